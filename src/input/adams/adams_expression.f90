!> Function expressions of Adams as trees, and what they depend on. The grammar is that of expression_parser, with `**` for a power
!> and colons between the arguments of a function.
!>
!> A number with a D is an angle in degrees, one with a D before digits has an exponent: 30D+5 is a sum. Case does not matter.
!> Limits: `most_nodes` numbers and operations; which functions there are is for `adams_translation` to say.
module adams_expression
   use dataset, only: upper_case
   use expression_dimension, only: term_t
   use expression_parser, only: close_parenthesis, parse_sum, parse_whole
   use expression_reader, only: advance, descend, fail, name_length, peek, reader_t
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

   !> An expression, and its reader. The `start` of a term is the number of its node.
   type, extends(reader_t) :: tree_t
      type(node_t), allocatable :: nodes(:)     !! (at least n)
      integer :: n = 0                          !! nodes in use
      integer :: root = 0                       !! the whole
      character(:), allocatable :: message      !! what is wrong; blank: nothing
   contains
      procedure :: combine
      procedure :: read_number => read_digits
      procedure :: read_word
   end type tree_t

contains

   !> Read an expression.
   subroutine parse_tree(text, tree)
      character(*), intent(in) :: text      !! as in the dataset
      type(tree_t), intent(out) :: tree     !! the tree; `message` says what is wrong

      type(term_t) :: whole

      tree%source = text
      tree%has_double_star = .true.
      tree%message = ""
      allocate (tree%nodes(64))
      call parse_whole(tree, whole)
      tree%root = whole%start
      if (.not. allocated(tree%fault)) return
      tree%message = tree%fault%message
      if (tree%fault%first > 1) tree%message = tree%message//" at '"//text(tree%fault%first:)//"'"
   end subroutine parse_tree

   !> Put a node into the tree.
   subroutine add_node(tree, kind, arguments, number)
      class(tree_t), intent(inout) :: tree    !! the tree
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
         call fail(tree, 1, 1, "it has more than "//to_text(most_nodes)//" numbers and operations")
      else
         tree%n = tree%n + 1
      end if
      number = tree%n
      tree%nodes(number)%kind = kind
      tree%nodes(number)%arguments = arguments
      tree%nodes(number)%name = ""
      tree%nodes(number)%digits = ""
   end subroutine add_node

   !> The node of a sign.
   subroutine combine(self, sign, left, right)
      class(tree_t), intent(inout) :: self     !! the reader
      character, intent(in) :: sign            !! one of `+ - * / ^ ~`
      type(term_t), intent(inout) :: left      !! first operand; the result on return
      type(term_t), intent(in) :: right        !! second operand

      integer, parameter :: operations(6) = [node_add, node_subtract, node_multiply, node_divide, node_power, node_negate]
      integer :: operands(2)

      operands = [left%start, right%start]
      call add_node(self, operations(index("+-*/^~", sign)), pack(operands, operands > 0), left%start)
   end subroutine combine

   !> A number, perhaps of degrees.
   recursive subroutine read_digits(self, term)
      class(tree_t), intent(inout) :: self     !! the reader, at the number
      type(term_t), intent(inout) :: term      !! what was read

      character(:), allocatable :: number
      integer :: length, letter
      logical :: is_finite

      call add_node(self, node_number, [integer ::], term%start)
      number = upper_case(self%source(self%at:))
      length = number_length(number)
      letter = max(index(number(:length), "D+"), index(number(:length), "D-"))
      if (letter > 0) length = letter - 1
      associate (node => self%nodes(term%start))
         node%digits = number(:length)
         call read_number(node%digits, 0, node%value, is_finite)
         if (.not. is_finite) call fail(self, self%at, self%at, "'"//node%digits//"' is not a number")
         if (number(length + 1:min(length + 1, len(number))) == "D") then
            node%kind = node_degrees
            length = length + 1
         end if
      end associate
      call advance(self, length)
   end subroutine read_digits

   !> A name, or a function with its arguments.
   recursive subroutine read_word(self, term)
      class(tree_t), intent(inout) :: self     !! the reader, at the name
      type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read

      type(term_t) :: argument
      integer, allocatable :: arguments(:)
      integer :: length, node

      length = name_length(self%source(self%at:))
      call add_node(self, node_name, [integer ::], node)
      term%start = node
      self%nodes(node)%name = upper_case(self%source(self%at:self%at + length - 1))
      call advance(self, length)
      if (peek(self) /= "(") return
      call descend(self)
      self%nodes(node)%kind = node_call
      arguments = [integer ::]
      do while (.not. allocated(self%fault))
         call advance(self, 1)
         call parse_sum(self, argument)
         arguments = [arguments, argument%start]
         if (scan(peek(self), ",:") == 0) exit
      end do
      call close_parenthesis(self, term%first)
      self%nodes(node)%arguments = arguments
   end subroutine read_word

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
