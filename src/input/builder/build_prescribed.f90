!> Which bodies of a scene are omitted of the unknowns, wholly or but for one coordinate, and how they move.
!>
!> Bodies whose motion is a known function of time leave the unknowns, with the rows that fix them; a body that one joint leaves a
!> single freedom against these or the ground keeps one coordinate, and the rows of its joint leave the equations. The plane and
!> space have kernels of their own (`planar_reduction`, `spatial_reduction`).
module build_prescribed
   use find_one_dof, only: find_one_dof_bodies, guide_t
   use find_prescribed, only: find_prescribed_bodies, link_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use integration_method, only: abilities_t
   use joint_registry, only: n_joint_kinds
   use joint_set, only: joint_set_t
   use kind_info, only: free_translation
   use kinds, only: wp
   use linkage, only: linkage_t
   use planar_one_dof, only: planar_one_dof_t
   use planar_prescribed, only: planar_prescribed_t
   use planar_reduction, only: planar_guide, planar_link, take_driver
   use reduced_bodies, only: one_dof_bodies_t, held_t, prescribed_bodies_t
   use rows, only: side_place
   use scene, only: analysis_dynamic, scene_t
   use scene_groups, only: driven_alone
   use scene_size, only: is_large
   use spatial_one_dof, only: spatial_one_dof_t
   use spatial_prescribed, only: spatial_prescribed_t
   use spatial_reduction, only: spatial_guide, spatial_link
   implicit none (type, external)
   private
   public :: choice_t, choose_bodies, list_carried, reduction_t, set_one_dof, set_prescribed, start_angles

   !> Which rows of a table of joints leave the equations.
   type :: choice_t
      logical, allocatable :: is_fixing(:)  !! (rows of the table)
   end type choice_t

   !> What leaves the unknowns and the equations.
   type :: reduction_t
      type(link_t), allocatable :: links(:)        !! (prescribed bodies) how they are fixed
      type(guide_t), allocatable :: guides(:)      !! (bodies with one degree of freedom) how they are held
      type(choice_t), allocatable :: choices(:)    !! (kinds) which rows of each table leave the equations
      logical, allocatable :: is_driven(:)         !! (bodies) whether drivers alone say how they move, omitted or not
   end type reduction_t

