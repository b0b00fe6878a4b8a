!> Films as recorders ask for them and get them: pressure and gap around a bearing, unwrapped, at one moment of a motion.
!>
!> Angles are in the frame of the bearing's body, places along the axis from the middle of the bearing. So grooves, which are
!> fixed in the bearing, stay where they are from moment to moment.
module film_fields
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: append_field, field_request_t, film_field_t, moment_at, moment_end, moment_least

   integer, parameter :: moment_end = 1    !! the end of the run
   integer, parameter :: moment_least = 2  !! the end of the step with the least film
   integer, parameter :: moment_at = 3     !! a time

   !> A film that is asked for.
   type :: field_request_t
      character(:), allocatable :: name   !! of the figure, and of the group in run.h5
      character(:), allocatable :: joint  !! the joint whose film it is
      integer :: moment = moment_end      !! one of the above
      real(wp) :: t = 0.0_wp              !! with `moment_at`: the time [s]
   end type field_request_t

   !> The film of a joint at a moment.
   type :: film_field_t
      type(field_request_t) :: request         !! what it answers
      character(:), allocatable :: film        !! name of the film
      real(wp) :: t = 0.0_wp                   !! the moment [s]
      real(wp) :: e(2) = 0.0_wp                !! (2) eccentricity of the journal, frame of the bearing's body [m]
      real(wp) :: clearance = 0.0_wp           !! of the film [m]
      real(wp) :: angle = 0.0_wp               !! of the bearing's body, world frame [rad]
      real(wp), allocatable :: theta(:)        !! (n) angles around the bearing, from 0 to 2 pi, frame of its body [rad]
      real(wp), allocatable :: y(:)            !! (m) places along the axis, from end to end [m]
      real(wp), allocatable :: pressure(:, :)  !! (m, n) above that at the ends [Pa]
      real(wp), allocatable :: gap(:, :)       !! (m, n) thickness of the film [m]
   end type film_field_t

contains

   !> Append a film to a list.
   subroutine append_field(list, field)
      type(film_field_t), allocatable, intent(inout) :: list(:)  !! (any) grown by one
      type(film_field_t), intent(in) :: field                    !! the new one

      type(film_field_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(size(list) + 1))
      do k = 1, size(list)
         grown(k) = list(k)
      end do
      grown(size(grown)) = field
      call move_alloc(grown, list)
   end subroutine append_field

end module film_fields
