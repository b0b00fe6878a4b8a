!> Baumgarte's stabilisation with gains that follow the violation, alpha = beta (critical damping).
!>
!> With e the maximum scaled violation at the start of a step and e_0 the target, the gain of the next step is
!>
!> alpha = min( 0.3/h, w, alpha_before sqrt(e/e_0) ), the root between 1/2 and 1 + alpha h, at most 2, alpha at least a
!> tenth of the mechanism's characteristic rate: it grows no faster than a violation can answer, and not at all when a step is tried
!> again:
!>
!> strong gains where the violation calls for them, weak ones that leave the motion alone elsewhere; never so strong that
!> gain times step endangers the integration, nor faster than the mechanism itself, whose maximum rate is w: beyond that
!> a violation as small as the tolerance would disturb the velocities by more than the tolerance. Lengths are scaled by the
!> size of the bodies. The option `target` is e_0; omitted it is the tolerance of the integrator.
!> Source: the idea, gains that follow the error at critical damping, is that of Chang and Nikravesh (1985), cited by Flores
!> et al. (2008), section 2.5; the rule is gudgeon's own. Limits: the target must be above round-off.
module stabilisation_baumgarte_adaptive
   use floors, only: min_stabilisation
   use stabilisation, only: stabilisation_t, option_number
   use item, only: option_t
   use kind_info, only: add_number, dim_none, kind_info_t
   use kinds, only: wp
   use archive, only: archive_t
   use linkage, only: linkage_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: stabilisation_baumgarte_adaptive_t

   real(wp), parameter :: most = 0.3_wp          !! gain times step [1]
   real(wp), parameter :: smallest = 1.0e-14_wp  !! target [1]

   !> A gain that follows.
   type, extends(stabilisation_t) :: stabilisation_baumgarte_adaptive_t
      real(wp) :: target = 1.0e-8_wp  !! scaled violation to be kept [1]
      real(wp) :: alpha = 5.0_wp      !! present gain [1/s]
      real(wp) :: worst = 0.0_wp      !! scaled violation when it was set [1]
   contains
      procedure, nopass :: info => adaptive_info
      procedure :: words => adaptive_words
      procedure :: configure => adaptive_configure
      procedure :: begin_step => adaptive_begin_step
      procedure :: save => adaptive_save
      procedure :: load => adaptive_load
   end type stabilisation_baumgarte_adaptive_t

contains

   !> Description of the method.
   function adaptive_info() result(info)
      type(kind_info_t) :: info  !! name, help, options

      info%name = "baumgarte_adaptive"
      info%help = "gains adapted to the constraint violation"
      info%source = "Chang and Nikravesh (1985), cited by Flores et al. (2008), section 2.5"
      call add_number(info, "target", dim_none, "scaled violation that the gains aim at", default="", lower=0.0_wp)
   end function adaptive_info

   !> What is done, as text.
   function adaptive_words(self) result(words)
      class(stabilisation_baumgarte_adaptive_t), intent(in) :: self  !! the stabilisation method
      character(:), allocatable :: words                    !! as in a deck

      words = self%name()//" target="//to_text(self%target)
   end function adaptive_words

   !> Take the target of a deck.
   subroutine adaptive_configure(self, options, tolerance)
      class(stabilisation_baumgarte_adaptive_t), intent(inout) :: self  !! the stabilisation method
      type(option_t), intent(in) :: options(:)                 !! (any) target
      real(wp), intent(in) :: tolerance                        !! of the integrator [1]

      self%follows_step = .true.
      self%target = max(smallest, option_number(options, "target", tolerance))
   end subroutine adaptive_configure

   !> The gain of a step.
   subroutine adaptive_begin_step(self, linkage, h)
      class(stabilisation_baumgarte_adaptive_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage                !! the bodies and their rows, last evaluated at the start of the step
      real(wp), intent(in) :: h                                !! length of the step, 0: not known yet [s]

      real(wp) :: rate, worst
      integer :: body

      if (linkage%rows%n_solve == 0) return
      worst = linkage%max_violation()
      ! the same violation again: the step is tried again, shorter, and a gain that grew as it shrinks would not let it succeed
      if (abs(worst - self%worst) > 0.0_wp) then
         self%alpha = self%alpha*min(1.0_wp + min(self%alpha*h, 1.0_wp), max(0.5_wp, sqrt(worst/self%target)))
      end if
      self%worst = worst
      rate = 0.0_wp
      do body = 1, linkage%bodies%n
         rate = max(rate, norm2(linkage%motion%v(:, body))/linkage%scales%length, maxval(abs(linkage%motion%omega(:, body))))
      end do
      self%alpha = min(self%alpha, rate)
      if (h > 0.0_wp) self%alpha = min(self%alpha, most/h)   ! 0: of a library that has yet to choose its first step
      self%alpha = max(self%alpha, min_stabilisation*linkage%scales%pace)
      call linkage%solution%set_gains(self%alpha, self%alpha)
   end subroutine adaptive_begin_step

   !> Write what the method remembers.
   subroutine adaptive_save(self, archive)
      class(stabilisation_baumgarte_adaptive_t), intent(in) :: self  !! the stabilisation method
      type(archive_t), intent(inout) :: archive                      !! the checkpoint

      call archive%put(self%alpha)
   end subroutine adaptive_save

   !> Read what the method remembers.
   subroutine adaptive_load(self, archive)
      class(stabilisation_baumgarte_adaptive_t), intent(inout) :: self  !! the stabilisation method
      type(archive_t), intent(inout) :: archive                         !! the checkpoint

      call archive%get(self%alpha)
   end subroutine adaptive_load

end module stabilisation_baumgarte_adaptive
