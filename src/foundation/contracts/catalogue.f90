!> What a scene can report: every channel of every item, with its current values.
!>
!> A group of the catalogue is a list of items of one sort (bodies, joints, ...); a group is one
!> quantity of all the items of a group, one dataset of the output file. The equations fill `values`;
!> results/writers read the rest once and know no kind by name.
module catalogue
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_set_halting_mode, ieee_set_status, ieee_status_type, ieee_usual
   use catalogue_groups, only: group_t, resize_groups
   use groups_of_catalogue, only: add_to_group, has_channel, n_groups, resize_storage, group_clearances, group_contacts, &
        group_paths, item_group_t
   use expression, only: expression_t, most_seen
   use kind_info, only: channel_t, kind_info_t
   use kinds, only: not_a_number, wp
   use readings, only: reading_offer_t, reading_plan_t, readings_t
   implicit none (type, external)
   private
   public :: bound_formula_t, catalogue_t, names_of_channels

   !> An expression over channels, bound to the catalogue that it stands in.
   type :: bound_formula_t
      type(expression_t) :: expression          !! of the time and the channels
      integer :: group = 0                      !! group that its value goes to; 0: a channel that it uses is not there
      integer, allocatable :: source(:, :)      !! (3, channels) group, component and item of each
   end type bound_formula_t

   !> Everything a scene can report.
   type :: catalogue_t
      integer :: n_coordinates = 2                !! of a point: 2 in the plane, 3 in space
      type(item_group_t) :: item_groups(n_groups)              !! (n_item_groups) items
      integer :: n_group = 0                      !! quantities so far
      type(group_t), allocatable :: groups(:)     !! (groups) quantities; while some are added with places for more
      real(wp), allocatable :: values(:)          !! (any) current values of all, SI; NaN: the item has no such channel [any]
      type(reading_offer_t) :: offer              !! what the sets of the system report
      type(reading_plan_t) :: readings            !! what is read of the sets of the system, if it is bound
      integer, allocatable :: magnitudes(:, :)    !! (2, any) requested ones: place in `values`, place before the vector
      type(bound_formula_t), allocatable :: formulas(:)  !! (any) expressions over channels, each after those that it uses
   contains
      procedure :: add_group => catalogue_add_group
      procedure :: add_item => catalogue_add_item
      procedure :: add_kind => catalogue_add_kind
      procedure :: allocate_data => catalogue_allocate_data
      procedure :: find_group => catalogue_find_group
      procedure :: item_has => catalogue_item_has
      procedure :: place => catalogue_place
      procedure :: value => catalogue_value
      procedure :: list => catalogue_list
      procedure :: bind => catalogue_bind
      procedure :: spread_wants => catalogue_spread_wants
      procedure :: work_out => catalogue_work_out
   end type catalogue_t

