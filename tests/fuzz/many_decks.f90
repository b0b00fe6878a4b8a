!> Many decks in one process, for `make fuzz`: each line of the standard input is a verb, check or explain, perhaps `--ideal`,
!> and a deck. Before each a line `begin N` is written, after it `end N CODE`, so that a crash has a name.
program many_decks
   use, intrinsic :: ieee_arithmetic, only: ieee_set_underflow_mode, ieee_support_underflow_control
   use, intrinsic :: iso_fortran_env, only: input_unit, output_unit
   use blas_threads, only: use_one_blas_thread
   use errors, only: error_t
   use kinds, only: wp
   use options, only: options_t
   use text, only: split_blank, text_t
   use verb_explain, only: check_deck, explain_deck
   implicit none (type, external)

   type(error_t), allocatable :: error
   type(options_t) :: options
   type(text_t), allocatable :: words(:)
   character(1000) :: line
   integer :: code, k, status

   options%write = "all"
   allocate (options%change%overrides(0))
   call use_one_blas_thread(error)
   if (allocated(error)) error stop error%code
   if (ieee_support_underflow_control(1.0_wp)) call ieee_set_underflow_mode(gradual=.false.)
   k = 0
   do
      read (input_unit, "(a)", iostat=status) line
      if (status /= 0) exit
      k = k + 1
      words = split_blank(trim(line))
      options%verb = words(1)%s
      options%change%is_ideal = size(words) > 2
      options%operands = [words(size(words))]
      write (output_unit, "(a, i0)") "begin ", k
      flush (output_unit)
      if (options%verb == "check") then
         call check_deck(options, error)
      else
         call explain_deck(options, error)
      end if
      code = 0
      if (allocated(error)) then
         code = error%code
         if (len_trim(error%message) == 0) code = -1
      end if
      write (output_unit, "(a, i0, 1x, i0)") "end ", k, code
      flush (output_unit)
   end do
end program many_decks
