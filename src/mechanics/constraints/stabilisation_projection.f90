!> Projection onto the constraints at the end of each step, in the metric of the masses.
!>
!> dq = -M^-1 Phi_q^T (Phi_q M^-1 Phi_q^T)^-1 Phi, by Newton's iteration, then at the corrected position
!> dv = -M^-1 Phi_q^T (Phi_q M^-1 Phi_q^T)^-1 (Phi_q v + Phi_t):
!>
!> the corrections of minimum kinetic energy. Violations are at round-off afterwards. Where rows are nearly dependent the
!> damped solution leaves what it cannot correct.
!> Source: as an addition to Flores et al. (2008), section 2.5; E. Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482.
!> Limits: a violation that Newton's iteration can correct; a step that leaves more is refused.
module stabilisation_projection
   use stabilisation, only: stabilisation_t
   use item, only: option_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use linkage, only: linkage_t
   implicit none (type, external)
   private
   public :: stabilisation_projection_t

   real(wp), parameter :: round_off = 1.0e-14_wp  !! scaled violation that is not worth a correction [1]
   real(wp), parameter :: too_much = 1.0e-7_wp    !! scaled violation left over at which the step is refused [1]
   integer, parameter :: n_newton = 3             !! corrections of the positions, at most

   !> Projection.
   type, extends(stabilisation_t) :: stabilisation_projection_t
   contains
      procedure, nopass :: info => projection_info
      procedure :: words => projection_words
      procedure :: configure => projection_configure
      procedure :: correct_step => projection_correct_step
   end type stabilisation_projection_t

contains

   !> Description of the method.
   function projection_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "projection"
      info%help = "projection onto the constraints after every step, with minimum change in the metric of kinetic energy"
      info%source = "Eich (1993)"
   end function projection_info

   !> What is done, as text.
   function projection_words(self) result(words)
      class(stabilisation_projection_t), intent(in) :: self  !! the stabilisation method
      character(:), allocatable :: words            !! as in a deck

      words = self%name()
   end function projection_words

   !> No options; the ends of steps are corrected.
   subroutine projection_configure(self, options, tolerance)
      class(stabilisation_projection_t), intent(inout) :: self  !! the stabilisation method
      type(option_t), intent(in) :: options(:)         !! (any) none
      real(wp), intent(in) :: tolerance                !! of the integrator [1]

      self%at_steps = .true.
   end subroutine projection_configure

   !> Positions, then rates. The motion of the bodies is that of the corrected state afterwards.
   subroutine projection_correct_step(self, linkage, t, y, status)
      class(stabilisation_projection_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage        !! the bodies and their rows
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(inout), contiguous :: y(:)      !! (n) state, corrected [any]
      integer, intent(out) :: status                   !! 0: done

      real(wp) :: before, now
      integer :: k

      status = 0
      before = huge(1.0_wp)
      associate (n => linkage%rows%n_solve)
         do k = 0, n_newton
            call linkage%evaluate_rows(t)
            now = linkage%max_violation()
            if (k == n_newton .or. now <= round_off .or. now > 0.5_wp*before) exit
            before = now
            linkage%solution%b(:n) = -linkage%rows%phi(:n)
            call correct(linkage, t, .false., y, status)
            if (status /= 0) return
         end do
         ! beyond a dead centre there is no position to correct to: shorter steps end there
         if (.not. now <= too_much) status = 1
         if (status /= 0) return
         linkage%solution%b(:n) = -linkage%solution%phi_dot(:n)
      end associate
      call correct(linkage, t, .true., y, status)
   end subroutine projection_correct_step

   !> Add the minimum change to coordinates or rates, and set the motion anew.
   subroutine correct(linkage, t, to_rates, y, status)
      type(linkage_t), intent(inout) :: linkage        !! the bodies and their rows, b set
      real(wp), intent(in) :: t                        !! time [s]
      logical, intent(in) :: to_rates                  !! whether rates are corrected, not coordinates
      real(wp), intent(inout), contiguous :: y(:)      !! (2 positions or more) coordinates and rates [any]
      integer, intent(out) :: status                   !! 0: done

      call linkage%solve_rows(status)
      if (status /= 0) return
      call linkage%add_change(to_rates, y)
      call linkage%set_motion(t, y)
   end subroutine correct

end module stabilisation_projection
