!> Infinitely long bearing, the film where its pressure is positive, with p = 0 at theta = +-90 degrees: exact.
!>
!> p = 6 mu (R/c)^2 (2 + eps cos(theta))/(1 + eps cos(theta))^2 [ a sin(theta) - eps' cos(theta) ] > 0 on (theta_1, theta_1 + pi)
!> f_r = -6 (a/q [sin(x)^2 - eps cos(x)] + 2 eps'/q^(3/2) [x/2 - sin(2x)/4]),   a = w/(2 + eps^2)
!> f_t = 6 (a/q^(3/2) [q x - eps sin(x) + sin(x) cos(x)] + 2 eps'/q^2 [sin(x)^2/2 + eps cos(x)]),   theta_1 = atan2(eps', a)
!>
!> with brackets between the ends x0 and x1 of the film in Sommerfeld's variable (`positive_part`).
!>
!> Signs: on the journal, n from the bearing's centre to the journal's, t = z x n; w = eps Om, q = 1 - eps^2.
!> Source: Flores et al. (2008), eq. (5.5) with the reference pressure of (5.21), integrated where it is positive. Limits: L/D above
!> about 2, where the force is still too large. Smooth once, always dissipative, the same in all directions for e -> 0.
module film_long_exact
   use closed_film, only: long_film_t, long_shape, positive_part
   use film_law, only: n_film_parameter
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: film_long_exact_t

   !> A long bearing, its film where the pressure is positive.
   type, extends(long_film_t) :: film_long_exact_t
   contains
      procedure, nopass :: info => long_exact_info
      procedure :: components => long_exact_components
      procedure, nopass :: has_field => long_exact_has_field
      procedure :: shape => long_exact_shape
   end type film_long_exact_t

contains

   !> Description of the kind.
   function long_exact_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.long_exact"
      info%help = "infinitely long bearing, only positive pressure; exact"
      info%source = "Flores et al. (2008), eq. (5.5), integrated where it is positive"
      allocate (info%columns(0))
   end function long_exact_info

   !> Components of the force over its scale.
   pure subroutine long_exact_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_long_exact_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: a, cosine(2), per_q, product, q, root, sine(2), step_cosine, step_square, width

      f_r = 0.0_wp
      f_t = 0.0_wp
      if (.not. w*w + eps_dot*eps_dot > sqrt(tiny(1.0_wp))) return
      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      a = w/(2.0_wp + eps*eps)
      call positive_part(eps, root, a, eps_dot, sine, cosine, width)
      step_cosine = cosine(2) - cosine(1)
      step_square = sine(2)**2 - sine(1)**2
      product = sine(2)*cosine(2) - sine(1)*cosine(1)
      per_q = 1.0_wp/q
      f_r = -6.0_wp*per_q*(a*(step_square - eps*step_cosine) + eps_dot*(width - product)*root*per_q)
      f_t = 6.0_wp*(a*(q*width - eps*(sine(2) - sine(1)) + product)*root*per_q**2 &
                    + eps_dot*(step_square + 2.0_wp*eps*step_cosine)*per_q**2)
   end subroutine long_exact_components

   !> It has pressures.
   pure logical function long_exact_has_field() result(has)
      has = .true.
   end function long_exact_has_field

   !> The pressure around the bearing.
   pure real(wp) function long_exact_shape(self, eps, eps_dot, w, theta) result(shape)
      class(film_long_exact_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap, 0 to 2 pi [rad]

      shape = max(long_shape(eps, eps_dot, w, theta), 0.0_wp)
   end function long_exact_shape

end module film_long_exact
