!> A recorder that keeps a run in memory: positions, velocities and reactions at the output instants, and all contacts.
!>
!> All lengths of a sort have one unit, so that they can be compared with one scale: an angle of a body counts as the way of a
!> point at its radius of gyration, a moment as a force at the maximum of these radii. Of the orientation of a body in space the
!> ways of three such points are kept, one on each of its own axes: the columns of the rotation times the radius. They do not know
!> the sign of Euler parameters.
module kept_run
   use catalogue, only: catalogue_t
   use catalogue_groups, only: group_t
   use groups_of_catalogue, only: group_bodies, group_clearances, group_contacts, group_drivers, group_joints
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use recorder, only: event_t, recorder_t, summary_t
   use rotations, only: rotation_of_parameters
   implicit none (type, external)
   private
   public :: contact_t, kept_run_t, n_sort, numbers_of, sort_of, sort_positions, sort_reactions, sort_velocities

   integer, parameter :: sort_positions = 1   !! positions and angles of bodies [m]
   integer, parameter :: sort_velocities = 2  !! velocities and angular velocities of bodies [m/s]
   integer, parameter :: sort_reactions = 3   !! forces and moments of joints, drivers and joints with clearance [N]
   integer, parameter :: n_sort = 3           !! number of sorts
   integer, parameter :: n_place = 9          !! coordinates of three points that report the orientation of a body

   !> A contact that started.
   type :: contact_t
      integer :: number = 0                   !! in the catalogue's group of contacts
      real(wp) :: onset = 0.0_wp              !! time at which it started [s]
      real(wp) :: impact_speed = 0.0_wp       !! normal approach speed there [m/s]
      real(wp) :: peak_force = 0.0_wp         !! maximum normal force [N]
      real(wp) :: release_speed = 0.0_wp      !! normal separation speed at the end; NaN: not ended [m/s]
   end type contact_t

   !> What is kept of a run. Components with a default are set before it.
   type, extends(recorder_t) :: kept_run_t
      logical :: is_kept = .true.                   !! .false.: nothing is kept, as in a run that is timed
      real(wp), allocatable :: arm(:)               !! (bodies) radii of gyration, 1 where there is none [m]
      integer :: n = 0                              !! instants kept
      real(wp) :: end = 0.0_wp                      !! time at which it ended [s]
      integer, allocatable :: sort(:)               !! (values) sort of each value
      real(wp), allocatable :: t(:)                 !! (capacity) instants [s]
      real(wp), allocatable :: values(:, :)         !! (values, capacity) in the unit of their sorts [any]
      type(contact_t), allocatable :: contacts(:)   !! (n) contacts, in the order in which they ended
      integer, allocatable, private :: group(:)     !! (values) group of each value
      integer, allocatable, private :: at(:, :)     !! (2, values) its component and item
      real(wp), allocatable, private :: factor(:)   !! (values) to the unit of its sort [any]
      type(catalogue_t), allocatable, private :: names  !! what was recorded, for the names of contacts
   contains
      procedure :: start => start_keeping
      procedure :: wants => wants_kept
      procedure :: sample => keep_sample
      procedure :: event => keep_contact
      procedure :: progress => no_progress
      procedure :: finish => finish_keeping
   end type kept_run_t

