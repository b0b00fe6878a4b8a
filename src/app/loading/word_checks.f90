!> The words of a deck for channels and figures, held against what its scene can report.
module word_checks
   use catalogue, only: catalogue_t
   use channels, only: list_scalars, select_channels, selection_t
   use columns, only: cell_index
   use deck_types, only: deck_t, place_of_part
   use diagnostics, only: diagnostics_t
   use figure_binding, only: bind_figure
   use figure_phrase, only: mistake_t, set_mistake
   use figure_words, only: draws_mechanism, figure_bifurcation, figure_contour, figure_film, figure_portrait, figure_section, &
      figure_statistics, figure_t, figure_wear, read_figure
   use film_fields, only: moment_at
   use item, only: location_of, place_of, value_t
   use kinds, only: wp
   use scene, only: scene_t
   use spelling, only: nearest_word
   use statistics, only: names_of_numbers, number_t
   use swept, only: sweep_t
   use text, only: append_text, join, real_text, text_t
   implicit none (type, external)
   private
   public :: check_words, joints_that_wear, read_figures

contains

   !> Read the figures of a deck; one whose words are wrong has no kind.
   subroutine read_figures(deck, scene, figures, mistakes)
      type(deck_t), intent(in) :: deck                           !! the deck, for the places of errors
      type(scene_t), intent(in) :: scene                         !! the scene
      type(figure_t), allocatable, intent(out) :: figures(:)     !! (n) what its words ask for
      type(diagnostics_t), intent(inout) :: mistakes             !! errors found

      type(mistake_t), allocatable :: mistake
      integer :: k

      associate (value => scene%settings%output%values(place_of(scene%settings%output, "figures")))
         allocate (figures(size(value%words)))
         do k = 1, size(figures)
            call read_figure(value%words(k)%s, figures(k), mistake)
            if (.not. allocated(mistake)) call look_for_name(figures(:k), mistake)
            if (.not. allocated(mistake)) cycle
            figures(k)%kind = 0
            call report_mistake(deck, value, k, mistake, mistakes)
         end do
      end associate
   end subroutine read_figures

   !> Whether the files of the last figure are those of an earlier one that draws something else.
   subroutine look_for_name(figures, mistake)
      type(figure_t), intent(in) :: figures(:)                   !! (n) figures
      type(mistake_t), allocatable, intent(inout) :: mistake     !! what is wrong

      integer :: k

      associate (last => figures(size(figures)))
         do k = 1, size(figures) - 1
            if (figures(k)%name /= last%name .or. figures(k)%word == last%word) cycle
            call set_mistake(mistake, "'"//figures(k)%word//"' and '"//last%word//"' have the same name of files, "//last%name, &
                             "write another name: A as NAME", "")
            return
         end do
      end associate
   end subroutine look_for_name

   !> Show a mistake of a figure where it stands.
   subroutine report_mistake(deck, value, k, mistake, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck, for the place of an error
      type(value_t), intent(in) :: value              !! of the key `figures`
      integer, intent(in) :: k                        !! which of its words
      type(mistake_t), intent(inout) :: mistake       !! what is wrong
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      if (mistake%part == value%words(k)%s) mistake%part = ""
      call mistakes%add(place_of_part(deck, location_of(value, k), mistake%part), mistake%message, &
                        trim(merge("not a figure of this deck", "invalid in this figure   ", len(mistake%part) == 0)), mistake%hint)
   end subroutine report_mistake

   !> Channels and figures must name what the scene has.
   subroutine check_words(deck, scene, figures, sweep, end, catalogue, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck, for the places of errors
      type(scene_t), intent(in) :: scene              !! the scene
      type(figure_t), intent(in) :: figures(:)        !! (n) its figures
      type(sweep_t), intent(in) :: sweep              !! that it is to make, perhaps none
      real(wp), intent(in) :: end                     !! of the run; 0: it has none [s]
      type(catalogue_t), intent(in) :: catalogue      !! what it can report
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(figure_t) :: figure
      type(mistake_t), allocatable :: mistake
      integer :: k

      associate (output => scene%settings%output)
         call check_channels(output%values(place_of(output, "channels")), catalogue, mistakes)
         do k = 1, size(figures)
            figure = figures(k)
            call bind_figure(figure, catalogue, mistake)
            if (.not. allocated(mistake)) call check_statistics(figure, scene, catalogue, mistake)
            if (.not. allocated(mistake)) call check_contour(figure, sweep, mistake)
            if (.not. allocated(mistake)) call check_film(figure, scene, end, mistake)
            if (.not. allocated(mistake)) call check_wear(figure, scene, mistake)
            if (allocated(mistake)) call report_mistake(deck, output%values(place_of(output, "figures")), k, mistake, mistakes)
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

   !> A figure of statistics needs a section [statistics], some a period, and numbers that there are.
   subroutine check_statistics(figure, scene, catalogue, mistake)
      type(figure_t), intent(in) :: figure                     !! the figure
      type(scene_t), intent(in) :: scene                       !! the scene
      type(catalogue_t), intent(in) :: catalogue               !! what it can report
      type(mistake_t), allocatable, intent(inout) :: mistake   !! what is wrong

      type(text_t), allocatable :: known(:)
      character(:), allocatable :: hint
      integer :: i, k

      if (figure%kind <= figure_portrait .or. any(figure%kind == [figure_film, figure_wear]) .or. draws_mechanism(figure)) return
      if (.not. scene%settings%statistics%is_present) then
         call set_mistake(mistake, "'"//figure%word//"' needs a section [statistics]", &
                          "give the end of the transient: [statistics], after = 2 turns of motor", "")
      else if (.not. scene%settings%statistics%is_given("period") .and. &
               (figure%kind == figure_section .or. figure%kind == figure_bifurcation)) then
         call set_mistake(mistake, "'"//figure%word//"' needs the drive period", &
                          "add to section [statistics]: period = 1 turns of motor, or a time", "")
      end if
      if (allocated(mistake) .or. all(figure%kind /= [figure_statistics, figure_contour])) return
      known = known_numbers(scene, catalogue)
      do k = 1, size(figure%arguments)
         associate (number => figure%arguments(k)%s)
            if (any([(known(i)%s == number, i=1, size(known))])) cycle
            hint = nearest_word(number, known)
            if (len(hint) > 0) hint = "did you mean '"//hint//"'? "
            call set_mistake(mistake, "unknown statistic '"//number//"'", hint//"statistics of this deck: "//join(known, " "), &
                             number)
            return
         end associate
      end do
   end subroutine check_statistics

   !> A number over two parameters needs a sweep that makes a grid of two.
   subroutine check_contour(figure, sweep, mistake)
      type(figure_t), intent(in) :: figure                     !! the figure
      type(sweep_t), intent(in) :: sweep                       !! cases, perhaps none
      type(mistake_t), allocatable, intent(inout) :: mistake   !! what is wrong

      logical :: is_grid

      if (figure%kind /= figure_contour .or. .not. sweep%is_present) return
      is_grid = allocated(sweep%parameters) .and. .not. sweep%is_paired .and. sweep%n_together == 1
      if (is_grid) is_grid = size(sweep%parameters) == 2
      if (is_grid) return
      call set_mistake(mistake, "'"//figure%word//"' needs a sweep over a grid of two parameters", &
                       "statistics("//figure%arguments(1)%s//") has a curve for each combination of further parameters", "")
   end subroutine check_contour

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
         call names_of_numbers(list_scalars(selection), catalogue, joints_that_wear(scene), list)
      end associate
      allocate (names(size(list)))
      do k = 1, size(list)
         names(k)%s = list(k)%name
      end do
   end function known_numbers

   !> A figure of a film needs a film that has pressures, and a time within the run.
   subroutine check_film(figure, scene, end, mistake)
      type(figure_t), intent(in) :: figure                     !! the figure
      type(scene_t), intent(in) :: scene                       !! the scene
      real(wp), intent(in) :: end                              !! of the run; 0: it has none [s]
      type(mistake_t), allocatable, intent(inout) :: mistake   !! what is wrong

      integer :: film

      if (figure%kind /= figure_film) return
      film = law_of(scene, figure%film%joint, "film")
      if (film > 0) then
         associate (law => scene%lubrication%films(film)%law)
            if (.not. law%has_field()) call set_mistake(mistake, "film '"//law%name//"' of joint '"//figure%film%joint// &
               "' gives a force without a pressure field: no '"//figure%word//"'", &
               "use a film with a pressure field: film.grid, film.squeeze, or a short or long film", "")
         end associate
      end if
      if (.not. allocated(mistake) .and. figure%film%moment == moment_at .and. end > 0.0_wp .and. figure%film%t > end) then
         call set_mistake(mistake, "'"//figure%word//"' is after the end of the run at "//real_text(end, 6)//" s", &
                          "film("//figure%film%joint//") shows the film at the end of the run", "")
      end if
   end subroutine check_film

   !> A figure of wear needs a joint with a wear law.
   subroutine check_wear(figure, scene, mistake)
      type(figure_t), intent(in) :: figure                     !! the figure
      type(scene_t), intent(in) :: scene                       !! the scene
      type(mistake_t), allocatable, intent(inout) :: mistake   !! what is wrong

      if (figure%kind /= figure_wear) return
      associate (joint => figure%arguments(1)%s)
         if (law_of(scene, joint, "wear") == 0) call set_mistake(mistake, "joint '"//joint//"' has no wear law: no '"// &
            figure%word//"'", "name a row of wear.archard or wear.reye in column wear of the joint", joint)
      end associate
   end subroutine check_wear

   !> Names of the joints with a wear law.
   function joints_that_wear(scene) result(names)
      type(scene_t), intent(in) :: scene           !! the scene
      type(text_t), allocatable :: names(:)        !! (n) in the order of the tables

      integer :: i, k

      allocate (names(0))
      do k = 1, size(scene%clearances)
         do i = 1, size(scene%clearances(k)%items)
            if (cell_index(scene%clearances(k)%info, scene%clearances(k)%items(i), "wear") == 0) cycle
            call append_text(names, scene%clearances(k)%items(i)%name)
         end do
      end do
   end function joints_that_wear

   !> Number of the film or wear law of a joint; 0: none.
   pure integer function law_of(scene, joint, column) result(law)
      type(scene_t), intent(in) :: scene   !! the scene
      character(*), intent(in) :: joint    !! name of the joint
      character(*), intent(in) :: column   !! film or wear

      integer :: i, k

      law = 0
      do k = 1, size(scene%clearances)
         if (.not. allocated(scene%clearances(k)%items)) cycle
         do i = 1, size(scene%clearances(k)%items)
            if (scene%clearances(k)%items(i)%name /= joint) cycle
            law = cell_index(scene%clearances(k)%info, scene%clearances(k)%items(i), column)
            return
         end do
      end do
   end function law_of

end module word_checks
