!> An object of JSON, member by member.
module json_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: i8, wp
   use plot_text, only: valid_utf8
   use text, only: exact_text, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: json_object_t, json_string

   !> An object that is being written.
   type :: json_object_t
      private
      type(buffer_t) :: buffer                 !! its members so far
      character(:), allocatable :: separator   !! before the next one
      character(:), allocatable :: indent      !! of its members
   contains
      procedure :: start => start_object
      procedure :: put_text
      procedure :: put_real
      procedure :: put_reals
      procedure :: put_integer
      procedure :: put_logical
      procedure :: put_list
      procedure :: put_object
      procedure :: put_objects
      procedure :: get => get_object
   end type json_object_t

contains

   !> Start an object.
   subroutine start_object(self, depth)
      class(json_object_t), intent(inout) :: self  !! the object
      integer, intent(in) :: depth                 !! objects around it

      self%indent = repeat("  ", depth + 1)
      self%separator = "{"//new_line("a")
   end subroutine start_object

   !> Write the name of the next member.
   subroutine put_name(self, name)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member

      call self%buffer%add(self%separator//self%indent//json_string(name)//": ")
      self%separator = ","//new_line("a")
   end subroutine put_name

   !> A member that is a string.
   subroutine put_text(self, name, value)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member
      character(*), intent(in) :: value            !! its value

      call put_name(self, name)
      call self%buffer%add(json_string(value))
   end subroutine put_text

   !> A member that is a number; what is not finite becomes null.
   subroutine put_real(self, name, value)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member
      real(wp), intent(in) :: value                !! its value [any]

      call put_name(self, name)
      if (ieee_is_finite(value)) then
         call self%buffer%add(exact_text(value))
      else
         call self%buffer%add("null")
      end if
   end subroutine put_real

   !> A member that is a list of numbers; what is not finite becomes null.
   subroutine put_reals(self, name, values)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member
      real(wp), intent(in) :: values(:)            !! (n) its values [any]

      integer :: k

      call put_name(self, name)
      call self%buffer%add("[")
      do k = 1, size(values)
         if (k > 1) call self%buffer%add(", ")
         if (ieee_is_finite(values(k))) then
            call self%buffer%add(exact_text(values(k)))
         else
            call self%buffer%add("null")
         end if
      end do
      call self%buffer%add("]")
   end subroutine put_reals

   !> A member that is an integer.
   subroutine put_integer(self, name, value)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member
      integer(i8), intent(in) :: value             !! its value

      call put_name(self, name)
      call self%buffer%add(to_text(value))
   end subroutine put_integer

   !> A member that is true or false.
   subroutine put_logical(self, name, value)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member
      logical, intent(in) :: value                 !! its value

      call put_name(self, name)
      call self%buffer%add(trim(merge("true ", "false", value)))
   end subroutine put_logical

   !> A member that is a list of strings.
   subroutine put_list(self, name, list)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member
      type(text_t), intent(in) :: list(:)          !! (n) strings

      integer :: k

      call put_name(self, name)
      call self%buffer%add("[")
      do k = 1, size(list)
         if (k > 1) call self%buffer%add(",")
         call self%buffer%add(new_line("a")//self%indent//"  "//json_string(list(k)%s))
      end do
      if (size(list) > 0) call self%buffer%add(new_line("a")//self%indent)
      call self%buffer%add("]")
   end subroutine put_list

   !> A member that is a finished object.
   subroutine put_object(self, name, value)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member
      character(*), intent(in) :: value            !! the object as text

      call put_name(self, name)
      call self%buffer%add(value)
   end subroutine put_object

   !> A member that is a list of finished objects.
   subroutine put_objects(self, name, list)
      class(json_object_t), intent(inout) :: self  !! the object
      character(*), intent(in) :: name             !! of the member
      type(text_t), intent(in) :: list(:)          !! (n) objects as text

      integer :: k

      call put_name(self, name)
      call self%buffer%add("[")
      do k = 1, size(list)
         if (k > 1) call self%buffer%add(", ")
         call self%buffer%add(list(k)%s)
      end do
      call self%buffer%add("]")
   end subroutine put_objects

   !> The finished object.
   function get_object(self) result(text)
      class(json_object_t), intent(inout) :: self  !! the object
      character(:), allocatable :: text            !! without a line's end after it

      text = self%buffer%get()//new_line("a")//self%indent(3:)//"}"
      if (self%buffer%length() == 0) text = "{}"
   end function get_object

   !> A string with its quotes, escaped.
   pure function json_string(value) result(s)
      character(*), intent(in) :: value   !! any bytes
      character(:), allocatable :: s      !! a string of JSON

      character(*), parameter :: hex = "0123456789abcdef"
      type(buffer_t) :: buffer
      character(:), allocatable :: clean
      integer :: code, i

      clean = valid_utf8(value)
      call buffer%add("""")
      do i = 1, len(clean)
         code = ichar(clean(i:i))
         if (clean(i:i) == """" .or. clean(i:i) == "\") then
            call buffer%add("\"//clean(i:i))
         else if (clean(i:i) == new_line("a")) then
            call buffer%add("\n")
         else if (code < 32 .or. code == 127) then
            call buffer%add("\u00"//hex(code/16 + 1:code/16 + 1)//hex(mod(code, 16) + 1:mod(code, 16) + 1))
         else
            call buffer%add(clean(i:i))
         end if
      end do
      call buffer%add("""")
      s = buffer%get()
   end function json_string

end module json_text
