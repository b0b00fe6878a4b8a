!> Films of a deck at their steady state, for `gudgeon explain`: what they carry, their coefficients, when a whirl sets in.
module explain_films
   use assembly_report, only: assembly_t
   use build_system, only: levels_as_written, new_system
   use console, only: say
   use errors, only: error_t
   use kinds, only: wp
   use linear_text, only: film_lines
   use load, only: loaded_t
   use mechanism, only: mechanism_t
   use static, only: equilibrium_t, find_equilibrium
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: explain_steady_films

   integer, parameter :: most_bodies = 60  !! the search is dense: beyond them it is no matter of a moment

contains

   !> The steady state, searched as a static analysis does it; why there is none, where there is none.
   subroutine explain_steady_films(loaded)
      type(loaded_t), intent(in) :: loaded     !! the deck

      type(assembly_t) :: assembly
      type(equilibrium_t) :: equilibrium
      type(error_t), allocatable :: error
      type(mechanism_t) :: system
      type(text_t), allocatable :: words(:)
      real(wp), allocatable :: q(:), v(:)
      integer :: i, k

      if (.not. loaded%system%clearance_joints%has_films) return
      if (loaded%system%linkage%bodies%n > most_bodies) then
         call say("")
         call say("steady state of the films: omitted for more than "//to_text(most_bodies)// &
                  " bodies; --analysis static does")
         return
      end if
      call new_system(loaded%scene, levels_as_written, system)
      call system%linkage%deck_state(q, v)
      call find_equilibrium(loaded%scene, system, q, assembly, equilibrium, error, .true.)
      call say("")
      call say("steady state of the films, as computed by --analysis static")
      if (allocated(error)) then
         call say("not found: the loads at t = 0 and the driver speeds of the deck do not determine one", 2)
         call say(first_line(error%message), 4)
         return
      end if
      if (.not. (equilibrium%linear%is_judged .or. size(equilibrium%linear%films) == 0)) then
         call say("no steady state; equilibrium "//equilibrium%words, 2)
         return
      end if
      call say(equilibrium%words, 2)
      do k = 1, size(equilibrium%linear%films)
         words = film_lines(equilibrium%linear%films(k))
         call say(words(1)%s, 2)
         do i = 2, size(words)
            call say(words(i)%s, 4)
         end do
      end do
      if (equilibrium%linear%is_searched) call say(equilibrium%linear%onset_words, 2)
   end subroutine explain_steady_films

   !> The first line of a message.
   pure function first_line(message) result(line)
      character(*), intent(in) :: message    !! the message
      character(:), allocatable :: line      !! up to the first end of a line

      line = message
      if (index(message, new_line("a")) > 0) line = message(:index(message, new_line("a")) - 1)
   end function first_line

end module explain_films
