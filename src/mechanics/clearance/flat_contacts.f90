!> Planar: points or circles of body j against planes fixed in body i.
!>
!> Contact m: A is a point of j, or the centre of a circle of radius R; P is a point of i, n the unit normal of a plane of i,
!> into its material, h its distance from P along n:
!> d = r_A - r_P,   delta = n . d - h   (h less R of a circle),   rate = n . (v_A - v_i(A)) = d(delta)/dt
!> delta'' = n . (a_A - a_P) + 2 w_i t . (v_A - v_P) + d . (alpha_i t - w_i^2 n),   t = R90 n
!>
!> Planes may start and end along an axis s of i, from P (`ends`). The material behind such a plane has a front at each end, with
!> the normal s at the first and -s at the second, and a point in it is pressed out by the shortest way: n and delta are those of
!> the nearest of the plane and both fronts. So delta, and what is stored, is continuous all around, and nothing is made of
!> nothing where a point comes over an end.
!>
!> C is the point A itself, or, of a circle, the middle between the two surfaces, A + (R - delta/2) n. Forces: see `point_contacts`.
!>
!> Source: Flores et al. (2008), section 4.3, corrected: signed penetration instead of (4.20), velocities of material points
!> instead of (4.21), one common point of application instead of two. Limits: points have ends, circles have none.
module flat_contacts
   use clearance_set, only: loss_contact, loss_friction, n_integrand, normal_impulse
   use contact_laws, only: press_in_course
   use contact_memory, only: contact_memory_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use normal_law, only: n_law_parameter, normal_law_t
   use point_contact, only: point_contact_t
   use planar_points, only: planar_points_t
   implicit none (type, external)
   private
   public :: flat_contacts_t

   !> Planes, and what comes near them.
   type :: plane_surfaces_t
      real(wp), allocatable :: normal_i(:, :)   !! (2, n_contact) normal of the plane, frame of i [1]
      real(wp), allocatable :: point_j(:, :)    !! (2, n_contact) the point A, frame of j [m]
      real(wp), allocatable :: height(:)        !! (n_contact) h: plane from P along the normal, less the radius [m]
      real(wp), allocatable :: radius(:)        !! (n_contact) radius of the circle, 0: a point [m]
      logical :: has_ends = .false.             !! some planes end
      real(wp), allocatable :: axis_i(:, :)     !! (2, n_contact) s along the plane, frame of i [1]
      real(wp), allocatable :: ends(:, :)       !! (2, n_contact) where it starts and ends along s, from P; huge: nowhere [m]
   end type plane_surfaces_t

   !> Points or circles against planes. `prepare` of a geometry calls `make_planes` and fills the parameters.
   type, abstract, extends(planar_points_t) :: flat_contacts_t
      type(plane_surfaces_t) :: plane   !! planes, and what comes near them
   contains
      procedure, non_overridable :: make_planes
      procedure :: evaluate => flat_evaluate
      procedure :: measure => measure_one
      procedure :: penetration_acceleration => flat_penetration_acceleration
      procedure :: turning => flat_turning
      procedure :: span_of => flat_span_of
   end type flat_contacts_t

