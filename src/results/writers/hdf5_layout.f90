!> The layout of run.h5, format 2.2: root attributes, deck, names, one growing dataset per quantity.
!>
!> A group appears if some item of it has a chosen channel, with all such items; a quantity appears
!> if it is chosen for some item, and its dataset then holds all items of the group that appear.
module hdf5_layout
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: n_groups, group_clearances, group_contacts, group_energy, group_requests, &
      group_states
   use channels, only: selection_t
   use hdf5, only: h5dclose_f, h5dwrite_f, h5gclose_f, h5t_ieee_f64le, h5t_native_double, h5t_std_i8le
   use hdf5, only: hid_t, hsize_t
   use hdf5_attributes, only: integer_attribute, text_attribute, word_attribute
   use hdf5_calls, only: new_dataset, new_group
   use hdf5_datasets, only: describe, text_dataset
   use hdf5_scales, only: add_scale, close_scales, has_scale, scales_t, take_scales, take_scales_of_path
   use kinds, only: i8, wp
   use output_plan, only: output_plan_t
   use recorder, only: row_kinds, status_complete, status_failed, status_running, status_stopped
   use text, only: append_text, segment, text_t
   implicit none (type, external)
   private
   public :: dataset_t, make_quantities, make_root, make_row_kind, make_time, rows_of_block, write_status

   integer, parameter :: format_version(2) = [2, 2]  !! major, minor: a reader must know the major number
   integer, parameter :: most_rows = 512, fewest_rows = 8      !! of a block
   integer(i8), parameter :: rows_of_few = 128_i8              !! of a block of a short motion
   integer(i8), parameter :: bytes_of_block = 2097152_i8       !! of the widest dataset, from which the rows follow
   integer, parameter :: longest_status = max(len(status_running), len(status_complete), len(status_stopped), len(status_failed))

   !> One quantity in the file, and its rows that are not yet there.
   type :: dataset_t
      integer(hid_t) :: id = -1                 !! the open dataset
      integer, allocatable :: place(:)          !! (numbers of a row) where they stand in the values of the catalogue
      integer(hsize_t), allocatable :: shape(:) !! (rank) extent of one row, in Fortran's order
      logical :: is_state = .false.             !! contact states, kept as small integers
      real(wp), allocatable :: rows(:, :)       !! (numbers of a row, block) rows to be written [any]
   end type dataset_t

   integer, parameter :: longest_scale = 32                               !! characters of the path of a scale
   character(*), parameter :: axis_names(3) = [character(1) :: "x", "y", "z"]
   character(*), parameter :: parameter_names(4) = [character(2) :: "e0", "e1", "e2", "e3"]

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
      call text_attribute(file, "checksum", "in the last line of a file that is complete or stopped", status)
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
      path = segment(path, 2)
   end function link_path

   !> How many rows make a block: the more, the less they cost, but the file of a short motion has no storage for many that never
   !> come.
   pure integer function rows_of_block(catalogue, n_instant)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      integer(i8), intent(in) :: n_instant        !! output instants that are to come

      integer(i8) :: widest
      integer :: group

      widest = 1
      do group = 1, size(catalogue%groups)
         associate (this => catalogue%groups(group))
            widest = max(widest, 8_i8*this%channel%components*size(catalogue%item_groups(this%item_group)%names))
         end associate
      end do
      rows_of_block = int(max(int(fewest_rows, i8), min(int(most_rows, i8), max(rows_of_few, n_instant), bytes_of_block/widest)))
   end function rows_of_block

   !> The time, the first dimension of all that grows.
   subroutine make_time(file, block, id, status)
      integer(hid_t), intent(in) :: file  !! the file
      integer, intent(in) :: block        !! rows of a chunk
      integer(hid_t), intent(out) :: id   !! the open dataset
      integer, intent(inout) :: status    !! negative: failed

      call new_dataset(file, "time", h5t_ieee_f64le, [0_hsize_t], id, status, chunk=[int(block, hsize_t)])
      call describe(id, "s", "time of the row", "none", status)
   end subroutine make_time

   !> What each row is.
   subroutine make_row_kind(file, block, dataset, status)
      integer(hid_t), intent(in) :: file           !! the file
      integer, intent(in) :: block                 !! rows of a chunk
      type(dataset_t), intent(inout) :: dataset    !! the dataset
      integer, intent(inout) :: status             !! negative: failed

      dataset%is_state = .true.
      allocate (dataset%shape(0), dataset%rows(1, block))
      call new_dataset(file, "row_kind", h5t_std_i8le, [0_hsize_t], dataset%id, status, chunk=[int(block, hsize_t)])
      call describe(dataset%id, "1", "type of the row", "none", status)
      call text_attribute(dataset%id, "kinds", row_kinds, status)
   end subroutine make_row_kind

   !> Names and datasets of everything chosen, and the scales of their dimensions and of the kinds of rows.
   subroutine make_quantities(file, catalogue, selection, block, kinds, datasets, status)
      integer(hid_t), intent(in) :: file                            !! the file
      type(catalogue_t), intent(in) :: catalogue                    !! what can be recorded
      type(selection_t), intent(in) :: selection                    !! what is
      integer, intent(in) :: block                                  !! rows of a chunk
      type(dataset_t), intent(in) :: kinds                          !! what each row is
      type(dataset_t), allocatable, intent(out) :: datasets(:)      !! (n) open datasets
      integer, intent(inout) :: status                              !! negative: failed

      type(scales_t) :: scales
      integer, allocatable :: items(:)
      integer :: group, k, n, item_group

      call add_scale(scales, file, "time", status)
      call take_scales(scales, file, kinds%id, "row_kind", ["time"], status)
      n = 0
      do group = 1, size(catalogue%groups)
         if (selection%has_group(group)) n = n + 1
      end do
      allocate (datasets(n))
      n = 0
      do item_group = 1, n_groups
         items = pack([(k, k=1, size(catalogue%item_groups(item_group)%names))], &
                      [(selection%has_item(catalogue, item_group, k), k=1, size(catalogue%item_groups(item_group)%names))])
         if (size(items) == 0) cycle
         call make_storage(file, catalogue, item_group, items, scales, status)
         do group = 1, size(catalogue%groups)
            if (catalogue%groups(group)%item_group /= item_group .or. .not. selection%has_group(group)) cycle
            n = n + 1
            call make_quantity(file, catalogue, group, items, block, scales, datasets(n), status)
         end do
      end do
      call close_scales(scales, file, status)
   end subroutine make_quantities

   !> The group of a group and the names of its items.
   subroutine make_storage(file, catalogue, item_group, items, scales, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      integer, intent(in) :: item_group                 !! number of the group
      integer, intent(in) :: items(:)             !! (n) items that are kept
      type(scales_t), intent(inout) :: scales     !! gets that of the items
      integer, intent(inout) :: status            !! negative: failed

      integer(hid_t) :: group, radius
      integer :: closed

      associate (this => catalogue%item_groups(item_group))
         call new_group(file, this%name, group, status)
         if (status < 0) return
         call h5gclose_f(group, closed)
         select case (item_group)
         case (group_energy, group_requests, group_states)
            continue
         case (group_contacts)
            call text_dataset(file, "clearances/contact_joint", picked(this%names, items), .false., &
                              "joint of each contact", status)
            call text_dataset(file, "clearances/contact_label", picked(this%labels, items), .false., &
                              "label of each contact within its joint", status)
         case default
            call text_dataset(file, this%name//"/names", picked(this%names, items), .false., &
                              "name of each item", status)
         end select
         if (all(item_group /= [group_energy, group_requests, group_states])) &
            call add_scale(scales, file, scale_of(catalogue, item_group), status)
         if (item_group == group_contacts) call take_scales_of_path(scales, file, "clearances/contact_joint", &
                                                                    [scale_of(catalogue, item_group)], status)
         if (item_group /= group_clearances) return
         call new_dataset(file, this%name//"/clearance", h5t_ieee_f64le, [size(items, kind=hsize_t)], radius, status)
         if (status >= 0) call h5dwrite_f(radius, h5t_native_double, this%radius(items), &
                                          [size(items, kind=hsize_t)], status)
         call describe(radius, "m", "radial clearance of the joint", "none", status)
         if (radius >= 0) call h5dclose_f(radius, closed)
         call take_scales_of_path(scales, file, this%name//"/clearance", [scale_of(catalogue, item_group)], status)
      end associate
   end subroutine make_storage

   !> Path of the scale of a group's items.
   pure function scale_of(catalogue, item_group) result(path)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      integer, intent(in) :: item_group                 !! number of the group
      character(longest_scale) :: path            !! path in the file

      path = trim(catalogue%item_groups(item_group)%name)//"/names"
      if (item_group == group_contacts) path = "clearances/contact_label"
   end function scale_of

   !> Path of the scale of an item's numbers, made when it is first requested.
   subroutine find_components(file, n, scales, path, status)
      integer(hid_t), intent(in) :: file                 !! the file
      integer, intent(in) :: n                           !! numbers of an item, more than one
      type(scales_t), intent(inout) :: scales            !! gets it
      character(longest_scale), intent(out) :: path      !! path in the file
      integer, intent(inout) :: status                   !! negative: failed

      type(text_t), allocatable :: names(:)
      integer :: k

      path = "component"
      if (n == size(parameter_names)) path = "parameter"
      if (has_scale(scales, trim(path))) return
      allocate (names(0))
      do k = 1, n
         if (n == size(parameter_names)) call append_text(names, parameter_names(k))
         if (n < size(parameter_names)) call append_text(names, axis_names(k))
      end do
      call text_dataset(file, trim(path), names, .false., "names of the components", status)
      call add_scale(scales, file, trim(path), status)
   end subroutine find_components

   !> Some of a list of strings.
   pure function picked(list, numbers) result(some)
      type(text_t), intent(in) :: list(:)        !! (n) strings
      integer, intent(in) :: numbers(:)          !! (m) numbers of those requested
      type(text_t), allocatable :: some(:)       !! (m) those

      integer :: k

      allocate (some(size(numbers)))
      do k = 1, size(numbers)
         some(k)%s = list(numbers(k))%s
      end do
   end function picked

   !> The dataset of a quantity.
   subroutine make_quantity(file, catalogue, group, items, block, scales, dataset, status)
      integer(hid_t), intent(in) :: file             !! the file
      type(catalogue_t), intent(in) :: catalogue     !! what can be recorded
      integer, intent(in) :: group                   !! number of the group
      integer, intent(in) :: items(:)                !! (n) items that are kept
      integer, intent(in) :: block                   !! rows of a chunk
      type(scales_t), intent(inout) :: scales        !! those of the file
      type(dataset_t), intent(inout) :: dataset      !! the dataset
      integer, intent(inout) :: status               !! negative: failed

      character(longest_scale) :: dimensions(3)
      character(:), allocatable :: path
      integer(hid_t) :: kind_of_number
      integer(hsize_t) :: rows
      integer :: c, i

      associate (this => catalogue%groups(group), item_group => catalogue%groups(group)%item_group, &
                 components => catalogue%groups(group)%channel%components)
         dataset%place = [((catalogue%place(group, c, items(i)), c=1, components), i=1, size(items))]
         dataset%is_state = item_group == group_contacts .and. this%channel%name == "state"
         allocate (dataset%rows(size(dataset%place), block))
         if (any(item_group == [group_energy, group_requests, group_states])) then
            allocate (dataset%shape(0))
         else if (components == 1) then
            dataset%shape = [size(items, kind=hsize_t)]
         else
            dataset%shape = [int(components, hsize_t), size(items, kind=hsize_t)]
         end if
         rows = block
         kind_of_number = h5t_ieee_f64le
         if (dataset%is_state) kind_of_number = h5t_std_i8le
         path = catalogue%item_groups(item_group)%name//"/"//this%channel%name
         call new_dataset(file, path, kind_of_number, [dataset%shape, 0_hsize_t], dataset%id, status, &
                          chunk=[dataset%shape, rows])
         call describe(dataset%id, this%channel%unit, this%channel%help, this%channel%frame, status)
         if (dataset%is_state) call text_attribute(dataset%id, "states", &
            "0 free, 1 contact, 2 film, 3 mixed, -1 not known", status)
         dimensions(1) = "time"
         dimensions(2) = scale_of(catalogue, item_group)
         if (size(dataset%shape) == 2) call find_components(file, components, scales, dimensions(3), status)
         call take_scales(scales, file, dataset%id, path, dimensions(:size(dataset%shape) + 1), status)
      end associate
   end subroutine make_quantity

end module hdf5_layout
