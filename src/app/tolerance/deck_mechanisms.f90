!> Mechanisms of a deck whose parameters deviate from their nominal values: only what the parameters stand in is read again.
module deck_mechanisms
   use build_system, only: new_system
   use changed_deck, only: changed_deck_t, forget_parameter
   use columns, only: column_of
   use dimension_text, only: unit_text
   use errors, only: error_t
   use kinds, only: wp
   use mechanism_source, only: mechanism_source_t
   use options, only: options_t
   use progress, only: progress_t
   use scene, only: scene_t
   use text, only: append_text, exact_text, text_t
   use tolerance_results, only: tolerance_study_t
   use tolerated, only: tolerated_t
   use varied_mechanism, only: varied_t
   implicit none (type, external)
   private
   public :: clearance_of, deck_mechanisms_t

   !> The deck and what is read of its mechanisms.
   type, extends(mechanism_source_t) :: deck_mechanisms_t
      type(changed_deck_t), private :: deck                      !! the deck, its command line without toleranced parameters
      type(tolerated_t), allocatable, private :: parameters(:)   !! (parameters) with their tolerances
      type(text_t), allocatable, private :: pins(:)              !! (pins) names of joints with clearance
      integer, allocatable, private :: requested(:, :)           !! (3, requests) channels that are read
      type(progress_t) :: display                                !! how far the study is
   contains
      procedure :: begin => deck_begin
      procedure :: build => deck_build
      procedure :: show => deck_show
   end type deck_mechanisms_t

contains

   !> Take what is asked for.
   subroutine deck_begin(self, options, study)
      class(deck_mechanisms_t), intent(inout) :: self   !! the mechanisms
      type(options_t), intent(in) :: options            !! the command line
      type(tolerance_study_t), intent(in) :: study      !! parameters, pins, requests

      integer :: k

      self%deck%options = options
      self%deck%options%verb = "run"
      self%deck%options%is_quiet = .true.
      self%deck%options%is_json = .false.
      do k = 1, size(study%plan%parameters)   ! what the command line gives them is nominal
         call forget_parameter(self%deck%options, study%plan%parameters(k)%name)
      end do
      self%parameters = study%plan%parameters
      allocate (self%pins(size(study%pins)), self%requested(3, size(study%requests)))
      do k = 1, size(study%pins)
         self%pins(k)%s = study%pins(k)%joint
      end do
      do k = 1, size(study%requests)
         self%requested(:, k) = study%requests(k)%at
      end do
   end subroutine deck_begin

   !> The mechanism whose parameters deviate from their nominal values.
   subroutine deck_build(self, deviations, varied, clearances, error)
      class(deck_mechanisms_t), intent(inout) :: self    !! the mechanisms
      real(wp), intent(in) :: deviations(:)              !! (parameters) deviations, SI [any]
      type(varied_t), intent(inout) :: varied            !! its system is built anew and bound
      real(wp), intent(out) :: clearances(:)             !! (pins) radial clearances [m]
      type(error_t), allocatable, intent(out) :: error   !! the deck has errors with these values

      type(options_t) :: options
      integer :: k

      clearances = 0.0_wp
      options = self%deck%options
      do k = 1, size(self%parameters)
         associate (parameter => self%parameters(k))
            call append_text(options%change%overrides, parameter%name//"="//exact_text(parameter%nominal + deviations(k))// &
                             unit_of(parameter))
         end associate
      end do
      call self%deck%load(options, error)
      if (allocated(error)) return
      call new_system(self%deck%loaded%scene, self%deck%loaded%levels, varied%system)
      varied%system%requests%formulas = self%deck%loaded%system%requests%formulas
      call varied%bind(self%requested)
      do k = 1, size(self%pins)
         clearances(k) = clearance_of(self%deck%loaded%scene, self%pins(k)%s)
      end do
   end subroutine deck_build

   !> SI unit of a parameter, blank if it has none.
   function unit_of(parameter) result(unit)
      type(tolerated_t), intent(in) :: parameter   !! the parameter
      character(:), allocatable :: unit            !! as a deck has it

      unit = unit_text(parameter%dimension)
      if (unit == "1") unit = ""
   end function unit_of

   !> Radial clearance of a joint.
   real(wp) function clearance_of(scene, joint) result(clearance)
      type(scene_t), intent(in) :: scene     !! the scene
      character(*), intent(in) :: joint      !! name of the joint, which is there

      integer :: i, k

      clearance = 0.0_wp
      do k = 1, size(scene%clearances)
         do i = 1, size(scene%clearances(k)%items)
            associate (item => scene%clearances(k)%items(i))
               if (item%name == joint) clearance = item%values(column_of(scene%clearances(k)%info, "clearance"))%number
            end associate
         end do
      end do
   end function clearance_of

   !> Show how far the study is.
   subroutine deck_show(self, fraction)
      class(deck_mechanisms_t), intent(inout) :: self   !! the mechanisms
      real(wp), intent(in) :: fraction                  !! of the study [1]

      call self%display%update(fraction)
   end subroutine deck_show

end module deck_mechanisms
