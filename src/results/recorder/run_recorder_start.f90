!> How the files of a run start: what they hold is chosen, and which groups are requested.
submodule(run_recorder) run_recorder_start
   use channel_names, only: scalar_t
   use channels, only: list_scalars, select_channels
   use drawn_rows, only: labels_of
   use errors, only: exit_deck
   use figure_binding, only: bind_figure
   use figure_phrase, only: mistake_t
   use figure_needs, only: extra_tables, film_requests, scalars_of
   use figure_words, only: append_figure, figure_bifurcation, figure_film, figure_history, figure_orbit, figure_portrait, &
      figure_section, figure_spectrum
   use forces_table, only: is_ranked, magnitudes_of_forces
   use text_file, only: write_file
   implicit none (type, external)

   integer, parameter :: figures_of_curves(3) = [figure_history, figure_orbit, figure_portrait]

contains

   !> Make the files.
   module procedure start_run
      call memory_is_for("the rows of the time histories that wait to be written")
      call self%plan%complete()
      self%items = catalogue
      call choose(self, catalogue, error)
      if (allocated(error)) return
      if (allocated(self%plan%origin%deck_echo)) then
         call write_file(self%plan%directory//"/deck.echo", self%plan%origin%deck_echo, error)
         if (allocated(error)) return
      end if
      if (self%plan%is_twin()) self%plan%statistics%is_wanted = .false.
      call self%statistics%start(self%plan%statistics, catalogue, &
                                 scalars_of(self%figures, [figure_section, figure_bifurcation]), &
                                 scalars_of(self%figures, [figure_spectrum]))
      allocate (self%fields(0))
      if (self%plan%with%hdf5 .and. self%plan%with%histories .or. self%plan%with%figures) then
         if (any(self%figures%kind == figure_film)) self%wants_fields = film_requests(self%figures)
      end if
      if (.not. self%plan%with%histories) call self%selection%clear(catalogue)
      call self%extremes%start(catalogue, list_scalars(self%selection), magnitudes_of_forces(self%selection, catalogue))
      if (self%plan%with%hdf5) call self%hdf5%start(self%plan, catalogue, self%selection, error)
      if (allocated(error)) return
      if (.not. self%plan%is_twin()) call self%keeper%start(self%plan%looks%frames, catalogue)
      if (self%plan%with%motion) then
         call self%reader%bind(catalogue)
         call self%motion%start(self%plan, catalogue, error)
         if (allocated(error)) return
      end if
      if (self%plan%with%texts) then
         call self%texts%start(self%plan, catalogue, self%selection, extra_tables(self%figures, catalogue), error)
         if (allocated(error)) return
         if (self%plan%with%figures .and. .not. self%plan%is_twin()) self%rows%labels = &
            labels_of(scalars_of(self%figures, figures_of_curves), catalogue)
         if (allocated(self%rows%labels)) call self%rows%start(self%texts, catalogue)
      end if
      ! histories may need them, extremes do
      self%wants_contact_rows = self%plan%with%histories .or. self%statistics%plan%is_wanted
      if (size(self%extremes%channels) + size(self%statistics%channels) > 0) then
         self%located%place = [self%extremes%places(), self%statistics%places(catalogue)]
         if (self%statistics%plan%is_wanted) self%located%from = self%statistics%plan%after
      end if
      self%has_started = .true.
      call self%display%start(self%plan%with%progress)
      call memory_is_for("the motion")
   end procedure start_run

   !> Find the channels that are kept, with those of figures. The reference run skips what it does not have.
   subroutine choose(self, catalogue, error)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! a word is wrong

      type(figure_t), allocatable :: bound(:)
      type(mistake_t), allocatable :: mistake
      type(text_t), allocatable :: words(:)
      character(:), allocatable :: hint, message
      integer :: bad, k

      words = self%plan%channels
      do
         call select_channels(words, catalogue, self%selection, bad, message, hint)
         if (bad == 0) exit
         if (.not. self%plan%is_twin()) then
            call set_error(error, exit_deck, message//"; "//hint)
            return
         end if
         words = without(words, bad)
         if (size(words) > 0) cycle
         call self%selection%clear(catalogue)
         exit
      end do
      if (.not. allocated(self%figures)) allocate (self%figures(0))
      if (self%plan%is_twin()) then  ! whose catalogue is another
         allocate (bound(0))
         do k = 1, size(self%figures)
            call bind_figure(self%figures(k), catalogue, mistake)
            if (.not. allocated(mistake)) call append_figure(bound, self%figures(k))
         end do
         call move_alloc(bound, self%figures)
      end if
      call self%selection%choose(scalars_of(self%figures, figures_of_curves))
   end subroutine choose

   !> A list without one of its words.
   function without(words, number) result(rest)
      type(text_t), intent(in) :: words(:)     !! (n) words
      integer, intent(in) :: number            !! of the word to omit
      type(text_t), allocatable :: rest(:)     !! (n - 1) the others

      integer :: k

      allocate (rest(0))
      do k = 1, size(words)
         if (k /= number) call append_text(rest, words(k)%s)
      end do
   end function without

   !> Whether files, figures or statistics read the value of a quantity of an item. A dataset of run.h5 holds all items of its room
   !> that appear.
   module procedure run_wants
      integer :: k

      wants = self%selection%has_group(group)
      if (wants) wants = self%selection%has_item(self%items, self%items%groups(group)%item_group, item)
      wants = wants .or. self%reader%reads(group) .or. self%keeper%reads(group)
      wants = wants .or. is_ranked(self%selection, self%items, group, item)
      if (allocated(self%statistics%channels)) wants = wants .or. reads(self%statistics%channels)
      if (allocated(self%statistics%spectra)) wants = wants .or. reads(self%statistics%spectra)
      do k = 1, size(self%figures)
         if (allocated(self%figures(k)%scalars)) wants = wants .or. reads(self%figures(k)%scalars)
      end do

   contains

      !> Whether it is among some numbers.
      pure logical function reads(scalars)
         type(scalar_t), intent(in) :: scalars(:)  !! (n) the numbers

         reads = any(scalars%group == group .and. scalars%item == item)
      end function reads

   end procedure run_wants

end submodule run_recorder_start
