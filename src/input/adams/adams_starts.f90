!> How the joints of an Adams dataset start: displacements and speeds of IC, ICROT and ICTRAN.
!>
!> A speed of a turn is a row of `[initial.speed]`. A speed of a slide becomes the velocity of the body that slides, if the other
!> one is the ground. Displacements are looked at only: bodies start where the dataset puts them.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: bodies that slide on bodies that move.
module adams_starts
   use adams_model, only: adams_model_t, leave_out
   use adams_numbers, only: argument_numbers
   use dataset, only: has_word, statement_t
   use deck_draft, only: deck_draft_t, joint_t, tab
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: add_start, angle_at_start, displacement_at_start, sliding_velocity

   real(wp), parameter :: same = 1.0e-6_wp   !! angles and parts of a length that are no difference [1]

contains

   !> Initial conditions of a joint that was put into the deck.
   subroutine add_start(model, draft, joint, statement, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(joint_t), intent(in) :: joint                 !! the joint in the deck
      type(statement_t), intent(in) :: statement         !! the joint in the dataset
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp), allocatable :: turn(:), slide(:)
      real(wp) :: now, velocity(3)
      integer :: part
      character(:), allocatable :: name

      call initial_conditions(statement, turn, slide, mistakes)
      if (size(turn) > 0) then
         now = angle_at_start(model, joint%marker)
         if (abs(sin(0.5_wp*(turn(1) - now))) > same) call leave_out(model, statement, "it requests the initial angle  "// &
            real_text(turn(1), 6)//" rad; the markers give "//real_text(now, 6)//" rad")
      end if
      if (size(slide) > 0) then
         now = displacement_at_start(model, joint%marker)
         if (abs(slide(1)*model%units%length - now) > same*(abs(now) + model%units%length)) call leave_out(model, statement, &
            "it requests the initial displacement "//real_text(slide(1), 6)//"; the markers give "// &
            real_text(now/model%units%length, 6)//"")
      end if
      if (size(slide) > 1) then
         call slide_of(model, statement, joint%marker, part, velocity, mistakes)
         if (part == 0) call leave_out(model, statement, "the speed of its displacement: give a body a velocity instead")
      end if
      if (size(turn) < 2) return
      if (joint%kind /= "joint.revolute" .and. joint%kind /= "joint.cylindrical") then
         call leave_out(model, statement, "the speed of ICROT")
         return
      end if
      call draft%new_name(joint%name//"_start", statement%id, name)
      call draft%put("initial.speed", "name joint speed[rad/s]", &
                     name//tab//joint%name//tab//real_text(turn(2)/model%units%time, 15))
   end subroutine add_start

   !> Displacement and speed of the turn and of the slide of a joint; IC is that of the freedom that it has.
   subroutine initial_conditions(statement, turn, slide, mistakes)
      type(statement_t), intent(in) :: statement         !! the joint
      real(wp), allocatable, intent(out) :: turn(:)      !! (0 to 2) angle and its rate, units of the dataset [any]
      real(wp), allocatable, intent(out) :: slide(:)       !! (0 to 2) displacement and its rate, units of the dataset [any]
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      call argument_numbers(statement, "ICROT", turn, mistakes, 3)
      call argument_numbers(statement, "ICTRAN", slide, mistakes, 3)
      if (has_word(statement, "TRANSLATIONAL", 2)) then
         if (size(slide) == 0) call argument_numbers(statement, "IC", slide, mistakes)
      else if (size(turn) == 0) then
         call argument_numbers(statement, "IC", turn, mistakes)
      end if
   end subroutine initial_conditions

   !> The velocity with which a part starts to slide in a joint that says so.
   subroutine sliding_velocity(model, part, velocity, is_given, mistakes)
      type(adams_model_t), intent(in) :: model           !! the dataset
      integer, intent(in) :: part                        !! number of the part in the list
      real(wp), intent(out) :: velocity(3)               !! (3) world, units of the dataset [any]
      logical, intent(out) :: is_given                   !! whether there is such a joint
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp), allocatable :: id(:)
      integer :: k, marker(2), moved, side
      character(1), parameter :: names(2) = ["I", "J"]

      velocity = 0.0_wp
      is_given = .false.
      do k = 1, size(model%joints)
         associate (joint => model%statements(model%joints(k)))
            do side = 1, 2
               call argument_numbers(joint, names(side), id, mistakes)
               marker(side) = 0
               if (size(id) > 0) marker(side) = model%marker(nint(min(abs(id(1)), 1.0e9_wp)))
            end do
            if (any(marker == 0)) cycle
            if (all(model%markers(marker)%part /= part)) cycle
            call slide_of(model, joint, marker, moved, velocity, mistakes)
         end associate
         is_given = moved == part
         if (is_given) return
      end do
   end subroutine sliding_velocity

   !> The part that a joint lets slide against the ground with a speed at the start, and its velocity.
   subroutine slide_of(model, statement, marker, part, velocity, mistakes)
      type(adams_model_t), intent(in) :: model           !! the dataset
      type(statement_t), intent(in) :: statement         !! the joint
      integer, intent(in) :: marker(2)                   !! (2) I and J
      integer, intent(out) :: part                       !! number of the part in the list; 0: there is none
      real(wp), intent(out) :: velocity(3)               !! (3) world, units of the dataset [any]
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp), allocatable :: turn(:), slide(:)
      real(wp) :: a(3, 3)
      integer :: k, parts(2)

      part = 0
      velocity = 0.0_wp
      if (.not. (has_word(statement, "TRANSLATIONAL", 2) .or. has_word(statement, "CYLINDRICAL", 2))) return
      call initial_conditions(statement, turn, slide, mistakes)
      if (size(slide) < 2) return
      if (size(turn) > 1) then
         if (abs(turn(2)) > 0.0_wp) return   ! the centre of mass would move across the axis too
      end if
      parts = model%markers(marker)%part
      if (model%parts(parts(1))%is_ground .eqv. model%parts(parts(2))%is_ground) return
      k = merge(2, 1, model%parts(parts(1))%is_ground)
      if (has_own_velocity(model%statements(model%parts(parts(k))%statement))) return
      part = parts(k)
      a = model%axes(marker(2))
      velocity = merge(1.0_wp, -1.0_wp, k == 1)*slide(2)*a(:, 3)
   end subroutine slide_of

   !> Whether a part says how fast it starts.
   pure logical function has_own_velocity(statement)
      type(statement_t), intent(in) :: statement   !! the part

      has_own_velocity = has_word(statement, "VX") .or. has_word(statement, "VY") .or. has_word(statement, "VZ")
   end function has_own_velocity

   !> Angle of marker I against J about the axis z of J, from axis x to axis x.
   pure real(wp) function angle_at_start(model, marker) result(angle)
      type(adams_model_t), intent(in) :: model           !! the dataset
      integer, intent(in) :: marker(2)                   !! (2) I and J

      real(wp) :: a(3, 3)

      a = matmul(transpose(model%axes(marker(2))), model%axes(marker(1)))
      angle = atan2(a(2, 1), a(1, 1))
   end function angle_at_start

   !> Displacement of marker I from J along the axis z of J.
   pure real(wp) function displacement_at_start(model, marker) result(x)
      type(adams_model_t), intent(in) :: model           !! the dataset
      integer, intent(in) :: marker(2)                   !! (2) I and J

      real(wp) :: a(3, 3)

      a = model%axes(marker(2))
      x = dot_product(a(:, 3), model%place(marker(1)) - model%place(marker(2)))
   end function displacement_at_start

end module adams_starts
