!> Files of worn surfaces: depth over angle as comma-separated values, and solids for other programs as STL.
!>
!> JOINT.bearing.csv, JOINT.journal.csv: angle in rad and depth in m of the middle of each cell; `worn.profile` reads them.
!> JOINT.bearing.stl, JOINT.journal.stl: text, in mm; depths are magnified by a factor that stands in the first line. The axis is
!> z, from
!> 0 to the length; x and y are those of the body. A bearing has a wall of half its radius behind the deepest place; a journal is
!> solid.
!> Source: RFC 4180; 3D Systems (1989), StereoLithography Interface Specification: normals point outward, corners counter-clockwise.
module worn_files
   use errors, only: error_t
   use kinds, only: pi, wp
   use output_plan, only: output_plan_t
   use text, only: append_text, exact_text, real_text, text_t
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: write_worn_files

   real(wp), parameter :: mm = 1.0e3_wp       !! [mm/m]

contains

   !> Write the files that are asked for.
   subroutine write_worn_files(plan, worn, csv, solids, error)
      type(output_plan_t), intent(in) :: plan                       !! directory of the run, and what is asked for
      type(worn_surface_t), allocatable, intent(in) :: worn(:)      !! (n) the surfaces; unallocated: none
      type(text_t), allocatable, intent(inout) :: csv(:)            !! (any) profiles that were written, grown
      type(text_t), allocatable, intent(inout) :: solids(:)         !! (any) solids that were written, grown
      type(error_t), allocatable, intent(out) :: error              !! one cannot be written; those before are there

      character(:), allocatable :: name
      integer :: k

      if (.not. allocated(worn)) return
      do k = 1, size(worn)
         name = name_of(worn(k))
         if (plan%with%csv) then
            call write_file(plan%directory//"/"//name//".csv", csv_text(worn(k)), error)
            if (allocated(error)) return
            call append_text(csv, name//".csv")
         end if
         if (.not. plan%with%worn_stl > 0.0_wp) cycle
         call write_file(plan%directory//"/"//name//".stl", stl_text(worn(k), plan%with%worn_stl), error)
         if (allocated(error)) return
         call append_text(solids, name//".stl")
      end do
   end subroutine write_worn_files

   !> Depths over the angle.
   function csv_text(surface) result(text)
      type(worn_surface_t), intent(in) :: surface    !! the surface
      character(:), allocatable :: text              !! the file

      type(buffer_t) :: lines
      real(wp), allocatable :: depths(:)
      integer :: i

      depths = surface%depths()
      call lines%line("angle[rad],depth[m]")
      do i = 1, size(depths)
         call lines%line(exact_text(surface%angle(i))//","//exact_text(depths(i)))
      end do
      text = lines%get()
   end function csv_text

   !> Name of the files of a surface, without ending.
   pure function name_of(surface) result(name)
      type(worn_surface_t), intent(in) :: surface    !! the surface
      character(:), allocatable :: name              !! as `gudgeon.bearing`

      name = surface%joint//"."//surface%side
   end function name_of

   !> A worn bearing or journal as STL; a journal that is worn through by magnified depths ends at a hundredth of its radius.
   function stl_text(surface, factor) result(text)
      type(worn_surface_t), intent(in) :: surface    !! the surface
      real(wp), intent(in) :: factor                 !! of the depths [1]
      character(:), allocatable :: text              !! the file

      real(wp), parameter :: wall = 0.5_wp           ! of a bearing, of its radius [1]
      real(wp), parameter :: core = 0.01_wp          ! what is left of a journal at least, of its radius [1]
      type(buffer_t) :: lines
      character(:), allocatable :: name
      real(wp) :: back, from, r(2), to, top
      real(wp), allocatable :: radii(:)
      integer :: i, n

      radii = mm*(surface%radius + merge(factor, -factor, surface%is_hole)*surface%depths())
      if (.not. surface%is_hole) radii = max(radii, core*mm*surface%radius)
      radii = 0.5_wp*(radii + cshift(radii, -1))   ! where cells meet
      back = maxval(radii) + wall*mm*surface%radius
      top = mm*surface%length
      n = size(radii)
      name = name_of(surface)//" worn, depths times "//real_text(factor, 6)//", mm"
      call lines%line("solid "//name)
      do i = 1, n
         from = 2.0_wp*pi*(i - 1)/n
         to = 2.0_wp*pi*modulo(i, n)/n   ! the last corner is the first one, to the digit
         r = [radii(i), radii(modulo(i, n) + 1)]
         if (surface%is_hole) then
            call face(at(r(1), from, 0.0_wp), at(r(1), from, top), at(r(2), to, top), at(r(2), to, 0.0_wp))
            call face(at(back, from, 0.0_wp), at(back, to, 0.0_wp), at(back, to, top), at(back, from, top))
            call face(at(r(1), from, top), at(back, from, top), at(back, to, top), at(r(2), to, top))
            call face(at(r(1), from, 0.0_wp), at(r(2), to, 0.0_wp), at(back, to, 0.0_wp), at(back, from, 0.0_wp))
         else
            call face(at(r(1), from, 0.0_wp), at(r(2), to, 0.0_wp), at(r(2), to, top), at(r(1), from, top))
            call facet(at(0.0_wp, 0.0_wp, top), at(r(1), from, top), at(r(2), to, top))
            call facet(at(0.0_wp, 0.0_wp, 0.0_wp), at(r(2), to, 0.0_wp), at(r(1), from, 0.0_wp))
         end if
      end do
      call lines%line("endsolid "//name)
      text = lines%get()

   contains

      !> A point.
      pure function at(r, theta, z) result(p)
         real(wp), intent(in) :: r        !! from the axis [mm]
         real(wp), intent(in) :: theta    !! direction [rad]
         real(wp), intent(in) :: z        !! along the axis [mm]
         real(wp) :: p(3)                 !! [mm]

         p = [r*cos(theta), r*sin(theta), z]
      end function at

      !> Four corners, counter-clockwise as seen from outside.
      subroutine face(a, b, c, d)
         real(wp), intent(in) :: a(3), b(3), c(3), d(3)   !! (3) the corners [mm]

         call facet(a, b, c)
         call facet(a, c, d)
      end subroutine face

      !> A triangle.
      subroutine facet(a, b, c)
         real(wp), intent(in) :: a(3), b(3), c(3)         !! (3) the corners [mm]

         real(wp) :: normal(3), p(3), q(3)

         p = b - a
         q = c - a
         normal = [p(2)*q(3) - p(3)*q(2), p(3)*q(1) - p(1)*q(3), p(1)*q(2) - p(2)*q(1)]
         normal = normal/max(norm2(normal), tiny(1.0_wp))
         call lines%line("facet normal"//words_of(normal))
         call lines%line("outer loop")
         call lines%line("vertex"//words_of(a))
         call lines%line("vertex"//words_of(b))
         call lines%line("vertex"//words_of(c))
         call lines%line("endloop")
         call lines%line("endfacet")
      end subroutine facet

      !> Three numbers.
      function words_of(p) result(words)
         real(wp), intent(in) :: p(3)             !! (3) any [any]
         character(:), allocatable :: words       !! each with a blank before it

         words = " "//real_text(p(1), 9)//" "//real_text(p(2), 9)//" "//real_text(p(3), 9)
      end function words_of

   end function stl_text

end module worn_files
