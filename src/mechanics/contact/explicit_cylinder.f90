!> Laws of a pin in a hole that give the force as a function of the penetration.
!>
!> F = F_elastic(delta) (1 + h rate / v0),   energy = integral of F_elastic ddelta
!>
!> A member gives F_elastic and its potential from constants that it fits to the surfaces. With a restitution h is that of the law
!> `exact`, unless the member has its own; without one nothing is lost. Beyond a maximum penetration that a member may have
!> the force continues along its tangent, which is reported as out of the law's range.
!> Source: the members. Limits: parallel cylinders, quasi-static contact.
module explicit_cylinder
   use cylinder_family, only: check_cylinders
   use hertz_family, only: damp
   use item, only: item_t
   use kinds, only: wp
   use law_exact, only: exact_hysteresis
   use normal_law, only: n_law_parameter, normal_law_t, parameter_deepest, parameter_gentle
   use surfaces, only: surfaces_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: explicit_cylinder_t

   !> Contact of a pin in a hole.
   type, abstract, extends(normal_law_t) :: explicit_cylinder_t
      real(wp) :: length = 0.0_wp      !! length of contact, 0: that of the joint [m]
      real(wp) :: hysteresis = 0.0_wp  !! damping factor h, 0: elastic [1]
   contains
      procedure(constants_interface), deferred :: find_constants
      procedure(elastic_interface), nopass, deferred :: elastic
      procedure(stored_interface), nopass, deferred :: stored
      procedure :: prepare => explicit_prepare
      procedure :: fit => explicit_fit
      procedure :: force => explicit_force
      procedure :: potential => explicit_potential
      procedure :: description => explicit_description
   end type explicit_cylinder_t

   abstract interface
      !> The constants of a member, or why it does not match.
      subroutine constants_interface(self, clearance, length, modulus, parameters, message, help)
         import :: explicit_cylinder_t, n_law_parameter, wp
         implicit none (type, external)
         class(explicit_cylinder_t), intent(in) :: self           !! the law
         real(wp), intent(in) :: clearance                        !! of the radii, c [m]
         real(wp), intent(in) :: length                           !! of contact, L [m]
         real(wp), intent(in) :: modulus                          !! of both surfaces, E = 1/(sigma_i + sigma_j) [Pa]
         real(wp), intent(inout) :: parameters(n_law_parameter)   !! (n_law_parameter) two constants, maximum penetration [any]
         character(:), allocatable, intent(inout) :: message      !! what is wrong, empty: the law fits
         character(:), allocatable, intent(inout) :: help         !! what would be right
      end subroutine constants_interface

      !> Elastic force and its derivative, for a penetration in the range of the law.
      pure subroutine elastic_interface(parameters, delta, f, df_ddelta)
         import :: n_law_parameter, wp
         implicit none (type, external)
         real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants [any]
         real(wp), intent(in) :: delta                        !! penetration, above 0 [m]
         real(wp), intent(out) :: f                           !! elastic force [N]
         real(wp), intent(out) :: df_ddelta                   !! its derivative [N/m]
      end subroutine elastic_interface

      !> Its potential.
      pure real(wp) function stored_interface(parameters, delta) result(energy)
         import :: n_law_parameter, wp
         implicit none (type, external)
         real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants [any]
         real(wp), intent(in) :: delta                        !! penetration, above 0 [m]
      end function stored_interface
   end interface

contains

   !> Take the columns of `add_line_columns`.
   subroutine explicit_prepare(self, item)
      class(explicit_cylinder_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                   !! the row

      self%name = item%name
      self%length = item%number("length")
      self%hysteresis = exact_hysteresis(item%number("restitution"))
   end subroutine explicit_prepare

   !> The constants, from the surfaces.
   subroutine explicit_fit(self, pair, parameters, message, help)
      class(explicit_cylinder_t), intent(in) :: self         !! the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) constants, range [any]
      character(:), allocatable, intent(out) :: message      !! what is wrong, empty: the law fits
      character(:), allocatable, intent(out) :: help         !! what would be right

      real(wp) :: length

      parameters = [1.0_wp, 1.0_wp, huge(1.0_wp), 0.0_wp]
      call check_cylinders(self%name, pair, self%length, length, message, help)
      if (message /= "") return
      call self%find_constants(pair%clearance, length, 1.0_wp/(pair%sigma_i + pair%sigma_j), parameters, message, help)
   end subroutine explicit_fit

   !> Force of n contacts.
   pure subroutine explicit_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(explicit_cylinder_t), intent(in) :: self         !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) constants, range [any]
      real(wp), intent(out) :: f(n)                          !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force [N]

      real(wp) :: within
      integer :: k

      do k = 1, n
         if (delta(k) > 0.0_wp) then
            within = min(delta(k), parameters(parameter_deepest, k))
            call self%elastic(parameters(:, k), within, f_elastic(k), df_ddelta(k))
            f_elastic(k) = f_elastic(k) + df_ddelta(k)*(delta(k) - within)
            call damp(self%hysteresis, delta(k), rate(k), impact_speed(k), parameters(parameter_gentle, k), f_elastic(k), f(k), &
                      df_ddelta(k), df_drate(k))
         else
            f(k) = 0.0_wp
            df_ddelta(k) = 0.0_wp
            df_drate(k) = 0.0_wp
            f_elastic(k) = 0.0_wp
         end if
      end do
   end subroutine explicit_force

   !> Elastic energy of one contact.
   pure function explicit_potential(self, delta, parameters) result(energy)
      class(explicit_cylinder_t), intent(in) :: self       !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants, range [any]
      real(wp) :: energy                                   !! energy stored [J]

      real(wp) :: beyond, df_ddelta, f, within

      energy = 0.0_wp
      if (.not. delta > 0.0_wp) return
      within = min(delta, parameters(parameter_deepest))
      energy = self%stored(parameters, within)
      beyond = delta - within
      if (.not. beyond > 0.0_wp) return
      call self%elastic(parameters, within, f, df_ddelta)
      energy = energy + beyond*(f + 0.5_wp*df_ddelta*beyond)
   end function explicit_potential

   !> Range and damping as text.
   function explicit_description(self, parameters) result(words)
      class(explicit_cylinder_t), intent(in) :: self       !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants, range [any]
      character(:), allocatable :: words                   !! for `gudgeon explain`

      words = "valid for any penetration"
      if (parameters(parameter_deepest) < huge(1.0_wp)) then
         words = "valid for penetration up to "//real_text(1.0e3_wp*parameters(parameter_deepest), 6)//" mm"
      end if
      if (self%hysteresis > 0.0_wp) words = words//", damping factor h = "//real_text(self%hysteresis, 6)//" in 1 + h rate/v0"
   end function explicit_description

end module explicit_cylinder
