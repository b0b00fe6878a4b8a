!> Surfaces that decks give as worn: volumes of cells against closed forms and quadratures, the worn arc, other cells.
module test_worn_tables
   use check, only: check_close, check_true, suite_t
   use deck_scene, only: load_text, loaded_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: pi, wp
   use text, only: exact_text, to_text
   use worn_by_run, only: resampled
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: run_test_worn_tables

   real(wp), parameter :: hole = 10.0e-3_wp, pin = 9.5e-3_wp, length = 15.0e-3_wp   ! [m]
   character(*), parameter :: nl = new_line("a")

contains

   !> Register the tests.
   subroutine run_test_worn_tables(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("volumes_of_a_shaft_in_a_bush", test_bush)
      call suite%test("cells_of_arcs", test_arcs)
      call suite%test("edges_of_worn_arcs", test_edges)
      call suite%test("uniform_wear", test_uniform)
      call suite%test("profiles_keep_their_area", test_profiles)
      call suite%test("other_cells", test_resampled)
   end subroutine run_test_worn_tables

   !> The worn surfaces of a deck: a shaft in a bush, with tables of wear.
   subroutine worn_of(tables, cells, worn, error)
      character(*), intent(in) :: tables                               !! tables of given wear
      integer, intent(in) :: cells                                     !! of each circumference
      type(worn_surface_t), allocatable, intent(out) :: worn(:)        !! (n) what the scene has
      type(error_t), allocatable, intent(out) :: error                 !! an error of the deck

      type(loaded_t) :: loaded

      call load_text("deck = 1"//nl//"[scene]"//nl//"gravity = 0 0 m/s^2"//nl//"[bodies]"//nl// &
                     "name mass[kg] inertia[kg.m^2]"//nl//"shaft 1 1e-3"//nl//"[points]"//nl//"name body"//nl// &
                     "bush ground"//nl//"centre shaft"//nl//"[material]"//nl//"name young[GPa] poisson"//nl// &
                     "steel 207 0.3"//nl//"[clearance.revolute]"//nl// &
                     "name bearing journal bearing_radius[mm] clearance[mm] length[mm] material law wear"//nl// &
                     "joint bush centre 10 0.5 15 steel dry slow"//nl//"[contact.hertz]"//nl//"name"//nl//"dry"//nl// &
                     "[wear.archard]"//nl//"name bearing[m^2/N] journal[m^2/N] cells"//nl// &
                     "slow 1e-15 1e-15 "//to_text(cells)//nl//tables//nl// &
                     "[analysis.dynamic]"//nl//"end = 1 ms"//nl, loaded, error)
      if (.not. allocated(error)) call move_alloc(loaded%scene%worn, worn)
   end subroutine worn_of

   !> The table of an arc.
   function arc(surface, radius, depth, direction) result(text)
      character(*), intent(in) :: surface       !! bearing or journal
      real(wp), intent(in) :: radius            !! of the circle [m]
      real(wp), intent(in) :: depth             !! of the deepest place [m]
      real(wp), intent(in) :: direction         !! of it [rad]
      character(:), allocatable :: text         !! the table

      text = "[worn.arc]"//nl//"name joint surface radius[m] depth[m] direction[rad]"//nl//"groove joint "//surface//" "// &
             exact_text(radius)//" "//exact_text(depth)//" "//exact_text(direction)
   end function arc

   !> Volumes of a shaft worn into a bush 1 um and 100 um deep: those of 30 digits. An omitted radius is that of the shaft.
   subroutine test_bush(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: depths(2) = [1.0e-6_wp, 1.0e-4_wp]
      real(wp), parameter :: expected(2) = [1.2317737498454e-11_wp, 1.1350086123764e-8_wp]   ! [m^3]
      type(worn_surface_t), allocatable :: worn(:)
      real(wp) :: angle, depth
      integer :: k

      do k = 1, 2
         call worn_of("[worn.arc]"//nl//"name joint surface depth[m] direction[deg]"//nl//"groove joint bearing "// &
                      exact_text(depths(k))//" -90", 360, worn, error)
         if (allocated(error)) return
         call check_true(error, worn(1)%joint == "joint" .and. worn(1)%side == "bearing", "joint and side")
         if (allocated(error)) return
         call check_close(error, sum(worn(1)%volume), expected(k), 1.0e-10_wp, "volume", relative=.true.)
         if (allocated(error)) return
         call worn(1)%max_depth(depth, angle)
         call check_close(error, depth, depths(k), 0.03_wp*depths(k), "depth of the deepest cells")
         if (allocated(error)) return
         call check_true(error, abs(angle + 0.5_wp*pi) < 0.02_wp, "where it is deepest")
         if (allocated(error)) return
      end do
   end subroutine test_bush

   !> Cells of arcs of holes and pins, at random, against the quadrature of the distance of a circle from the centre.
   subroutine test_arcs(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: cells = 24, cases = 12, fine = 4000
      type(worn_surface_t), allocatable :: worn(:)
      type(random_t) :: random
      real(wp) :: centre, depth, direction, expected(cells), own, radius, s, theta
      logical :: is_hole
      integer :: i, k, m

      random%state = 5
      do k = 1, cases
         is_hole = modulo(k, 2) == 0
         depth = 1.0e-3_wp*10.0_wp**random%between(-3.0_wp, 0.0_wp)
         direction = random%between(-7.0_wp, 7.0_wp)
         own = merge(hole, pin, is_hole)
         radius = merge(own*random%between(0.3_wp, 1.0_wp), own*random%between(1.0_wp, 3.0_wp), is_hole)
         call worn_of(arc(trim(merge("bearing", "journal", is_hole)), radius, depth, direction), cells, worn, error)
         if (allocated(error)) return
         centre = merge(own + depth, own - depth, is_hole) - radius
         expected = 0.0_wp
         do i = 1, cells
            do m = 1, fine
               theta = 2.0_wp*pi*(i - 1 + (m - 0.5_wp)/fine)/cells - direction
               s = radius**2 - (centre*sin(theta))**2
               if (s < 0.0_wp) cycle
               s = centre*cos(theta) + sqrt(s)
               if (is_hole) expected(i) = expected(i) + 0.5_wp*length*max(s**2 - own**2, 0.0_wp)*2.0_wp*pi/(cells*fine)
               if (.not. is_hole) expected(i) = expected(i) + 0.5_wp*length*max(own**2 - s**2, 0.0_wp)*2.0_wp*pi/(cells*fine)
            end do
         end do
         call check_close(error, worn(1)%volume, expected, 1.0e-5_wp*maxval(expected), "volumes of cells")
         if (allocated(error)) return
      end do
   end subroutine test_arcs

   !> The worn arc of holes and pins: 2 b, sin b by the chord, to 1e-3 with 360 cells, wherever it lies; and where half a degree is
   !> worn, and all round.
   subroutine test_edges(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(worn_surface_t), allocatable :: worn(:)
      type(worn_surface_t) :: other
      type(random_t) :: random
      real(wp) :: depth, e, half
      integer :: k

      random%state = 8
      do k = 1, 20
         depth = merge(1.0e-4_wp, 1.0e-4_wp*random%between(0.3_wp, 3.0_wp), k < 8)
         call worn_of(arc("bearing", pin, depth, random%between(-3.0_wp, 3.0_wp)), 360, worn, error)
         if (allocated(error)) return
         e = hole - pin + depth
         half = acos((hole**2 - pin**2 - e**2)/(2.0_wp*pin*e))                  ! from the centre of the pin
         if (k == 1) call check_close(error, half*180.0_wp/pi, 34.5446836933_wp, 1.0e-9_wp, "half angle")
         if (allocated(error)) return
         half = atan2(pin*sin(half), e + pin*cos(half))
         call check_close(error, worn(1)%arc(), 2.0_wp*half, 1.0e-3_wp, "arc of a hole", relative=.true.)
         if (allocated(error)) return
         call worn_of(arc("journal", hole, depth, random%between(-3.0_wp, 3.0_wp)), 360, worn, error)
         if (allocated(error)) return
         e = hole - pin + depth
         half = acos((e**2 + pin**2 - hole**2)/(2.0_wp*pin*e))                  ! from the centre of the pin
         call check_close(error, worn(1)%arc(), 2.0_wp*(pi - half), 1.0e-3_wp, "arc of a pin", relative=.true.)
         if (allocated(error)) return
      end do
      other = worn(1)
      other%volume = 0.0_wp
      call check_close(error, other%arc(), 0.0_wp, 0.0_wp, "no wear")
      if (allocated(error)) return
      other%volume(360) = 1.0_wp
      call check_close(error, other%arc(), 2.0_wp*pi/360, 1.0e-12_wp, "one cell")
      if (allocated(error)) return
      other%volume(1:2) = 1.0_wp
      other%volume(3) = 0.25_wp
      other%volume(180) = 1.0_wp
      call check_close(error, other%arc(), 2.0_wp*pi/360*(0.25_wp + 3.0_wp + 1.0_wp), 1.0e-9_wp, "two stretches, one around zero")
      if (allocated(error)) return
      other%volume = 1.0_wp
      call check_close(error, other%arc(), 2.0_wp*pi, 0.0_wp, "all round")
   end subroutine test_edges

   !> Depths come back from even wear of hole and pin.
   subroutine test_uniform(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(worn_surface_t), allocatable :: worn(:)

      call worn_of("[worn.uniform]"//nl//"name joint surface depth[um]"//nl//"a joint bearing 200"//nl// &
                   "b joint journal 300", 36, worn, error)
      if (allocated(error)) return
      call check_close(error, sum(worn(1)%volume), pi*length*((hole + 2.0e-4_wp)**2 - hole**2), 1.0e-13_wp, "hole", relative=.true.)
      if (allocated(error)) return
      call check_close(error, sum(worn(2)%volume), pi*length*(pin**2 - (pin - 3.0e-4_wp)**2), 1.0e-13_wp, "pin", relative=.true.)
      if (allocated(error)) return
      call check_close(error, worn(2)%depths(), spread(3.0e-4_wp, 1, 36), 1.0e-16_wp, "depths of the pin")
   end subroutine test_uniform

   !> A profile at uneven angles: its area by the trapezoidal rule, which is that of lines, whatever the cells; each cell against a
   !> fine sum; and the same profile started at another sample.
   subroutine test_profiles(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: degree = pi/180.0_wp
      real(wp), parameter :: angles(6) = [-100.0_wp, -90.0_wp, -71.0_wp, 3.0_wp, 140.0_wp, 200.5_wp]*degree
      real(wp), parameter :: depths(6) = [0.0_wp, 1.0e-4_wp, 2.0e-5_wp, 0.0_wp, 3.0e-4_wp, 1.0e-5_wp]
      integer, parameter :: cells(3) = [9, 360, 1441], fine = 200
      type(worn_surface_t), allocatable :: turned(:), worn(:)
      real(wp) :: area(7), angle(7), theta, total
      real(wp), allocatable :: expected(:)
      character(60) :: text(4)
      integer :: i, k, m

      area(:6) = hole*depths + 0.5_wp*depths**2
      area(7) = area(1)
      angle = [angles, angles(1) + 2.0_wp*pi]
      total = length*sum(0.5_wp*(area(2:) + area(:6))*(angle(2:) - angle(:6)))
      text = [character(60) :: "-100 -90 -71 3 140 200.5", "0 100 20 0 300 10", &
                              "-71 3 140 200.5 260 270 289", "20 0 300 10 0 100 20"]
      do k = 1, size(cells)
         call worn_of(profile(text(1), text(2)), cells(k), worn, error)
         if (allocated(error)) return
         call check_close(error, sum(worn(1)%volume), total, 1.0e-13_wp, "volume", relative=.true.)
         if (allocated(error)) return
         call worn_of(profile(text(3), text(4)), cells(k), turned, error)
         if (allocated(error)) return
         call check_close(error, turned(1)%volume, worn(1)%volume, 1.0e-14_wp*total, "a turn closed by its first sample")
         if (allocated(error)) return
         expected = [(0.0_wp, i=1, cells(k))]
         do i = 1, cells(k)
            do m = 1, fine
               theta = angle(1) + modulo(2.0_wp*pi*(i - 1 + (m - 0.5_wp)/fine)/cells(k) - angle(1), 2.0_wp*pi)
               expected(i) = expected(i) + length*line_at(theta)*2.0_wp*pi/(cells(k)*fine)
            end do
         end do
         call check_close(error, worn(1)%volume, expected, 1.0e-3_wp*maxval(expected), "cells")
         if (allocated(error)) return
      end do

   contains

      !> The area at an angle.
      pure real(wp) function line_at(theta) result(value)
         real(wp), intent(in) :: theta   !! from the first sample on [rad]

         integer :: j

         j = min(count(angle <= theta), 6)
         value = area(j) + (area(j + 1) - area(j))*(theta - angle(j))/(angle(j + 1) - angle(j))
      end function line_at

      !> The table of a profile.
      pure function profile(angles, depths) result(table)
         character(*), intent(in) :: angles, depths   !! numbers in degrees and micrometres
         character(:), allocatable :: table           !! the table

         table = "[worn.profile]"//nl//"name joint surface angle depth"//nl//"a joint bearing """//trim(angles)// &
                 " deg"" """//trim(depths)//" um"""
      end function profile

   end subroutine test_profiles

   !> Volumes in other cells: cells of cells have the sum, halves have half, and none is lost between numbers that share no factor.
   subroutine test_resampled(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: volume(12)
      integer :: k

      volume = [(real(k*k, wp), k=1, 12)]
      call check_close(error, resampled(volume, 4), [(sum(volume(3*k - 2:3*k)), k=1, 4)], 1.0e-13_wp, "coarser")
      if (allocated(error)) return
      call check_close(error, resampled(volume, 24), 0.5_wp*[(volume(k), volume(k), k=1, 12)], 1.0e-13_wp, "finer")
      if (allocated(error)) return
      do k = 1, 40
         call check_close(error, sum(resampled(volume, k)), sum(volume), 1.0e-14_wp, "sum", relative=.true.)
         if (allocated(error)) return
      end do
      call check_close(error, resampled([1.0_wp, 2.0_wp], 3), [2.0_wp/3.0_wp, 1.0_wp, 4.0_wp/3.0_wp], 1.0e-15_wp, "two in three")
   end subroutine test_resampled

end module test_worn_tables
