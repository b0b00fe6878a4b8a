!> Belt drive in space: a belt that neither slips nor stretches runs over two pulleys on parallel axes.
!>
!> Phi = R_i phi_i +- R_j phi_j - (the same where the deck puts the bodies), + for a crossed belt, - for an open one   (1 row)
!>
!> That is the row of gears whose radii are R_i and +-R_j at any distance of their centres: see `spatial_gear` for the angles. The
!> multiplier is the pull, the difference of the tensions of both spans.
!> Signs: a positive pull turns the pulley of i counter-clockwise about axis_i, with the moment R_i times the pull. Axes may point
!> the same way or not. Source, limits: `joint_belt`; axes that are not parallel are refused.
module spatial_belt
   use coordinates, only: coordinates_t
   use item, only: item_t
   use joint_belt, only: add_belt_columns, of_pull, sign_of_belt
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use mesh, only: close_enough, pulley_overlap
   use motion, only: motion_t
   use rows, only: rows_t
   use spatial_gear, only: between_gears, parallel, spatial_gear_t
   use spatial_joint, only: add_axis_columns, add_joint_columns, add_spatial_channels
   implicit none (type, external)
   private
   public :: spatial_belt_t

   !> All belts of a spatial scene: gears whose second radius is negative where the belt is open.
   type, extends(spatial_gear_t) :: spatial_belt_t
      real(wp), allocatable, private :: pulley(:, :)   !! (2, n) radii of the pulleys [m]
   contains
      procedure, nopass :: info => belt_info
      procedure :: prepare => belt_prepare
      procedure :: closing_fault => belt_closing_fault
      procedure :: closing_doubt => belt_closing_doubt
      procedure :: report_own => belt_report_own
   end type spatial_belt_t

contains

   !> Description of the kind.
   function belt_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.belt"
      info%help = "belt without slip over two pulleys on parallel axes; other joints guide them"
      info%source = "one speed of the belt at both pulleys"
      info%n_row = 1
      info%counts_turns = .true.
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the pulley")
      call add_spatial_channels(info)
      call add_belt_columns(info)
   end function belt_info

   !> Radii and axes.
   subroutine belt_prepare(self, items, angle)
      class(spatial_belt_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)          !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)             !! (0:bodies) not used [rad]

      integer :: k

      call self%spatial_gear_t%prepare(items, angle)
      allocate (self%pulley(2, self%n))
      do k = 1, self%n
         self%pulley(:, k) = [items(k)%number("radius_i"), items(k)%number("radius_j")]
         if (sign_of_belt(items(k)) < 0.0_wp) call self%reverse_second(k)
      end do
   end subroutine belt_prepare

   !> A belt needs parallel axes, apart from each other.
   function belt_closing_fault(self, k, motion) result(fault)
      class(spatial_belt_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      character(:), allocatable :: fault         !! what is wrong; blank: nothing

      real(wp) :: between(2)

      between = between_gears(self, k, motion)
      fault = ""
      if (between(1) >= parallel) then
         fault = "has pulleys whose axes are not parallel: align axis_i and axis_j"
      else if (.not. between(2) > close_enough*maxval(self%pulley(:, k))) then
         fault = "has pulleys on one axis: separate the points i and j"
      end if
   end function belt_closing_fault

   !> Pulleys do not overlap.
   function belt_closing_doubt(self, k, motion) result(doubt)
      class(spatial_belt_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      character(:), allocatable :: doubt         !! what does not match; blank: nothing

      real(wp) :: between(2)

      between = between_gears(self, k, motion)
      doubt = pulley_overlap(self%pulley(:, k), between(2))
   end function belt_closing_doubt

   !> The pull, which is the multiplier of the row.
   subroutine belt_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      class(spatial_belt_t), intent(in) :: self        !! the set
      integer, intent(in) :: code                      !! the channel
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N]
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [N]

      if (code == of_pull) then
         value(1) = lambda(self%first_row + k)
      else
         call self%spatial_gear_t%report_own(code, k, motion, coordinates, rows, lambda, value)
      end if
   end subroutine belt_report_own

end module spatial_belt
