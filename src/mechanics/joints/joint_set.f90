!> The contract of ideal joints and drivers: all the items of one kind, evaluated by one call.
!>
!> A kind adds rows to the constraint equations Phi(q, t) = 0 and gives for each row, at the
!> present motion, Phi, the Jacobian Phi_q, the right-hand side of accelerations
!> gamma = -(Phi_q v)_q v - 2 Phi_qt v - Phi_tt, and Phi_t. Flores et al. (2008), eqs. (2.10), (2.11).
!>
!> Signs: the reaction on a body is -Phi_q^T lambda (forces and moment about the centre of mass).
!> A planar row has six columns: x_i, y_i, angle_i, x_j, y_j, angle_j; one in space twelve: the velocity of i and its angular
!> velocity in the frame of its body, then those of j (`spatial_rows`).
module joint_set
   use archive, only: archive_t
   use coordinates, only: coordinates_t
   use item, only: item_t
   use joint_friction, only: joint_friction_t
   use kind_info, only: add_channel, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t, point_position
   use readings, only: readings_t
   use rows, only: rows_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: add_joint_channels, joint_set_t, joint_slot_t
   public :: of_coordinate, of_force, of_moment, of_own, of_power, of_violation, of_violation_rate

   ! channels; those of friction: see `joint_friction`
   integer, parameter :: of_force = 1             !! reaction
   integer, parameter :: of_moment = 2            !! reaction moment
   integer, parameter :: of_violation = 3         !! of the constraints
   integer, parameter :: of_violation_rate = 4    !! its rate
   integer, parameter :: of_coordinate = 5        !! of a driver
   integer, parameter :: of_power = 6             !! of a driver
   integer, parameter :: of_own = 11              !! the first of a kind's own

   !> All items of one kind of joint or driver.
   type, abstract :: joint_set_t
      integer :: n = 0                           !! number of items
      integer :: n_row_item = 0                  !! rows of one item
      integer :: first_row = 0                   !! number of the first row of the set, less one
      logical :: is_solved = .true.              !! whether its rows are solved for, not only evaluated for reactions
      integer, allocatable :: column(:)          !! (n) places of the items among all joints, or all drivers, in reports
      logical :: is_driver = .false.             !! whether the items prescribe a motion
      logical :: is_angle(6) = .false.           !! (6) which rows of an item are angles, set by `prepare`
      logical :: sides_apart = .false.           !! whether Phi_q of a body depends on that body alone, set by `prepare`
      type(text_t), allocatable :: names(:)      !! (n) names
      integer, allocatable :: body(:, :)         !! (2, n) bodies i and j, 0: ground
      real(wp), allocatable :: s_i(:, :)         !! (3, n) point of body i, its frame [m]
      real(wp), allocatable :: s_j(:, :)         !! (3, n) point of body j, its frame [m]
      type(joint_friction_t) :: friction         !! of the items with friction
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(prepare_interface), deferred :: prepare
      procedure(evaluate_interface), deferred :: evaluate
      procedure :: new => joint_new
      procedure :: set_start => joint_set_start
      procedure :: take_joint => joint_take_joint
      procedure :: closing_fault => joint_closing_fault
      procedure :: closing_doubt => joint_closing_doubt
      procedure :: follow => joint_follow
      procedure :: n_more_blocks => joint_n_more_blocks
      procedure :: declare_rows => joint_declare_rows
      procedure :: reaction_point => joint_reaction_point
      procedure :: slide_axis_of => joint_slide_axis_of
      procedure, nopass :: friction_lengths => joint_friction_lengths
      procedure :: slide => joint_slide
      procedure :: press => joint_press
      procedure, non_overridable :: report => joint_report
      procedure :: report_own => joint_report_own
      procedure :: reaction => joint_reaction
      procedure :: coordinate => joint_coordinate
      procedure :: prescription => joint_prescription
      procedure :: time_of_turns => joint_time_of_turns
      procedure :: time_before => joint_time_before
      procedure :: save => joint_save
      procedure :: load => joint_load
   end type joint_set_t

   !> A place for a set of any kind.
   type :: joint_slot_t
      class(joint_set_t), allocatable :: set  !! the set
   end type joint_slot_t

   abstract interface
      !> Description of the kind.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name, columns, rows and channels
      end function info_interface

      !> Take the kind's own parameters from the rows of its table. Bodies and points are set already.
      subroutine prepare_interface(self, items, angle)
         import :: item_t, joint_set_t, wp
         implicit none (type, external)
         class(joint_set_t), intent(inout) :: self  !! the set
         type(item_t), intent(in) :: items(:)       !! (n) rows of the table
         real(wp), intent(in) :: angle(0:)          !! (0:bodies) angles at the start as the deck gives them [rad]
      end subroutine prepare_interface

      !> Fill the set's rows at the present motion. No allocation.
      subroutine evaluate_interface(self, t, motion, rows)
         import :: joint_set_t, motion_t, rows_t, wp
         implicit none (type, external)
         class(joint_set_t), intent(in) :: self  !! the set
         real(wp), intent(in) :: t               !! time [s]
         type(motion_t), intent(in) :: motion    !! positions and velocities
         type(rows_t), intent(inout) :: rows     !! rows, those of the set are filled
      end subroutine evaluate_interface
   end interface

   interface
      !> The channels that every ideal joint has.
      module subroutine add_joint_channels(info)
         implicit none (type, external)
         type(kind_info_t), intent(inout) :: info  !! the kind
      end subroutine add_joint_channels

      !> Values that are read, item by item: channels that joints or drivers share here, those of a kind's own by `report_own`. A
      !> channel of `info()` that nobody fills is an error of the kind; the tests of the registry find it. No allocation.
      module subroutine joint_report(self, readings, motion, coordinates, rows, lambda, phi_dot, values)
         implicit none (type, external)
         class(joint_set_t), intent(in) :: self           !! the set
         type(readings_t), intent(in) :: readings         !! channels that are read, of those that the kind announces
         type(motion_t), intent(in) :: motion             !! positions and velocities
         class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
         type(rows_t), intent(in) :: rows                 !! rows at the motion
         real(wp), intent(in) :: lambda(rows%n)           !! (rows) multipliers [N or N.m]
         real(wp), intent(in) :: phi_dot(rows%n)          !! (rows) rates of the violations [m/s or rad/s]
         real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]
      end subroutine joint_report

      !> Reaction of an item on body i, or j: force, and moment about its reaction point.
      module subroutine joint_reaction(self, item, motion, coordinates, rows, lambda, force, moment, side)
         implicit none (type, external)
         class(joint_set_t), intent(in) :: self           !! the set
         integer, intent(in) :: item                      !! item of the set
         type(motion_t), intent(in) :: motion             !! positions and velocities
         class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
         type(rows_t), intent(in) :: rows                 !! rows at the motion
         real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N or N.m]
         real(wp), intent(out) :: force(3)                !! (3) force on the body, world frame [N]
         real(wp), intent(out) :: moment(3)               !! (3) moment on the body about the reaction point [N.m]
         integer, intent(in), optional :: side            !! 1: body i, 2: body j; absent: body i
      end subroutine joint_reaction
   end interface

