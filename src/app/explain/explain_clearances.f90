!> Clearance joints, for `gudgeon explain`: their laws, and how long a contact lasts beside the steps and the output.
module explain_clearances
   use clearance_set, only: clearance_set_t
   use console, only: say
   use film_law, only: film_motion_t, parameter_length, parameter_radius, parameter_viscosity
   use kind_info, only: kind_info_t
   use elastic_waves, only: bar_speed, most_share, share_of_waves
   use kinds, only: pi, wp
   use load, only: loaded_t
   use mechanism, only: mechanism_t
   use scene, only: analysis_dynamic
   use text, only: real_text, to_text
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: explain_clearance_joints

contains

   !> Clearance joints: laws, stiffness, initial gap, time scale of a contact against the output interval.
   subroutine explain_clearance_joints(loaded, y)
      type(loaded_t), intent(inout) :: loaded         !! the deck
      real(wp), allocatable, intent(in) :: y(:)       !! (n) start; unallocated: none was found [any]

      real(wp), parameter :: speeds(3) = [0.1_wp, 1.0_wp, 10.0_wp]  ! of impacts, as examples [m/s]
      real(wp), allocatable :: delta(:), rate(:)
      character(:), allocatable :: law, words
      real(wp) :: step
      integer :: c, i, k, last, v

      if (loaded%system%clearance_joints%n == 0) return
      step = loaded%scene%settings%integration%controls%fixed_step
      call say("")
      call say("joints with clearance")
      allocate (delta(loaded%system%clearance_joints%n_contact), rate(loaded%system%clearance_joints%n_contact), source=0.0_wp)
      if (allocated(y)) call loaded%system%events(0.0_wp, y, delta, rate)
      do k = 1, size(loaded%system%clearance_joints%sets)
         associate (set => loaded%system%clearance_joints%sets(k)%set)
            law = set%laws%normal%name
            if (allocated(set%laws%friction)) law = law//", friction "//set%laws%friction%name
            if (allocated(set%laws%wear)) law = law//", wear "//set%laws%wear%name
            do i = 1, set%n
               c = (i - 1)*set%n_contact_item + 1
               words = ""
               if (set%traits%is_round) words = "radial clearance "//to_text(1.0e3_wp*set%items%pairs(i)%clearance)//" mm, "
               call say(set%names(i)%s//": "//words//"law "//law//", "//set%laws%normal%description(set%laws%parameters(:, c)), 2)
               call explain_film(set, i, loaded%system%linkage%inverse_mass(1, :))
               last = set%before%contacts + i*set%n_contact_item
               if (allocated(y)) call say("initial clearance "//real_text(-1.0e3_wp*maxval( &
                  delta(last - set%n_contact_item + 1:last)), 6)//" mm", 4)
               call explain_wear(loaded%scene%worn, set%names(i)%s)
               if (loaded%scene%analysis /= analysis_dynamic) cycle
               if (is_film_alone(set)) cycle
               do v = 1, size(speeds)
                  if (.not. contact_time(loaded%system, set, c, speeds(v)) > 0.0_wp) then
                     call say("no impact duration: drivers prescribe both bodies, or the law stores no energy", 4)
                     exit
                  end if
                  call say("duration of an elastic impact at "//to_text(speeds(v))//" m/s: about "// &
                           real_text(1.0e6_wp*contact_time(loaded%system, set, c, speeds(v)), 3)//" us, "// &
                           intervals_text(contact_time(loaded%system, set, c, speeds(v))/loaded%plan%every)// &
                           steps_of(contact_time(loaded%system, set, c, speeds(v)), step), 4)
               end do
               call explain_validity(set%items%pairs(i)%speed_limit)
            end do
         end associate
      end do
   end subroutine explain_clearance_joints

   !> Surfaces of a joint that are worn at the start.
   subroutine explain_wear(worn, joint)
      type(worn_surface_t), intent(in) :: worn(:)   !! (any) of all joints
      character(*), intent(in) :: joint             !! its name

      real(wp) :: angle, depth
      integer :: k

      do k = 1, size(worn)
         if (worn(k)%joint /= joint) cycle
         call worn(k)%max_depth(depth, angle)
         call say(worn(k)%side//" worn at the start: "//real_text(1.0e9_wp*sum(worn(k)%volume), 6)//" mm^3, maximum depth "// &
                  real_text(1.0e3_wp*depth, 6)//" mm at "//real_text(angle*180.0_wp/pi, 4)//" deg, worn over "// &
                  real_text(worn(k)%arc()*180.0_wp/pi, 5)//" deg in "//to_text(size(worn(k)%volume))//" cells", 4)
      end do
   end subroutine explain_wear

   !> A number of output intervals.
   function intervals_text(n) result(words)
      real(wp), intent(in) :: n                  !! the number [1]
      character(:), allocatable :: words         !! with its noun

      words = real_text(n, 2)
      words = words//trim(merge(" output interval ", " output intervals", words == "1"))
   end function intervals_text

   !> Whether a film alone is between the surfaces.
   pure logical function is_film_alone(set)
      class(clearance_set_t), intent(in) :: set     !! the joint's set

      is_film_alone = .false.
      if (allocated(set%laws%films)) is_film_alone = set%laws%films%is_alone
   end function is_film_alone

   !> The film of a joint: its kind, what it is fitted to, and how it acts.
   subroutine explain_film(set, item, inverse_mass)
      class(clearance_set_t), intent(in) :: set     !! the joint's set
      integer, intent(in) :: item                   !! item of the set
      real(wp), intent(in) :: inverse_mass(0:)      !! (0:bodies) one over the mass, 0 for the ground [1/kg]

      real(wp), parameter :: near = 0.9_wp  ! eccentricity over clearance at which a decay is reported [1]
      character(:), allocatable :: words
      real(wp) :: decay
      type(kind_info_t) :: info

      if (.not. allocated(set%laws%films)) return
      associate (films => set%laws%films, p => set%laws%films%parameters(:, item), place => set%laws%films%place(item))
         info = films%law%info()
         if (.not. films%acts) then
            call say("film "//films%law%name//" ("//info%name//"): not active at this level", 4)
            return
         end if
         call say("film "//films%law%name//" ("//info%name//"): "//info%help, 4)
         call say("viscosity "//to_text(p(parameter_viscosity))//" Pa.s, length "//to_text(1.0e3_wp*p(parameter_length))// &
                  " mm, journal radius "//to_text(1.0e3_wp*p(parameter_radius))//" mm, L/D = "// &
                  real_text(0.5_wp*p(parameter_length)/p(parameter_radius), 4), 4)
         if (films%law%description(p) /= "") call say(films%law%description(p), 4)
         words = "entrainment speed: sum of the angular speeds of journal and bearing, each relative to the world"
         if (place%is_relative) words = "entrainment speed: relative speed of journal and bearing, as printed in Flores et al. "// &
            "(2008)"
         if (place%has_torque) words = words//"; shear torques act on the bodies"
         call say(words, 4)
         if (place%is_heated) call say("a static analysis computes the film temperature from a heat balance", 4)
         if (films%is_alone) then
            call say("no contact law: the run stops at an eccentricity of "// &
                     real_text(films%eps_max(item), 8)//" times the clearance", 4)
         else if (place%depth > 0.0_wp) then
            call say("film fades out over e_t0 = "//to_text(1.0e3_wp*place%depth)//" mm beyond the clearance, while the "// &
               "contact "// &
               "fades in", 4)
         else
            call say("film force keeps its form beyond "//real_text(films%eps_max(item), 8)//" times the clearance; the "// &
               "contact force is "// &
               "added", 4)
         end if
         decay = films%decay_of(item, film_motion_t(e=[near*set%items%pairs(item)%clearance, 0.0_wp]), &
                                sum(inverse_mass(set%items%body(:, item))))
         if (decay > 0.0_wp) call say("at an eccentricity of "//real_text(near, 1)//" times the clearance the film brings the "// &
                                      "journal to rest within "//real_text(1.0e6_wp/decay, 2)//" us: explicit methods need "// &
                                      "steps of about this size; implicit methods (radau, bdf, ida) do not", 4)
      end associate
   end subroutine explain_film

   !> A duration in fixed steps, or what variable steps do with it.
   function steps_of(duration, step) result(words)
      real(wp), intent(in) :: duration     !! of an impact [s]
      real(wp), intent(in) :: step         !! length of fixed steps, 0: variable [s]
      character(:), allocatable :: words   !! to follow the duration

      words = "; the integrator starts a contact with a step of 1 % of it"
      if (step > 0.0_wp) words = ", "//real_text(duration/step, 2)//" fixed steps"
   end function steps_of

   !> Duration of an impact.
   real(wp) function contact_time(system, set, contact, speed)
      type(mechanism_t), intent(in) :: system   !! the system
      class(clearance_set_t), intent(in) :: set     !! the joint's set
      integer, intent(in) :: contact                !! contact of the set
      real(wp), intent(in) :: speed                 !! impact speed [m/s]

      contact_time = set%contact_time(contact, speed, system%linkage%inverse_mass(1, :))
   end function contact_time

   !> How much of an impact's energy goes into elastic waves, which a quasi-static law omits.
   subroutine explain_validity(speed_limit)
      real(wp), intent(in) :: speed_limit  !! huge: not known [m/s]

      if (speed_limit >= huge(speed_limit)) return
      call say("the law is quasi-static: it neglects elastic waves, which take "// &
               real_text(100.0_wp*share_of_waves(1.0_wp, bar_speed(speed_limit)), 2)//" % of the energy of an impact at 1 m/s "// &
                  "and "// &
               real_text(100.0_wp*most_share, 2)//" % at "//real_text(speed_limit, 3)//" m/s (Hunter 1957, for balls)", 4)
   end subroutine explain_validity

end module explain_clearances
