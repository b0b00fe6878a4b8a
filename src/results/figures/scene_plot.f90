!> Figures of the mechanism by gnuplot: strokes in a `.dat` file, and the script that draws them.
!>
!> The file has a block for each style, and of an animation one such group for each picture; they are read by `index`. Several
!> instants stand side by side, to one scale.
module scene_plot
   use catalogue, only: catalogue_t
   use display_units, only: choose_unit, display_unit_t
   use drawing, only: drawing_t
   use errors, only: error_t
   use figure_words, only: figure_animation, figure_coupler, figure_mechanism, figure_strip, figure_t
   use frames, only: frame_t
   use groups_of_catalogue, only: group_bodies
   use kinds, only: wp
   use motion_words, only: names_if_few, names_on
   use path_corners, only: chord_words, corners_t
   use plot_text, only: quoted
   use scene_legends, only: short_legend, time_text
   use scene_names, only: add_names, count_names, start_names
   use scene_sheet, only: frame_lines, height_of, letter_size, scene_sheet_t, width_moving, width_still
   use scene_canvas, only: canvas_t, n_style, style_arrow, style_body, style_ground, style_hole, style_journal, style_line, &
      style_name, style_path, style_pin, style_symbol
   use scene_strokes, only: draw_scene
   use scene_views, only: lay_out_views, projected, view_t
   use script_parts, only: preamble
   use symbol_scales, only: arrow_tips, largest_force, new_symbols
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use tracks, only: track_t
   implicit none (type, external)
   private
   public :: write_scene_plot

   integer, parameter :: line_still = 3        !! width of lines of bodies in a picture
   integer, parameter :: line_moving = 2       !! the same in an animation
   integer, parameter :: most_names = 24       !! of a picture with names by default
   integer, parameter :: seconds_moving = 6    !! that an animation takes, about

