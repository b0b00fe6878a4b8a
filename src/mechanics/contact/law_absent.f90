!> No contact at all: the law of a joint whose surfaces a film alone holds apart.
!>
!> F_N = 0,   energy = 0
!>
!> No row of a deck names it; a joint gets it where its level has no dry contact. Limits: none.
module law_absent
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t, parameter_deepest
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: law_absent_t

   !> No force.
   type, extends(normal_law_t) :: law_absent_t
   contains
      procedure, nopass :: info => absent_info
      procedure :: prepare => absent_prepare
      procedure :: fit => absent_fit
      procedure :: force => absent_force
      procedure :: potential => absent_potential
      procedure :: description => absent_description
   end type law_absent_t

contains

   !> A name for messages; there is no table of it.
   function absent_info() result(info)
      type(kind_info_t) :: info  !! name

      info%name = "contact.none"
      info%help = "no contact"
      info%source = "none"
   end function absent_info

   !> Nothing to take.
   subroutine absent_prepare(self, item)
      class(law_absent_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item            !! any row

      self%name = item%name
   end subroutine absent_prepare

   !> Any surfaces will do.
   subroutine absent_fit(self, pair, parameters, message, help)
      class(law_absent_t), intent(in) :: self               !! the law
      type(surfaces_t), intent(in) :: pair                  !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)  !! (n_law_parameter) no range [any]
      character(:), allocatable, intent(out) :: message     !! empty
      character(:), allocatable, intent(out) :: help        !! empty

      parameters = 0.0_wp
      parameters(parameter_deepest) = huge(1.0_wp)
      message = ""
      help = ""
   end subroutine absent_fit

   !> No force at any penetration.
   pure subroutine absent_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(law_absent_t), intent(in) :: self                 !! the law
      integer, intent(in) :: n                                !! number of contacts
      real(wp), intent(in) :: delta(n)                        !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                         !! (n) its rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                 !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n)  !! (n_law_parameter, n) from `fit` [any]
      real(wp), intent(out) :: f(n)                           !! (n) zero [N]
      real(wp), intent(out) :: df_ddelta(n)                   !! (n) zero [N/m]
      real(wp), intent(out) :: df_drate(n)                    !! (n) zero [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                   !! (n) zero [N]

      f = 0.0_wp
      df_ddelta = 0.0_wp
      df_drate = 0.0_wp
      f_elastic = 0.0_wp
   end subroutine absent_force

   !> Nothing is stored.
   pure function absent_potential(self, delta, parameters) result(energy)
      class(law_absent_t), intent(in) :: self              !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) from `fit` [any]
      real(wp) :: energy                                   !! zero [J]

      energy = 0.0_wp
   end function absent_potential

   !> As text.
   function absent_description(self, parameters) result(words)
      class(law_absent_t), intent(in) :: self              !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) from `fit` [any]
      character(:), allocatable :: words                   !! that there is none

      words = "no contact"
   end function absent_description

end module law_absent
