!> The part of a state that constraints leave free, and states that belong to it.
!>
!> With C the derivative of the projection onto the constraints, of scaled components, as many components are chosen as C has
!> rank, by elimination with complete pivoting. The others follow from them.
!>
!> $$ z_k = y_{i_k}/s_{i_k}, \qquad B = \frac{\partial y}{\partial z}, \qquad B_{i_k, l} = s_{i_k} \delta_{kl} $$
module free_state
   use kinds, only: eps, wp
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: free_state_t

   real(wp), parameter :: beside = 1.0e-5_wp     !! differences, of the scales [1]
   real(wp), parameter :: no_pivot = 1.0e-4_wp   !! of C: nothing is left [1]
   integer, parameter :: most_projections = 100  !! of a state whose free components are given
   real(wp), parameter :: met = 4.0_wp*eps       !! error of a free component that is none, of 1 + |z| [1]

   !> The free components.
   type :: free_state_t
      integer, allocatable :: place(:)    !! (m) places of free components in the state
      real(wp), allocatable :: scale(:)   !! (m) their scales [any]
   contains
      procedure :: find => find_free
      procedure :: of => free_components
      procedure :: embed
      procedure :: basis => find_basis
      procedure :: keep
   end type free_state_t

contains

   !> Choose the free components at a state.
   subroutine find_free(self, system, y, status)
      class(free_state_t), intent(inout) :: self      !! set
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: y(:)                    !! (n) state at t = 0 [any]
      integer, intent(out) :: status                  !! 0: done

      real(wp), allocatable :: c(:, :), minus(:), plus(:), scale(:)
      integer :: at(2), k, l, n

      n = system%n - system%n_quadrature
      allocate (c(n, n), scale(system%n))
      call system%weights(y, scale)
      do k = 1, n
         plus = y
         minus = y
         plus(k) = y(k) + beside*scale(k)
         minus(k) = y(k) - beside*scale(k)
         call system%project_state(0.0_wp, plus, status)
         if (status == 0) call system%project_state(0.0_wp, minus, status)
         if (status /= 0) return
         c(:, k) = (plus(:n) - minus(:n))/(2.0_wp*beside*scale(:n))
      end do
      allocate (self%place(0))
      do k = 1, n
         at = maxloc(abs(c))
         if (abs(c(at(1), at(2))) < no_pivot) exit
         self%place = [self%place, at(1)]
         c(:, at(2)) = c(:, at(2))/c(at(1), at(2))
         do l = 1, n
            if (l /= at(2)) c(:, l) = c(:, l) - c(at(1), l)*c(:, at(2))
         end do
         c(:, at(2)) = 0.0_wp
         c(at(1), :) = 0.0_wp
      end do
      call sort(self%place)
      self%scale = scale(self%place)
      status = 0
   end subroutine find_free

   !> Sort places.
   pure subroutine sort(places)
      integer, intent(inout) :: places(:)     !! (m) sorted

      integer :: k, place

      do k = 2, size(places)
         place = places(k)
         places(k) = 0
         associate (behind => count(places(:k - 1) < place))
            places(behind + 2:k) = places(behind + 1:k - 1)
            places(behind + 1) = place
         end associate
      end do
   end subroutine sort

   !> Drop free components.
   subroutine keep(self, is_kept)
      class(free_state_t), intent(inout) :: self      !! fewer components
      logical, intent(in) :: is_kept(:)               !! (m) which remain

      self%place = pack(self%place, is_kept)
      self%scale = pack(self%scale, is_kept)
   end subroutine keep

   !> Free components of a state.
   pure function free_components(self, y) result(z)
      class(free_state_t), intent(in) :: self         !! which they are
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      real(wp) :: z(size(self%place))                 !! (m) over their scales [1]

      z = y(self%place)/self%scale
   end function free_components

   !> The state with given free components near a state.
   subroutine embed(self, system, z, y, status)
      class(free_state_t), intent(in) :: self         !! which they are
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: z(:)                    !! (m) free components, over their scales [1]
      real(wp), intent(inout) :: y(:)                 !! (n) a state nearby, then that asked for, at t = 0 [any]
      integer, intent(out) :: status                  !! 0: found

      integer :: k

      do k = 1, most_projections
         y(self%place) = z*self%scale
         call system%project_state(0.0_wp, y, status)
         if (status /= 0) return
         if (all(abs(self%of(y) - z) <= met*(1.0_wp + abs(z)))) return
      end do
      status = 1
   end subroutine embed

   !> Derivative of the state by its free components.
   subroutine find_basis(self, system, z, y, basis, status)
      class(free_state_t), intent(in) :: self         !! which they are
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: z(:)                    !! (m) free components, over their scales [1]
      real(wp), intent(in) :: y(:)                    !! (n) the state [any]
      real(wp), intent(out) :: basis(:, :)            !! (n, m) the derivative [any]
      integer, intent(out) :: status                  !! 0: found

      real(wp) :: minus(size(y)), plus(size(y)), x(size(z))
      integer :: k

      status = 0
      do k = 1, size(z)
         plus = y
         minus = y
         x = z
         x(k) = z(k) + beside
         call self%embed(system, x, plus, status)
         if (status /= 0) return
         x(k) = z(k) - beside
         call self%embed(system, x, minus, status)
         if (status /= 0) return
         basis(:, k) = (plus - minus)/(2.0_wp*beside)
         basis(self%place, k) = 0.0_wp
         basis(self%place(k), k) = self%scale(k)
      end do
   end subroutine find_basis

end module free_state
