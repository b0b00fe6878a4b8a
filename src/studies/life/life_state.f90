!> The worn surfaces of a life as one list of numbers: volumes of all cells, surface by surface, then what each surface has slid.
!>
!> Measures of a surface are its maximum depth, its volume and its worn arc. The depth that a small change dV of the volume of a
!> cell makes is  dh = dV/(L w (R + h)),  of a pin  dV/(L w (r - h)),  w the width of the cell.
module life_state
   use kinds, only: pi, wp
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: life_state_t, measure_arc, measure_depth, measure_names, measure_units, measure_volume, n_measure

   integer, parameter :: measure_depth = 1    !! maximum depth [m]
   integer, parameter :: measure_volume = 2   !! worn volume [m^3]
   integer, parameter :: measure_arc = 3      !! worn arc [rad]
   integer, parameter :: n_measure = 3        !! measures of a surface
   character(*), parameter :: measure_names(n_measure) = [character(9) :: "depth_max", "volume", "arc"]   !! in files
   character(*), parameter :: measure_units(n_measure) = [character(3) :: "m", "m^3", "rad"]              !! their units

   real(wp), parameter :: window = 0.125_wp   !! part of the worn arc over which errors of depth are averaged [1]

   !> The surfaces: what does not change, and where their numbers stand.
   type :: life_state_t
      type(worn_surface_t), allocatable :: surfaces(:)   !! (surfaces) as they are at the start
      integer, allocatable :: before(:)                  !! (surfaces) numbers before the cells of each
      integer :: n = 0                                   !! numbers
   contains
      procedure :: start => state_start
      procedure :: numbers => state_numbers
      procedure :: worn => state_worn
      procedure :: measures => state_measures
      procedure :: smooth_depths
      procedure :: max_depth => state_max_depth
      procedure :: added_clearance
   end type life_state_t

contains

   !> Take the surfaces.
   subroutine state_start(self, surfaces)
      class(life_state_t), intent(out) :: self       !! the surfaces
      type(worn_surface_t), intent(in) :: surfaces(:) !! (surfaces) at the start

      integer :: k

      self%surfaces = surfaces
      allocate (self%before(size(surfaces)), source=0)
      do k = 2, size(surfaces)
         self%before(k) = self%before(k - 1) + size(surfaces(k - 1)%volume)
      end do
      self%n = size(surfaces) + sum([(size(surfaces(k)%volume), k=1, size(surfaces))])
   end subroutine state_start

   !> The numbers of surfaces.
   pure function state_numbers(self, surfaces) result(x)
      class(life_state_t), intent(in) :: self         !! the surfaces
      type(worn_surface_t), intent(in) :: surfaces(:) !! (surfaces) as they are now
      real(wp) :: x(self%n)                           !! (n) volumes and distances [m^3, m]

      integer :: k

      do k = 1, size(surfaces)
         x(self%before(k) + 1:self%before(k) + size(surfaces(k)%volume)) = surfaces(k)%volume
      end do
      x(self%n - size(surfaces) + 1:) = surfaces%distance
   end function state_numbers

   !> The surfaces of some numbers.
   pure function state_worn(self, x) result(surfaces)
      class(life_state_t), intent(in) :: self                !! the surfaces
      real(wp), intent(in) :: x(:)                           !! (n) volumes and distances [m^3, m]
      type(worn_surface_t), allocatable :: surfaces(:)       !! (surfaces) as they are then

      integer :: k

      surfaces = self%surfaces
      do k = 1, size(surfaces)
         surfaces(k)%volume = x(self%before(k) + 1:self%before(k) + size(surfaces(k)%volume))
         surfaces(k)%distance = x(self%n - size(surfaces) + k)
      end do
   end function state_worn

   !> Measures of all surfaces.
   pure function state_measures(self, x) result(values)
      class(life_state_t), intent(in) :: self                !! the surfaces
      real(wp), intent(in) :: x(:)                           !! (n) volumes and distances [m^3, m]
      real(wp) :: values(n_measure, size(self%surfaces))     !! (measures, surfaces) their measures [m, m^3, rad]

      type(worn_surface_t), allocatable :: surfaces(:)
      real(wp) :: angle
      integer :: k

      surfaces = self%worn(x)
      do k = 1, size(surfaces)
         call surfaces(k)%max_depth(values(measure_depth, k), angle)
         values(measure_volume, k) = sum(surfaces(k)%volume)
         values(measure_arc, k) = surfaces(k)%arc()
      end do
   end function state_measures

   !> Depths that a change of the volumes of a surface makes, averaged over an eighth of its worn arc: at an end of the arc, which
   !> moves, cells have errors of both signs.
   pure subroutine smooth_depths(self, k, x, change, depths)
      class(life_state_t), intent(in) :: self         !! the surfaces
      integer, intent(in) :: k                        !! number of the surface
      real(wp), intent(in) :: x(:)                    !! (n) where [m^3, m]
      real(wp), intent(in) :: change(:)               !! (n) change of the numbers [m^3, m]
      real(wp), intent(out) :: depths(:)              !! (cells of the surface) change of depths [m]

      real(wp) :: local(size(self%surfaces(k)%volume)), radius
      integer :: half, i, j, n

      n = size(local)
      associate (surface => self%surfaces(k), volume => x(self%before(k) + 1:self%before(k) + n))
         do i = 1, n
            radius = volume(i)*n/(pi*surface%length)
            radius = sqrt(max(surface%radius**2 + merge(radius, -radius, surface%is_hole), (1.0e-3_wp*surface%radius)**2))
            local(i) = change(self%before(k) + i)*n/(2.0_wp*pi*surface%length*radius)
         end do
         half = int(0.5_wp*window*count(volume > 0.0_wp))
      end associate
      do i = 1, n
         depths(i) = sum([(local(1 + modulo(i + j - 1, n)), j=-half, half)])/(2*half + 1)
      end do
   end subroutine smooth_depths

   !> Maximum depth of all surfaces.
   pure real(wp) function state_max_depth(self, x) result(depth)
      class(life_state_t), intent(in) :: self   !! the surfaces
      real(wp), intent(in) :: x(:)              !! (n) volumes and distances [m^3, m]

      real(wp) :: values(n_measure, size(self%surfaces))

      values = self%measures(x)
      depth = maxval(values(measure_depth, :))
   end function state_max_depth

   !> What the wear of a joint adds to its clearance: the maximum depths of both surfaces.
   pure function added_clearance(self, x) result(added)
      class(life_state_t), intent(in) :: self          !! the surfaces, bearing and journal of each contact side by side
      real(wp), intent(in) :: x(:)                     !! (n) volumes and distances [m^3, m]
      real(wp) :: added(size(self%surfaces)/2)         !! (contacts) length [m]

      real(wp) :: values(n_measure, size(self%surfaces))

      values = self%measures(x)
      added = values(measure_depth, 1::2) + values(measure_depth, 2::2)
   end function added_clearance

end module life_state