contains

   !> Set up the common part: names, bodies and points of the items.
   subroutine joint_new(self, items, body, s_i, s_j)
      class(joint_set_t), intent(inout) :: self   !! the set
      type(item_t), intent(in) :: items(:)        !! (n) rows of the table
      integer, intent(in) :: body(:, :)           !! (2, n) bodies i and j, 0: ground
      real(wp), intent(in) :: s_i(:, :)           !! (3, n) point of body i, its frame; the origin is the centre of mass [m]
      real(wp), intent(in) :: s_j(:, :)           !! (3, n) point of body j, its frame [m]

      type(kind_info_t) :: info
      integer :: k

      info = self%info()
      self%n = size(items)
      self%n_row_item = info%n_row
      allocate (self%names(self%n))
      do k = 1, self%n
         self%names(k)%s = items(k)%name
      end do
      self%body = body
      self%s_i = s_i
      self%s_j = s_j
      allocate (self%friction%item(0))
   end subroutine joint_new

   !> Take what the deck omits from where it puts the bodies at the start: nothing, unless the kind says otherwise.
   subroutine joint_set_start(self, motion)
      class(joint_set_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion       !! bodies where the deck puts them
   end subroutine joint_set_start

   !> Take what an item needs of the joint that its row names, of several one after the other: nothing, unless the kind says
   !> otherwise.
   subroutine joint_take_joint(self, k, joint, motion)
      class(joint_set_t), intent(inout) :: self  !! the set, prepared
      integer, intent(in) :: k                   !! item
      class(joint_set_t), intent(in) :: joint    !! a set of one item, the joint, prepared and with its start
      type(motion_t), intent(in) :: motion       !! bodies where the deck puts them
   end subroutine joint_take_joint

   !> A step has ended: what counts turns continues from there. Nothing, unless the kind says otherwise (`counts_turns`).
   subroutine joint_follow(self, motion)
      class(joint_set_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion       !! positions at the end of the step
   end subroutine joint_follow

   !> How an item is closed in a way that nobody means, which its rows cannot report from the right one: what follows its name in a
   !> message. In none, unless the kind says otherwise.
   function joint_closing_fault(self, k, motion) result(fault)
      class(joint_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      type(motion_t), intent(in) :: motion    !! positions
      character(:), allocatable :: fault      !! what is wrong; blank: nothing

      fault = repeat("", k + self%n + size(motion%angle))
   end function joint_closing_fault

   !> What of an item's dimensions does not match where it is closed, though its rows hold: what follows its name in a warning. In
   !> none, unless the kind says otherwise.
   function joint_closing_doubt(self, k, motion) result(doubt)
      class(joint_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      type(motion_t), intent(in) :: motion    !! positions
      character(:), allocatable :: doubt      !! what does not match; blank: nothing

      doubt = repeat("", k + self%n + size(motion%angle))
   end function joint_closing_doubt

   !> Blocks of Phi_q besides one of each row: none, unless rows tie more than two bodies.
   pure integer function joint_n_more_blocks(self) result(n)
      class(joint_set_t), intent(in) :: self  !! the set, with the joints that its rows name

      n = 0*self%n
   end function joint_n_more_blocks

   !> Report the bodies of the set's rows, and which are angles.
   subroutine joint_declare_rows(self, rows)
      class(joint_set_t), intent(inout) :: self  !! the set
      type(rows_t), intent(inout) :: rows        !! rows; those of the set are declared

      integer :: i, k, row

      do k = 1, self%n
         do i = 1, self%n_row_item
            row = self%first_row + (k - 1)*self%n_row_item + i
            rows%body(:, row) = self%body(:, k)
            rows%is_angle(row) = self%is_angle(i)
         end do
      end do
   end subroutine joint_declare_rows

   !> A channel of a kind's own, from `of_own` on; there is none here, and the value is left alone.
   subroutine joint_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      class(joint_set_t), intent(in) :: self           !! the set
      integer, intent(in) :: code                      !! the channel, one that the kind announces
      integer, intent(in) :: k                         !! item of the set
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N or N.m]
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [any]
   end subroutine joint_report_own

   !> Where the reaction force on body i is reported: at the point of body i, unless the kind says otherwise.
   function joint_reaction_point(self, k, motion) result(p)
      class(joint_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      type(motion_t), intent(in) :: motion    !! positions
      real(wp) :: p(3)                        !! (3) the point, world frame [m]

      p = point_position(motion, self%body(1, k), self%s_i(:, k))
   end function joint_reaction_point

   !> Columns of the lengths that friction needs, of a kind with the columns of friction: blank-separated, that of its moment first.
   function joint_friction_lengths() result(name)
      character(:), allocatable :: name   !! the columns

      name = ""
   end function joint_friction_lengths

   !> How the items with friction lie: sliding velocities, and what the rates of both bodies add to them. No allocation.
   subroutine joint_slide(self, motion)
      class(joint_set_t), intent(inout) :: self  !! the set; `friction` is set
      type(motion_t), intent(in) :: motion       !! positions and velocities
   end subroutine joint_slide

   !> Normal force of an item that has friction, from its multipliers.
   pure subroutine joint_press(self, m, lambda, normal, slope)
      class(joint_set_t), intent(in) :: self     !! the set
      integer, intent(in) :: m                   !! place among the items with friction
      real(wp), intent(in) :: lambda(:)          !! (rows of an item, or more) multipliers [N or N.m]
      real(wp), intent(out) :: normal            !! normal force, not negative [N]
      real(wp), intent(out) :: slope(:)          !! (size of lambda) its derivatives [1 or 1/m]

      normal = self%friction%preload(m)
      slope = 0.0_wp*lambda
   end subroutine joint_press

   !> Axis along which body j slides in body i, of a kind that leaves a way: none, unless the kind says otherwise.
   pure function joint_slide_axis_of(self, k) result(axis)
      class(joint_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      real(wp) :: axis(2)                     !! (2) unit vector, frame of body i [1]

      axis = 0.0_wp*self%s_i(1:2, k)
   end function joint_slide_axis_of

   !> Coordinate and rate of a driver: of j relative to i, counter-clockwise positive.
   subroutine joint_coordinate(self, k, motion, value, rate)
      class(joint_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      type(motion_t), intent(in) :: motion    !! positions and velocities
      real(wp), intent(out) :: value          !! coordinate [rad or m]
      real(wp), intent(out) :: rate           !! its rate [rad/s or m/s]

      value = motion%angle(self%body(2, k)) - motion%angle(self%body(1, k))
      rate = motion%omega(3, self%body(2, k)) - motion%omega(3, self%body(1, k))
   end subroutine joint_coordinate

   !> The coordinate that a driver prescribes, and its derivatives.
   subroutine joint_prescription(self, k, t, f, f_dot, f_dot_dot)
      class(joint_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      real(wp), intent(in) :: t               !! time [s]
      real(wp), intent(out) :: f              !! coordinate; zero unless the kind is a driver of an angle [rad]
      real(wp), intent(out) :: f_dot          !! its first time derivative [rad/s]
      real(wp), intent(out) :: f_dot_dot      !! its second time derivative [rad/s^2]

      f = 0.0_wp
      f_dot = 0.0_wp
      f_dot_dot = 0.0_wp
   end subroutine joint_prescription

   !> Time at which a driver has made a number of turns since t = 0; negative if it never does.
   function joint_time_of_turns(self, k, turns) result(t)
      class(joint_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      real(wp), intent(in) :: turns           !! turns, of either sense [1]
      real(wp) :: t                           !! the time [s]

      t = -1.0_wp
      if (turns <= 0.0_wp .and. k <= self%n) t = 0.0_wp
   end function joint_time_of_turns

   !> Time before t_end since which a driver has made a number of turns; negative if it has not made so many.
   function joint_time_before(self, k, turns, t_end) result(t)
      class(joint_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      real(wp), intent(in) :: turns           !! turns, of either sense [1]
      real(wp), intent(in) :: t_end           !! end of the turns [s]
      real(wp) :: t                           !! their start [s]

      t = -1.0_wp
      if (turns <= 0.0_wp .and. k <= self%n) t = t_end
   end function joint_time_before

   !> Write what the set remembers.
   subroutine joint_save(self, archive)
      class(joint_set_t), intent(in) :: self     !! the set
      type(archive_t), intent(inout) :: archive  !! the checkpoint
   end subroutine joint_save

   !> Read what the set remembers.
   subroutine joint_load(self, archive)
      class(joint_set_t), intent(inout) :: self  !! the set
      type(archive_t), intent(inout) :: archive  !! the checkpoint
   end subroutine joint_load

end module joint_set
