!> Curves that turn more often than a picture has columns: the range that they fill and their mean, in columns.
!>
!> Such a curve drawn as a line is a solid block. A turn counts if the curve has moved by a part of its range since the last one.
module envelope_data
   use errors, only: error_t
   use drawn_rows, only: drawn_rows_t
   use figure_data, only: curve_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: not_a_number, wp
   use row_reader, only: row_reader_t
   use script_parts, only: axes_t, scaled
   use text, only: append_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   implicit none (type, external)
   private
   public :: count_turns, envelope_t, make_envelope

   integer, parameter :: n_column = 290               !! columns of an envelope, three pixels each
   real(wp), parameter :: min_move = 0.1_wp           !! between two turns that count, of the range of the curve [1]

   !> The ranges of some curves of a figure.
   type :: envelope_t
      character(:), allocatable :: file     !! table, beside the script
      integer, allocatable :: numbers(:)    !! (n) curves that are drawn so, by their numbers in the figure
   contains
      procedure :: is_used
      procedure :: place => place_of_curve
      procedure :: range_source
      procedure :: mean_source
   end type envelope_t

contains

   !> Whether a curve is drawn so.
   pure logical function is_used(self)
      class(envelope_t), intent(in) :: self  !! the ranges

      is_used = .false.
      if (allocated(self%numbers)) is_used = size(self%numbers) > 0
   end function is_used

   !> Which curve of the table one of the figure is; 0: it is drawn as a line.
   pure integer function place_of_curve(self, number) result(place)
      class(envelope_t), intent(in) :: self  !! the ranges
      integer, intent(in) :: number          !! of the curve in the figure

      place = 0
      if (allocated(self%numbers)) place = findloc(self%numbers, number, dim=1)
   end function place_of_curve

   !> File and columns of a range.
   function range_source(self, place, axes) result(s)
      class(envelope_t), intent(in) :: self  !! the ranges
      integer, intent(in) :: place           !! which of them
      type(axes_t), intent(in) :: axes       !! scales of the figure
      character(:), allocatable :: s         !! for `plot`

      s = "'"//self%file//"' using "//scaled(4*place - 3, axes%x%factor, axes%less_x)//":"// &
          scaled(4*place - 2, axes%y%factor, axes%less)//":"//scaled(4*place - 1, axes%y%factor, axes%less)
   end function range_source

   !> File and columns of a mean.
   function mean_source(self, place, axes) result(s)
      class(envelope_t), intent(in) :: self  !! the ranges
      integer, intent(in) :: place           !! which of them
      type(axes_t), intent(in) :: axes       !! scales of the figure
      character(:), allocatable :: s         !! for `plot`

      s = "'"//self%file//"' using "//scaled(4*place - 3, axes%x%factor, axes%less_x)//":"// &
          scaled(4*place, axes%y%factor, axes%less)
   end function mean_source

   !> Find the curves of a figure that turn too often within what is drawn, and write their ranges.
   subroutine make_envelope(folder, name, heading, rows, curves, window, envelope, error)
      character(*), intent(in) :: folder                 !! of the figures
      character(*), intent(in) :: name                   !! of the figure
      character(*), intent(in) :: heading                !! lines with `#` for the table
      type(drawn_rows_t), intent(in) :: rows             !! of the run
      type(curve_t), intent(in) :: curves(:)             !! (n) curves of the figure
      real(wp), intent(in) :: window(2)                  !! (2) ends of the abscissa, SI [any]
      type(envelope_t), intent(out) :: envelope          !! what there is
      type(error_t), allocatable, intent(out) :: error   !! the rows cannot be read, or the table not written

      real(wp), allocatable :: tables(:, :, :)
      type(text_t), allocatable :: names(:)
      real(wp) :: table(4, n_column)
      integer :: k, n, n_turn

      envelope%file = name//".range.dat"
      allocate (envelope%numbers(0), names(0), tables(4, n_column, count(curves%turns > n_column)))
      n = 0
      do k = 1, size(curves)
         if (curves(k)%turns <= n_column .or. curves(k)%falls > 0) cycle
         call find_ranges(folder, rows, curves(k), window, table, n_turn, error)
         if (allocated(error)) return
         if (n_turn <= n_column) cycle
         n = n + 1
         tables(:, :, n) = table
         envelope%numbers = [envelope%numbers, curves(k)%number]
         call append_text(names, curves(k)%name)
      end do
      if (n > 0) call write_file(folder//"/"//envelope%file, table_text(heading, names, tables(:, :, :n)), error)
   end subroutine make_envelope

   !> How often a curve turns, small wiggles apart.
   subroutine count_turns(folder, rows, curve, n_turn, error)
      character(*), intent(in) :: folder                 !! of the figures
      type(drawn_rows_t), intent(in) :: rows             !! of the run
      type(curve_t), intent(in) :: curve                 !! the curve
      integer, intent(out) :: n_turn                     !! turns
      type(error_t), allocatable, intent(out) :: error   !! the rows cannot be read

      real(wp) :: table(4, n_column)

      n_turn = 0
      if (curve%x_range(2) > curve%x_range(1)) then
         call find_ranges(folder, rows, curve, curve%x_range, table, n_turn, error)
      end if
   end subroutine count_turns

   !> Ranges and means of a curve in columns of equal width, and how often it turns. The mean is over the abscissa.
   subroutine find_ranges(folder, rows, curve, window, table, n_turn, error)
      character(*), intent(in) :: folder              !! of the figures
      type(drawn_rows_t), intent(in) :: rows          !! of the run
      type(curve_t), intent(in) :: curve              !! the curve
      real(wp), intent(in) :: window(2)               !! (2) ends of the abscissa, SI [any]
      real(wp), intent(out) :: table(:, :)            !! (4, columns) middle, minimum, maximum value, mean; NaN: empty, SI [any]
      integer, intent(out) :: n_turn                  !! turns
      type(error_t), allocatable, intent(out) :: error !! the rows cannot be read

      type(row_reader_t) :: reader
      real(wp) :: before(2), extreme, length(size(table, 2)), least_move, point(2)
      integer :: k, n, r, direction

      n = size(table, 2)
      table(1, :) = [(window(1) + (window(2) - window(1))*(k - 0.5_wp)/n, k=1, n)]
      table(2, :) = huge(1.0_wp)
      table(3, :) = -huge(1.0_wp)
      table(4, :) = 0.0_wp
      length = 0.0_wp
      n_turn = 0
      direction = 0
      before = not_a_number()
      extreme = 0.0_wp
      least_move = min_move*(curve%y_range(2) - curve%y_range(1))
      call reader%open(folder, curve, error)
      if (allocated(error)) return
      do r = 1, rows%n
         call reader%next(point, error)
         if (allocated(error)) return
         associate (x => point(1), y => point(2))
            if (ieee_is_nan(x) .or. ieee_is_nan(y)) cycle
            if (x < window(1) .or. x > window(2)) cycle
            k = min(n, 1 + int(n*(x - window(1))/(window(2) - window(1))))
            table(2, k) = min(table(2, k), y)
            table(3, k) = max(table(3, k), y)
            if (.not. ieee_is_nan(before(1))) then
               table(4, k) = table(4, k) + 0.5_wp*(x - before(1))*(y + before(2))
               length(k) = length(k) + x - before(1)
            else
               extreme = y
            end if
            before = [x, y]
            call turn(y)
         end associate
      end do
      call reader%close()
      call smooth_mean(table(4, :), length)
      where (table(2, :) > table(3, :))
         table(2, :) = not_a_number()
         table(3, :) = not_a_number()
      end where

   contains

      !> Follow the curve from turn to turn.
      subroutine turn(y)
         real(wp), intent(in) :: y  !! the ordinate, SI [any]

         if (direction == 0) then
            if (abs(y - extreme) > least_move) then
               direction = nint(sign(1.0_wp, y - extreme))
               extreme = y
            end if
         else if ((y - extreme)*direction > 0.0_wp) then
            extreme = y
         else if (abs(y - extreme) > least_move) then
            n_turn = n_turn + 1
            direction = -direction
            extreme = y
         end if
      end subroutine turn

   end subroutine find_ranges

   !> Means over several columns each, from sums in columns.
   pure subroutine smooth_mean(sums, length)
      real(wp), intent(inout) :: sums(:)   !! (n) integrals over the columns; means on return, NaN: empty [any]
      real(wp), intent(in) :: length(:)    !! (n) widths that these are over [any]

      integer, parameter :: reach = 5  ! columns to either side
      real(wp) :: mean(size(sums))
      integer :: first, k, last

      do k = 1, size(sums)
         first = max(1, k - reach)
         last = min(size(sums), k + reach)
         mean(k) = not_a_number()
         if (sum(length(first:last)) > 0.0_wp) mean(k) = sum(sums(first:last))/sum(length(first:last))
      end do
      sums = mean
   end subroutine smooth_mean

   !> The table as text: four columns for each curve.
   function table_text(heading, names, tables) result(text)
      character(*), intent(in) :: heading         !! lines with `#`
      type(text_t), intent(in) :: names(:)        !! (n) curves
      real(wp), intent(in) :: tables(:, :, :)     !! (4, columns, n) SI [any]
      character(:), allocatable :: text           !! whole lines

      character(*), parameter :: of(4) = [character(8) :: "abscissa", "minimum", "maximum", "mean"]
      type(buffer_t) :: lines
      integer :: i, j, k

      call lines%add("#")
      do k = 1, size(names)
         do i = 1, 4
            call lines%add(" "//names(k)%s//"."//trim(of(i)))
         end do
      end do
      call lines%line("")
      call lines%add(heading)
      call lines%line("# minimum and maximum in "//to_text(size(tables, 2))//" pixel columns of the picture, SI")
      do j = 1, size(tables, 2)
         call lines%line(number_row([tables(:, j, :)])//" ")
      end do
      text = lines%get()
   end function table_text

end module envelope_data
