!> A normal law that comes in by degrees, as a film goes out over the same depth: the dry part of a transition.
!>
!> F_N = min(delta/d, 1) F(delta),   energy = integral of min(delta/d, 1) F_elastic(delta)
!>
!> F is the force of another law, d the depth of the transition. The energy is that of parts, W delta/d - (integral of W)/d up to d
!> with W the energy of the other law, by Gauss' formula in the square root of the penetration: exact where W is a power
!> delta^(k/2). No row of a deck names it; a joint gets it from its own columns.
!> Source: Flores et al. (2008), eq. (5.23). Limits: those of the other law.
module law_faded
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t
   use surfaces, only: surfaces_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: law_faded_t, new_law_faded

   integer, parameter :: n_pair = 4  !! pairs of points of Gauss' formula
   real(wp), parameter :: place(n_pair) = [0.18343464249564980494_wp, 0.52553240991632898582_wp, 0.79666647741362673959_wp, &
                                           0.96028985649753623168_wp]  !! (n_pair) points in [-1, 1], with either sign [1]
   real(wp), parameter :: weight(n_pair) = [0.36268378337836198297_wp, 0.31370664587788728734_wp, 0.22238103445337447054_wp, &
                                            0.10122853629037625915_wp]  !! (n_pair) their weights [1]

   !> A law that comes in by degrees.
   type, extends(normal_law_t) :: law_faded_t
      class(normal_law_t), allocatable :: law   !! the other law
      real(wp) :: depth = 0.0_wp                !! d: where it has come in [m]
   contains
      procedure, nopass :: info => faded_info
      procedure :: prepare => faded_prepare
      procedure :: fit => faded_fit
      procedure :: force => faded_force
      procedure :: potential => faded_potential
      procedure :: description => faded_description
   end type law_faded_t

contains

   !> A law that comes in by degrees over a depth.
   subroutine new_law_faded(law, depth, faded)
      class(normal_law_t), intent(in) :: law   !! the other law
      real(wp), intent(in) :: depth            !! of the transition, positive [m]
      type(law_faded_t), intent(out) :: faded  !! the law

      allocate (faded%law, source=law)
      faded%name = law%name
      faded%jumps_at_turn = law%jumps_at_turn
      faded%depth = depth
   end subroutine new_law_faded

   !> A name for messages; there is no table of it.
   function faded_info() result(info)
      type(kind_info_t) :: info  !! name

      info%name = "contact.faded"
      info%help = "a law that fades in with the penetration"
      info%source = "Flores et al. (2008), eq. (5.23)"
   end function faded_info

   !> Nothing to take: the other law has its row.
   subroutine faded_prepare(self, item)
      class(law_faded_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item           !! any row

      self%name = item%name
   end subroutine faded_prepare

   !> As the other law.
   subroutine faded_fit(self, pair, parameters, message, help)
      class(law_faded_t), intent(in) :: self                !! the law
      type(surfaces_t), intent(in) :: pair                  !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)  !! (n_law_parameter) of the other law [any]
      character(:), allocatable, intent(out) :: message     !! what is wrong, empty: the law fits
      character(:), allocatable, intent(out) :: help        !! what would be right

      call self%law%fit(pair, parameters, message, help)
   end subroutine faded_fit

   !> Force of n contacts.
   pure subroutine faded_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(law_faded_t), intent(in) :: self                  !! the law
      integer, intent(in) :: n                                !! number of contacts
      real(wp), intent(in) :: delta(n)                        !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                         !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                 !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n)  !! (n_law_parameter, n) of the other law [any]
      real(wp), intent(out) :: f(n)                           !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                   !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                    !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                   !! (n) elastic part of the force [N]

      real(wp) :: part
      integer :: k

      call self%law%force(n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      do k = 1, n
         if (delta(k) >= self%depth) cycle
         part = max(delta(k), 0.0_wp)/self%depth
         df_ddelta(k) = part*df_ddelta(k) + f(k)/self%depth
         f(k) = part*f(k)
         df_drate(k) = part*df_drate(k)
         f_elastic(k) = part*f_elastic(k)
      end do
   end subroutine faded_force

   !> Elastic energy that a contact stores.
   pure function faded_potential(self, delta, parameters) result(energy)
      class(law_faded_t), intent(in) :: self               !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the other law [any]
      real(wp) :: energy                                   !! energy stored [J]

      real(wp) :: integral, reached, root
      integer :: k

      energy = 0.0_wp
      if (.not. delta > 0.0_wp) return
      reached = min(delta, self%depth)
      integral = 0.0_wp
      do k = 1, n_pair
         root = 0.5_wp*(1.0_wp - place(k))
         integral = integral + weight(k)*root*self%law%potential(reached*root*root, parameters)
         root = 0.5_wp*(1.0_wp + place(k))
         integral = integral + weight(k)*root*self%law%potential(reached*root*root, parameters)
      end do
      energy = (self%law%potential(reached, parameters) - integral)*reached/self%depth
      if (delta > reached) energy = energy + self%law%potential(delta, parameters) - self%law%potential(reached, parameters)
   end function faded_potential

   !> The other law as text, and the depth.
   function faded_description(self, parameters) result(words)
      class(law_faded_t), intent(in) :: self               !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the other law [any]
      character(:), allocatable :: words                   !! as "stiffness 6.6e10 N/m^1.5, comes in over 0.005 mm"

      words = self%law%description(parameters)//", fades in over "//to_text(1.0e3_wp*self%depth)//" mm"
   end function faded_description

end module law_faded
