!> Planar: circles of body j beside or inside curves fixed in body i, and straight faces of body j on convex curves of body i.
!>
!> p is the centre of the circle of radius R, q the nearest place of the curve of i (`profile_curve`), n into the material of i:
!> cam    delta = R + n . (p - q),   n to the inside of the closed curve,       b = -kappa/(1 + kappa |p - q|) outside
!> slot   delta = |p - q| - c,       n = (p - q)/|p - q|, c half the width of the slot less R,   b = kappa_n/(1 + kappa_n |p - q|)
!> corner delta = R - |p - q|,       n = (q - p)/|p - q|, q of the mouth of a slot,              b = -1/|p - q|
!>
!> with kappa the curvature of the curve, kappa_n that which counts on the side of n (positive where it bends away from n), and
!> b = 1/|p - q| at the round end of a slot. With w = p' as body i sees it and t = R90 n:
!> rate = n . w,   delta'' = n . p'' as body i sees it + b (t . w)^2,   n turns with omega_i + b t . w
!>
!> A face of j through the point P has the unit normal n out of j, q is the place of the curve that is farthest against n:
!> delta = n . (P - q),   q moves along the curve with (omega_j - omega_i)/kappa,   n turns with omega_j.
!>
!> C is the middle between the surfaces; rates and sliding velocities are those of the material points there, forces:
!> `point_contacts`.
!>
!> Laws are fitted to the curvature where the surfaces meet: 1/R_e = kappa + 1/R of a circle, kappa of a face. Where that varies
!> along the curve parameters come from splines over ln R_e, and what they do to the stored energy U at a given penetration is
!> counted as lost in contact, with its sign: -dU/dR_e R_e'.
!>
!> Source: do Carmo, Differential geometry of curves and surfaces (1976), section 1.5 (parallel curves); Flores et al. (2008),
!> sections 3.1 and 4.2. Limits: one contact for an item: a circle finds room in every hollow (`clearance_cam`); a face meets a
!> convex curve, and has no ends.
module curve_contacts
   use clearance_set, only: clearance_fit, clearance_note_contact_rate, loss_contact, loss_friction, n_integrand, normal_impulse
   use contact_laws, only: press_in_course
   use contact_memory, only: contact_memory_t
   use curve_stiffness, only: fit_curved, law_along_t, parameters_at
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use normal_law, only: n_law_parameter, normal_law_t
   use planar_points, only: planar_points_t
   use point_contact, only: point_contact_t
   use profile_curve, only: at_corner, curvature_at, find_nearest, find_support, foot_t, profile_t
   implicit none (type, external)
   private
   public :: curve_contacts_t, curved_t, meets_cam, meets_face, meets_slot

   integer, parameter :: meets_cam = 1    !! a circle beside a closed curve
   integer, parameter :: meets_slot = 2   !! a circle in a slot about a curve
   integer, parameter :: meets_face = 3   !! a face on a closed curve

   !> One item: a curve, and what meets it.
   type :: curved_t
      integer :: meets = meets_cam            !! one of the above
      type(profile_t) :: profile              !! the curve
      real(wp) :: radius = 0.0_wp             !! R of the circle; 0: a point, or a face [m]
      real(wp) :: offset = 0.0_wp             !! delta less n . (p - q): R, -c or 0 [m]
      real(wp) :: normal_j(2) = 0.0_wp        !! (2) n of a face, frame of j [1]
      type(law_along_t) :: along              !! parameters of the law along the curve
   end type curved_t

   !> Where a contact is, in the frame of body i.
   type :: meeting_t
      type(foot_t) :: foot             !! the place of the curve
      real(wp) :: d(2) = 0.0_wp        !! (2) from the point of i to p or P, world frame [m]
      real(wp) :: s_i(2) = 0.0_wp      !! (2) the point of i from its centre of mass, world frame [m]
      real(wp) :: s_j(2) = 0.0_wp      !! (2) p or P from the centre of mass of j, world frame [m]
      real(wp) :: n(2) = 0.0_wp        !! (2) n, world frame [1]
      real(wp) :: delta = 0.0_wp       !! penetration [m]
      real(wp) :: b = 0.0_wp           !! b; of a face 1/kappa [1/m or m]
   end type meeting_t

   !> Circles and faces on curves. `prepare` of a geometry calls `make_curves` and fills `curved`.
   type, abstract, extends(planar_points_t) :: curve_contacts_t
      type(curved_t), allocatable :: curved(:)             !! (n) the curves, and what meets them
      type(meeting_t), allocatable, private :: meeting(:)  !! (n) where the contacts that act are, of the last evaluation
   contains
      procedure, non_overridable :: make_curves
      procedure :: evaluate => curve_evaluate
      procedure :: measure => measure_one
      procedure :: penetration_acceleration => curve_penetration_acceleration
      procedure :: turning => curve_turning
      procedure :: span_of => curve_span_of
      procedure :: fit => curve_fit
      procedure :: note_contact_rate => curve_note_contact_rate
      procedure :: elastic_energy => curve_elastic_energy
   end type curve_contacts_t

