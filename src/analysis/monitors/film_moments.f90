!> Films that a recorder asks for, unwrapped, at the moments for which it asks: a time, the end of the run, the minimum film.
!>
!> Pressures are found at these moments only. For the minimum film the motion of the bearing is looked at on the ends of steps, and
!> that of the minimum film kept.
module film_moments
   use film_fields, only: field_request_t, film_field_t, moment_at, moment_end, moment_min
   use film_law, only: film_motion_t, max_eccentricity
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use recorder, only: recorder_t
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: film_moments_t

   !> A film that is asked for.
   type :: wanted_film_t
      type(field_request_t) :: request       !! what is asked for
      integer :: slot = 0                    !! set of the joint in the whole; 0: there is no such film, or it was reported
      integer :: item = 0                    !! the joint within the set
      real(wp) :: distance = -1.0_wp         !! of the centres with the minimum film [m]
      real(wp) :: t = 0.0_wp                 !! its time [s]
      type(film_motion_t) :: motion          !! motion of the bearing then
   end type wanted_film_t

   !> All that are asked for.
   type :: film_moments_t
      type(wanted_film_t), allocatable, private :: films(:)  !! (any) films
      logical :: has_min = .false.                         !! minimum films are asked for
   contains
      procedure :: begin => moments_begin
      procedure :: look => moments_look
      procedure :: next => moments_next
      procedure :: tell_at => moments_tell_at
      procedure :: tell_rest => moments_tell_rest
      procedure :: save => moments_save
      procedure :: load => moments_load
   end type film_moments_t

