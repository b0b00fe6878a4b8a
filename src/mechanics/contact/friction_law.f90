!> The contract of friction laws: the tangential force that opposes sliding.
!>
!> A law gives the magnitude of the force, not negative, from the normal force and the magnitude of
!> the sliding speed; the caller applies it against the sliding velocity. Flores et al. (2008),
!> section 3.5. A law with a memory (`memory`) needs more of the caller: with `memory_slip` a contact slides one way, slides
!> the other way or sticks, as located events decide, and `stick_limit` says how much it holds; with `memory_bristle` it has a
!> state, a deflection z whose rate comes from `bristles` with the force. For these `force` is that of steady sliding.
module friction_law
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_law_t, friction_slot_t
   public :: memory_bristle, memory_none, memory_slip

   integer, parameter :: memory_none = 0     !! the force is a function of the present motion
   integer, parameter :: memory_slip = 1     !! whether and which way a contact slides is remembered
   integer, parameter :: memory_bristle = 2  !! a contact has a deflection that is integrated

   !> One row of a table of friction laws.
   type, abstract :: friction_law_t
      character(:), allocatable :: name  !! name of the row
      integer :: memory = memory_none    !! what a contact remembers, one of the above
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(prepare_interface), deferred :: prepare
      procedure(is_active_interface), deferred :: is_active
      procedure(force_interface), deferred :: force
      procedure :: stick_limit => friction_stick_limit
      procedure :: bristles => friction_bristles
      procedure :: bristle_scale => friction_bristle_scale
      procedure :: mistake => friction_mistake
   end type friction_law_t

   !> A place for a friction law of any kind.
   type :: friction_slot_t
      class(friction_law_t), allocatable :: law  !! the law
   end type friction_slot_t

   abstract interface
      !> Description of the kind.
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

   !> Maximum tangential force of a contact that sticks: none, unless the law says otherwise.
   pure real(wp) function friction_stick_limit(self, normal_force) result(f)
      class(friction_law_t), intent(in) :: self  !! the law
      real(wp), intent(in) :: normal_force       !! normal force, not negative [N]

      f = 0.0_wp
   end function friction_stick_limit

   !> Force of the bristles of one contact and the rate of their deflection: none, unless the law says otherwise.
   pure subroutine friction_bristles(self, n, normal_force, velocity, z, f, z_rate)
      class(friction_law_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                   !! components: 1 in the plane, 3 in space
      real(wp), intent(in) :: normal_force       !! normal force, not negative [N]
      real(wp), intent(in) :: velocity(n)        !! (n) sliding velocity [m/s]
      real(wp), intent(in) :: z(n)               !! (n) deflection [m]
      real(wp), intent(out) :: f(n)              !! (n) force along the sliding velocity that is to be opposed [N]
      real(wp), intent(out) :: z_rate(n)         !! (n) rate of the deflection [m/s]

      f = 0.0_wp
      z_rate = 0.0_wp
   end subroutine friction_bristles

   !> Natural size of the deflection, for error norms.
   pure real(wp) function friction_bristle_scale(self) result(z)
      class(friction_law_t), intent(in) :: self  !! the law

      z = 1.0_wp
   end function friction_bristle_scale

   !> What is wrong with the parameters as a whole, empty if nothing is; a law with such rules overrides this.
   function friction_mistake(self) result(message)
      class(friction_law_t), intent(in) :: self    !! the law
      character(:), allocatable :: message         !! one line, empty: all is well

      message = repeat("", len(self%name))
   end function friction_mistake

end module friction_law
