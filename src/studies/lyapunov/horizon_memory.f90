!> What was found of the horizon, on the tape of a run that is saved: a run that goes on tells what the run before found, since
!> another search would end elsewhere where its time is up.
module horizon_memory
   use batch_means, only: estimate_t
   use exponent, only: exponent_t, horizon_t
   use tape, only: tape_t
   implicit none (type, external)
   private
   public :: load_horizon, save_horizon

contains

   !> Write it; one that was not planned is a flag.
   subroutine save_horizon(horizon, tape)
      type(horizon_t), intent(in) :: horizon   !! what is known, or nothing
      type(tape_t), intent(inout) :: tape      !! receives it

      call tape%put(allocated(horizon%t))
      if (.not. allocated(horizon%t)) return
      call tape%put_list(horizon%t)
      call tape%put([horizon%after, horizon%tolerance, horizon%asked])
      call save_exponent(horizon%tangent, tape)
      call save_exponent(horizon%twin, tape)
      call tape%put([horizon%n_crossed, horizon%n_grazed, horizon%n_together, horizon%n_renewed])
      call tape%put(horizon%digits)
      call tape%put(horizon%run_digits)
      call tape%put(horizon%is_cut)
      call tape%put(horizon%with_twin)
      call tape%put(horizon%is_agreed)
   end subroutine save_horizon

   !> Take it back.
   subroutine load_horizon(tape, horizon)
      type(tape_t), intent(inout) :: tape      !! holds it
      type(horizon_t), intent(out) :: horizon  !! what was known; no instants: nothing

      logical :: is_there

      call tape%get(is_there)
      if (.not. is_there) return
      call tape%get_list(horizon%t)
      call tape%get(horizon%after)
      call tape%get(horizon%tolerance)
      call tape%get(horizon%asked)
      call load_exponent(tape, horizon%tangent)
      call load_exponent(tape, horizon%twin)
      call tape%get(horizon%n_crossed)
      call tape%get(horizon%n_grazed)
      call tape%get(horizon%n_together)
      call tape%get(horizon%n_renewed)
      call tape%get(horizon%digits)
      call tape%get(horizon%run_digits)
      call tape%get(horizon%is_cut)
      call tape%get(horizon%with_twin)
      call tape%get(horizon%is_agreed)
   end subroutine load_horizon

   !> Write what a method says.
   subroutine save_exponent(exponent, tape)
      type(exponent_t), intent(in) :: exponent   !! what it says
      type(tape_t), intent(inout) :: tape        !! receives it

      call tape%put(exponent%reason)
      call tape%put([exponent%rate%value, exponent%rate%half, exponent%rate%n_effective])
      call tape%put(exponent%rate%n_batch)
      call tape%put_list(exponent%growth)
   end subroutine save_exponent

   !> Take it back.
   subroutine load_exponent(tape, exponent)
      type(tape_t), intent(inout) :: tape        !! holds it
      type(exponent_t), intent(out) :: exponent  !! what the method says

      type(estimate_t) :: rate

      call tape%get_text(exponent%reason)
      call tape%get(rate%value)
      call tape%get(rate%half)
      call tape%get(rate%n_effective)
      call tape%get(rate%n_batch)
      exponent%rate = rate
      call tape%get_list(exponent%growth)
   end subroutine load_exponent

end module horizon_memory
