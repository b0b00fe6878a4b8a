!> Joints and joint primitives of an Adams dataset as rows of a deck.
!>
!> A joint of Adams moves marker I against marker J along and about the axis z of J; a deck's joint moves j against i. So i of
!> the deck is J, and j is I. Two kinds have conventions of their own:
!>
!> | Adams | deck |
!> |---|---|
!> | CONVEL: axes z of I and J point along the shafts, away from the joint | `joint.constant_velocity`, `axis_j` along -z of I |
!> | RACKPIN: the pinion turns about its z, and its x points along z of the rack, whose pitch line that is | `joint.rack` |
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: a RACKPIN whose x and z are not along one another.
module adams_joints
   use adams_model, only: adams_model_t, leave_out
   use adams_numbers, only: argument_numbers, id_of, mistake
   use adams_starts, only: add_start
   use dataset, only: has_word, line_words, statement_t
   use deck_draft, only: body_axis, deck_draft_t, joint_t, tab
   use deck_table, only: direction_cell
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use motion, only: cross
   use text, only: exact_text, to_text
   implicit none (type, external)
   private
   public :: add_joints, add_primitives, named, two_markers

   character(*), parameter :: header = "name i j axis_i axis_j pitch zero"   !! of all joints; what a kind lacks stays blank
   real(wp), parameter :: same = 1.0e-6_wp   !! angles and parts of a length that are no difference [1]

