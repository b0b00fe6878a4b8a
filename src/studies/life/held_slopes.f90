!> Derivatives of the rates under held loads (`held_loads`) by the volumes of the cells, as products with a vector.
!>
!> A node overlaps by d at points of the width w in the directions u. If the surfaces get deeper by dh there, its pin moves by de so
!> that the force f of the node stays:
!>
!> (H + b/M m m^T) de = int 2 u dh + b/M m int 2 d dh,   H = int 2 u u^T,  m = int 2 d u,  M = int d^2,  b = (p - 3/2)/(5/2)
!>
!> with the exponent p of the normal law. The overlap changes by  dd = u . de - dh,  and the rate of a cell by
!>
!> dv = V/D (int_cell dd - int_cell d int dd/D),   D = int d,  V the volume that the node takes per cycle
!>
!> A cell that loses the volume dV gets deeper by dh = dV/(L w_cell (R + h)), of a pin R - h. A product costs a few operations a
!> point; nothing is factorised.
!> Signs: int_cell dd falls with the depth of the cell, so that no eigenvalue is positive.
!> Source: this program.
!> Limits: M_round ~ delta^(5/2); what edges of the overlap, defects and slopes of profiles change is left out, so that iterations
!> with these derivatives converge linearly, at a small rate.
module held_slopes
   use kinds, only: pi, wp
   use krylov_solver, only: product_t
   use life_state, only: life_state_t
   use overlap_sums, only: arc_t
   implicit none (type, external)
   private
   public :: depth_by_volume, implicit_t, slopes_t

   real(wp), parameter :: hertz = 1.5_wp, moment = 2.5_wp   !! exponents of a linear foundation: of its force, of M [1]

   !> A node where it overlaps.
   type :: node_slope_t
      integer :: first = 0, last = -1       !! its points
      real(wp) :: volume(2) = 0.0_wp        !! (2) V of bearing and journal per cycle [m^3]
      real(wp) :: area = 0.0_wp             !! D [m.rad]
      real(wp) :: m(2) = 0.0_wp             !! (2) m [m.rad]
      real(wp) :: stiffer = 0.0_wp          !! b/M [1/(m^2.rad)]
      real(wp) :: inverse(2, 2) = 0.0_wp    !! (2, 2) of the matrix of de [1/rad]
   end type node_slope_t

   !> All nodes of a profile.
   type :: slopes_t
      integer :: n = 0                             !! nodes
      type(node_slope_t), allocatable :: nodes(:)  !! (n or more) the nodes
      integer, allocatable :: cell(:, :)           !! (2, points or more) numbers of the cells of hole and pin
      real(wp), allocatable :: point(:, :)         !! (4, points or more) u, w, d [1, rad, m]
   contains
      procedure :: clear
      procedure :: add => add_node
      procedure :: add_product
      procedure :: add_diagonal
   end type slopes_t

   !> The matrix  1 - h dv/dV,  scaled by its diagonal from the right: v = (1 - share) v_a + share v_b.
   type, extends(product_t) :: implicit_t
      type(slopes_t), pointer :: a => null(), b => null()   !! derivatives of v_a, and of v_b if share > 0
      real(wp) :: share = 0.0_wp                   !! of v_b [1]
      real(wp) :: h = 0.0_wp                       !! cycles [1]
      real(wp), allocatable :: by(:)               !! (n) depth of a cell by its volume, 0: of no cell [1/m^2]
      real(wp), allocatable :: diagonal(:)         !! (n) of the matrix [1]
   contains
      procedure :: prepare
      procedure :: apply => matrix_product
   end type implicit_t

