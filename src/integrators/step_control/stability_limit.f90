!> Whether the steps of an explicit method are as long as its stability allows, and no longer for accuracy's sake.
!>
!> Two states at the end of a step, the one that the last stage was evaluated at and the one that the step gives, differ mostly in
!> what decays or swings fastest. The difference of their derivatives over their own is an estimate of its rate
!>
!> $$ \rho = \| f(y_1) - f(g_s) \| / \| y_1 - g_s \| $$
!>
!> over the error scales. Where h rho is near the bound of stability in step after step, the equations are stiff for the method.
!> Steps of an error control may come no nearer than half of it: eigenvalues lie beside the real axis, or the error estimate grows
!> first.
!>
!> Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.2 (stiffness detection).
!> Limits: an estimate from below where something slow makes up the difference.
module stability_limit
   use kinds, only: i8, wp
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: rate_between, stability_limit_t

   integer, parameter :: look_every = 8          !! steps from one look to the next, where nothing is near the bound
   integer, parameter :: enough = 25             !! looks near the bound that make the equations stiff
   integer, parameter :: calm = 6                !! looks in a row below, after which they are not
   integer, parameter :: most = 1000000          !! looks that are counted
   real(wp), parameter :: near = 0.5_wp          !! of the bound [1]

   !> What was seen of an explicit method's steps.
   type :: stability_limit_t
      real(wp) :: bound = 0.0_wp             !! h rho up to which the method is stable; 0: it is not explicit [1]
      logical :: is_watched = .false.        !! whether steps are looked at
      logical :: is_stiff = .false.          !! whether stability keeps the steps short
      integer :: pause = look_every          !! steps until the next look
      integer :: n_near = 0                  !! looks near the bound in this stretch of steps
      integer :: n_below = 0                 !! looks below since the last of them
      real(wp) :: t_from = 0.0_wp            !! where the stretch started [s]
      real(wp) :: product = 0.0_wp           !! h rho at the last look [1]
      ! over the run
      integer(i8) :: n_step = 0              !! steps that stability kept short
      real(wp) :: time = 0.0_wp              !! their lengths together [s]
      real(wp) :: t_first = -1.0_wp          !! where the first stretch of them started; negative: there was none [s]
   contains
      procedure :: is_due
      procedure :: note
      procedure :: forget
      procedure :: save => save_limit
      procedure :: load => load_limit
   end type stability_limit_t

contains

   !> Rate at which a difference of two states changes; zero where there is none.
   pure real(wp) function rate_between(n, y_a, f_a, y_b, f_b, scale) result(rate)
      integer, intent(in) :: n           !! entries that count
      real(wp), intent(in) :: y_a(:)     !! (n or more) a state [any]
      real(wp), intent(in) :: f_a(:)     !! (n or more) its derivative [any]
      real(wp), intent(in) :: y_b(:)     !! (n or more) another state [any]
      real(wp), intent(in) :: f_b(:)     !! (n or more) its derivative [any]
      real(wp), intent(in) :: scale(:)   !! (n or more) what the entries are measured by [any]

      real(wp) :: above, below
      integer :: i

      above = 0.0_wp
      below = 0.0_wp
      do i = 1, n
         above = above + ((f_b(i) - f_a(i))/scale(i))**2
         below = below + ((y_b(i) - y_a(i))/scale(i))**2
      end do
      rate = 0.0_wp
      if (below > 0.0_wp) rate = sqrt(above/below)
   end function rate_between

   !> Whether the step just made is to be looked at.
   logical function is_due(self)
      class(stability_limit_t), intent(inout) :: self   !! what was seen

      self%pause = self%pause - 1
      is_due = self%pause <= 0
   end function is_due

   !> A look at a step.
   pure subroutine note(self, h, rate, t)
      class(stability_limit_t), intent(inout) :: self   !! what was seen
      real(wp), intent(in) :: h                   !! length of the step [s]
      real(wp), intent(in) :: rate                !! the fastest rate in it [1/s]
      real(wp), intent(in) :: t                   !! time at its end [s]

      self%product = h*rate
      if (self%product > near*self%bound) then
         if (self%n_near == 0) self%t_from = t
         self%n_near = min(self%n_near + 1, most)
         self%n_below = 0
         self%is_stiff = self%n_near >= enough
      else
         self%n_below = self%n_below + 1
         if (self%n_below >= calm) call self%forget()
      end if
      self%pause = merge(1, look_every, self%n_near > 0)
      if (.not. self%is_stiff) return
      if (self%t_first < 0.0_wp) self%t_first = self%t_from
      self%n_step = self%n_step + 1
      self%time = self%time + h
   end subroutine note

   !> A new stretch starts.
   pure subroutine forget(self)
      class(stability_limit_t), intent(inout) :: self   !! what was seen

      self%is_stiff = .false.
      self%n_near = 0
      self%n_below = 0
      self%pause = look_every
   end subroutine forget

   !> Write what was seen.
   subroutine save_limit(self, archive)
      class(stability_limit_t), intent(in) :: self  !! what was seen
      type(archive_t), intent(inout) :: archive     !! the checkpoint

      call archive%put(self%is_watched)
      call archive%put(self%is_stiff)
      call archive%put(self%pause)
      call archive%put(self%n_near)
      call archive%put(self%n_below)
      call archive%put(self%t_from)
      call archive%put(self%product)
      call archive%put(self%n_step)
      call archive%put(self%time)
      call archive%put(self%t_first)
   end subroutine save_limit

   !> Read it.
   subroutine load_limit(self, archive)
      class(stability_limit_t), intent(inout) :: self  !! what was seen
      type(archive_t), intent(inout) :: archive        !! the checkpoint

      call archive%get(self%is_watched)
      call archive%get(self%is_stiff)
      call archive%get(self%pause)
      call archive%get(self%n_near)
      call archive%get(self%n_below)
      call archive%get(self%t_from)
      call archive%get(self%product)
      call archive%get(self%n_step)
      call archive%get(self%time)
      call archive%get(self%t_first)
   end subroutine load_limit

end module stability_limit
