!> Function expressions of Adams as trees: reading them, and what they depend on.
!>
!>     sum     = term { ("+" | "-") term }
!>     term    = signed { ("*" | "/") signed }
!>     signed  = { "+" | "-" } power
!>     power   = primary [ "**" signed ]
!>     primary = number ["D"] | TIME | PI | DTOR | RTOD | NAME "(" sum {("," | ":") sum} ")" | "(" sum ")"
!>
!> A number with a D is an angle in degrees, one with a D before digits has an exponent: 30D+5 is a sum. Case does not matter.
!> Limits: `most_nodes` numbers and operations; which functions there are is for `adams_translation` to say.
module adams_expression
   use dataset, only: upper_case
   use kinds, only: wp
   use numbers, only: number_length, read_number
   use text, only: to_text
   implicit none (type, external)
   private
   public :: depends_on, is_measure, node_t, on_other, on_rate, on_stretch, on_time, parse_tree, tree_t
   public :: node_add, node_call, node_curve, node_degrees, node_divide, node_multiply, node_name, node_negate, node_number, &
      node_power, node_subtract

   integer, parameter :: node_number = 1     !! a number
   integer, parameter :: node_degrees = 2    !! a number of degrees
   integer, parameter :: node_name = 3       !! TIME, PI, DTOR, RTOD
   integer, parameter :: node_call = 4       !! a function
   integer, parameter :: node_add = 5
   integer, parameter :: node_subtract = 6
   integer, parameter :: node_multiply = 7
   integer, parameter :: node_divide = 8
   integer, parameter :: node_power = 9
   integer, parameter :: node_negate = 10
   integer, parameter :: node_curve = 11     !! a curve of the deck, by its name, of one argument

   ! what an expression depends on, bits
   integer, parameter :: on_time = 1      !! the time
   integer, parameter :: on_stretch = 2   !! distance or angle of the two markers of a force
   integer, parameter :: on_rate = 4      !! rate of that
   integer, parameter :: on_other = 8     !! anything else that moves

   integer, parameter :: most_nodes = 2000  !! of a tree
   integer, parameter :: deepest = 60       !! of what is open at once

   !> A node of a tree.
   type :: node_t
      integer :: kind = node_number             !! one of the above
      real(wp) :: value = 0.0_wp                !! of a number [any]
      character(:), allocatable :: name         !! of a name or function, in capitals
      character(:), allocatable :: digits       !! of a number, as written
      integer, allocatable :: arguments(:)      !! (n) numbers of the nodes that it works on
      character(:), allocatable :: words        !! of a measure: how a deck calls it; unallocated: not yet known
   end type node_t

   !> An expression.
   type :: tree_t
      type(node_t), allocatable :: nodes(:)     !! (at least n)
      integer :: n = 0                          !! nodes in use
      integer :: root = 0                       !! the whole
      character(:), allocatable :: message      !! what is wrong; blank: nothing
      character(:), allocatable, private :: text   !! in capitals
      integer, private :: at = 1                !! next character
      integer, private :: depth = 0             !! what is open
   end type tree_t

