!> Where a motion starts: assembled positions, consistent velocities, no overlap; redundant rows are found and named.
module start_state
   use assembly_report, only: assembly_t
   use build_system, only: levels_ideal, new_system
   use consistent_start, only: assemble
   use dependent_rows, only: find_dependent
   use driver_conflict, only: name_conflict
   use errors, only: error_t, exit_assembly, exit_deck, set_error
   use integration_method, only: abilities_t
   use integration_settings, only: start_ideal, start_static
   use kinds, only: wp
   use memory_purpose, only: memory_is_for
   use perturbation, only: shift_t
   use mechanism, only: mechanism_t
   use scene, only: scene_t
   use shaky, only: find_dead_centre, find_shaky
   use shared_friction, only: find_shared_friction
   use static, only: equilibrium_t, find_equilibrium
   use text, only: to_text
   implicit none (type, external)
   private
   public :: find_start, ideal_start_t, redundancy_text

   real(wp), parameter :: touching = 1.0e-9_wp  !! overlap that counts as none, of the clearance [1]

   !> Where the mechanism with ideal joints starts; nothing is allocated until it was assembled.
   type :: ideal_start_t
      real(wp), allocatable :: q(:)   !! (n_q bodies) positions [any]
      real(wp), allocatable :: v(:)   !! (n_v bodies) velocities [m/s or rad/s]
      type(assembly_t) :: report      !! how the assembly went
   end type ideal_start_t

