!> Gears of an Adams dataset as rows of a deck.
!>
!> | Adams | deck |
!> |---|---|
!> | GEAR of two revolute joints with parallel axes on one carrier | `joint.gear`, radii from the CV marker |
!>
!> With a the direction of both axes, p_k a point of each, c the CV marker and z its axis: both bodies have the same velocity there,
!> w_1 (a x (c - p_1)) . z = w_2 (a x (c - p_2)) . z, as the carrier sees it. Two gears have w_1 R_1 + w_2 R_2 = 0.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: other joints, axes that meet or are one.
module adams_gears
   use adams_couplers, only: add_couplers
   use adams_joints, only: named
   use adams_model, only: adams_model_t, leave_out
   use adams_numbers, only: argument_numbers, id_of, mistake
   use dataset, only: statement_t
   use deck_draft, only: deck_draft_t, joint_t, tab
   use deck_table, only: direction_cell
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use motion, only: cross
   use text, only: exact_text, to_text
   implicit none (type, external)
   private
   public :: add_gears

   real(wp), parameter :: same = 1.0e-6_wp   !! sines of angles, and parts of a length, that are none [1]

   !> One of the two wheels.
   type :: wheel_t
      integer :: marker = 0             !! its marker on the axis, by its place in the list
      integer :: part = 0               !! its part
      integer :: carrier = 0            !! the part that its joint is on
      real(wp) :: axis(3) = 0.0_wp      !! (3) about which the joint's angle counts, world [1]
      real(wp) :: side = 1.0_wp         !! -1: the angle of the joint is that of the carrier in the wheel [1]
      real(wp) :: radius = 0.0_wp       !! of the pitch circle, negative: a ring [m]
   end type wheel_t

