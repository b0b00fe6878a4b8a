!> Films on a grid, as tests ask for them.
module film_grid_case
   use kinds, only: pi, wp
   use reynolds_grid, only: journal_state_t, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   use reynolds_results, only: film_result_t, get_result
   implicit none (type, external)
   private
   public :: at_widest_gap, make_grid, result_of, steady, two_grooves

contains

   !> A grid without supplies and tilt.
   subroutine make_grid(grid, ratio, n, m, boundary)
      type(reynolds_grid_t), intent(out) :: grid  !! the grid
      real(wp), intent(in) :: ratio               !! L/D [1]
      integer, intent(in) :: n, m                 !! columns and rows
      integer, intent(in) :: boundary             !! which boundary condition

      type(supply_t) :: none(0)

      call new_reynolds_grid(grid, ratio, n, m, boundary, none, .false.)
   end subroutine make_grid

   !> p = 0 along the line of the widest gap.
   pure function at_widest_gap() result(supply)
      type(supply_t) :: supply(1)  !! the line

      supply(1)%is_at_widest_gap = .true.
   end function at_widest_gap

   !> Grooves of 20 degrees at both sides of x.
   pure function two_grooves() result(supply)
      type(supply_t) :: supply(2)  !! the grooves

      supply%angle = [-0.5_wp*pi, 0.5_wp*pi]
      supply%width = pi/9.0_wp
   end function two_grooves

   !> A state without tilt whose centre is at rest, w_J + w_B = 1.
   pure function steady(e) result(state)
      real(wp), intent(in) :: e(2)  !! (2) eccentricity [1]
      type(journal_state_t) :: state   !! the state

      state%e = e
      state%v = -0.5_wp*[-e(2), e(1)]
   end function steady

   !> What the film does in a state; the status must be 0.
   function result_of(grid, state) result(result)
      type(reynolds_grid_t), intent(inout) :: grid  !! the grid
      type(journal_state_t), intent(in) :: state       !! the state
      type(film_result_t) :: result                 !! forces and flows

      integer :: status

      call grid%solve(state, status)
      if (status /= 0) error stop "a film has no solution"
      call get_result(grid, result)
   end function result_of

end module film_grid_case
