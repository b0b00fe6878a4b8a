!> What was found of the horizon, on the archive of a run that is saved: a run that continues reports what the run before found,
!> since another search would end elsewhere where its time is up.
module horizon_memory
   use batch_means, only: estimate_t
   use exponent, only: exponent_t, horizon_t
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: load_horizon, save_horizon

contains

   !> Write it; one that was not planned is a flag.
   subroutine save_horizon(horizon, archive)
      type(horizon_t), intent(in) :: horizon   !! what is known, or nothing
      type(archive_t), intent(inout) :: archive      !! receives it

      call archive%put(allocated(horizon%t))
      if (.not. allocated(horizon%t)) return
      call archive%put_list(horizon%t)
      call archive%put([horizon%after, horizon%tolerance, horizon%asked])
      call save_exponent(horizon%tangent, archive)
      call save_exponent(horizon%twin, archive)
      call archive%put([horizon%n_crossed, horizon%n_grazed, horizon%n_together, horizon%n_renewed])
      call archive%put(horizon%digits)
      call archive%put(horizon%run_digits)
      call archive%put(horizon%is_cut)
      call archive%put(horizon%with_twin)
      call archive%put(horizon%is_agreed)
   end subroutine save_horizon

   !> Take it back.
   subroutine load_horizon(archive, horizon)
      type(archive_t), intent(inout) :: archive      !! holds it
      type(horizon_t), intent(out) :: horizon  !! what was known; no instants: nothing

      logical :: is_there

      call archive%get(is_there)
      if (.not. is_there) return
      call archive%get_list(horizon%t)
      call archive%get(horizon%after)
      call archive%get(horizon%tolerance)
      call archive%get(horizon%asked)
      call load_exponent(archive, horizon%tangent)
      call load_exponent(archive, horizon%twin)
      call archive%get(horizon%n_crossed)
      call archive%get(horizon%n_grazed)
      call archive%get(horizon%n_together)
      call archive%get(horizon%n_renewed)
      call archive%get(horizon%digits)
      call archive%get(horizon%run_digits)
      call archive%get(horizon%is_cut)
      call archive%get(horizon%with_twin)
      call archive%get(horizon%is_agreed)
   end subroutine load_horizon

   !> Write what a method says.
   subroutine save_exponent(exponent, archive)
      type(exponent_t), intent(in) :: exponent   !! what it says
      type(archive_t), intent(inout) :: archive        !! receives it

      call archive%put(exponent%reason)
      call archive%put([exponent%rate%value, exponent%rate%half, exponent%rate%n_effective])
      call archive%put(exponent%rate%n_batch)
      call archive%put_list(exponent%growth)
   end subroutine save_exponent

   !> Take it back.
   subroutine load_exponent(archive, exponent)
      type(archive_t), intent(inout) :: archive        !! holds it
      type(exponent_t), intent(out) :: exponent  !! what the method says

      type(estimate_t) :: rate

      call archive%get_text(exponent%reason)
      call archive%get(rate%value)
      call archive%get(rate%half)
      call archive%get(rate%n_effective)
      call archive%get(rate%n_batch)
      exponent%rate = rate
      call archive%get_list(exponent%growth)
   end subroutine load_exponent

end module horizon_memory
