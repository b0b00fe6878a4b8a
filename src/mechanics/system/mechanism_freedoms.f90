!> Small changes of the state along the bodies' axes, and those that the rows leave.
submodule(mechanism_state) mechanism_freedoms
   use free_directions, only: find_free_directions
   implicit none (type, external)

contains

   !> The local change that a small change of a state is. One coordinate of a body with one degree of freedom, and other states, are
   !> what they are.
   module procedure mechanism_to_local
      integer :: n_rate, n_turned

      associate (linkage => self%linkage, n_body => self%linkage%rows%n_unknown, nq => self%linkage%n_position)
         n_rate = linkage%n_rate
         n_turned = linkage%coordinates%n_v*n_body
         call linkage%coordinates%to_local(n_body, y, change, change(nq + 1:), x, x(n_rate + 1:))
         x(n_turned + 1:n_rate) = change(linkage%coordinates%n_q*n_body + 1:nq)
         x(n_rate + n_turned + 1:) = change(nq + n_turned + 1:)
      end associate
   end procedure mechanism_to_local

   !> The small change of a state that a local change is.
   module procedure mechanism_from_local
      integer :: n_rate, n_turned

      associate (linkage => self%linkage, n_body => self%linkage%rows%n_unknown, nq => self%linkage%n_position)
         n_rate = linkage%n_rate
         n_turned = linkage%coordinates%n_v*n_body
         call linkage%coordinates%from_local(n_body, y, x, x(n_rate + 1:), change, change(nq + 1:))
         change(linkage%coordinates%n_q*n_body + 1:nq) = x(n_turned + 1:n_rate)
         change(nq + n_turned + 1:) = x(n_rate + n_turned + 1:)
      end associate
   end procedure mechanism_from_local

   !> Directions that the rows leave the bodies, then one of each body with one degree of freedom.
   module procedure mechanism_free_directions
      integer :: k, n_turned

      associate (linkage => self%linkage)
         n_turned = linkage%coordinates%n_v*linkage%rows%n_unknown
         direction = 0.0_wp
         reading = 0.0_wp
         call linkage%set_motion(t, y)
         if (linkage%rows%n_solve > 0) call linkage%evaluate_rows(t)
         call find_free_directions(linkage, y, n, direction(:n_turned, :), reading(:n_turned, :))
         do k = n_turned + 1, linkage%n_rate
            n = n + 1
            if (n > size(direction, 2)) cycle
            direction(k, n) = 1.0_wp
            reading(k, n) = 1.0_wp
         end do
      end associate
   end procedure mechanism_free_directions

end submodule mechanism_freedoms
