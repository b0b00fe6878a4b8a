!> Finished figures at the end of a run: one gnuplot script each, and the picture it draws.
!>
!> gnuplot is started directly, with fixed file names made of the deck's checked names; text of the
!> deck reaches it only inside single-quoted strings of the scripts. That gnuplot is not installed,
!> fails, takes too long or leaves no whole picture is a warning: the scripts stay.
module figures
   use animation_page, only: page_text
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use curve_panels, only: shows_nothing
   use curve_script, only: curve_text
   use drawing, only: drawing_t
   use envelope_data, only: count_turns, envelope_t, make_envelope
   use errors, only: error_t
   use extremes, only: extremes_t
   use field_plot, only: write_field_plot
   use drawn_rows, only: drawn_rows_t
   use figure_data, only: curve_t, find_curves
   use figure_words, only: draws_mechanism, figure_animation, figure_film, figure_histogram, figure_history, figure_portrait, &
      figure_section, figure_spectrum, figure_t, figure_wear, is_of_run
   use frames, only: frame_keeper_t
   use gnuplot_runs, only: draw_figures, make_folder, moving
   use film_fields, only: film_field_t
   use plot_table, only: plot_table_t, tell_empty, write_plot
   use kinds, only: wp
   use page_plots, only: plots_text
   use path_data, only: make_path, path_t
   use path_script, only: figure_text, path_of
   use scene_plot, only: write_scene_plot
   use text, only: append_text, text_t
   use text_file, only: write_file
   use wear_plot, only: write_wear_plot
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: make_figures

   character(*), parameter :: ideal_suffix = ".ideal"  !! of the files of the reference run with ideal joints

