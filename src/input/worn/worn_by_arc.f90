!> A circle that is worn into a surface to some depth: what a pin leaves in a bearing under a load of one direction, or a hole on a
!> pin that does not turn.
!>
!> The circle has the radius rho; its centre lies off that of the surface, in the direction of the arc, by
!>
!> e = R + h - rho of a hole,   e = r - h - rho of a pin, negative
!>
!> The worn surface is s(theta) = e cos(theta) + sqrt(rho^2 - e^2 sin(theta)^2) inside of the half angle b, where it meets the
!> circle of the radius R:  1 - cos b = h (2 rho - h)/(2 R e),   of a pin  -h (2 rho + h)/(2 r e). Volume between two directions:
!>
!> V = L |int (s^2 - R^2)/2 dtheta| = L |[rho^2 psi/2 + e rho sin(psi)/2 - R^2 theta/2]|,   psi = theta + asin(e sin(theta)/rho)
!>
!> Signs: the direction is that of the deepest place, in the frame of the body that carries the surface, counter-clockwise from
!> its x axis. Source: areas of sectors of circles. Limits: rho is not larger than the radius of a hole and not smaller than that
!> of a pin; h is at most rho in a hole, smaller than r on a pin; round-off is 1e-16 R^2 L.
module worn_by_arc
   use item, only: item_t
   use kind_info, only: add_number, dim_angle, dim_length, kind_info_t
   use kinds, only: pi, wp
   use text, only: real_text
   use worn_kind, only: add_surface_columns, cell_edge, set_mistake, worn_kind_t, worn_mistake_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: worn_by_arc_t

   !> The kind.
   type, extends(worn_kind_t) :: worn_by_arc_t
   contains
      procedure, nopass :: info => arc_info
      procedure, nopass :: fill => arc_fill
   end type worn_by_arc_t

   real(wp), parameter :: same = 1.0e-9_wp   !! difference of radii that is round-off of the deck's numbers [1]

contains

   !> Description of the kind.
   function arc_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "worn.arc"
      info%help = "surfaces into which a circle is worn at the start, as a shaft wears into a bush under a load of one direction"
      info%source = ""
      call add_surface_columns(info)
      call add_number(info, "depth", dim_length, "depth at the deepest place", lower=0.0_wp)
      call add_number(info, "direction", dim_angle, "of the deepest place, from the x axis of the body that carries the surface")
      call add_number(info, "radius", dim_length, "radius of the circle; omitted: that of the other surface", default="0 m", &
                      lower=0.0_wp, is_free=.true.)
   end function arc_info

   !> Worn volumes of a surface.
   subroutine arc_fill(item, cells, other_radius, surface, mistake)
      type(item_t), intent(inout) :: item                          !! the row
      integer, intent(in) :: cells                                 !! of the circumference
      real(wp), intent(in) :: other_radius                         !! of the surface that it touches [m]
      type(worn_surface_t), intent(inout) :: surface               !! with radius and length; volumes are set
      type(worn_mistake_t), allocatable, intent(out) :: mistake    !! a circle that is worn into no surface

      real(wp) :: depth, direction, e, edge, first, half, last, outward, radius
      integer :: k, turn

      depth = item%number("depth")
      radius = item%number("radius")
      if (.not. item%is_given("radius")) radius = other_radius
      call check_circle(surface, depth, radius, mistake)
      if (allocated(mistake)) return
      allocate (surface%volume(cells), source=0.0_wp)
      if (.not. depth > 0.0_wp) return
      outward = merge(1.0_wp, -1.0_wp, surface%is_hole)
      radius = outward*min(outward*radius, outward*surface%radius)
      e = surface%radius + outward*depth - radius
      half = 2.0_wp*asin(sqrt(0.25_wp*outward*depth*(2.0_wp*radius - outward*depth)/(surface%radius*e)))
      direction = modulo(item%number("direction"), 2.0_wp*pi)
      do k = 1, cells
         edge = cell_edge(k - 1, cells) - direction
         do turn = -1, 1
            first = max(edge + 2.0_wp*pi*turn, -half)
            last = min(edge + cell_edge(1, cells) + 2.0_wp*pi*turn, half)
            if (.not. last > first) cycle
            surface%volume(k) = surface%volume(k) + max(surface%length*outward*area_between(first, last), 0.0_wp)
         end do
      end do

   contains

      !> Area between the worn and the new surface: of a pin it is negative.
      pure real(wp) function area_between(from, to) result(area)
         real(wp), intent(in) :: from, to   !! directions from the deepest place, within the arc [rad]

         real(wp) :: psi(2)

         psi = [from, to] + asin(e*sin([from, to])/radius)
         area = 0.5_wp*(radius**2*(psi(2) - psi(1)) - surface%radius**2*(to - from)) + &
                e*radius*cos(0.5_wp*(psi(1) + psi(2)))*sin(0.5_wp*(psi(2) - psi(1)))   ! [m^2]
      end function area_between

   end subroutine arc_fill

   !> Whether a circle can be worn into a surface.
   subroutine check_circle(surface, depth, radius, mistake)
      type(worn_surface_t), intent(in) :: surface                  !! with its radius
      real(wp), intent(in) :: depth                                !! of the deepest place [m]
      real(wp), intent(in) :: radius                               !! of the circle [m]
      type(worn_mistake_t), allocatable, intent(out) :: mistake    !! what is wrong

      if (surface%is_hole .and. radius > surface%radius*(1.0_wp + same)) then
         call set_mistake(mistake, "radius", 0, "the radius of the arc exceeds that of the bearing, "//in_mm(surface%radius), &
                                  "a circle that is worn into a hole is not larger than the hole")
      else if (surface%is_hole .and. depth > radius) then
         call set_mistake(mistake, "depth", 0, "the arc is deeper than its radius, "//in_mm(radius), &
                                  "give a depth of at most the radius")
      else if (.not. surface%is_hole .and. radius < surface%radius*(1.0_wp - same)) then
         call set_mistake(mistake, "radius", 0, "the radius of the arc is smaller than that of the journal, "// &
                                  in_mm(surface%radius), "a circle that is worn into a pin is not smaller than the pin")
      else if (.not. (surface%is_hole .or. depth < surface%radius)) then
         call set_mistake(mistake, "depth", 0, "the journal is worn through", "the depth of a journal is smaller than its radius")
      end if
   end subroutine check_circle

   !> A length as a deck has it.
   function in_mm(length) result(words)
      real(wp), intent(in) :: length         !! [m]
      character(:), allocatable :: words     !! with its unit

      words = real_text(1.0e3_wp*length, 6)//" mm"
   end function in_mm

end module worn_by_arc
