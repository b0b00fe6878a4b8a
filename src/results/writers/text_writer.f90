!> Writes the time histories, one `.dat` file per item, and events.dat.
!>
!> Rows wait in memory and are written in blocks; a file that cannot take a block keeps the blocks
!> before it. A clearance joint's file holds the channels of its contacts too.
module text_writer
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: n_groups, group_clearances, group_contacts
   use channel_names, only: item_name, scalar_t
   use channels, only: selection_t
   use decimal_text, only: decimal_width
   use errors, only: error_t, set_error
   use event_list, only: event_list_t, n_event_numbers, n_event_words, number_names, number_units, word_names
   use kinds, only: i8, wp
   use output_marker, only: enter_file, note_files
   use output_plan, only: output_plan_t
   use posix, only: make_directory, remove_file
   use archive, only: archive_t
   use text, only: text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: fail_file, put_in_place, text_file_t
   use text_table, only: file_heading, put_row_of_numbers, text_table_t
   implicit none (type, external)
   private
   public :: extra_table_t, file_of_item, text_writer_t

   integer, parameter :: most_rows = 256, fewest_rows = 8     !! rows in memory
   integer, parameter :: numbers_in_memory = 8388608          !! of all tables together, from which the rows follow
   integer, parameter :: events_in_memory = 256               !! lines of events.dat
   real(wp), parameter :: longest_wait = 10.0_wp              !! time after which rows are written anyway [s]

   !> A table besides those of the items, for a figure of channels of several items.
   type :: extra_table_t
      character(:), allocatable :: name           !! path within the run's directory, without suffix and `.dat`
      type(scalar_t), allocatable :: columns(:)   !! (n) its columns
   end type extra_table_t

   !> The files of a run.
   type :: text_writer_t
      private
      type(text_table_t), allocatable, public :: tables(:) !! (n) files of columns
      type(text_t), allocatable, public :: names(:)       !! (n) their paths within the run's directory
      type(text_file_t) :: events                         !! events.dat
      character(:), allocatable :: heading                !! of events.dat
      logical :: with_events = .true.                     !! whether there is an events.dat
      integer :: block = most_rows                        !! rows in memory at most
      integer :: waiting = 0                              !! rows in memory
      integer :: written = 0                              !! rows in the files
      integer :: written_events = 0                       !! events in events.dat
      real(wp) :: last_time = 0.0_wp                      !! time of the last row in the files [s]
      integer(i8) :: flushed_at = 0                       !! clock at the last block
      logical :: is_broken = .false.                      !! a write failed: nothing more is written
   contains
      procedure, public :: start => start_files
      procedure, public :: sample => sample_files
      procedure, public :: flush => write_block
      procedure, public :: save => save_files
      procedure, public :: go_on => go_on_with_files
      procedure, public :: finish => finish_files
   end type text_writer_t

