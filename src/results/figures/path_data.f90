!> Paths of very many points, as orbits and portraits of long runs have: what a picture can show of them.
!>
!> Points nearer to the last one than a part of a pixel are omitted. A line that crosses the picture thousands of times would
!> fill it, and gnuplot takes minutes for it: of such a path the points are drawn. The more there is of either the more
!> transparent it is, so that where the path passes often is seen among the rest.
module path_data
   use errors, only: error_t
   use drawn_rows, only: drawn_rows_t
   use figure_data, only: curve_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: pi, wp
   use path_corners, only: corners_t
   use row_reader, only: row_reader_t
   use text_buffer, only: buffer_t
   use text_file, only: text_file_t
   use text_table, only: number_row
   implicit none (type, external)
   private
   public :: make_path, path_t

   integer, parameter :: block = 65536              !! characters that are written at once
   integer, parameter :: most_rows = 20000          !! of the run's own table that gnuplot draws as it is
   real(wp), parameter :: opaque_line = 100.0_wp    !! a line that crosses the picture less often is not transparent [1]
   real(wp), parameter :: longest_line = 3000.0_wp  !! of a line that crosses it more often the points are drawn [1]
   real(wp), parameter :: opaque_points = 1.0e5_wp  !! fewer points are not transparent [1]
   real(wp), parameter :: nearest = 5.0e-4_wp       !! distance of points, of the path's extent: half a pixel [1]
   real(wp), parameter :: most_transparent = 0.85_wp !! transparency of a very long path [1]

   !> A path for a picture.
   type :: path_t
      logical :: is_used = .false.            !! it is drawn in place of the run's own table
      logical :: is_of_chords = .false.       !! it has a corner at most rows
      character(:), allocatable :: file       !! table of two columns, beside the script
      character(2) :: alpha = ""              !! transparency, as colours of gnuplot have it
      character(:), allocatable :: style      !! how it is drawn
   end type path_t

contains

   !> Whether a path has a corner at most rows; and the table of a path with too many points for the run's own.
   subroutine make_path(folder, name, heading, rows, curve, path, error)
      character(*), intent(in) :: folder                 !! of the figures
      character(*), intent(in) :: name                   !! of the figure
      character(*), intent(in) :: heading                !! lines with `#` for the table
      type(drawn_rows_t), intent(in) :: rows             !! of the run
      type(curve_t), intent(in) :: curve                 !! the path
      type(path_t), intent(out) :: path                  !! what there is
      type(error_t), allocatable, intent(out) :: error   !! the rows cannot be read, or the table not written

      type(buffer_t) :: lines
      type(row_reader_t) :: reader
      type(text_file_t) :: table
      real(wp) :: crossings, extent(2), last(2), point(2)
      integer :: n, r
      logical :: has_last

      call find_corners(folder, rows, curve, path%is_of_chords, error)
      if (allocated(error) .or. rows%n <= most_rows) return
      call reader%open(folder, curve, error)
      if (allocated(error)) return
      path%file = name//".path.dat"
      table%path = folder//"/"//path%file
      call lines%line("# "//curve%x_label//" "//curve%y_label)
      call lines%add(heading)
      call lines%line("# path, points closer than half a pixel omitted, SI")
      extent = extent_of(curve)
      crossings = 0.0_wp
      has_last = .false.
      n = 0
      do r = 1, rows%n
         call reader%next(point, error)
         if (allocated(error)) return
         if (.not. all(ieee_is_finite(point))) then
            if (has_last) call lines%line("")
            has_last = .false.
            cycle
         end if
         if (has_last .and. any(curve%wraps .and. abs(point - last) > pi)) then
            call lines%line("")  ! from pi to -pi, or back
            has_last = .false.
         end if
         if (has_last) then
            if (all(abs(point - last) <= nearest*extent)) cycle
            crossings = crossings + maxval(abs(point - last)/max(extent, tiny(1.0_wp)))
         end if
         call lines%line(number_row(point))
         last = point
         has_last = .true.
         n = n + 1
         if (lines%length() < block) cycle
         call table%append(lines%get(), error)
         if (allocated(error)) exit
         lines = buffer_t()
      end do
      call reader%close()
      if (.not. allocated(error)) call table%append(lines%get(), error)
      path%is_used = n > 0 .and. .not. allocated(error)
      call choose_style(crossings, n, path)
   end subroutine make_path

   !> Whether a path has a corner at most rows, by its first ones.
   subroutine find_corners(folder, rows, curve, are_most, error)
      character(*), intent(in) :: folder                 !! of the figures
      type(drawn_rows_t), intent(in) :: rows             !! of the run
      type(curve_t), intent(in) :: curve                 !! the path
      logical, intent(out) :: are_most                   !! whether it is so
      type(error_t), allocatable, intent(out) :: error   !! the rows cannot be read

      type(corners_t) :: corners
      type(row_reader_t) :: reader
      real(wp) :: extent(2), point(2)
      integer :: r

      are_most = .false.
      call reader%open(folder, curve, error)
      if (allocated(error)) return
      extent = extent_of(curve)
      do r = 1, min(rows%n, most_rows)
         call reader%next(point, error)
         if (allocated(error)) return
         if (.not. all(ieee_is_finite(point))) then
            corners%n_place = 0
         else
            call corners%add(merge(point, 0.0_wp, extent > 0.0_wp)/merge(extent, 1.0_wp, extent > 0.0_wp))
         end if
      end do
      call reader%close()
      are_most = corners%are_most()
   end subroutine find_corners

   !> How far a path reaches along both axes.
   pure function extent_of(curve) result(extent)
      type(curve_t), intent(in) :: curve   !! the path
      real(wp) :: extent(2)                !! (2) SI [any]

      extent = [curve%x_range(2) - curve%x_range(1), curve%y_range(2) - curve%y_range(1)]
      if (.not. all(ieee_is_finite(extent))) extent = 0.0_wp  ! infinite numbers are omitted, and no others
   end function extent_of

   !> Line or points, and how transparent.
   subroutine choose_style(crossings, n, path)
      real(wp), intent(in) :: crossings    !! how often the line crosses the picture [1]
      integer, intent(in) :: n             !! points
      type(path_t), intent(inout) :: path  !! its style is set

      real(wp) :: fill

      if (crossings > longest_line) then
         path%style = "dots"
         fill = opaque_points/max(n, 1)
      else
         path%style = "lines linewidth 1"
         fill = opaque_line/max(crossings, 1.0_wp)
      end if
      write (path%alpha, "(z2.2)") nint(255*min(most_transparent, max(0.0_wp, 1.0_wp - fill)))
   end subroutine choose_style

end module path_data
