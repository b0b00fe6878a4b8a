!> How a failure travels: `type(error_t), allocatable, intent(out) :: error`, last argument.
!>
!> Unallocated means success. Only `main` prints a message and sets the exit code.
module errors
   implicit none (type, external)
   private
   public :: error_t, set_error
   public :: exit_assembly, exit_audit, exit_deck, exit_different, exit_file, exit_integration
   public :: exit_internal, exit_ok, exit_stopped, exit_sweep, exit_usage

   integer, parameter :: exit_ok = 0           !! done
   integer, parameter :: exit_different = 1    !! compared and found different
   integer, parameter :: exit_usage = 2        !! a wrong command line
   integer, parameter :: exit_deck = 3         !! an error in the deck
   integer, parameter :: exit_assembly = 4     !! the mechanism cannot be assembled
   integer, parameter :: exit_integration = 5  !! the integration failed
   integer, parameter :: exit_audit = 6        !! energy or constraint above the deck's limit
   integer, parameter :: exit_stopped = 7      !! stopped with a checkpoint
   integer, parameter :: exit_sweep = 8        !! part of a sweep failed
   integer, parameter :: exit_file = 9         !! file or disk
   integer, parameter :: exit_internal = 70    !! an error of the program itself

   !> What went wrong, as text a user can act on.
   type :: error_t
      integer :: code = exit_internal        !! exit code of the program, one of the above
      character(:), allocatable :: message   !! text, possibly of several lines, without a final newline
   end type error_t

contains

   !> Make an error.
   pure subroutine set_error(error, code, message)
      type(error_t), allocatable, intent(out) :: error  !! the new error
      integer, intent(in) :: code                       !! exit code
      character(*), intent(in) :: message               !! what, value, limit, where, what to do

      allocate (error)
      error%code = code
      error%message = message
   end subroutine set_error

end module errors
