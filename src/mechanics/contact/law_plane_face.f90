!> A plane face against a plane, with hysteresis damping.
!>
!> F_N = K delta ( 1 + h rate / v0 ),   K = sqrt(a b) / (m (sigma_i + sigma_j)),   energy = K delta^2 / 2
!>
!> a and b are the sides of the face, m the factor of the mean displacement of a rectangle under uniform pressure (see
!> stiffness). The exponent is one: K is in N/m. v0 is the impact speed, or what takes its place in deep contacts
!> (`normal_law`); the force is cut off at zero.
!> h = 3 (1 - ce^2) / 4 as in the law of Lankarani and Nikravesh, or with `damping = exact` what makes two free bodies
!> part with ce.
!>
!> Source: Flores et al. (2008), eq. (4.26), there for a square, with the damping of eq. (3.9). Limits: a face that stays parallel
!> to the plane, and is small against the bodies; impact speeds below 0.02 sqrt(E/rho), see `elastic_waves`.
module law_plane_face
   use hertz_family, only: add_restitution, damp
   use item, only: item_t
   use kind_info, only: add_number, add_word, dim_stiffness, kind_info_t
   use kinds, only: wp
   use law_exact, only: exact_hysteresis
   use law_lankarani_nikravesh, only: lankarani_nikravesh_hysteresis
   use normal_law, only: n_law_parameter, normal_law_t, parameter_gentle
   use stiffness, only: face_stiffness
   use surfaces, only: shape_face, surfaces_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: law_plane_face_t

   !> Linear contact with hysteresis damping.
   type, extends(normal_law_t) :: law_plane_face_t
      real(wp) :: stiffness = 0.0_wp   !! given contact stiffness, 0: from the face [N/m]
      real(wp) :: hysteresis = 0.0_wp  !! h [1]
   contains
      procedure, nopass :: info => plane_face_info
      procedure :: prepare => plane_face_prepare
      procedure :: fit => plane_face_fit
      procedure :: force => plane_face_force
      procedure :: potential => plane_face_potential
      procedure :: description => plane_face_description
   end type law_plane_face_t

contains

   !> Description of the kind.
   function plane_face_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.plane_face"
      info%help = "a plane face against a plane: linear, with hysteresis damping"
      info%source = "Flores et al. (2008), eq. (4.26)"
      call add_number(info, "stiffness", dim_stiffness, "contact stiffness; 0: from the sides of the face and the materials", &
                      default="0 N/m", lower=0.0_wp)
      call add_restitution(info)
      call add_word(info, "damping", "damping factor: Lankarani and Nikravesh's, or the one that reproduces ce exactly", &
                    default="lankarani_nikravesh", choices="lankarani_nikravesh exact")
   end function plane_face_info

   !> Take the parameters.
   subroutine plane_face_prepare(self, item)
      class(law_plane_face_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                !! the row

      self%name = item%name
      self%stiffness = item%number("stiffness")
      self%hysteresis = lankarani_nikravesh_hysteresis(item%number("restitution"))
      if (item%word("damping") == "exact") self%hysteresis = exact_hysteresis(item%number("restitution"))
   end subroutine plane_face_prepare

   !> Stiffness: given, or from the face.
   subroutine plane_face_fit(self, pair, parameters, message, help)
      class(law_plane_face_t), intent(in) :: self            !! the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) stiffness, unused, any depth, 0 [N/m, 1, m, 1/kg]
      character(:), allocatable, intent(out) :: message      !! what is wrong, empty: the law fits
      character(:), allocatable, intent(out) :: help         !! what would be right

      message = ""
      help = ""
      parameters = [self%stiffness, 0.0_wp, huge(1.0_wp), 0.0_wp]
      if (self%stiffness > 0.0_wp) return
      if (pair%shape == shape_face) parameters(1) = face_stiffness(pair)
      if (parameters(1) > 0.0_wp) return
      message = "law '"//self%name//"' needs a plane face with length and width"
      help = "set its column stiffness, or the sides of the face; for curved surfaces use a law of the Hertz family"
   end subroutine plane_face_fit

   !> Force of n contacts.
   pure subroutine plane_face_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(law_plane_face_t), intent(in) :: self            !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) stiffness first [N/m]
      real(wp), intent(out) :: f(n)                          !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force [N]

      integer :: k

      do k = 1, n
         f_elastic(k) = parameters(1, k)*max(delta(k), 0.0_wp)
         df_ddelta(k) = merge(parameters(1, k), 0.0_wp, delta(k) > 0.0_wp)
         call damp(self%hysteresis, delta(k), rate(k), impact_speed(k), parameters(parameter_gentle, k), f_elastic(k), f(k), &
                   df_ddelta(k), df_drate(k))
      end do
   end subroutine plane_face_force

   !> Elastic energy of one contact.
   pure function plane_face_potential(self, delta, parameters) result(energy)
      class(law_plane_face_t), intent(in) :: self          !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) stiffness first [N/m]
      real(wp) :: energy                                   !! energy stored [J]

      energy = 0.5_wp*parameters(1)*max(delta, 0.0_wp)**2
   end function plane_face_potential

   !> The stiffness as text.
   function plane_face_description(self, parameters) result(words)
      class(law_plane_face_t), intent(in) :: self          !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) stiffness first [N/m]
      character(:), allocatable :: words                   !! for `gudgeon explain`

      words = "stiffness "//real_text(parameters(1), 6)//" N/m"
      if (self%hysteresis > 0.0_wp) words = words//", damping factor h = "//real_text(self%hysteresis, 6)//" in 1 + h rate/v0"
   end function plane_face_description

end module law_plane_face
