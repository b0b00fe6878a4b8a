!> All that a motion must remember to go on: the integrator's memory, the system's, and what is watched of the contacts.
!>
!> A run that takes it back is, with a one-step method, equal bit for bit to the one that was not interrupted. What was saved by
!> another method, another mechanism or another form is refused by name, and nothing is changed.
module run_memory
   use checkpoint, only: add_piece, checkpoint_t, piece_t
   use contact_watch, only: contact_watch_t
   use errors, only: error_t
   use integrator, only: integrator_t
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: load_run_memory, save_run_memory

   integer, parameter :: watch_version = 1  !! of the form of what is kept of contacts from step to step

contains

   !> Save it.
   subroutine save_run_memory(method, system, watch, checkpoint)
      class(integrator_t), intent(in) :: method       !! the integrator, between two steps
      type(mechanism_t), intent(in) :: system         !! the system
      type(contact_watch_t), intent(in) :: watch      !! its contacts
      type(checkpoint_t), intent(inout) :: checkpoint !! what is remembered

      integer :: place

      call checkpoint%begin(list_of_run(method, system, watch))
      place = 0
      call method%save(checkpoint%row, place)
      call system%save(checkpoint%row, place)
      call watch%save(checkpoint%row, place)
   end subroutine save_run_memory

   !> Take it back into a run of the same deck that has been started.
   subroutine load_run_memory(checkpoint, method, system, watch, error)
      type(checkpoint_t), intent(in) :: checkpoint         !! what was remembered
      class(integrator_t), intent(inout) :: method         !! the integrator, started
      type(mechanism_t), intent(inout) :: system           !! the system
      type(contact_watch_t), intent(inout) :: watch        !! its contacts
      type(error_t), allocatable, intent(out) :: error     !! it is another run's; nothing is changed

      integer :: place

      call checkpoint%compare(list_of_run(method, system, watch), error)
      if (allocated(error)) return
      place = 0
      call method%load(checkpoint%row, place)
      call system%load(checkpoint%row, place)
      call watch%load(checkpoint%row, place)
   end subroutine load_run_memory

   !> The pieces of a run, in the order in which they are saved.
   function list_of_run(method, system, watch) result(pieces)
      class(integrator_t), intent(in) :: method      !! the integrator
      type(mechanism_t), intent(in) :: system        !! the system
      type(contact_watch_t), intent(in) :: watch     !! its contacts
      type(piece_t), allocatable :: pieces(:)        !! (any) the list

      call method%list_memory(pieces)
      call system%list_memory(pieces)
      call add_piece(pieces, "the contacts from step to step", watch_version, watch%memory_size())
   end function list_of_run

end module run_memory
