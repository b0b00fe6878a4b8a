!> Worn surfaces of an earlier run, read with the deck that names its file.
!>
!> The format of the file belongs to the results of runs. What reads it is set once, when a deck is loaded
!> (`set_profile_reader`); it gives a line for each cell, `joint side volume`, cells in the order of their angles. These lines are
!> what `file_store` keeps.
module run_profiles
   use file_store, only: read_kept, reader_interface
   use kinds, only: i8, wp
   use numbers, only: read_number
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: columns_of_profiles, read_profiles, set_profile_reader

   integer, parameter :: columns_of_profiles = 3  !! size of a column that names the file of a run

   procedure(reader_interface), pointer :: reader => null()   !! what reads a run

contains

   !> Set what reads a run.
   subroutine set_profile_reader(procedure)
      procedure(reader_interface) :: procedure   !! gives lines `joint side volume`

      reader => procedure
   end subroutine set_profile_reader

   !> Read the worn surfaces of a run.
   subroutine read_profiles(path, lines, names, table, message)
      character(*), intent(in) :: path                        !! of the file
      character(:), allocatable, intent(out) :: lines         !! `joint side volume` of each cell
      type(text_t), allocatable, intent(out) :: names(:)      !! (n) `joint side` of each surface
      real(wp), allocatable, intent(out) :: table(:, :)       !! (n + cells of all, 1) numbers of cells, then volumes [1 and m^3]
      character(:), allocatable, intent(out) :: message       !! empty: success; else what is wrong

      real(wp), allocatable :: count(:), volume(:)
      logical :: is_stream

      allocate (names(0), table(0, 1))
      if (.not. associated(reader)) error stop "internal error: no reader of runs"
      call read_kept(path, .true., huge(1_i8), lines, message, is_stream, reader)
      if (len(message) > 0) return
      call take_lines(lines, names, count, volume)
      table = reshape([count, volume], [size(count) + size(volume), 1])
   end subroutine read_profiles

   !> Surfaces of lines.
   subroutine take_lines(lines, names, count, volume)
      character(*), intent(in) :: lines                       !! `joint side volume`, each with its end
      type(text_t), allocatable, intent(inout) :: names(:)    !! (n) none before; `joint side` of each surface
      real(wp), allocatable, intent(out) :: count(:)          !! (n) cells of each [1]
      real(wp), allocatable, intent(out) :: volume(:)         !! (cells of all) volumes [m^3]

      real(wp) :: number
      integer :: before, blank, first, last, n
      logical :: is_good, is_new

      n = 0
      do first = 1, len(lines)
         if (lines(first:first) == new_line("a")) n = n + 1
      end do
      allocate (count(0), volume(n))
      n = 0
      first = 1
      do while (first <= len(lines))
         last = first + index(lines(first:), new_line("a")) - 2
         blank = first + index(lines(first:last), " ", back=.true.) - 1
         before = size(names)
         is_new = before == 0
         if (.not. is_new) is_new = names(before)%s /= lines(first:blank - 1)
         if (is_new) then
            call append_text(names, lines(first:blank - 1))
            count = [count, 0.0_wp]
         end if
         n = n + 1
         call read_number(lines(blank + 1:last), 0, number, is_good)
         volume(n) = number
         count(size(count)) = count(size(count)) + 1.0_wp
         first = last + 2
      end do
   end subroutine take_lines

end module run_profiles
