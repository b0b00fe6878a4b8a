!> The stretch of time in which a motion starts: functions of time take their right side at t = 0.
module start_segment
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_set_halting_mode, ieee_set_status, ieee_status_type, ieee_usual
   use expression_switches, only: find_switches, switch_t
   use kind_info, only: cell_expression
   use kinds, only: wp
   use scene, only: scene_t, table_t
   use smooth_segment, only: smooth_segment_t
   implicit none (type, external)
   private
   public :: segment_at_start

   real(wp), parameter :: just_after = 1.0e-30_wp   !! a time that is 0 in every sum with another one [s]

contains

   !> All of time, or what follows t = 0 if a load or driver jumps or bends there.
   function segment_at_start(scene) result(segment)
      type(scene_t), intent(in) :: scene   !! the scene
      type(smooth_segment_t) :: segment        !! the stretch

      type(ieee_status_type) :: status
      integer :: k
      logical :: bends

      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      bends = .false.
      do k = 1, size(scene%joints)
         bends = bends .or. bends_at_start(scene%joints(k))
      end do
      do k = 1, size(scene%forces)
         bends = bends .or. bends_at_start(scene%forces(k))
      end do
      call ieee_set_status(status)
      if (bends) segment%low = just_after
   end function segment_at_start

   !> Whether a function of time in a table has different branches at t = 0 and behind it.
   logical function bends_at_start(table) result(bends)
      type(table_t), intent(in) :: table   !! rows of a kind

      type(switch_t), allocatable :: switches(:)
      real(wp) :: at, behind, d1, d2
      integer :: c, i, k

      bends = .false.
      do c = 1, size(table%info%columns)
         if (table%info%columns(c)%cell /= cell_expression .or. table%info%columns(c)%variable /= "t") cycle
         do i = 1, size(table%items)
            if (table%items(i)%values(c)%expression%is_constant) cycle
            call find_switches(table%items(i)%values(c)%expression, switches)
            do k = 1, size(switches)
               call switches(k)%g%evaluate(0.0_wp, at, d1, d2)
               call switches(k)%g%evaluate(just_after, behind, d1, d2)
               bends = bends .or. (.not. switches(k)%touches .and. (at < 0.0_wp .neqv. behind < 0.0_wp))
            end do
         end do
      end do
   end function bends_at_start

end module start_segment
