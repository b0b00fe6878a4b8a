!> Stages of a step of Radau IIA, and what they say of those of another.
module radau_stages
   use kinds, only: eps, wp
   use radau_products, only: c
   implicit none (type, external)
   private
   public :: extrapolate, stages_t

   !> Stages of a step.
   type :: stages_t
      real(wp) :: t = 0.0_wp               !! its start [s]
      real(wp) :: h = 0.0_wp               !! its length, 0: there are none [s]
      real(wp), allocatable :: z(:, :)     !! (n, 3) changes of the state, without quadratures [any]
   end type stages_t

contains

   !> Where the iteration starts: on the polynomial through stages of a step that ends, or starts, where this one starts; else on
   !> the tangent there, which friction that starts to slide has its direction from.
   pure subroutine extrapolate(stages, t, h, f0, z)
      type(stages_t), intent(in) :: stages  !! the stages
      real(wp), intent(in) :: t             !! start of the step in hand [s]
      real(wp), intent(in) :: h             !! its length [s]
      real(wp), intent(in) :: f0(:)         !! (all) derivative there [any]
      real(wp), intent(out) :: z(:, :)      !! (n, 3) changes of the state at its stages [any]

      real(wp) :: p(3), s
      integer :: i, k
      logical :: goes_on

      goes_on = stages%t < t
      if (.not. stages%h > 0.0_wp .or. abs(merge(stages%t + stages%h, stages%t, goes_on) - t) > 4.0_wp*eps*abs(t)) then
         do k = 1, 3
            z(:, k) = c(k)*h*f0(:size(z, 1))
         end do
         return
      end if
      do k = 1, 3
         s = c(k)*h/stages%h + merge(1.0_wp, 0.0_wp, goes_on)
         p(1) = s*(s - c(2))*(s - c(3))/(c(1)*(c(1) - c(2))*(c(1) - c(3)))
         p(2) = s*(s - c(1))*(s - c(3))/(c(2)*(c(2) - c(1))*(c(2) - c(3)))
         p(3) = s*(s - c(1))*(s - c(2))/(c(3)*(c(3) - c(1))*(c(3) - c(2)))
         if (goes_on) p(3) = p(3) - 1.0_wp
         do i = 1, size(z, 1)
            z(i, k) = p(1)*stages%z(i, 1) + p(2)*stages%z(i, 2) + p(3)*stages%z(i, 3)
         end do
      end do
   end subroutine extrapolate

end module radau_stages
