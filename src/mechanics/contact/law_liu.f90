!> Liu, Zhang and Yang: a pin in a hole of nearly its size, as an elastic layer.
!>
!> F = (pi/2) E L delta sqrt( delta / (2 (c + delta)) ),   1/E = sigma_i + sigma_j,   c = R_i - R_j
!> energy = (pi/2) E L / sqrt(2) { sqrt(delta (c + delta)) (2 delta - 3 c)/4 + (3/4) c^2 asinh sqrt(delta/c) }
!>
!> The root is the sine of half the angle of contact e, cos e = c/(c + delta). For delta far below c the force is that of a power
!> 3/2, beyond it is linear. The energy is taken from its series where the two parts would cancel.
!> Source: C.-S. Liu, K. Zhang and R. Yang, The FEM analysis and approximate model for cylindrical joints with clearances,
!> Mechanism and Machine Theory 42 (2007), 183-197. Limits: plane strain, no friction; bodies alike in stiffness.
module law_liu
   use cylinder_family, only: add_line_columns
   use explicit_cylinder, only: explicit_cylinder_t
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use normal_law, only: n_law_parameter
   implicit none (type, external)
   private
   public :: law_liu_t

   !> A pin in a hole of nearly its size.
   type, extends(explicit_cylinder_t) :: law_liu_t
   contains
      procedure, nopass :: info => liu_info
      procedure :: find_constants => liu_constants
      procedure, nopass :: elastic => liu_elastic
      procedure, nopass :: stored => liu_stored
   end type law_liu_t

contains

   !> Description of the kind.
   function liu_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.liu"
      info%help = "a pin in a closely fitting hole, as an elastic layer"
      info%source = "Liu, Zhang and Yang (2007)"
      call add_line_columns(info)
   end function liu_info

   !> pi E L / sqrt(8), and c.
   subroutine liu_constants(self, clearance, length, modulus, parameters, message, help)
      class(law_liu_t), intent(in) :: self                     !! the law
      real(wp), intent(in) :: clearance                        !! of the radii, c [m]
      real(wp), intent(in) :: length                           !! of contact, L [m]
      real(wp), intent(in) :: modulus                          !! of both surfaces, E [Pa]
      real(wp), intent(inout) :: parameters(n_law_parameter)   !! (n_law_parameter) constants [N/m, m]
      character(:), allocatable, intent(inout) :: message      !! nothing is wrong
      character(:), allocatable, intent(inout) :: help         !! nothing is wrong

      parameters(1:2) = [pi*modulus*length/sqrt(8.0_wp), clearance]
   end subroutine liu_constants

   !> Elastic force.
   pure subroutine liu_elastic(parameters, delta, f, df_ddelta)
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants [N/m, m]
      real(wp), intent(in) :: delta                        !! penetration, above 0 [m]
      real(wp), intent(out) :: f                           !! elastic force [N]
      real(wp), intent(out) :: df_ddelta                   !! its derivative [N/m]

      real(wp) :: root

      root = sqrt(delta/(parameters(2) + delta))
      f = parameters(1)*delta*root
      df_ddelta = parameters(1)*root*(1.5_wp*parameters(2) + delta)/(parameters(2) + delta)
   end subroutine liu_elastic

   !> Its potential.
   pure real(wp) function liu_stored(parameters, delta) result(energy)
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) constants [N/m, m]
      real(wp), intent(in) :: delta                        !! penetration, above 0 [m]

      real(wp), parameter :: small = 0.02_wp  ! delta/c below which the series is taken; its remainder is 1e-16 of it [1]
      integer, parameter :: n_term = 9        ! terms of the series
      real(wp) :: factor, sum, x
      integer :: k

      associate (c => parameters(2))
         x = delta/c
         if (x > small) then
            energy = 0.25_wp*sqrt(delta*(c + delta))*(2.0_wp*delta - 3.0_wp*c) + 0.75_wp*c*c*asinh(sqrt(x))
         else
            ! x^1.5 (1 + x)^-1/2, term by term
            sum = 0.0_wp
            factor = 1.0_wp
            do k = 0, n_term - 1
               sum = sum + factor/(k + 2.5_wp)
               factor = -factor*x*(k + 0.5_wp)/(k + 1.0_wp)
            end do
            energy = sum*sqrt(x)*delta*delta
         end if
      end associate
      energy = parameters(1)*energy
   end function liu_stored

end module law_liu
