!> The arguments of figures that draw the mechanism, and the moment of a film.
!>
!> `mechanism` at the end, `mechanism(t=1ms,2ms)` at instants; `strip(n=8)`: n positions over a turn of the first driver, or over
!> `last=2turnsofmotor` or a time; `coupler(POINT)`: the path of a point of the deck, over all that is written or over `last=...`;
!> `animation(last=1turnsofmotor)`, with n pictures. All take `names=on` or `names=off`. `film(JOINT)`,
!> `film(JOINT,end)`, `film(JOINT,least)`, `film(JOINT,0.3s)`.
module motion_words
   use figure_phrase, only: mistake_t, set_mistake
   use film_fields, only: field_request_t, moment_at, moment_end, moment_min
   use kind_info, only: dim_time, same_dimension
   use kinds, only: wp
   use numbers, only: number_length
   use text, only: segment, starts_with, text_t
   use units, only: parse_unit, read_quantity, unit_t
   implicit none (type, external)
   private
   public :: film_hint, motion_hint, motion_request_t, names_if_few, names_on, read_moment, read_motion

   integer, parameter :: most_pictures = 200  !! of one figure
   integer, parameter :: names_if_few = 0     !! names are shown unless there are many
   integer, parameter :: names_on = 1         !! names are shown
   integer, parameter :: names_off = 2        !! they are not
   character(*), parameter :: motion_hint = "write mechanism(t=1ms,2ms), strip(n=8), coupler(POINT) or "// &
                              "animation(last = 1 turns of DRIVER); strip, coupler and animation take n=... and last=..., "// &
                              "all take names=on or names=off"
   character(*), parameter :: film_hint = "write film(JOINT) for the end of the run, film(JOINT,least) or "// &
                              "film(JOINT,0.3s)"  !! what would be right

   !> What a figure of the mechanism asks for.
   type :: motion_request_t
      real(wp), allocatable :: times(:)        !! (any) instants that are named [s]
      integer :: n = 0                         !! pictures; 0: as many as is usual
      integer :: names = names_if_few          !! whether it has the names of bodies, joints and points, as below
      real(wp) :: last = 0.0_wp                !! length of the window; 0: as is usual [s, or turns of the driver]
      character(:), allocatable :: driver      !! whose turns these are; blank: `last` is a time
      character(:), allocatable :: point       !! whose path is drawn; blank: none
   end type motion_request_t

