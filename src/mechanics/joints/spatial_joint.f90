!> What the joints of space share: axes in both bodies, and rows made of a list of elementary constraints.
!>
!> A joint has a frame x, y, z in each of its bodies (`joint_frames`): z is `axis_i` in the body of i and `axis_j` in the body of j;
!> with z along zeta x is along xi. A joint that holds the orientation (`holds_turn`) has the frame of i in j too, as the deck puts
!> the bodies. A kind lists its elements (`elements`):
!>
!>     at_point        P_i - P_j                       three rows
!>     across a, b     a_i . b_j = 0                   the axes, by number, stay at right angles
!>     beside a        a_i . d = 0                     no displacement along an axis of i
!>     untwisted       2 e_3 = 0                       j is turned against i about an axis across z alone
!>
!> Rows of `across` and `untwisted` are angles. Signs: the force on body i of a point is -lambda.
!> Source: Flores et al. (2008), eqs. (6.13) to (6.15), with the two independent rows of the parallel axes.
!> Limits: parallel axes may be opposed: `closing_fault` says so, and the start refuses it.
module spatial_joint
   use coordinates, only: coordinates_t
   use item, only: find_place, item_t
   use joint_frames, only: add_zero_columns, find_frames, from_start
   use joint_set, only: joint_set_t, of_force, of_moment, of_own, of_violation, of_violation_rate
   use kind_info, only: add_channel, add_direction, add_reference, in_space, kind_info_t
   use kinds, only: pi, wp
   use motion, only: motion_t
   use rows, only: rows_t
   use text, only: real_text
   use spatial_rows, only: angle_between, axis_of, dot_with_span, put_across_rows, put_row, put_vector_rows, &
      scalar_t, twist_of_frames
   implicit none (type, external)
   private
   public :: across, add_axis_columns, add_joint_columns, add_reaction_channels, add_spatial_channels, at_point, beside
   public :: degrees_between, element_t, is_turned_over, set_joint_frames, words_of_turned_over
   public :: add_slide_channels, add_turn_channels, press_ends, spatial_joint_t, spatial_report_own, untwisted

   integer, parameter :: is_point = 1    !! an element: two points coincide
   integer, parameter :: is_across = 2   !! two axes at right angles
   integer, parameter :: is_beside = 3   !! no displacement along an axis
   integer, parameter :: is_untwisted = 4 !! no twist

   ! channels of joints with an axis
   integer, parameter :: of_angle = of_own            !! about the axis
   integer, parameter :: of_angular_rate = of_own + 1 !! its rate
   integer, parameter :: of_displacement = of_own + 2 !! along the axis
   integer, parameter :: of_sliding_rate = of_own + 3 !! its rate
   ! channels of joints with axes
   integer, parameter :: of_own_force = of_own + 4    !! reaction along the axes of the joint
   integer, parameter :: of_own_moment = of_own + 5   !! its moment along them

   !> An elementary constraint.
   type :: element_t
      integer :: what = is_point   !! one of the above
      integer :: of_i = 0          !! axis of i, 1 to 3
      integer :: of_j = 0          !! axis of j, 1 to 3
   end type element_t

   type(element_t), parameter :: at_point = element_t(is_point, 0, 0)       !! the points coincide
   type(element_t), parameter :: untwisted = element_t(is_untwisted, 0, 0)  !! no twist between the frames

   !> Elementary constraints of each item, and the axes of all.
   type :: joint_axes_t
      type(element_t), allocatable :: elements(:)  !! of each item
      logical :: holds_turn = .false.              !! the frames are parallel as the deck puts the bodies
      logical :: holds_parallel = .false.          !! rows keep axes z parallel, and hold where these are opposed too
      real(wp), allocatable :: axis_i(:, :)        !! (3, n) as in the deck, body's own axes [1]
      real(wp), allocatable :: axis_j(:, :)        !! (3, n) as in the deck; zero: omitted [1]
      real(wp), allocatable :: across(:, :, :)     !! (3, 2, n) x of i and of j as in the deck; zero: omitted [1]
      logical, allocatable :: from_start(:)        !! (n) angles are zero where the deck puts the bodies
      real(wp), allocatable :: frame_i(:, :, :)    !! (3, 3, n) axes x, y, z as columns, frame of body i [1]
      real(wp), allocatable :: frame_j(:, :, :)    !! (3, 3, n) axes x, y, z as columns, frame of body j [1]
      real(wp), allocatable :: turn(:, :, :)       !! (4, 2, n) Euler parameters of both, where a twist is a row [1]
   end type joint_axes_t

   !> All items of one kind of joint of space.
   type, extends(joint_set_t), abstract :: spatial_joint_t
      type(joint_axes_t) :: axes   !! elementary constraints, and the axes that they are of
   contains
      procedure :: take_axes => spatial_take_axes
      procedure :: set_start => set_joint_frames
      procedure :: evaluate => spatial_evaluate
      procedure :: fill_rows => spatial_fill_rows
      procedure :: closing_fault => spatial_closing_fault
      procedure :: report_own => spatial_report_own
   end type spatial_joint_t

