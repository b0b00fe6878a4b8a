!> The file of a motion for other programs: its groups and datasets, as VTKHDF 2.0 prescribes them for PolyData that moves.
!>
!> One part whose cells never change: `NumberOfPoints` and the cells stand once, all steps point to them (offsets 0); `Points`, and
!> the data at points, have the rows of all steps one after the other. Points are the vertices of the outlines, body by body, then
!> the contacts. Source: VTK, "VTKHDF File Format", version 2.0.
module motion_layout
   use drawing, only: drawing_t, in_pictures
   use hdf5, only: h5dclose_f, h5dwrite_f, h5gclose_f, h5gopen_f, h5t_ieee_f64le, h5t_native_integer, h5t_std_i64le, hid_t, hsize_t
   use hdf5_attributes, only: integer_attribute, long_attribute, text_attribute, word_attribute
   use hdf5_calls, only: new_dataset, new_group
   use hdf5_datasets, only: describe
   use, intrinsic :: iso_c_binding, only: c_loc
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: growing_t, make_cells, make_steps, most_growing, point_layout_t, root_group, set_steps

   character(*), parameter :: root_group = "VTKHDF"             !! where VTK looks
   character(*), parameter :: steps = root_group//"/Steps"      !! what moves
   character(*), parameter :: data_of_type = "PolyData"         !! type of the data
   integer, parameter :: version(2) = [2, 0]                    !! of the format
   integer, parameter :: most_growing = 17                      !! datasets that grow

   !> A dataset that grows by some rows with each step.
   type :: growing_t
      integer(hid_t) :: id = -1                      !! the open dataset
      integer(hsize_t), allocatable :: shape(:)      !! (rank - 1) extent of a row
      integer :: n_row = 1                           !! rows of a step
      real(wp) :: per_step = 0.0_wp                  !! of offsets: what each step adds [1]
      real(wp), allocatable :: rows(:, :)            !! (values of a step, block) steps that wait [any]
   end type growing_t

   !> How the points of a step follow one another.
   type :: point_layout_t
      integer :: n_outline = 0   !! vertices of outlines
      integer :: n_contact = 0   !! contacts
      integer :: n = 0           !! both
   end type point_layout_t

