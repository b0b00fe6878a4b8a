!> Groups of bodies that nothing joins, and each of them as a scene of its own.
!>
!> Two bodies are of one group if a joint, driver, force element or joint with clearance, ideal or not, names both, or points of
!> both; the ground joins nothing. A group of driven bodies only, which has no freedom, stays with the first that has some.
module scene_groups
   use bodies, only: take_bodies
   use find_prescribed, only: find_prescribed_bodies, link_t, takes_work
   use item, only: item_t
   use kind_info, only: cell_reference, column_t
   use scene, only: scene_t, table_t
   use scene_size, only: size_of_bodies
   use ties, only: find_joint, names_joint
   implicit none (type, external)
   private
   public :: begin_group_scene, driven_alone, find_groups, groups_t, sees_motion, set_group_scene

   !> Things sorted by the group that they belong to.
   type :: sorted_t
      integer, allocatable :: first(:)   !! (groups + 1) place of the first one of each group
      integer, allocatable :: item(:)    !! (things) their numbers, group by group
      integer, allocatable :: rank(:)    !! (things) number of each in its group
   end type sorted_t

   !> The groups of a scene.
   type :: groups_t
      integer :: n = 0                                     !! number of groups
      type(sorted_t) :: bodies                             !! bodies
      type(sorted_t), allocatable :: joints(:)             !! (kinds) rows of joints and drivers
      type(sorted_t), allocatable :: forces(:)             !! (kinds) rows of force elements
      type(sorted_t), allocatable :: clearances(:)         !! (kinds) rows of joints with clearance
      integer, allocatable, private :: point(:)            !! (points) scratch: number of each in a group
   contains
      procedure :: bodies_of => groups_bodies_of
   end type groups_t

