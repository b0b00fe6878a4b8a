!> The profile of a worn surface, as contact geometry reads it: depth, slope and bend at any place of its circumference.
!>
!> V_k the volume that cell k has lost, w its angle, L the length:  A = V_k/(L w), mean area of its section per angle; A(theta) is
!> the histospline of these means, so that the area of each cell is kept, and
!>
!> h = sqrt(R^2 + 2 A) - R of a hole,   h = r - sqrt(r^2 - 2 A) of a pin
!> h' = A'/(R + h),  h'' = (A'' - h'^2)/(R + h);   of a pin h' = A'/(r - h),  h'' = (A'' + h'^2)/(r - h)
!>
!> Signs: h is not negative; angles in the frame of the body that carries the surface, counter-clockwise from its x axis. h and h'
!> are continuous, h'' jumps from cell to cell. Source: see `histospline`.
!> Limits: cells of one width, at least 4; a pin is nowhere worn through (`worn_surface`).
module surface_profile
   use gauss_points, only: n_six, six_places
   use histospline, only: degree, fit_histospline, value_of_histospline, values_of_histospline
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: depth_t, most_places, new_profile, places_t, profile_t, worn_pair_t

   integer, parameter :: most_places = 161   !! looked at at once

   !> Places of a hole, as they are read often.
   type :: places_t
      real(wp), allocatable :: theta(:)    !! (n) their angles, frame of the body, 0 to 2 pi [rad]
      real(wp), allocatable :: u(:, :)     !! (n, 2) their directions [1]
      real(wp), allocatable :: h(:)        !! (n) depths [m]
      real(wp), allocatable :: slope(:)    !! (n) dh/dtheta [m/rad]
      real(wp), allocatable :: bend(:)     !! (n) d2h/dtheta2 [m/rad^2]
   end type places_t

   !> A worn surface, or one without a profile, which is round.
   type :: profile_t
      logical :: is_hole = .true.            !! its radius grows by wear; else a pin
      real(wp) :: radius = 0.0_wp            !! of the new surface [m]
      real(wp) :: width = 0.0_wp             !! angle of a cell [rad]
      real(wp), allocatable :: c(:, :)       !! (0:4, cells) coefficients of A; unallocated: the surface is round [m^2]
      real(wp), allocatable :: volume(:)     !! (cells) what each has lost [m^3]
      integer :: parts = 1                   !! intervals of each cell of a hole, for integrals over it
      type(places_t) :: points               !! (5 intervals + 1) Lobatto's six points of each, the last being the first of the next
   contains
      procedure :: is_round => profile_is_round
      procedure :: at => depth_at
      procedure :: at_places => depths_at
   end type profile_t

   real(wp), parameter :: longest = 0.05_wp  !! interval that Lobatto's six points are right for [rad]

   !> The worn surfaces of a pin in a hole; the pin may be round.
   type :: worn_pair_t
      type(profile_t) :: hole   !! of the bearing; never without a profile
      type(profile_t) :: pin    !! of the journal
      real(wp) :: distance = 0.0_wp   !! that the surfaces have slid on each other before the start [m]
   end type worn_pair_t

   !> Depth at a place.
   type :: depth_t
      real(wp) :: h = 0.0_wp       !! depth [m]
      real(wp) :: slope = 0.0_wp   !! dh/dtheta [m/rad]
      real(wp) :: bend = 0.0_wp    !! d2h/dtheta2 [m/rad^2]
   end type depth_t

