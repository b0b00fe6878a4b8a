!> Motions of an Adams dataset as drivers of a deck.
!>
!> Angles of the deck are zero at the start; the angle of Adams at the start, between the axes x of both markers, is taken off what
!> a MOTION asks for.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: velocities whose integrals have words in a deck, see
!> `adams_integrals`.
module adams_motions
   use adams_expression, only: depends_on, on_time, parse_tree, tree_t
   use adams_integrals, only: integral_text
   use adams_joints, only: named, two_markers
   use adams_model, only: adams_model_t, find_statement, leave_out
   use adams_numbers, only: argument_numbers, id_of, mistake
   use adams_splines, only: name_splines
   use adams_starts, only: angle_at_start
   use adams_translation, only: deck_text, grouped, words_t
   use dataset, only: expression_of, find_argument, has_word, statement_t
   use deck_draft, only: body_axis, deck_draft_t, tab
   use deck_table, only: direction_cell
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: add_motions

   real(wp), parameter :: same = 1.0e-6_wp   !! angles and parts of a length that are no difference [1]

contains

   !> All MOTION statements.
   subroutine add_motions(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      integer :: i, j, k, marker(2)
      logical :: turns

      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (it%keyword /= "MOTION") cycle
            if (find_argument(it, "JOINT", 2) == 0) then
               call add_point_motion(model, draft, it, mistakes)
               cycle
            end if
            j = id_of(it, "JOINT", mistakes, 2)
            do i = 1, size(draft%joints)
               if (draft%joints(i)%id == j .and. .not. draft%joints(i)%is_primitive) exit
            end do
            if (i > size(draft%joints)) then
               if (find_statement(model, "JOINT", j) == 0) then
                  call mistake(mistakes, it%at, "MOTION/"//to_text(it%id)//" drives JOINT/"//to_text(j)// &
                        ", which does not exist", "")
               else
                  call leave_out(model, it, "its joint is not in the deck")
               end if
               cycle
            end if
            marker = draft%joints(i)%marker
            turns = draft%joints(i)%kind == "joint.revolute" .or. &
                    (draft%joints(i)%kind == "joint.cylindrical" .and. has_word(it, "ROTATIONAL", 1))
            if (turns) then
               call add_turn(model, draft, it, draft%joints(i)%name, marker, mistakes)
            else if (draft%joints(i)%kind == "joint.translational" .or. draft%joints(i)%kind == "joint.cylindrical") then
               call add_way(model, draft, it, marker, 3, mistakes)
            else
               call leave_out(model, it, "gudgeon has no driver for "//draft%joints(i)%kind)
            end if
         end associate
      end do
   end subroutine add_motions

   !> A motion between two markers: along an axis of J.
   subroutine add_point_motion(model, draft, statement, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the motion
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(1), parameter :: axes(3) = ["X", "Y", "Z"]
      integer :: axis, marker(2)

      call two_markers(model, statement, marker, mistakes)
      if (any(marker == 0)) return
      do axis = 1, 3
         if (has_word(statement, axes(axis))) exit
      end do
      if (axis > 3) then
         call leave_out(model, statement, "gudgeon has no driver for an angle between two markers without a joint")
      else
         call add_way(model, draft, statement, marker, axis, mistakes)
      end if
   end subroutine add_point_motion

   !> A driver of an angle.
   subroutine add_turn(model, draft, statement, joint, marker, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the motion
      character(*), intent(in) :: joint                  !! name of the joint
      integer, intent(in) :: marker(2)                   !! (2) I and J
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(:), allocatable :: name, text
      real(wp) :: start
      logical :: is_speed

      start = angle_at_start(model, marker)
      call motion_text(model, draft, statement, start, .true., text, is_speed, mistakes)
      if (text == "") return
      call draft%new_name(named(statement), statement%id, name)
      if (is_speed) then
         call draft%put("driver.speed", "name joint speed", &
                        name//tab//joint//tab//"{"//text//"*"//real_text(1.0_wp/model%units%time, 15)//"rad/s}")
      else
         call draft%put("driver.angle", "name joint angle", name//tab//joint//tab//"{"//text//"*1rad}")
      end if
   end subroutine add_turn

   !> A driver of a way along an axis of marker J.
   subroutine add_way(model, draft, statement, marker, axis, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the motion
      integer, intent(in) :: marker(2)                   !! (2) I and J
      integer, intent(in) :: axis                        !! axis of J, 1 to 3
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(:), allocatable :: name, point_i, point_j, text
      real(wp) :: a(3, 3), start
      logical :: is_speed

      a = model%axes(marker(2))
      start = dot_product(a(:, axis), model%place(marker(1)) - model%place(marker(2)))/model%units%length
      call motion_text(model, draft, statement, start, .false., text, is_speed, mistakes)
      if (text == "") return
      call draft%new_name(named(statement), statement%id, name)
      call draft%point(model, marker(2), point_i)
      call draft%point(model, marker(1), point_j)
      call draft%put("driver.position", "name i j axis_i position", name//tab//point_i//tab//point_j//tab// &
            direction_cell(body_axis(model, marker(2), axis))//tab//"{"//text//"*"//model%units%length_text()//"}")
   end subroutine add_way

   !> What a motion asks for as a function of time, a plain number in the units of the dataset; blank: it is omitted.
   !> Length: displacement, velocity and acceleration differ in a line or two each.
   subroutine motion_text(model, draft, statement, start, turns, text, is_speed, mistakes)
      type(adams_model_t), intent(inout) :: model           !! the dataset
      type(deck_draft_t), intent(inout) :: draft            !! the deck
      type(statement_t), intent(in) :: statement            !! the motion
      real(wp), intent(in) :: start                         !! value at the start, in the units of the dataset [any]
      logical, intent(in) :: turns                          !! whether it is an angle, zero at the start in the deck
      character(:), allocatable, intent(out) :: text        !! the function
      logical, intent(out) :: is_speed                      !! whether it is the constant rate of an angle
      type(diagnostics_t), intent(inout) :: mistakes        !! collects what is wrong

      type(tree_t) :: tree
      character(:), allocatable :: at_zero, expression, first, message
      type(words_t) :: at_start, words
      real(wp), allocatable :: given(:), speed(:)
      integer :: bits
      logical :: by_acceleration, by_velocity

      text = ""
      is_speed = .false.
      expression = expression_of(statement, "FUNCTION", 3)
      if (expression == "") then
         call leave_out(model, statement, "it has no FUNCTION")
         return
      end if
      call parse_tree(expression, tree)
      message = tree%message
      call name_splines(model, draft, tree, message)
      if (message == "") bits = depends_on(tree, tree%root, [0, 0], .false.)
      if (message == "") then
         if (iand(bits, not(on_time)) /= 0) message = "it depends on more than time"
      end if
      words%time = "(t/"//model%units%time_text()//")"
      words%stretch = ""
      at_start = words_t("0", "")
      by_velocity = has_word(statement, "VELOCITY", 1)
      by_acceleration = has_word(statement, "ACCELERATION", 1)
      call argument_numbers(statement, "ICDISP", given, mistakes, 3)
      call argument_numbers(statement, "ICVEL", speed, mistakes, 3)
      if (message /= "") then
         continue
      else if (by_acceleration) then
         if (bits /= 0) message = "an ACCELERATION that is not constant"
         call deck_text(tree, tree%root, words, first, message)
         if (size(speed) == 0) speed = [0.0_wp]
         text = grouped(first)//"*"//words%time//"^2/2 + "//real_text(speed(1), 15)//"*"//words%time
      else if (by_velocity .and. bits == 0 .and. turns) then
         is_speed = .true.
         call deck_text(tree, tree%root, words, first, message)
         text = grouped(first)
      else if (by_velocity) then
         call integral_text(tree, tree%root, words, first, message)
         call integral_text(tree, tree%root, at_start, at_zero, message)
         text = first//" - "//grouped(at_zero)
      else
         call deck_text(tree, tree%root, words, text, message)
         if (turns .and. abs(start) > 1.0e-14_wp) text = text//" - ("//real_text(start, 17)//")"
      end if
      if (message /= "") then
         text = ""
         call leave_out(model, statement, message//": "//expression)
         return
      end if
      if (by_velocity .or. by_acceleration) then
         if (size(given) > 0) then
            if (abs(given(1) - start) > same*(1.0_wp + abs(start))) call leave_out(model, statement, "ICDISP = "// &
               real_text(given(1), 6)//"; the motion starts at "//real_text(start, 6)//", the position of the markers")
         end if
         if (.not. turns .and. abs(start) > 0.0_wp) text = real_text(start, 17)//" + "//text
      end if
      if (.not. is_speed) text = grouped(text)
   end subroutine motion_text

end module adams_motions
