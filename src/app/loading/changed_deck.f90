!> A deck whose parameters change, as `--set` changes them: only what the parameters stand in is read again.
module changed_deck
   use errors, only: error_t
   use kinds, only: wp
   use load, only: load_case, load_deck, loaded_t
   use options, only: options_t
   use text, only: append_text, exact_text, text_t
   implicit none (type, external)
   private
   public :: change_parameter, changed_deck_t, forget_parameter

   !> The deck.
   type :: changed_deck_t
      type(options_t) :: options                    !! its command line, to be set first
      type(loaded_t), pointer :: loaded => null()   !! the deck as it was loaded last, kept until the program ends
      logical, private :: is_loaded = .false.       !! it was loaded without errors
   contains
      procedure :: load => load_changed
   end type changed_deck_t

contains

   !> Load it by another command line, which differs from its own in `--set`.
   subroutine load_changed(self, options, error)
      class(changed_deck_t), intent(inout) :: self         !! the deck
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! what the deck says of the values

      type(options_t) :: member

      member = options
      member%runs%is_member = .true.
      member%runs%has_known_words = .true.
      if (.not. associated(self%loaded)) allocate (self%loaded)
      if (self%is_loaded) then
         call load_case(member, self%loaded, error)
      else
         call load_deck(member, self%loaded, error)
      end if
      self%is_loaded = .not. allocated(error)
   end subroutine load_changed

   !> Give a parameter a value, instead of what the command line gives it.
   subroutine change_parameter(options, name, value, unit)
      type(options_t), intent(inout) :: options   !! the command line
      character(*), intent(in) :: name            !! of the parameter
      real(wp), intent(in) :: value               !! its value, SI [any]
      character(*), intent(in) :: unit            !! SI

      call forget_parameter(options, name)
      call append_text(options%change%overrides, name//"="//exact_text(value)//" "//unit)
   end subroutine change_parameter

   !> Leave a parameter as the deck has it, whatever the command line gives it.
   subroutine forget_parameter(options, name)
      type(options_t), intent(inout) :: options   !! the command line
      character(*), intent(in) :: name            !! of the parameter

      type(text_t), allocatable :: others(:)
      integer :: k

      allocate (others(0))
      do k = 1, size(options%change%overrides)
         associate (override => options%change%overrides(k))
            if (trim(adjustl(override%s(:index(override%s, "=") - 1))) /= name) others = [others, override]
         end associate
      end do
      call move_alloc(others, options%change%overrides)
   end subroutine forget_parameter

end module changed_deck
