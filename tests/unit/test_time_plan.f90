!> The times of a motion and of its output, in seconds or in turns of a driver.
module test_time_plan
   use build_system, only: levels_as_written, new_system
   use check, only: check_close, check_equal, check_true, suite_t
   use diagnostics, only: diagnostics_t
   use errors, only: error_t
   use kinds, only: pi, wp
   use mechanism, only: mechanism_t
   use scene, only: scene_t
   use scene_fixture, only: nl, read_scene_text
   use source_text, only: source_t
   use time_plan, only: new_time_plan, time_plan_t
   implicit none (type, external)
   private
   public :: run_test_time_plan

contains

   subroutine run_test_time_plan(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("turns_of_constant_speed", test_turns_of_constant_speed)
      call suite%test("turns_of_an_angle", test_turns_of_an_angle)
      call suite%test("last_turns", test_last_turns)
      call suite%test("turns_never_made", test_turns_never_made)
      call suite%test("unknown_driver", test_unknown_driver)
      call suite%test("output_times", test_output_times)
      call suite%test("mistakes", test_mistakes)
   end subroutine run_test_time_plan

   !> Three rotors, the first with a motor at 5000 rpm, one turned backwards, one by an angle.
   function rotors(angle, settings, output) result(deck)
      character(*), intent(in) :: angle       !! of the third
      character(*), intent(in) :: settings    !! of the analysis
      character(*), intent(in) :: output      !! of the output
      character(:), allocatable :: deck       !! the deck

      deck = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"one 1 1 0 0"//nl//"two 1 1 0 0"//nl// &
             "three 1 1 0 0"//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"seat ground 0 0"//nl//"hub_1 one 0 0"//nl//"hub_2 two 0 0"//nl// &
             "hub_3 three 0 0"//nl// &
             "[joint.revolute]"//nl//"name i j"//nl//"pin_1 seat hub_1"//nl//"pin_2 seat hub_2"//nl//"pin_3 seat hub_3"//nl// &
             "[driver.speed]"//nl//"name joint speed[rpm]"//nl//"motor pin_1 5000"//nl//"back pin_2 -100"//nl// &
             "[driver.angle]"//nl//"name joint angle"//nl//"swing pin_3 "//angle//nl// &
             "[analysis.dynamic]"//nl//settings//nl//"[output]"//nl//output
   end function rotors

   !> The times of a deck; errors are an error.
   subroutine plan_of(deck, plan, error)
      character(*), intent(in) :: deck                    !! the deck
      type(time_plan_t), intent(out) :: plan              !! its times
      type(error_t), allocatable, intent(inout) :: error  !! first failure; errors

      type(diagnostics_t) :: mistakes
      type(mechanism_t) :: system
      type(scene_t) :: scene
      type(source_t) :: none(0)

      call read_scene_text(deck, scene, error)
      if (allocated(error)) return
      call new_system(scene, levels_as_written, system)
      call new_time_plan(scene, system, plan, mistakes)
      call mistakes%to_error(none, error)
   end subroutine plan_of

   !> 2 turns at 5000 rpm are 24 ms; backwards counts as well.
   subroutine test_turns_of_constant_speed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(time_plan_t) :: plan

      call plan_of(rotors("0rad", "end = 2 turns of motor", ""), plan, error)
      if (allocated(error)) return
      call check_close(error, plan%end, 24.0e-3_wp, 1.0e-17_wp, "2 turns of motor")
      call check_close(error, plan%every, 24.0e-6_wp, 1.0e-19_wp, "a thousandth of it")
      call check_close(error, plan%first_output, 0.0_wp, 0.0_wp, "from the start")
      if (allocated(error)) return
      call plan_of(rotors("0rad", "end = 0.5 turns of back", ""), plan, error)
      if (allocated(error)) return
      call check_close(error, plan%end, 0.3_wp, 1.0e-15_wp, "half a turn backwards")
   end subroutine test_turns_of_constant_speed

   !> The time at which an angle has changed by so many turns: even, accelerated, backwards, after a rest.
   subroutine test_turns_of_an_angle(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_turns("{0.7 rad + 10 rad/s*t}", "3", 0.6_wp*pi)
      call check_turns("{0.7 rad - 10 rad/s*t}", "3", 0.6_wp*pi)
      call check_turns("{1 rad + 2 rad/s^2*t^2}", "5", sqrt(5.0_wp*pi))
      call check_turns("{-4 rad*sin(0.5 rad/s*t)}", "0.25", 2.0_wp*asin(pi/8.0_wp))
      call check_turns("{9 rad/s*max(t - 2 s, 0 s)}", "1", 2.0_wp + 2.0_wp*pi/9.0_wp)

   contains

      !> Check one angle.
      subroutine check_turns(angle, turns, expected)
         character(*), intent(in) :: angle   !! expression
         character(*), intent(in) :: turns   !! how many
         real(wp), intent(in) :: expected    !! the time [s]

         type(time_plan_t) :: plan

         if (allocated(error)) return
         call plan_of(rotors(angle, "end = "//turns//" turns of swing", ""), plan, error)
         call check_close(error, plan%end, expected, 1.0e-13_wp, turns//" turns of "//angle, relative=.true.)
      end subroutine check_turns

   end subroutine test_turns_of_an_angle

   !> `last` counts turns back from the end: of an accelerated wheel the last two take less time than the first two.
   subroutine test_last_turns(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_last("{3 rad + 2 rad/s^2*t^2}", "2 turns of swing", sqrt(10.0_wp*pi), sqrt(8.0_wp*pi))
      call check_last("{-2 rad/s^2*t^2}", "2 turns of swing", sqrt(10.0_wp*pi), sqrt(8.0_wp*pi))
      call check_last("{20 rad/s*t}", "10 turns of swing", pi, 0.0_wp)
      call check_last("{7 rad/s*t - 1 rad}", "10 turns of swing", 20.0_wp*pi/7.0_wp, 0.0_wp)
      call check_last("{25 rad*pi*(1 - exp(-t/(1 s)))}", "2 turns of swing", log(5.0_wp), log(25.0_wp/9.0_wp))
      call check_mistake(error, rotors("{2 rad/s^2*t^2}", "end = 10 turns of swing", "last = 10.001 turns of swing"), &
                         "driver 'swing' never completes so many turns")
      call check_mistake(error, rotors("0rad", "end = 12 ms", "last = 2 turns of motor"), "turns")

   contains

      !> Check the first output of 10 turns, where all of the angle's turns are counted.
      subroutine check_last(angle, last, end, expected)
         character(*), intent(in) :: angle   !! expression
         character(*), intent(in) :: last    !! setting of the output
         real(wp), intent(in) :: end         !! end of 10 turns [s]
         real(wp), intent(in) :: expected    !! first output [s]

         type(time_plan_t) :: plan

         if (allocated(error)) return
         call plan_of(rotors(angle, "end = 10 turns of swing", "last = "//last), plan, error)
         call check_close(error, plan%end, end, 1.0e-12_wp, "end of 10 turns of "//angle)
         call check_close(error, plan%first_output, expected, 1.0e-9_wp, "last "//last//" of "//angle)
         call check_close(error, plan%every, 1.0e-3_wp*(end - expected), 1.0e-12_wp, "a thousandth of the output")
      end subroutine check_last

   end subroutine test_last_turns

   !> An angle that swings by less than a turn, one that does not move, and one that ends before.
   subroutine test_turns_never_made(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_mistake(error, rotors("{3 rad*sin(2 rad/s*t)}", "end = 1 turns of swing", ""), &
                         "driver 'swing' never completes so many turns")
      call check_mistake(error, rotors("2rad", "end = 1 turns of swing", ""), "driver 'swing' never completes so many turns")
      call check_mistake(error, rotors("{9 rad*sqrt(1 - t/(3 s))}", "end = 2 turns of swing", ""), &
                         "driver 'swing' never completes so many turns")
   end subroutine test_turns_never_made

   !> A driver that is not there, with the one that was meant.
   subroutine test_unknown_driver(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_mistake(error, rotors("0rad", "end = 1 turns of moter", ""), "unknown driver 'moter' in 'end'")
      call check_mistake(error, rotors("0rad", "end = 1 turns of moter", ""), "did you mean 'motor'? drivers: motor back swing")
      call check_mistake(error, rotors("0rad", "end = 1 turns of pin_1", ""), "unknown driver 'pin_1'")
   end subroutine test_unknown_driver

   !> `every`, `from` and `last`.
   subroutine test_output_times(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(time_plan_t) :: plan

      call plan_of(rotors("0rad", "end = 60 ms", "every = 10 us"//nl//"from = 1 turns of motor"), plan, error)
      if (allocated(error)) return
      call check_close(error, [plan%end, plan%first_output, plan%every], [60.0e-3_wp, 12.0e-3_wp, 10.0e-6_wp], 1.0e-17_wp, &
                       "from")
      call plan_of(rotors("0rad", "end = 60 ms", "last = 2 turns of motor"), plan, error)
      if (allocated(error)) return
      call check_close(error, [plan%end, plan%first_output, plan%every], [60.0e-3_wp, 36.0e-3_wp, 24.0e-6_wp], 1.0e-17_wp, &
                       "last")
      call plan_of(rotors("0rad", "end = 60 ms", "last = 60 ms"), plan, error)
      if (allocated(error)) return
      call check_close(error, plan%first_output, 0.0_wp, 0.0_wp, "all of it")
   end subroutine test_output_times

   !> Times that do not go together.
   subroutine test_mistakes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_mistake(error, rotors("0rad", "end = 0 s", ""), "the end time must be positive")
      call check_mistake(error, rotors("0rad", "end = 0 turns of motor", ""), "the end time must be positive")
      call check_mistake(error, rotors("{1 rad/s*t}", "end = 0 turns of swing", ""), "the end time must be positive")
      call check_mistake(error, rotors("0rad", "end = 1 s", "from = 1 ms"//nl//"last = 1 ms"), "exclude each other")
      call check_mistake(error, rotors("0rad", "end = 1 s", "last = 1.1 s"), "'last' is longer than the motion")
      call check_mistake(error, rotors("0rad", "end = 1 s", "from = 1 s"), "'from' must be before the end")
      call check_mistake(error, rotors("0rad", "end = 1 s", "from = -1 ms"), "'from' must not be negative")
      call check_mistake(error, rotors("0rad", "end = 1 s", "last = -1 ms"), "'last' must not be negative")
      call check_mistake(error, rotors("0rad", "end = 1 s", "every = 1.1 s"), "'every' is longer than what is written")
      call check_mistake(error, rotors("0rad", "end = 1 s", "last = 10 ms"//nl//"every = 11 ms"), &
                         "'every' is longer than what is written")
   end subroutine test_mistakes

   !> Fail unless a deck has an error in its times.
   subroutine check_mistake(error, deck, words)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: deck                  !! the deck
      character(*), intent(in) :: words                 !! what the message must say

      type(error_t), allocatable :: reason
      type(time_plan_t) :: plan

      if (allocated(error)) return
      call plan_of(deck, plan, reason)
      call check_true(error, allocated(reason), "'"//words//"' is a mistake")
      if (allocated(error)) return
      call check_true(error, index(reason%message, words) > 0, "'"//reason%message//"' says '"//words//"'")
   end subroutine check_mistake

end module test_time_plan