contains

   !> Number of the group of a group with a given channel name, 0 if there is none.
   pure integer function catalogue_find_group(self, item_group, name) result(found)
      class(catalogue_t), intent(in) :: self  !! the catalogue
      integer, intent(in) :: item_group             !! group to look in
      character(*), intent(in) :: name        !! channel name

      integer :: k

      found = 0
      do k = 1, self%n_group
         if (self%groups(k)%item_group /= item_group) cycle
         if (self%groups(k)%channel%name /= name) cycle
         found = k
         return
      end do
   end function catalogue_find_group

   !> Add a quantity to a group. A vector has as many components as a point has coordinates. One that is there, of another kind of
   !> item, has the components and frames of both.
   subroutine catalogue_add_group(self, item_group, channel)
      class(catalogue_t), intent(inout) :: self  !! the catalogue
      integer, intent(in) :: item_group                !! its group
      type(channel_t), intent(in) :: channel     !! the quantity

      integer :: components, found

      components = merge(self%n_coordinates, channel%components, channel%components == 2)
      found = self%find_group(item_group, channel%name)
      if (found > 0) then
         associate (there => self%groups(found)%channel)
            there%components = max(there%components, components)
            if (index(there%frame, channel%frame) == 0) there%frame = there%frame//", "//channel%frame
         end associate
         return
      end if
      if (.not. allocated(self%groups)) allocate (self%groups(32))
      if (self%n_group == size(self%groups)) call resize_groups(self%groups, self%n_group, 2*self%n_group)
      self%n_group = self%n_group + 1
      associate (group => self%groups(self%n_group))
         group%item_group = item_group
         group%channel = channel
         group%channel%components = components
      end associate
   end subroutine catalogue_add_group

   !> Add all the channels that a kind announces to a group.
   subroutine catalogue_add_kind(self, item_group, info)
      class(catalogue_t), intent(inout) :: self  !! the catalogue
      integer, intent(in) :: item_group                !! group of the kind's items
      type(kind_info_t), intent(in) :: info      !! the kind

      integer :: k

      if (.not. allocated(info%channels)) return
      do k = 1, size(info%channels)
         call self%add_group(item_group, info%channels(k))
      end do
   end subroutine catalogue_add_kind

   !> Add an item to a group.
   subroutine catalogue_add_item(self, item_group, name, label, radius, channels)
      class(catalogue_t), intent(inout) :: self        !! the catalogue
      integer, intent(in) :: item_group                      !! its group
      character(*), intent(in) :: name                 !! its name
      character(*), intent(in), optional :: label      !! of a contact: label within the joint
      real(wp), intent(in), optional :: radius         !! of a clearance joint: radial clearance [m]
      character(*), intent(in), optional :: channels   !! present: it has only these, see `names_of_channels`

      call add_to_group(self%item_groups(item_group), name, label, radius, channels)
   end subroutine catalogue_add_item

   !> The channels of a kind, each between blanks.
   pure function names_of_channels(info) result(list)
      type(kind_info_t), intent(in) :: info  !! the kind
      character(:), allocatable :: list      !! " name name ", " " if it has none

      integer :: k

      list = " "
      if (.not. allocated(info%channels)) return
      do k = 1, size(info%channels)
         list = list//info%channels(k)%name//" "
      end do
   end function names_of_channels

   !> Whether an item has the quantity of a group of its group.
   pure logical function catalogue_item_has(self, group, item) result(has)
      class(catalogue_t), intent(in) :: self  !! the catalogue
      integer, intent(in) :: group            !! number of the group
      integer, intent(in) :: item             !! number of the item in the group's group

      has = self%groups(group)%has(item)
   end function catalogue_item_has

   !> Where a number stands in `values`.
   pure integer function catalogue_place(self, group, component, item) result(place)
      class(catalogue_t), intent(in) :: self  !! the catalogue
      integer, intent(in) :: group            !! number of the group
      integer, intent(in) :: component        !! the component
      integer, intent(in) :: item             !! number of the item in the group's group

      place = self%groups(group)%before + self%groups(group)%channel%components*(item - 1) + component
   end function catalogue_place

   !> Current value of a quantity of an item.
   pure function catalogue_value(self, group, item) result(x)
      class(catalogue_t), intent(in) :: self                   !! the catalogue
      integer, intent(in) :: group                             !! number of the group
      integer, intent(in) :: item                              !! number of the item in the group's group
      real(wp) :: x(self%groups(group)%channel%components)     !! (components) its value [any]

      associate (before => self%place(group, 0, item))
         x = self%values(before + 1:before + size(x))
      end associate
   end function catalogue_value

   !> What a set reports: its channels, and where their values go.
   subroutine catalogue_list(self, item_group, info, offer)
      class(catalogue_t), intent(in) :: self     !! the catalogue
      integer, intent(in) :: item_group  !! group of the set's items; of clearance joints: their contacts have one of their own
      type(kind_info_t), intent(in) :: info      !! its channels
      type(readings_t), intent(inout) :: offer   !! what it reports

      integer :: group, k

      call offer%start(count_channels(info))
      do k = 1, count_channels(info)
         group = self%find_group(item_group, info%channels(k)%name)
         if (group == 0 .and. item_group == group_clearances) group = self%find_group(group_contacts, info%channels(k)%name)
         if (group > 0) call offer%add(info%channels(k)%code, group, 0, 0, info%channels(k)%components)
      end do
   end subroutine catalogue_list

   !> What is read of a set: those of its channels that someone needs of any item, or item by item.
   pure subroutine catalogue_bind(self, offer, readings, columns)
      class(catalogue_t), intent(in) :: self      !! the catalogue
      type(readings_t), intent(in) :: offer       !! what the set reports
      type(readings_t), intent(inout) :: readings !! what is read
      integer, intent(in), optional :: columns(:) !! (items of the set) their places in the group; absent: not item by item

      integer :: i, k, n

      n = 1
      if (present(columns)) n = size(columns)
      call readings%start(n*offer%n)
      do k = 1, offer%n
         associate (this => self%groups(offer%of(k)%group))
            if (present(columns)) then
               do i = 1, n
                  if (this%has(columns(i)) .and. this%is_wanted(columns(i))) call add(columns(i), i, readings)
               end do
            else if (any(this%is_wanted)) then
               call add(1, 0, readings)
            end if
         end associate
      end do

   contains

      !> Add the channel at hand of one item, or of all.
      pure subroutine add(column, item, list)
         integer, intent(in) :: column           !! place in the group of the item, or of the first
         integer, intent(in) :: item             !! item of the set, 0: all
         type(readings_t), intent(inout) :: list !! what is read

         associate (group => offer%of(k)%group)
            call list%add(offer%of(k)%code, group, item, self%place(group, 0, column), self%groups(group)%channel%components)
         end associate
      end subroutine add

   end subroutine catalogue_bind

   !> What requested expressions read is requested too.
   pure subroutine catalogue_spread_wants(self)
      class(catalogue_t), intent(inout) :: self  !! the catalogue

      integer :: k, m

      do k = size(self%formulas), 1, -1
         associate (formula => self%formulas(k))
            if (formula%group == 0) cycle
            if (.not. any(self%groups(formula%group)%is_wanted)) cycle
            do m = 1, size(formula%source, 2)
               self%groups(formula%source(1, m))%is_wanted(formula%source(3, m)) = .true.
            end do
         end associate
      end do
   end subroutine catalogue_spread_wants

   !> Values of the requested expressions, when all else is filled. What does not exist is NaN. No allocation.
   subroutine catalogue_work_out(self, t)
      class(catalogue_t), intent(inout) :: self  !! the catalogue
      real(wp), intent(in) :: t                  !! time [s]

      type(ieee_status_type) :: status
      real(wp) :: slope, value, x(1 + most_seen)
      integer :: k, m

      if (size(self%formulas) == 0) return
      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      x(1) = t
      do k = 1, size(self%formulas)
         associate (formula => self%formulas(k))
            if (formula%group == 0) cycle
            if (.not. self%groups(formula%group)%is_wanted(1)) cycle
            do m = 1, size(formula%source, 2)
               x(1 + m) = self%values(self%place(formula%source(1, m), formula%source(2, m), formula%source(3, m)))
            end do
            call formula%expression%evaluate_seeing(x(:1 + size(formula%source, 2)), 1, value, slope)
            self%values(self%place(formula%group, 1, 1)) = value
         end associate
      end do
      call ieee_set_status(status)
   end subroutine catalogue_work_out

   !> How many channels a kind has.
   pure integer function count_channels(info)
      type(kind_info_t), intent(in) :: info  !! the kind

      count_channels = 0
      if (allocated(info%channels)) count_channels = size(info%channels)
   end function count_channels

   !> Make storage for the values, all NaN; no more items come.
   subroutine catalogue_allocate_data(self)
      class(catalogue_t), intent(inout) :: self  !! the catalogue

      character(:), allocatable :: word
      integer :: item, k, n

      do k = 1, n_groups
         self%item_groups(k)%name = trim(group_paths(k))
         call resize_storage(self%item_groups(k), self%item_groups(k)%n)
      end do
      call resize_groups(self%groups, self%n_group, self%n_group)
      if (.not. allocated(self%formulas)) allocate (self%formulas(0))
      n = 0
      do k = 1, size(self%groups)
         associate (group => self%groups(k))
            if (allocated(group%has)) deallocate (group%has, group%is_wanted)
            allocate (group%is_wanted(size(self%item_groups(group%item_group)%names)), source=.true.)
            word = " "//group%channel%name//" "
            if (group%vector > 0) then
               group%has = self%groups(group%vector)%has
            else
               group%has = [(has_channel(self%item_groups(group%item_group), word, item), item=1, size(group%is_wanted))]
            end if
            group%before = n
            n = n + group%channel%components*size(group%has)
         end associate
      end do
      if (allocated(self%values)) deallocate (self%values)
      allocate (self%values(n), source=not_a_number())
   end subroutine catalogue_allocate_data

end module catalogue
