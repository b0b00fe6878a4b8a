!> Films beside Reynolds' equation on a grid: bearings, motions, and the error of a force.
module film_comparison
   use film_case, only: film_case_t, force_of, make_film_kind
   use film_grid_case, only: make_grid, result_of
   use film_law, only: film_bearing_t, film_motion_t
   use kinds, only: pi, wp
   use reynolds_grid, only: boundary_reynolds, journal_state_t, reynolds_grid_t
   use reynolds_results, only: film_result_t
   implicit none (type, external)
   private
   public :: column_names, error_row_t, grid_force, motion_names, ratios, row_of, steps_of_eps

   real(wp), parameter :: ratios(5) = [0.25_wp, 0.5_wp, 1.0_wp, 2.0_wp, 4.0_wp]           !! (5) L/D [1]
   real(wp), parameter :: steps_of_eps(5) = [0.2_wp, 0.5_wp, 0.8_wp, 0.95_wp, 0.99_wp]    !! (5) eccentricity ratios [1]
   character(*), parameter :: motion_names(4) = [character(8) :: "rotation", "approach", "parting", "spiral"]
   character(*), parameter :: column_names = "film,motion,length_over_diameter,eps,force_over_grid,angle_to_grid_deg,error_percent"
   real(wp), parameter :: speeds(2, 4) = reshape([0.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, -1.0_wp, 0.0_wp, -0.2_wp, 1.0_wp], [2, 4])
      !! (2, 4) eps' and w_J + w_B - 2 gamma' of the motions [1/s, rad/s]
   integer, parameter :: n_column = 240  !! columns of the grid
   integer, parameter :: n_row = 24      !! rows of the half length
   real(wp), parameter :: min_angle = 5.0e-4_wp  !! what is less is none in three digits [deg]

   !> A film beside the grid.
   type :: error_row_t
      real(wp) :: force = 0.0_wp  !! size of its force over that of the grid [1]
      real(wp) :: angle = 0.0_wp  !! from the force of the grid to its own [deg]
      real(wp) :: error = 0.0_wp  !! size of the difference over that of the grid's force [%]
   end type error_row_t

contains

   !> A bearing with mu L R^3/c^2 = 1 N.s and c = 1 m.
   pure function bearing_of(ratio) result(bearing)
      real(wp), intent(in) :: ratio    !! L/D [1]
      type(film_bearing_t) :: bearing  !! the bearing

      bearing = film_bearing_t(radius=1.0_wp, clearance=1.0_wp, length=2.0_wp*ratio, viscosity=0.5_wp/ratio, eps_max=0.9999_wp)
   end function bearing_of

   !> Force of the grid in a motion, e along x.
   function grid_force(ratio, eps, motion) result(f)
      real(wp), intent(in) :: ratio   !! L/D [1]
      real(wp), intent(in) :: eps     !! eccentricity ratio [1]
      integer, intent(in) :: motion   !! number of the motion
      real(wp) :: f(2)                !! (2) force over mu L R^3/c^2 [1/s]

      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      type(journal_state_t) :: state

      call make_grid(grid, ratio, n_column, n_row, boundary_reynolds)
      state%e = [eps, 0.0_wp]
      state%v = [speeds(1, motion), -0.5_wp*eps*speeds(2, motion)]
      film = result_of(grid, state)
      f = film%f
   end function grid_force

   !> A film beside the force of the grid.
   subroutine row_of(kind, ratio, eps, motion, f, name, row)
      integer, intent(in) :: kind                    !! number of the film
      real(wp), intent(in) :: ratio                  !! L/D [1]
      real(wp), intent(in) :: eps                    !! eccentricity ratio [1]
      integer, intent(in) :: motion                  !! number of the motion
      real(wp), intent(in) :: f(2)                   !! (2) `grid_force` of the same [1/s]
      character(:), allocatable, intent(out) :: name !! of the film
      type(error_row_t), intent(out) :: row          !! its errors

      type(film_case_t) :: case
      type(film_motion_t) :: moving
      real(wp) :: own(2)

      call make_film_kind(kind, bearing_of(ratio), case)
      moving%e = [eps, 0.0_wp]
      moving%e_dot = [speeds(1, motion), 0.0_wp]
      moving%speed_sum = speeds(2, motion)
      own = force_of(case, moving)
      name = case%name
      row%force = norm2(own)/norm2(f)
      row%angle = atan2(f(1)*own(2) - f(2)*own(1), dot_product(f, own))*180.0_wp/pi
      if (abs(row%angle) < min_angle) row%angle = 0.0_wp
      row%error = 100.0_wp*norm2(own - f)/norm2(f)
   end subroutine row_of

end module film_comparison
