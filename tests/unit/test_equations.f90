!> Equations of motion of small scenes against Newton, written out by hand.
module test_equations
   use check, only: check_close, suite_t
   use errors, only: error_t
   use kinds, only: pi, wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: channel_of, channel_pair, nl, start_text, system_of_text
   implicit none (type, external)
   private
   public :: run_test_equations

   real(wp), parameter :: g = 9.81_wp          !! free fall [m/s^2]
   real(wp), parameter :: mass = 2.0_wp        !! of the only body [kg]
   real(wp), parameter :: inertia = 0.05_wp    !! of the only body [kg.m^2]
   real(wp), parameter :: length = 0.4_wp      !! of the pendulum, from pin to centre of mass [m]
   real(wp), parameter :: pin(2) = [0.1_wp, 0.2_wp]  !! where the pendulum hangs [m]

contains

   subroutine run_test_equations(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("free_fall", test_free_fall)
      call suite%test("pendulum", test_pendulum)
      call suite%test("weld", test_weld)
      call suite%test("inclined_guide", test_inclined_guide)
      call suite%test("driver_of_constant_speed", test_driver_of_constant_speed)
      call suite%test("driver_of_an_angle", test_driver_of_an_angle)
      call suite%test("driven_body_i", test_driven_body_i)
      call suite%test("force_on_a_guided_mass", test_force_on_a_one_dof_mass)
      call suite%test("torque_on_a_rotor", test_torque_on_a_rotor)
   end subroutine run_test_equations

   !> Deck of one body with points `eye` of it and `hook` of the ground, and more tables.
   function one_body(tables) result(deck)
      character(*), intent(in) :: tables     !! joints, drivers and forces
      character(:), allocatable :: deck      !! the deck

      deck = "[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"//nl//"bob 2 0.05 0.5 0.2 0"//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0.1 0.2"//nl//"eye bob -0.4 0"//nl// &
             tables//nl//"[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s"//nl//"stabilise = none"
   end function one_body

   !> State of the pendulum at an angle.
   function hanging(system, angle, speed) result(y)
      type(mechanism_t), intent(in) :: system   !! the system
      real(wp), intent(in) :: angle                 !! from the pin to the centre of mass, from x [rad]
      real(wp), intent(in) :: speed                 !! angular speed [rad/s]
      real(wp) :: y(system%n)                       !! (n) state [any]

      y = 0.0_wp
      y(1:3) = [pin(1) + length*cos(angle), pin(2) + length*sin(angle), angle]
      y(4:6) = [-speed*length*sin(angle), speed*length*cos(angle), speed]
   end function hanging

   !> Force that the pin must exert on the pendulum, and its angular acceleration.
   subroutine newton(angle, speed, force, acceleration)
      real(wp), intent(in) :: angle                  !! as above [rad]
      real(wp), intent(in) :: speed                  !! angular speed [rad/s]
      real(wp), intent(out) :: force(2)              !! (2) force on the pendulum [N]
      real(wp), intent(inout) :: acceleration        !! given by a driver, or huge: free, then set [rad/s^2]

      if (acceleration > 1.0e30_wp) acceleration = -mass*g*length*cos(angle)/(inertia + mass*length**2)
      force = mass*length*(acceleration*[-sin(angle), cos(angle)] - speed**2*[cos(angle), sin(angle)])
      force(2) = force(2) + mass*g
   end subroutine newton

   subroutine test_free_fall(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text(one_body(""), system, y, error)
      if (allocated(error)) return
      call check_close(error, channel_pair(system, 0.0_wp, y, "bob", "acceleration"), [0.0_wp, -g], 0.0_wp, "acceleration")
      call check_close(error, channel_of(system, 0.0_wp, y, "bob", "angular_acceleration"), 0.0_wp, 0.0_wp, "no rotation")
   end subroutine test_free_fall

   !> The pin's reaction is Newton's, at rest and moving, and the pin takes no moment; i and j exchanged.
   subroutine test_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: angles(4) = [-0.5_wp*pi, 0.6_wp, 2.5_wp, -3.0_wp], speeds(2) = [0.0_wp, 3.0_wp]
      character(*), parameter :: pairs(2) = ["hook eye ", "eye  hook"]
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: acceleration, force(2)
      integer :: i, k, order

      do order = 1, 2
         call system_of_text(one_body("[joint.revolute]"//nl//"name i j"//nl//"pin "//pairs(order)), system, error)
         if (allocated(error)) return
         do k = 1, size(angles)
            do i = 1, size(speeds)
               y = hanging(system, angles(k), speeds(i))
               acceleration = huge(1.0_wp)
               call newton(angles(k), speeds(i), force, acceleration)
               if (order == 1) force = -force
               call check_close(error, channel_pair(system, 0.0_wp, y, "pin", "force"), force, 1.0e-13_wp*mass*g, &
                                "reaction on the body of i, "//pairs(order))
               call check_close(error, channel_of(system, 0.0_wp, y, "pin", "moment"), 0.0_wp, 1.0e-13_wp, "moment of a pin")
               call check_close(error, channel_of(system, 0.0_wp, y, "bob", "angular_acceleration"), acceleration, &
                                1.0e-13_wp*g, "angular acceleration")
            end do
         end do
      end do
   end subroutine test_pendulum

   !> A cantilever: the weld carries the weight and its moment about the point of i.
   subroutine test_weld(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call system_of_text(one_body("[joint.rigid]"//nl//"name i j"//nl//"weld hook eye"), system, error)
      if (allocated(error)) return
      y = hanging(system, 0.0_wp, 0.0_wp)
      call check_close(error, channel_pair(system, 0.0_wp, y, "weld", "force"), [0.0_wp, -mass*g], 1.0e-13_wp, &
                       "force on the ground")
      call check_close(error, channel_of(system, 0.0_wp, y, "weld", "moment"), -mass*g*length, 1.0e-13_wp, &
                       "moment on the ground")
   end subroutine test_weld

   !> A slider on a guide at 30 degrees, held off its centre of mass: acceleration, normal force, moment.
   subroutine test_inclined_guide(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: along(2), arm(2), normal(2)

      call system_of_text(one_body("[joint.translational]"//nl//"name i j axis axis_angle[deg]"//nl// &
                                   "guide hook eye x 30"), system, error)
      if (allocated(error)) return
      along = [cos(pi/6.0_wp), 0.5_wp]
      normal = mass*g*cos(pi/6.0_wp)*[-along(2), along(1)]
      allocate (y(system%n), source=0.0_wp)
      arm = [-length, 0.0_wp]
      y(1:2) = pin + 0.7_wp*along - arm
      y(4:5) = 1.3_wp*along
      call check_close(error, channel_pair(system, 0.0_wp, y, "bob", "acceleration"), -0.5_wp*g*along, 1.0e-13_wp*g, &
                       "acceleration")
      call check_close(error, channel_pair(system, 0.0_wp, y, "guide", "force"), -normal, 1.0e-13_wp*mass*g, &
                       "normal force on the guide")
      ! about its centre of mass the slider is at rest: moment at the eye + arm x normal = 0
      call check_close(error, channel_of(system, 0.0_wp, y, "guide", "moment"), arm(1)*normal(2) - arm(2)*normal(1), &
                       1.0e-13_wp*mass*g, "moment on the guide")
   end subroutine test_inclined_guide

   !> At constant speed the driver carries the moment of the weight; its power is moment times speed.
   subroutine test_driver_of_constant_speed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp), parameter :: angles(3) = [0.0_wp, 0.6_wp, 2.5_wp]
      real(wp) :: moment, acceleration, force(2)
      integer :: k

      call system_of_text(one_body("[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                                   "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"motor pin 4"), system, error)
      if (allocated(error)) return
      do k = 1, size(angles)
         y = hanging(system, angles(k), 4.0_wp)
         moment = mass*g*length*cos(angles(k))
         call check_close(error, channel_of(system, 0.25_wp*angles(k), y, "motor", "moment"), moment, 1.0e-13_wp*mass*g, &
                          "driving moment on the body of j")
         call check_close(error, channel_of(system, 0.25_wp*angles(k), y, "motor", "power"), 4.0_wp*moment, &
                          1.0e-12_wp*mass*g, "power")
         call check_close(error, channel_of(system, 0.25_wp*angles(k), y, "motor", "coordinate"), angles(k), 1.0e-15_wp, &
                          "coordinate")
         acceleration = 0.0_wp
         call newton(angles(k), 4.0_wp, force, acceleration)
         call check_close(error, channel_pair(system, 0.25_wp*angles(k), y, "pin", "force"), -force, 1.0e-13_wp*mass*g, &
                          "force on the ground")
      end do
   end subroutine test_driver_of_constant_speed

   !> A driver that accelerates: the moment of inertia about the pin times f'' more.
   subroutine test_driver_of_an_angle(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: angle, moment, speed
      real(wp), parameter :: t = 0.2_wp

      call system_of_text(one_body("[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                                   "[driver.angle]"//nl//"name joint angle"//nl// &
                                   "motor pin {0.6 rad + 2 rad/s*t + 1.5 rad/s^2*t^2}"), system, error)
      if (allocated(error)) return
      angle = 0.6_wp + 2.0_wp*t + 1.5_wp*t**2
      speed = 2.0_wp + 3.0_wp*t
      y = hanging(system, angle, speed)
      moment = 3.0_wp*(inertia + mass*length**2) + mass*g*length*cos(angle)
      call check_close(error, channel_of(system, t, y, "bob", "angular_acceleration"), 3.0_wp, 1.0e-13_wp, "acceleration")
      call check_close(error, channel_of(system, t, y, "motor", "moment"), moment, 1.0e-13_wp*mass*g, "driving moment")
      call check_close(error, channel_of(system, t, y, "motor", "power"), moment*speed, 1.0e-12_wp*mass*g, "power")
   end subroutine test_driver_of_an_angle

   !> The driven body as i, the ground as j: speed and moment of j relative to i change sign, the power does not.
   subroutine test_driven_body_i(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: moment

      call system_of_text(one_body("[joint.revolute]"//nl//"name i j"//nl//"pin eye hook"//nl// &
                                   "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"motor pin -4"), system, error)
      if (allocated(error)) return
      y = hanging(system, 0.6_wp, 4.0_wp)
      moment = mass*g*length*cos(0.6_wp)
      call check_close(error, channel_of(system, 0.15_wp, y, "motor", "moment"), -moment, 1.0e-12_wp, "moment on the ground")
      call check_close(error, channel_of(system, 0.15_wp, y, "motor", "power"), 4.0_wp*moment, 1.0e-12_wp, "power")
      call check_close(error, channel_of(system, 0.15_wp, y, "motor", "coordinate"), -0.6_wp, 1.0e-15_wp, "coordinate")
      call check_close(error, channel_of(system, 0.15_wp, y, "pin", "violation"), 0.0_wp, 1.0e-15_wp, "the pin is closed")
   end subroutine test_driven_body_i

   !> A sin(w t) along a guide: the acceleration is exact at any time; what is across goes into the guide.
   subroutine test_force_on_a_one_dof_mass(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: f, t
      integer :: k

      call system_of_text(one_body("[joint.translational]"//nl//"name i j axis"//nl//"guide hook eye x"//nl// &
                                   "[force.point]"//nl//"name point fx fy"//nl// &
                                   "push eye {6 N*sin(20 rad/s*t)} {-3 N + 8 N/s*t}"), system, error)
      if (allocated(error)) return
      allocate (y(system%n), source=0.0_wp)
      y(1:2) = pin + [length, 0.0_wp]
      y(4) = 1.5_wp
      do k = 0, 5
         t = 0.07_wp*k
         f = 6.0_wp*sin(20.0_wp*t)
         call check_close(error, channel_pair(system, t, y, "bob", "acceleration"), [f/mass, 0.0_wp], 1.0e-14_wp*g, &
                          "acceleration")
         call check_close(error, channel_pair(system, t, y, "guide", "force"), [0.0_wp, -3.0_wp + 8.0_wp*t - mass*g], &
                          1.0e-13_wp*mass*g, "force on the guide")
         call check_close(error, channel_of(system, t, y, "guide", "moment"), -mass*g*length, 1.0e-13_wp*mass*g, &
                          "moment on the guide about the eye")
         call check_close(error, channel_pair(system, t, y, "push", "force"), [f, -3.0_wp + 8.0_wp*t], 1.0e-14_wp, "force")
         call check_close(error, channel_of(system, t, y, "push", "power"), 1.5_wp*f, 1.0e-13_wp, "power")
      end do
   end subroutine test_force_on_a_one_dof_mass

   !> A torque on a body that turns about its centre of mass.
   subroutine test_torque_on_a_rotor(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: moment, t
      integer :: k

      call system_of_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"rotor 2 0.05 0 0"//nl// &
                          "[points]"//nl//"name body xi[m] eta[m]"//nl//"seat ground 0 0"//nl//"hub rotor 0 0"//nl// &
                          "[joint.revolute]"//nl//"name i j"//nl//"axle seat hub"//nl// &
                          "[force.torque]"//nl//"name body moment"//nl//"twist rotor {0.3 N.m*cos(5 rad/s*t)}"//nl// &
                          "[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s", system, error)
      if (allocated(error)) return
      allocate (y(system%n), source=0.0_wp)
      y(6) = -2.0_wp
      do k = 0, 5
         t = 0.3_wp*k
         moment = 0.3_wp*cos(5.0_wp*t)
         call check_close(error, channel_of(system, t, y, "rotor", "angular_acceleration"), moment/inertia, 1.0e-13_wp, &
                          "angular acceleration")
         call check_close(error, channel_of(system, t, y, "twist", "power"), -2.0_wp*moment, 1.0e-14_wp, "power")
         call check_close(error, channel_pair(system, t, y, "axle", "force"), [0.0_wp, 0.0_wp], 1.0e-14_wp, "no force")
      end do
   end subroutine test_torque_on_a_rotor

end module test_equations
