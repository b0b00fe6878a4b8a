!> The largest Lyapunov exponent and the horizon in an HDF5 file: the group `horizon`.
module horizon_group
   use exponent, only: exponent_t, horizon_t
   use growth, only: n_digit
   use hdf5, only: h5gclose_f, hid_t
   use hdf5_attributes, only: long_attribute, real_attribute, text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: real_dataset
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: write_horizon

contains

   !> Write the group; nothing if the horizon was not planned.
   subroutine write_horizon(file, horizon, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(horizon_t), intent(in) :: horizon      !! what is known
      integer, intent(inout) :: status            !! negative: failed

      integer(hid_t) :: group
      integer :: closed, n

      if (.not. allocated(horizon%t)) return
      call new_group(file, "horizon", group, status)
      if (status < 0) return
      n = size(horizon%t)
      call real_attribute(group, "after", horizon%after, status)
      call real_attribute(group, "end", horizon%t(n), status)
      call long_attribute(group, "is_cut", int(merge(1, 0, horizon%is_cut), i8), status)
      call real_attribute(group, "tolerance", horizon%tolerance, status)
      call put(horizon%tangent, "exponent")
      call put(horizon%twin, "exponent_by_twin")
      call long_attribute(group, "exponents_agree", int(merge(1, 0, horizon%is_agreed), i8), status)
      call long_attribute(group, "jumps", int(horizon%n_crossed, i8), status)
      call long_attribute(group, "grazing", int(horizon%n_grazed, i8), status)
      call long_attribute(group, "together", int(horizon%n_together, i8), status)
      call long_attribute(group, "brought_back", int(horizon%n_renewed, i8), status)
      call h5gclose_f(group, closed)
      call real_dataset(file, "horizon/time", [n], horizon%t, "s", "instants", status)
      call real_dataset(file, "horizon/growth", [n], horizon%tangent%growth, "1", &
                        "ln of the growth of a perturbation, from the tangent equations", status)
      call real_dataset(file, "horizon/growth_by_twin", [n], horizon%twin%growth, "1", "the same, from a neighbouring "// &
         "trajectory", status)
      call real_dataset(file, "horizon/digits", [n_digit], horizon%digits, "s", &
                        "time up to which a solution in double precision has 1, 2, ... digits; NaN: beyond the end", status)
      if (horizon%asked <= 0.0_wp) return
      call real_dataset(file, "horizon/digits_of_run", [n_digit], horizon%run_digits, "s", &
                        "the same for a run with the tolerance of this one", status)

   contains

      !> What a method says.
      subroutine put(exponent, name)
         type(exponent_t), intent(in) :: exponent   !! the method's
         character(*), intent(in) :: name           !! of its numbers

         call text_attribute(group, name//"_reason", exponent%reason, status)
         if (exponent%reason /= "") return
         call real_attribute(group, name, exponent%rate%value, status)
         call real_attribute(group, name//"_interval", exponent%rate%half, status)
         call long_attribute(group, name//"_batches", int(exponent%rate%n_batch, i8), status)
         call real_attribute(group, name//"_effective", exponent%rate%n_effective, status)
      end subroutine put

   end subroutine write_horizon

end module horizon_group
