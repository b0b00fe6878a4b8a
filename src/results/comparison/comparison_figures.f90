!> Figures of a comparison: both over one another, and the difference.
module comparison_figures
   use comparison, only: comparison_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use plot_table, only: draw_dotted_lines, draw_lines, draw_points, panel_t, plot_curve_t, plot_table_t, write_plot
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: write_overlays

   integer, parameter :: most_figures = 12   !! channels that are drawn
   integer, parameter :: few = 200           !! instants up to which each is a dot

contains

   !> Figures of the channels that are furthest apart.
   subroutine write_overlays(found, folder, first, second, names, warnings, error)
      type(comparison_t), intent(in) :: found                         !! what was found
      character(*), intent(in) :: folder                              !! where they go
      character(*), intent(in) :: first                               !! what A is called
      character(*), intent(in) :: second                              !! what B is called
      type(text_t), allocatable, intent(out) :: names(:)              !! (n) figures
      type(text_t), allocatable, intent(inout) :: warnings(:)         !! (m) grown by what has nothing to draw
      type(error_t), allocatable, intent(out) :: error                !! a file cannot be written

      real(wp) :: worst(size(found%list))
      integer :: i, k
      logical :: is_written

      allocate (names(0))
      do k = 1, size(found%list)
         worst(k) = found%list(k)%maximum/max(found%list(k)%allowed, tiny(1.0_wp)*1.0e10_wp)
         if (.not. ieee_is_finite(worst(k)) .or. any(found%list(k)%only > 0)) worst(k) = huge(1.0_wp)
      end do
      do i = 1, min(most_figures, size(found%list))
         k = maxloc(worst, dim=1)
         worst(k) = -1.0_wp
         associate (name => found%list(k)%name)
            if (.not. any(ieee_is_finite(found%a(:, k)) .or. ieee_is_finite(found%b(:, k)))) then
               call append_text(warnings, "no figure of "//name//": no values in A or B")
               cycle
            end if
            call write_plot(folder, name, overlay(found, k, first, second), is_written, error)
            if (allocated(error)) return
            if (is_written) call append_text(names, name)
         end associate
      end do
   end subroutine write_overlays

   !> The figure of a channel, of which at least one has numbers. Without a difference it has one panel.
   function overlay(found, k, first, second) result(table)
      type(comparison_t), intent(in) :: found   !! what was found
      integer, intent(in) :: k                  !! number of the channel
      character(*), intent(in) :: first         !! what A is called
      character(*), intent(in) :: second        !! what B is called
      type(plot_table_t) :: table               !! the figure

      associate (d => found%list(k))
         table%name = d%name
         table%heading = ""
         table%x_name = "time"
         table%x_unit = "s"
         allocate (table%labels(0), table%categories(0), table%values(4, size(found%t)))
         allocate (table%panels(merge(2, 1, any(ieee_is_finite(found%d(:, k))))))
         call append_text(table%labels, "time [s]")
         call append_text(table%labels, "A ["//d%unit//"]")
         call append_text(table%labels, "B ["//d%unit//"]")
         call append_text(table%labels, "B - A ["//d%unit//"]")
         table%values(1, :) = found%t
         table%values(2, :) = found%a(:, k)
         table%values(3, :) = found%b(:, k)
         table%values(4, :) = found%d(:, k)
         table%panels(1)%y_unit = d%unit
         table%panels(1)%y_name = d%name
         call add_curve(table%panels(1), found%a(:, k), 2, 1, .false., "A: "//first)
         call add_curve(table%panels(1), found%b(:, k), 3, 2, size(found%t) <= few, "B: "//second)
         if (size(table%panels) < 2) return
         table%panels(2)%y_name = "B - A"
         table%panels(2)%y_unit = d%unit
         call add_curve(table%panels(2), found%d(:, k), 4, 6, .false., "")
      end associate
   end function overlay

   !> A curve over the time, if it has numbers; with dots on the line if that alone would leave some of them out.
   subroutine add_curve(panel, x, column, colour, by_dots, title)
      type(panel_t), intent(inout) :: panel      !! grown
      real(wp), intent(in) :: x(:)               !! (n) its numbers [any]
      integer, intent(in) :: column              !! of the ordinate
      integer, intent(in) :: colour              !! number of the colour
      logical, intent(in) :: by_dots             !! no line
      character(*), intent(in) :: title          !! in the legend; blank: none

      type(plot_curve_t) :: curve

      if (.not. allocated(panel%curves)) allocate (panel%curves(0))
      if (.not. any(ieee_is_finite(x))) return
      curve%style = draw_lines
      if (stands_alone(ieee_is_finite(x))) curve%style = draw_dotted_lines
      if (by_dots) curve%style = draw_points
      curve%y = column
      curve%colour = colour
      curve%title = title
      panel%curves = [panel%curves, curve]
   end subroutine add_curve

   !> Whether some number has no other one beside it.
   pure logical function stands_alone(is_number)
      logical, intent(in) :: is_number(:)   !! (n) where there is one

      logical :: padded(0:size(is_number) + 1)

      padded = .false.
      padded(1:size(is_number)) = is_number
      associate (n => size(is_number))
         stands_alone = any(padded(1:n) .and. .not. (padded(0:n - 1) .or. padded(2:n + 1)))
      end associate
   end function stands_alone

end module comparison_figures
