!> Whether a run by an explicit method was stiff, and how many times fewer evaluations an implicit one would have taken.
!>
!> At the end of a run whose steps were many and as short as the next one, the method for stiff equations is tried
!> (`method_trial`). The ratio of evaluations per second of the motion is reported. Limits: it is that of the end of the motion.
module stiff_run
   use integration_method, only: abilities_t
   use integrator, only: integrator_t
   use integrator_registry, only: find_stiff_integrator
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use method_trial, only: run_trial, trial_t
   use one_step, only: one_step_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: stiffness_warning

   integer(i8), parameter :: many = 4000       !! steps, below which nothing is said
   real(wp), parameter :: shorter = 2.0_wp     !! next step over the mean one, at most [1]
   real(wp), parameter :: worth = 3.0_wp       !! ratio of evaluations from which on it is reported [1]
   integer, parameter :: n_step = 40           !! steps of the trial
   real(wp), parameter :: part_of_run = 0.01_wp  !! length of the trial, of the run, at most [1]

contains

   !> The warning, blank if there is none. The system is left elsewhere.
   function stiffness_warning(system, method) result(words)
      type(mechanism_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(in) :: method   !! its integrator, at the end of the run
      character(:), allocatable :: words          !! a sentence

      class(integrator_t), allocatable :: stiff
      type(abilities_t) :: can
      type(trial_t) :: trial
      real(wp) :: factor, h

      words = ""
      can = method%abilities()
      if (can%parts /= "") return
      select type (method)
      class is (one_step_t)
         h = method%pace%h_next
         if (.not. method%stability%is_watched .or. method%count%n_steps < many) return
         if (h*real(method%count%n_steps, wp) > shorter*method%t) return
         call find_stiff_integrator(stiff)
         select type (stiff)
         class is (one_step_t)
            call run_trial(stiff, system, method%controls, method%t, method%step%y1, (1.0_wp + part_of_run)*method%t, h, n_step, &
                           trial)
         end select
         factor = real(method%n_new_stage + 1, wp)/h*(trial%t_end - trial%t_begin)/real(trial%n_evaluation, wp)
         if (factor < worth) return
         words = "stiff for method = "//method%name()//": stability limits its steps to "//real_text(h, 2)// &
                 " s; "//stiff%name()//" needs about "//real_text(factor, 2)// &
                 " times fewer evaluations at the end of the motion: set method = auto or "//stiff%name()
      end select
   end function stiffness_warning

end module stiff_run
