!> `gudgeon fit DECK DATA ...`: parameters of a deck from measured data, with their intervals.
module verb_fit
   use channel_names, only: scalar_name, scalar_t
   use csv_table, only: csv_text
   use diagnostics, only: diagnostics_t
   use errors, only: error_t, exit_usage, set_error
   use file_store, only: keep_files
   use find_fit, only: find_parameters
   use fit_data, only: read_data
   use fit_deck, only: fit_deck_t
   use fit_info, only: fit_sensor_info, fit_set_info, fit_study_info, fit_table_info
   use fit_layout, only: layout_of
   use fit_model, only: fit_model_t
   use fit_plan, only: fit_plan_t
   use fit_plots, only: write_fit_plots
   use fit_report, only: note_fit, report_fit
   use fit_results, only: fit_t
   use fit_tables, only: table_of_correlations, table_of_data, table_of_sensors, table_of_unknowns
   use fit_words, only: plan_fit
   use gnuplot_runs, only: draw_figures, make_folder
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use read_fit, only: has_fit
   use recorder, only: status_complete
   use run_limits, only: limits_of
   use scene_echo, only: echo_scene
   use study_request, only: check_derivable, echo_of_rows, echo_of_section, open_study
   use table_file, only: write_table_file
   use table_list, only: list_of
   use text, only: text_t
   use text_file, only: replace_file
   use text_table, only: file_heading
   implicit none (type, external)
   private
   public :: fit_deck_to_data

