!> The channels that ideal joints share, and those that drivers share, and the reaction that they tell of.
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
      call add_channel(info, "force", "N", "world", 2, "reaction force on the body of i", of_force)
      call add_channel(info, "moment", "N.m", "world", 1, "reaction moment on the body of i about the point of the force", &
                       of_moment)
      call add_channel(info, "violation", "m", "none", 1, "norm of the constraint violation, angles times 1 m", of_violation)
      call add_channel(info, "violation_rate", "m/s", "none", 1, "norm of the rate of the constraint violation", &
                       of_violation_rate)
   end procedure add_joint_channels

   !> Values that are read. They are written to their places one by one: a name for a place is a descriptor, made at each reading.
   module procedure joint_report
      real(wp) :: force(3), load(most_rates), moment(3), rate
      integer :: column, first, group, i, k, last, m

      do m = 1, readings%n
         k = readings%item(m)
         group = readings%group(m)
         column = self%column(k)
         first = self%first_row + (k - 1)*self%n_row_item + 1
         last = first + self%n_row_item - 1
         select case (readings%code(m))
         case (of_force, of_moment)
            if (self%is_driver) then
               groups(group)%data(1, column) = -lambda(first)
            else if (readings%code(m) == of_force) then
               call find_load(self, k, 0, coordinates%n_v, rows%jac, lambda, load)
               call coordinates%split_load(load(:coordinates%n_v), motion, self%body(1, k), force, moment)
               do i = 1, size(groups(group)%data, 1)
                  groups(group)%data(i, column) = force(i)
               end do
            else
               call self%reaction(k, motion, coordinates, rows, lambda, force, moment)
               i = merge(3, 1, size(groups(group)%data, 1) == 1)
               groups(group)%data(:, column) = moment(i:)
            end if
         case (of_violation)
            groups(group)%data(1, column) = norm2(rows%phi(first:last))
         case (of_violation_rate)
            groups(group)%data(1, column) = norm2(phi_dot(first:last))
         case (of_coordinate)
            call self%coordinate(k, motion, groups(group)%data(1, column), rate)
         case (of_power)
            groups(group)%data(1, column) = sum(lambda(first:last)*rows%phi_t(first:last))
         case (of_friction_moment, of_friction_force)
            do i = 1, self%friction%n
               if (self%friction%item(i) /= k) cycle
               groups(group)%data(1, column) = self%friction%force(i)
               if (readings%code(m) == of_friction_moment) then
                  groups(group)%data(1, column) = self%friction%length(1, i)*self%friction%force(i)
               end if
            end do
         case default
            call self%report_own(readings%code(m), k, motion, coordinates, rows, lambda, groups(group)%data(:, column))
         end select
      end do
   end procedure joint_report

   !> Reaction of an item on body i, or j.
   module procedure joint_reaction
      real(wp) :: load(most_rates)
      integer :: before, body

      before = 0
      if (present(side)) before = (side - 1)*coordinates%n_v
      body = self%body(merge(2, 1, before > 0), item)
      call find_load(self, item, before, coordinates%n_v, rows%jac, lambda, load)
      call coordinates%split_load(load(:coordinates%n_v), motion, body, force, moment)
      moment = moment - cross(self%reaction_point(item, motion) - motion%r(:, body), force)
   end procedure joint_reaction

   !> Load of the rows of an item on the rates of a body.
   pure subroutine find_load(self, item, before, n, jac, lambda, load)
      class(joint_set_t), intent(in) :: self          !! the set
      integer, intent(in) :: item                     !! item of the set
      integer, intent(in) :: before                   !! places before the body's in the rows
      integer, intent(in) :: n                        !! rates of a body
      real(wp), intent(in), contiguous :: jac(:, :)   !! (2 n, rows) Phi_q [1 or m]
      real(wp), intent(in), contiguous :: lambda(:)   !! (rows) multipliers [N or N.m]
      real(wp), intent(inout) :: load(most_rates)     !! (n) first: the load [N or N.m]

      integer :: i, k, row

      load(1:n) = 0.0_wp
      do k = 1, self%n_row_item
         row = self%first_row + (item - 1)*self%n_row_item + k
         !GCC$ novector
         do i = 1, n
            load(i) = load(i) - jac(before + i, row)*lambda(row)
         end do
      end do
   end subroutine find_load

end submodule joint_channels
