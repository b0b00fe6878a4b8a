!> Expressions of Adams in the words of a deck. Which functions there are stands here and nowhere else.
!>
!> | Adams | deck |
!> |---|---|
!> | `SIN COS TAN ASIN ACOS ATAN ATAN2 SINH COSH TANH EXP LOG LOG10 SQRT ABS MIN MAX` | the same |
!> | `STEP(x, x0, h0, x1, h1)` | h0 + (h1 - h0) u^2 (3 - 2 u), u = (x - x0)/(x1 - x0) within 0 and 1 |
!> | `STEP5` | the same with u^3 (10 - 15 u + 6 u^2) |
!> | `HAVSIN` | the same with (1 - cos(pi u))/2 |
!> | `IF(a: b, c, d)` | b for a < 0, c for a = 0, d for a > 0 |
!> | `SIGN(a, b)`, `DIM(a, b)` | abs(a) with the sign of b; max(a - b, 0) |
!> | `POLY(x, x0, a0, ...)` | a0 + a1 (x - x0) + ... |
!> | `SHF(x, x0, a, w, phi, b)` | a sin(w (x - x0) - phi) + b |
!> | `FORCOS`, `FORSIN` `(x, x0, w, a0, a1, ...)` | a0 + a1 cos(w (x - x0)) + ..., with sines |
!> | `IMPACT(x, v, x1, k, e, c, d)` | max(k p^e - c STEP(p, 0, 0, d, 1) v, 0), p = max(x1 - x, 0) |
!> | `BISTOP(x, v, x1, x2, k, e, c, d)` | the same at x1, less that at x2 with p = max(x - x2, 0) and -v |
!> | `CUBSPL`, `AKISPL` `(x, 0, id)` | see `adams_splines` |
!> | `DM VR DX DY DZ VX VY VZ WX WY WZ` | see `adams_measures` |
!>
!> Limits: whatever else there is has no words here, and the message says its name.
module adams_translation
   use adams_expression, only: depends_on, node_add, node_call, node_curve, node_degrees, node_divide, node_multiply, node_name, &
      node_negate, node_number, node_power, node_subtract, on_time, tree_t
   use kinds, only: wp
   use text, only: lower, text_t, to_text
   implicit none (type, external)
   private
   public :: coefficient_text, deck_text, grouped, is_undamped, words_t

   character(*), parameter :: same = " SIN COS TAN ASIN ACOS ATAN SINH COSH TANH EXP LOG LOG10 SQRT ABS "  !! of one argument
   character(*), parameter :: same_of_two = " ATAN2 MIN MAX "

   !> How what is not a number is written.
   type :: words_t
      character(:), allocatable :: time      !! the time, a plain number, as `(t/1s)`
      character(:), allocatable :: stretch   !! the distance or angle of a force, a plain number, as `(x/1mm)`; blank: none
   end type words_t