contains

   !> State at t = 0 of a system of the scene.
   !>
   !> `start = ideal` assembles the mechanism with its clearance joints taken as ideal, `start = given`
   !> only the ideal joints; both move the bodies as little as possible, with what holds only at the start there while
   !> assembling, then no more. `start = static` searches the equilibrium at t = 0. Rows of the system that runs may depend
   !> on one another: it is reported. A mechanism that was assembled with ideal joints before, for a system with other ones, is not
   !> assembled again.
   subroutine find_start(scene, levels, system, y, report, error, shift, ideal)
      type(scene_t), intent(in) :: scene                    !! the scene
      integer, intent(in) :: levels                         !! of joints with clearance, as of `system`
      type(mechanism_t), intent(inout) :: system            !! the system that will run
      real(wp), allocatable, intent(out) :: y(:)            !! (n) state [any]
      type(assembly_t), intent(out) :: report               !! how the assembly went
      type(error_t), allocatable, intent(out) :: error      !! cannot be assembled, or overlap
      type(shift_t), intent(in), optional :: shift          !! a perturbation, after which the mechanism is assembled anew
      type(ideal_start_t), intent(inout), optional :: ideal !! with ideal joints: taken if it is there, kept if it was found

      type(mechanism_t) :: twin
      real(wp), allocatable :: q(:), v(:)
      integer :: at_start
      logical :: is_shared, starts_ideal

      call memory_is_for("the initial state of "//to_text(size(scene%bodies%names))//" bodies")
      call system%linkage%deck_state(q, v)
      associate (start => scene%settings%integration%start)
         starts_ideal = start == start_ideal
         at_start = merge(levels_ideal, levels, starts_ideal)
         if (start == start_static) call start_at_rest(scene, system, q, v, report, error)
      end associate
      if (allocated(error)) return
      is_shared = .false.
      if (present(ideal)) is_shared = allocated(ideal%q) .and. starts_ideal
      if (is_shared) then
         q = ideal%q
         v = ideal%v
         report = ideal%report
      else
         call new_system(scene, at_start, twin, is_for_start=.true.)
         call assemble(twin%linkage, q, v, report, error)
         if (allocated(error)) then
            call find_dead_centre(twin%linkage, q, error)
            call system%linkage%deck_state(q, v)
            call name_conflict(scene, at_start, q, v, error)
            return
         end if
         if (present(ideal) .and. starts_ideal) ideal = ideal_start_t(q, v, report)
      end if
      if (present(shift)) then
         call shift%move(system%linkage%coordinates, system%linkage%bodies%n, q, v)
         call new_system(scene, levels, twin, is_for_start=.true.)
         call assemble(twin%linkage, q, v, report, error)
         if (allocated(error)) return
      end if
      if (size(report%set_aside) > 0) then
         call assemble(system%linkage, q, v, report, error)  ! rows are set aside in the system that runs, too
         if (allocated(error)) return
      end if
      call judge_rows(system, q, v, report, error)
      if (allocated(error)) return
      call check_method(scene, system, report, error)
      if (allocated(error)) return
      allocate (y(system%n), source=0.0_wp)
      call system%linkage%take_state(q, v, y)
      call system%begin_states(y, error)
      if (allocated(error)) return
      call look_at_overlap(system, y, scene%settings%integration%allows_overlap, error)
   end subroutine find_start

   !> Which rows depend on others, what friction depends on these, and whether they hold a motion to second order only.
   subroutine judge_rows(system, q, v, report, error)
      type(mechanism_t), intent(inout) :: system            !! the system that will run
      real(wp), intent(in) :: q(:)                          !! (n_q bodies) assembled positions [any]
      real(wp), intent(in) :: v(:)                          !! (n_v bodies) their rates [m/s or rad/s]
      type(assembly_t), intent(inout) :: report             !! dependent rows
      type(error_t), allocatable, intent(out) :: error      !! the assembly is shaky

      associate (linkage => system%linkage)
         call find_dependent(linkage, q, v, report)
         call find_shared_friction(system, report)
         if (report%n_weak > size(report%set_aside)) call find_shaky(linkage, q, error)
         if (allocated(error)) return
         linkage%solution%is_redundant = size(report%dependent) > 0
         if (size(report%dependent) == 0) call linkage%solution%judge_pivots(linkage%inverse_mass, linkage%rows)
      end associate
   end subroutine judge_rows

   !> A method that leaves dependent rows out has not the multipliers that friction in joints depends on.
   subroutine check_method(scene, system, report, error)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(mechanism_t), intent(in) :: system               !! the system that will run
      type(assembly_t), intent(in) :: report                !! its dependent rows
      type(error_t), allocatable, intent(out) :: error      !! the method cannot do it

      type(abilities_t) :: can

      if (size(report%dependent) == 0 .or. system%friction%rubbing%n == 0) return
      can = scene%settings%integration%can()
      if (.not. can%solves_dae) return
      call set_error(error, exit_deck, "method "//scene%settings%integration%method//" drops redundant rows, but joint " &
                     //"friction needs the multipliers of all rows"//new_line("a")//"  = "//redundancy_text(system, report) &
                     //new_line("a")//"  = use another method, or joints without redundancy")
   end subroutine check_method

   !> The static equilibrium at t = 0, its contacts started.
   subroutine start_at_rest(scene, system, q, v, report, error)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(mechanism_t), intent(inout) :: system        !! the system that will run
      real(wp), intent(inout) :: q(:)                       !! (3 bodies) positions of the deck, then at rest [m, m, rad]
      real(wp), intent(out) :: v(:)                         !! (3 bodies) velocities, zero [m/s, m/s, rad/s]
      type(assembly_t), intent(out) :: report               !! how the assembly went
      type(error_t), allocatable, intent(out) :: error      !! no equilibrium

      type(equilibrium_t) :: equilibrium
      integer :: k

      call find_equilibrium(scene, system, q, report, equilibrium, error)
      if (allocated(error)) return
      v = 0.0_wp
      do k = 1, size(system%clearance_joints%sets)
         call system%clearance_joints%sets(k)%set%begin_at_rest()
      end do
   end subroutine start_at_rest

   !> How many rows depend on others, whose reactions are not unique, and what friction depends on these; blank if none.
   function redundancy_text(system, report) result(words)
      class(mechanism_t), intent(in) :: system   !! the system that was assembled
      type(assembly_t), intent(in) :: report         !! dependent rows
      character(:), allocatable :: words             !! one line

      character(:), allocatable :: names
      integer :: k

      words = report%misfit
      if (size(report%dependent) == size(report%set_aside)) return
      if (words /= "") words = words//"; "
      names = ""
      do k = 1, size(report%shared)
         if (any(report%set_aside == report%shared(k))) cycle
         if (index(names//" ", "'"//system%linkage%row_name(report%shared(k))//"'") > 0) cycle
         names = names//" '"//system%linkage%row_name(report%shared(k))//"'"
      end do
      words = words//"redundant constraints: "//to_text(size(report%dependent) - size(report%set_aside))//" of "// &
              to_text(system%linkage%rows%n)//" rows are linearly dependent at t = 0; "
      if (allocated(report%rubbing)) then
         if (size(report%rubbing) > 0) then
            words = words//"the reactions of"//names//" are not unique: the minimum-norm reactions are used, and the motion "// &
                    "depends on them through friction in"//rubbing_names()//"; give one of these joints compliance (clearance, "// &
                       "or "// &
                    "springs in its place) or choose joint types with fewer rows"
            return
         end if
      end if
      words = words//"accelerations are exact, but the reactions of"//names// &
              " are not unique: the minimum-norm reactions are used"

   contains

      !> Joints whose friction depends on them.
      function rubbing_names() result(list)
         character(:), allocatable :: list   !! their names, each after a blank

         integer :: m

         list = ""
         associate (rubbing => system%friction%rubbing)
            do m = 1, size(report%rubbing)
               associate (set => system%linkage%joints(rubbing%slot(report%rubbing(m)))%set)
                  list = list//" '"//set%names(set%friction%item(rubbing%place(report%rubbing(m))))%s//"'"
               end associate
            end do
         end associate
      end function rubbing_names

   end function redundancy_text

   !> No clearance joint may start with its surfaces overlapping, unless the deck says that it is preloaded: then its contact
   !> has started, with the rate of the penetration as impact speed; a law's floor takes the place of one that is less.
   subroutine look_at_overlap(system, y, is_preload, error)
      type(mechanism_t), intent(inout) :: system       !! the system
      real(wp), intent(in) :: y(:)                         !! (n) state [any]
      logical, intent(in) :: is_preload                    !! overlap is requested
      type(error_t), allocatable, intent(out) :: error     !! names the joint and the depth

      real(wp) :: delta(system%clearance_joints%n_contact), rate(system%clearance_joints%n_contact)
      integer :: i, k

      if (system%clearance_joints%n == 0) return
      call system%events(0.0_wp, y, delta, rate)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               if (delta(set%before%contacts + i) <= touching*set%items%pairs(set%item_of(i))%clearance) cycle
               if (is_preload) then
                  call set%begin_contact(i, 0.0_wp, max(rate(set%before%contacts + i), 0.0_wp), 0.0_wp)
                  cycle
               end if
               call set_error(error, exit_assembly, "initial overlap: joint '"//set%names(set%item_of(i))%s// &
                              "' has initially overlapping surfaces, by "//to_text(delta(set%before%contacts + i))//" m"// &
                              new_line("a")//"  = move its bodies, enlarge the clearance, set start = ideal, "// &
                              "or accept it with overlap = preload")
               return
            end do
         end associate
      end do
   end subroutine look_at_overlap

end module start_state