contains

   !> All GEAR and COUPLER statements.
   subroutine add_gears(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck, with its joints
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      type(wheel_t) :: wheels(2)
      character(:), allocatable :: message
      integer :: k

      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (it%keyword /= "GEAR") cycle
            call find_wheels(model, draft, it, wheels, message, mistakes)
            if (message == "") call take_mark(model, it, wheels, message, mistakes)
            if (message == "") then
               call put_gear(model, draft, it, wheels)
            else
               call leave_out(model, it, message)
            end if
         end associate
      end do
      call add_couplers(model, draft, mistakes)
   end subroutine add_gears

   !> The wheels of two revolute joints, and whether they turn on parallel axes of one carrier.
   subroutine find_wheels(model, draft, statement, wheels, message, mistakes)
      type(adams_model_t), intent(in) :: model               !! the dataset
      type(deck_draft_t), intent(in) :: draft                !! the deck, with its joints
      type(statement_t), intent(in) :: statement             !! the statement
      type(wheel_t), intent(out) :: wheels(2)                !! (2) radii are not set
      character(:), allocatable, intent(out) :: message      !! why there are none; blank: there are
      type(diagnostics_t), intent(inout) :: mistakes         !! collects what is wrong

      type(joint_t) :: joints(2)
      integer :: common, i, k, parts(2, 2)
      real(wp) :: span(3)
      real(wp), allocatable :: id(:)

      call argument_numbers(statement, "JOINTS", id, mistakes, 1)
      message = "it does not couple two revolute joints of the deck"
      if (size(id) /= 2) return
      do k = 1, 2
         do i = 1, size(draft%joints)
            if (draft%joints(i)%kind /= "joint.revolute" .or. draft%joints(i)%is_primitive) cycle
            if (abs(draft%joints(i)%id - id(k)) < 0.5_wp) exit
         end do
         if (i > size(draft%joints)) return
         joints(k) = draft%joints(i)
         parts(:, k) = [model%markers(joints(k)%marker(1))%part, model%markers(joints(k)%marker(2))%part]
      end do
      message = "its joints have no common carrier part"
      common = 0
      do i = 2, 1, -1
         if (any(parts(:, 2) == parts(i, 1))) common = parts(i, 1)
      end do
      if (any(parts(:, 1) == parts(2, 1) .and. parts(2, 1) == parts(2, 2))) common = parts(2, 1)
      if (common == 0) return
      do k = 1, 2
         associate (wheel => wheels(k))
            i = merge(1, 2, parts(2, k) == common)
            wheel = wheel_t(marker=joints(k)%marker(i), part=parts(i, k), carrier=common, side=merge(1.0_wp, -1.0_wp, i == 1))
            wheel%axis = third_axis(model, joints(k)%marker(2))
         end associate
      end do
      message = "both its joints belong to the same part"
      if (wheels(1)%part == wheels(2)%part) return
      message = "the axes of its joints are not parallel"
      if (norm2(cross(wheels(1)%axis, wheels(2)%axis)) > same) return
      message = "its joints have the same axis"
      span = model%place(wheels(1)%marker) - model%place(wheels(2)%marker)
      if (norm2(cross(wheels(1)%axis, span)) <= same*model%units%length) return
      message = ""
   end subroutine find_wheels

   !> The axis z of a marker.
   pure function third_axis(model, marker) result(z)
      type(adams_model_t), intent(in) :: model   !! the dataset
      integer, intent(in) :: marker              !! by its place in the list
      real(wp) :: z(3)                           !! (3) world [1]

      real(wp) :: a(3, 3)

      a = model%axes(marker)
      z = a(:, 3)
   end function third_axis

   !> Radii from where the gears touch.
   subroutine take_mark(model, statement, wheels, message, mistakes)
      type(adams_model_t), intent(in) :: model                  !! the dataset
      type(statement_t), intent(in) :: statement                !! the statement
      type(wheel_t), intent(inout) :: wheels(2)                 !! (2) radii are set
      character(:), allocatable, intent(inout) :: message       !! set: they have none
      type(diagnostics_t), intent(inout) :: mistakes            !! collects what is wrong

      real(wp) :: arm(2), z(3)
      integer :: k, mark

      mark = model%marker(id_of(statement, "CV", mistakes))
      if (mark == 0) then
         call mistake(mistakes, statement%at, "the CV of GEAR/"//to_text(statement%id)//" is not a MARKER of a rigid part", "")
         return
      end if
      if (model%markers(mark)%part /= wheels(1)%carrier) then
         message = "its CV marker is not on the carrier part"
         return
      end if
      z = third_axis(model, mark)
      do k = 1, 2
         arm(k) = dot_product(cross(wheels(1)%axis, model%place(mark) - model%place(wheels(k)%marker)), z)
      end do
      if (minval(abs(arm)) <= same*maxval(abs(arm))) then
         message = "neither gear moves the contact point along z of the CV marker"
         return
      end if
      wheels(1)%radius = abs(arm(1))
      wheels(2)%radius = -sign(1.0_wp, arm(1))*arm(2)
   end subroutine take_mark

   !> The row.
   subroutine put_gear(model, draft, statement, wheels)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      type(wheel_t), intent(in) :: wheels(2)             !! (2) the wheels

      character(:), allocatable :: name, point_i, point_j

      call draft%new_name(named(statement), statement%id, name)
      call draft%point(model, wheels(1)%marker, point_i)
      call draft%point(model, wheels(2)%marker, point_j)
      call draft%put("joint.gear", "name i j axis_i axis_j radius_i radius_j", &
                     name//tab//point_i//tab//point_j//tab//cell(1)//tab//cell(2)//tab//exact_text(wheels(1)%radius)//"m"//tab// &
                     exact_text(wheels(2)%radius)//"m")

   contains

      !> The axis of the first joint in the frame of a wheel.
      function cell(k) result(words)
         integer, intent(in) :: k                 !! number of the wheel
         character(:), allocatable :: words       !! as a cell

         real(wp) :: x(3)

         x = wheels(1)%axis
         if (.not. model%parts(wheels(k)%part)%is_ground) x = matmul(transpose(model%parts(wheels(k)%part)%a), x)
         words = direction_cell(x)
      end function cell

   end subroutine put_gear

end module adams_gears
