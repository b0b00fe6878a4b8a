!> Where an expression is not smooth: functions of its first variable, the time, that change sign, or touch zero, there.
!>
!> | operation | function | |
!> |---|---|---|
!> | step(u), abs(u) | u | changes sign |
!> | min(a, b), max(a, b) | a - b, with the sign for which below zero means b | changes sign |
!> | atan2(y, x) | y, where x is negative | changes sign |
!> | a curve that holds or continues straight | its argument less its first, its last place | changes sign |
!> | a law that rises | its argument less the places where its formula changes | changes sign |
!> | a curve of such laws | its argument less these; sin of it over the period if it repeats itself | changes sign |
!> | sqrt(u), u^p with p < 2 | u | touches zero |
!> | asin(u), acos(u) | 1 - u^2 | touches zero |
!>
!> The operations choose their branch by `function < 0`, and so does whoever searches the places, so that a place is between
!> two neighbouring numbers. Each function is itself an expression, the part of the program that makes the argument.
!> An expression may see a motion too: its parts that do not are functions of the time (`time_parts`), and only these have switches.
!> Limits: a cubic spline is twice continuously differentiable; its knots are no such places.
module expression_switches
   use curve, only: beyond_stabilisation, beyond_linear, beyond_periodic, curve_t
   use expression, only: expression_t, op_abs, op_acos, op_add, op_asin, op_atan2, op_curve, op_integer_power, op_max, op_min, &
      op_multiply, op_number, op_real_power, op_rise, op_sin, op_sqrt, op_step, op_subtract, op_time
   use kinds, only: pi, wp
   use rise_laws, only: breaks_of
   implicit none (type, external)
   private
   public :: find_switches, switch_t, time_parts

   !> A function whose sign, or zero, says where an expression is not smooth.
   type :: switch_t
      type(expression_t) :: g                 !! the function
      logical :: touches = .false.            !! it does not change its sign but touches zero
      type(expression_t), allocatable :: condition  !! it counts only where this is negative
   end type switch_t