contains

   !> Forget all nodes.
   pure subroutine clear(self)
      class(slopes_t), intent(inout) :: self   !! the nodes

      self%n = 0
      if (.not. allocated(self%nodes)) allocate (self%nodes(16), self%cell(2, 1024), self%point(4, 1024))
   end subroutine clear

   !> Add a node.
   pure subroutine add_node(self, arc, p, volume, before, cells)
      class(slopes_t), intent(inout) :: self   !! the nodes
      type(arc_t), intent(in) :: arc           !! points of its overlap
      real(wp), intent(in) :: p                !! exponent of the normal law [1]
      real(wp), intent(in) :: volume(2)        !! (2) that bearing and journal lose per cycle [m^3]
      integer, intent(in) :: before(2)         !! (2) numbers before the cells of bearing and journal
      integer, intent(in) :: cells(2)          !! (2) cells of these

      type(node_slope_t) :: node
      real(wp) :: matrix(2, 2), moment_2
      integer :: k

      if (self%n > 0) node%last = self%nodes(self%n)%last
      if (self%n == 0) node%last = 0
      node%first = node%last + 1
      node%last = node%last + arc%n
      call make_room(self, node%last)
      node%volume = volume
      matrix = 0.0_wp
      moment_2 = 0.0_wp
      do k = 1, arc%n
         associate (point => self%point(:, node%first + k - 1), cell => self%cell(:, node%first + k - 1))
            point = [cos(arc%hole(k)), sin(arc%hole(k)), arc%width(k), arc%d(k)]
            cell(1) = before(1) + cell_of(arc%hole(k), cells(1))
            cell(2) = before(2) + cell_of(arc%pin(k), cells(2))
            associate (u => point(:2), w => point(3), d => point(4))
               node%area = node%area + w*d
               node%m = node%m + 2.0_wp*w*d*u
               moment_2 = moment_2 + w*d**2
               matrix(1, 1) = matrix(1, 1) + 2.0_wp*w*u(1)**2
               matrix(2, 1) = matrix(2, 1) + 2.0_wp*w*u(1)*u(2)
               matrix(2, 2) = matrix(2, 2) + 2.0_wp*w*u(2)**2
            end associate
         end associate
      end do
      node%stiffer = (p - hertz)/(moment*moment_2)
      matrix(1, 2) = matrix(2, 1)
      do k = 1, 2
         matrix(:, k) = matrix(:, k) + node%stiffer*node%m*node%m(k)
      end do
      node%inverse = reshape([matrix(2, 2), -matrix(2, 1), -matrix(1, 2), matrix(1, 1)], [2, 2]) &
                     /(matrix(1, 1)*matrix(2, 2) - matrix(1, 2)*matrix(2, 1))
      self%n = self%n + 1
      self%nodes(self%n) = node
   end subroutine add_node

   !> Room for one more node and for some points.
   pure subroutine make_room(self, points)
      class(slopes_t), intent(inout) :: self   !! the nodes
      integer, intent(in) :: points            !! points of all nodes

      type(node_slope_t), allocatable :: nodes(:)
      integer, allocatable :: cell(:, :)
      real(wp), allocatable :: point(:, :)

      if (self%n == size(self%nodes)) then
         allocate (nodes(2*self%n))
         nodes(:self%n) = self%nodes
         call move_alloc(nodes, self%nodes)
      end if
      if (points <= size(self%cell, 2)) return
      allocate (cell(2, 2*points), point(4, 2*points))
      associate (n => size(self%cell, 2))
         cell(:, :n) = self%cell
         point(:, :n) = self%point
      end associate
      call move_alloc(cell, self%cell)
      call move_alloc(point, self%point)
   end subroutine make_room

   !> Cell of an angle, from 1.
   elemental integer function cell_of(angle, cells) result(cell)
      real(wp), intent(in) :: angle     !! the angle [rad]
      integer, intent(in) :: cells      !! cells of the circumference

      cell = modulo(floor(angle*(cells/(2.0_wp*pi))), cells) + 1
   end function cell_of

   !> Add a multiple of the change of the rates by depths.
   pure subroutine add_product(self, share, depth, rates)
      class(slopes_t), intent(in) :: self      !! the nodes
      real(wp), intent(in) :: share            !! the multiple [1]
      real(wp), intent(in) :: depth(:)         !! (n) what cells get deeper [m]
      real(wp), intent(inout) :: rates(:)      !! (n) added to, per cycle [m^3]

      real(wp) :: by_area, change, deeper, e(2), pressed, right(2), total
      integer :: k, m

      do m = 1, self%n
         associate (node => self%nodes(m))
            right = 0.0_wp
            pressed = 0.0_wp
            do k = node%first, node%last
               deeper = 2.0_wp*self%point(3, k)*(depth(self%cell(1, k)) + depth(self%cell(2, k)))
               right = right + deeper*self%point(:2, k)
               pressed = pressed + deeper*self%point(4, k)
            end do
            e = matmul(node%inverse, right + node%stiffer*pressed*node%m)
            total = 0.0_wp
            do k = node%first, node%last
               total = total + self%point(3, k)*(dot_product(self%point(:2, k), e) &
                                                 - depth(self%cell(1, k)) - depth(self%cell(2, k)))
            end do
            by_area = total/node%area
            do k = node%first, node%last
               change = share/node%area*self%point(3, k)*(dot_product(self%point(:2, k), e) - depth(self%cell(1, k)) &
                                                          - depth(self%cell(2, k)) - self%point(4, k)*by_area)
               rates(self%cell(1, k)) = rates(self%cell(1, k)) + node%volume(1)*change
               rates(self%cell(2, k)) = rates(self%cell(2, k)) + node%volume(2)*change
            end do
         end associate
      end do
   end subroutine add_product

   !> Add a multiple of what rates of cells fall with their depths where pins stay.
   pure subroutine add_diagonal(self, share, diagonal)
      class(slopes_t), intent(in) :: self       !! the nodes
      real(wp), intent(in) :: share             !! the multiple [1]
      real(wp), intent(inout) :: diagonal(:)    !! (n) added to, per cycle [m^2]

      integer :: k, m

      do m = 1, self%n
         associate (node => self%nodes(m))
            do k = node%first, node%last
               diagonal(self%cell(:, k)) = diagonal(self%cell(:, k)) + (share*self%point(3, k)/node%area)*node%volume
            end do
         end associate
      end do
   end subroutine add_diagonal

   !> Prepare the matrix.
   subroutine prepare(self, h, share)
      class(implicit_t), intent(inout) :: self   !! the matrix; a, b and `by` are set
      real(wp), intent(in) :: h                  !! cycles [1]
      real(wp), intent(in) :: share              !! of v_b [1]

      self%h = h
      self%share = share
      self%diagonal = 0.0_wp*self%by
      call self%a%add_diagonal(1.0_wp - share, self%diagonal)
      if (share > 0.0_wp) call self%b%add_diagonal(share, self%diagonal)
      self%diagonal = 1.0_wp + h*self%by*self%diagonal
   end subroutine prepare

   !> Product of the scaled matrix with a vector.
   subroutine matrix_product(self, v, z)
      class(implicit_t), intent(inout) :: self   !! the matrix
      real(wp), intent(in) :: v(:)               !! (n) vector [m^3]
      real(wp), intent(out) :: z(:)              !! (n) product [m^3]

      real(wp), allocatable :: change(:), depth(:)

      change = 0.0_wp*v
      depth = self%by*v/self%diagonal
      call self%a%add_product(1.0_wp - self%share, depth, change)
      if (self%share > 0.0_wp) call self%b%add_product(self%share, depth, change)
      z = v/self%diagonal - self%h*change
   end subroutine matrix_product

   !> Depth of each cell by its volume; of distances zero.
   pure function depth_by_volume(state, x) result(by)
      type(life_state_t), intent(in) :: state   !! the surfaces
      real(wp), intent(in) :: x(:)              !! (n) volumes and distances [m^3, m]
      real(wp) :: by(size(x))                   !! (n) depths by volumes [1/m^2]

      real(wp), parameter :: thinnest = 1.0e-3_wp   ! radius of a pin that is nearly worn through, of the new one [1]
      real(wp) :: radius
      integer :: i, k

      by = 0.0_wp
      do k = 1, size(state%surfaces)
         associate (surface => state%surfaces(k), n => size(state%surfaces(k)%volume))
            do i = state%before(k) + 1, state%before(k) + n
               radius = x(i)*n/(pi*surface%length)
               radius = sqrt(max(surface%radius**2 + merge(radius, -radius, surface%is_hole), (thinnest*surface%radius)**2))
               by(i) = n/(2.0_wp*pi*surface%length*radius)
            end do
         end associate
      end do
   end function depth_by_volume

end module held_slopes
