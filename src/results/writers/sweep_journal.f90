!> The journal of a sweep: what it is of, and what every run gave, each written as soon as the run has ended.
!>
!> It is the memory of a sweep that was killed: a later one of the same model takes from here what is done. And it is what the
!> parts of a sweep leave behind for `gudgeon merge`. It starts with a line that says what it is, then come blocks
!> (`journal_blocks`). Runs whose block is damaged, or comes after such a block, are made again.
module sweep_journal
   use errors, only: error_t
   use file_store, only: kept_file_t
   use journal_blocks, only: block_of, next_block, tag_length
   use kinds, only: i8
   use member_result, only: member_result_t
   use packed, only: packer_t, unpacker_t
   use system_file, only: read_file
   use text, only: segment
   use text_file, only: replace_file, text_file_t
   implicit none (type, external)
   private
   public :: differences, journal_name, journal_t, origin_of_sweep_t, packed_origin, run_record_t, unpack_origin

   character(*), parameter :: journal_name = "sweep.runs"                 !! file in the directory
   character(*), parameter :: first_line = "gudgeon runs of a sweep, format 2"//new_line("a")
   character(tag_length), parameter :: tag_head = "head"     !! block: what the sweep is of
   character(tag_length), parameter :: tag_run = "run "      !! block: a run
   character(tag_length), parameter :: tag_end = "end "      !! block: the results were written
   integer, parameter :: largest_code = 255         !! exit code of a process
   integer(i8), parameter :: largest_journal = 2000000000_i8  !! bytes that are read

   !> What the runs are of: they can stand in one file only if this is the same.
   type :: origin_of_sweep_t
      character(:), allocatable :: program             !! which program made them
      character(:), allocatable :: settings            !! what the command line sets beside the deck
      character(:), allocatable :: deck                !! path of the deck
      type(kept_file_t), allocatable :: files(:)       !! (n) every file that was read, the deck first
   end type origin_of_sweep_t

   !> What came of a run.
   type :: run_record_t
      integer :: number = 0                            !! of the run
      integer :: exit_code = 0                         !! with which it ended, 128 + signal if one ended it
      character(:), allocatable :: message             !! why, if not 0
      type(member_result_t) :: member                  !! what it handed back
   end type run_record_t

   !> A journal.
   type :: journal_t
      type(origin_of_sweep_t) :: origin                !! what it is of
      type(run_record_t), allocatable :: runs(:)       !! (n) read from it; a run may stand twice, then the last counts
      logical :: is_there = .false.                    !! it was read, and says what it is of
      logical :: has_ended = .false.                   !! the results were written after its last run
      type(text_file_t) :: file                        !! where more is written
   contains
      procedure :: read => read_journal
      procedure :: begin => begin_journal
      procedure :: add => add_run
      procedure :: end => end_journal
   end type journal_t

