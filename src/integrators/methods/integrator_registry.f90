!> The integrators: two lines each (`use`, `case`), and their number.
module integrator_registry
   use adams, only: adams_t
   use auto, only: auto_t
   use bdf, only: bdf_t
   use dop853, only: dop853_t
   use ida, only: ida_t
   use integration_method, only: abilities_t
   use integrator, only: integrator_t
   use radau, only: radau_t
   use rk4, only: rk4_t
   use rock4, only: rock4_t
   use text, only: append_text, text_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: abilities_of, find_integrator, find_stiff_integrator, n_integrator_kinds, new_integrator, reference_methods

contains

   !> Number of methods.
   pure integer function n_integrator_kinds()
      n_integrator_kinds = 9
   end function n_integrator_kinds

   !> Integrator of kind number k, 1 to `n_integrator_kinds`.
   subroutine new_integrator(k, method)
      integer, intent(in) :: k                                  !! number of the kind
      class(integrator_t), allocatable, intent(out) :: method   !! the integrator, not started

      select case (k)
      case (1); allocate (auto_t :: method)
      case (2); allocate (verner_t :: method)
      case (3); allocate (dop853_t :: method)
      case (4); allocate (rk4_t :: method)
      case (5); allocate (adams_t :: method)
      case (6); allocate (bdf_t :: method)
      case (7); allocate (ida_t :: method)
      case (8); allocate (rock4_t :: method)
      case (9); allocate (radau_t :: method)
      end select
   end subroutine new_integrator

   !> Integrator by its name in a deck, which must be one of them.
   subroutine find_integrator(name, method)
      character(*), intent(in) :: name                          !! the method's name
      class(integrator_t), allocatable, intent(out) :: method   !! the integrator, not started

      integer :: k

      do k = 1, n_integrator_kinds()
         call new_integrator(k, method)
         if (method%name() == name) exit
      end do
   end subroutine find_integrator

   !> What the integrator of a name can do.
   type(abilities_t) function abilities_of(name) result(can)
      character(*), intent(in) :: name      !! the method's name

      class(integrator_t), allocatable :: method

      call find_integrator(name, method)
      can = method%abilities()
   end function abilities_of

   !> The one-step method for stiff equations.
   subroutine find_stiff_integrator(method)
      class(integrator_t), allocatable, intent(out) :: method   !! the integrator, not started

      type(abilities_t) :: can
      integer :: k

      do k = 1, n_integrator_kinds()
         call new_integrator(k, method)
         can = method%abilities()
         if (can%is_stiff .and. .not. can%begins_anew) exit
      end do
   end subroutine find_stiff_integrator

   !> Names of the methods that confirm the results of others, in the order in which they are tried.
   function reference_methods(with_stiff) result(names)
      logical, intent(in) :: with_stiff       !! with those that are made for stiff equations, too
      type(text_t), allocatable :: names(:)   !! (n) names

      class(integrator_t), allocatable :: method
      type(abilities_t) :: can
      integer :: k, place

      allocate (names(0))
      do place = 1, n_integrator_kinds()
         do k = 1, n_integrator_kinds()
            call new_integrator(k, method)
            can = method%abilities()
            if (can%reference_place /= place .or. (can%is_stiff .and. .not. with_stiff)) cycle
            call append_text(names, method%name())
         end do
      end do
   end function reference_methods

end module integrator_registry
