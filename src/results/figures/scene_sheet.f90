!> The sheet of a figure of the mechanism: its unit, views and cells, axes or a scale, size of the picture and of letters.
!>
!> A scene in the plane has axes with the coordinates of the world; several output times side by side have a scale, as
!> scenes in space, which have the directions of the axes above it.
module scene_sheet
   use display_units, only: display_unit_t
   use kinds, only: wp
   use plot_text, only: quoted
   use scene_names, only: names_t
   use scene_canvas, only: symbols_t
   use scene_views, only: extents_t, view_t
   use text, only: real_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: frame_lines, height_of, letter_size, scene_sheet_t, width_moving, width_still

   integer, parameter :: width_still = 1200    !! of a picture, in units of layout
   integer, parameter :: width_moving = 640    !! of an animation, in pixels

   !> Everything about one figure that its parts need.
   type :: scene_sheet_t
      type(display_unit_t) :: unit              !! of lengths
      type(symbols_t) :: symbols                !! scales
      type(extents_t) :: extents                !! of the whole picture [m]
      type(view_t), allocatable :: views(:)     !! views of a cell
      type(names_t) :: names                    !! names in the first view, none if they are off
      real(wp) :: cell(2) = 0.0_wp              !! (2) size of a cell, where several output times stand side by side [m]
      integer :: columns = 1                    !! cells beside each other
      integer :: cells = 1                      !! all of them
      logical :: is_planar = .true.             !! bodies move in the plane
      logical :: has_axes = .false.             !! coordinates of the world stand at its edges
   end type scene_sheet_t

contains

   !> Width and height of a letter of the names, in the picture.
   pure function letter_size(plot, moves) result(letter)
      logical, intent(in) :: moves                  !! of an animation
      type(scene_sheet_t), intent(in) :: plot      !! the plan
      real(wp) :: letter(2)                         !! (2) width and height [m]

      real(wp), parameter :: of_picture = 0.85_wp   ! the part of the picture within its axes [1]
      real(wp), parameter :: size_still(2) = [7.5_wp, 16.0_wp]   ! as `width_still`
      real(wp), parameter :: size_moving(2) = [6.5_wp, 13.0_wp]  ! in pixels
      integer :: width

      width = merge(width_moving, width_still, moves)
      letter = merge(size_moving, size_still, moves)
      associate (extent => plot%extents%maximum - plot%extents%minimum)
         letter = letter*maxval(extent/(of_picture*real([width, height_of(plot, width)], wp)))
      end associate
   end function letter_size

   !> Height of a picture of a width.
   pure integer function height_of(plot, width) result(height)
      type(scene_sheet_t), intent(in) :: plot    !! the plan
      integer, intent(in) :: width                !! in pixels

      associate (e => plot%extents)
         height = nint(real(width, wp)*(e%maximum(2) - e%minimum(2))/(e%maximum(1) - e%minimum(1)))
      end associate
      height = min(max(height + width/10, width*2/5), width*5/4)
   end function height_of

   !> Frame of the picture, in its unit.
   subroutine frame_lines(script, plot)
      type(buffer_t), intent(inout) :: script      !! the script
      type(scene_sheet_t), intent(in) :: plot     !! the plan

      real(wp) :: at(2), bar
      integer :: v

      call script%line("set size ratio -1")
      call script%line("set key noautotitle")
      call script%line("set style textbox opaque margins 0.4,0.4 noborder")
      associate (e => plot%extents, factor => plot%unit%factor)
         call script%line("set xrange ["//real_text(factor*e%minimum(1), 6)//":"//real_text(factor*e%maximum(1), 6)//"]")
         call script%line("set yrange ["//real_text(factor*e%minimum(2), 6)//":"//real_text(factor*e%maximum(2), 6)//"]")
         if (plot%has_axes) then
            call script%line("set xlabel "//quoted("x ["//plot%unit%symbol//"]"))
            call script%line("set ylabel "//quoted("y ["//plot%unit%symbol//"]"))
            return
         end if
         call script%line("unset grid; unset border; unset xtics; unset ytics")
         bar = round_below(0.3_wp*factor*plot%cell(1)/sqrt(real(size(plot%views), wp)))
         call script%line("set arrow from graph 0.02, graph 0.02 rto first "//real_text(bar, 3)// &
                          ", 0 heads size graph 0.004,90 linewidth 2")
         call script%line("set label "//quoted(real_text(bar, 3)//" "//plot%unit%symbol)//" at graph 0.02, graph 0.045")
         if (.not. plot%is_planar) call axes_lines(script, plot, bar)
         if (plot%cells > 1) return
         do v = 1, size(plot%views)
            at = factor*plot%views(v)%label_at
            call script%line("set label "//quoted(trim(plot%views(v)%label))//" at "//real_text(at(1), 6)//", "// &
                             real_text(at(2), 6)//" center front textcolor rgb '#808080'")
         end do
      end associate
   end subroutine frame_lines

   !> The directions of the axes x, y, z in the first view, above the scale.
   subroutine axes_lines(script, plot, bar)
      type(buffer_t), intent(inout) :: script      !! the script
      type(scene_sheet_t), intent(in) :: plot     !! the plan
      real(wp), intent(in) :: bar                  !! length of the scale [the unit shown]

      character(*), parameter :: at = "graph 0.06, graph 0.12", names = "xyz"
      real(wp) :: way(2)
      integer :: k

      do k = 1, 3
         way = 0.5_wp*bar*[plot%views(1)%right(k), plot%views(1)%up(k)]
         call script%line("set arrow from "//at//" rto first "//real_text(way(1), 4)//", first "//real_text(way(2), 4)// &
                          " size graph 0.01,20 linewidth 1.5 linecolor rgb '#606060'")
         way = 1.25_wp*way
         call script%line("set label '"//names(k:k)//"' at "//at//" offset first "//real_text(way(1), 4)//", first "// &
                          real_text(way(2), 4)//" center textcolor rgb '#606060'")
      end do
   end subroutine axes_lines

   !> The maximum of 1, 2, 5 times a power of ten that is not above a length.
   pure real(wp) function round_below(length) result(round)
      real(wp), intent(in) :: length  !! the length, positive [any]

      round = 10.0_wp**floor(log10(length))
      if (5.0_wp*round <= length) then
         round = 5.0_wp*round
      else if (2.0_wp*round <= length) then
         round = 2.0_wp*round
      end if
   end function round_below

end module scene_sheet
