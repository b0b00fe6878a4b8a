!> What no mechanism does: a run that gets there warns, or ends. Looked at on the ends of steps.
!>
!> of a contact: a penetration beyond the clearance, the range of its law or a part of the surfaces' size; an impact too
!> fast for a quasi-static law; a force at which the pressure is beyond the strength of the material;
!> of a film: how thin it becomes (`film_monitor`);
!> of a body: its speed, its distance from the start in sizes of the scene; of the ledger: energy made of nothing.
!>
!> Sources: of the limits of laws see `surfaces` and `normal_law`, of the pressure `contact_pressure`. Limits: peaks are those of
!> the contacts' memory, so that they are as right as its; speeds and ways are those at the ends of steps.
module guards
   use clearance_set, only: clearance_set_t
   use contact_memory, only: contact_memory_t
   use contact_pressure, only: force_at_pressure
   use film_monitor, only: film_monitor_t
   use kinds, only: eps, wp
   use normal_law, only: parameter_deepest
   use mechanism, only: mechanism_t
   use scene, only: scene_t
   use scene_size, only: extent_of_scene
   use surfaces, only: shape_plane
   use archive, only: archive_t
   use text, only: real_text, text_t
   implicit none (type, external)
   private
   public :: guards_t, guard_clearance, guard_impact_speed, guard_law_range, guard_penetration, guard_strength, joint_words, &
      n_contact_guard, new_guards

   integer, parameter :: guard_penetration = 1   !! a penetration, part of the size of the surfaces (radius; slider: length)
   integer, parameter :: guard_clearance = 2     !! a penetration, the clearance
   integer, parameter :: guard_law_range = 3     !! a penetration, the range of the law
   integer, parameter :: guard_impact_speed = 4  !! an impact speed
   integer, parameter :: guard_strength = 5      !! a normal force
   integer, parameter :: n_contact_guard = 5     !! guards of a contact

   character(*), parameter :: words_of(2:n_contact_guard) = [character(12) :: "clearance", "law_range", "impact_speed", "strength"]
      !! keys of [guards]

   real(wp), parameter :: noise = 1.0e6_wp       !! round-off of the ledger, in spacings of what it adds up [1]
   integer, parameter :: most_wrong = 100        !! steps in a row after which a ledger is wrong for good

   !> Where a limit was passed.
   type :: breach_t
      logical :: is_there = .false.              !! it was passed
      real(wp) :: first = 0.0_wp                 !! when it was passed first [s]
      real(wp) :: value = 0.0_wp                 !! the maximum value [any]
      real(wp) :: time = 0.0_wp                  !! when that was reached [s]
   end type breach_t

   !> The guards of a run. Without `new_guards` there are none.
   type :: guards_t
      logical :: is_set = .false.                !! there are guards
      logical :: stops(n_contact_guard) = .false.       !! (guards of a contact) whether the run ends there
      real(wp), allocatable :: limit(:, :)       !! (guards of a contact, contacts) limits; huge: none [m, m/s or N]
      type(breach_t), allocatable :: breach(:, :)       !! (guards of a contact, contacts) where they were passed
      real(wp) :: penetration = 0.0_wp           !! maximum penetration over the size of the surfaces, 0: no limit [1]
      real(wp) :: energy = 0.0_wp                !! maximum residual over the largest energy, 0: no limit [1]
      integer :: n_wrong = 0                     !! steps in a row with a greater one
      real(wp) :: speed = huge(1.0_wp)           !! maximum speed of a body [m/s]
      real(wp) :: max_displacement = huge(1.0_wp)  !! distance from the start, beyond it a warning [m]
      real(wp) :: size = 0.0_wp                  !! of the scene [m]
      real(wp), allocatable :: start(:, :)       !! (2, bodies) centres at the start [m]
      type(breach_t), allocatable :: travel(:)   !! (bodies) greater distances from the start
      type(film_monitor_t) :: films                !! how thin films become
      character(:), allocatable :: reason        !! why the run must end; unallocated: it need not
   contains
      procedure :: share => guards_share
      procedure :: gather => guards_gather
      procedure :: begin => guards_begin
      procedure :: look => guards_look
      procedure :: look_at_energy => guards_look_at_energy
      procedure :: look_at_made => guards_look_at_made
      procedure :: warn => guards_warn
      procedure :: save => guards_save
      procedure :: load => guards_load
   end type guards_t

   interface

      !> Append a warning for each joint whose contacts passed a limit without ending the run, one for each limit, and one for the
      !> body that went farthest.
      module subroutine guards_warn(self, system, warnings)
         implicit none (type, external)
         class(guards_t), intent(in) :: self                        !! the guards
         type(mechanism_t), intent(in) :: system                !! the system
         type(text_t), allocatable, intent(inout) :: warnings(:)    !! (any) appended to
      end subroutine guards_warn

      !> A contact as text.
      module function joint_words(set, c) result(words)
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: set       !! set of the contact
         integer, intent(in) :: c                        !! contact of the set
         character(:), allocatable :: words              !! joint, contact and law
      end function joint_words

      !> Write what was seen.
      module subroutine guards_save(self, archive)
         implicit none (type, external)
         class(guards_t), intent(in) :: self     !! the guards of a run that need not end
         type(archive_t), intent(inout) :: archive     !! receives it
      end subroutine guards_save

      !> Take it back.
      module subroutine guards_load(self, archive)
         implicit none (type, external)
         class(guards_t), intent(inout) :: self  !! the guards, started
         type(archive_t), intent(inout) :: archive     !! holds it
      end subroutine guards_load

      !> What was passed, as text.
      module function breach_words(self, g, m) result(words)
         implicit none (type, external)
         class(guards_t), intent(in) :: self     !! the guards
         integer, intent(in) :: g                !! guard
         integer, intent(in) :: m                !! contact
         character(:), allocatable :: words      !! value, limit and times
      end function breach_words

   end interface

