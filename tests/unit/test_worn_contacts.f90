!> Contact on worn surfaces: round ones against the closed form, derivatives against differences, invariance, edges of cells.
module test_worn_contacts
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, pi, wp
   use overlap_rays, only: pin_t
   use overlap_sums, only: arc_t, to_gradient, to_second
   use surface_overlap, only: find_overlap, overlap_t
   use surfaces, only: put_inside, surfaces_t
   use surface_profile, only: new_profile, profile_t
   implicit none (type, external)
   private
   public :: run_test_worn_contacts

   real(wp), parameter :: hole = 10.0e-3_wp, clearance = 0.1e-3_wp, length = 15.0e-3_wp

contains

   !> Register the tests.
   subroutine run_test_worn_contacts(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("surfaces_that_have_lost_nothing", test_round)
      call suite%test("derivatives_of_the_penetration_of_worn_surfaces", test_derivatives)
      call suite%test("everything_turns_together", test_turned)
      call suite%test("pins_of_steps_that_are_not_accepted", test_far)
      call suite%test("arc_that_passes_edges_of_cells", test_edges)
      call suite%test("arc_of_a_worn_bush", test_conformal)
   end subroutine run_test_worn_contacts

   !> A pair with volumes at random in each cell, as deep as a part of the clearance.
   subroutine new_pair(n, depth, seed, pair)
      integer, intent(in) :: n                  !! cells
      real(wp), intent(in) :: depth             !! of the deepest cell, about [m]
      integer(i8), intent(in) :: seed           !! of the volumes
      type(surfaces_t), intent(out) :: pair     !! the pair

      real(wp) :: volume(n)
      type(random_t) :: random
      integer :: k, side

      call put_inside(pair, hole, clearance)
      pair%length = length
      allocate (pair%worn)
      random%state = seed
      do side = 1, 2
         volume = [(random%between(0.0_wp, 1.0_wp), k=1, n)]
         do k = 1, 3  ! as smooth as wear is
            volume = (volume + cshift(volume, 1) + cshift(volume, -1) + cshift(volume, 2))/4
         end do
         volume = volume*depth*length*hole*2.0_wp*pi/n
         if (side == 1) call new_profile(pair%worn%hole, .true., pair%radius_i, length, volume)
         if (side == 2) call new_profile(pair%worn%pin, .false., pair%radius_j, length, volume)
      end do
   end subroutine new_pair

   !> A pin at a place and with a motion at random.
   function some_pin(random, distance) result(pin)
      type(random_t), intent(inout) :: random   !! the source
      real(wp), intent(in) :: distance          !! of the centres [m]
      type(pin_t) :: pin                        !! the pin

      integer :: k

      pin%phi = random%between(-pi, pi)
      pin%e = distance*[cos(pin%phi), sin(pin%phi)]
      do k = 1, 2
         pin%e_dot(k) = random%between(-0.1_wp, 0.1_wp)
         pin%e_ddot(k) = random%between(-100.0_wp, 100.0_wp)
         pin%angle(k) = random%between(-10.0_wp, 10.0_wp)
         pin%omega(k) = random%between(-50.0_wp, 50.0_wp)
         pin%alpha(k) = random%between(-1.0e4_wp, 1.0e4_wp)
      end do
      call place(pin)
   end function some_pin

   !> Distance and direction from e.
   subroutine place(pin)
      type(pin_t), intent(inout) :: pin   !! set

      pin%distance = norm2(pin%e)
      pin%phi = atan2(pin%e(2), pin%e(1))
   end subroutine place

   !> Where the pin is after a time, at constant accelerations.
   type(pin_t) function moved(pin, t)
      type(pin_t), intent(in) :: pin   !! the pin
      real(wp), intent(in) :: t        !! the time [s]

      moved = pin
      moved%e = pin%e + pin%e_dot*t + 0.5_wp*pin%e_ddot*t**2
      moved%e_dot = pin%e_dot + pin%e_ddot*t
      moved%angle = pin%angle + pin%omega*t + 0.5_wp*pin%alpha*t**2
      moved%omega = pin%omega + pin%alpha*t
      call place(moved)
   end function moved

   !> delta = |e| - c, n = e/|e|, nothing else, in contact and apart.
   subroutine test_round(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(overlap_t) :: overlap
      type(pin_t) :: pin
      type(surfaces_t) :: pair
      type(random_t) :: random
      real(wp) :: delta, noise, turn
      integer :: k

      random%state = 3_i8
      call new_pair(360, 0.0_wp, 1_i8, pair)
      do k = 1, 60
         delta = 10.0_wp**random%between(-10.0_wp, -4.0_wp)
         if (modulo(k, 3) == 0) delta = -random%between(0.0_wp, 0.9_wp)*clearance
         pin = some_pin(random, clearance + delta)
         call find_overlap(pair, pin, to_second, overlap)
         delta = pin%distance - clearance
         call check_close(error, overlap%delta, delta, 1.0e-12_wp*abs(delta) + 2.0e-19_wp, "penetration")
         if (allocated(error)) return
         noise = merge(1.0e-10_wp + 1.0e-18_wp/abs(delta), 1.0e-7_wp, delta > 0.0_wp)  ! a maximum of d is flat
         call check_close(error, overlap%gradient, pin%e/pin%distance, noise, "normal")
         if (allocated(error)) return
         call check_close(error, [overlap%by_i, overlap%by_j, overlap%depth], [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-17_wp, "others")
         if (allocated(error)) return
         associate (n => pin%e/pin%distance)
            call check_close(error, overlap%rate, dot_product(n, pin%e_dot), noise, "rate")
            if (allocated(error)) return
            turn = (n(1)*pin%e_dot(2) - n(2)*pin%e_dot(1))/pin%distance
            call check_close(error, n(1)*overlap%gradient_rate(2) - n(2)*overlap%gradient_rate(1), turn, 1.0e-6_wp*abs(turn), &
                             "turn")
            if (allocated(error)) return
            ! terms that cancel are as large as the square of the rate over the penetration
            noise = 1.0e-7_wp*overlap%rate**2/abs(delta)
            call check_close(error, dot_product(n, overlap%gradient_rate), 0.0_wp, noise/abs(overlap%rate), "growth")
            if (allocated(error)) return
            call check_close(error, overlap%second, dot_product(n, pin%e_ddot) + turn**2*pin%distance, 1.0e-6_wp + noise, "second")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_round

   !> Gradient, rates and second derivatives against differences, in contact and apart.
   subroutine test_derivatives(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-9_wp, time = 1.0e-7_wp, turn = 1.0e-6_wp
      type(overlap_t) :: fore, here, rear
      type(pin_t) :: pin, shifted
      type(surfaces_t) :: pair
      type(random_t) :: random
      real(wp) :: slope
      integer :: k, m, n_contact

      random%state = 5
      n_contact = 0
      call new_pair(60, 0.3_wp*clearance, 2_i8, pair)
      do k = 1, 60
         pin = some_pin(random, clearance*random%between(0.6_wp, 1.7_wp))
         call find_overlap(pair, pin, to_second, here)
         if (here%delta > 0.0_wp) n_contact = n_contact + 1
         if (abs(here%delta) < 1.0e-6_wp) cycle  ! differences would go beyond the onset
         do m = 1, 2
            shifted = pin
            shifted%e(m) = pin%e(m) + step
            call place(shifted)
            call find_overlap(pair, shifted, to_gradient, fore)
            shifted%e(m) = pin%e(m) - step
            call place(shifted)
            call find_overlap(pair, shifted, to_gradient, rear)
            call check_close(error, here%gradient(m), (fore%delta - rear%delta)/(2.0_wp*step), 2.0e-5_wp, "gradient")
            if (allocated(error)) return
            shifted = pin
            shifted%angle(m) = pin%angle(m) + turn
            call find_overlap(pair, shifted, to_gradient, fore)
            shifted%angle(m) = pin%angle(m) - turn
            call find_overlap(pair, shifted, to_gradient, rear)
            slope = merge(here%by_i, here%by_j, m == 1)
            call check_close(error, slope, (fore%delta - rear%delta)/(2.0_wp*turn), 3.0e-8_wp, "by the angle of a body")
            if (allocated(error)) return
         end do
         call find_overlap(pair, moved(pin, time), to_second, fore)
         call find_overlap(pair, moved(pin, -time), to_second, rear)
         call check_close(error, here%rate, (fore%delta - rear%delta)/(2.0_wp*time), 1.0e-5_wp, "rate")
         if (allocated(error)) return
         call check_close(error, here%second, (fore%rate - rear%rate)/(2.0_wp*time), 1.0e-3_wp*abs(here%second) + 1.0_wp, "second")
         if (allocated(error)) return
         call check_close(error, here%gradient_rate, (fore%gradient - rear%gradient)/(2.0_wp*time), &
                          1.0e-3_wp*norm2(here%gradient_rate) + 1.0_wp, "rate of the gradient")
         if (allocated(error)) return
         call check_close(error, here%depth_rate, (fore%depth - rear%depth)/(2.0_wp*time), &
                          1.0e-3_wp*abs(here%depth_rate) + 1.0e-6_wp, "rate of the depth")
         if (allocated(error)) return
      end do
      call check_true(error, n_contact > 20 .and. n_contact < 50, "some in contact, some apart")
   end subroutine test_derivatives

   !> A common rotation changes nothing but directions: e x g + d/d alpha_i + d/d alpha_j = 0.
   subroutine test_turned(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(overlap_t) :: here, there
      type(pin_t) :: pin, turned
      type(surfaces_t) :: pair
      type(random_t) :: random
      real(wp) :: beta
      integer :: k

      random%state = 7
      call new_pair(360, 0.3_wp*clearance, 4_i8, pair)
      do k = 1, 30
         pin = some_pin(random, clearance*random%between(0.6_wp, 1.7_wp))
         beta = random%between(-10.0_wp, 10.0_wp)
         turned = pin
         turned%e = [cos(beta)*pin%e(1) - sin(beta)*pin%e(2), sin(beta)*pin%e(1) + cos(beta)*pin%e(2)]
         turned%angle = pin%angle + beta
         call place(turned)
         call find_overlap(pair, pin, to_gradient, here)
         call find_overlap(pair, turned, to_gradient, there)
         call check_close(error, there%delta, here%delta, 1.0e-15_wp, "penetration")
         if (allocated(error)) return
         call check_close(error, pin%e(1)*here%gradient(2) - pin%e(2)*here%gradient(1) + here%by_i + here%by_j, 0.0_wp, &
                          1.0e-12_wp, "moments")
         if (allocated(error)) return
      end do
   end subroutine test_turned

   !> Turns without number and a pin outside of its hole come to an end.
   subroutine test_far(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(overlap_t) :: here, there
      type(pin_t) :: pin
      type(surfaces_t) :: pair
      type(random_t) :: random

      random%state = 9_i8
      call new_pair(90, 0.3_wp*clearance, 8_i8, pair)
      pin = some_pin(random, 1.5_wp*clearance)
      call find_overlap(pair, pin, to_gradient, here)
      pin%angle = pin%angle + 2.0e5_wp*pi
      call find_overlap(pair, pin, to_gradient, there)
      call check_close(error, there%delta, here%delta, 1.0e-11_wp, "many turns")
      if (allocated(error)) return
      pin%angle = [1.0e13_wp, -3.0e14_wp]
      call find_overlap(pair, pin, to_gradient, there)
      call check_true(error, abs(there%delta) < clearance, "turns without number")
      if (allocated(error)) return
      pin = some_pin(random, 3.0_wp*hole)
      call find_overlap(pair, pin, to_gradient, there)
      call check_close(error, there%delta, 3.0_wp*hole - clearance, 1.0e-15_wp, "a pin outside of its hole")
   end subroutine test_far

   !> A narrow arc goes along the hole past edges of cells: penetration and gradient have no jumps there; where the pin is round the
   !> gradient has no corner either, where it is worn corners are of the size of what bends the profiles.
   subroutine test_edges(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 60
      real(wp), parameter :: small = 1.0e-5_wp, distance = 1.6_wp*clearance
      type(overlap_t) :: at(-2:2)
      type(pin_t) :: pin
      type(profile_t) :: round
      type(surfaces_t) :: pair
      real(wp) :: bends(2)
      integer :: k, m, side

      call new_pair(n, 0.3_wp*clearance, 6_i8, pair)
      do side = 2, 1, -1
         do k = 1, n
            do m = -2, 2
               pin%e = distance*[cos(2.0_wp*pi*k/n + m*small), sin(2.0_wp*pi*k/n + m*small)]
               call place(pin)
               call find_overlap(pair, pin, to_gradient, at(m))
            end do
            bends = [at(0)%delta - 2.0_wp*at(-1)%delta + at(-2)%delta, at(2)%delta - 2.0_wp*at(1)%delta + at(0)%delta]/small**2
            call check_close(error, bends(2), bends(1), merge(1.0e-2_wp, 10.0_wp, side == 1)*clearance, "second derivative")
            if (allocated(error)) return
            call check_close(error, at(1)%gradient, at(-1)%gradient, 1.0e3_wp*small, "gradient")
            if (allocated(error)) return
         end do
         pair%worn%pin = round  ! as the second one
      end do
   end subroutine test_edges

   !> A bush worn to the circle of a pin: the overlap is an arc of the pin's radius, delta d deep, and moves as one.
   subroutine test_conformal(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 2880
      real(wp), parameter :: worn = 0.8_wp*clearance, deep = 1.0e-6_wp
      type(arc_t) :: arc
      type(overlap_t) :: overlap
      type(pin_t) :: pin
      type(surfaces_t) :: pair
      real(wp) :: area(n), b, e, rho, theta
      integer :: g, k

      call put_inside(pair, hole, clearance)
      pair%length = length
      allocate (pair%worn)
      e = clearance + worn
      do k = 1, n
         area(k) = 0.0_wp
         do g = 1, 20
            theta = 2.0_wp*pi*(k - 1 + (g - 0.5_wp)/20)/n
            rho = e*cos(theta) + sqrt(pair%radius_j**2 - (e*sin(theta))**2)
            area(k) = area(k) + 0.5_wp*max(rho**2 - hole**2, 0.0_wp)/20
         end do
      end do
      call new_profile(pair%worn%hole, .true., hole, length, area*length*2.0_wp*pi/n)
      pin%e = [e + deep, 0.0_wp]
      call place(pin)
      call find_overlap(pair, pin, to_gradient, overlap, arc)
      b = acos(clearance/e)  ! about: of a circle of the pin's radius
      associate (m => arc%n)
         call check_true(error, maxval(abs(arc%hole(:m))) > 0.9_wp*b, "the arc is as wide as the worn one")
         if (allocated(error)) return
         associate (inside => abs(arc%hole(:m)) < 0.9_wp*b)
            call check_close(error, pack(arc%d(:m), inside), pack(deep*cos(arc%hole(:m)), inside), 0.02_wp*deep, "overlap")
            if (allocated(error)) return
         end associate
         call check_close(error, sum(arc%width(:m)*arc%d(:m)**2), deep**2*(b + sin(b)*cos(b)), 0.03_wp*deep**2, "moment")
      end associate
   end subroutine test_conformal

end module test_worn_contacts
