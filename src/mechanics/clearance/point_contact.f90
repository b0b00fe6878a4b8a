!> Two surfaces that meet at a point: what a geometry measures of one contact at one motion, and what its laws take and give.
!>
!> n is the normal at C, the common point of contact, into the material of body i. The force on body j is
!>
!> f_j = -F_N n + F_T t,   on body i: -f_j,   both at C
!>
!> with t the direction of sliding in the tangent plane (R90 n, one of two, in the plane); F_N is not negative, F_T is against
!> v_T = t . (v_j - v_i). Where surfaces are worn the penetration does not grow as the centres move along n, but lambda times as
!> much: F_N is lambda F(delta) of the law F, and the rate is that of the centres, delta'/lambda (`surface_overlap`).
module point_contact
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: contact_work_t, most_of_item, new_work, point_contact_t

   integer, parameter :: most_of_item = 16    !! contacts of an item, at most

   !> Kinematics of one contact. A geometry of the plane neither sets nor reads what is along z, nor the tangent.
   type :: point_contact_t
      real(wp) :: normal(3) = 0.0_wp  !! (3) n, world frame [1]
      real(wp) :: tangent(3) = 0.0_wp !! (3) in space: t, the direction of sliding, zero of none; world frame [1]
      real(wp) :: delta = 0.0_wp      !! penetration, negative: apart [m]
      real(wp) :: rate = 0.0_wp       !! its rate, over `lever` [m/s]
      real(wp) :: v_t = 0.0_wp        !! sliding velocity of j along t, for the friction law; where it is asked for [m/s]
      real(wp) :: v_t_work = 0.0_wp   !! the same of the material points where the forces act, for their power [m/s]
      real(wp) :: arm_i(3) = 0.0_wp   !! (3) where the force on i acts, from its centre of mass, world frame [m]
      real(wp) :: arm_j(3) = 0.0_wp   !! (3) where the force on j acts, from its centre of mass, world frame [m]
      real(wp) :: lever = 1.0_wp      !! derivative of the penetration along n; 1 but of worn surfaces [1]
   end type point_contact_t

   !> What an evaluation finds of several contacts.
   type :: contact_work_t
      type(point_contact_t), allocatable :: contacts(:)  !! (n_contact) kinematics of those that act
      real(wp), allocatable :: delta(:)                  !! (n_contact) penetration, 0 of a free contact [m]
      real(wp), allocatable :: rate(:)                   !! (n_contact) its rate, 0 of a free contact [m/s]
      real(wp), allocatable :: impact_speed(:)           !! (n_contact) impact speed, 1 m/s of a free contact [m/s]
      real(wp), allocatable :: f_n(:)                    !! (n_contact) normal force [N]
      real(wp), allocatable :: slope_delta(:)            !! (n_contact) its derivative by the penetration [N/m]
      real(wp), allocatable :: slope_rate(:)             !! (n_contact) its derivative by the rate [N.s/m]
      real(wp), allocatable :: f_elastic(:)              !! (n_contact) derivative of the stored energy by the penetration [N]
      real(wp), allocatable :: f_friction(:)                  !! (n_contact) normal force that friction feels [N]
      real(wp), allocatable :: speed(:)                  !! (n_contact) magnitude of the sliding velocity [m/s]
      real(wp), allocatable :: f_t(:)                    !! (n_contact) friction force on j along t [N]
   end type contact_work_t

contains

   !> Storage for n contacts, all zero.
   pure subroutine new_work(n, work)
      integer, intent(in) :: n                   !! number of contacts
      type(contact_work_t), intent(out) :: work  !! workspace

      allocate (work%contacts(n))
      allocate (work%delta(n), work%rate(n), work%impact_speed(n), work%f_n(n), work%slope_delta(n), work%slope_rate(n), &
                work%f_elastic(n), work%f_friction(n), work%speed(n), work%f_t(n), source=0.0_wp)
   end subroutine new_work

end module point_contact
