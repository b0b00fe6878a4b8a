!> Whether a run by an explicit method was stiff, and how many times fewer evaluations an implicit one would have taken.
!>
!> Where stability kept most steps short (`stability_limit`), `radau` goes on from the end of the motion, for some steps that
!> nobody sees: the ratio of evaluations per second of the motion is told. Limits: it is that of the end of the motion; none is
!> found where an event comes first.
module stiff_run
   use auto, only: auto_t
   use integrator, only: advance_step, integrator_t
   use integrator_registry, only: find_integrator
   use kind_info, only: kind_info_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use one_step, only: one_step_t
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: method_words, stiffness_warning

   integer(i8), parameter :: many = 2000       !! steps kept short, below which nothing is said
   real(wp), parameter :: most_of = 0.5_wp     !! part of all steps that they must be [1]
   real(wp), parameter :: worth = 3.0_wp       !! ratio of evaluations from which on it is told [1]
   integer, parameter :: settling = 12         !! steps of the implicit method that do not count
   integer, parameter :: n_try = 40            !! steps, at most
   real(wp), parameter :: part_of_run = 0.05_wp  !! evaluations of this, at most, of those of the run [1]

contains

   !> Name of an integrator, and what it chose.
   function method_words(method) result(words)
      class(integrator_t), intent(in) :: method   !! the integrator, after the run
      character(:), allocatable :: words          !! as `verner`

      select type (method)
      type is (auto_t)
         words = "auto ("//method%choice_in_words()//")"
      class default
         words = name_of(method)
      end select
   end function method_words

   !> The warning, blank if there is none. The system is left elsewhere.
   function stiffness_warning(system, method) result(words)
      type(mechanism_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(in) :: method   !! its integrator, at the end of the run
      character(:), allocatable :: words          !! a sentence

      real(wp) :: factor

      words = ""
      select type (method)
      type is (auto_t)
      class is (one_step_t)
         associate (seen => method%stability)
            if (seen%n_step < many .or. real(seen%n_step, wp) < most_of*real(method%count%n_steps, wp)) return
            factor = real(seen%n_step, wp)*real(method%n_new_stage + 1, wp)/seen%time
            factor = factor/evaluations_per_second(system, method, factor)
            if (factor < worth) return
            words = "stiff for method = "//name_of(method)//": stability, not accuracy, kept "//to_text(seen%n_step)//" of "// &
                    to_text(method%count%n_steps)//" steps short, to "//real_text(seen%time/real(seen%n_step, wp), 2)// &
                    " s on average; radau takes about "//real_text(factor, 2)//" times fewer evaluations: leave method out, "// &
                    "or set method = radau"
         end associate
      end select
   end function stiffness_warning

   !> Evaluations per second of the motion that `radau` takes from the end of a run on; huge: not found.
   real(wp) function evaluations_per_second(system, method, usual) result(rate)
      type(mechanism_t), intent(inout) :: system   !! the system
      class(integrator_t), intent(in) :: method    !! its integrator, at the end of the run
      real(wp), intent(in) :: usual                !! those of the explicit method [1/s]

      class(integrator_t), allocatable :: other
      integer(i8) :: most, n_first
      integer :: k, status
      real(wp) :: t_first

      rate = huge(1.0_wp)
      call find_integrator("radau", other)
      other%controls = method%controls
      other%controls%maximum_steps = 0
      other%controls%maximum_evaluations = 0
      other%controls%initial_step = 10.0_wp/usual
      most = int(part_of_run*real(method%count%n_evaluations, wp), i8)
      call other%start(system, method%t, method%step%y1, 2.0_wp*method%t, status)
      if (status /= advance_step) return
      t_first = other%t
      n_first = 0
      do k = 1, n_try
         call other%advance(system, 2.0_wp*method%t, status)
         if (status /= advance_step) return
         if (k > settling) rate = real(other%count%n_evaluations - n_first, wp)/(other%t - t_first)
         if (k == settling) then
            t_first = other%t
            n_first = other%count%n_evaluations
         end if
         if (other%count%n_evaluations > most .or. .not. other%t < 2.0_wp*method%t) return
      end do
   end function evaluations_per_second

   !> Name of an integrator.
   function name_of(method) result(name)
      class(integrator_t), intent(in) :: method  !! the integrator
      character(:), allocatable :: name          !! its name

      type(kind_info_t) :: info

      info = method%info()
      name = info%name
   end function name_of

end module stiff_run
