!> The laws of cylinders: a penetration that is an explicit function of the force, inverted safely.
!>
!> delta = a F [ ln(B/F) + 1 ],   a = (sigma_i + sigma_j) / L
!>
!> B is what the members differ in. With d = delta/(a B) and the root w >= 1 of w - ln w = 1 - ln d:
!> F = delta / (a w),   dF/ddelta = 1 / (a (w - 1)),   energy = a F^2 (2 w - 1) / 4
!> (the integral of F ddelta). w is found by Newton's iteration from 1 + sqrt(2 u) + u, u = -ln d, which comes from
!> above and always converges. The formula turns back at delta = a B (two forces for each penetration): from nine
!> tenths of that the force continues along its tangent, which is beyond the law's range and reported as such.
!> With a restitution the force is F (1 + h rate/v0), h that of the law `exact`; without one nothing is lost.
!>
!> Source: Flores et al. (2008), eqs. (3.10), (3.11). Limits: parallel cylinders, penetration below 0.9 a B,
!> quasi-static contact. Against line contact in plane strain the formulas are 3.5 to 4.3 times too soft;
!> with sigma/pi in place of sigma (column sigma_pi) 1.25 to 1.6 times: the sources may have meant that.
module cylinder_family
   use hertz_family, only: add_restitution, damp
   use item, only: item_t
   use kind_info, only: add_flag, add_number, dim_length, kind_info_t
   use kinds, only: pi, wp
   use law_exact, only: exact_hysteresis
   use normal_law, only: n_law_parameter, normal_law_t, parameter_gentle
   use surfaces, only: shape_internal, surfaces_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: add_cylinder_columns, add_line_columns, check_cylinders, cylinder_family_t, prepare_cylinder, prepare_line

   real(wp), parameter :: range = 0.9_wp  !! part of a B up to which the law holds [1]

   !> Contact of a pin in a hole along a line.
   type, abstract, extends(normal_law_t) :: cylinder_family_t
      real(wp) :: length = 0.0_wp      !! length of contact, 0: that of the joint [m]
      real(wp) :: divisor = 1.0_wp     !! of the compliances: 1, or pi [1]
      real(wp) :: factor = 1.0_wp      !! of B, for members of which there are several forms [1]
      real(wp) :: hysteresis = 0.0_wp  !! damping factor h, 0: elastic [1]
   contains
      procedure(force_constant_interface), nopass, deferred :: force_constant
      procedure :: prepare => prepare_cylinder
      procedure :: fit => family_fit
      procedure :: force => family_force
      procedure :: potential => family_potential
      procedure :: description => family_description
   end type cylinder_family_t

   abstract interface
      !> The constant B of a member.
      pure function force_constant_interface(pair, length, sigma) result(b)
         import :: surfaces_t, wp
         implicit none (type, external)
         type(surfaces_t), intent(in) :: pair  !! radii and clearance
         real(wp), intent(in) :: length        !! length of contact [m]
         real(wp), intent(in) :: sigma         !! sum of the compliances [1/Pa]
         real(wp) :: b                         !! the force at which the law turns back [N]
      end function force_constant_interface
   end interface

