!> Writes src/mechanics/lubrication/finite_flow.inc: flow_table > FILE. The error of the fit goes to standard error. Some seconds.
program flow_table
   use finite_fit, only: node_ratio
   use finite_flow, only: flow_terms, n_flow_terms
   use film_grid_case, only: make_grid, result_of
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use kinds, only: pi, wp
   use lapack, only: dgels
   use reynolds_grid, only: boundary_reynolds, journal_state_t, reynolds_grid_t
   use reynolds_results, only: film_result_t
   implicit none (type, external)

   real(wp), parameter :: eps(15) = [0.0_wp, 0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.5_wp, 0.6_wp, 0.7_wp, 0.8_wp, 0.87_wp, 0.92_wp, &
                                     0.96_wp, 0.98_wp, 0.99_wp, 0.999_wp]
   integer, parameter :: n_ratio = 8, n_angle = 25, n = n_ratio*size(eps)*n_angle, per_line = 6
   real(wp), allocatable :: fitted(:), matrix(:, :), right(:, :), work(:)
   real(wp) :: phi(n)
   type(journal_state_t) :: state
   type(film_result_t) :: film
   type(reynolds_grid_t) :: grid
   real(wp) :: angle
   integer :: i, info, j, k, row

   allocate (matrix(n, n_flow_terms), right(n, 1), work(64*n_flow_terms))
   row = 0
   do k = 1, n_ratio
      call make_grid(grid, node_ratio(k), 160, 16, boundary_reynolds)
      do i = 1, size(eps)
         do j = 1, n_angle
            row = row + 1
            angle = pi*(j - 1)/(n_angle - 1)
            state%e = [eps(i), 0.0_wp]
            state%v = [cos(angle), sin(angle)]
            film = result_of(grid, state)
            phi(row) = film%side_flow/(24.0_wp*node_ratio(k)**2)
            matrix(row, :) = flow_terms(node_ratio(k), eps(i), eps(i)*cos(angle))
         end do
      end do
   end do
   right(:, 1) = log(phi)
   fitted = [(0.0_wp, i=1, n)]
   block
      real(wp), allocatable :: copy(:, :)

      copy = matrix
      call dgels("N", n, n_flow_terms, 1, copy, n, right, n, work, size(work), info)
   end block
   right(:n_flow_terms, 1) = 1.0e-6_wp*nint(1.0e6_wp*right(:n_flow_terms, 1))
   fitted = exp(matmul(matrix, right(:n_flow_terms, 1)))
   write (error_unit, "(a, f7.3, a)") "greatest error of the side flow ", 100.0_wp*maxval(abs(fitted/phi - 1.0_wp)), " %"
   write (output_unit, "(a)") "! Coefficients of finite_flow: `make film-table` writes this file.", &
      "   real(wp), parameter :: flow_coefficient(n_flow_terms) = 1.0e-6_wp*[ &"
   do i = 1, n_flow_terms, per_line
      k = min(i + per_line - 1, n_flow_terms)
      write (output_unit, "(9x, *(i0, '.0_wp', :, ', '))", advance="no") nint(1.0e6_wp*right(i:k, 1))
      if (k < n_flow_terms) write (output_unit, "(a)") ", &"
   end do
   write (output_unit, "(a)") "]", "      !! (n_flow_terms) polynomials of log(L/D), times powers of eps^2 and of x [1]"
end program flow_table
