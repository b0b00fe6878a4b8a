!> The temperature of films at a steady state, by a balance of heat: what a film loses the side flow carries away.
!>
!> Delta T = P/(rho c Q),   T = T_in + Delta T/2
!>
!> with P the power of the film, Q what leaves at its ends, and the viscosity that of T. Half of what is missing is added, and the
!> journal settles anew, until nothing is missing.
!>
!> Source: DIN 31652-1, Hydrodynamische Radial-Gleitlager im stationaeren Betrieb (cooling by the lubricant; effective temperature
!> as the mean of inlet and outlet). Limits: steady states; no heat goes through the housing; the pressure at which lubricant is
!> supplied adds no flow.
module film_heat
   use errors, only: error_t, exit_assembly, set_error
   use film_law, only: film_motion_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use static_film, only: settle_in_films
   use static_problem, only: balance_t, is_balanced, look_at
   use text, only: real_text
   implicit none (type, external)
   private
   public :: balance_heat

   real(wp), parameter :: same = 1.0e-7_wp        !! difference of temperatures that is none [K]
   real(wp), parameter :: hottest = 473.15_wp     !! beyond it no oil lasts: the search ends there [K]
   integer, parameter :: n_round = 200            !! corrections of the temperatures

contains

   !> Find temperatures and the equilibrium that goes with them.
   subroutine balance_heat(system, part, tolerance, most, q, balance, steps, error)
      class(mechanism_t), intent(inout) :: system           !! the system; its films get their temperatures
      real(wp), intent(in) :: part                          !! unbalanced load tried for, of the largest [1]
      real(wp), intent(in) :: tolerance                     !! unbalanced load allowed, of the largest [1]
      integer, intent(in) :: most                           !! steps allowed for an equilibrium
      real(wp), intent(inout) :: q(:)                       !! (n_q bodies) positions of the equilibrium, moved [any]
      type(balance_t), intent(inout) :: balance             !! there
      integer, intent(inout) :: steps                       !! steps made so far
      type(error_t), allocatable, intent(out) :: error      !! there is no balance

      character(:), allocatable :: worst
      real(wp) :: missing
      integer :: begun, round
      logical :: is_settled

      do round = 1, n_round
         call look_at(system, q)
         call correct_temperatures(system, missing, worst, error)
         if (allocated(error) .or. missing <= same) return
         begun = 0
         call settle_in_films(system, part, most, q, balance, begun, is_settled)
         steps = steps + begun
         if (.not. is_balanced(system, balance, tolerance)) exit
      end do
      call set_error(error, exit_assembly, "the heat of the film of joint '"//worst//"' has no thermal equilibrium: "// &
                     real_text(missing, 3)//" K remain"//new_line("a")// &
                     "  = with heat = off the film keeps the temperature of the lubricant")
   end subroutine balance_heat

   !> Bring the temperature of each heated film half the way to what its heat asks for.
   subroutine correct_temperatures(system, missing, worst, error)
      class(mechanism_t), intent(inout) :: system           !! the system at an equilibrium
      real(wp), intent(out) :: missing                      !! maximum difference of temperatures before that [K]
      character(:), allocatable, intent(out) :: worst       !! joint that has it
      type(error_t), allocatable, intent(out) :: error      !! a film has no flow, or gets too hot

      type(film_motion_t) :: motion
      real(wp) :: change
      integer :: i, k

      missing = 0.0_wp
      worst = ""
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (.not. allocated(set%laws%films)) cycle
            associate (films => set%laws%films, items => set%items)
               do i = 1, set%n
                  if (.not. films%place(i)%is_heated) cycle
                  motion = films%motion_of(i, items%body(:, i), items%s_i(:, i), items%s_j(:, i), system%linkage%motion)
                  associate (state => films%state_of(i, items%body(:, i), motion, system%linkage%motion))
                     if (.not. state%has_flow) then
                        call set_error(error, exit_assembly, "film of joint '"//set%names(i)%s// &
                                       "' has no side flow, so its heat balance has no solution"//new_line("a")// &
                                       "  = with heat = off the film keeps the temperature of the lubricant")
                        return
                     end if
                     change = films%oil(i)%temperature + 0.5_wp*state%rise - films%place(i)%temperature
                  end associate
                  if (abs(change) >= missing) worst = set%names(i)%s
                  missing = max(missing, abs(change))
                  if (missing <= same) cycle
                  call films%warm(i, items%pairs(i), min(films%place(i)%temperature + 0.5_wp*change, hottest))
               end do
            end associate
         end associate
      end do
   end subroutine correct_temperatures

end module film_heat
