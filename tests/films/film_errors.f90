!> Errors of all films against Reynolds' equation on a grid, over L/D, eccentricity and motion, to docs/data/film_errors.csv
program film_errors
   use, intrinsic :: iso_fortran_env, only: output_unit
   use film_comparison, only: column_names, error_row_t, grid_force, motion_names, ratios, row_of, steps_of_eps
   use film_registry, only: n_journal_film_kinds
   use kinds, only: wp
   implicit none (type, external)

   type(error_row_t) :: row
   character(:), allocatable :: name
   real(wp) :: f(2, size(ratios), size(steps_of_eps), size(motion_names))
   integer :: i, j, k, kind

   do k = 1, size(motion_names)
      do i = 1, size(ratios)
         do j = 1, size(steps_of_eps)
            f(:, i, j, k) = grid_force(ratios(i), steps_of_eps(j), k)
         end do
      end do
   end do
   write (output_unit, "(a)") column_names
   do kind = 1, n_journal_film_kinds()
      do k = 1, size(motion_names)
         do i = 1, size(ratios)
            do j = 1, size(steps_of_eps)
               call row_of(kind, ratios(i), steps_of_eps(j), k, f(:, i, j, k), name, row)
               write (output_unit, "(4a, 2(f4.2, a), es10.4, a, f0.3, a, es10.4)") name, ",", trim(motion_names(k)), ",", &
                  ratios(i), ",", steps_of_eps(j), ",", row%force, ",", row%angle, ",", row%error
            end do
         end do
      end do
   end do
end program film_errors
