!> From a deck to what the dynamic level of a study of tolerances is asked: numbers of a run with their limits.
module dynamic_setup
   use errors, only: error_t, exit_usage, set_error
   use kinds, only: wp
   use load, only: find_catalogue, loaded_t
   use run_numbers, only: find_run_numbers
   use statistics, only: number_t
   use text, only: append_text, text_t
   use tolerance_results, only: request_t, tolerance_study_t
   use tolerance_setup, only: add_limits
   implicit none (type, external)
   private
   public :: set_up_numbers

contains

   !> Set up a study whose plan is read and settled. The tables were checked when the deck was loaded.
   subroutine set_up_numbers(loaded, study, channels, error)
      type(loaded_t), intent(inout) :: loaded                !! the deck, of a dynamic analysis
      type(tolerance_study_t), intent(inout) :: study        !! contributors and requests are set
      type(text_t), allocatable, intent(out) :: channels(:)  !! (n) channels that a run must observe
      type(error_t), allocatable, intent(out) :: error       !! nothing is asked

      integer :: k

      call find_catalogue(loaded)
      allocate (study%pins(0), study%requests(0), study%contributors(0), channels(0))
      do k = 1, size(study%plan%parameters)
         call append_text(study%contributors, study%plan%parameters(k)%name)
      end do
      study%contributors = [study%contributors, study%plan%batches]
      do k = 1, size(study%plan%requests)
         call add_word(study%plan%requests(k)%s, 0)
      end do
      do k = 1, size(study%plan%limits)
         call add_word(study%plan%limits(k)%channel, k)
      end do
      if (.not. any(study%plan%parameters%sigma > 0.0_wp)) then
         call set_error(error, exit_usage, "nothing scatters: no parameter has a tolerance"//new_line("a")// &
                        "  = give a row of [tolerance]")
      else if (study%plan%sampling%rare > 0) then
         call set_error(error, exit_usage, "rare of [tolerance.study] needs the kinematic level: each member is a run here"// &
                        new_line("a")//"  = omit it, and take more members")
      else if (size(study%requests) == 0) then
         call set_error(error, exit_usage, "the deck has no requests of a run"//new_line("a")// &
                        "  = name some as requests of [tolerance.study], as slider.acceleration.x.rms")
      end if

   contains

      !> Add the numbers that a word names, each once, and their limits.
      subroutine add_word(word, limit)
         character(*), intent(in) :: word   !! as in the deck
         integer, intent(in) :: limit       !! number of its limit; 0: none

         type(number_t), allocatable :: numbers(:)
         type(request_t) :: request
         character(:), allocatable :: channel, hint, message
         integer :: i, m

         call find_run_numbers(word, loaded%scene, loaded%catalogue, .false., numbers, channel, message, hint)
         if (channel /= "") call append_text(channels, channel)
         do i = 1, size(numbers)
            do m = 1, size(study%requests)
               if (study%requests(m)%name == numbers(i)%name) exit
            end do
            if (m > size(study%requests)) then
               request%name = numbers(i)%name
               request%unit = numbers(i)%unit
               study%requests = [study%requests, request]
            end if
            if (limit == 0) cycle
            call add_limits(study%plan%limits(limit), study%requests(m))
         end do
      end subroutine add_word

   end subroutine set_up_numbers

end module dynamic_setup
