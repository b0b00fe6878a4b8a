!> The family of Hertz's law: an elastic force with hysteresis damping, and what its members share.
!>
!> F_N = K delta^n ( 1 + h rate / v0 ),   n = 3/2, v0 the impact speed;   energy = K delta^(n+1) / (n+1)
!>
!> The members differ in h as a function of the coefficient of restitution ce. The force is cut off at zero, and v0 is not less
!> than a tenth of the speed of the depth in the damping term (`normal_law`), which two free bodies never reach. They show a
!> restitution e that is not ce, whatever the elastic force, the masses and the speed: h(1+e) = ln[(1+h)/(1-h e)].
!>
!> Source: Flores et al. (2008), section 3.2. Limits: quasi-static contact: impact speeds below
!> 0.02 sqrt(E/rho), see `elastic_waves`.
module hertz_family
   use deep_damping, only: damp_all_deep, damp_deep
   use item, only: find_place, item_t
   use kind_info, only: add_number, dim_contact_stiffness, dim_none, kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t, parameter_gentle
   use stiffness, only: curved_stiffness
   use surfaces, only: surfaces_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: add_elastic_columns, add_restitution, damp, elastic_force, elastic_potential, hertz_family_t

   !> Contact of curved surfaces with hysteresis damping.
   type, abstract, extends(normal_law_t) :: hertz_family_t
      real(wp) :: stiffness = 0.0_wp  !! given contact stiffness, 0: from the geometry [N/m^1.5]
   contains
      procedure(hysteresis_interface), nopass, deferred :: hysteresis_of
      procedure :: prepare => family_prepare
      procedure :: fit => family_fit
      procedure :: force => family_force
      procedure :: potential => family_potential
      procedure :: description => family_description
   end type hertz_family_t

   abstract interface
      !> The factor h of a member.
      pure function hysteresis_interface(restitution) result(h)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: restitution  !! coefficient of restitution ce, above 0, at most 1 [1]
         real(wp) :: h                        !! factor of rate/v0, not negative [1]
      end function hysteresis_interface
   end interface

contains

   !> The columns of laws with an elastic part K delta^n.
   subroutine add_elastic_columns(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_number(info, "stiffness", dim_contact_stiffness, "contact stiffness; 0: from radii and materials", &
                      default="0 N/m^1.5", lower=0.0_wp)
   end subroutine add_elastic_columns

   !> The column of the coefficient of restitution.
   subroutine add_restitution(info, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in), optional :: default  !! absent: required

      call add_number(info, "restitution", dim_none, "coefficient of restitution ce", default=default, &
                      lower=0.0_wp, upper=1.0_wp, open_lower=.true.)
   end subroutine add_restitution

   !> Take the parameters: the columns of `add_elastic_columns` and, of members that lose energy, `add_restitution`.
   subroutine family_prepare(self, item)
      class(hertz_family_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item              !! the row

      self%name = item%name
      self%stiffness = item%number("stiffness")
      if (find_place(item, "restitution") > 0) self%hertz_damping = self%hysteresis_of(item%number("restitution"))
   end subroutine family_prepare

   !> Stiffness: given, or from the surfaces.
   subroutine family_fit(self, pair, parameters, message, help)
      class(hertz_family_t), intent(in) :: self              !! the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) stiffness, 0, any depth, 0 [any]
      character(:), allocatable, intent(out) :: message      !! what is wrong, empty: the law fits
      character(:), allocatable, intent(out) :: help         !! what would be right

      message = ""
      help = ""
      parameters = [self%stiffness, 0.0_wp, huge(1.0_wp), 0.0_wp]
      if (self%stiffness > 0.0_wp) return
      parameters(1) = curved_stiffness(pair)
      if (parameters(1) > 0.0_wp) return
      message = "law '"//self%name//"' gives no stiffness for contact of plane faces"
      help = "set its column stiffness, or use a law for plane faces"
   end subroutine family_fit

   !> Force of n contacts.
   pure subroutine family_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(hertz_family_t), intent(in) :: self              !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) stiffness first [N/m^1.5]
      real(wp), intent(out) :: f(n)                          !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force [N]

      integer :: k
      logical :: any_deep, is_deep

      any_deep = .false.
      do k = 1, n
         call press_hertz(self%hertz_damping, delta(k), rate(k), impact_speed(k), parameters(:, k), f(k), df_ddelta(k), &
                          df_drate(k), f_elastic(k), is_deep)
         any_deep = any_deep .or. is_deep
      end do
      if (any_deep) then
         call damp_all_deep(self%hertz_damping, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      end if
   end subroutine family_force

   !> Elastic energy of one contact.
   pure function family_potential(self, delta, parameters) result(energy)
      class(hertz_family_t), intent(in) :: self            !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) stiffness first [N/m^1.5]
      real(wp) :: energy                                   !! energy stored [J]

      energy = elastic_potential(parameters(1), delta)
   end function family_potential

   !> The stiffness as text.
   function family_description(self, parameters) result(words)
      class(hertz_family_t), intent(in) :: self            !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) stiffness first [N/m^1.5]
      character(:), allocatable :: words                   !! for `gudgeon explain`

      words = "stiffness "//real_text(parameters(1), 6)//" N/m^1.5"
      if (self%hertz_damping > 0.0_wp) words = words//", damping factor h = "//real_text(self%hertz_damping, 6)//" in 1 + h rate/v0"
   end function family_description

   include "hertz_force.inc"

   !> The potential K delta^2.5 / 2.5 of that force.
   elemental real(wp) function elastic_potential(stiffness, delta) result(energy)
      real(wp), intent(in) :: stiffness   !! contact stiffness [N/m^1.5]
      real(wp), intent(in) :: delta       !! penetration [m]

      energy = 0.4_wp*stiffness*sqrt(max(delta, 0.0_wp))*max(delta, 0.0_wp)**2
   end function elastic_potential

   !> Hysteresis damping of any elastic force: F = F_elastic ( 1 + h rate / v0 ), cut off at zero; v0 as `normal_law` has it.
   elemental subroutine damp(hysteresis, delta, rate, impact_speed, gently, f_elastic, f, df_ddelta, df_drate)
      real(wp), intent(in) :: hysteresis     !! h [1]
      real(wp), intent(in) :: delta          !! penetration [m]
      real(wp), intent(in) :: rate           !! penetration rate [m/s]
      real(wp), intent(in) :: impact_speed   !! rate at the onset [m/s]
      real(wp), intent(in) :: gently         !! parameter_gentle of the contact [1/kg]
      real(wp), intent(in) :: f_elastic      !! elastic force [N]
      real(wp), intent(out) :: f             !! normal force [N]
      real(wp), intent(inout) :: df_ddelta   !! derivative by penetration: of the elastic force, then of the normal force [N/m]
      real(wp), intent(out) :: df_drate      !! derivative of the normal force by rate [N.s/m]

      real(wp) :: factor, slope

      if (gently*f_elastic*delta < impact_speed*impact_speed) then
         slope = hysteresis/impact_speed
         factor = 1.0_wp + slope*rate
         f = f_elastic*factor
         df_ddelta = df_ddelta*factor
         df_drate = f_elastic*slope
         if (f < 0.0_wp) then
            f = 0.0_wp
            df_ddelta = 0.0_wp
            df_drate = 0.0_wp
         end if
      else
         call damp_deep(hysteresis, delta, rate, impact_speed, gently, f_elastic, f, df_ddelta, df_drate)
      end if
   end subroutine damp

end module hertz_family
