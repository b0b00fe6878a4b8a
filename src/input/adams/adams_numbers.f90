!> Numbers in the arguments of the statements of an Adams dataset, and what is said of those that are none.
!>
!> A number with a D behind it is in degrees.
!> Source: the public descriptions of the statements of Adams/Solver. Limits: no expressions.
module adams_numbers
   use dataset, only: find_argument, statement_t
   use diagnostics, only: diagnostics_t
   use item, only: location_t
   use kinds, only: pi, wp
   use numbers, only: number_length, read_number
   use text, only: lower, to_text
   implicit none (type, external)
   private
   public :: argument_numbers, id_of, mistake, vector_numbers

contains

   !> An error of the dataset.
   subroutine mistake(mistakes, at, message, help)
      type(diagnostics_t), intent(inout) :: mistakes   !! the collection
      type(location_t), intent(in) :: at               !! where it is
      character(*), intent(in) :: message              !! what is wrong
      character(*), intent(in) :: help                 !! what to do, or blank

      call mistakes%add(at, message, "", help)
   end subroutine mistake

   !> Numbers of an argument; angles in degrees become radians.
   subroutine argument_numbers(statement, name, numbers, mistakes, minimum, wanted)
      type(statement_t), intent(in) :: statement            !! the statement
      character(*), intent(in) :: name                      !! of the argument
      real(wp), allocatable, intent(out) :: numbers(:)      !! (n) none: there is no such argument [any]
      type(diagnostics_t), intent(inout) :: mistakes        !! collects what is no number
      integer, intent(in), optional :: minimum                !! letters that do for the name
      integer, intent(in), optional :: wanted               !! how many there must be; omitted: any number

      character(*), parameter :: counts(3) = [character(5) :: "one", "two", "three"]
      character(:), allocatable :: word
      real(wp) :: x
      integer :: i, k, length
      logical :: is_finite

      allocate (numbers(0))
      k = find_argument(statement, name, minimum)
      if (k == 0) return
      do i = 1, size(statement%arguments(k)%values)
         word = statement%arguments(k)%values(i)%s
         length = number_length(word)
         is_finite = length > 0
         x = 0.0_wp
         if (is_finite) call read_number(word(:length), 0, x, is_finite)
         if (is_finite .and. length < len(word)) then
            is_finite = lower(word(length + 1:)) == "d"
            x = x*pi/180.0_wp
         end if
         if (.not. is_finite) call mistake(mistakes, statement%arguments(k)%at, "'"//word//"' of "//name//" is not a number", "")
         numbers = [numbers, x]
      end do
      if (.not. present(wanted)) return
      if (size(numbers) /= wanted) call mistake(mistakes, statement%arguments(k)%at, name//" has "//to_text(size(numbers))// &
                                    trim(merge(" number ", " numbers", size(numbers) == 1))//" where "// &
                                    trim(counts(wanted))//trim(merge(" is expected ", " are expected", wanted == 1)), "")
   end subroutine argument_numbers

   !> Three numbers of an argument, zeros without it.
   subroutine vector_numbers(statement, name, vector, is_given, mistakes)
      type(statement_t), intent(in) :: statement            !! the statement
      character(*), intent(in) :: name                      !! of the argument
      real(wp), intent(out) :: vector(3)                    !! (3) the numbers [any]
      logical, intent(out) :: is_given                      !! whether it is there
      type(diagnostics_t), intent(inout) :: mistakes        !! collects what is no number

      real(wp), allocatable :: numbers(:)

      call argument_numbers(statement, name, numbers, mistakes, wanted=3)
      vector = 0.0_wp
      is_given = size(numbers) == 3
      if (is_given) vector = numbers
   end subroutine vector_numbers

   !> The number of a statement that an argument names; 0: there is no such argument.
   integer function id_of(statement, name, mistakes, minimum) result(id)
      type(statement_t), intent(in) :: statement            !! the statement
      character(*), intent(in) :: name                      !! of the argument
      type(diagnostics_t), intent(inout) :: mistakes        !! collects what is no number
      integer, intent(in), optional :: minimum                !! letters that do for the name

      real(wp), allocatable :: numbers(:)

      call argument_numbers(statement, name, numbers, mistakes, minimum, wanted=1)
      id = 0
      if (size(numbers) > 0) id = nint(min(abs(numbers(1)), 1.0e9_wp))
   end function id_of

end module adams_numbers
