!> Bearing of finite length, from Reynolds' equation on a grid: the judge of the other films, and the one with grooves.
!>
!> F = mu L R^3/c^2 f(e/c, v/c; L/D),   v = e' - (w_J + w_B)/2 z x e,   f: `reynolds_grid`
!>
!> Pressures are not below zero, with dp/dn = 0 where the film ruptures and forms again (`boundary = reynolds`), or of any sign
!> (`full`). Lubricant comes in from the ends without pressure, and from supplies: along the line of the widest gap, or at equal
!> distances around the bearing, fixed in it, as grooves (length 1) or holes (length and width the same way along the surface); with
!> `both` the line has no pressure and the fixed ones have that of the row. Published tables of grooved bearings mean `both`.
!>
!> A tilted journal has rows over the whole length, see `reynolds_grid`.
!>
!> Signs: on the journal; angles in the frame of the bearing's body. Beyond eps_max, at either end, the film has the shape that it
!> has with e and tilt made smaller in proportion, and v as it is. Source: Reynolds (1886). Limits: any L/D; some hundred times as
!> dear as `finite`.
!>
!> Grids are made when the film is fitted to a bearing, one for each L/D (with tilt, when it is first asked for), and stay as long
!> as the program: all films with the same supplies, resolution and boundary share them, each solution starts with the wet cells of
!> the one before and does not depend on it.
module film_grid
   use film_law, only: basic_parameters, film_bearing_t, film_law_t, film_motion_t, max_eccentricity, n_film_parameter, &
      own_parameters, parameter_clearance, parameter_eps_max, parameter_length, parameter_radius, parameter_viscosity
   use item, only: item_t
   use kind_info, only: add_number, add_word, dim_angle, dim_none, dim_pressure, kind_info_t
   use kinds, only: not_a_number, two_pi, wp
   use reynolds_field, only: film_field
   use reynolds_grid, only: boundary_full, boundary_reynolds, journal_state_t, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   use reynolds_results, only: film_result_t, get_result
   use text, only: to_text
   implicit none (type, external)
   private
   public :: film_grid_t

   integer, parameter :: parameter_scale = own_parameters + 1     !! mu L R^3/c^2 [N.s]
   integer, parameter :: parameter_ratio = own_parameters + 2     !! L/D [1]
   integer, parameter :: parameter_pressure = own_parameters + 3  !! P of the supplies [1/s]
   integer, parameter :: columns_of(3) = [80, 160, 240]           !! of the words of `resolution`
   integer, parameter :: rows_of(3) = [10, 16, 24]                !! rows of the half length
   real(wp), parameter :: same_ratio = 1.0e-12_wp                 !! difference of L/D that is none [1]

   !> Grids that films share, and what these films are like.
   type :: grid_pool_t
      type(supply_t), allocatable :: supply(:)       !! where lubricant comes in, pressures in Pa
      integer :: resolution = 2                      !! coarse, normal, fine
      integer :: boundary = boundary_reynolds        !! where pressures end
      type(grid_pool_t), pointer :: next => null()   !! the pool made before
      type(reynolds_grid_t), allocatable :: grid(:)  !! the grids
      real(wp), allocatable :: pressure(:)           !! (grids) P of the supplies in the last solution; huge: there is none [1/s]
   end type grid_pool_t

   type(grid_pool_t), pointer :: last_pool => null()  !! of all that were made: films come and go, and copies of them

   !> A bearing of finite length.
   type, extends(film_law_t) :: film_grid_t
      type(grid_pool_t), pointer :: pool => null()  !! grids, one for each L/D
      type(supply_t), allocatable :: supply(:)      !! where lubricant comes in, pressures in Pa
      integer :: resolution = 2                     !! coarse, normal, fine
      integer :: boundary = boundary_reynolds       !! where pressures end
   contains
      procedure, nopass :: info => grid_info
      procedure :: prepare => grid_prepare
      procedure :: fit => grid_fit
      procedure :: force => grid_force
      procedure :: tilted_force => grid_tilted_force
      procedure :: side_flow => grid_side_flow
      procedure, nopass :: has_field => grid_has
      procedure, nopass :: knows_tilt => grid_has
      procedure :: field => grid_field
      procedure :: mistake => grid_mistake
      procedure :: description => grid_description
   end type film_grid_t