contains

   !> Storage for the curves.
   subroutine make_curves(self)
      class(curve_contacts_t), intent(inout) :: self  !! the set

      call self%make_storage()
      allocate (self%curved(self%n), self%meeting(self%n))
   end subroutine make_curves

   !> Add the contact forces of the touching contacts.
   subroutine curve_evaluate(self, motion, loads, integrands)
      class(curve_contacts_t), intent(inout) :: self        !! the set
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(loads_t), intent(inout) :: loads                 !! loads on the bodies
      real(wp), intent(inout) :: integrands(n_integrand, self%n_contact)  !! (3, contacts) power lost and normal force [W and N]

      integer :: k

      include "point_way.inc"
      do k = 1, self%n
         if (self%curved(k)%along%varies .and. self%contact(k)%is_touching) then
            integrands(loss_contact, k) = integrands(loss_contact, k) - stiffening_power(self, k, motion)
         end if
      end do
   end subroutine curve_evaluate

   include "push.inc"
   include "planar_loads.inc"

   !> Measure the contacts that touch, all of them where they act apart, and take what the law gets of them.
   subroutine measure_touching(self, motion)
      class(curve_contacts_t), intent(inout) :: self  !! the set; kinematics and parameters of the law are set
      type(motion_t), intent(in) :: motion            !! positions and velocities

      integer :: k

      do k = 1, self%n
         if (self%contact(k)%is_touching .or. self%laws%normal%acts_apart) then
            call meet(self, k, motion, self%meeting(k))
            call take_meeting(self, k, motion, self%meeting(k), self%work%contacts(k))
            if (self%curved(k)%along%varies) then
               self%laws%parameters(:, k) = parameters_at(self%curved(k)%along, self%curved(k)%radius, &
                                                          self%meeting(k)%foot%curvature)
            end if
         end if
         call take_contact(self%contact(k), self%work%contacts(k), self%laws%normal%acts_apart, self%work%delta(k), &
                           self%work%rate(k), self%work%impact_speed(k))
      end do
   end subroutine measure_touching

   !> Normal, penetration, its rate, arms and sliding velocity, which costs nothing here.
   pure subroutine measure_one(self, k, with_sliding, motion, contact)
      class(curve_contacts_t), intent(in) :: self      !! the set
      integer, intent(in) :: k                         !! contact
      logical, intent(in) :: with_sliding              !! its sliding velocity too
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(point_contact_t), intent(inout) :: contact  !! kinematics

      type(meeting_t) :: meeting

      call meet(self, k, motion, meeting)
      call take_meeting(self, k, motion, meeting, contact)
   end subroutine measure_one

   !> Where a contact is.
   pure subroutine meet(self, k, motion, meeting)
      class(curve_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                     !! contact
      type(motion_t), intent(in) :: motion         !! positions
      type(meeting_t), intent(out) :: meeting      !! where it is

      real(wp) :: bend, distance, e(2), n(2), side

      associate (curved => self%curved(k), rot_i => motion%rot(1:2, 1:2, self%items%body(1, k)), &
                 rot_j => motion%rot(1:2, 1:2, self%items%body(2, k)), foot => meeting%foot)
         meeting%s_i = matmul(rot_i, self%items%s_i(1:2, k))
         meeting%s_j = matmul(rot_j, self%items%s_j(1:2, k))
         meeting%d = motion%r(1:2, self%items%body(2, k)) + meeting%s_j - motion%r(1:2, self%items%body(1, k)) - meeting%s_i
         if (curved%meets == meets_face) then
            meeting%n = matmul(rot_j, curved%normal_j)
            n = matmul(meeting%n, rot_i)
            call find_support(curved%profile, n, foot)
            meeting%delta = dot_product(meeting%n, meeting%d) - dot_product(n, foot%q)
            meeting%b = 1.0_wp/foot%curvature
            return
         end if
         e = matmul(meeting%d, rot_i)
         call find_nearest(curved%profile, e, foot)
         e = e - foot%q
         n = [-foot%tangent(2), foot%tangent(1)]
         distance = norm2(e)
         if (curved%meets == meets_slot .and. foot%end /= 0 .and. distance > tiny(1.0_wp)) then
            side = merge(-1.0_wp, 1.0_wp, foot%end == at_corner)
            n = side*e/distance
            meeting%b = side/distance
            distance = side*distance
         else
            side = 1.0_wp
            if (curved%meets == meets_slot) side = sign(1.0_wp, dot_product(n, e))
            n = side*n
            distance = dot_product(n, e)
            bend = 1.0_wp - side*foot%curvature*distance  ! zero where p is in the centre of curvature
            meeting%b = -side*foot%curvature/sign(max(abs(bend), epsilon(1.0_wp)), bend)
         end if
         meeting%n = matmul(rot_i, n)
         meeting%delta = distance + merge(curved%radius, curved%offset, foot%end == at_corner)
      end associate
   end subroutine meet

   !> Kinematics of a contact from where it is.
   pure subroutine take_meeting(self, k, motion, meeting, contact)
      class(curve_contacts_t), intent(in) :: self      !! the set
      integer, intent(in) :: k                         !! contact
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(meeting_t), intent(in) :: meeting           !! where it is
      type(point_contact_t), intent(inout) :: contact  !! its kinematics

      real(wp) :: arm_i(2), arm_j(2), v(2)

      associate (i => self%items%body(1, k), j => self%items%body(2, k), n => meeting%n)
         if (self%curved(k)%meets == meets_face) then
            arm_i = meeting%s_i + matmul(motion%rot(1:2, 1:2, i), meeting%foot%q) + 0.5_wp*meeting%delta*n
            arm_j = motion%r(1:2, i) - motion%r(1:2, j) + arm_i
         else
            arm_j = meeting%s_j + (self%curved(k)%radius - 0.5_wp*meeting%delta)*n
            arm_i = motion%r(1:2, j) - motion%r(1:2, i) + arm_j
         end if
         v = motion%v(1:2, j) + motion%omega(3, j)*[-arm_j(2), arm_j(1)] &
             - motion%v(1:2, i) - motion%omega(3, i)*[-arm_i(2), arm_i(1)]
         contact%delta = meeting%delta
         contact%rate = dot_product(n, v)
         contact%v_t = n(1)*v(2) - n(2)*v(1)
         contact%v_t_work = contact%v_t
         contact%normal(1:2) = n
         contact%arm_i(1:2) = arm_i
         contact%arm_j(1:2) = arm_j
      end associate
   end subroutine take_meeting

   !> Velocity of p or P as body i sees it, world frame.
   pure function velocity_in_i(self, k, motion, meeting) result(w)
      class(curve_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                     !! contact
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(meeting_t), intent(in) :: meeting       !! where it is
      real(wp) :: w(2)                             !! (2) the velocity [m/s]

      real(wp) :: arm(2)

      associate (i => self%items%body(1, k), j => self%items%body(2, k))
         arm = meeting%s_i + meeting%d
         w = motion%v(1:2, j) + motion%omega(3, j)*[-meeting%s_j(2), meeting%s_j(1)] &
             - motion%v(1:2, i) - motion%omega(3, i)*[-arm(2), arm(1)]
      end associate
   end function velocity_in_i

   !> Second derivative of a penetration by time.
   pure real(wp) function curve_penetration_acceleration(self, k, motion, contact) result(acceleration)
      class(curve_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                      !! contact
      type(motion_t), intent(in) :: motion          !! positions, velocities and accelerations
      type(point_contact_t), intent(in) :: contact  !! its kinematics

      type(meeting_t) :: meeting
      real(wp) :: a(2), arm(2), t(2), w(2)

      call meet(self, k, motion, meeting)
      if (self%curved(k)%meets == meets_face) then
         acceleration = face_acceleration(self, k, motion, meeting)
         return
      end if
      t = [-meeting%n(2), meeting%n(1)]
      associate (i => self%items%body(1, k), j => self%items%body(2, k), s_j => meeting%s_j)
         arm = meeting%s_i + meeting%d
         w = velocity_in_i(self, k, motion, meeting)
         a = motion%a(1:2, j) + motion%alpha(3, j)*[-s_j(2), s_j(1)] - motion%omega(3, j)**2*s_j &
             - motion%a(1:2, i) - motion%alpha(3, i)*[-arm(2), arm(1)] + motion%omega(3, i)**2*arm &
             - 2.0_wp*motion%omega(3, i)*[-w(2), w(1)]
      end associate
      acceleration = dot_product(meeting%n, a) + meeting%b*dot_product(t, w)**2
   end function curve_penetration_acceleration

   !> The same of a face: derivative of n . (V_j - V_i) at q, which moves.
   pure real(wp) function face_acceleration(self, k, motion, meeting) result(acceleration)
      class(curve_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                     !! contact
      type(motion_t), intent(in) :: motion         !! positions, velocities and accelerations
      type(meeting_t), intent(in) :: meeting       !! where it is

      real(wp) :: arm_i(2), arm_j(2), q_dot(2), rate(2), spin, t(2), v_i(2), v_j(2)

      t = [-meeting%n(2), meeting%n(1)]
      associate (i => self%items%body(1, k), j => self%items%body(2, k))
         arm_i = meeting%s_i + matmul(motion%rot(1:2, 1:2, i), meeting%foot%q)
         arm_j = motion%r(1:2, i) + arm_i - motion%r(1:2, j)
         spin = motion%omega(3, j) - motion%omega(3, i)
         v_i = motion%v(1:2, i) + motion%omega(3, i)*[-arm_i(2), arm_i(1)]
         v_j = motion%v(1:2, j) + motion%omega(3, j)*[-arm_j(2), arm_j(1)]
         q_dot = v_i - spin*meeting%b*t
         rate = motion%a(1:2, j) + motion%alpha(3, j)*[-arm_j(2), arm_j(1)] - motion%omega(3, j)**2*arm_j &
                - motion%a(1:2, i) - motion%alpha(3, i)*[-arm_i(2), arm_i(1)] + motion%omega(3, i)**2*arm_i &
                - motion%omega(3, j)*[-v_j(2), v_j(1)] + motion%omega(3, i)*[-v_i(2), v_i(1)] + spin*[-q_dot(2), q_dot(1)]
         acceleration = dot_product(meeting%n, rate) + motion%omega(3, j)*dot_product(t, v_j - v_i)
      end associate
   end function face_acceleration

   !> How the normal turns, and how fast the point of contact goes along it.
   pure subroutine curve_turning(self, k, motion, contact, turn, speed_i, speed_j)
      class(curve_contacts_t), intent(in) :: self    !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions and velocities
      type(point_contact_t), intent(in) :: contact   !! its kinematics
      real(wp), intent(out) :: turn                  !! rate at which the normal turns towards t [rad/s]
      real(wp), intent(out) :: speed_i               !! n . s_i', from the centre of mass of i [m/s]
      real(wp), intent(out) :: speed_j               !! n . s_j', from the centre of mass of j [m/s]

      type(meeting_t) :: meeting
      real(wp) :: arm(2), t(2), v(2)

      call meet(self, k, motion, meeting)
      t = [-meeting%n(2), meeting%n(1)]
      associate (i => self%items%body(1, k), j => self%items%body(2, k), n => meeting%n)
         v = motion%v(1:2, j) - motion%v(1:2, i)
         if (self%curved(k)%meets == meets_face) then
            turn = motion%omega(3, j)
            arm = meeting%s_i + matmul(motion%rot(1:2, 1:2, i), meeting%foot%q)
            speed_i = motion%omega(3, i)*dot_product(n, [-arm(2), arm(1)]) + 0.5_wp*contact%rate
            speed_j = speed_i - dot_product(n, v)
         else
            turn = motion%omega(3, i) + meeting%b*dot_product(t, velocity_in_i(self, k, motion, meeting))
            speed_j = motion%omega(3, j)*dot_product(n, [-meeting%s_j(2), meeting%s_j(1)]) - 0.5_wp*contact%rate
            speed_i = speed_j + dot_product(n, v)
         end if
      end associate
   end subroutine curve_turning

   !> What the change of the stiffness along the curve adds to the stored energy: dU/dR_e R_e'.
   real(wp) function stiffening_power(self, k, motion) result(power)
      class(curve_contacts_t), intent(in) :: self  !! the set, measured
      integer, intent(in) :: k                     !! contact that touches
      type(motion_t), intent(in) :: motion         !! positions and velocities

      real(wp), parameter :: part = 1.0e-5_wp  ! of the curve, for differences [1]
      real(wp) :: energy(2), h, speed, t(2)
      integer :: side

      associate (meeting => self%meeting(k), curved => self%curved(k), foot => self%meeting(k)%foot, &
                 i => self%items%body(1, k), j => self%items%body(2, k))
         t = [-meeting%n(2), meeting%n(1)]
         if (curved%meets == meets_face) then
            speed = (motion%omega(3, j) - motion%omega(3, i))*meeting%b
         else  ! along the tangent, which is -t
            speed = -dot_product(t, velocity_in_i(self, k, motion, meeting))*(1.0_wp - meeting%b*(meeting%delta - curved%offset))
         end if
         h = part*(curved%profile%range(2) - curved%profile%range(1))
         do side = 1, 2
            energy(side) = self%laws%normal%potential(meeting%delta, parameters_at(curved%along, curved%radius, &
               curvature_at(curved%profile, foot%u + merge(-h, h, side == 1))))
         end do
         power = (energy(2) - energy(1))/(2.0_wp*h)*speed/foot%pace
      end associate
   end function stiffening_power

   !> Elastic energy that the touching contacts store, with the parameters of the place where each is.
   function curve_elastic_energy(self, motion) result(energy)
      class(curve_contacts_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion         !! positions
      real(wp) :: energy                           !! energy stored [J]

      integer :: k
      real(wp) :: parameters(n_law_parameter)
      type(meeting_t) :: meeting

      energy = 0.0_wp
      do k = 1, self%n
         if (.not. (self%contact(k)%is_touching .or. self%laws%normal%acts_apart)) cycle
         call meet(self, k, motion, meeting)
         parameters = self%laws%parameters(:, k)
         associate (curved => self%curved(k))
            if (curved%along%varies) parameters = parameters_at(curved%along, curved%radius, meeting%foot%curvature)
         end associate
         energy = energy + self%laws%normal%potential(meeting%delta, parameters)
      end do
   end function curve_elastic_energy

   !> How far the curve and what meets it are from the centres of mass.
   pure function curve_span_of(self, contact) result(span)
      class(curve_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact               !! contact of the set
      real(wp) :: span(2)                          !! (2) in bodies i and j [m]

      span = [sum(abs(self%items%s_i(:, contact))) + maxval(abs(self%curved(contact)%profile%q)), &
              sum(abs(self%items%s_j(:, contact))) + self%curved(contact)%radius]
   end function curve_span_of

   !> Fit the law to the surfaces of an item, and to the curvature along it.
   subroutine curve_fit(self, k)
      class(curve_contacts_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! the item

      call clearance_fit(self, k)
      if (self%curved(k)%meets == meets_slot) return
      call fit_curved(self%laws%normal, self%laws%parameters(:, k), self%items%pairs(k), self%curved(k)%profile, &
                      self%curved(k)%radius, self%curved(k)%along)
   end subroutine curve_fit

   !> Contact rate of a contact that has started, of the parameters that the law has at the reference curvature: a restart finds
   !> the same.
   pure subroutine curve_note_contact_rate(self, k, delta)
      class(curve_contacts_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: delta                   !! its penetration [m]

      if (self%curved(k)%along%varies) self%laws%parameters(:, k) = self%curved(k)%along%reference
      call clearance_note_contact_rate(self, k, delta)
   end subroutine curve_note_contact_rate

end module curve_contacts