contains

   !> Name of the file of an item.
   pure function file_of_item(item, suffix) result(name)
      character(*), intent(in) :: item     !! name of the item
      character(*), intent(in) :: suffix   !! blank, or `.ideal`
      character(:), allocatable :: name    !! file name

      name = item//trim(suffix)//".dat"
   end function file_of_item

   !> Make all files with their headings.
   subroutine start_files(self, plan, catalogue, selection, extra, error)
      class(text_writer_t), intent(inout) :: self        !! the files
      type(output_plan_t), intent(in) :: plan            !! where they go and what they say
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(selection_t), intent(in) :: selection         !! what is
      type(extra_table_t), intent(in) :: extra(:)        !! (n) further tables
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be made

      integer :: item, k, n, item_group, pass

      self%block = max(fewest_rows, min(most_rows, numbers_in_memory/max(1, selection%count())))
      do pass = 1, 2
         n = 0
         do item_group = 1, n_groups
            if (item_group == group_contacts) cycle
            do item = 1, size(catalogue%item_groups(item_group)%names)
               call add_table(self, pass, n, file_of_item(item_name(catalogue, item_group, item), plan%suffix), &
                              columns_of_item(catalogue, selection, item_group, item), plan, catalogue, error)
               if (allocated(error)) return
            end do
         end do
         do k = 1, size(extra)
            call add_table(self, pass, n, file_of_item(extra(k)%name, plan%suffix), extra(k)%columns, &
                           plan, catalogue, error)
            if (allocated(error)) return
         end do
         if (pass == 1) allocate (self%tables(n), self%names(n))
      end do
      self%with_events = .not. plan%is_twin()
      if (self%with_events) call start_events(self, plan, error)
      call system_clock(self%flushed_at)
   end subroutine start_files

   !> Count a table (pass 1) or make it (pass 2), if it has columns.
   subroutine add_table(self, pass, n, name, columns, plan, catalogue, error)
      type(text_writer_t), intent(inout) :: self         !! the files
      integer, intent(in) :: pass                        !! 1: only count
      integer, intent(inout) :: n                        !! tables so far
      character(*), intent(in) :: name                   !! path within the run's directory
      type(scalar_t), intent(in) :: columns(:)           !! (n) its columns, perhaps none
      type(output_plan_t), intent(in) :: plan            !! where it goes and what it says
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! the file cannot be made

      integer :: at, code

      if (size(columns) == 0) return
      n = n + 1
      if (pass == 1) return
      at = index(name, "/", back=.true.)
      if (at > 1) then
         code = enter_file(plan%directory//"/"//name(1:at))
         if (code == 0) code = make_directory(plan%directory//"/"//name(1:at - 1))
         if (code /= 0) then
            call fail_file(error, "cannot make the directory", plan%directory//"/"//name(1:at - 1), code, "")
            return
         end if
      end if
      self%names(n)%s = name
      call self%tables(n)%start(plan%directory//"/"//name, columns, with_kinds(plan, catalogue), self%block, plan, catalogue, error)
   end subroutine add_table

   !> Whether there may be rows at contacts: the reference run with ideal joints may have none.
   pure logical function with_kinds(plan, catalogue)
      type(output_plan_t), intent(in) :: plan       !! what the files say of the run
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded

      with_kinds = plan%with%contact_rows .and. size(catalogue%item_groups(group_contacts)%names) > 0
   end function with_kinds

   !> The chosen numbers of an item and, of a clearance joint, of its contacts.
   function columns_of_item(catalogue, selection, item_group, item) result(columns)
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      type(selection_t), intent(in) :: selection    !! what is
      integer, intent(in) :: item_group                   !! group of the item
      integer, intent(in) :: item                   !! its number there
      type(scalar_t), allocatable :: columns(:)     !! (n) numbers in the order of the catalogue

      integer :: k

      allocate (columns(0))
      call append_columns(catalogue, selection, item_group, item, columns)
      if (item_group /= group_clearances) return
      do k = 1, size(catalogue%item_groups(group_contacts)%names)
         if (catalogue%item_groups(group_contacts)%names(k)%s /= catalogue%item_groups(item_group)%names(item)%s) cycle
         call append_columns(catalogue, selection, group_contacts, k, columns)
      end do
   end function columns_of_item

   !> Append the chosen numbers of an item.
   subroutine append_columns(catalogue, selection, item_group, item, columns)
      type(catalogue_t), intent(in) :: catalogue                  !! what can be recorded
      type(selection_t), intent(in) :: selection                  !! what is
      integer, intent(in) :: item_group                                 !! group of the item
      integer, intent(in) :: item                                 !! its number there
      type(scalar_t), allocatable, intent(inout) :: columns(:)    !! (n) numbers

      integer :: component, group

      do group = 1, size(catalogue%groups)
         if (catalogue%groups(group)%item_group /= item_group) cycle
         do component = 1, catalogue%groups(group)%channel%components
            if (selection%groups(group)%mask(component, item)) columns = [columns, scalar_t(group, component, item)]
         end do
      end do
   end subroutine append_columns

   !> Make events.dat with its heading.
   subroutine start_events(self, plan, error)
      type(text_writer_t), intent(inout) :: self         !! the files
      type(output_plan_t), intent(in) :: plan            !! where it goes and what it says
      type(error_t), allocatable, intent(out) :: error   !! the file cannot be made

      type(buffer_t) :: heading
      integer :: k

      self%events%path = plan%directory//"/events.dat"
      call heading%add("# time[s]")
      do k = 1, n_event_words
         call heading%add(" "//trim(word_names(k)))
      end do
      do k = 2, n_event_numbers
         call heading%add(" "//trim(number_names(k))//"["//trim(number_units(k))//"]")
      end do
      call heading%line("")
      call heading%add(file_heading(plan))
      call heading%line("# one row per located event, by time; a contact is one row, at the time of its onset")
      self%heading = heading%get()
      if (.not. plan%life%goes_on) call self%events%append(self%heading, error)
      call note_files()
   end subroutine start_events

   !> Keep a row of every table; write them if the block is full.
   subroutine sample_files(self, t, kind, catalogue, events, error)
      class(text_writer_t), intent(inout) :: self        !! the files
      real(wp), intent(in) :: t                          !! time [s]
      integer, intent(in) :: kind                        !! what the row is
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(event_list_t), intent(in) :: events           !! all events so far
      type(error_t), allocatable, intent(out) :: error   !! they cannot be written

      integer(i8) :: now, rate
      integer :: k

      if (self%is_broken) return
      self%waiting = self%waiting + 1
      do k = 1, size(self%tables)
         call self%tables(k)%put(self%waiting, t, kind, catalogue)
      end do
      call system_clock(now, rate)
      if (self%waiting == self%block .or. real(now - self%flushed_at, wp) > longest_wait*real(rate, wp)) then
         call write_block(self, t, events, error)
      end if
   end subroutine sample_files

   !> Write where the files stand: all rows and events must be in them.
   subroutine save_files(self, archive)
      class(text_writer_t), intent(in) :: self  !! the files, flushed
      type(archive_t), intent(inout) :: archive       !! receives it

      integer :: k

      call archive%put([self%written, self%written_events])
      call archive%put(self%last_time)
      do k = 1, size(self%tables)
         call archive%put(self%tables(k)%file%length)
      end do
      if (self%with_events) call archive%put(self%events%length)
   end subroutine save_files

   !> Continue with the files of an earlier run where they stood when it was saved.
   subroutine go_on_with_files(self, archive, error)
      class(text_writer_t), intent(inout) :: self        !! the files, started
      type(archive_t), intent(inout) :: archive                !! holds where they stood
      type(error_t), allocatable, intent(out) :: error   !! one is not as it was

      integer(i8) :: length
      integer :: k

      call archive%get(self%written)
      call archive%get(self%written_events)
      call archive%get(self%last_time)
      do k = 1, size(self%tables)
         call archive%get(length)
         call self%tables(k)%file%go_on(length, error)
         if (allocated(error)) return
      end do
      if (.not. self%with_events) return
      call archive%get(length)
      call self%events%go_on(length, error)
   end subroutine go_on_with_files

   !> Write the waiting rows and events.
   subroutine write_block(self, t, events, error)
      class(text_writer_t), intent(inout) :: self         !! the files
      real(wp), intent(in) :: t                          !! time of the last row [s]
      type(event_list_t), intent(in) :: events           !! all events so far
      type(error_t), allocatable, intent(out) :: error   !! they cannot be written

      character(:), allocatable :: saved
      integer :: k

      do k = 1, size(self%tables)
         call self%tables(k)%flush(self%waiting, error)
         if (allocated(error)) exit
      end do
      if (self%with_events .and. .not. allocated(error)) then
         call append_events(events, [(k, k=self%written_events + 1, events%n)], self%events, error)
      end if
      if (allocated(error)) then
         self%is_broken = .true.
         saved = " Nothing was saved there."
         if (self%written > 0) saved = " Saved and readable: "//to_text(self%written)// &
                                       " rows up to t = "//to_text(self%last_time)//" s."
         error%message = error%message//saved
         return
      end if
      self%written = self%written + self%waiting
      self%written_events = events%n
      self%waiting = 0
      self%last_time = t
      call note_files()
      call system_clock(self%flushed_at)
   end subroutine write_block

   !> Append events to a file, a block at a time.
   subroutine append_events(events, list, file, error)
      type(event_list_t), intent(in) :: events           !! all events
      integer, intent(in) :: list(:)                     !! (n) numbers of those to write
      type(text_file_t), intent(inout) :: file           !! the file
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written; it ends with a whole line

      integer :: first

      do first = 1, size(list), events_in_memory
         call file%append(event_rows(events, list(first:min(first + events_in_memory - 1, size(list)))), error)
         if (allocated(error)) return
      end do
   end subroutine append_events

   !> Events as lines of text.
   function event_rows(events, list) result(text)
      type(event_list_t), intent(in) :: events   !! all events
      integer, intent(in) :: list(:)             !! (n) numbers of those to write
      character(:), allocatable :: text          !! whole lines

      type(buffer_t) :: buffer
      character(decimal_width*n_event_numbers) :: line
      character(:), allocatable :: word
      integer :: i, k

      do i = 1, size(list)
         call put_row_of_numbers(events%numbers(list(i)), line)
         call buffer%add(line(1:decimal_width - 1))
         do k = 1, n_event_words
            word = events%word(list(i), k)
            if (len_trim(word) == 0) word = "-"
            call buffer%add(" "//word)
         end do
         call buffer%add(line(decimal_width:decimal_width*n_event_numbers - 1)//new_line("a"))
      end do
      text = buffer%get()
   end function event_rows

   !> Write what waits and put the events in the order of their times.
   subroutine finish_files(self, t, events, error)
      class(text_writer_t), intent(inout) :: self        !! the files
      real(wp), intent(in) :: t                          !! time of the last row [s]
      type(event_list_t), intent(in) :: events           !! all events
      type(error_t), allocatable, intent(out) :: error   !! they cannot be written

      type(text_file_t) :: sorted
      integer :: ignored

      if (self%is_broken .or. .not. allocated(self%tables)) return
      call write_block(self, t, events, error)
      if (allocated(error) .or. .not. self%with_events .or. events%n == 0) return
      sorted%path = self%events%path//".part"
      call sorted%append(self%heading, error)
      if (.not. allocated(error)) call append_events(events, events%order_by_onset(), sorted, error)
      if (.not. allocated(error)) call put_in_place(self%events%path, error)
      if (allocated(error)) ignored = remove_file(sorted%path)
   end subroutine finish_files

end module text_writer
