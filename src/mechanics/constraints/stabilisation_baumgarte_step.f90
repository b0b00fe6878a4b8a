!> Baumgarte's stabilisation with gains from the step h: alpha = 1/h, beta = sqrt(2)/h.
!>
!> From a second-order step to zero violation, Phi + h Phi' + h^2/2 Phi'' = 0. The options alpha and beta are the factors
!> before 1/h; 0.1 holds nearly as well and pollutes the motion much less.
!> Source: Flores et al. (2008), section 2.5 (table 2.3). Limits: made for fixed steps; with variable ones the gains follow.
module stabilisation_baumgarte_step
   use stabilisation, only: stabilisation_t, option_number
   use item, only: option_t
   use kind_info, only: add_number, dim_none, kind_info_t
   use kinds, only: wp
   use linkage, only: linkage_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: stabilisation_baumgarte_step_t

   !> Gains over the step.
   type, extends(stabilisation_t) :: stabilisation_baumgarte_step_t
      real(wp) :: alpha = 1.0_wp           !! factor of the gain on the rate of violation [1]
      real(wp) :: beta = sqrt(2.0_wp)      !! factor of the gain on the violation [1]
   contains
      procedure, nopass :: info => step_info
      procedure, nopass :: needs_fixed_step => step_needs_fixed_step
      procedure :: words => step_words
      procedure :: configure => step_configure
      procedure :: begin_step => step_begin_step
   end type stabilisation_baumgarte_step_t

contains

   !> Description of the method.
   function step_info() result(info)
      type(kind_info_t) :: info  !! name, help, options

      info%name = "baumgarte_step"
      info%help = "gains alpha/h and beta/h from the step h"
      info%source = "Flores et al. (2008), section 2.5, table 2.3"
      call add_number(info, "alpha", dim_none, "gain on the rate of violation, times the step", default="", lower=0.0_wp)
      call add_number(info, "beta", dim_none, "gain on the violation, times the step", default="", lower=0.0_wp)
   end function step_info

   !> The gains would force ever smaller variable steps.
   pure logical function step_needs_fixed_step() result(needs_step)
      needs_step = .true.
   end function step_needs_fixed_step

   !> What is done, as text.
   function step_words(self) result(words)
      class(stabilisation_baumgarte_step_t), intent(in) :: self  !! the stabilisation method
      character(:), allocatable :: words                !! as in a deck

      words = self%name()//" alpha="//to_text(self%alpha)//" beta="//to_text(self%beta)
   end function step_words

   !> Take the factors of a deck.
   subroutine step_configure(self, options, tolerance)
      class(stabilisation_baumgarte_step_t), intent(inout) :: self  !! the stabilisation method
      type(option_t), intent(in) :: options(:)             !! (any) alpha, beta
      real(wp), intent(in) :: tolerance                    !! of the integrator [1]

      self%follows_step = .true.
      self%alpha = option_number(options, "alpha", self%alpha)
      self%beta = option_number(options, "beta", self%beta)
   end subroutine step_configure

   !> Gains of a step.
   subroutine step_begin_step(self, linkage, h)
      class(stabilisation_baumgarte_step_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage            !! the bodies and their rows
      real(wp), intent(in) :: h                            !! length of the step [s]

      call linkage%solution%set_gains(self%alpha/h, self%beta/h)
   end subroutine step_begin_step

end module stabilisation_baumgarte_step
