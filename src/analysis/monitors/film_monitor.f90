!> How thin the films of a run become, against what is safe: looked at on the ends of steps.
!>
!> h_min = c - e, eq. (5.33). Limits: 2.5 um (machined surfaces); 1.5e-4 of the journal's diameter; twenty times the roughness,
!> where it is given.
!>
!> Sources: Flores et al. (2008), section 5.8, with B. J. Hamrock, Fundamentals of Fluid Film Lubrication (1994), for 2.5 um, and
!> R. M. Phelan, Fundamentals of Mechanical Design (1970), for that of the diameter. Limits: of steps, so that a minimum film
!> between two ends is reported a little too thick.
module film_monitor
   use clearance_set, only: clearance_set_t
   use film_law, only: film_motion_t, parameter_radius
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use motion, only: motion_t
   use archive, only: archive_t
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: film_monitor_t

   integer, parameter :: limit_machined = 1    !! minimum film of machined surfaces
   integer, parameter :: limit_diameter = 2    !! one that grows with the journal
   integer, parameter :: limit_roughness = 3   !! one that grows with the roughness
   integer, parameter :: n_limit = 3           !! limits of a film

   real(wp), parameter :: machined = 2.5e-6_wp     !! minimum film of machined surfaces [m]
   real(wp), parameter :: of_diameter = 1.5e-4_wp  !! minimum film over the journal's diameter [1]
   real(wp), parameter :: of_roughness = 20.0_wp   !! minimum film over the roughness [1]

   real(wp), parameter :: most_tilt = 0.3_wp        !! tilt up to which films of aligned journals hold, of the gap in the middle [1]
   real(wp), parameter :: min_engaged = 0.99_wp   !! part of the length that is all of it [1]

   real(wp), parameter :: stiff_from = 0.1_wp    !! step over the time of a decay, from which on the decay decides the step [1]
   real(wp), parameter :: stiff_to = 20.0_wp    !! beyond what explicit methods can bear: the step was not one of theirs [1]

   !> How a pin in a bushing has lain where the film does not hold: of each the worst, and when.
   type :: lean_t
      real(wp) :: tilt = 0.0_wp            !! what the tilt adds to the eccentricity at an end, of the gap left in the middle [1]
      real(wp) :: tilt_time = 0.0_wp       !! when that was [s]
      real(wp) :: engaged = 1.0_wp         !! part of the film's length that the pin is in [1]
      real(wp) :: engaged_time = 0.0_wp    !! when that was [s]
   end type lean_t

   !> The film of a joint.
   type :: thin_film_t
      logical :: is_watched = .false.                  !! it has a film that acts
      logical :: is_below(n_limit) = .false.           !! (limits) it was thinner
      real(wp) :: first(n_limit) = 0.0_wp              !! (limits) when it was so first [s]
      real(wp) :: film_at_end = 0.0_wp                 !! thickness where a film that is alone ends; 0 of others [m]
      real(wp) :: limit(n_limit) = 0.0_wp              !! (limits) the limits, 0: none [m]
      real(wp) :: minimum = huge(1.0_wp)                 !! minimum thickness [m]
      real(wp) :: time = 0.0_wp                        !! when that was [s]
      real(wp) :: step = 0.0_wp                        !! step that ended then, or the one before: the longer of both [s]
      type(film_motion_t) :: motion                    !! motion of the bearing then
      type(lean_t) :: lean                             !! how its pin has lain
   end type thin_film_t

   !> The films of all clearance joints.
   type :: film_monitor_t
      type(thin_film_t), allocatable :: joint(:)   !! (contacts) films, at first contacts of joints; unallocated: there is none
      real(wp), allocatable :: delta(:), rate(:)   !! (contacts) penetrations [m] and their rates [m/s]
      real(wp) :: t = 0.0_wp                       !! end of the last step [s]
      real(wp) :: step = 0.0_wp                    !! length of that step, which an event or the end of the run may have cut [s]
   contains
      procedure :: begin => monitor_begin
      procedure :: look => monitor_look
      procedure :: gather => monitor_gather
      procedure :: warn => monitor_warn
      procedure :: save => monitor_save
      procedure :: load => monitor_load
      procedure :: warn_of_stiffness => monitor_warn_of_stiffness
   end type film_monitor_t

