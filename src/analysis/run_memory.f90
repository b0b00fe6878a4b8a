!> All that a part of a motion must remember to go on: the integrator's memory, the system's, what is watched of the contacts, and
!> where ledger and events stand.
!>
!> A part that takes it back is, with a one-step method, equal bit for bit to the one that was not interrupted. What was saved by
!> another method, another mechanism or another form is refused by name, and nothing is changed.
!> Limits: what guards and drivers' jumps have noted for the warnings at the end is not kept.
module run_memory
   use checkpoint, only: add_piece, checkpoint_t, piece_t
   use errors, only: error_t
   use memory, only: get, put
   use moving_part, only: moving_part_t
   use smooth_piece, only: smooth_piece_t
   implicit none (type, external)
   private
   public :: load_part_memory, save_part_memory

   integer, parameter :: watch_version = 1   !! of the form of what is kept of contacts from step to step
   integer, parameter :: part_version = 1    !! of the form of where ledger and events stand
   integer, parameter :: n_part = 10         !! numbers of the latter

contains

   !> Save it.
   subroutine save_part_memory(part, checkpoint)
      type(moving_part_t), intent(in) :: part         !! the part, between two steps
      type(checkpoint_t), intent(inout) :: checkpoint !! what is remembered

      integer :: place

      call checkpoint%begin(list_of_part(part))
      place = 0
      associate (row => checkpoint%row)
         call part%method%save(row, place)
         call part%system%save(row, place)
         call part%watch%save(row, place)
         call put(row, place, part%n_idle)
         associate (ledger => part%ledger)
            call put(row, place, [part%t_event, ledger%balance_0, ledger%potential_0, ledger%residual, ledger%level, &
                                  ledger%magnitude, ledger%lost, part%worst])
         end associate
         call put(row, place, part%worst_row)
      end associate
   end subroutine save_part_memory

   !> Take it back into a part of a run of the same deck that has begun; the search for instants is brought to where the motion is.
   subroutine load_part_memory(checkpoint, part, error)
      type(checkpoint_t), intent(in) :: checkpoint         !! what was remembered
      type(moving_part_t), intent(inout) :: part           !! the part, begun
      type(error_t), allocatable, intent(out) :: error     !! it is another run's; nothing is changed

      type(smooth_piece_t) :: piece
      integer :: place

      call checkpoint%compare(list_of_part(part), error)
      if (allocated(error)) return
      place = 0
      associate (row => checkpoint%row)
         call part%method%load(row, place)
         call part%system%load(row, place)
         call part%watch%load(row, place)
         call get(row, place, part%n_idle)
         call get(row, place, part%t_event)
         call get(row, place, part%ledger%balance_0)
         call get(row, place, part%ledger%potential_0)
         call get(row, place, part%ledger%residual)
         call get(row, place, part%ledger%level)
         call get(row, place, part%ledger%magnitude)
         call get(row, place, part%ledger%lost)
         call get(row, place, part%worst)
         call get(row, place, part%worst_row)
      end associate
      do while (part%instants%next%at < part%system%linkage%piece%end)
         call part%instants%pass(piece)
      end do
      call part%system%linkage%set_motion(part%method%t, part%method%step%y1)
      call part%instants%note_turning(part%system)
   end subroutine load_part_memory

   !> The pieces of a part, in the order in which they are saved.
   function list_of_part(part) result(pieces)
      type(moving_part_t), intent(in) :: part        !! the part
      type(piece_t), allocatable :: pieces(:)        !! (any) the list

      call part%method%list_memory(pieces)
      call part%system%list_memory(pieces)
      call add_piece(pieces, "the contacts from step to step", watch_version, part%watch%memory_size())
      call add_piece(pieces, "where ledger and events stand", part_version, n_part)
   end function list_of_part

end module run_memory
