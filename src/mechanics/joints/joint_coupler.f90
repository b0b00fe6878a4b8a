!> Coupler: a linear relation between coordinates of two or three other joints, each an angle or a displacement.
!>
!> $$ \Phi = s_1 + \frac{c_2}{c_1} s_2 + \frac{c_3}{c_1} s_3 - s_0 = 0 $$                              (1 row)
!>
!> with the scales c, and s_0 = offset/c_1, or the sum where the deck puts the bodies. Phi_q and gamma are the sums of those of the
!> coordinates (`joint_coordinate`), so that the row ties all bodies of the joints. Angles are counted through whole turns.
!>
!> Signs: those of the coordinates; the coupler acts on coordinate k, on body j and opposite on body i, with -lambda c_k/c_1, a
!> moment about the axis or a force along it. Their powers sum to zero. Source: Nikravesh (1988), section 4.2.4, generalised from
!> the definition. Limits: the joints are ideal; in space less than half a turn in a step.
module joint_coupler
   use archive, only: archive_t
   use coordinates, only: coordinates_t
   use item, only: item_t
   use joint_coordinate, only: joint_coordinate_t, new_coordinate
   use joint_set, only: joint_set_t, of_own, of_violation, of_violation_rate
   use kind_info, only: add_any_number, add_channel, add_reference, add_word, free_translation, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use rows, only: rows_t
   use spatial_rows, only: scalar_t, row_of, wrapped
   implicit none (type, external)
   private
   public :: add_coupler_columns, joint_coupler_t, most_joints

   integer, parameter :: most_joints = 3             !! joints of an item, at most
   integer, parameter :: of_moments = of_own         !! the first of the moments on the joints
   integer, parameter :: of_forces = of_own + most_joints !! the first of the forces
   character(1), parameter :: digit(most_joints) = ["1", "2", "3"]

   !> A coupler, and its place among the rows.
   type :: coupled_t
      integer :: n = 0                                   !! its joints
      type(joint_coordinate_t) :: of(most_joints)        !! (joints) their coordinates
      logical :: wants_angle(most_joints) = .true.       !! (joints) whether these are angles
      real(wp) :: scale(most_joints) = 0.0_wp            !! (joints) c_k/c_1 [rad/rad, m/m, rad/m or m/rad]
      logical :: is_given = .false.                      !! whether the deck gives the sum
      real(wp) :: sum = 0.0_wp                           !! s_0 [rad or m]
      real(wp) :: near(most_joints) = 0.0_wp             !! (joints) coordinates at the end of the last step [rad or m]
      integer :: n_body = 0                              !! bodies but the ground
      integer :: body(2*most_joints) = 0                 !! (bodies) these
      integer :: first_block = 0                         !! blocks before its second one
   contains
      procedure :: find => coupled_find
   end type coupled_t

   !> All couplers.
   type, extends(joint_set_t) :: joint_coupler_t
      type(coupled_t), allocatable, private :: items(:)   !! (n) these
   contains
      procedure, nopass :: info => coupler_info
      procedure :: prepare => coupler_prepare
      procedure :: take_joint => coupler_take_joint
      procedure :: n_more_blocks => coupler_n_more_blocks
      procedure :: declare_rows => coupler_declare_rows
      procedure :: evaluate => coupler_evaluate
      procedure :: follow => coupler_follow
      procedure :: reaction => coupler_reaction
      procedure :: reaction_point => coupler_reaction_point
      procedure :: report_own => coupler_report_own
      procedure :: save => coupler_save
      procedure :: load => coupler_load
   end type joint_coupler_t

