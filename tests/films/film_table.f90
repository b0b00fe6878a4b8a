!> Writes src/mechanics/lubrication/finite_table.inc: film_table > FILE. The errors of the fit go to standard error. Some minutes.
program film_table
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use finite_bearing, only: n_mu, n_nu, n_ratio
   use finite_fit, only: fit_ratio, node_ratio, to_polynomials
   use kinds, only: wp
   implicit none (type, external)

   integer, parameter :: per_line = 14         !! numbers
   real(wp), parameter :: unit = 1.0e-5_wp     !! of a number [1]
   real(wp) :: fit(0:n_nu, -n_mu:n_mu, n_ratio), max_error
   integer :: i, j, k, n
   integer :: numbers(n_ratio, -2:n_nu, -n_mu:n_mu)

   do k = 1, n_ratio
      call fit_ratio(node_ratio(k), fit(:, :, k), max_error)
      write (error_unit, "(a, f7.4, a, es9.2)") "L/D ", node_ratio(k), "  greatest error of force over force ", max_error
   end do
   do i = -n_mu, n_mu
      do j = -2, n_nu
         numbers(:, j, i) = nint(to_polynomials(fit(abs(j), i, :))/unit)
      end do
   end do
   write (output_unit, "(a)") "! Splines of S of finite_bearing: `make film-table` writes this file.", &
      "   real(wp), parameter :: table(n_ratio, -2:n_nu, -n_mu:n_mu) = 1.0e-5_wp*reshape([ &"
   n = size(numbers)
   associate (all => reshape(numbers, [n]))
      do i = 1, n, per_line
         k = min(i + per_line - 1, n)
         write (output_unit, "(9x, *(i0, :, ', '))", advance="no") all(i:k)
         if (k < n) write (output_unit, "(a)") ", &"
      end do
   end associate
   write (output_unit, "(a)") "], [n_ratio, n_nu + 3, 2*n_mu + 1])", &
      "      !! (n_ratio, -2:n_nu, -n_mu:n_mu) polynomials of log(L/D) by splines over nu and mu [1]"
end program film_table