contains

   !> The groups of a scene, in the order of their first bodies.
   subroutine find_groups(scene, groups)
      type(scene_t), intent(in) :: scene      !! the scene
      type(groups_t), intent(out) :: groups   !! its groups

      integer :: k, group(scene%bodies%n), parent(scene%bodies%n)

      call join_all(scene, parent)
      call join_driven(scene, parent)
      groups%n = 0
      do k = 1, scene%bodies%n
         if (root_of(parent, k) == k) then
            groups%n = groups%n + 1
            group(k) = groups%n
         else
            group(k) = group(root_of(parent, k))  ! a root is the first body of its group
         end if
      end do
      allocate (groups%joints(size(scene%joints)), groups%forces(size(scene%forces)), groups%clearances(size(scene%clearances)))
      call sort(group, groups%n, groups%bodies)
      do k = 1, size(scene%joints)
         call sort_rows(scene, scene%joints(k), group, groups%n, groups%joints(k))
      end do
      do k = 1, size(scene%forces)
         call sort_rows(scene, scene%forces(k), group, groups%n, groups%forces(k))
      end do
      do k = 1, size(scene%clearances)
         call sort_rows(scene, scene%clearances(k), group, groups%n, groups%clearances(k))
      end do
      allocate (groups%point(scene%points%n), source=0)
   end subroutine find_groups

   !> Bodies of groups all of whose bodies are known functions of time, some of them by a driver that works.
   function driven_alone(scene, links) result(is_alone)
      type(scene_t), intent(in) :: scene      !! the scene
      type(link_t), intent(in) :: links(:)    !! (prescribed bodies) how they are fixed
      logical :: is_alone(scene%bodies%n)     !! (bodies)

      logical :: is_driven(scene%bodies%n), moves(scene%bodies%n)
      integer :: k, parent(scene%bodies%n), root(scene%bodies%n)

      call join_all(scene, parent)
      root = [(root_of(parent, k), k=1, scene%bodies%n)]
      moves = .true.
      moves(links%body) = .false.
      moves(pack(root, moves)) = .true.   ! of a group its root
      is_driven = .false.
      is_driven(root(pack(links%body, [(takes_work(scene, links(k)), k=1, size(links))]))) = .true.
      is_alone = is_driven(root) .and. .not. moves(root)
   end function driven_alone

   !> Join the bodies that rows of any table name.
   subroutine join_all(scene, parent)
      type(scene_t), intent(in) :: scene      !! the scene
      integer, intent(out) :: parent(:)       !! (bodies) trees of joined bodies, the root their first

      integer :: k

      parent = [(k, k=1, scene%bodies%n)]
      do k = 1, size(scene%joints)
         call join_bodies(scene, scene%joints(k), parent)
      end do
      do k = 1, size(scene%forces)
         call join_bodies(scene, scene%forces(k), parent)
      end do
      do k = 1, size(scene%clearances)
         call join_bodies(scene, scene%clearances(k), parent)
      end do
   end subroutine join_all

   !> Whether some load sees the motion of bodies.
   pure logical function sees_motion(scene) result(sees)
      type(scene_t), intent(in) :: scene      !! the scene

      integer :: c, i, k

      sees = scene%states%n > 0
      do k = 1, size(scene%forces)
         do i = 1, size(scene%forces(k)%items)
            do c = 1, size(scene%forces(k)%items(i)%values)
               if (.not. allocated(scene%forces(k)%items(i)%values(c)%expression)) cycle
               sees = sees .or. allocated(scene%forces(k)%items(i)%values(c)%expression%observables)
            end do
         end do
      end do
   end function sees_motion

   !> Numbers of the bodies of a group.
   pure function groups_bodies_of(self, group) result(bodies)
      class(groups_t), intent(in) :: self   !! the groups
      integer, intent(in) :: group          !! one of them
      integer, allocatable :: bodies(:)     !! (bodies of the group) their numbers in the scene

      bodies = self%bodies%item(self%bodies%first(group):self%bodies%first(group + 1) - 1)
   end function groups_bodies_of

   !> Join the bodies that the rows of a table name.
   subroutine join_bodies(scene, table, parent)
      type(scene_t), intent(in) :: scene       !! the scene
      type(table_t), intent(in) :: table       !! rows of a kind
      integer, intent(inout) :: parent(:)      !! (bodies) trees of joined bodies, the root their first

      integer, allocatable :: bodies(:)
      integer :: i, k, first

      do i = 1, size(table%items)
         bodies = bodies_of_row(scene, table, i)
         first = 0
         do k = 1, size(bodies)
            if (bodies(k) == 0) cycle
            if (first > 0) call join_pair(parent, first, bodies(k))
            first = bodies(k)
         end do
      end do
   end subroutine join_bodies

   !> All bodies that a row names, by themselves, by points or by joints; 0: the ground.
   recursive function bodies_of_row(scene, table, row) result(bodies)
      type(scene_t), intent(in) :: scene     !! the scene
      type(table_t), intent(in) :: table     !! rows of a kind
      integer, intent(in) :: row             !! one of them
      integer, allocatable :: bodies(:)      !! (any) numbers of bodies

      integer :: c, joint, kind

      allocate (bodies(0))
      do c = 1, size(table%info%columns)
         if (table%info%columns(c)%cell /= cell_reference) cycle
         associate (column => table%info%columns(c), number => table%items(row)%values(c)%index)
            if (number == 0) cycle
            if (column%refers_to == "bodies") then
               bodies = [bodies, number]
            else if (column%refers_to == "points") then
               bodies = [bodies, scene%points%body(number)]
            else if (names_joint(column%refers_to)) then
               call find_joint(scene, number, kind, joint)
               bodies = [bodies, bodies_of_row(scene, scene%joints(kind), joint)]
            end if
         end associate
      end do
   end function bodies_of_row

   !> Join the groups of which all bodies are driven to the first one that is not.
   subroutine join_driven(scene, parent)
      type(scene_t), intent(in) :: scene     !! the scene
      integer, intent(inout) :: parent(:)    !! (bodies) trees of joined bodies

      type(link_t), allocatable :: links(:)
      logical :: is_known(scene%bodies%n), moves(scene%bodies%n)
      integer :: k, first

      call find_prescribed_bodies(scene, links)
      is_known = .false.
      is_known(links%body) = .true.
      moves = .false.
      do k = 1, scene%bodies%n
         if (.not. is_known(k)) moves(root_of(parent, k)) = .true.
      end do
      first = findloc(moves, .true., dim=1)
      if (first == 0) return
      do k = 1, scene%bodies%n
         if (root_of(parent, k) == k .and. .not. moves(k)) then
            call join_pair(parent, k, first)
            moves(root_of(parent, first)) = .true.
         end if
      end do
   end subroutine join_driven

   !> Root of the tree of a body.
   pure integer function root_of(parent, body) result(root)
      integer, intent(in) :: parent(:)   !! (bodies) trees of joined bodies
      integer, intent(in) :: body        !! a body

      root = body
      do while (parent(root) /= root)
         root = parent(root)
      end do
   end function root_of

   !> Join the trees of two bodies under the lesser root.
   pure subroutine join_pair(parent, a, b)
      integer, intent(inout) :: parent(:)   !! (bodies) trees of joined bodies
      integer, intent(in) :: a, b           !! the bodies

      integer :: body, next, root, root_a, root_b

      root_a = root_of(parent, a)
      root_b = root_of(parent, b)
      root = min(root_a, root_b)
      parent(max(root_a, root_b)) = root
      body = b
      do while (body /= root)  ! shorten the way of the body at hand
         next = parent(body)
         parent(body) = root
         body = next
      end do
   end subroutine join_pair

   !> Sort things by their group; those of no group go with the first.
   subroutine sort(group, n_group, sorted)
      integer, intent(in) :: group(:)          !! (things) group of each, 0: none
      integer, intent(in) :: n_group           !! number of groups
      type(sorted_t), intent(out) :: sorted    !! the same, sorted

      integer :: g, k, n(n_group)

      n = 0
      allocate (sorted%first(n_group + 1), sorted%item(size(group)), sorted%rank(size(group)))
      do k = 1, size(group)
         g = max(group(k), 1)
         n(g) = n(g) + 1
         sorted%rank(k) = n(g)
      end do
      sorted%first(1) = 1
      do g = 1, n_group
         sorted%first(g + 1) = sorted%first(g) + n(g)
      end do
      do k = 1, size(group)
         sorted%item(sorted%first(max(group(k), 1)) + sorted%rank(k) - 1) = k
      end do
   end subroutine sort

   !> Sort the rows of a table by the group of their bodies.
   subroutine sort_rows(scene, table, group, n_group, sorted)
      type(scene_t), intent(in) :: scene       !! the scene
      type(table_t), intent(in) :: table       !! rows of a kind
      integer, intent(in) :: group(:)          !! (bodies) group of each
      integer, intent(in) :: n_group           !! number of groups
      type(sorted_t), intent(out) :: sorted    !! the rows, sorted

      integer :: body, i, of_row(size(table%items))

      of_row = 0
      do i = 1, size(table%items)
         body = maxval(bodies_of_row(scene, table, i))
         if (body > 0) of_row(i) = group(body)
      end do
      call sort(of_row, n_group, sorted)
   end subroutine sort_rows

   !> What all groups have of a scene: gravity, materials, laws, kinds and settings of the analysis.
   subroutine begin_group_scene(scene, one)
      type(scene_t), intent(in) :: scene   !! the scene
      type(scene_t), intent(out) :: one    !! that of a group, without bodies and rows

      integer :: k

      one%gravity = scene%gravity
      one%size_of_whole = size_of_bodies(scene)
      one%materials = scene%materials
      one%laws = scene%laws
      one%frictions = scene%frictions
      one%wears = scene%wears
      one%worn = scene%worn
      one%lubrication = scene%lubrication
      one%analysis = scene%analysis
      one%settings%integration = scene%settings%integration
      one%settings%is_spatial = scene%settings%is_spatial
      one%settings%header = scene%settings%header
      allocate (one%joints(size(scene%joints)), one%forces(size(scene%forces)), one%clearances(size(scene%clearances)))
      do k = 1, size(scene%joints)
         one%joints(k)%info => scene%joints(k)%info
      end do
      do k = 1, size(scene%forces)
         one%forces(k)%info => scene%forces(k)%info
      end do
      do k = 1, size(scene%clearances)
         one%clearances(k)%info => scene%clearances(k)%info
      end do
   end subroutine begin_group_scene

   !> The bodies and rows of a group.
   subroutine set_group_scene(scene, groups, group, one)
      type(scene_t), intent(in) :: scene        !! the scene
      type(groups_t), intent(inout) :: groups   !! its groups; scratch is used
      integer, intent(in) :: group              !! one of them
      type(scene_t), intent(inout) :: one       !! started; its bodies, points and rows become those of the group

      integer :: k, n_point, points(scene%points%n)

      call take_bodies(scene%bodies, groups%bodies_of(group), one%bodies)
      n_point = 0
      do k = 1, size(scene%joints)
         call take_rows(scene%joints(k), groups%joints(k), one%joints(k))
      end do
      do k = 1, size(scene%forces)
         call take_rows(scene%forces(k), groups%forces(k), one%forces(k))
      end do
      do k = 1, size(scene%clearances)
         call take_rows(scene%clearances(k), groups%clearances(k), one%clearances(k))
      end do
      do k = 1, size(scene%joints)
         call renumber_all(one%joints(k))
      end do
      do k = 1, size(scene%forces)
         call renumber_all(one%forces(k))
      end do
      do k = 1, size(scene%clearances)
         call renumber_all(one%clearances(k))
      end do
      associate (chosen => points(:n_point))
         one%points%n = n_point
         one%points%names = scene%points%names(chosen)
         one%points%s = scene%points%s(:, chosen)
         one%points%body = scene%points%body(chosen)
         where (one%points%body > 0) one%points%body = groups%bodies%rank(max(one%points%body, 1))
         groups%point(chosen) = 0
      end associate

   contains

      !> The rows of a table that are the group's.
      subroutine take_rows(table, sorted, own)
         type(table_t), intent(in) :: table     !! rows of a kind
         type(sorted_t), intent(in) :: sorted   !! the same by groups
         type(table_t), intent(inout) :: own    !! those of the group

         own%items = table%items(sorted%item(sorted%first(group):sorted%first(group + 1) - 1))
      end subroutine take_rows

      !> References of rows to what the group has.
      subroutine renumber_all(own)
         type(table_t), intent(inout) :: own    !! rows of the group

         integer :: c, i

         do c = 1, size(own%info%columns)
            if (own%info%columns(c)%cell /= cell_reference) cycle
            do i = 1, size(own%items)
               call renumber(own%info%columns(c), own%items(i)%values(c)%index)
            end do
         end do
      end subroutine renumber_all

      !> The number in the group of what a cell refers to; materials and laws are those of all.
      subroutine renumber(column, number)
         type(column_t), intent(in) :: column   !! the column
         integer, intent(inout) :: number       !! number in the scene, then in the group

         integer :: k, kind, row

         if (number == 0) return
         if (column%refers_to == "bodies") then
            number = groups%bodies%rank(number)
         else if (column%refers_to == "points") then
            if (groups%point(number) == 0) then
               n_point = n_point + 1
               points(n_point) = number
               groups%point(number) = n_point
            end if
            number = groups%point(number)
         else if (names_joint(column%refers_to)) then
            call find_joint(scene, number, kind, row)
            number = groups%joints(kind)%rank(row)
            do k = 1, kind - 1
               number = number + size(one%joints(k)%items)
            end do
         end if
      end subroutine renumber

   end subroutine set_group_scene

end module scene_groups
