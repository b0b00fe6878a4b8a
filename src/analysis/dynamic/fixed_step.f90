!> Whether the fixed step of a method is too long for the motion. Such a method has no error estimate: what comes of it is reported
!> by whatever looks at states, as joints torn apart or energy made of nothing, which is not the cause.
!>
!> From where the last step started one step of the set length is made, and the same time is gone through by 4, 16, ... steps.
!> It is too long if they get there and it does not, or if it leads elsewhere, by more than `apart` of the error scales. Where they
!> do not get there either, the cause is another one. Contacts stay as they are meanwhile: no event is met.
module fixed_step
   use integrator, only: advance_step, integrator_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: too_long

   integer, parameter :: n_division = 7          !! divisions by 4 that are tried, at most
   real(wp), parameter :: apart = 1.0e-2_wp      !! difference of both ways, in error scales, that is one of motions [1]

contains

   !> Why the step is too long; blank if it is not, or steps are not fixed. The last step of the method is lost.
   function too_long(system, method) result(words)
      type(mechanism_t), intent(inout) :: system      !! the system, where the motion failed
      class(integrator_t), intent(inout) :: method    !! its integrator
      character(:), allocatable :: words              !! one line

      real(wp) :: f0(system%n), far, h, scale(system%n), t0, y(system%n), y0(system%n), y_parts(system%n)
      integer :: k, n
      logical :: arrives, arrives_in_parts

      words = ""
      h = method%controls%fixed_step
      if (h <= 0.0_wp) return
      t0 = method%step%t0
      y0 = method%step%y0
      f0 = method%step%f0
      call go(1, y, arrives)
      do k = 1, n_division
         call go(4**k, y_parts, arrives_in_parts)
         if (arrives_in_parts) exit
      end do
      if (.not. arrives_in_parts) return
      words = "the step of "//real_text(h, 3)//" s is too long for the motion from t = "//real_text(t0, 9)//" s on: "
      if (.not. arrives) then
         words = words//"the step fails, but steps of "//real_text(h/4.0_wp**k, 3)//" s succeed"
         return
      end if
      n = system%n - system%n_quadrature
      call system%weights(y0, scale)
      far = maxval(abs(y(:n) - y_parts(:n))/scale(:n))
      if (far <= apart) then
         words = ""
      else
         words = words//"steps of "//real_text(h/4.0_wp**k, 3)//" s give a different motion"
      end if

   contains

      !> Go through the step in equal parts.
      subroutine go(n_part, y_end, arrived)
         integer, intent(in) :: n_part         !! how many
         real(wp), intent(out) :: y_end(:)     !! (n) state at the end, if it arrives [any]
         logical, intent(out) :: arrived       !! all of them could be made

         integer :: i, status

         method%step%h = h/real(n_part, wp)
         method%step%t0 = t0
         method%step%y0(:) = y0
         method%step%f0(:) = f0
         arrived = .false.
         do i = 1, n_part
            call method%refine(system, 1.0_wp, y_end, status)
            if (status /= advance_step) return
            method%step%t0 = t0 + h*real(i, wp)/real(n_part, wp)
            method%step%y0(:) = y_end
            call system%evaluate(method%step%t0, method%step%y0, method%step%f0, status)
            if (status /= 0) return
         end do
         arrived = .true.
      end subroutine go

   end function too_long

end module fixed_step
