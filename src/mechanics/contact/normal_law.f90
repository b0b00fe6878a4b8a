!> The contract of normal contact laws: F_N as a function of penetration and penetration rate.
!>
!> Signs: penetration delta > 0 in contact, rate > 0 approaching, force > 0 pushes the bodies apart.
!> A law never pulls. Flores et al. (2008), chapter 3.
!>
!> Damping terms have the impact speed v0 as a divisor. A contact that starts gently and is then pressed on by loads gets far deeper
!> than v0 could take it, and v0 says nothing about its damping any more: in these terms v0 is not less than a tenth of the speed of
!> the depth, v_d = sqrt(F_elastic delta/m), m the reduced mass. The impact of two free bodies has v_d < 1.2 v0 (Hertz; up to
!> sqrt(n + 1) v0/sqrt(2) for delta^n) at any speed, and is left alone. With u = gentle^2 v_d^2:
!>
!> v0^2 -> u - 2 v0^2 + 3 v0^4/u - v0^6/u^2  where u > v0^2,   twice smooth there, u for v0 = 0
!>
!> and the damping itself is one that does not cut the force off while they part (`deep_damping`).
!>
!> An object of a law is one row of its deck table: a set of parameters under a name. What depends on the surfaces
!> is handed in per contact, so that one row serves joints of different size: at set-up the law fits a column of
!> parameters to each pair of surfaces, and says so if it cannot.
module normal_law
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: impact_speed_of_depth, n_law_parameter, normal_law_t, parameter_deepest, parameter_gentle

   integer, parameter :: n_law_parameter = 4    !! numbers of a contact that a law may keep
   integer, parameter :: parameter_deepest = 3  !! the one that is of every law: penetration up to which it holds, huge: any [m]
   integer, parameter :: parameter_gentle = 4   !! one that the contact gives: gentle^2/m, see `impact_speed_of_depth` [1/kg]

   !> One row of a table of normal laws.
   type, abstract :: normal_law_t
      character(:), allocatable :: name   !! name of the row
      logical :: jumps_at_turn = .false.  !! the force jumps where the penetration turns (rate = 0), which must be located
      real(wp) :: hertz_damping = 0.0_wp  !! h of K delta^1.5 (1 + h rate/v0), see `hertz_family`; 0: it is another force [1]
      logical :: acts_apart = .false.     !! there is a force between surfaces that do not touch, as of a film: see `press.inc`
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(prepare_interface), deferred :: prepare
      procedure(fit_interface), deferred :: fit
      procedure(force_interface), deferred :: force
      procedure(potential_interface), deferred :: potential
      procedure(description_interface), deferred :: description
      procedure :: mistake => normal_mistake
      procedure :: contact_time => normal_contact_time
   end type normal_law_t

   abstract interface
      !> Description of the kind.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name and columns
      end function info_interface

      !> Take the parameters from a row of the kind's table.
      subroutine prepare_interface(self, item)
         import :: item_t, normal_law_t
         implicit none (type, external)
         class(normal_law_t), intent(inout) :: self  !! the law
         type(item_t), intent(in) :: item            !! the row
      end subroutine prepare_interface

      !> Parameters of the law for a pair of surfaces, or what is wrong with the pair: the deck's reader asks this
      !> first, so that a law that does not match is an error of the deck.
      subroutine fit_interface(self, pair, parameters, message, help)
         import :: n_law_parameter, normal_law_t, surfaces_t, wp
         implicit none (type, external)
         class(normal_law_t), intent(in) :: self                !! the law
         type(surfaces_t), intent(in) :: pair                   !! the surfaces
         real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) of the law; the gentle one 0 [any]
         character(:), allocatable, intent(out) :: message      !! what is wrong, empty: the law fits
         character(:), allocatable, intent(out) :: help         !! what would be right
      end subroutine fit_interface

      !> Force of n contacts, its partial derivatives and its elastic part. No allocation.
      pure subroutine force_interface(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
         import :: n_law_parameter, normal_law_t, wp
         implicit none (type, external)
         class(normal_law_t), intent(in) :: self                !! the law
         integer, intent(in) :: n                               !! number of contacts
         real(wp), intent(in) :: delta(n)                       !! (n) penetration; no force unless > 0 or acts_apart [m]
         real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
         real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset, positive [m/s]
         real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) from `fit` [any]
         real(wp), intent(out) :: f(n)                          !! (n) normal force, not negative [N]
         real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
         real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate [N.s/m]
         real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force: the rest is lost as heat [N]
      end subroutine force_interface

      !> Elastic energy that one contact stores: the potential of the elastic part of the force.
      pure function potential_interface(self, delta, parameters) result(energy)
         import :: n_law_parameter, normal_law_t, wp
         implicit none (type, external)
         class(normal_law_t), intent(in) :: self              !! the law
         real(wp), intent(in) :: delta                        !! penetration [m]
         real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) from `fit` [any]
         real(wp) :: energy                                   !! energy stored [J]
      end function potential_interface

      !> The parameters of a contact as text, for `gudgeon explain`.
      function description_interface(self, parameters) result(words)
         import :: n_law_parameter, normal_law_t, wp
         implicit none (type, external)
         class(normal_law_t), intent(in) :: self              !! the law
         real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) from `fit` [any]
         character(:), allocatable :: words                   !! as "stiffness 6.6e10 N/m^1.5"
      end function description_interface
   end interface

