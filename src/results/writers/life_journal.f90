!> The journal of a life: what it is of, and what every simulation gave, each written as soon as it has ended.
!>
!> A life depends on its simulations only: made again with those of the journal, it comes to where it was and continues from there.
module life_journal
   use errors, only: error_t
   use journal_blocks, only: block_of, next_block, tag_length
   use kinds, only: i8, wp
   use packed, only: packer_t, unpacker_t
   use sweep_journal, only: origin_of_sweep_t, packed_origin, unpack_origin
   use system_file, only: read_file
   use text_file, only: replace_file, text_file_t
   implicit none (type, external)
   private
   public :: life_journal_t, simulation_t

   character(*), parameter :: journal_name = "life.runs"                  !! file in the directory
   character(*), parameter :: first_line = "gudgeon runs of a life, format 2"//new_line("a")
   character(tag_length), parameter :: tag_head = "head"     !! block: what the life is of
   character(tag_length), parameter :: tag_run = "run "      !! block: a simulation
   integer(i8), parameter :: largest_journal = 2000000000_i8  !! bytes that are read

   !> What a simulation gave.
   type :: simulation_t
      integer :: profile = 0                   !! number of the profile
      integer :: start = 0                     !! number of the start
      real(wp), allocatable :: rates(:)        !! (n) volumes and distances per cycle [m^3, m]
      real(wp), allocatable :: values(:)       !! (conditions) extremes of channels [any]
      real(wp), allocatable :: loads(:)        !! (n_loads) nodes of the loads, see `held_loads` [m, rad, 1, m^3]
   end type simulation_t

   !> A journal.
   type :: life_journal_t
      type(origin_of_sweep_t) :: origin                !! what it is of
      type(simulation_t), allocatable :: runs(:)       !! (n or more) simulations
      integer :: n = 0                                 !! simulations
      logical :: is_there = .false.                    !! it was read, and says what it is of
      type(text_file_t) :: file                        !! where more is written
   contains
      procedure :: read => read_journal
      procedure :: begin => begin_journal
      procedure :: add => add_run
      procedure :: find => find_run
   end type life_journal_t

contains

   !> Read the journal of a directory.
   subroutine read_journal(self, directory)
      class(life_journal_t), intent(inout) :: self   !! the journal; not there if it cannot be read
      character(*), intent(in) :: directory          !! of the life

      type(simulation_t) :: run
      type(unpacker_t) :: block
      character(:), allocatable :: bytes, message, tag
      integer :: at

      self%is_there = .false.
      self%n = 0
      self%runs = [simulation_t ::]
      call read_file(directory//"/"//journal_name, .true., largest_journal, bytes, message)
      if (len(message) > 0 .or. index(bytes, first_line) /= 1) return
      at = len(first_line)
      do while (next_block(bytes, at, tag, block))
         if (tag == tag_head) then
            call unpack_origin(block, self%origin)
            self%is_there = block%is_good
         else
            call block%integer(run%profile, huge(0))
            call block%integer(run%start, huge(0))
            call block%reals(run%rates)
            call block%reals(run%values)
            call block%reals(run%loads)
            if (block%is_good) call append_run(self, run)
         end if
      end do
   end subroutine read_journal

   !> Write what the journal is of and the simulations that it has, whole, before more come.
   subroutine begin_journal(self, directory, error)
      class(life_journal_t), intent(inout) :: self       !! the journal, its origin and simulations are set
      character(*), intent(in) :: directory              !! of the life
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      character(:), allocatable :: text
      integer :: k

      text = first_line//block_of(tag_head, packed_origin(self%origin))
      do k = 1, self%n
         text = text//packed_run(self%runs(k))
      end do
      self%file%path = directory//"/"//journal_name
      call replace_file(self%file%path, text, error)
      self%file%length = len(text, i8)
   end subroutine begin_journal

   !> Write what a simulation gave, and keep it.
   subroutine add_run(self, run, error)
      class(life_journal_t), intent(inout) :: self       !! the journal
      type(simulation_t), intent(in) :: run              !! the simulation
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      call append_run(self, run)
      call self%file%append(packed_run(run), error)
   end subroutine add_run

   !> Append a simulation to those in memory.
   subroutine append_run(self, run)
      class(life_journal_t), intent(inout) :: self       !! the journal
      type(simulation_t), intent(in) :: run              !! the simulation

      type(simulation_t), allocatable :: longer(:)

      if (self%n == size(self%runs)) then
         allocate (longer(2*self%n + 16))
         longer(:self%n) = self%runs(:self%n)
         call move_alloc(longer, self%runs)
      end if
      self%n = self%n + 1
      self%runs(self%n) = run
   end subroutine append_run

   !> Number of a simulation in the journal, 0: it is not there.
   pure integer function find_run(self, profile, start) result(k)
      class(life_journal_t), intent(in) :: self          !! the journal
      integer, intent(in) :: profile                     !! number of the profile
      integer, intent(in) :: start                       !! number of the start

      do k = self%n, 1, -1
         if (self%runs(k)%profile == profile .and. self%runs(k)%start == start) return
      end do
   end function find_run

   !> A simulation as a block.
   function packed_run(run) result(block)
      type(simulation_t), intent(in) :: run   !! the simulation
      character(:), allocatable :: block      !! the same

      type(packer_t) :: packer

      call packer%integer(run%profile)
      call packer%integer(run%start)
      call packer%reals(run%rates)
      call packer%reals(run%values)
      call packer%reals(run%loads)
      block = block_of(tag_run, packer%bytes%get())
   end function packed_run

end module life_journal
