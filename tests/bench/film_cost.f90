!> What an evaluation of each film costs: nanoseconds a bearing, over random states up to an eccentricity of 0.99.
!>
!>     film_cost inputs/journal_bearing.deck      times every film of the deck's tables in a bearing with L/D = 1
program film_cost
   use, intrinsic :: iso_fortran_env, only: error_unit
   use deck_file, only: read_deck
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use film_law, only: film_bearing_t, film_law_t, film_motion_t, n_film_parameter
   use kinds, only: i8, wp
   use read_scene, only: scene_from_deck
   use scene, only: scene_t
   use text, only: text_t
   implicit none (type, external)

   integer, parameter :: n_state = 1000           ! bearings in one call, of fast films
   integer, parameter :: n_few = 10               ! bearings in one call, of slow ones
   real(wp), parameter :: slow = 1.0e-3_wp        ! time of a few bearings from which a film is slow [s]
   real(wp), parameter :: min_time = 0.1_wp     ! of a measurement [s]
   integer, parameter :: n_repeat = 3             ! measurements, of which the shortest counts
   type(film_bearing_t), parameter :: bearing = film_bearing_t(10.0e-3_wp, 0.1e-3_wp, 20.0e-3_wp, 0.1_wp, 0.999_wp)

   type(deck_t) :: deck
   type(diagnostics_t) :: mistakes
   type(scene_t) :: scene
   type(text_t) :: none(0)
   type(film_motion_t) :: motion(n_state)
   character(200) :: path
   integer :: k

   if (command_argument_count() /= 1) then
      write (error_unit, "(a)") "film_cost: name a deck with films"
      stop 2
   end if
   call get_command_argument(1, path)
   call read_deck(trim(path), none, deck, mistakes)
   if (mistakes%count() == 0) call scene_from_deck(deck, scene, mistakes)
   if (mistakes%count() > 0) then
      write (error_unit, "(a)") "film_cost: the deck has mistakes"
      stop 3
   end if
   call make_states(motion)
   write (*, "(a)") "film                 ns per bearing"
   do k = 1, size(scene%lubrication%films)
      associate (law => scene%lubrication%films(k)%law)
         write (*, "(a, t20, f10.1)") law%name, 1.0e9_wp*time_of(law)
      end associate
   end do

contains

   !> States that look random and are the same every time.
   subroutine make_states(states)
      type(film_motion_t), intent(out) :: states(:)  !! (n) states

      real(wp) :: angle, x(4)
      integer :: i

      do i = 1, size(states)
         x = modulo(real(i, wp)*[0.754877666_wp, 0.569840291_wp, 0.437015816_wp, 0.618033989_wp], 1.0_wp)
         angle = 6.283185307_wp*x(1)
         states(i)%e = 0.99_wp*bearing%clearance*x(2)*[cos(angle), sin(angle)]
         states(i)%e_dot = 0.01_wp*[2.0_wp*x(3) - 1.0_wp, 2.0_wp*x(4) - 1.0_wp]
         states(i)%speed_sum = 400.0_wp*(x(3) - x(1))
         states(i)%speed_difference = states(i)%speed_sum
         states(i)%angle = angle*x(4)
      end do
   end subroutine make_states

   !> Time of a bearing [s].
   real(wp) function time_of(law) result(time)
      class(film_law_t), intent(in) :: law  !! the film

      character(:), allocatable :: help, message
      real(wp), allocatable :: parameters(:, :)
      real(wp) :: f(2, n_state), of_one(n_film_parameter), one, total
      integer(i8) :: begin, end, n, rate
      integer :: i, m, repeat_number

      call law%fit(bearing, of_one, message, help)
      parameters = spread(of_one, 2, n_state)
      time = huge(1.0_wp)
      total = 0.0_wp
      call system_clock(begin, rate)
      call law%force(n_few, motion(:n_few), parameters(:, :n_few), f(:, :n_few))
      call system_clock(end)
      m = merge(n_few, n_state, real(end - begin, wp)/real(rate, wp) > slow)
      do repeat_number = 1, n_repeat
         n = 0
         call system_clock(begin, rate)
         do
            do i = 1, merge(1, 10, m < n_state)
               call law%force(m, motion(:m), parameters(:, :m), f(:, :m))
               total = total + f(1, 1)
               n = n + m
            end do
            call system_clock(end)
            one = real(end - begin, wp)/real(rate, wp)
            if (one > min_time) exit
         end do
         time = min(time, one/real(n, wp))
      end do
      if (total > huge(1.0_wp)) time = huge(1.0_wp)  ! the forces are used
   end function time_of

end program film_cost