contains

   !> All JOINT statements.
   subroutine add_joints(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(14), parameter :: adams(9) = [character(14) :: "REVOLUTE", "TRANSLATIONAL", "CYLINDRICAL", "SPHERICAL", &
                                                 "UNIVERSAL", "HOOKE", "PLANAR", "FIXED", "CONVEL"]
      character(17), parameter :: deck(9) = [character(17) :: "revolute", "translational", "cylindrical", "spherical", &
                                                "universal", "universal", "planar", "rigid", "constant_velocity"]
      integer :: i, k, marker(2)

      allocate (draft%joints(0))
      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (it%keyword /= "JOINT") cycle
            call two_markers(model, it, marker, mistakes)
            if (any(marker == 0)) cycle
            if (has_word(it, "SCREW", 2)) then
               call add_screw(model, draft, it, marker, mistakes)
               cycle
            end if
            if (has_word(it, "RACKPIN", 2)) then
               call add_rack(model, draft, it, marker, mistakes)
               cycle
            end if
            do i = 1, size(adams)
               if (has_word(it, trim(adams(i)), 2)) exit
            end do
            if (i > size(adams)) then
               call leave_out(model, it, "gudgeon has no such spatial joint ("//first_word(it)//")")
            else if (trim(adams(i)) == "CYLINDRICAL" .and. is_of_screw(model, marker, mistakes)) then
               call model%changed%add(line_words(it%at)//"JOINT/"//to_text(it%id)// &
                                      " (cylindrical) and the screw on the same axis are merged to one joint.screw")
            else
               call add_joint(model, draft, it, "joint."//trim(deck(i)), axes_of(trim(adams(i))), marker, "")
               call add_start(model, draft, draft%joints(size(draft%joints)), it, mistakes)
            end if
         end associate
      end do
   end subroutine add_joints

   !> Axes of the markers I and J that a type of joint is about: z, but for HOOKE, whose cross has x of I and y of J as its arms.
   pure function axes_of(kind) result(axis)
      character(*), intent(in) :: kind   !! type in the dataset
      integer :: axis(2)                 !! (2) of I and J, 1 to 3

      axis = 3
      if (kind == "HOOKE") axis = [1, 2]
   end function axes_of

   !> The first word of a statement that has no value.
   pure function first_word(statement) result(word)
      type(statement_t), intent(in) :: statement   !! the statement
      character(:), allocatable :: word            !! blank if it has none

      integer :: k

      word = "no type"
      do k = size(statement%arguments), 1, -1
         if (size(statement%arguments(k)%values) == 0) word = statement%arguments(k)%name
      end do
   end function first_word

   !> Markers I and J of a statement, as places in the list; one that is not there is an error.
   subroutine two_markers(model, statement, marker, mistakes)
      type(adams_model_t), intent(in) :: model           !! the dataset
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(out) :: marker(2)                  !! (2) I and J; 0: missing
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(1), parameter :: names(2) = ["I", "J"]
      integer :: id, k

      do k = 1, 2
         id = id_of(statement, names(k), mistakes)
         marker(k) = model%marker(id)
         if (marker(k) == 0) call mistake(mistakes, statement%at, "marker "//names(k)//" = "//to_text(id)//" of "// &
                                          statement%keyword//"/"//to_text(statement%id)//" is not a MARKER of a rigid part", "")
      end do
   end subroutine two_markers

   !> A row of a joint.
   subroutine add_joint(model, draft, statement, kind, axis, marker, pitch)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      character(*), intent(in) :: kind                   !! of the deck
      integer, intent(in) :: axis(2)                     !! (2) axes of I and J that the kind has, 1 to 3
      integer, intent(in) :: marker(2)                   !! (2) I and J
      character(*), intent(in) :: pitch                  !! of a screw; else blank

      type(joint_t) :: new
      character(:), allocatable :: axis_i, axis_j, name, point_i, point_j, zero
      real(wp) :: a(3, 3), b(3, 3), x(3)

      call draft%new_name(named(statement), statement%id, name)
      call draft%point(model, marker(2), point_i)
      call draft%point(model, marker(1), point_j)
      axis_i = ""
      axis_j = ""
      zero = ""
      a = model%axes(marker(1))
      b = model%axes(marker(2))
      select case (kind)
      case ("joint.spherical")
         continue
      case ("joint.rigid", "joint.orientation", "joint.translational")
         if (kind == "joint.translational") axis_i = direction_cell(body_axis(model, marker(2), axis(2)))
         if (maxval(abs(a - b)) > same) call model%changed%add(line_words(statement%at)//statement%keyword//"/"// &
            to_text(statement%id)//" keeps the initial orientation of the dataset, in which I and J differ")
      case ("joint.constant_velocity")
         axis_i = direction_cell(body_axis(model, marker(2), 3))
         x = body_axis(model, marker(1), 3)
         axis_j = direction_cell(merge(-x, x, dot_product(a(:, 3), b(:, 3)) < 0.0_wp))
         call check_shafts(model, statement, a, b)
      case default
         axis_i = direction_cell(body_axis(model, marker(2), axis(2)))
         x = body_axis(model, marker(1), axis(1))
         if (kind /= "joint.universal" .and. kind /= "joint.perpendicular" .and. &
             dot_product(a(:, axis(1)), b(:, axis(2))) < 0.0_wp) then
            x = -x
            call model%changed%add(line_words(statement%at)//statement%keyword//"/"//to_text(statement%id)// &
                                   ": the z axes of I and J are opposed; that of I is reversed")
         end if
         axis_j = direction_cell(x)
         if (kind == "joint.inline" .or. kind == "joint.inplane") axis_j = ""
      end select
      if (index(" joint.revolute joint.cylindrical joint.screw joint.planar ", " "//kind//" ") > 0) zero = "start"
      call draft%put(kind, header, name//tab//point_i//tab//point_j//tab//axis_i//tab//axis_j//tab//pitch//tab//zero)
      new = joint_t(statement%id, statement%keyword == "JPRIM", name, kind, marker)
      draft%joints = [draft%joints, new]
   end subroutine add_joint

   !> What a constant-velocity joint has otherwise in a deck.
   subroutine check_shafts(model, statement, a, b)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(statement_t), intent(in) :: statement         !! the statement
      real(wp), intent(in) :: a(3, 3)                    !! (3, 3) axes of I as columns, world frame [1]
      real(wp), intent(in) :: b(3, 3)                    !! (3, 3) those of J [1]

      character(:), allocatable :: place

      place = line_words(statement%at)//"JOINT/"//to_text(statement%id)//" (constant velocity)"
      if (dot_product(a(:, 3), b(:, 3)) >= 0.0_wp) then
         call model%changed%add(place//": the z axes of I and J do not point away from one another; they are used as the shafts")
      else if (abs(dot_product(a(:, 1), b(:, 2)) + dot_product(a(:, 2), b(:, 1))) > same) then
         call model%changed%add(place//" keeps the initial twist of the dataset, in which the x axes of I and J differ")
      end if
   end subroutine check_shafts

   !> A rack and its pinion.
   subroutine add_rack(model, draft, statement, marker, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp), parameter :: near = 1.0e-3_wp  ! a part of a length that is no difference [1]
      character(:), allocatable :: name, point_i, point_j
      type(joint_t) :: new
      real(wp), allocatable :: diameter(:)
      real(wp) :: axes(3, 3, 2), radius, side
      integer :: k, pinion, rack

      call argument_numbers(statement, "PD", diameter, mistakes, 2)
      if (size(diameter) == 0) then
         call mistake(mistakes, statement%at, "a rack and pinion needs a pitch diameter PD", "")
         return
      end if
      do k = 1, 2
         axes(:, :, k) = model%axes(marker(k))
      end do
      pinion = 0
      do k = 1, 2
         if (dot_product(axes(:, 1, k), axes(:, 3, 3 - k)) > 1.0_wp - same) pinion = pinion + k
      end do
      if (pinion /= 1 .and. pinion /= 2) then
         call leave_out(model, statement, "the marker of the pinion is identified by its x axis, along z of the rack; here "// &
                        trim(merge("neither matches", "both match     ", pinion == 0)))
         return
      end if
      rack = 3 - pinion
      radius = 0.5_wp*diameter(1)*model%units%length
      side = dot_product(model%place(marker(pinion)) - model%place(marker(rack)), cross(axes(:, 3, pinion), axes(:, 3, rack)))
      if (abs(abs(side) - abs(radius)) > near*abs(radius)) call model%changed%add(line_words(statement%at)//"JOINT/"// &
         to_text(statement%id)//" (rack and pinion): the distance of the axes is "//exact_text(abs(side))//" m, but half of PD "// &
            "is used")
      call draft%new_name(named(statement), statement%id, name)
      call draft%point(model, marker(rack), point_i)
      call draft%point(model, marker(pinion), point_j)
      call draft%put("joint.rack", "name i j axis_i axis_j radius", name//tab//point_i//tab//point_j//tab// &
                     direction_cell(body_axis(model, marker(rack), 3))//tab//direction_cell(body_axis(model, marker(pinion), 3))// &
                     tab//exact_text(sign(radius, merge(side, radius, abs(side) > near*abs(radius))))//"m")
      new%id = statement%id
      new%name = name
      new%kind = "joint.rack"
      new%marker = marker
      draft%joints = [draft%joints, new]
   end subroutine add_rack

   !> The name of a statement.
   pure function named(statement) result(name)
      type(statement_t), intent(in) :: statement   !! the statement
      character(:), allocatable :: name            !! from Adams/View, or keyword and number

      name = statement%view_name
      if (name == "") name = statement%keyword//"_"//to_text(statement%id)
   end function named

   !> A screw: one constraint in Adams, which goes with a cylindrical joint; both in a deck.
   subroutine add_screw(model, draft, statement, marker, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp), allocatable :: pitch(:)

      call argument_numbers(statement, "PITCH", pitch, mistakes, 2)
      if (size(pitch) == 0) then
         call mistake(mistakes, statement%at, "a screw needs a PITCH", "")
         return
      end if
      call add_joint(model, draft, statement, "joint.screw", [3, 3], marker, exact_text(pitch(1)*model%units%length)//"m")
      if (.not. any_cylinder(model, marker, mistakes)) call model%changed%add(line_words(statement%at)//"JOINT/"// &
         to_text(statement%id)//" (screw) constrains its axis too, as there is no cylindrical joint beside it")
      call add_start(model, draft, draft%joints(size(draft%joints)), statement, mistakes)
   end subroutine add_screw

   !> Whether a screw ties the parts of two markers about the same axis.
   logical function is_of_screw(model, marker, mistakes)
      type(adams_model_t), intent(in) :: model           !! the dataset
      integer, intent(in) :: marker(2)                   !! (2) I and J of a cylindrical joint
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      is_of_screw = any_partner(model, marker, "SCREW", mistakes)
   end function is_of_screw

   !> Whether a cylindrical joint ties the parts of two markers about the same axis.
   logical function any_cylinder(model, marker, mistakes)
      type(adams_model_t), intent(in) :: model           !! the dataset
      integer, intent(in) :: marker(2)                   !! (2) I and J of a screw
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      any_cylinder = any_partner(model, marker, "CYLINDRICAL", mistakes)
   end function any_cylinder

   !> Whether a joint of some type ties the same parts about a parallel axis.
   logical function any_partner(model, marker, word, mistakes)
      type(adams_model_t), intent(in) :: model           !! the dataset
      integer, intent(in) :: marker(2)                   !! (2) I and J
      character(*), intent(in) :: word                   !! type of the joint
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp) :: a(3, 3), b(3, 3)
      integer :: k, other(2), parts(2), theirs(2)

      any_partner = .false.
      parts = [model%markers(marker(1))%part, model%markers(marker(2))%part]
      a = model%axes(marker(2))
      do k = 1, size(model%statements)
         if (model%statements(k)%keyword /= "JOINT") cycle
         if (.not. has_word(model%statements(k), word, 2)) cycle
         call two_markers(model, model%statements(k), other, mistakes)
         if (any(other == 0)) cycle
         theirs = [model%markers(other(1))%part, model%markers(other(2))%part]
         b = model%axes(other(2))
         if ((all(theirs == parts) .or. all(theirs == parts(2:1:-1))) .and. &
             abs(dot_product(a(:, 3), b(:, 3))) > 1.0_wp - same) any_partner = .true.
      end do
   end function any_partner

   !> All JPRIM statements.
   subroutine add_primitives(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(14), parameter :: adams(6) = [character(14) :: "ATPOINT", "INLINE", "INPLANE", "ORIENTATION", "PARALLEL_AXES", &
                                                 "PERPENDICULAR"]
      character(13), parameter :: deck(6) = [character(13) :: "spherical", "inline", "inplane", "orientation", "parallel_axes", &
                                                "perpendicular"]
      integer :: i, k, marker(2)

      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (it%keyword /= "JPRIM") cycle
            call two_markers(model, it, marker, mistakes)
            if (any(marker == 0)) cycle
            do i = 1, size(adams)
               if (has_word(it, trim(adams(i)), 3)) exit
            end do
            if (i > size(adams)) then
               call leave_out(model, it, "gudgeon has no such spatial primitive ("//first_word(it)//")")
            else
               call add_joint(model, draft, it, "joint."//trim(deck(i)), [3, 3], marker, "")
            end if
         end associate
      end do
   end subroutine add_primitives

end module adams_joints
