!> Friction in the ideal joints of a mechanism.
!>
!> Friction forces x of the m joints with friction follow from normal forces, these from the multipliers, and these from x:
!>
!> x_k = f_k(N_k(lambda), v_k, z_k),   lambda = lambda_0 + R (x - x_0)
!>
!> with f_k the law of friction (`joint_friction`), lambda_0 the multipliers of accelerations under forces x_0, and R what unit
!> forces do to them, which is one solution of the augmented equations for each joint. The m equations are solved by Newton's
!> iteration to 1e-12 of the maximum force; the accelerations then are those under all loads. With multipliers that are given, as
!> those of `ida`, no equation is to be solved.
!>
!> What sticks to contacts (`mechanism_friction`) is found in turns with x until neither changes.
!>
!> Source: the equations of motion, Flores et al. (2008), eq. (2.14), with friction among the loads. Limits: x is unique as
!> long as friction gives less normal force than it comes from, |f' N_lambda R| < 1; a joint beyond that locks (wedges), and has no
!> solution or several: the evaluation then fails, or takes the one that is found from x_0 = 0.
submodule(mechanism) mechanism_rubbing
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use joint_friction, only: law_force, most_rows
   use lapack, only: dgetrf, dgetrs
   implicit none (type, external)

   real(wp), parameter :: tolerance = 1.0e-12_wp   !! of the forces, of the maximum of them [1]
   integer, parameter :: most_iterations = 30      !! of Newton's, at most
   integer, parameter :: most_turns = 30           !! of friction in joints and of contacts that stick, at most
   real(wp), parameter :: normal_step = 1.0_wp     !! of the difference that gives the slope of a law, beyond N itself [N]
   real(wp), parameter :: most_force = 1.0e100_wp  !! friction is no greater: beyond, the iteration goes nowhere [N]

