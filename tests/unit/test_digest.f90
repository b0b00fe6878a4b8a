!> SHA-256 of published messages. Source: FIPS 180-4 and NIST's examples of it.
module test_digest
   use check, only: check_true, suite_t
   use digest, only: sha256
   use errors, only: error_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_digest

contains

   subroutine run_test_digest(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("published", test_published)
      call suite%test("padding", test_padding)
   end subroutine run_test_digest

   !> No bytes, one block, two blocks, many.
   subroutine test_published(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call expect("", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855", error)
      if (allocated(error)) return
      call expect("abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad", error)
      if (allocated(error)) return
      call expect("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", &
                  "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1", error)
      if (allocated(error)) return
      call expect("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmno"// &
                  "ijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu", &
                  "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1", error)
      if (allocated(error)) return
      call expect(repeat("a", 1000000), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0", error)
   end subroutine test_published

   !> A text and its digest.
   subroutine expect(text, published, error)
      character(*), intent(in) :: text                   !! the message
      character(*), intent(in) :: published              !! its digest
      type(error_t), allocatable, intent(out) :: error   !! it is another one

      call check_true(error, sha256(text) == published, to_text(len(text))//" bytes: "//sha256(text))
   end subroutine expect

   !> Every length around the ends of blocks gives a digest of its own.
   subroutine test_padding(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: k

      do k = 50, 130
         call check_true(error, sha256(repeat("x", k)) /= sha256(repeat("x", k + 1)), to_text(k)//" bytes and one more")
         if (allocated(error)) return
      end do
   end subroutine test_padding

end module test_digest
