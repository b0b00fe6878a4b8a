!> Paths of included files.
module file_path
   use text, only: append_text, join, text_t
   implicit none (type, external)
   private
   public :: beside, plain_path

contains

   !> The path of a file that another file names, relative to that other file.
   pure function beside(including, path) result(whole)
      character(*), intent(in) :: including  !! path of the file that names it
      character(*), intent(in) :: path       !! as named
      character(:), allocatable :: whole     !! the path

      integer :: k

      k = index(including, "/", back=.true.)
      if (path(1:1) == "/") k = 0
      whole = including(1:k)//path
   end function beside

   !> A path without `.`, doubled slashes, and `..` after a directory.
   pure function plain_path(path) result(plain)
      character(*), intent(in) :: path    !! any path
      character(:), allocatable :: plain  !! the same file by a simpler path, as long as there are no links

      type(text_t), allocatable :: parts(:)
      integer :: first, k, last, n
      logical :: goes_up

      n = 0
      allocate (parts(0))
      first = 1
      do while (first <= len(path))
         last = index(path(first:), "/") + first - 2
         if (last < first - 1) last = len(path)
         goes_up = .false.
         if (n > 0 .and. path(first:last) == "..") goes_up = parts(n)%s /= ".."
         if (goes_up) then
            n = n - 1
         else if (last >= first .and. path(first:last) /= ".") then
            n = n + 1
            if (n > size(parts)) call append_text(parts, "")
            parts(n)%s = path(first:last)
         end if
         first = last + 2
      end do
      plain = join(parts(1:n), "/")
      k = min(1, len(path))
      if (path(1:k) == "/") then
         plain = "/"//plain
      else if (n == 0 .and. k > 0) then
         plain = "."
      end if
   end function plain_path

end module file_path
