!> The table /events of run.h5: one record per event, appended in the order reported, sorted at the end.
module hdf5_events
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: n_groups
   use event_list, only: event_list_t, n_event_numbers, n_event_words, number_long_names, number_names, number_units
   use event_list, only: word_long_names, word_names
   use hdf5, only: h5dclose_f, h5dget_space_f, h5dset_extent_f, h5dwrite_f, h5sclose_f, h5screate_simple_f
   use hdf5, only: h5sselect_hyperslab_f, h5tclose_f, h5tcreate_f, h5tinsert_f, h5s_select_set_f, h5t_compound_f
   use hdf5, only: h5t_ieee_f64le, h5t_native_double, hid_t, hsize_t, size_t
   use hdf5_attributes, only: word_type
   use hdf5_calls, only: new_dataset
   use hdf5_datasets, only: describe, integer_dataset
   use hdf5_scales, only: add_scale, scales_t, take_scales
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: event_table_t

   integer, parameter :: shortest_word = 16  !! bytes of a word at least
   integer, parameter :: records_of_chunk = 64  !! records that lie together in the file
   integer, parameter :: records_at_once = 16*records_of_chunk  !! records in memory at most
   integer, parameter :: bytes_of_number = storage_size(1.0_wp)/8  !! bytes of a number

   !> The open table.
   type :: event_table_t
      integer(hid_t) :: id = -1                  !! the open dataset
      integer(hid_t) :: memory = -1              !! type of a record in memory
      integer :: width(n_event_words) = 0        !! (5) bytes of each word
      integer :: record = 0                      !! bytes of a record
      integer :: written = 0                     !! records in the file
   contains
      procedure :: make => make_table
      procedure :: bytes => bytes_to_come
      procedure :: append => append_records
      procedure :: sort => sort_table
      procedure :: number => number_records
      procedure :: close => close_table
   end type event_table_t

