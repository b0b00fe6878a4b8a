!> Springs, dampers and forces of one component of an Adams dataset as rows of a deck.
!>
!> | Adams | deck |
!> |---|---|
!> | SPRINGDAMPER | `force.spring`, `force.torsion_spring` |
!> | SFORCE, TRANSLATION, of DM, VR and TIME | `force.spring`: law of x = DM, damping, actuator |
!> | SFORCE, ROTATION, of AZ, WZ and TIME | `force.torsion_spring`: law of x = AZ, damping, actuator |
!> | SFORCE of other measures | the same, with an actuator that sees the motion |
!> | SFORCE, ACTIONONLY | `force.point`, `force.torque`: `adams_loads` |
!>
!> A force of Adams is positive if it drives I and J apart, or turns I about the axis z of J; a deck's is positive if it pulls them
!> together, or turns j (which is I) back. So the deck's is the negative one.
!> An expression is cut into the terms of its sum; each may depend on the time, on the stretch, or, linearly, on its rate. One that
!> cannot be cut is the actuator as a whole.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: measures that `adams_measures` has no words for.
module adams_forces
   use adams_joints, only: named, two_markers
   use adams_loads, only: put_alone
   use adams_model, only: adams_model_t, leave_out
   use adams_numbers, only: argument_numbers
   use adams_starts, only: angle_at_start
   use dataset, only: expression_of, has_word, statement_t
   use deck_draft, only: body_axis, body_name, deck_draft_t, tab
   use deck_table, only: direction_cell
   use diagnostics, only: diagnostics_t
   use expression, only: expression_t
   use expression_compile, only: compile_expression, evaluate_safely, fault_t, symbols_t
   use force_parts, only: cut_force, parts_t, whole_force
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kind_info, only: dim_angle, dim_length
   use kinds, only: pi, wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: add_forces

   character(*), parameter :: spring_header = "name i j stiffness[N/m] damping[N.s/m] free_length preload[N] actuator law"
   character(*), parameter :: turning_header = "name i j axis_i axis_j zero stiffness[N.m/rad] damping[N.m.s/rad] " &
      //"free_angle[rad] preload[N.m] actuator law"