contains

   !> Before the first step.
   subroutine monitor_begin(self, system)
      class(film_monitor_t), intent(out) :: self   !! the monitor
      type(mechanism_t), intent(in) :: system    !! the system

      integer :: first, i, k

      if (.not. system%clearance_joints%has_films) return
      allocate (self%joint(system%clearance_joints%n_contact), self%delta(system%clearance_joints%n_contact), &
                self%rate(system%clearance_joints%n_contact))
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (.not. allocated(set%laws%films)) cycle
            do i = 1, set%n
               first = place_of(set, i)
               associate (joint => self%joint(first), films => set%laws%films)
                  joint%is_watched = films%acts
                  if (films%is_alone) joint%film_at_end = set%items%pairs(i)%clearance*(1.0_wp - films%eps_max(i))
                  joint%limit(limit_machined) = machined
                  joint%limit(limit_diameter) = of_diameter*2.0_wp*films%parameters(parameter_radius, i)
                  joint%limit(limit_roughness) = of_roughness*films%roughness(i)
               end associate
            end do
         end associate
      end do
   end subroutine monitor_begin

   !> After a step.
   subroutine monitor_look(self, system, t)
      class(film_monitor_t), intent(inout) :: self   !! the monitor
      type(mechanism_t), intent(in) :: system      !! the system, its motion that at the end of the step
      real(wp), intent(in) :: t                    !! time there [s]

      real(wp) :: thickness
      integer :: first, i, k, limit

      if (.not. allocated(self%joint)) return
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (.not. allocated(set%laws%films)) cycle
            call set%gaps(system%linkage%motion, self%delta, self%rate)
            do i = 1, set%n
               first = place_of(set, i)
               associate (joint => self%joint(first))
                 if (set%laws%films%may_tilt .and. joint%is_watched) call look_at_tilt(set, i, system%linkage%motion, t, joint%lean)
                  thickness = joint%film_at_end - maxval(self%delta(first:first + set%n_contact_item - 1))
                  if (.not. joint%is_watched .or. thickness >= joint%minimum) cycle
                  joint%minimum = thickness
                  joint%time = t
                  joint%step = max(t - self%t, self%step)
                  joint%motion = set%laws%films%motion_of(i, set%items%body(:, i), set%items%s_i(:, i), set%items%s_j(:, i), &
                                                          system%linkage%motion)
                  do limit = 1, n_limit
                     if (joint%is_below(limit) .or. thickness >= joint%limit(limit)) cycle
                     joint%is_below(limit) = .true.
                     joint%first(limit) = t
                  end do
               end associate
            end do
         end associate
      end do
      self%step = t - self%t
      self%t = t
   end subroutine monitor_look

   !> Where the film of a joint stands: at its first contact.
   pure integer function place_of(set, item) result(place)
      class(clearance_set_t), intent(in) :: set  !! its set
      integer, intent(in) :: item                !! item of the set

      place = set%before%contacts + (item - 1)*set%n_contact_item + 1
   end function place_of

   !> Note how the pin of a joint lies.
   subroutine look_at_tilt(set, item, motion, t, lean)
      class(clearance_set_t), intent(in) :: set  !! its set
      integer, intent(in) :: item                !! item of the set
      type(motion_t), intent(in) :: motion       !! of the bodies
      real(wp), intent(in) :: t                  !! time [s]
      type(lean_t), intent(inout) :: lean        !! what was seen so far

      type(film_motion_t) :: film
      real(wp) :: tilt

      film = set%laws%films%motion_of(item, set%items%body(:, item), set%items%s_i(:, item), set%items%s_j(:, item), motion)
      tilt = norm2(film%tilt)/max(set%items%pairs(item)%clearance - norm2(film%e), tiny(1.0_wp))
      if (tilt > lean%tilt) then
         lean%tilt = tilt
         lean%tilt_time = t
      end if
      if (film%engaged < lean%engaged) then
         lean%engaged = film%engaged
         lean%engaged_time = t
      end if
   end subroutine look_at_tilt

   !> Append a warning where a pin lay so that its film does not hold.
   subroutine warn_of_lean(joint, film, lean, warnings)
      character(*), intent(in) :: joint, film                    !! names of the joint and of its film
      type(lean_t), intent(in) :: lean                           !! how the pin has lain
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (any) appended to

      if (lean%tilt > most_tilt) then
         call append_text(warnings, "joint '"//joint//"', film '"//film//"': the tilt changes the film thickness at an end by "// &
            ""//real_text(lean%tilt, 2)// &
                          " of that in the middle, at t = "//real_text(lean%tilt_time, 6)// &
                          " s; the model is valid up to "//real_text(most_tilt, 1)//"; film.grid has no such limit")
      end if
      if (lean%engaged < min_engaged) then
         call append_text(warnings, "joint '"//joint//"': the pin covers only "//real_text(lean%engaged, 3)// &
                          " of the film length, at t = "//real_text(lean%engaged_time, 6)//" s; the film force is "// &
                             "reduced in proportion")
      end if
   end subroutine warn_of_lean

   !> What the monitor of a part of the mechanism has seen.
   subroutine monitor_gather(self, part, contacts)
      class(film_monitor_t), intent(inout) :: self   !! monitor of the whole, started
      type(film_monitor_t), intent(in) :: part       !! monitor of the part
      integer, intent(in) :: contacts(:)           !! (contacts of the part) their numbers in the whole

      if (allocated(part%joint) .and. allocated(self%joint)) self%joint(contacts) = part%joint
   end subroutine monitor_gather

   !> Append a warning for each joint whose film was thinner than what is safe.
   subroutine monitor_warn(self, system, warnings)
      class(film_monitor_t), intent(in) :: self                    !! the monitor
      type(mechanism_t), intent(in) :: system                    !! the system
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (any) appended to

      character(:), allocatable :: words
      integer :: first, i, k, limit

      if (.not. allocated(self%joint)) return
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (.not. allocated(set%laws%films)) cycle
            do i = 1, set%n
               first = place_of(set, i)
               associate (joint => self%joint(first))
                  call warn_of_lean(set%names(i)%s, set%laws%films%law%name, joint%lean, warnings)
                  if (set%laws%films%place(i)%is_heated) call append_text(warnings, "joint '"//set%names(i)%s// &
                     "': heat = balance needs a static analysis; this run uses the temperature of the lubricant")
                  if (.not. any(joint%is_below)) cycle
                  words = "joint '"//set%names(i)%s//"', film '"//set%laws%films%law%name//"': minimum thickness "// &
                          micrometres(max(joint%minimum, 0.0_wp))//" at t = "//real_text(joint%time, 6)//" s"
                  do limit = 1, n_limit
                     if (joint%is_below(limit)) words = words//"; below "//limit_words(limit, joint%limit(limit))// &
                                                        " first at "//real_text(joint%first(limit), 6)//" s"
                  end do
                  call append_text(warnings, words)
               end associate
            end do
         end associate
      end do
   end subroutine monitor_warn

   !> Append a warning for each joint whose film, not the motion, made the steps of an explicit method as short as they were where
   !> it was thinnest: no longer than some multiple of the time in which it brings the journal to rest.
   subroutine monitor_warn_of_stiffness(self, system, method, warnings)
      class(film_monitor_t), intent(in) :: self                    !! the monitor
      type(mechanism_t), intent(in) :: system                    !! the system
      character(*), intent(in) :: method                         !! name of the explicit method
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (any) appended to

      real(wp) :: decay
      integer :: first, i, k

      if (.not. allocated(self%joint)) return
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (.not. allocated(set%laws%films)) cycle
            do i = 1, set%n
               first = place_of(set, i)
               associate (joint => self%joint(first), &
                          inverse => system%linkage%inverse_mass(1, set%items%body(1, i)) &
                                     + system%linkage%inverse_mass(1, set%items%body(2, i)))
                  if (.not. joint%is_watched .or. .not. joint%step > 0.0_wp) cycle
                  decay = set%laws%films%decay_of(i, joint%motion, inverse)
                  if (joint%step*decay < stiff_from .or. joint%step*decay > stiff_to) cycle
                  call append_text(warnings, "joint '"//set%names(i)%s//"', film '"//set%laws%films%law%name// &
                                   "' is stiff: at its minimum thickness it stops the journal within "// &
                                   real_text(1.0e6_wp/decay, 2)//" us, and '"//method//"' takes steps of "// &
                                   real_text(1.0e6_wp*joint%step, 2)//" us; method = bdf or radau "// &
                                   "takes longer steps")
               end associate
            end do
         end associate
      end do
   end subroutine monitor_warn_of_stiffness

   !> A limit as text.
   function limit_words(limit, value) result(words)
      integer, intent(in) :: limit         !! which one
      real(wp), intent(in) :: value        !! the limit [m]
      character(:), allocatable :: words   !! with its value

      select case (limit)
      case (limit_machined)
         words = micrometres(value)//" (machined surfaces, Hamrock)"
      case (limit_diameter)
         words = micrometres(value)//" (1.5e-4 of the journal diameter, Phelan)"
      case default
         words = micrometres(value)//" (20 times the roughness)"
      end select
   end function limit_words

   !> A thickness as text.
   function micrometres(length) result(words)
      real(wp), intent(in) :: length        !! [m]
      character(:), allocatable :: words    !! in um

      words = real_text(1.0e6_wp*length, 4)//" um"
   end function micrometres

   !> Write what was seen.
   subroutine monitor_save(self, archive)
      class(film_monitor_t), intent(in) :: self   !! the monitor
      type(archive_t), intent(inout) :: archive       !! receives it

      integer :: k

      if (.not. allocated(self%joint)) return
      call archive%put(self%t)
      call archive%put(self%step)
      do k = 1, size(self%joint)
         call archive%put(transfer(self%joint(k), [0.0_wp]))
      end do
   end subroutine monitor_save

   !> Take it back.
   subroutine monitor_load(self, archive)
      class(film_monitor_t), intent(inout) :: self  !! the monitor, started
      type(archive_t), intent(inout) :: archive         !! holds it

      real(wp) :: numbers(size(transfer(thin_film_t(), [0.0_wp])))
      integer :: k

      if (.not. allocated(self%joint)) return
      call archive%get(self%t)
      call archive%get(self%step)
      do k = 1, size(self%joint)
         call archive%get(numbers)
         self%joint(k) = transfer(numbers, self%joint(k))
      end do
   end subroutine monitor_load

end module film_monitor
