!> The layout of run.h5, format 2.0: root attributes, deck, names, one growing dataset per quantity.
!>
!> A room appears if some item of it has a chosen channel, with all such items; a quantity appears
!> if it is chosen for some item, and its dataset then holds all items of the room that appear.
module hdf5_layout
   use catalogue, only: catalogue_t, n_rooms, room_clearances, room_contacts, room_energy
   use channels, only: selection_t
   use hdf5, only: h5dclose_f, h5dwrite_f, h5gclose_f, h5t_ieee_f64le, h5t_native_double, h5t_std_i8le
   use hdf5, only: hid_t, hsize_t
   use hdf5_attributes, only: integer_attribute, text_attribute, word_attribute
   use hdf5_calls, only: new_dataset, new_group
   use hdf5_datasets, only: describe, text_dataset
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int64_t, c_null_char
   use kinds, only: wp
   use output_plan, only: output_plan_t
   use recorder, only: row_kinds, status_complete, status_failed, status_running, status_stopped
   use text, only: piece, text_t
   implicit none (type, external)
   private
   public :: dataset_t, make_quantities, make_root, make_row_kind, make_time, write_status

   integer, parameter :: format_version(2) = [2, 0]  !! major, minor: a reader must know the major number
   integer, parameter :: longest_status = max(len(status_running), len(status_complete), len(status_stopped), len(status_failed))

   !> One quantity in the file, and its rows that are not yet there.
   type :: dataset_t
      integer(hid_t) :: id = -1                 !! the open dataset
      integer :: group = 0                      !! its group in the catalogue
      integer :: components = 1                 !! numbers of an item
      integer, allocatable :: items(:)          !! (n) items of the room that are kept
      integer(hsize_t), allocatable :: shape(:) !! (rank) extent of one row, in Fortran's order
      logical :: is_state = .false.             !! contact states, kept as small integers
      real(wp), allocatable :: rows(:, :)       !! (components*n, block) rows to be written [any]
   end type dataset_t

   ! allow(assumed-size)
   interface
      integer(c_int) function c_set_scale(dataset, name) bind(c, name="H5DSset_scale")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: dataset           !! the scale
         character(kind=c_char), intent(in) :: name(*)  !! (n) its name
      end function c_set_scale

      integer(c_int) function c_attach_scale(dataset, scale, dimension) bind(c, name="H5DSattach_scale")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: dataset  !! the dataset
         integer(c_int64_t), value :: scale    !! the scale
         integer(c_int), value :: dimension    !! of the dataset, from 0 in C's order
      end function c_attach_scale
   end interface

