!> An expression of a force: cut into terms of the time, of the stretch, and of its rate, or whole as a load that sees the motion.
!>
!> A sum, and a product with a constant of one, is cut further; what has a term of more than one of them, or of other motion, is
!> not cut. VARVAL is replaced by the expression of its VARIABLE.
module force_parts
   use adams_expression, only: depends_on, is_measure, node_add, node_call, node_divide, node_multiply, node_negate, &
      node_subtract, on_other, on_rate, on_stretch, on_time, parse_tree, tree_t
   use adams_measures, only: name_measures
   use adams_model, only: adams_model_t, find_statement
   use adams_numbers, only: id_of
   use adams_splines, only: name_splines
   use adams_translation, only: coefficient_text, deck_text, grouped, is_undamped, words_t
   use dataset, only: expression_of, statement_t, upper_case
   use deck_draft, only: deck_draft_t
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: cut_force, parts_t, whole_force

   !> The parts of a force, in the units of the dataset; blank: there is none.
   type :: parts_t
      character(:), allocatable :: of_time      !! terms of the time
      character(:), allocatable :: of_stretch   !! terms of the stretch
      character(:), allocatable :: of_rate      !! factor of the rate
      character(:), allocatable :: message      !! why it has no words in a deck; blank: it has
   end type parts_t