contains

   !> Description of the kind in the plane.
   function coupler_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%space = in_plane
      call add_coupler_columns(info, "joint.revolute joint.translational", "own angle displacement")
   end function coupler_info

   !> Name, columns and channels, of the plane and of space.
   subroutine add_coupler_columns(info, joints, choices)
      type(kind_info_t), intent(inout) :: info  !! the kind
      character(*), intent(in) :: joints        !! kinds of joints that it couples
      character(*), intent(in) :: choices       !! words for the coordinate of a joint

      integer :: k

      info%name = "joint.coupler"
      info%help = "ratio between angles and displacements of two or three other joints: scale_1 s_1 + scale_2 s_2 + scale_3 s_3 is &
                  &constant"
      info%source = "Nikravesh (1988), section 4.2.4, for any joints"
      info%n_row = 1
      info%couples_joints = .true.
      info%counts_turns = .true.
      do k = 1, most_joints
         if (k < most_joints) then
            call add_reference(info, "joint_"//digit(k), joints, "joint "//digit(k))
            call add_any_number(info, "scale_"//digit(k), "factor of its coordinate, as 2 or, beside a displacement, 30 mm/rad")
         else
            call add_reference(info, "joint_"//digit(k), joints, "a third joint; empty: none", default="")
            call add_any_number(info, "scale_"//digit(k), "factor of its coordinate", default="0")
         end if
         call add_word(info, "of_"//digit(k), "coordinate of joint "//digit(k)//": its own is the displacement of a translational &
                       &joint, else the angle", default="own", choices=choices)
      end do
      call add_any_number(info, "offset", "the constant sum; omitted: as at the given positions", default="")
      call add_channel(info, "violation", "m", "none", 1, "absolute constraint violation in joint 1, angles multiplied by 1 m", &
                       of_violation)
      call add_channel(info, "violation_rate", "m/s", "none", 1, "absolute rate of the constraint violation", of_violation_rate)
      do k = 1, most_joints
         call add_channel(info, "moment_"//digit(k), "N.m", "joint", 1, "moment on the body of j of joint "//digit(k)// &
                          " about its axis; 0 where a displacement is coupled", of_moments + k - 1)
         call add_channel(info, "force_"//digit(k), "N", "joint", 1, "force on the body of j of joint "//digit(k)// &
                          " along its axis; 0 where an angle is coupled", of_forces + k - 1)
      end do
   end subroutine add_coupler_columns

   !> Scales, and which coordinates are meant; `coupler_checks` knows that they match.
   subroutine coupler_prepare(self, items, angle)
      class(joint_coupler_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)           !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)              !! (0:bodies) not used [rad]

      integer :: e, k

      allocate (self%items(self%n))
      do k = 1, self%n
         associate (one => self%items(k))
            do e = 1, most_joints
               one%scale(e) = items(k)%number("scale_"//digit(e))/items(k)%number("scale_1")
               one%wants_angle(e) = items(k)%word("of_"//digit(e)) /= "displacement"
            end do
            one%is_given = items(k)%is_given("offset")
            if (one%is_given) one%sum = items(k)%number("offset")/items(k)%number("scale_1")
         end associate
      end do
   end subroutine coupler_prepare

   !> The next joint of an item. A joint that only slides has no angle.
   subroutine coupler_take_joint(self, k, joint, motion)
      class(joint_coupler_t), intent(inout) :: self  !! the set, prepared
      integer, intent(in) :: k                       !! item
      class(joint_set_t), intent(in) :: joint        !! a set of one item, the joint, prepared and with its start
      type(motion_t), intent(in) :: motion           !! bodies where the deck puts them

      type(kind_info_t) :: info
      type(scalar_t) :: x
      integer :: side

      info = joint%info()
      associate (one => self%items(k))
         one%n = one%n + 1
         one%of(one%n) = new_coordinate(joint, one%wants_angle(one%n) .and. info%free /= free_translation)
         x = one%of(one%n)%find(motion)
         one%near(one%n) = x%value
         if (.not. one%is_given) one%sum = one%sum + one%scale(one%n)*x%value
         do side = 1, 2
            if (joint%body(side, 1) == 0 .or. any(one%body == joint%body(side, 1))) cycle
            one%n_body = one%n_body + 1
            one%body(one%n_body) = joint%body(side, 1)
         end do
         self%body(:, k) = one%body(:2)
      end associate
   end subroutine coupler_take_joint

   !> Blocks besides one of each row.
   pure integer function coupler_n_more_blocks(self) result(n)
      class(joint_coupler_t), intent(in) :: self  !! the set, with the joints that its rows name

      n = sum(max(0, (self%items%n_body - 1)/2))
   end function coupler_n_more_blocks

   !> Report the bodies of all blocks, and which rows are angles.
   subroutine coupler_declare_rows(self, rows)
      class(joint_coupler_t), intent(inout) :: self  !! the set; places of its blocks are set
      type(rows_t), intent(inout) :: rows            !! rows; those of the set are declared

      integer :: k, m

      do k = 1, self%n
         associate (one => self%items(k), row => self%first_row + k)
            rows%body(:, row) = one%body(:2)
            rows%is_angle(row) = one%of(1)%is_angle
            one%first_block = rows%n_block
            do m = 3, one%n_body, 2
               rows%n_block = rows%n_block + 1
               rows%body(:, rows%n_block) = one%body(m:m + 1)
               rows%owner(rows%n_block) = row
            end do
         end associate
      end do
   end subroutine coupler_declare_rows

   !> A coordinate of an item, an angle next to that at the end of the last step.
   pure function coupled_find(self, e, motion) result(x)
      class(coupled_t), intent(in) :: self   !! the item
      integer, intent(in) :: e               !! which of its joints
      type(motion_t), intent(in) :: motion   !! positions and velocities
      type(scalar_t) :: x                    !! the coordinate [rad or m]

      x = self%of(e)%find(motion)
      if (self%of(e)%is_angle .and. allocated(motion%spatial%own)) x%value = self%near(e) + wrapped(x%value - self%near(e))
   end function coupled_find

   !> Fill the rows of all items.
   subroutine coupler_evaluate(self, t, motion, rows)
      class(joint_coupler_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                   !! time [s]
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(rows_t), intent(inout) :: rows         !! rows, those of the set are filled

      type(scalar_t) :: x
      integer :: e, k, row

      do k = 1, self%n
         row = self%first_row + k
         associate (one => self%items(k))
            rows%phi(row) = -one%sum
            rows%phi_t(row) = 0.0_wp
            rows%gam(row) = 0.0_wp
            rows%jac(:, row) = 0.0_wp
            rows%jac(:, one%first_block + 1:one%first_block + (one%n_body - 1)/2) = 0.0_wp
            do e = 1, one%n
               x = one%find(e, motion)
               rows%phi(row) = rows%phi(row) + one%scale(e)*x%value
               rows%gam(row) = rows%gam(row) - one%scale(e)*x%bend
               call add_entries(one, e, x, row, motion, rows)
            end do
         end associate
      end do
   end subroutine coupler_evaluate

   !> Add the entries of a coordinate to the blocks of its bodies; those of the ground to a side that is left, if there is one.
   pure subroutine add_entries(one, e, x, row, motion, rows)
      type(coupled_t), intent(in) :: one      !! the item
      integer, intent(in) :: e                !! which of its joints
      type(scalar_t), intent(in) :: x         !! its coordinate
      integer, intent(in) :: row              !! number of the row
      type(motion_t), intent(in) :: motion    !! positions
      type(rows_t), intent(inout) :: rows     !! rows

      real(wp) :: entries(12)
      integer :: block, m, n_v, place, side

      n_v = rows%n_v
      if (allocated(motion%spatial%own)) then
         entries = row_of(motion, one%of(e)%body, x)
      else
         entries(:6) = [-x%force(:2), x%turn_i(3), x%force(:2), x%turn_j(3)]
      end if
      do side = 1, 2
         if (one%of(e)%body(side) == 0 .and. modulo(one%n_body, 2) == 0) cycle
         m = findloc(one%body, one%of(e)%body(side), dim=1)
         block = row
         if (m > 2) block = one%first_block + (m - 1)/2
         place = n_v*mod(m - 1, 2)
         rows%jac(place + 1:place + n_v, block) = rows%jac(place + 1:place + n_v, block) &
                                                  + one%scale(e)*entries(n_v*(side - 1) + 1:n_v*side)
      end do
   end subroutine add_entries

   !> A step has ended: angles are counted from there.
   subroutine coupler_follow(self, motion)
      class(joint_coupler_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion           !! positions at the end of the step

      type(scalar_t) :: x
      integer :: e, k

      do k = 1, self%n
         do e = 1, self%items(k)%n
            x = self%items(k)%find(e, motion)
            self%items(k)%near(e) = x%value
         end do
      end do
   end subroutine coupler_follow

   !> What an item does to body i, or j, of its first joint.
   subroutine coupler_reaction(self, item, motion, coordinates, rows, lambda, force, moment, side)
      class(joint_coupler_t), intent(in) :: self       !! the set
      integer, intent(in) :: item                      !! item of the set
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N or N.m]
      real(wp), intent(out) :: force(3)                !! (3) force on the body, world frame [N]
      real(wp), intent(out) :: moment(3)               !! (3) moment on the body about the point of j, world frame [N.m]
      integer, intent(in), optional :: side            !! 1: body i, 2: body j; absent: body i

      type(scalar_t) :: x
      real(wp) :: pull

      x = self%items(item)%find(1, motion)
      pull = lambda(self%first_row + item)
      if (present(side)) pull = merge(-1.0_wp, 1.0_wp, side == 2)*pull
      force = pull*x%force
      moment = 0.0_wp
      if (self%items(item)%of(1)%is_angle) moment = pull*x%turn_j
   end subroutine coupler_reaction

   !> The point of j of the first joint.
   function coupler_reaction_point(self, k, motion) result(p)
      class(joint_coupler_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! item
      type(motion_t), intent(in) :: motion        !! positions
      real(wp) :: p(3)                            !! (3) the point, world frame [m]

      p = self%items(k)%of(1)%place(motion)
   end function coupler_reaction_point

   !> Moments and forces on the coordinates.
   subroutine coupler_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      class(joint_coupler_t), intent(in) :: self       !! the set
      integer, intent(in) :: code                      !! the channel
      integer, intent(in) :: k                         !! item of the set
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N or N.m]
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [N or N.m]

      integer :: e

      e = mod(code - of_own, most_joints) + 1
      value(1) = 0.0_wp
      if (e > self%items(k)%n) return
      if (self%items(k)%of(e)%is_angle .neqv. code < of_forces) return
      value(1) = -self%items(k)%scale(e)*lambda(self%first_row + k)
   end subroutine coupler_report_own

   !> Write the coordinates.
   subroutine coupler_save(self, archive)
      class(joint_coupler_t), intent(in) :: self  !! the set
      type(archive_t), intent(inout) :: archive   !! the checkpoint

      integer :: k

      do k = 1, self%n
         call archive%put(self%items(k)%near)
      end do
   end subroutine coupler_save

   !> Read the coordinates.
   subroutine coupler_load(self, archive)
      class(joint_coupler_t), intent(inout) :: self  !! the set
      type(archive_t), intent(inout) :: archive      !! the checkpoint

      integer :: e, k

      do k = 1, self%n
         do e = 1, most_joints
            call archive%get(self%items(k)%near(e))
         end do
      end do
   end subroutine coupler_load

end module joint_coupler
