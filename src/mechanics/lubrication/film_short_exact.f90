!> Infinitely short bearing, the film where its pressure is positive: exact.
!>
!> p = 3 mu/c^2 (L^2/4 - z^2) [ w sin(theta) - 2 eps' cos(theta) ]/(1 + eps cos(theta))^3 > 0 on (theta_1, theta_1 + pi)
!> f_r = 1/2 (w I11 - 2 eps' I02),   f_t = 1/2 (w I20 - 2 eps' I11),   theta_1 = atan2(2 eps', w)
!> I20 = [x/2 - sin(2x)/4]/q^(3/2),   I02 = [x/2 + sin(2x)/4 - 2 eps sin(x) + eps^2 x]/q^(5/2),   I11 = [sin(x)^2/2 + eps
!> cos(x)]/q^2
!>
!> with brackets between the ends x0 and x1 of the film in Sommerfeld's variable (`positive_part`).
!>
!> Signs: on the journal, n from the bearing's centre to the journal's, t = z x n; w = eps Om, q = 1 - eps^2.
!> Source: Flores et al. (2008), eq. (5.3), integrated with the integrals of J. F. Booker, A table of the journal-bearing integral,
!> J. Basic Engineering 87 (1965) 533-535. Limits: L/D below about 1/2, where the force is still too large. Smooth once, always
!> dissipative, the same in all directions for e -> 0.
module film_short_exact
   use closed_film, only: positive_part, short_film_t, short_shape
   use film_law, only: n_film_parameter
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: film_short_exact_t

   !> A short bearing, its film where the pressure is positive.
   type, extends(short_film_t) :: film_short_exact_t
   contains
      procedure, nopass :: info => short_exact_info
      procedure :: components => short_exact_components
      procedure, nopass :: has_field => short_exact_has_field
      procedure :: shape => short_exact_shape
   end type film_short_exact_t

contains

   !> Description of the kind.
   function short_exact_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.short_exact"
      info%help = "infinitely short bearing, only positive pressure; exact"
      info%source = "Flores et al. (2008), eq. (5.3), integrated where it is positive"
      allocate (info%columns(0))
   end function short_exact_info

   !> Components of the force over its scale.
   pure subroutine short_exact_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_short_exact_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: cosine(2), i02, i11, i20, per_q, product, q, root, sine(2), step_sine, width

      f_r = 0.0_wp
      f_t = 0.0_wp
      if (.not. w*w + eps_dot*eps_dot > sqrt(tiny(1.0_wp))) return
      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      call positive_part(eps, root, w, 2.0_wp*eps_dot, sine, cosine, width)
      step_sine = sine(2) - sine(1)
      product = sine(2)*cosine(2) - sine(1)*cosine(1)
      per_q = 1.0_wp/q
      i20 = 0.5_wp*(width - product)*root*per_q**2
      i02 = (0.5_wp*(width + product) - 2.0_wp*eps*step_sine + eps*eps*width)*root*per_q**3
      i11 = (0.5_wp*(sine(2)**2 - sine(1)**2) + eps*(cosine(2) - cosine(1)))*per_q**2
      f_r = 0.5_wp*(w*i11 - 2.0_wp*eps_dot*i02)
      f_t = 0.5_wp*(w*i20 - 2.0_wp*eps_dot*i11)
   end subroutine short_exact_components

   !> It has pressures.
   pure logical function short_exact_has_field() result(has)
      has = .true.
   end function short_exact_has_field

   !> The pressure around the bearing.
   pure real(wp) function short_exact_shape(self, eps, eps_dot, w, theta) result(shape)
      class(film_short_exact_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap, 0 to 2 pi [rad]

      shape = max(short_shape(eps, eps_dot, w, theta), 0.0_wp)
   end function short_exact_shape

end module film_short_exact
