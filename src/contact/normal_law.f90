!> The contract of normal contact laws: F_N as a function of penetration and penetration rate.
!>
!> Signs: penetration delta > 0 in contact, rate > 0 approaching, force > 0 pushes the bodies apart.
!> A law never pulls. Flores et al. (2008), chapter 3.
!>
!> An object of a law is one row of its deck table: a set of parameters under a name. Stiffness is
!> handed in per contact, so that one row serves joints of different size; a contact knows its
!> stiffness from its geometry and materials unless the row gives one.
module normal_law
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: least_impact_speed, normal_law_t

   real(wp), parameter :: least_impact_speed = 1.0e-3_wp
      !! floor of the impact speed in damping terms: a contact that opens gently must not pull [m/s]

   !> One row of a table of normal laws.
   type, abstract :: normal_law_t
      character(:), allocatable :: name   !! name of the row
      real(wp) :: stiffness = 0.0_wp      !! given contact stiffness, 0: from the geometry [N/m^exponent]
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(prepare_interface), deferred :: prepare
      procedure(force_interface), deferred :: force
      procedure(potential_interface), deferred :: potential
   end type normal_law_t

   abstract interface
      !> What the kind says of itself.
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

      !> Force of n contacts, its partial derivatives and its elastic part. No allocation.
      pure subroutine force_interface(self, n, delta, rate, impact_speed, stiffness, f, df_ddelta, df_drate, f_elastic)
         import :: normal_law_t, wp
         implicit none (type, external)
         class(normal_law_t), intent(in) :: self      !! the law
         integer, intent(in) :: n                     !! number of contacts
         real(wp), intent(in) :: delta(n)             !! (n) penetration; no force where it is not positive [m]
         real(wp), intent(in) :: rate(n)              !! (n) penetration rate [m/s]
         real(wp), intent(in) :: impact_speed(n)      !! (n) rate at the onset, positive [m/s]
         real(wp), intent(in) :: stiffness(n)         !! (n) contact stiffness [N/m^exponent]
         real(wp), intent(out) :: f(n)                !! (n) normal force, not negative [N]
         real(wp), intent(out) :: df_ddelta(n)        !! (n) its derivative by penetration [N/m]
         real(wp), intent(out) :: df_drate(n)         !! (n) its derivative by rate [N.s/m]
         real(wp), intent(out) :: f_elastic(n)        !! (n) elastic part of the force: the rest is lost as heat [N]
      end subroutine force_interface

      !> Elastic energy that one contact stores: the potential of the elastic part of the force.
      pure function potential_interface(self, delta, stiffness) result(energy)
         import :: normal_law_t, wp
         implicit none (type, external)
         class(normal_law_t), intent(in) :: self  !! the law
         real(wp), intent(in) :: delta            !! penetration [m]
         real(wp), intent(in) :: stiffness        !! contact stiffness [N/m^exponent]
         real(wp) :: energy                       !! energy stored [J]
      end function potential_interface
   end interface

end module normal_law