contains

   !> What a recorder asks for of a system.
   subroutine moments_begin(self, system, recorder)
      class(film_moments_t), intent(out) :: self  !! the films
      type(mechanism_t), intent(in) :: system     !! the whole
      class(recorder_t), intent(in) :: recorder   !! the recorder, started

      integer :: k

      if (.not. allocated(recorder%wants_fields)) return
      allocate (self%films(size(recorder%wants_fields)))
      do k = 1, size(self%films)
         self%films(k)%request = recorder%wants_fields(k)
         call find_film(system, self%films(k)%request%joint, self%films(k)%slot, self%films(k)%item)
         if (self%films(k)%slot > 0 .and. self%films(k)%request%moment == moment_min) self%has_min = .true.
      end do
   end subroutine moments_begin

   !> Where the joint of a film is.
   pure subroutine find_film(system, joint, slot, item)
      type(mechanism_t), intent(in) :: system  !! a mechanism
      character(*), intent(in) :: joint        !! name of the joint
      integer, intent(out) :: slot             !! its set; 0: there is no such film
      integer, intent(out) :: item             !! the joint within the set

      do slot = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(slot)%set)
            if (.not. allocated(set%laws%films)) cycle
            if (.not. set%laws%films%acts) cycle
            do item = 1, set%n
               if (set%names(item)%s == joint) return
            end do
         end associate
      end do
      slot = 0
      item = 0
   end subroutine find_film

   !> Motion of the bearing of a joint.
   type(film_motion_t) function motion_of(system, slot, item)
      type(mechanism_t), intent(in) :: system  !! a mechanism
      integer, intent(in) :: slot              !! set of the joint
      integer, intent(in) :: item              !! the joint within the set

      associate (set => system%clearance_joints%sets(slot)%set)
         motion_of = set%laws%films%motion_of(item, set%items%body(:, item), set%items%s_i(:, item), set%items%s_j(:, item), &
                                              system%linkage%motion)
      end associate
   end function motion_of

   !> Update the minimum film at the end of a step of a part, or at a row of the whole.
   subroutine moments_look(self, part, t)
      class(film_moments_t), intent(inout) :: self  !! the films
      type(mechanism_t), intent(in) :: part         !! the part or the whole, evaluated at this time
      real(wp), intent(in) :: t                     !! the time [s]

      type(film_motion_t) :: motion
      real(wp) :: distance
      integer :: item, k, slot

      do k = 1, size(self%films)
         if (self%films(k)%slot == 0 .or. self%films(k)%request%moment /= moment_min) cycle
         call find_film(part, self%films(k)%request%joint, slot, item)
         if (slot == 0) cycle
         motion = motion_of(part, slot, item)
         distance = max_eccentricity(motion)
         if (distance <= self%films(k)%distance) cycle
         self%films(k)%distance = distance
         self%films(k)%t = t
         self%films(k)%motion = motion
      end do
   end subroutine moments_look

   !> The earliest time that is asked for and was not reported; none: one that is never reached.
   pure real(wp) function moments_next(self) result(t)
      class(film_moments_t), intent(in) :: self  !! the films

      integer :: k

      t = huge(1.0_wp)
      if (.not. allocated(self%films)) return
      do k = 1, size(self%films)
         if (self%films(k)%slot > 0 .and. self%films(k)%request%moment == moment_at) t = min(t, self%films(k)%request%t)
      end do
   end function moments_next

   !> Report the films of a time.
   subroutine moments_tell_at(self, system, t, recorder)
      class(film_moments_t), intent(inout) :: self  !! the films
      type(mechanism_t), intent(in) :: system       !! the whole, its motion that of the time
      real(wp), intent(in) :: t                     !! the time [s]
      class(recorder_t), intent(inout) :: recorder  !! keeps the results

      integer :: k

      if (.not. allocated(self%films)) return
      do k = 1, size(self%films)
         if (self%films(k)%slot == 0 .or. self%films(k)%request%moment /= moment_at .or. self%films(k)%request%t > t) cycle
         self%films(k)%t = t
         self%films(k)%motion = motion_of(system, self%films(k)%slot, self%films(k)%item)
         call tell(self%films(k), system, recorder)
      end do
   end subroutine moments_tell_at

   !> Report the films of the end, and the minimum ones.
   subroutine moments_tell_rest(self, system, t, recorder)
      class(film_moments_t), intent(inout) :: self  !! the films
      type(mechanism_t), intent(in) :: system       !! the whole, its motion that of the end
      real(wp), intent(in) :: t                     !! the end [s]
      class(recorder_t), intent(inout) :: recorder  !! keeps the results

      integer :: k

      if (.not. allocated(self%films)) return
      do k = 1, size(self%films)
         if (self%films(k)%slot == 0 .or. self%films(k)%request%moment == moment_at) cycle
         if (self%films(k)%request%moment == moment_end .or. self%films(k)%distance < 0.0_wp) then
            self%films(k)%t = t
            self%films(k)%motion = motion_of(system, self%films(k)%slot, self%films(k)%item)
         end if
         call tell(self%films(k), system, recorder)
      end do
   end subroutine moments_tell_rest

   !> Report a film, once.
   subroutine tell(film, system, recorder)
      type(wanted_film_t), intent(inout) :: film    !! the film
      type(mechanism_t), intent(in) :: system       !! the whole
      class(recorder_t), intent(inout) :: recorder  !! keeps the results

      type(film_field_t) :: field

      field%request = film%request
      field%t = film%t
      call system%clearance_joints%sets(film%slot)%set%laws%films%unwrap(film%item, film%motion, field)
      call recorder%field(field)
      film%slot = 0
   end subroutine tell

   !> Write what is remembered of the minimum films, and which were reported.
   subroutine moments_save(self, archive)
      class(film_moments_t), intent(in) :: self  !! the films
      type(archive_t), intent(inout) :: archive        !! what is remembered

      integer :: k

      if (.not. allocated(self%films)) return
      do k = 1, size(self%films)
         call archive%put(self%films(k)%slot)
         call archive%put([self%films(k)%distance, self%films(k)%t])
         call archive%put(transfer(self%films(k)%motion, [0.0_wp]))
      end do
   end subroutine moments_save

   !> Take it back.
   subroutine moments_load(self, archive)
      class(film_moments_t), intent(inout) :: self  !! the films, started
      type(archive_t), intent(inout) :: archive           !! what was remembered

      real(wp) :: numbers(size(transfer(film_motion_t(), [0.0_wp])))
      integer :: k

      if (.not. allocated(self%films)) return
      do k = 1, size(self%films)
         call archive%get(self%films(k)%slot)
         call archive%get(self%films(k)%distance)
         call archive%get(self%films(k)%t)
         call archive%get(numbers)
         self%films(k)%motion = transfer(numbers, self%films(k)%motion)
      end do
   end subroutine moments_load

end module film_moments
