!> Which bodies of a scene move as known functions of time, and which rows of joints and drivers fix them.
!>
!> Starting from the ground: a revolute joint with a driver, or a rigid joint, makes the body on its other side known.
!> Where rows tie such bodies to one another a second time, they are redundant or contradict: then no body is known, so that
!> the solvers report which, and share the reactions.
module find_prescribed
   use clearance_registry, only: n_clearance_kinds
   use item, only: find_place, item_t
   use joint_registry, only: n_joint_kinds
   use kind_info, only: free_none, free_rotation
   use kinds, only: wp
   use scene, only: scene_t
   use ties, only: find_joint, tie_of, tie_t
   implicit none (type, external)
   private
   public :: find_prescribed_bodies, has_smooth_cells, joint_bodies, link_t, has_friction, takes_work

   !> How a prescribed body is fixed: a revolute joint with its driver, or a rigid joint.
   type :: link_t
      integer :: body = 0      !! the prescribed body
      integer :: kind = 0      !! kind of the joint
      integer :: item = 0      !! its row in the table of the kind
      integer :: driver = 0    !! kind of the driver, 0: rigid
      integer :: driving = 0   !! its row in the table of the kind
   end type link_t

contains

   !> The links of all prescribed bodies, each after the link of the body that it is tied to.
   subroutine find_prescribed_bodies(scene, links)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(link_t), allocatable, intent(out) :: links(:)    !! (prescribed bodies) how they are fixed

      logical :: is_known(0:scene%bodies%n)
      integer :: n

      is_known = .false.
      is_known(0) = .true.
      allocate (links(0))
      do
         n = size(links)
         call look_at_drivers(scene, is_known, links)
         call look_at_rigid_joints(scene, is_known, links)
         if (size(links) == n) exit
      end do
      if (are_tied_twice(scene, is_known, links)) links = links(:0)
   end subroutine find_prescribed_bodies

   !> Whether any row but those of the links lies between prescribed bodies; joints with clearance count, in case they are ideal.
   pure logical function are_tied_twice(scene, is_known, links) result(are_tied)
      type(scene_t), intent(in) :: scene      !! the scene
      logical, intent(in) :: is_known(0:)     !! (0:bodies) which bodies are known
      type(link_t), intent(in) :: links(:)    !! (prescribed bodies) how they are fixed

      type(tie_t) :: tie
      integer :: i, k, n

      n = 0
      do k = 1, n_joint_kinds()
         if (scene%joints(k)%info%is_start_only) cycle
         do i = 1, size(scene%joints(k)%items)
            tie = tie_of(scene, scene%joints(k)%info, scene%joints(k)%items(i))
            if (all(is_known(tie%body)) .and. all(is_known(tie%more))) n = n + 1
         end do
      end do
      do k = 1, n_clearance_kinds()
         do i = 1, size(scene%clearances(k)%items)
            tie = tie_of(scene, scene%clearances(k)%info, scene%clearances(k)%items(i))
            if (.not. tie%by_joint .and. all(is_known(tie%body))) n = n + 1
         end do
      end do
      are_tied = n > size(links) + count(links%driver > 0)
   end function are_tied_twice

   !> Joints that leave a turn, which is driven, between a known and an unknown body.
   subroutine look_at_drivers(scene, is_known, links)
      type(scene_t), intent(in) :: scene                       !! the scene
      logical, intent(inout) :: is_known(0:)                   !! (0:bodies) which bodies are known
      type(link_t), allocatable, intent(inout) :: links(:)     !! links, grown

      type(tie_t) :: tie
      integer :: i, k, kind, row

      do k = 1, n_joint_kinds()
         if (.not. scene%joints(k)%info%drives_turn) cycle
         do i = 1, size(scene%joints(k)%items)
            if (.not. has_smooth_cells(scene%joints(k)%items(i))) cycle
            tie = tie_of(scene, scene%joints(k)%info, scene%joints(k)%items(i))
            call find_joint(scene, tie%joint(1), kind, row)
            if (scene%joints(kind)%info%free /= free_rotation .or. has_friction(scene, scene%joints(kind)%items(row))) cycle
            call add_if_new(scene, link_t(kind=kind, item=row, driver=k, driving=i), is_known, links)
         end do
      end do
   end subroutine look_at_drivers

   !> Whether the work of a link changes: not that of a wheel about its centre of mass, or of what stands still, on the ground.
   function takes_work(scene, link) result(takes)
      type(scene_t), intent(in) :: scene   !! the scene
      type(link_t), intent(in) :: link     !! the link
      logical :: takes                     !! it does

      type(tie_t) :: tie
      integer :: k

      tie = tie_of(scene, scene%joints(link%kind)%info, scene%joints(link%kind)%items(link%item))
      takes = all(tie%body /= 0)
      if (link%driver == 0 .or. takes) return
      do k = 1, 2
         if (tie%body(k) == link%body .and. tie%point(k) > 0) takes = any(abs(scene%points%s(:, tie%point(k))) > 0.0_wp)
      end do
      associate (item => scene%joints(link%driver)%items(link%driving))
         do k = 1, size(item%values)
            if (allocated(item%values(k)%expression)) takes = takes .or. .not. item%values(k)%expression%is_constant
         end do
      end associate
   end function takes_work

   !> Whether all functions of time in a row are smooth. A body cannot jump; where its driver does, it stays unknown, and the
   !> stabilisation brings it back.
   pure logical function has_smooth_cells(item) result(is_smooth)
      type(item_t), intent(in) :: item  !! the row

      integer :: k

      is_smooth = .true.
      do k = 1, size(item%values)
         if (allocated(item%values(k)%expression)) is_smooth = is_smooth .and. item%values(k)%expression%is_smooth()
      end do
   end function has_smooth_cells

   !> Joints that leave nothing, between a known and an unknown body.
   subroutine look_at_rigid_joints(scene, is_known, links)
      type(scene_t), intent(in) :: scene                       !! the scene
      logical, intent(inout) :: is_known(0:)                   !! (0:bodies) which bodies are known
      type(link_t), allocatable, intent(inout) :: links(:)     !! links, grown

      integer :: i, k

      do k = 1, n_joint_kinds()
         if (scene%joints(k)%info%free /= free_none) cycle
         do i = 1, size(scene%joints(k)%items)
            call add_if_new(scene, link_t(kind=k, item=i), is_known, links)
         end do
      end do
   end subroutine look_at_rigid_joints

   !> Append a link if it makes a body known.
   subroutine add_if_new(scene, link, is_known, links)
      type(scene_t), intent(in) :: scene                       !! the scene
      type(link_t), intent(in) :: link                         !! the link, without its body
      logical, intent(inout) :: is_known(0:)                   !! (0:bodies) which bodies are known
      type(link_t), allocatable, intent(inout) :: links(:)     !! links, grown

      integer :: body(2)

      body = joint_bodies(scene, link%kind, link%item)
      if (is_known(body(1)) .eqv. is_known(body(2))) return
      links = [links, link]
      links(size(links))%body = merge(body(2), body(1), is_known(body(1)))
      is_known(body) = .true.
   end subroutine add_if_new

   !> Whether an ideal joint has friction: then its reactions are part of the equations of motion.
   pure logical function has_friction(scene, item)
      type(scene_t), intent(in) :: scene   !! the scene
      type(item_t), intent(in) :: item     !! row of the joint

      integer :: law

      has_friction = .false.
      if (find_place(item, "friction") == 0) return
      law = item%reference("friction")
      if (law > 0) has_friction = scene%frictions(law)%law%is_active()
   end function has_friction

   !> Bodies i and j of a row of a joint table, 0: ground.
   pure function joint_bodies(scene, kind, row) result(body)
      type(scene_t), intent(in) :: scene   !! the scene
      integer, intent(in) :: kind          !! number of the kind
      integer, intent(in) :: row           !! row of its table
      integer :: body(2)                   !! (2) their numbers

      type(tie_t) :: tie

      tie = tie_of(scene, scene%joints(kind)%info, scene%joints(kind)%items(row))
      body = tie%body
   end function joint_bodies

end module find_prescribed