contains

   !> All forces.
   subroutine add_forces(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      integer :: k, marker(2)

      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            select case (it%keyword)
            case ("SPRINGDAMPER", "SFORCE")
               call two_markers(model, it, marker, mistakes)
               if (any(marker == 0)) cycle
               if (it%keyword == "SFORCE") call add_single(model, draft, it, marker)
               if (it%keyword == "SPRINGDAMPER") call add_spring(model, draft, it, marker, mistakes)
            end select
         end associate
      end do
   end subroutine add_forces

   !> A spring and damper.
   subroutine add_spring(model, draft, statement, marker, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp) :: c, force, free, k, moment

      associate (u => model%units)
         if (has_word(statement, "ROTATIONAL", 2)) then
            moment = u%force*u%length
            k = number("KT", 2)*moment
            c = number("CT", 2)*moment*u%time
            free = number("ANGLE", 2) - angle_at_start(model, marker)
            force = -number("TORQUE", 2)*moment
            call put_turning(model, draft, statement, marker, cell(k), cell(c), cell(free), cell(force), "", "")
         else
            k = number("K", 1)*u%force/u%length
            c = number("C", 1)*u%force*u%time/u%length
            free = number("LENGTH", 1)*u%length
            force = -number("FORCE", 1)*u%force
            call put_spring(model, draft, statement, marker, cell(k), cell(c), cell(free), cell(force), "", "")
         end if
      end associate

   contains

      !> A number of the statement; 0 if it is not there.
      real(wp) function number(name, minimum) result(value)
         character(*), intent(in) :: name   !! of the argument
         integer, intent(in) :: minimum       !! letters that do for it

         real(wp), allocatable :: numbers(:)

         call argument_numbers(statement, name, numbers, mistakes, minimum)
         value = 0.0_wp
         if (size(numbers) > 0) value = numbers(1)
      end function number

   end subroutine add_spring

   !> A number as a cell; blank: zero.
   pure function cell(x) result(words)
      real(wp), intent(in) :: x                !! the number [any]
      character(:), allocatable :: words       !! its digits

      words = ""
      if (abs(x) > 0.0_wp) words = real_text(x, 16)
   end function cell

   !> A row of a spring.
   subroutine put_spring(model, draft, statement, marker, stiffness, damping, free, preload, actuator, law)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      character(*), intent(in) :: stiffness              !! cell
      character(*), intent(in) :: damping                !! cell
      character(*), intent(in) :: free                   !! a number of m, or blank
      character(*), intent(in) :: preload                !! cell
      character(*), intent(in) :: actuator               !! cell
      character(*), intent(in) :: law                    !! cell

      character(:), allocatable :: length, name, point_i, point_j

      call draft%new_name(named(statement), statement%id, name)
      call draft%point(model, marker(2), point_i)
      call draft%point(model, marker(1), point_j)
      length = free
      if (length /= "") length = length//"m"
      call draft%put("force.spring", spring_header, name//tab//point_i//tab//point_j//tab//stiffness//tab//damping//tab//length// &
            tab//preload//tab//actuator//tab//law)
   end subroutine put_spring

   !> A row of a torsional spring; its angle is zero at the start.
   subroutine put_turning(model, draft, statement, marker, stiffness, damping, free, preload, actuator, law)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      character(*), intent(in) :: stiffness              !! cell
      character(*), intent(in) :: damping                !! cell
      character(*), intent(in) :: free                   !! cell
      character(*), intent(in) :: preload                !! cell
      character(*), intent(in) :: actuator               !! cell
      character(*), intent(in) :: law                    !! cell

      character(:), allocatable :: name

      call draft%new_name(named(statement), statement%id, name)
      associate (i => model%parts(model%markers(marker(2))%part), j => model%parts(model%markers(marker(1))%part))
         call draft%put("force.torsion_spring", turning_header, name//tab//body_name(i%name, i%is_ground)//tab// &
               body_name(j%name, j%is_ground)//tab//direction_cell(body_axis(model, marker(2), 3))//tab// &
                     direction_cell(body_axis(model, marker(1), 3))//tab//"start"//tab//stiffness//tab//damping//tab//free//tab// &
                           preload//tab//actuator//tab//law)
      end associate
   end subroutine put_turning

   !> A force of one component.
   subroutine add_single(model, draft, statement, marker)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J

      type(parts_t) :: parts
      character(:), allocatable :: actuator, damping, expression, law, unit
      real(wp) :: free, start
      logical :: is_alone, turns

      expression = expression_of(statement, "FUNCTION", 3)
      if (expression == "") then
         call leave_out(model, statement, "it has no FUNCTION")
         return
      end if
      turns = has_word(statement, "ROTATIONAL", 1)
      is_alone = has_word(statement, "ACTIONONLY", 2)
      start = norm2(model%place(marker(1)) - model%place(marker(2)))/model%units%length
      if (turns) start = angle_at_start(model, marker)
      unit = model%units%force_text()
      if (turns) unit = unit//"*"//model%units%length_text()
      free = 0.0_wp
      call cut_force(model, draft, expression, statement, turns, free, parts)
      if (parts%message == "" .and. parts%of_stretch /= "") then
         free = rest_of(draft%functions, negative(parts%of_stretch, "1"), start, merge(1.0_wp, model%units%length, turns), turns)
         call cut_force(model, draft, expression, statement, turns, free, parts)
      end if
      if (parts%message /= "" .or. (is_alone .and. (parts%of_stretch /= "" .or. parts%of_rate /= ""))) then
         parts%of_stretch = ""
         parts%of_rate = ""
         call whole_force(model, draft, expression, parts%of_time, parts%message)
      end if
      if (parts%message /= "") then
         call leave_out(model, statement, parts%message//": "//expression)
         return
      end if
      if (is_alone) then
         call put_alone(model, draft, statement, marker, turns, parts%of_time//"*"//unit)
         return
      end if
      actuator = negative(parts%of_time, unit)
      law = negative(parts%of_stretch, unit)
      damping = ""
      if (parts%of_rate /= "" .and. turns) damping = "{-"//parts%of_rate//"*"//real_text(model%units%force*model%units%length* &
                                                                                         model%units%time, 15)//"N.m.s/rad}"
      if (parts%of_rate /= "" .and. .not. turns) damping = "{-"//parts%of_rate//"*"// &
            real_text(model%units%force*model%units%time/ &
                                                                                               model%units%length, 15)//"N.s/m}"
      if (turns) then
         call put_turning(model, draft, statement, marker, "", damping, cell(free - start), "", actuator, law)
      else
         call put_spring(model, draft, statement, marker, "", damping, cell(free*model%units%length), "", actuator, law)
      end if
   end subroutine add_single

   !> Where a law stores minimum, so that what it stores is counted from there: searched from the start on, as far as a length
   !> goes to
   !> zero and to three times itself, and an angle half a turn.
   function rest_of(functions, law, start, unit, turns) result(rest)
      type(symbols_t), intent(in) :: functions  !! that it may call
      character(*), intent(in) :: law      !! tension over the length or angle x, a plain number, in braces
      real(wp), intent(in) :: start        !! length or angle at the start, units of the dataset [any]
      real(wp), intent(in) :: unit         !! of the dataset, SI [any]
      logical, intent(in) :: turns         !! whether it is an angle
      real(wp) :: rest                     !! the length or angle, units of the dataset [any]

      integer, parameter :: n = 2000       ! places looked at, and halvings of the last one
      type(expression_t) :: compiled
      type(fault_t), allocatable :: fault
      real(wp) :: force, high, minimum, low, previous, step, stored, x
      integer :: k, side

      rest = start
      call compile_expression(law(2:len(law) - 1), functions, .true., compiled, fault, "x", [merge(dim_angle, dim_length, turns)])
      if (allocated(fault)) return
      minimum = 0.0_wp
      do side = -1, 1, 2
         step = pi/real(n, wp)
         if (.not. turns) step = start*merge(1.0_wp, 2.0_wp, side < 0)/real(n, wp)
         stored = 0.0_wp
         previous = force_at(start)
         do k = 1, n
            x = start + side*step*real(k, wp)
            force = force_at(x)
            stored = stored + 0.5_wp*side*step*(previous + force)
            previous = force
            if (.not. stored < minimum - 1.0e-12_wp*abs(minimum)) cycle
            minimum = stored
            rest = merge(x, max(x, 0.0_wp), turns)
         end do
      end do
      if (abs(rest - start) <= 0.0_wp) return
      low = rest - step
      high = rest + step
      if (.not. force_at(low)*force_at(high) < 0.0_wp) return
      do k = 1, 60
         rest = 0.5_wp*(low + high)
         if (force_at(rest)*force_at(low) > 0.0_wp) then
            low = rest
         else
            high = rest
         end if
      end do
      rest = anint(rest*1.0e12_wp)*1.0e-12_wp

   contains

      !> The law.
      real(wp) function force_at(at) result(value)
         real(wp), intent(in) :: at   !! length or angle, units of the dataset [any]

         real(wp) :: d1, d2

         call evaluate_safely(compiled, at*unit, value, d1, d2)
         if (.not. ieee_is_finite(value)) value = 0.0_wp
      end function force_at

   end function rest_of

   !> A term with the other sign and its unit, as a cell.
   pure function negative(term, unit) result(words)
      character(*), intent(in) :: term           !! a plain number; blank: none
      character(*), intent(in) :: unit           !! a quantity
      character(:), allocatable :: words         !! in braces; blank: none

      words = ""
      if (term /= "") words = "{-"//term//"*"//unit//"}"
   end function negative

end module adams_forces