contains

   !> Read an expression.
   subroutine parse_tree(text, tree)
      character(*), intent(in) :: text      !! as in the dataset
      type(tree_t), intent(out) :: tree     !! the tree; `message` says what is wrong

      integer :: i

      tree%message = ""
      tree%text = ""
      do i = 1, len(text)
         if (text(i:i) == "*" .and. len(tree%text) > 0) then      ! a power, with a blank within it
            if (tree%text(verify(tree%text, " ", back=.true.):) == "* ") tree%text = trim(tree%text)
         end if
         tree%text = tree%text//upper_case(text(i:i))
      end do
      tree%text = trim(tree%text)
      allocate (tree%nodes(64))
      if (len(tree%text) == 0) then
         tree%message = "the expression is empty"
         return
      end if
      call read_sum(tree, tree%root)
      if (tree%message == "" .and. next(tree) /= " ") tree%message = "'"//tree%text(tree%at:)//"' is not supported"
   end subroutine parse_tree

   !> The next character that is no blank; blank at the end.
   character function next(tree)
      type(tree_t), intent(inout) :: tree  !! the reader, moved there

      next = " "
      do while (tree%at <= len(tree%text))
         if (tree%text(tree%at:tree%at) /= " ") exit
         tree%at = tree%at + 1
      end do
      if (tree%at <= len(tree%text)) next = tree%text(tree%at:tree%at)
   end function next

   !> Put a node into the tree.
   subroutine add_node(tree, kind, arguments, number)
      type(tree_t), intent(inout) :: tree     !! the tree
      integer, intent(in) :: kind             !! of the node
      integer, intent(in) :: arguments(:)     !! (n) what it works on
      integer, intent(out) :: number          !! of the node

      type(node_t), allocatable :: more(:)

      if (tree%n == size(tree%nodes)) then
         allocate (more(2*tree%n))
         more(:tree%n) = tree%nodes
         call move_alloc(more, tree%nodes)
      end if
      if (tree%n >= most_nodes) then
         tree%message = "it has more than "//to_text(most_nodes)//" numbers and operations"
      else
         tree%n = tree%n + 1
      end if
      number = tree%n
      tree%nodes(number)%kind = kind
      tree%nodes(number)%arguments = arguments
      tree%nodes(number)%name = ""
      tree%nodes(number)%digits = ""
   end subroutine add_node

   !> Sums and differences.
   recursive subroutine read_sum(tree, node)
      type(tree_t), intent(inout) :: tree  !! the reader
      integer, intent(out) :: node         !! what was read

      character :: sign
      integer :: right

      node = 0
      tree%depth = tree%depth + 1
      if (tree%depth > deepest) tree%message = "it is nested too deeply"
      if (tree%message == "") call read_term(tree, node)
      do while (tree%message == "")
         sign = next(tree)
         if (sign /= "+" .and. sign /= "-") exit
         tree%at = tree%at + 1
         call read_term(tree, right)
         if (tree%message /= "") exit
         call add_node(tree, merge(node_add, node_subtract, sign == "+"), [node, right], node)
      end do
      tree%depth = tree%depth - 1
   end subroutine read_sum

   !> Products and quotients.
   recursive subroutine read_term(tree, node)
      type(tree_t), intent(inout) :: tree  !! the reader
      integer, intent(out) :: node         !! what was read

      character :: sign
      integer :: right

      call read_signed(tree, node)
      do while (tree%message == "")
         sign = next(tree)
         if (sign /= "*" .and. sign /= "/") exit
         tree%at = tree%at + 1
         call read_signed(tree, right)
         if (tree%message /= "") exit
         call add_node(tree, merge(node_multiply, node_divide, sign == "*"), [node, right], node)
      end do
   end subroutine read_term

   !> Signs.
   recursive subroutine read_signed(tree, node)
      type(tree_t), intent(inout) :: tree  !! the reader
      integer, intent(out) :: node         !! what was read

      character :: sign
      integer :: inner

      node = 0
      sign = next(tree)
      if (sign == "+" .or. sign == "-") then
         tree%at = tree%at + 1
         tree%depth = tree%depth + 1
         if (tree%depth > deepest) tree%message = "it is nested too deeply"
         if (tree%message == "") call read_signed(tree, inner)
         tree%depth = tree%depth - 1
         node = inner
         if (tree%message == "" .and. sign == "-") call add_node(tree, node_negate, [inner], node)
      else
         call read_power(tree, node)
      end if
   end subroutine read_signed

   !> Powers.
   recursive subroutine read_power(tree, node)
      type(tree_t), intent(inout) :: tree  !! the reader
      integer, intent(out) :: node         !! what was read

      integer :: exponent

      call read_primary(tree, node)
      if (tree%message /= "" .or. next(tree) == " " .or. tree%at + 1 > len(tree%text)) return
      if (tree%text(tree%at:tree%at + 1) == "**") then
         tree%at = tree%at + 2
      else if (next(tree) == "^") then
         tree%at = tree%at + 1
      else
         return
      end if
      call read_signed(tree, exponent)
      if (tree%message == "") call add_node(tree, node_power, [node, exponent], node)
   end subroutine read_power

   !> Numbers, names, functions, parentheses.
   recursive subroutine read_primary(tree, node)
      type(tree_t), intent(inout) :: tree  !! the reader
      integer, intent(out) :: node         !! what was read

      character(*), parameter :: letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_"
      integer :: length

      node = 0
      if (next(tree) == "(") then
         tree%at = tree%at + 1
         call read_sum(tree, node)
         if (tree%message == "" .and. next(tree) /= ")") tree%message = "missing closing parenthesis"
         tree%at = tree%at + 1
      else if (scan(next(tree), "0123456789.") > 0) then
         call read_digits(tree, node)
      else if (index(letters, next(tree)) > 0) then
         length = verify(tree%text(tree%at:)//" ", letters//"0123456789") - 1
         call add_node(tree, node_name, [integer ::], node)
         tree%nodes(node)%name = tree%text(tree%at:tree%at + length - 1)
         tree%at = tree%at + length
         if (next(tree) == "(") call read_arguments(tree, node)
      else if (next(tree) == " ") then
         tree%message = "it is incomplete"
      else
         tree%message = "'"//tree%text(tree%at:)//"' is not supported"
      end if
   end subroutine read_primary

   !> A number, perhaps of degrees.
   subroutine read_digits(tree, node)
      type(tree_t), intent(inout) :: tree  !! the reader
      integer, intent(out) :: node         !! what was read

      real(wp) :: x
      integer :: length, letter
      logical :: is_finite

      call add_node(tree, node_number, [integer ::], node)
      length = number_length(tree%text(tree%at:))
      letter = max(index(tree%text(tree%at:tree%at + length - 1), "D+"), index(tree%text(tree%at:tree%at + length - 1), "D-"))
      if (letter > 0) length = letter - 1
      is_finite = length > 0
      if (is_finite) call read_number(tree%text(tree%at:tree%at + length - 1), 0, x, is_finite)
      if (.not. is_finite) then
         tree%message = "'"//tree%text(tree%at:)//"' is not a number"
         return
      end if
      tree%nodes(node)%value = x
      tree%nodes(node)%digits = tree%text(tree%at:tree%at + length - 1)
      tree%at = tree%at + length
      if (tree%at > len(tree%text)) return
      if (tree%text(tree%at:tree%at) /= "D") return
      tree%nodes(node)%kind = node_degrees
      tree%at = tree%at + 1
   end subroutine read_digits

   !> Arguments of a function.
   recursive subroutine read_arguments(tree, node)
      type(tree_t), intent(inout) :: tree  !! the reader
      integer, intent(in) :: node          !! the function, arguments are added

      integer, allocatable :: arguments(:)
      integer :: one

      tree%nodes(node)%kind = node_call
      allocate (arguments(0))
      do
         tree%at = tree%at + 1
         call read_sum(tree, one)
         if (tree%message /= "") return
         arguments = [arguments, one]
         if (scan(next(tree), ",:") == 0) exit
      end do
      if (next(tree) /= ")") tree%message = "missing closing parenthesis of "//tree%nodes(node)%name//""
      tree%at = tree%at + 1
      tree%nodes(node)%arguments = arguments
   end subroutine read_arguments

   !> What a node depends on. The stretch of a force is a measure of its own two markers, in either order.
   recursive integer function depends_on(tree, node, markers, turns) result(bits)
      type(tree_t), intent(in) :: tree       !! the expression
      integer, intent(in) :: node            !! number of the node
      integer, intent(in) :: markers(2)      !! (2) markers of the force; 0: none
      logical, intent(in) :: turns           !! whether the force is a torque: AZ and WZ instead of DM and VR

      integer :: k

      bits = 0
      associate (it => tree%nodes(node))
         if (it%kind == node_name) then
            if (it%name == "TIME") bits = on_time
         else if (it%kind == node_call) then
            bits = measure_of(tree, node, markers, turns)
            if (bits > 0) return
         end if
         do k = 1, size(it%arguments)
            bits = ior(bits, depends_on(tree, it%arguments(k), markers, turns))
         end do
      end associate
   end function depends_on

   !> What a function measures; 0: it is a function of its arguments.
   integer function measure_of(tree, node, markers, turns) result(bits)
      type(tree_t), intent(in) :: tree       !! the expression
      integer, intent(in) :: node            !! number of the node
      integer, intent(in) :: markers(2)      !! (2) markers of the force; 0: none
      logical, intent(in) :: turns           !! whether the force is a torque

      integer :: k, m(2)
      logical :: is_own

      bits = 0
      associate (it => tree%nodes(node))
         if (.not. is_measure(it%name)) return
         bits = on_other
         m = 0
         do k = 1, min(2, size(it%arguments))
            if (tree%nodes(it%arguments(k))%kind == node_number) m(k) = nint(min(tree%nodes(it%arguments(k))%value, 1.0e9_wp))
         end do
         is_own = all(markers > 0) .and. (all(m == markers) .or. (all(m == markers(2:1:-1)) .and. .not. turns))
         if (.not. is_own) return
         if (it%name == merge("AZ", "DM", turns)) bits = on_stretch
         if (it%name == merge("WZ", "VR", turns)) bits = on_rate
      end associate
   end function measure_of

   !> Whether a function measures something of the model.
   pure logical function is_measure(name)
      character(*), intent(in) :: name   !! of the function, in capitals

      character(*), parameter :: measures = " DM DX DY DZ AX AY AZ PSI THETA PHI YAW PITCH ROLL VM VR VX VY VZ WM WX WY WZ ACCM " &
         //"ACCX ACCY ACCZ WDTM WDTX WDTY WDTZ FM FX FY FZ TM TX TY TZ AKISPL CUBSPL CURVE ARYVAL VARVAL DIF DIF1 PINVAL POUVAL " &
         //"SENVAL SFORCE GFORCE VFORCE VTORQUE NFORCE BEAM BUSH JOINT JPRIM MOTION FIELD SPDP PTCV CVCV UCON USER BSPLINE "

      is_measure = index(measures, " "//name//" ") > 0
   end function is_measure

end module adams_expression