contains

   !> Read the journal of a directory.
   subroutine read_journal(self, directory)
      class(journal_t), intent(inout) :: self    !! the journal; not there if it cannot be read
      character(*), intent(in) :: directory      !! of the sweep

      type(unpacker_t) :: block
      character(:), allocatable :: bytes, message, tag
      integer :: at, n

      self%is_there = .false.
      self%has_ended = .false.
      if (allocated(self%runs)) deallocate (self%runs)
      allocate (self%runs(0))
      call read_file(directory//"/"//journal_name, .true., largest_journal, bytes, message)
      if (len(message) > 0 .or. index(bytes, first_line) /= 1) return
      n = count_runs(bytes)
      deallocate (self%runs)
      allocate (self%runs(n))
      n = 0
      at = len(first_line)
      do while (next_block(bytes, at, tag, block))
         select case (tag)
         case (tag_head)
            call unpack_origin(block, self%origin)
            self%is_there = block%is_good
         case (tag_run)
            n = n + 1
            call unpack_run(block, self%runs(n))
            if (.not. block%is_good) n = n - 1
            self%has_ended = .false.
         case (tag_end)
            self%has_ended = .true.
         end select
      end do
      if (n < size(self%runs)) self%runs = self%runs(:n)
   end subroutine read_journal

   !> How many runs it has.
   integer function count_runs(bytes) result(n)
      character(*), intent(in) :: bytes   !! of the journal

      type(unpacker_t) :: block
      character(:), allocatable :: tag
      integer :: at

      n = 0
      at = len(first_line)
      do while (next_block(bytes, at, tag, block))
         if (tag == tag_run) n = n + 1
      end do
   end function count_runs

   !> Write what the journal is of and the runs that it has, whole, before more come.
   subroutine begin_journal(self, directory, error)
      class(journal_t), intent(inout) :: self            !! the journal, its origin and runs are set
      character(*), intent(in) :: directory              !! of the sweep
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      character(:), allocatable :: text
      integer :: k

      text = first_line//block_of(tag_head, packed_origin(self%origin))
      do k = 1, size(self%runs)
         text = text//block_of(tag_run, packed_run(self%runs(k)))
      end do
      self%file%path = directory//"/"//journal_name
      call replace_file(self%file%path, text, error)
      self%file%length = len(text, i8)
   end subroutine begin_journal

   !> Write what came of a run.
   subroutine add_run(self, run, error)
      class(journal_t), intent(inout) :: self            !! the journal
      type(run_record_t), intent(in) :: run              !! what came of it
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      call self%file%append(block_of(tag_run, packed_run(run)), error)
   end subroutine add_run

   !> Say that the results were written.
   subroutine end_journal(self, error)
      class(journal_t), intent(inout) :: self            !! the journal
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      call self%file%append(block_of(tag_end, ""), error)
   end subroutine end_journal

   !> What a run gave, as bytes.
   pure function packed_run(run) result(bytes)
      type(run_record_t), intent(in) :: run   !! the run
      character(:), allocatable :: bytes      !! the same

      type(packer_t) :: packer

      call packer%integer(run%number)
      call packer%integer(run%exit_code)
      call packer%text(run%message)
      call run%member%pack(packer)
      bytes = packer%bytes%get()
   end function packed_run

   !> What a run gave, from bytes.
   subroutine unpack_run(block, run)
      type(unpacker_t), intent(inout) :: block    !! the bytes
      type(run_record_t), intent(out) :: run      !! the run

      call block%integer(run%number, huge(0))
      call block%integer(run%exit_code, largest_code)
      call block%text(run%message)
      call run%member%unpack(block)
   end subroutine unpack_run

   !> What a sweep is of, as bytes.
   pure function packed_origin(origin) result(bytes)
      type(origin_of_sweep_t), intent(in) :: origin   !! what it is of
      character(:), allocatable :: bytes              !! the same

      type(packer_t) :: packer
      integer :: k

      call packer%text(origin%program)
      call packer%text(origin%settings)
      call packer%text(origin%deck)
      call packer%integer(size(origin%files))
      do k = 1, size(origin%files)
         call packer%text(origin%files(k)%path)
         call packer%text(origin%files(k)%bytes)
         call packer%text(origin%files(k)%message)
         call packer%integer(merge(1, 0, origin%files(k)%is_stream))
      end do
      bytes = packer%bytes%get()
   end function packed_origin

   !> What a sweep is of, from bytes.
   subroutine unpack_origin(block, origin)
      type(unpacker_t), intent(inout) :: block            !! the bytes
      type(origin_of_sweep_t), intent(out) :: origin      !! what it is of

      integer :: is_stream, k, n

      call block%text(origin%program)
      call block%text(origin%settings)
      call block%text(origin%deck)
      call block%integer(n, len(block%bytes))
      allocate (origin%files(n))
      do k = 1, n
         call block%text(origin%files(k)%path)
         call block%text(origin%files(k)%bytes)
         call block%text(origin%files(k)%message)
         call block%integer(is_stream, 1)
         origin%files(k)%is_stream = is_stream == 1
      end do
   end subroutine unpack_origin

   !> In what two sweeps differ, as text; blank: they are of the same.
   pure function differences(a, b) result(words)
      type(origin_of_sweep_t), intent(in) :: a   !! one
      type(origin_of_sweep_t), intent(in) :: b   !! the other
      character(:), allocatable :: words         !! as `file x.deck`

      integer :: k

      words = ""
      if (a%program /= b%program) words = words//", the program"
      if (a%settings /= b%settings) words = words//", options of the command line"
      if (size(a%files) /= size(b%files)) words = words//", the number of input files"
      do k = 1, min(size(a%files), size(b%files))
         if (len(a%files(k)%bytes) == len(b%files(k)%bytes) .and. a%files(k)%bytes == b%files(k)%bytes) cycle
         words = words//", file "//b%files(k)%path
      end do
      words = segment(words, len(", ") + 1)
   end function differences

end module sweep_journal
