!> Planar: a slider between two straight surfaces: its corners, ends of the guide, and how long sides share their forces.
!>
!> Corners A, B, C, D of a rectangle of body j, counter-clockwise from the one behind and below, at the upper, then at the lower
!> surface of body i (`flat_contacts`). The guide has a front at each end, which corners that come over it touch; where faces share,
!> a contact lasts while the corner is between the ends.
!>
!> Faces, where both corners of a long side are at one surface, penetrating by d_1 and d_2, L the length, K_f that of `face_law`:
!> corners     each corner for itself, with the normal law
!> book        the face law instead: F = K_f (d_1 + d_2)/2 at L/3 (d_1 + 2 d_2)/(d_1 + d_2) from corner 1; it starts and ends
!>             with the located onset and end of the second corner, with a jump of the force
!> blend       (1 - w) corners + w face, w = S(min(d_1, d_2)/max(d_1, d_2)), S(r) = r^2 (3 - 2 r): no jump
!> foundation  springs K_f/L per length under the part that penetrates; of one corner l = L d_1/(d_1 - d_2), F = K_f d_1 l/(2 L)
!>             at l/3: no jump, and no corner law
!> The face force is damped with the rate at its point of application and the impact speed (v_1 d_1 + v_2 d_2)/(d_1 + d_2), that
!> of the corners weighted by their depth, so that a corner that comes or goes changes nothing. It acts as two forces at the
!> corners with the same resultant. What blend gives beyond the gradient of its own energy (1 - w) U_corners + w U_face is
!> counted as lost in contact (it may be negative: weights that depend on the position have no potential).
!>
!> Source: Flores et al. (2008), section 4.3, (4.26) with the stiffness of a rectangle. Limits: short sides have corners only; with
!> faces the ends of the guide have no front and cut corners, not the part of a face: a corner that enters between the surfaces from
!> beyond an end starts its contact there, with energy that nothing gave.
module slider_contacts
   use faced_contacts, only: faced_contacts_t
   use kinds, only: wp
   use motion, only: motion_t
   use planar_contacts, only: planar_force
   use point_contact, only: point_contact_t
   use point_contacts, only: of_eccentricity, of_moment, point_gaps
   use slider_faces, only: bedding_energy, blend_energy, find_blend, find_face
   use text, only: text_t
   implicit none (type, external)
   private
   public :: faces_blend, faces_book, faces_corners, faces_foundation, lower, n_corner, slider_contacts_t, upper

   integer, parameter :: n_corner = 4                !! corners
   integer, parameter :: upper = 1                   !! contacts 1 to 4: corners at the upper surface
   integer, parameter :: lower = 2                   !! contacts 5 to 8: corners at the lower surface
   integer, parameter :: side_1(2) = [1, 4]          !! first corners of the long sides: A and D
   integer, parameter :: side_2(2) = [2, 3]          !! second corners: B and C

   integer, parameter :: faces_corners = 0     !! ways of treating faces
   integer, parameter :: faces_book = 1        !! the same
   integer, parameter :: faces_blend = 2       !! the same
   integer, parameter :: faces_foundation = 3  !! the same

   !> Guides of sliders.
   type :: guides_t
      real(wp), allocatable :: axis(:, :)              !! (2, n) unit axis of the guide, frame of i [1]
      real(wp), allocatable :: ends(:, :)              !! (2, n) ends of the guide along it, from P [m]
      integer, allocatable :: faces(:)                 !! (n) way of treating faces
      real(wp), allocatable :: face_parameters(:, :)   !! (n_law_parameter, n) of the face law [any]
   end type guides_t

   !> Sliders between surfaces.
   type, abstract, extends(faced_contacts_t) :: slider_contacts_t
      type(guides_t) :: guide   !! the guides
   contains
      procedure, nopass :: contact_labels => slider_contact_labels
      procedure :: gaps => slider_gaps
      procedure :: cut_at_ends => slider_cut_at_ends
      procedure :: report_item => slider_report_item
      procedure :: share_item => slider_share_item
      procedure :: face_energy => slider_face_energy
   end type slider_contacts_t

