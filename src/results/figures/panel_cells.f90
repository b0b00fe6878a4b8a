!> Where the panels of a figure stand in its picture: plots of equal height, however many rows their legends have.
module panel_cells
   use curve_panels, only: panel_t
   use envelope_data, only: envelope_t
   use kinds, only: wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: cell_heights, cell_words, picture_height

   integer, parameter :: title_height = 50    !! above all panels, in units of layout
   integer, parameter :: label_height = 55    !! of what stands below the abscissa of the last, in units of layout
   integer, parameter :: row_height = 28      !! of a legend, in units of layout
   integer, parameter :: letter_width = 12    !! as gnuplot reckons a legend, in units of layout
   integer, parameter :: sample_letters = 7   !! of a column of a legend beside its longest name
   integer, parameter :: plot_width = 996     !! in units of layout

contains

   !> Heights of panels with their legends.
   pure function cell_heights(panels, envelope, usual) result(heights)
      type(panel_t), intent(in) :: panels(:)    !! (n) the panels
      type(envelope_t), intent(in) :: envelope  !! ranges of curves that turn too often
      integer, intent(in) :: usual              !! height of the picture if each legend has one row, in units of layout
      integer :: heights(size(panels))          !! (n) in units of layout

      integer :: k, n

      n = size(panels)
      do k = 1, n
         heights(k) = (usual - title_height - label_height)/n + row_height*(legend_rows(panels(k), envelope) - 1)
      end do
      heights(n) = heights(n) + label_height
   end function cell_heights

   !> Rows of a legend: as many columns as the longest name leaves space for.
   pure integer function legend_rows(panel, envelope) result(rows)
      type(panel_t), intent(in) :: panel        !! what is drawn
      type(envelope_t), intent(in) :: envelope  !! ranges of curves that turn too often

      integer :: columns, entries, k, longest

      entries = size(panel%curves) + merge(1, 0, size(panel%ideal) > 0)
      longest = len("ideal joints")
      do k = 1, size(panel%curves)
         if (envelope%place(panel%curves(k)%number) > 0) entries = entries + 1  ! its mean
         longest = max(longest, len(panel%curves(k)%name) + merge(len(", range"), 0, envelope%place(panel%curves(k)%number) > 0) &
                       + merge(len(" (right)"), 0, panel%side(k) == 2))
      end do
      columns = max(1, plot_width/(letter_width*(longest + sample_letters)))
      rows = max(1, (entries + columns - 1)/columns)
   end function legend_rows

   !> Height of the whole picture.
   pure integer function picture_height(heights)
      integer, intent(in) :: heights(:)  !! (n) of the panels, in units of layout

      picture_height = title_height + sum(heights)
   end function picture_height

   !> Size and place of a panel, for gnuplot.
   function cell_words(heights, k) result(words)
      integer, intent(in) :: heights(:)        !! (n) of the panels, in units of layout
      integer, intent(in) :: k                 !! which of them
      character(:), allocatable :: words       !! as `set size 1,0.4; set origin 0,0.5`

      real(wp) :: whole

      whole = real(picture_height(heights), wp)
      words = "set size 1,"//real_text(real(heights(k), wp)/whole, 6)//"; set origin 0,"// &
              real_text(real(sum(heights(k + 1:)), wp)/whole, 6)
   end function cell_words

end module panel_cells
