!> The words of a figure of a film: `film(JOINT)`, `film(JOINT,end)`, `film(JOINT,minimum)`, `film(JOINT,0.3s)`.
module film_words
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_clearances
   use film_fields, only: field_request_t, film_field_t, moment_at, moment_end, moment_min
   use kind_info, only: dim_time, same_dimension
   use kinds, only: wp
   use numbers, only: number_length
   use spelling, only: nearest_word
   use text, only: append_text, join, text_t
   use units, only: parse_unit, read_quantity, unit_t
   implicit none (type, external)
   private
   public :: film_hint, missing_films, take_film

   character(*), parameter :: film_channel = "film_thickness"  !! what joints with films have
   character(*), parameter :: film_hint = "write film(JOINT) for the end of the run, film(JOINT,least) or "// &
                              "film(JOINT,0.3s)"  !! what would be right

contains

   !> The film of a joint at a moment.
   subroutine take_film(arguments, catalogue, request, message, hint, bad)
      type(text_t), intent(in) :: arguments(:)               !! (1 or 2) joint, and moment
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(field_request_t), intent(inout) :: request        !! joint and moment are set
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank
      character(:), allocatable, intent(out) :: bad          !! the wrong argument, blank: none

      character(:), allocatable :: nearest
      type(text_t), allocatable :: with_film(:)
      integer :: group, k

      allocate (with_film(0))
      group = catalogue%find_group(group_clearances, film_channel)
      do k = 1, size(catalogue%rooms(group_clearances)%names)
         if (group == 0) exit
         if (catalogue%item_has(group, k)) call append_text(with_film, catalogue%rooms(group_clearances)%names(k)%s)
      end do
      bad = ""
      request%joint = arguments(1)%s
      if (.not. any([(with_film(k)%s == arguments(1)%s, k=1, size(with_film))])) then
         bad = arguments(1)%s
         message = "no film of '"//arguments(1)%s//"': it is not a joint with a film"
         nearest = nearest_word(arguments(1)%s, with_film)
         hint = "joints with films: "//join(with_film, " ")
         if (size(with_film) == 0) hint = "this deck has no joint with a film"
         if (len(nearest) > 0) hint = "did you mean 'film("//nearest//")'? "//hint
      else if (size(arguments) == 2) then
         call take_moment(arguments(2)%s, request, message, hint)
         if (len(message) > 0) bad = arguments(2)%s
      end if
   end subroutine take_film

   !> The moment of a film.
   subroutine take_moment(word, request, message, hint)
      character(*), intent(in) :: word                       !! end, minimum or a time with its unit
      type(field_request_t), intent(inout) :: request        !! its moment is set
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      character(:), allocatable :: trouble
      type(unit_t) :: unit
      integer :: first, last, n
      logical :: is_good

      n = number_length(word)
      if (word == "end" .or. word == "least") then
         request%moment = merge(moment_end, moment_min, word == "end")
      else if (n == 0 .or. n == len(word)) then
         message = "'"//word//"' is not a time of a film"
         if (n > 0) message = "the time '"//word//"' of a film has no unit"
         hint = film_hint
      else
         request%moment = moment_at
         call parse_unit(word(n + 1:), unit, trouble, first, last)
         is_good = len(trouble) == 0
         if (is_good) is_good = same_dimension(unit%dimension, dim_time)
         if (is_good) call read_quantity(word(1:n), unit, request%t, is_good)
         if (is_good) is_good = request%t >= 0.0_wp
         if (.not. is_good) then
            message = "'"//word//"' is not within the run"
            hint = film_hint
         end if
      end if
   end subroutine take_moment

   !> Films that were asked for and not found, as text.
   function missing_films(requests, fields) result(warnings)
      type(field_request_t), intent(in) :: requests(:)  !! (n) what was asked for
      type(film_field_t), intent(in) :: fields(:)       !! (any) what was found
      type(text_t), allocatable :: warnings(:)          !! (any) a line for each that is missing

      integer :: i, k

      allocate (warnings(0))
      do k = 1, size(requests)
         if (any([(fields(i)%request%name == requests(k)%name, i=1, size(fields))])) cycle
         call append_text(warnings, "no film of joint '"//requests(k)%joint//"' for "//requests(k)%name// &
                          ": it has no active film, or the run ended before that time")
      end do
   end function missing_films

end module film_words
