!> Other numbers for the parameters of a deck: which sections may mean something else.
module test_parameter_change
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_fixture, only: read_lines, reading_t
   use errors, only: error_t
   use kinds, only: wp
   use parameter_change, only: change_parameters
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: run_test_parameter_change

   character, parameter :: nl = new_line("a")
   character(*), parameter :: deck = "deck = 1"//nl//"[parameters]"//nl//"c = 1 mm"//nl//"half = {c/2}"//nl//"speed = 3"//nl// &
      "c_2 = 5"//nl//"d2c = 1"//nl//"g = 9.81 m/s^2"//nl//"[scene]"//nl//"gravity = 0 {-g*speed} m/s^2"//nl//"[bodies]"//nl// &
      "name mass[kg] x[mm]"//nl//"crank {speed*1 kg} 3"//nl//"[driver.angle]"//nl//"name body angle[rad]"//nl// &
      "a crank {half*1 rad/(1 mm)}"//nl// &
      "[output]"//nl//"end = {c_2*1 s}"//nl//"factor = {d2c}"

contains

   !> All tests of this file.
   subroutine run_test_parameter_change(suite)
      type(suite_t), intent(inout) :: suite  !! the suite

      call suite%test("touched_sections", test_touched_sections)
      call suite%test("other_overrides", test_other_overrides)
   end subroutine run_test_parameter_change

   !> A name counts where it stands by itself, and so do parameters that are made of it; letters of longer names do not.
   !> After a digit a name is taken for one by itself: a table is rather read once too often.
   subroutine test_touched_sections(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call check_touched("c", "c=2mm", "driver.angle output", error)  ! for the digit in d2c
      call check_touched("c", "c=1mm", "", error)
      call check_touched("speed", "speed=4", "scene bodies", error)
      call check_touched("c_2", "c_2=6", "output", error)
      call check_touched("d2c", "d2c=2", "output", error)
      call check_touched("half", "half=1mm", "driver.angle", error)
   end subroutine test_touched_sections

   !> The sections that an override changes.
   subroutine check_touched(name, override, expected, error)
      character(*), intent(in) :: name                    !! of the parameter
      character(*), intent(in) :: override                !! what it is set to
      character(*), intent(in) :: expected                !! blank-separated names of the sections
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      type(reading_t) :: reading
      type(text_t), allocatable :: overrides(:)
      logical, allocatable :: is_touched(:)
      character(:), allocatable :: found
      logical :: is_done
      integer :: k

      if (allocated(error)) return
      call read_lines(deck, reading, name//"="//value_of(name))
      call check_equal(error, reading%message, "", "the deck")
      allocate (overrides(0))
      call append_text(overrides, override)
      call change_parameters(reading%deck, overrides, is_touched, is_done)
      call check_true(error, is_done, override//" is taken")
      if (allocated(error)) return
      found = ""
      do k = 1, size(is_touched)
         if (is_touched(k)) found = found//" "//reading%deck%sections(k)%name
      end do
      call check_equal(error, trim(adjustl(found)), expected, "sections that "//override//" touches")
      do k = 1, reading%deck%symbols%n_parameter
         if (reading%deck%symbols%list(k)%name /= "c" .or. override /= "c=2mm") cycle
         call check_close(error, reading%deck%symbols%list(k)%number, 2.0e-3_wp, 1.0e-18_wp, "its value")
      end do
   end subroutine check_touched

   !> What the deck says of a parameter.
   function value_of(name) result(value)
      character(*), intent(in) :: name      !! the parameter
      character(:), allocatable :: value    !! as written

      select case (name)
      case ("c")
         value = "1 mm"
      case ("half")
         value = "0.5 mm"
      case ("speed")
         value = "3"
      case ("c_2")
         value = "5"
      case default
         value = "1"
      end select
   end function value_of

   !> Where more or fewer parameters are set than before the deck must be read anew.
   subroutine test_other_overrides(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: reading
      type(text_t), allocatable :: overrides(:)
      logical, allocatable :: is_touched(:)
      logical :: is_done

      call read_lines(deck, reading)
      allocate (overrides(0))
      call append_text(overrides, "c=2mm")
      call change_parameters(reading%deck, overrides, is_touched, is_done)
      call check_true(error, .not. is_done, "one more is refused")
   end subroutine test_other_overrides

end module test_parameter_change
