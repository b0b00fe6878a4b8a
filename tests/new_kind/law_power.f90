!> Power law: an elastic force of any exponent, for surfaces of which only a measured curve is known.
!>
!> F = K delta^n,   energy = K delta^(n+1)/(n+1)
!>
!> Source: Flores et al. (2008), eq. (3.2), with K and n from the deck. Limits: no energy is lost; K has no link to geometry.
module law_power
   use item, only: item_t
   use kind_info, only: add_number, dim_none, kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t
   use surfaces, only: surfaces_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: law_power_t

   !> Elastic force of any exponent.
   type, extends(normal_law_t) :: law_power_t
      real(wp) :: stiffness = 0.0_wp  !! K [N/m^n]
      real(wp) :: exponent = 1.0_wp   !! n [1]
   contains
      procedure, nopass :: info => power_info
      procedure :: prepare => power_prepare
      procedure :: fit => power_fit
      procedure :: force => power_force
      procedure :: potential => power_potential
      procedure :: description => power_description
   end type law_power_t

contains

   !> Description of the kind.
   function power_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.power"
      info%help = "elastic force of any exponent, F = K delta^n"
      info%source = "Flores et al. (2008), eq. (3.2)"
      call add_number(info, "stiffness", dim_none, "K in N/m^n", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "exponent", dim_none, "n", lower=1.0_wp)
   end function power_info

   !> Take the parameters.
   subroutine power_prepare(self, item)
      class(law_power_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item           !! the row

      self%name = item%name
      self%stiffness = item%number("stiffness")
      self%exponent = item%number("exponent")
   end subroutine power_prepare

   !> The same for all surfaces.
   subroutine power_fit(self, pair, parameters, message, help)
      class(law_power_t), intent(in) :: self                 !! the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) K, n, any depth [N/m^n, 1, m]
      character(:), allocatable, intent(out) :: message      !! empty: the law fits
      character(:), allocatable, intent(out) :: help         !! empty

      message = ""
      help = ""
      parameters = [self%stiffness, self%exponent, huge(1.0_wp), 0.0_wp]
   end subroutine power_fit

   !> Force of n contacts.
   pure subroutine power_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(law_power_t), intent(in) :: self                 !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate, of no effect [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset, of no effect [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) K, n [N/m^n, 1]
      real(wp), intent(out) :: f(n)                          !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate, zero [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force, all of it [N]

      f = parameters(1, :)*max(delta, 0.0_wp)**parameters(2, :)
      df_ddelta = 0.0_wp
      where (delta > 0.0_wp) df_ddelta = parameters(2, :)*f/delta
      df_drate = 0.0_wp
      f_elastic = f
   end subroutine power_force

   !> Elastic energy of one contact.
   pure function power_potential(self, delta, parameters) result(energy)
      class(law_power_t), intent(in) :: self               !! the law, all of whose parameters are the contact's
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) K, n [N/m^n, 1]
      real(wp) :: energy                                   !! energy stored [J]

      energy = parameters(1)*max(delta, 0.0_wp)**(parameters(2) + 1.0_wp)/(parameters(2) + 1.0_wp)
   end function power_potential

   !> The parameters as text.
   function power_description(self, parameters) result(words)
      class(law_power_t), intent(in) :: self               !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) K, n [N/m^n, 1]
      character(:), allocatable :: words                   !! for `gudgeon explain`

      words = "stiffness "//real_text(parameters(1), 6)//" N/m^"//real_text(parameters(2), 6)
   end function power_description

end module law_power
