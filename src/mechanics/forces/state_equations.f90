!> State equations of a deck: its own differential, difference and algebraic equations, whose values drive loads.
!>
!> $$ \dot x = f(t, q, \dot q, x, s, w), \qquad s_{k+1} = g(t_k, q, \dot q, x, s_k, w), \qquad w = h(t, q, \dot q, x, s, w) $$
!>
!> x are continuous states, s sampled ones, w algebraic variables. Samples are taken at t_k = k T, k = 0, 1, ...: all sampled states
!> that are due change at once, from the values before; between samples they are held. Algebraic variables stand in an order in
!> which each follows those that it reads; `read_states` refuses a loop.
!>
!> Signs: those of the deck. Source: Franklin, Powell and Workman, Digital Control of Dynamic Systems (1998), chapters 2 and 4.
!> Limits: the functions see time, positions, velocities and one another, no accelerations and no forces.
module state_equations
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use errors, only: error_t, exit_usage, set_error
   use expression, only: expression_t
   use item, only: location_t
   use kind_info, only: add_any_number, add_channel, add_formula, add_number, add_word, dim_none, dim_t, dim_time, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use observed_motion, only: value_of
   implicit none (type, external)
   private
   public :: algebraic, continuous, refuse_sampled, sampled, state_equations_t, state_info, state_prefix, state_row_t

   character(*), parameter :: state_prefix = "state."   !! of the channels that they are

   ! what a row is
   integer, parameter :: continuous = 1   !! a differential equation
   integer, parameter :: sampled = 2      !! a difference equation
   integer, parameter :: algebraic = 3    !! a variable

   real(wp), parameter :: same_time = 64.0_wp*epsilon(1.0_wp)   !! difference of times that is round-off, of the time [1]

   !> One row.
   type :: state_row_t
      character(:), allocatable :: name      !! of the row
      character(:), allocatable :: unit      !! SI unit of its value
      type(dim_t) :: dimension = dim_none    !! of its value
      integer :: sort = continuous           !! one of the above
      type(expression_t) :: expression       !! rate, next value, or value [any]
      type(location_t) :: location           !! of the expression in the deck
      real(wp) :: start = 0.0_wp             !! value at t = 0; of a sampled one that before its first sample [any]
      real(wp) :: scale = 1.0_wp             !! magnitude below which errors are absolute [any]
      real(wp) :: every = 0.0_wp             !! sampling period T [s]
   end type state_row_t

   !> All rows of a deck.
   type :: state_equations_t
      integer :: n = 0                                !! rows
      integer :: n_state = 0                          !! those that have an entry in the state of the system
      integer :: n_sampled = 0                        !! those that are sampled
      type(state_row_t), allocatable :: rows(:)       !! (n) rows in the order of the deck
      integer, allocatable :: integrated(:)           !! (n_state) rows with an entry in the state
      integer, allocatable :: order(:)                !! (n - n_state) algebraic variables, each after those that it reads
   contains
      procedure :: begin => states_begin
      procedure :: take => states_take
      procedure :: work_out => states_work_out
      procedure :: rates => states_rates
      procedure :: weights => states_weights
      procedure :: sample => states_sample
      procedure :: info => states_info
   end type state_equations_t

