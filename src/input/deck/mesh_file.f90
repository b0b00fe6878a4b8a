!> Triangles of a file for display: STL, as text or binary, and OBJ.
!>
!> A file whose name ends with `.obj` is OBJ: of its lines `v` and `f` are read, others (normals, textures, groups, materials) have
!> no part in the shape; polygons are cut into triangles from their first corner, so they should be convex. Any other is STL: binary
!> if its size is that of the number of triangles in its header, else text. Normals of a file are not read; they follow from the
!> corners.
!>
!> Sources: 3D Systems (1989), StereoLithography Interface Specification; Wavefront (1995), Object Files, Advanced Visualizer
!> Manual, appendix B1. Units: those of the file.
module mesh_file
   use file_store, only: read_kept
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_fortran_env, only: int32, real32
   use kinds, only: i8, wp
   use numbers, only: number_length, read_number
   use text, only: lower, to_text
   implicit none (type, external)
   private
   public :: most_triangles, read_mesh, triangles_of_bytes

   integer, parameter :: most_triangles = 50000          !! of a deck: pages of animations hold them
   integer(i8), parameter :: largest_file = 64000000_i8  !! bytes
   integer, parameter :: head_bytes = 84, facet_bytes = 50  !! of binary STL

   !> What is read so far.
   type :: mesh_t
      real(wp), allocatable :: corners(:, :)   !! (9, capacity) corners of triangles, one after the other [unit of the file]
      integer :: n = 0                         !! triangles
      real(wp), allocatable :: vertices(:, :)  !! (3, capacity) of OBJ [unit of the file]
      integer :: n_vertex = 0                  !! of OBJ
   end type mesh_t

