!> Text, files and numbers inside a page of HTML that asks no network: text that is nothing but text, bytes and numbers in base 64.
!>
!> Source of base 64: IETF RFC 4648, section 4.
module html_text
   use, intrinsic :: iso_fortran_env, only: int32, real32, real64
   use kinds, only: wp
   use plot_text, only: valid_utf8
   use text, only: replace
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: base_64, doubles_in_base_64, escaped, floats_in_base_64, in_attribute, integers_in_base_64

contains

   !> Text that is nothing but text, in the page or in a string of its script.
   pure function escaped(text, in_page) result(s)
      character(*), intent(in) :: text         !! any bytes
      logical, intent(in) :: in_page           !! in the page, not in a string
      character(:), allocatable :: s           !! harmless

      character(*), parameter :: codes(6) = [character(2) :: "22", "27", "3c", "3e", "26", "5c"]
      character(*), parameter :: signs = """'<>&\"
      type(buffer_t) :: buffer
      character(:), allocatable :: clean
      integer :: i, k

      clean = valid_utf8(text)
      do i = 1, len(clean)
         k = index(signs, clean(i:i))
         if (iachar(clean(i:i)) < 32) then
            call buffer%add(" ")
         else if (k == 0) then
            call buffer%add(clean(i:i))
         else if (in_page) then
            call buffer%add("&#x"//codes(k)//";")
         else
            call buffer%add("\u00"//codes(k))
         end if
      end do
      s = buffer%get()
   end function escaped

   !> A whole page as the value of an attribute in double quotes; its lines stay lines.
   pure function in_attribute(page) result(s)
      character(*), intent(in) :: page         !! HTML
      character(:), allocatable :: s           !! harmless between double quotes

      s = replace(replace(page, "&", "&amp;"), """", "&quot;")
   end function in_attribute

   !> Bytes in base 64.
   pure function base_64(bytes) result(s)
      character(*), intent(in) :: bytes        !! any bytes
      character(:), allocatable :: s           !! letters, digits, `+`, `/`, `=`

      character(*), parameter :: signs = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
      integer :: at, code, i, j, n

      allocate (character(4*((len(bytes) + 2)/3)) :: s)
      at = 0
      do i = 1, len(bytes), 3
         n = min(3, len(bytes) - i + 1)
         code = 0
         do j = 0, 2
            code = 256*code
            if (j < n) code = code + ichar(bytes(i + j:i + j))
         end do
         do j = 0, 3
            at = at + 1
            s(at:at) = "="
            if (j <= n) s(at:at) = signs(ibits(code, 6*(3 - j), 6) + 1:ibits(code, 6*(3 - j), 6) + 1)
         end do
      end do
   end function base_64

   !> Numbers as bytes in base 64, four each, in the order of bytes of this machine: IEEE single precision.
   pure function floats_in_base_64(values) result(s)
      real(wp), intent(in) :: values(:)        !! (n) the numbers; beyond the range of single precision infinite [any]
      character(:), allocatable :: s           !! 16/3 letters each

      character(:), allocatable :: bytes

      allocate (character(4*size(values)) :: bytes)
      bytes = transfer(real(values, real32), bytes)
      s = base_64(bytes)
   end function floats_in_base_64

   !> The same, eight bytes each: IEEE double precision.
   pure function doubles_in_base_64(values) result(s)
      real(wp), intent(in) :: values(:)        !! (n) the numbers [any]
      character(:), allocatable :: s           !! 32/3 letters each

      character(:), allocatable :: bytes

      allocate (character(8*size(values)) :: bytes)
      bytes = transfer(real(values, real64), bytes)
      s = base_64(bytes)
   end function doubles_in_base_64

   !> The same, integers of four bytes.
   pure function integers_in_base_64(values) result(s)
      integer, intent(in) :: values(:)         !! (n) the numbers
      character(:), allocatable :: s           !! 16/3 letters each

      character(:), allocatable :: bytes

      allocate (character(4*size(values)) :: bytes)
      bytes = transfer(int(values, int32), bytes)
      s = base_64(bytes)
   end function integers_in_base_64

end module html_text
