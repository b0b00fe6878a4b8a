!> The speed at which a mechanism on lubricant films starts to whirl: all drivers faster or slower in one proportion.
!>
!> From the speed of the deck on, faster where it is stable there and slower where it is not, by steps of a tenth; the equilibrium
!> of each speed is found from that of the one before. Where the maximum real part of the eigenvalues has changed its sign, the
!> zero is found by regula falsi (Illinois). What comes out is the nearest change, if there are not two within one step.
!>
!> Source: M. Dowell and P. Jarratt, A modified regula falsi method, BIT 11 (1971) 168-174; otherwise `steady_stability`.
!> Limits: loads are those of the deck at any speed.
module whirl_onset
   use kinds, only: not_a_number, two_pi, wp
   use linearised, only: linearised_t
   use mechanism, only: mechanism_t
   use static_film, only: settle_in_films
   use static_problem, only: balance_t, is_balanced, look_at
   use steady_stability, only: find_eigenvalues, no_growth
   use text, only: real_text
   implicit none (type, external)
   private
   public :: find_onset

   real(wp), parameter :: ratio = 1.1_wp            !! of two speeds of the search [1]
   real(wp), parameter :: enough = 1.0e-8_wp        !! unbalanced load that is enough for a trial, of the largest [1]
   real(wp), parameter :: close = 1.0e-9_wp         !! width of the bracket in the end, of the speed [1]
   integer, parameter :: most = 60                  !! steps of an equilibrium, and of the bracket

   !> A speed and what happens there.
   type :: trial_t
      real(wp) :: speed = 1.0_wp          !! over that of the deck [1]
      real(wp) :: growth = 0.0_wp         !! maximum real part [1/s]
      real(wp) :: frequency = 0.0_wp      !! imaginary part that belongs to it [rad/s]
      real(wp), allocatable :: q(:)       !! (n_q bodies) the equilibrium [any]
   end type trial_t

contains

   !> Search up to a multiple of the speed, or down to that part of it.
   subroutine find_onset(system, q, tolerance, range, balance, linear)
      class(mechanism_t), intent(inout) :: system      !! the system; left at the equilibrium
      real(wp), intent(in) :: q(:)                     !! (n_q bodies) equilibrium at the speed of the deck [any]
      real(wp), intent(in) :: tolerance                !! unbalanced load allowed, of the largest [1]
      real(wp), intent(in) :: range                    !! the multiple [1]
      type(balance_t), intent(inout) :: balance        !! evaluations are counted
      type(linearised_t), intent(inout) :: linear      !! with eigenvalues; the onset is set

      type(trial_t) :: here, next
      character(:), allocatable :: so_far
      logical :: is_found, is_stable

      linear%is_searched = .true.
      linear%onset = not_a_number()
      linear%onset_frequency = not_a_number()
      here = trial_t(1.0_wp, linear%eigenvalues(1, 1), abs(linear%eigenvalues(2, 1)), q)
      is_stable = here%growth < 0.0_wp
      do
         next = here
         next%speed = merge(min(here%speed*ratio, range), max(here%speed/ratio, 1.0_wp/range), is_stable)
         call try(system, tolerance, next, balance, is_found)
         if (.not. is_found) exit
         if (next%growth < 0.0_wp .neqv. is_stable) exit
         here = next
         if (abs(log(here%speed)) >= log(range)*(1.0_wp - close)) exit
      end do
      linear%searched_to = here%speed
      so_far = trim(merge("stable up to    ", "unstable down to", is_stable))//" "//real_text(here%speed, 4)//" times this speed"
      if (.not. is_found) then
         linear%onset_words = so_far//"; no steady state found beyond"
      else if (next%growth < 0.0_wp .eqv. is_stable) then
         linear%onset_words = so_far
      else
         call narrow(system, tolerance, here, next, balance)
         linear%onset = next%speed
         linear%onset_frequency = next%frequency
         linear%searched_to = next%speed
         linear%onset_words = "stable below "//real_text(next%speed, 6)//" times this speed"
         if (next%frequency > 0.0_wp) linear%onset_words = linear%onset_words//"; whirl onset at "// &
                                                           real_text(next%frequency/two_pi, 6)//" Hz"
      end if
      balance%speed = 1.0_wp
      call look_at(system, q)
   end subroutine find_onset

   !> Equilibrium and growth at a speed.
   subroutine try(system, tolerance, trial, balance, is_found)
      class(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: tolerance                !! unbalanced load allowed, of the largest [1]
      type(trial_t), intent(inout) :: trial            !! its speed, and an equilibrium nearby; the rest is set
      type(balance_t), intent(inout) :: balance        !! at that speed
      logical, intent(out) :: is_found                 !! there is an equilibrium

      real(wp), allocatable :: eigenvalues(:, :)
      integer :: steps

      balance%speed = trial%speed
      steps = 0
      call settle_in_films(system, tolerance, most, trial%q, balance, steps, is_found)
      is_found = is_balanced(system, balance, max(tolerance, enough))
      if (.not. is_found) return
      call find_eigenvalues(system, trial%q, balance, eigenvalues)
      trial%growth = eigenvalues(1, 1)
      if (abs(trial%growth) <= no_growth(eigenvalues)) trial%growth = 0.0_wp
      trial%frequency = abs(eigenvalues(2, 1))
   end subroutine try

   !> Narrow a bracket of the change.
   subroutine narrow(system, tolerance, here, there, balance)
      class(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: tolerance                !! unbalanced load allowed, of the largest [1]
      type(trial_t), intent(in) :: here                !! one end of the bracket
      type(trial_t), intent(inout) :: there            !! the other; then the change
      type(balance_t), intent(inout) :: balance        !! evaluations are counted

      type(trial_t) :: low, middle
      integer :: k
      logical :: is_found

      low = here
      do k = 1, most
         if (.not. abs(there%growth) > 0.0_wp .or. abs(there%speed - low%speed) <= close*there%speed) return
         middle = there
         middle%speed = (low%speed*there%growth - there%speed*low%growth)/(there%growth - low%growth)
         call try(system, tolerance, middle, balance, is_found)
         if (.not. is_found) return
         if (middle%growth < 0.0_wp .neqv. there%growth < 0.0_wp) then
            low = there
         else
            low%growth = 0.5_wp*low%growth
         end if
         there = middle
      end do
   end subroutine narrow

end module whirl_onset
