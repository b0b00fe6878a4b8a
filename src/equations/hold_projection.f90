!> Projection onto the constraints at the end of each step, in the metric of the masses.
!>
!> dq = -M^-1 Phi_q^T (Phi_q M^-1 Phi_q^T)^-1 Phi, by Newton's iteration, then at the corrected position
!> dv = -M^-1 Phi_q^T (Phi_q M^-1 Phi_q^T)^-1 (Phi_q v + Phi_t):
!>
!> the corrections of least kinetic energy. Violations are at round-off afterwards. Where rows are nearly dependent the
!> damped solution leaves what it cannot correct.
!> Source: as an addition to Flores et al. (2008), section 2.5; E. Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482.
!> Limits: a violation that Newton's iteration can correct; a step that leaves more is refused.
module hold_projection
   use hold, only: hold_t
   use item, only: option_t
   use kinds, only: wp
   use ode_system, only: ode_system_t
   use planar_system, only: planar_system_t
   implicit none (type, external)
   private
   public :: hold_projection_t

   real(wp), parameter :: round_off = 1.0e-14_wp  !! scaled violation that is not worth a correction [1]
   real(wp), parameter :: too_much = 1.0e-7_wp    !! scaled violation left over at which the step is refused [1]
   integer, parameter :: n_newton = 3             !! corrections of the positions, at most

   !> Projection.
   type, extends(hold_t) :: hold_projection_t
   contains
      procedure, nopass :: name => projection_name
      procedure :: words => projection_words
      procedure :: configure => projection_configure
      procedure :: correct_step => projection_correct_step
   end type hold_projection_t

contains

   !> The word for it in a deck.
   function projection_name() result(name)
      character(:), allocatable :: name  !! as in `stabilise = name`

      name = "projection"
   end function projection_name

   !> What is done, in words.
   function projection_words(self) result(words)
      class(hold_projection_t), intent(in) :: self  !! the way
      character(:), allocatable :: words            !! as in a deck

      words = self%name()
   end function projection_words

   !> No options; the ends of steps are corrected.
   subroutine projection_configure(self, options, tolerance)
      class(hold_projection_t), intent(inout) :: self  !! the way
      type(option_t), intent(in) :: options(:)         !! (any) none
      real(wp), intent(in) :: tolerance                !! of the integrator [1]

      self%at_steps = .true.
   end subroutine projection_configure

   !> Correct the end of a step.
   subroutine projection_correct_step(self, system, t, y, status)
      class(hold_projection_t), intent(inout) :: self  !! the way
      class(ode_system_t), intent(inout) :: system     !! the system
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(inout), contiguous :: y(:)      !! (n) state, corrected [any]
      integer, intent(out) :: status                   !! 0: done

      status = 0
      select type (system)
      class is (planar_system_t)
         call project(system, t, y, status)
      end select
   end subroutine projection_correct_step

   !> Positions, then rates. The motion of the system is that of the corrected state afterwards.
   subroutine project(system, t, y, status)
      class(planar_system_t), intent(inout) :: system  !! the system, its motion set
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(inout), contiguous :: y(:)      !! (2 positions or more) coordinates and rates, corrected [any]
      integer, intent(out) :: status                   !! 0: done

      real(wp) :: before, now
      integer :: k

      status = 0
      before = huge(1.0_wp)
      associate (n => system%rows%n_solve)
         do k = 0, n_newton
            call system%evaluate_rows(system%piece%inside(t))
            now = maxval(system%row_weight(:n)*abs(system%rows%phi(:n)))
            if (k == n_newton .or. now <= round_off .or. now > 0.5_wp*before) exit
            before = now
            system%b(:n) = -system%rows%phi(:n)
            call correct(system, t, 0, y, status)
            if (status /= 0) return
         end do
         ! beyond a dead point there is no position to correct to: shorter steps end there
         if (.not. now <= too_much) status = 1
         if (status /= 0) return
         system%b(:n) = -system%phi_dot(:n)
      end associate
      call correct(system, t, system%n_position, y, status)
   end subroutine project

   !> Add the least change to coordinates or rates, and set the motion anew.
   subroutine correct(system, t, place, y, status)
      class(planar_system_t), intent(inout) :: system  !! the system, b set
      real(wp), intent(in) :: t                        !! time [s]
      integer, intent(in) :: place                     !! before what is corrected in the state
      real(wp), intent(inout), contiguous :: y(:)      !! (2 positions or more) coordinates and rates [any]
      integer, intent(out) :: status                   !! 0: done

      integer :: k

      call system%solve_rows(status)
      if (status /= 0) return
      do k = 1, system%rows%n_unknown
         associate (part => y(place + 3*k - 2:place + 3*k))
            part = part + system%a(:, system%rows%unknown(k))
         end associate
      end do
      call system%set_motion(t, y)
   end subroutine correct

end module hold_projection
