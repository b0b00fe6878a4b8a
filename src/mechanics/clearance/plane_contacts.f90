!> Contacts in space between points or balls of body j and planes fixed in body i.
!>
!> With p a point fixed in j, or the centre of a ball of radius R, n the unit normal of a plane of i, into its material, h its
!> distance along n from the point of the item in i (less R, of a ball), and d from that point to p:
!>
!> delta = n . d - h,   rate = n . w,   w = d' - omega_i x d,   delta'' = n . (w' as body i sees it),
!>
!> forces as in `point_contacts`, at C: the point p, or, of a ball, p + (R - delta/2) n, the middle between the surfaces. A geometry
!> gives normals and points along the axes of its item, x, y, z, in `prepare`; the axes are found in `set_start` (`find_axes`).
!>
!> Planes may start and end along z of their item (`ends`), with a front there, whose normal is z at the first end and -z at the
!> second: n and delta are those of the nearest of plane and fronts, as in `flat_contacts`.
!>
!> Signs: see `point_contact`. Source: Flores et al. (2008), section 4.3, with the surfaces of space. Limits: points have
!> ends, balls have none.
module plane_contacts
   use contact_stick_slip, only: tangent_t
   use item, only: find_place, item_t
   use joint_frames, only: find_frames
   use kinds, only: wp
   use motion, only: motion_t
   use point_contact, only: point_contact_t
   use point_contacts, only: of_axial_displacement, of_eccentricity, of_moment, of_tilt
   use space_tangents, only: lie_in_space, set_sliding
   use spatial_contacts, only: spatial_contacts_t
   use spatial_rows, only: axis_of
   implicit none (type, external)
   private
   public :: plane_contacts_t

   real(wp), parameter :: endless = huge(1.0_wp)  !! where planes end that do not [m]

   !> Points and planes along the axes of their item, and in the frames of the bodies.
   type :: planes_t
      real(wp), allocatable :: normal(:, :)    !! (3, n_contact) n along the axes of i [1]
      real(wp), allocatable :: point(:, :)     !! (3, n_contact) p from the point of the item in j, along the axes of j [m]
      real(wp), allocatable :: height(:)       !! (n_contact) h [m]
      real(wp), allocatable :: radius(:)       !! (n_contact) R, 0: a point [m]
      real(wp), allocatable :: normal_i(:, :)  !! (3, n_contact) n, frame of body i [1]
      real(wp), allocatable :: point_j(:, :)   !! (3, n_contact) p, frame of body j [m]
   end type planes_t

   !> Axes of an item.
   type :: axes_t
      real(wp) :: axis_i(3) = 0.0_wp       !! (3) z in body i, as in the deck [1]
      real(wp) :: axis_j(3) = 0.0_wp       !! (3) z in body j, as in the deck; zero: omitted [1]
      real(wp) :: across(3) = 0.0_wp       !! (3) x in body i, as in the deck; zero: that of `find_frames` [1]
      real(wp) :: frame_i(3, 3) = 0.0_wp   !! (3, 3) x, y, z as columns, frame of body i [1]
      real(wp) :: frame_j(3, 3) = 0.0_wp   !! (3, 3) the same, frame of body j [1]
      real(wp) :: ends(2) = [-endless, endless]  !! (2) where the planes start and end along z, from the point in i [m]
   end type axes_t

   !> Points against planes, in space. `prepare` of a geometry calls `make_planes` and fills them.
   type, abstract, extends(spatial_contacts_t) :: plane_contacts_t
      type(planes_t) :: planes              !! planes, and what comes near them
      type(axes_t), allocatable :: axes(:)  !! (n) axes of the items
   contains
      procedure, non_overridable :: make_planes
      procedure :: set_start => plane_set_start
      procedure :: find_axes => plane_find_axes
      procedure :: span_of => plane_span_of
      procedure :: measure_acting => plane_measure_acting
      procedure :: measure => measure_one
      procedure :: penetration_acceleration => plane_penetration_acceleration
      procedure :: lie => plane_lie
      procedure :: report_item => plane_report_item
   end type plane_contacts_t

