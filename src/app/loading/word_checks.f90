!> The words of a deck for channels and figures, held against what its scene can report.
module word_checks
   use catalogue, only: catalogue_t
   use channels, only: list_scalars, select_channels, selection_t
   use deck_types, only: deck_t, place_of_part
   use diagnostics, only: diagnostics_t
   use figure_words, only: check_figures, draws_mechanism, figure_bifurcation, figure_film, figure_portrait, figure_section, &
      figure_statistics, figure_t
   use film_figures, only: check_film_figures
   use item, only: location_of, place_of, value_t
   use kinds, only: wp
   use scene, only: scene_t
   use spelling, only: nearest_word
   use statistics, only: names_of_numbers, number_t
   use text, only: join, text_t
   implicit none (type, external)
   private
   public :: check_words

contains

   !> Channels and figures must name what the scene has.
   subroutine check_words(deck, scene, end, catalogue, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck, for the places of errors
      type(scene_t), intent(in) :: scene              !! the scene
      real(wp), intent(in) :: end                     !! of the run; 0: it has none [s]
      type(catalogue_t), intent(in) :: catalogue      !! what it can report
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      integer :: k

      call check_channels(scene%settings%output%values(place_of(scene%settings%output, "channels")), catalogue, mistakes)
      associate (value => scene%settings%output%values(place_of(scene%settings%output, "figures")))
         do k = 1, size(value%words)
            call check_figure(deck, scene, end, catalogue, value, k, mistakes)
         end do
      end associate
      if (.not. scene%settings%statistics%is_present) return
      do k = 1, size(scene%settings%statistics%values)
         call check_channels(scene%settings%statistics%values(k), catalogue, mistakes)
      end do
   end subroutine check_words

   !> The channels of a key: each wrong one is an error.
   subroutine check_channels(value, catalogue, mistakes)
      type(value_t), intent(in) :: value              !! of the key, perhaps without words
      type(catalogue_t), intent(in) :: catalogue      !! what can be reported
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(selection_t) :: selection
      character(:), allocatable :: hint, message
      integer :: bad, before

      before = 0
      do while (before < size(value%words))  ! those after a wrong one are looked at too
         call select_channels(value%words(before + 1:), catalogue, selection, bad, message, hint)
         if (bad == 0) return
         call mistakes%add(location_of(value, before + bad), message, "not a channel of this deck", hint)
         before = before + bad
      end do
   end subroutine check_channels

   !> A figure of the list.
   subroutine check_figure(deck, scene, end, catalogue, value, k, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck, for the place of an error
      type(scene_t), intent(in) :: scene              !! the scene
      real(wp), intent(in) :: end                     !! of the run; 0: it has none [s]
      type(catalogue_t), intent(in) :: catalogue      !! what it can report
      type(value_t), intent(in) :: value              !! of the key `figures`
      integer, intent(in) :: k                        !! which of its words
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(figure_t), allocatable :: figures(:)
      character(:), allocatable :: hint, message, part
      integer :: bad

      associate (words => value%words(k:k))
         call check_figures(words, catalogue, bad, message, hint, part, figures)
         if (bad == 0) call check_statistics_figures(words, figures, scene, catalogue, bad, message, hint, part)
         if (bad == 0) call check_film_figures(words, figures, scene, end, bad, message, hint)
      end associate
      if (bad == 0) return
      if (part == value%words(k)%s) part = ""
      call mistakes%add(place_of_part(deck, location_of(value, k), part), message, &
                        trim(merge("not a figure of this deck", "invalid in this figure   ", len(part) == 0)), hint)
   end subroutine check_figure

   !> Figures of statistics need a section [statistics], some a period, and numbers that there are.
   subroutine check_statistics_figures(words, figures, scene, catalogue, bad, message, hint, part)
      type(text_t), intent(in) :: words(:)                 !! (n) words for figures
      type(figure_t), intent(in) :: figures(:)             !! (n) the figures
      type(scene_t), intent(in) :: scene                   !! the scene
      type(catalogue_t), intent(in) :: catalogue           !! what it can report
      integer, intent(out) :: bad                          !! number of the first wrong word, 0: none
      character(:), allocatable, intent(out) :: message    !! what is wrong with it
      character(:), allocatable, intent(out) :: hint       !! what may have been meant, may be blank
      character(:), allocatable, intent(out) :: part       !! the part of it that is wrong; blank: all of it

      type(text_t), allocatable :: known(:)
      integer :: i, k

      message = ""
      hint = ""
      part = ""
      do bad = 1, size(words)
         associate (figure => figures(bad))
            if (figure%kind <= figure_portrait .or. figure%kind == figure_film .or. draws_mechanism(figure)) cycle
            if (.not. scene%settings%statistics%is_present) then
               message = "'"//words(bad)%s//"' needs a section [statistics]"
               hint = "give the end of the transient: [statistics], after = 2 turns of motor"
               return
            end if
            if (.not. scene%settings%statistics%is_given("period") .and. &
                (figure%kind == figure_section .or. figure%kind == figure_bifurcation)) then
               message = "'"//words(bad)%s//"' needs the drive period"
               hint = "add to section [statistics]: period = 1 turns of motor, or a time"
               return
            end if
            if (figure%kind /= figure_statistics) cycle
            known = known_numbers(scene, catalogue)
            do k = 1, size(figure%numbers)
               if (any([(known(i)%s == figure%numbers(k)%s, i=1, size(known))])) cycle
               part = figure%numbers(k)%s
               message = "unknown statistic '"//figure%numbers(k)%s//"'"
               hint = nearest_word(figure%numbers(k)%s, known)
               if (len(hint) > 0) hint = "did you mean '"//hint//"'? "
               hint = hint//"statistics of this deck: "//join(known, " ")
               return
            end do
         end associate
      end do
      bad = 0
   end subroutine check_statistics_figures

   !> Names of the numbers of a scene's statistics.
   function known_numbers(scene, catalogue) result(names)
      type(scene_t), intent(in) :: scene             !! the scene
      type(catalogue_t), intent(in) :: catalogue     !! what it can report
      type(text_t), allocatable :: names(:)          !! (n) names

      type(number_t), allocatable :: list(:)
      type(selection_t) :: selection
      character(:), allocatable :: hint, message
      integer :: bad, k

      associate (words => scene%settings%statistics%values(place_of(scene%settings%statistics, "channels"))%words)
         call selection%clear(catalogue)
         if (size(words) > 0) call select_channels(words, catalogue, selection, bad, message, hint)
         call names_of_numbers(list_scalars(selection), catalogue, list)
      end associate
      allocate (names(size(list)))
      do k = 1, size(list)
         names(k)%s = list(k)%name
      end do
   end function known_numbers

end module word_checks
