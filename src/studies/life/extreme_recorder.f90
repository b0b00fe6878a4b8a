!> A recorder that keeps the extremes of some channels from a time on: those of all rows, and those located between rows.
module extreme_recorder
   use catalogue, only: catalogue_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use recorder, only: event_t, recorder_t, summary_t
   implicit none (type, external)
   private
   public :: extreme_recorder_t

   !> What is kept. Set `asked` and `from` before it starts.
   type, extends(recorder_t) :: extreme_recorder_t
      integer, allocatable :: asked(:, :)      !! (3, n) group, component and item of the channels
      real(wp) :: from = 0.0_wp                !! extremes since then [s]
      real(wp), allocatable :: minimum(:)      !! (n) huge: no value [any]
      real(wp), allocatable :: maximum(:)      !! (n) -huge: no value [any]
   contains
      procedure :: start => start_extremes
      procedure :: wants => wants_extremes
      procedure :: sample => sample_extremes
      procedure :: further_row => row_of_extremes
      procedure :: between => between_extremes
      procedure :: event => no_event
      procedure :: progress => no_progress
      procedure :: finish => no_finish
   end type extreme_recorder_t

contains

   !> Find the channels.
   subroutine start_extremes(self, catalogue, error)
      class(extreme_recorder_t), intent(inout) :: self   !! the recorder
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! never set

      integer :: k

      associate (n => size(self%asked, 2))
         self%minimum = [(huge(1.0_wp), k=1, n)]
         self%maximum = -self%minimum
         self%wants_contact_rows = n > 0
         self%located%place = [(catalogue%place(self%asked(1, k), self%asked(2, k), self%asked(3, k)), k=1, n)]
         self%located%from = self%from
      end associate
   end subroutine start_extremes

   !> Whether a value is read.
   pure logical function wants_extremes(self, group, item) result(wants)
      class(extreme_recorder_t), intent(in) :: self   !! the recorder
      integer, intent(in) :: group                    !! its group in the catalogue
      integer, intent(in) :: item                     !! number of the item in the group

      wants = any(self%asked(1, :) == group .and. self%asked(3, :) == item)
   end function wants_extremes

   !> Note the values of an instant.
   subroutine note(self, t, catalogue)
      class(extreme_recorder_t), intent(inout) :: self   !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t

      real(wp) :: value
      integer :: k

      if (t < self%from) return
      do k = 1, size(self%asked, 2)
         value = catalogue%values(self%located%place(k))
         if (.not. ieee_is_finite(value)) cycle
         self%minimum(k) = min(self%minimum(k), value)
         self%maximum(k) = max(self%maximum(k), value)
      end do
   end subroutine note

   !> Note an output time.
   subroutine sample_extremes(self, t, catalogue, error)
      class(extreme_recorder_t), intent(inout) :: self   !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! never set

      call note(self, t, catalogue)
   end subroutine sample_extremes

   !> Note an instant of a contact.
   subroutine row_of_extremes(self, t, kind, catalogue, error)
      class(extreme_recorder_t), intent(inout) :: self   !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      integer, intent(in) :: kind                        !! what it is
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! never set

      call note(self, t, catalogue)
   end subroutine row_of_extremes

   !> Note an extreme between rows.
   subroutine between_extremes(self, t, catalogue)
      class(extreme_recorder_t), intent(inout) :: self   !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t

      call note(self, t, catalogue)
   end subroutine between_extremes

   !> Events are not kept.
   subroutine no_event(self, event, error)
      class(extreme_recorder_t), intent(inout) :: self   !! the recorder
      type(event_t), intent(in) :: event                 !! what happened
      type(error_t), allocatable, intent(out) :: error   !! never set
   end subroutine no_event

   !> Progress is not shown.
   subroutine no_progress(self, fraction)
      class(extreme_recorder_t), intent(inout) :: self  !! the recorder
      real(wp), intent(in) :: fraction                  !! of the work done, 0 to 1 [1]
   end subroutine no_progress

   !> Nothing is closed.
   subroutine no_finish(self, summary, error)
      class(extreme_recorder_t), intent(inout) :: self   !! the recorder
      type(summary_t), intent(in) :: summary             !! cost and errors of the run
      type(error_t), allocatable, intent(out) :: error   !! never set
   end subroutine no_finish

end module extreme_recorder