contains

   !> The columns of all laws of cylinders.
   subroutine add_line_columns(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_number(info, "length", dim_length, "contact length along the axis; 0: that of the joint", &
                      default="0 m", lower=0.0_wp)
      call add_restitution(info, default="1")
   end subroutine add_line_columns

   !> The columns of members whose source leaves open what the compliances are.
   subroutine add_cylinder_columns(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_line_columns(info)
      call add_flag(info, "sigma_pi", "compliances of the materials divided by pi, closer to line contact", default="off")
   end subroutine add_cylinder_columns

   !> Take the parameters of `add_line_columns`: compliances over pi, as line contact has them.
   subroutine prepare_line(self, item)
      class(cylinder_family_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                 !! the row

      self%name = item%name
      self%length = item%number("length")
      self%hysteresis = exact_hysteresis(item%number("restitution"))
      self%divisor = pi
   end subroutine prepare_line

   !> Take the parameters of `add_cylinder_columns`.
   subroutine prepare_cylinder(self, item)
      class(cylinder_family_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                 !! the row

      call prepare_line(self, item)
      self%divisor = merge(pi, 1.0_wp, item%flag("sigma_pi"))
   end subroutine prepare_cylinder

   !> a, a B and the range, from the surfaces.
   subroutine family_fit(self, pair, parameters, message, help)
      class(cylinder_family_t), intent(in) :: self           !! the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) a, a B, range [m/N, m, m]
      character(:), allocatable, intent(out) :: message      !! what is wrong, empty: the law fits
      character(:), allocatable, intent(out) :: help         !! what would be right

      real(wp) :: length, sigma

      parameters = [1.0_wp, 1.0_wp, range, 0.0_wp]
      call check_cylinders(self%name, pair, self%length, length, message, help)
      if (message /= "") return
      sigma = (pair%sigma_i + pair%sigma_j)/self%divisor
      parameters(1) = sigma/length
      parameters(2) = parameters(1)*self%factor*self%force_constant(pair, length, sigma)
      parameters(3) = range*parameters(2)
   end subroutine family_fit

   !> What a law of a pin in a hole asks of a pair of surfaces, and the length of contact.
   subroutine check_cylinders(name, pair, own_length, length, message, help)
      character(*), intent(in) :: name                       !! of the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(in) :: own_length                     !! length that the law gives, 0: none [m]
      real(wp), intent(out) :: length                        !! length of contact [m]
      character(:), allocatable, intent(out) :: message      !! what is wrong, empty: the law fits
      character(:), allocatable, intent(out) :: help         !! what would be right

      length = pair%length
      if (own_length > 0.0_wp) length = own_length
      message = ""
      help = ""
      if (pair%shape /= shape_internal) then
         message = "law '"//name//"' is for a pin in a hole"
         help = "use a law of the Hertz family, or one for plane faces"
      else if (.not. length > 0.0_wp) then
         message = "law '"//name//"' needs the length of the bearing"
         help = "give column length in the row of the joint, or in that of the law"
      end if
   end subroutine check_cylinders

   !> Force of n contacts.
   pure subroutine family_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(cylinder_family_t), intent(in) :: self           !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) a, a B, range [m/N, m, m]
      real(wp), intent(out) :: f(n)                          !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force [N]

      real(wp) :: energy
      integer :: k

      do k = 1, n
         call invert(parameters(:, k), delta(k), f_elastic(k), df_ddelta(k), energy)
         call damp(self%hysteresis, delta(k), rate(k), impact_speed(k), parameters(parameter_gentle, k), f_elastic(k), f(k), &
                   df_ddelta(k), df_drate(k))
      end do
   end subroutine family_force

   !> Elastic energy of one contact.
   pure function family_potential(self, delta, parameters) result(energy)
      class(cylinder_family_t), intent(in) :: self         !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) a, a B, range [m/N, m, m]
      real(wp) :: energy                                   !! energy stored [J]

      real(wp) :: df_ddelta, f

      call invert(parameters, delta, f, df_ddelta, energy)
   end function family_potential

   !> The range as text.
   function family_description(self, parameters) result(words)
      class(cylinder_family_t), intent(in) :: self         !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) a, a B, range [m/N, m, m]
      character(:), allocatable :: words                   !! for `gudgeon explain`

      words = "valid for penetration up to "//real_text(1.0e3_wp*parameters(3), 6)//" mm"
      if (self%hysteresis > 0.0_wp) words = words//", damping factor h = "//real_text(self%hysteresis, 6)//" in 1 + h rate/v0"
   end function family_description

   !> Elastic force, its derivative and its potential; zero where delta is not positive.
   pure subroutine invert(parameters, delta, f, df_ddelta, energy)
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) a, a B, range [m/N, m, m]
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(out) :: f                           !! elastic force [N]
      real(wp), intent(out) :: df_ddelta                   !! its derivative [N/m]
      real(wp), intent(out) :: energy                      !! its potential [J]

      real(wp) :: beyond, w, within

      f = 0.0_wp
      df_ddelta = 0.0_wp
      energy = 0.0_wp
      if (.not. delta > 0.0_wp) return
      within = min(delta, parameters(3))
      beyond = delta - within
      w = root(within/parameters(2))
      f = within/(parameters(1)*w)
      df_ddelta = 1.0_wp/(parameters(1)*(w - 1.0_wp))
      energy = 0.25_wp*parameters(1)*f*f*(2.0_wp*w - 1.0_wp) + beyond*(f + 0.5_wp*df_ddelta*beyond)
      f = f + df_ddelta*beyond
   end subroutine invert

   !> The root w > 1 of w - ln w = 1 - ln d.
   pure real(wp) function root(d) result(w)
      real(wp), intent(in) :: d  !! penetration over its maximum, above 0, below 1 [1]

      real(wp), parameter :: close = 4.0_wp*epsilon(1.0_wp)  ! relative change that ends the iteration [1]
      integer, parameter :: most = 10                        ! iterations; four do
      real(wp) :: change, u
      integer :: k

      u = -log(d)
      w = 1.0_wp + sqrt(2.0_wp*u) + u
      do k = 1, most
         change = (w - log(w) - 1.0_wp - u)*w/(w - 1.0_wp)
         w = w - change
         if (abs(change) <= close*w) exit
      end do
   end function root

end module cylinder_family
