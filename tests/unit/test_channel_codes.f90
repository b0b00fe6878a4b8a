!> Every channel of a kind has a number of its own: by that the kind knows it when values are requested.
module test_channel_codes
   use check, only: check_true, suite_t
   use errors, only: error_t
   use kind_info, only: kind_info_t
   use kind_list, only: all_kinds
   use mechanism_catalogue, only: energy_info
   use read_channel, only: channel_code
   implicit none (type, external)
   private
   public :: run_test_channel_codes

contains

   !> Register the tests.
   subroutine run_test_channel_codes(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("channels_have_numbers_of_their_own", channels_have_numbers_of_their_own)
   end subroutine run_test_channel_codes

   subroutine channels_have_numbers_of_their_own(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kind_info_t) :: energy
      type(kind_info_t), allocatable :: kinds(:)
      integer :: i, k, n

      call all_kinds(kinds)
      energy = energy_info(.true., .true.)
      kinds = [kinds, energy]
      n = 0
      do k = 1, size(kinds)
         if (.not. allocated(kinds(k)%channels)) cycle
         associate (channels => kinds(k)%channels)
            do i = 1, size(channels)
               n = n + 1
               call check_true(error, channels(i)%code > 0, kinds(k)%name//": "//channels(i)%name//" has a number")
               call check_true(error, all(channels(:i - 1)%code /= channels(i)%code), &
                               kinds(k)%name//": no other has that of "//channels(i)%name)
               call check_true(error, channel_code(kinds(k), channels(i)%name) == channels(i)%code, &
                               kinds(k)%name//": "//channels(i)%name//" is found")
            end do
         end associate
      end do
      call check_true(error, n > 50, "there are channels")
   end subroutine channels_have_numbers_of_their_own

end module test_channel_codes
