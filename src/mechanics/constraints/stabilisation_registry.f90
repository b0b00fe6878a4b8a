!> The stabilisation methods: two lines each (`use`, `case`), and their number.
module stabilisation_registry
   use stabilisation, only: stabilisation_t
   use stabilisation_augmented_lagrangian, only: stabilisation_augmented_lagrangian_t
   use stabilisation_baumgarte, only: stabilisation_baumgarte_t
   use stabilisation_baumgarte_adaptive, only: stabilisation_baumgarte_adaptive_t
   use stabilisation_baumgarte_step, only: stabilisation_baumgarte_step_t
   use stabilisation_none, only: stabilisation_none_t
   use stabilisation_partitioning, only: stabilisation_partitioning_t
   use stabilisation_projection, only: stabilisation_projection_t
   implicit none (type, external)
   private
   public :: choose_stabilisation, exact_stabilisation, find_stabilisation, n_stabilisation_kinds, new_stabilisation
   public :: reason_of_stabilisation

contains

   !> Number of stabilisation methods.
   pure integer function n_stabilisation_kinds()
      n_stabilisation_kinds = 7
   end function n_stabilisation_kinds

   !> Way number k, 1 to `n_stabilisation_kinds`, not configured.
   subroutine new_stabilisation(k, stabiliser)
      integer, intent(in) :: k                             !! number of the stabilisation method
      class(stabilisation_t), allocatable, intent(out) :: stabiliser       !! the stabilisation method

      select case (k)
      case (1); allocate (stabilisation_none_t :: stabiliser)
      case (2); allocate (stabilisation_baumgarte_t :: stabiliser)
      case (3); allocate (stabilisation_baumgarte_step_t :: stabiliser)
      case (4); allocate (stabilisation_baumgarte_adaptive_t :: stabiliser)
      case (5); allocate (stabilisation_partitioning_t :: stabiliser)
      case (6); allocate (stabilisation_augmented_lagrangian_t :: stabiliser)
      case (7); allocate (stabilisation_projection_t :: stabiliser)
      end select
   end subroutine new_stabilisation

   !> Stabilisation by its name in a deck, which must be one of them.
   subroutine find_stabilisation(name, stabiliser)
      character(*), intent(in) :: name                              !! the stabilisation method's name
      class(stabilisation_t), allocatable, intent(out) :: stabiliser       !! the stabilisation method, not configured

      integer :: k

      do k = 1, n_stabilisation_kinds()
         call new_stabilisation(k, stabiliser)
         if (stabiliser%name() == name) exit
      end do
   end subroutine find_stabilisation

   !> The stabilisation that suits a system: projection, which leaves neither violations nor the traces of gains in the motion;
   !> Baumgarte's where a driver jumps, because a jump cannot be projected; none where there is nothing to enforce.
   subroutine choose_stabilisation(is_needed, is_smooth, stabiliser)
      logical, intent(in) :: is_needed                              !! there are constraints that the integrator does not enforce
      logical, intent(in) :: is_smooth                              !! no driver jumps
      class(stabilisation_t), allocatable, intent(out) :: stabiliser       !! the stabilisation method, not configured

      if (.not. is_needed) then
         allocate (stabilisation_none_t :: stabiliser)
      else if (is_smooth) then
         allocate (stabilisation_projection_t :: stabiliser)
      else
         allocate (stabilisation_baumgarte_t :: stabiliser)
      end if
   end subroutine choose_stabilisation

   !> Why a method was chosen.
   function reason_of_stabilisation(stabiliser) result(words)
      class(stabilisation_t), intent(in) :: stabiliser    !! the stabilisation method that `choose_stabilisation` has chosen
      character(:), allocatable :: words           !! the reason

      select type (stabiliser)
      type is (stabilisation_none_t)
         words = "not needed: no constraints, or the integrator enforces them"
      type is (stabilisation_baumgarte_t)
         words = "a driver jumps, and projection cannot follow a jump"
      class default
         words = "removes all constraint violation, and has no gains to choose"
      end select
   end function reason_of_stabilisation

   !> Name of the method that leaves no violation.
   function exact_stabilisation() result(name)
      character(:), allocatable :: name   !! as in a deck

      type(stabilisation_projection_t) :: stabiliser

      name = stabiliser%name()
   end function exact_stabilisation

end module stabilisation_registry
