!> What figures need of a run: channels, once per period or all the time, films, and files of their own.
module figure_needs
   use catalogue, only: catalogue_t
   use channel_names, only: item_name, scalar_t
   use figure_words, only: figure_film, figure_history, figure_portrait, figure_t
   use film_fields, only: field_request_t, film_field_t
   use text, only: append_text, text_t
   use text_writer, only: extra_table_t
   implicit none (type, external)
   private
   public :: extra_tables, film_requests, missing_films, scalars_of

contains

   !> The films that figures need.
   function film_requests(figures) result(list)
      type(figure_t), intent(in) :: figures(:)             !! (n) figures
      type(field_request_t), allocatable :: list(:)        !! (any) films, each once

      integer :: i, k

      allocate (list(0))
      do k = 1, size(figures)
         if (figures(k)%kind /= figure_film) cycle
         if (any([(list(i)%name == figures(k)%name, i=1, size(list))])) cycle
         list = [list, figures(k)%film]
      end do
   end function film_requests

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

   !> The channels of the figures of some kinds.
   function scalars_of(figures, kinds) result(list)
      type(figure_t), intent(in) :: figures(:)         !! (n) figures
      integer, intent(in) :: kinds(:)                  !! (any) kinds
      type(scalar_t), allocatable :: list(:)           !! (any) channels, perhaps more than once

      integer :: k

      allocate (list(0))
      do k = 1, size(figures)
         if (any(kinds == figures(k)%kind)) list = [list, figures(k)%scalars]
      end do
   end function scalars_of

   !> Tables for portraits, and curves over a channel, whose channels are not in the same file.
   function extra_tables(figures, catalogue) result(tables)
      type(figure_t), intent(in) :: figures(:)          !! (n) figures
      type(catalogue_t), intent(in) :: catalogue        !! what can be recorded
      type(extra_table_t), allocatable :: tables(:)     !! (n) tables

      logical :: apart(size(figures))
      integer :: i, k, n

      apart = .false.
      do k = 1, size(figures)
         if (figures(k)%kind /= figure_portrait .and. .not. (figures(k)%kind == figure_history .and. &
                                                             figures(k)%curves%abscissa > 0)) cycle
         associate (list => figures(k)%scalars)
            apart(k) = any([(file_of(list(i), catalogue) /= file_of(list(1), catalogue), i=2, size(list))])
         end associate
      end do
      allocate (tables(count(apart)))
      n = 0
      do k = 1, size(figures)
         if (.not. apart(k)) cycle
         n = n + 1
         tables(n)%name = "figures/"//figures(k)%name
         tables(n)%columns = figures(k)%scalars
      end do
   end function extra_tables

   !> Name of the item in whose file a number is.
   pure function file_of(scalar, catalogue) result(name)
      type(scalar_t), intent(in) :: scalar        !! the number
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      character(:), allocatable :: name           !! of the item

      name = item_name(catalogue, catalogue%groups(scalar%group)%item_group, scalar%item)
   end function file_of

end module figure_needs
