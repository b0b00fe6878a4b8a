!> What figures need of a run: channels, once per period or all the time, films, and files of their own.
module figure_needs
   use catalogue, only: catalogue_t
   use channel_names, only: item_name, scalar_t
   use channels, only: selection_t
   use figure_words, only: figure_bifurcation, figure_film, figure_history, figure_portrait, figure_section, figure_spectrum
   use figure_words, only: figure_t
   use film_fields, only: field_request_t, film_field_t
   use text, only: append_text, text_t
   use text_writer, only: extra_table_t
   implicit none (type, external)
   private
   public :: add_figure_channels, extra_tables, film_requests, missing_films, spectral_scalars, stroboscopic_scalars

contains

   !> The films that figures need.
   function film_requests(figures) result(list)
      type(figure_t), intent(in) :: figures(:)             !! (n) figures
      type(field_request_t), allocatable :: list(:)        !! (any) films, each once

      type(field_request_t), allocatable :: grown(:)
      integer :: i, k

      allocate (list(0))
      do k = 1, size(figures)
         if (figures(k)%kind /= figure_film) cycle
         if (any([(list(i)%name == figures(k)%name, i=1, size(list))])) cycle
         allocate (grown(size(list) + 1))
         do i = 1, size(list)
            grown(i) = list(i)
         end do
         grown(size(grown)) = figures(k)%film
         call move_alloc(grown, list)
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

   !> The channels that figures need once per period.
   function stroboscopic_scalars(figures) result(list)
      type(figure_t), intent(in) :: figures(:)         !! (n) figures
      type(scalar_t), allocatable :: list(:)           !! (any) channels

      integer :: k

      allocate (list(0))
      do k = 1, size(figures)
         if (figures(k)%kind == figure_section .or. figures(k)%kind == figure_bifurcation) list = [list, figures(k)%scalars]
      end do
   end function stroboscopic_scalars

   !> The channels whose spectra figures need.
   function spectral_scalars(figures) result(list)
      type(figure_t), intent(in) :: figures(:)         !! (n) figures
      type(scalar_t), allocatable :: list(:)           !! (any) channels

      integer :: k

      allocate (list(0))
      do k = 1, size(figures)
         if (figures(k)%kind == figure_spectrum) list = [list, figures(k)%scalars]
      end do
   end function spectral_scalars

   !> Add the channels that figures need to a selection.
   subroutine add_figure_channels(figures, selection)
      type(figure_t), intent(in) :: figures(:)         !! (n) figures
      type(selection_t), intent(inout) :: selection    !! channels that are kept

      integer :: k

      do k = 1, size(figures)
         if (figures(k)%kind > figure_portrait) cycle
         call selection%choose(figures(k)%scalars)
      end do
   end subroutine add_figure_channels

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

      name = item_name(catalogue, catalogue%groups(scalar%group)%room, scalar%item)
   end function file_of

end module figure_needs
