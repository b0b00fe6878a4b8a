!> Bodies linked by ideal joints and drivers: their motion, the constraint rows Phi(q, t) = 0, and the solution of the equations.
!>
!> The state has the coordinates of each body whose motion is unknown, then one of each body with one degree of freedom, then the
!> rates of both. Loads come from outside, so that stabilisation methods, the start and the analyses without integration need
!> nothing but this.
!> Source: Flores et al. (2008), eqs. (2.10), (2.11), (2.15).
module linkage
   use bodies, only: bodies_t
   use coordinates, only: coordinates_t
   use joint_set, only: joint_slot_t
   use rows, only: rows_t
   use kinds, only: wp
   use motion, only: motion_t
   use readings, only: wanted_rows_t
   use reduced, only: reduced_t
   use row_kernels, only: right_hand_side, take_prescribed
   use smooth_segment, only: smooth_segment_t
   use solution, only: find_free, solution_t
   implicit none (type, external)
   private
   public :: linkage_t, scales_t

   integer, parameter :: rows_at_once = 256   !! evaluated before their rates are found, while they are in the processor's cache

   !> What is large and what is small, see `mechanism_scales`.
   type :: scales_t
      real(wp) :: length = 1.0_wp         !! size of the bodies, for error scales [m]
      real(wp) :: tolerance = 1.0e-8_wp   !! of the integrator, for what round-off allows [1]
      real(wp) :: pace = 1.0_wp           !! maximum rate of the mechanism so far [1/s]
      real(wp) :: late_rate = 0.01_wp     !! rate that errors are measured by at least [1/s]
      real(wp) :: misfit = 0.0_wp         !! of redundant rows, fitted in least squares: sizes of the bodies or radians [1]
   end type scales_t

   !> Bodies and what links them.
   type :: linkage_t
      type(bodies_t) :: bodies                          !! the bodies
      class(coordinates_t), allocatable :: coordinates  !! what their positions and rates are
      integer :: n_position = 0                         !! coordinates in the state
      integer :: n_rate = 0                             !! rates in the state
      real(wp), allocatable :: mass(:, :)               !! (n_v, bodies) masses [kg or kg.m^2]
      real(wp), allocatable :: inverse_mass(:, :)       !! (n_v, 0:bodies) the same inverted, 0 if known [1/kg or 1/(kg.m^2)]
      type(scales_t) :: scales                          !! sizes and rates
      type(joint_slot_t), allocatable :: joints(:)      !! sets of ideal joints and drivers, see `build_linkage`
      integer :: n_solved_set = 0                       !! sets of them with rows that are solved for, the first ones
      type(joint_slot_t), allocatable :: ideal(:)       !! joints with clearance taken as ideal, one set per kind
      type(reduced_t) :: reduced                        !! bodies that are not unknown
      type(smooth_segment_t) :: segment                     !! where functions of time are evaluated
      type(motion_t) :: motion                          !! positions, velocities, and accelerations where they are set
      type(rows_t) :: rows                              !! constraint rows
      type(solution_t) :: solution                      !! accelerations and multipliers
      real(wp), allocatable, private :: rest(:, :)      !! (n_v, 0:bodies) scratch: loads [N or N.m]
   contains
      procedure :: make_storage => linkage_make_storage, place_bodies => linkage_place_bodies
      procedure :: deck_state => linkage_deck_state, take_state => linkage_take_state
      procedure :: move => linkage_move, set_motion => linkage_set_motion
      procedure :: set_acceleration => linkage_set_acceleration, set_state => linkage_set_state
      procedure :: evaluate_rows => linkage_evaluate_rows, find_accelerations => linkage_find_accelerations
      procedure :: solve_rows => linkage_solve_rows, add_change => linkage_add_change, tidy => linkage_tidy
      procedure :: list_wanted => linkage_list_wanted, find_reactions => linkage_find_reactions
      procedure :: max_violation => linkage_max_violation
      procedure :: set_rows_aside => linkage_set_rows_aside
      procedure :: row_name => linkage_row_name
   end type linkage_t

   interface
      !> What the reports of some rows need of those that are not solved for. The multipliers of prescribed bodies are found
      !> together; they have those of the bodies with one degree of freedom in them that known ones carry.
      module subroutine linkage_list_wanted(self, is_read, wanted)
         implicit none (type, external)
         class(linkage_t), intent(in) :: self           !! the linkage
         logical, intent(in) :: is_read(:)              !! (rows) which are reported
         type(wanted_rows_t), intent(out) :: wanted     !! the list
      end subroutine linkage_list_wanted

      !> Multipliers of rows that fix bodies that are not solved for, at the motion and the accelerations that are set.
      !> Reports need them.
      module subroutine linkage_find_reactions(self, t, g, wanted)
         implicit none (type, external)
         class(linkage_t), intent(inout) :: self        !! the linkage
         real(wp), intent(in) :: t                      !! time [s]
         real(wp), intent(in) :: g(self%coordinates%n_v, 0:self%bodies%n)  !! (n_v, 0:bodies) loads [N or N.m]
         type(wanted_rows_t), intent(in) :: wanted      !! which of them
      end subroutine linkage_find_reactions

      !> Name of the joint or driver that a constraint row belongs to.
      module function linkage_row_name(self, row) result(name)
         implicit none (type, external)
         class(linkage_t), intent(in) :: self   !! the linkage
         integer, intent(in) :: row             !! number of the row
         character(:), allocatable :: name      !! the joint's name
      end function linkage_row_name
   end interface