contains

   !> The profile of what cells have lost.
   pure subroutine new_profile(profile, is_hole, radius, length, volume)
      type(profile_t), intent(out) :: profile  !! the profile
      logical, intent(in) :: is_hole           !! a hole, else a pin
      real(wp), intent(in) :: radius           !! of the new surface [m]
      real(wp), intent(in) :: length           !! along the axis [m]
      real(wp), intent(in) :: volume(:)        !! (cells) what each has lost, not negative [m^3]

      integer :: g, k

      profile%is_hole = is_hole
      profile%radius = radius
      profile%width = 2.0_wp*pi/size(volume)
      profile%volume = volume
      allocate (profile%c(0:degree, size(volume)))
      call fit_histospline(volume/(length*profile%width), profile%c)
      if (.not. is_hole) return
      profile%parts = ceiling(profile%width/longest)
      associate (n => profile%parts*size(volume))
         call take_places(profile, [((k - 1 + six_places(g), g=1, n_six - 1), k=1, n), real(n, wp)], &
                          [((k - 1, g=1, n_six - 1), k=1, n), n - 1], profile%points)
      end associate
   end subroutine new_profile

   !> Places of a profile.
   pure subroutine take_places(profile, x, interval, places)
      type(profile_t), intent(in) :: profile   !! the profile, fitted
      real(wp), intent(in) :: x(:)             !! (n) where they are, in intervals from the x axis [1]
      integer, intent(in) :: interval(:)       !! (n) those they are in, from 0
      type(places_t), intent(out) :: places    !! the places

      type(depth_t) :: depth
      integer :: k

      allocate (places%u(size(x), 2), places%h(size(x)), places%slope(size(x)), places%bend(size(x)))
      places%theta = x*(profile%width/profile%parts)
      do k = 1, size(x)
         depth = profile%at(places%theta(k), interval(k)/profile%parts)
         places%u(k, :) = [cos(places%theta(k)), sin(places%theta(k))]
         places%h(k) = depth%h
         places%slope(k) = depth%slope
         places%bend(k) = depth%bend
      end do
   end subroutine take_places

   !> Whether there is no profile.
   pure logical function profile_is_round(self)
      class(profile_t), intent(in) :: self   !! the surface

      profile_is_round = .not. allocated(self%c)
   end function profile_is_round

   !> Depth at an angle. At the edge of two cells h'' is that of the cell on the side that is asked for.
   pure type(depth_t) function depth_at(self, theta, cell) result(depth)
      class(profile_t), intent(in) :: self      !! the surface
      real(wp), intent(in) :: theta             !! angle from the x axis of its body, any turn [rad]
      integer, intent(in), optional :: cell     !! number of the cell it is in, from 0, any turn; absent: found

      real(wp) :: area, bend, rho, slope, u
      integer :: k

      if (.not. allocated(self%c)) return
      u = theta/self%width
      if (present(cell)) then
         k = cell
      else
         k = floor(u)
      end if
      u = min(max(u - k, 0.0_wp), 1.0_wp)
      call value_of_histospline(self%c(:, modulo(k, size(self%c, 2)) + 1), u, area, slope, bend)
      slope = slope/self%width
      bend = bend/self%width**2
      if (self%is_hole) then
         rho = sqrt(self%radius**2 + 2.0_wp*area)
         depth%slope = slope/rho
         depth%bend = (bend - depth%slope**2)/rho
      else
         rho = sqrt(self%radius**2 - 2.0_wp*area)
         depth%slope = slope/rho
         depth%bend = (bend + depth%slope**2)/rho
      end if
      depth%h = 2.0_wp*area/(rho + self%radius)
   end function depth_at

   !> Depths at many angles, none of them at the edge of a cell.
   pure subroutine depths_at(self, n, theta, h, slope, bend)
      class(profile_t), intent(in) :: self      !! the surface, with a profile
      integer, intent(in) :: n                  !! how many, `most_places` at most
      real(wp), intent(in) :: theta(n)          !! (n) angles from the x axis of its body, any turn [rad]
      real(wp), intent(out) :: h(n)             !! (n) depths [m]
      real(wp), intent(out) :: slope(n)         !! (n) dh/dtheta [m/rad]
      real(wp), intent(out) :: bend(n)          !! (n) d2h/dtheta2 [m/rad^2]

      real(wp) :: outward, rho, u(most_places)
      integer :: cell(most_places), cells, k, turn

      outward = merge(1.0_wp, -1.0_wp, self%is_hole)
      cells = size(self%volume)
      do k = 1, n
         u(k) = theta(k)/self%width
         turn = floor(u(k))
         u(k) = u(k) - turn
         cell(k) = turn + merge(cells, 0, turn < 0) - merge(cells, 0, turn >= cells) + 1
      end do
      do k = 1, n
         if (cell(k) < 1 .or. cell(k) > cells) cell(k) = modulo(cell(k) - 1, cells) + 1  ! more than a turn off
      end do
      call values_of_histospline(self%c, n, cell, u, h, slope, bend)
      do k = 1, n
         rho = sqrt(self%radius**2 + outward*2.0_wp*h(k))  ! h is the area so far
         h(k) = 2.0_wp*h(k)/(rho + self%radius)
         slope(k) = slope(k)/(self%width*rho)
         bend(k) = (bend(k)/self%width**2 - outward*slope(k)**2)/rho
      end do
   end subroutine depths_at

end module surface_profile
