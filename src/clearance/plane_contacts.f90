!> Contacts in space between points of body j and planes fixed in body i.
!>
!> With p a point fixed in j, n the unit normal of a plane of i, into its material, h its distance along n from the point of the
!> item in i, and d from that point to p:
!>
!> delta = n . d - h,   rate = n . w,   w = d' - omega_i x d,   delta'' = n . (w' as body i sees it),
!>
!> forces as in `point_contacts`, at p: C is the point p. A geometry gives normals and points along the axes of its item, x, y, z
!> of `find_frames`, in `prepare`; the axes are found in `set_start`.
!>
!> Signs: see `point_contact`. Source: Flores et al. (2008), section 4.3, with the surfaces of space. Limits: planes have no ends.
module plane_contacts
   use clearance_set, only: loss_contact, loss_friction
   use contact_grip, only: tangent_t
   use contact_laws, only: press_in_course
   use contact_memory, only: contact_memory_t
   use item, only: item_t
   use joint_frames, only: find_frames
   use kinds, only: wp
   use motion, only: cross, loads_t, motion_t
   use normal_law, only: n_law_parameter, normal_law_t
   use point_contact, only: point_contact_t
   use point_contacts, only: of_axial_displacement, of_eccentricity, of_moment, of_tilt, point_contacts_t
   use space_tangents, only: lie_in_space, set_sliding, spatial_force
   use spatial_rows, only: axis_of
   implicit none (type, external)
   private
   public :: plane_contacts_t

   !> Points and planes along the axes of their item, and in the frames of the bodies.
   type :: planes_t
      real(wp), allocatable :: normal(:, :)    !! (3, n_contact) n along the axes of i [1]
      real(wp), allocatable :: point(:, :)     !! (3, n_contact) p from the point of the item in j, along the axes of j [m]
      real(wp), allocatable :: height(:)       !! (n_contact) h [m]
      real(wp), allocatable :: normal_i(:, :)  !! (3, n_contact) n, frame of body i [1]
      real(wp), allocatable :: point_j(:, :)   !! (3, n_contact) p, frame of body j [m]
   end type planes_t

   !> Axes of an item.
   type :: axes_t
      real(wp) :: axis_i(3) = 0.0_wp       !! (3) z in body i, as in the deck [1]
      real(wp) :: axis_j(3) = 0.0_wp       !! (3) z in body j, as in the deck; zero: left out [1]
      real(wp) :: across(3) = 0.0_wp       !! (3) x in body i, as in the deck; zero: that of `find_frames` [1]
      real(wp) :: frame_i(3, 3) = 0.0_wp   !! (3, 3) x, y, z as columns, frame of body i [1]
      real(wp) :: frame_j(3, 3) = 0.0_wp   !! (3, 3) the same, frame of body j [1]
   end type axes_t

   !> Points against planes, in space. `prepare` of a geometry calls `make_planes` and fills them.
   type, abstract, extends(point_contacts_t) :: plane_contacts_t
      type(planes_t) :: planes              !! planes, and what comes near them
      type(axes_t), allocatable :: axes(:)  !! (n) axes of the items
   contains
      procedure, non_overridable :: make_planes
      procedure :: set_start => plane_set_start
      procedure :: span_of => plane_span_of
      procedure :: evaluate => plane_evaluate
      procedure :: measure => measure_one
      procedure :: penetration_acceleration => plane_penetration_acceleration
      procedure :: lie => plane_lie
      procedure, nopass :: force_on_j => spatial_force
      procedure :: report_item => plane_report_item
   end type plane_contacts_t

