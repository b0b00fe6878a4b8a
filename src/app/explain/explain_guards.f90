!> `gudgeon explain`: the guards of a run, with the limits that they come to in this scene.
module explain_guards
   use catalogue, only: catalogue_t
   use console, only: say
   use guards, only: guard_clearance, guard_penetration, guard_strength, guards_t, new_guards
   use kinds, only: wp
   use load, only: loaded_t
   use mechanism_catalogue, only: build_catalogue
   use mechanism, only: mechanism_t
   use run_audit, only: limits_t
   use run_limits, only: limits_of
   use scene, only: analysis_dynamic, scene_t
   use text, only: real_text, text_t
   implicit none (type, external)
   private
   public :: say_guards

contains

   !> Say what ends a motion early, and what it is reported of.
   subroutine say_guards(loaded)
      type(loaded_t), intent(in) :: loaded   !! the deck

      type(catalogue_t) :: catalogue
      type(limits_t) :: limits
      type(text_t), allocatable :: warnings(:)
      integer :: k

      if (loaded%scene%analysis /= analysis_dynamic) return
      allocate (warnings(0))
      call build_catalogue(loaded%system, catalogue)
      call limits_of(loaded%scene, catalogue, limits, warnings)
      call new_guards(loaded%scene, loaded%system, limits%guards)
      call say("")
      call say("guards")
      associate (guards => limits%guards)
         call say_contacts(loaded%scene, loaded%system, guards)
         if (loaded%system%ledger%is_kept .and. guards%energy > 0.0_wp) then
            call say("stops if the energy error exceeds "// &
                     real_text(100.0_wp*guards%energy, 3)//" % of the maximum energy (energy)", 2)
         end if
         if (guards%speed < huge(1.0_wp)) call say("stops if a body exceeds "//real_text(guards%speed, 3)// &
                                                   " m/s (speed)", 2)
         if (guards%max_displacement < huge(1.0_wp)) &
            call say("warns if a body moves more than "//real_text(guards%max_displacement, 3)//" m from its initial position, "// &
                     real_text(guards%max_displacement/guards%size, 3)//" times the size of the model (travel)", 2)
      end associate
      do k = 1, limits%stop%n
         call say("stops as requested when "//limits%stop%list(k)%words, 2)
      end do
      do k = 1, size(warnings)
         call say(warnings(k)%s, 2)
      end do
   end subroutine say_guards

   !> The guards of the contacts, joint by joint.
   subroutine say_contacts(scene, system, guards)
      type(scene_t), intent(in) :: scene              !! the scene
      type(mechanism_t), intent(in) :: system     !! the system that will run
      type(guards_t), intent(in) :: guards            !! the guards

      integer :: i, k, m
      logical :: has_contacts, is_film_alone

      has_contacts = .false.
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            is_film_alone = .false.
            if (allocated(set%laws%films)) is_film_alone = set%laws%films%is_alone
            if (is_film_alone) cycle
            has_contacts = .true.
            do i = 1, set%n
               m = set%before%contacts + (i - 1)*set%n_contact_item + 1
               associate (limit => guards%limit(:, m), name => set%names(i)%s)
                  if (limit(guard_penetration) < huge(1.0_wp)) then
                     call say(name//": stops at a penetration of "//real_text(1.0e3_wp*limit(guard_penetration), 3)//" mm, "// &
                              real_text(guards%penetration, 3)//" times the smaller radius or the slider length (penetration)", 2)
                  end if
                  if (limit(guard_clearance) < huge(1.0_wp)) then
                     call say(name//": "//verb_of(scene, "clearance")//" at a penetration of "// &
                              real_text(1.0e3_wp*limit(guard_clearance), 3)//" mm, equal to the clearance (clearance)", 2)
                  end if
                  if (limit(guard_strength) < huge(1.0_wp)) then
                     call say(name//": "//verb_of(scene, "strength")//" at a normal force of "// &
                              real_text(limit(guard_strength), 3)//" N, the strength limit of the material (strength)", 2)
                  end if
               end associate
            end do
         end associate
      end do
      if (.not. has_contacts) return
      call say(verb_of(scene, "law_range")//" if a penetration leaves the valid range of its law (law_range)", 2)
      call say(verb_of(scene, "impact_speed")// &
               " if elastic waves take more than 10 % of the impact energy (impact_speed)", 2)
   end subroutine say_contacts

   !> What a guard does.
   function verb_of(scene, key) result(verb)
      type(scene_t), intent(in) :: scene    !! the scene
      character(*), intent(in) :: key       !! key of [guards]
      character(:), allocatable :: verb     !! warns, stops, or says nothing

      select case (scene%settings%guards%word(key))
      case ("stop"); verb = "stops"
      case ("warn"); verb = "warns"
      case default; verb = "no warning"
      end select
   end function verb_of

end module explain_guards