contains

   !> Fit the parameters that the deck asks for.
   subroutine fit_deck_to_data(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck or the data, no directory, or no motion

      type(fit_deck_t), save, target :: source
      type(fit_model_t) :: model
      type(fit_t) :: fit
      type(loaded_t), save :: loaded
      type(options_t) :: alone
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(text_t), allocatable :: pictures(:), warnings(:)

      call keep_files()
      if (size(options%operands) < 2) then
         call set_error(error, exit_usage, "'gudgeon fit' needs a deck and its data: gudgeon fit FILE.deck DATA.csv [DATA.csv ...]")
         return
      end if
      alone = options
      alone%operands = options%operands(:1)
      call load_deck(alone, loaded, error)
      if (.not. allocated(error)) call check_derivable(loaded, has_fit(loaded%deck), "table [fit]", "a fit needs", error)
      if (allocated(error)) return
      allocate (warnings(0))
      call limits_of(loaded%scene, loaded%catalogue, loaded%limits, warnings)
      call set_up(options, loaded, model, fit, warnings, error)
      if (.not. allocated(error)) call open_study(options, loaded, directory, plan, warnings, error)
      if (allocated(error)) return
      source%deck%options = alone
      source%plan = model%plan
      model%source => source
      call find_parameters(model, model%plan%sensors%has(1), fit, error)
      if (.not. allocated(error)) then
         call note_fit(fit, warnings)
         call write_results(options%write, loaded, plan, fit, pictures, warnings, error)
      end if
      if (.not. allocated(error)) call report_fit(options, loaded, plan, fit, pictures, warnings, error)
      call directory%close()
   end subroutine fit_deck_to_data

   !> Unknowns, sensors and data of the model.
   subroutine set_up(options, loaded, model, fit, warnings, error)
      type(options_t), intent(in) :: options                    !! the command line
      type(loaded_t), intent(inout) :: loaded                   !! the deck
      type(fit_model_t), intent(inout) :: model                 !! all but its source is set
      type(fit_t), intent(inout) :: fit                         !! names of sensors are set
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (m) grown
      type(error_t), allocatable, intent(out) :: error          !! nothing is asked, or no data

      type(diagnostics_t) :: ignored  ! there are no errors: the tables were checked
      type(scalar_t), allocatable :: scalars(:)
      type(text_t), allocatable :: units(:)
      integer :: k

      call plan_fit(loaded%deck, loaded%catalogue, model%plan, scalars, ignored)
      if (size(scalars) == 0) then
         call set_error(error, exit_usage, "the deck has no table [fit.sensor]: nothing is compared with the data")
         return
      end if
      if (options%change%tolerance > 0.0_wp) model%plan%tolerance = options%change%tolerance
      call read_data(options, loaded%catalogue, scalars, loaded%plan%end, model%plan, model%sets, warnings, error)
      if (allocated(error)) return
      allocate (model%channels(3, size(scalars)), model%sigma(size(scalars)), model%spread(size(scalars)))
      allocate (fit%sensors(size(scalars)), units(size(scalars)))
      do k = 1, size(scalars)
         model%channels(:, k) = [scalars(k)%group, scalars(k)%component, scalars(k)%item]
         fit%sensors(k)%name = model%plan%sensors(k)%name
         fit%sensors(k)%channel = scalar_name(loaded%catalogue, scalars(k))
         units(k)%s = loaded%catalogue%groups(scalars(k)%group)%channel%unit
         fit%sensors(k)%unit = units(k)%s
         model%spread(k) = spread_of(model, k)
         model%sigma(k) = model%spread(k)
         if (model%plan%sensors(k)%has(1)) model%sigma(k) = model%plan%sensors(k)%sigma
      end do
      model%places = layout_of(model%plan, units)
      if (size(model%places) == 0) call set_error(error, exit_usage, "the deck has no unknowns: table [fit] has no rows")
   end subroutine set_up

   !> Standard deviation of the data of a sensor; 1 if they are all alike.
   pure real(wp) function spread_of(model, sensor) result(sigma)
      type(fit_model_t), intent(in) :: model     !! sets of data
      integer, intent(in) :: sensor              !! number of the sensor

      real(wp), allocatable :: x(:)
      integer :: k

      allocate (x(0))
      do k = 1, size(model%sets)
         x = [x, pack(model%sets(k)%x(sensor, :), ieee_is_finite(model%sets(k)%x(sensor, :)))]
      end do
      sigma = 0.0_wp
      if (size(x) > 0) sigma = norm2(x - sum(x)/size(x))/sqrt(real(size(x), wp))
      if (.not. sigma > 0.0_wp) sigma = 1.0_wp
   end function spread_of

   !> The files and figures.
   subroutine write_results(write, loaded, plan, fit, pictures, warnings, error)
      character(*), intent(in) :: write                          !! numbers: none of them; channels: no figures; all
      type(loaded_t), intent(inout) :: loaded                    !! the deck; defaults are noted
      type(output_plan_t), intent(in) :: plan                    !! what files say
      type(fit_t), intent(in) :: fit                             !! the fit
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(text_t), allocatable :: names(:)
      character(:), allocatable :: folder

      allocate (pictures(0))
      if (write == "numbers") return
      call replace_file(plan%directory//"/deck.echo", echo_scene(loaded%deck, loaded%scene)//echo_of_tables(loaded), error)
      if (.not. allocated(error)) then
         call write_table_file("fit.h5", "gudgeon fit", plan, status_complete, &
                               list_of(table_of_unknowns(fit), table_of_correlations(fit), table_of_sensors(fit), &
                                       table_of_data(fit)), error)
      end if
      if (.not. allocated(error)) call replace_file(plan%directory//"/fit.csv", csv_text(table_of_data(fit)), error)
      if (allocated(error) .or. write /= "all") return
      folder = plan%directory//"/figures"
      call make_folder(folder, error)
      if (.not. allocated(error)) call write_fit_plots(folder, plan%title, file_heading(plan), fit, names, error)
      if (.not. allocated(error)) call draw_figures(folder, names, pictures, warnings)
   end subroutine write_results

   !> The tables of the fit for the echo.
   function echo_of_tables(loaded) result(text)
      type(loaded_t), intent(inout) :: loaded      !! the deck; defaults are noted
      character(:), allocatable :: text            !! tables of a deck

      text = echo_of_rows(loaded, fit_table_info())
      text = text//echo_of_rows(loaded, fit_sensor_info())
      text = text//echo_of_rows(loaded, fit_set_info())
      text = text//echo_of_section(loaded, fit_study_info())
   end function echo_of_tables

end module verb_fit