contains

   !> The deck table.
   function state_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "state"
      info%help = "state equations: differential, difference and algebraic equations over channels, states and time, whose "// &
                  "values state.NAME loads may use"
      info%source = "Franklin, Powell and Workman, Digital Control of Dynamic Systems (1998), chapters 2 and 4"
      call add_word(info, "unit", "unit of the value", default="1")
      call add_any_number(info, "start", "value at t = 0; of a sampled state before its first sample", default="0")
      call add_formula(info, "rate", "of a continuous state: its derivative by time, {(state.in - state.out)/tau}", default="")
      call add_formula(info, "next", "of a sampled state: its value after a sample, by the values before", default="")
      call add_formula(info, "value", "of an algebraic variable: its value, {max(-24 V, min(24 V, state.u))}", default="")
      call add_number(info, "every", dim_time, "sampling period of a sampled state: samples at 0, T, 2 T, ...", default="0 s", &
                      lower=0.0_wp)
      call add_any_number(info, "scale", "magnitude below which the error of the state is absolute: its error is at most "// &
                          "tolerance*max(|value|, scale); 0: |start|, or one unit where it starts at zero", default="0")
   end function state_info

   !> Channels of the rows: the value of each.
   function states_info(self) result(info)
      class(state_equations_t), intent(in) :: self   !! the equations
      type(kind_info_t) :: info                      !! channels

      character(*), parameter :: help(3) = [character(18) :: "continuous state", "sampled state", "algebraic variable"]
      integer :: k

      info%name = "state"
      info%is_table = .false.
      do k = 1, self%n
         associate (row => self%rows(k))
            call add_channel(info, row%name, row%unit, "none", 1, trim(help(row%sort))//" of the deck", k)
         end associate
      end do
   end function states_info

   !> Values at the start.
   pure subroutine states_begin(self, y)
      class(state_equations_t), intent(in) :: self   !! the equations
      real(wp), intent(out) :: y(:)                  !! (n_state) entries of the state [any]

      integer :: k

      do k = 1, self%n_state
         y(k) = self%rows(self%integrated(k))%start
      end do
   end subroutine states_begin

   !> Values of states into a motion. No allocation.
   pure subroutine states_take(self, y, motion)
      class(state_equations_t), intent(in) :: self   !! the equations
      real(wp), intent(in) :: y(:)                   !! (n_state) entries of the state [any]
      type(motion_t), intent(inout) :: motion        !! `states` is set, but for algebraic variables

      integer :: k

      do k = 1, self%n_state
         motion%states(self%integrated(k)) = y(k)
      end do
   end subroutine states_take

   !> Values of algebraic variables into a motion. No allocation.
   pure subroutine states_work_out(self, t, motion)
      class(state_equations_t), intent(in) :: self   !! the equations
      real(wp), intent(in) :: t                      !! time, in the smooth stretch [s]
      type(motion_t), intent(inout) :: motion        !! positions, velocities and states; algebraic variables are set

      integer :: k

      do k = 1, size(self%order)
         motion%states(self%order(k)) = value_of(self%rows(self%order(k))%expression, t, motion)
      end do
   end subroutine states_work_out

   !> Rates of the entries of the state; those of sampled ones are zero. No allocation.
   pure subroutine states_rates(self, t, motion, ydot)
      class(state_equations_t), intent(in) :: self   !! the equations
      real(wp), intent(in) :: t                      !! time, in the smooth stretch [s]
      type(motion_t), intent(in) :: motion           !! positions, velocities and values of the rows
      real(wp), intent(out) :: ydot(:)               !! (n_state) rates [any]

      integer :: k

      do k = 1, self%n_state
         associate (row => self%rows(self%integrated(k)))
            ydot(k) = 0.0_wp
            if (row%sort == continuous) ydot(k) = value_of(row%expression, t, motion)
         end associate
      end do
   end subroutine states_rates

   !> Error scales of the entries of the state: max(|x|, scale).
   pure subroutine states_weights(self, y, scale)
      class(state_equations_t), intent(in) :: self   !! the equations
      real(wp), intent(in) :: y(:)                   !! (n_state) entries of the state [any]
      real(wp), intent(out) :: scale(:)              !! (n_state) scales [any]

      integer :: k

      do k = 1, self%n_state
         scale(k) = max(abs(y(k)), self%rows(self%integrated(k))%scale)
      end do
   end subroutine states_weights

   !> Take the samples that are due at an instant, all from the values before.
   pure subroutine states_sample(self, t, motion, y, bad)
      class(state_equations_t), intent(in) :: self   !! the equations
      real(wp), intent(in) :: t                      !! time of the instant [s]
      type(motion_t), intent(in) :: motion           !! positions, velocities and values of the rows before
      real(wp), intent(inout) :: y(:)                !! (n_state) entries of the state [any]
      integer, intent(out) :: bad                    !! a row whose sample is not finite; 0: none

      integer :: k

      bad = 0
      do k = 1, self%n_state
         associate (row => self%rows(self%integrated(k)))
            if (row%sort /= sampled) cycle
            if (abs(t - anint(t/row%every)*row%every) > same_time*abs(t)) cycle
            y(k) = value_of(row%expression, t, motion)
            if (.not. ieee_is_finite(y(k))) bad = self%integrated(k)
         end associate
      end do
   end subroutine states_sample

   !> Derivatives of a motion do not go across samples: refuse studies that need them.
   subroutine refuse_sampled(states, error)
      type(state_equations_t), intent(in) :: states        !! the equations of the deck
      type(error_t), allocatable, intent(out) :: error     !! some row is sampled

      integer :: k

      if (states%n_sampled == 0) return
      k = findloc(states%rows%sort, sampled, dim=1)
      call set_error(error, exit_usage, "this study needs derivatives of the motion, which sampled states do not have: '"// &
                     state_prefix//states%rows(k)%name//"' is sampled"//new_line("a")// &
                     "  = give it a rate instead of 'next' and 'every', or use gudgeon sweep")
   end subroutine refuse_sampled

end module state_equations