contains

   !> Storage for the solution. The rows are declared.
   subroutine linkage_make_storage(self)
      class(linkage_t), intent(inout) :: self       !! the linkage

      associate (solution => self%solution, n => self%rows%n, n_body => self%bodies%n)
         solution%row_weight = merge(1.0_wp, 1.0_wp/self%scales%length, self%rows%is_angle)
         allocate (solution%phi_dot(n), solution%b(n), solution%lambda(n), source=0.0_wp)
         allocate (solution%left_out(0), solution%set_aside(0))
         allocate (solution%a(self%coordinates%n_v, 0:n_body), self%rest(self%coordinates%n_v, 0:n_body), source=0.0_wp)
         self%n_position = self%coordinates%n_q*self%rows%n_unknown + self%reduced%one_dof%n
         self%n_rate = self%coordinates%n_v*self%rows%n_unknown + self%reduced%one_dof%n
      end associate
   end subroutine linkage_make_storage

   !> Motion of all bodies at a state.
   subroutine linkage_set_motion(self, t, y)
      class(linkage_t), intent(inout) :: self                   !! the linkage
      real(wp), intent(in) :: t                                 !! time [s]
      real(wp), intent(in) :: y(self%n_position + self%n_rate)  !! (positions + rates) the first of a state [any]

      call self%move(self%segment%inside(t), y)
   end subroutine linkage_set_motion

   !> Motion of all bodies at a state and a time in the smooth stretch.
   subroutine linkage_move(self, t, y)
      class(linkage_t), intent(inout) :: self                   !! the linkage
      real(wp), intent(in) :: t                                 !! time, in the smooth stretch [s]
      real(wp), intent(in) :: y(self%n_position + self%n_rate)  !! (positions + rates) the first of a state [any]

      self%motion%t = t
      self%motion%number = self%motion%number + 1
      if (self%reduced%known%n > 0) call self%reduced%known%move(self%joints, t, self%motion)
      associate (n => self%rows%n_unknown, nq => self%n_position, one_dof => self%reduced%one_dof)
         if (n > 0) call self%coordinates%move(n, self%rows%unknown, y, y(nq + 1:), self%motion)
         if (one_dof%n > 0) call one_dof%move(y(nq - one_dof%n + 1:nq), y(nq + self%n_rate - one_dof%n + 1:), self%motion)
      end associate
   end subroutine linkage_move

   !> Coordinates and rates of all bodies as the deck gives them.
   subroutine linkage_deck_state(self, q, v)
      class(linkage_t), intent(in) :: self             !! the linkage
      real(wp), allocatable, intent(out) :: q(:)       !! (n_q bodies) coordinates [any]
      real(wp), allocatable, intent(out) :: v(:)       !! (n_v bodies) rates [any]

      allocate (q(self%coordinates%n_q*self%bodies%n), v(self%coordinates%n_v*self%bodies%n), source=0.0_wp)
      call self%coordinates%read_start(self%bodies, q, v)
   end subroutine linkage_deck_state

   !> Motion of all bodies, known and guided ones included, from coordinates and rates of all: that of no time.
   subroutine linkage_place_bodies(self, q, v)
      class(linkage_t), intent(inout) :: self        !! the linkage
      real(wp), intent(in), contiguous :: q(:)       !! (n_q bodies) coordinates [any]
      real(wp), intent(in), contiguous :: v(:)       !! (n_v bodies) rates [any]

      integer :: k

      self%motion%number = self%motion%number + 1
      call self%coordinates%move(self%bodies%n, [(k, k=1, self%bodies%n)], q, v, self%motion)
      if (allocated(self%reduced%known)) self%reduced%known%t = -huge(1.0_wp)
   end subroutine linkage_place_bodies

   !> The state that coordinates and rates of all bodies are. Joints of bodies with one degree of freedom are fulfilled.
   subroutine linkage_take_state(self, q, v, y)
      class(linkage_t), intent(inout) :: self          !! the linkage; its motion is that of the state
      real(wp), intent(in), contiguous :: q(:)         !! (n_q bodies) coordinates [any]
      real(wp), intent(in), contiguous :: v(:)         !! (n_v bodies) rates [any]
      real(wp), intent(inout), contiguous :: y(:)      !! (positions + rates or more) state, the first of it is set [any]

      integer :: body, k

      call self%place_bodies(q, v)
      associate (n_q => self%coordinates%n_q, n_v => self%coordinates%n_v, nq => self%n_position, one_dof => self%reduced%one_dof)
         do k = 1, self%rows%n_unknown
            body = self%rows%unknown(k)
            y(n_q*(k - 1) + 1:n_q*k) = q(n_q*(body - 1) + 1:n_q*body)
            y(nq + n_v*(k - 1) + 1:nq + n_v*k) = v(n_v*(body - 1) + 1:n_v*body)
         end do
         if (one_dof%n == 0) return
         call one_dof%read_coordinates(self%motion, y(nq - one_dof%n + 1:nq), y(nq + self%n_rate - one_dof%n + 1:))
      end associate
   end subroutine linkage_take_state

   !> Motion of all bodies, with accelerations, from a state and its derivative.
   subroutine linkage_set_state(self, t, y, ydot)
      class(linkage_t), intent(inout) :: self        !! the linkage
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(self%n_position + self%n_rate)     !! (positions + rates) the first of a state [any]
      real(wp), intent(in) :: ydot(self%n_position + self%n_rate)  !! (positions + rates) their derivatives [any]

      call self%set_motion(t, y)
      call self%set_acceleration(ydot)
   end subroutine linkage_set_state

   !> Accelerations of the unknown bodies from the derivative of a state.
   subroutine linkage_set_acceleration(self, ydot)
      class(linkage_t), intent(inout) :: self                      !! the linkage, its motion set
      real(wp), intent(in) :: ydot(self%n_position + self%n_rate)  !! (positions + rates) derivatives of the first of a state [any]

      associate (n => self%rows%n_unknown, nq => self%n_position, one_dof => self%reduced%one_dof)
         if (n > 0) call self%coordinates%accelerate(n, self%rows%unknown, ydot(nq + 1:), self%motion)
         if (one_dof%n > 0) call one_dof%set_acceleration(ydot(nq + self%n_rate - one_dof%n + 1:), self%motion)
      end associate
   end subroutine linkage_set_acceleration

   !> Solved rows, rates of their violations and right-hand sides at the present motion.
   subroutine linkage_evaluate_rows(self, t)
      class(linkage_t), intent(inout) :: self   !! the linkage, its motion set
      real(wp), intent(in) :: t                 !! time [s]

      real(wp) :: inside
      integer :: done, k

      inside = min(max(t, self%segment%low), self%segment%high)  ! in the smooth stretch: `smooth_segment`, without its call
      done = 0
      if (self%rows%n_solve > rows_at_once) then
         call evaluate_many(self, inside, done)
      else
         do k = 1, self%n_solved_set
            call self%joints(k)%set%evaluate(inside, self%motion, self%rows)
         end do
      end if
      do k = 1, size(self%ideal)
         call self%ideal(k)%set%evaluate(inside, self%motion, self%rows)
      end do
      call find_sides(self, done + 1, self%rows%n_solve)
      if (size(self%solution%set_aside) > 0) call self%set_rows_aside()
      if (size(self%rows%known, 2) == 0) return
      associate (rows => self%rows, motion => self%motion)
         if (self%coordinates%turns_in_body) then
            call take_prescribed(rows, self%bodies%n, motion%a, motion%spatial%rise, self%solution%b)
         else
            call take_prescribed(rows, self%bodies%n, motion%a, motion%alpha, self%solution%b)
         end if
      end associate
   end subroutine linkage_evaluate_rows

   !> Rows that are set aside ask for nothing.
   pure subroutine linkage_set_rows_aside(self)
      class(linkage_t), intent(inout) :: self   !! the linkage, rows evaluated

      integer :: k

      associate (rows => self%rows, solution => self%solution)
         do k = 1, size(solution%set_aside)
            associate (row => solution%set_aside(k))
               rows%phi(row) = 0.0_wp
               rows%phi_t(row) = 0.0_wp
               rows%jac(:, row) = 0.0_wp
               rows%gam(row) = 0.0_wp
               solution%phi_dot(row) = 0.0_wp
               solution%b(row) = 0.0_wp
            end associate
         end do
      end associate
   end subroutine linkage_set_rows_aside

   !> Many solved rows of joints, some at a time with their right-hand sides.
   subroutine evaluate_many(linkage, t, done)
      type(linkage_t), intent(inout) :: linkage   !! the linkage, its motion set
      real(wp), intent(in) :: t                   !! time, in the smooth stretch [s]
      integer, intent(out) :: done                !! rows that have right-hand sides; the others of joints have none yet

      integer :: k

      done = 0
      do k = 1, linkage%n_solved_set
         associate (set => linkage%joints(k)%set)
            if (set%first_row - done >= rows_at_once) then
               call find_sides(linkage, done + 1, set%first_row)
               done = set%first_row
            end if
            call set%evaluate(t, linkage%motion, linkage%rows)
         end associate
      end do
   end subroutine evaluate_many

   !> Rates of the violations and right-hand sides of some solved rows, as they were evaluated.
   subroutine find_sides(linkage, from, to)
      type(linkage_t), intent(inout) :: linkage   !! the linkage
      integer, intent(in) :: from                 !! the first of the rows
      integer, intent(in) :: to                   !! the last of them

      associate (rows => linkage%rows, motion => linkage%motion, solution => linkage%solution)
         if (linkage%coordinates%turns_in_body) then
            call right_hand_side(from, to, rows, linkage%bodies%n, motion%v, motion%spatial%spin, solution%alpha, solution%beta, &
                                 solution%phi_dot, solution%b)
         else
            call right_hand_side(from, to, rows, linkage%bodies%n, motion%v, motion%omega, solution%alpha, solution%beta, &
                                 solution%phi_dot, solution%b)
         end if
      end associate
   end subroutine find_sides

   !> Accelerations and multipliers of the rows, as they were evaluated.
   subroutine linkage_find_accelerations(self, g, must_agree, with_one_dof, status)
      class(linkage_t), intent(inout) :: self        !! the linkage, rows evaluated
      real(wp), intent(in), contiguous :: g(:, 0:)   !! (n_v, 0:bodies) loads [N or N.m]
      logical, intent(in) :: must_agree              !! whether a contradiction counts: that of a correction is round-off
      logical, intent(in) :: with_one_dof             !! whether those of bodies with one degree of freedom are requested too
      integer, intent(out) :: status                 !! 0: found

      status = 0
      if (with_one_dof .and. self%reduced%one_dof%n > 0) then
         call self%reduced%one_dof%response(g, must_agree, self%motion, self%solution%a)
      end if
      if (self%rows%n_unknown == 0) return
      if (self%rows%n_solve == 0) then
         self%solution%bad_row = 0
         call find_free(self%rows%n_unknown, self%rows%unknown, self%coordinates%n_v, self%bodies%n, self%inverse_mass, g, &
                        self%solution%a)
         return
      end if
      self%solution%rate = self%scales%pace
      call self%solution%find(self%inverse_mass, self%rows, g, must_agree, status)
   end subroutine linkage_find_accelerations

   !> Minimum change of coordinates or rates in the metric of the masses, into `solution%a`: Phi_q a = b for the b that is set.
   subroutine linkage_solve_rows(self, status)
      class(linkage_t), intent(inout) :: self   !! the linkage, rows evaluated, b set
      integer, intent(out) :: status            !! 0: found

      self%rest = 0.0_wp
      call self%find_accelerations(self%rest, .false., .false., status)
   end subroutine linkage_solve_rows

   !> Add what `solve_rows` found, or what else is in `solution%a`, to the coordinates of a state, or to the rates.
   subroutine linkage_add_change(self, to_rates, y)
      class(linkage_t), intent(in) :: self          !! the linkage, rows solved
      logical, intent(in) :: to_rates               !! to the rates, not the coordinates
      real(wp), intent(inout), contiguous :: y(:)   !! (positions + rates or more) state [any]

      integer :: k

      associate (n_q => self%coordinates%n_q, n_v => self%coordinates%n_v)
         do k = 1, self%rows%n_unknown
            associate (change => self%solution%a(:, self%rows%unknown(k)), before => self%n_position + n_v*(k - 1))
               if (to_rates) then
                  y(before + 1:before + n_v) = y(before + 1:before + n_v) + change
               else
                  call self%coordinates%add_change(1, change, y(n_q*(k - 1) + 1:))
               end if
            end associate
         end do
      end associate
   end subroutine linkage_add_change

   !> Take away what of a state is no part of the motion, as the length of Euler parameters: a change of nothing is added.
   subroutine linkage_tidy(self, y)
      class(linkage_t), intent(in) :: self          !! the linkage
      real(wp), intent(inout), contiguous :: y(:)   !! (positions or more) state [any]

      real(wp) :: nothing(self%coordinates%n_v, self%rows%n_unknown)

      nothing = 0.0_wp
      associate (n => self%rows%n_unknown)
         call self%coordinates%add_change(n, nothing, y(:self%coordinates%n_q*n))
      end associate
   end subroutine linkage_tidy

   !> Maximum scaled violation of the solved rows, as they were evaluated.
   pure real(wp) function linkage_max_violation(self) result(worst)
      class(linkage_t), intent(in) :: self   !! the linkage

      associate (n => self%rows%n_solve)
         worst = maxval(self%solution%row_weight(:n)*abs(self%rows%phi(:n)))
      end associate
   end function linkage_max_violation

end module linkage