contains

   !> What is wrong with the row as a whole, empty if nothing is; a law with such rules overrides this.
   function normal_mistake(self) result(message)
      class(normal_law_t), intent(in) :: self  !! the law
      character(:), allocatable :: message     !! one line, empty: all is well

      message = repeat("", len(self%name))
   end function normal_mistake

   !> The impact speed that damping terms have where a contact is deeper than it started, and its derivative by the penetration.
   pure subroutine impact_speed_of_depth(delta, f_elastic, df_elastic, impact_speed, gently, speed, dspeed)
      real(wp), intent(in) :: delta         !! penetration [m]
      real(wp), intent(in) :: f_elastic     !! elastic force there [N]
      real(wp), intent(in) :: df_elastic    !! its derivative [N/m]
      real(wp), intent(in) :: impact_speed  !! v0, not negative [m/s]
      real(wp), intent(in) :: gently        !! parameter_gentle of the contact [1/kg]
      real(wp), intent(out) :: speed        !! what takes its place [m/s]
      real(wp), intent(out) :: dspeed       !! its derivative by the penetration [1/s]

      real(wp) :: r, u

      u = gently*f_elastic*delta
      speed = impact_speed
      dspeed = 0.0_wp
      if (.not. u > impact_speed**2) return
      r = impact_speed**2/u
      speed = sqrt(u*(1.0_wp - r*(2.0_wp - r*(3.0_wp - r))))
      dspeed = 0.5_wp*(1.0_wp - r)**2*(1.0_wp + 2.0_wp*r)*gently*(df_elastic*delta + f_elastic)/speed
   end subroutine impact_speed_of_depth

   !> Duration of an elastic impact of two free bodies, roughly if the force is no power of the penetration: 2.943 delta/v,
   !> where all of m v^2/2 is stored at the penetration delta. The factor is that of an exponent 3/2 (pi for 1).
   !> Newton's iteration in logarithms, exact at once for a power. Source: Goldsmith, Impact (1960), section 4.2.
   !> 0 where there is none: without a speed, with bodies that cannot move, with a law that stores nothing.
   pure real(wp) function normal_contact_time(self, parameters, speed, inverse_mass) result(time)
      class(normal_law_t), intent(in) :: self              !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) from `fit` [any]
      real(wp), intent(in) :: speed                        !! impact speed [m/s]
      real(wp), intent(in) :: inverse_mass                 !! 1/m_i + 1/m_j of the bodies, 0 for what cannot move [1/kg]

      real(wp), parameter :: factor = 2.9432752_wp   ! 2 sqrt(pi) Gamma(7/5) / Gamma(9/10) [1]
      real(wp), parameter :: begin = 1.0e-6_wp       ! penetration at which the iteration starts, of no influence on its end [m]
      real(wp), parameter :: longest = 20.0_wp       ! change of its logarithm in one iteration [1]
      real(wp), parameter :: close = 1.0e-6_wp       ! logarithms that are the same [1]
      integer, parameter :: most = 40                ! iterations
      real(wp) :: by_delta(1), by_rate(1), change, delta, elastic(1), energy, f(1), stored
      integer :: k

      time = 0.0_wp
      energy = 0.0_wp
      if (speed > sqrt(tiny(1.0_wp)) .and. inverse_mass > 0.0_wp) energy = 0.5_wp*speed*speed/inverse_mass
      if (.not. energy > tiny(1.0_wp)) return
      delta = begin
      do k = 1, most
         stored = self%potential(delta, parameters)
         call self%force(1, [delta], [0.0_wp], [speed], parameters, f, by_delta, by_rate, elastic)
         change = 2.0_wp
         if (stored > 0.0_wp .and. elastic(1) > 0.0_wp) change = log(energy/stored)*stored/(elastic(1)*delta)
         change = min(max(change, -longest), longest)
         delta = delta*exp(change)
         if (abs(change) < close) exit
      end do
      if (abs(change) < close) time = factor*delta/speed
   end function normal_contact_time

end module normal_law