contains

   !> All switches of an expression; none if it is smooth.
   subroutine find_switches(expression, switches)
      type(expression_t), intent(in) :: expression             !! the expression
      type(switch_t), allocatable, intent(out) :: switches(:)  !! (n) what to look at

      integer :: first, k, middle, n

      allocate (switches(0))
      if (expression%is_constant) return
      do k = 1, size(expression%code)
         select case (expression%code(k))
         case (op_step, op_abs)
            call add(part(expression, begin_of(expression, k - 1), k - 1), .false.)
         case (op_sqrt)
            call add(part(expression, begin_of(expression, k - 1), k - 1), .true.)
         case (op_real_power)
            if (expression%operand(k) < 2.0_wp .and. expression%operand(k) > 0.0_wp) then
               call add(part(expression, begin_of(expression, k - 1), k - 1), .true.)
            end if
         case (op_asin, op_acos)
            first = begin_of(expression, k - 1)
            call add(extended(extended(part(expression, first, k - 1), op_integer_power, 2.0_wp), op_subtract, 1.0_wp), .true.)
         case (op_min, op_max, op_atan2)
            middle = begin_of(expression, k - 1)
            first = begin_of(expression, middle - 1)
            if (expression%code(k) == op_max) then
               call add(part(expression, first, k - 1, op_subtract), .false.)
            else if (expression%code(k) == op_min) then
               call add(part(expression, middle, k - 1, op_subtract, first), .false.)
            else
               n = size(switches)
               call add(part(expression, first, middle - 1), .false.)
               if (size(switches) > n) call set_condition(switches(size(switches)), part(expression, middle, k - 1))
            end if
         case (op_curve)
            call add_curve(expression%curves(nint(expression%operand(k))), &
                           part(expression, begin_of(expression, k - 1), k - 1))
         case (op_rise)
            call add_places(breaks_of(nint(expression%operand(k))), part(expression, begin_of(expression, k - 1), k - 1))
         end select
      end do

   contains

      !> Append a switch whose function moves.
      subroutine add(g, touches)
         type(expression_t), intent(in) :: g   !! its function
         logical, intent(in) :: touches        !! whether it is one that touches zero

         type(switch_t), allocatable :: longer(:)
         integer :: m, n

         if (.not. is_of_time(g)) return
         n = size(switches)
         allocate (longer(n + 1))
         do m = 1, n
            longer(m) = switches(m)
         end do
         longer(n + 1)%g = g
         longer(n + 1)%touches = touches
         call move_alloc(longer, switches)
      end subroutine add

      !> Append switches at places of an argument.
      subroutine add_places(places, argument)
         real(wp), intent(in) :: places(:)            !! (any) the places [any]
         type(expression_t), intent(in) :: argument   !! what is there

         integer :: m

         do m = 1, size(places)
            call add(extended(argument, op_subtract, places(m)), .false.)
         end do
      end subroutine add_places

      !> Append the switches of a curve.
      subroutine add_curve(curve, argument)
         type(curve_t), intent(in) :: curve           !! the curve
         type(expression_t), intent(in) :: argument   !! where it is taken

         real(wp) :: period
         integer :: i, m

         associate (n => size(curve%x))
            period = curve%x(n) - curve%x(1)
            if (curve%bends .and. curve%beyond == beyond_periodic) then
               do i = 1, n - 1
                  call add(waving(argument, curve%x(i), period), .false.)
               end do
            else if (curve%bends) then
               call add_places(curve%x, argument)
            else if (curve%beyond == beyond_stabilisation .or. curve%beyond == beyond_linear) then
               call add_places(curve%x([1, n]), argument)
            end if
         end associate
         if (.not. allocated(curve%rises)) return
         do m = 1, size(curve%rises)
            associate (rise => curve%rises(m))
               associate (places => rise%begin + rise%length*breaks_of(rise%law))
                  do i = 1, size(places)
                     if (curve%beyond == beyond_periodic) then
                        call add(waving(argument, places(i), period), .false.)
                     else
                        call add_places(places(i:i), argument)
                     end if
                  end do
               end associate
            end associate
         end do
      end subroutine add_curve

   end subroutine find_switches

   !> Whether a program depends on the first variable alone.
   pure logical function is_of_time(g)
      type(expression_t), intent(in) :: g   !! the program

      ! a number of any size may stand where the code is another one: no conversion to integers
      is_of_time = any(g%code == op_time .and. abs(g%operand - 1.0_wp) < 0.5_wp) .and. &
                   .not. any(g%code == op_time .and. g%operand > 1.5_wp)
   end function is_of_time

   !> The maximum parts of an expression that are functions of the time alone; of one that sees no motion, itself.
   subroutine time_parts(expression, parts)
      type(expression_t), intent(in) :: expression             !! the expression
      type(expression_t), allocatable, intent(out) :: parts(:) !! (any) its parts

      type(expression_t) :: one
      integer :: first, k

      if (.not. allocated(expression%observables)) then
         parts = [expression]
         return
      end if
      allocate (parts(0))
      k = size(expression%code)
      do while (k > 0)  ! from the end: a part that is one takes all that it is made of with it
         first = begin_of(expression, k)
         if (first < k) then
            one = part(expression, first, k)
            if (is_of_time(one)) then
               parts = [parts, one]
               k = first
            end if
         end if
         k = k - 1
      end do
   end subroutine time_parts

   !> A switch counts only where a function is negative; one that sees a motion is not known, and the switch always counts.
   subroutine set_condition(switch, condition)
      type(switch_t), intent(inout) :: switch      !! the switch
      type(expression_t), intent(in) :: condition  !! the function

      if (any(condition%code == op_time .and. nint(condition%operand) > 1)) return
      switch%condition = condition
   end subroutine set_condition

   !> Where the operand starts that ends with an operation.
   pure integer function begin_of(expression, last) result(first)
      type(expression_t), intent(in) :: expression  !! the expression
      integer, intent(in) :: last                   !! number of the last operation

      integer :: wanted

      wanted = 1
      first = last + 1
      do while (wanted > 0)
         first = first - 1
         select case (expression%code(first))
         case (op_number, op_time)
            wanted = wanted - 1
         case (op_add:op_atan2)
            wanted = wanted + 1
         end select
      end do
   end function begin_of

   !> A part of a program, followed by that from `again` to before its first operation, and by an operation.
   pure function part(expression, first, last, op, again) result(g)
      type(expression_t), intent(in) :: expression  !! the expression
      integer, intent(in) :: first                  !! first operation
      integer, intent(in) :: last                   !! last operation
      integer, intent(in), optional :: op           !! operation to follow
      integer, intent(in), optional :: again        !! first operation of the other operand
      type(expression_t) :: g                       !! the part

      g%code = expression%code(first:last)
      g%operand = expression%operand(first:last)
      if (present(again)) then
         g%code = [g%code, expression%code(again:first - 1)]
         g%operand = [g%operand, expression%operand(again:first - 1)]
      end if
      if (present(op)) then
         g%code = [g%code, op]
         g%operand = [g%operand, 0.0_wp]
      end if
      if (allocated(expression%curves)) g%curves = expression%curves
      g%others = expression%others
      g%is_constant = .false.
   end function part

   !> A wave that is zero where the argument is at a place, or whole periods from it.
   pure function waving(argument, place, period) result(g)
      type(expression_t), intent(in) :: argument    !! the argument
      real(wp), intent(in) :: place                 !! the place [any]
      real(wp), intent(in) :: period                !! the period [any]
      type(expression_t) :: g                       !! the wave

      g = extended(extended(argument, op_subtract, place), op_multiply, pi/period)
      g%code = [g%code, op_sin]
      g%operand = [g%operand, 0.0_wp]
   end function waving

   !> A program with an operation more: a power, or one with a number as second operand.
   pure function extended(expression, op, number) result(g)
      type(expression_t), intent(in) :: expression  !! the program
      integer, intent(in) :: op                     !! the operation
      real(wp), intent(in) :: number                !! its number [any]
      type(expression_t) :: g                       !! the longer program

      g = expression
      if (op == op_integer_power) then
         g%code = [g%code, op]
         g%operand = [g%operand, number]
      else
         g%code = [g%code, op_number, op]
         g%operand = [g%operand, number, 0.0_wp]
      end if
   end function extended

end module expression_switches
