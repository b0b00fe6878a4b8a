!> Writing and reading the memory of kinds and integrators as one row of numbers.
!>
!> Every kind that remembers something says how many numbers that takes, puts them into a row and
!> takes them back; counts and flags travel as whole numbers in doubles, exact below 2^53.
module memory
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: get, put

   !> Put a value at the end of what is written.
   interface put
      module procedure put_real, put_reals, put_integer, put_long, put_logical
   end interface put

   !> Take the next value.
   interface get
      module procedure get_real, get_reals, get_integer, get_long, get_logical
   end interface get

contains

   subroutine put_real(row, place, value)
      real(wp), intent(inout) :: row(:)  !! (any) the row [any]
      integer, intent(inout) :: place    !! last place used
      real(wp), intent(in) :: value      !! the value [any]

      place = place + 1
      row(place) = value
   end subroutine put_real

   subroutine put_reals(row, place, values)
      real(wp), intent(inout) :: row(:)   !! (any) the row [any]
      integer, intent(inout) :: place     !! last place used
      real(wp), intent(in) :: values(:)   !! (any) the values [any]

      row(place + 1:place + size(values)) = values
      place = place + size(values)
   end subroutine put_reals

   subroutine put_integer(row, place, value)
      real(wp), intent(inout) :: row(:)  !! (any) the row [any]
      integer, intent(inout) :: place    !! last place used
      integer, intent(in) :: value       !! the value

      call put_real(row, place, real(value, wp))
   end subroutine put_integer

   subroutine put_long(row, place, value)
      real(wp), intent(inout) :: row(:)  !! (any) the row [any]
      integer, intent(inout) :: place    !! last place used
      integer(i8), intent(in) :: value   !! the value

      call put_real(row, place, real(value, wp))
   end subroutine put_long

   subroutine put_logical(row, place, value)
      real(wp), intent(inout) :: row(:)  !! (any) the row [any]
      integer, intent(inout) :: place    !! last place used
      logical, intent(in) :: value       !! the value

      call put_real(row, place, merge(1.0_wp, 0.0_wp, value))
   end subroutine put_logical

   subroutine get_real(row, place, value)
      real(wp), intent(in) :: row(:)   !! (any) the row [any]
      integer, intent(inout) :: place  !! last place used
      real(wp), intent(out) :: value   !! the value [any]

      place = place + 1
      value = row(place)
   end subroutine get_real

   subroutine get_reals(row, place, values)
      real(wp), intent(in) :: row(:)      !! (any) the row [any]
      integer, intent(inout) :: place     !! last place used
      real(wp), intent(out) :: values(:)  !! (any) the values [any]

      values = row(place + 1:place + size(values))
      place = place + size(values)
   end subroutine get_reals

   subroutine get_integer(row, place, value)
      real(wp), intent(in) :: row(:)   !! (any) the row [any]
      integer, intent(inout) :: place  !! last place used
      integer, intent(out) :: value    !! the value

      place = place + 1
      value = nint(row(place))
   end subroutine get_integer

   subroutine get_long(row, place, value)
      real(wp), intent(in) :: row(:)     !! (any) the row [any]
      integer, intent(inout) :: place    !! last place used
      integer(i8), intent(out) :: value  !! the value

      place = place + 1
      value = nint(row(place), i8)
   end subroutine get_long

   subroutine get_logical(row, place, value)
      real(wp), intent(in) :: row(:)   !! (any) the row [any]
      integer, intent(inout) :: place  !! last place used
      logical, intent(out) :: value    !! the value

      place = place + 1
      value = nint(row(place)) == 1
   end subroutine get_logical

end module memory
