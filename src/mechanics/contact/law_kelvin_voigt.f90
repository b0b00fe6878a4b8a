!> Kelvin and Voigt: a linear spring that loses energy.
!>
!> squared:  F = K delta while approaching, ce^2 K delta while parting
!> book:     F = K delta while approaching, ce K delta while parting              eq. (3.1)
!> dashpot:  F = K delta + C rate,   C = 2 zeta sqrt(K m),   zeta = -ln ce / sqrt(pi^2 + ln^2 ce)
!> energy = K delta^2 / 2,   m the reduced mass of the two bodies
!>
!> Two free bodies part with ce in the form `squared`, with sqrt(ce) in the book's. These two jump where the penetration
!> turns, which is located; where a load lies between both forces the contact rests (`turn_monitor`). The dashpot would give
!> ce if it pulled at the end; it does not, and for ce = 0.9 and 0.5 gives 0.902 and 0.550; its force jumps by C v0 at the
!> onset, and what the spring still holds when the force is cut off is counted as lost.
!>
!> Source: Flores et al. (2008), eq. (3.1), corrected. Limits: the stiffness has no link to geometry or material and must be
!> given; the reduced mass of the dashpot is that of free bodies; impact speeds below 0.02 sqrt(E/rho), see `elastic_waves`.
module law_kelvin_voigt
   use hertz_family, only: add_restitution
   use item, only: item_t
   use kind_info, only: add_number, add_word, dim_stiffness, kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t
   use surfaces, only: surfaces_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: law_kelvin_voigt_t

   !> Linear spring with a loss.
   type, extends(normal_law_t) :: law_kelvin_voigt_t
      real(wp) :: stiffness = 0.0_wp      !! K [N/m]
      real(wp) :: returned = 1.0_wp       !! force while parting, of that while approaching [1]
      real(wp) :: damping_ratio = 0.0_wp  !! zeta [1]
   contains
      procedure, nopass :: info => kelvin_voigt_info
      procedure :: prepare => kelvin_voigt_prepare
      procedure :: fit => kelvin_voigt_fit
      procedure :: force => kelvin_voigt_force
      procedure :: potential => kelvin_voigt_potential
      procedure :: description => kelvin_voigt_description
   end type law_kelvin_voigt_t

contains

   !> Description of the kind.
   function kelvin_voigt_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.kelvin_voigt"
      info%help = "linear spring with a reduced force during separation, or with a dashpot"
      info%source = "Flores et al. (2008), eq. (3.1)"
      call add_number(info, "stiffness", dim_stiffness, "stiffness of the spring", lower=0.0_wp, open_lower=.true.)
      call add_restitution(info)
      call add_word(info, "form", "energy loss: force during separation times ce^2, times ce as printed in Flores et al. "// &
         "(2008), or a dashpot", &
                    default="squared", choices="squared book dashpot")
   end function kelvin_voigt_info

   !> Take the parameters.
   subroutine kelvin_voigt_prepare(self, item)
      class(law_kelvin_voigt_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                  !! the row

      real(wp), parameter :: pi = acos(-1.0_wp)

      self%name = item%name
      self%stiffness = item%number("stiffness")
      self%returned = 1.0_wp
      self%damping_ratio = 0.0_wp
      associate (ce => item%number("restitution"))
         select case (item%word("form"))
         case ("squared")
            self%returned = ce**2
         case ("book")
            self%returned = ce
         case ("dashpot")
            self%damping_ratio = -log(ce)/sqrt(pi**2 + log(ce)**2)
         end select
      end associate
      self%jumps_at_turn = self%returned < 1.0_wp
   end subroutine kelvin_voigt_prepare

   !> Stiffness and coefficient of the dashpot.
   subroutine kelvin_voigt_fit(self, pair, parameters, message, help)
      class(law_kelvin_voigt_t), intent(in) :: self          !! the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) stiffness, damping, any depth [N/m, N.s/m, m]
      character(:), allocatable, intent(out) :: message      !! what is wrong, empty: the law fits
      character(:), allocatable, intent(out) :: help         !! what would be right

      message = ""
      help = ""
      parameters = [self%stiffness, 0.0_wp, huge(1.0_wp), 0.0_wp]
      if (pair%inverse_mass > 0.0_wp) parameters(2) = 2.0_wp*self%damping_ratio*sqrt(self%stiffness/pair%inverse_mass)
   end subroutine kelvin_voigt_fit

   !> Force of n contacts.
   pure subroutine kelvin_voigt_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(law_kelvin_voigt_t), intent(in) :: self          !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset, of no effect [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) stiffness, damping [N/m, N.s/m]
      real(wp), intent(out) :: f(n)                          !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force [N]

      integer :: k

      do k = 1, n
         f(k) = 0.0_wp
         df_ddelta(k) = 0.0_wp
         df_drate(k) = 0.0_wp
         f_elastic(k) = parameters(1, k)*max(delta(k), 0.0_wp)
         if (.not. delta(k) > 0.0_wp) cycle
         df_ddelta(k) = parameters(1, k)*merge(self%returned, 1.0_wp, rate(k) < 0.0_wp)
         df_drate(k) = parameters(2, k)
         f(k) = df_ddelta(k)*delta(k) + df_drate(k)*rate(k)
         if (f(k) < 0.0_wp) then
            f(k) = 0.0_wp
            df_ddelta(k) = 0.0_wp
            df_drate(k) = 0.0_wp
         end if
      end do
   end subroutine kelvin_voigt_force

   !> Elastic energy of one contact.
   pure function kelvin_voigt_potential(self, delta, parameters) result(energy)
      class(law_kelvin_voigt_t), intent(in) :: self        !! the law, all of whose parameters are the contact's
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) stiffness first [N/m]
      real(wp) :: energy                                   !! energy stored [J]

      energy = 0.5_wp*parameters(1)*max(delta, 0.0_wp)**2
   end function kelvin_voigt_potential

   !> The stiffness as text.
   function kelvin_voigt_description(self, parameters) result(words)
      class(law_kelvin_voigt_t), intent(in) :: self        !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) stiffness, damping [N/m, N.s/m]
      character(:), allocatable :: words                   !! for `gudgeon explain`

      words = "stiffness "//real_text(parameters(1), 6)//" N/m"
      if (self%returned < 1.0_wp) words = words//", force during separation "//real_text(self%returned, 6)//" times the "// &
         "elastic force"
      if (parameters(2) > 0.0_wp) words = words//", dashpot "//real_text(parameters(2), 6)//" N.s/m"
   end function kelvin_voigt_description

end module law_kelvin_voigt
