!> The file of a checkpoint, `checkpoint.h5` in the directory of the run: what the run remembers, and whose it is.
!>
!> It is written whole beside its place and then renamed, after all that the run has written is on the disk: there is the one before
!> or this one, and the run's files hold at least what it reports of. Its checksum is looked at before it is
!> read. Deck, included files, settings and program stand in it; a run of another deck or program is reported what differs.
module checkpoint_file
   use checksum, only: seal_none, seal_right, seal_state
   use errors, only: error_t, exit_file, exit_usage, set_error
   use hdf5, only: h5fclose_f, hid_t
   use hdf5_calls, only: open_file
   use hdf5_datasets, only: integer_dataset, real_dataset, text_dataset
   use hdf5_read, only: has_dataset, read_reals, read_texts
   use kinds, only: wp
   use output_plan, only: output_plan_t
   use posix, only: sync_path
   use saved_run, only: saved_run_t
   use archive, only: archive_t
   use text, only: append_text, text_t, to_text
   use whole_file, only: begin_whole_file, end_whole_file
   implicit none (type, external)
   private
   public :: checkpoint_name, read_checkpoint, write_checkpoint

   character(*), parameter :: checkpoint_name = "checkpoint.h5"     !! file in the directory of the run
   character(*), parameter :: filetype = "gudgeon checkpoint"       !! description of it
   integer, parameter :: n_belonging = 7                            !! texts that say whose it is
   !> What they are.
   character(*), parameter :: belonging(n_belonging) = [character(28) :: "version of gudgeon", "sources of gudgeon", "compiler", &
                                                        "flags of the compiler", "options", "deck", "deck as understood"]
   integer, parameter :: first_of_deck = 6                          !! from here on they have many lines

