!> SHA-256 of a text, by which a file is known again (sha256.c).
module digest
   use, intrinsic :: iso_c_binding, only: c_char, c_int64_t
   implicit none (type, external)
   private
   public :: n_digest, sha256

   integer, parameter :: n_digest = 64  !! characters of a digest

   ! allow(assumed-size, assumed-size-character-intent)
   interface
      subroutine c_sha256(bytes, n, digest) bind(c, name="gudgeon_sha256")
         import :: c_char, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: bytes(*)    !! (n) the bytes
         integer(c_int64_t), value :: n                    !! how many
         character(kind=c_char), intent(out) :: digest(*)  !! (64) the digest
      end subroutine c_sha256
   end interface

contains

   !> The digest of a text in hexadecimal digits.
   function sha256(text) result(digest)
      character(*), intent(in) :: text   !! the text
      character(n_digest) :: digest      !! its digest

      call c_sha256(text, len(text, c_int64_t), digest)
   end function sha256

end module digest