contains

   !> Write data and script of a figure.
   subroutine write_scene_plot(folder, title, figure, catalogue, drawing, list, track, error)
      character(*), intent(in) :: folder                  !! of the figures
      character(*), intent(in) :: title                   !! of the scene, any text
      type(figure_t), intent(in) :: figure                !! the figure
      type(catalogue_t), intent(in) :: catalogue          !! what was recorded
      type(drawing_t), intent(in) :: drawing              !! the scene
      type(frame_t), intent(in) :: list(:)                !! (1 or more) frames
      type(track_t), intent(in) :: track                  !! path of a point, or none
      type(error_t), allocatable, intent(out) :: error    !! a file cannot be written

      type(buffer_t) :: data, script
      type(scene_sheet_t) :: plot
      type(track_t) :: path
      logical :: has_style(n_style)

      if (figure%kind == figure_coupler) path = track
      call plan_plot(figure, catalogue, drawing, list, path, plot)
      call write_data(figure, drawing, list, path, plot, data, has_style)
      if (figure%kind == figure_animation) then
         call moving_script(figure, title, list, plot, has_style, script)
      else
         call still_script(figure, title, list, plot, has_chords(path), has_style, script)
      end if
      call write_file(folder//"/"//figure%name//".dat", data%get(), error)
      if (allocated(error)) return
      call write_file(folder//"/"//figure%name//".gp", script%get(), error)
   end subroutine write_scene_plot

   !> Scales, views and cells.
   subroutine plan_plot(figure, catalogue, drawing, list, path, plot)
      type(figure_t), intent(in) :: figure          !! the figure
      type(catalogue_t), intent(in) :: catalogue    !! what was recorded
      type(drawing_t), intent(in) :: drawing        !! the scene
      type(frame_t), intent(in) :: list(:)          !! (1 or more) frames
      type(track_t), intent(in) :: path             !! path of a point, or none
      type(scene_sheet_t), intent(out) :: plot     !! the plan

      real(wp), parameter :: narrowest = 0.7_wp  ! width of a picture over its height [1]
      real(wp) :: lacking
      integer :: first, rows
      logical :: with_names

      if (figure%kind == figure_mechanism) plot%cells = size(list)
      call new_symbols(catalogue, drawing, list, plot%symbols)
      first = merge(size(list), 1, figure%kind == figure_strip)  ! of the frames that are drawn with their forces
      if (figure%kind == figure_strip) plot%symbols%force = largest_force(plot%symbols, list(first:))  ! as drawn
      if (figure%kind == figure_coupler) plot%symbols%force = 0.0_wp
      call lay_out_views(drawing, list, path, arrow_tips(drawing, plot%symbols, list(first:)), &
                         plot%cells > 1 .or. figure%kind == figure_animation, plot%views, plot%extents)
      lacking = narrowest*(plot%extents%maximum(2) - plot%extents%minimum(2)) - (plot%extents%maximum(1) - plot%extents%minimum(1))
      if (lacking > 0.0_wp) then
         plot%extents%minimum(1) = plot%extents%minimum(1) - 0.5_wp*lacking
         plot%extents%maximum(1) = plot%extents%maximum(1) + 0.5_wp*lacking
      end if
      plot%unit = choose_unit("m", maxval(plot%extents%maximum - plot%extents%minimum))
      plot%is_planar = .not. drawing%is_spatial
      plot%has_axes = plot%cells == 1 .and. size(plot%views) == 1 .and. .not. drawing%is_spatial
      plot%symbols%scale = plot%unit%factor
      plot%cell = plot%extents%maximum - plot%extents%minimum
      plot%columns = ceiling(sqrt(real(plot%cells, wp)*plot%cell(2)/plot%cell(1)))
      plot%columns = max(1, min(plot%cells, plot%columns))
      rows = (plot%cells + plot%columns - 1)/plot%columns
      plot%extents%maximum(1) = plot%extents%minimum(1) + plot%columns*plot%cell(1)
      plot%extents%minimum(2) = plot%extents%maximum(2) - rows*plot%cell(2)
      allocate (plot%names%list(0))
      with_names = figure%motion%names == names_on
      associate (bodies => catalogue%item_groups(group_bodies)%names)
         if (figure%motion%names == names_if_few) with_names = count_names(drawing, bodies) <= most_names
         if (with_names) call start_names(drawing, bodies, plot%symbols%size, &
                                          letter_size(plot, figure%kind == figure_animation), plot%names)
      end associate
   end subroutine plan_plot

   !> All strokes.
   subroutine write_data(figure, drawing, list, path, plot, data, has_style)
      type(figure_t), intent(in) :: figure          !! the figure
      type(drawing_t), intent(in) :: drawing        !! the scene
      type(frame_t), intent(in) :: list(:)          !! (1 or more) frames
      type(track_t), intent(in) :: path             !! path of a point, or none
      type(scene_sheet_t), intent(inout) :: plot   !! the plan; where names stand is kept
      type(buffer_t), intent(inout) :: data         !! the file
      logical, intent(out) :: has_style(n_style)    !! which styles occur

      type(canvas_t) :: canvas
      type(view_t) :: view
      real(wp) :: paleness
      integer :: f, k, v

      has_style = .false.
      call data%line("# strokes of "//figure%name//": x ["//plot%unit%symbol//"], y ["//plot%unit%symbol//"], colour")
      do f = 1, size(list)
         if (f == 1 .or. figure%kind == figure_animation) canvas = canvas_t()
         paleness = 0.0_wp
         if (figure%kind == figure_strip) paleness = 0.65_wp*real(size(list) - f, wp)/real(max(size(list) - 1, 1), wp)
         do v = 1, size(plot%views)
            view = plot%views(v)
            if (plot%cells > 1) view%shift = view%shift + plot%cell*[real(mod(f - 1, plot%columns), wp), &
                                                                     -real((f - 1)/plot%columns, wp)]
            if (f == 1 .or. figure%kind == figure_animation) call draw_path(path, view, plot%symbols%scale, canvas)
            call draw_scene(drawing, list(f), view, plot%symbols, paleness, figure%kind /= figure_strip .or. f == size(list), &
                            canvas)
         end do
         if (size(plot%names%list) > 0 .and. f == merge(size(list), f, figure%kind == figure_strip) .and. &
             (f == 1 .or. figure%kind /= figure_mechanism)) then  ! of several output times at the first
            call add_names(plot%names, list(f), plot%views(1), plot%symbols, plot%extents, canvas)
         end if
         if (f < size(list) .and. figure%kind /= figure_animation) cycle
         do k = 1, n_style
            has_style(k) = has_style(k) .or. canvas%styles(k)%length() > 0
            if (canvas%styles(k)%length() == 0) then  ! one point, beyond the picture, keeps the blocks in their order
               associate (e => plot%extents)
                  call data%line(real_text(plot%unit%factor*(2.0_wp*e%minimum(1) - e%maximum(1)), 6)//" "// &
                                 real_text(plot%unit%factor*(2.0_wp*e%minimum(2) - e%maximum(2)), 6)//" 0")
               end associate
               call data%line("")
            else
               call data%add(canvas%styles(k)%get())
            end if
            call data%line("")
         end do
      end do
   end subroutine write_data

   !> Whether a path has a corner at most rows.
   pure logical function has_chords(path)
      type(track_t), intent(in) :: path   !! the path, perhaps none

      type(corners_t) :: corners
      integer :: k

      do k = 1, path%n
         call corners%add(path%x(:, k))
      end do
      has_chords = corners%are_most()
   end function has_chords

   !> The path of a point.
   subroutine draw_path(path, view, scale, canvas)
      type(track_t), intent(in) :: path          !! the path, perhaps none
      type(view_t), intent(in) :: view           !! the view
      real(wp), intent(in) :: scale              !! numbers of the picture over lengths [any/m]
      type(canvas_t), intent(inout) :: canvas    !! gets lines

      real(wp) :: p(2)
      integer :: k

      if (path%n == 0) return
      do k = 1, path%n
         p = scale*projected(view, path%x(:, k))
         call canvas%styles(style_path)%line(real_text(p(1), 7)//" "//real_text(p(2), 7)//" 0")
      end do
      call canvas%styles(style_path)%line("")
   end subroutine draw_path

   !> The plot command.
   subroutine plot_lines(script, name, first, width, has_style)
      type(buffer_t), intent(inout) :: script       !! the script
      character(*), intent(in) :: name              !! of the figure
      character(*), intent(in) :: first             !! number of the first block
      integer, intent(in) :: width                  !! of the lines of bodies, in pixels
      logical, intent(in) :: has_style(n_style)     !! which styles occur

      character(64) :: how(n_style)
      integer :: k, last

      how(style_ground) = "lines linewidth 1.2 linecolor rgb '#707070'"
      how(style_body) = "filledcurves closed fillcolor rgb '#e4ebf2'"
      how(style_line) = "lines linewidth "//to_text(width)//" linecolor rgb variable"
      how(style_path) = "lines linewidth 1.6 linecolor rgb '#d1495b'"
      how(style_pin) = "filledcurves closed fillcolor rgb '#ffffff'"
      how(style_symbol) = "lines linewidth 1.6 linecolor rgb '#404040'"
      how(style_hole) = "filledcurves closed fillcolor rgb '#fff4d6'"
      how(style_journal) = "filledcurves closed fillcolor rgb '#9fb4c7'"
      how(style_name) = "labels center font ',"//to_text(merge(12, 9, width == line_still))//"' textcolor rgb variable"
      how(style_arrow) = "lines linewidth 2.5 linecolor rgb variable"
      last = findloc(has_style, .true., dim=1, back=.true.)
      call script%line("plot \")
      do k = 1, n_style
         if (.not. has_style(k)) cycle
         call script%add("  '"//name//".dat' index "//first//"+"//to_text(k - 1)//" using 1:2")
         if (k == style_name) call script%add(":4")
         if (index(how(k), "variable") > 0) call script%add(":3")
         call script%add(" with "//trim(how(k)))
         if (index(how(k), "filled") > 0) call script%add(" fillstyle solid border linecolor rgb '#404040'")
         call script%line(merge(", \", "   ", k < last))
      end do
   end subroutine plot_lines

   !> A picture.
   subroutine still_script(figure, title, list, plot, is_of_chords, has_style, script)
      type(figure_t), intent(in) :: figure          !! the figure
      character(*), intent(in) :: title             !! of the scene, any text
      type(frame_t), intent(in) :: list(:)          !! (1 or more) frames
      type(scene_sheet_t), intent(in) :: plot      !! the plan
      logical, intent(in) :: is_of_chords           !! the path has a corner at most rows
      logical, intent(in) :: has_style(n_style)     !! which styles occur
      type(buffer_t), intent(inout) :: script       !! the script

      character(:), allocatable :: words
      real(wp) :: at(2)
      integer :: f

      call preamble(script, figure%name, width_still, height_of(plot, width_still))
      call script%line("set title "//quoted(title)//" font ',17'")
      call frame_lines(script, plot)
      words = short_legend(plot%symbols)
      if (figure%kind == figure_coupler) words = "path of "//figure%motion%point
      if (is_of_chords) words = words//", "//chord_words
      if (plot%cells == 1 .and. figure%kind /= figure_coupler) then
         if (len(words) > 0) words = ",  "//words
         if (figure%kind == figure_strip) then
            words = to_text(size(list))//" positions, the last at "//time_text(list(size(list))%t)//words
         else
            words = "t = "//time_text(list(1)%t)//words
         end if
      end if
      call script%line("set label "//quoted(words)//" at graph 0.02, graph 0.965 front boxed font ',13'")
      if (plot%cells > 1) then
         do f = 1, size(list)
            at = [plot%extents%minimum(1), plot%extents%maximum(2)] + &
                 plot%cell*[real(mod(f - 1, plot%columns), wp) + 0.05_wp, -real((f - 1)/plot%columns, wp) - 0.14_wp]
            call script%line("set label "//quoted("t = "//time_text(list(f)%t))//" at "//real_text(plot%unit%factor*at(1), 6)// &
                             ", "//real_text(plot%unit%factor*at(2), 6)//" front font ',13'")
         end do
      end if
      call plot_lines(script, figure%name, "0", line_still, has_style)
      call script%line("unset output")
   end subroutine still_script

   !> An animation.
   subroutine moving_script(figure, title, list, plot, has_style, script)
      type(figure_t), intent(in) :: figure          !! the figure
      character(*), intent(in) :: title             !! of the scene, any text
      type(frame_t), intent(in) :: list(:)          !! (1 or more) frames
      type(scene_sheet_t), intent(in) :: plot      !! the plan
      logical, intent(in) :: has_style(n_style)     !! which styles occur
      type(buffer_t), intent(inout) :: script       !! the script

      type(display_unit_t) :: unit
      integer :: f

      call script%line("# Edit this script and run it here again:  gnuplot "//figure%name//".gp")
      call script%line("reset")
      call script%line("set encoding utf8")
      call script%line("set terminal gif animate delay "//to_text(max(3, 100*seconds_moving/size(list)))// &
                       " loop 0 noenhanced size "//to_text(width_moving)//","//to_text(height_of(plot, width_moving))// &
                       " font ""DejaVu Sans,11""")
      call script%line("set output '"//figure%name//".gif'")
      call script%line("set title "//quoted(title)//" font ',12'")
      call script%line("set tics nomirror")
      call script%line("set grid linetype 1 linewidth 0.7 linecolor rgb '#dcdcdc'")
      call frame_lines(script, plot)
      if (len(short_legend(plot%symbols)) > 0) then
         call script%line("set label "//quoted(short_legend(plot%symbols))//" at graph 0.02, graph 0.96 front boxed")
      end if
      unit = choose_unit("s", list(size(list))%t)
      call script%add("times = '")
      do f = 1, size(list)
         call script%add(real_text(unit%factor*list(f)%t, 4)//" ")
      end do
      call script%line("'")
      call script%line("do for [f=0:"//to_text(size(list) - 1)//"] {")
      call script%line("set label 99 't = '.word(times, f + 1).' "//unit%symbol//"' at graph 0.985, graph 0.96 right front boxed")
      call plot_lines(script, figure%name, "f*"//to_text(n_style), line_moving, has_style)
      call script%line("}")
      call script%line("unset output")
   end subroutine moving_script

end module scene_plot
