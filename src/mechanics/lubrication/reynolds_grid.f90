!> Reynolds' equation of a journal bearing on a grid: the judge of the film models.
!>
!> In parts of the clearance c, of the radius R and of the half length L/2, with u = (cos theta, sin theta) the direction from the
!> bearing's centre and P = p c^2/(mu R^2):
!>
!> h = 1 - (e + y g).u,   d/dtheta(h^3 dP/dtheta) + (D/L)^2 d/dy(h^3 dP/dy) = -12 (v + y w).u,   P = 0 at y = -1, 1
!>
!> e is the journal's eccentricity in the middle of the length, y g what a tilt of the journal adds to it; v and y w are the
!> velocities e' - (w_J + w_B)/2 z x e of both. P >= 0 where the film ruptures and forms again with dP/dn = 0 (Reynolds'
!> condition, `complementarity`), or P of any sign (full film). Force on the journal, about its middle F = mu L R^3/c^2 f, f =
!> -(1/2) int P u, the integral over the whole film, and f_1 = -(1/2) int y P u, whose couple turns the tilt back.
!>
!> Finite volumes of second order: one pressure in a cell, conductances h^3 at its edges, sources and forces with the exact
!> integral of u over the cell. So, without supplies, f = -grad over v of P.A P/24, convex and homogeneous of degree 2: f.v <= 0
!> exactly, on every grid. The row at an end counts 5/6 of its width, as source and for the force: with equal rows a parabola over
!> the length has its exact mean then, and the error in the rows is a tenth of what it would be. Without tilt the half length is
!> enough. All is finite at e = 0 and v = 0; no allocation after set-up.
!>
!> A bore that is not round, fixed in the bearing's body, adds G(theta, y) to h. In the inertial frame it turns with w_B, so that
!> dh/dt has -w_B dG/dtheta, and the right-hand side gets 6 (w_J + w_B) dG/dtheta - 12 w_B dG/dtheta = 6 (w_J - w_B) dG/dtheta:
!> what turns as one body has no pressure, as without it. With the pressure on its slopes, f_G = (1/2) int P dG, the film takes
!> -f.v - (w_J - w_B) f_G/2, which is not negative, on every grid too (`bored_gap`).
!>
!> Source: Reynolds (1886); Patankar, Numerical heat
!> transfer and fluid flow (1980), chapter 4. Limits: isoviscous, no inertia, h < 1/1000 R and h > 0.
module reynolds_grid
   use bore_profile, only: bore_t
   use bored_gap, only: at_left, at_middle, at_right, bored_gap_t, new_bored_gap, with_edges
   use complementarity, only: complementarity_t, new_complementarity
   use kinds, only: wp
   use reynolds_mesh, only: divide_length, divide_ring, new_length, new_ring, section_list_t, supply_t
   implicit none (type, external)
   private
   public :: boundary_full, boundary_reynolds, drag, journal_state_t, new_reynolds_grid, reynolds_grid_t

   integer, parameter :: boundary_reynolds = 1  !! pressures are not below zero, rupture with dP/dn = 0
   integer, parameter :: boundary_full = 2      !! pressures of any sign
   real(wp), parameter :: drag = 12.0_wp        !! factor of the right-hand side [1]
   real(wp), parameter :: end_weight = 5.0_wp/6.0_wp  !! of the row at an end, see above [1]

   !> Where the journal is and how it moves, in the bearing's frame and parts of the clearance.
   type :: journal_state_t
      real(wp) :: e(2) = 0.0_wp  !! (2) eccentricity in the middle [1]
      real(wp) :: v(2) = 0.0_wp  !! (2) e' - (w_J + w_B)/2 z x e [1/s]
      real(wp) :: g(2) = 0.0_wp  !! (2) what the tilt adds to e at the end y = 1 [1]
      real(wp) :: w(2) = 0.0_wp  !! (2) g' - (w_J + w_B)/2 z x g [1/s]
      real(wp) :: spin = 0.0_wp  !! w_J - w_B, where the bore is not round [rad/s]
      real(wp) :: per_clearance = 0.0_wp  !! 1/c, where the bore is not round [1/m]
   end type journal_state_t

   !> A bearing, its grid and the film of the last solution.
   type :: reynolds_grid_t
      real(wp) :: ratio = 1.0_wp                !! L/D [1]
      logical :: is_whole = .false.             !! rows over the whole length, as a tilt needs
      type(supply_t), allocatable :: supply(:)  !! where lubricant comes in
      type(complementarity_t) :: film           !! pressures P of the cells, rows by columns
      real(wp), allocatable :: theta(:)         !! (0:n) edges of the columns, bearing's frame [rad]
      real(wp), allocatable :: y(:)             !! (0:m) edges of the rows, in half lengths from the middle [1]
      real(wp), allocatable :: weight(:)        !! (m) what the rows count in sources and forces, of the half length [1]
      type(journal_state_t) :: state               !! that of the solution
      type(bored_gap_t) :: bored                !! the bore, where it is not round
      type(section_list_t), private :: ring     !! sections of the ring
      type(section_list_t), private :: length   !! sections of the half length
      integer, allocatable :: column(:)         !! (n) supply that a column is in, 0: none
      integer, allocatable :: edge(:)           !! (n) supply that is a line before a column, 0: none
      integer, allocatable, private :: fixed_edge(:)  !! (n) the same of lines that do not move
   contains
      procedure :: solve
      procedure :: is_supplied
      procedure :: gap
      procedure :: source_at
   end type reynolds_grid_t