contains

   !> Read a file.
   subroutine read_mesh(path, table, message)
      character(*), intent(in) :: path                       !! of the file
      real(wp), allocatable, intent(out) :: table(:, :)      !! (n, 9) corners of triangles [unit of the file]
      character(:), allocatable, intent(out) :: message      !! empty: success; else what is wrong, with the line of the file

      character(:), allocatable :: bytes
      integer :: line
      logical :: is_stream

      allocate (table(0, 9))
      call read_kept(path, .true., largest_file, bytes, message, is_stream)
      if (len(message) > 0) return
      call triangles_of_bytes(bytes, lower(path(max(1, len(path) - 3):)) == ".obj", table, line, message)
      if (len(message) == 0) return
      if (line > 0) message = to_text(line)//": "//message
      if (line == 0) message = " "//message
      message = path//":"//message
   end subroutine read_mesh

   !> The triangles of a file's content.
   subroutine triangles_of_bytes(bytes, is_obj, table, line, message)
      character(*), intent(in) :: bytes                      !! content of the file
      logical, intent(in) :: is_obj                          !! OBJ, not STL
      real(wp), allocatable, intent(out) :: table(:, :)      !! (n, 9) corners of triangles [unit of the file]
      integer, intent(out) :: line                           !! where something is wrong; 0: in the whole file
      character(:), allocatable, intent(out) :: message      !! empty: success; else what is wrong

      type(mesh_t) :: mesh
      integer(i8) :: n

      line = 0
      message = ""
      allocate (mesh%corners(9, 256), mesh%vertices(3, 256))
      n = -1
      if (.not. is_obj .and. len(bytes) >= head_bytes) n = count_of(bytes)
      if (n >= 0 .and. head_bytes + facet_bytes*n == len(bytes)) then
         call read_binary(bytes, n, mesh, message)
      else if (.not. is_obj .and. .not. is_text(bytes)) then
         message = "not an STL file: it is not text, and "//to_text(len(bytes))// &
                   " bytes do not hold the number of triangles in its header"
      else
         call read_lines(bytes, is_obj, mesh, line, message)
      end if
      if (len(message) == 0 .and. mesh%n == 0) message = "it has no triangles"
      if (len(message) > 0) mesh%n = 0
      table = transpose(mesh%corners(:, :mesh%n))
   end subroutine triangles_of_bytes

   !> Whether content is text that STL begins with.
   pure logical function is_text(bytes)
      character(*), intent(in) :: bytes   !! content of a file

      is_text = index(lower(adjustl(bytes(:min(len(bytes), 80)))), "solid") == 1 .and. index(bytes, achar(0)) == 0
   end function is_text

   !> The number of triangles in the header of binary STL, low byte first.
   pure integer(i8) function count_of(bytes) result(n)
      character(*), intent(in) :: bytes   !! content of the file, with its header

      integer :: k

      n = 0
      do k = 84, 81, -1
         n = 256*n + ichar(bytes(k:k))
      end do
   end function count_of

   !> Binary STL: of each triangle normal, three corners, two bytes of attributes.
   subroutine read_binary(bytes, n, mesh, message)
      character(*), intent(in) :: bytes                      !! content of the file
      integer(i8), intent(in) :: n                           !! triangles
      type(mesh_t), intent(inout) :: mesh                    !! receives them
      character(:), allocatable, intent(inout) :: message    !! what is wrong

      real(wp) :: corners(9)
      integer :: at, c, k

      if (n > most_triangles) message = too_many(n)
      if (n > most_triangles) return
      do k = 1, int(n)
         do c = 1, 9
            at = head_bytes + facet_bytes*(k - 1) + 8 + 4*c
            corners(c) = float_of(bytes(at + 1:at + 4))
         end do
         if (.not. all(ieee_is_finite(corners))) then
            message = "triangle "//to_text(k)//" has a coordinate that is not finite"
            return
         end if
         call add_triangle(corners, mesh)
      end do
   end subroutine read_binary

   !> A number in single precision, low byte first.
   pure real(wp) function float_of(bytes) result(x)
      character(4), intent(in) :: bytes   !! as in the file

      integer(int32) :: bits
      integer :: k

      bits = 0
      do k = 1, 4
         bits = ior(bits, ishft(int(ichar(bytes(k:k)), int32), 8*(k - 1)))
      end do
      x = real(transfer(bits, 1.0_real32), wp)
   end function float_of

   !> Files of lines.
   subroutine read_lines(bytes, is_obj, mesh, line, message)
      character(*), intent(in) :: bytes                      !! content of the file
      logical, intent(in) :: is_obj                          !! OBJ, not STL
      type(mesh_t), intent(inout) :: mesh                    !! receives the triangles
      integer, intent(out) :: line                           !! number of the last line
      character(:), allocatable, intent(inout) :: message    !! what is wrong in it

      integer :: first, last, n_corner

      line = 0
      first = 1
      n_corner = 0
      do while (first <= len(bytes) .and. len(message) == 0)
         last = index(bytes(first:), new_line("a")) + first - 2
         if (last < first - 1) last = len(bytes)
         line = line + 1
         if (is_obj) then
            call read_obj_line(cleaned(bytes(first:last)), mesh, message)
         else
            call read_stl_line(cleaned(bytes(first:last)), n_corner, mesh, message)
         end if
         first = last + 2
      end do
      if (len(message) == 0 .and. n_corner > 0) message = "the file ends within a facet"
      if (len(message) == 0) line = 0
   end subroutine read_lines

   !> A line without tabs and the end of a line of DOS, its first character not blank.
   pure function cleaned(line) result(s)
      character(*), intent(in) :: line      !! as in the file
      character(:), allocatable :: s        !! with blanks only

      integer :: k

      s = line
      do k = 1, len(s)
         if (iachar(s(k:k)) < 32) s(k:k) = " "
      end do
      s = trim(adjustl(s))
   end function cleaned

   !> A line of STL.
   subroutine read_stl_line(line, n_corner, mesh, message)
      character(*), intent(in) :: line                       !! cleaned
      integer, intent(inout) :: n_corner                     !! corners of the facet so far
      type(mesh_t), intent(inout) :: mesh                    !! grows by a triangle with the third corner
      character(:), allocatable, intent(inout) :: message    !! what is wrong

      real(wp), allocatable :: x(:)

      select case (lower(line(:index(line//" ", " ") - 1)))
      case ("vertex")
         call read_numbers(line(7:), x, message)
         if (len(message) == 0 .and. size(x) /= 3) message = "a vertex has three coordinates, here "//to_text(size(x))
         if (len(message) == 0 .and. n_corner == 3) message = "a fourth vertex in a facet: facets are triangles"
         if (len(message) > 0) return
         n_corner = n_corner + 1
         if (n_corner == 1) call add_triangle([x, x, x], mesh)
         mesh%corners(3*n_corner - 2:3*n_corner, mesh%n) = x
         if (mesh%n > most_triangles) message = too_many(int(mesh%n, i8))
      case ("endfacet")
         if (n_corner /= 3) message = "a facet has three vertices, here "//to_text(n_corner)
         n_corner = 0
      case ("", "solid", "facet", "outer", "endloop", "endsolid")
         continue
      case default
         message = "not a line of STL: '"//line(:min(len(line), 40))//"'"
      end select
   end subroutine read_stl_line

   !> A line of OBJ.
   subroutine read_obj_line(line, mesh, message)
      character(*), intent(in) :: line                       !! cleaned
      type(mesh_t), intent(inout) :: mesh                    !! grows
      character(:), allocatable, intent(inout) :: message    !! what is wrong

      real(wp), allocatable :: larger(:, :), x(:)
      integer, allocatable :: list(:)
      integer :: k

      select case (line(:index(line//" ", " ") - 1))
      case ("v")
         call read_numbers(line(2:), x, message)
         if (len(message) == 0 .and. size(x) < 3) message = "a vertex has three coordinates, here "//to_text(size(x))
         if (len(message) > 0) return
         if (mesh%n_vertex == size(mesh%vertices, 2)) then
            allocate (larger(3, 2*mesh%n_vertex))
            larger(:, :mesh%n_vertex) = mesh%vertices
            call move_alloc(larger, mesh%vertices)
         end if
         mesh%n_vertex = mesh%n_vertex + 1
         mesh%vertices(:, mesh%n_vertex) = x(:3)
      case ("f")
         call read_corners(line(2:), mesh%n_vertex, list, message)
         if (len(message) == 0 .and. size(list) < 3) message = "a face has at least three corners, here "//to_text(size(list))
         if (len(message) > 0) return
         do k = 2, size(list) - 1
            call add_triangle([mesh%vertices(:, list(1)), mesh%vertices(:, list(k)), mesh%vertices(:, list(k + 1))], mesh)
         end do
         if (mesh%n > most_triangles) message = too_many(int(mesh%n, i8))
      case default
         continue
      end select
   end subroutine read_obj_line

   !> The numbers of a line.
   subroutine read_numbers(line, x, message)
      character(*), intent(in) :: line                       !! blanks between numbers
      real(wp), allocatable, intent(out) :: x(:)             !! (any) the numbers [unit of the file]
      character(:), allocatable, intent(inout) :: message    !! what is wrong

      integer :: at, last
      logical :: is_good
      real(wp) :: number

      allocate (x(0))
      last = 0
      do
         at = last + verify(line(last + 1:), " ")
         if (at == last) return
         last = at + scan(line(at:)//" ", " ") - 2
         is_good = number_length(line(at:last)) == last - at + 1
         if (is_good) call read_number(line(at:last), 0, number, is_good)
         if (.not. is_good) then
            message = "not a finite number: '"//line(at:min(last, at + 40))//"'"
            return
         end if
         x = [x, number]
      end do
   end subroutine read_numbers

   !> Corners of a face of OBJ, as `3`, `3/1`, `3//2` or, from the last vertex so far, `-1`.
   subroutine read_corners(line, n_vertex, list, message)
      character(*), intent(in) :: line                       !! blanks between corners
      integer, intent(in) :: n_vertex                        !! vertices so far
      integer, allocatable, intent(out) :: list(:)           !! (any) their vertices
      character(:), allocatable, intent(inout) :: message    !! what is wrong

      integer :: at, last, number, status

      allocate (list(0))
      last = 0
      do
         at = last + verify(line(last + 1:), " ")
         if (at == last) return
         last = at + scan(line(at:)//" ", " ") - 2
         associate (word => line(at:at + scan(line(at:last)//"/", "/") - 2))
            status = 1
            if (verify(word, "-0123456789") == 0 .and. len(word) > 0 .and. len(word) < 10) read (word, *, iostat=status) number
            if (status == 0 .and. number < 0) number = n_vertex + 1 + number
            if (status /= 0) number = 0
            if (number < 1 .or. number > n_vertex) then
               message = "'"//line(at:min(last, at + 40))//"' is none of the "//to_text(n_vertex)//" vertices before this line"
               return
            end if
         end associate
         list = [list, number]
      end do
   end subroutine read_corners

   !> Append a triangle.
   subroutine add_triangle(corners, mesh)
      real(wp), intent(in) :: corners(9)   !! (9) three corners [unit of the file]
      type(mesh_t), intent(inout) :: mesh  !! grows

      real(wp), allocatable :: larger(:, :)

      if (mesh%n == size(mesh%corners, 2)) then
         allocate (larger(9, 2*mesh%n))
         larger(:, :mesh%n) = mesh%corners
         call move_alloc(larger, mesh%corners)
      end if
      mesh%n = mesh%n + 1
      mesh%corners(:, mesh%n) = corners
   end subroutine add_triangle

   !> What is said of a mesh that is too large.
   function too_many(n) result(message)
      integer(i8), intent(in) :: n             !! its triangles so far
      character(:), allocatable :: message     !! with the limit

      message = to_text(n)//" triangles or more (allowed "//to_text(most_triangles)//"): save it with fewer triangles"
   end function too_many

end module mesh_file