contains

   !> Guards as the deck sets them.
   subroutine new_guards(scene, system, guards)
      type(scene_t), intent(in) :: scene              !! the scene
      type(mechanism_t), intent(in) :: system     !! the system that will run
      type(guards_t), intent(out) :: guards           !! the guards

      character(:), allocatable :: word
      real(wp) :: travel
      integer :: g, k

      guards%is_set = .true.
      associate (settings => scene%settings%guards)
         guards%penetration = settings%number("penetration")
         guards%energy = settings%number("energy")
         if (settings%number("speed") > 0.0_wp) guards%speed = settings%number("speed")
         guards%size = extent_of_scene(scene)
         travel = settings%number("travel")
         if (travel*guards%size > 0.0_wp) guards%max_displacement = travel*guards%size
         allocate (guards%limit(n_contact_guard, system%clearance_joints%n_contact), source=huge(1.0_wp))
         do k = 1, system%clearance_joints%n_set
            call set_limits(system%clearance_joints%sets(k)%set, guards)
         end do
         guards%stops(guard_penetration) = .true.
         do g = 2, n_contact_guard
            word = settings%word(trim(words_of(g)))
            guards%stops(g) = word == "stop"
            if (word == "off") guards%limit(g, :) = huge(1.0_wp)
         end do
      end associate
   end subroutine new_guards

   !> Limits of the contacts of a set.
   subroutine set_limits(set, guards)
      class(clearance_set_t), intent(in) :: set   !! the set
      type(guards_t), intent(inout) :: guards     !! limits are set

      integer :: c, item, m
      logical :: has_clearance
      real(wp) :: radius

      do c = 1, set%n_contact
         m = set%before%contacts + c
         item = set%item_of(c)
         associate (pair => set%items%pairs(item), limit => guards%limit(:, m))
            radius = pair%radius_j
            if (pair%radius_i > 0.0_wp) radius = min(radius, pair%radius_i)
            if (pair%shape == shape_plane) radius = max(radius, pair%length)
            if (guards%penetration*radius > 0.0_wp) limit(guard_penetration) = guards%penetration*radius
            has_clearance = set%traits%is_round .or. (set%traits%is_gap .and. set%items%pairs(item)%clearance > 0.0_wp)
            if (has_clearance) limit(guard_clearance) = set%items%pairs(item)%clearance
            limit(guard_law_range) = set%laws%parameters(parameter_deepest, c)
            limit(guard_impact_speed) = pair%speed_limit
            limit(guard_strength) = force_at_pressure(pair, pair%strength)
         end associate
      end do
   end subroutine set_limits

   !> The guards of a part of the mechanism: those of its contacts, measured by the whole.
   subroutine guards_share(self, contacts, part)
      class(guards_t), intent(in) :: self    !! guards of the whole
      integer, intent(in) :: contacts(:)     !! (contacts of the part) their numbers in the whole
      type(guards_t), intent(out) :: part    !! guards of the part

      part%is_set = self%is_set
      part%stops = self%stops
      if (allocated(self%limit)) part%limit = self%limit(:, contacts)
      part%penetration = self%penetration
      part%energy = self%energy
      part%speed = self%speed
      part%max_displacement = self%max_displacement
      part%size = self%size
   end subroutine guards_share

   !> What the guards of a part have seen.
   subroutine guards_gather(self, part, bodies, contacts)
      class(guards_t), intent(inout) :: self   !! guards of the whole, started
      type(guards_t), intent(in) :: part       !! guards of the part
      integer, intent(in) :: bodies(:)         !! (bodies of the part) their numbers in the whole
      integer, intent(in) :: contacts(:)       !! (contacts of the part) their numbers in the whole

      call self%films%gather(part%films, contacts)
      if (.not. allocated(part%breach) .or. .not. allocated(self%breach)) return
      self%breach(:, contacts) = part%breach
      self%travel(bodies) = part%travel
   end subroutine guards_gather

   !> Before the first step.
   subroutine guards_begin(self, system)
      class(guards_t), intent(inout) :: self         !! the guards
      type(mechanism_t), intent(in) :: system    !! the system, its motion that of the start

      call self%films%begin(system)
      if (.not. self%is_set) return
      allocate (self%breach(n_contact_guard, system%clearance_joints%n_contact), self%travel(system%linkage%bodies%n))
      self%start = system%linkage%motion%r(1:2, 1:system%linkage%bodies%n)
   end subroutine guards_begin

   !> After a step: contacts and bodies.
   subroutine guards_look(self, system, t)
      class(guards_t), intent(inout) :: self         !! the guards
      type(mechanism_t), intent(in) :: system    !! the system, its motion that at the end of the step
      real(wp), intent(in) :: t                      !! time there [s]

      real(wp) :: distance
      integer :: k

      if (.not. self%is_set) return
      if (system%clearance_joints%has_films) call self%films%look(system, t)
      do k = 1, system%clearance_joints%n_set
         associate (set => system%clearance_joints%sets(k)%set)
            if (set%n_touching == 0) cycle
            associate (first => set%before%contacts + 1)
               if (are_within(set%n_contact, set%contact, self%limit(1, first), self%breach(1, first))) cycle
            end associate
            call note(self, set, t)
         end associate
      end do
      associate (motion => system%linkage%motion)
         if (are_near(system%linkage%bodies%n, motion%r, motion%v, self%start, self%max_displacement**2, self%speed**2)) return
         do k = 1, system%linkage%bodies%n
            if (motion%v(1, k)**2 + motion%v(2, k)**2 > self%speed**2) then
               call end_run(self, "body '"//system%linkage%bodies%names(k)%s//"' has a speed of "//real_text(hypot(motion%v(1, k), &
                            motion%v(2, k)), 3)//" m/s, above the guard 'speed': "//real_text(self%speed, 3)//" m/s")
            end if
            distance = (motion%r(1, k) - self%start(1, k))**2 + (motion%r(2, k) - self%start(2, k))**2
            if (distance > self%max_displacement**2) call raise(self%travel(k), sqrt(distance), t)
         end do
      end associate
   end subroutine guards_look

   !> Whether all contacts of a set that touch are within their limits, or beyond one by no more than they were before: of what was
   !> passed by more before no more is reported.
   pure logical function are_within(n, contact, limit, breach)
      integer, intent(in) :: n                                  !! number of contacts
      type(contact_memory_t), intent(in) :: contact(n)          !! (n) the contacts
      real(wp), intent(in) :: limit(n_contact_guard, n)         !! (guards of a contact, n) their limits [m, m/s or N]
      type(breach_t), intent(in) :: breach(n_contact_guard, n)  !! (guards of a contact, n) where these were passed

      real(wp) :: values(n_contact_guard)
      integer :: c, g

      are_within = .false.
      do c = 1, n
         if (.not. contact(c)%is_touching) cycle
         values = guarded(contact(c))
         do g = 1, n_contact_guard
            if (values(g) > limit(g, c) .and. values(g) > breach(g, c)%value) return
         end do
      end do
      are_within = .true.
   end function are_within

   !> What of a contact is guarded.
   pure function guarded(contact) result(values)
      type(contact_memory_t), intent(in) :: contact   !! the contact
      real(wp) :: values(n_contact_guard)             !! (guards of a contact) the values [m, m/s or N]

      values(guard_penetration) = contact%peak_penetration
      values(guard_clearance) = contact%peak_penetration
      values(guard_law_range) = contact%peak_penetration
      values(guard_impact_speed) = contact%impact_speed
      values(guard_strength) = contact%peak_force
   end function guarded

   !> Whether all bodies are near their starts, and none is too fast.
   pure logical function are_near(n, r, v, start, distance_2, speed_2)
      integer, intent(in) :: n               !! number of bodies
      real(wp), intent(in) :: r(3, 0:n)      !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: v(3, 0:n)      !! (3, 0:bodies) their velocities [m/s]
      real(wp), intent(in) :: start(2, n)    !! (2, bodies) centres at the start [m]
      real(wp), intent(in) :: distance_2          !! square of the maximum distance [m^2]
      real(wp), intent(in) :: speed_2        !! square of the maximum speed [m^2/s^2]

      integer :: k

      are_near = .false.
      do k = 1, n
         if (v(1, k)**2 + v(2, k)**2 > speed_2) return
         if ((r(1, k) - start(1, k))**2 + (r(2, k) - start(2, k))**2 > distance_2) return
      end do
      are_near = .true.
   end function are_near

   !> The ledger after a step: energy made of nothing, more than the part that the guard allows of the largest energy, and more
   !> than the round-off of what it adds up, for many steps in a row: where a motion starts with next to no energy, the first
   !> ones may have it wrong.
   subroutine guards_look_at_energy(self, residual, largest, added)
      class(guards_t), intent(inout) :: self      !! the guards
      real(wp), intent(in) :: residual            !! of the ledger [J]
      real(wp), intent(in) :: largest             !! largest energy so far [J]
      real(wp), intent(in) :: added               !! magnitude of what the ledger adds up [J]

      if (.not. self%energy > 0.0_wp) return
      self%n_wrong = self%n_wrong + 1
      if (abs(residual) <= self%energy*largest .or. abs(residual) <= noise*eps*added) self%n_wrong = 0
      if (self%n_wrong < most_wrong) return
      call end_run(self, "the motion is not physical: an energy error of "//real_text(residual, 3)//" J, which is "// &
                   real_text(abs(residual)/largest, 3)//" of the maximum energy (guard 'energy')")
   end subroutine guards_look_at_energy

   !> What a contact made of nothing that started where its surfaces overlapped. It is booked as its loss, so that no residual has
   !> it.
   subroutine guards_look_at_made(self, made, largest)
      class(guards_t), intent(inout) :: self      !! the guards
      real(wp), intent(in) :: made                !! by the contact that started just now [J]
      real(wp), intent(in) :: largest             !! largest energy before [J]

      if (.not. self%energy > 0.0_wp .or. made <= self%energy*(largest + made)) return
      call end_run(self, "the motion is not physical: a contact with initial overlap created "// &
                   real_text(made, 3)//" J, which is "//real_text(made/(largest + made), 3)// &
                   " of the maximum energy (guard 'energy')")
   end subroutine guards_look_at_made

   !> The first reason stands.
   subroutine end_run(self, reason)
      class(guards_t), intent(inout) :: self      !! the guards
      character(*), intent(in) :: reason          !! why the run must end

      if (.not. allocated(self%reason)) self%reason = reason
   end subroutine end_run

   !> Raise a breach.
   pure subroutine raise(breach, value, t)
      type(breach_t), intent(inout) :: breach   !! the breach
      real(wp), intent(in) :: value             !! value beyond the limit [any]
      real(wp), intent(in) :: t                 !! time [s]

      if (.not. breach%is_there) breach%first = t
      if (.not. breach%is_there .or. value > breach%value) then
         breach%value = value
         breach%time = t
      end if
      breach%is_there = .true.
   end subroutine raise

   !> Note what the contacts of a set have passed, and whether the run ends with it.
   subroutine note(self, set, t)
      class(guards_t), intent(inout) :: self          !! the guards
      class(clearance_set_t), intent(in) :: set       !! the set
      real(wp), intent(in) :: t                       !! time [s]

      real(wp) :: values(n_contact_guard)
      integer :: c, g, m

      do c = 1, set%n_contact
         if (.not. set%contact(c)%is_touching) cycle
         m = set%before%contacts + c
         values = guarded(set%contact(c))
         do g = 1, n_contact_guard
            if (.not. (values(g) > self%limit(g, m) .and. values(g) > self%breach(g, m)%value)) cycle
            call raise(self%breach(g, m), values(g), t)
            if (self%stops(g)) call end_run(self, joint_words(set, c)//": "//breach_words(self, g, m))
         end do
      end do
   end subroutine note

end module guards
