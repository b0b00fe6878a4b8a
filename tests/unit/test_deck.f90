!> Decks: values in SI, defaults, overrides, includes, messages, and the echo that reads back.
module test_deck
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_fixture, only: read_all, read_lines, reading_t
   use deck_texts, only: deck_text, get_includes
   use deck_types, only: location_of_end
   use diagnostics, only: diagnostics_t
   use echo, only: all_defaults, echo_start, get_parameters
   use errors, only: error_t, exit_deck
   use file_path, only: beside, plain_path
   use item, only: location_t
   use kinds, only: pi, wp
   use settings, only: has_section
   use source_text, only: new_source, source_t
   use text, only: join, replace, text_t, to_text
   implicit none (type, external)
   private
   public :: run_test_deck

   character, parameter :: nl = new_line("a")
   character(*), parameter :: good = "deck = 1 # version"//nl//"[scene]"//nl//"title = ""A \""good\"" deck # 1"" # comment"//nl &
      & //"gravity = 0 {-g} m/s^2"//nl//nl//"[parameters]"//nl//"c = 0.5 mm"//nl//"half={c/2}"//nl//"g = 9.81 m/s^2"//nl &
      & //"way=slow"//nl//"w = {2*pi*50 Hz}"//nl//"turns = 3"//nl//nl//"[bodies]"//nl &
      & //"name   x[mm] mass[g] parent fixed"//nl//"crank  25    0.1kg  -      on"//nl//"rod    {half} {10 g*2} crank  off"//nl &
      & //"   pin 0.1m  1e2    rod    -"//nl//"[driver.angle]"//nl//"name body angle[deg]"//nl//"a crank 90"//nl &
      & //"b rod {30deg*sin(w*t) + w*t}"//nl//"[output]"//nl//"end = {turns} turns of motor"//nl &
      & //"channels = crank.* portrait( a.x, b.y ) {way}"//nl//"method = {way} beta={1/(10 ms)} file=""a b"""//nl &
      & //"last = 24 ms"

