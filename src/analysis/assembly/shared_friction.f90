!> Friction in ideal joints that depends on multipliers which are not unique.
!>
!> Rows that depend on one another have a combination that vanishes, Phi_q^T x = 0, and lambda + s x holds the bodies as lambda
!> does.
!> The friction of a joint depends on s if its normal force does. The normal force without load is the preload; what x adds to it is
!> a norm of the joint's part of x or of some of its entries, which is zero for the parts of x that do not matter: the axial force
!> of a pin, say, whose radial one is unique.
!>
!> Source: J. F. Fraczek and M. Wojtyra, On the unique solvability of a direct dynamics problem for mechanisms with redundant
!> constraints and Coulomb friction in joints, Mech. Mach. Theory 46 (2011) 312-334. Limits: at one position; of a scene so large
!> that its matrices are sparse every row that occurs in a combination counts by itself.
module shared_friction
   use assembly_report, only: assembly_t
   use dependent_rows, only: choose_dependent
   use joint_friction, only: most_rows
   use joint_set, only: joint_set_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: find_shared_friction

   real(wp), parameter :: share = 1.0e-6_wp  !! normal force times the size of the bodies, of the maximum scaled multiplier [1]

contains

   !> Joints whose friction depends on multipliers that are not unique, into the report.
   subroutine find_shared_friction(system, report)
      class(mechanism_t), intent(inout) :: system   !! the system, its motion and rows those of the start
      type(assembly_t), intent(inout) :: report     !! dependent rows are found

      type(assembly_t) :: again
      real(wp), allocatable :: x(:, :)
      logical :: is_shared(system%friction%rubbing%n)
      integer :: k

      report%rubbing = [integer ::]
      if (size(report%dependent) == 0 .or. system%friction%rubbing%n == 0) return
      call choose_dependent(system%linkage, again, combination=x)
      if (.not. allocated(x)) then
         allocate (x(system%linkage%rows%n, size(again%shared)), source=0.0_wp)
         do k = 1, size(again%shared)
            x(again%shared(k), k) = 1.0_wp
         end do
      end if
      do k = 1, size(x, 2)
         x(:, k) = x(:, k)/maxval(abs(x(:, k)))*system%linkage%solution%row_weight(:size(x, 1))
      end do
      associate (rubbing => system%friction%rubbing)
         do k = 1, rubbing%n
            associate (set => system%linkage%joints(rubbing%slot(k))%set)
               call set%slide(system%linkage%motion)
               is_shared(k) = presses(set, rubbing%place(k), x, system%linkage%scales%length)
            end associate
         end do
         report%rubbing = pack([(k, k=1, rubbing%n)], is_shared)
      end associate
   end subroutine find_shared_friction

   !> Whether any combination changes the normal force of an item that has friction.
   logical function presses(set, m, x, length)
      class(joint_set_t), intent(in) :: set   !! the set
      integer, intent(in) :: m                !! place among the items with friction
      real(wp), intent(in) :: x(:, :)         !! (rows, combinations) multipliers [N or N.m]
      real(wp), intent(in) :: length          !! size of the bodies [m]

      real(wp) :: lambda(most_rows), normal, slope(most_rows), without
      integer :: first, k

      lambda = 0.0_wp
      call set%press(m, lambda, without, slope)
      first = set%first_row + (set%friction%item(m) - 1)*set%n_row_item
      presses = .false.
      do k = 1, size(x, 2)
         lambda(:set%n_row_item) = x(first + 1:first + set%n_row_item, k)
         call set%press(m, lambda, normal, slope)
         presses = presses .or. (normal - without)*length > share
      end do
   end function presses

end module shared_friction
