!> General constraints (GCON) of an Adams dataset as rows of a deck, where a deck has them: a distance of two markers.
!>
!> FUNCTION = a DM(I, J) + b, and a sum, difference, product or quotient of numbers that comes to that:
!> `joint.distance` of length -b/a, i the marker J, j the marker I.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: any other function is omitted.
module adams_constraints
   use adams_expression, only: node_add, node_call, node_divide, node_multiply, node_negate, node_number, node_subtract, &
      parse_tree, tree_t
   use adams_joints, only: named
   use adams_measures, only: markers_of
   use adams_model, only: adams_model_t, leave_out
   use adams_names, only: reason_against
   use dataset, only: find_argument
   use deck_draft, only: deck_draft_t, tab
   use kinds, only: not_a_number, wp
   use text, only: exact_text
   implicit none (type, external)
   private
   public :: add_constraints

   real(wp), parameter :: same = 1.0e-9_wp   !! parts of a length that are none [1]

contains

   !> All GCON statements.
   subroutine add_constraints(model, draft)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck

      type(tree_t) :: tree
      character(:), allocatable :: message, name, point_i, point_j
      real(wp) :: length
      integer :: k, m, marker(4), measure

      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (it%keyword /= "GCON") cycle
            m = find_argument(it, "FUNCTION", 3)
            length = not_a_number()
            if (m > 0) then
               call parse_tree(it%arguments(m)%values(1)%s, tree)
               if (tree%message == "") call find_distance(tree, measure, length)
            end if
            message = reason_against(it%keyword)
            marker = 0
            if (length > 0.0_wp) call markers_of(model, tree, measure, marker, message)
            if (message /= "" .or. any(marker(1:2) == 0)) then
               call leave_out(model, it, message)
               cycle
            end if
            call draft%new_name(named(it), it%id, name)
            call draft%point(model, marker(2), point_i)
            call draft%point(model, marker(1), point_j)
            call draft%put("joint.distance", "name i j length", name//tab//point_i//tab//point_j//tab// &
                           exact_text(length*model%units%length)//"m")
         end associate
      end do
   end subroutine add_constraints

   !> The one distance in a function that is linear in it, and its value where the function is zero; NaN: there is none.
   subroutine find_distance(tree, measure, length)
      type(tree_t), intent(in) :: tree        !! the function
      integer, intent(out) :: measure         !! node of the distance
      real(wp), intent(out) :: length         !! the value [units of the dataset]

      real(wp) :: f(3)
      integer :: k, n

      length = not_a_number()
      measure = 0
      n = 0
      do k = 1, tree%n
         if (tree%nodes(k)%kind /= node_call) cycle
         n = n + 1
         if (tree%nodes(k)%name == "DM") measure = k
      end do
      if (n /= 1 .or. measure == 0) return
      f = [(value_of(tree, tree%root, real(k, wp)), k=0, 2)]
      if (.not. abs(f(3) - 2.0_wp*f(2) + f(1)) <= same*maxval(abs(f)) .or. .not. abs(f(2) - f(1)) > 0.0_wp) return
      length = -f(1)/(f(2) - f(1))
   end subroutine find_distance

   !> Value of a function of a distance; NaN: it has more in it than numbers.
   recursive real(wp) function value_of(tree, node, distance) result(value)
      type(tree_t), intent(in) :: tree       !! the function
      integer, intent(in) :: node            !! the node
      real(wp), intent(in) :: distance       !! the distance [units of the dataset]

      associate (it => tree%nodes(node))
         select case (it%kind)
         case (node_number); value = it%value
         case (node_call); value = distance
         case (node_negate); value = -part(1)
         case (node_add); value = part(1) + part(2)
         case (node_subtract); value = part(1) - part(2)
         case (node_multiply); value = part(1)*part(2)
         case (node_divide)
            value = not_a_number()
            if (abs(part(2)) > 0.0_wp) value = part(1)/part(2)
         case default; value = not_a_number()
         end select
      end associate

   contains

      !> Value of an argument.
      recursive real(wp) function part(k)
         integer, intent(in) :: k   !! its number

         part = value_of(tree, tree%nodes(node)%arguments(k), distance)
      end function part

   end function value_of

end module adams_constraints
