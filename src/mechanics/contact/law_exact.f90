!> Hertz contact with the hysteresis damping that delivers the restitution asked for.
!>
!> F_N = K delta^n ( 1 + h rate / v0 ),   n = 3/2, v0 the impact speed,   h(1 + ce) = ln[ (1 + h) / (1 - h ce) ]
!>
!> Integrating m v dv = -F d(delta) of two free bodies over the impact gives the equation of h, whatever the elastic
!> force, the masses and the speed: so ce is what they show. h = 0 for ce = 1, and h tends to 1/ce for ce to 0.
!>
!> Source: the integral is that of Hunt and Crossley, Journal of Applied Mechanics 42 (1975), 440-445, not expanded in 1 - ce.
!> Limits: two free bodies: forces of a mechanism during the impact change what they show; those of hertz_family.
module law_exact
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: exact_hysteresis, law_exact_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_exact_t
   contains
      procedure, nopass :: info => exact_info
      procedure, nopass :: hysteresis_of => exact_hysteresis
   end type law_exact_t

contains

   !> Description of the kind.
   function exact_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.exact"
      info%help = "Hertz contact with hysteresis damping that reproduces the given restitution exactly"
      info%source = "Hunt and Crossley (1975), integrated without expansion"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function exact_info

   !> The root of h(1 + ce) = ln[(1 + h)/(1 - h ce)] that is not zero, by bisection to the last digit, between
   !> 1.5 (1 - ce) and 1.6 (1 - ce)/ce, and below 1/ce.
   pure real(wp) function exact_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce, above 0, at most 1 [1]

      integer, parameter :: most = 200  ! halvings; the interval is empty long before
      real(wp) :: high, low
      integer :: k

      h = 0.0_wp
      if (restitution >= 1.0_wp) return
      low = 1.5_wp*(1.0_wp - restitution)
      high = min(1.6_wp*(1.0_wp - restitution), 1.0_wp)/restitution
      do k = 1, most
         h = 0.5_wp*(low + high)
         if (h <= low .or. h >= high) exit
         if (excess(h, restitution) > 0.0_wp) then
            low = h
         else
            high = h
         end if
      end do
   end function exact_hysteresis

   !> Positive below the root, negative above. For a low restitution the form without a pole,
   !> 1 - h ce - (1 + h) exp(-h (1 + ce)). For a high one, where that is all cancellation: with z = h(1+ce)/(2 + h(1-ce)) the
   !> logarithm is 2 artanh z, and the equation h(1 - ce) = 2 (artanh(z)/z - 1).
   pure real(wp) function excess(h, ce)
      real(wp), intent(in) :: h   !! trial [1]
      real(wp), intent(in) :: ce  !! coefficient of restitution [1]

      real(wp), parameter :: low = 0.5_wp    ! restitution that counts as such [1]
      integer, parameter :: n_term = 24      ! of the series z^2/3 + z^4/5 + ... , z < 0.5
      real(wp) :: rest, z
      integer :: k

      if (ce < low) then
         excess = 1.0_wp - h*ce - (1.0_wp + h)*exp(-h*(1.0_wp + ce))
         return
      end if
      z = h*(1.0_wp + ce)/(2.0_wp + h*(1.0_wp - ce))
      if (z < 0.5_wp) then
         rest = 0.0_wp
         do k = n_term, 1, -1
            rest = (rest + 1.0_wp/real(2*k + 1, wp))*z*z
         end do
      else
         rest = atanh(z)/z - 1.0_wp
      end if
      excess = h*(1.0_wp - ce) - 2.0_wp*rest
   end function excess

end module law_exact
