!> What an output directory holds, held against its marker: files of others, runs that still write; and its removal.
!>
!> Runs of a sweep are output directories within that of the sweep, with markers of their own. Links are never followed.
module output_tree
   use name_table, only: name_table_t
   use output_marker, only: is_as_made, marker_name, marker_t, read_marker
   use posix, only: close_file, is_busy, list_directory, lock_file, remove_within
   use text, only: starts_with, text_t
   implicit none (type, external)
   private
   public :: inspect, remove_run, tree_t

   !> What was found.
   type :: tree_t
      character(:), allocatable :: foreign   !! path of a file that no run made, by the markers; unallocated: none
      character(:), allocatable :: in_use    !! path of a directory within that a run is writing to; unallocated: none
   end type tree_t

contains

   !> Look through an output directory, but for its own lock.
   subroutine inspect(place, marker, tree)
      character(*), intent(in) :: place        !! the directory
      type(marker_t), intent(in) :: marker     !! its marker
      type(tree_t), intent(out) :: tree        !! what was found

      call look_into(place, "", marker, tree)
   end subroutine inspect

   !> Look through an output directory that may be part of another.
   recursive subroutine look_into(top, prefix, marker, tree)
      character(*), intent(in) :: top          !! the outermost directory
      character(*), intent(in) :: prefix       !! path of this one within it, with a slash at its end, or blank
      type(marker_t), intent(in) :: marker     !! its marker
      type(tree_t), intent(inout) :: tree      !! what was found

      type(name_table_t) :: table
      integer :: k

      call table%list(marker%files)
      do k = 1, size(marker%files)
         if (leads_out(marker%files(k)%s)) cycle
         if (.not. is_as_made(top//"/"//prefix, marker, k)) call note(tree%foreign, prefix//marker%files(k)%s)
      end do
      call look_at(top, prefix, "", table, tree)
   end subroutine look_into

   !> Look through a directory of a run.
   recursive subroutine look_at(top, prefix, folder, table, tree)
      character(*), intent(in) :: top              !! the outermost directory
      character(*), intent(in) :: prefix           !! path of the run's directory within it
      character(*), intent(in) :: folder           !! path of this one within that of the run
      type(name_table_t), intent(in) :: table      !! what the run made
      type(tree_t), intent(inout) :: tree          !! what was found

      type(marker_t) :: marker
      type(text_t), allocatable :: names(:)
      character(:), allocatable :: name
      integer :: code, file, k
      logical :: is_locked

      call list_directory(top//"/"//prefix//folder, names, code)
      if (code /= 0) then
         call note(tree%foreign, prefix//folder)
         return
      end if
      do k = 1, size(names)
         name = folder//names(k)%s
         if (name == marker_name) cycle
         if (table%find(name) == 0) call note(tree%foreign, prefix//name)
         if (index(name, "/", back=.true.) /= len(name)) cycle
         code = lock_file(top//"/"//prefix//name//marker_name, .false., file, is_locked)
         if (is_busy(code)) call note(tree%in_use, prefix//name(1:len(name) - 1))
         if (code == 0) call close_file(file)
         call read_marker(top//"/"//prefix//name, marker)
         if (marker%is_ours) then
            call look_into(top, prefix//name, marker, tree)
         else
            call look_at(top, prefix, name, table, tree)
         end if
      end do
   end subroutine look_at

   !> Remember the first path in alphabetical order, whatever order the system has.
   subroutine note(path, found)
      character(:), allocatable, intent(inout) :: path  !! the first so far
      character(*), intent(in) :: found                 !! another

      if (allocated(path)) then
         if (found > path) return
      end if
      path = found
   end subroutine note

   !> Remove what the runs in an output directory made, the marker last, and the directory if nothing else is in it.
   subroutine remove_run(place, code)
      character(*), intent(in) :: place    !! the directory
      integer, intent(out) :: code         !! 0, or the system's error number, as of a directory that is not empty

      integer :: slash

      slash = index(place, "/", back=.true.)
      call clear(place, "")
      if (slash > 0) then
         code = remove_within(place(1:max(1, slash - 1)), place(slash + 1:)//"/")
      else
         code = remove_within(".", place//"/")
      end if
   end subroutine remove_run

   !> Remove what a run made in a directory that may be part of another; what cannot be removed stays.
   recursive subroutine clear(top, prefix)
      character(*), intent(in) :: top          !! the outermost directory
      character(*), intent(in) :: prefix       !! path of this one within it, with a slash at its end, or blank

      type(marker_t) :: marker
      integer :: ignored, k

      call read_marker(top//"/"//prefix, marker)
      if (.not. marker%is_ours) return
      do k = size(marker%files), 1, -1
         associate (name => marker%files(k)%s)
            if (leads_out(name)) cycle
            if (.not. is_as_made(top//"/"//prefix, marker, k)) cycle
            if (index(name, "/", back=.true.) == len(name)) call clear(top, prefix//name)
            ignored = remove_within(top, prefix//name)
         end associate
      end do
      ignored = remove_within(top, prefix//marker_name)
   end subroutine clear

   !> Whether a path does not stay below the directory that it is in, which no marker of ours has.
   pure logical function leads_out(name)
      character(*), intent(in) :: name  !! path in a marker

      leads_out = len(name) == 0 .or. starts_with(name, "/") .or. index("/"//name//"/", "/../") > 0
   end function leads_out

end module output_tree