contains

   !> All tests of this file.
   subroutine run_test_deck(suite)
      type(suite_t), intent(inout) :: suite  !! the suite

      call suite%test("numbers", test_numbers)
      call suite%test("words", test_words)
      call suite%test("expressions", test_expressions)
      call suite%test("defaults", test_defaults)
      call suite%test("overrides", test_overrides)
      call suite%test("echo", test_echo)
      call suite%test("line_ends", test_line_ends)
      call suite%test("split_tables", test_split_tables)
      call suite%test("file_paths", test_file_paths)
      call suite%test("rendering", test_rendering)
      call suite%test("rendering_of_odd_lines", test_rendering_of_odd_lines)
      call suite%test("many_mistakes", test_many_mistakes)
      call suite%test("several_mistakes", test_several_mistakes)
      call suite%test("mistakes_of_defaults", test_mistakes_of_defaults)
      call suite%test("unreadable", test_unreadable)
      call suite%test("records", test_records)
   end subroutine run_test_deck

   !> Numbers with every sort of unit.
   subroutine test_numbers(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r

      call read_lines(good, r)
      call check_equal(error, r%message, "", "no mistakes")
      if (allocated(error)) return
      call check_equal(error, size(r%bodies), 3, "bodies")
      call check_close(error, r%bodies(1)%values(1)%number, 0.1_wp, 0.0_wp, "a unit in the cell goes before the header")
      call check_close(error, r%bodies(1)%values(2)%number, 0.025_wp, 0.0_wp, "a unit in the header")
      call check_close(error, r%bodies(2)%values(1)%number, 0.02_wp, 1.0e-17_wp, "an expression with a unit")
      call check_close(error, r%bodies(2)%values(2)%number, 0.25e-3_wp, 0.0_wp, "a parameter made from another")
      call check_close(error, r%bodies(3)%values(1)%number, 0.1_wp, 0.0_wp, "an exponent")
      call check_close(error, r%bodies(3)%values(2)%number, 0.1_wp, 0.0_wp, "another unit than in the header")
      call check_close(error, r%bodies(3)%values(3)%number, 1.0e9_wp, 0.0_wp, "a default")
      call check_close(error, r%scene%values(2)%vector%x(1:2), [0.0_wp, -9.81_wp], 0.0_wp, "a vector")
      call check_equal(error, r%scene%values(2)%vector%n, 2, "its size")
      call check_close(error, r%scene%values(3)%number, 293.15_wp, 1.0e-13_wp, "a temperature")
      call check_close(error, r%output%values(1)%number, 3.0_wp, 0.0_wp, "a number of turns")
      call check_equal(error, r%output%values(1)%text, "motor", "reference of turns")
      call check_close(error, r%output%values(2)%number, 0.024_wp, 0.0_wp, "a time")
      call check_equal(error, r%output%values(2)%text, "", "not in turns")
   end subroutine test_numbers

   !> Words, lists of words, options, flags, names.
   subroutine test_words(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r

      call read_lines(good, r)
      call check_equal(error, r%message, "", "no mistakes")
      if (allocated(error)) return
      call check_equal(error, r%scene%values(1)%text, "A ""good"" deck # 1", "a title in quotes")
      call check_equal(error, r%bodies(3)%name, "pin", "a name")
      call check_equal(error, r%bodies(3)%kind, "bodies", "a kind")
      call check_equal(error, r%bodies(3)%location%line, 18, "its line")
      call check_equal(error, r%bodies(3)%location%first, 4, "its column")
      call check_equal(error, r%bodies(2)%values(4)%text, "crank", "a reference")
      call check_equal(error, r%bodies(1)%values(4)%text, "", "a blank default")
      call check_true(error, .not. r%bodies(1)%values(4)%given, "it was not given")
      call check_true(error, r%bodies(1)%values(5)%flag .and. .not. r%bodies(2)%values(5)%flag, "flags")
      call check_equal(error, join(r%output%values(3)%words, "|"), "crank.*|portrait(a.x,b.y)|slow", "a list of words")
      call check_equal(error, r%output%values(3)%places(2)%first, 20, "place of a word")
      call check_equal(error, r%output%values(3)%places(2)%last, 39, "its end")
      call check_equal(error, r%output%values(4)%text, "slow", "a word from a parameter")
      call check_equal(error, size(r%output%values(4)%options), 2, "options")
      call check_equal(error, r%output%values(4)%options(1)%name, "beta", "name of an option")
      call check_close(error, r%output%values(4)%options(1)%number, 100.0_wp, 1.0e-13_wp, "its number in SI")
      call check_true(error, .not. r%output%values(4)%options(2)%is_number, "an option that is text")
      call check_equal(error, r%output%values(4)%options(2)%text, "a b", "its text")
   end subroutine test_words

   !> Expressions in the time, and constants in their place.
   subroutine test_expressions(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r
      real(wp) :: d1, d2, x

      call read_lines(good, r)
      call check_equal(error, r%message, "", "no mistakes")
      if (allocated(error)) return
      call check_true(error, r%drivers(1)%values(2)%expression%is_constant, "a number is a constant expression")
      call r%drivers(1)%values(2)%expression%evaluate(1.0_wp, x, d1, d2)
      call check_close(error, [x, d1, d2], [pi/2.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, "its value")
      call r%drivers(2)%values(2)%expression%evaluate(0.0_wp, x, d1, d2)
      call check_close(error, [x, d1, d2], [0.0_wp, 100.0_wp*pi*(1.0_wp + pi/6.0_wp), 0.0_wp], 1.0e-12_wp, "an expression")
      call check_close(error, r%drivers(2)%values(2)%number, 0.0_wp, 0.0_wp, "its number is that at t = 0")
   end subroutine test_expressions

   !> Defaults are filled in, marked, and listed.
   subroutine test_defaults(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r

      call read_lines("deck = 1"//nl//"[bodies]"//nl//"name mass[kg]"//nl//"a 1"//nl//"[output]"//nl//"end = 1s", r)
      call check_equal(error, r%message, "", "no mistakes")
      if (allocated(error)) return
      call check_close(error, r%scene%values(2)%vector%x(2), -9.81_wp, 0.0_wp, "a section that is not there")
      call check_true(error, .not. r%scene%values(2)%given, "a default is not given")
      call check_true(error, r%bodies(1)%values(1)%given, "a value is given")
      call check_equal(error, r%bodies(1)%values(3)%location%line, 4, "a default stands where the row stands")
      call check_equal(error, r%output%values(4)%options(1)%name, "alpha", "an option of a default")
      call check_equal(error, join(all_defaults(r%deck), "|"), "scene title = """"|scene gravity = 0 -9.81 m/s^2" &
                     & //"|scene temperature = 20 degC|bodies a x = 0 m|bodies a stiffness = 1e9 N/m^1.5|bodies a fixed = off" &
                     & //"|output channels = *|output method = fast alpha=5s^-1|output factor = 1", "list of defaults")
   end subroutine test_defaults

   !> The command line changes parameters, and what is made from them.
   subroutine test_overrides(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r

      call read_lines(good, r, "c = 0.1 mm")
      call check_close(error, r%bodies(2)%values(2)%number, 0.05e-3_wp, 1.0e-19_wp, "half of a parameter that was set")
      call read_lines(good, r, "c={1 cm*turns}")
      call check_true(error, index(r%message, "unknown parameter 'turns'") > 0, "only earlier parameters are known")
      call read_lines(good, r, "way=fast")
      call check_equal(error, r%output%values(4)%text, "fast", "a word that was set")
      call read_lines(good, r, "w=50rpm")
      call check_equal(error, r%message, "", "a soft parameter takes radians")
      call read_lines(good, r, "wy=fast")
      call check_true(error, index(r%message, "did you mean 'way'?") > 0, "a misspelt parameter")
      call read_lines(good, r, "c=0.1")
      call check_true(error, index(r%message, "parameter 'c' is a length [m] in the deck") > 0, "missing unit")
      call check_equal(error, r%n_mistake, 1, "only this is reported")
   end subroutine test_overrides

   !> The echo reads back to an echo that is the same.
   subroutine test_echo(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: again, r
      real(wp) :: x(3), y(3)

      call read_lines(good, r)
      call read_lines(r%echo, again)
      call check_equal(error, again%message, "", "the echo is a deck")
      if (allocated(error)) return
      call check_equal(error, again%echo, r%echo, "echo of the echo")
      call check_equal(error, again%scene%values(1)%text, r%scene%values(1)%text, "title")
      call check_close(error, again%bodies(2)%values(2)%number, r%bodies(2)%values(2)%number, 0.0_wp, "a number")
      call r%drivers(2)%values(2)%expression%evaluate(0.123_wp, x(1), x(2), x(3))
      call again%drivers(2)%values(2)%expression%evaluate(0.123_wp, y(1), y(2), y(3))
      call check_close(error, y, x, 0.0_wp, "an expression with a soft parameter")
      call check_true(error, index(r%echo, "end      = 3 turns of motor"//nl) > 0, "turns")
      call check_true(error, index(r%echo, "method   = slow beta=100s^-1 file=""a b"""//nl) > 0, "options")
      call check_equal(error, index(echo_start(r%deck), "deck = 1"//nl//nl//"[parameters]"//nl//"c = 0.5 mm"//nl), 1, "start")
   end subroutine test_echo

   !> CR LF, tabs, a byte order mark and a missing last line end change nothing.
   subroutine test_line_ends(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      character(3) :: mark
      type(reading_t) :: r

      mark = char(239)//char(187)//char(191)
      call read_lines(mark//"deck = 1"//achar(13)//nl//"[bodies] "//achar(13)//nl//"name"//achar(9)//"mass[kg]"//achar(13)//nl &
                    & //achar(9)//"a"//achar(9)//"1"//achar(13)//nl//"[output]"//nl//"end=1s"//achar(13), r)
      call check_equal(error, r%message, "", "no mistakes")
      if (allocated(error)) return
      call check_equal(error, r%bodies(1)%name, "a", "a name between tabs")
      call check_equal(error, r%bodies(1)%location%first, 2, "a tab is one column")
      call check_close(error, r%output%values(1)%number, 1.0_wp, 0.0_wp, "the last line")
   end subroutine test_line_ends

   !> Tables that stand twice are joined, each with its own header.
   subroutine test_split_tables(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r

      call read_lines("deck = 1"//nl//"[bodies]"//nl//"name mass[kg]"//nl//"a 1"//nl//"[output]"//nl//"end = 1s"//nl &
                    & //"[bodies]"//nl//"x[mm] mass[g] name"//nl//"5 7 b", r)
      call check_equal(error, r%message, "", "no mistakes")
      if (allocated(error)) return
      call check_equal(error, size(r%bodies), 2, "rows")
      call check_close(error, r%bodies(2)%values(1)%number, 0.007_wp, 0.0_wp, "mass")
      call check_close(error, r%bodies(2)%values(2)%number, 0.005_wp, 0.0_wp, "x")
      call check_true(error, has_section(r%deck, "bodies") .and. .not. has_section(r%deck, "scene"), "has_section")
   end subroutine test_split_tables

   !> Paths of included files.
   subroutine test_file_paths(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call check_equal(error, beside("inputs/a.deck", "shared/b.inc"), "inputs/shared/b.inc", "beside a deck")
      call check_equal(error, beside("a.deck", "b.inc"), "b.inc", "in the same directory")
      call check_equal(error, beside("inputs/a.deck", "/b.inc"), "/b.inc", "an absolute path")
      call check_equal(error, plain_path("./a//b/../c.deck"), "a/c.deck", "a plain path")
      call check_equal(error, plain_path("a/.."), ".", "the directory itself")
      call check_equal(error, plain_path("../../a"), "../../a", "upwards")
      call check_equal(error, plain_path("/a/./b/"), "/a/b", "from the root")
   end subroutine test_file_paths

   !> An error is shown exactly like this.
   subroutine test_rendering(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(diagnostics_t) :: diagnostics
      type(error_t), allocatable :: found
      type(source_t) :: sources(2)

      call new_source(sources(1), "inputs/a.deck", repeat(nl, 49)//"name     bearing   clearence[mm]   level"//nl)
      sources(1)%is_file = .true.
      call new_source(sources(2), "--set c=1", "c=1")
      call diagnostics%add(location_t(2, 1, 3, 3), "third", "no unit")
      call diagnostics%add(location_t(), "last", help="nowhere")
      call diagnostics%add(location_t(1, 50, 20, 28), "unknown column 'clearence'", "not a column", "did you mean 'clearance'?")
      call diagnostics%add(location_t(1, 3, 1, 1), "first")
      call diagnostics%add(location_t(1, 3, 1, 1), "first")
      call check_equal(error, diagnostics%count(), 4, "doubled mistakes count once")
      call diagnostics%to_error(sources, found)
      call check_equal(error, found%code, exit_deck, "exit code")
      call check_equal(error, found%message, "error: first"//nl//" --> inputs/a.deck:3:1"//nl//"  |"//nl//"3 | "//nl//"  | ^" &
         & //nl//nl//"error: unknown column 'clearence'"//nl//"  --> inputs/a.deck:50:20"//nl//"   |"//nl &
         & //"50 | name     bearing   clearence[mm]   level"//nl//"   |                    ^^^^^^^^^ not a column"//nl &
         & //"   = did you mean 'clearance'?"//nl//nl//"error: third"//nl//" --> --set c=1"//nl//"  |"//nl//"  | c=1"//nl &
         & //"  |   ^ no unit"//nl//nl//"error: last"//nl//"  = nowhere", "four mistakes")
   end subroutine test_rendering

   !> Long lines are cut, letters of several bytes count once, control characters are harmless.
   subroutine test_rendering_of_odd_lines(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(diagnostics_t) :: diagnostics
      type(error_t), allocatable :: found
      type(source_t) :: sources(1)

      call new_source(sources(1), "a.deck", repeat("x", 5000)//"HERE"//repeat("y", 100000)//nl//"a"//achar(9)//"b"//achar(27))
      sources(1)%is_file = .true.
      call diagnostics%add(location_t(1, 1, 5001, 5004), "far out", "here")
      call diagnostics%add(location_t(1, 2, 3, 3), "a tab", "there")
      call diagnostics%to_error(sources, found)
      call check_equal(error, found%message, "error: far out"//nl//" --> a.deck:1:5001"//nl//"  |"//nl//"1 | "//repeat("x", 60) &
         & //"HERE"//repeat("y", 56)//nl//"  | "//repeat(" ", 60)//"^^^^ here"//nl//nl//"error: a tab"//nl//" --> a.deck:2:3" &
         & //nl//"  |"//nl//"2 | a"//achar(9)//"b?"//nl//"  |  "//achar(9)//"^ there", "two odd lines")
   end subroutine test_rendering_of_odd_lines

   !> At most 20 are shown, in the order of the deck.
   subroutine test_many_mistakes(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(diagnostics_t) :: diagnostics
      type(error_t), allocatable :: found
      type(source_t) :: sources(1)
      integer :: i

      call new_source(sources(1), "a.deck", repeat("x"//nl, 6000))
      sources(1)%is_file = .true.
      do i = 6000, 1, -1
         call diagnostics%add(location_t(1, i, 1, 1), "mistake "//to_text(i))
      end do
      call diagnostics%to_error(sources, found)
      call check_equal(error, diagnostics%count(), 6000, "all are counted")
      call check_true(error, index(found%message, nl//nl//"... and 5980 more") == len(found%message) - 18, "the rest")
      call check_true(error, index(found%message, "error: mistake 1001"//nl) == 1, "those that are kept are sorted")
   end subroutine test_many_mistakes

   !> Several errors are found in one go, and none follows from another.
   subroutine test_several_mistakes(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r

      call read_lines("deck = 1"//nl//"[parameters]"//nl//"a = 1 kgm"//nl//"b = {2*a}"//nl//"[bodies]"//nl//"name mass[kg] x"//nl &
                    & //"p {a} 0mm"//nl//"q {b} 1"//nl//"p 1 2mm 3"//nl//"r -1 2mm"//nl//"[output]"//nl//"end = 1 m"//nl &
                    & //"methode = fast"//nl//"factor = 2.5"//nl//"[outputs]", r)
      call check_equal(error, r%n_mistake, 9, "number of mistakes in"//nl//r%message)
      call check_equal(error, size(r%bodies), 4, "rows with mistakes are there, so that their names are known")
      call check_equal(error, r%bodies(4)%name, "r", "name of a row with a mistake")
   end subroutine test_several_mistakes

   !> A default that is wrong is an error too, shown with its own text.
   subroutine test_mistakes_of_defaults(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r

      call read_lines("deck = 1"//nl//"[output]"//nl//"end = -1 s"//nl//"factor = 1 2"//nl//"channels = a(b"//nl &
                    & //"method = fast alpha=5bogus beta = 3 beta=4"//nl//"last = 1 turn of", r)
      call check_equal(error, r%n_mistake, 6, "number of mistakes in"//nl//r%message)
      call check_true(error, index(r%message, "-1 s is out of range in key end of output") > 0, "a range")
      call check_true(error, index(r%message, "missing closing parenthesis in key channels of output") > 0, "a parenthesis")
      call check_true(error, index(r%message, "unknown unit 'bogus' in key method of output") > 0, "a unit")
      call check_true(error, index(r%message, "option 'beta' is given twice in key method of output") > 0, "a doubled option")
      call check_true(error, index(r%message, "unclear reference of turns in key last of output") > 0, "turns of nothing")
   end subroutine test_mistakes_of_defaults

   !> What cannot be read at all gives one message and no other.
   subroutine test_unreadable(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(reading_t) :: r
      type(text_t) :: none(0)

      call expect("", "it is empty")
      call expect(nl//"   "//nl, "it is empty")
      call expect("# only"//nl, "the deck is empty")
      call expect("deck = 1"//achar(0), "not a text file")
      call expect(repeat(achar(1)//"a", 100), "not a text file")
      call expect("deck = 2"//nl//"nonsense", "unsupported format version '2'")
      call expect("decks = 1"//nl//"nonsense", "invalid format version")
      call expect("nonsense"//nl//"{", "missing format version")
      call read_all("/", none, r)
      call check_equal(error, r%n_mistake, 1, "mistakes of a directory")
      call check_true(error, index(r%message, "it is a directory") > 0, r%message)
      call read_all("/nowhere/at/all.deck", none, r)
      call check_true(error, index(r%message, "no such file") > 0, r%message)

   contains

      !> One message with some words.
      subroutine expect(whole, words)
         character(*), intent(in) :: whole  !! the deck
         character(*), intent(in) :: words  !! in the message

         type(reading_t) :: bad

         call read_lines(whole, bad)
         call check_equal(error, bad%n_mistake, 1, "mistakes in "//bad%message)
         call check_true(error, index(bad%message, words) > 0, words//" in "//bad%message)
      end subroutine expect

   end subroutine test_unreadable

   !> The deck's own text, its end, its parameters.
   subroutine test_records(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(location_t) :: place
      type(reading_t) :: r
      type(text_t), allocatable :: names(:), values(:)

      call read_lines(good, r, "c=1mm")
      call check_equal(error, deck_text(r%deck), replace(good, "c = 0.5 mm", "c = 1mm   # --set; in the file: 0.5 mm"), &
                       "text in force")
      place = location_of_end(r%deck)
      call check_equal(error, place%line, 27, "last line")
      call check_equal(error, place%first, 13, "behind its end")
      call get_parameters(r%deck, names, values)
      call check_equal(error, join(names, " "), "c half g way w turns", "parameters")
      call check_equal(error, join(values, "|"), "1mm|{c/2}|9.81 m/s^2|slow|{2*pi*50 Hz}|3", "their values")
      call get_includes(r%deck, names, values)
      call check_equal(error, size(names), 0, "no included files")
   end subroutine test_records

end module test_deck
