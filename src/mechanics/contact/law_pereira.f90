!> Pereira, Ramalho and Ambrosio: a power of the penetration, fitted to line contact of a pin in a hole.
!>
!> F = (a c + b) E L / c delta^n { 1 + 3/4 (1 - ce^2) rate / v0 },   1/E = sigma_i + sigma_j,   c = R_i - R_j
!> a = 0.965, b = 0.0965, n = Y c^-0.005,   energy = F_elastic delta / (n + 1)
!> Y = 1.51 (ln 1000 c)^-0.151 for c < 0.34954,   0.0151 c + 1.151 beyond (the same there)
!>
!> with c and delta in millimetres, E in N/mm^2: the numbers have these units in them.
!> The restitution shown is not ce, as with every law of this damping (`hertz_family`).
!> Source: C. M. Pereira, A. L. Ramalho and J. A. Ambrosio, A critical overview of internal and external cylinder contact force
!> models, Nonlinear Dynamics 63 (2011), 681-697; An enhanced cylindrical contact force model, Multibody System Dynamics 35
!> (2015), 277-298. Limits: clearances of 5 um to 10 mm.
module law_pereira
   use cylinder_family, only: add_line_columns
   use explicit_cylinder, only: explicit_cylinder_t
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter
   use text, only: real_text
   implicit none (type, external)
   private
   public :: law_pereira_t

   real(wp), parameter :: a = 0.965_wp, b = 0.0965_wp              !! of an internal contact [1/mm, 1]
   real(wp), parameter :: minimum = 0.005_wp, maximum = 10.0_wp     !! clearances of the fit [mm]
   real(wp), parameter :: change = 0.34954_wp                      !! clearance at which the fit of n changes [mm]
   real(wp), parameter :: mm = 1.0e-3_wp                           !! one millimetre [m]

   !> A power law.
   type, extends(explicit_cylinder_t) :: law_pereira_t
   contains
      procedure, nopass :: info => pereira_info
      procedure :: prepare => pereira_prepare
      procedure :: find_constants => pereira_constants
      procedure, nopass :: elastic => pereira_elastic
      procedure, nopass :: stored => pereira_stored
   end type law_pereira_t

contains

   !> Description of the kind.
   function pereira_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.pereira"
      info%help = "power law of the penetration, fitted to line contact of a pin in a hole"
      info%source = "Pereira, Ramalho and Ambrosio (2011, 2015)"
      call add_line_columns(info)
   end function pereira_info

   !> Take the parameters.
   subroutine pereira_prepare(self, item)
      class(law_pereira_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item             !! the row

      self%name = item%name
      self%length = item%number("length")
      self%hysteresis = 0.75_wp*(1.0_wp - item%number("restitution")**2)
   end subroutine pereira_prepare

   !> The force at a penetration of one millimetre, and n.
   subroutine pereira_constants(self, clearance, length, modulus, parameters, message, help)
      class(law_pereira_t), intent(in) :: self                 !! the law
      real(wp), intent(in) :: clearance                        !! of the radii, c [m]
      real(wp), intent(in) :: length                           !! of contact, L [m]
      real(wp), intent(in) :: modulus                          !! of both surfaces, E [Pa]
      real(wp), intent(inout) :: parameters(n_law_parameter)   !! (n_law_parameter) constants [N, 1]
      character(:), allocatable, intent(inout) :: message      !! what is wrong, empty: the law fits
      character(:), allocatable, intent(inout) :: help         !! what would be right

      real(wp) :: c, y

      c = clearance/mm
      if (c < minimum .or. c > maximum) then
         message = "law '"//self%name//"' is fitted to clearances of 5 um to 10 mm, the clearance here is "//real_text(c, 4)//" mm"
         help = "use another law of cylinders: johnson, liu"
         return
      end if
      if (c < change) then
         y = 1.51_wp*log(1000.0_wp*c)**(-0.151_wp)
      else
         y = 0.0151_wp*c + 1.151_wp
      end if
      parameters(1) = (a*c + b)*modulus*mm**2*(length/mm)/c
      parameters(2) = y*c**(-0.005_wp)
   end subroutine pereira_constants

   !> Elastic force.
   pure subroutine pereira_elastic(parameters, delta, f, df_ddelta)
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants [N, 1]
      real(wp), intent(in) :: delta                        !! penetration, above 0 [m]
      real(wp), intent(out) :: f                           !! elastic force [N]
      real(wp), intent(out) :: df_ddelta                   !! its derivative [N/m]

      f = parameters(1)*(delta/mm)**parameters(2)
      df_ddelta = parameters(2)*f/delta
   end subroutine pereira_elastic

   !> Its potential.
   pure real(wp) function pereira_stored(parameters, delta) result(energy)
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants [N, 1]
      real(wp), intent(in) :: delta                        !! penetration, above 0 [m]

      energy = parameters(1)*(delta/mm)**parameters(2)*delta/(parameters(2) + 1.0_wp)
   end function pereira_stored

end module law_pereira