contains

   !> Make the table, with words as long as the longest name in the scene.
   subroutine make_table(self, file, catalogue, status)
      class(event_table_t), intent(inout) :: self  !! the table
      integer(hid_t), intent(in) :: file           !! the file
      type(catalogue_t), intent(in) :: catalogue   !! what can be recorded
      integer, intent(inout) :: status             !! negative: failed

      integer(hid_t) :: stored
      integer :: closed, item, k, item_group

      if (status < 0) return
      self%width = shortest_word
      do item_group = 1, n_groups
         do item = 1, size(catalogue%item_groups(item_group)%names)
            self%width(2) = max(self%width(2), len(catalogue%item_groups(item_group)%names(item)%s))
            self%width(3) = max(self%width(3), len(catalogue%item_groups(item_group)%labels(item)%s))
         end do
      end do
      self%record = n_event_numbers*bytes_of_number + sum(self%width)
      call record_type(self, h5t_ieee_f64le, stored, status)
      call record_type(self, h5t_native_double, self%memory, status)
      call new_dataset(file, "events", stored, [0_hsize_t], self%id, status, chunk=[int(records_of_chunk, hsize_t)])
      if (status < 0) return
      call h5tclose_f(stored, closed)
      call describe(self%id, trim(number_units(1))//repeat(" 1", n_event_words)//" "// &
                    joined([(number_units(k), k=2, n_event_numbers)]), &
                    joined([number_names(1)//": "//number_long_names(1), word_names//": "//word_long_names, &
                            [(number_names(k)//": "//number_long_names(k), k=2, n_event_numbers)]], "; "), &
                    "none", status)
   end subroutine make_table

   !> Trimmed strings in one.
   pure function joined(list, separator) result(s)
      character(*), intent(in) :: list(:)                !! (n) strings
      character(*), intent(in), optional :: separator    !! between two of them, a blank if absent
      character(:), allocatable :: s                     !! the whole

      integer :: k

      s = squeezed(list(1))
      do k = 2, size(list)
         if (present(separator)) then
            s = s//separator//squeezed(list(k))
         else
            s = s//" "//trim(list(k))
         end if
      end do
   end function joined

   !> A string without blanks before a colon and at its end.
   pure function squeezed(string) result(s)
      character(*), intent(in) :: string  !! `name    : meaning`
      character(:), allocatable :: s      !! `name: meaning`

      integer :: at

      at = index(string, ": ")
      s = trim(string)
      if (at > 0) s = trim(string(1:at - 1))//trim(string(at:))
   end function squeezed

   !> The type of a record: time, the words, the other numbers; without gaps.
   subroutine record_type(self, kind_of_number, type_id, status)
      type(event_table_t), intent(in) :: self          !! the table
      integer(hid_t), intent(in) :: kind_of_number     !! type of its numbers
      integer(hid_t), intent(out) :: type_id           !! to be closed by the caller
      integer, intent(inout) :: status                 !! negative: failed

      integer(hid_t) :: word
      integer(size_t) :: at
      integer :: closed, k

      type_id = -1
      if (status < 0) return
      call h5tcreate_f(h5t_compound_f, int(self%record, size_t), type_id, status)
      if (status >= 0) call h5tinsert_f(type_id, trim(number_names(1)), 0_size_t, kind_of_number, status)
      at = bytes_of_number
      do k = 1, n_event_words
         call word_type(self%width(k), word, status)
         if (status >= 0) call h5tinsert_f(type_id, trim(word_names(k)), at, word, status)
         if (status < 0) return
         call h5tclose_f(word, closed)
         at = at + self%width(k)
      end do
      do k = 2, n_event_numbers
         if (status >= 0) call h5tinsert_f(type_id, trim(number_names(k)), at, kind_of_number, status)
         at = at + bytes_of_number
      end do
   end subroutine record_type

   !> Room that the events not yet in the file need there.
   pure integer(i8) function bytes_to_come(self, events)
      class(event_table_t), intent(in) :: self  !! the table
      type(event_list_t), intent(in) :: events  !! all events so far

      bytes_to_come = int(self%record, i8)*(events%n - self%written + records_of_chunk)
   end function bytes_to_come

   !> Append the events that are not yet in the file.
   subroutine append_records(self, events, status)
      class(event_table_t), intent(inout) :: self  !! the table
      type(event_list_t), intent(in) :: events     !! all events so far
      integer, intent(inout) :: status             !! negative: failed

      integer :: k

      if (status < 0 .or. events%n == self%written) return
      call h5dset_extent_f(self%id, [int(events%n, hsize_t)], status)
      call write_records(self, events, [(k, k=self%written + 1, events%n)], self%written, status)
      if (status >= 0) self%written = events%n
   end subroutine append_records

   !> Put all events in the order of their times.
   subroutine sort_table(self, events, status)
      class(event_table_t), intent(inout) :: self  !! the table
      type(event_list_t), intent(in) :: events     !! all events, all of them in the file
      integer, intent(inout) :: status             !! negative: failed

      if (status < 0 .or. self%written == 0) return
      call write_records(self, events, events%order_by_onset(), 0, status)
   end subroutine sort_table

   !> Number the records, at the end: /event is the scale of their dimension.
   subroutine number_records(self, file, scales, status)
      class(event_table_t), intent(in) :: self     !! the table
      integer(hid_t), intent(in) :: file           !! the file
      type(scales_t), intent(inout) :: scales      !! gets it
      integer, intent(inout) :: status             !! negative: failed

      integer :: k

      call integer_dataset(file, "event", [self%written], [(k, k=1, self%written)], "number of the event, from 1", status)
      call add_scale(scales, file, "event", status)
      call take_scales(scales, file, self%id, "events", ["event"], status)
   end subroutine number_records

   !> Write records into a table that is long enough.
   subroutine write_records(self, events, list, offset, status)
      type(event_table_t), intent(in) :: self    !! the table
      type(event_list_t), intent(in) :: events   !! all events
      integer, intent(in) :: list(:)             !! (n) numbers of those to write
      integer, intent(in) :: offset              !! records before them
      integer, intent(inout) :: status           !! negative: failed

      character(kind=c_char, len=1), allocatable, target :: bytes(:, :)
      integer(hid_t) :: here, there
      integer :: closed, first, k, n

      allocate (bytes(self%record, min(size(list), records_at_once)))
      do first = 1, size(list), records_at_once
         if (status < 0) return
         n = min(records_at_once, size(list) + 1 - first)
         do k = 1, n
            call encode_record(self, events, list(first + k - 1), bytes(:, k))
         end do
         call h5screate_simple_f(1, [int(n, hsize_t)], here, status)
         if (status >= 0) call h5dget_space_f(self%id, there, status)
         if (status < 0) return
         call h5sselect_hyperslab_f(there, h5s_select_set_f, [int(offset + first - 1, hsize_t)], [int(n, hsize_t)], status)
         if (status >= 0) call h5dwrite_f(self%id, self%memory, c_loc(bytes), status, here, there)
         call h5sclose_f(here, closed)
         call h5sclose_f(there, closed)
      end do
   end subroutine write_records

   !> One record as it lies in memory.
   subroutine encode_record(self, events, event, bytes)
      type(event_table_t), intent(in) :: self                    !! the table
      type(event_list_t), intent(in) :: events                   !! all events
      integer, intent(in) :: event                               !! number of the event
      character(kind=c_char, len=1), intent(out) :: bytes(:)     !! (record) its bytes

      character(:), allocatable :: word
      real(wp) :: numbers(n_event_numbers)
      integer :: at, i, k

      numbers = events%numbers(event)
      bytes = c_null_char
      bytes(1:bytes_of_number) = transfer(numbers(1), bytes)
      at = bytes_of_number
      do k = 1, n_event_words
         word = events%word(event, k)
         do i = 1, min(len(word), self%width(k))
            bytes(at + i) = word(i:i)
         end do
         at = at + self%width(k)
      end do
      bytes(at + 1:) = transfer(numbers(2:), bytes)
   end subroutine encode_record

   !> Close the table.
   subroutine close_table(self)
      class(event_table_t), intent(inout) :: self  !! the table

      integer :: closed

      if (self%id >= 0) call h5dclose_f(self%id, closed)
      if (self%memory >= 0) call h5tclose_f(self%memory, closed)
      self%id = -1
      self%memory = -1
   end subroutine close_table

end module hdf5_events
