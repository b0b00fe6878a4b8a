!> `gudgeon compare A B`: a run against another run, or against columns of another program.
module verb_compare
   use channel_spec, only: parse_spec, spec_t
   use comparison, only: compare_histories, comparison_t
   use comparison_figures, only: write_overlays
   use comparison_report, only: comparison_json, comparison_text, verdict_text
   use comparison_tables, only: table_of_channels
   use console, only: say
   use csv_table, only: csv_text
   use errors, only: error_t, exit_different, exit_file, exit_usage, set_error
   use external_columns, only: read_external
   use gnuplot_runs, only: draw_figures, make_folder
   use kinds, only: wp
   use options, only: options_t
   use output_directory, only: output_directory_t
   use posix, only: path_exists
   use run_history, only: read_run
   use series, only: history_t
   use source_text, only: line_of, n_line_of, read_source, source_t
   use sweep_comparison, only: compare_cases
   use text, only: append_text, counted, lower, starts_with, text_t, to_text
   use text_file, only: replace_file
   implicit none (type, external)
   private
   public :: compare_runs

   real(wp), parameter :: usual = 1.0e-6_wp   !! difference allowed, of a channel's maximum magnitude [1]

contains

   !> Compare, write, and say; exit code 1 if something differs.
   subroutine compare_runs(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! nothing to compare, or a difference

      type(comparison_t) :: found
      type(history_t) :: a, b
      type(spec_t) :: time
      type(spec_t), allocatable :: specs(:)
      type(text_t), allocatable :: notes(:)
      character(:), allocatable :: first, second
      real(wp) :: relative

      if (size(options%operands) /= 2) then
         call set_error(error, exit_usage, "'gudgeon compare' needs two arguments: a run, and a run or a file of columns"// &
                        new_line("a")//"  = gudgeon compare outputs/NAME legacy.csv --channel ""slider.position.x=2 unit=mm""")
         return
      end if
      if (any([is_sweep(options%operands(1)%s), is_sweep(options%operands(2)%s)])) then
         call compare_sweeps(options, error)
         return
      end if
      allocate (notes(0))
      first = run_file(options%operands(1)%s)
      second = run_file(options%operands(2)%s)
      call gather_specs(options, specs, time, error)
      if (.not. allocated(error)) call read_run(first, a, error)
      if (allocated(error)) then
         if (.not. is_run(first) .and. is_run(second)) error%message = error%message//new_line("a")// &
            "  = give the run first, the file of columns second"
         return
      end if
      if (is_run(second)) then
         call read_run(second, b, error)
         if (.not. allocated(error)) call shift_time(b, time)
         if (.not. allocated(error)) call adapt(b, specs, error)
      else
         call read_external(second, specs, time, a, b, notes, error)
      end if
      if (allocated(error)) return
      relative = options%legacy%relative
      if (relative < 0.0_wp) relative = usual
      call compare_histories(a, b, specs, options%legacy%absolute, relative, options%legacy%by_statistics, found, error)
      if (.not. allocated(error)) call write_results(options, found, first, second, notes, error)
      if (.not. allocated(error) .and. found%n_different > 0) call set_error(error, exit_different, "different: "// &
            verdict_text(found))
   end subroutine compare_runs

   !> Whether a path is the directory of a sweep.
   logical function is_sweep(path)
      character(*), intent(in) :: path         !! of the command line

      is_sweep = path_exists(path//"/sweep.h5") .and. .not. path_exists(path//"/run.h5")
   end function is_sweep

   !> Compare the cases of two sweeps and say what differs.
   subroutine compare_sweeps(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! nothing to compare, or a difference

      type(text_t), allocatable :: lines(:)
      real(wp) :: relative
      integer :: k, n_different

      associate (first => options%operands(1)%s, second => options%operands(2)%s)
         if (.not. (is_sweep(first) .and. is_sweep(second))) then
            call set_error(error, exit_usage, "a sweep can be compared with another sweep only"//new_line("a")// &
                           "  = give the directories of two sweeps, or of two runs")
            return
         end if
         relative = options%legacy%relative
         if (relative < 0.0_wp) relative = usual
         call compare_cases(first, second, options%legacy%absolute, relative, lines, n_different, error)
      end associate
      if (allocated(error)) return
      if (.not. options%is_quiet) then
         do k = 1, size(lines)
            call say(lines(k)%s)
         end do
      end if
      if (n_different > 0) call set_error(error, exit_different, "different: "//lines(size(lines))%s)
   end subroutine compare_sweeps

   !> The run.h5 of a directory; a file as it is.
   function run_file(path) result(file)
      character(*), intent(in) :: path         !! of the command line
      character(:), allocatable :: file        !! what is read

      file = path
      if (path_exists(path//"/run.h5")) file = path//"/run.h5"
   end function run_file

   !> Whether a file is taken as a run.
   pure logical function is_run(path)
      character(*), intent(in) :: path  !! of the file

      is_run = .false.
      if (len(path) > 3) is_run = lower(path(len(path) - 2:)) == ".h5"
   end function is_run

   !> What is asked for, from the command line and the table.
   subroutine gather_specs(options, specs, time, error)
      type(options_t), intent(in) :: options               !! the command line
      type(spec_t), allocatable, intent(out) :: specs(:)   !! (n) channels
      type(spec_t), intent(out) :: time                    !! the time
      type(error_t), allocatable, intent(out) :: error     !! an error in one of them

      type(source_t) :: source
      type(spec_t) :: one
      character(:), allocatable :: line, message, time_text
      integer :: at, k

      allocate (specs(0))
      time_text = ""
      if (allocated(options%legacy%time)) time_text = options%legacy%time
      do k = 1, size(options%legacy%channels)
         call parse_spec(options%legacy%channels(k)%s, .false., one, error)
         if (allocated(error)) return
         specs = [specs, one]
      end do
      if (allocated(options%legacy%table)) then
         call read_source(options%legacy%table, source, message, may_be_stream=.true.)
         if (message /= "") call set_error(error, exit_file, "cannot read '"//options%legacy%table//"': "//message)
         do k = 1, n_line_of(source)
            if (allocated(error)) return
            line = trim(adjustl(line_of(source, k)))
            at = index(line, "#")
            if (at > 0) line = trim(line_before(line, at))
            if (line == "") cycle
            if (starts_with(line, "time") .and. scan(line(5:), "= ") == 1) then
               if (time_text == "") time_text = behind_sign(line)
               cycle
            end if
            call parse_spec(line, .false., one, error)
            if (allocated(error)) error%message = error%message//new_line("a")//"  = "//options%legacy%table//", line "//to_text(k)
            if (.not. allocated(error)) specs = [specs, one]
         end do
      end if
      if (.not. allocated(error)) call parse_spec(time_text, .true., time, error)
   end subroutine gather_specs

   !> A line before its comment.
   pure function line_before(line, at) result(part)
      character(*), intent(in) :: line         !! the line
      integer, intent(in) :: at                !! where the comment starts
      character(:), allocatable :: part        !! what is before it

      part = line(:at - 1)
   end function line_before

   !> The last part of a path.
   pure function behind_slash(path) result(part)
      character(*), intent(in) :: path         !! of a directory
      character(:), allocatable :: part        !! its own name

      part = path(index(path, "/", back=.true.) + 1:)
   end function behind_slash

   !> What stands behind the first equals sign.
   pure function behind_sign(line) result(part)
      character(*), intent(in) :: line         !! `time = ...`
      character(:), allocatable :: part        !! the rest

      part = trim(adjustl(line(index(line, "=") + 1:)))
   end function behind_sign

   !> Shift and scale the time of a run.
   subroutine shift_time(history, time)
      type(history_t), intent(inout) :: history   !! the run
      type(spec_t), intent(in) :: time            !! how

      integer :: k

      history%time = time%scale*history%time + time%offset
      do k = 1, size(history%impacts)
         history%impacts(k)%time = time%scale*history%impacts(k)%time + time%offset
      end do
      do k = 1, size(history%list)
         if (.not. allocated(history%list(k)%extreme_at)) cycle
         history%list(k)%extreme_at = time%scale*history%list(k)%extreme_at + time%offset
      end do
   end subroutine shift_time

   !> Scale, shift and turn the channels of a run as asked for.
   subroutine adapt(history, specs, error)
      type(history_t), intent(inout) :: history            !! the run
      type(spec_t), intent(in) :: specs(:)                 !! (n) channels
      type(error_t), allocatable, intent(out) :: error     !! columns of a run

      character(2), parameter :: axes(3) = [".x", ".y", ".z"]
      real(wp), allocatable :: x(:, :)
      integer :: c, k, place(3), s

      do s = 1, size(specs)
         if (size(specs(s)%columns) > 0) then
            call set_error(error, exit_usage, "option --channel of a run names channels, not columns: write --channel "// &
               specs(s)%channel)
            return
         end if
         place = 0
         do k = 1, size(history%list)
            do c = 1, 3
               if (history%list(k)%name == specs(s)%channel//axes(c)) place(c) = k
            end do
            if (.not. (history%list(k)%name == specs(s)%channel .or. &
                       starts_with(history%list(k)%name, specs(s)%channel//"."))) cycle
            history%list(k)%x = specs(s)%scale*history%list(k)%x + specs(s)%offset
            if (allocated(history%list(k)%extreme)) then
               history%list(k)%extreme = specs(s)%scale*history%list(k)%extreme + specs(s)%offset
            end if
         end do
         if (any(place(:2) == 0) .or. .not. is_turned(specs(s)%turn)) cycle
         allocate (x(size(history%time), 3), source=0.0_wp)
         do c = 1, 3
            if (place(c) > 0) x(:, c) = history%list(place(c))%x
         end do
         x = matmul(x, transpose(specs(s)%turn))
         do c = 1, 3
            if (place(c) == 0) cycle
            history%list(place(c))%x = x(:, c)
            if (allocated(history%list(place(c))%extreme)) deallocate (history%list(place(c))%extreme)
         end do
         deallocate (x)
      end do
   end subroutine adapt

   !> Whether axes are turned at all.
   pure logical function is_turned(turn)
      real(wp), intent(in) :: turn(3, 3)       !! (3, 3) the turn [1]

      real(wp), parameter :: unit(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])

      is_turned = any(abs(turn - unit) > 0.0_wp)
   end function is_turned

   !> Files, figures, and what is said.
   subroutine write_results(options, found, first, second, notes, error)
      type(options_t), intent(in) :: options               !! the command line
      type(comparison_t), intent(in) :: found              !! what was found
      character(*), intent(in) :: first                    !! where A was read
      character(*), intent(in) :: second                   !! where B was read
      type(text_t), intent(in) :: notes(:)                 !! (m) what is said of the columns
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written

      type(output_directory_t) :: directory
      type(text_t), allocatable :: names(:), pictures(:), warnings(:)
      character(:), allocatable :: folder, object, text
      integer :: k

      call directory%open(directory_of(options, first), error)
      if (allocated(error)) return
      warnings = directory%warnings
      do k = 1, size(notes)
         call append_text(warnings, notes(k)%s)
      end do
      allocate (pictures(0))
      folder = directory%path//"/figures"
      call make_folder(folder, error)
      if (.not. allocated(error)) call write_overlays(found, folder, first, second, names, warnings, error)
      if (.not. allocated(error)) call draw_figures(folder, names, pictures, warnings)
      text = comparison_text(found, first, second)//"output     "//directory%path//"/"//new_line("a")
      do k = 1, size(warnings)
         text = text//"warning: "//warnings(k)%s//new_line("a")
      end do
      object = comparison_json(found, first, second, directory%path, pictures, warnings)
      if (.not. allocated(error)) then
         call replace_file(directory%path//"/compare.csv", csv_text(table_of_channels(found), with_units=.false.), error)
      end if
      if (.not. allocated(error)) call replace_file(directory%path//"/summary.txt", text, error)
      if (.not. allocated(error)) call replace_file(directory%path//"/summary.json", object//new_line("a"), error)
      call directory%close()
      if (allocated(error)) return
      if (options%is_json) then
         call say(object)
      else if (.not. options%is_quiet) then
         call say(text(:len(text) - 1))
      end if
   end subroutine write_results

   !> Where the results go: beside those of the first run.
   function directory_of(options, first) result(directory)
      type(options_t), intent(in) :: options       !! the command line
      character(*), intent(in) :: first            !! file of the first run
      character(:), allocatable :: directory       !! of the comparison

      character(:), allocatable :: place
      integer :: slash

      if (allocated(options%directory)) then
         directory = options%directory
         return
      end if
      place = first
      slash = index(place, "/", back=.true.)
      if (slash > 1) then
         place = line_before(place, slash)
         place = behind_slash(place)
      else
         place = "run"
      end if
      directory = "outputs/"//place//"_compare"
   end function directory_of

end module verb_compare
