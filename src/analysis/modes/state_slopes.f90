!> Derivatives of the right-hand side and of outputs along changes of the state, by central differences of sixth order.
!>
!> A step moves no body by more than a thousandth of the size of the bodies or of a radian, and no surface by more than a hundredth
!> of the penetration of a contact that touches; where films act nothing moves by more than a hundredth of the smallest gap. Rates
!> likewise, over the time of a radian. Where friction acts rates move less, so that its laws are met near rest.
!> Source: Fornberg, Math. Comp. 51 (1988) 699-706 (weights). Limits: a law that has a kink at the state gives the mean of both
!> sides.
module state_slopes
   use catalogue, only: catalogue_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use mechanism_report, only: report_evaluated
   use motion_frame, only: motion_frame_t, stencil, stencil_weight
   implicit none (type, external)
   private
   public :: slopes_t

   real(wp), parameter :: part = 1.0e-3_wp            !! displacement, of the size of the bodies or a radian [1]
   real(wp), parameter :: part_of_gap = 1.0e-2_wp     !! displacement of surfaces, of penetration or gap [1]
   real(wp), parameter :: min_gap = 1.0e-9_wp         !! gap that is never less, of the size of the bodies [1]
   real(wp), parameter :: slow = 1.0e-4_wp            !! rates with friction, of those without [1]

   !> Where derivatives are taken.
   type :: slopes_t
      real(wp) :: t = 0.0_wp                        !! time [s]
      real(wp), allocatable :: y(:)                 !! (n) state [any]
      real(wp) :: rate = 1.0_wp                     !! characteristic rate [1/s]
      logical :: has_friction = .false.             !! friction acts
      integer, allocatable :: place(:)              !! (outputs) places in the catalogue
   contains
      procedure :: begin
      procedure :: along
      procedure :: evaluate
      procedure :: report
   end type slopes_t

