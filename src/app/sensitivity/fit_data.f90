!> The data of a fit: columns of files as `gudgeon compare` reads them, cut into sets.
module fit_data
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use channel_spec, only: parse_spec, spec_t
   use errors, only: error_t, exit_usage, set_error
   use external_columns, only: read_external
   use fit_model, only: measured_t
   use fit_plan, only: data_set_t, fit_plan_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use options, only: options_t
   use series, only: history_t
   use text, only: append_text, text_t, to_text
   implicit none (type, external)
   private
   public :: read_data

contains

   !> Read the files and cut them.
   subroutine read_data(options, catalogue, scalars, end, plan, sets, warnings, error)
      type(options_t), intent(in) :: options                       !! the command line: the deck, then files
      type(catalogue_t), intent(in) :: catalogue                   !! channels of the deck
      type(scalar_t), intent(in) :: scalars(:)                     !! (sensors) their channels
      real(wp), intent(in) :: end                                  !! of the motion [s]
      type(fit_plan_t), intent(inout) :: plan                      !! what is asked; without sets each file becomes one
      type(measured_t), allocatable, intent(out) :: sets(:)        !! (sets) the data
      type(text_t), allocatable, intent(inout) :: warnings(:)      !! (m) grown
      type(error_t), allocatable, intent(out) :: error             !! a file cannot be read, or has no such column

      type(data_set_t) :: new
      type(history_t), allocatable :: columns(:, :)
      integer :: f, k, n

      n = size(options%operands) - 1
      if (size(plan%sets) == 0) then
         do f = 1, n
            new%name = base_of(options%operands(f + 1)%s)
            new%file = f
            allocate (new%changes(0))
            plan%sets = [plan%sets, new]
            deallocate (new%changes)
         end do
      end if
      allocate (columns(size(scalars), n), sets(size(plan%sets)))
      do f = 1, n
         call read_file(options, options%operands(f + 1)%s, catalogue, scalars, plan, columns(:, f), warnings, error)
         if (allocated(error)) return
      end do
      do k = 1, size(sets)
         if (plan%sets(k)%file > n) then
            call set_error(error, exit_usage, "set '"//plan%sets(k)%name//"' is in file "//to_text(plan%sets(k)%file)// &
                           ", but the command line names "//to_text(n)//new_line("a")//"  = gudgeon fit DECK DATA [DATA ...]")
            return
         end if
         sets(k)%path = options%operands(plan%sets(k)%file + 1)%s
         call cut_set(plan, plan%sets(k), columns(:, plan%sets(k)%file), end, sets(k), warnings, error)
         if (allocated(error)) return
      end do
   end subroutine read_data

   !> A file's name without folder and ending.
   pure function base_of(path) result(base)
      character(*), intent(in) :: path         !! of the file
      character(:), allocatable :: base        !! its name

      integer :: dot

      base = path(index(path, "/", back=.true.) + 1:)
      dot = index(base, ".", back=.true.)
      if (dot > 1) base = path(index(path, "/", back=.true.) + 1:index(path, "/", back=.true.) + dot - 1)
   end function base_of

   !> The columns of all sensors in a file.
   subroutine read_file(options, path, catalogue, scalars, plan, columns, warnings, error)
      type(options_t), intent(in) :: options                       !! the command line
      character(*), intent(in) :: path                             !! of the file
      type(catalogue_t), intent(in) :: catalogue                   !! channels of the deck
      type(scalar_t), intent(in) :: scalars(:)                     !! (sensors) their channels
      type(fit_plan_t), intent(in) :: plan                         !! what is asked
      type(history_t), intent(inout) :: columns(:)                 !! (sensors) what the file has of them
      type(text_t), allocatable, intent(inout) :: warnings(:)      !! (m) grown
      type(error_t), allocatable, intent(out) :: error             !! it cannot be read, or has no such column

      type(history_t) :: like
      type(spec_t) :: spec, time
      type(text_t), allocatable :: notes(:)
      character(:), allocatable :: words
      integer :: k, s

      words = ""
      if (allocated(options%legacy%time)) words = options%legacy%time
      call parse_spec(words, .true., time, error)
      allocate (like%list(1))
      do s = 1, size(scalars)
         if (allocated(error)) return
         like%list(1)%name = scalar_name(catalogue, scalars(s))
         like%list(1)%unit = catalogue%groups(scalars(s)%group)%channel%unit
         call parse_spec(like%list(1)%name//"="//plan%sensors(s)%column, .false., spec, error)
         if (allocated(error)) then
            error%message = error%message//new_line("a")//"  = column of sensor '"//plan%sensors(s)%name//"' in [fit.sensor]"
            return
         end if
         if (size(spec%columns) == 0) call append_text(spec%columns, like%list(1)%name)
         if (allocated(notes)) deallocate (notes)
         allocate (notes(0))
         call read_external(path, [spec], time, like, columns(s), notes, error)
         do k = 1, merge(size(notes), 0, s == 1)
            call append_text(warnings, notes(k)%s)
         end do
      end do
   end subroutine read_file

   !> A set: rows between its times, those of the motion.
   subroutine cut_set(plan, asked, columns, end, set, warnings, error)
      type(fit_plan_t), intent(in) :: plan                         !! what is asked, for the delays
      type(data_set_t), intent(in) :: asked                        !! the set
      type(history_t), intent(in) :: columns(:)                    !! (sensors) of its file
      real(wp), intent(in) :: end                                  !! of the motion [s]
      type(measured_t), intent(inout) :: set                       !! the data
      type(text_t), allocatable, intent(inout) :: warnings(:)      !! (m) grown
      type(error_t), allocatable, intent(out) :: error             !! there are none

      integer, allocatable :: rows(:)
      integer :: k, n_outside, s

      set%name = asked%name
      rows = pack([(k, k=1, size(columns(1)%time))], columns(1)%is_output .and. columns(1)%time >= asked%from .and. &
                                                     columns(1)%time <= asked%to)
      set%t = columns(1)%time(rows) - asked%from
      allocate (set%x(size(columns), size(rows)))
      set%reason = ""
      n_outside = 0
      do s = 1, size(columns)
         set%x(s, :) = columns(s)%list(1)%x(rows)
         associate (is_outside => set%t < plan%sensors(s)%delay .or. set%t > end - plan%sensors(s)%delay)
            n_outside = n_outside + count(is_outside .and. ieee_is_finite(set%x(s, :)))
            where (is_outside) set%x(s, :) = not_a_number()
         end associate
      end do
      if (.not. any(ieee_is_finite(set%x))) then
         call set_error(error, exit_usage, "set '"//set%name//"' of "//set%path//" has no data within the motion"//new_line("a")// &
                        "  = rows of the file: "//to_text(size(rows))//"; check from and to in [fit.set], and end")
      else if (n_outside > 0) then
         call append_text(warnings, to_text(n_outside)//" data of set '"//set%name//"' are not within the motion, or nearer to " &
                          //"its ends than the delay of their sensor: not used")
      end if
   end subroutine cut_set

end module fit_data
