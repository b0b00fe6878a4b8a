!> What a row of a table ties: its references say, and nothing else.
!>
!> The references of a row to points, bodies or joints, in the order of its columns, are its ends. An end that is a point or a body
!> is that. One joint stands for what it ties itself, in its order. Two joints stand for the two bodies that they do not share, at
!> the points that they hold there: two wheels on one carrier, say. A row that couples joints ties all bodies of them, the ground
!> left out. So a kind of joint, driver, force or contact is tied by the
!> words of its `add_reference` alone.
module ties
   use item, only: item_t
   use joint_registry, only: n_joint_kinds
   use joint_set, only: joint_set_t
   use kind_info, only: cell_reference, is_of_space, kind_info_t
   use kinds, only: wp
   use scene, only: scene_t
   implicit none (type, external)
   private
   public :: find_joint, kind_number, names_joint, tie_of, tie_set, tie_t

   !> What a row ties.
   type :: tie_t
      integer :: n = 0              !! references that are ends: none to three
      logical :: by_joint = .false. !! the first of them is a joint
      integer :: column(3) = 0      !! (3) their columns
      integer :: body(2) = 0        !! (2) bodies i and j, 0: ground
      integer :: point(2) = 0       !! (2) points of these, 0: the centre of mass
      integer :: more(4) = 0        !! (4) further bodies of a row that couples joints, 0: none
      integer :: joint(3) = 0       !! (3) joints that the ends name, by their numbers among all joints, 0: none
   end type tie_t

contains

   !> What a row ties; its references are resolved.
   pure recursive function tie_of(scene, info, item) result(tie)
      type(scene_t), intent(in) :: scene      !! the scene
      type(kind_info_t), intent(in) :: info   !! kind of the row
      type(item_t), intent(in) :: item        !! the row
      type(tie_t) :: tie                      !! what it ties

      integer :: c, most

      most = merge(3, 2, info%couples_joints)
      do c = 1, size(info%columns)
         if (info%columns(c)%cell /= cell_reference .or. tie%n == most) cycle
         associate (refers_to => info%columns(c)%refers_to, index => item%values(c)%index)
            if (.not. (refers_to == "points" .or. refers_to == "bodies" .or. names_joint(refers_to))) cycle
            if (info%couples_joints .and. index == 0) cycle
            tie%n = tie%n + 1
            tie%column(tie%n) = c
            if (refers_to == "points") then
               tie%point(tie%n) = index
               if (index > 0) tie%body(tie%n) = scene%points%body(index)
            else if (refers_to == "bodies") then
               tie%body(tie%n) = index
            else
               tie%joint(tie%n) = index
            end if
         end associate
      end do
      tie%by_joint = tie%joint(1) > 0
      if (.not. tie%by_joint) return
      if (info%couples_joints) then
         call take_all_bodies(scene, tie)
      else
         call take_joints(scene, tie)
      end if
   end function tie_of

   !> All bodies of the joints but the ground, each once.
   pure recursive subroutine take_all_bodies(scene, tie)
      type(scene_t), intent(in) :: scene   !! the scene
      type(tie_t), intent(inout) :: tie    !! the ends; bodies are set

      type(tie_t) :: own
      integer :: bodies(6), end, kind, n, row, side

      bodies = 0
      n = 0
      do end = 1, count(tie%joint > 0)
         call find_joint(scene, tie%joint(end), kind, row)
         own = tie_of(scene, scene%joints(kind)%info, scene%joints(kind)%items(row))
         do side = 1, 2
            if (own%body(side) == 0 .or. any(bodies == own%body(side))) cycle
            n = n + 1
            bodies(n) = own%body(side)
         end do
      end do
      tie%body = bodies(:2)
      tie%more = bodies(3:)
   end subroutine take_all_bodies

   !> Ends that joints stand for.
   pure recursive subroutine take_joints(scene, tie)
      type(scene_t), intent(in) :: scene   !! the scene
      type(tie_t), intent(inout) :: tie    !! the ends; bodies and points are set

      type(tie_t) :: own(2)
      integer :: end, kind, row, side

      do end = 1, count(tie%joint > 0)
         call find_joint(scene, tie%joint(end), kind, row)
         own(end) = tie_of(scene, scene%joints(kind)%info, scene%joints(kind)%items(row))
      end do
      if (tie%joint(2) == 0) then
         tie%body = own(1)%body
         tie%point = own(1)%point
         return
      end if
      do end = 1, 2
         side = merge(2, 1, any(own(3 - end)%body == own(end)%body(1)))
         tie%body(end) = own(end)%body(side)
         tie%point(end) = own(end)%point(side)
      end do
   end subroutine take_joints

   !> Whether a reference is to joints.
   pure logical function names_joint(refers_to)
      character(*), intent(in) :: refers_to   !! as of its column

      names_joint = index(refers_to, "joint.") == 1
   end function names_joint

   !> Set up a set of joints by what its rows tie.
   subroutine tie_set(scene, info, items, set)
      type(scene_t), intent(in) :: scene          !! the scene
      type(kind_info_t), intent(in) :: info       !! kind of the rows
      type(item_t), intent(in) :: items(:)        !! (n) the rows
      class(joint_set_t), intent(inout) :: set    !! the set, empty before

      type(tie_t) :: tie
      integer, allocatable :: body(:, :)
      real(wp), allocatable :: s(:, :, :)
      integer :: end, k

      allocate (body(2, size(items)))
      allocate (s(3, 2, size(items)), source=0.0_wp)
      do k = 1, size(items)
         tie = tie_of(scene, info, items(k))
         body(:, k) = tie%body
         do end = 1, 2
            if (tie%point(end) > 0) s(:, end, k) = scene%points%s(:, tie%point(end))
         end do
      end do
      call set%new(items, body, s(:, 1, :), s(:, 2, :))
   end subroutine tie_set

   !> Kind and row of a joint by its number among all joints, in the order of the registry.
   pure subroutine find_joint(scene, number, kind, row)
      type(scene_t), intent(in) :: scene   !! the scene
      integer, intent(in) :: number        !! the joint, from 1
      integer, intent(out) :: kind         !! number of its kind
      integer, intent(out) :: row          !! its row in the table of the kind

      row = number
      do kind = 1, n_joint_kinds()
         if (row <= size(scene%joints(kind)%items)) return
         row = row - size(scene%joints(kind)%items)
      end do
   end subroutine find_joint

   !> Number of a kind of joint in the registry, by its name.
   pure integer function kind_number(scene, name) result(k)
      type(scene_t), intent(in) :: scene   !! the scene, whose tables know their kinds
      character(*), intent(in) :: name     !! as in a deck

      do k = 1, n_joint_kinds()
         if (scene%joints(k)%info%name == name .and. is_of_space(scene%joints(k)%info, scene%settings%is_spatial)) return
      end do
   end function kind_number

end module ties
