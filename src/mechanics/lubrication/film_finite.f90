!> Bearing of finite length, from a stored potential: quick, within 1 % of Reynolds' equation on a grid.
!>
!> F = mu L R^3/c^2 f(e/c, v/c; L/D),   v = e' - (w_J + w_B)/2 z x e,   f = -grad over v of Psi (`finite_bearing`)
!>
!> Pressures are not below zero; the film ruptures and forms again where it likes, with dp/dn = 0; no groove. F.v = -2 Psi <= 0.
!>
!> Signs: on the journal. Beyond eps_max the film has the shape of eps_max in the direction of e, and v as it is.
!> Source: fitted to the film on a grid (`reynolds_grid`). Limits: L/D from 1/4 to 4.
module film_finite
   use film_law, only: basic_parameters, film_bearing_t, film_law_t, film_motion_t, n_film_parameter, own_parameters, &
      parameter_clearance, parameter_eps_max
   use finite_bearing, only: finite_force, finite_weights, max_ratio, min_ratio, n_ratio
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: film_finite_t

   integer, parameter :: parameter_scale = own_parameters + 1          !! mu L R^3/c^2 [N.s]
   integer, parameter :: parameter_ratio = own_parameters + 2          !! L/D [1]
   integer, parameter :: first_weight = own_parameters + 3             !! polynomials of L/D [1]
   integer, parameter :: last_weight = first_weight + n_ratio - 1      !! the last of them [1]
   real(wp), parameter :: slack = 1.0e-9_wp                            !! of L/D at the ends of its range [1]

   !> A bearing of finite length.
   type, extends(film_law_t) :: film_finite_t
   contains
      procedure, nopass :: info => finite_info
      procedure :: prepare => finite_prepare
      procedure :: fit => finite_fit
      procedure :: force => film_finite_force
   end type film_finite_t

contains

   !> Description of the kind.
   function finite_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.finite"
      info%help = "bearing of finite length, L/D from 1/4 to 4, only positive pressure; fast, within 1 % of `grid`"
      info%source = "fitted to Reynolds' equation on a grid, see docs/theory/evidence/films.md"
      allocate (info%columns(0))
   end function finite_info

   !> A row without columns of its own.
   subroutine finite_prepare(self, item)
      class(film_finite_t), intent(inout) :: self  !! the film
      type(item_t), intent(in) :: item             !! the row

      self%name = item%name
   end subroutine finite_prepare

   !> Parameters for a bearing.
   subroutine finite_fit(self, bearing, parameters, message, help)
      class(film_finite_t), intent(in) :: self               !! the film
      type(film_bearing_t), intent(in) :: bearing            !! the bearing
      real(wp), intent(out) :: parameters(n_film_parameter)  !! (n_film_parameter) parameters [any]
      character(:), allocatable, intent(out) :: message      !! empty: L/D is within the table
      character(:), allocatable, intent(out) :: help         !! what would be right

      real(wp) :: ratio

      message = ""
      help = ""
      call basic_parameters(bearing, parameters)
      ratio = 0.5_wp*bearing%length/bearing%radius
      if (ratio < min_ratio*(1.0_wp - slack) .or. ratio > max_ratio*(1.0_wp + slack)) then
         message = "L/D = "//to_text(ratio)//" is outside the range of 'finite', 0.25 to 4"
         help = "shorter: short_exact, longer: long_exact, any length: grid"
         return
      end if
      parameters(parameter_scale) = bearing%viscosity*bearing%length*bearing%radius**3/bearing%clearance**2
      parameters(parameter_ratio) = ratio
      parameters(first_weight:last_weight) = finite_weights(ratio)
   end subroutine finite_fit

   !> Forces of n bearings.
   pure subroutine film_finite_force(self, n, motion, parameters, f)
      class(film_finite_t), intent(in) :: self                !! the film
      integer, intent(in) :: n                                !! number of bearings
      type(film_motion_t), intent(in) :: motion(n)            !! (n) their motion
      real(wp), intent(in) :: parameters(n_film_parameter, n) !! (n_film_parameter, n) from `fit` [any]
      real(wp), intent(out) :: f(2, n)                        !! (2, n) forces on the journals, world frame [N]

      real(wp) :: e(2), size_of_e, v(2)
      integer :: k

      do k = 1, n
         associate (p => parameters(:, k), half_speed => 0.5_wp*motion(k)%speed_sum)
            v(1) = (motion(k)%e_dot(1) + half_speed*motion(k)%e(2))/p(parameter_clearance)
            v(2) = (motion(k)%e_dot(2) - half_speed*motion(k)%e(1))/p(parameter_clearance)
            e = motion(k)%e/p(parameter_clearance)
            size_of_e = sqrt(e(1)*e(1) + e(2)*e(2))
            if (size_of_e > p(parameter_eps_max)) e = e*(p(parameter_eps_max)/size_of_e)
            call finite_force(p(parameter_ratio), p(first_weight:last_weight), e, v, f(:, k))
            f(:, k) = p(parameter_scale)*f(:, k)
         end associate
      end do
   end subroutine film_finite_force

end module film_finite