contains

   !> Axes of the two bodies at right angles.
   pure function across(of_i, of_j) result(element)
      integer, intent(in) :: of_i   !! axis of i, 1 to 3
      integer, intent(in) :: of_j   !! axis of j, 1 to 3
      type(element_t) :: element    !! the element

      element = element_t(is_across, of_i, of_j)
   end function across

   !> No displacement along an axis of i.
   pure function beside(of_i) result(element)
      integer, intent(in) :: of_i   !! axis of i, 1 to 3
      type(element_t) :: element    !! the element

      element = element_t(is_beside, of_i, 0)
   end function beside

   !> Columns of the two points, and of the axes where a joint has some.
   subroutine add_joint_columns(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      info%space = in_space
      call add_reference(info, "i", "points", "point of the first body")
      call add_reference(info, "j", "points", "point of the second body")
   end subroutine add_joint_columns

   !> Columns of the axes.
   subroutine add_axis_columns(info, words)
      type(kind_info_t), intent(inout) :: info  !! the kind
      character(*), intent(in) :: words         !! what the axis is

      call add_direction(info, "axis_i", words//", in the frame of the body of i", default='"0 0 1"')
      call add_direction(info, "axis_j", words//", in the frame of the body of j; default: consistent with the given positions", &
                         default="")
   end subroutine add_axis_columns

   !> The channels of a joint that has axes.
   subroutine add_spatial_channels(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_reaction_channels(info)
      call add_channel(info, "joint_force", "N", "joint", 2, "force along the axes x, y, z of the joint in i", of_own_force)
      call add_channel(info, "joint_moment", "N.m", "joint", 2, "moment along the axes x, y, z of the joint in i", &
                       of_own_moment)
   end subroutine add_spatial_channels

   !> The channels that every joint of space has.
   subroutine add_reaction_channels(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_channel(info, "force", "N", "world", 2, "reaction force on the body of i, including joint friction", of_force)
      call add_channel(info, "moment", "N.m", "world", 2, "reaction moment on the body of i about its point, including "// &
                       "joint friction", of_moment)
      call add_channel(info, "violation", "m", "none", 1, "norm of the constraint violation, angles multiplied by 1 m", &
         of_violation)
      call add_channel(info, "violation_rate", "m/s", "none", 1, "norm of the rate of the constraint violation", &
                       of_violation_rate)
   end subroutine add_reaction_channels

   !> Elements of the kind, and the axes of its rows; `prepare` calls it.
   subroutine spatial_take_axes(self, items, elements)
      class(spatial_joint_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)           !! (n) rows of the table
      type(element_t), intent(in) :: elements(:)     !! elements of each item

      integer :: k, row

      self%axes%elements = elements
      self%sides_apart = all(elements%what == is_point)
      self%axes%holds_parallel = any([(elements(k)%what == is_across .and. elements(k)%of_i == 1 .and. elements(k)%of_j == 3, &
                                       k=1, size(elements))])
      row = 0
      do k = 1, size(elements)
         row = row + merge(3, 1, elements(k)%what == is_point)
         self%is_angle(row) = elements(k)%what == is_across .or. elements(k)%what == is_untwisted
      end do
      allocate (self%axes%axis_i(3, self%n), self%axes%axis_j(3, self%n), source=0.0_wp)
      allocate (self%axes%frame_i(3, 3, self%n), self%axes%frame_j(3, 3, self%n), source=0.0_wp)
      allocate (self%axes%from_start(self%n), source=.false.)
      allocate (self%axes%across(3, 2, self%n), source=0.0_wp)
      self%axes%axis_i(3, :) = 1.0_wp
      if (self%n == 0) return
      if (find_place(items(1), "axis_i") == 0) return
      do k = 1, self%n
         self%axes%axis_i(:, k) = items(k)%direction("axis_i")
         if (find_place(items(k), "axis_j") > 0) self%axes%axis_j(:, k) = items(k)%direction("axis_j")
         if (find_place(items(k), "zero") == 0) cycle
         self%axes%from_start(k) = items(k)%word("zero") == from_start
         self%axes%across(:, 1, k) = items(k)%direction("x_i")
         self%axes%across(:, 2, k) = items(k)%direction("x_j")
      end do
   end subroutine spatial_take_axes

   !> Frames of the joints, from the axes of the deck and where it puts the bodies.
   subroutine set_joint_frames(self, motion)
      class(spatial_joint_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion           !! bodies where the deck puts them

      integer :: k

      do k = 1, self%n
         associate (axes => self%axes)
            call find_frames(motion, self%body(:, k), axes%axis_i(:, k), axes%axis_j(:, k), &
                             axes%holds_turn .or. axes%from_start(k), axes%frame_i(:, :, k), axes%frame_j(:, :, k), &
                             axes%across(:, :, k))
         end associate
      end do
   end subroutine set_joint_frames

   !> Fill the rows of all items.
   subroutine spatial_evaluate(self, t, motion, rows)
      class(spatial_joint_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                   !! time [s]
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(rows_t), intent(inout) :: rows         !! rows, those of the set are filled

      call self%fill_rows(motion, rows)
   end subroutine spatial_evaluate

   !> Fill the rows of the elements of all items.
   subroutine spatial_fill_rows(self, motion, rows)
      class(spatial_joint_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(rows_t), intent(inout) :: rows         !! rows, those of the set are filled

      type(scalar_t) :: x
      integer :: e, k, row

      row = self%first_row
      do e = 1, size(self%axes%elements)
         associate (element => self%axes%elements(e), axes => self%axes)
            select case (element%what)
            case (is_point)
               call put_vector_rows(self%n, self%body, self%s_i, self%s_j, ubound(motion%angle, 1), motion%r, motion%rot, &
                                    motion%omega, row, self%n_row_item, rows%n, rows%phi, rows%jac, rows%gam)
               row = row + 3
            case (is_across)
               call put_across_rows(self%n, self%body, element%of_i, axes%frame_i, element%of_j, axes%frame_j, &
                                    ubound(motion%angle, 1), motion%rot, motion%omega, row, self%n_row_item, rows%n, rows%phi, &
                                    rows%phi_t, rows%jac, rows%gam)
               row = row + 1
            case (is_untwisted)
               do k = 1, self%n
                  x = twist_of_frames(motion, self%body(:, k), axes%turn(:, 1, k), axes%turn(:, 2, k))
                  call put_row(rows, row + 1 + (k - 1)*self%n_row_item, motion, self%body(:, k), x, 0.0_wp, 0.0_wp, 0.0_wp)
               end do
               row = row + 1
            case default
               do k = 1, self%n
                  x = dot_with_span(motion, self%body(:, k), axes%frame_i(:, element%of_i, k), self%s_i(:, k), self%s_j(:, k))
                  call put_row(rows, row + 1 + (k - 1)*self%n_row_item, motion, self%body(:, k), x, 0.0_wp, 0.0_wp, 0.0_wp)
               end do
               row = row + 1
            end select
         end associate
      end do
   end subroutine spatial_fill_rows

   !> Axes that are opposed where the rows only ask them to be parallel.
   function spatial_closing_fault(self, k, motion) result(fault)
      class(spatial_joint_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! item
      type(motion_t), intent(in) :: motion        !! positions
      character(:), allocatable :: fault          !! what is wrong; blank: nothing

      fault = ""
      if (is_turned_over(self, k, motion)) then
         fault = "is assembled in the reversed configuration: its axes are antiparallel"//new_line("a")// &
                 "  = rotate one of its bodies, or reverse axis_i or axis_j, in the deck"
      end if
   end function spatial_closing_fault

   !> Where an item has come to whose axes are opposed: what follows its name in a message.
   function words_of_turned_over(self, k, motion) result(words)
      class(spatial_joint_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! item
      type(motion_t), intent(in) :: motion        !! positions
      character(:), allocatable :: words          !! what is wrong

      words = "moved to its other branch: the angle between its axes, which must be parallel, is "// &
              real_text(degrees_between(axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k)), &
                                        axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))), 4)//" deg"
   end function words_of_turned_over

   !> Angle of two axes.
   pure real(wp) function degrees_between(a, b) result(angle)
      real(wp), intent(in) :: a(3)   !! (3) an axis [1]
      real(wp), intent(in) :: b(3)   !! (3) another one [1]

      angle = 2.0_wp*atan2(norm2(a - b), norm2(a + b))*180.0_wp/pi
   end function degrees_between

   !> Whether the axes z of an item, parallel by its rows, are opposed: a branch that nobody means.
   pure logical function is_turned_over(self, k, motion) result(is_over)
      class(spatial_joint_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! item
      type(motion_t), intent(in) :: motion        !! positions

      is_over = .false.
      if (self%axes%holds_parallel) is_over = dot_product(axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k)), &
                                              axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))) < 0.0_wp
      if (is_over .or. .not. self%axes%holds_turn) return
      is_over = dot_product(axis_of(motion, self%body(1, k), self%axes%frame_i(:, 1, k)), &
                            axis_of(motion, self%body(2, k), self%axes%frame_j(:, 1, k))) < 0.0_wp
   end function is_turned_over

   !> What presses the two ends of a bearing or slider: N = |f/2 + m/L| + |f/2 - m/L|, with the multipliers f of rows that hold
   !> x and y of the points, and m of rows x_i . z_j and y_i . z_j.
   pure subroutine press_ends(f, m, length, normal, by_f, by_m)
      real(wp), intent(in) :: f(2)          !! (2) of the points [N]
      real(wp), intent(in) :: m(2)          !! (2) of the axes [N.m]
      real(wp), intent(in) :: length        !! distance of the ends; 0: the moment is omitted [m]
      real(wp), intent(out) :: normal       !! the sum of both ends [N]
      real(wp), intent(out) :: by_f(2)      !! (2) its derivatives by f [1]
      real(wp), intent(out) :: by_m(2)      !! (2) its derivatives by m [1/m]

      real(wp) :: arm, end(2), size_of
      integer :: side

      arm = 0.0_wp
      if (length > 0.0_wp) arm = 1.0_wp/length
      normal = 0.0_wp
      by_f = 0.0_wp
      by_m = 0.0_wp
      do side = -1, 1, 2
         end = 0.5_wp*f + real(side, wp)*arm*m
         size_of = norm2(end)
         normal = normal + size_of
         if (.not. size_of > 0.0_wp) cycle
         by_f = by_f + 0.5_wp*end/size_of
         by_m = by_m + real(side, wp)*arm*end/size_of
      end do
   end subroutine press_ends

   !> The channels of a joint that turns about its axis, and where its angle is zero.
   subroutine add_turn_channels(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_zero_columns(info)
      call add_channel(info, "angle", "rad", "joint", 1, "angle of j relative to i about the axis, between -pi and pi", of_angle)
      call add_channel(info, "angular_rate", "rad/s", "joint", 1, "angular velocity of j relative to i about the axis", &
                       of_angular_rate)
   end subroutine add_turn_channels

   !> The channels of a joint that slides along its axis.
   subroutine add_slide_channels(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_channel(info, "displacement", "m", "joint", 1, "displacement of j relative to i along the axis of i", &
         of_displacement)
      call add_channel(info, "sliding_rate", "m/s", "joint", 1, "rate of the displacement", of_sliding_rate)
   end subroutine add_slide_channels

   !> A channel of the axes.
   subroutine spatial_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      class(spatial_joint_t), intent(in) :: self       !! the set
      integer, intent(in) :: code                      !! the channel
      integer, intent(in) :: k                         !! item of the set
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N or N.m]
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [any]

      type(scalar_t) :: x
      real(wp) :: force(3), moment(3)

      select case (code)
      case (of_angle, of_angular_rate)
         x = angle_between(motion, self%body(:, k), self%axes%frame_i(:, :, k), self%axes%frame_j(:, :, k))
         value = merge(x%value, x%rate, code == of_angle)
      case (of_displacement, of_sliding_rate)
         x = dot_with_span(motion, self%body(:, k), self%axes%frame_i(:, 3, k), self%s_i(:, k), self%s_j(:, k))
         value = merge(x%value, x%rate, code == of_displacement)
      case (of_own_force, of_own_moment)
         call self%reaction(k, motion, coordinates, rows, lambda, force, moment)
         value = merge(force, moment, code == of_own_force)
         value = matmul(matmul(value, motion%rot(:, :, self%body(1, k))), self%axes%frame_i(:, :, k))
      end select
   end subroutine spatial_report_own

end module spatial_joint
