!> Rows of any kind, filled from what the kind says of its columns: a registered kind is tested without more.
module generic_item
   use expression, only: expression_t
   use expression_compile, only: compile_expression, fault_t, symbols_t
   use fixed_random, only: random_t
   use item, only: item_t, value_t
   use kind_info, only: cell_expression, cell_file, cell_flag, cell_list, cell_number, cell_reference, cell_vector, cell_word, &
      column_t, kind_info_t
   use kinds, only: wp
   use text, only: exact_text, split_blank, text_t
   implicit none (type, external)
   private
   public :: column_number, fill_item, make_expression, set_number

   integer, parameter :: n_sample = 7  !! numbers of a list
   character(*), parameter :: smooth = "(0.4 + 0.9*sin(1.7 rad/s*t) - 0.3*cos(2.9 rad/s*t))"
      !! a function of time with derivatives that are not zero

contains

   !> A row of a kind. References are all to item number `variant`; words go round with it.
   subroutine fill_item(info, variant, random, item, unit_of_length)
      type(kind_info_t), intent(in) :: info                !! the kind
      integer, intent(in) :: variant                       !! number of the row, from 1
      type(random_t), intent(inout) :: random              !! where numbers come from
      type(item_t), intent(out) :: item                    !! the row
      real(wp), intent(in), optional :: unit_of_length     !! scales everything that has lengths in it; 1 if absent [m]

      integer :: k

      item%kind = info%name
      item%name = "item_"//achar(iachar("0") + variant)
      allocate (item%values(size(info%columns)))
      do k = 1, size(info%columns)
         call fill_value(info%columns(k), variant, random, item%values(k))
         if (present(unit_of_length)) call scale_value(info%columns(k), unit_of_length, item%values(k))
      end do
   end subroutine fill_item

   !> A value within the bounds of its column.
   subroutine fill_value(column, variant, random, value)
      type(column_t), intent(in) :: column     !! the column
      integer, intent(in) :: variant           !! number of the row
      type(random_t), intent(inout) :: random  !! where numbers come from
      type(value_t), intent(out) :: value      !! the value

      real(wp), parameter :: unbounded = 0.5_wp*huge(1.0_wp)
      real(wp) :: high, low
      type(text_t), allocatable :: words(:)

      value%column = column%name
      value%given = .true.
      value%text = ""
      low = -1.0_wp
      if (column%bounds%upper < unbounded) low = column%bounds%upper - 1.0_wp
      if (column%bounds%lower > -unbounded) low = column%bounds%lower
      high = low + 2.0_wp
      if (column%bounds%upper < unbounded) high = column%bounds%upper
      select case (column%cell)
      case (cell_number)
         value%number = random%between(low, high)
      case (cell_vector)
         value%vector%n = column%size
         value%vector%x = random%vector(3, low, high)
      case (cell_word)
         value%text = "word"
         if (allocated(column%choices)) then
            words = split_blank(column%choices)
            if (size(words) > 0) value%text = words(1 + modulo(variant - 1, size(words)))%s
         end if
      case (cell_reference)
         value%index = variant
      case (cell_expression)
         value%expression = make_expression(exact_text(random%between(0.5_wp, 1.5_wp))//"*"//smooth, column)
      case (cell_flag)
         value%flag = modulo(variant, 2) == 1
      case (cell_list)
         if (column%size > 1) then
            value%table = reshape(random%vector(column%size, -1.0_wp, 1.0_wp), [column%size, 1])
         else
            value%table = reshape(column_of_samples(column%name, random), [n_sample, 1])
         end if
      case (cell_file)
         value%given = .false.
      end select
   end subroutine fill_value

   !> A list: places in order, or values that end as they start.
   function column_of_samples(name, random) result(list)
      character(*), intent(in) :: name         !! of the column
      type(random_t), intent(inout) :: random  !! where numbers come from
      real(wp) :: list(n_sample)               !! (n_sample) numbers [any]

      integer :: k

      list = random%vector(n_sample, 0.3_wp, 1.0_wp)
      if (name == "at") then
         do k = 2, n_sample
            list(k) = list(k - 1) + list(k)
         end do
      else
         list(n_sample) = list(1)
      end if
   end function column_of_samples

   !> Another unit of length: the same thing, so many times as large.
   subroutine scale_value(column, unit_of_length, value)
      type(column_t), intent(in) :: column         !! the column
      real(wp), intent(in) :: unit_of_length       !! how much larger [m]
      type(value_t), intent(inout) :: value        !! the value

      real(wp) :: factor

      factor = unit_of_length**column%dimension%m
      value%number = factor*value%number
      value%vector%x = factor*value%vector%x
      if (.not. allocated(value%expression)) return
      value%expression = make_expression(exact_text(factor)//"*"//value%expression%source, column)
   end subroutine scale_value

   !> An expression for a column; units are those of SI and not written.
   function make_expression(source, column) result(compiled)
      character(*), intent(in) :: source    !! text
      type(column_t), intent(in) :: column  !! where it belongs
      type(expression_t) :: compiled        !! the expression, with the dimension of the column

      type(fault_t), allocatable :: fault
      type(symbols_t) :: none

      call compile_expression(source, none, .true., compiled, fault)
      if (allocated(fault)) error stop "generic_item: the expression is wrong"
      compiled%dimension = column%dimension
   end function make_expression

   !> Number of a column, 0 if the kind has no such column.
   pure integer function column_number(info, name) result(found)
      type(kind_info_t), intent(in) :: info  !! the kind
      character(*), intent(in) :: name       !! name of the column

      integer :: k

      found = 0
      do k = 1, size(info%columns)
         if (info%columns(k)%name == name) found = k
      end do
   end function column_number

   !> Set a number of a row, if the kind has the column.
   subroutine set_number(info, name, x, item)
      type(kind_info_t), intent(in) :: info  !! the kind
      character(*), intent(in) :: name       !! name of the column
      real(wp), intent(in) :: x              !! the number, SI [any]
      type(item_t), intent(inout) :: item    !! the row

      integer :: k

      k = column_number(info, name)
      if (k > 0) item%values(k)%number = x
   end subroutine set_number

end module generic_item
