!> Requests of a deck, and what its loads see of the motion: names become places.
module read_requests
   use columns, only: find_column
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use expression, only: expression_t
   use item, only: item_t, location_t, place_of
   use kind_info, only: cell_expression
   use kind_list, only: kind_named
   use kinds, only: wp
   use name_table, only: name_table_t
   use references, only: add_names, directory_t, resolve
   use requests, only: requests_t
   use scene, only: scene_t, table_bodies, table_formulas, table_motions, table_points, table_reactions
   use observable, only: place_t, sees_angle, sees_angular_velocity, sees_distance, sees_distance_rate, sees_state, observable_t
   use state_equations, only: state_prefix
   use observable_words, only: read_observable_word
   use spelling, only: nearest_word
   use tables, only: read_items
   use text, only: text_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: make_requests, place_observable, place_observables, requests_from_deck

contains

   !> The tables of requests, their references resolved but for joints.
   subroutine requests_from_deck(deck, directory, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(directory_t), intent(in) :: directory          !! names of bodies and points
      type(scene_t), intent(inout) :: scene               !! tables are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      associate (tables => scene%tables%requests)
         tables(table_formulas)%info => kind_named("request", scene%settings%is_spatial)
         tables(table_motions)%info => kind_named("request.motion", scene%settings%is_spatial)
         tables(table_reactions)%info => kind_named("request.reaction", scene%settings%is_spatial)
         do k = 1, size(tables)
            call read_items(deck, tables(k)%info, tables(k)%items, diagnostics)
            call resolve(directory, tables(k)%info, tables(k)%items, diagnostics)
         end do
      end associate
   end subroutine requests_from_deck

   !> Requests of a scene whose points are placed; expressions over channels wait until these are known.
   subroutine make_requests(scene, diagnostics)
      type(scene_t), intent(inout) :: scene               !! requests are set; those of before are gone
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      associate (requests => scene%requests, tables => scene%tables%requests)
         requests = requests_t()
         requests%is_spatial = scene%settings%is_spatial
         allocate (requests%motions(size(tables(table_motions)%items)), requests%reactions(size(tables(table_reactions)%items)))
         allocate (requests%formulas(0))
         do k = 1, size(requests%motions)
            associate (item => tables(table_motions)%items(k))
               requests%motions(k)%name = item%name
               requests%motions(k)%place = place_of_row(scene, item)
               requests%motions(k)%place%turns_with = item%word("observer") == "frame"
            end associate
         end do
         do k = 1, size(requests%reactions)
            associate (item => tables(table_reactions)%items(k), reaction => requests%reactions(k))
               reaction%name = item%name
               reaction%joint = item%word("joint")
               reaction%on_j = item%word("on") == "j"
               reaction%has_point = item%reference("point") > 0
               if (reaction%has_point) call take_point(scene, item%reference("point"), reaction%place%body, reaction%place%s)
               reaction%place%frame = item%reference("frame")
               call check_joint(scene, item, diagnostics)
            end associate
         end do
         call list_points(scene)
      end associate
   end subroutine make_requests

   !> The place of a row of [request.motion].
   function place_of_row(scene, item) result(place)
      type(scene_t), intent(in) :: scene   !! the scene
      type(item_t), intent(in) :: item     !! the row
      type(place_t) :: place               !! its point, from where, along which axes

      call take_point(scene, item%reference("point"), place%body, place%s)
      place%frame = item%reference("frame")
      if (item%reference("from") > 0) then
         call take_point(scene, item%reference("from"), place%origin_body, place%origin_s)
      else
         place%origin_body = place%frame
      end if
   end function place_of_row

   !> Body and coordinates of a point.
   subroutine take_point(scene, point, body, s)
      type(scene_t), intent(in) :: scene   !! the scene
      integer, intent(in) :: point         !! number of the point
      integer, intent(out) :: body         !! its body
      real(wp), intent(out) :: s(3)        !! (3) its coordinates there [m]

      body = scene%points%body(point)
      s = scene%points%s(:, point)
   end subroutine take_point

   !> A reaction is that of a joint, a driver, a joint with clearance, or a force between two bodies.
   subroutine check_joint(scene, item, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(item_t), intent(in) :: item                    !! the row of the reaction
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      type(text_t), allocatable :: names(:)
      type(name_table_t) :: table
      character(:), allocatable :: near
      integer :: k

      allocate (names(0))
      do k = 1, size(scene%joints)
         if (.not. scene%joints(k)%info%is_start_only) call add_names(scene%joints(k)%items, names)
      end do
      do k = 1, size(scene%clearances)
         call add_names(scene%clearances(k)%items, names)
      end do
      do k = 1, size(scene%forces)
         if (find_column(scene%forces(k)%info, "j") > 0) call add_names(scene%forces(k)%items, names)
      end do
      call table%list(names)
      if (table%find(item%word("joint")) > 0) return
      near = nearest_word(item%word("joint"), names)
      if (near /= "") near = "did you mean '"//near//"'?"
      call diagnostics%add(item%values(place_of(item, "joint"))%location, "unknown joint '"//item%word("joint")// &
                           "' in column joint of request.reaction", "not a joint, driver, joint with clearance or spring of "// &
                           "this deck", near)
   end subroutine check_joint

   !> Points that have channels: all whose names are no other item's.
   subroutine list_points(scene)
      type(scene_t), intent(inout) :: scene   !! the scene; its requests are set

      character(*), parameter :: taken_always = " energy request events summary ideal "
      type(name_table_t) :: table
      type(text_t), allocatable :: names(:)
      type(text_list_t) :: points
      type(place_t), allocatable :: places(:)
      integer :: k, n

      call names_of_items(scene, names)
      call table%list(names)
      n = 0
      associate (items => scene%tables%base(table_points)%items)
         allocate (places(size(items)))
         do k = 1, size(items)
            if (table%find(items(k)%name) > 0 .or. index(taken_always, " "//items(k)%name//" ") > 0) cycle
            call points%add(items(k)%name)
            n = n + 1
            call take_point(scene, k, places(n)%body, places(n)%s)
         end do
      end associate
      scene%requests%places = places(:n)
      scene%requests%points = points%get()
   end subroutine list_points

   !> Names of everything that has channels but points.
   subroutine names_of_items(scene, names)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(text_t), allocatable, intent(out) :: names(:)    !! (any) names

      integer :: k

      allocate (names(0))
      call add_names(scene%tables%base(table_bodies)%items, names)
      do k = 1, size(scene%joints)
         call add_names(scene%joints(k)%items, names)
      end do
      do k = 1, size(scene%forces)
         call add_names(scene%forces(k)%items, names)
      end do
      do k = 1, size(scene%clearances)
         call add_names(scene%clearances(k)%items, names)
      end do
      call add_names(scene%tables%requests(table_motions)%items, names)
      call add_names(scene%tables%requests(table_reactions)%items, names)
   end subroutine names_of_items

   !> Find what the expressions of loads see.
   subroutine place_observables(scene, diagnostics)
      type(scene_t), intent(inout) :: scene               !! expressions of loads are completed
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: c, i, k, m

      do k = 1, size(scene%forces)
         do c = 1, size(scene%forces(k)%info%columns)
            if (scene%forces(k)%info%columns(c)%cell /= cell_expression) cycle
            do i = 1, size(scene%forces(k)%items)
               associate (value => scene%forces(k)%items(i)%values(c))
                  if (.not. allocated(value%expression%observables)) cycle
                  do m = 1, size(value%expression%observables)
                     call place_observable(scene, value%location, value%expression%observables(m), diagnostics)
                  end do
               end associate
            end do
         end do
      end do
   end subroutine place_observables

   !> Find one channel: of a body, a point, or a row of [request.motion].
   subroutine place_observable(scene, location, observable, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(location_t), intent(in) :: location            !! of the expression, its brace included
      type(observable_t), intent(inout) :: observable               !! its place is set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      character(:), allocatable :: help, ignored, item, message, near, quantity
      type(location_t) :: at
      type(observable_t) :: other
      integer :: body, motion, point

      observable%component = find_state(scene, observable%word)
      if (observable%component > 0) then
         observable%quantity = sees_state
         return
      end if
      call read_observable_word(observable%word, item, quantity, observable%component, observable%quantity)
      help = ""
      call find_item(scene, item, body, motion, point, help)
      if (body + motion + point == 0) then
         message = "not available to loads: '"//item//"'"
         if (help /= "") then
            near = help//observable%word(len(item) + 1:)
            call find_item(scene, help, body, motion, point, ignored)
            other = observable
            call check_observable(scene, near, body > 0, motion > 0, other, ignored, help)
            help = ""
            if (ignored == "") help = "did you mean '"//near//"'?"
         end if
      else
         if (body > 0) then
            observable%place = place_t(body=body)
         else if (motion > 0) then
            observable%place = scene%requests%motions(motion)%place
         else
            observable%place = scene%requests%places(point)
         end if
         call check_observable(scene, item//"."//quantity, body > 0, motion > 0, observable, message, help)
      end if
      if (message == "") return
      at = location
      at%first = location%first + observable%first
      at%last = at%first + len(observable%word) - 1
      call diagnostics%add(at, "invalid channel '"//observable%word//"' in an expression", message, help)
   end subroutine place_observable

   !> Number of the row of [state] whose value a channel is; 0: a channel of another kind.
   pure integer function find_state(scene, word) result(row)
      type(scene_t), intent(in) :: scene   !! the scene
      character(*), intent(in) :: word     !! the channel

      do row = 1, scene%states%n
         if (word == state_prefix//scene%states%rows(row)%name) return
      end do
      row = 0
   end function find_state

   !> The body, the row of [request.motion] or the point of a name.
   subroutine find_item(scene, item, body, motion, point, near)
      type(scene_t), intent(in) :: scene                  !! the scene
      character(*), intent(in) :: item                    !! the name
      integer, intent(out) :: body                        !! number of the body, 0: none
      integer, intent(out) :: motion                      !! number of the row, 0: none
      integer, intent(out) :: point                       !! number among points that have channels, 0: none
      character(:), allocatable, intent(out) :: near      !! a name that is like it, may be blank

      type(text_list_t) :: known
      integer :: k

      body = 0
      motion = 0
      point = 0
      do k = 1, scene%bodies%n
         if (scene%bodies%names(k)%s == item) body = k
         call known%add(scene%bodies%names(k)%s)
      end do
      do k = 1, size(scene%requests%motions)
         if (scene%requests%motions(k)%name == item) motion = k
         call known%add(scene%requests%motions(k)%name)
      end do
      do k = 1, size(scene%requests%points)
         if (scene%requests%points(k)%s == item) point = k
         call known%add(scene%requests%points(k)%s)
      end do
      near = nearest_word(item, known%get())
   end subroutine find_item

   !> Whether an item has a quantity, and whether what is named of it is a single number.
   subroutine check_observable(scene, name, is_body, is_motion, observable, message, help)
      type(scene_t), intent(in) :: scene                      !! the scene
      character(*), intent(in) :: name                        !! item and quantity, as written
      logical, intent(in) :: is_body                          !! the item is a body
      logical, intent(in) :: is_motion                        !! it is a row of [request.motion]
      type(observable_t), intent(inout) :: observable                   !! its component is set
      character(:), allocatable, intent(out) :: message       !! what is wrong, blank: nothing
      character(:), allocatable, intent(out) :: help          !! what to do

      logical :: is_vector

      message = ""
      help = ""
      is_vector = .true.
      select case (observable%quantity)
      case (sees_angle)
         is_vector = .false.
         if (.not. is_body .or. scene%settings%is_spatial) message = "only planar bodies have an angle"
      case (sees_angular_velocity)
         is_vector = scene%settings%is_spatial
         if (.not. is_body) message = "only bodies have an angular velocity"
      case (sees_distance, sees_distance_rate)
         is_vector = .false.
         if (.not. is_motion) message = "only rows of [request.motion] have a distance"
      end select
      if (message /= "") return
      if (is_vector) then
         if (observable%component >= 1 .and. observable%component <= merge(3, 2, scene%settings%is_spatial)) return
         message = "'"//observable%word//"' has several components"
         help = "write "//name//".x or .y"
         if (scene%settings%is_spatial) help = help//" or .z"
      else
         if (observable%component /= 0) then
            message = "'"//observable%word//"' has no components"
            help = "write "//name
         end if
         observable%component = merge(3, 1, observable%quantity == sees_angular_velocity)  ! about z
      end if
   end subroutine check_observable

end module read_requests