contains

   !> Storage for the parameters.
   subroutine make_planes(self)
      class(flat_contacts_t), intent(inout) :: self  !! the set

      integer :: m

      m = self%n_contact
      call self%make_storage()
      allocate (self%plane%normal_i(2, m), self%plane%point_j(2, m), self%plane%height(m), self%plane%radius(m), source=0.0_wp)
      allocate (self%plane%axis_i(2, m), source=0.0_wp)
      allocate (self%plane%ends(2, m), source=huge(1.0_wp))
      self%plane%ends(1, :) = -huge(1.0_wp)
   end subroutine make_planes

   !> Add the contact forces of the touching contacts.
   subroutine flat_evaluate(self, motion, loads, integrands)
      class(flat_contacts_t), intent(inout) :: self         !! the set
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(loads_t), intent(inout) :: loads                 !! loads on the bodies
      real(wp), intent(inout) :: integrands(n_integrand, self%n_contact)  !! (3, contacts) power lost and normal force [W and N]

      include "point_way.inc"
   end subroutine flat_evaluate

   include "push.inc"
   include "planar_loads.inc"

   !> Measure the contacts that touch, all of them where they share faces or act apart, and take what the law gets of them.
   subroutine measure_touching(self, motion)
      class(flat_contacts_t), intent(inout) :: self  !! the set; kinematics are set
      type(motion_t), intent(in) :: motion           !! positions and velocities

      type(point_contact_t) :: contact
      integer :: k

      do k = 1, self%n_contact
         if (self%contact(k)%is_touching .or. self%traits%has_faces .or. self%laws%normal%acts_apart) then
            call measure_one(self, k, .true., motion, contact)
            self%work%contacts(k) = contact
         end if
         call take_contact(self%contact(k), self%work%contacts(k), self%laws%normal%acts_apart, self%work%delta(k), &
                           self%work%rate(k), self%work%impact_speed(k))
      end do
   end subroutine measure_touching

   !> Normal, penetration, its rate, arms and sliding velocity, which costs nothing here.
   pure subroutine measure_one(self, k, with_sliding, motion, contact)
      class(flat_contacts_t), intent(in) :: self       !! the set
      integer, intent(in) :: k                         !! contact
      logical, intent(in) :: with_sliding              !! its sliding velocity too
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(point_contact_t), intent(inout) :: contact  !! kinematics

      real(wp) :: along(2), arm_i(2), arm_j(2), d(2), n(2), reach, s_i(2), s_j(2), v(2)
      integer :: i, item, j

      item = self%item_of(k)
      i = self%items%body(1, item)
      j = self%items%body(2, item)
      s_i = motion%rot(1:2, 1, i)*self%items%s_i(1, item) + motion%rot(1:2, 2, i)*self%items%s_i(2, item)
      s_j = motion%rot(1:2, 1, j)*self%plane%point_j(1, k) + motion%rot(1:2, 2, j)*self%plane%point_j(2, k)
      n = motion%rot(1:2, 1, i)*self%plane%normal_i(1, k) + motion%rot(1:2, 2, i)*self%plane%normal_i(2, k)
      d = motion%r(1:2, j) + s_j - motion%r(1:2, i) - s_i
      contact%delta = dot_product(n, d) - self%plane%height(k)
      if (self%plane%has_ends) then
         along = motion%rot(1:2, 1, i)*self%plane%axis_i(1, k) + motion%rot(1:2, 2, i)*self%plane%axis_i(2, k)
         call find_nearest(along, dot_product(along, d), self%plane%ends(:, k), n, contact%delta)
      end if
      reach = 0.0_wp
      if (self%plane%radius(k) > 0.0_wp) reach = self%plane%radius(k) - 0.5_wp*contact%delta
      arm_j = s_j + reach*n
      arm_i = motion%r(1:2, j) - motion%r(1:2, i) + arm_j
      v = motion%v(1:2, j) + motion%omega(3, j)*[-arm_j(2), arm_j(1)] &
          - motion%v(1:2, i) - motion%omega(3, i)*[-arm_i(2), arm_i(1)]
      contact%rate = dot_product(n, v)
      contact%v_t = n(1)*v(2) - n(2)*v(1)
      contact%v_t_work = contact%v_t
      contact%normal(1:2) = n
      contact%arm_i(1:2) = arm_i
      contact%arm_j(1:2) = arm_j
   end subroutine measure_one

   !> The nearest of a plane and of the fronts at its ends.
   pure subroutine find_nearest(along, place, ends, n, delta)
      real(wp), intent(in) :: along(2)      !! (2) s, world frame [1]
      real(wp), intent(in) :: place         !! of the point along it [m]
      real(wp), intent(in) :: ends(2)       !! (2) where the plane starts and ends [m]
      real(wp), intent(inout) :: n(2)       !! (2) normal of the plane; of what is nearest, world frame [1]
      real(wp), intent(inout) :: delta      !! penetration of the plane; of what is nearest [m]

      if (place - ends(1) < delta) then
         n = along
         delta = place - ends(1)
      end if
      if (ends(2) - place < delta) then
         n = -along
         delta = ends(2) - place
      end if
   end subroutine find_nearest

   !> Second derivative of a penetration by time.
   pure real(wp) function flat_penetration_acceleration(self, k, motion, contact) result(acceleration)
      class(flat_contacts_t), intent(in) :: self    !! the set
      integer, intent(in) :: k                      !! contact
      type(motion_t), intent(in) :: motion          !! positions, velocities and accelerations
      type(point_contact_t), intent(in) :: contact  !! its kinematics

      real(wp) :: a(2), d(2), s_i(2), s_j(2), tangent(2), v(2)
      integer :: i, item, j

      item = self%item_of(k)
      i = self%items%body(1, item)
      j = self%items%body(2, item)
      s_i = motion%rot(1:2, 1, i)*self%items%s_i(1, item) + motion%rot(1:2, 2, i)*self%items%s_i(2, item)
      s_j = motion%rot(1:2, 1, j)*self%plane%point_j(1, k) + motion%rot(1:2, 2, j)*self%plane%point_j(2, k)
      tangent = [-contact%normal(2), contact%normal(1)]
      d = motion%r(1:2, j) + s_j - motion%r(1:2, i) - s_i
      v = motion%v(1:2, j) + motion%omega(3, j)*[-s_j(2), s_j(1)] - motion%v(1:2, i) - motion%omega(3, i)*[-s_i(2), s_i(1)]
      a = motion%a(1:2, j) + motion%alpha(3, j)*[-s_j(2), s_j(1)] - motion%omega(3, j)**2*s_j &
          - motion%a(1:2, i) - motion%alpha(3, i)*[-s_i(2), s_i(1)] + motion%omega(3, i)**2*s_i
      acceleration = dot_product(contact%normal(1:2), a) + 2.0_wp*motion%omega(3, i)*dot_product(tangent, v) &
                     + dot_product(d, motion%alpha(3, i)*tangent - motion%omega(3, i)**2*contact%normal(1:2))
   end function flat_penetration_acceleration

   !> The normal turns with body i; the point of contact moves with the point A, and in a circle towards it by half the penetration.
   pure subroutine flat_turning(self, k, motion, contact, turn, speed_i, speed_j)
      class(flat_contacts_t), intent(in) :: self     !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions and velocities
      type(point_contact_t), intent(in) :: contact   !! its kinematics
      real(wp), intent(out) :: turn                  !! rate at which the normal turns towards t [rad/s]
      real(wp), intent(out) :: speed_i               !! n . s_i', from the centre of mass of i [m/s]
      real(wp), intent(out) :: speed_j               !! n . s_j', from the centre of mass of j [m/s]

      real(wp) :: nearer, s_j(2), v(2)
      integer :: i, item, j

      item = self%item_of(k)
      i = self%items%body(1, item)
      j = self%items%body(2, item)
      s_j = motion%rot(1:2, 1, j)*self%plane%point_j(1, k) + motion%rot(1:2, 2, j)*self%plane%point_j(2, k)
      v = motion%omega(3, j)*[-s_j(2), s_j(1)]  ! of the point A, from the centre of mass
      nearer = merge(0.5_wp*contact%rate, 0.0_wp, self%plane%radius(k) > 0.0_wp)
      turn = motion%omega(3, i)
      speed_i = dot_product(contact%normal(1:2), motion%v(1:2, j) + v - motion%v(1:2, i)) - nearer
      speed_j = dot_product(contact%normal(1:2), v) - nearer
   end subroutine flat_turning

   !> How far plane and point of a contact are from the centres of mass.
   pure function flat_span_of(self, contact) result(span)
      class(flat_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact              !! contact of the set
      real(wp) :: span(2)                         !! (2) in bodies i and j [m]

      associate (item => self%item_of(contact))
         span = [sum(abs(self%items%s_i(:, item))) + abs(self%plane%height(contact)), sum(abs(self%plane%point_j(:, contact)))]
      end associate
   end function flat_span_of

end module flat_contacts
