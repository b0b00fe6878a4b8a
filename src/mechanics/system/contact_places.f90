!> Where what belongs to a contact lies: its losses among the quadratures of the ledger, its functions among the event functions.
!> (Its impulse is behind these quadratures: `place_of_impulse`.)
!>
!> Quadratures: the works and what dampers lose, then n_loss of each contact: lost by damping, lost by friction (`clearance_set`);
!> then what friction in ideal joints takes, if any rub; last what lubricant films take, if there are any. The impulses of contacts
!> follow, with a ledger or without one.
!> Event functions come in blocks, each in the order of the contacts: one of every contact for its onset and end, one for slip and
!> stick if any friction can stick, one for turns of the penetration if any normal law jumps there, one for the
!> end of the transition from a film if any film has one.
!>
!> Contacts are counted through all sets. Limits: a block has a function for every contact, whether it needs one or not.
module contact_places
   use clearance_set, only: loss_contact, loss_friction, n_integrand, normal_impulse
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: event_functions_t, impulse_rates, lost_damper, n_loss, n_quadratures, place_of_film_loss, place_of_joint_loss
   public :: place_of_loss
   public :: slip_function, touch_function, transition_function, turn_function, work_drive, work_load, work_stabilisation

   integer, parameter :: work_drive = 1          !! quadrature: work of the drivers
   integer, parameter :: work_load = 2           !! quadrature: work of applied loads
   integer, parameter :: work_stabilisation = 3  !! quadrature: work of constraint forces on the drift
   integer, parameter :: lost_damper = 4         !! quadrature: lost in dampers
   integer, parameter :: n_work = 4              !! quadratures before those of the contacts
   integer, parameter :: n_loss = max(loss_contact, loss_friction)  !! quadratures of a contact

   integer, parameter :: touch_function = 1      !! of a contact: its penetration, for onset and end
   integer, parameter :: slip_function = 2       !! its friction, for slip that ends and sticking that gives way
   integer, parameter :: turn_function = 3       !! the rate of its penetration, for turns and for rest that ends
   integer, parameter :: transition_function = 4 !! its penetration less the depth over which a film goes out
   integer, parameter :: n_function = 4          !! kinds of functions

   !> Which blocks of event functions there are.
   type :: event_functions_t
      integer :: n_contact = 0                        !! contacts of all sets: functions of a block
      integer :: n = 0                                !! functions
      logical :: has_slip = .false.                   !! there is a block for slip and stick
      logical :: has_turn = .false.                   !! there is a block for turns
      logical :: has_transition = .false.             !! there is a block for transitions from films
      integer, private :: before(n_function) = -1     !! functions before the block of a kind; -1: there is none
   contains
      procedure :: add => functions_add
      procedure :: place => functions_place
      procedure :: kind_of => functions_kind_of
      procedure :: contact_of => functions_contact_of
   end type event_functions_t

contains

   !> Number of the ledger's quadratures before those of joints with friction and of films.
   pure integer function n_quadratures(n_contact) result(n)
      integer, intent(in) :: n_contact  !! contacts of all sets

      n = n_work + n_loss*n_contact
   end function n_quadratures

   !> Number of the quadrature of what friction in ideal joints takes, if any of them rub.
   pure integer function place_of_joint_loss(n_contact) result(place)
      integer, intent(in) :: n_contact  !! contacts of all sets

      place = n_quadratures(n_contact) + 1
   end function place_of_joint_loss

   !> Number of the quadrature of what films take, the last one of the ledger, if there are any.
   pure integer function place_of_film_loss(n_contact, has_friction) result(place)
      integer, intent(in) :: n_contact  !! contacts of all sets
      logical, intent(in) :: has_friction       !! any ideal joint has friction

      place = n_quadratures(n_contact) + merge(2, 1, has_friction)
   end function place_of_film_loss

   !> Number of the quadrature of a loss.
   pure integer function place_of_loss(contact, loss) result(place)
      integer, intent(in) :: contact  !! number of the contact
      integer, intent(in) :: loss     !! loss_contact or loss_friction; 0: the quadrature before both

      place = n_work + n_loss*(contact - 1) + loss
   end function place_of_loss

   include "impulse_rates.inc"

   !> Add a block after those that are there.
   pure subroutine functions_add(self, kind)
      class(event_functions_t), intent(inout) :: self  !! the functions, their contacts counted
      integer, intent(in) :: kind                      !! kind of the block

      self%before(kind) = self%n
      self%n = self%n + self%n_contact
      self%has_slip = self%has_slip .or. kind == slip_function
      self%has_turn = self%has_turn .or. kind == turn_function
      self%has_transition = self%has_transition .or. kind == transition_function
   end subroutine functions_add

   !> Number of a function of a contact; of contact 0: functions before the block.
   pure integer function functions_place(self, kind, contact) result(place)
      class(event_functions_t), intent(in) :: self  !! the functions
      integer, intent(in) :: kind                   !! kind of the block, which is there
      integer, intent(in) :: contact                !! number of the contact

      place = self%before(kind) + contact
   end function functions_place

   !> Kind of a function by its number.
   pure integer function functions_kind_of(self, number) result(kind)
      class(event_functions_t), intent(in) :: self  !! the functions
      integer, intent(in) :: number                 !! number of the function

      kind = touch_function
      if (number <= self%n_contact) return
      do kind = n_function, 1, -1
         if (self%before(kind) >= 0 .and. number > self%before(kind)) return
      end do
   end function functions_kind_of

   !> The contact of a function by its number.
   pure integer function functions_contact_of(self, number) result(contact)
      class(event_functions_t), intent(in) :: self  !! the functions
      integer, intent(in) :: number                 !! number of the function

      contact = modulo(number - 1, self%n_contact) + 1
   end function functions_contact_of

end module contact_places
