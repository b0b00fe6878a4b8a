!> Gears in space: two gears roll on one another, on parallel axes or on axes that meet (bevel gears), wherever their centres move.
!>
!> Phi = R_i phi_i + R_j phi_j - (the same where the deck puts the bodies)                            (1 row)
!>
!> phi_i is the angle about z_i, in the body of i, of the direction to where the gears touch, phi_j the same in j about z_j. On
!> parallel axes the direction is along the line of centres, d from i and -d from j; on others it is that of the other gear's axis:
!> z_j from i, z_i from j. Phi' = 0 says that the pitch circles have the same velocity where they touch. Angles are taken next to
!> those at the end of the last step, so that turns are counted.
!>
!> Signs: parallel axes may point the same way or not. Axes that meet both point away from where they meet, or both towards it;
!> else one radius is negative, as that of a ring gear is.
!> Source: P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems (1988), section 4.2.4, with the direction to the other
!> gear in place of a carrier. Limits: other joints hold the gears near to where they mesh at the start: where axes that meet
!> become parallel, or the centres on parallel axes coincide, the angles have no value; a run ends before (`gear_is_lost`);
!> less than half a turn in a step; on axes that meet the row makes
!> couples on both bodies, so that what the bearings carry for the force at the teeth is not among their reactions; no pressure
!> angle, no play.
module spatial_gear
   use counted_joint, only: counted_joint_t, most_angles
   use item, only: item_t
   use kind_info, only: add_number, dim_length, kind_info_t
   use kinds, only: wp
   use mesh, only: axes_misfit, close_enough, distance_misfit, two_rings
   use motion, only: cross, motion_t, point_position
   use rows, only: rows_t
   use spatial_joint, only: add_axis_columns, add_joint_columns, add_spatial_channels, degrees_between, element_t, &
      set_joint_frames
   use spatial_rows, only: angle_of, axis_of, dot_of_axes, dot_with_span, put_row, scalar_t, observed_from_other, wrapped
   use text, only: real_text
   implicit none (type, external)
   private
   public :: between_gears, gear_is_lost, parallel, spatial_gear_t, words_of_lost_gear

   real(wp), parameter :: parallel = 1.0e-6_wp  !! sine of an angle of axes that is none [1]
   real(wp), parameter :: minimum = 0.25_wp  !! minimum part of what is between the gears at the start that they still mesh at [1]

   !> All pairs of gears of a spatial scene.
   type, extends(counted_joint_t) :: spatial_gear_t
      real(wp), allocatable, private :: radius(:, :)       !! (2, n) of i and j; of axes that point opposite ways one is turned [m]
      logical, allocatable, private :: is_parallel(:)      !! (n) whether the axes are parallel
      real(wp), allocatable, private :: start(:)           !! (n) R_i phi_i + R_j phi_j where the deck puts the bodies [m]
      real(wp), allocatable, private :: between(:, :)      !! (2, n) sine of the angle of the axes, distance across z_i there [1, m]
   contains
      procedure, nopass :: info => gear_info
      procedure :: prepare => gear_prepare
      procedure :: set_start => gear_set_start
      procedure :: evaluate => gear_evaluate
      procedure :: find_angles => gear_find_angles
      procedure :: closing_fault => gear_closing_fault
      procedure :: closing_doubt => gear_closing_doubt
      procedure :: reverse_second
   end type spatial_gear_t

