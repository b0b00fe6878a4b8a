!> Where a kinematic analysis starts: assembled positions, and a driver for every degree of freedom.
module kinematic_start
   use assembly_report, only: assembly_t
   use consistent_start, only: assemble
   use dependent_rows, only: find_dependent
   use errors, only: error_t, exit_assembly, set_error
   use kinds, only: wp
   use linkage, only: linkage_t
   use mobility, only: find_mobility, joint_names, mobility_t, moving_bodies
   use mechanism, only: mechanism_t
   use row_corrections, only: evaluate_rows, worst_violation
   use scene, only: scene_t
   use shaky, only: find_shaky, name_dead_centre
   use shared_friction, only: find_shared_friction
   use text, only: to_text
   implicit none (type, external)
   private
   public :: find_kinematic_start

contains

   !> Assemble at t = 0 and count freedoms against drivers.
   !>
   !> Drivers that contradict each other keep the mechanism from being assembled; then it is reported which
   !> of them is in excess, not which joint stays open.
   subroutine find_kinematic_start(scene, system, q, report, mobility, error)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(mechanism_t), intent(inout) :: system        !! the system, all joints ideal
      real(wp), allocatable, intent(out) :: q(:)            !! (n_q bodies) positions at t = 0 [any]
      type(assembly_t), intent(out) :: report               !! how the assembly went
      type(mobility_t), intent(out) :: mobility             !! freedoms and drivers at the start
      type(error_t), allocatable, intent(out) :: error      !! cannot be assembled, a driver is missing or in excess

      type(error_t), allocatable :: assembly_error
      real(wp), allocatable :: v(:)

      call system%linkage%deck_state(q, v)
      call assemble(system%linkage, q, v, report, assembly_error)
      call evaluate_rows(system%linkage, 0.0_wp, q, v)
      call find_mobility(system%linkage, mobility)
      call find_dependent(system%linkage, q, v, report)
      call find_shared_friction(system, report)
      system%linkage%solution%is_redundant = size(report%dependent) > 0
      if (any(mobility%is_excess) .and. mobility%n_left > 0 .and. is_closed(system%linkage)) then
         call name_dead_centre(system%linkage, q, mobility%is_excess, error)
      end if
      if (allocated(error)) return
      if (any(mobility%is_excess)) then
         call refuse_excess(system, mobility, error)
      else if (allocated(assembly_error)) then
         call move_alloc(assembly_error, error)
      else if (mobility%n_left > 0) then
         call find_shaky(system%linkage, q, error)
         if (.not. allocated(error)) call refuse_missing(system, mobility, report, error)
      end if
   end subroutine find_kinematic_start

   !> Whether positions fulfil the rows, where velocities may not.
   logical function is_closed(linkage)
      type(linkage_t), intent(in) :: linkage  !! the bodies and their rows, evaluated

      real(wp), parameter :: closed = 1.0e-10_wp  ! scaled violation [1]

      is_closed = worst_violation(linkage) <= closed
   end function is_closed

   !> Drivers that prescribe what the joints and the other drivers do already.
   subroutine refuse_excess(system, mobility, error)
      type(mechanism_t), intent(in) :: system          !! the system
      type(mobility_t), intent(in) :: mobility             !! freedoms and drivers
      type(error_t), allocatable, intent(out) :: error     !! the message

      character(:), allocatable :: left

      left = ""
      if (mobility%n_left > 0) left = new_line("a")//"  = and "//freedoms(mobility%n_left)//" without a driver: "// &
                                      moving_bodies(system%linkage, mobility%freedom)//" can still move"
      call set_error(error, exit_assembly, "the mechanism is over-driven: "//drivers(mobility%n_driver)//" for "// &
                     freedoms(mobility%n_freedom)//", and "//joint_names(system%linkage, mobility%is_excess)// &
                     " prescribes motion that joints and other drivers already determine"//left//new_line("a")// &
                     "  = drivers: "//joint_names(system%linkage, mobility%is_driver)//new_line("a")// &
                     "  = a kinematic analysis needs exactly one driver per degree of freedom; remove the extra one")
   end subroutine refuse_excess

   !> Freedoms that no driver prescribes.
   subroutine refuse_missing(system, mobility, report, error)
      type(mechanism_t), intent(in) :: system          !! the system
      type(mobility_t), intent(in) :: mobility             !! freedoms and drivers
      type(assembly_t), intent(in) :: report               !! dependent rows
      type(error_t), allocatable, intent(out) :: error     !! the message

      character(:), allocatable :: dead_centre
      logical :: is_shared(system%linkage%rows%n)

      is_shared = .false.
      is_shared(report%shared) = .true.
      dead_centre = ""
      if (any(is_shared)) dead_centre = new_line("a")//"  = rows of "//joint_names(system%linkage, is_shared)// &
                                   " are linearly dependent here: at a dead centre, start at another position"
      call set_error(error, exit_assembly, "the motion is not determined: "//freedoms(mobility%n_left)//" left; "// &
                     drivers(mobility%n_driver)//" for "//freedoms(mobility%n_freedom)//new_line("a")// &
                     "  = bodies that can move: "//moving_bodies(system%linkage, &
                          mobility%freedom)//dead_centre//new_line("a")// &
                     "  = add one driver per degree of freedom, or use [analysis.dynamic]")
   end subroutine refuse_missing

   !> A number of freedoms as text.
   function freedoms(n) result(words)
      integer, intent(in) :: n               !! the number
      character(:), allocatable :: words     !! as `2 degrees of freedom`

      words = to_text(n)//" degrees of freedom"
      if (n == 1) words = "1 degree of freedom"
   end function freedoms

   !> A number of drivers as text.
   function drivers(n) result(words)
      integer, intent(in) :: n               !! the number
      character(:), allocatable :: words     !! as `2 drivers`

      words = to_text(n)//" drivers"
      if (n == 1) words = "1 driver"
   end function drivers

end module kinematic_start
