!> Description of an integrator: name, help, and what it can do. It is found in the registry and asked, so that no other file
!> names a method.
module integration_method
   use kind_info, only: kind_info_t
   use kinds, only: i8
   implicit none (type, external)
   private
   public :: abilities_t, method_t, steps_any, steps_fixed, steps_variable

   integer, parameter :: steps_any = 0        !! fixed steps, or variable ones
   integer, parameter :: steps_fixed = 1      !! fixed steps only
   integer, parameter :: steps_variable = 2   !! variable steps only

   !> Abilities of a method; the defaults are those of an explicit one-step method.
   type :: abilities_t
      integer :: steps = steps_any               !! which steps it makes, one of the above
      logical :: is_explicit = .true.            !! stability limits its steps where something decays fast
      logical :: is_stiff = .false.              !! made for stiff equations: implicit, damps any decay
      logical :: begins_anew = .false.           !! restarts from a checkpoint without its history, which is not saved
      logical :: solves_dae = .false.            !! enforces the constraints, and omits dependent rows
      logical :: has_sparse_newton = .false.     !! Newton matrix of large systems follows the pattern of all coordinates
      integer :: reference_place = 0             !! place among the methods that confirm others; 0: not among them
      character(24) :: parts = ""                !! methods whose steps it makes, by its choice; blank: its own only
   end type abilities_t

   !> A method.
   type, abstract :: method_t
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure, nopass :: abilities => usual_abilities
      procedure :: name => method_name
      procedure :: words => method_words
      procedure :: is_explicit => method_is_explicit
      procedure :: begins_anew => method_begins_anew
      procedure :: trial_evaluations => method_trial_evaluations
   end type method_t

   abstract interface
      !> Description of the method.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name and help
      end function info_interface
   end interface

contains

   !> What most methods can do.
   pure type(abilities_t) function usual_abilities() result(can)
      can = abilities_t()
   end function usual_abilities

   !> Name of the method in a deck.
   function method_name(self) result(name)
      class(method_t), intent(in) :: self  !! the method
      character(:), allocatable :: name    !! as in `method = name`

      type(kind_info_t) :: info

      info = self%info()
      name = info%name
   end function method_name

   !> Name, and what was chosen in a run; before the run what there is to choose from, blank if nothing is.
   function method_words(self, has_run) result(words)
      class(method_t), intent(in) :: self      !! the method
      logical, intent(in) :: has_run           !! after a run
      character(:), allocatable :: words       !! part of a line

      words = ""
      if (has_run) words = self%name()
   end function method_words

   !> Whether what decays fast kept the last step short, as it does with explicit methods.
   pure logical function method_is_explicit(self) result(is_explicit)
      class(method_t), intent(in) :: self  !! the method

      type(abilities_t) :: can

      can = self%abilities()
      is_explicit = can%is_explicit
   end function method_is_explicit

   !> Whether the method restarts from a checkpoint without its history.
   pure logical function method_begins_anew(self) result(begins_anew)
      class(method_t), intent(in) :: self  !! the method

      type(abilities_t) :: can

      can = self%abilities()
      begins_anew = can%begins_anew
   end function method_begins_anew

   !> Evaluations of trials of other methods, which the system does not count.
   pure integer(i8) function method_trial_evaluations(self) result(n)
      class(method_t), intent(in) :: self  !! the method, after a run

      n = merge(0_i8, 0_i8, self%begins_anew())
   end function method_trial_evaluations

end module integration_method
