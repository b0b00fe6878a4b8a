!> What the words of a figure name in a catalogue.
module figure_binding
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use curve_words, only: bind_curves, find_scalar
   use figure_phrase, only: mistake_t, phrase_hint, set_mistake
   use figure_words, only: call_words, figure_animation, figure_film, figure_histogram, figure_history, figure_orbit, &
      figure_portrait, figure_statistics, figure_t, figure_wear, orbit_ending, read_figure
   use groups_of_catalogue, only: group_clearances, group_contacts
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use spelling, only: nearest_word
   use text, only: append_text, join, segment, starts_with, text_t
   implicit none (type, external)
   private
   public :: bind_figure

   character(*), parameter :: film_channel = "film_thickness"              !! what joints with films have
   character(*), parameter :: histogram_words = "impact_speed peak_force"  !! what there are histograms of
   character(*), parameter :: question = "did you mean '"                  !! how a hint starts that names what was meant
   character(*), parameter :: unknown_channel = "unknown channel"          !! how the message about one starts

contains

   !> Look up what a figure names; it may have been bound to another catalogue before.
   recursive subroutine bind_figure(figure, catalogue, mistake)
      type(figure_t), intent(inout) :: figure                !! the figure
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(mistake_t), allocatable, intent(out) :: mistake   !! what is wrong

      integer :: k

      if (allocated(figure%scalars)) deallocate (figure%scalars)
      allocate (figure%scalars(0))
      select case (figure%kind)
      case (figure_history)
         call bind_curves(figure%phrase, catalogue, figure%scalars, figure%curves, mistake)
         if (allocated(mistake)) call name_figures(figure%word, catalogue, mistake)
      case (figure_orbit)
         call bind_orbit(figure, catalogue, mistake)
      case (figure_film)
         call check_film(figure%film%joint, catalogue, mistake)
      case (figure_wear)
         call check_wear(figure%arguments(1)%s, catalogue, mistake)
      case (figure_histogram)
         call check_histogram(figure%arguments(1)%s, figure%arguments(2)%s, catalogue, mistake)
      case (figure_portrait:figure_histogram - 1, figure_histogram + 1:figure_statistics - 1)
         do k = 1, size(figure%arguments)
            call find_scalar(figure%arguments(k)%s, catalogue, "this figure needs single components, as in "// &
                             figure%arguments(k)%s//".x", figure%scalars, mistake)
            if (allocated(mistake)) return
         end do
      end select
   end subroutine bind_figure

   !> What is wrong with a word that may be no channel but another figure.
   recursive subroutine name_figures(word, catalogue, mistake)
      character(*), intent(in) :: word                          !! the figure
      type(catalogue_t), intent(in) :: catalogue                !! what can be recorded
      type(mistake_t), allocatable, intent(inout) :: mistake    !! what is wrong with it as a channel

      if (.not. starts_with(mistake%message, unknown_channel) .or. mistake%part /= word) return
      mistake%message = "unknown figure"//segment(mistake%message, len(unknown_channel) + 1)
      call take_nearest_call(word, catalogue, mistake%hint)
      mistake%hint = mistake%hint//"; figures are a channel, JOINT.orbit, portrait(X,Y), section(X,Y), spectrum(X), "// &
                     "histogram(JOINT.impact_speed), bifurcation(X), statistics(NUMBER), film(JOINT), wear(JOINT), mechanism, "// &
                     "strip(n=8), coupler(POINT) and animation(last=...); "//phrase_hint
   end subroutine name_figures

   !> Start a hint with the figure of another kind that was probably meant, if that would be understood.
   recursive subroutine take_nearest_call(word, catalogue, hint)
      character(*), intent(in) :: word                       !! a word of the deck that names no figure
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant

      character(:), allocatable :: meant, nearest
      type(text_t) :: calls(figure_portrait:figure_animation), endings(1)
      integer :: k

      if (starts_with(hint, question)) return
      meant = word
      endings(1)%s = orbit_ending(2:)
      k = index(word, ".", back=.true.)
      if (k > 1 .and. nearest_word(word(k + 1:), endings) == orbit_ending(2:)) then
         meant = word(:k - 1)//orbit_ending
      else
         do k = figure_portrait, figure_animation
            calls(k)%s = segment(call_words(k), 1, index(call_words(k), "(") - 1)
         end do
         nearest = nearest_word(word(:index(word//"(", "(") - 1), calls)
         if (len(nearest) > 0) meant = nearest//word(index(word//"(", "("):)
      end if
      if (meant /= word) call take_if_understood(meant, catalogue, hint)
   end subroutine take_nearest_call

   !> Start a hint with a figure, if that would be understood.
   recursive subroutine take_if_understood(meant, catalogue, hint)
      character(*), intent(in) :: meant                      !! the figure that was probably meant
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant

      type(figure_t) :: figure
      type(mistake_t), allocatable :: mistake

      call read_figure(meant, figure, mistake)
      if (.not. allocated(mistake)) call bind_figure(figure, catalogue, mistake)
      if (.not. allocated(mistake)) hint = question//meant//"'? "//hint
   end subroutine take_if_understood

   !> Path of a journal.
   recursive subroutine bind_orbit(figure, catalogue, mistake)
      type(figure_t), intent(inout) :: figure                   !! the figure
      type(catalogue_t), intent(in) :: catalogue                !! what can be recorded
      type(mistake_t), allocatable, intent(inout) :: mistake    !! what is wrong

      character(:), allocatable :: hint, nearest
      integer :: group, k
      logical :: is_round

      group = catalogue%find_group(group_clearances, "eccentricity")
      figure%joint = 0
      associate (joint => figure%arguments(1)%s, names => catalogue%item_groups(group_clearances)%names)
         do k = 1, size(names)
            if (names(k)%s == joint) figure%joint = k
         end do
         if (figure%joint > 0) then
            associate (clearance => catalogue%item_groups(group_clearances)%radius(figure%joint))
               is_round = ieee_is_finite(clearance)
               if (is_round) is_round = clearance > 0.0_wp
            end associate
            if (.not. is_round) then
               call set_mistake(mistake, "no orbit of '"//joint//"': the joint is ideal, or its clearance is not round", &
                                "an orbit needs a journal in a bearing with level = clearance", "")
               return
            end if
         end if
         if (figure%joint > 0 .and. group > 0) then
            if (catalogue%item_has(group, figure%joint)) then
               figure%scalars = [(scalar_t(group, k, figure%joint), k=1, catalogue%groups(group)%channel%components)]
               return
            end if
         end if
         nearest = nearest_word(joint, names)
         hint = "joints with clearance: "//join(names, " ")
         if (size(names) == 0) hint = "this deck has no joints with clearance"
         if (len(nearest) > 0 .and. nearest /= joint) call take_if_understood(nearest//orbit_ending, catalogue, hint)
         call set_mistake(mistake, "no orbit of '"//joint//"': it is not a joint with clearance", hint, "")
      end associate
   end subroutine bind_orbit

   !> A film needs a joint with a film.
   subroutine check_film(joint, catalogue, mistake)
      character(*), intent(in) :: joint                         !! name of the joint
      type(catalogue_t), intent(in) :: catalogue                !! what can be recorded
      type(mistake_t), allocatable, intent(inout) :: mistake    !! what is wrong

      character(:), allocatable :: hint, nearest
      type(text_t), allocatable :: with_film(:)
      integer :: group, k

      allocate (with_film(0))
      group = catalogue%find_group(group_clearances, film_channel)
      do k = 1, size(catalogue%item_groups(group_clearances)%names)
         if (group == 0) exit
         if (catalogue%item_has(group, k)) call append_text(with_film, catalogue%item_groups(group_clearances)%names(k)%s)
      end do
      if (any([(with_film(k)%s == joint, k=1, size(with_film))])) return
      nearest = nearest_word(joint, with_film)
      hint = "joints with films: "//join(with_film, " ")
      if (size(with_film) == 0) hint = "this deck has no joint with a film"
      if (len(nearest) > 0) hint = question//"film("//nearest//")'? "//hint
      call set_mistake(mistake, "no film of '"//joint//"': it is not a joint with a film", hint, joint)
   end subroutine check_film

   !> Wear needs a joint with clearance; whether its surfaces wear is known to the scene only.
   subroutine check_wear(joint, catalogue, mistake)
      character(*), intent(in) :: joint                         !! name of the joint
      type(catalogue_t), intent(in) :: catalogue                !! what can be recorded
      type(mistake_t), allocatable, intent(inout) :: mistake    !! what is wrong

      character(:), allocatable :: hint, nearest
      integer :: k

      associate (names => catalogue%item_groups(group_clearances)%names)
         if (any([(names(k)%s == joint, k=1, size(names))])) return
         nearest = nearest_word(joint, names)
         hint = "joints with clearance: "//join(names, " ")
         if (size(names) == 0) hint = "this deck has no joints with clearance"
      end associate
      if (len(nearest) > 0) hint = question//"wear("//nearest//")'? "//hint
      call set_mistake(mistake, "no wear of '"//joint//"': it is not a joint with clearance", hint, joint)
   end subroutine check_wear

   !> A histogram needs a joint with contacts, and something that they do.
   subroutine check_histogram(joint, quantity, catalogue, mistake)
      character(*), intent(in) :: joint                         !! name of the joint
      character(*), intent(in) :: quantity                      !! what its contacts do
      type(catalogue_t), intent(in) :: catalogue                !! what can be recorded
      type(mistake_t), allocatable, intent(inout) :: mistake    !! what is wrong

      character(:), allocatable :: word
      integer :: k

      associate (names => catalogue%item_groups(group_contacts)%names)
         if (index(" "//histogram_words//" ", " "//quantity//" ") > 0 .and. &
             any([(names(k)%s == joint, k=1, size(names))])) return
      end associate
      word = quantity
      if (len(joint) > 0) word = joint//"."//quantity
      call set_mistake(mistake, "no histogram of '"//word//"'", &
                       "write histogram(JOINT.impact_speed) or histogram(JOINT.peak_force) for a joint with clearance", word)
   end subroutine check_histogram

end module figure_binding
