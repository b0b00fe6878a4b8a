!> Reading a run.h5 back: every number that it holds as a time history by its name, and its impacts.
!> Limits: as many rows as /time has, so that a run that continues or was killed can be read.
module run_history
   use checksum, only: seal_none, seal_state, seal_wrong, survives
   use errors, only: error_t, exit_file, set_error
   use hdf5, only: h5aclose_f, h5aexists_f, h5aget_space_f, h5aopen_f, h5aread_f, h5dclose_f, h5dget_space_f, h5dopen_f, h5dread_f
   use hdf5, only: h5dvlen_reclaim_f, h5fclose_f, h5fopen_f, h5p_default_f
   use hdf5, only: h5gclose_f, h5gget_info_f, h5gopen_f, h5lexists_f, h5lget_name_by_idx_f, h5sclose_f
   use hdf5, only: h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f, h5tclose_f, h5tcreate_f, h5tinsert_f
   use hdf5, only: h5f_acc_rdonly_f, h5t_compound_f, h5t_native_double, h5_index_name_f, h5_iter_inc_f, hid_t, hsize_t, size_t
   use hdf5_attributes, only: string_type, word_type
   use hdf5_calls, only: open_library
   use hdf5_read, only: has_dataset, read_reals, read_texts
   use history_extremes, only: read_extremes
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_loc, c_null_char, c_ptr
   use kinds, only: pi, wp
   use recorder, only: status_complete, status_stopped
   use series, only: append_series, history_t, impact_t, series_t
   use text, only: append_text, starts_with, text_t
   implicit none (type, external)
   private
   public :: read_histories, read_run

   character(10), parameter :: names(10) = [character(10) :: "bodies", "joints", "drivers", "clearances", "forces", "energy", &
                                             "points", "motions", "reactions", "requests"]
   !> Angles from -pi to pi.
   character(*), parameter :: wrapped(2) = [character(33) :: "joints/angle", "clearances/contacts/contact_angle"]
   integer, parameter :: longest_word = 256   !! bytes of a word of /events

