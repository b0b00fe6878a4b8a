!> Files that pages hold, as they were when the program was built: three.js, its licence, and our own of page/.
module page_files
   use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_int, c_ptr, c_size_t
   implicit none (type, external)
   private
   public :: page_file, page_body, page_head, page_licence, page_orbit, page_scripts, page_study, page_three, &
      study_scripts, study_style

   integer, parameter :: page_head = 0      !! style, to the start of the body
   integer, parameter :: page_body = 1      !! elements of an animation
   integer, parameter :: page_licence = 2   !! of three.js
   integer, parameter :: page_three = 3     !! three.js
   integer, parameter :: page_orbit = 4     !! OrbitControls of three.js
   integer, parameter :: page_study = 5     !! elements of the page of a sweep
   integer, parameter :: study_style = 17   !! style of the page of a study, before the other
   integer, parameter :: page_scripts(8) = [6, 7, 8, 9, 10, 11, 12, 13]  !! our own of an animation, in the order of reading
   integer, parameter :: study_scripts(7) = [6, 7, 14, 15, 18, 19, 16]   !! the same of a sweep

   interface
      type(c_ptr) function c_page_file(number, n) bind(c, name="gudgeon_page_file")
         import :: c_int, c_ptr, c_size_t
         implicit none (type, external)
         integer(c_int), value :: number       !! one of the above
         integer(c_size_t), intent(out) :: n   !! its bytes
      end function c_page_file
   end interface

contains

   !> The text of a file.
   function page_file(number) result(text)
      integer, intent(in) :: number          !! one of the above
      character(:), allocatable :: text      !! as it is

      character(kind=c_char), pointer :: bytes(:)
      type(c_ptr) :: address
      integer(c_size_t) :: k, n

      address = c_page_file(int(number, c_int), n)
      call c_f_pointer(address, bytes, [n])
      allocate (character(n) :: text)
      do k = 1, n
         text(k:k) = bytes(k)
      end do
   end function page_file

end module page_files