contains

   !> Cut a force into its parts.
   subroutine cut_force(model, draft, text, statement, turns, free, parts)
      type(adams_model_t), intent(inout) :: model      !! the dataset
      type(deck_draft_t), intent(inout) :: draft       !! the deck
      character(*), intent(in) :: text                 !! the expression
      type(statement_t), intent(in) :: statement       !! the force
      logical, intent(in) :: turns                     !! whether it is a torque
      real(wp), intent(in) :: free                     !! length or angle at which x is zero, units of the dataset [any]
      type(parts_t), intent(out) :: parts              !! its parts

      type(diagnostics_t) :: ignored
      type(tree_t) :: tree
      type(words_t) :: words
      integer :: own(2)

      parts = parts_t("", "", "", "")
      own = [id_of(statement, "I", ignored), id_of(statement, "J", ignored)]
      call parse_tree(with_variables(model, text), tree)
      parts%message = tree%message
      call name_splines(model, draft, tree, parts%message)
      if (parts%message /= "") return
      words%time = "(t/"//model%units%time_text()//")"
      words%stretch = "x/"//model%units%length_text()
      if (turns) words%stretch = "x/1rad"
      if (abs(free) > 0.0_wp) words%stretch = words%stretch//" + "//real_text(free, 17)
      words%stretch = "("//words%stretch//")"
      call add_terms(tree, tree%root, "", own, turns, words, parts)
   end subroutine cut_force

   !> A force as one expression in the time and the motion; requests that it needs go to the deck if it has words.
   subroutine whole_force(model, draft, expression, text, message)
      type(adams_model_t), intent(inout) :: model               !! the dataset
      type(deck_draft_t), intent(inout) :: draft                !! the deck
      character(*), intent(in) :: expression                    !! of the dataset
      character(:), allocatable, intent(out) :: text            !! a plain number, in the units of the dataset
      character(:), allocatable, intent(out) :: message         !! what has no words in a deck; blank: all has

      type(tree_t) :: tree
      type(words_t) :: words
      integer :: k

      call parse_tree(with_variables(model, expression), tree)
      message = tree%message
      call name_splines(model, draft, tree, message)
      if (message /= "") return
      words%time = "(t/"//model%units%time_text()//")"
      words%stretch = ""
      do k = 1, tree%n
         if (tree%nodes(k)%kind /= node_call) cycle
         if (is_measure(tree%nodes(k)%name)) tree%nodes(k)%words = "0"
      end do
      call deck_text(tree, tree%root, words, text, message)     ! whether all but the measures has words
      if (message == "") call name_measures(model, draft, tree, message)
      if (message == "") call deck_text(tree, tree%root, words, text, message)
      text = grouped(text)
   end subroutine whole_force

   !> An expression with the variables that it takes by VARVAL put in.
   recursive function with_variables(model, text, depth) result(whole)
      type(adams_model_t), intent(in) :: model      !! the dataset
      character(*), intent(in) :: text              !! the expression
      integer, intent(in), optional :: depth        !! variables within variables
      character(:), allocatable :: whole            !! without VARVAL, if all of them are expressions

      integer, parameter :: deepest = 8, longest = 20000
      character(:), allocatable :: digits, segment
      integer :: at, id, k, last, level, next

      level = 0
      if (present(depth)) level = depth
      whole = text
      at = index(upper_case(whole), "VARVAL(")
      do while (at > 0 .and. level < deepest .and. len(whole) < longest)
         last = index(whole(at:), ")") + at - 1
         if (last <= at + 7) return
         digits = trim(adjustl(whole(at + 7:last - 1)))
         if (verify(digits, "0123456789") > 0 .or. len(digits) > 9 .or. len(digits) == 0) return
         read (digits, *) id
         k = find_statement(model, "VARIABLE", id)
         if (k == 0) return
         associate (variable => model%statements(k))
            segment = expression_of(variable, "FUNCTION", 3)
         end associate
         if (segment == "") return
         segment = "("//with_variables(model, segment, level + 1)//")"
         whole = replaced(whole, at, last, segment)
         at = at + len(segment)      ! what one within it left is not looked at again
         next = index(upper_case(whole(at:)), "VARVAL(")
         at = merge(at - 1 + next, 0, next > 0)
      end do
   end function with_variables

   !> A text with a piece of it replaced.
   pure function replaced(text, first, last, segment) result(whole)
      character(*), intent(in) :: text        !! the text
      integer, intent(in) :: first            !! where the piece starts
      integer, intent(in) :: last             !! where it ends
      character(*), intent(in) :: segment       !! what takes its place
      character(:), allocatable :: whole      !! the new text

      whole = text(:first - 1)//segment//text(last + 1:)
   end function replaced

   !> Add the terms of a sum to the parts of a force.
   !> Length: sums, products with a constant, and what is a term are reported apart in one place.
   recursive subroutine add_terms(tree, node, factor, own, turns, words, parts)
      type(tree_t), intent(in) :: tree                 !! the expression
      integer, intent(in) :: node                      !! number of the node
      character(*), intent(in) :: factor               !! of the node, with the sign that follows it
      integer, intent(in) :: own(2)                    !! (2) markers I and J of the force
      logical, intent(in) :: turns                     !! whether it is a torque
      type(words_t), intent(in) :: words               !! how variables are written
      type(parts_t), intent(inout) :: parts            !! of the force

      character(:), allocatable :: text
      integer :: bits, k, other
      logical :: is_linear

      if (parts%message /= "") return
      bits = depends_on(tree, node, own, turns)
      associate (it => tree%nodes(node))
         if (bits /= 0 .and. bits /= on_time .and. bits /= on_stretch) then
            select case (it%kind)
            case (node_add, node_subtract, node_negate)
               if (it%kind == node_negate) then
                  call add_terms(tree, it%arguments(1), factor//"(-1)*", own, turns, words, parts)
               else
                  call add_terms(tree, it%arguments(1), factor, own, turns, words, parts)
                  call add_terms(tree, it%arguments(2), trim(merge(factor//"     ", factor//"(-1)*", it%kind == node_add)), own, &
                        turns, &
                                 words, parts)
               end if
               return
            case (node_multiply, node_divide)
               k = 1
               if (depends_on(tree, it%arguments(1), own, turns) == 0) k = 2
               other = it%arguments(3 - k)
               if (depends_on(tree, other, own, turns) == 0 .and. bits /= on_rate .and. .not. (k == 2 .and. &
                                                                                                it%kind == node_divide)) then
                  call deck_text(tree, other, words, text, parts%message)
                  text = "("//text//")"
                  if (it%kind == node_divide) text = "(1/"//text//")"
                  call add_terms(tree, it%arguments(k), factor//text//"*", own, turns, words, parts)
                  return
               end if
            end select
         end if
         if (it%kind == node_call .and. iand(bits, on_rate) /= 0 .and. (it%name == "IMPACT" .or. it%name == "BISTOP")) then
            if (is_undamped(tree, node)) then
               call deck_text(tree, node, words, text, parts%message)   ! of the stretch alone
            else
               parts%message = it%name//" with damping"
            end if
            if (parts%message == "") parts%of_stretch = sum_of(parts%of_stretch, factor//text)
            return
         end if
      end associate
      select case (bits)
      case (0, on_time)
         call deck_text(tree, node, words, text, parts%message)
         parts%of_time = sum_of(parts%of_time, factor//text)
      case (on_stretch)
         call deck_text(tree, node, words, text, parts%message)
         parts%of_stretch = sum_of(parts%of_stretch, factor//text)
      case (on_rate)
         call coefficient_text(tree, node, own, turns, on_rate, .true., words, text, is_linear)
         if (.not. is_linear) parts%message = "its damping is not linear in the rate"
         parts%of_rate = sum_of(parts%of_rate, factor//text)
      case default
         parts%message = "a term that combines elongation, its rate or time"
         if (iand(bits, on_other) /= 0) parts%message = "it depends on motion other than the relative motion of its markers "// &
            "along their line"
         if (iand(bits, on_other) /= 0 .and. turns) parts%message = "it depends on motion other than AZ and WZ of its own markers"
      end select
   end subroutine add_terms

   !> A sum with one more term.
   pure function sum_of(sum, term) result(whole)
      character(*), intent(in) :: sum        !! so far, in parentheses; blank: nothing
      character(*), intent(in) :: term       !! one more
      character(:), allocatable :: whole     !! in parentheses

      whole = "("//term//")"
      if (sum /= "") whole = "("//sum(2:len(sum) - 1)//" + "//term//")"
   end function sum_of

end module force_parts