contains

   !> Group, attributes and cells: what does not change.
   subroutine make_cells(file, drawing, n_contact, layout, status)
      integer(hid_t), intent(in) :: file           !! the file
      type(drawing_t), intent(in) :: drawing       !! outlines
      integer, intent(in) :: n_contact             !! contacts
      type(point_layout_t), intent(out) :: layout  !! points of a step
      integer, intent(inout) :: status             !! negative: failed

      integer(hid_t) :: group
      integer, allocatable :: bodies(:), faces(:), first(:), lines(:)
      integer :: closed, k

      call new_group(file, root_group, group, status)
      call integer_attribute(group, "Version", version, status)
      call word_attribute(group, "Type", data_of_type, len(data_of_type), status)
      if (group >= 0) call h5gclose_f(group, closed)
      layout%n_outline = sum([(size(drawing%parts(k)%s, 2), k=1, drawing%n_part)])
      layout%n_contact = n_contact
      layout%n = layout%n_outline + n_contact
      call long_dataset(file, root_group//"/NumberOfPoints", [layout%n], status)
      allocate (bodies(n_contact), source=-1)
      call make_kind("Vertices", [(k, k=0, n_contact)], [(layout%n_outline + k - 1, k=1, n_contact)])
      call list_strokes(drawing, .false., lines, first, bodies)
      call make_kind("Lines", first, lines)
      call list_strokes(drawing, .true., faces, first, bodies)
      call make_kind("Polygons", first, faces)
      call make_kind("Strips", [0], [integer ::])
      call long_dataset(file, root_group//"/CellData/body", bodies, status)
      call long_dataset(file, root_group//"/CellData/contact", [(k, k=1, n_contact), (0, k=1, size(bodies) - n_contact)], status)

   contains

      !> Cells of one kind.
      subroutine make_kind(name, offsets, connectivity)
         character(*), intent(in) :: name           !! of the group
         integer, intent(in) :: offsets(:)          !! (cells + 1) where the points of each cell start
         integer, intent(in) :: connectivity(:)     !! (any) points, from 0

         call long_dataset(file, root_group//"/"//name//"/NumberOfCells", [size(offsets) - 1], status)
         call long_dataset(file, root_group//"/"//name//"/NumberOfConnectivityIds", [size(connectivity)], status)
         call long_dataset(file, root_group//"/"//name//"/Offsets", offsets, status)
         call long_dataset(file, root_group//"/"//name//"/Connectivity", connectivity, status)
      end subroutine make_kind

   end subroutine make_cells

   !> The lines, or the faces, of all parts; their bodies are appended to a list.
   subroutine list_strokes(drawing, are_faces, vertices, first, bodies)
      type(drawing_t), intent(in) :: drawing               !! outlines
      logical, intent(in) :: are_faces                     !! faces, not lines
      integer, allocatable, intent(out) :: vertices(:)     !! (any) their points, from 0
      integer, allocatable, intent(out) :: first(:)        !! (strokes + 1) where those of each start, from 0
      integer, allocatable, intent(inout) :: bodies(:)     !! (any) grown

      integer, allocatable :: of(:)
      integer :: at, j, k, m, n, pass

      do pass = 1, 2
         at = 0
         m = 0
         n = 0
         do k = 1, drawing%n_part
            associate (part => drawing%parts(k))
               do j = 1, size(part%strokes)
                  if (part%strokes(j)%is_face .neqv. are_faces) cycle
                  if (part%strokes(j)%use == in_pictures) cycle
                  if (pass == 2) then
                     vertices(m + 1:m + size(part%strokes(j)%vertices)) = at + part%strokes(j)%vertices - 1
                     first(n + 1) = m
                     of(n + 1) = part%body
                  end if
                  m = m + size(part%strokes(j)%vertices)
                  n = n + 1
               end do
               at = at + size(part%s, 2)
            end associate
         end do
         if (pass == 1) allocate (vertices(m), first(n + 1), of(n), source=0)
      end do
      first(n + 1) = m
      bodies = [bodies, of]
   end subroutine list_strokes

   !> The datasets that grow, in the order in which they are filled: points, their data, then times and offsets.
   subroutine make_steps(file, layout, block, list, status)
      integer(hid_t), intent(in) :: file              !! the file
      type(point_layout_t), intent(in) :: layout      !! points of a step
      integer, intent(in) :: block                    !! steps of a chunk
      type(growing_t), intent(out) :: list(most_growing) !! (most_growing) open datasets, the times as the last
      integer, intent(inout) :: status                !! negative: failed

      character(*), parameter :: at_points(4) = [character(12) :: "velocity", "normal_force", "penetration", "state"]
      character(*), parameter :: units(4) = [character(3) :: "m/s", "N", "m", "1"]
      character(*), parameter :: helps(4) = [character(64) :: "velocity", "normal force of a contact, 0 elsewhere", &
                                             "penetration of a contact, 0 elsewhere", &
                                             "-1 no contact, 0 free, 1 contact, 2 film, 3 mixed"]
      character(*), parameter :: of_cells(2) = [character(7) :: "body", "contact"]
      integer(hsize_t), parameter :: one(0) = [integer(hsize_t) ::]
      integer :: k

      call grow("/Points", [3_hsize_t], layout%n, h5t_ieee_f64le, 0, list(1))
      call describe(list(1)%id, "m", "vertices of outlines, then contacts", "world", status)
      call grow("/PointData/velocity", [3_hsize_t], layout%n, h5t_ieee_f64le, 0, list(2))
      do k = 2, 4
         call grow("/PointData/"//trim(at_points(k)), one, layout%n, h5t_ieee_f64le, 0, list(k + 1))
      end do
      do k = 1, 4
         call describe(list(k + 1)%id, trim(units(k)), trim(helps(k)), merge("world", "none ", k == 1), status)
         call grow("/Steps/PointDataOffsets/"//trim(at_points(k)), one, 1, h5t_std_i64le, layout%n, list(k + 5))
      end do
      call grow("/Steps/PointOffsets", one, 1, h5t_std_i64le, layout%n, list(10))
      call grow("/Steps/NumberOfParts", one, 1, h5t_std_i64le, 0, list(11))
      call grow("/Steps/PartOffsets", one, 1, h5t_std_i64le, 0, list(12))
      call grow("/Steps/CellOffsets", [4_hsize_t], 1, h5t_std_i64le, 0, list(13))
      call grow("/Steps/ConnectivityIdOffsets", [4_hsize_t], 1, h5t_std_i64le, 0, list(14))
      do k = 1, 2
         call grow("/Steps/CellDataOffsets/"//trim(of_cells(k)), one, 1, h5t_std_i64le, 0, list(14 + k))
      end do
      call grow("/Steps/Values", one, 1, h5t_ieee_f64le, 0, list(17))
      call describe(list(17)%id, "s", "time of the step", "none", status)
      list(11)%rows = 1.0_wp
      call set_steps(file, 0, status)

   contains

      !> A dataset that grows.
      subroutine grow(name, shape, n_row, type_id, per_step, this)
         character(*), intent(in) :: name              !! its path below the root of VTK
         integer(hsize_t), intent(in) :: shape(:)      !! (rank - 1) extent of a row
         integer, intent(in) :: n_row                  !! rows of a step
         integer(hid_t), intent(in) :: type_id         !! type in the file
         integer, intent(in) :: per_step               !! what each step adds to it
         type(growing_t), intent(out) :: this          !! the dataset

         this%shape = shape
         this%n_row = n_row
         this%per_step = real(per_step, wp)
         allocate (this%rows(product(shape)*n_row, block), source=0.0_wp)
         call new_dataset(file, root_group//name, type_id, [shape, 0_hsize_t], this%id, status, &
                          chunk=[shape, int(max(n_row, 1)*block, hsize_t)])
      end subroutine grow

   end subroutine make_steps

   !> Say how many steps there are: an attribute replaced in its place.
   subroutine set_steps(file, n, status)
      integer(hid_t), intent(in) :: file  !! the file
      integer, intent(in) :: n            !! number of steps
      integer, intent(inout) :: status    !! negative: failed

      integer(hid_t) :: group
      integer :: closed

      if (status < 0) return
      call h5gopen_f(file, steps, group, status)
      call long_attribute(group, "NSteps", int(n, i8), status)
      if (group >= 0) call h5gclose_f(group, closed)
   end subroutine set_steps

   !> Make a dataset of 64-bit integers and write it.
   subroutine long_dataset(file, path, values, status)
      integer(hid_t), intent(in) :: file     !! file or group
      character(*), intent(in) :: path       !! path within it
      integer, intent(in) :: values(:)       !! (n) the numbers
      integer, intent(inout) :: status       !! negative: failed

      integer, allocatable, target :: store(:)
      integer(hid_t) :: dataset
      integer :: closed

      call new_dataset(file, path, h5t_std_i64le, [size(values, kind=hsize_t)], dataset, status)
      store = [values, 0]
      if (status >= 0 .and. size(values) > 0) call h5dwrite_f(dataset, h5t_native_integer, c_loc(store), status)
      if (dataset >= 0) call h5dclose_f(dataset, closed)
   end subroutine long_dataset

end module motion_layout
