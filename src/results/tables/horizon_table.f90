!> The largest Lyapunov exponent and the horizon as tables: growth of small changes, and times up to which there are digits.
module horizon_table
   use exponent, only: exponent_t, horizon_t
   use growth, only: n_digit
   use kinds, only: wp
   use result_table, only: in_all, in_hdf5, in_text_files, result_table_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: table_of_digits, table_of_horizon

contains

   !> Facts of both methods, and a row for each output time.
   function table_of_horizon(horizon) result(table)
      type(horizon_t), intent(in) :: horizon      !! what is known, its times allocated
      type(result_table_t) :: table               !! the table

      integer :: n, of_twin

      n = size(horizon%t)
      of_twin = merge(in_all, in_hdf5, horizon%with_twin)
      call table%start("growth", "horizon", n)
      call put_method(horizon%tangent, "exponent", in_all)
      call put_method(horizon%twin, "exponent_by_twin", of_twin)
      call table%fact("exponents_agree", horizon%is_agreed, formats=of_twin)
      call table%fact("exponent_from", horizon%after, "after")
      call table%fact("exponent_to", horizon%t(n), "end")
      call table%fact("exponent_cut", horizon%is_cut, "is_cut")
      call table%fact("tolerance", horizon%tolerance, formats=in_hdf5)
      call table%fact("exponent_jumps", horizon%n_crossed, "jumps")
      call table%fact("exponent_grazing", horizon%n_grazed, "grazing")
      call table%fact("exponent_together", horizon%n_together, "together")
      call table%fact("brought_back", horizon%n_renewed, formats=in_hdf5)
      call put_digits(horizon%digits, "horizon_")
      if (horizon%asked > 0.0_wp) call put_digits(horizon%run_digits, "horizon_of_run_")
      call table%put("time", "s", "instants", horizon%t, formats=in_hdf5)
      call table%put("growth", "1", "ln of the growth of a perturbation, from the tangent equations", horizon%tangent%growth, &
                     formats=in_hdf5)
      call table%put("growth_by_twin", "1", "the same, from a neighbouring trajectory", horizon%twin%growth, formats=in_hdf5)

   contains

      !> The exponent by a method.
      subroutine put_method(exponent, name, formats)
         type(exponent_t), intent(in) :: exponent   !! the method's
         character(*), intent(in) :: name           !! of its facts
         integer, intent(in) :: formats             !! which formats have them

         call table%fact(name//"_reason", exponent%reason, formats=formats)
         if (exponent%reason /= "") return
         call table%fact(name, exponent%rate%value, formats=formats)
         call table%fact(name//"_interval", exponent%rate%half, formats=formats)
         call table%fact(name//"_batches", exponent%rate%n_batch, formats=formats)
         call table%fact(name//"_effective", exponent%rate%n_effective, formats=formats)
      end subroutine put_method

      !> Times up to which there are digits.
      subroutine put_digits(digits, name)
         real(wp), intent(in) :: digits(:)          !! (n_digit) times; NaN: beyond the end [s]
         character(*), intent(in) :: name           !! before the number of digits

         integer :: k

         do k = 1, n_digit
            call table%fact(name//to_text(k), digits(k), formats=in_text_files)
         end do
      end subroutine put_digits

   end function table_of_horizon

   !> A row for each number of digits.
   function table_of_digits(horizon) result(table)
      type(horizon_t), intent(in) :: horizon      !! what is known
      type(result_table_t) :: table               !! the table

      call table%start("digits", "horizon", n_digit)
      call table%put("digits", "s", "time up to which a solution in double precision has 1, 2, ... digits; NaN: beyond the end", &
                     horizon%digits)
      if (horizon%asked <= 0.0_wp) return
      call table%put("digits_of_run", "s", "the same for a run with the tolerance of this one", horizon%run_digits)
   end function table_of_digits

end module horizon_table
