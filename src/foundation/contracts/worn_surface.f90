!> The worn surface of a joint, as a run reports it: what each cell of its circumference has lost, and the profile that follows.
!>
!> A cell of the width w that has lost the volume V has the mean area function A = V/(L w); the profile is the positive, once
!> differentiable curve A(theta) with these means (`histospline`), and the depth
!>
!> h = sqrt(R^2 + 2 A) - R of a hole,   h = r - sqrt(r^2 - 2 A) of a pin
!>
!> so that L int A dtheta = L/2 int ((R + h)^2 - R^2) dtheta, of a pin L/2 int (r^2 - (r - h)^2) dtheta, is the volume to round-off.
!> Signs: h is not negative; theta in the frame of the body that carries the surface, counter-clockwise from its x axis.
!> Limits: a pin that is worn through has the depth of its radius (`is_through`).
module worn_surface
   use histospline, only: degree, fit_histospline, max_of_histospline, value_of_histospline
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: depths_at, worn_surface_t

   !> A worn surface of a joint.
   type :: worn_surface_t
      character(:), allocatable :: joint     !! name of the joint
      character(:), allocatable :: side      !! bearing or journal
      logical :: is_hole = .true.            !! it is a hole, whose radius grows; else a pin
      real(wp) :: radius = 0.0_wp            !! of the new surface [m]
      real(wp) :: length = 0.0_wp            !! along the axis [m]
      real(wp) :: distance = 0.0_wp          !! that the surfaces have slid on each other [m]
      real(wp), allocatable :: volume(:)     !! (cells) what each has lost [m^3]
   contains
      procedure :: angle => angle_of_cell
      procedure :: depths => depths_of_cells
      procedure :: max_depth => surface_max_depth
      procedure :: arc => worn_arc
      procedure :: is_through
   end type worn_surface_t

contains

   !> Direction of the middle of a cell.
   elemental real(wp) function angle_of_cell(self, cell) result(angle)
      class(worn_surface_t), intent(in) :: self   !! the surface
      integer, intent(in) :: cell                 !! number of the cell

      angle = 2.0_wp*pi*(cell - 0.5_wp)/size(self%volume)
   end function angle_of_cell

   !> Depths in the middle of the cells.
   pure function depths_of_cells(self) result(depths)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp) :: depths(size(self%volume))       !! (cells) h [m]

      integer :: k

      depths = depths_at(self, [(k - 0.5_wp, k=1, size(depths))])
   end function depths_of_cells

   !> Depths at some places.
   pure function depths_at(self, places) result(depths)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp), intent(in) :: places(:)           !! (any) where, in cells from theta = 0; k - 1/2: the middle of cell k [1]
      real(wp) :: depths(size(places))            !! (any) h [m]

      real(wp) :: c(0:degree, size(self%volume))
      integer :: k

      c = profile_of(self)
      do k = 1, size(depths)
         depths(k) = depth_of(self, value_of_histospline(c, places(k)))
      end do
   end function depths_at

   !> Maximum depth of the profile, and where it is.
   pure subroutine surface_max_depth(self, depth, angle)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp), intent(out) :: depth              !! h [m]
      real(wp), intent(out) :: angle              !! theta, -pi to pi [rad]

      real(wp) :: area, x

      call max_of_histospline(profile_of(self), area, x)
      depth = depth_of(self, area)
      angle = 2.0_wp*pi*x/size(self%volume)
      angle = angle - 2.0_wp*pi*anint(angle/(2.0_wp*pi))
   end subroutine surface_max_depth

   !> Angle of all cells that have lost something.
   pure real(wp) function worn_arc(self) result(arc)
      class(worn_surface_t), intent(in) :: self   !! the surface

      arc = 2.0_wp*pi*count(self%volume > 0.0_wp)/size(self%volume)
   end function worn_arc

   !> Whether a pin has lost all there was of it somewhere.
   pure logical function is_through(self)
      class(worn_surface_t), intent(in) :: self   !! the surface

      real(wp) :: area, x

      call max_of_histospline(profile_of(self), area, x)
      is_through = .not. (self%is_hole .or. 2.0_wp*area < self%radius**2)
   end function is_through

   !> The area function A as a curve.
   pure function profile_of(self) result(c)
      class(worn_surface_t), intent(in) :: self        !! the surface
      real(wp) :: c(0:degree, size(self%volume))       !! (0:4, cells) coefficients [m^2]

      call fit_histospline(self%volume*(size(self%volume)/(2.0_wp*pi*self%length)), c)
   end function profile_of

   !> Depth of an area function.
   elemental real(wp) function depth_of(self, area) result(depth)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp), intent(in) :: area                !! A [m^2]

      if (self%is_hole) then
         depth = 2.0_wp*area/(sqrt(self%radius**2 + 2.0_wp*area) + self%radius)
      else
         depth = 2.0_wp*area/(self%radius + sqrt(max(self%radius**2 - 2.0_wp*area, 0.0_wp)))
         depth = min(depth, self%radius)
      end if
   end function depth_of

end module worn_surface