contains

   !> Friction forces, and the accelerations with them.
   module procedure mechanism_add_friction
      integer :: k, turn

      call slide(self)
      do k = 1, self%linkage%n_solved_set
         associate (friction => self%linkage%joints(k)%set%friction)
            if (friction%n > 0) friction%force = 0.0_wp
         end associate
      end do
      do turn = 1, most_turns
         call solve_rubbing(self, status)
         if (status /= 0) return
         if (self%friction%stick_slips%n_slip == 0) exit
         call self%stick(status)
         if (status /= 0) return
         if (maxval(abs(self%friction%rubbing%change)) <= tolerance*maximum(self)) exit
      end do
      call note_power(self)
   end procedure mechanism_add_friction

   !> Friction forces by the multipliers that are set, into the loads.
   module procedure mechanism_friction_by_multipliers
      real(wp) :: before, normal, slope(most_rows), z_rate
      integer :: k

      call slide(self)
      change = 0.0_wp
      associate (rubbing => self%friction%rubbing)
         call take_multipliers(self, rubbing%lambda)
         do k = 1, rubbing%n
            associate (set => self%linkage%joints(rubbing%slot(k))%set, m => rubbing%place(k))
               call set%press(m, rubbing%lambda(:, k), normal, slope)
               before = set%friction%force(m)
               call law_force(set%friction%law(m)%law, is_steady, normal, set%friction%v(m), set%friction%z(m), &
                              set%friction%force(m), z_rate)
               set%friction%z_rate(m) = z_rate
               if (.not. is_added) before = 0.0_wp
               rubbing%change(k) = set%friction%force(m) - before
               change = max(change, abs(rubbing%change(k)))
            end associate
         end do
         do k = 1, rubbing%n
            call add_friction(self, k, rubbing%change(k), self%loading%g)
         end do
      end associate
      change = change/max(maximum(self), tiny(1.0_wp))
      call note_power(self)
   end procedure mechanism_friction_by_multipliers

   !> How the joints with friction lie, at the present motion.
   subroutine slide(self)
      class(mechanism_t), intent(inout) :: self   !! the system, its motion set

      integer :: k

      do k = 1, self%linkage%n_solved_set
         associate (set => self%linkage%joints(k)%set)
            if (set%friction%n > 0) call set%slide(self%linkage%motion)
         end associate
      end do
   end subroutine slide

   !> Newton's iteration from the forces that the accelerations have in them.
   subroutine solve_rubbing(self, status)
      class(mechanism_t), intent(inout) :: self   !! the system, accelerations found
      integer, intent(out) :: status              !! 0: found

      real(wp) :: max_force
      integer :: info, k

      call respond(self, status)
      if (status /= 0) return
      associate (rubbing => self%friction%rubbing, n => self%friction%rubbing%n)
         rubbing%change = 0.0_wp
         status = 1
         rubbing%wedged = 0
         if (.not. all(ieee_is_finite(rubbing%lambda(:, :n)))) return   ! of a state far out, as of a stage that is given up
         if (maxval(abs(rubbing%lambda(:, :n))) > most_force) return
         do k = 1, most_iterations
            call find_left(self, max_force)
            if (maxval(abs(rubbing%left)) <= tolerance*max_force) then
               status = 0
               exit
            end if
            call dgetrf(n, n, rubbing%matrix, n, rubbing%pivot, info)
            if (info /= 0) exit
            call dgetrs("N", n, 1, rubbing%matrix, n, rubbing%pivot, rubbing%left, n, info)
            rubbing%change = rubbing%change - rubbing%left
            if (maxval(abs(rubbing%change)) > most_force) exit   ! it diverges
         end do
         if (status /= 0) rubbing%wedged = maxloc(abs(rubbing%left), dim=1)
         if (status /= 0) return
         do k = 1, n
            associate (friction => self%linkage%joints(rubbing%slot(k))%set%friction, m => rubbing%place(k))
               friction%force(m) = friction%force(m) + rubbing%change(k)
            end associate
            call add_friction(self, k, rubbing%change(k), self%loading%g)
         end do
      end associate
      call self%linkage%find_accelerations(self%loading%g, .true., self%friction%stick_slips%n_slip > 0, status)
   end subroutine solve_rubbing

   !> Multipliers of the joints with friction, and what unit forces do to them.
   subroutine respond(self, status)
      class(mechanism_t), intent(inout) :: self   !! the system, accelerations found; they are lost
      integer, intent(out) :: status              !! 0: found

      integer :: d

      associate (rubbing => self%friction%rubbing, solution => self%linkage%solution, n => self%linkage%rows%n_solve)
         call take_multipliers(self, rubbing%lambda)
         rubbing%load%b(:n) = solution%b(:n)
         solution%b(:n) = 0.0_wp
         do d = 1, rubbing%n
            rubbing%load%unit = 0.0_wp
            call add_friction(self, d, 1.0_wp, rubbing%load%unit)
            call self%linkage%find_accelerations(rubbing%load%unit, .false., .false., status)
            if (status /= 0) exit
            call take_multipliers(self, rubbing%response(:, :, d))
         end do
         solution%b(:n) = rubbing%load%b(:n)
      end associate
   end subroutine respond

   !> What is left of the equations of the forces, and their derivatives.
   subroutine find_left(self, max_force)
      class(mechanism_t), intent(inout) :: self     !! the system, responses found
      real(wp), intent(out) :: max_force       !! of all joints [N]

      real(wp) :: beyond, force, lambda(most_rows), normal, slope(most_rows), steepness, x, z_rate
      integer :: d, k

      max_force = tiny(1.0_wp)
      associate (rubbing => self%friction%rubbing)
         do k = 1, rubbing%n
            associate (set => self%linkage%joints(rubbing%slot(k))%set, m => rubbing%place(k))
               lambda = rubbing%lambda(:, k)
               do d = 1, rubbing%n
                  lambda = lambda + rubbing%response(:, k, d)*rubbing%change(d)
               end do
               call set%press(m, lambda, normal, slope)
               associate (friction => set%friction)
                  call law_force(friction%law(m)%law, .false., normal, friction%v(m), friction%z(m), force, z_rate)
                  friction%z_rate(m) = z_rate
                  call law_force(friction%law(m)%law, .false., 2.0_wp*normal + normal_step, friction%v(m), friction%z(m), beyond, &
                                 z_rate)
                  steepness = (beyond - force)/(normal + normal_step)
                  x = friction%force(m) + rubbing%change(k)
               end associate
               rubbing%left(k) = x - force
               do d = 1, rubbing%n
                  rubbing%matrix(k, d) = -steepness*dot_product(slope, rubbing%response(:, k, d))
               end do
               rubbing%matrix(k, k) = rubbing%matrix(k, k) + 1.0_wp
               max_force = max(max_force, abs(x), abs(force))
            end associate
         end do
      end associate
   end subroutine find_left

   !> Multipliers of the last solution, those of the joints with friction.
   pure subroutine take_multipliers(self, lambda)
      class(mechanism_t), intent(in) :: self     !! the system
      real(wp), intent(out) :: lambda(:, :)      !! (most_rows, joints) the multipliers, then zeros [N or N.m]

      integer :: first, k

      lambda = 0.0_wp
      do k = 1, self%friction%rubbing%n
         associate (set => self%linkage%joints(self%friction%rubbing%slot(k))%set, m => self%friction%rubbing%place(k))
            first = set%first_row + (set%friction%item(m) - 1)*set%n_row_item
            lambda(:set%n_row_item, k) = self%linkage%solution%lambda(first + 1:first + set%n_row_item)
         end associate
      end do
   end subroutine take_multipliers

   !> Add the pair of friction forces of a joint to loads on the rates.
   pure subroutine add_friction(self, k, force, g)
      class(mechanism_t), intent(in) :: self     !! the system
      integer, intent(in) :: k                   !! number of the joint that has friction
      real(wp), intent(in) :: force              !! on body j along its sliding velocity [N]
      real(wp), intent(inout) :: g(:, 0:)        !! (n_v, 0:bodies) loads [N or N.m]

      associate (set => self%linkage%joints(self%friction%rubbing%slot(k))%set, m => self%friction%rubbing%place(k), &
                 n_v => size(g, 1))
         associate (i => set%body(1, set%friction%item(m)), j => set%body(2, set%friction%item(m)))
            g(:, i) = g(:, i) + force*set%friction%row(:n_v, m)
            g(:, j) = g(:, j) + force*set%friction%row(n_v + 1:, m)
         end associate
      end associate
   end subroutine add_friction

   !> The maximum friction force.
   pure real(wp) function maximum(self)
      class(mechanism_t), intent(in) :: self     !! the system

      integer :: k

      maximum = 0.0_wp
      do k = 1, self%friction%rubbing%n
         associate (friction => self%linkage%joints(self%friction%rubbing%slot(k))%set%friction)
            maximum = max(maximum, abs(friction%force(self%friction%rubbing%place(k))))
         end associate
      end do
   end function maximum

   !> Power that friction in joints takes.
   subroutine note_power(self)
      class(mechanism_t), intent(inout) :: self  !! the system, forces found

      integer :: k

      self%friction%rubbing%power = 0.0_wp
      do k = 1, self%linkage%n_solved_set
         associate (friction => self%linkage%joints(k)%set%friction)
            if (friction%n > 0) self%friction%rubbing%power = self%friction%rubbing%power - dot_product(friction%force, friction%v)
         end associate
      end do
   end subroutine note_power

end submodule mechanism_rubbing
