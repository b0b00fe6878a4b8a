!> Films as recorders ask for them and get them: pressure and gap around a bearing, unwrapped, at one moment of a motion.
!>
!> Angles are in the frame of the bearing's body, places along the axis from the middle of the bearing. So grooves, which are
!> fixed in the bearing, stay where they are from moment to moment.
module film_fields
   use kinds, only: wp
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: append_field, field_request_t, film_field_t, load_fields, save_fields, moment_at, moment_end, moment_min

   integer, parameter :: moment_end = 1    !! the end of the run
   integer, parameter :: moment_min = 2  !! the end of the step with the minimum film
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

   !> Write films.
   subroutine save_fields(list, archive)
      type(film_field_t), intent(in) :: list(:)  !! (any) the films
      type(archive_t), intent(inout) :: archive        !! receives them

      integer :: k

      call archive%put(size(list))
      do k = 1, size(list)
         associate (this => list(k))
            call archive%put(this%request%name)
            call archive%put(this%request%joint)
            call archive%put(this%request%moment)
            call archive%put(this%film)
            call archive%put([this%request%t, this%t, this%e, this%clearance, this%angle])
            call archive%put_list(this%theta)
            call archive%put_list(this%y)
            call archive%put_list(reshape(this%pressure, [size(this%pressure)]))
            call archive%put_list(reshape(this%gap, [size(this%gap)]))
         end associate
      end do
   end subroutine save_fields

   !> Take them back.
   subroutine load_fields(archive, list)
      type(archive_t), intent(inout) :: archive                      !! holds them
      type(film_field_t), allocatable, intent(out) :: list(:)  !! (any) the films

      type(film_field_t) :: field
      real(wp), allocatable :: numbers(:)
      integer :: k, n

      allocate (list(0))
      call archive%get(n)
      do k = 1, n
         call archive%get_text(field%request%name)
         call archive%get_text(field%request%joint)
         call archive%get(field%request%moment)
         call archive%get_text(field%film)
         call archive%get(field%request%t)
         call archive%get(field%t)
         call archive%get(field%e)
         call archive%get(field%clearance)
         call archive%get(field%angle)
         call archive%get_list(field%theta)
         call archive%get_list(field%y)
         call archive%get_list(numbers)
         field%pressure = reshape(numbers, [size(field%y), size(field%theta)])
         call archive%get_list(numbers)
         field%gap = reshape(numbers, [size(field%y), size(field%theta)])
         if (.not. archive%is_good) return
         call append_field(list, field)
      end do
   end subroutine load_fields

end module film_fields
