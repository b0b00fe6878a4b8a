!> `gudgeon life DECK`: wear over many cycles, by jumps between simulations, with its interval.
!>
!> What simulations give is in the journal as soon as it is (`life_journal`): a life of the same deck into the same directory
!> continues from there. What was reached when a simulation fails is written too.
module verb_life
   use csv_table, only: csv_text
   use deck_rates, only: deck_rates_t
   use errors, only: error_t
   use file_store, only: keep_files
   use gnuplot_runs, only: draw_figures, make_folder
   use kinds, only: wp
   use life_ends, only: rate_of_end
   use life_journal, only: life_journal_t
   use life_jumps, only: find_life
   use life_plots, only: write_life_plots
   use life_report, only: report_life
   use life_results, only: life_t
   use life_setup, only: check_request, set_up_life
   use life_tables, only: table_of_budget, table_of_jumps, table_of_life, table_of_surfaces_at_end, tables_of_life_profiles
   use load, only: load_deck, loaded_t
   use options, only: options_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete, status_failed
   use result_table, only: result_table_t
   use run_place, only: directory_of
   use run_plan, only: tell_origin
   use scene_echo, only: echo_scene
   use sweep_journal, only: differences, origin_of_sweep_t
   use sweep_work, only: origin_of_sweep
   use table_file, only: write_table_file
   use table_list, only: append_tables, list_of
   use text, only: text_t
   use text_file, only: replace_file
   use text_table, only: file_heading
   use wear_tables, only: tables_of_wear
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: live_deck

contains

   !> Find the life of a deck.
   subroutine live_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, no directory, or a simulation failed

      type(deck_rates_t) :: source
      type(error_t), allocatable :: late_error
      type(life_t) :: life
      type(loaded_t), save :: loaded
      type(origin_of_sweep_t) :: origin
      type(output_plan_t) :: plan
      type(text_t), allocatable :: pictures(:), warnings(:)
      type(worn_surface_t), allocatable :: surfaces(:)

      call keep_files()
      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_request(loaded, error)
      if (allocated(error)) return
      origin = origin_of_sweep(options, loaded)
      call source%directory%open(directory_of(options, loaded), error, goes_on=is_of(directory_of(options, loaded), origin))
      if (allocated(error)) return
      warnings = source%directory%warnings
      call set_up_life(options, loaded, source, surfaces, warnings)
      plan%directory = source%directory%path
      plan%title = loaded%scene%title
      call tell_origin(options, loaded, plan)
      call plan%complete()
      call source%journal%read(plan%directory)  ! once more: the directory is ours only now
      source%journal%origin = origin
      call source%journal%begin(plan%directory, error)
      if (.not. allocated(error)) then
         call source%display%start(.not. options%is_quiet)
         call find_life(source%plan, surfaces, source, life, error)
         call source%display%finish()
         if (life%n > 0) then
            call end_life(life)
            call write_results(loaded, plan, life, trim(merge(status_failed//"  ", status_complete, allocated(error))), pictures, &
                               warnings, late_error)
            if (.not. allocated(late_error)) call report_life(options, loaded, plan, life, source%n_made, pictures, warnings, &
                                                              error, late_error)
         end if
      end if
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
      call source%directory%close()
   end subroutine live_deck

   !> Whether a directory holds an earlier life of the same.
   logical function is_of(path, origin)
      character(*), intent(in) :: path                     !! the directory
      type(origin_of_sweep_t), intent(in) :: origin        !! what the life is of

      type(life_journal_t) :: journal

      call journal%read(path)
      is_of = journal%is_there
      if (is_of) is_of = differences(journal%origin, origin) == ""
   end function is_of

   !> The interval of the cycles: that of the depth or clearance that ended the life, over their rate.
   subroutine end_life(life)
      type(life_t), intent(inout) :: life    !! the life

      real(wp) :: half, rate

      if (life%last == 0) life%last = life%n
      if (life%ends_by_cycles) return
      call rate_of_end(life, rate, half)
      if (rate > 0.0_wp) life%cycles_half = half/rate
   end subroutine end_life

   !> The files and figures.
   subroutine write_results(loaded, plan, life, state, pictures, warnings, error)
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(output_plan_t), intent(in) :: plan                    !! what files say
      type(life_t), intent(in) :: life                           !! the life
      character(*), intent(in) :: state                          !! complete, or failed
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(result_table_t), allocatable :: tables(:)
      type(text_t), allocatable :: names(:)
      type(worn_surface_t), allocatable :: worn(:)
      character(:), allocatable :: folder

      allocate (pictures(0))
      worn = life%state%worn(life%nodes(life%last)%x)
      call replace_file(plan%directory//"/deck.echo", echo_scene(loaded%deck, loaded%scene), error)
      if (.not. allocated(error)) then
         tables = list_of(table_of_life(life), table_of_surfaces_at_end(life), table_of_budget(life), table_of_jumps(life))
         call append_tables(tables, tables_of_life_profiles(life))
         call append_tables(tables, tables_of_wear(worn))
         call write_table_file("life.h5", "gudgeon life", plan, state, tables, error)
      end if
      if (.not. allocated(error)) call replace_file(plan%directory//"/life.csv", csv_text(table_of_jumps(life)), error)
      if (allocated(error)) return
      folder = plan%directory//"/figures"
      call make_folder(folder, error)
      if (.not. allocated(error)) call write_life_plots(folder, plan%title, file_heading(plan), life, names, error)
      if (.not. allocated(error)) call draw_figures(folder, names, pictures, warnings)
   end subroutine write_results

end module verb_life