contains

   !> Read the arguments of a figure of the mechanism.
   subroutine read_motion(arguments, with_point, request, mistake)
      type(text_t), intent(in) :: arguments(:)               !! (any) what stands between commas
      logical, intent(in) :: with_point                      !! the first of them is a point
      type(motion_request_t), intent(out) :: request         !! what they ask for
      type(mistake_t), allocatable, intent(out) :: mistake   !! what is wrong

      character(:), allocatable :: message
      integer :: k

      message = ""
      request%driver = ""
      request%point = ""
      allocate (request%times(0))
      if (with_point) request%point = arguments(1)%s
      do k = merge(2, 1, with_point), size(arguments)
         associate (word => arguments(k)%s)
            if (starts_with(word, "n=")) then
               call read_count(segment(word, 3), request, message)
            else if (word == "names=on" .or. word == "names=off") then
               request%names = merge(names_on, names_off, word == "names=on")
            else if (starts_with(word, "last=")) then
               call read_window(segment(word, 6), request, message)
            else
               call add_time(segment(word, merge(3, 1, starts_with(word, "t="))), request, message)
            end if
            if (len(message) > 0) call set_mistake(mistake, message, motion_hint, word)
         end associate
         if (allocated(mistake)) return
      end do
      if (size(request%times) > most_pictures) call set_mistake(mistake, "too many times for one figure", motion_hint, "")
   end subroutine read_motion

   !> Read the moment of a film.
   subroutine read_moment(word, request, mistake)
      character(*), intent(in) :: word                       !! end, least or a time with its unit
      type(field_request_t), intent(inout) :: request        !! its moment is set
      type(mistake_t), allocatable, intent(out) :: mistake   !! what is wrong

      character(:), allocatable :: trouble
      integer :: n

      n = number_length(word)
      trouble = ""
      if (word == "end" .or. word == "least") then
         request%moment = merge(moment_end, moment_min, word == "end")
      else if (n == 0) then
         trouble = "'"//word//"' is not a time of a film"
      else if (n == len(word)) then
         trouble = "the time '"//word//"' of a film has no unit"
      else
         request%moment = moment_at
         call read_time(word, request%t, trouble)
         if (len(trouble) > 0) trouble = "'"//word//"' is not within the run"
      end if
      if (len(trouble) > 0) call set_mistake(mistake, trouble, film_hint, word)
   end subroutine read_moment

   !> A number of pictures.
   subroutine read_count(word, request, message)
      character(*), intent(in) :: word                       !! digits
      type(motion_request_t), intent(inout) :: request       !! its number is set
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing

      integer :: status

      status = 1
      if (len(word) > 0 .and. len(word) < 5 .and. verify(word, "0123456789") == 0) read (word, *, iostat=status) request%n
      if (status == 0 .and. request%n >= 2 .and. request%n <= most_pictures) return
      message = "'n="//word//"' is not a number of pictures from 2 to 200"
   end subroutine read_count

   !> The length of a window: a time, or turns of a driver.
   subroutine read_window(word, request, message)
      character(*), intent(in) :: word                       !! as `2ms`, `1turnsofmotor`
      type(motion_request_t), intent(inout) :: request       !! its window is set
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing

      character(*), parameter :: turns(2) = [character(7) :: "turnsof", "turnof"]
      integer :: k, n, status
      logical :: is_in(2)

      n = number_length(word)
      is_in = [(starts_with(segment(word, n + 1), trim(turns(k))), k=1, 2)]
      if (n > 0 .and. any(is_in)) then
         request%driver = segment(word, n + 1 + len_trim(turns(findloc(is_in, .true., dim=1))))
         read (word(:n), *, iostat=status) request%last
         if (status /= 0 .or. len(request%driver) == 0) message = "'last="//word//"' is not a number of turns of a driver"
      else
         call read_time(word, request%last, message)
      end if
      if (len(message) == 0 .and. .not. request%last > 0.0_wp) message = "'last="//word//"' is not positive"
   end subroutine read_window

   !> Append an instant.
   subroutine add_time(word, request, message)
      character(*), intent(in) :: word                       !! as `1ms`
      type(motion_request_t), intent(inout) :: request       !! its times grow
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing

      real(wp) :: t

      call read_time(word, t, message)
      if (len(message) > 0) return
      if (size(request%times) > 0) then
         if (t <= request%times(size(request%times))) message = "times must increase: '"//word//"' does not"
      end if
      request%times = [request%times, t]
   end subroutine add_time

   !> A time with its unit.
   subroutine read_time(word, t, message)
      character(*), intent(in) :: word                       !! as `1ms`
      real(wp), intent(out) :: t                             !! the time [s]
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing

      character(:), allocatable :: trouble
      type(unit_t) :: unit
      integer :: first, last, n
      logical :: is_good

      t = 0.0_wp
      n = number_length(word)
      is_good = n > 0 .and. n < len(word)
      if (is_good) then
         call parse_unit(word(n + 1:), unit, trouble, first, last)
         is_good = len(trouble) == 0
         if (is_good) is_good = same_dimension(unit%dimension, dim_time)
         if (is_good) call read_quantity(word(1:n), unit, t, is_good)
         if (is_good) is_good = t >= 0.0_wp
      end if
      if (.not. is_good) message = "'"//word//"' is not a time of the run with its unit"
   end subroutine read_time

end module motion_words