contains

   !> Find what will be kept.
   subroutine start_keeping(self, catalogue, error)
      class(kept_run_t), intent(inout) :: self           !! the recorder
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! never set

      integer :: g, pass

      allocate (self%contacts(0))
      if (.not. self%is_kept) return
      self%names = catalogue
      do pass = 1, 2
         self%n = 0
         do g = 1, size(catalogue%groups)
            call choose(g)
         end do
         if (pass == 1) allocate (self%sort(self%n), self%group(self%n), self%at(2, self%n), source=0)
         if (pass == 1) allocate (self%factor(self%n), source=1.0_wp)
      end do
      allocate (self%t(64), self%values(self%n, 64), source=0.0_wp)
      self%n = 0

   contains

      !> Take the numbers of a group that are requested; in the first pass only count them.
      subroutine choose(g)
         integer, intent(in) :: g  !! number of the group

         integer :: component, item, sort

         associate (group => catalogue%groups(g))
            sort = sort_of(group%item_group, group%channel%name)
            if (sort == 0) return
            do item = 1, catalogue%item_groups(group%item_group)%n
               if (.not. catalogue%item_has(g, item)) cycle
               do component = 1, numbers_of(group)
                  self%n = self%n + 1
                  if (pass == 1) cycle
                  self%sort(self%n) = sort
                  self%group(self%n) = g
                  self%at(:, self%n) = [component, item]
                  if (index(group%channel%name, "ang") == 1 .or. is_orientation(group)) self%factor(self%n) = self%arm(item)
                  if (group%channel%name == "moment") self%factor(self%n) = 1.0_wp/maxval(self%arm)
               end do
            end do
         end associate
      end subroutine choose

   end subroutine start_keeping

   !> Whether a value is read: what is not kept need not be found.
   pure logical function wants_kept(self, group, item) result(wants)
      class(kept_run_t), intent(in) :: self      !! the recorder
      integer, intent(in) :: group               !! its group in the catalogue
      integer, intent(in) :: item                !! number of the item in the group's group

      wants = .false.
      if (self%is_kept) wants = any(self%group == group .and. self%at(2, :) == item)
   end function wants_kept

   !> Whether a quantity is the orientation of bodies in space.
   pure logical function is_orientation(group)
      type(group_t), intent(in) :: group   !! the quantity

      is_orientation = group%item_group == group_bodies .and. group%channel%name == "orientation"
   end function is_orientation

   !> Numbers that are kept of one item of a quantity.
   pure integer function numbers_of(group) result(n)
      type(group_t), intent(in) :: group   !! the quantity

      n = merge(n_place, group%channel%components, is_orientation(group))
   end function numbers_of

   !> Sort of a channel of a group, 0 if it is not kept.
   pure integer function sort_of(item_group, name) result(sort)
      integer, intent(in) :: item_group         !! of the catalogue
      character(*), intent(in) :: name    !! of the channel

      sort = 0
      select case (item_group)
      case (group_bodies)
         if (name == "position" .or. name == "angle" .or. name == "orientation") sort = sort_positions
         if (name == "velocity" .or. name == "angular_velocity") sort = sort_velocities
      case (group_joints, group_drivers, group_clearances)
         if (name == "force" .or. name == "moment" .or. name == "tension") sort = sort_reactions
      end select
   end function sort_of

   !> Keep an output instant.
   subroutine keep_sample(self, t, catalogue, error)
      class(kept_run_t), intent(inout) :: self           !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! never set

      real(wp), allocatable :: more(:, :)
      integer :: k

      if (.not. self%is_kept) return
      if (self%n == size(self%t)) then
         self%t = [self%t, self%t]
         allocate (more(size(self%values, 1), 2*self%n), source=0.0_wp)
         more(:, :self%n) = self%values
         call move_alloc(more, self%values)
      end if
      self%n = self%n + 1
      self%t(self%n) = t
      do k = 1, size(self%sort)
         associate (group => catalogue%groups(self%group(k)), at => self%at(:, k))
            if (.not. is_orientation(group)) then
               self%values(k, self%n) = self%factor(k)*catalogue%values(catalogue%place(self%group(k), at(1), at(2)))
            else if (at(1) == 1) then
               self%values(k:k + n_place - 1, self%n) = self%factor(k)* &
                                              reshape(rotation_of_parameters(catalogue%value(self%group(k), at(2))), [n_place])
            end if
         end associate
      end do
   end subroutine keep_sample

   !> Keep a contact.
   subroutine keep_contact(self, event, error)
      class(kept_run_t), intent(inout) :: self           !! the recorder
      type(event_t), intent(in) :: event                 !! what happened
      type(error_t), allocatable, intent(out) :: error   !! never set

      type(contact_t) :: contact
      integer :: k

      if (.not. self%is_kept .or. event%kind /= "contact") return
      associate (item_group => self%names%item_groups(group_contacts))
         do k = 1, item_group%n
            if (item_group%names(k)%s == event%item .and. item_group%labels(k)%s == event%contact) exit
         end do
      end associate
      contact = contact_t(k, event%time, event%impact_speed, event%peak_force, event%release_speed)
      if (.not. ieee_is_finite(event%duration)) contact%release_speed = not_a_number()
      self%contacts = [self%contacts, contact]
   end subroutine keep_contact

   !> Reported how far the run is: nothing to do.
   subroutine no_progress(self, fraction)
      class(kept_run_t), intent(inout) :: self  !! the recorder
      real(wp), intent(in) :: fraction          !! of the work done, 0 to 1 [1]
   end subroutine no_progress

   !> The run has ended: nothing more is needed than what is kept.
   subroutine finish_keeping(self, summary, error)
      class(kept_run_t), intent(inout) :: self           !! the recorder
      type(summary_t), intent(in) :: summary             !! cost and errors of the run
      type(error_t), allocatable, intent(out) :: error   !! never set

      if (allocated(self%names)) deallocate (self%names)
      self%end = summary%time_end
      if (.not. self%is_kept) return
      self%t = self%t(:self%n)
      self%values = self%values(:, :self%n)
   end subroutine finish_keeping

end module kept_run