contains

   !> Write it.
   subroutine write_checkpoint(plan, saved, error)
      type(output_plan_t), intent(in) :: plan             !! whose it is
      type(saved_run_t), intent(in) :: saved              !! what is remembered
      type(error_t), allocatable, intent(out) :: error    !! it cannot be written; the one before is still there

      character(:), allocatable :: path
      type(text_t), allocatable :: names(:)
      integer, allocatable :: sizes(:), versions(:)
      real(wp), allocatable :: row(:)
      integer(hid_t) :: file
      integer :: k, p, status

      path = plan%directory//"/"//checkpoint_name
      status = sync_path(plan%directory//"/run.h5")
      call begin_whole_file(path, filetype, plan, file, status, error)
      if (allocated(error)) return
      allocate (names(0), sizes(0), versions(0), row(0))
      do p = 1, size(saved%parts)
         do k = 1, size(saved%parts(p)%segments)
            call append_text(names, saved%parts(p)%segments(k)%name)
         end do
         sizes = [sizes, saved%parts(p)%segments%size]
         versions = [versions, saved%parts(p)%segments%version]
         row = [row, saved%parts(p)%row(:saved%parts(p)%n)]
      end do
      call real_dataset(file, "time", [1], [saved%t], "s", "time of the motion", status)
      call text_dataset(file, "belongs_to", whose(plan), .false., "program, options, deck with included files, deck with "// &
         "defaults", &
                        status)
      call text_dataset(file, "parts/names", names, .false., "names of the saved subsystems", status)
      call integer_dataset(file, "parts/versions", [size(versions)], versions, "format version of each", status)
      call integer_dataset(file, "parts/sizes", [size(sizes)], sizes, "number of values of each", status)
      call integer_dataset(file, "parts/pieces", [size(saved%parts)], [(size(saved%parts(p)%segments), p=1, size(saved%parts))], &
                           "names of each part of the mechanism", status)
      call real_dataset(file, "parts/row", [size(row)], row, "any", "values of all parts, concatenated", status)
      call put_archive(file, "motion", saved%motion, "state of the whole motion", status)
      call put_archive(file, "output", saved%output, "state of samples, statistics and files", status)
      call end_whole_file(path, file, status, error)
   end subroutine write_checkpoint

   !> Write an archive.
   subroutine put_archive(file, name, archive, long_name, status)
      integer(hid_t), intent(in) :: file     !! the file
      character(*), intent(in) :: name       !! of the dataset
      type(archive_t), intent(in) :: archive       !! what is remembered
      character(*), intent(in) :: long_name  !! what it is
      integer, intent(inout) :: status       !! negative: failed

      call real_dataset(file, name, [archive%n], archive%row(:archive%n), "any", long_name, status)
   end subroutine put_archive

   !> To which run a checkpoint belongs, in the order of `belonging`.
   function whose(plan) result(list)
      type(output_plan_t), intent(in) :: plan   !! the run
      type(text_t), allocatable :: list(:)      !! (n_belonging) texts

      integer :: k

      allocate (list(n_belonging))
      associate (origin => plan%origin)
         list(1)%s = origin%program_version
         list(2)%s = origin%git_sha1
         list(3)%s = origin%compiler
         list(4)%s = origin%flags
         list(5)%s = origin%choices
         list(6)%s = origin%deck_text
         do k = 1, size(origin%include_texts)
            list(6)%s = list(6)%s//new_line("a")//"# "//origin%include_names(k)%s//new_line("a")//origin%include_texts(k)%s
         end do
         list(7)%s = origin%deck_echo
      end associate
   end function whose

   !> Read the checkpoint of a directory, which must be that of a run with this plan.
   subroutine read_checkpoint(plan, saved, error)
      type(output_plan_t), intent(in) :: plan             !! the run that would continue
      type(saved_run_t), intent(out) :: saved             !! what was remembered
      type(error_t), allocatable, intent(out) :: error    !! there is none, or it is that of another run; what differs

      character(:), allocatable :: path, words
      type(text_t), allocatable :: there(:)
      integer(hid_t) :: file
      integer :: closed, status

      path = plan%directory//"/"//checkpoint_name
      status = seal_state(path)
      if (status /= seal_right) then  ! the library may crash on a damaged file, or read other numbers
         words = " is corrupt: its content does not match its checksum"
         if (status == seal_none) words = " is corrupt: its checksum is missing"
         call set_error(error, exit_file, path//words//new_line("a")//"  = run the deck anew, without --resume")
         return
      end if
      status = 0
      call open_file(path, file, status)
      if (status >= 0 .and. .not. has_dataset(file, "parts", "row")) status = -1
      call read_texts(file, "belongs_to", there, status)
      if (status >= 0) call compare(path, there, whose(plan), error)
      if (.not. allocated(error)) call read_memory(file, saved, status)
      if (file >= 0) call h5fclose_f(file, closed)
      if (status < 0) call set_error(error, exit_file, path//" is unreadable or not a checkpoint; run the deck again")
   end subroutine read_checkpoint

   !> Read what is remembered.
   subroutine read_memory(file, saved, status)
      integer(hid_t), intent(in) :: file         !! the file
      type(saved_run_t), intent(out) :: saved    !! what was remembered
      integer, intent(inout) :: status           !! negative: failed

      type(text_t), allocatable :: names(:)
      real(wp), allocatable :: many(:), row(:), sizes(:), time(:), versions(:)
      integer :: at, k, p, place

      call read_texts(file, "parts/names", names, status)
      call read_reals(file, "parts/versions", versions, status)
      call read_reals(file, "parts/sizes", sizes, status)
      call read_reals(file, "parts/pieces", many, status)
      call read_reals(file, "parts/row", row, status)
      call read_reals(file, "time", time, status)
      call get_archive(file, "motion", saved%motion, status)
      call get_archive(file, "output", saved%output, status)
      if (status < 0) return
      if (nint(sum(many)) /= size(names) .or. nint(sum(sizes)) /= size(row) .or. size(versions) /= size(sizes)) then
         status = -1
         return
      end if
      allocate (saved%parts(size(many)))
      saved%t = time(1)
      at = 0
      place = 0
      do p = 1, size(many)
         associate (part => saved%parts(p))
            allocate (part%segments(nint(many(p))))
            do k = 1, size(part%segments)
               part%segments(k)%name = names(at + k)%s
               part%segments(k)%version = nint(versions(at + k))
               part%segments(k)%size = nint(sizes(at + k))
            end do
            part%n = sum(part%segments%size)
            part%row = row(place + 1:place + part%n)
            at = at + size(part%segments)
            place = place + part%n
         end associate
      end do
   end subroutine read_memory

   !> Read an archive.
   subroutine get_archive(file, name, archive, status)
      integer(hid_t), intent(in) :: file     !! the file
      character(*), intent(in) :: name       !! of the dataset
      type(archive_t), intent(out) :: archive      !! what was remembered
      integer, intent(inout) :: status       !! negative: failed

      call read_reals(file, name, archive%row, status)
      archive%n = size(archive%row)
   end subroutine get_archive

   !> Name the first difference between the run that was saved and the one that would continue.
   subroutine compare(path, there, here, error)
      character(*), intent(in) :: path                    !! of the checkpoint
      type(text_t), intent(in) :: there(:)                !! (n_belonging) whose it is
      type(text_t), intent(in) :: here(:)                 !! (n_belonging) who would continue
      type(error_t), allocatable, intent(out) :: error    !! what differs

      character(:), allocatable :: difference
      integer :: k

      if (size(there) /= size(here)) then
         call set_error(error, exit_usage, path//" was written by another version of gudgeon")
         return
      end if
      do k = 1, size(here)
         if (there(k)%s == here(k)%s .and. len(there(k)%s) == len(here(k)%s)) cycle
         difference = trim(belonging(k))//" "//quoted(there(k)%s)//", this is "//quoted(here(k)%s)
         if (k >= first_of_deck) difference = trim(belonging(k))//", "//first_difference(there(k)%s, here(k)%s)
         call set_error(error, exit_usage, path//" belongs to another run: "//difference//new_line("a")// &
                        "  = use the same deck, options and program as that run, or omit --resume to start again")
         return
      end do
   end subroutine compare

   !> A text between quotation marks.
   pure function quoted(text) result(words)
      character(*), intent(in) :: text          !! the text
      character(:), allocatable :: words        !! the same, quoted

      words = "'"//text//"'"
   end function quoted

   !> The first line in which two texts differ.
   function first_difference(there, here) result(words)
      character(*), intent(in) :: there         !! that of the checkpoint
      character(*), intent(in) :: here          !! the present one
      character(:), allocatable :: words        !! the number of the line and both

      integer :: at(2), line, n(2)

      at = 1
      line = 0
      do
         line = line + 1
         n = [length_of_line(there(at(1):)), length_of_line(here(at(2):))]
         if (there(at(1):at(1) + n(1) - 1) /= here(at(2):at(2) + n(2) - 1) .or. any(at + n > [len(there), len(here)])) exit
         at = at + n + 1
      end do
      words = "line "//to_text(line)//" "//quoted(there(at(1):at(1) + n(1) - 1))//", this is "// &
              quoted(here(at(2):at(2) + n(2) - 1))
   end function first_difference

   !> Characters up to the end of a line.
   pure integer function length_of_line(text) result(n)
      character(*), intent(in) :: text          !! from the start of the line

      n = index(text, new_line("a")) - 1
      if (n < 0) n = len(text)
   end function length_of_line

end module checkpoint_file