contains

   !> Read a run. One that is complete or stopped carries its checksum, which is looked at first; any other is read in a copy of
   !> this process before, which the library may end if the file is damaged.
   subroutine read_run(path, history, error)
      character(*), intent(in) :: path                    !! of the file
      type(history_t), intent(out) :: history             !! what it holds
      type(error_t), allocatable, intent(out) :: error    !! it is no run, is damaged, or cannot be read

      integer :: state
      logical :: has_lost_it

      state = seal_state(path)
      if (state == seal_none) then
         if (.not. survives(can_be_taken, path)) state = seal_wrong
      end if
      if (state == seal_wrong) then
         call set_error(error, exit_file, "cannot read '"//path//"': it is corrupt, was changed after it was written, or is "// &
            "not a "// &
                        "file of gudgeon; run the deck again")
         return
      end if
      call take_run(path, history, has_lost_it, error)
      if (.not. has_lost_it .or. state /= seal_none .or. allocated(error)) return
      call set_error(error, exit_file, "cannot read '"//path//"': its checksum is missing; the file was truncated or changed "// &
                     "after it was written; run the deck again")
   end subroutine read_run

   !> Whether a run can be read, or refused with words.
   logical function can_be_taken(path)
      character(*), intent(in) :: path                    !! of the file

      type(error_t), allocatable :: error
      type(history_t) :: history
      logical :: ignored

      call take_run(path, history, ignored, error)
      can_be_taken = .true.
   end function can_be_taken

   !> Whether a file says that it has come to its end with a checksum.
   logical function should_have_checksum(file)
      integer(hid_t), intent(in) :: file                  !! the file

      character(kind=c_char), target :: bytes(longest_word)
      character(longest_word) :: word
      type(c_ptr) :: memory
      integer(hid_t) :: attribute, type_id
      integer :: closed, k, status

      call h5aexists_f(file, "checksum", should_have_checksum, status)
      if (status < 0 .or. .not. should_have_checksum) return
      should_have_checksum = .false.
      call h5aopen_f(file, "status", attribute, status)
      if (status < 0) return
      call word_type(longest_word, type_id, status)
      bytes = c_null_char
      memory = c_loc(bytes)
      if (status >= 0) call h5aread_f(attribute, type_id, memory, status)
      call h5aclose_f(attribute, closed)
      do k = 1, longest_word
         word(k:k) = bytes(k)
      end do
      k = index(word//c_null_char, c_null_char)
      should_have_checksum = status >= 0 .and. (word(:k - 1) == status_complete .or. word(:k - 1) == status_stopped)
   end function should_have_checksum

   !> Read a run as it is.
   subroutine take_run(path, history, has_lost_it, error)
      character(*), intent(in) :: path                    !! of the file
      type(history_t), intent(out) :: history             !! what it holds
      logical, intent(out) :: has_lost_it                 !! it should have a checksum
      type(error_t), allocatable, intent(out) :: error    !! it is no run, or cannot be read

      integer(hid_t) :: file
      integer :: closed, status

      has_lost_it = .false.
      status = 0
      call open_library(status)
      if (status >= 0) call h5fopen_f(path, h5f_acc_rdonly_f, file, status)
      if (status < 0) then
         call set_error(error, exit_file, "cannot read '"//path//"': not an HDF5 file, or not readable")
         return
      end if
      has_lost_it = should_have_checksum(file)
      if (.not. has_top(file, "time")) then
         call set_error(error, exit_file, "'"//path//"' is not the run.h5 of a run with time histories: it has no /time")
      else
         call read_histories(file, history, status)
         if (has_top(file, "extremes")) call read_extremes(file, history, status)
         if (has_top(file, "events")) call read_impacts(file, history, status)
         if (status < 0) call set_error(error, exit_file, "cannot read '"//path//"': the file is corrupt, or has another format")
      end if
      history%path = path
      call h5fclose_f(file, closed)
   end subroutine take_run

   !> The time histories of a run, which is a whole file or a group of the file of a sweep.
   subroutine read_histories(place, history, status)
      integer(hid_t), intent(in) :: place              !! the file or group
      type(history_t), intent(out) :: history          !! times and numbers; no impacts
      integer, intent(inout) :: status                 !! negative: failed

      real(wp), allocatable :: kinds(:)
      integer :: k

      allocate (history%list(0), history%impacts(0))
      call read_reals(place, "time", history%time, status)
      call read_reals(place, "row_kind", kinds, status)
      history%is_output = kinds(:size(history%time)) < 0.5_wp
      do k = 1, size(names)
         if (has_top(place, trim(names(k)))) call read_channel_group(place, trim(names(k)), history, status)
      end do
   end subroutine read_histories

   !> Whether the file has something of some name at its top.
   logical function has_top(file, name)
      integer(hid_t), intent(in) :: file   !! the file
      character(*), intent(in) :: name     !! what is searched

      integer :: status

      call h5lexists_f(file, name, has_top, status)
      has_top = has_top .and. status >= 0
   end function has_top

   !> All numbers of a group.
   subroutine read_channel_group(file, item_group, history, status)
      integer(hid_t), intent(in) :: file            !! the file
      character(*), intent(in) :: item_group              !! name of the group
      type(history_t), intent(inout) :: history     !! grown
      integer, intent(inout) :: status              !! negative: failed

      type(text_t), allocatable :: contacts(:), items(:), labels(:)
      integer :: k

      allocate (items(0), contacts(0))
      if (item_group == "energy") call append_text(items, "energy")
      if (item_group == "requests") call append_text(items, "request")
      if (has_dataset(file, item_group, "names")) call read_texts(file, item_group//"/names", items, status)
      call read_group(file, item_group, items, history, status)
      if (.not. has_dataset(file, item_group, "contact_joint")) return
      call read_texts(file, item_group//"/contact_joint", contacts, status)
      call read_texts(file, item_group//"/contact_label", labels, status)
      do k = 1, size(contacts)
         if (labels(k)%s /= "") contacts(k)%s = contacts(k)%s//"."//labels(k)%s
      end do
      if (has_dataset(file, item_group, "contacts")) call read_group(file, item_group//"/contacts", contacts, history, status)
   end subroutine read_channel_group

   !> All numbers of a group, whose datasets have a row for each time and a column for each item.
   subroutine read_group(file, group, items, history, status)
      integer(hid_t), intent(in) :: file            !! the file
      character(*), intent(in) :: group             !! its path
      type(text_t), intent(in) :: items(:)          !! (n) names of the columns
      type(history_t), intent(inout) :: history     !! grown
      integer, intent(inout) :: status              !! negative: failed

      character(256) :: name
      integer(hid_t) :: place
      integer(hsize_t) :: i
      integer, allocatable :: shape(:)
      integer :: closed, most, n, storage

      if (status < 0 .or. size(items) == 0) return
      call h5gopen_f(file, group, place, status)
      if (status < 0) return
      call h5gget_info_f(place, storage, n, most, status)
      do i = 0, int(n - 1, hsize_t)
         if (status < 0) exit
         call h5lget_name_by_idx_f(place, ".", h5_index_name_f, h5_iter_inc_f, i, name, status)
         if (trim(name) == "contacts") cycle
         call shape_of(file, group//"/"//trim(name), shape, status)
         if (status < 0) exit
         if (size(shape) < 1) cycle
         if (shape(size(shape)) < size(history%time)) cycle     ! no history: names, clearances
         if (size(shape) > 1) then
            if (shape(size(shape) - 1) /= size(items)) cycle
         else if (group /= "energy" .and. group /= "requests") then
            cycle
         end if
         call read_quantity(file, group//"/"//trim(name), trim(name), items, shape, history, status)
      end do
      call h5gclose_f(place, closed)
   end subroutine read_group

   !> The shape of a dataset, the fastest index first.
   subroutine shape_of(file, path, shape, status)
      integer(hid_t), intent(in) :: file                 !! the file
      character(*), intent(in) :: path                   !! of the dataset
      integer, allocatable, intent(out) :: shape(:)      !! (rank) its extents
      integer, intent(inout) :: status                   !! negative: failed

      integer(hid_t) :: dataset, space
      integer(hsize_t), allocatable :: extent(:), most(:)
      integer :: closed, rank, ignored

      allocate (shape(0))
      call h5dopen_f(file, path, dataset, status)
      if (status < 0) return
      call h5dget_space_f(dataset, space, status)
      if (status >= 0) call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status < 0) return
      allocate (extent(rank), most(rank))
      if (rank > 0) call h5sget_simple_extent_dims_f(space, extent, most, ignored)
      shape = int(extent)
      call h5sclose_f(space, closed)
      call h5dclose_f(dataset, closed)
   end subroutine shape_of

   !> A quantity of all items of a group; numbers that an item does not have are omitted. A request is there
   !> even if none of its values is a number.
   subroutine read_quantity(file, path, quantity, items, shape, history, status)
      integer(hid_t), intent(in) :: file            !! the file
      character(*), intent(in) :: path              !! of the dataset
      character(*), intent(in) :: quantity          !! its name
      type(text_t), intent(in) :: items(:)          !! (n) names of the columns
      integer, intent(in) :: shape(:)               !! (rank) the fastest index first
      type(history_t), intent(inout) :: history     !! grown
      integer, intent(inout) :: status              !! negative: failed

      character(2), parameter :: axes(4) = ["x ", "y ", "z ", "  "], parameters(4) = ["e0", "e1", "e2", "e3"]
      type(series_t), allocatable :: more(:)
      logical, allocatable :: is_kept(:)
      real(wp), allocatable :: all(:)
      character(:), allocatable :: unit
      integer :: c, i, n, n_component, row

      n_component = 1
      if (size(shape) == 3) n_component = shape(1)
      if (size(shape) > 3 .or. n_component > 4) return
      call read_reals(file, path, all, status)
      call unit_of(file, path, unit, status)
      if (status < 0) return
      n = size(history%time)
      allocate (more(n_component*size(items)), is_kept(n_component*size(items)))
      i = 0
      do row = 1, size(items)
         do c = 1, n_component
            i = i + 1
            more(i)%name = items(row)%s//"."//quantity
            if (size(shape) == 3) more(i)%name = more(i)%name//"."//trim(merge(parameters(c), axes(c), n_component == 4))
            more(i)%unit = unit
            more(i)%is_state = path == "clearances/contacts/state"
            if (any(wrapped == path)) more(i)%turn = 2.0_wp*pi
            more(i)%x = all(i:i + (n - 1)*size(more):size(more))
         end do
      end do
      do i = 1, size(more)
         is_kept(i) = .not. all_missing(more(i)%x) .or. starts_with(path, "requests/")
      end do
      call append_series(history%list, more, is_kept)
   end subroutine read_quantity

   !> Whether none of the values is a number.
   pure logical function all_missing(x)
      real(wp), intent(in) :: x(:)  !! (n) values [any]

      all_missing = all(ieee_is_nan(x))
   end function all_missing

   !> The attribute `units` of a dataset.
   subroutine unit_of(file, path, unit, status)
      integer(hid_t), intent(in) :: file                     !! the file
      character(*), intent(in) :: path                       !! of the dataset
      character(:), allocatable, intent(out) :: unit         !! SI
      integer, intent(inout) :: status                       !! negative: failed

      type(c_ptr), target :: pointer
      type(c_ptr) :: memory
      character(kind=c_char), pointer :: bytes(:)
      integer(hid_t) :: attribute, dataset, space, type_id
      integer :: closed, k

      unit = ""
      if (status < 0) return
      call h5dopen_f(file, path, dataset, status)
      if (status >= 0) call h5aopen_f(dataset, "units", attribute, status)
      call string_type(type_id, status)
      if (status < 0) return
      memory = c_loc(pointer)
      call h5aread_f(attribute, type_id, memory, status)
      if (status >= 0 .and. c_associated(pointer)) then
         call c_f_pointer(pointer, bytes, [64])
         do k = 1, size(bytes)
            if (bytes(k) == c_null_char) exit
            unit = unit//bytes(k)
         end do
         call h5aget_space_f(attribute, space, closed)
         call h5dvlen_reclaim_f(type_id, space, h5p_default_f, memory, closed)
         call h5sclose_f(space, closed)
      end if
      call h5tclose_f(type_id, closed)
      call h5aclose_f(attribute, closed)
      call h5dclose_f(dataset, closed)
   end subroutine unit_of

   !> The contacts among the events.
   subroutine read_impacts(file, history, status)
      integer(hid_t), intent(in) :: file            !! the file
      type(history_t), intent(inout) :: history     !! grown
      integer, intent(inout) :: status              !! negative: failed

      character(16), parameter :: numbers(3) = [character(16) :: "time", "impact_speed", "peak_force"]
      character(16), parameter :: words(3) = [character(16) :: "kind", "item", "contact"]
      integer, parameter :: real_bytes = storage_size(1.0_wp)/8, record = 3*(real_bytes + longest_word)
      character(kind=c_char), allocatable, target :: bytes(:)
      type(impact_t) :: new
      type(impact_t), allocatable :: impacts(:)
      type(c_ptr) :: memory
      integer(hid_t) :: dataset, type_id, word
      integer, allocatable :: shape(:)
      integer :: closed, i, k, n

      if (status < 0) return
      call shape_of(file, "events", shape, status)
      if (status < 0 .or. size(shape) /= 1) return
      if (shape(1) == 0) return
      call h5tcreate_f(h5t_compound_f, int(record, size_t), type_id, status)
      do k = 1, 3
         if (status >= 0) call h5tinsert_f(type_id, trim(numbers(k)), int((k - 1)*real_bytes, size_t), h5t_native_double, status)
      end do
      call word_type(longest_word, word, status)
      do k = 1, 3
         if (status >= 0) call h5tinsert_f(type_id, trim(words(k)), int(3*real_bytes + (k - 1)*longest_word, size_t), word, status)
      end do
      allocate (bytes(record*shape(1)))
      memory = c_loc(bytes)
      if (status >= 0) call h5dopen_f(file, "events", dataset, status)
      if (status < 0) return
      call h5dread_f(dataset, type_id, memory, status)
      call h5dclose_f(dataset, closed)
      call h5tclose_f(type_id, closed)
      call h5tclose_f(word, closed)
      if (status < 0) return
      n = 0
      allocate (impacts(shape(1)))
      do i = 1, shape(1)
         associate (part => bytes((i - 1)*record + 1:i*record))
            if (word_of(part, 1) /= "contact") cycle
            n = n + 1
            new%item = word_of(part, 2)
            if (word_of(part, 3) /= "") new%item = new%item//"."//word_of(part, 3)
            new%time = transfer(part(1:real_bytes), new%time)
            new%speed = transfer(part(real_bytes + 1:2*real_bytes), new%speed)
            new%force = transfer(part(2*real_bytes + 1:3*real_bytes), new%force)
            impacts(n) = new
         end associate
      end do
      history%impacts = impacts(:n)
   end subroutine read_impacts

   !> A word of a record.
   pure function word_of(part, k) result(word)
      character(kind=c_char), intent(in) :: part(:)   !! (record) its bytes
      integer, intent(in) :: k                        !! number of the word
      character(:), allocatable :: word               !! without padding

      integer :: first, i

      word = ""
      first = 3*storage_size(1.0_wp)/8 + (k - 1)*longest_word
      do i = first + 1, first + longest_word
         if (part(i) == c_null_char) exit
         word = word//part(i)
      end do
   end function word_of

end module run_history
