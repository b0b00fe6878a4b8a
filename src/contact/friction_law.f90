!> The contract of friction laws: the tangential force that opposes sliding.
!>
!> A law gives the magnitude of the force, not negative, from the normal force and the magnitude of
!> the sliding speed; the caller applies it against the sliding velocity. Flores et al. (2008),
!> section 3.5.
module friction_law
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_law_t

   !> One row of a table of friction laws.
   type, abstract :: friction_law_t
      character(:), allocatable :: name  !! name of the row
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(prepare_interface), deferred :: prepare
      procedure(is_active_interface), deferred :: is_active
      procedure(force_interface), deferred :: force
      procedure :: mistake => friction_mistake
   end type friction_law_t

   abstract interface
      !> What the kind says of itself.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name and columns
      end function info_interface

      !> Take the parameters from a row of the kind's table.
      subroutine prepare_interface(self, item)
         import :: friction_law_t, item_t
         implicit none (type, external)
         class(friction_law_t), intent(inout) :: self  !! the law
         type(item_t), intent(in) :: item              !! the row
      end subroutine prepare_interface

      !> Whether the law ever gives a force: one without is dropped from the model.
      pure logical function is_active_interface(self)
         import :: friction_law_t
         implicit none (type, external)
         class(friction_law_t), intent(in) :: self  !! the law
      end function is_active_interface

      !> Magnitude of the friction force of n contacts. No allocation.
      pure subroutine force_interface(self, n, normal_force, speed, f)
         import :: friction_law_t, wp
         implicit none (type, external)
         class(friction_law_t), intent(in) :: self  !! the law
         integer, intent(in) :: n                   !! number of contacts
         real(wp), intent(in) :: normal_force(n)    !! (n) normal force, not negative [N]
         real(wp), intent(in) :: speed(n)           !! (n) magnitude of the sliding velocity [m/s]
         real(wp), intent(out) :: f(n)              !! (n) magnitude of the friction force [N]
      end subroutine force_interface
   end interface

contains

   !> What is wrong with the parameters as a whole, empty if nothing is; a law with such rules overrides this.
   function friction_mistake(self) result(message)
      class(friction_law_t), intent(in) :: self    !! the law
      character(:), allocatable :: message         !! one line, empty: all is well

      message = repeat("", len(self%name))
   end function friction_mistake

end module friction_law
