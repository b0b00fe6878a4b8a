!> Belt drive in the plane: a belt that neither slips nor stretches runs over two pulleys.
!>
!> With phi the angle of the line of centres, R_i and R_j the radii, + for a crossed belt, - for an open one:
!> Phi = R_i (angle_i - phi) +- R_j (angle_j - phi) - (the same at the start) = 0                            (1 row)
!>
!> That is the row of gears whose radii are R_i and +-R_j at any distance of their centres: see `joint_gear` for Phi_q and gamma. So
!> the frame that carries both pulleys may turn. The multiplier is the pull, the difference of the tensions of both spans.
!> Signs: a positive pull turns the pulley of i counter-clockwise, with the moment R_i times the pull.
!> Source: the belt has one speed at both pulleys. Limits: other joints keep the distance of the centres; what the tensions press on
!> the bearings is not a force of the row: without a law of the belt's stretch their sum is not determined.
module joint_belt
   use coordinates, only: coordinates_t
   use item, only: item_t
   use joint_gear, only: joint_gear_t
   use joint_set, only: add_joint_channels, of_own
   use kind_info, only: add_channel, add_number, add_reference, add_word, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use mesh, only: pulley_overlap
   use motion, only: motion_t, point_position
   use rows, only: rows_t
   use span, only: span_of
   implicit none (type, external)
   private
   public :: add_belt_columns, joint_belt_t, of_pull, sign_of_belt

   integer, parameter :: of_pull = of_own + 20   !! the pull, behind the channels of joints of space

   !> All belts of a planar scene: gears whose second radius is negative where the belt is open.
   type, extends(joint_gear_t) :: joint_belt_t
   contains
      procedure, nopass :: info => belt_info
      procedure :: prepare => belt_prepare
      procedure :: reaction_point => belt_reaction_point
      procedure :: closing_fault => belt_closing_fault
      procedure :: closing_doubt => belt_closing_doubt
      procedure :: report_own => belt_report_own
   end type joint_belt_t

contains

   !> Columns and channels of belts, of the plane and of space.
   subroutine add_belt_columns(info)
      type(kind_info_t), intent(inout) :: info  !! the kind, columns and a channel are added

      call add_number(info, "radius_i", dim_length, "radius of the first pulley", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "radius_j", dim_length, "radius of the second pulley", lower=0.0_wp, open_lower=.true.)
      call add_word(info, "belt", "how it runs: crossed, the pulleys turn in opposite directions", default="open", &
                    choices="open crossed")
      call add_channel(info, "pull", "N", "none", 1, "difference of the tensions of both spans, positive where it turns the &
                       &pulley of i counter-clockwise", of_pull)
   end subroutine add_belt_columns

   !> Sign of the second radius.
   pure real(wp) function sign_of_belt(item) result(sign)
      type(item_t), intent(in) :: item   !! the row

      sign = merge(1.0_wp, -1.0_wp, item%word("belt") == "crossed")
   end function sign_of_belt

   !> Description of the kind.
   function belt_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.belt"
      info%space = in_plane
      info%help = "belt without slip over two pulleys; other joints guide their centres, on a carrier that may move"
      info%source = "one speed of the belt at both pulleys"
      info%n_row = 1
      call add_reference(info, "i", "points", "centre of the first pulley")
      call add_reference(info, "j", "points", "centre of the second pulley")
      call add_joint_channels(info)
      call add_belt_columns(info)
   end function belt_info

   !> Radii.
   subroutine belt_prepare(self, items, angle)
      class(joint_belt_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)        !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)           !! (0:bodies) angles at the start [rad]

      integer :: k

      call self%joint_gear_t%prepare(items, angle)
      do k = 1, self%n
         self%radius(2, k) = sign_of_belt(items(k))*self%radius(2, k)
      end do
   end subroutine belt_prepare

   !> The centre of the first pulley.
   function belt_reaction_point(self, k, motion) result(p)
      class(joint_belt_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      real(wp) :: p(3)                         !! (3) the point, world frame [m]

      p = point_position(motion, self%body(1, k), self%s_i(:, k))
   end function belt_reaction_point

   !> A belt needs a line of centres.
   function belt_closing_fault(self, k, motion) result(fault)
      class(joint_belt_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      character(:), allocatable :: fault       !! what is wrong; blank: nothing

      real(wp) :: length, rate, u(3)

      call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, length, rate)
      fault = ""
      if (.not. length > 0.0_wp) fault = "has pulleys with one centre: separate the points i and j"
   end function belt_closing_fault

   !> Pulleys do not overlap.
   function belt_closing_doubt(self, k, motion) result(doubt)
      class(joint_belt_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      character(:), allocatable :: doubt       !! what does not match; blank: nothing

      real(wp) :: length, rate, u(3)

      call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, length, rate)
      doubt = pulley_overlap(self%radius(:, k), length)
   end function belt_closing_doubt

   !> The pull, which is the multiplier of the row.
   subroutine belt_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      class(joint_belt_t), intent(in) :: self          !! the set
      integer, intent(in) :: code                      !! the channel
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N]
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [N]

      if (code == of_pull) value(1) = lambda(self%first_row + k)
   end subroutine belt_report_own

end module joint_belt
