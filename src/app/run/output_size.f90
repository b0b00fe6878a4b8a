!> How much a run will write, estimated before it starts.
!>
!> Of each number kept 8 bytes an instant in run.h5 and 25 in a text file; of each point of motion.vtkhdf ten numbers. Limits: rows
!> at contacts, whose number nobody knows before, and what a few thousand events take are not counted.
module output_size
   use channels, only: select_channels, selection_t
   use errors, only: error_t, exit_deck, exit_file, set_error
   use item, only: place_of
   use kinds, only: i8, wp
   use load, only: loaded_t
   use options, only: options_t
   use posix, only: free_space, path_exists
   use scene, only: analysis_static
   use text, only: real_text, to_text
   use time_plan, only: last_instant
   implicit none (type, external)
   private
   public :: check_size

   real(wp), parameter :: gigabyte = 1.0e9_wp    !! [byte]
   real(wp), parameter :: of_binary = 8.0_wp     !! a number in run.h5 [byte]
   real(wp), parameter :: of_text = 25.0_wp      !! a number in a text file [byte]
   real(wp), parameter :: of_point = 80.0_wp     !! a point of motion.vtkhdf [byte]
   integer, parameter :: points_of_body = 16     !! about so many points draw a body

contains

   !> A run that would write more than the deck allows, or than there is storage for, is refused before anything is made.
   subroutine check_size(options, loaded, directory, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      character(*), intent(in) :: directory                !! of the run, which need not exist
      type(error_t), allocatable, intent(out) :: error     !! it would write too much

      type(selection_t) :: selection
      character(:), allocatable :: hint, message, what
      integer :: bad
      integer(i8) :: room
      real(wp) :: each, size_limit, total

      if (loaded%scene%analysis == analysis_static .or. options%write == "numbers") return
      associate (output => loaded%scene%settings%output)
         call select_channels(output%values(place_of(output, "channels"))%words, loaded%catalogue, selection, bad, message, hint)
         if (bad > 0) return  ! reported elsewhere
         size_limit = output%number("size_limit")
         each = of_binary*selection%count()
         if (options%write == "all") each = each + of_text*selection%count()
         if (options%write == "all" .and. output%word("motion") /= "off") then
            each = each + of_point*points_of_body*size(loaded%scene%bodies%names)
         end if
      end associate
      total = each*real(last_instant(loaded%plan) + 1_i8, wp)
      what = "the run would write about "//real_text(total/gigabyte, 3)//" GB: "//to_text(last_instant(loaded%plan) + 1_i8)// &
             " output times of "//to_text(selection%count())//" numbers"
      hint = new_line("a")//"  = reduce 'channels', write less often ('every') or only the final part ('last'), or omit text "// &
         "files "// &
             "(--write channels)"
      room = free_space(nearest_directory(directory))
      if (total > size_limit*gigabyte) then
         call set_error(error, exit_deck, what//"; 'size_limit' in [output] allows "//real_text(size_limit, 3)//" GB"//hint// &
                        ", or raise the limit")
      else if (room >= 0 .and. total > real(room, wp)) then
         call set_error(error, exit_file, what//"; "//real_text(real(room, wp)/gigabyte, 3)//" GB are free on the disk of "// &
            directory// &
                        " is"//hint//", or write to another disk (--out DIRECTORY)")
      end if
   end subroutine check_size

   !> The nearest directory above a path that exists.
   function nearest_directory(path) result(there)
      character(*), intent(in) :: path          !! any path
      character(:), allocatable :: there        !! itself, one above it, or `.`

      integer :: n

      n = len(path)
      do while (n > 0)
         if (path_exists(path(:n))) exit
         n = index(path(:n), "/", back=.true.) - 1
      end do
      there = "."
      if (n > 0) there = path(:n)
      if (n <= 0 .and. index(path, "/") == 1) there = "/"
   end function nearest_directory

end module output_size