contains

   include "../../foundation/numerics/across.inc"

   !> Storage for the planes, and the axes of the deck.
   subroutine make_planes(self, items)
      class(plane_contacts_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)            !! (n) rows of the table

      integer :: k, m

      call self%make_storage()
      m = self%n_contact
      allocate (self%axes(self%n))
      allocate (self%planes%normal(3, m), self%planes%point(3, m), self%planes%height(m), self%planes%radius(m), &
                self%planes%normal_i(3, m), self%planes%point_j(3, m), source=0.0_wp)
      do k = 1, self%n
         if (find_place(items(k), "axis_i") > 0) self%axes(k)%axis_i = items(k)%direction("axis_i")
         if (find_place(items(k), "axis_j") > 0) self%axes(k)%axis_j = items(k)%direction("axis_j")
         if (find_place(items(k), "x_i") > 0) self%axes(k)%across = items(k)%direction("x_i")
      end do
   end subroutine make_planes

   !> Axes, normals and points in the frames of the bodies.
   subroutine plane_set_start(self, motion)
      class(plane_contacts_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion            !! bodies where the deck puts them

      integer :: item, k

      call self%find_axes(motion)
      do k = 1, self%n_contact
         item = self%item_of(k)
         self%planes%normal_i(:, k) = matmul(self%axes(item)%frame_i, self%planes%normal(:, k))
         self%planes%point_j(:, k) = self%items%s_j(:, item) + matmul(self%axes(item)%frame_j, self%planes%point(:, k))
      end do
   end subroutine plane_set_start

   !> Axes of the items, from those of the deck and where it puts the bodies.
   subroutine plane_find_axes(self, motion)
      class(plane_contacts_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion            !! bodies where the deck puts them

      real(wp) :: turn(3, 3), x(3)
      integer :: k

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
   end subroutine plane_find_axes

   !> How far what takes part in a contact is from the centres of mass of both bodies.
   pure function plane_span_of(self, contact) result(span)
      class(plane_contacts_t), intent(in) :: self     !! the set
      integer, intent(in) :: contact                  !! contact of the set
      real(wp) :: span(2)                             !! (2) in bodies i and j [m]

      associate (item => self%item_of(contact))
         span = [sum(abs(self%items%s_i(:, item))), sum(abs(self%items%s_j(:, item)))] &
                + sum(abs(self%planes%point(:, contact))) + self%items%pairs(item)%clearance
      end associate
   end function plane_span_of

   !> Measure the contacts that act.
   subroutine plane_measure_acting(self, motion)
      class(plane_contacts_t), intent(inout) :: self  !! the set; kinematics are set
      type(motion_t), intent(in) :: motion            !! positions and velocities

      include "measure_acting.inc"
   end subroutine plane_measure_acting

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
         contact%delta = dot_product(contact%normal, d) - self%planes%height(k)
         if (self%axes(item)%ends(2) < endless) then
            call find_nearest(axis_of(motion, i, self%axes(item)%frame_i(:, 3)), d, self%axes(item)%ends, contact)
         end if
         if (self%planes%radius(k) > 0.0_wp) then
            d = (self%planes%radius(k) - 0.5_wp*contact%delta)*contact%normal
            contact%arm_j = contact%arm_j + d
            contact%arm_i = contact%arm_i + d
         end if
         w = motion%v(:, j) + across(motion%omega(:, j), contact%arm_j) - motion%v(:, i) - across(motion%omega(:, i), contact%arm_i)
         contact%rate = dot_product(contact%normal, w)
         if (with_sliding) call set_sliding(motion, i, j, contact)
      end associate
   end subroutine measure_one

   !> The nearest of a plane and of the fronts at its ends.
   pure subroutine find_nearest(along, d, ends, contact)
      real(wp), intent(in) :: along(3)                 !! (3) z of the item, world frame [1]
      real(wp), intent(in) :: d(3)                     !! (3) from the point of the item in i to p, world frame [m]
      real(wp), intent(in) :: ends(2)                  !! (2) where the plane starts and ends along it [m]
      type(point_contact_t), intent(inout) :: contact  !! normal and penetration of the plane; of what is nearest

      real(wp) :: place

      place = dot_product(along, d)
      if (place - ends(1) < contact%delta) then
         contact%normal = along
         contact%delta = place - ends(1)
      end if
      if (ends(2) - place < contact%delta) then
         contact%normal = -along
         contact%delta = ends(2) - place
      end if
   end subroutine find_nearest

   !> Second derivative of a penetration by time.
   pure real(wp) function plane_penetration_acceleration(self, k, motion, contact) result(acceleration)
      class(plane_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions, velocities and accelerations
      type(point_contact_t), intent(in) :: contact   !! its kinematics

      real(wp) :: a(3), arm_i(3), arm_j(3), reach(3), turn_i(3), turn_j(3)
      integer :: item

      item = (k - 1)/self%n_contact_item + 1
      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         reach = reach_of(self, k, contact)*contact%normal
         arm_i = contact%arm_i - reach
         arm_j = contact%arm_j - reach
         turn_i = across(motion%omega(:, i), arm_i)
         turn_j = across(motion%omega(:, j), arm_j)
         a = motion%a(:, j) + across(motion%alpha(:, j), arm_j) + across(motion%omega(:, j), turn_j) - motion%a(:, i) &
             - across(motion%alpha(:, i), arm_i) - across(motion%omega(:, i), turn_i) &
             - 2.0_wp*across(motion%omega(:, i), motion%v(:, j) + turn_j - motion%v(:, i) - turn_i)
      end associate
      acceleration = dot_product(contact%normal, a)
   end function plane_penetration_acceleration

   !> From the point p to C, along n.
   pure real(wp) function reach_of(self, k, contact) result(reach)
      class(plane_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                      !! contact
      type(point_contact_t), intent(in) :: contact  !! its kinematics

      reach = 0.0_wp
      if (self%planes%radius(k) > 0.0_wp) reach = self%planes%radius(k) - 0.5_wp*contact%delta
   end function reach_of

   !> How a contact lies: the normal turns with body i, p stays in body j.
   subroutine plane_lie(self, k, motion, tangent)
      class(plane_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions and velocities
      type(tangent_t), intent(inout) :: tangent      !! how it lies; its forces and its way are left alone

      type(point_contact_t) :: contact
      real(wp) :: arm_rate(3), normal_rate(3), reach
      integer :: item

      item = (k - 1)/self%n_contact_item + 1
      call measure_one(self, k, .true., motion, contact)
      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         reach = reach_of(self, k, contact)
         normal_rate = across(motion%omega(:, i), contact%normal)
         arm_rate = across(motion%omega(:, j), contact%arm_j - reach*contact%normal)
         if (self%planes%radius(k) > 0.0_wp) arm_rate = arm_rate + reach*normal_rate - 0.5_wp*contact%rate*contact%normal
         call lie_in_space(motion, i, j, contact, contact%normal, normal_rate, arm_rate, tangent)
      end associate
   end subroutine plane_lie

   !> Centre of j from the axis, moment of the forces about it, tilt and way along the axis.
   subroutine plane_report_item(self, code, item, motion, contacts, f_n, f_t, value)
      class(plane_contacts_t), intent(in) :: self         !! the set
      integer, intent(in) :: code                         !! the channel
      integer, intent(in) :: item                         !! the item
      type(motion_t), intent(in) :: motion                !! positions and velocities
      type(point_contact_t), intent(in) :: contacts(self%n_contact_item)  !! (n_contact_item) their kinematics
      real(wp), intent(in) :: f_n(self%n_contact_item)    !! (n_contact_item) normal forces [N]
      real(wp), intent(in) :: f_t(self%n_contact_item)    !! (n_contact_item) friction forces on j along t [N]
      real(wp), intent(inout), contiguous :: value(:)     !! (components) the value [any]

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
               value = value + across(contacts(c)%arm_j - centre, self%force_on_j(contacts(c), f_n(c), f_t(c)))
            end do
         case (of_tilt)
            d = axis_of(motion, j, self%axes(item)%frame_j(:, 3))
            value = atan2(norm2(across(u, d)), dot_product(u, d))
         end select
      end associate
   end subroutine plane_report_item

end module plane_contacts
