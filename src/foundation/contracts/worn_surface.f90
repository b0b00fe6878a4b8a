!> The worn surface of a joint, as a run reports it: what each cell of its circumference has lost, and the depths that follow.
!>
!> A cell of the width w that has lost the volume V has the mean area A = V/(L w) of its section per angle, and the depth
!>
!> h = sqrt(R^2 + 2 A) - R of a hole,   h = r - sqrt(r^2 - 2 A) of a pin
!>
!> so that L/2 w ((R + h)^2 - R^2), of a pin L/2 w (r^2 - (r - h)^2), is the volume of the cell to round-off.
!> Signs: h is not negative; angles in the frame of the body that carries the surface, counter-clockwise from its x axis.
!> Limits: a pin that is worn through has the depth of its radius (`is_through`).
module worn_surface
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: worn_surface_t

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

   !> Depths of the cells.
   pure function depths_of_cells(self) result(depths)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp) :: depths(size(self%volume))       !! (cells) h [m]

      depths = 2.0_wp*areas(self)
      if (self%is_hole) then
         depths = depths/(sqrt(self%radius**2 + depths) + self%radius)
      else
         depths = min(depths/(sqrt(max(self%radius**2 - depths, 0.0_wp)) + self%radius), self%radius)
      end if
   end function depths_of_cells

   !> Maximum depth, and the middle of the cell that has it.
   pure subroutine surface_max_depth(self, depth, angle)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp), intent(out) :: depth              !! h [m]
      real(wp), intent(out) :: angle              !! where, -pi to pi [rad]

      real(wp) :: depths(size(self%volume))
      integer :: cell

      depths = self%depths()
      cell = maxloc(depths, dim=1)
      depth = depths(cell)
      angle = self%angle(cell)
      if (angle > pi) angle = angle - 2.0_wp*pi
   end subroutine surface_max_depth

   !> Angle of all cells that have lost something.
   pure real(wp) function worn_arc(self) result(arc)
      class(worn_surface_t), intent(in) :: self   !! the surface

      arc = 2.0_wp*pi*count(self%volume > 0.0_wp)/size(self%volume)
   end function worn_arc

   !> Whether a pin has lost all there was of it somewhere.
   pure logical function is_through(self)
      class(worn_surface_t), intent(in) :: self   !! the surface

      is_through = .not. self%is_hole .and. any(2.0_wp*areas(self) >= self%radius**2)
   end function is_through

   !> Mean areas A of the cells.
   pure function areas(self)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp) :: areas(size(self%volume))        !! (cells) per angle [m^2]

      areas = self%volume*(size(self%volume)/(2.0_wp*pi*self%length))
   end function areas

end module worn_surface
