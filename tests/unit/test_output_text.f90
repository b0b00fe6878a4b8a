!> Text that goes out: for gnuplot, for JSON, in units that read well; events by time.
module test_output_text
   use check, only: check_close, check_equal, check_true, suite_t
   use display_units, only: choose_unit, display_unit_t
   use decimal_text, only: decimal_width
   use errors, only: error_t
   use event_list, only: event_list_t, n_event_numbers
   use html_text, only: base_64
   use json_text, only: json_object_t, json_string
   use kinds, only: not_a_number, pi, wp
   use plot_text, only: quoted, valid_utf8
   use recorder, only: event_t
   use text_table, only: put_row_of_numbers
   implicit none (type, external)
   private
   public :: run_test_output_text

contains

   subroutine run_test_output_text(suite)
      type(suite_t), intent(inout) :: suite  !! tests of the program

      call suite%test("nothing_escapes_the_quotes", nothing_escapes_the_quotes)
      call suite%test("bytes_become_utf8", bytes_become_utf8)
      call suite%test("json_is_escaped", json_is_escaped)
      call suite%test("bytes_in_base_64", bytes_in_base_64)
      call suite%test("units_read_well", units_read_well)
      call suite%test("numbers_read_back", numbers_read_back)
      call suite%test("events_are_sorted", events_are_sorted)
   end subroutine run_test_output_text

   subroutine nothing_escapes_the_quotes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(:), allocatable :: text
      integer :: code

      call check_equal(error, quoted("it's `ls` ""$x"" \"), "'it’s `ls` ""$x"" \'", "hostile text")
      call check_equal(error, quoted("a"//new_line("a")//"!ls"), "'a !ls'", "lines")
      call check_equal(error, quoted("é漢"), "'é□'", "letters the font lacks")
      call check_equal(error, quoted(repeat("x", 200)), "'"//repeat("x", 90)//"…'", "long text")
      do code = 0, 255
         text = quoted(achar(code)//"b")
         call check_true(error, scan(text(2:len(text) - 1), "'"//new_line("a")//achar(0)//achar(13)) == 0, "any byte")
      end do
   end subroutine nothing_escapes_the_quotes

   subroutine bytes_become_utf8(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_equal(error, valid_utf8("ä√🚀"), "ä√🚀", "valid text stays")
      call check_equal(error, valid_utf8(char(255)//"a"//char(195)), "?a?", "stray bytes")
      call check_equal(error, valid_utf8(char(192)//char(128)), "??", "overlong")
      call check_equal(error, valid_utf8(char(237)//char(160)//char(128)), "???", "surrogate")
   end subroutine bytes_become_utf8

   subroutine json_is_escaped(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(json_object_t) :: json

      call check_equal(error, json_string("a""b\c"//new_line("a")//achar(1)//"ä"), """a\""b\\c\n\u0001ä""", "string")
      call json%start(0)
      call json%put_real("x", 0.1_wp)
      call json%put_real("y", not_a_number())
      call json%put_logical("z", .false.)
      call check_equal(error, json%get(), "{"//new_line("a")//"  ""x"": 0.1,"//new_line("a")//"  ""y"": null,"// &
                       new_line("a")//"  ""z"": false"//new_line("a")//"}", "object")
   end subroutine json_is_escaped

   !> The examples of RFC 4648, section 10, and every byte there and back by its bits.
   subroutine bytes_in_base_64(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_equal(error, base_64(""), "", "nothing")
      call check_equal(error, base_64("f"), "Zg==", "one byte")
      call check_equal(error, base_64("fo"), "Zm8=", "two")
      call check_equal(error, base_64("foo"), "Zm9v", "three")
      call check_equal(error, base_64("foobar"), "Zm9vYmFy", "six")
      call check_equal(error, base_64(char(255)//char(254)//char(0)), "//4A", "bytes beyond letters")
   end subroutine bytes_in_base_64

   !> Check the unit chosen for a quantity.
   subroutine check_unit(error, si, extent, symbol, factor)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: si                      !! unit in files
      real(wp), intent(in) :: extent                      !! largest value, SI [any]
      character(*), intent(in) :: symbol                  !! what must be chosen
      real(wp), intent(in) :: factor                      !! and its factor [any]

      type(display_unit_t) :: unit

      unit = choose_unit(si, extent)
      call check_equal(error, unit%symbol, symbol, "unit for "//si)
      call check_close(error, unit%factor, factor, 0.0_wp, "factor for "//si)
   end subroutine check_unit

   subroutine units_read_well(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(display_unit_t) :: unit
      integer :: power

      call check_unit(error, "s", 0.024_wp, "ms", 1.0e3_wp)
      call check_unit(error, "s", 5.0_wp, "s", 1.0_wp)
      call check_unit(error, "m", 5.0e-4_wp, "mm", 1.0e3_wp)
      call check_unit(error, "m", 1.0e-5_wp, "µm", 1.0e6_wp)
      call check_unit(error, "m/s", 0.5_wp, "m/s", 1.0_wp)
      call check_unit(error, "m/s", 5.0e-3_wp, "mm/s", 1.0e3_wp)
      call check_unit(error, "m/s", 2.0e-5_wp, "µm/s", 1.0e6_wp)
      call check_unit(error, "m/s", 2.6e-9_wp, "nm/s", 1.0e9_wp)
      call check_unit(error, "J", 3.0e-9_wp, "nJ", 1.0e9_wp)
      call check_unit(error, "N", 20924.979_wp, "kN", 1.0e-3_wp)
      call check_unit(error, "N", 4.0e6_wp, "MN", 1.0e-6_wp)
      call check_unit(error, "N.m", 300.0_wp, "N·m", 1.0_wp)
      call check_unit(error, "m/s^2", 9.0e3_wp, "m/s²", 1.0_wp)
      call check_unit(error, "m/s^2", 3.0e5_wp, "10³ m/s²", 1.0e-3_wp)
      call check_unit(error, "m", 0.0_wp, "m", 1.0_wp)
      call check_unit(error, "1", 3.0_wp, "", 1.0_wp)
      call check_unit(error, "rad", 3.0_wp, "deg", 180.0_wp/pi)
      call check_unit(error, "rad", 2.0e-4_wp, "mrad", 1.0e3_wp)
      call check_unit(error, "J", 1.5e-10_wp, "nJ", 1.0e9_wp)
      call check_unit(error, "J", 2.0e-13_wp, "pJ", 1.0e12_wp)
      call check_unit(error, "m/s", 3.0e-9_wp, "nm/s", 1.0e9_wp)
      call check_unit(error, "m/s", 3.0e-12_wp, "pm/s", 1.0e12_wp)
      call check_unit(error, "m^3/s", 2.0e-6_wp, "cm³/s", 1.0e6_wp)
      call check_unit(error, "N/m", 2.0e8_wp, "10⁶ N/m", 1.0e-6_wp)
      call check_unit(error, "kg.m^2", 2.0e-5_wp, "10⁻⁶ kg·m²", 1.0e6_wp)
      call check_unit(error, "N/m^1.5", 3.0_wp, "N/m^1.5", 1.0_wp)
      call check_unit(error, "m^0.5.s", 3.0_wp, "m^0.5·s", 1.0_wp)
      call check_unit(error, "kg.s^-0.5", 2.0e6_wp, "10⁶ kg·s^-0.5", 1.0e-6_wp)
      call check_unit(error, "m^2.s^-2", 3.0_wp, "m²·s⁻²", 1.0_wp)
      call check_unit(error, "kg^2.m^2.s^-4", 3.0_wp, "kg²·m²·s⁻⁴", 1.0_wp)
      call check_unit(error, "kg.s^-3", 2.0e6_wp, "10⁶ kg·s⁻³", 1.0e-6_wp)
      do power = -14, 9  ! never more than five digits before the point, nor zeros behind it
         unit = choose_unit("N", 3.0_wp*10.0_wp**power)
         call check_true(error, unit%factor*3.0_wp*10.0_wp**power >= 0.009_wp .and. unit%factor*3.0_wp*10.0_wp**power < 1.0e4_wp, &
                         unit%symbol)
      end do
   end subroutine units_read_well

   subroutine numbers_read_back(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: numbers(5) = [1.0_wp/3.0_wp, -1.0e-300_wp, 1.0e300_wp, 0.0_wp, -2.0_wp]
      character(200) :: line
      real(wp) :: back(5)

      call put_row_of_numbers(numbers, line)
      read (line(1:5*decimal_width), *) back
      call check_close(error, back, numbers, 0.0_wp, "numbers")
      call put_row_of_numbers([not_a_number()], line)
      call check_equal(error, line(1:decimal_width), repeat(" ", decimal_width - 4)//"NaN ", "not a number")
   end subroutine numbers_read_back

   subroutine events_are_sorted(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(event_list_t) :: events
      type(event_t) :: event
      integer, parameter :: n = 2500  ! of several blocks
      real(wp) :: numbers(n_event_numbers), times(n)
      integer, allocatable :: order(:)
      integer :: k
      logical :: is_added

      call check_equal(error, size(events%order_by_onset()), 0, "no events")
      do k = 1, n
         times(k) = real(mod(37*k, 50), wp)
         event%time = times(k)
         event%peak_penetration_time = real(k, wp)
         event%item = "pin"
         call events%add(event, is_added)
      end do
      order = events%order_by_onset()
      do k = 1, n
         numbers = events%numbers(k)
         call check_true(error, all(numbers([1, n_event_numbers]) >= [times(k), real(k, wp)]), "its own numbers")
         call check_true(error, all(numbers([1, n_event_numbers]) <= [times(k), real(k, wp)]), "its own numbers")
      end do
      do k = 2, n
         call check_true(error, times(order(k - 1)) <= times(order(k)), "by time")
         if (times(order(k - 1)) < times(order(k))) cycle
         call check_true(error, order(k - 1) < order(k), "equal times as told")
      end do
      call check_equal(error, events%word(7, 2)//events%word(7, 1), "pin", "words")
   end subroutine events_are_sorted

end module test_output_text
