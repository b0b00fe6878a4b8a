!> Augmented Lagrangian: penalties on the violations, iterated until the rows are fulfilled.
!>
!> b = gamma - 2 omega mu Phi' - omega^2 Phi, solved by `solver = augmented_lagrangian` with the given penalty: the converged
!> iteration is Baumgarte's stabilisation with alpha = omega mu, beta = omega.
!> Source: Flores et al. (2008), section 2.5, eqs. (2.32)-(2.35), with Phi_q v + Phi_t where (2.34) prints Phi_q a;
!> J. Garcia de Jalon, E. Bayo (1994). Limits: as augmented_lagrangian and hold_baumgarte.
module stabilisation_augmented_lagrangian
   use stabilisation, only: stabilisation_t, option_number
   use item, only: option_t
   use kind_info, only: add_number, dim_frequency, dim_none, kind_info_t
   use kinds, only: wp
   use linkage, only: linkage_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: stabilisation_augmented_lagrangian_t

   !> Gains and penalty.
   type, extends(stabilisation_t) :: stabilisation_augmented_lagrangian_t
      real(wp) :: penalty = 1.0e5_wp  !! of a violated row, of its inverse effective mass [1]
      real(wp) :: omega = 10.0_wp     !! natural frequency of a violation [1/s]
      real(wp) :: mu = 1.0_wp         !! its damping ratio [1]
   contains
      procedure, nopass :: info => lagrangian_info
      procedure, nopass :: solver => lagrangian_solver
      procedure :: words => lagrangian_words
      procedure :: configure => lagrangian_configure
      procedure :: begin_step => lagrangian_begin_step
   end type stabilisation_augmented_lagrangian_t

contains

   !> Description of the method.
   function lagrangian_info() result(info)
      type(kind_info_t) :: info  !! name, help, options

      info%name = "augmented_lagrangian"
      info%help = "penalty, and gains omega mu, omega"
      info%source = "Flores et al. (2008), section 2.5, eqs. (2.32)-(2.35)"
      call add_number(info, "penalty", dim_none, "of a violated row, relative to its effective mass", default="", lower=0.0_wp, &
                      open_lower=.true.)
      call add_number(info, "omega", dim_frequency, "gain on the violation", default="", lower=0.0_wp)
      call add_number(info, "mu", dim_none, "damping: the gain on the rate of violation is omega mu", default="", lower=0.0_wp)
   end function lagrangian_info

   !> The solver that iterates with the penalty.
   pure function lagrangian_solver() result(name)
      character(:), allocatable :: name     !! as in `solver = name`

      name = "augmented_lagrangian"
   end function lagrangian_solver

   !> What is done, as text.
   function lagrangian_words(self) result(words)
      class(stabilisation_augmented_lagrangian_t), intent(in) :: self  !! the stabilisation method
      character(:), allocatable :: words                      !! as in a deck

      words = self%name()//" penalty="//to_text(self%penalty)//" omega="//to_text(self%omega)//"s^-1 mu="//to_text(self%mu)
   end function lagrangian_words

   !> Take the numbers of a deck.
   subroutine lagrangian_configure(self, options, tolerance)
      class(stabilisation_augmented_lagrangian_t), intent(inout) :: self  !! the stabilisation method
      type(option_t), intent(in) :: options(:)                   !! (any) penalty, omega, mu
      real(wp), intent(in) :: tolerance                          !! of the integrator [1]

      self%penalty = option_number(options, "penalty", self%penalty)
      self%omega = option_number(options, "omega", self%omega)
      self%mu = option_number(options, "mu", self%mu)
   end subroutine lagrangian_configure

   !> Gains, and the penalty of the solver.
   subroutine lagrangian_begin_step(self, linkage, h)
      class(stabilisation_augmented_lagrangian_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage                  !! the bodies and their rows
      real(wp), intent(in) :: h                                  !! length of the step [s]

      call linkage%solution%set_gains(self%omega*self%mu, self%omega)
      call linkage%solution%solver%set_penalty(self%penalty)
   end subroutine lagrangian_begin_step

end module stabilisation_augmented_lagrangian
