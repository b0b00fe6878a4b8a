!> A law of the user's own: the normal force as an expression in penetration and rate.
!>
!> F_N = f(delta, rate, v0) where delta > 0, else 0;   energy = integral of f(s, 0, 1 m/s) from s = 0 to delta
!>
!> v0 is the impact speed, not less than a tenth of the speed of the depth (`normal_law`); the force is cut off at zero. The elastic
!> part, which the ledger books as stored, is the force at rate zero (and v0 = 1 m/s, should that matter there); all the rest of its
!> power is counted as lost, with its sign: an expression that drives the contact gives a negative loss.
!>
!> Source: none. Limits: the force should rise from zero with the penetration and be smooth; where the expression is not a
!> number the run ends with an error.
module law_expression
   use expression, only: expression_t
   use item, only: item_t, place_of
   use kind_info, only: add_expression, dim_force, dim_length, dim_speed, kind_info_t
   use kinds, only: wp
   use normal_law, only: impact_speed_of_depth, n_law_parameter, normal_law_t, parameter_deepest, parameter_gentle
   use quadrature, only: integral_of
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: law_expression_t

   !> A force that the deck gives.
   type, extends(normal_law_t) :: law_expression_t
      type(expression_t) :: whole    !! f of penetration, rate, impact speed [N]
      type(expression_t) :: elastic  !! the same at rate 0 and v0 = 1 m/s, of the penetration [N]
   contains
      procedure, nopass :: info => expression_info
      procedure :: prepare => expression_prepare
      procedure :: fit => expression_fit
      procedure :: force => expression_force
      procedure :: potential => expression_potential
      procedure :: description => expression_description
   end type law_expression_t

contains

   !> Description of the kind.
   function expression_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.expression"
      info%help = "user-defined law: the force as an expression of penetration, rate and impact speed"
      info%source = "none"
      call add_expression(info, "force", dim_force, "force from the penetration delta, its rate and the impact speed v0", &
                          variable="delta rate v0", argument=[dim_length, dim_speed, dim_speed])
   end function expression_info

   !> Take the parameters.
   subroutine expression_prepare(self, item)
      class(law_expression_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                !! the row

      self%name = item%name
      self%whole = item%values(place_of(item, "force"))%expression
      self%elastic = self%whole
      self%elastic%others = [0.0_wp, 1.0_wp]
   end subroutine expression_prepare

   !> An expression fits any surfaces and has no parameters of its own.
   subroutine expression_fit(self, pair, parameters, message, help)
      class(law_expression_t), intent(in) :: self            !! the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) unused, unused, any depth [1, 1, m]
      character(:), allocatable, intent(out) :: message      !! empty: the law fits
      character(:), allocatable, intent(out) :: help         !! empty

      message = repeat("", len(self%name) + pair%shape)
      help = message
      parameters = [0.0_wp, 0.0_wp, huge(1.0_wp), 0.0_wp]
   end subroutine expression_fit

   !> Force of n contacts.
   pure subroutine expression_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(law_expression_t), intent(in) :: self            !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) depth last [m]
      real(wp), intent(out) :: f(n)                          !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force [N]

      real(wp) :: d1, dspeed, speed, x(3)
      integer :: k

      do k = 1, n
         f(k) = 0.0_wp
         df_ddelta(k) = 0.0_wp
         df_drate(k) = 0.0_wp
         f_elastic(k) = 0.0_wp
         if (.not. (delta(k) > 0.0_wp .and. delta(k) < parameters(parameter_deepest, k))) cycle
         call self%elastic%evaluate_at([delta(k), self%elastic%others], 1, f_elastic(k), d1)
         call impact_speed_of_depth(delta(k), f_elastic(k), d1, impact_speed(k), parameters(parameter_gentle, k), speed, dspeed)
         x = [delta(k), rate(k), max(speed, tiny(1.0_wp))]
         call self%whole%evaluate_at(x, 1, f(k), df_ddelta(k))
         call self%whole%evaluate_at(x, 2, f(k), df_drate(k))
         if (dspeed > 0.0_wp) then
            call self%whole%evaluate_at(x, 3, f(k), d1)
            df_ddelta(k) = df_ddelta(k) + d1*dspeed
         end if
         if (f(k) < 0.0_wp) then
            f(k) = 0.0_wp
            df_ddelta(k) = 0.0_wp
            df_drate(k) = 0.0_wp
         end if
      end do
   end subroutine expression_force

   !> Elastic energy of one contact.
   pure function expression_potential(self, delta, parameters) result(energy)
      class(law_expression_t), intent(in) :: self          !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) depth last [m]
      real(wp) :: energy                                   !! energy stored [J]

      energy = integral_of(self%elastic, min(max(delta, 0.0_wp), parameters(parameter_deepest)))
   end function expression_potential

   !> The expression as text.
   function expression_description(self, parameters) result(words)
      class(law_expression_t), intent(in) :: self          !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) depth last [m]
      character(:), allocatable :: words                   !! for `gudgeon explain`

      words = "force = "//self%whole%source
      if (parameters(parameter_deepest) < huge(1.0_wp)) words = words//" within its valid range"
   end function expression_description

end module law_expression
