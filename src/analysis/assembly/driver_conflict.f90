!> Drivers that contradict each other at the start, found when a mechanism cannot be assembled.
!>
!> What a minimum correction leaves open is spread over all joints of a loop, so the joint that is most open says little. A
!> driver, or a speed at the start, takes part in a contradiction if the mechanism can be assembled without it; two of them
!> contradict each other.
module driver_conflict
   use assembly_report, only: assembly_t
   use build_system, only: new_system
   use consistent_start, only: assemble
   use errors, only: error_t, exit_assembly, set_error
   use item, only: item_t
   use joint_registry, only: n_joint_kinds
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use scene, only: scene_t
   use text, only: append_text, segment, starts_with, text_t
   implicit none (type, external)
   private
   public :: name_conflict

   integer, parameter :: most_drivers = 50  !! drivers that are tried: each takes an assembly

contains

   !> Say which drivers or initial speeds contradict each other, if that is why a mechanism cannot be assembled; else
   !> the error stays as it is.
   subroutine name_conflict(scene, levels, q, v, error)
      type(scene_t), intent(in) :: scene                      !! the scene
      integer, intent(in) :: levels                           !! how joints with clearance are taken
      real(wp), intent(in) :: q(:)                            !! (n_q bodies) positions of the deck [any]
      real(wp), intent(in) :: v(:)                            !! (n_v bodies) velocities of the deck [m/s or rad/s]
      type(error_t), allocatable, intent(inout) :: error      !! why it cannot be assembled

      type(text_t), allocatable :: guilty(:)
      character(:), allocatable :: names, was
      integer :: i, k, n
      logical :: is_driver(n_joint_kinds())

      if (error%code /= exit_assembly) return
      n = 0
      do k = 1, n_joint_kinds()
         is_driver(k) = starts_with(scene%joints(k)%info%name, "driver.") .or. scene%joints(k)%info%is_start_only
         if (is_driver(k)) n = n + size(scene%joints(k)%items)
      end do
      if (n < 2 .or. n > most_drivers) return
      allocate (guilty(0))
      do k = 1, n_joint_kinds()
         if (.not. is_driver(k)) cycle
         do i = 1, size(scene%joints(k)%items)
            if (can_do_without(scene, levels, k, i, q, v)) call append_text(guilty, scene%joints(k)%items(i)%name)
         end do
      end do
      if (size(guilty) < 2) return
      names = "'"//guilty(1)%s//"'"
      do k = 2, size(guilty)
         if (k < size(guilty)) names = names//", '"//guilty(k)%s//"'"
         if (k == size(guilty)) names = names//" and '"//guilty(k)%s//"'"
      end do
      was = error%message
      if (index(was, new_line("a")) > 0) was = segment(was, 1, index(was, new_line("a")) - 1)
      call set_error(error, exit_assembly, names//" prescribe contradictory motion at t = 0"//new_line("a")// &
                     "  = the mechanism can be assembled without any one of them, but not with all: "//was//new_line("a")// &
                     "  = remove one, or make their positions and speeds consistent")
   end subroutine name_conflict

   !> Whether the mechanism can be assembled without a driver.
   logical function can_do_without(scene, levels, kind, row, q, v) result(can)
      type(scene_t), intent(in) :: scene     !! the scene
      integer, intent(in) :: levels          !! how joints with clearance are taken
      integer, intent(in) :: kind            !! kind of the driver
      integer, intent(in) :: row             !! its row in the table
      real(wp), intent(in) :: q(:)           !! (n_q bodies) positions of the deck [any]
      real(wp), intent(in) :: v(:)           !! (n_v bodies) velocities of the deck [m/s or rad/s]

      type(scene_t) :: other
      type(assembly_t) :: report
      type(error_t), allocatable :: error
      type(item_t), allocatable :: rest(:)
      type(mechanism_t) :: system
      real(wp) :: p(size(q)), w(size(v))
      integer :: k, n

      other = scene
      allocate (rest(size(scene%joints(kind)%items) - 1))
      n = 0
      do k = 1, size(scene%joints(kind)%items)
         if (k == row) cycle
         n = n + 1
         rest(n) = scene%joints(kind)%items(k)
      end do
      call move_alloc(rest, other%joints(kind)%items)
      call new_system(other, levels, system, is_for_start=.true.)
      p = q
      w = v
      call assemble(system%linkage, p, w, report, error)
      can = .not. allocated(error)
   end function can_do_without

end module driver_conflict