contains

   !> What has become of the run: a word of fixed length, since it is replaced when that is known, in one write without new space.
   subroutine write_status(file, word, status)
      integer(hid_t), intent(in) :: file   !! the file
      character(*), intent(in) :: word     !! one of `status_...` of the recorder
      integer, intent(inout) :: status     !! negative: failed

      call word_attribute(file, "status", word, longest_status, status)
   end subroutine write_status

   !> Root attributes and the deck.
   subroutine make_root(file, plan, status)
      integer(hid_t), intent(in) :: file       !! the file
      type(output_plan_t), intent(in) :: plan  !! what it says of the run
      integer, intent(inout) :: status         !! negative: failed

      type(text_t) :: text(1)
      integer :: k

      call text_attribute(file, "filetype", "gudgeon run", status)
      call integer_attribute(file, "format_version", format_version, status)
      call text_attribute(file, "program_version", plan%origin%program_version, status)
      call text_attribute(file, "git_sha1", plan%origin%git_sha1, status)
      call text_attribute(file, "compiler", plan%origin%compiler, status)
      call text_attribute(file, "libraries", plan%origin%libraries, status)
      call text_attribute(file, "title", plan%title, status)
      call write_status(file, status_running, status)
      call text_attribute(file, "status_message", "", status)
      text(1)%s = plan%origin%deck_text
      call text_dataset(file, "deck", text, .true., "the deck, verbatim", status)
      do k = 1, min(size(plan%origin%include_names), size(plan%origin%include_texts))
         text(1)%s = plan%origin%include_texts(k)%s
         call text_dataset(file, "deck_includes/"//link_path(plan%origin%include_names(k)%s), text, .true., &
                           "an included file, verbatim", status)
      end do
   end subroutine make_root

   !> The path of an included file as a path in the file: slashes make groups, dots alone do not count.
   pure function link_path(name) result(path)
      character(*), intent(in) :: name     !! as in the deck
      character(:), allocatable :: path    !! never blank, without `.` and empty parts

      integer :: at, next

      path = ""
      next = 1
      do while (next <= len(name))
         at = index(name(next:), "/")
         if (at == 0) at = len(name) - next + 2
         associate (part => name(next:next + at - 2))
            if (len(part) > 0 .and. part /= ".") path = path//"/"//part
         end associate
         next = next + at
      end do
      if (len(path) == 0) path = "/unnamed"
      path = piece(path, 2)
   end function link_path

   !> The time, a dimension scale for all that grows.
   subroutine make_time(file, block, id, status)
      integer(hid_t), intent(in) :: file  !! the file
      integer, intent(in) :: block        !! rows of a chunk
      integer(hid_t), intent(out) :: id   !! the open dataset
      integer, intent(inout) :: status    !! negative: failed

      call new_dataset(file, "time", h5t_ieee_f64le, [0_hsize_t], id, status, chunk=[int(block, hsize_t)])
      if (status >= 0) status = c_set_scale(int(id, c_int64_t), "time"//c_null_char)
      call describe(id, "s", "time of the row", "none", status)
   end subroutine make_time

   !> What each row is.
   subroutine make_row_kind(file, block, time, dataset, status)
      integer(hid_t), intent(in) :: file           !! the file
      integer, intent(in) :: block                 !! rows of a chunk
      integer(hid_t), intent(in) :: time           !! the dimension scale
      type(dataset_t), intent(inout) :: dataset    !! the dataset
      integer, intent(inout) :: status             !! negative: failed

      dataset%is_state = .true.
      allocate (dataset%shape(0), dataset%rows(1, block))
      call new_dataset(file, "row_kind", h5t_std_i8le, [0_hsize_t], dataset%id, status, chunk=[int(block, hsize_t)])
      call describe(dataset%id, "1", "what the row is", "none", status)
      call text_attribute(dataset%id, "kinds", row_kinds, status)
      if (status >= 0) status = c_attach_scale(int(dataset%id, c_int64_t), int(time, c_int64_t), 0)
   end subroutine make_row_kind

   !> Names and datasets of everything chosen.
   subroutine make_quantities(file, catalogue, selection, block, time, datasets, status)
      integer(hid_t), intent(in) :: file                            !! the file
      type(catalogue_t), intent(in) :: catalogue                    !! what can be recorded
      type(selection_t), intent(in) :: selection                    !! what is
      integer, intent(in) :: block                                  !! rows of a chunk
      integer(hid_t), intent(in) :: time                            !! the dimension scale
      type(dataset_t), allocatable, intent(out) :: datasets(:)      !! (n) open datasets
      integer, intent(inout) :: status                              !! negative: failed

      integer, allocatable :: items(:)
      integer :: group, k, n, room

      n = 0
      do group = 1, size(catalogue%groups)
         if (selection%has_group(group)) n = n + 1
      end do
      allocate (datasets(n))
      n = 0
      do room = 1, n_rooms
         items = pack([(k, k=1, size(catalogue%rooms(room)%names))], &
                      [(selection%has_item(catalogue, room, k), k=1, size(catalogue%rooms(room)%names))])
         if (size(items) == 0) cycle
         call make_room(file, catalogue, room, items, status)
         do group = 1, size(catalogue%groups)
            if (catalogue%groups(group)%room /= room .or. .not. selection%has_group(group)) cycle
            n = n + 1
            call make_quantity(file, catalogue, group, items, block, datasets(n), status)
            if (status >= 0) status = c_attach_scale(int(datasets(n)%id, c_int64_t), int(time, c_int64_t), 0)
         end do
      end do
   end subroutine make_quantities

   !> The group of a room and the names of its items.
   subroutine make_room(file, catalogue, room, items, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      integer, intent(in) :: room                 !! number of the room
      integer, intent(in) :: items(:)             !! (n) items that are kept
      integer, intent(inout) :: status            !! negative: failed

      integer(hid_t) :: group, radius
      integer :: closed

      associate (this => catalogue%rooms(room))
         call new_group(file, this%name, group, status)
         if (status < 0) return
         call h5gclose_f(group, closed)
         select case (room)
         case (room_energy)
            continue
         case (room_contacts)
            call text_dataset(file, "clearances/contact_joint", picked(this%names, items), .false., &
                              "joint of each contact", status)
            call text_dataset(file, "clearances/contact_label", picked(this%labels, items), .false., &
                              "label of each contact within its joint", status)
         case default
            call text_dataset(file, this%name//"/names", picked(this%names, items), .false., &
                              "name of each item", status)
         end select
         if (room /= room_clearances) return
         call new_dataset(file, this%name//"/clearance", h5t_ieee_f64le, [size(items, kind=hsize_t)], radius, status)
         if (status >= 0) call h5dwrite_f(radius, h5t_native_double, this%radius(items), &
                                          [size(items, kind=hsize_t)], status)
         call describe(radius, "m", "radial clearance of the joint", "none", status)
         if (radius >= 0) call h5dclose_f(radius, closed)
      end associate
   end subroutine make_room

   !> Some of a list of strings.
   pure function picked(list, numbers) result(some)
      type(text_t), intent(in) :: list(:)        !! (n) strings
      integer, intent(in) :: numbers(:)          !! (m) numbers of those wanted
      type(text_t), allocatable :: some(:)       !! (m) those

      integer :: k

      allocate (some(size(numbers)))
      do k = 1, size(numbers)
         some(k)%s = list(numbers(k))%s
      end do
   end function picked

   !> The dataset of a quantity.
   subroutine make_quantity(file, catalogue, group, items, block, dataset, status)
      integer(hid_t), intent(in) :: file             !! the file
      type(catalogue_t), intent(in) :: catalogue     !! what can be recorded
      integer, intent(in) :: group                   !! number of the group
      integer, intent(in) :: items(:)                !! (n) items that are kept
      integer, intent(in) :: block                   !! rows of a chunk
      type(dataset_t), intent(inout) :: dataset      !! the dataset
      integer, intent(inout) :: status               !! negative: failed

      character(:), allocatable :: path
      integer(hid_t) :: kind_of_number
      integer(hsize_t) :: rows

      associate (this => catalogue%groups(group), room => catalogue%groups(group)%room)
         dataset%group = group
         dataset%items = items
         dataset%components = this%channel%components
         dataset%is_state = room == room_contacts .and. this%channel%name == "state"
         allocate (dataset%rows(dataset%components*size(items), block))
         if (room == room_energy) then
            allocate (dataset%shape(0))
         else if (dataset%components == 1) then
            dataset%shape = [size(items, kind=hsize_t)]
         else
            dataset%shape = [int(dataset%components, hsize_t), size(items, kind=hsize_t)]
         end if
         rows = block
         kind_of_number = h5t_ieee_f64le
         if (dataset%is_state) kind_of_number = h5t_std_i8le
         path = catalogue%rooms(room)%name//"/"//this%channel%name
         call new_dataset(file, path, kind_of_number, [dataset%shape, 0_hsize_t], dataset%id, status, &
                          chunk=[dataset%shape, rows])
         call describe(dataset%id, this%channel%unit, this%channel%help, this%channel%frame, status)
         if (dataset%is_state) call text_attribute(dataset%id, "states", &
            "0 free, 1 contact, 2 film, 3 mixed, -1 not known", status)
      end associate
   end subroutine make_quantity

end module hdf5_layout
