!> Archives: what is put comes out, exactly and in order; whoever reads too much gets zeros and is reported.
module test_archive
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: i8, wp
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: run_test_archive

contains

   subroutine run_test_archive(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("round_trip", test_round_trip)
      call suite%test("growth", test_growth)
      call suite%test("too_short", test_too_short)
      call suite%test("lists_that_lie", test_lists_that_lie)
      call suite%test("segments", test_segments)
   end subroutine run_test_archive

   !> All types, with their extreme values.
   subroutine test_round_trip(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer(i8), parameter :: long = 9007199254740992_i8  ! 2^53: the maximum that is exact
      type(archive_t) :: archive
      character(:), allocatable :: empty, text
      real(wp), allocatable :: list(:), none(:)
      real(wp) :: three(3), x
      integer :: i, pair(2)
      integer(i8) :: k, negative
      logical :: flag, is_false

      call archive%put(0.1_wp)
      call archive%put([tiny(1.0_wp), -huge(1.0_wp), 1.0_wp/3.0_wp])
      call archive%put(-huge(1))
      call archive%put([huge(1), 0])
      call archive%put(long)
      call archive%put(.true.)
      call archive%put(.false.)
      call archive%put(-long)
      call archive%put("pin 'a'"//achar(0)//achar(127))
      call archive%put("")
      call archive%put_list([1.5_wp, -2.5_wp])
      call archive%put_list([real(wp) ::])
      call check_true(error, .not. archive%is_at_end(), "nothing has been read")
      if (allocated(error)) return
      call archive%get(x)
      call archive%get(three)
      call archive%get(i)
      call archive%get(pair)
      call archive%get(k)
      call archive%get(flag)
      call archive%get(is_false)
      call archive%get(negative)
      call archive%get_text(text)
      call archive%get_text(empty)
      call archive%get_list(list)
      call archive%get_list(none)
      call check_close(error, x, 0.1_wp, 0.0_wp, "a real")
      if (.not. allocated(error)) call check_close(error, three, [tiny(1.0_wp), -huge(1.0_wp), 1.0_wp/3.0_wp], 0.0_wp, "reals")
      if (.not. allocated(error)) call check_equal(error, i, -huge(1), "an integer")
      if (.not. allocated(error)) call check_true(error, all(pair == [huge(1), 0]), "integers")
      if (.not. allocated(error)) call check_true(error, k == long .and. flag, "a long integer and a flag")
      if (.not. allocated(error)) call check_true(error, negative == -long .and. .not. is_false, "their opposites")
      if (.not. allocated(error)) call check_true(error, text == "pin 'a'"//achar(0)//achar(127) .and. len(text) == 9, "a text")
      if (.not. allocated(error)) call check_true(error, len(empty) == 0 .and. size(none) == 0, "an empty text, an empty list")
      if (.not. allocated(error)) call check_close(error, list, [1.5_wp, -2.5_wp], 0.0_wp, "a list")
      if (.not. allocated(error)) call check_true(error, archive%is_at_end(), "all has been read")
   end subroutine test_round_trip

   !> Many numbers one by one, and a long list in one.
   subroutine test_growth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 3000
      type(archive_t) :: archive
      real(wp), allocatable :: list(:)
      integer :: found(n), k

      do k = 1, n
         call archive%put(k)
      end do
      call archive%put_list([(real(k, wp), k=1, 5*n)])
      call archive%get(found)
      call archive%get_list(list)
      call check_true(error, all(found == [(k, k=1, n)]), "one by one")
      if (.not. allocated(error)) call check_close(error, list, [(real(k, wp), k=1, 5*n)], 0.0_wp, "a list")
      if (.not. allocated(error)) call check_true(error, archive%is_at_end(), "all has been read")
   end subroutine test_growth

   !> Beyond the end: zeros, and no end that could be taken for a good one.
   subroutine test_too_short(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(archive_t) :: archive
      real(wp) :: three(3), x

      call archive%put([1.0_wp, 2.0_wp])
      call archive%get(three)
      call check_close(error, three, [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "three of two")
      if (allocated(error)) return
      call archive%get(x)
      call check_close(error, x, 0.0_wp, 0.0_wp, "after that")
      if (.not. allocated(error)) call check_true(error, .not. (archive%is_good .or. archive%is_at_end()), "the tape says so")
   end subroutine test_too_short

   !> Segments count what is put into them; an empty one may be dropped; another archive is refused by the first that differs.
   subroutine test_segments(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(archive_t) :: archive, other
      type(error_t), allocatable :: refusal

      call archive%begin("the state", 1)
      call archive%put([1.0_wp, 2.0_wp])
      call archive%put(.true.)
      call archive%begin("nothing", 1)
      call archive%drop_empty()
      call archive%drop_empty()
      call archive%begin("the rest", 2, is_fixed=.false.)
      call archive%put_list([3.0_wp])
      call check_equal(error, size(archive%segments), 2, "segments")
      if (allocated(error)) return
      call check_true(error, all(archive%segments%size == [3, 2]), "their numbers")
      call archive%compare(archive, refusal)
      if (.not. allocated(error)) call check_true(error, .not. allocated(refusal), "it can be read")
      other = archive
      call other%put(4.0_wp)
      call other%compare(archive, refusal)
      if (.not. allocated(error)) call check_true(error, .not. allocated(refusal), "a segment of another size, which may change")
      other%segments(1)%version = 3
      call other%compare(archive, refusal)
      if (.not. allocated(error)) call check_true(error, allocated(refusal), "another version")
      if (allocated(error)) return
      call check_true(error, index(refusal%message, "the state of the state has version 3, supported is version 1") > 0, "by name")
   end subroutine test_segments

   !> A list whose length is not one.
   subroutine test_lists_that_lie(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: lengths(3) = [-1, 2, huge(1)]
      type(archive_t) :: archive
      real(wp), allocatable :: list(:)
      integer :: k

      do k = 1, size(lengths)
         archive = archive_t()
         call archive%put(lengths(k))
         call archive%put(1.0_wp)
         call archive%get_list(list)
         call check_true(error, size(list) == 0 .and. .not. archive%is_good, "no list")
         if (allocated(error)) return
      end do
   end subroutine test_lists_that_lie

end module test_archive
