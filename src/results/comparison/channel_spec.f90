!> What is compared with what: a channel and the columns that stand for it, as the user writes it.
!>
!>     CHANNEL = COLUMN [COLUMN ...] [KEY=VALUE ...]
!>     slider.position.x = 2 unit=mm
!>     slider.velocity = VX VY scale=-1 turn=30deg
!>     rod.angle = "ANGLE (deg)" offset=90deg modulo=360deg absolute=1e-6 relative=0
!>
!> A quantity with as many columns as it has components is a vector, whose frame may be turned against the world by `turn` about
!> z, or
!> by three turns as `turn=zxz:10deg,20deg,30deg`. The value is A (scale x + offset), x in the unit of the column: `unit`, or what
!> stands in its name, or SI. `TIME = COLUMN [unit=] [scale=] [shift=]` is the same for the time: scale t + shift.
module channel_spec
   use errors, only: error_t, exit_usage, set_error
   use kinds, only: wp
   use numbers, only: number_length, read_number
   use rotations, only: rotation_of_sequence
   use text, only: append_text, segment, text_t
   use units, only: parse_unit, read_quantity, unit_t
   implicit none (type, external)
   private
   public :: parse_spec, read_with_unit, spec_t

   real(wp), parameter :: unit_matrix(3, 3) = &
      reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])   !! no turn [1]

   !> A channel and its columns.
   type :: spec_t
      character(:), allocatable :: channel      !! of the run; a quantity without its component is a vector
      type(text_t), allocatable :: columns(:)   !! (n) names or numbers; none: those of the channel's name
      character(:), allocatable :: unit         !! of the columns; blank: as they say
      real(wp) :: scale = 1.0_wp                !! factor [1]
      real(wp) :: offset = 0.0_wp               !! added, SI [any]
      real(wp) :: modulo = -1.0_wp              !! differences are up to multiples of it; 0: not; negative: the run's way, SI [any]
      real(wp) :: absolute = -1.0_wp            !! difference allowed, SI; negative: as all [any]
      real(wp) :: relative = -1.0_wp            !! the same, of the maximum magnitude; negative: as all [1]
      real(wp) :: turn(3, 3) = unit_matrix      !! (3, 3) frame of the columns to the world [1]
   end type spec_t

