!> Bearing of finite length, from Reynolds' equation on a grid: the judge of the other films, and the one with grooves.
!>
!> F = mu L R^3/c^2 f(e/c, v/c; L/D),   v = e' - (w_J + w_B)/2 z x e,   f: `reynolds_grid`
!>
!> Pressures are not below zero, with dp/dn = 0 where the film ruptures and forms again (`boundary = reynolds`), or of any sign
!> (`full`). Lubricant comes in from the ends without pressure, and from supplies: along the line of the widest gap, or at equal
!> distances around the bearing, fixed in it, as grooves (length 1) or holes (length and width the same way along the surface); with
!> `both` the line has no pressure and the fixed ones have that of the row. Published tables of grooved bearings mean `both`.
!>
!> A tilted journal has rows over the whole length, see `reynolds_grid`. A bore that is not round: `bore_profile`; the pressure on
!> its slopes gives moments too, with Gamma = mu L R^3/c f_G of `reynolds_results` and J of the whole gap,
!>
!> T_J, T_B = -+ mu L R^3/c (w_J - w_B) J - (e x F)_z/2 +- Gamma/2
!>
!> Signs: on the journal; angles in the frame of the bearing's body. Beyond eps_max, at either end, the film has the shape that it
!> has with e and tilt made smaller in proportion, and v as it is. Source: Reynolds (1886). Limits: any L/D; some hundred times as
!> dear as `finite`.
!>
!> Grids are made when the film is fitted to a bearing, one for each L/D, and shared, see `reynolds_pool`.
module film_grid
   use bore_profile, only: add_bore_columns, bore_mistake, bore_words, new_bore
   use film_law, only: basic_parameters, film_bearing_t, film_law_t, film_motion_t, max_eccentricity, n_film_parameter, &
      film_torques, own_parameters, parameter_clearance, parameter_eps_max, parameter_length, parameter_radius, parameter_viscosity
   use item, only: item_t
   use kind_info, only: add_number, add_word, dim_angle, dim_none, dim_pressure, kind_info_t
   use kinds, only: not_a_number, two_pi, wp
   use reynolds_field, only: film_field
   use reynolds_grid, only: boundary_full, boundary_reynolds, journal_state_t
   use reynolds_mesh, only: supply_t
   use reynolds_pool, only: columns_of, find_grid, find_pool, grid_form_t, grid_pool_t, rows_of
   use reynolds_results, only: film_result_t, get_result
   use text, only: to_text
   implicit none (type, external)
   private
   public :: film_grid_t

   integer, parameter :: parameter_scale = own_parameters + 1     !! mu L R^3/c^2 [N.s]
   integer, parameter :: parameter_ratio = own_parameters + 2     !! L/D [1]
   integer, parameter :: parameter_pressure = own_parameters + 3  !! P of the supplies [1/s]

   !> A bearing of finite length.
   type, extends(film_law_t) :: film_grid_t
      type(grid_pool_t), pointer :: pool => null()  !! grids, one for each L/D
      type(grid_form_t) :: form                     !! what they are like
      character(:), allocatable :: bad_bore         !! what is wrong with it, empty: nothing
   contains
      procedure, nopass :: info => grid_info
      procedure :: prepare => grid_prepare
      procedure :: fit => grid_fit
      procedure :: force => grid_force
      procedure :: tilted_force => grid_tilted_force
      procedure :: torques => grid_torques
      procedure :: has_bore => grid_has_bore
      procedure :: min_thickness => grid_min_thickness
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
      call add_bore_columns(info)
   end function grid_info

   !> Take the columns.
   subroutine grid_prepare(self, item)
      class(film_grid_t), intent(inout) :: self  !! the film
      type(item_t), intent(in) :: item           !! the row

      integer :: k, n

      self%name = item%name
      self%form%boundary = merge(boundary_full, boundary_reynolds, item%word("boundary") == "full")
      self%form%resolution = findloc(["coarse", "normal", "fine  "] == item%word("resolution"), .true., dim=1)
      select case (item%word("supply"))
      case ("widest_gap")
         self%form%supply = [supply_t(pressure=item%number("pressure"), is_at_widest_gap=.true.)]
      case ("fixed", "both")
         n = nint(item%number("number"))
         self%form%supply = [(supply_t(angle=item%number("angle") + two_pi*(k - 1)/n, width=item%number("width"), &
                                  length=item%number("length"), pressure=item%number("pressure")), k=1, n)]
         if (item%word("supply") == "both") self%form%supply = [self%form%supply, supply_t(is_at_widest_gap=.true.)]
      case default
         allocate (self%form%supply(0))
      end select
      self%bad_bore = bore_mistake(item)
      if (self%bad_bore == "") call new_bore(item, self%form%bore)
      if (self%has_bore() .and. any(self%form%supply%is_at_widest_gap)) then
         self%bad_bore = "a supply along the widest gap is that of a round bore: use supply = none or fixed"
      end if
      call find_pool(self%form, self%pool)
   end subroutine grid_prepare

   !> Supplies that leave no film between them.
   function grid_mistake(self) result(message)
      class(film_grid_t), intent(in) :: self  !! the film
      character(:), allocatable :: message    !! one line, empty: all is well

      message = self%bad_bore
      if (sum(self%form%supply%width) > 0.9_wp*two_pi) message = to_text(size(self%form%supply)) &
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
      if (size(self%form%supply) > 0) parameters(parameter_pressure) = self%form%supply(1)%pressure*bearing%clearance**2 &
                                                                       /(bearing%viscosity*bearing%radius**2)
      parameters(parameter_ratio) = 0.5_wp*bearing%length/bearing%radius
      call find_grid(self%pool, parameters(parameter_ratio), .false., number)
   end subroutine grid_fit

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
      if (self%has_bore()) then
         state%spin = motion%speed_difference
         state%per_clearance = 1.0_wp/parameters(parameter_clearance)
      end if
      call find_grid(self%pool, parameters(parameter_ratio), any(abs([state%g, state%w]) > 0.0_wp), number)
      associate (grid => self%pool%grid(number), solved => self%pool%pressure(number), pressure => parameters(parameter_pressure))
         if (.not. abs(solved - pressure) > 0.0_wp) then
            if (.not. any(abs([grid%state%e - state%e, grid%state%v - state%v, grid%state%g - state%g, grid%state%w - state%w, &
                            grid%state%spin - state%spin, grid%state%per_clearance - state%per_clearance]) > 0.0_wp)) return
         end if
         grid%supply%pressure = pressure
         if (size(grid%supply) > 1) where (grid%supply%is_at_widest_gap) grid%supply%pressure = 0.0_wp
         call grid%solve(state, status)
         solved = merge(pressure, huge(1.0_wp), status == 0)
      end associate
   end subroutine solve_one

   !> Moments of the shear; of a bore that is not round with the pressure on its slopes.
   subroutine grid_torques(self, motion, parameters, f, t_j, t_b)
      class(film_grid_t), intent(in) :: self                !! the film
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: f(2)                          !! (2) force on the journal, world frame [N]
      real(wp), intent(out) :: t_j                          !! moment on the journal [N.m]
      real(wp), intent(out) :: t_b                          !! moment on the bearing [N.m]

      type(film_result_t) :: film
      real(wp) :: half, slip
      integer :: number, status

      if (.not. self%has_bore()) then
         call film_torques(self, motion, parameters, f, t_j, t_b)
         return
      end if
      call solve_one(self, motion, parameters, number, status)
      call get_result(self%pool%grid(number), film)
      half = 0.5_wp*(motion%e(1)*f(2) - motion%e(2)*f(1))
      slip = parameters(parameter_scale)*parameters(parameter_clearance) &
             *(motion%speed_difference*film%shear_all - 0.5_wp*film%f_bore)
      t_j = -slip - half
      t_b = slip - half
   end subroutine grid_torques

   !> Whether its bore is not round.
   pure logical function grid_has_bore(self)
      class(film_grid_t), intent(in) :: self  !! the film

      grid_has_bore = .not. self%form%bore%is_round()
   end function grid_has_bore

   !> Minimum thickness, of a bore that is not round that of its gap.
   pure real(wp) function grid_min_thickness(self, clearance, motion, parameters) result(thickness)
      class(film_grid_t), intent(in) :: self                !! the film
      real(wp), intent(in) :: clearance                     !! of the surfaces [m]
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]

      type(journal_state_t) :: state

      if (self%has_bore()) then
         state = state_of(motion, parameters)
         thickness = max(clearance*self%form%bore%min_gap(state%e, 1.0_wp/parameters(parameter_clearance)), 0.0_wp)
      else
         thickness = max(clearance - max_eccentricity(motion), 0.0_wp)
      end if
   end function grid_min_thickness

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

      words = to_text(columns_of(self%form%resolution))//" x "//to_text(rows_of(self%form%resolution))//" cells"
      if (size(self%form%supply) > 0) words = words//", supplied at "//to_text(self%form%supply(1)%pressure)//" Pa"
      words = words//bore_words(self%form%bore)
   end function grid_description

end module film_grid
