!> How the lists of a kind grow. What a list holds already is handed over to the
!> longer one, its texts not copied.
submodule(kind_info) kind_growth
   implicit none (type, external)

contains

   !> What every column has.
   module procedure start_column
      column%name = name
      column%cell = cell
      column%help = help
      if (present(default)) column%default = default
   end procedure start_column

   !> Append a column to a kind.
   module procedure add_column
      type(column_t), allocatable :: grown(:)
      integer :: i, n

      if (len(column%name) > longest_column) error stop "internal error: a column with too long a name"
      n = 0
      if (allocated(info%columns)) n = size(info%columns)
      allocate (grown(n + 1))
      do i = 1, n
         call hand_over_column(info%columns(i), grown(i))
      end do
      call hand_over_column(column, grown(n + 1))
      call move_alloc(grown, info%columns)
   end procedure add_column

   !> Append an output channel to a kind.
   module procedure add_channel
      type(channel_t), allocatable :: grown(:)
      integer :: i, n

      n = 0
      if (allocated(info%channels)) n = size(info%channels)
      allocate (grown(n + 1))
      do i = 1, n
         call hand_over_channel(info%channels(i), grown(i))
      end do
      grown(n + 1)%name = name
      grown(n + 1)%unit = unit
      grown(n + 1)%frame = frame
      grown(n + 1)%components = components
      grown(n + 1)%help = help
      if (present(code)) grown(n + 1)%code = code
      call move_alloc(grown, info%channels)
   end procedure add_channel

   !> A column to another place.
   subroutine hand_over_column(from, to)
      type(column_t), intent(inout) :: from   !! the column; afterwards without texts
      type(column_t), intent(inout) :: to     !! the same

      to%cell = from%cell
      to%dimension = from%dimension
      to%is_any = from%is_any
      to%sees_motion = from%sees_motion
      to%variable = from%variable
      to%argument = from%argument
      to%size = from%size
      to%bounds = from%bounds
      to%is_free = from%is_free
      call move_alloc(from%name, to%name)
      call move_alloc(from%refers_to, to%refers_to)
      call move_alloc(from%choices, to%choices)
      call move_alloc(from%default, to%default)
      call move_alloc(from%options, to%options)
      call move_alloc(from%help, to%help)
   end subroutine hand_over_column

   !> A channel to another place.
   subroutine hand_over_channel(from, to)
      type(channel_t), intent(inout) :: from   !! the channel; afterwards without texts
      type(channel_t), intent(inout) :: to     !! the same

      to%components = from%components
      to%code = from%code
      call move_alloc(from%name, to%name)
      call move_alloc(from%unit, to%unit)
      call move_alloc(from%frame, to%frame)
      call move_alloc(from%help, to%help)
   end subroutine hand_over_channel

end submodule kind_growth