contains

   !> Description of the kind.
   function gear_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.gear"
      info%help = "two gears in mesh, on parallel or intersecting axes; other joints guide them"
      info%source = "Nikravesh (1988), section 4.2.4"
      info%n_row = 1
      info%counts_turns = .true.
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the gear")
      call add_number(info, "radius_i", dim_length, "radius of the pitch circle of the first gear; negative: a ring gear", &
                      not_zero=.true.)
      call add_number(info, "radius_j", dim_length, "radius of the pitch circle of the second gear; negative: a ring gear", &
                      not_zero=.true.)
      call add_spatial_channels(info)
   end function gear_info

   !> Radii and axes.
   subroutine gear_prepare(self, items, angle)
      class(spatial_gear_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      integer :: k

      call self%take_axes(items, [element_t ::])
      allocate (self%radius(2, self%n), self%angle(2, self%n), self%start(self%n), source=0.0_wp)
      allocate (self%between(2, self%n), source=0.0_wp)
      allocate (self%is_parallel(self%n), source=.false.)
      do k = 1, self%n
         self%radius(:, k) = [items(k)%number("radius_i"), items(k)%number("radius_j")]
      end do
   end subroutine gear_prepare

   !> Give the second radius of an item the other sign.
   pure subroutine reverse_second(self, k)
      class(spatial_gear_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                      !! item

      self%radius(2, k) = -self%radius(2, k)
   end subroutine reverse_second

   !> The gears mesh as the deck puts them.
   subroutine gear_set_start(self, motion)
      class(spatial_gear_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion          !! bodies where the deck puts them

      type(scalar_t) :: phi(most_angles)
      real(wp) :: z_i(3), z_j(3)
      integer :: k

      call set_joint_frames(self, motion)
      do k = 1, self%n
         z_i = axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k))
         z_j = axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))
         self%between(:, k) = between_gears(self, k, motion)
         self%is_parallel(k) = self%between(1, k) < parallel
         if (self%is_parallel(k) .and. dot_product(z_i, z_j) < 0.0_wp) self%radius(2, k) = -self%radius(2, k)
         self%angle(:, k) = 0.0_wp
         call self%find_angles(k, motion, phi)
         self%angle(:, k) = phi%value
         self%start(k) = dot_product(self%radius(:, k), self%angle(:, k))
      end do
   end subroutine gear_set_start

   !> Angles of an item, next to those at the end of the last step.
   pure subroutine gear_find_angles(self, k, motion, phi)
      class(spatial_gear_t), intent(in) :: self         !! the set
      integer, intent(in) :: k                          !! item
      type(motion_t), intent(in) :: motion              !! positions and velocities
      type(scalar_t), intent(inout) :: phi(most_angles) !! (most_angles) phi_i and phi_j [rad]

      type(scalar_t) :: across(2, 2)
      integer :: a

      associate (body => self%body(:, k), s_i => self%s_i(:, k), s_j => self%s_j(:, k), &
                 of_i => self%axes%frame_i(:, :, k), of_j => self%axes%frame_j(:, :, k))
         do a = 1, 2
            if (self%is_parallel(k)) then
               across(a, 1) = dot_with_span(motion, body, of_i(:, a), s_i, s_j)
               across(a, 2) = observed_from_other(dot_with_span(motion, body([2, 1]), of_j(:, a), s_j, s_i))
            else
               across(a, 1) = dot_of_axes(motion, body, of_i(:, a), of_j(:, 3))
               across(a, 2) = observed_from_other(dot_of_axes(motion, body([2, 1]), of_j(:, a), of_i(:, 3)))
            end if
         end do
      end associate
      do a = 1, 2
         phi(a) = angle_of(across(1, a), across(2, a))
         phi(a)%value = self%angle(a, k) + wrapped(phi(a)%value - self%angle(a, k))
      end do
   end subroutine gear_find_angles

   !> Fill the rows of all items.
   subroutine gear_evaluate(self, t, motion, rows)
      class(spatial_gear_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(rows_t), intent(inout) :: rows        !! rows, those of the set are filled

      type(scalar_t) :: phi(most_angles), x
      integer :: k

      do k = 1, self%n
         call self%find_angles(k, motion, phi)
         associate (r => self%radius(:, k))
            x%value = r(1)*phi(1)%value + r(2)*phi(2)%value
            x%rate = r(1)*phi(1)%rate + r(2)*phi(2)%rate
            x%bend = r(1)*phi(1)%bend + r(2)*phi(2)%bend
            x%force = r(1)*phi(1)%force + r(2)*phi(2)%force
            x%turn_i = r(1)*phi(1)%turn_i + r(2)*phi(2)%turn_i
            x%turn_j = r(1)*phi(1)%turn_j + r(2)*phi(2)%turn_j
         end associate
         call put_row(rows, self%first_row + k, motion, self%body(:, k), x, self%start(k), 0.0_wp, 0.0_wp)
      end do
   end subroutine gear_evaluate

   !> Radii of an item as the deck gives them.
   pure function own_radii(self, k, motion) result(radius)
      class(spatial_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      real(wp) :: radius(2)                      !! (2) of i and j [m]

      radius = self%radius(:, k)
      if (.not. self%is_parallel(k)) return
      if (dot_product(axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k)), &
                      axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))) < 0.0_wp) radius(2) = -radius(2)
   end function own_radii

   !> What is between two gears: sine of the angle of their axes, and distance of the centres across z_i.
   pure function between_gears(self, k, motion) result(between)
      class(spatial_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      real(wp) :: between(2)                     !! (2) both [1, m]

      real(wp) :: z_i(3)

      z_i = axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k))
      between(1) = norm2(cross(z_i, axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))))
      between(2) = norm2(cross(z_i, point_position(motion, self%body(2, k), self%s_j(:, k)) &
                               - point_position(motion, self%body(1, k), self%s_i(:, k))))
   end function between_gears

   !> Whether the gears have come so far from where they mesh at the start that their angles are about to have no value.
   pure logical function gear_is_lost(self, k, motion) result(is_off)
      class(spatial_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions

      real(wp) :: between(2)

      between = between_gears(self, k, motion)
      if (self%is_parallel(k)) then
         is_off = between(2) < minimum*self%between(2, k) .or. between(1) > 1.0_wp - minimum
      else
         is_off = between(1) < minimum*self%between(1, k)
      end if
   end function gear_is_lost

   !> Where they have come to.
   function words_of_lost_gear(self, k, motion) result(words)
      class(spatial_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      character(:), allocatable :: words         !! what is wrong

      real(wp) :: between(2)

      between = between_gears(self, k, motion)
      words = "has lost its mesh: the angle between the axes of its gears is "// &
              real_text(degrees_between(axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k)), &
                                        axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))), 4)//" deg"
      if (self%is_parallel(k)) then
         words = words//" and the distance of their centres "//real_text(between(2), 4)//" m (initially 0 deg and "// &
                 real_text(self%between(2, k), 4)//" m)"
      else
         words = words//" (the sine of that angle was initially "//real_text(self%between(1, k), 4)//", is now "// &
                 real_text(between(1), 4)//", and must be at least 0.25)"
      end if
      words = words//": add joints that keep the gears in mesh"
   end function words_of_lost_gear

   !> One of two gears at most is a ring gear, and on parallel axes they have a line of centres.
   function gear_closing_fault(self, k, motion) result(fault)
      class(spatial_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      character(:), allocatable :: fault         !! what is wrong; blank: nothing

      fault = ""
      if (all(own_radii(self, k, motion) < 0.0_wp)) fault = two_rings
      if (.not. self%is_parallel(k) .or. self%between(2, k) > close_enough*maxval(abs(self%radius(:, k)))) return
      fault = "has coaxial gears, "//real_text(self%between(2, k), 4)//" m apart, without a line of centres"// &
              new_line("a")//"  = separate the centres by the sum of the radii, or couple the bodies by another joint"
   end function gear_closing_fault

   !> Parallel axes are as far apart as the radii make it, others meet.
   function gear_closing_doubt(self, k, motion) result(doubt)
      class(spatial_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      character(:), allocatable :: doubt         !! what does not match; blank: nothing

      real(wp) :: d(3), normal(3), z_i(3), z_j(3)

      z_i = axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k))
      z_j = axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))
      d = point_position(motion, self%body(2, k), self%s_j(:, k)) - point_position(motion, self%body(1, k), self%s_i(:, k))
      if (self%is_parallel(k)) then
         doubt = distance_misfit(own_radii(self, k, motion), norm2(d - dot_product(d, z_i)*z_i))
      else
         normal = cross(z_i, z_j)
         doubt = axes_misfit(self%radius(:, k), abs(dot_product(d, normal))/norm2(normal))
      end if
   end function gear_closing_doubt

end module spatial_gear
