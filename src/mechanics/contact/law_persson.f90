!> Persson: a pin in a hole of nearly its size, with the exact angle of contact of plane elasticity.
!>
!> F = 2 pi E L c s (1 + s) / (2 - ln(1 + s) - 2 s^2),   s = tan^2(e/2),   1/E = sigma_i + sigma_j,   c = R_i - R_j
!>
!> for bodies of one material. The penetration goes with the angle of contact e by the overlap of the circles,
!> cos e = c/(c + delta), so that s = delta/(2 c + delta). The force grows without bound at s = 0.8346; from nine tenths of that
!> it continues along its tangent, which is beyond the law's range and reported as such. The energy is a Gauss-Legendre sum of
!> 16 points.
!> Source: A. Persson, On the stress distribution of cylindrical elastic bodies in contact, dissertation, Chalmers (1964);
!> M. Ciavarella and P. Decuzzi, The state of stress induced by the plane frictionless cylindrical contact, International Journal of
!> Solids and Structures 38 (2001), 4507-4523; the penetration as in C.-S. Liu, K. Zhang and R. Yang (2007).
!> Limits: materials alike (of different ones the mean compliance is taken), plane strain, no friction.
module law_persson
   use cylinder_family, only: add_line_columns
   use explicit_cylinder, only: explicit_cylinder_t
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use normal_law, only: n_law_parameter
   implicit none (type, external)
   private
   public :: law_persson_t

   real(wp), parameter :: steepest = 0.9_wp*0.8346152_wp  !! s up to which the law holds [1]
   integer, parameter :: n_point = 8                    !! points of the sum on each side of the middle
   real(wp), parameter :: point(n_point) = [0.09501250983763744_wp, 0.28160355077925891_wp, 0.45801677765722739_wp, &
                                            0.61787624440264375_wp, 0.75540440835500303_wp, 0.86563120238783174_wp, &
                                            0.94457502307323258_wp, 0.98940093499164993_wp]  !! (n_point) places, -1 to 1 [1]
   real(wp), parameter :: weight(n_point) = [0.18945061045506850_wp, 0.18260341504492359_wp, 0.16915651939500254_wp, &
                                             0.14959598881657673_wp, 0.12462897125553387_wp, 0.09515851168249278_wp, &
                                             0.06225352393864789_wp, 0.02715245941175409_wp]  !! (n_point) their weights [1]

   !> A pin in a hole of nearly its size.
   type, extends(explicit_cylinder_t) :: law_persson_t
   contains
      procedure, nopass :: info => persson_info
      procedure :: find_constants => persson_constants
      procedure, nopass :: elastic => persson_elastic
      procedure, nopass :: stored => persson_stored
   end type law_persson_t

contains

   !> Description of the kind.
   function persson_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.persson"
      info%help = "a pin in a closely fitting hole, with the contact angle of plane elasticity"
      info%source = "Persson (1964); Ciavarella and Decuzzi (2001)"
      call add_line_columns(info)
   end function persson_info

   !> 2 pi E L c, 2 c, and the range.
   subroutine persson_constants(self, clearance, length, modulus, parameters, message, help)
      class(law_persson_t), intent(in) :: self                 !! the law
      real(wp), intent(in) :: clearance                        !! of the radii, c [m]
      real(wp), intent(in) :: length                           !! of contact, L [m]
      real(wp), intent(in) :: modulus                          !! of both surfaces, E [Pa]
      real(wp), intent(inout) :: parameters(n_law_parameter)   !! (n_law_parameter) constants, range [N, m, m]
      character(:), allocatable, intent(inout) :: message      !! nothing is wrong
      character(:), allocatable, intent(inout) :: help         !! nothing is wrong

      parameters(1) = 2.0_wp*pi*modulus*length*clearance
      parameters(2) = 2.0_wp*clearance
      parameters(3) = parameters(2)*steepest/(1.0_wp - steepest)
   end subroutine persson_constants

   !> Elastic force.
   pure subroutine persson_elastic(parameters, delta, f, df_ddelta)
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants, range [N, m, m]
      real(wp), intent(in) :: delta                        !! penetration, above 0 [m]
      real(wp), intent(out) :: f                           !! elastic force [N]
      real(wp), intent(out) :: df_ddelta                   !! its derivative [N/m]

      real(wp) :: d, s

      s = delta/(parameters(2) + delta)
      d = 2.0_wp - log(1.0_wp + s) - 2.0_wp*s*s
      f = parameters(1)*s*(1.0_wp + s)/d
      df_ddelta = (parameters(1)*(1.0_wp + 2.0_wp*s) + f*(1.0_wp/(1.0_wp + s) + 4.0_wp*s))/d &
                  *parameters(2)/(parameters(2) + delta)**2
   end subroutine persson_elastic

   !> Its potential.
   pure real(wp) function persson_stored(parameters, delta) result(energy)
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants, range [N, m, m]
      real(wp), intent(in) :: delta                        !! penetration, above 0 [m]

      real(wp) :: df_ddelta, f(2)
      integer :: k

      energy = 0.0_wp
      do k = 1, n_point
         call persson_elastic(parameters, 0.5_wp*delta*(1.0_wp - point(k)), f(1), df_ddelta)
         call persson_elastic(parameters, 0.5_wp*delta*(1.0_wp + point(k)), f(2), df_ddelta)
         energy = energy + 0.5_wp*delta*weight(k)*(f(1) + f(2))
      end do
   end function persson_stored

end module law_persson
