!> Which bodies of a scene are left out of the unknowns, wholly or but for one coordinate, and how they move.
!>
!> Bodies whose motion is a known function of time leave the unknowns, with the rows that fix them; a body that one joint leaves a
!> single freedom against these or the ground keeps one coordinate, and the rows of its joint leave the equations.
!> Planar: both are kernels of the plane.
module build_known
   use find_guided, only: find_guided_bodies, guide_t
   use find_known, only: find_known_bodies, link_t
   use item, only: place_of
   use joint_registry, only: n_joint_kinds
   use joint_set, only: joint_set_t
   use kind_info, only: leaves_way
   use kinds, only: wp
   use linkage, only: linkage_t
   use rows, only: side_place
   use scene, only: analysis_dynamic, scene_t
   use scene_size, only: is_large
   use ties, only: tie_of, tie_t
   implicit none (type, external)
   private
   public :: choice_t, choose_bodies, list_carried, reduction_t, set_guided, set_known, start_angles

   !> Which rows of a table of joints leave the equations.
   type :: choice_t
      logical, allocatable :: is_fixing(:)  !! (rows of the table)
   end type choice_t

   !> What leaves the unknowns and the equations.
   type :: reduction_t
      type(link_t), allocatable :: links(:)        !! (known bodies) how they are fixed
      type(guide_t), allocatable :: guides(:)      !! (guided bodies) how they are held
      type(choice_t) :: choices(n_joint_kinds)     !! (kinds) which rows of each table leave the equations
      logical, allocatable :: is_driven(:)         !! (bodies) whether drivers alone say how they move, left out or not
   end type reduction_t