contains

   !> Write the scripts of all figures and draw them.
   subroutine make_figures(directory, title, list, catalogue, extremes, rows, ideal_rows, tables, fields, worn, drawing, keeper, &
                           pictures, warnings, error)
      character(*), intent(in) :: directory                        !! of the run
      character(*), intent(in) :: title                            !! of the scene, any text
      type(figure_t), intent(in) :: list(:)                        !! (n) figures
      type(catalogue_t), intent(in) :: catalogue                   !! what was recorded
      type(extremes_t), intent(in) :: extremes                     !! what is round-off
      type(drawn_rows_t), intent(in) :: rows                       !! numbers of curves
      type(drawn_rows_t), intent(in) :: ideal_rows                 !! those of the reference run with ideal joints
      type(plot_table_t), intent(in) :: tables(:)                  !! (n) numbers of those that are no histories
      type(film_field_t), intent(in) :: fields(:)                  !! (any) films
      type(worn_surface_t), intent(in) :: worn(:)                  !! (any) worn surfaces
      type(drawing_t), intent(in) :: drawing                       !! what the scene looks like
      type(frame_keeper_t), intent(in) :: keeper                   !! pictures of its motion
      type(text_t), allocatable, intent(out) :: pictures(:)        !! (m) pictures made, paths within the directory
      type(text_t), allocatable, intent(out) :: warnings(:)        !! (k) what was not made, and why
      type(error_t), allocatable, intent(out) :: error             !! a script cannot be written

      type(text_t), allocatable :: empty(:), names(:), pages(:)
      integer :: i, k
      logical :: is_written

      allocate (pictures(0), warnings(0), names(0), pages(0))
      if (.not. any([(is_of_run(list(k)), k=1, size(list))])) return
      call make_folder(directory//"/figures", error)
      if (allocated(error)) return
      do k = 1, size(list)
         if (any([(names(i)%s == file_of(list(k)), i=1, size(names))]) .or. .not. is_of_run(list(k))) cycle
         if (draws_mechanism(list(k))) then
            call write_scene(directory//"/figures", title, list, k, catalogue, extremes, rows, drawing, keeper, is_written, pages, &
                             error)
         else if (list(k)%kind == figure_film) then
            call write_field_plot(directory//"/figures", title, tables(k)%heading, list(k)%name, fields, is_written, error)
         else if (list(k)%kind == figure_wear) then
            call write_wear_plot(directory//"/figures", title, tables(k)%heading, list(k)%name, list(k)%arguments(1)%s, worn, &
                                 is_written, error)
         else if (list(k)%kind > figure_portrait) then
            call write_plot(directory//"/figures", title, tables(k), is_written, error, empty)
            call tell_empty(list(k)%word, empty, warnings)
         else
            call write_curves(directory//"/figures", title, tables(k)%heading, list(k), catalogue, extremes, rows, ideal_rows, &
                              is_written, warnings, error)
         end if
         if (allocated(error)) return
         if (is_written) then
            call append_text(names, file_of(list(k)))
         else if (list(k)%kind /= figure_film) then  ! of a film that is missing the recorder reports
            call append_text(warnings, "figure "//list(k)%word//": no values to draw: "//why_nothing(list(k)))
         end if
      end do
      call draw_figures(directory//"/figures", names, pictures, warnings)
      do k = 1, size(pages)
         call append_text(pictures, pages(k)%s)
      end do
   end subroutine make_figures

   !> Why a figure has nothing to draw.
   pure function why_nothing(figure) result(reason)
      type(figure_t), intent(in) :: figure     !! the figure
      character(:), allocatable :: reason      !! a few words

      select case (figure%kind)
      case (figure_section)
         reason = "the run has no complete drive period after the transient (`after` and `period` in [statistics])"
      case (figure_spectrum)
         reason = "it needs two output times after the transient (`after` in [statistics]), with a value at each"
      case (figure_histogram)
         reason = "the run has no impact after the transient (`after` in [statistics])"
      case (figure_wear)
         reason = "the joint does not wear in this run"
      case default
         reason = "the output times shown have no values (`from` and `last` in [output], the end of the run)"
      end select
   end function why_nothing

   !> What a figure is called among the pictures: those that move by the name of their file.
   pure function file_of(figure) result(name)
      type(figure_t), intent(in) :: figure     !! the figure
      character(:), allocatable :: name        !! without the ending of a picture that stands still

      name = figure%name
      if (figure%kind == figure_animation) name = name//moving
   end function file_of

   !> Time histories, orbits and portraits.
   subroutine write_curves(folder, title, heading, figure, catalogue, extremes, rows, ideal_rows, is_written, warnings, error)
      character(*), intent(in) :: folder                  !! of the figures
      character(*), intent(in) :: title                   !! of the scene, any text
      character(*), intent(in) :: heading                 !! lines with `#` for a table
      type(figure_t), intent(in) :: figure                !! the figure
      type(catalogue_t), intent(in) :: catalogue          !! what was recorded
      type(extremes_t), intent(in) :: extremes            !! what is round-off
      type(drawn_rows_t), intent(in) :: rows              !! numbers of the run
      type(drawn_rows_t), intent(in) :: ideal_rows        !! those of the reference run with ideal joints
      logical, intent(out) :: is_written                  !! there are numbers to draw
      type(text_t), allocatable, intent(inout) :: warnings(:)  !! (any) what is not drawn, and why
      type(error_t), allocatable, intent(out) :: error    !! the script cannot be written

      type(curve_t), allocatable :: curves(:), ideal(:)
      type(envelope_t) :: envelope
      type(path_t) :: thinned
      character(:), allocatable :: script
      real(wp) :: window(2)
      integer :: n_turn

      is_written = .false.
      call find_curves(figure, catalogue, extremes, rows, "", curves)
      call find_curves(figure, catalogue, extremes, ideal_rows, ideal_suffix, ideal)
      if (figure%kind == figure_history .and. size(curves) > 0) then
         window = window_of(figure, curves, ideal)
         call make_envelope(folder, figure%name, heading, rows, curves, window, envelope, error)
         if (allocated(error)) return
         script = curve_text(figure, catalogue, title, curves, ideal, window, envelope)
         call tell_missing(figure, catalogue, curves, warnings)
         if (shows_nothing(figure, catalogue, curves)) then
            call append_text(warnings, "figure "//figure%word//": no values in the axis range")
         end if
      else
         n_turn = 0
         if (size(curves) > 0 .and. figure%kind == figure_portrait) then
            call count_turns(folder, rows, curves(1), n_turn, error)
            if (allocated(error)) return
            call make_path(folder, figure%name, heading, rows, curves(1), thinned, error)
         else if (size(curves) > 1) then
            call make_path(folder, figure%name, heading, rows, path_of(curves), thinned, error)
         end if
         if (allocated(error)) return
         script = figure_text(figure, catalogue, title, curves, ideal, n_turn, thinned)
      end if
      is_written = len(script) > 0
      if (is_written) call write_file(folder//"/"//figure%name//".gp", script, error)
   end subroutine write_curves

   !> Ends of the abscissa of curves: what is asked for, the time of the run, or all values of another channel.
   pure function window_of(figure, curves, ideal) result(window)
      type(figure_t), intent(in) :: figure    !! the figure
      type(curve_t), intent(in) :: curves(:)  !! (n) curves of the run
      type(curve_t), intent(in) :: ideal(:)   !! (m) curves of the reference run with ideal joints
      real(wp) :: window(2)                   !! (2) SI [any]

      window = [minval(curves%x_range(1)), maxval(curves%x_range(2))]
      if (figure%curves%abscissa > 0) then
         window = [min(window(1), minval(ideal%x_range(1))), max(window(2), maxval(ideal%x_range(2)))]
      end if
      if (figure%curves%x%has_range) window = figure%curves%x%range
   end function window_of

   !> Warn of each channel of a figure that has no numbers beside others that have some.
   subroutine tell_missing(figure, catalogue, curves, warnings)
      type(figure_t), intent(in) :: figure                     !! the figure
      type(catalogue_t), intent(in) :: catalogue               !! what was recorded
      type(curve_t), intent(in) :: curves(:)                   !! (n) curves of the run
      type(text_t), allocatable, intent(inout) :: warnings(:)  !! (any) what is not drawn, and why

      integer :: k

      do k = 1, size(figure%scalars)
         if (k == figure%curves%abscissa .or. any(curves%number == k)) cycle
         call append_text(warnings, "figure "//figure%word//": no values of "//scalar_name(catalogue, figure%scalars(k)))
      end do
   end subroutine tell_missing

   !> A figure of the mechanism, and of an animation its page.
   subroutine write_scene(folder, title, figures, number, catalogue, extremes, rows, drawing, keeper, is_written, pages, error)
      character(*), intent(in) :: folder                         !! of the figures
      character(*), intent(in) :: title                          !! of the scene, any text
      type(figure_t), intent(in) :: figures(:)                   !! (n) all figures of the run
      integer, intent(in) :: number                              !! of this one
      type(catalogue_t), intent(in) :: catalogue                 !! what was recorded
      type(extremes_t), intent(in) :: extremes                   !! what is round-off
      type(drawn_rows_t), intent(in) :: rows                     !! numbers of curves
      type(drawing_t), intent(in) :: drawing                     !! what the scene looks like
      type(frame_keeper_t), intent(in) :: keeper                 !! pictures of its motion
      logical, intent(out) :: is_written                         !! the run came to its instants
      type(text_t), allocatable, intent(inout) :: pages(:)       !! (any) pages written
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      character(:), allocatable :: plots
      integer :: k, n_in_loop, n_left_out

      is_written = .false.
      associate (figure => figures(number))
         k = findloc([(keeper%plan%wanted(k)%name == figure%name .and. keeper%n(k) > 0, k=1, size(keeper%n))], .true., dim=1)
         if (k == 0) return
         is_written = .true.
         associate (list => keeper%frames(:keeper%n(k), k), plan => keeper%plan)
            n_in_loop = size(list)
            if (plan%wanted(k)%repeats .and. list(n_in_loop)%t > plan%end - plan%every) n_in_loop = max(1, n_in_loop - 1)
            call write_scene_plot(folder, title, figure, catalogue, drawing, list(:n_in_loop), keeper%tracks(k), error)
            if (allocated(error) .or. figure%kind /= figure_animation) return
            call plots_text(folder, figures, catalogue, extremes, rows, [list(1)%t, list(size(list))%t], plots, n_left_out, error)
            if (allocated(error)) return
            call write_file(folder//"/"//figure%name//".html", &
                            page_text(title, catalogue, drawing, list, n_in_loop < size(list), keeper%tracks(k), plots, &
                                      n_left_out), error)
         end associate
         call append_text(pages, "figures/"//figure%name//".html")
      end associate
   end subroutine write_scene

end module figures
