!> Forces and torques of an Adams dataset that act on one part, as rows of a deck.
!>
!> | Adams | deck |
!> |---|---|
!> | SFORCE, ACTIONONLY | `force.point`, `force.torque` along the axis z of J |
!> | VFORCE, VTORQUE, GFORCE against the ground | `force.point`, `force.torque` along the axes of RM |
!>
!> They may depend on the time and on the measures that `adams_measures` has words for.
!> Source: the public descriptions of the statements of Adams/Solver. Limits: axes of the ground or of the part that is loaded;
!> reactions on the ground.
module adams_loads
   use adams_joints, only: named
   use adams_model, only: adams_model_t, find_statement, leave_out
   use adams_numbers, only: id_of, mistake
   use dataset, only: expression_of, find_argument, statement_t
   use deck_draft, only: body_axis, body_name, deck_draft_t, tab
   use diagnostics, only: diagnostics_t
   use force_parts, only: whole_force
   use kinds, only: wp
   use text, only: real_text, text_t, to_text
   implicit none (type, external)
   private
   public :: add_loads, put_alone

contains

   !> All forces and torques of three components.
   subroutine add_loads(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      integer :: k

      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (index(" VFORCE GFORCE VTORQUE ", " "//it%keyword//" ") > 0) call add_vector(model, draft, it, mistakes)
         end associate
      end do
   end subroutine add_loads

   !> A force or torque on I alone, along the axis z of J.
   subroutine put_alone(model, draft, statement, marker, turns, text)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      logical, intent(in) :: turns                       !! whether it is a torque
      character(*), intent(in) :: text                   !! its size, with its unit

      character(:), allocatable :: c(:), frame
      real(wp) :: z(3)
      integer :: k

      if (.not. axes_of_load(model, marker(2), marker(1), frame)) then
         call leave_out(model, statement, "its direction moves with another part")
         return
      end if
      z = body_axis(model, marker(2), 3)
      allocate (character(len(text) + 40) :: c(3))
      do k = 1, 3
         c(k) = ""
         if (abs(z(k)) > 1.0e-15_wp) c(k) = "{"//real_text(z(k), 17)//"*"//text//"}"
      end do
      call put_load(model, draft, statement, marker(1), turns, frame, trim(c(1))//tab//trim(c(2))//tab//trim(c(3)))
   end subroutine put_alone

   !> Whether the axes of a marker are those of the world or of the body that is loaded, and which.
   logical function axes_of_load(model, axes, loaded, frame) result(is_one)
      type(adams_model_t), intent(in) :: model              !! the dataset
      integer, intent(in) :: axes                           !! marker with the axes
      integer, intent(in) :: loaded                         !! marker that is loaded
      character(:), allocatable, intent(out) :: frame       !! as a cell

      frame = ""
      is_one = model%parts(model%markers(axes)%part)%is_ground
      if (is_one) return
      is_one = model%markers(axes)%part == model%markers(loaded)%part
      frame = "body"
   end function axes_of_load

   !> A row of a force at a point, or of a torque.
   subroutine put_load(model, draft, statement, marker, turns, frame, components)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker                      !! that is loaded
      logical, intent(in) :: turns                       !! whether it is a torque
      character(*), intent(in) :: frame                  !! cell
      character(*), intent(in) :: components             !! three cells

      character(:), allocatable :: name, point

      if (components == tab//tab) return
      call draft%new_name(named(statement), statement%id, name)
      associate (part => model%parts(model%markers(marker)%part))
         if (part%is_ground) then
            call leave_out(model, statement, "it acts on the ground")
         else if (turns) then
            call draft%put("force.torque", "name body mx my mz frame", name//tab//body_name(part%name, .false.)//tab// &
                  components//tab//frame)
         else
            call draft%point(model, marker, point)
            call draft%put("force.point", "name point fx fy fz frame", name//tab//point//tab//components//tab//frame)
         end if
      end associate
   end subroutine put_load

   !> A force and a torque of three components.
   subroutine add_vector(model, draft, statement, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(2), parameter :: names(3, 2) = reshape(["FX", "FY", "FZ", "TX", "TY", "TZ"], [3, 2])
      character(:), allocatable :: expression, frame, message, sum, unit
      type(text_t) :: cells(3), terms(3)
      real(wp) :: a(3, 3)
      integer :: i, k, marker, other, pass, reference

      marker = model%marker(id_of(statement, "I", mistakes))
      other = model%marker(id_of(statement, "JFLOAT", mistakes, 2))
      reference = model%marker(id_of(statement, "RM", mistakes))
      if (marker == 0 .or. reference == 0) then
         call mistake(mistakes, statement%at, "I and RM of "//statement%keyword//"/"//to_text(statement%id)// &
                      " are not markers of rigid parts", "")
         return
      end if
      if (find_argument(statement, "FUNCTION", 3) > 0 .or. all([((find_argument(statement, names(k, pass)) == 0, &
                                                                  k=1, 3), pass=1, 2)])) then
         call leave_out(model, statement, "its components are missing, or user code outside the dataset")
         return
      end if
      if (.not. floats_on_ground(model, statement, mistakes)) then
         call leave_out(model, statement, "its reaction acts on a moving part")
         return
      end if
      if (.not. axes_of_load(model, reference, marker, frame)) then
         call leave_out(model, statement, "its axes move with another part")
         return
      end if
      do pass = 1, 2
         do k = 1, 3
            terms(k)%s = ""
            expression = expression_of(statement, names(k, pass))
            if (expression == "") cycle
            call whole_force(model, draft, expression, terms(k)%s, message)
            if (message == "") cycle
            call leave_out(model, statement, message//": "//expression)
            return
         end do
         unit = model%units%force_text()
         if (pass == 2) unit = unit//"*"//model%units%length_text()
         a = reshape([body_axis(model, reference, 1), body_axis(model, reference, 2), body_axis(model, reference, 3)], [3, 3])
         do i = 1, 3
            sum = ""
            do k = 1, 3
               if (terms(k)%s == "" .or. abs(a(i, k)) <= 1.0e-15_wp) cycle
               if (sum /= "") sum = sum//" + "
               sum = sum//real_text(a(i, k), 17)//"*"//terms(k)%s
            end do
            cells(i)%s = ""
            if (sum /= "") cells(i)%s = "{("//sum//")*"//unit//"}"
         end do
         call put_load(model, draft, statement, marker, pass == 2, frame, cells(1)%s//tab//cells(2)%s//tab//cells(3)%s)
      end do
   end subroutine add_vector

   !> Whether the floating marker of a force is on the ground.
   logical function floats_on_ground(model, statement, mistakes)
      type(adams_model_t), intent(in) :: model           !! the dataset
      type(statement_t), intent(in) :: statement         !! the force
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      integer :: i, k, part

      floats_on_ground = .false.
      k = find_statement(model, "MARKER", id_of(statement, "JFLOAT", mistakes, 2))
      if (k == 0) return
      part = id_of(model%statements(k), "PART", mistakes, 1)
      do i = 1, size(model%parts)
         if (model%parts(i)%id == part) floats_on_ground = model%parts(i)%is_ground
      end do
   end function floats_on_ground

end module adams_loads