contains

   !> Angles of the bodies at the start, with that of the ground.
   pure function start_angles(scene) result(angle)
      type(scene_t), intent(in) :: scene         !! the scene
      real(wp) :: angle(0:scene%bodies%n)        !! (0:bodies) angles [rad]

      angle(0) = 0.0_wp
      angle(1:) = scene%bodies%angle
   end function start_angles

   !> The bodies that leave the unknowns, unless the deck wants all coordinates, and the rows that leave the equations.
   !> Only an integration has unknowns: elsewhere all bodies stay together; so do bodies that rows hold at the start only, and
   !> those of a method that holds the constraints by itself, or needs the sparse form of it, keep all their coordinates.
   subroutine choose_bodies(scene, levels, with_start_rows, reduction)
      type(scene_t), intent(in) :: scene             !! the scene
      integer, intent(in) :: levels                  !! how joints with clearance are taken
      logical, intent(in) :: with_start_rows         !! whether rows that hold only at the start take part
      type(reduction_t), intent(out) :: reduction    !! what leaves

      logical :: is_known(0:scene%bodies%n)
      integer :: k

      do k = 1, n_joint_kinds
         allocate (reduction%choices(k)%is_fixing(size(scene%joints(k)%items)), source=.false.)
      end do
      allocate (reduction%links(0), reduction%guides(0))
      allocate (reduction%is_driven(scene%bodies%n), source=.false.)
      if (scene%analysis /= analysis_dynamic .or. scene%settings%is_spatial) return
      call find_known_bodies(scene, reduction%links)
      reduction%is_driven(reduction%links%body) = .true.
      if (scene%settings%dynamic%word("coordinates") == "full") reduction%links = reduction%links(:0)
      ! without any unknown nothing would control the step, and the works would be as good as chance
      if (size(reduction%links) == scene%bodies%n) reduction%links = reduction%links(:0)
      associate (links => reduction%links)
         do k = 1, size(links)
            reduction%choices(links(k)%kind)%is_fixing(links(k)%item) = .true.
            if (links(k)%driver > 0) reduction%choices(links(k)%driver)%is_fixing(links(k)%driving) = .true.
         end do
         if (with_start_rows) return
         if (scene%settings%dynamic%word("coordinates") == "full") return
         associate (method => scene%settings%dynamic%values(place_of(scene%settings%dynamic, "method"))%text)
            if (method == "ida" .or. (method == "bdf" .and. is_large(scene))) return
         end associate
         is_known = .false.
         is_known([0, links%body]) = .true.
      end associate
      call find_guided_bodies(scene, is_known, levels, reduction%guides)
      associate (guides => reduction%guides)
         do k = 1, size(guides)
            reduction%choices(guides(k)%kind)%is_fixing(guides(k)%item) = .true.
         end do
      end associate
   end subroutine choose_bodies

   !> How the known bodies are moved, and which rows fix them.
   subroutine set_known(scene, links, choices, linkage)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(link_t), intent(in) :: links(:)                    !! (known bodies) how they are fixed
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table leave the equations
      type(linkage_t), intent(inout) :: linkage               !! known bodies are set; joints are there

      real(wp) :: angle(0:scene%bodies%n)
      type(tie_t) :: tie
      integer :: body(2), item, k, n, point(2), side, slot

      n = size(links)
      angle = start_angles(scene)
      linkage%reduced%known%n = n
      allocate (linkage%reduced%known%item(n))
      do k = 1, n
         associate (link => links(k), known => linkage%reduced%known%item(k))
            tie = tie_of(scene, scene%joints(link%kind)%info, scene%joints(link%kind)%items(link%item))
            point = tie%point
            body = tie%body
            side = merge(1, 2, body(1) == link%body)
            known%body = body(side)
            known%base = body(3 - side)
            known%s_body = scene%points%s(1:2, point(side))
            known%s_base = scene%points%s(1:2, point(3 - side))
            known%side = side
            call find_fixing(scene, choices, linkage, link%kind, link%item, slot, item)
            call take_rows(linkage%joints(slot)%set, item, known%row)
            if (link%driver == 0) then
               known%offset = angle(known%body) - angle(known%base)
            else
               call find_fixing(scene, choices, linkage, link%driver, link%driving, known%slot, known%item)
               call take_rows(linkage%joints(known%slot)%set, known%item, known%row(3:3))
               known%sign = merge(1.0_wp, -1.0_wp, side == 2)
            end if
         end associate
      end do
      allocate (linkage%reduced%is_known(linkage%bodies%n), source=.false.)
      linkage%reduced%is_known(linkage%reduced%known%item%body) = .true.
      do k = 1, linkage%bodies%n
         if (.not. linkage%reduced%is_known(k)) linkage%inverse_mass(:, k) = 1.0_wp/linkage%mass(:, k)
      end do
   end subroutine set_known

   !> How the guided bodies move, and which rows hold them.
   subroutine set_guided(scene, guides, choices, linkage)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(guide_t), intent(in) :: guides(:)                  !! (guided bodies) how they are held
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table leave the equations
      type(linkage_t), intent(inout) :: linkage               !! guided bodies are set; joints and known bodies are there

      real(wp) :: angle(0:scene%bodies%n)
      type(tie_t) :: tie
      integer :: item, k, n, point(2), slot

      n = size(guides)
      angle = start_angles(scene)
      linkage%reduced%guided%n = n
      linkage%reduced%guided%n_turning = count([(scene%joints(guides(k)%kind)%info%leaves /= leaves_way, k=1, n)])
      allocate (linkage%reduced%guided%item(n))
      do k = 1, n
         associate (guide => guides(k), guided => linkage%reduced%guided%item(k))
            tie = tie_of(scene, scene%joints(guide%kind)%info, scene%joints(guide%kind)%items(guide%item))
            point = tie%point
            guided%side = merge(1, 2, tie%body(1) == guide%body)
            if (guided%side == 1) point = point([2, 1])
            guided%body = guide%body
            guided%base = scene%points%body(point(1))
            guided%mass = scene%bodies%mass(guided%body)
            guided%s_base = scene%points%s(1:2, point(1))
            call find_fixing(scene, choices, linkage, guide%kind, guide%item, slot, item)
            associate (set => linkage%joints(slot)%set, s_body => scene%points%s(1:2, point(2)))
               call take_rows(set, item, guided%row)
               if (scene%joints(guide%kind)%info%leaves == leaves_way) then
                  guided%offset = angle(guided%body) - angle(guided%base)
                  guided%turned = [cos(guided%offset), sin(guided%offset)]
                  guided%arm = set%way_of(item)
                  if (guided%side == 1) guided%arm = turn(guided%turned, guided%arm)
                  guided%s_base = guided%s_base - turn(guided%turned, s_body)
                  guided%ease = 1.0_wp/guided%mass
               else
                  guided%arm = -s_body
                  guided%ease = 1.0_wp/(scene%bodies%inertia(guided%body) + guided%mass*dot_product(s_body, s_body))
               end if
            end associate
         end associate
      end do
   end subroutine set_guided

   !> What acts on known bodies besides the rows that fix them, and the bodies that move with them.
   subroutine list_carried(linkage)
      type(linkage_t), intent(inout) :: linkage   !! the bodies and their rows, sides listed

      integer :: i, k, n, row

      associate (guided => linkage%reduced%guided%item, rows => linkage%rows)
         linkage%reduced%driven = [linkage%reduced%known%item%body, pack(guided%body, guided%base > 0)]
         n = size(rows%known, 2)
         allocate (linkage%reduced%carried(3, n + 2*count(guided%base > 0)), source=0)
         linkage%reduced%carried(:, :n) = rows%known
         do k = 1, size(guided)
            if (guided(k)%base == 0) cycle
            do i = 1, 2
               row = guided(k)%row(i)
               n = n + 1
               linkage%reduced%carried(:, n) = [row, side_place(rows%n_v, row, 3 - guided(k)%side), guided(k)%base]
            end do
         end do
      end associate
   end subroutine list_carried

   !> A plane vector turned by an angle.
   pure function turn(cosine_sine, s) result(turned)
      real(wp), intent(in) :: cosine_sine(2)  !! (2) cosine and sine of the angle [1]
      real(wp), intent(in) :: s(2)            !! (2) the vector [any]
      real(wp) :: turned(2)                   !! (2) the same turned [any]

      turned = [cosine_sine(1)*s(1) - cosine_sine(2)*s(2), cosine_sine(2)*s(1) + cosine_sine(1)*s(2)]
   end function turn

   !> Rows of an item, as many as there is room for.
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
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table leave the equations
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

end module build_known