contains

   !> Room for the planes, and the axes of the deck.
   subroutine make_planes(self, items)
      class(plane_contacts_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)            !! (n) rows of the table

      integer :: k, m

      call self%make_room()
      m = self%n_contact
      allocate (self%axes(self%n))
      allocate (self%planes%normal(3, m), self%planes%point(3, m), self%planes%height(m), self%planes%normal_i(3, m), &
                self%planes%point_j(3, m), source=0.0_wp)
      do k = 1, self%n
         self%axes(k)%axis_i = items(k)%direction("axis_i")
         self%axes(k)%axis_j = items(k)%direction("axis_j")
      end do
   end subroutine make_planes

   !> Axes, normals and points in the frames of the bodies.
   subroutine plane_set_start(self, motion)
      class(plane_contacts_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion            !! bodies where the deck puts them

      real(wp) :: turn(3, 3), x(3)
      integer :: item, k

      do k = 1, self%n
         associate (axes => self%axes(k), own => motion%spatial%own, i => self%items%body(1, k))
            call find_frames(motion, self%items%body(:, k), axes%axis_i, axes%axis_j, .true., axes%frame_i, axes%frame_j)
            if (.not. any(abs(axes%across) > 0.0_wp)) cycle
            x = matmul(axes%across, matmul(own(:, :, i), axes%frame_i))  ! along the joint's axes
            x(3) = 0.0_wp
            if (.not. norm2(x) > 0.0_wp) cycle
            x = x/norm2(x)
            turn = reshape([x(1), x(2), 0.0_wp, -x(2), x(1), 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
            axes%frame_i = matmul(axes%frame_i, turn)
            axes%frame_j = matmul(axes%frame_j, turn)
         end associate
      end do
      do k = 1, self%n_contact
         item = self%item_of(k)
         self%planes%normal_i(:, k) = matmul(self%axes(item)%frame_i, self%planes%normal(:, k))
         self%planes%point_j(:, k) = self%items%s_j(:, item) + matmul(self%axes(item)%frame_j, self%planes%point(:, k))
      end do
   end subroutine plane_set_start

   !> How far what takes part in a contact is from the centres of mass of both bodies.
   pure function plane_span_of(self, contact) result(span)
      class(plane_contacts_t), intent(in) :: self     !! the set
      integer, intent(in) :: contact                  !! contact of the set
      real(wp) :: span(2)                             !! (2) in bodies i and j [m]

      associate (item => self%item_of(contact))
         span = [sum(abs(self%items%s_i(:, item))), sum(abs(self%items%s_j(:, item)))] &
                + sum(abs(self%planes%point(:, contact))) + self%items%clearance(item)
      end associate
   end function plane_span_of

   !> Add the contact forces of the touching contacts.
   subroutine plane_evaluate(self, motion, loads, losses)
      class(plane_contacts_t), intent(inout) :: self       !! the set
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(loads_t), intent(inout) :: loads                 !! loads on the bodies
      real(wp), intent(inout), contiguous :: losses(:, :)   !! (2, all contacts) power lost [W]

      include "point_way.inc"
   end subroutine plane_evaluate

   include "press.inc"
   include "spatial_loads.inc"

   !> Measure the contacts that touch, all of them where they act apart, with their sliding velocities where there is friction.
   subroutine measure_touching(self, motion)
      class(plane_contacts_t), intent(inout) :: self  !! the set; kinematics are set
      type(motion_t), intent(in) :: motion             !! positions and velocities

      integer :: k

      do k = 1, self%n_contact
         if (.not. (self%contact(k)%is_touching .or. self%laws%normal%acts_apart)) cycle
         call measure_one(self, k, allocated(self%laws%friction), motion, self%work%contacts(k))
      end do
   end subroutine measure_touching

   !> Normal, penetration, its rate and arms of a contact; its sliding velocity where it is asked for.
   pure subroutine measure_one(self, k, with_sliding, motion, contact)
      class(plane_contacts_t), intent(in) :: self     !! the set
      integer, intent(in) :: k                         !! contact
      logical, intent(in) :: with_sliding              !! its sliding velocity too
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(point_contact_t), intent(inout) :: contact  !! its kinematics

      real(wp) :: d(3), w(3)
      integer :: item

      item = (k - 1)/self%n_contact_item + 1
      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         contact%normal = axis_of(motion, i, self%planes%normal_i(:, k))
         contact%arm_j = axis_of(motion, j, self%planes%point_j(:, k))
         contact%arm_i = motion%r(:, j) + contact%arm_j - motion%r(:, i)
         d = contact%arm_i - axis_of(motion, i, self%items%s_i(:, item))
         w = motion%v(:, j) + cross(motion%omega(:, j), contact%arm_j) - motion%v(:, i) - cross(motion%omega(:, i), contact%arm_i)
         contact%delta = dot_product(contact%normal, d) - self%planes%height(k)
         contact%rate = dot_product(contact%normal, w)
         if (with_sliding) call set_sliding(motion, i, j, contact)
      end associate
   end subroutine measure_one

   !> Second derivative of a penetration by time.
   pure real(wp) function plane_penetration_acceleration(self, k, motion, contact) result(acceleration)
      class(plane_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions, velocities and accelerations
      type(point_contact_t), intent(in) :: contact   !! its kinematics

      real(wp) :: a(3), turn_i(3), turn_j(3)
      integer :: item

      item = (k - 1)/self%n_contact_item + 1
      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         turn_i = cross(motion%omega(:, i), contact%arm_i)
         turn_j = cross(motion%omega(:, j), contact%arm_j)
         a = motion%a(:, j) + cross(motion%alpha(:, j), contact%arm_j) + cross(motion%omega(:, j), turn_j) - motion%a(:, i) &
             - cross(motion%alpha(:, i), contact%arm_i) - cross(motion%omega(:, i), turn_i) &
             - 2.0_wp*cross(motion%omega(:, i), motion%v(:, j) + turn_j - motion%v(:, i) - turn_i)
      end associate
      acceleration = dot_product(contact%normal, a)
   end function plane_penetration_acceleration

   !> How a contact lies: the normal turns with body i, C stays in body j.
   subroutine plane_lie(self, k, motion, tangent)
      class(plane_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions and velocities
      type(tangent_t), intent(inout) :: tangent      !! how it lies; its forces and its way are left alone

      type(point_contact_t) :: contact
      integer :: item

      item = (k - 1)/self%n_contact_item + 1
      call measure_one(self, k, .true., motion, contact)
      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         call lie_in_space(motion, i, j, contact, contact%normal, cross(motion%omega(:, i), contact%normal), &
                           cross(motion%omega(:, j), contact%arm_j), tangent)
      end associate
   end subroutine plane_lie

   !> Centre of j from the axis, moment of the forces about it, tilt and way along the axis.
   subroutine plane_report_item(self, code, item, motion, contacts, f_n, f_t, value)
      class(plane_contacts_t), intent(in) :: self         !! the set
      integer, intent(in) :: code                         !! the channel
      integer, intent(in) :: item                         !! the item
      type(motion_t), intent(in) :: motion                !! positions and velocities
      type(point_contact_t), intent(in) :: contacts(:)    !! (contacts of an item) their kinematics
      real(wp), intent(in) :: f_n(:)                      !! (contacts of an item) normal forces [N]
      real(wp), intent(in) :: f_t(:)                      !! (contacts of an item) friction forces on j along t [N]
      real(wp), intent(inout) :: value(:)                 !! (components) the value [any]

      real(wp) :: centre(3), d(3), u(3)
      integer :: c

      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         centre = axis_of(motion, j, self%items%s_j(:, item))
         u = axis_of(motion, i, self%axes(item)%frame_i(:, 3))
         d = motion%r(:, j) + centre - motion%r(:, i) - axis_of(motion, i, self%items%s_i(:, item))
         select case (code)
         case (of_eccentricity)
            value = d - dot_product(d, u)*u
         case (of_axial_displacement)
            value = dot_product(d, u)
         case (of_moment)
            value = 0.0_wp
            do c = 1, size(contacts)
               value = value + cross(contacts(c)%arm_j - centre, self%force_on_j(contacts(c), f_n(c), f_t(c)))
            end do
         case (of_tilt)
            d = axis_of(motion, j, self%axes(item)%frame_j(:, 3))
            value = atan2(norm2(cross(u, d)), dot_product(u, d))
         end select
      end associate
   end subroutine plane_report_item

end module plane_contacts