contains

   !> Description of the kind.
   function grid_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.grid"
      info%help = "bearing of any length with grooves or holes: Reynolds' equation on a grid; accurate to 0.1 %, slow"
      info%source = "Reynolds (1886)"
      call add_word(info, "boundary", "pressure condition: non-negative pressure (reynolds), or both signs (full)", &
         default="reynolds", choices="reynolds full")
      call add_word(info, "resolution", "80 x 10, 160 x 16 or 240 x 24 cells on half the length", default="normal", &
                    choices="coarse normal fine")
      call add_word(info, "supply", "supply besides the ends: at the widest gap, fixed in the bearing, or both", &
                    default="none", choices="none widest_gap fixed both")
      call add_number(info, "number", dim_none, "number of fixed supplies, equally spaced", default="1", lower=1.0_wp, &
                      upper=12.0_wp)
      call add_number(info, "angle", dim_angle, "angle of the first supply, from x of the bearing body, in space from x_i of "// &
         "the bushing", &
                      default="0 deg")
      call add_number(info, "width", dim_angle, "circumferential width of a supply; 0: a line", default="0 deg", lower=0.0_wp, &
                      upper=two_pi, open_upper=.true.)
      call add_number(info, "length", dim_none, "axial length of a supply over that of the bearing; 1: from end to end", &
         default="1", &
                      lower=0.0_wp, upper=1.0_wp, open_lower=.true.)
      call add_number(info, "pressure", dim_pressure, "supply pressure above that at the ends", default="0 Pa", lower=0.0_wp)
   end function grid_info

   !> Take the columns.
   subroutine grid_prepare(self, item)
      class(film_grid_t), intent(inout) :: self  !! the film
      type(item_t), intent(in) :: item           !! the row

      integer :: k, n

      self%name = item%name
      self%boundary = merge(boundary_full, boundary_reynolds, item%word("boundary") == "full")
      self%resolution = findloc(["coarse", "normal", "fine  "] == item%word("resolution"), .true., dim=1)
      select case (item%word("supply"))
      case ("widest_gap")
         self%supply = [supply_t(pressure=item%number("pressure"), is_at_widest_gap=.true.)]
      case ("fixed", "both")
         n = nint(item%number("number"))
         self%supply = [(supply_t(angle=item%number("angle") + two_pi*(k - 1)/n, width=item%number("width"), &
                                  length=item%number("length"), pressure=item%number("pressure")), k=1, n)]
         if (item%word("supply") == "both") self%supply = [self%supply, supply_t(is_at_widest_gap=.true.)]
      case default
         allocate (self%supply(0))
      end select
      call find_pool(self)
   end subroutine grid_prepare

   !> The pool of films like this one; it is made if it is not there.
   subroutine find_pool(self)
      class(film_grid_t), intent(inout) :: self  !! the film; its pool is set

      self%pool => last_pool
      do while (associated(self%pool))
         associate (pool => self%pool)
            if (pool%resolution == self%resolution .and. pool%boundary == self%boundary &
                .and. size(pool%supply) == size(self%supply)) then
               if (all(are_equal(pool%supply, self%supply))) return
            end if
         end associate
         self%pool => self%pool%next
      end do
      allocate (self%pool)
      self%pool%supply = self%supply
      self%pool%resolution = self%resolution
      self%pool%boundary = self%boundary
      self%pool%next => last_pool
      allocate (self%pool%grid(0), self%pool%pressure(0))
      last_pool => self%pool
   end subroutine find_pool

   !> Whether two supplies are one and the same.
   elemental logical function are_equal(a, b)
      type(supply_t), intent(in) :: a  !! one
      type(supply_t), intent(in) :: b  !! the other

      are_equal = (a%is_at_widest_gap .eqv. b%is_at_widest_gap) .and. &
                  .not. any(abs([a%angle - b%angle, a%width - b%width, a%length - b%length, a%pressure - b%pressure]) > 0.0_wp)
   end function are_equal

   !> Supplies that leave no film between them.
   function grid_mistake(self) result(message)
      class(film_grid_t), intent(in) :: self  !! the film
      character(:), allocatable :: message    !! one line, empty: all is well

      message = ""
      if (sum(self%supply%width) > 0.9_wp*two_pi) message = to_text(size(self%supply)) &
                                                            //" supplies of this width leave no film: the maximum total is 324 deg"
   end function grid_mistake

   !> Parameters for a bearing, and its grid.
   subroutine grid_fit(self, bearing, parameters, message, help)
      class(film_grid_t), intent(in) :: self                 !! the film
      type(film_bearing_t), intent(in) :: bearing            !! the bearing
      real(wp), intent(out) :: parameters(n_film_parameter)  !! (n_film_parameter) parameters [any]
      character(:), allocatable, intent(out) :: message      !! empty: any bearing will do
      character(:), allocatable, intent(out) :: help         !! empty

      integer :: number

      message = ""
      help = ""
      call basic_parameters(bearing, parameters)
      parameters(parameter_scale) = bearing%viscosity*bearing%length*bearing%radius**3/bearing%clearance**2
      if (size(self%supply) > 0) parameters(parameter_pressure) = self%supply(1)%pressure*bearing%clearance**2 &
                                                                  /(bearing%viscosity*bearing%radius**2)
      parameters(parameter_ratio) = 0.5_wp*bearing%length/bearing%radius
      call find_grid(self, parameters(parameter_ratio), .false., number)
   end subroutine grid_fit

   !> Number of the grid of an L/D; it is made if it is not there.
   subroutine find_grid(self, ratio, is_tilted, number)
      class(film_grid_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: ratio           !! L/D [1]
      logical, intent(in) :: is_tilted        !! over the whole length
      integer, intent(out) :: number          !! of the grid

      type(reynolds_grid_t), allocatable :: grids(:)
      integer :: n

      n = size(self%pool%grid)
      do number = 1, n
         if (self%pool%grid(number)%is_whole .neqv. is_tilted) cycle
         if (abs(self%pool%grid(number)%ratio - ratio) <= same_ratio*ratio) return
      end do
      allocate (grids(n + 1))
      grids(:n) = self%pool%grid
      call new_reynolds_grid(grids(number), ratio, columns_of(self%resolution), rows_of(self%resolution), self%boundary, &
                             self%supply, is_tilted)
      call move_alloc(grids, self%pool%grid)
      self%pool%pressure = [self%pool%pressure, huge(1.0_wp)]
   end subroutine find_grid

   !> Forces of n bearings.
   subroutine grid_force(self, n, motion, parameters, f)
      class(film_grid_t), intent(in) :: self                   !! the film
      integer, intent(in) :: n                                 !! number of bearings
      type(film_motion_t), intent(in) :: motion(n)             !! (n) their motion
      real(wp), intent(in) :: parameters(n_film_parameter, n)  !! (n_film_parameter, n) from `fit` [any]
      real(wp), intent(out) :: f(2, n)                         !! (2, n) forces on the journals, world frame [N]

      real(wp) :: f_1(2)
      integer :: k

      do k = 1, n
         call grid_tilted_force(self, motion(k), parameters(:, k), f(:, k), f_1)
      end do
   end subroutine grid_force

   !> Force of one bearing, its journal tilted or not, and its first moment over half the length.
   subroutine grid_tilted_force(self, motion, parameters, f, f_1)
      class(film_grid_t), intent(in) :: self                !! the film
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(out) :: f(2)                         !! (2) force on the journal, frame of the motion [N]
      real(wp), intent(out) :: f_1(2)                       !! (2) its moment along the axis, over half the length [N]

      type(film_result_t) :: film
      integer :: number, status

      call solve_one(self, motion, parameters, number, status)
      call get_result(self%pool%grid(number), film)
      associate (cosine => cos(motion%angle), sine => sin(motion%angle), scale => parameters(parameter_scale))
         f = scale*[cosine*film%f(1) - sine*film%f(2), sine*film%f(1) + cosine*film%f(2)]
         f_1 = scale*[cosine*film%f_1(1) - sine*film%f_1(2), sine*film%f_1(1) + cosine*film%f_1(2)]
      end associate
   end subroutine grid_tilted_force

   !> What leaves at the ends less what comes in there: c R^3/(3 L) times that of the grid; none of a full film.
   function grid_side_flow(self, motion, parameters) result(flow)
      class(film_grid_t), intent(in) :: self                   !! the film
      type(film_motion_t), intent(in) :: motion                !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)     !! (n_film_parameter) from `fit` [any]
      real(wp) :: flow                                         !! volume in a time [m^3/s]

      type(film_result_t) :: film
      integer :: number, status

      call solve_one(self, motion, parameters, number, status)
      call get_result(self%pool%grid(number), film)
      flow = film%side_flow*parameters(parameter_clearance)*parameters(parameter_radius)**3/(3.0_wp*parameters(parameter_length))
   end function grid_side_flow

   !> Solve the film of one bearing; the last solution is taken if it is that of the same motion. Should the pressures not be found,
   !> those of the last step stay.
   subroutine solve_one(self, motion, parameters, number, status)
      class(film_grid_t), intent(in) :: self                !! the film
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      integer, intent(out) :: number                        !! of the grid that has the solution
      integer, intent(out) :: status                        !! 0: done

      type(journal_state_t) :: state

      status = 0
      state = state_of(motion, parameters)
      call find_grid(self, parameters(parameter_ratio), any(abs([state%g, state%w]) > 0.0_wp), number)
      associate (grid => self%pool%grid(number), solved => self%pool%pressure(number), pressure => parameters(parameter_pressure))
         if (.not. abs(solved - pressure) > 0.0_wp) then
            if (.not. any(abs([grid%state%e - state%e, grid%state%v - state%v, grid%state%g - state%g, grid%state%w - state%w]) &
                          > 0.0_wp)) return
         end if
         grid%supply%pressure = pressure
         if (size(grid%supply) > 1) where (grid%supply%is_at_widest_gap) grid%supply%pressure = 0.0_wp
         call grid%solve(state, status)
         solved = merge(pressure, huge(1.0_wp), status == 0)
      end associate
   end subroutine solve_one

   !> It has pressures, at any tilt.
   pure logical function grid_has() result(has)
      has = .true.
   end function grid_has

   !> Pressures and gaps of one bearing; no numbers should the pressures not be found.
   subroutine grid_field(self, motion, parameters, theta, y, p, h)
      class(film_grid_t), intent(in) :: self                !! the film
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: theta(:)                      !! (n) angles, frame of the bearing's body [rad]
      real(wp), intent(in) :: y(:)                          !! (m) places along the axis, from -1 at one end to 1 at the other [1]
      real(wp), intent(out) :: p(:, :)                      !! (m, n) pressures [Pa]
      real(wp), intent(out) :: h(:, :)                      !! (m, n) gaps [m]

      integer :: number, status

      call solve_one(self, motion, parameters, number, status)
      call film_field(self%pool%grid(number), theta, y, p, h)
      p = p*parameters(parameter_viscosity)*(parameters(parameter_radius)/parameters(parameter_clearance))**2
      if (status /= 0) p = not_a_number()
      h = h*parameters(parameter_clearance)
   end subroutine grid_field

   !> The motion in the frame of the bearing's body and parts of the clearance, the journal within eps_max at both ends.
   pure function state_of(motion, parameters) result(state)
      type(film_motion_t), intent(in) :: motion             !! the motion
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      type(journal_state_t) :: state                        !! the state

      real(wp) :: half_speed, longest, part, reach

      half_speed = 0.5_wp*motion%speed_sum
      associate (c => parameters(parameter_clearance), g => motion%tilt, e => motion%e)
         part = 1.0_wp/c
         longest = parameters(parameter_eps_max)*c
         reach = max_eccentricity(motion)
         if (reach > longest) part = part*longest/reach
         state%e = turned(part*e)
         state%g = turned(part*g)
         state%v = turned([motion%e_dot(1) + half_speed*e(2), motion%e_dot(2) - half_speed*e(1)]/c)
         state%w = turned([motion%tilt_dot(1) + half_speed*g(2), motion%tilt_dot(2) - half_speed*g(1)]/c)
      end associate

   contains

      !> A vector in the frame of the bearing's body.
      pure function turned(x) result(y)
         real(wp), intent(in) :: x(2)  !! (2) the vector, frame of the motion [any]
         real(wp) :: y(2)              !! (2) frame of the body [any]

         y = [cos(motion%angle)*x(1) + sin(motion%angle)*x(2), cos(motion%angle)*x(2) - sin(motion%angle)*x(1)]
      end function turned

   end function state_of

   !> The grid of a bearing.
   function grid_description(self, parameters) result(words)
      class(film_grid_t), intent(in) :: self                !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      character(:), allocatable :: words                    !! as "160 x 16 cells"

      words = to_text(columns_of(self%resolution))//" x "//to_text(rows_of(self%resolution))//" cells"
      if (size(self%supply) > 0) words = words//", supplied at "//to_text(self%supply(1)%pressure)//" Pa"
   end function grid_description

end module film_grid
