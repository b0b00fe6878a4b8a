!> A part of another normal law: one of several contacts that carry a load together, each with its share of the stiffness.
!>
!> F_N = s F(delta),   energy = s W(delta)
!>
!> F is the force of another law, s the share. Damping goes with the stiffness: the hysteresis of each contact is the same part of
!> what it stores. No row of a deck names it; a joint gets it from its own columns.
!> Source: Flores et al. (2008), section 6.3, where each of two bases has the whole stiffness (s = 1).
!> Limits: those of the other law.
module law_part
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t
   use surfaces, only: surfaces_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: law_part_t, new_law_part

   !> A part of a law.
   type, extends(normal_law_t) :: law_part_t
      class(normal_law_t), allocatable :: law   !! the other law
      real(wp) :: share = 1.0_wp                !! s [1]
   contains
      procedure, nopass :: info => part_info
      procedure :: prepare => part_prepare
      procedure :: fit => part_fit
      procedure :: force => part_force
      procedure :: potential => part_potential
      procedure :: description => part_description
   end type law_part_t

contains

   !> A share of a law.
   subroutine new_law_part(law, share, part)
      class(normal_law_t), intent(in) :: law   !! the other law
      real(wp), intent(in) :: share            !! of its force [1]
      type(law_part_t), intent(out) :: part    !! the law

      allocate (part%law, source=law)
      part%name = law%name
      part%jumps_at_turn = law%jumps_at_turn
      part%acts_apart = law%acts_apart
      part%share = share
   end subroutine new_law_part

   !> A name for messages; there is no table of it.
   function part_info() result(info)
      type(kind_info_t) :: info  !! name

      info%name = "contact.part"
      info%help = "a fraction of another law"
      info%source = "Flores et al. (2008), section 6.3"
   end function part_info

   !> Nothing to take: the other law has its row.
   subroutine part_prepare(self, item)
      class(law_part_t), intent(inout) :: self   !! the law
      type(item_t), intent(in) :: item           !! any row

      self%name = item%name
   end subroutine part_prepare

   !> As the other law.
   subroutine part_fit(self, pair, parameters, message, help)
      class(law_part_t), intent(in) :: self                 !! the law
      type(surfaces_t), intent(in) :: pair                  !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)  !! (n_law_parameter) of the other law [any]
      character(:), allocatable, intent(out) :: message     !! what is wrong, empty: the law fits
      character(:), allocatable, intent(out) :: help        !! what would be right

      call self%law%fit(pair, parameters, message, help)
   end subroutine part_fit

   !> Force of n contacts.
   pure subroutine part_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(law_part_t), intent(in) :: self                   !! the law
      integer, intent(in) :: n                                !! number of contacts
      real(wp), intent(in) :: delta(n)                        !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                         !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                 !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n)  !! (n_law_parameter, n) of the other law [any]
      real(wp), intent(out) :: f(n)                           !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                   !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                    !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                   !! (n) elastic part of the force [N]

      call self%law%force(n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      f = self%share*f
      df_ddelta = self%share*df_ddelta
      df_drate = self%share*df_drate
      f_elastic = self%share*f_elastic
   end subroutine part_force

   !> Elastic energy that a contact stores.
   pure function part_potential(self, delta, parameters) result(energy)
      class(law_part_t), intent(in) :: self                !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the other law [any]
      real(wp) :: energy                                   !! energy stored [J]

      energy = self%share*self%law%potential(delta, parameters)
   end function part_potential

   !> The other law as text, and the share.
   function part_description(self, parameters) result(words)
      class(law_part_t), intent(in) :: self                !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the other law [any]
      character(:), allocatable :: words                   !! as "stiffness 6.6e10 N/m^1.5, at each base 0.5 of it"

      words = self%law%description(parameters)//", at each end "//to_text(self%share)//" times the law"
   end function part_description

end module law_part
