!> Integrals over the time of expressions of Adams, in the words of a deck.
!>
!> They are known of sums of constants, powers of TIME, SIN and COS of what is linear in TIME, and STEP of TIME.
!> Limits: others have no words.
module adams_integrals
   use adams_expression, only: depends_on, node_add, node_call, node_divide, node_multiply, node_name, node_negate, node_number, &
      node_power, node_subtract, on_time, tree_t
   use adams_translation, only: coefficient_text, deck_text, grouped, words_t
   implicit none (type, external)
   private
   public :: integral_text

contains

   !> The integral of a node over the time, up to a constant.
   recursive subroutine integral_text(tree, node, words, text, message)
      type(tree_t), intent(in) :: tree                          !! the expression
      integer, intent(in) :: node                               !! number of the node
      type(words_t), intent(in) :: words                        !! how variables are written
      character(:), allocatable, intent(out) :: text            !! an expression of a deck
      character(:), allocatable, intent(inout) :: message       !! set: what there are no words for

      character(:), allocatable :: a, b
      integer :: k

      text = ""
      if (message /= "") return
      associate (it => tree%nodes(node))
         if (depends_on(tree, node, [0, 0], .false.) == 0) then
            call deck_text(tree, node, words, a, message)
            text = grouped(a)//"*"//words%time
            return
         end if
         message = "its time integral is not supported"
         select case (it%kind)
         case (node_name)
            message = ""
            text = words%time//"^2/2"
         case (node_negate, node_add, node_subtract)
            message = ""
            call integral_text(tree, it%arguments(1), words, a, message)
            text = "(-("//a//"))"
            if (it%kind == node_negate) return
            call integral_text(tree, it%arguments(2), words, b, message)
            text = "("//a//merge(" + ", " - ", it%kind == node_add)//b//")"
         case (node_multiply, node_divide)
            k = 2
            if (depends_on(tree, it%arguments(2), [0, 0], .false.) /= 0) k = 1
            if (depends_on(tree, it%arguments(k), [0, 0], .false.) /= 0) return
            if (k == 1 .and. it%kind == node_divide) return
            message = ""
            call integral_text(tree, it%arguments(3 - k), words, a, message)
            call deck_text(tree, it%arguments(k), words, b, message)
            text = grouped(a)//merge("*", "/", it%kind == node_multiply)//grouped(b)
         case (node_power)
            if (tree%nodes(it%arguments(1))%kind /= node_name .or. tree%nodes(it%arguments(2))%kind /= node_number) return
            message = ""
            call deck_text(tree, it%arguments(2), words, b, message)
            text = words%time//"^("//b//" + 1)/("//b//" + 1)"
         case (node_call)
            call integral_of_call(tree, node, words, text, message)
         end select
      end associate
   end subroutine integral_text

   !> The integral of a function over the time.
   subroutine integral_of_call(tree, node, words, text, message)
      type(tree_t), intent(in) :: tree                          !! the expression
      integer, intent(in) :: node                               !! number of the node
      type(words_t), intent(in) :: words                        !! how variables are written
      character(:), allocatable, intent(out) :: text            !! an expression of a deck
      character(:), allocatable, intent(inout) :: message       !! kept, or blank where there are words

      type(words_t) :: none
      character(:), allocatable :: a, fault, h0, h1, rate, u, x0, x1
      logical :: is_linear

      text = ""
      fault = ""
      none = words
      associate (it => tree%nodes(node))
         select case (it%name)
         case ("SIN", "COS")
            call coefficient_text(tree, it%arguments(1), [0, 0], .false., on_time, .false., none, rate, is_linear)
            if (.not. is_linear) return
            call deck_text(tree, it%arguments(1), words, a, fault)
            text = "sin("//a//")/"//grouped(rate)
            if (it%name == "SIN") text = "(-cos("//a//")/"//grouped(rate)//")"
         case ("STEP")
            if (size(it%arguments) < 5) return
            if (tree%nodes(it%arguments(1))%kind /= node_name) return
            call deck_text(tree, it%arguments(2), words, x0, fault)
            call deck_text(tree, it%arguments(3), words, h0, fault)
            call deck_text(tree, it%arguments(4), words, x1, fault)
            call deck_text(tree, it%arguments(5), words, h1, fault)
            u = "min(max(("//words%time//" - "//grouped(x0)//")/("//x1//" - "//grouped(x0)//"), 0), 1)"
            text = "("//h0//"*"//words%time//" + ("//h1//" - ("//h0//"))*(("//x1//" - ("//x0//"))*("//u//"^3 - "//u// &
                  "^4/2) + max("// &
                   words%time//" - ("//x1//"), 0)))"
         case default
            return
         end select
      end associate
      message = fault
   end subroutine integral_of_call

end module adams_integrals
