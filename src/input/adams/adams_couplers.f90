!> Couplers of an Adams dataset as rows of `joint.coupler`.
!>
!> r_1 q_1 + r_2 q_2 (+ r_3 q_3) = 0 with q_k the displacement of marker I against J along the axis z of J, in the dataset's unit
!> of length, or the angle about it in radians, both from the start. A deck adds terms in one unit: beside a displacement the
!> factor of an angle is a length per angle.
!>
!> Source: the public description of the statement of Adams/Solver: r_1 is 1 where one factor fewer than joints is given. Limits:
!> revolute, translational and cylindrical joints; no FUNCTION.
module adams_couplers
   use adams_joints, only: named
   use adams_model, only: adams_model_t, leave_out
   use adams_numbers, only: argument_numbers
   use dataset, only: find_argument, statement_t, upper_case
   use deck_draft, only: deck_draft_t, joint_t, tab
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use text, only: exact_text
   implicit none (type, external)
   private
   public :: add_couplers

   integer, parameter :: most = 3   !! joints of a coupler, at most

contains

   !> All COUPLER statements.
   subroutine add_couplers(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck, with its joints
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      type(joint_t) :: joints(most)
      character(:), allocatable :: message
      real(wp), allocatable :: scales(:)
      logical :: is_angle(most)
      integer :: k, n

      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (it%keyword /= "COUPLER") cycle
            call find_joints(draft, it, joints, n, message, mistakes)
            if (message == "") call find_coordinates(it, joints(:n), is_angle(:n), message)
            if (message == "") call take_scales(it, n, scales, message, mistakes)
            if (message == "") then
               call put_coupler(model, draft, it, joints(:n), is_angle(:n), scales)
            else
               call leave_out(model, it, message)
            end if
         end associate
      end do
   end subroutine add_couplers

   !> Its two or three joints in the deck.
   subroutine find_joints(draft, statement, joints, n, message, mistakes)
      type(deck_draft_t), intent(in) :: draft             !! the deck, with its joints
      type(statement_t), intent(in) :: statement          !! the statement
      type(joint_t), intent(out) :: joints(most)          !! (most) those that there are are set
      integer, intent(out) :: n                           !! how many
      character(:), allocatable, intent(out) :: message   !! what is wrong with the statement; blank: nothing
      type(diagnostics_t), intent(inout) :: mistakes      !! collects what is wrong

      real(wp), allocatable :: id(:)
      integer :: i, k

      call argument_numbers(statement, "JOINTS", id, mistakes, 1)
      n = size(id)
      message = "a FUNCTION of its own is not supported"
      if (find_argument(statement, "FUNCTION", 1) > 0) return
      message = "it does not name two or three JOINTS"
      if (n < 2 .or. n > most) return
      message = "its joints are not all revolute, translational or cylindrical joints of the deck"
      do k = 1, n
         do i = 1, size(draft%joints)
            if (draft%joints(i)%is_primitive) cycle
            if (index(" joint.revolute joint.translational joint.cylindrical ", " "//draft%joints(i)%kind//" ") == 0) cycle
            if (abs(draft%joints(i)%id - id(k)) < 0.5_wp) exit
         end do
         if (i > size(draft%joints)) return
         joints(k) = draft%joints(i)
      end do
      message = ""
   end subroutine find_joints

   !> Which of them give their angles: TYPE says it of cylindrical joints.
   subroutine find_coordinates(statement, joints, is_angle, message)
      type(statement_t), intent(in) :: statement              !! the statement
      type(joint_t), intent(in) :: joints(:)                  !! (n) the joints
      logical, intent(out) :: is_angle(:)                     !! (n) whether the angle; else the displacement
      character(:), allocatable, intent(inout) :: message     !! set: TYPE does not match

      character(:), allocatable :: letters
      integer :: argument, c, i, k

      letters = ""
      argument = find_argument(statement, "TYPE", 1)
      if (argument > 0) then
         associate (values => statement%arguments(argument)%values)
            do i = 1, size(values)
               do c = 1, len(values(i)%s)
                  if (index(":, ", values(i)%s(c:c)) == 0) letters = letters//upper_case(values(i)%s(c:c))
               end do
            end do
         end associate
      end if
      do k = 1, size(joints)
         is_angle(k) = joints(k)%kind == "joint.revolute"
         if (len(letters) == size(joints)) then
            if (index("RT", letters(k:k)) == 0) message = "its TYPE has other letters than T and R"
            if (joints(k)%kind == "joint.cylindrical") is_angle(k) = letters(k:k) == "R"
            if (is_angle(k) .neqv. letters(k:k) == "R") message = "its TYPE does not match its joints"
         else if (joints(k)%kind == "joint.cylindrical" .or. letters /= "") then
            message = "its TYPE does not have a letter for each of its joints"
         end if
      end do
   end subroutine find_coordinates

   !> Its factors; the first is 1 where it is omitted.
   subroutine take_scales(statement, n, scales, message, mistakes)
      type(statement_t), intent(in) :: statement                !! the statement
      integer, intent(in) :: n                                  !! number of joints
      real(wp), allocatable, intent(out) :: scales(:)           !! (n) factors, of the dataset's units [any]
      character(:), allocatable, intent(inout) :: message       !! set: it has none
      type(diagnostics_t), intent(inout) :: mistakes            !! collects what is wrong

      call argument_numbers(statement, "SCALES", scales, mistakes, 1)
      if (size(scales) == n - 1) scales = [1.0_wp, scales]
      if (size(scales) /= n) then
         message = "it does not have SCALES for its joints"
      else if (.not. minval(abs(scales)) > 0.0_wp) then
         message = "one of its SCALES is zero"
      end if
   end subroutine take_scales

   !> The row.
   subroutine put_coupler(model, draft, statement, joints, is_angle, scales)
      type(adams_model_t), intent(in) :: model           !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      type(joint_t), intent(in) :: joints(:)             !! (n) the joints
      logical, intent(in) :: is_angle(:)                 !! (n) whether their angles are coupled
      real(wp), intent(in) :: scales(:)                  !! (n) factors [any]

      character(:), allocatable :: name, names, factors, words
      integer :: k

      call draft%new_name(named(statement), statement%id, name)
      names = ""
      factors = ""
      words = ""
      do k = 1, most
         names = names//tab
         factors = factors//tab
         words = words//tab
         if (k > size(joints)) cycle
         names = names//joints(k)%name
         if (all(is_angle) .or. .not. is_angle(k)) then
            factors = factors//exact_text(scales(k))
         else
            factors = factors//exact_text(scales(k)*model%units%length)//"m/rad"
         end if
         if (joints(k)%kind == "joint.cylindrical") words = words//trim(merge("angle       ", "displacement", is_angle(k)))
      end do
      call draft%put("joint.coupler", "name joint_1 joint_2 joint_3 scale_1 scale_2 scale_3 of_1 of_2 of_3", &
                     name//names//factors//words)
   end subroutine put_coupler

end module adams_couplers
