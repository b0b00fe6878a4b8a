!> The contract of stabilisation methods against the drift of an integration.
!>
!> A method may set Baumgarte's gains as a step starts, correct the coordinates and rates that an evaluation starts with, and
!> correct the state at the end of a step. What a correction does to the energy is work of the stabilisation in the ledger.
!> Source: Flores et al. (2008), section 2.5.
module stabilisation
   use archive, only: archive_t
   use item, only: option_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use linkage, only: linkage_t
   implicit none (type, external)
   private
   public :: stabilisation_t, option_number

   !> A stabilisation method.
   type, abstract :: stabilisation_t
      logical :: at_stages = .false.  !! whether `correct_stage` is to be called
      logical :: follows_step = .false.  !! whether gains follow the step
      logical :: at_steps = .false.   !! whether `correct_step` is to be called
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(words_interface), deferred :: words
      procedure :: name => stabilisation_name
      procedure, nopass :: needs_fixed_step => stabilisation_needs_no_step
      procedure, nopass :: solver => stabilisation_solver
      procedure :: configure => stabilisation_configure
      procedure :: begin_step => stabilisation_begin_step
      procedure :: correct_stage => stabilisation_correct
      procedure :: correct_step => stabilisation_correct
      procedure, nopass :: memory_version => stabilisation_memory_version
      procedure, nopass :: is_memory_fixed => stabilisation_is_memory_fixed
      procedure :: save => stabilisation_save
      procedure :: load => stabilisation_load
   end type stabilisation_t

   abstract interface
      !> Description of the method: the word for it in a deck, what it does, the options after the word as columns.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name, as in `stabilise = name`, help, options
      end function info_interface

      !> What is done, as text.
      function words_interface(self) result(words)
         import :: stabilisation_t
         implicit none (type, external)
         class(stabilisation_t), intent(in) :: self     !! the stabilisation method
         character(:), allocatable :: words    !! as in a deck
      end function words_interface
   end interface

contains

   !> The word for the method in a deck.
   function stabilisation_name(self) result(name)
      class(stabilisation_t), intent(in) :: self     !! the stabilisation method
      character(:), allocatable :: name     !! as in `stabilise = name`

      type(kind_info_t) :: info

      info = self%info()
      name = info%name
   end function stabilisation_name

   !> Whether the method needs steps of a fixed length: it does not, unless it says otherwise.
   pure logical function stabilisation_needs_no_step() result(needs_step)
      needs_step = .false.
   end function stabilisation_needs_no_step

   !> Name of the solver that the method needs; blank: any.
   pure function stabilisation_solver() result(name)
      character(:), allocatable :: name     !! as in `solver = name`

      name = ""
   end function stabilisation_solver

   !> Value of an option of a deck, or what stands for it.
   pure real(wp) function option_number(options, name, default) result(number)
      type(option_t), intent(in) :: options(:)  !! (any) options after the word
      character(*), intent(in) :: name          !! its name
      real(wp), intent(in) :: default           !! its value if it is not there [any]

      integer :: k

      number = default
      do k = 1, size(options)
         if (options(k)%name == name) number = options(k)%number
      end do
   end function option_number

   !> Take the options of a deck: there are none, unless the method says otherwise.
   subroutine stabilisation_configure(self, options, tolerance)
      class(stabilisation_t), intent(inout) :: self      !! the stabilisation method
      type(option_t), intent(in) :: options(:)  !! (any) options after its word
      real(wp), intent(in) :: tolerance         !! of the integrator [1]
   end subroutine stabilisation_configure

   !> Nothing to change as a step starts, unless the method says otherwise.
   subroutine stabilisation_begin_step(self, linkage, h)
      class(stabilisation_t), intent(inout) :: self           !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage      !! the bodies and their rows, last evaluated at the start of the step
      real(wp), intent(in) :: h                      !! length of the step [s]
   end subroutine stabilisation_begin_step

   !> Nothing to correct, unless the method says otherwise. At the end of a step the motion of the system is set, and must be that
   !> of the corrected state afterwards.
   subroutine stabilisation_correct(self, linkage, t, y, status)
      class(stabilisation_t), intent(inout) :: self           !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage      !! the bodies and their rows
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(inout), contiguous :: y(:)    !! (2 positions or more) coordinates and rates, corrected [any]
      integer, intent(out) :: status                 !! 0: done

      status = 0
   end subroutine stabilisation_correct

   !> Version of the form of what the method saves; one that changes it says so.
   pure integer function stabilisation_memory_version() result(version)
      version = 1
   end function stabilisation_memory_version

   !> Whether the stabiliser saves as many numbers at any time: it does, unless the method says otherwise.
   pure logical function stabilisation_is_memory_fixed() result(is_fixed)
      is_fixed = .true.
   end function stabilisation_is_memory_fixed

   !> Write what the method remembers.
   subroutine stabilisation_save(self, archive)
      class(stabilisation_t), intent(in) :: self     !! the stabilisation method
      type(archive_t), intent(inout) :: archive      !! the checkpoint
   end subroutine stabilisation_save

   !> Read what the method remembers.
   subroutine stabilisation_load(self, archive)
      class(stabilisation_t), intent(inout) :: self  !! the stabilisation method
      type(archive_t), intent(inout) :: archive      !! the checkpoint
   end subroutine stabilisation_load

end module stabilisation
