!> The size of the model and how it was assembled, for `gudgeon explain`.
module explain_model
   use assembly_report, only: assembly_t
   use branches, only: find_doubts
   use console, only: say
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use load, only: loaded_t
   use mechanism, only: mechanism_t
   use mobility, only: find_mobility, mobility_t
   use plausibility, only: find_notes
   use scene, only: analysis_dynamic, analysis_kinematic, scene_t
   use start_state, only: redundancy_text
   use text, only: counted, real_text, text_t, to_text
   implicit none (type, external)
   private
   public :: explain_notes, explain_size, explain_start

contains

   !> Coordinates, rows and degrees of freedom.
   subroutine explain_size(scene, system, twin)
      type(scene_t), intent(in) :: scene            !! the scene
      type(mechanism_t), intent(in) :: system   !! its system
      type(mechanism_t), intent(in) :: twin     !! with all joints ideal

      character(:), allocatable :: words
      integer :: k

      call say("")
      call say("model")
      associate (linkage => system%linkage, names => system%linkage%bodies%names, n => system%linkage%bodies%n)
         words = trim(merge("spatial", "planar ", scene%settings%is_spatial))
         words = counted(n, words//" body", words//" bodies")//", "//to_text(linkage%coordinates%n_q*n)//" coordinates"
         if (scene%settings%is_spatial) words = words//" (including Euler parameters), "//to_text(size(linkage%mass))//" velocities"
         call say(words, 2)
         do k = 1, linkage%reduced%known%n
            call say("'"//names(linkage%reduced%known%held(k)%body)%s//"': prescribed motion", 2)
         end do
         do k = 1, linkage%reduced%one_dof%n
            call say("'"//names(linkage%reduced%one_dof%held(k)%body)%s//"': reduced to one generalised coordinate, that of '"// &
                     linkage%row_name(linkage%reduced%one_dof%held(k)%row(1))//"'", 2)
         end do
      end associate
      if (system%linkage%rows%n > system%linkage%rows%n_solve) then
         call say(counted(system%n_position, "unknown coordinate", "unknown coordinates")//", "// &
                  counted(system%linkage%rows%n_solve, "constraint row", "constraint rows")//" in the equations that are solved", 2)
      end if
      do k = 1, size(scene%joints)
         call count_kind(scene%joints(k)%info, scene%joints(k)%items)
      end do
      do k = 1, size(scene%forces)
         call count_kind(scene%forces(k)%info, scene%forces(k)%items)
      end do
      call count_kind(scene%tables%states%info, scene%tables%states%items)
      do k = 1, size(scene%tables%functions)
         call count_kind(scene%tables%functions(k)%info, scene%tables%functions(k)%items)
      end do
      if (size(system%linkage%ideal) > 0) then
         call say(counted(system%linkage%ideal(1)%set%n, "joint", "joints")//" with clearance treated as ideal, "// &
                  to_text(system%linkage%ideal(1)%set%n_row_item*system%linkage%ideal(1)%set%n)//" rows", 2)
      end if
      words = trim(merge("velocities ", "coordinates", scene%settings%is_spatial))//" minus rows: "
      call say(counted(system%linkage%rows%n, "constraint row", "constraint rows")//" in all; "//words// &
               to_text(size(system%linkage%mass) - system%linkage%rows%n)//" ("// &
               to_text(size(twin%linkage%mass) - twin%linkage%rows%n)//" with all joints ideal)", 2)
      if (norm2(system%loading%gravity) > 0.0_wp) then
         words = ""
         do k = 1, system%linkage%coordinates%n_axis
            words = words//" "//to_text(system%loading%gravity(k))
         end do
         call say("gravity"//words//" m/s^2", 2)
      end if
   end subroutine explain_size

   !> How the mechanism was assembled, its degrees of freedom, redundant rows.
   subroutine explain_start(loaded, assembly, has_failed)
      type(loaded_t), intent(in) :: loaded       !! the deck
      type(assembly_t), intent(in) :: assembly   !! how the start was found
      logical, intent(in) :: has_failed          !! there is no start

      type(mobility_t) :: mobility
      type(text_t), allocatable :: doubts(:)
      integer :: k

      if (has_failed) then
         call say(trim(merge("NOT assembled   ", "NOT ready to run", loaded%scene%analysis == analysis_dynamic))// &
                  ": see the error below", 2)
         return
      end if
      call say(counted(size(loaded%system%linkage%mass) - loaded%system%linkage%rows%n + size(assembly%dependent), &
                       "degree of freedom", "degrees of freedom"), 2)
      if (loaded%scene%analysis == analysis_kinematic) then
         call find_mobility(loaded%system%linkage, mobility)
         call say(counted(mobility%n_freedom, "degree of freedom", "degrees of freedom")//" without drivers, "// &
                  counted(mobility%n_driver, "driver", "drivers"), 2)
      end if
      if (loaded%system%linkage%solution%is_redundant) then
         call say(redundancy_text(loaded%system, assembly), 2)
      else
         call say("no redundant rows", 2)
      end if
      allocate (doubts(0))
      call find_doubts(loaded%system%linkage, doubts)
      do k = 1, size(doubts)
         call say(doubts(k)%s, 2)
      end do
      call say("assembled in "//counted(assembly%corrections, "correction", "corrections")//", residual "// &
               real_text(assembly%residual, 2)//" m or rad, maximum displacement of a body "//real_text(assembly%moved, 3)// &
               " m", 2)
      if (assembly%rate_changed > 0.0_wp) then
         call say("consistent initial velocities: changes up to "//real_text(assembly%rate_changed, 3)//" m/s (body '"// &
                  loaded%scene%bodies%names(assembly%changed_body)%s//"')", 2)
      end if
   end subroutine explain_start

   !> Values of the deck that are possible but unusual.
   subroutine explain_notes(scene, system, assembly)
      type(scene_t), intent(in) :: scene            !! the scene
      type(mechanism_t), intent(in) :: system       !! its system
      type(assembly_t), intent(in) :: assembly      !! how the start was found

      type(text_t), allocatable :: notes(:)
      integer :: k

      call find_notes(scene, system, assembly, notes)
      if (size(notes) == 0) return
      call say("")
      call say("unusual values, taken as they are")
      do k = 1, size(notes)
         call say(notes(k)%s, 2)
      end do
   end subroutine explain_notes

   !> How many items a kind has.
   subroutine count_kind(info, items)
      type(kind_info_t), intent(in) :: info   !! the kind
      type(item_t), intent(in) :: items(:)    !! its rows

      if (size(items) == 0) return
      if (info%n_row > 0) then
         call say(to_text(size(items))//" "//info%name//", "// &
                  counted(info%n_row*size(items), "constraint row", "constraint rows")// &
                  trim(merge(" initially only   ", "                  ", info%is_start_only)), 2)
      else
         call say(to_text(size(items))//" "//info%name, 2)
      end if
   end subroutine count_kind

end module explain_model
