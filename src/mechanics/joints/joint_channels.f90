!> The channels that ideal joints share, and those that drivers share, and the reaction that they report of.
!>
!> The reaction of a joint is all that it transmits: its constraint forces and, if it has friction, its friction.
!>
!> Signs: force and moment of a joint are those on the body of i; those of a driver act on the body of j along its coordinate,
!> -lambda. Power of a driver: lambda . Phi_t.
submodule(joint_set) joint_channels
   use coordinates, only: most_rates
   use joint_friction, only: of_friction_force, of_friction_moment
   use motion, only: cross
   implicit none (type, external)

contains

   !> The channels that every ideal joint has.
   module procedure add_joint_channels
      call add_channel(info, "force", "N", "world", 2, "reaction force on the body of i, including joint friction", of_force)
      call add_channel(info, "moment", "N.m", "world", 1, "reaction moment on the body of i about the point of the force, "// &
                       "including joint friction", of_moment)
      call add_channel(info, "violation", "m", "none", 1, "norm of the constraint violation, angles multiplied by 1 m", &
         of_violation)
      call add_channel(info, "violation_rate", "m/s", "none", 1, "norm of the rate of the constraint violation", &
                       of_violation_rate)
   end procedure add_joint_channels

   !> Values that are read. What is read often is found here, all else by a call.
   module procedure joint_report
      real(wp) :: force(3), load(most_rates), moment(3), rate
      integer :: at, before, i, m

      do m = 1, readings%n
         associate (reading => readings%of(m))
            at = reading%place
            before = self%first_row + (reading%item - 1)*self%n_row_item
            if (self%is_driver .and. reading%code <= of_moment) then
               values(at + 1) = -lambda(before + 1)
            else if (reading%code == of_force) then
               call find_load(self%n_row_item, before, 0, coordinates%n_v, rows%n, rows%jac, lambda, load)
               if (self%friction%n > 0) call add_friction(self%friction, reading%item, 0, coordinates%n_v, load)
               call coordinates%split_load(load, motion, self%body(1, reading%item), force, moment)
               do i = 1, reading%width
                  values(at + i) = force(i)
               end do
            else if (reading%code == of_coordinate) then
               call self%coordinate(reading%item, motion, values(at + 1), rate)
            else
               call report_other(self, reading%code, reading%item, motion, coordinates, rows, lambda, phi_dot, &
                                 values(at + 1:at + reading%width))
            end if
         end associate
      end do
   end procedure joint_report

   !> A channel that is neither a force nor a coordinate.
   subroutine report_other(self, code, k, motion, coordinates, rows, lambda, phi_dot, value)
      class(joint_set_t), intent(in) :: self           !! the set
      integer, intent(in) :: code                      !! the channel
      integer, intent(in) :: k                         !! item of the set
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N or N.m]
      real(wp), intent(in), contiguous :: phi_dot(:)   !! (rows) rates of the violations [m/s or rad/s]
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [any]

      real(wp) :: force(3), moment(3)
      integer :: first, i, last

      first = self%first_row + (k - 1)*self%n_row_item + 1
      last = first + self%n_row_item - 1
      select case (code)
      case (of_moment)
         call self%reaction(k, motion, coordinates, rows, lambda, force, moment)
         value = moment(merge(3, 1, size(value) == 1):)
      case (of_violation)
         value(1) = norm2(rows%phi(first:last))
      case (of_violation_rate)
         value(1) = norm2(phi_dot(first:last))
      case (of_power)
         value(1) = sum(lambda(first:last)*rows%phi_t(first:last))
      case (of_friction_moment, of_friction_force)
         do i = 1, self%friction%n
            if (self%friction%item(i) /= k) cycle
            value(1) = self%friction%force(i)
            if (code == of_friction_moment) value(1) = self%friction%length(1, i)*self%friction%force(i)
         end do
      case default
         call self%report_own(code, k, motion, coordinates, rows, lambda, value)
      end select
   end subroutine report_other

   !> Reaction of an item on body i, or j.
   module procedure joint_reaction
      real(wp) :: load(most_rates)
      integer :: before, body

      before = 0
      if (present(side)) before = (side - 1)*coordinates%n_v
      body = self%body(merge(2, 1, before > 0), item)
      call find_load(self%n_row_item, self%first_row + (item - 1)*self%n_row_item, before, coordinates%n_v, rows%n, rows%jac, &
                     lambda, load)
      if (self%friction%n > 0) call add_friction(self%friction, item, before, coordinates%n_v, load)
      call coordinates%split_load(load, motion, body, force, moment)
      moment = moment - cross(self%reaction_point(item, motion) - motion%r(:, body), force)
   end procedure joint_reaction

   !> Add the friction of the last evaluation, if the item has friction.
   pure subroutine add_friction(friction, item, before, n, load)
      type(joint_friction_t), intent(in) :: friction  !! friction of the set
      integer, intent(in) :: item                     !! item of the set
      integer, intent(in) :: before                   !! places before the body's in the rows
      integer, intent(in) :: n                        !! rates of a body
      real(wp), intent(inout) :: load(most_rates)     !! (n) first: the load [N or N.m]

      integer :: m

      do m = 1, friction%n
         if (friction%item(m) == item) load(1:n) = load(1:n) + friction%force(m)*friction%row(before + 1:before + n, m)
      end do
   end subroutine add_friction

   !> Load of some rows on the rates of a body.
   pure subroutine find_load(n_own, first, before, n, n_row, jac, lambda, load)
      integer, intent(in) :: n_own                    !! how many rows
      integer, intent(in) :: first                    !! rows before them
      integer, intent(in) :: before                   !! places before the body's in the rows
      integer, intent(in) :: n                        !! rates of a body
      integer, intent(in) :: n_row                    !! number of all rows
      real(wp), intent(in) :: jac(2*n, n_row)         !! (2 n, rows) Phi_q [1 or m]
      real(wp), intent(in) :: lambda(n_row)           !! (rows) multipliers [N or N.m]
      real(wp), intent(inout) :: load(most_rates)     !! (n) first: the load [N or N.m]

      integer :: i, k, row

      load(1:n) = 0.0_wp
      do k = 1, n_own
         row = first + k
         !GCC$ novector
         do i = 1, n
            load(i) = load(i) - jac(before + i, row)*lambda(row)
         end do
      end do
   end subroutine find_load

end submodule joint_channels