contains

   !> Make the grid: about n columns and m rows of the half length.
   subroutine new_reynolds_grid(self, ratio, n, m, boundary, supply, is_tilted, bore)
      type(reynolds_grid_t), intent(out) :: self  !! the grid
      real(wp), intent(in) :: ratio               !! L/D [1]
      integer, intent(in) :: n                    !! columns, about
      integer, intent(in) :: m                    !! rows of the half length, about
      integer, intent(in) :: boundary             !! boundary_reynolds or boundary_full
      type(supply_t), intent(in) :: supply(:)     !! where lubricant comes in, by angle, apart from one another
      logical, intent(in) :: is_tilted            !! g and w may be other than zero
      type(bore_t), intent(in), optional :: bore  !! not round, whose supplies are all fixed; absent: it is round

      integer :: done, k, n_column, n_row

      self%ratio = ratio
      self%is_whole = is_tilted
      self%supply = supply
      if (present(bore)) self%supply = with_edges(bore, supply)
      call new_ring(self%ring, n, self%supply)
      if (present(bore)) then
         call new_length(self%length, m, [self%supply%length, bore%dam_length])
      else
         call new_length(self%length, m, [supply%length])
      end if
      n_column = sum(self%ring%n_cell)
      n_row = sum(self%length%n_cell)*merge(2, 1, is_tilted)
      allocate (self%theta(0:n_column), self%y(0:n_row), self%weight(n_row), source=0.0_wp)
      allocate (self%column(n_column), self%edge(n_column), source=0)
      done = 0
      do k = 1, size(self%ring%n_cell)
         associate (n_cell => self%ring%n_cell(k))
            if (n_cell == 0) then
               self%edge(modulo(done, n_column) + 1) = self%ring%supply(k)
            else
               self%column(done + 1:done + n_cell) = self%ring%supply(k)
            end if
            done = done + n_cell
         end associate
      end do
      self%fixed_edge = self%edge
      call new_complementarity(self%film, n_row, n_column, boundary == boundary_full)
      if (present(bore)) call new_bored_gap(self%bored, bore, n_row, n_column)
   end subroutine new_reynolds_grid

   !> The film of a state.
   subroutine solve(self, state, status)
      class(reynolds_grid_t), intent(inout) :: self  !! the grid
      type(journal_state_t), intent(in) :: state        !! the journal's state
      integer, intent(out) :: status                 !! 0: done; 3: the surfaces touch; others: see `complementarity`

      real(wp) :: eps, gamma
      integer :: line, m

      status = 3
      self%state = state
      eps = max(norm2(state%e + state%g), norm2(state%e - state%g))
      if (.not. eps < 1.0_wp) return
      gamma = direction(state)
      call divide_ring(self%ring, eps, gamma, self%theta, line)
      self%edge = self%fixed_edge
      if (line > 0) self%edge(line) = self%ring%line
      m = ubound(self%y, 1)
      if (self%is_whole) then
         call divide_length(self%length, self%ratio, eps, self%y(m/2:))
         self%y(0:m/2) = -self%y(m:m/2:-1)
      else
         call divide_length(self%length, self%ratio, eps, self%y)
      end if
      self%weight = self%y(1:m) - self%y(0:m - 1)
      self%weight(m) = end_weight*self%weight(m)
      if (self%is_whole) self%weight(1) = end_weight*self%weight(1)
      if (self%bored%is_there) call self%bored%place(self%theta, self%y, state%per_clearance)
      call set_prescribed(self)
      call set_around(self)
      if (self%bored%is_there) call add_bore_source(self)
      call set_along(self)
      call self%film%solve(status)
   end subroutine solve

   !> Direction of the minimum film; of the motion where the journal is in the middle.
   pure real(wp) function direction(state)
      type(journal_state_t), intent(in) :: state  !! the journal's state

      direction = 0.0_wp
      if (norm2(state%e) > tiny(1.0_wp)) then
         direction = atan2(state%e(2), state%e(1))
      else if (norm2(state%v) > tiny(1.0_wp)) then
         direction = atan2(state%v(2), state%v(1))
      end if
   end function direction

   !> Whether a supply reaches over a row.
   pure logical function is_supplied(self, supply, j)
      class(reynolds_grid_t), intent(in) :: self  !! the grid
      integer, intent(in) :: supply               !! which, 0: none
      integer, intent(in) :: j                    !! the row

      is_supplied = .false.
      if (supply > 0) is_supplied = 0.5_wp*abs(self%y(j - 1) + self%y(j)) < self%supply(supply)%length
   end function is_supplied

   !> Sources of the bore.
   pure subroutine add_bore_source(self)
      class(reynolds_grid_t), intent(inout) :: self  !! the grid

      integer :: k

      do k = 1, self%film%n
         self%film%source(:, k) = self%film%source(:, k) - 0.5_wp*drag*self%state%spin*self%bored%rise(:, k)*self%weight
      end do
   end subroutine add_bore_source

   !> The gap in the middle of a column, at a place along the bearing in a row.
   pure real(wp) function gap(self, j, k, y)
      class(reynolds_grid_t), intent(in) :: self  !! the grid
      integer, intent(in) :: j, k                 !! row and column
      real(wp), intent(in) :: y                   !! the place [1]

      real(wp) :: middle

      middle = 0.5_wp*(self%theta(k) + self%theta(k - 1))
      gap = height(self%state, y, [cos(middle), sin(middle)])
      if (self%bored%is_there) gap = gap + self%bored%depth(j, k, at_middle)
   end function gap

   !> Source over the drag in the middle of a column, of an area, at a place along the bearing in a row.
   pure real(wp) function source_at(self, j, k, y)
      class(reynolds_grid_t), intent(in) :: self  !! the grid
      integer, intent(in) :: j, k                 !! row and column
      real(wp), intent(in) :: y                   !! the place [1]

      real(wp) :: middle

      middle = 0.5_wp*(self%theta(k) + self%theta(k - 1))
      source_at = dot_product(self%state%v + y*self%state%w, [cos(middle), sin(middle)])
      if (self%bored%is_there) source_at = source_at - 0.5_wp*self%state%spin*self%bored%rise(j, k) &
                                                      /(self%theta(k) - self%theta(k - 1))
   end function source_at

   !> Which cells lie in supplies, their pressures, and the sources of all.
   pure subroutine set_prescribed(self)
      class(reynolds_grid_t), intent(inout) :: self  !! the grid

      real(wp) :: u(2), y
      integer :: j, k

      associate (film => self%film)
         do k = 1, film%n
            u = integral_of_u(self%theta(k - 1), self%theta(k))
            do j = 1, film%m
               y = 0.5_wp*(self%y(j - 1) + self%y(j))
               film%source(j, k) = drag*dot_product(self%state%v + y*self%state%w, u)*self%weight(j)
               film%ground(j, k) = 0.0_wp
               film%is_known(j, k) = self%is_supplied(self%column(k), j)
               if (film%is_known(j, k)) film%p(j, k) = self%supply(self%column(k))%pressure
            end do
         end do
      end associate
   end subroutine set_prescribed

   !> Integral of u over a column.
   pure function integral_of_u(from, to) result(u)
      real(wp), intent(in) :: from, to  !! edges, bearing's frame [rad]
      real(wp) :: u(2)                  !! (2) the integral [1]

      u = 2.0_wp*sin(0.5_wp*(to - from))*[cos(0.5_wp*(from + to)), sin(0.5_wp*(from + to))]
   end function integral_of_u

   !> Conductances around the bearing, and what a bore drags through the edges.
   pure subroutine set_around(self)
      class(reynolds_grid_t), intent(inout) :: self  !! the grid

      real(wp) :: behind, given, here, there, u(2), wide, y
      integer :: j, k, next
      logical :: is_bored, is_given

      is_bored = self%bored%is_there
      associate (film => self%film, theta => self%theta)
         do k = 1, film%n
            next = modulo(k, film%n) + 1
            here = 0.5_wp*(theta(k) - theta(k - 1))
            there = 0.5_wp*(theta(next) - theta(next - 1))
            u = [cos(theta(k)), sin(theta(k))]
            do j = 1, film%m
               y = 0.5_wp*(self%y(j - 1) + self%y(j))
               wide = height(self%state, y, u)**3*(self%y(j) - self%y(j - 1))
               behind = wide
               if (is_bored) then
                  wide = cube_of_gap(self, j, k, at_right, y, u)*(self%y(j) - self%y(j - 1))
                  behind = cube_of_gap(self, j, next, at_left, y, u)*(self%y(j) - self%y(j - 1))
               end if
               film%around(j, k) = 0.0_wp
               is_given = .true.
               given = 0.0_wp
               if (self%is_supplied(self%edge(next), j)) then
                  given = self%supply(self%edge(next))%pressure
                  call feed(film, j, k, wide/here, given)
                  call feed(film, j, next, behind/there, given)
               else if (film%is_known(j, next)) then
                  given = film%p(j, next)
                  call feed(film, j, k, wide/here, given)
               else if (film%is_known(j, k)) then
                  given = film%p(j, k)
                  call feed(film, j, next, behind/there, given)
               else
                  film%around(j, k) = wide/(here + there)
                  if (is_bored) film%around(j, k) = in_series(wide, behind, here, there)
                  is_given = .false.
               end if
               if (is_bored) call self%bored%join(j, k, next, wide/here, behind/there, is_given, given)
            end do
         end do
      end associate
   end subroutine set_around

   !> h^3 of a cell, in the middle of its column or at an edge.
   pure real(wp) function cube_of_gap(self, j, k, at, y, u) result(wide)
      class(reynolds_grid_t), intent(in) :: self  !! the grid
      integer, intent(in) :: j, k                 !! row and column
      integer, intent(in) :: at                   !! at_left, at_middle or at_right
      real(wp), intent(in) :: y                   !! place along the bearing in the row [1]
      real(wp), intent(in) :: u(2)                !! (2) direction of the place around it [1]

      wide = height(self%state, y, u)
      if (self%bored%is_there) wide = wide + self%bored%depth(j, k, at)
      wide = wide**3
   end function cube_of_gap

   !> Conductance of two half cells, one behind the other.
   pure real(wp) function in_series(wide, behind, here, there)
      real(wp), intent(in) :: wide, behind        !! h^3 times the width of both [1]
      real(wp), intent(in) :: here, there         !! their lengths [1]

      in_series = wide*behind/(here*behind + there*wide)
   end function in_series

   !> Conductances along the bearing and to its ends.
   pure subroutine set_along(self)
      class(reynolds_grid_t), intent(inout) :: self  !! the grid

      real(wp) :: behind, here, middle, step, there, u(2), wide
      integer :: j, k
      logical :: is_bored

      is_bored = self%bored%is_there

      associate (film => self%film, theta => self%theta, y => self%y)
         do k = 1, film%n
            step = theta(k) - theta(k - 1)
            middle = 0.5_wp*(theta(k - 1) + theta(k))
            u = [cos(middle), sin(middle)]
            do j = 0, film%m
               if (j == 0 .and. .not. self%is_whole) cycle
               wide = height(self%state, y(j), u)**3*step/self%ratio**2
               behind = wide
               if (is_bored) then
                  wide = cube_of_gap(self, max(j, 1), k, at_middle, y(j), u)*step/self%ratio**2
                  behind = cube_of_gap(self, min(j + 1, film%m), k, at_middle, y(j), u)*step/self%ratio**2
               end if
               here = 0.5_wp*(y(max(j, 1)) - y(max(j, 1) - 1))
               there = 0.5_wp*(y(min(j + 1, film%m)) - y(min(j, film%m - 1)))
               if (j == film%m) then
                  call feed(film, j, k, wide/here, 0.0_wp)
               else if (j == 0) then
                  call feed(film, 1, k, behind/there, 0.0_wp)
               else
                  film%along(j, k) = 0.0_wp
                  if (film%is_known(j + 1, k)) then
                     call feed(film, j, k, wide/here, film%p(j + 1, k))
                  else if (film%is_known(j, k)) then
                     call feed(film, j + 1, k, behind/there, film%p(j, k))
                  else
                     film%along(j, k) = wide/(here + there)
                     if (is_bored) film%along(j, k) = in_series(wide, behind, here, there)
                  end if
               end if
            end do
         end do
      end associate
   end subroutine set_along

   !> The gap.
   pure real(wp) function height(state, y, u)
      type(journal_state_t), intent(in) :: state  !! the journal's state
      real(wp), intent(in) :: y                !! half lengths from the middle [1]
      real(wp), intent(in) :: u(2)             !! (2) direction from the centre, bearing's frame [1]

      height = 1.0_wp - (state%e(1) + y*state%g(1))*u(1) - (state%e(2) + y*state%g(2))*u(2)
   end function height

   !> A conductance between a cell and a given pressure.
   pure subroutine feed(film, j, k, conductance, pressure)
      type(complementarity_t), intent(inout) :: film  !! the film
      integer, intent(in) :: j, k                     !! row and column of the cell
      real(wp), intent(in) :: conductance             !! the conductance [1]
      real(wp), intent(in) :: pressure                !! the given pressure [1/s]

      film%ground(j, k) = film%ground(j, k) + conductance
      film%source(j, k) = film%source(j, k) + conductance*pressure
   end subroutine feed

end module reynolds_grid