contains

   !> Take a state.
   subroutine begin(self, system, t, y, place)
      class(slopes_t), intent(inout) :: self          !! set
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      integer, intent(in) :: place(:)                 !! (outputs) places in the catalogue

      integer :: k

      self%t = t
      self%y = y
      self%place = place
      call system%linkage%set_motion(t, y)
      self%rate = max(1.0_wp, maxval(norm2(system%linkage%motion%omega, dim=1)))
      self%has_friction = system%friction%rubbing%n > 0 .or. system%friction%stick_slips%n_slip > 0 &
                          .or. system%friction%stick_slips%n_bristle > 0
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            self%has_friction = self%has_friction .or. (allocated(set%laws%friction) .and. set%n_touching > 0)
         end associate
      end do
   end subroutine begin

   !> The right-hand side and the outputs at a state. Status 0: done.
   subroutine evaluate(self, system, catalogue, y, ydot, outputs, status)
      class(slopes_t), intent(in) :: self                !! where
      type(mechanism_t), intent(inout) :: system         !! the system
      type(catalogue_t), intent(inout) :: catalogue      !! outputs are bound
      real(wp), intent(in) :: y(:)                       !! (n) state [any]
      real(wp), intent(inout) :: ydot(:)                 !! (n) its derivative [any]
      real(wp), intent(out) :: outputs(:)                !! (outputs) values [any]
      integer, intent(out) :: status                     !! 0: done

      call system%evaluate(self%t, y, ydot, status)
      outputs = 0.0_wp
      if (status == 0) call self%report(system, catalogue, y, ydot, outputs)
   end subroutine evaluate

   !> The outputs after an evaluation, perhaps with other accelerations.
   subroutine report(self, system, catalogue, y, ydot, outputs)
      class(slopes_t), intent(in) :: self                !! where
      type(mechanism_t), intent(inout) :: system         !! the system, evaluated
      type(catalogue_t), intent(inout) :: catalogue      !! outputs are bound
      real(wp), intent(in) :: y(:)                       !! (n) its state [any]
      real(wp), intent(in) :: ydot(:)                    !! (n) derivative of the state [any]
      real(wp), intent(out) :: outputs(:)                !! (outputs) values [any]

      outputs = 0.0_wp
      if (size(outputs) == 0) return
      call report_evaluated(system, self%t, y, ydot, 0.0_wp, catalogue)
      outputs = catalogue%values(self%place)
   end subroutine report

   !> Derivatives along a local displacement, a local change of the rates and a change of other states.
   subroutine along(self, system, catalogue, frame, x, w, others, slope, outputs, status)
      class(slopes_t), intent(in) :: self                !! where
      type(mechanism_t), intent(inout) :: system         !! the system
      type(catalogue_t), intent(inout) :: catalogue      !! outputs are bound
      type(motion_frame_t), intent(in) :: frame          !! for local changes
      real(wp), intent(in) :: x(:), w(:)                 !! (rates) displacements and changes of rates [any]
      real(wp), intent(in) :: others(:)                  !! (other states) their changes [any]
      real(wp), intent(out) :: slope(:)                  !! (local changes) of the right-hand side [any]
      real(wp), intent(out) :: outputs(:)                !! (outputs) their derivatives [any]
      integer, intent(out) :: status                     !! 0: done

      real(wp), dimension(size(self%y)) :: change, sum, ydot
      real(wp) :: step, values(size(outputs))
      integer :: i, last

      slope = 0.0_wp
      outputs = 0.0_wp
      sum = 0.0_wp
      ydot = 0.0_wp
      call frame%to_state(system, self%y, x, w, change)
      last = system%n - system%n_quadrature
      change(last - size(others) + 1:last) = others
      step = step_of(self, system, x, w, others)
      do i = 1, size(stencil)
         call self%evaluate(system, catalogue, self%y + stencil(i)*step*change, ydot, values, status)
         if (status /= 0) return
         sum = sum + stencil_weight(i)/step*ydot
         outputs = outputs + stencil_weight(i)/step*values
      end do
      call system%to_local(self%y, sum(:last), slope)
   end subroutine along

   !> Length of a step along a change.
   real(wp) function step_of(self, system, x, w, others) result(step)
      class(slopes_t), intent(in) :: self                !! where
      type(mechanism_t), intent(inout) :: system         !! the system
      real(wp), intent(in) :: x(:), w(:)                 !! (rates) displacements and changes of rates [any]
      real(wp), intent(in) :: others(:)                  !! (other states) their changes [any]

      real(wp), dimension(system%clearance_joints%n_contact) :: by_rates, by_shift, delta
      real(wp) :: gap, length, of_rates, of_shift, weights(system%n), widest
      integer :: i, k

      length = system%linkage%scales%length
      associate (scale => system%linkage%coordinates%scales(length, system%linkage%bodies%n))
         of_shift = maxval([0.0_wp, abs(x)/scale])
         of_rates = maxval([0.0_wp, abs(w)/scale])/self%rate
      end associate
      widest = 1.0_wp
      if (self%has_friction) of_rates = of_rates/slow
      call find_approach(self, system, x, delta, by_shift)
      call find_approach(self, system, w, delta, by_rates)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               if (.not. (set%contact(i)%is_touching .or. allocated(set%laws%films))) cycle
               associate (n => set%before%contacts + i)
                  gap = part_of_gap*max(abs(delta(n)), min_gap*length)
                  if (allocated(set%laws%films)) then
                     widest = max(widest, part*length/gap)
                  else
                     of_shift = max(of_shift, part*abs(by_shift(n))/gap)
                     of_rates = max(of_rates, part*abs(by_rates(n))/(gap*self%rate))
                  end if
               end associate
            end do
         end associate
      end do
      step = part/max(widest*of_shift, widest*of_rates, tiny(1.0_wp))
      if (size(others) == 0) return
      if (.not. any(abs(others) > 0.0_wp)) return
      call system%weights(self%y, weights)
      associate (last => system%n - system%n_quadrature)
         step = part/maxval(abs(others)/weights(last - size(others) + 1:last))
      end associate
   end function step_of

   !> Penetrations at the state, and their rates if bodies move by a local change per second.
   subroutine find_approach(self, system, x, delta, rate)
      class(slopes_t), intent(in) :: self                !! where
      type(mechanism_t), intent(inout) :: system         !! the system; left at another motion
      real(wp), intent(in) :: x(:)                       !! (rates) local change [any]
      real(wp), intent(out) :: delta(:)                  !! (contacts) penetrations [m]
      real(wp), intent(out) :: rate(:)                   !! (contacts) their rates [m/s]

      real(wp) :: change(size(self%y)), local(2*size(x) + size(self%y)), y(size(self%y))
      integer :: k

      delta = 0.0_wp
      rate = 0.0_wp
      if (size(delta) == 0) return
      local = 0.0_wp
      local(size(x) + 1:2*size(x)) = x
      associate (m => system%n - system%n_quadrature, nq => system%linkage%n_position)
         call system%from_local(self%y, local(:m - system%traits%n_turning), change(:m))
         y = self%y
         y(nq + 1:nq + size(x)) = change(nq + 1:nq + size(x))
      end associate
      call system%linkage%set_motion(self%t, y)
      do k = 1, size(system%clearance_joints%sets)
         call system%clearance_joints%sets(k)%set%gaps(system%linkage%motion, delta, rate)
      end do
   end subroutine find_approach

end module state_slopes
