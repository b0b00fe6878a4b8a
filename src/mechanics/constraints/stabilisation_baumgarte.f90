!> Baumgarte's stabilisation with constant gains: b = gamma - 2 alpha Phi' - beta^2 Phi.
!>
!> Critical damping is alpha = beta. Gains of the order of one over the step hold best and pollute the motion most.
!> Source: Flores et al. (2008), eqs. (2.23), (2.24); J. Baumgarte (1972). Limits: gain times step below about 2.7
!> (Runge-Kutta of order 4).
module stabilisation_baumgarte
   use stabilisation, only: stabilisation_t, option_number
   use item, only: option_t
   use kind_info, only: add_number, dim_frequency, kind_info_t
   use kinds, only: wp
   use linkage, only: linkage_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: stabilisation_baumgarte_t

   !> Constant gains.
   type, extends(stabilisation_t) :: stabilisation_baumgarte_t
      real(wp) :: alpha = 5.0_wp  !! gain on the rate of violation [1/s]
      real(wp) :: beta = 5.0_wp   !! gain on the violation [1/s]
   contains
      procedure, nopass :: info => baumgarte_info
      procedure :: words => baumgarte_words
      procedure :: configure => baumgarte_configure
      procedure :: begin_step => baumgarte_begin_step
   end type stabilisation_baumgarte_t

contains

   !> Description of the method.
   function baumgarte_info() result(info)
      type(kind_info_t) :: info  !! name, help, options

      info%name = "baumgarte"
      info%help = "constant gains alpha, beta"
      info%source = "Flores et al. (2008), eqs. (2.23), (2.24)"
      call add_number(info, "alpha", dim_frequency, "gain on the rate of violation", default="", lower=0.0_wp)
      call add_number(info, "beta", dim_frequency, "gain on the violation", default="", lower=0.0_wp)
   end function baumgarte_info

   !> What is done, as text.
   function baumgarte_words(self) result(words)
      class(stabilisation_baumgarte_t), intent(in) :: self  !! the stabilisation method
      character(:), allocatable :: words           !! as in a deck

      words = self%name()//" alpha="//to_text(self%alpha)//"s^-1 beta="//to_text(self%beta)//"s^-1"
   end function baumgarte_words

   !> Take the gains of a deck.
   subroutine baumgarte_configure(self, options, tolerance)
      class(stabilisation_baumgarte_t), intent(inout) :: self  !! the stabilisation method
      type(option_t), intent(in) :: options(:)        !! (any) alpha, beta
      real(wp), intent(in) :: tolerance               !! of the integrator [1]

      self%alpha = option_number(options, "alpha", self%alpha)
      self%beta = option_number(options, "beta", self%beta)
   end subroutine baumgarte_configure

   !> The gains do not change.
   subroutine baumgarte_begin_step(self, linkage, h)
      class(stabilisation_baumgarte_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage       !! the bodies and their rows
      real(wp), intent(in) :: h                       !! length of the step [s]

      call linkage%solution%set_gains(self%alpha, self%beta)
   end subroutine baumgarte_begin_step

end module stabilisation_baumgarte