contains

   !> Read one.
   subroutine parse_spec(text, is_time, spec, error)
      character(*), intent(in) :: text                     !! as the user writes it
      logical, intent(in) :: is_time                       !! there is no channel and no equals sign
      type(spec_t), intent(out) :: spec                    !! what it says
      type(error_t), allocatable, intent(out) :: error     !! what is wrong

      character(:), allocatable :: rest
      type(text_t), allocatable :: words(:)
      integer :: at, k

      allocate (spec%columns(0))
      spec%unit = ""
      spec%channel = "time"
      rest = text
      if (.not. is_time) then
         at = index(text, "=")
         spec%channel = trim(adjustl(text))
         if (at > 0) spec%channel = trim(adjustl(text(:at - 1)))
         rest = ""
         if (at > 0) rest = text(at + 1:)
      end if
      if (spec%channel == "" .or. scan(spec%channel, " ,") > 0) then
         call set_error(error, exit_usage, "'"//text//"' has no channel name: write CHANNEL=COLUMN, as ""rod.angle=3 unit=deg""")
         return
      end if
      call split_words(rest, words)
      do k = 1, size(words)
         at = index(words(k)%s, "=")
         if (at > 1 .and. .not. is_quoted(words(k)%s)) then
            call take_key(words(k)%s(:at - 1), words(k)%s(at + 1:), spec, error)
            if (allocated(error)) error%message = error%message//new_line("a")//"  = in '"//text//"'"
            if (allocated(error)) return
         else
            call append_text(spec%columns, without_quotes(words(k)%s))
         end if
      end do
   end subroutine parse_spec

   !> Words between blanks; quotes keep blanks in.
   subroutine split_words(text, words)
      character(*), intent(in) :: text                       !! any text
      type(text_t), allocatable, intent(out) :: words(:)     !! (n) with their quotes

      character(:), allocatable :: word
      character :: quote
      integer :: i

      allocate (words(0))
      word = ""
      quote = " "
      do i = 1, len(text)
         if (quote == " " .and. text(i:i) == " ") then
            if (word /= "") call append_text(words, word)
            word = ""
         else
            if (quote == " ") then
               if (scan(text(i:i), """'") > 0) quote = text(i:i)
            else if (text(i:i) == quote) then
               quote = " "
            end if
            word = word//text(i:i)
         end if
      end do
      if (word /= "") call append_text(words, word)
   end subroutine split_words

   !> Whether a word stands in quotes.
   pure logical function is_quoted(word)
      character(*), intent(in) :: word  !! a word

      is_quoted = scan(word(1:1), """'") > 0
   end function is_quoted

   !> A word without the quotes around it.
   pure function without_quotes(word) result(bare)
      character(*), intent(in) :: word      !! a word
      character(:), allocatable :: bare     !! what is between them

      bare = word
      if (is_quoted(word) .and. len(word) > 1) bare = segment(word, 2, len(word) - 1)
   end function without_quotes

   !> Take a key and its value.
   subroutine take_key(key, value, spec, error)
      character(*), intent(in) :: key                      !! the key
      character(*), intent(in) :: value                    !! its value
      type(spec_t), intent(inout) :: spec                  !! set
      type(error_t), allocatable, intent(out) :: error     !! unknown key, or no such value

      character(:), allocatable :: message
      type(unit_t) :: unit
      integer :: first, last
      logical :: is_good

      is_good = .true.
      select case (key)
      case ("unit")
         spec%unit = without_quotes(value)
         call parse_unit(spec%unit, unit, message, first, last)
         if (message /= "") call set_error(error, exit_usage, message)
         return
      case ("scale"); call read_plain(value, spec%scale, is_good)
      case ("offset", "shift"); call read_with_unit(value, spec%offset, is_good)
      case ("modulo"); call read_with_unit(value, spec%modulo, is_good)
      case ("absolute"); call read_with_unit(value, spec%absolute, is_good)
      case ("relative"); call read_plain(value, spec%relative, is_good)
      case ("turn"); call read_turn(value, spec%turn, is_good)
      case default
         call set_error(error, exit_usage, "unknown key '"//key//"'"//new_line("a")// &
                        "  = valid keys: unit scale offset shift modulo absolute relative turn")
         return
      end select
      if (.not. is_good) call set_error(error, exit_usage, "'"//value//"' is not a value of "//key)
   end subroutine take_key

   !> A number without a unit.
   subroutine read_plain(value, x, is_good)
      character(*), intent(in) :: value     !! the text
      real(wp), intent(inout) :: x          !! the number [any]
      logical, intent(out) :: is_good       !! whether it is one

      real(wp) :: y

      is_good = number_length(value) == len(value) .and. len(value) > 0
      if (is_good) call read_number(value, 0, y, is_good)
      if (is_good) x = y
   end subroutine read_plain

   !> A number with its unit, or one in SI.
   subroutine read_with_unit(value, x, is_good)
      character(*), intent(in) :: value     !! the text
      real(wp), intent(inout) :: x          !! the number, SI [any]
      logical, intent(out) :: is_good       !! whether it is one

      character(:), allocatable :: message
      type(unit_t) :: unit
      real(wp) :: y
      integer :: first, last, n

      n = number_length(value)
      is_good = n > 0
      if (.not. is_good) return
      if (n < len(value)) then
         call parse_unit(trim(adjustl(value(n + 1:))), unit, message, first, last)
         is_good = message == ""
         if (is_good) call read_quantity(value(:n), unit, y, is_good)
      else
         call read_number(value, 0, y, is_good)
      end if
      if (is_good) x = y
   end subroutine read_with_unit

   !> A turn about z, or three turns.
   subroutine read_turn(value, turn, is_good)
      character(*), intent(in) :: value          !! as `30deg` or `zxz:10deg,20deg,30deg`
      real(wp), intent(inout) :: turn(3, 3)      !! (3, 3) the rotation [1]
      logical, intent(out) :: is_good            !! whether it is one

      character(:), allocatable :: rest
      character(3) :: sequence
      real(wp) :: angles(3)
      integer :: at, k

      angles = 0.0_wp
      sequence = "zxz"
      if (index(value, ":") == 0) then
         call read_with_unit(value, angles(1), is_good)
      else
         is_good = index(value, ":") == 4
         if (is_good) sequence = value(:3)
         is_good = is_good .and. verify(sequence, "xyz") == 0
         rest = value(index(value, ":") + 1:)//","
         do k = 1, 3
            at = index(rest, ",")
            if (.not. is_good .or. at < 2) exit
            call read_with_unit(rest(:at - 1), angles(k), is_good)
            rest = segment(rest, at + 1, len(rest))
         end do
         is_good = is_good .and. k == 4
      end if
      if (is_good) turn = rotation_of_sequence(sequence, angles)
   end subroutine read_turn

end module channel_spec
