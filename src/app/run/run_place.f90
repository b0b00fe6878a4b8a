!> Where a run writes: its directory, made, or taken again where an earlier run is continued with.
module run_place
   use checkpoint_file, only: checkpoint_name
   use errors, only: error_t
   use load, only: loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use posix, only: path_exists, write_error
   use recorder, only: status_complete
   use source_text, only: read_source, source_t
   use text, only: starts_with
   implicit none (type, external)
   private
   public :: directory_of, open_place

contains

   !> Directory of the run: outputs/NAME of inputs/NAME.deck, unless `--out` names another.
   function directory_of(options, loaded) result(directory)
      type(options_t), intent(in) :: options       !! the command line
      type(loaded_t), intent(in) :: loaded         !! the deck
      character(:), allocatable :: directory       !! of the run

      integer :: dot, slash

      associate (path => loaded%path)
         slash = index(path, "/", back=.true.)
         dot = index(path, ".", back=.true.)
         if (dot <= slash + 1) dot = len(path) + 1
         directory = "outputs/"//path(slash + 1:dot - 1)
         if (loaded%is_stream .and. (starts_with(path, "/dev/") .or. starts_with(path, "/proc/"))) directory = "outputs/stdin"
      end associate
      if (allocated(options%directory)) directory = options%directory
   end function directory_of

   !> The directory of a run, if it writes anything: a new one, or with `--resume` that of the run that continues.
   subroutine open_place(options, loaded, directory, goes_on, is_complete, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(output_directory_t), intent(inout) :: directory !! opened
      logical, intent(out) :: goes_on                      !! an earlier run is continued with: there is a checkpoint
      logical, intent(out) :: is_complete                  !! there is a run that has come to its end: nothing is to be done
      type(error_t), allocatable, intent(out) :: error     !! it cannot be made, or is not free

      character(:), allocatable :: path

      goes_on = .false.
      is_complete = .false.
      if (options%write == "nothing") then
         directory%path = "."
         allocate (directory%warnings(0))
         return
      end if
      path = directory_of(options, loaded)
      if (options%restart%is_resumed) then
         goes_on = path_exists(path//"/"//checkpoint_name)
         is_complete = .not. goes_on .and. has_completed(path//"/summary.json")
         if (is_complete) then
            call write_error("note: the run in "//path//" is complete, there is nothing to resume"//new_line("a"))
            return
         end if
         if (.not. goes_on) call write_error("note: no checkpoint in "//path//": the run starts at t = 0"//new_line("a"))
      end if
      if (goes_on) then
         call directory%open_again(path, error)
      else
         call directory%open(path, error)
      end if
   end subroutine open_place

   !> Whether a run has come to its end, by its summary. One that failed, as for need of room on the disk, has not.
   logical function has_completed(path)
      character(*), intent(in) :: path      !! of the summary

      character(:), allocatable :: message
      type(source_t) :: summary

      call read_source(path, summary, message, may_be_stream=.false.)
      has_completed = message == "" .and. index(summary%text, """status"": """//status_complete//"""") > 0
   end function has_completed

end module run_place
