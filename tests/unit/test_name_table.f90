!> The table of names against a search from the first to the last.
module test_name_table
   use check, only: check_equal, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use name_table, only: name_table_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: run_test_name_table

contains

   subroutine run_test_name_table(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("against_search", test_against_search)
      call suite%test("empty", test_empty)
   end subroutine run_test_name_table

   !> Random names of up to four letters: many come twice, of which the first counts; some never.
   subroutine test_against_search(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 200
      character(*), parameter :: letters = "abc "
      type(name_table_t) :: table
      type(random_t) :: random
      type(text_t) :: names(n)
      character(4) :: name
      integer :: expected, i, k, previous

      random%state = 5_i8
      do k = 1, n
         names(k)%s = letters_of(random)
      end do
      call table%list(names)
      do k = 1, 300
         name = letters_of(random)
         expected = 0
         do i = n, 1, -1
            if (names(i)%s == name) expected = i
         end do
         call check_equal(error, table%find(trim(name)), expected, "'"//trim(name)//"'")
      end do
      call table%start(1)
      call table%enter("one", 7, previous)
      call check_equal(error, previous, 0, "a new name")
      call table%enter("one", 8, previous)
      call check_equal(error, previous, 7, "a name that was there")
      call check_equal(error, table%find("one"), 7, "number of the first")

   contains

      !> Four letters, blanks at the end omitted.
      function letters_of(from) result(word)
         type(random_t), intent(inout) :: from   !! where numbers come from
         character(:), allocatable :: word       !! the word

         character(4) :: room
         integer :: at, c

         do c = 1, 4
            at = 1 + min(3, int(from%between(0.0_wp, 4.0_wp)))
            room(c:c) = letters(at:at)
         end do
         word = trim(room)
      end function letters_of

   end subroutine test_against_search

   !> A table without names has none.
   subroutine test_empty(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(name_table_t) :: table
      type(text_t) :: none(0)

      call table%list(none)
      call check_equal(error, table%find("a"), 0, "a name of an empty table")
   end subroutine test_empty

end module test_name_table
