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

   !> Values of a channel for all items.
   module procedure report_shared
      real(wp) :: force(3), moment(3), rate, value
      integer :: first, k, last

      do k = 1, self%n
         first = self%first_row + (k - 1)*self%n_row_item + 1
         last = first + self%n_row_item - 1
         associate (column => self%column(k))
            select case (code)
            case (of_force)
               if (self%is_driver) then
                  values(1, column) = -lambda(first)
               else
                  call self%reaction(k, motion, coordinates, rows, lambda, force, moment)
                  values(:, column) = force(:size(values, 1))
               end if
            case (of_moment)
               if (self%is_driver) then
                  values(1, column) = -lambda(first)
               else
                  call self%reaction(k, motion, coordinates, rows, lambda, force, moment)
                  values(1, column) = moment(3)
               end if
            case (of_violation)
               values(1, column) = norm2(rows%phi(first:last))
            case (of_violation_rate)
               values(1, column) = norm2(phi_dot(first:last))
            case (of_coordinate)
               call self%coordinate(k, motion, value, rate)
               values(1, column) = value
            case (of_power)
               values(1, column) = sum(lambda(first:last)*rows%phi_t(first:last))
            end select
         end associate
      end do
      if (code /= of_friction_moment .and. code /= of_friction_force) return
      do k = 1, self%friction%n
         associate (column => self%column(self%friction%item(k)))
            values(1, column) = self%friction%force(k)
            if (code == of_friction_moment) values(1, column) = self%friction%length(k)*self%friction%force(k)
         end associate
      end do
   end procedure report_shared

   !> Reaction of an item on body i.
   module procedure joint_reaction
      real(wp) :: load(most_rates)
      integer :: body, k, n, row

      n = coordinates%n_v
      load = 0.0_wp
      body = self%body(1, item)
      do k = 1, self%n_row_item
         row = self%first_row + (item - 1)*self%n_row_item + k
         load(:n) = load(:n) - rows%jac(:n, row)*lambda(row)
      end do
      call coordinates%split_load(load(:n), motion, body, force, moment)
      moment = moment - cross(self%reaction_point(item, motion) - motion%r(:, body), force)
   end procedure joint_reaction

end submodule joint_channels