contains

   !> A node in the words of a deck.
   recursive subroutine deck_text(tree, node, words, text, message)
      type(tree_t), intent(in) :: tree                          !! the expression
      integer, intent(in) :: node                               !! number of the node
      type(words_t), intent(in) :: words                        !! how variables are written
      character(:), allocatable, intent(out) :: text            !! an expression of a deck
      character(:), allocatable, intent(inout) :: message       !! set: what there are no words for

      character(:), allocatable :: a, b

      text = ""
      if (message /= "") return
      associate (it => tree%nodes(node))
         select case (it%kind)
         case (node_number); text = plain_digits(it%digits)
         case (node_degrees); text = "("//plain_digits(it%digits)//"*pi/180)"
         case (node_name)
            select case (it%name)
            case ("TIME"); text = words%time
            case ("PI"); text = "pi"
            case ("DTOR"); text = "(pi/180)"
            case ("RTOD"); text = "(180/pi)"
            case default; message = it%name//" is not supported"
            end select
         case (node_negate)
            call deck_text(tree, it%arguments(1), words, a, message)
            text = "(-"//a//")"
         case (node_curve)
            call deck_text(tree, it%arguments(1), words, a, message)
            text = it%name//"("//a//")"
         case (node_call)
            if (allocated(it%words)) then
               text = it%words
            else
               call call_text(tree, node, words, text, message)
            end if
         case default
            call deck_text(tree, it%arguments(1), words, a, message)
            call deck_text(tree, it%arguments(2), words, b, message)
            select case (it%kind)
            case (node_add); text = "("//a//" + "//b//")"
            case (node_subtract); text = "("//a//" - "//b//")"
            case (node_multiply); text = a//"*"//b
            case (node_divide); text = a//"/"//grouped(b)
            case (node_power)
               text = grouped(a)//"^"//grouped(b)
            end select
         end select
      end associate
   end subroutine deck_text

   !> A factor: in parentheses, unless it is a number or a name, or stands in some.
   pure function grouped(text) result(factor)
      character(*), intent(in) :: text          !! an expression of a deck
      character(:), allocatable :: factor       !! the same

      integer :: depth, i

      factor = text
      if (verify(text, "abcdefghijklmnopqrstuvwxyz0123456789.") == 0) return
      factor = "("//text//")"
      if (text(1:1) /= "(") return
      depth = 0
      do i = 1, len(text)
         if (text(i:i) == "(") depth = depth + 1
         if (text(i:i) == ")") depth = depth - 1
         if (depth == 0 .and. i < len(text)) return
      end do
      factor = text
   end function grouped

   !> Digits with an E for a D.
   pure function plain_digits(digits) result(text)
      character(*), intent(in) :: digits     !! of a number
      character(len(digits)) :: text         !! the same for a deck

      integer :: at

      text = digits
      at = scan(digits, "dDE")
      if (at > 0) text(at:at) = "e"
   end function plain_digits

   !> A function in the words of a deck.
   !> Length: a case for each function.
   recursive subroutine call_text(tree, node, words, text, message)
      type(tree_t), intent(in) :: tree                          !! the expression
      integer, intent(in) :: node                               !! number of the node
      type(words_t), intent(in) :: words                        !! how variables are written
      character(:), allocatable, intent(out) :: text            !! an expression of a deck
      character(:), allocatable, intent(inout) :: message       !! set: what there are no words for

      type(text_t), allocatable :: a(:)
      character(:), allocatable :: u
      integer :: k, n

      text = ""
      associate (it => tree%nodes(node))
         n = size(it%arguments)
         if ((it%name == "DM" .or. it%name == "AZ") .and. words%stretch /= "") then
            text = words%stretch
            return
         end if
         allocate (a(max(n, 9)))
         do k = 1, n
            a(k)%s = ""
            if (k == 2 .and. is_undamped(tree, node)) cycle   ! the rate
            call deck_text(tree, it%arguments(k), words, a(k)%s, message)
         end do
         if (message /= "") return
         if (n < min_arguments(it%name)) then
            message = it%name//" has too few arguments"
            return
         end if
         select case (it%name)
         case ("STEP", "STEP5", "HAVSIN")
            u = "min(max(("//a(1)%s//" - "//grouped(a(2)%s)//")/("//a(4)%s//" - "//grouped(a(2)%s)//"), 0), 1)"
            if (it%name == "STEP") u = u//"^2*(3 - 2*"//u//")"
            if (it%name == "STEP5") u = u//"^3*(10 - 15*"//u//" + 6*"//u//"^2)"
            if (it%name == "HAVSIN") u = "(1 - cos(pi*"//u//"))/2"
            text = "("//a(3)%s//" + ("//a(5)%s//" - "//grouped(a(3)%s)//")*"//u//")"
            if (a(3)%s == "0") text = grouped(a(5)%s)//"*"//u
         case ("IF")
            text = "(("//a(2)%s//")*(1 - step("//a(1)%s//")) + ("//a(4)%s//")*(1 - step(-("//a(1)%s//"))))"
            if (a(3)%s == a(4)%s) then
               text = "(("//a(2)%s//")*(1 - step("//a(1)%s//")) + ("//a(4)%s//")*step("//a(1)%s//"))"
            else if (a(2)%s == a(3)%s) then
               text = "(("//a(2)%s//")*step(-("//a(1)%s//")) + ("//a(4)%s//")*(1 - step(-("//a(1)%s//"))))"
            else
               text = "("//text//" + ("//a(3)%s//")*(step("//a(1)%s//") + step(-("//a(1)%s//")) - 1))"
            end if
         case ("SIGN"); text = "abs("//a(1)%s//")*(2*step("//a(2)%s//") - 1)"
         case ("DIM"); text = "max("//a(1)%s//" - ("//a(2)%s//"), 0)"
         case ("POLY")
            text = "("//a(3)%s
            do k = 4, n
               text = text//" + ("//a(k)%s//")*("//a(1)%s//" - ("//a(2)%s//"))^"//to_text(k - 3)
            end do
            text = text//")"
         case ("SHF")
            u = "0"
            if (n > 5) u = a(6)%s
            text = "(("//a(3)%s//")*sin(("//a(4)%s//")*("//a(1)%s//" - ("//a(2)%s//")) - ("//a(5)%s//")) + ("//u//"))"
         case ("FORCOS", "FORSIN")
            text = "("//a(4)%s
            do k = 5, n
               text = text//" + ("//a(k)%s//")*"//lower(it%name(4:6))//"("//to_text(k - 4)//"*("//a(3)%s//")*("//a(1)%s//" - ("// &
                      a(2)%s//")))"
            end do
            text = text//")"
         case ("IMPACT", "BISTOP")
            if (.not. is_undamped(tree, node) .and. is_zero(tree, it%arguments(min_arguments(it%name)))) then
               message = it%name//" with a damping that starts abruptly"
               return
            end if
            k = merge(1, 0, it%name == "BISTOP")
            text = stop_text(a(3)%s//" - "//grouped(a(1)%s), "-"//grouped(a(2)%s), a(4 + k:7 + k), is_undamped(tree, node))
            if (k == 1) text = "("//text//" - "//stop_text(a(1)%s//" - "//grouped(a(4)%s), grouped(a(2)%s), a(5:8), &
                                                           is_undamped(tree, node))//")"
         case default
            if (index(same, " "//it%name//" ") > 0) then
               text = lower(it%name)//"("//a(1)%s//")"
            else if (index(same_of_two, " "//it%name//" ") > 0) then
               text = lower(it%name)//"("//a(1)%s//", "//a(2)%s//")"
            else
               message = it%name//" is not supported"
            end if
         end select
      end associate
   end subroutine call_text

   !> One side of a stop: max(k p^e + c s v, 0) for p > 0, s from 0 to 1 as p goes from 0 to d, v the rate of p.
   pure function stop_text(depth, rate, law, is_undamped) result(text)
      character(*), intent(in) :: depth         !! p
      character(*), intent(in) :: rate          !! v
      type(text_t), intent(in) :: law(4)        !! (4) k, e, c, d
      logical, intent(in) :: is_undamped        !! c is zero
      character(:), allocatable :: text         !! an expression of a deck

      character(:), allocatable :: share

      text = grouped(law(1)%s)//"*max("//depth//", 0)^"//grouped(law(2)%s)
      if (is_undamped) return
      share = "min(max(("//depth//")/"//grouped(law(4)%s)//", 0), 1)"
      text = "max("//text//" + "//grouped(law(3)%s)//"*"//share//"^2*(3 - 2*"//share//")*("//rate//"), 0)"
   end function stop_text

   !> Whether a node is a stop without damping.
   pure logical function is_undamped(tree, node)
      type(tree_t), intent(in) :: tree   !! the expression
      integer, intent(in) :: node        !! number of the node

      is_undamped = .false.
      associate (it => tree%nodes(node))
         if (it%name /= "IMPACT" .and. it%name /= "BISTOP") return
         if (size(it%arguments) < min_arguments(it%name)) return
         is_undamped = is_zero(tree, it%arguments(min_arguments(it%name) - 1))
      end associate
   end function is_undamped

   !> Arguments that a function has at least.
   pure integer function min_arguments(name) result(n)
      character(*), intent(in) :: name  !! of the function

      select case (name)
      case ("STEP", "STEP5", "HAVSIN", "SHF"); n = 5
      case ("IF", "FORCOS", "FORSIN"); n = 4
      case ("POLY"); n = 3
      case ("IMPACT"); n = 7
      case ("BISTOP"); n = 8
      case ("SIGN", "DIM", "ATAN2", "MIN", "MAX"); n = 2
      case default; n = 1
      end select
   end function min_arguments

   !> Whether a node is the number zero.
   pure logical function is_zero(tree, node)
      type(tree_t), intent(in) :: tree   !! the expression
      integer, intent(in) :: node        !! number of the node

      is_zero = tree%nodes(node)%kind == node_number .and. .not. abs(tree%nodes(node)%value) > 0.0_wp
   end function is_zero

   !> The factor of what has some bit, in an expression that is linear in it. With `is_pure` nothing but the product may stand
   !> there.
   recursive subroutine coefficient_text(tree, node, markers, turns, bit, is_pure, words, text, is_linear)
      type(tree_t), intent(in) :: tree                   !! the expression
      integer, intent(in) :: node                        !! number of the node
      integer, intent(in) :: markers(2)                  !! (2) markers of the force; 0: none
      logical, intent(in) :: turns                       !! whether it is a torque
      integer, intent(in) :: bit                         !! of what it is linear in
      logical, intent(in) :: is_pure                     !! whether nothing may be added
      type(words_t), intent(in) :: words                 !! how variables are written
      character(:), allocatable, intent(out) :: text     !! the factor
      logical, intent(out) :: is_linear                  !! .false.: it is not linear, or of something else too

      character(:), allocatable :: a, b, message
      integer :: bits(2), k
      logical :: both(2)

      text = "0"
      message = ""
      is_linear = .false.
      associate (it => tree%nodes(node))
         bits = 0
         do k = 1, min(2, size(it%arguments))
            bits(k) = depends_on(tree, it%arguments(k), markers, turns)
         end do
         select case (it%kind)
         case (node_name, node_call)
            is_linear = depends_on(tree, node, markers, turns) == bit .and. (it%kind == node_name .or. bit /= on_time)
            if (is_linear) text = "1"
         case (node_negate)
            call coefficient_text(tree, it%arguments(1), markers, turns, bit, is_pure, words, a, is_linear)
            text = "(-"//a//")"
         case (node_multiply, node_divide)
            k = findloc(bits, bit, dim=1)
            if (k == 0 .or. any(bits(3 - max(k, 1):3 - max(k, 1)) /= 0) .or. (k == 2 .and. it%kind == node_divide)) return
            call coefficient_text(tree, it%arguments(k), markers, turns, bit, is_pure, words, a, is_linear)
            call deck_text(tree, it%arguments(3 - k), words, b, message)
            is_linear = is_linear .and. message == ""
            text = grouped(a)//merge("*", "/", it%kind == node_multiply)//grouped(b)
            if (a == "1" .and. it%kind == node_multiply) text = grouped(b)
         case (node_add, node_subtract)
            if (is_pure .and. .not. all(bits == bit)) return
            both = .true.
            a = "0"
            b = "0"
            if (bits(1) /= 0) call coefficient_text(tree, it%arguments(1), markers, turns, bit, is_pure, words, a, both(1))
            if (bits(2) /= 0) call coefficient_text(tree, it%arguments(2), markers, turns, bit, is_pure, words, b, both(2))
            is_linear = all(both)
            text = "("//a//merge(" + ", " - ", it%kind == node_add)//b//")"
         end select
      end associate
   end subroutine coefficient_text

end module adams_translation
