!> Many decks in one process, for `make fuzz`: each line of the standard input is a reader, perhaps `--ideal`, and a file.
!>
!> Before each a line `begin N` is written, so that a crash has a name, and after it
!>
!>     end N CODE NEWS EDGES TIME
!>
!> CODE is the exit code that the program would have; -1: an error without a word; -2: the echo of a good deck is no good deck.
!> NEWS and EDGES are of coverage.c, TIME is processor time [us]. The reader `leaks` reads nothing: CODE is 1 if memory was lost.
!> Another reader is another case of `read_one`.
program many_decks
   use, intrinsic :: ieee_arithmetic, only: ieee_set_underflow_mode, ieee_support_underflow_control
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
   use, intrinsic :: iso_fortran_env, only: input_unit, output_unit
   use blas_threads, only: use_one_blas_thread
   use errors, only: error_t
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use options, only: options_t
   use processes, only: begin_process
   use scene_echo, only: echo_scene
   use text, only: printable, split_blank, text_t
   use verb_explain, only: check_deck, explain_deck
   implicit none (type, external)

   interface
      !> Start with a deck.
      subroutine coverage_begin() bind(c)
         implicit none (type, external)
      end subroutine coverage_begin

      !> Processor time of this process [us].
      integer(c_int64_t) function coverage_clock() bind(c)
         import :: c_int64_t
         implicit none (type, external)
      end function coverage_clock

      !> Whether memory was lost since the last call.
      integer(c_int) function coverage_leaks() bind(c)
         import :: c_int
         implicit none (type, external)
      end function coverage_leaks

      !> How many classes of edges the deck was the first to reach.
      integer(c_int) function coverage_news(edges) bind(c)
         import :: c_int
         implicit none (type, external)
         integer(c_int), intent(out) :: edges  !! edges that it passed
      end function coverage_news

      !> Open the file of what was reached; 0, or 1: it cannot be had.
      integer(c_int) function coverage_open() bind(c)
         import :: c_int
         implicit none (type, external)
      end function coverage_open
   end interface

   type(error_t), allocatable :: error
   type(text_t), allocatable :: words(:)
   character(1000) :: line
   integer(c_int64_t) :: begin
   integer(c_int) :: edges, news
   integer :: code, k, status

   call begin_process()
   call use_one_blas_thread(error)
   if (allocated(error)) error stop error%code
   if (coverage_open() /= 0) error stop "GUDGEON_COVERAGE cannot be opened"
   if (ieee_support_underflow_control(1.0_wp)) call ieee_set_underflow_mode(gradual=.false.)
   k = 0
   do
      read (input_unit, "(a)", iostat=status) line
      if (status /= 0) exit
      k = k + 1
      words = split_blank(trim(line))
      write (output_unit, "(a, i0)") "begin ", k
      flush (output_unit)
      begin = coverage_clock()
      call coverage_begin()
      call read_one(words(1)%s, words(size(words))%s, size(words) > 2, code)
      news = coverage_news(edges)
      write (output_unit, "(a, 5(i0, :, 1x))") "end ", k, code, news, edges, coverage_clock() - begin
      flush (output_unit)
   end do
   if (allocated(words)) deallocate (words)  ! what a main program holds at its end counts as lost

contains

   !> Read one file.
   subroutine read_one(reader, path, is_ideal, code)
      character(*), intent(in) :: reader  !! which reader
      character(*), intent(in) :: path    !! of the file
      logical, intent(in) :: is_ideal     !! clearance joints are taken as ideal
      integer, intent(out) :: code        !! how it ended

      type(error_t), allocatable :: error
      type(options_t) :: options
      character(:), allocatable :: shown

      options%verb = reader
      options%write = "all"
      allocate (options%change%overrides(0), options%operands(1))
      options%change%is_ideal = is_ideal
      options%operands(1)%s = path
      code = 0
      select case (reader)
      case ("check")
         call check_deck(options, error)
      case ("explain")
         call explain_deck(options, error)
      case ("echo")
         call read_echo(options, code, error)
      case ("leaks")
         code = coverage_leaks()
      case default
         error stop "many_decks: unknown reader"
      end select
      if (.not. allocated(error)) return
      shown = printable(error%message)
      if (code == 0) code = error%code
      if (len_trim(shown) == 0) code = -1
   end subroutine read_one

   !> A good deck, as understood, is a good deck.
   subroutine read_echo(options, code, error)
      type(options_t), intent(inout) :: options            !! deck
      integer, intent(out) :: code                         !! -2: it is not
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, or of its echo

      type(loaded_t) :: again, loaded
      character(:), allocatable :: path, text
      integer :: unit

      code = 0
      call load_deck(options, loaded, error)
      if (allocated(error)) return
      text = echo_scene(loaded%deck, loaded%scene)
      path = options%operands(1)%s//".echo"
      open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", action="write")
      write (unit) text
      close (unit)
      options%operands(1)%s = path
      call load_deck(options, again, error)
      if (.not. allocated(error)) return
      code = -2
      write (*, "(a)") "of the echo: "//printable(error%message)
   end subroutine read_echo

end program many_decks