contains

   !> Angles of the bodies at the start, with that of the ground.
   pure function start_angles(scene) result(angle)
      type(scene_t), intent(in) :: scene         !! the scene
      real(wp) :: angle(0:scene%bodies%n)        !! (0:bodies) angles [rad]

      angle(0) = 0.0_wp
      angle(1:) = scene%bodies%angle
   end function start_angles

   !> The bodies that leave the unknowns, unless the deck needs all coordinates, and the rows that leave the equations.
   !> Only an integration has unknowns: elsewhere all bodies stay together; so do bodies that rows hold at the start only, and
   !> those of a method that holds the constraints by itself, or needs the sparse form of it, keep all their coordinates.
   subroutine choose_bodies(scene, levels, with_start_rows, reduction)
      type(scene_t), intent(in) :: scene             !! the scene
      integer, intent(in) :: levels                  !! how joints with clearance are taken
      logical, intent(in) :: with_start_rows         !! whether rows that hold only at the start take part
      type(reduction_t), intent(out) :: reduction    !! what leaves

      type(abilities_t) :: can
      logical :: is_known(0:scene%bodies%n)
      integer :: k

      allocate (reduction%choices(n_joint_kinds()))
      do k = 1, size(reduction%choices)
         allocate (reduction%choices(k)%is_fixing(size(scene%joints(k)%items)), source=.false.)
      end do
      allocate (reduction%links(0), reduction%guides(0))
      allocate (reduction%is_driven(scene%bodies%n), source=.false.)
      if (scene%analysis /= analysis_dynamic) return
      call find_prescribed_bodies(scene, reduction%links)
      reduction%is_driven(reduction%links%body) = .true.
      if (.not. scene%settings%integration%is_reduced) reduction%links = reduction%links(:0)
      ! without any unknown nothing would control the step, and the works would be as good as chance; what else moves, and has
      ! nothing to do with them, knows nothing of the step that they need
      if (size(reduction%links) == scene%bodies%n) then
         reduction%links = reduction%links(:0)
      else if (any(reduction%links%driver > 0)) then
         is_known(1:) = .not. driven_alone(scene, reduction%links)
         reduction%links = pack(reduction%links, is_known(reduction%links%body))
      end if
      associate (links => reduction%links)
         do k = 1, size(links)
            reduction%choices(links(k)%kind)%is_fixing(links(k)%item) = .true.
            if (links(k)%driver > 0) reduction%choices(links(k)%driver)%is_fixing(links(k)%driving) = .true.
         end do
         if (with_start_rows) return
         if (.not. scene%settings%integration%is_reduced) return
         can = scene%settings%integration%can()
         if (can%solves_dae .or. (can%has_sparse_newton .and. is_large(scene))) return
         is_known = .false.
         is_known([0, links%body]) = .true.
      end associate
      call find_one_dof_bodies(scene, is_known, levels, reduction%guides)
      associate (guides => reduction%guides)
         do k = 1, size(guides)
            reduction%choices(guides(k)%kind)%is_fixing(guides(k)%item) = .true.
         end do
      end associate
   end subroutine choose_bodies

   !> How the prescribed bodies are moved, and which rows fix them.
   subroutine set_prescribed(scene, links, choices, linkage)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(link_t), intent(in) :: links(:)                    !! (prescribed bodies) how they are fixed
      type(choice_t), intent(in) :: choices(:)  !! (kinds) which rows of each table leave the equations
      type(linkage_t), intent(inout) :: linkage               !! prescribed bodies are set; joints are there

      class(prescribed_bodies_t), allocatable :: known
      real(wp) :: rise, speed, x(size(links))
      integer :: item(size(links)), k, slot(size(links))

      if (scene%settings%is_spatial) then
         allocate (spatial_prescribed_t :: known)
      else
         allocate (planar_prescribed_t :: known)
      end if
      known%n = size(links)
      allocate (known%held(known%n))
      do k = 1, known%n
         associate (link => links(k), held => known%held(k))
            call find_fixing(scene, choices, linkage, link%kind, link%item, slot(k), item(k))
            call take_held(linkage%joints(slot(k))%set, item(k), link%body, held)
            if (link%driver == 0) cycle
            call find_fixing(scene, choices, linkage, link%driver, link%driving, held%slot, held%item)
            call take_rows(linkage%joints(held%slot)%set, held%item, held%row(linkage%coordinates%n_v:))
         end associate
      end do
      select type (known)
      type is (planar_prescribed_t)
         known%item = [(planar_link(linkage%joints(slot(k))%set, item(k), known%held(k), start_angles(scene)), k=1, known%n)]
         do k = 1, known%n
            if (known%item(k)%slot > 0) call take_driver(linkage%joints(known%item(k)%slot)%set, known%item(k))
         end do
      type is (spatial_prescribed_t)
         x = 0.0_wp
         do k = 1, known%n
            associate (held => known%held(k))
               if (held%slot > 0) call linkage%joints(held%slot)%set%prescription(held%item, 0.0_wp, x(k), speed, rise)
               if (.not. ieee_is_finite(x(k))) x(k) = 0.0_wp  ! which the start will report
            end associate
         end do
         known%item = [(spatial_link(linkage%joints(slot(k))%set, item(k), known%held(k), x(k), linkage%motion%spatial%p), &
                         k=1, known%n)]
      end select
      allocate (linkage%reduced%is_known(linkage%bodies%n), source=.false.)
      linkage%reduced%is_known(links%body) = .true.
      call move_alloc(known, linkage%reduced%known)
      do k = 1, linkage%bodies%n
         if (.not. linkage%reduced%is_known(k)) linkage%inverse_mass(:, k) = 1.0_wp/linkage%mass(:, k)
      end do
   end subroutine set_prescribed

   !> How the bodies with one degree of freedom move, and which rows hold them.
   subroutine set_one_dof(scene, guides, choices, linkage)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(guide_t), intent(in) :: guides(:)  !! (bodies with one degree of freedom) how they are held, those that turn first
      type(choice_t), intent(in) :: choices(:)  !! (kinds) which rows of each table leave the equations
      type(linkage_t), intent(inout) :: linkage  !! bodies with one degree of freedom are set; joints and prescribed bodies are
                                                 !! there

      class(one_dof_bodies_t), allocatable :: one_dof
      integer :: item(size(guides)), k, slot(size(guides))

      if (scene%settings%is_spatial) then
         allocate (spatial_one_dof_t :: one_dof)
      else
         allocate (planar_one_dof_t :: one_dof)
      end if
      one_dof%n = size(guides)
      one_dof%n_turning = count([(scene%joints(guides(k)%kind)%info%free /= free_translation, k=1, one_dof%n)])
      allocate (one_dof%held(one_dof%n))
      do k = 1, one_dof%n
         call find_fixing(scene, choices, linkage, guides(k)%kind, guides(k)%item, slot(k), item(k))
         call take_held(linkage%joints(slot(k))%set, item(k), guides(k)%body, one_dof%held(k))
      end do
      select type (one_dof)
      type is (planar_one_dof_t)
         one_dof%item = [(planar_guide(linkage%joints(slot(k))%set, item(k), one_dof%held(k), k > one_dof%n_turning, &
                                      start_angles(scene), linkage%mass(:, one_dof%held(k)%body)), k=1, one_dof%n)]
      type is (spatial_one_dof_t)
         one_dof%item = [(spatial_guide(linkage%joints(slot(k))%set, item(k), one_dof%held(k), k > one_dof%n_turning, &
                                       linkage%mass(:, one_dof%held(k)%body), linkage%motion%spatial%p), k=1, one_dof%n)]
      end select
      call move_alloc(one_dof, linkage%reduced%one_dof)
   end subroutine set_one_dof

   !> A body and what a joint ties it to, with the rows of the joint.
   subroutine take_held(set, item, body, held)
      class(joint_set_t), intent(in) :: set     !! the joint's set
      integer, intent(in) :: item               !! its item
      integer, intent(in) :: body               !! the body
      type(held_t), intent(inout) :: held       !! how it is held

      held%side = merge(1, 2, set%body(1, item) == body)
      held%body = body
      held%base = set%body(3 - held%side, item)
      call take_rows(set, item, held%row(:set%n_row_item))
   end subroutine take_held

   !> What acts on prescribed bodies besides the rows that fix them, and the bodies that move with them.
   subroutine list_carried(linkage)
      type(linkage_t), intent(inout) :: linkage   !! the bodies and their rows, sides listed

      integer :: i, k, n, n_held, row

      n_held = linkage%coordinates%n_v - 1
      associate (held => linkage%reduced%one_dof%held, rows => linkage%rows)
         linkage%reduced%driven = [linkage%reduced%known%held%body, pack(held%body, held%base > 0)]
         n = size(rows%known, 2)
         allocate (linkage%reduced%carried(3, n + n_held*count(held%base > 0)), source=0)
         linkage%reduced%carried(:, :n) = rows%known
         do k = 1, size(held)
            if (held(k)%base == 0) cycle
            do i = 1, n_held
               row = held(k)%row(i)
               n = n + 1
               linkage%reduced%carried(:, n) = [row, side_place(rows%n_v, row, 3 - held(k)%side), held(k)%base]
            end do
         end do
      end associate
   end subroutine list_carried

   !> Rows of an item, as many as there is storage for.
   subroutine take_rows(set, item, row)
      class(joint_set_t), intent(in) :: set   !! the set
      integer, intent(in) :: item             !! its item
      integer, intent(out) :: row(:)          !! (any) its rows

      integer :: i

      row = [(set%first_row + (item - 1)*set%n_row_item + i, i=1, size(row))]
   end subroutine take_rows

   !> Set and item of a row of a joint table that leaves the equations.
   subroutine find_fixing(scene, choices, linkage, kind, row, slot, item)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(choice_t), intent(in) :: choices(:)  !! (kinds) which rows of each table leave the equations
      type(linkage_t), intent(in) :: linkage                  !! its joints
      integer, intent(in) :: kind                             !! number of the kind
      integer, intent(in) :: row                              !! row of its table
      integer, intent(out) :: slot                            !! the set
      integer, intent(out) :: item                            !! its item

      item = count(choices(kind)%is_fixing(:row))
      do slot = 1, size(linkage%joints)
         associate (set => linkage%joints(slot)%set)
            if (set%is_solved) cycle
            if (set%names(min(item, set%n))%s == scene%joints(kind)%items(row)%name) return
         end associate
      end do
   end subroutine find_fixing

end module build_prescribed
