!> Where a run writes: its directory, made, or taken again where an earlier run is continued with.
module run_place
   use errors, only: error_t
   use load, only: loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use restart_run, only: open_directory
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

   !> The directory of a run, if it writes anything.
   subroutine open_place(options, loaded, directory, goes_on, is_complete, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(output_directory_t), intent(inout) :: directory !! opened
      logical, intent(out) :: goes_on                      !! an earlier run is continued with
      logical, intent(out) :: is_complete                  !! that run has ended: nothing is to be done
      type(error_t), allocatable, intent(out) :: error     !! it cannot be made, or is not free

      if (options%write /= "nothing") then
         call open_directory(options, directory_of(options, loaded), directory, goes_on, is_complete, error)
         return
      end if
      goes_on = .false.
      is_complete = .false.
      directory%path = "."
      allocate (directory%warnings(0))
   end subroutine open_place

end module run_place