contains

   !> Corners A to D at the upper, then at the lower surface.
   pure function slider_contact_labels() result(labels)
      type(text_t), allocatable :: labels(:)  !! (8) names

      integer :: c

      allocate (labels(2*n_corner))
      do c = 1, n_corner
         labels(c)%s = achar(iachar("A") + c - 1)//"_upper"
         labels(n_corner + c)%s = achar(iachar("A") + c - 1)//"_lower"
      end do
   end function slider_contact_labels

   !> Penetrations and rates, those of guides with faces cut at their ends.
   subroutine slider_gaps(self, motion, delta, rate)
      class(slider_contacts_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      real(wp), intent(inout), contiguous :: delta(:)       !! (all contacts) penetration [m]
      real(wp), intent(inout), contiguous :: rate(:)        !! (all contacts) its rate [m/s]

      type(point_contact_t) :: contact
      integer :: k, m

      call point_gaps(self, motion, delta, rate)
      if (.not. self%traits%has_faces) return
      do k = 1, self%n_contact
         m = self%before%contacts + k
         call self%measure(k, .false., motion, contact)
         call slider_cut_at_ends(self, k, motion, contact, delta(m), rate(m))
      end do
   end subroutine slider_gaps

   !> Of a corner beyond an end of a guide with faces how far it is beyond, negative, if that is less than its penetration.
   pure subroutine slider_cut_at_ends(self, k, motion, contact, delta, rate)
      class(slider_contacts_t), intent(in) :: self    !! the set
      integer, intent(in) :: k                        !! contact
      type(motion_t), intent(in) :: motion            !! positions and velocities
      type(point_contact_t), intent(in) :: contact    !! its kinematics
      real(wp), intent(inout) :: delta                !! penetration [m]
      real(wp), intent(inout) :: rate                 !! its rate [m/s]

      real(wp) :: d(2), inside(2), s(2), speed, v(2)
      integer :: i, item, j

      item = self%item_of(k)
      if (self%guide%faces(item) == faces_corners .or. self%guide%ends(2, item) >= huge(1.0_wp)) return
      i = self%items%body(1, item)
      j = self%items%body(2, item)
      s = motion%rot(1:2, 1, i)*self%guide%axis(1, item) + motion%rot(1:2, 2, i)*self%guide%axis(2, item)
      associate (arm_i => contact%arm_i, arm_j => contact%arm_j)
         d = arm_i(1:2) - motion%rot(1:2, 1, i)*self%items%s_i(1, item) - motion%rot(1:2, 2, i)*self%items%s_i(2, item)
         v = motion%v(1:2, j) + motion%omega(3, j)*[-arm_j(2), arm_j(1)] &
             - motion%v(1:2, i) - motion%omega(3, i)*[-arm_i(2), arm_i(1)]
      end associate
      speed = dot_product(s, v)
      inside = [dot_product(s, d) - self%guide%ends(1, item), self%guide%ends(2, item) - dot_product(s, d)]
      if (minval(inside) >= delta) return
      delta = minval(inside)
      rate = merge(speed, -speed, inside(1) < inside(2))
   end subroutine slider_cut_at_ends

   !> The eccentricity, of the slider's centre from the guide's line, and the moment of the contact forces about that centre.
   subroutine slider_report_item(self, code, item, motion, contacts, f_n, f_t, value)
      class(slider_contacts_t), intent(in) :: self        !! the set
      integer, intent(in) :: code                         !! the channel
      integer, intent(in) :: item                         !! the item
      type(motion_t), intent(in) :: motion                !! positions and velocities
      type(point_contact_t), intent(in) :: contacts(self%n_contact_item)  !! (n_contact_item) kinematics of its contacts
      real(wp), intent(in) :: f_n(self%n_contact_item)    !! (n_contact_item) normal forces [N]
      real(wp), intent(in) :: f_t(self%n_contact_item)    !! (n_contact_item) friction forces on j along t [N]
      real(wp), intent(inout), contiguous :: value(:)     !! (components) the value [m or N.m]

      real(wp) :: across(2), arm(2), centre(2), f(3)
      integer :: c, i, j

      i = self%items%body(1, item)
      j = self%items%body(2, item)
      centre = matmul(motion%rot(1:2, 1:2, j), self%items%s_j(1:2, item))
      select case (code)
      case (of_eccentricity)
         across = motion%rot(1:2, 2, i)*self%guide%axis(1, item) - motion%rot(1:2, 1, i)*self%guide%axis(2, item)
         arm = motion%r(1:2, j) + centre - motion%r(1:2, i) - matmul(motion%rot(1:2, 1:2, i), self%items%s_i(1:2, item))
         value = dot_product(across, arm)*across
      case (of_moment)
         value = 0.0_wp
         do c = 1, self%n_contact_item
            f = planar_force(contacts(c), f_n(c), f_t(c))
            arm = contacts(c)%arm_j(1:2) - centre
            value(1) = value(1) + arm(1)*f(2) - arm(2)*f(1)
         end do
      end select
   end subroutine slider_report_item

   !> The contacts of the two corners of a long side at a surface: number q of the four of an item.
   pure function corners_of(q) result(c)
      integer, intent(in) :: q  !! sides 1, 2 at the upper, 3, 4: at the lower surface
      integer :: c(2)           !! (2) contacts of the item

      integer :: side

      side = modulo(q - 1, 2) + 1
      c = (q - side)/2*n_corner + [side_1(side), side_2(side)]
   end function corners_of

   !> Let faces of an item take over from their corners.
   subroutine slider_share_item(self, item, contacts, f_n, f_elastic, f_friction)
      class(slider_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: item                           !! the item
      type(point_contact_t), intent(in) :: contacts(:)      !! (8) penetrations and rates of its contacts
      real(wp), intent(inout) :: f_n(:)                     !! (8) normal forces, as the normal law gives them [N]
      real(wp), intent(inout) :: f_elastic(:)               !! (8) derivatives of the stored energy by the penetrations [N]
      real(wp), intent(inout) :: f_friction(:)                   !! (8) normal forces that friction feels [N]

      real(wp) :: d(2), f(2), f_d(2), impact_speed(2), rate(2)
      integer :: c(2), q
      logical :: is_touching(2)

      f_friction = f_n
      if (self%guide%faces(item) == faces_corners) return
      do q = 1, n_corner
         c = corners_of(q)
         associate (memory => self%contact((item - 1)*self%n_contact_item + c))
            is_touching = memory%is_touching
            impact_speed = merge(memory%impact_speed, 0.0_wp, is_touching)
         end associate
         if (.not. any(is_touching) .or. (self%guide%faces(item) /= faces_foundation .and. .not. all(is_touching))) cycle
         if (.not. all(is_touching)) impact_speed = sum(impact_speed)
         d = contacts(c)%delta
         rate = contacts(c)%rate
         f = f_n(c)
         f_d = f_elastic(c)
         if (self%guide%faces(item) == faces_blend) then
            call find_blend(self%laws%face, self%guide%face_parameters(:, item), d, rate, impact_speed, corner_energy(self, item, &
                            c, d), &
                            f, f_d)
         else
            call find_face(self%laws%face, self%guide%face_parameters(:, item), d, rate, impact_speed, f, f_d)
         end if
         f_n(c) = f
         f_elastic(c) = f_d
         f_friction(c) = merge(merge(f, sum(f), all(is_touching)), 0.0_wp, is_touching)
      end do
   end subroutine slider_share_item

   !> Elastic energy of two corners.
   function corner_energy(self, item, c, d) result(energy)
      class(slider_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: item                           !! the item
      integer, intent(in) :: c(2)                           !! (2) contacts of the item
      real(wp), intent(in) :: d(2)                          !! (2) their penetrations [m]
      real(wp) :: energy                                    !! of those that touch [J]

      integer :: k, m

      energy = 0.0_wp
      do k = 1, 2
         m = (item - 1)*self%n_contact_item + c(k)
         if (self%contact(m)%is_touching) energy = energy + self%laws%normal%potential(d(k), self%laws%parameters(:, m))
      end do
   end function corner_energy

   !> Elastic energy of the corners and faces of an item.
   function slider_face_energy(self, item, contacts) result(energy)
      class(slider_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: item                           !! the item
      type(point_contact_t), intent(in) :: contacts(:)      !! (8) penetrations and rates of its contacts
      real(wp) :: energy                                    !! energy stored [J]

      real(wp) :: d(2), of_corners
      integer :: c(2), q
      logical :: is_touching(2)

      energy = 0.0_wp
      do q = 1, n_corner
         c = corners_of(q)
         is_touching = self%contact((item - 1)*self%n_contact_item + c)%is_touching
         if (.not. any(is_touching)) cycle
         d = contacts(c)%delta
         of_corners = corner_energy(self, item, c, d)
         if (self%guide%faces(item) == faces_foundation) then
            energy = energy + bedding_energy(self%laws%face, self%guide%face_parameters(:, item), d)
         else if (self%guide%faces(item) == faces_corners .or. .not. all(is_touching)) then
            energy = energy + of_corners
         else if (self%guide%faces(item) == faces_blend) then
            energy = energy + blend_energy(self%laws%face, self%guide%face_parameters(:, item), d, of_corners)
         else
            energy = energy + bedding_energy(self%laws%face, self%guide%face_parameters(:, item), d)
         end if
      end do
   end function slider_face_energy

end module slider_contacts
