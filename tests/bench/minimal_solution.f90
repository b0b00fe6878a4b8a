!> The dry slider-crank of inputs/slider_crank_dry.deck, coded by hand: how fast this scene can be.
!>
!> Minimal coordinates y = (theta, theta', x, x'): angle of the rod and place of the slider; the
!> crank's angle phi = omega t is given. About the crank pin, with f the force on the journal:
!>
!> $$ (J_3 + m_3 l_3^2/4)\,\theta'' = m_3 l_2 l_3 \omega^2 \sin(\phi - \theta)/2
!>    + l_3 (f_y \cos\theta - f_x \sin\theta), \qquad m_4 x'' = -f_x $$
!>
!> The force is that of Lankarani and Nikravesh, F = K d^1.5 (1 + 3 (1 - e^2)/4 d'/v), with the
!> stiffness of internal contact. Verner's pair of orders 6 and 5 with DVERK's coefficients and step
!> control, weights max(1, |y|). Onsets and ends of contact are located by stepping again from the
!> start of the step, with Newton's method on the step's length: they are as accurate as a step.
!> All of it stands in one module so that the compiler can put it into one loop.
module minimal_solution
   implicit none (type, external)
   private
   public :: counts_t
   public :: simulate
   public :: dp, max_onsets

   integer, parameter :: dp = kind(1.0d0)
   integer, parameter :: n = 4             !! unknowns
   integer, parameter :: max_onsets = 200  !! onsets kept

   real(dp), parameter :: pi = 3.14159265358979324_dp
   real(dp), parameter :: omega = 5000.0_dp*2.0_dp*pi/60.0_dp  !! speed of the crank [rad/s]
   real(dp), parameter :: l2 = 0.05_dp           !! crank [m]
   real(dp), parameter :: l3 = 0.12_dp           !! rod [m]
   real(dp), parameter :: m3 = 0.21_dp           !! mass of the rod [kg]
   real(dp), parameter :: m4 = 0.14_dp           !! mass of the slider [kg]
   real(dp), parameter :: j3 = 2.5e-4_dp         !! inertia of the rod about its centre [kg.m^2]
   real(dp), parameter :: radius = 10.0e-3_dp    !! of the bearing [m]
   real(dp), parameter :: c = 0.5e-3_dp          !! radial clearance [m]
   real(dp), parameter :: restitution = 0.9_dp   !! coefficient of the normal law [1]
   real(dp), parameter :: young = 207.0e9_dp     !! of both bodies [Pa]
   real(dp), parameter :: poisson = 0.3_dp       !! of both bodies [1]

   !> Stiffness of internal contact, 4/(3 (s_i + s_j)) sqrt(R_i R_j/(R_i - R_j)) [N/m^1.5]
   real(dp), parameter :: sigma = (1.0_dp - poisson**2)/young
   real(dp), parameter :: stiffness = 4.0_dp/(3.0_dp*2.0_dp*sigma)*sqrt(radius*(radius - c)/c)
   real(dp), parameter :: hysteresis = 0.75_dp*(1.0_dp - restitution**2)  !! factor of d'/v [1]

   real(dp), parameter :: per_j = 1.0_dp/(j3 + m3*(0.5_dp*l3)**2)  !! about the pin [1/(kg.m^2)]
   real(dp), parameter :: contact_rate = per_j*m3*0.5_dp*l3*l2*omega**2   !! of the driven pin [rad/s^2]
   real(dp), parameter :: m_contact = 1.0_dp/(1.0_dp/m4 + l3**2*per_j)  !! rough, of an impact [kg]
   real(dp), parameter :: h_max = 2.0e-4_dp  !! longest step: six degrees of the crank [s]

   !> Rounding error of the gap function [m^2]
   real(dp), parameter :: rounding = 4.0_dp*epsilon(1.0_dp)*2.0_dp*c*(l2 + l3)

   !> What a run cost and where contact started.
   type :: counts_t
      integer :: steps = 0                  !! accepted
      integer :: rejected = 0               !! steps
      integer :: rhs = 0                    !! evaluations of the right-hand side
      integer :: onsets = 0                 !! of contact
      real(dp) :: onset(max_onsets) = 0.0_dp   !! (max_onsets) their times [s]
      real(dp) :: speed(max_onsets) = 0.0_dp   !! (max_onsets) their impact speeds [m/s]
   end type counts_t

contains

   !> Right-hand side. Without contact one sine is all there is.
   pure subroutine evaluate(t, y, closed, chi, f)
      real(dp), intent(in) :: t      !! time [s]
      real(dp), intent(in) :: y(n)   !! (n) unknowns [rad, rad/s, m, m/s]
      logical, intent(in) :: closed  !! in contact
      real(dp), intent(in) :: chi    !! hysteresis factor over impact speed [s/m]
      real(dp), intent(out) :: f(n)  !! (n) derivatives of y [any]

      real(dp) :: g(2)

      if (closed) then
         call observe(t, y, closed, chi, f, g)
      else
         f = [y(2), contact_rate*sin(omega*t - y(1)), y(4), 0.0_dp]
      end if
   end subroutine evaluate

   !> Right-hand side and gap function g = e^2 - c^2 with its rate.
   pure subroutine observe(t, y, closed, chi, f, g)
      real(dp), intent(in) :: t        !! time [s]
      real(dp), intent(in) :: y(n)     !! (n) unknowns [rad, rad/s, m, m/s]
      logical, intent(in) :: closed    !! in contact
      real(dp), intent(in) :: chi      !! hysteresis factor over impact speed [s/m]
      real(dp), intent(out) :: f(n)    !! (n) derivatives of y [any]
      real(dp), intent(out) :: g(2)    !! (2) gap function, positive in contact, rate [m^2, m^2/s]

      real(dp) :: crank_x, crank_y, rod_x, rod_y, ex, ey, e, depth, pull, half_rate

      crank_x = cos(omega*t)
      crank_y = sin(omega*t)
      rod_x = cos(y(1))
      rod_y = sin(y(1))
      ex = l2*crank_x + l3*rod_x - y(3)
      ey = l2*crank_y + l3*rod_y
      half_rate = ey*(l2*omega*crank_x + l3*rod_x*y(2)) &
         - ex*(l2*omega*crank_y + l3*rod_y*y(2) + y(4))
      g = [ex*ex + ey*ey - c*c, 2.0_dp*half_rate]
      f = [y(2), contact_rate*(crank_y*rod_x - crank_x*rod_y), y(4), 0.0_dp]
      if (closed .and. g(1) > 0.0_dp) then
         e = sqrt(g(1) + c*c)
         depth = e - c
         pull = stiffness*depth*sqrt(depth)*(1.0_dp + chi*half_rate/e)/e
         f(2) = f(2) + per_j*l3*pull*(ex*rod_y - ey*rod_x)
         f(4) = pull*ex/m4
      end if
   end subroutine observe

   !> One step of Verner's method from (t, y), whose derivatives are k1.
   pure subroutine step(t, h, y, k1, closed, chi, y_new, change)
      real(dp), intent(in) :: t           !! start [s]
      real(dp), intent(in) :: h           !! length [s]
      real(dp), intent(in) :: y(n)        !! (n) unknowns at t [any]
      real(dp), intent(in) :: k1(n)       !! (n) derivatives at t [any]
      logical, intent(in) :: closed       !! in contact
      real(dp), intent(in) :: chi         !! hysteresis factor over impact speed [s/m]
      real(dp), intent(out) :: y_new(n)   !! (n) unknowns at t + h, order 6 [any]
      real(dp), intent(out) :: change(n)  !! (n) difference of the orders 6 and 5 [any]

      real(dp), dimension(n) :: k2, k3, k4, k5, k6, k7, k8

      call evaluate(t + h/6.0_dp, y + (h/6.0_dp)*k1, closed, chi, k2)
      call evaluate(t + h*(4.0_dp/15.0_dp), y + h*((4.0_dp/75.0_dp)*k1 + (16.0_dp/75.0_dp)*k2), &
         closed, chi, k3)
      call evaluate(t + h*(2.0_dp/3.0_dp), y + h*((5.0_dp/6.0_dp)*k1 - (8.0_dp/3.0_dp)*k2 &
         + 2.5_dp*k3), closed, chi, k4)
      call evaluate(t + h*(5.0_dp/6.0_dp), y + h*((55.0_dp/6.0_dp)*k2 - (165.0_dp/64.0_dp)*k1 &
         - (425.0_dp/64.0_dp)*k3 + (85.0_dp/96.0_dp)*k4), closed, chi, k5)
      call evaluate(t + h, y + h*(2.4_dp*k1 - 8.0_dp*k2 + (4015.0_dp/612.0_dp)*k3 &
         - (11.0_dp/36.0_dp)*k4 + (88.0_dp/255.0_dp)*k5), closed, chi, k6)
      call evaluate(t + h/15.0_dp, y + h*((124.0_dp/75.0_dp)*k2 - (8263.0_dp/15000.0_dp)*k1 &
         - (643.0_dp/680.0_dp)*k3 - 0.324_dp*k4 + (2484.0_dp/10625.0_dp)*k5), closed, chi, k7)
      call evaluate(t + h, y + h*((3501.0_dp/1720.0_dp)*k1 - (300.0_dp/43.0_dp)*k2 &
         + (297275.0_dp/52632.0_dp)*k3 - (319.0_dp/2322.0_dp)*k4 + (24068.0_dp/84065.0_dp)*k5 &
         + (3850.0_dp/26703.0_dp)*k7), closed, chi, k8)
      y_new = y + h*(0.075_dp*k1 + (875.0_dp/2244.0_dp)*k3 + (23.0_dp/72.0_dp)*k4 &
         + (264.0_dp/1955.0_dp)*k5 + (125.0_dp/11592.0_dp)*k7 + (43.0_dp/616.0_dp)*k8)
      change = h*((-1.0_dp/160.0_dp)*k1 - (125.0_dp/17952.0_dp)*k3 + (1.0_dp/144.0_dp)*k4 &
         - (12.0_dp/1955.0_dp)*k5 - (3.0_dp/44.0_dp)*k6 + (125.0_dp/11592.0_dp)*k7 &
         + (43.0_dp/616.0_dp)*k8)
   end subroutine step

   !> The whole motion, from the extended position with the clearance centred.
   subroutine simulate(t_end, tolerance, counts)
      real(dp), intent(in) :: t_end          !! end of the motion [s]
      real(dp), intent(in) :: tolerance      !! local error tolerance [1]
      type(counts_t), intent(out) :: counts  !! cost and onsets

      real(dp) :: y(n), y_new(n), k1(n), f(n), change(n)
      real(dp) :: t, h, h_next, h_free, chi, ratio, side, g(2), g_new(2), top
      logical :: closed, crossed, was_rejected

      t = 0.0_dp
      y = [0.0_dp, -l2/l3*omega, l2 + l3, 0.0_dp]
      closed = .false.
      chi = 0.0_dp
      h = min(h_max, 1.0e-3_dp*tolerance**(1.0_dp/6.0_dp))
      h_free = h
      was_rejected = .false.
      call observe(t, y, closed, chi, k1, g)
      counts%rhs = 1
      do while (t < t_end*(1.0_dp - 1.0e-14_dp))
         h = min(h, h_max, t_end - t)
         call step(t, h, y, k1, closed, chi, y_new, change)
         counts%rhs = counts%rhs + 7
         ratio = maxval(abs(change)/max(1.0_dp, abs(y)))/tolerance
         if (ratio > 1.0_dp) then
            h = h*max(0.5_dp, 0.9_dp*ratio**(-1.0_dp/6.0_dp))
            counts%rejected = counts%rejected + 1
            was_rejected = .true.
            cycle
         end if
         h_next = h*min(merge(1.0_dp, 2.0_dp, was_rejected), &
            0.9_dp*max(ratio, 1.0e-9_dp)**(-1.0_dp/6.0_dp))
         was_rejected = .false.
         counts%steps = counts%steps + 1
         call observe(t + h, y_new, closed, chi, f, g_new)
         counts%rhs = counts%rhs + 1
         side = merge(-1.0_dp, 1.0_dp, closed)
         call look(side*g(1), side*h*g(2), side*g_new(1), side*h*g_new(2), top, crossed)
         if (crossed) then
            call locate(t, y, k1, closed, chi, g, g_new, top, h, y_new, counts)
            closed = .not. closed
            if (closed) then
               h_free = h_next
               call begin_contact(t + h, y_new, chi, h_next, counts)
            else
               h_next = h_free
            end if
            call observe(t + h, y_new, closed, chi, f, g_new)
            counts%rhs = counts%rhs + 1
         end if
         t = t + h
         y = y_new
         k1 = f
         g = g_new
         h = h_next
      end do
   end subroutine simulate

   !> Keep an onset of contact and its impact speed; start with a twentieth of Hertz' contact time.
   subroutine begin_contact(t, y, chi, h, counts)
      real(dp), intent(in) :: t                 !! time of the onset [s]
      real(dp), intent(in) :: y(n)              !! (n) unknowns then [any]
      real(dp), intent(out) :: chi              !! hysteresis factor over impact speed [s/m]
      real(dp), intent(out) :: h                !! first step of the contact [s]
      type(counts_t), intent(inout) :: counts   !! where the onset is kept

      real(dp) :: f(n), g(2), speed

      call observe(t, y, .false., 0.0_dp, f, g)
      speed = max(g(2)/(2.0_dp*c), 1.0e-9_dp)
      chi = hysteresis/speed
      h = 0.05_dp*3.2_dp*(m_contact**2/(stiffness**2*speed))**0.2_dp
      if (counts%onsets == max_onsets) return
      counts%onsets = counts%onsets + 1
      counts%onset(counts%onsets) = t
      counts%speed(counts%onsets) = speed
   end subroutine begin_contact

   !> Shorten the step so that it ends where the gap function is zero.
   subroutine locate(t, y, k1, closed, chi, g, g_full, top, h, y_new, counts)
      real(dp), intent(in) :: t                !! start of the step [s]
      real(dp), intent(in) :: y(n)             !! (n) unknowns at t [any]
      real(dp), intent(in) :: k1(n)            !! (n) derivatives at t [any]
      logical, intent(in) :: closed            !! in contact
      real(dp), intent(in) :: chi              !! hysteresis factor over impact speed [s/m]
      real(dp), intent(in) :: g(2)             !! (2) gap function and rate at t [any]
      real(dp), intent(in) :: g_full(2)        !! (2) gap function and rate at the end [any]
      real(dp), intent(in) :: top              !! part of the step that holds the zero [1]
      real(dp), intent(inout) :: h             !! length, in full and as shortened [s]
      real(dp), intent(out) :: y_new(n)        !! (n) unknowns at the zero [any]
      type(counts_t), intent(inout) :: counts  !! cost

      real(dp) :: change(n), f(n), g_new(2), h_full, low, high, part, correction, side
      integer :: k

      h_full = h
      side = merge(-1.0_dp, 1.0_dp, closed)
      low = 1.0e-3_dp
      high = top
      do k = 1, 14
         part = 0.5_dp*(low + high)
         if (side*cubic(part, g(1), h_full*g(2), g_full(1), h_full*g_full(2)) > 0.0_dp) then
            high = part
         else
            low = part
         end if
      end do
      do k = 1, 12
         h = part*h_full
         call step(t, h, y, k1, closed, chi, y_new, change)
         counts%rhs = counts%rhs + 7
         call observe(t + h, y_new, .false., 0.0_dp, f, g_new)
         if (abs(g_new(1)) <= rounding) exit
         correction = g_new(1)/(g_new(2)*h_full)
         if (abs(correction) < 1.0e-15_dp) exit
         part = min(max(part - correction, 1.0e-6_dp*part), 1.2_dp)
      end do
   end subroutine locate

   !> Whether a function not positive at 0 has been so by 1, and up to where to look for it.
   pure subroutine look(g0, d0, g1, d1, top, crossed)
      real(dp), intent(in) :: g0       !! value at 0 [any]
      real(dp), intent(in) :: d0       !! slope at 0 [any]
      real(dp), intent(in) :: g1       !! value at 1 [any]
      real(dp), intent(in) :: d1       !! slope at 1 [any]
      real(dp), intent(out) :: top     !! place of a positive value [1]
      logical, intent(out) :: crossed  !! there is one

      real(dp) :: a, b

      top = 1.0_dp
      crossed = g1 > 0.0_dp
      if (crossed .or. d0 <= 0.0_dp .or. d1 >= 0.0_dp) return
      a = 3.0_dp*(d0 + d1 - 2.0_dp*(g1 - g0))
      b = 3.0_dp*(g1 - g0) - 2.0_dp*d0 - d1
      top = d0/(sqrt(max(b*b - a*d0, 0.0_dp)) - b)
      crossed = cubic(top, g0, d0, g1, d1) > 0.0_dp
   end subroutine look

   !> The cubic through values and slopes at both ends of the unit interval.
   pure real(dp) function cubic(s, g0, d0, g1, d1) result(value)
      real(dp), intent(in) :: s   !! place in the interval [1]
      real(dp), intent(in) :: g0  !! value at 0 [any]
      real(dp), intent(in) :: d0  !! slope at 0 [any]
      real(dp), intent(in) :: g1  !! value at 1 [any]
      real(dp), intent(in) :: d1  !! slope at 1 [any]

      value = (1.0_dp - s)**2*((1.0_dp + 2.0_dp*s)*g0 + s*d0) &
         + s**2*((3.0_dp - 2.0_dp*s)*g1 - (1.0_dp - s)*d1)
   end function cubic

end module minimal_solution
