!> What a run remembers, as one row of numbers in named pieces, each with the version of its form.
!>
!> Whoever remembers something lists its pieces, in the order in which it saves them. A checkpoint carries the list of whoever
!> wrote it, so that whoever would read it can report by name what differs, and reads nothing that another form was written in.
module checkpoint
   use errors, only: error_t, exit_usage, set_error
   use kinds, only: wp
   use text, only: counted, to_text
   implicit none (type, external)
   private
   public :: add_segment, checkpoint_t, segment_t, size_of_segments

   !> A stretch of the row.
   type :: segment_t
      character(:), allocatable :: name   !! what remembers it, as `clearance.revolute 'gudgeon'`
      integer :: version = 1              !! of its form: raised where what is saved, or its order, changes
      integer :: size = 0                 !! how many numbers
      logical :: is_fixed = .true.        !! their number does not change while a run continues
   end type segment_t

   !> A checkpoint.
   type :: checkpoint_t
      type(segment_t), allocatable :: segments(:)   !! (any) in the order of the row
      real(wp), allocatable :: row(:)           !! (their numbers) what is remembered [any]
   contains
      procedure :: begin => checkpoint_begin
      procedure :: compare => checkpoint_compare
   end type checkpoint_t

contains

   !> Append a piece to a list.
   subroutine add_segment(segments, name, version, n, is_fixed)
      type(segment_t), allocatable, intent(inout) :: segments(:)  !! (any) the list, may be unallocated
      character(*), intent(in) :: name                        !! what remembers it
      integer, intent(in) :: version                          !! of its form
      integer, intent(in) :: n                                !! how many numbers
      logical, intent(in), optional :: is_fixed               !! their number does not change; absent: it does not

      type(segment_t), allocatable :: grown(:)
      integer :: last

      last = 0
      if (allocated(segments)) last = size(segments)
      allocate (grown(last + 1))
      if (last > 0) grown(:last) = segments
      grown(last + 1)%name = name
      grown(last + 1)%version = version
      grown(last + 1)%size = n
      if (present(is_fixed)) grown(last + 1)%is_fixed = is_fixed
      call move_alloc(grown, segments)
   end subroutine add_segment

   !> How many numbers the pieces of a list have together.
   pure integer function size_of_segments(segments) result(n)
      type(segment_t), intent(in) :: segments(:)  !! (any) the list

      n = sum(segments%size)
   end function size_of_segments

   !> Storage for the pieces of a list.
   subroutine checkpoint_begin(self, segments)
      class(checkpoint_t), intent(inout) :: self   !! the checkpoint, without numbers
      type(segment_t), intent(in) :: segments(:)       !! (any) what will be saved

      self%segments = segments
      if (allocated(self%row)) deallocate (self%row)
      allocate (self%row(size_of_segments(segments)), source=0.0_wp)
   end subroutine checkpoint_begin

   !> Whether those who remember these pieces can read the checkpoint; the first that differs is named.
   subroutine checkpoint_compare(self, segments, error)
      class(checkpoint_t), intent(in) :: self              !! the checkpoint
      type(segment_t), intent(in) :: segments(:)               !! (any) what those who would read it remember
      type(error_t), allocatable, intent(out) :: error     !! what differs: name, version or size

      integer :: k

      do k = 1, min(size(segments), size(self%segments))
         associate (here => segments(k), there => self%segments(k))
            if (there%name /= here%name) then
               call refuse("it contains the state of "//there%name//" instead of that of "//here%name)
            else if (there%version /= here%version) then
               call refuse("the state of "//here%name//" has version "//to_text(there%version)// &
                           ", supported is version "//to_text(here%version))
            else if (there%size /= here%size .and. here%is_fixed) then
               call refuse("the state of "//here%name//" has "//counted(there%size, "number", "numbers")// &
                           ", expected "//to_text(here%size))
            end if
         end associate
         if (allocated(error)) return
      end do
      if (size(self%segments) > size(segments)) then
         call refuse("it contains the state of "//self%segments(size(segments) + 1)%name//", which is not part of this run")
      else if (size(segments) > size(self%segments)) then
         call refuse("the state of "//segments(size(self%segments) + 1)%name//" is missing")
      else if (size(self%row) /= size_of_segments(self%segments)) then
         call refuse("it has "//counted(size(self%row), "number", "numbers")//", but its segments describe "// &
                     to_text(size_of_segments(self%segments)))
      end if

   contains

      !> Say what differs.
      subroutine refuse(difference)
         character(*), intent(in) :: difference  !! the sentence

         call set_error(error, exit_usage, "the checkpoint does not belong to this run: "//difference//new_line("a")// &
                        "  = use the same deck, options and version of gudgeon as the interrupted run")
      end subroutine refuse

   end subroutine checkpoint_compare

end module checkpoint
