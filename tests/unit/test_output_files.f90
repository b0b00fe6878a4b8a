!> The files of a run, written and read back; the directory they are in; writes that fail.
module test_output_files
   use catalogue, only: catalogue_t
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t, exit_file
   use hdf5, only: h5dclose_f, h5dget_space_f, h5dopen_f, h5dread_f, h5fclose_f, h5fopen_f, h5sclose_f
   use hdf5, only: h5sget_simple_extent_dims_f, h5f_acc_rdonly_f, h5t_native_double, hid_t, hsize_t
   use kinds, only: not_a_number, wp
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t, show_nothing
   use output_scene, only: clean_scratch, fill_scene, is_absent, make_scene, read_whole, scratch_directory
   use posix, only: make_directory, path_exists
   use recorder, only: event_t, status_complete, summary_t
   use run_recorder, only: run_recorder_t
   use text, only: split_blank
   use text_file, only: replace_file, text_file_t, write_file
   implicit none (type, external)
   private
   public :: run_test_output_files

   integer, parameter :: n_samples = 300  !! more than two blocks

contains

   subroutine run_test_output_files(suite)
      type(suite_t), intent(inout) :: suite  !! tests of the program

      call suite%test("text_files_hold_the_run", text_files_hold_the_run)
      call suite%test("hdf5_holds_the_run", hdf5_holds_the_run)
      call suite%test("the_twin_lies_beside", the_twin_lies_beside)
      call suite%test("an_older_run_is_kept_once", an_older_run_is_kept_once)
      call suite%test("a_second_run_is_refused", a_second_run_is_refused)
      call suite%test("foreign_files_are_left_alone", foreign_files_are_left_alone)
      call suite%test("a_full_disk_is_an_error", a_full_disk_is_an_error)
   end subroutine run_test_output_files

   !> Record a short run.
   subroutine record(place, channels, suffix, error)
      character(*), intent(in) :: place                  !! directory
      character(*), intent(in) :: channels               !! blank-separated words
      character(*), intent(in) :: suffix                 !! of the names of files
      type(error_t), allocatable, intent(out) :: error   !! what failed

      type(run_recorder_t) :: keeper
      type(catalogue_t) :: scene
      type(event_t) :: event
      type(summary_t) :: summary
      integer :: k

      call make_scene(scene)
      keeper%plan%directory = place
      keeper%plan%title = "A 'title' with `backticks`"//new_line("a")//"!and a second line"
      keeper%plan%origin%deck_text = "deck = 1"
      keeper%plan%channels = split_blank(channels)
      keeper%plan%suffix = suffix
      keeper%plan%with%hdf5 = len_trim(suffix) == 0
      keeper%plan%with%summary = keeper%plan%with%hdf5
      keeper%plan%with%progress = .false.
      keeper%plan%show = show_nothing
      call keeper%start(scene, error)
      if (allocated(error)) return
      do k = 0, n_samples - 1
         call fill_scene(scene, 1.0e-3_wp*k)
         call keeper%sample(1.0e-3_wp*k, scene, error)
         if (allocated(error)) return
         if (mod(k, 100) /= 50) cycle
         event%time = 0.5_wp - 1.0e-3_wp*k
         event%kind = "contact"
         event%item = "guide"
         event%contact = "A"
         event%duration = not_a_number()
         call keeper%event(event, error)
         if (allocated(error)) return
      end do
      summary%status = status_complete
      summary%quality%energy_residual_max = not_a_number()
      summary%count%events = 3
      call keeper%finish(summary, error)
   end subroutine record

   !> A line of a text.
   function line_of(text, number) result(line)
      character(*), intent(in) :: text      !! whole lines
      integer, intent(in) :: number         !! from 1; negative: from the end
      character(:), allocatable :: line     !! without its end, blank if there is none

      integer :: at, k, last

      line = ""
      if (number < 0) then
         at = index(text(1:len(text) - 1), new_line("a"), back=.true.)
         line = text(at + 1:len(text) - 1)
         return
      end if
      last = 0
      do k = 1, number
         at = last + 1
         last = index(text(at:), new_line("a"))
         if (last == 0) return
         last = at + last - 1
      end do
      line = text(at:last - 1)
   end function line_of

   subroutine text_files_hold_the_run(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(:), allocatable :: first, last, place, text
      real(wp) :: row(4)

      place = scratch_directory("text")
      call record(place, "slider.velocity guide.A.penetration guide.A.state gudgeon.state energy.*", "", error)
      if (allocated(error)) return
      text = read_whole(place//"/slider.dat")
      call check_equal(error, line_of(text, 2), "# A 'title' with `backticks` !and a second line", "title")
      call check_equal(error, line_of(text, 1), "# time[s] slider.velocity.x[m/s] slider.velocity.y[m/s]", "names of columns")
      text = line_of(text, -1)
      call check_equal(error, len(text), 74, "length of a row")
      read (text, *) row(1:3)
      call check_close(error, row(1:3), [0.299_wp, 221*1.299_wp, 222*1.299_wp], 1.0e-12_wp, "last row")
      call check_equal(error, line_of(read_whole(place//"/guide.dat"), 1), &
                       "# time[s] guide.A.penetration[m] guide.A.state[1]", "of a contact")
      text = read_whole(place//"/events.dat")
      first = line_of(text, 6)
      last = line_of(text, -1)
      read (first(1:25), *) row(1)
      read (last(1:25), *) row(2)
      call check_close(error, row(1:2), [0.25_wp, 0.45_wp], 1.0e-12_wp, "events by time")
      call check_true(error, index(last, " contact guide A - - ") > 0, "words of an event")
      call check_true(error, is_absent(place//"/crank.dat"), "no file for what is not chosen")
      text = read_whole(place//"/summary.json")
      call check_true(error, index(text, """energy_residual_max"": null") > 0, "NaN is null")
      call check_true(error, index(text, "`backticks`\n!and a") > 0, "strings are escaped")
      call clean_scratch(place)
   end subroutine text_files_hold_the_run

   subroutine hdf5_holds_the_run(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(:), allocatable :: place
      integer(hid_t) :: dataset, file, space
      integer(hsize_t) :: dims(3), most(3)
      real(wp), allocatable :: values(:, :, :)
      integer :: status

      place = scratch_directory("hdf5")
      call record(place, "slider.velocity.x crank.angle", "", error)
      if (allocated(error)) return
      call h5fopen_f(place//"/run.h5", h5f_acc_rdonly_f, file, status)
      call check_equal(error, status, 0, "run.h5 can be opened")
      if (allocated(error)) return
      call h5dopen_f(file, "bodies/velocity", dataset, status)
      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_dims_f(space, dims, most, status)
      call check_equal(error, status, 3, "rank")
      call check_close(error, real(dims, wp), [2.0_wp, 2.0_wp, real(n_samples, wp)], 0.0_wp, &
                       "shape (union of the items)")
      if (allocated(error)) return
      allocate (values(2, 2, n_samples))
      call h5dread_f(dataset, h5t_native_double, values, dims, status)
      call check_close(error, [values(1, 1, 1), values(2, 2, n_samples)], [211.0_wp, 222*1.299_wp], 1.0e-12_wp, &
                       "values")
      call h5sclose_f(space, status)
      call h5dclose_f(dataset, status)
      call h5fclose_f(file, status)
      call clean_scratch(place)
   end subroutine hdf5_holds_the_run

   subroutine the_twin_lies_beside(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(:), allocatable :: place

      place = scratch_directory("twin")
      call record(place, "slider.velocity no.such.channel", ".ideal", error)
      call check_true(error, path_exists(place//"/slider.ideal.dat"), "file of the twin")
      call check_true(error, is_absent(place//"/run.h5"), "no HDF5 of the twin")
      call check_true(error, is_absent(place//"/summary.json"), "no summary of the twin")
      call clean_scratch(place)
   end subroutine the_twin_lies_beside

   subroutine an_older_run_is_kept_once(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(output_directory_t) :: directory
      character(:), allocatable :: place
      integer :: k

      place = scratch_directory("older")
      do k = 1, 3
         call directory%open(place//"/deep/run/", error)
         if (allocated(error)) return
         call write_file(directory%path//"/run.h5", repeat("x", k), error)
         if (allocated(error)) return
         call directory%close()
      end do
      call check_equal(error, len(read_whole(place//"/deep/run/run.h5")), 3, "the last run")
      call check_equal(error, len(read_whole(place//"/deep/run.1/run.h5")), 2, "the run before")
      call check_true(error, is_absent(place//"/deep/run.1.1"), "no third one")
      call check_true(error, is_absent(place//"/deep/run.lock"), "no lock is left")
      call clean_scratch(place)
   end subroutine an_older_run_is_kept_once

   subroutine a_second_run_is_refused(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(output_directory_t) :: first, second
      type(error_t), allocatable :: refused
      character(:), allocatable :: place

      place = scratch_directory("second")
      call write_file(place//"/run.lock", "1"//new_line("a"), error)
      if (allocated(error)) return
      call first%open(place//"/run", error)
      if (allocated(error)) return
      call second%open(place//"/run", refused)
      call check_true(error, allocated(refused), "a second run is refused")
      if (allocated(error)) return
      call check_equal(error, refused%code, exit_file, "exit code")
      call check_true(error, index(refused%message, "is writing to") > 0, "message says why")
      call first%close()
      call second%open(place//"/run", error)
      call second%close()
      if (allocated(error)) return
      call check_equal(error, read_whole(place//"/run.lock"), "1"//new_line("a"), "a file beside the directory is not touched")
      call clean_scratch(place)
   end subroutine a_second_run_is_refused

   subroutine foreign_files_are_left_alone(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(output_directory_t) :: directory
      type(error_t), allocatable :: refused
      character(:), allocatable :: place
      integer :: code

      place = scratch_directory("foreign")
      call write_file(place//"/thesis.txt", "precious", error)
      if (allocated(error)) return
      call directory%open(place, refused)
      call check_true(error, allocated(refused), "a directory with other files is refused")
      call directory%open(place//"/thesis.txt", refused)
      call check_true(error, allocated(refused), "a file is refused")
      code = make_directory(place//"/run.1")
      call write_file(place//"/run.1/thesis.txt", "precious", refused)
      call directory%open(place//"/run", refused)
      call write_file(place//"/run/run.h5", "x", refused)
      call directory%close()
      call directory%open(place//"/run", refused)
      call check_true(error, allocated(refused), "a foreign DIRECTORY.1 is not removed")
      call check_equal(error, read_whole(place//"/run.1/thesis.txt"), "precious", "it is still there")
      call check_equal(error, read_whole(place//"/run/run.h5"), "x", "nor was the run moved")
      call clean_scratch(place)
   end subroutine foreign_files_are_left_alone

   subroutine a_full_disk_is_an_error(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(text_file_t) :: file
      type(error_t), allocatable :: refused
      character(:), allocatable :: place

      if (path_exists("/dev/full")) then
         call write_file("/dev/full", "text", refused)
         call check_true(error, allocated(refused), "/dev/full takes nothing")
         if (allocated(error)) return
         call check_equal(error, refused%code, exit_file, "exit code")
         call check_true(error, index(refused%message, "cannot write /dev/full: ") == 1, "message names the file")
      end if
      call replace_file("/no/such/place", "text", refused)
      call check_true(error, allocated(refused), "no such directory")
      place = scratch_directory("append")
      file%path = place//"/lines.txt"
      call file%append("one"//new_line("a"), error)
      if (.not. allocated(error)) call file%append("two"//new_line("a"), error)
      call check_equal(error, read_whole(file%path), "one"//new_line("a")//"two"//new_line("a"), "a file grows")
      call clean_scratch(place)
   end subroutine a_full_disk_is_an_error

end module test_output_files
