!> How time goes along a step of a Runge-Kutta method: evenly, or as a square from or to a place where a force starts or ends.
!>
!> A contact force goes like a half-integer power of the time since its onset, t^1.5 of Hertz's, and of the time left to its end.
!> Velocities have t^2.5 in them, positions t^3.5, so that a step that starts there has an error of the order h^2.5, whatever the
!> method. With t = t_0 + h p(s), 0 <= s <= 1, the equations are
!>
!> $$ dy/ds = h p'(s) f(t, y), \qquad p = s^2 \text{ from a root}, \quad p = s (2 - s) \text{ to one}, \quad p = s \text{ else} $$
!>
!> and in s these powers are whole ones: a method of order q has an error of the order h^((q + 1)/2). Forces that are smooth there
!> stay so; a step then carries half the powers of time that an even one does.
!>
!> Source: substitution of the independent variable; the powers are those of Flores et al. (2008), eq. (3.1), at delta = v t.
!> Limits: a root at an end of the step.
module step_course
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: along, course_even, course_from_root, course_to_root, pace_at, parameter_of

   integer, parameter :: course_even = 0        !! time goes evenly
   integer, parameter :: course_from_root = 1   !! a force starts like a root of time at the start of the step
   integer, parameter :: course_to_root = 2     !! one ends so at its end

contains

   !> p(s).
   elemental real(wp) function along(course, s) result(place)
      integer, intent(in) :: course   !! how time goes
      real(wp), intent(in) :: s       !! parameter, 0 to 1 [1]

      select case (course)
      case (course_from_root); place = s*s
      case (course_to_root); place = s*(2.0_wp - s)
      case default; place = s
      end select
   end function along

   !> p'(s).
   elemental real(wp) function pace_at(course, s) result(pace)
      integer, intent(in) :: course   !! how time goes
      real(wp), intent(in) :: s       !! parameter, 0 to 1 [1]

      select case (course)
      case (course_from_root); pace = 2.0_wp*s
      case (course_to_root); pace = 2.0_wp*(1.0_wp - s)
      case default; pace = 1.0_wp
      end select
   end function pace_at

   !> The parameter at a place: s for p(s).
   elemental real(wp) function parameter_of(course, place) result(s)
      integer, intent(in) :: course   !! how time goes
      real(wp), intent(in) :: place   !! place in the step, 0 to 1 [1]

      select case (course)
      case (course_from_root); s = sqrt(max(place, 0.0_wp))
      case (course_to_root); s = 1.0_wp - sqrt(max(1.0_wp - place, 0.0_wp))
      case default; s = place
      end select
   end function parameter_of

end module step_course
