!> Parameters of the function IMPACT of Adams that come nearest to the contact laws of a deck, for `gudgeon explain --adams`.
!>
!>     F = max(0, k p^e + c(p) p'),   c(p) = c_max u^2 (3 - 2 u),   u = min(p/d, 1)
!>
!> with the penetration p. k and e are those of the elastic force between a twentieth of the depth of an impact at 1 m/s and all
!> of it,
!> by least squares in logarithms. c_max and d are those that come nearest, in the mean square, to the law along this impact of
!> the two
!> bodies as if they were free; d is searched between a thousandth of the depth and twice that.
!> What the function misses is reported at speeds a decade to either side too, for its damping does not go with the impact speed.
!>
!> Signs: p' > 0 while the bodies approach. Source: the public description of IMPACT in Adams/Solver.
!> Limits: friction is not in it; contacts of a law that stores nothing have no k.
module explain_adams
   use clearance_set, only: clearance_set_t
   use console, only: say
   use kinds, only: wp
   use load, only: loaded_t
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: explain_adams_parameters

   integer, parameter :: n_step = 2000        !! steps of an elastic impact
   integer, parameter :: most_steps = 40000   !! of any impact
   integer, parameter :: n_depth = 200        !! depths d that are tried

   !> The function.
   type :: impact_function_t
      real(wp) :: k = 0.0_wp      !! stiffness [N/m^e]
      real(wp) :: e = 1.5_wp      !! exponent [1]
      real(wp) :: c = 0.0_wp      !! maximum damping [N.s/m]
      real(wp) :: d = 1.0_wp      !! depth at which it is reached [m]
   end type impact_function_t

   !> An impact of free bodies.
   type :: course_t
      real(wp), allocatable :: p(:)        !! (n) penetration [m]
      real(wp), allocatable :: rate(:)     !! (n) its rate [m/s]
      real(wp), allocatable :: force(:)    !! (n) force of the law [N]
      real(wp) :: restitution = 0.0_wp     !! speed after over speed before [1]
   end type course_t

contains

   !> All clearance joints.
   subroutine explain_adams_parameters(loaded)
      type(loaded_t), intent(in) :: loaded        !! the deck

      integer :: i, k

      call say("")
      call say("Adams: F = IMPACT(x, x', x1, k, e, c_max, d), penetration x1 - x")
      if (loaded%system%clearance_joints%n == 0) call say("the deck has no joint with clearance", 2)
      do k = 1, size(loaded%system%clearance_joints%sets)
         associate (set => loaded%system%clearance_joints%sets(k)%set)
            do i = 1, set%n
               call explain_item(set, i, loaded%system%linkage%inverse_mass(1, :))
            end do
         end associate
      end do
   end subroutine explain_adams_parameters

   !> One clearance joint.
   subroutine explain_item(set, item, inverse_mass)
      class(clearance_set_t), intent(in) :: set     !! its set
      integer, intent(in) :: item                   !! item of the set
      real(wp), intent(in) :: inverse_mass(0:)      !! (0:bodies) one over the mass, 0 for the ground [1/kg]

      real(wp), parameter :: speeds(3) = [0.1_wp, 1.0_wp, 10.0_wp]   ! of impacts [m/s]
      type(course_t) :: ours, theirs
      type(impact_function_t) :: fit
      real(wp) :: mass, time
      integer :: c, v

      if (allocated(set%laws%films)) then
         if (set%laws%films%is_alone) then
            call say(set%names(item)%s//": lubricant film only, no contact", 2)
            return
         end if
      end if
      c = (item - 1)*set%n_contact_item + 1
      mass = sum(inverse_mass(set%items%body(:, item)))
      if (mass > 0.0_wp) then
         mass = 1.0_wp/mass
      else
         mass = 1.0_wp
      end if
      time = set%laws%normal%contact_time(set%laws%parameters(:, c), 1.0_wp, 1.0_wp/mass)
      if (.not. time > 0.0_wp) then
         call say(set%names(item)%s//": the law stores no energy, so k is undefined", 2)
         return
      end if
      call follow(set, c, mass, 1.0_wp, time, ours)
      call fit_elastic(set, c, maxval(ours%p), fit)
      call fit_damping(ours, fit)
      call say(set%names(item)%s//", law "//set%laws%normal%name//", free mass "//real_text(mass, 4)//" kg", 2)
      call say("k = "//real_text(fit%k, 6)//" N/m^e, e = "//real_text(fit%e, 5)//", c_max = "//real_text(fit%c, 5)// &
            " N.s/m, d = "// &
               real_text(fit%d, 4)//" m", 4)
      call say("in N, mm, s: k = "//real_text(fit%k*1.0e-3_wp**fit%e, 6)//" N/mm^e, c_max = "//real_text(1.0e-3_wp*fit%c, 5)// &
               " N.s/mm, d = "//real_text(1.0e3_wp*fit%d, 4)//" mm", 4)
      do v = 1, size(speeds)
         time = set%laws%normal%contact_time(set%laws%parameters(:, c), speeds(v), 1.0_wp/mass)
         call follow(set, c, mass, speeds(v), time, ours)
         call follow(set, c, mass, speeds(v), time, theirs, fit)
         call say("impact at "//to_text(speeds(v))//" m/s: force differs by up to "// &
                  real_text(100.0_wp*maxval(abs(force_of(fit, ours%p, ours%rate) - ours%force))/maxval(ours%force), 2)// &
                  " % of its peak at equal penetration and rate; peak "//real_text(maxval(theirs%force), 4)//" N (law: "// &
                  real_text(maxval(ours%force), 4)//" N), restitution "//real_text(theirs%restitution, 3)//" (law: "// &
                  real_text(ours%restitution, 3)//")", 4)
      end do
   end subroutine explain_item

   !> Force of the function.
   elemental real(wp) function force_of(fit, p, rate) result(f)
      type(impact_function_t), intent(in) :: fit   !! the function
      real(wp), intent(in) :: p                    !! penetration [m]
      real(wp), intent(in) :: rate                 !! its rate [m/s]

      real(wp) :: u

      f = 0.0_wp
      if (p <= 0.0_wp) return
      u = min(p/fit%d, 1.0_wp)
      f = max(0.0_wp, fit%k*p**fit%e + fit%c*u*u*(3.0_wp - 2.0_wp*u)*rate)
   end function force_of

   !> Follow an impact from its onset to its end, by the classic method of order 4.
   subroutine follow(set, contact, mass, speed, time, course, fit)
      class(clearance_set_t), intent(in) :: set                    !! the joint's set
      integer, intent(in) :: contact                               !! contact of the set
      real(wp), intent(in) :: mass                                 !! of both bodies as if they were free [kg]
      real(wp), intent(in) :: speed                                !! of the impact [m/s]
      real(wp), intent(in) :: time                                 !! of an elastic one [s]
      type(course_t), intent(out) :: course                        !! the impact
      type(impact_function_t), intent(in), optional :: fit         !! force of the function instead of the law's

      real(wp) :: a(4), h, p, rate
      integer :: n

      h = time/real(n_step, wp)
      allocate (course%p(most_steps), course%rate(most_steps), course%force(most_steps))
      p = 0.0_wp
      rate = speed
      do n = 1, most_steps
         a(1) = pull(p, rate)
         course%p(n) = p
         course%rate(n) = rate
         course%force(n) = -a(1)*mass
         a(2) = pull(p + 0.5_wp*h*rate, rate + 0.5_wp*h*a(1))
         a(3) = pull(p + 0.5_wp*h*rate + 0.25_wp*h*h*a(1), rate + 0.5_wp*h*a(2))
         a(4) = pull(p + h*rate + 0.5_wp*h*h*a(2), rate + h*a(3))
         p = p + h*rate + h*h*(a(1) + a(2) + a(3))/6.0_wp
         rate = rate + h*(a(1) + 2.0_wp*a(2) + 2.0_wp*a(3) + a(4))/6.0_wp
         if (p <= 0.0_wp) exit
      end do
      n = min(n, most_steps)
      course%p = course%p(:n)
      course%rate = course%rate(:n)
      course%force = course%force(:n)
      course%restitution = max(0.0_wp, -rate/speed)

   contains

      !> The acceleration of the penetration.
      real(wp) function pull(at, at_rate) result(acceleration)
         real(wp), intent(in) :: at        !! penetration [m]
         real(wp), intent(in) :: at_rate   !! its rate [m/s]

         real(wp) :: by_delta(1), by_rate(1), elastic(1), f(1)

         f = 0.0_wp
         if (present(fit)) then
            f = force_of(fit, at, at_rate)
         else if (at > 0.0_wp) then
            call set%laws%normal%force(1, [at], [at_rate], [speed], set%laws%parameters(:, contact:contact), f, by_delta, &
                  by_rate, &
                                       elastic)
         end if
         acceleration = -f(1)/mass
      end function pull

   end subroutine follow

   !> k and e of the elastic force.
   subroutine fit_elastic(set, contact, depth, fit)
      class(clearance_set_t), intent(in) :: set       !! the joint's set
      integer, intent(in) :: contact                  !! contact of the set
      real(wp), intent(in) :: depth                   !! of the impact [m]
      type(impact_function_t), intent(inout) :: fit   !! k and e are set

      integer, parameter :: n = 40
      real(wp) :: by_delta(1), by_rate(1), elastic(1), f(1), x(n), y(n)
      integer :: k

      do k = 1, n
         associate (p => depth*(0.05_wp + 0.95_wp*real(k, wp)/real(n, wp)))
            call set%laws%normal%force(1, [p], [0.0_wp], [1.0_wp], set%laws%parameters(:, contact:contact), f, by_delta, by_rate, &
                                       elastic)
            x(k) = log(p)
            y(k) = log(max(elastic(1), tiny(1.0_wp)))
         end associate
      end do
      x = x - sum(x)/real(n, wp)
      fit%e = sum(x*y)/sum(x*x)
      fit%k = exp(sum(y)/real(n, wp) - fit%e*(log(depth*(0.05_wp + 0.95_wp/real(n, wp))) - x(1)))
   end subroutine fit_elastic

   !> c_max and d of the damping.
   subroutine fit_damping(course, fit)
      type(course_t), intent(in) :: course            !! an impact of the law
      type(impact_function_t), intent(inout) :: fit   !! c and d are set

      type(impact_function_t) :: trial
      real(wp), allocatable :: base(:), left(:), u(:)
      real(wp) :: minimum, square
      integer :: k

      minimum = huge(minimum)
      left = course%force - fit%k*course%p**fit%e
      trial = fit
      do k = 0, n_depth
         trial%d = maxval(course%p)*2.0e-3_wp**(1.0_wp - real(k, wp)/real(n_depth, wp))*2.0_wp**(real(k, wp)/real(n_depth, wp))
         u = min(course%p/trial%d, 1.0_wp)
         base = u*u*(3.0_wp - 2.0_wp*u)*course%rate
         trial%c = max(0.0_wp, sum(base*left)/sum(base*base))
         square = sum((force_of(trial, course%p, course%rate) - course%force)**2)
         if (square >= minimum) cycle
         minimum = square
         fit = trial
      end do
   end subroutine fit_damping

end module explain_adams
