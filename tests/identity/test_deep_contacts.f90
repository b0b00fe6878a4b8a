!> Contacts that are deeper than their impact speed could take them: the speed in their damping terms, and the damping itself.
module test_deep_contacts
   use check, only: check_close, check_true, suite_t
   use contact_registry, only: n_law_kinds
   use errors, only: error_t
   use floors, only: gentle
   use kinds, only: wp
   use law_fixture, only: make_law, steel_mass
   use normal_law, only: impact_speed_of_depth, n_law_parameter, normal_law_t, parameter_gentle
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_deep_contacts

contains

   !> Register the tests.
   subroutine run_test_deep_contacts(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("gentle_onset", test_gentle_onset)
      call suite%test("slow_onsets", test_slow_onsets)
      call suite%test("pressed_and_let_go", test_pressed_and_let_go)
   end subroutine run_test_deep_contacts

   !> The impact speed in damping terms: the given one as long as a free impact could have got as deep, whatever mass and speed;
   !> where loads press on, a tenth of the speed of the depth, and smooth between. Its derivative by differences.
   subroutine test_gentle_onset(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: masses(3) = [1.0e-6_wp, 1.0_wp, 1.0e6_wp], speeds(3) = [1.0e-9_wp, 1.0e-3_wp, 10.0_wp]
      real(wp), parameter :: stiffness = 6.6e10_wp
      real(wp) :: above, below, by_delta, deepest, gently, h, speed, unused
      integer :: i, k

      do i = 1, size(masses)
         gently = gentle**2/masses(i)
         do k = 1, size(speeds)
            deepest = (1.25_wp*masses(i)*speeds(k)**2/stiffness)**0.4_wp  ! of an elastic impact
            call speed_at(deepest, speeds(k), speed, by_delta)
            call check_close(error, speed, speeds(k), 0.0_wp, "a free impact keeps its speed")
            call check_close(error, by_delta, 0.0_wp, 0.0_wp, "wherever it is")
            ! v_d^2 = K delta^2.5/m grows with the power 2.5: a tenth of v_d is v0 at
            h = (masses(i)*(speeds(k)/gentle)**2/stiffness)**0.4_wp
            call speed_at(h*(1.0_wp + 1.0e-6_wp), speeds(k), above, by_delta)
            call check_close(error, above/speeds(k), 1.0_wp, 1.0e-10_wp, "it leaves its speed without a kink")
            call speed_at(3.0_wp*h, speeds(k), speed, by_delta)
            call speed_at(3.0_wp*h*(1.0_wp + 1.0e-5_wp), speeds(k), above, unused)
            call speed_at(3.0_wp*h*(1.0_wp - 1.0e-5_wp), speeds(k), below, unused)
            call check_close(error, by_delta, (above - below)/(6.0e-5_wp*h), 1.0e-8_wp, "its derivative", relative=.true.)
            call speed_at(1.0e3_wp*h, speeds(k), speed, by_delta)
            call check_close(error, speed, gentle*sqrt(stiffness*(1.0e3_wp*h)**2.5_wp/masses(i)), 1.0e-7_wp, "far beyond", &
                             relative=.true.)
            call speed_at(h, 0.0_wp, speed, by_delta)
            call check_close(error, speed, speeds(k), 1.0e-12_wp, "an onset without speed", relative=.true.)
         end do
      end do

   contains

      !> At a penetration.
      subroutine speed_at(delta, impact_speed, speed, by_delta)
         real(wp), intent(in) :: delta         !! penetration [m]
         real(wp), intent(in) :: impact_speed  !! impact speed [m/s]
         real(wp), intent(out) :: speed        !! in damping terms [m/s]
         real(wp), intent(out) :: by_delta     !! its derivative [1/s]

         call impact_speed_of_depth(delta, stiffness*delta**1.5_wp, 1.5_wp*stiffness*sqrt(delta), impact_speed, gently, speed, &
                                    by_delta)
      end subroutine speed_at

   end subroutine test_gentle_onset

   !> Every law: nothing but the mass sets the scale, and no onset is too gentle: with the pair's own mass the force of a slow
   !> onset has the derivatives of its differences, is finite and does not pull.
   subroutine test_slow_onsets(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      real(wp), parameter :: slow(4) = [0.0_wp, 1.0e-12_wp, 1.0e-6_wp, 1.0e-3_wp], delta = 1.0e-6_wp, part = 1.0e-6_wp
      real(wp) :: above(1), below(1), by_delta(1), by_rate(1), elastic(1), f(1), parameters(n_law_parameter), rate, unused(1), &
         unused_too(1)
      character(:), allocatable :: name
      integer :: k, kind, side

      do kind = 1, n_law_kinds()
         call make_law(kind, 2, law, parameters, name)
         parameters(parameter_gentle) = gentle**2/steel_mass
         do k = 1, size(slow)
            do side = -1, 1, 2
               rate = side*1.0e-3_wp
               call law%force(1, [delta], [rate], slow(k:k), parameters, f, by_delta, by_rate, elastic)
               call check_true(error, f(1) >= 0.0_wp .and. f(1) < 1.0e6_wp, name//": force of a slow onset")
               if (.not. f(1) > 0.0_wp) cycle
               call law%force(1, [delta], [rate*(1.0_wp + part)], slow(k:k), parameters, above, unused, unused_too, elastic)
               call law%force(1, [delta], [rate*(1.0_wp - part)], slow(k:k), parameters, below, unused, unused_too, elastic)
               call check_close(error, by_rate(1)*rate, (above(1) - below(1))/(2.0_wp*part), &
                                1.0e-5_wp*(abs(by_rate(1)*rate) + f(1)), name//": its derivative by rate")
               call law%force(1, [delta*(1.0_wp + part)], [rate], slow(k:k), parameters, above, unused, unused_too, elastic)
               call law%force(1, [delta*(1.0_wp - part)], [rate], slow(k:k), parameters, below, unused, unused_too, elastic)
               call check_close(error, by_delta(1)*delta, (above(1) - below(1))/(2.0_wp*part), &
                                1.0e-5_wp*(abs(by_delta(1))*delta + f(1)), name//": its derivative by penetration")
            end do
         end do
      end do
   end subroutine test_slow_onsets

   !> Every law whose damping is h rate/v0, h measured in an impact: without v0 the factor is the closed form in the speed of
   !> the depth, never zero however fast the surfaces part; where the depth starts to count the force has neither a jump nor a kink.
   subroutine test_pressed_and_let_go(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      character(:), allocatable :: name
      real(wp), parameter :: delta = 1.0e-6_wp, rates(5) = [-10.0_wp, -1.0e-2_wp, -1.0e-4_wp, 1.0e-4_wp, 1.0e-2_wp]
      real(wp) :: by_delta(3), by_rate(3), elastic(3), f(3), h, join, parameters(n_law_parameter), speed, x
      integer :: k, kind, n_family

      n_family = 0
      do kind = 1, n_law_kinds()
         call make_law(kind, 2, law, parameters, name)
         parameters(parameter_gentle) = gentle**2/steel_mass
         call law%force(2, spread(delta, 1, 2), spread(0.1_wp, 1, 2), [1.0_wp, 2.0_wp], spread(parameters, 2, 2), f(:2), &
                        by_delta(:2), by_rate(:2), elastic(:2))
         h = (f(1)/elastic(1) - 1.0_wp)/0.1_wp
         if (.not. (h > 0.0_wp .and. abs(by_rate(2) - 0.5_wp*by_rate(1)) < 1.0e-10_wp*by_rate(1))) cycle
         if (index(name, "expression") > 0) cycle  ! its v0 may stand anywhere
         n_family = n_family + 1
         speed = gentle*sqrt(elastic(1)*delta/steel_mass)
         do k = 1, size(rates)
            call law%force(1, [delta], rates(k:k), [0.0_wp], parameters, f(:1), by_delta(:1), by_rate(:1), elastic(:1))
            x = h*rates(k)/speed
            call check_close(error, f(1)/elastic(1), merge(x + sqrt(1.0_wp + x*x), 1.0_wp/(sqrt(1.0_wp + x*x) - x), x > 0.0_wp), &
                             1.0e-9_wp, name//": the factor", relative=.true.)
            call check_true(error, f(1) > 0.0_wp, name//": it is never cut off")
         end do
         ! just before, at and just behind the depth that counts
         join = speed*(1.0_wp + 1.0e-5_wp)
         call law%force(3, spread(delta, 1, 3), spread(-0.5_wp*speed/h, 1, 3), [join, speed, 2.0_wp*speed - join], &
                        spread(parameters, 2, 3), f, by_delta, by_rate, elastic)
         call check_close(error, f(1), f(3), 1.0e-4_wp*f(2), name//": no jump")
         call check_close(error, by_delta(1), by_delta(3), 1.0e-4_wp*abs(by_delta(2)), name//": no kink by the penetration")
         call check_close(error, by_rate(1), by_rate(3), 1.0e-4_wp*by_rate(2), name//": no kink by the rate")
      end do
      call check_true(error, n_family >= 10, "laws of this damping: "//to_text(n_family))
   end subroutine test_pressed_and_let_go

end module test_deep_contacts
