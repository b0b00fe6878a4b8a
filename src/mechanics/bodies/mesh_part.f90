!> The part of a drawing that a mesh of triangles is: corners at one place become one vertex, and edges that are seen become lines
!> for flat pictures.
!>
!> An edge is seen where its two triangles meet at more than 30 degrees, or where it has one triangle, or more than two. Vertices
!> and edges are found by tables of open addresses, so that the time is in proportion to the triangles.
module mesh_part
   use drawing, only: in_files, in_pictures, part_t, start_part
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: part_of_mesh

   real(wp), parameter :: same_face = 0.866_wp   !! cosine of the angle between faces from which on their edge is seen [1]

contains

   !> The part of a mesh.
   subroutine part_of_mesh(table, scale, rotation, centre, body, part)
      real(wp), intent(in) :: table(:, :)      !! (n, 9) corners of triangles [unit of the file]
      real(wp), intent(in) :: scale            !! this unit [m]
      real(wp), intent(in) :: rotation(3, 3)   !! (3, 3) turn of the mesh in the body [1]
      real(wp), intent(in) :: centre(3)        !! (3) where its origin is, own frame [m]
      integer, intent(in) :: body              !! its body
      type(part_t), intent(out) :: part        !! what is drawn

      real(wp), allocatable :: s(:, :)
      integer, allocatable :: corners(:, :), edges(:, :)
      integer :: k, n

      allocate (corners(3, size(table, 1)))
      call merge_corners(table, s, corners)
      n = size(corners, 2)
      call start_part(part, body, spread(centre, 2, size(s, 2)) + matmul(scale*rotation, s))
      call find_edges(s, corners, edges)
      deallocate (part%strokes)
      allocate (part%strokes(n + size(edges, 2)))
      do k = 1, n
         part%strokes(k)%vertices = corners(:, k)
         part%strokes(k)%is_face = .true.
         part%strokes(k)%use = in_files
      end do
      do k = 1, size(edges, 2)
         part%strokes(n + k)%vertices = edges(:, k)
         part%strokes(n + k)%use = in_pictures
      end do
   end subroutine part_of_mesh

   !> Places of corners, each once, and which of them the corners are.
   subroutine merge_corners(table, s, corners)
      real(wp), intent(in) :: table(:, :)               !! (n, 9) corners of triangles [unit of the file]
      real(wp), allocatable, intent(out) :: s(:, :)     !! (3, any) places [unit of the file]
      integer, intent(out) :: corners(:, :)             !! (3, n) numbers of the places

      real(wp), allocatable :: all(:, :)
      integer, allocatable :: slots(:)
      integer :: at, c, k, n

      allocate (all(3, 3*size(table, 1) + 1))
      allocate (slots(0:8*size(table, 1)), source=0)
      n = 0
      do k = 1, size(table, 1)
         do c = 1, 3
            all(:, n + 1) = table(k, 3*c - 2:3*c) + 0.0_wp  ! the zero with a sign is the one without
            at = int(modulo(mixed(transfer(all(:, n + 1), [0_i8])), int(size(slots), i8)))
            do while (slots(at) > 0)
               if (all_equal(all(:, slots(at)), all(:, n + 1))) exit
               at = modulo(at + 1, size(slots))
            end do
            if (slots(at) == 0) then
               n = n + 1
               slots(at) = n
            end if
            corners(c, k) = slots(at)
         end do
      end do
      s = all(:, :n)
   end subroutine merge_corners

   !> Whether two places are the same to the last bit.
   pure logical function all_equal(a, b)
      real(wp), intent(in) :: a(3)   !! (3) the one [unit of the file]
      real(wp), intent(in) :: b(3)   !! (3) the other [unit of the file]

      all_equal = .not. any(a < b .or. a > b)
   end function all_equal

   !> Words mixed to one number by shifts and exclusive or, for the place in a table.
   pure integer(i8) function mixed(words) result(h)
      integer(i8), intent(in) :: words(:)   !! (any) the words

      integer :: k

      h = 0
      do k = 1, size(words)
         h = ieor(h, words(k))
         h = ieor(h, ishft(h, -30))
         h = ieor(ishftc(h, 27), ishft(h, 9))
         h = ieor(h, ishft(h, -31))
      end do
   end function mixed

   !> Edges that are seen.
   subroutine find_edges(s, corners, edges)
      real(wp), intent(in) :: s(:, :)                     !! (3, any) vertices [m]
      integer, intent(in) :: corners(:, :)                !! (3, n) of triangles
      integer, allocatable, intent(out) :: edges(:, :)    !! (2, any) their ends

      integer, allocatable :: all(:, :), faces(:, :), slots(:)
      logical, allocatable :: is_seen(:)
      integer :: at, c, ends(2), k, n

      allocate (all(2, size(corners)), faces(3, size(corners)), slots(0:3*size(corners)), source=0)  ! the first two, and all
      n = 0
      do k = 1, size(corners, 2)
         do c = 1, 3
            ends = [corners(c, k), corners(modulo(c, 3) + 1, k)]
            ends = [minval(ends), maxval(ends)]
            if (ends(1) == ends(2)) cycle
            at = int(modulo(mixed(int(ends, i8)), int(size(slots), i8)))
            do while (slots(at) > 0)
               if (all(1, slots(at)) == ends(1) .and. all(2, slots(at)) == ends(2)) exit
               at = modulo(at + 1, size(slots))
            end do
            if (slots(at) == 0) then
               n = n + 1
               slots(at) = n
               all(:, n) = ends
            end if
            associate (of => faces(:, slots(at)))
               of(3) = of(3) + 1
               if (of(3) <= 2) of(of(3)) = k
            end associate
         end do
      end do
      is_seen = faces(3, :n) /= 2
      do k = 1, n
         if (.not. is_seen(k)) is_seen(k) = abs(dot_product(normal(faces(1, k)), normal(faces(2, k)))) < same_face
      end do
      edges = reshape(pack(all(:, :n), spread(is_seen, 1, 2)), [2, count(is_seen)])

   contains

      !> Unit normal of a triangle; zero if it has no area.
      pure function normal(k) result(u)
         integer, intent(in) :: k   !! the triangle
         real(wp) :: u(3)           !! (3) normal [1]

         real(wp) :: a(3), b(3)

         a = s(:, corners(2, k)) - s(:, corners(1, k))
         b = s(:, corners(3, k)) - s(:, corners(1, k))
         u = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
         if (norm2(u) > 0.0_wp) u = u/norm2(u)
      end function normal

   end subroutine find_edges

end module mesh_part
