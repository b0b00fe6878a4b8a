!> Named functions must reach as far as the motion: found before it starts, not when it gets there.
module function_range
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use curve, only: beyond_error
   use diagnostics, only: diagnostics_t
   use expression, only: expression_t
   use expression_compile, only: evaluate_safely
   use kind_info, only: cell_expression
   use kinds, only: wp
   use scene, only: scene_t, table_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: check_function_ranges

   integer, parameter :: n_look = 2000  !! intervals of the motion whose ends are looked at

contains

   !> Report loads and drivers whose named functions do not exist at some time of the motion.
   subroutine check_function_ranges(scene, end, mistakes)
      type(scene_t), intent(in) :: scene              !! the scene
      real(wp), intent(in) :: end                     !! end of the motion [s]
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      integer :: k

      do k = 1, size(scene%joints)
         call check_table(scene%joints(k), end, mistakes)
      end do
      do k = 1, size(scene%forces)
         call check_table(scene%forces(k), end, mistakes)
      end do
   end subroutine check_function_ranges

   !> The expressions of a table.
   subroutine check_table(table, end, mistakes)
      type(table_t), intent(in) :: table              !! rows of a kind
      real(wp), intent(in) :: end                     !! end of the motion [s]
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      real(wp) :: t
      integer :: c, i

      do c = 1, size(table%info%columns)
         if (table%info%columns(c)%cell /= cell_expression .or. table%info%columns(c)%variable /= "t") cycle
         do i = 1, size(table%items)
            associate (value => table%items(i)%values(c))
               if (.not. allocated(value%expression%curves) .or. allocated(value%expression%observables)) cycle
               if (.not. any(value%expression%curves%beyond == beyond_error)) cycle
               t = first_gap(value%expression, end)
               if (t > end) cycle
               call mistakes%add(value%location, "the domain of a function does not cover the motion, in column "// &
                                 table%info%columns(c)%name//" of "//table%info%name, &
                                 "undefined at t = "//real_text(t, 4)//" s, the motion ends at "//real_text(end, 4)//" s", &
                                 "extend the samples, or set beyond = hold, linear or periodic")
            end associate
         end do
      end do
   end subroutine check_table

   !> First time looked at where an expression does not exist; beyond the end if it exists everywhere.
   real(wp) function first_gap(expression, end) result(t)
      type(expression_t), intent(in) :: expression  !! the expression
      real(wp), intent(in) :: end                   !! end of the motion [s]

      real(wp) :: d1, d2, value
      integer :: k

      do k = 0, n_look
         t = end*k/n_look
         call evaluate_safely(expression, t, value, d1, d2)
         if (ieee_is_nan(value)) return
      end do
      t = huge(t)
   end function first_gap

end module function_range
