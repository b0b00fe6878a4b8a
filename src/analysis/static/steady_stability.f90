!> Small motions of a mechanism about a steady state in lubricant films: is it stable, and what the films are like there.
!>
!> $$ N^T M N\, x'' + N^T C N\, x' + N^T K N\, x = 0, \quad C = -\frac{dr}{dv}, \quad K = -\frac{dr}{dq} $$
!>
!> with N the motions that the rows leave free, r the loads less the reactions at the speeds of the drivers; stable where all
!> eigenvalues have negative real parts. C and K are those of the whole mechanism, of films, contacts, springs and friction, by
!> differences of fourth order; their steps move a journal by a thousandth of what is left of its gap.
!>
!> Source: Lund (1987), see `journal_whirl`; Meirovitch, Computational Methods in Structural Dynamics (1980), section 3.10 (state
!> space). Limits: dense; a state that does not change while the bodies turn: where the drivers ask for accelerations there is none,
!> and this is reported instead.
module steady_stability
   use acting_forces, only: has_films
   use clearance_set, only: clearance_set_t
   use film_law, only: film_motion_t, film_slopes_t
   use journal_whirl, only: find_whirl, whirl_t
   use kinds, only: i8, two_pi, wp
   use lapack, only: dgeev, dgetrf, dgetrs
   use linearised, only: film_coefficients_t, linearised_t
   use mechanism, only: mechanism_t
   use prescribed_motion, only: newton_t, solve_rates
   use row_corrections, only: min_correction
   use static_problem, only: balance_t, load_scale, look_at, position_scale, unbalanced_load
   use text, only: real_text
   implicit none (type, external)
   private
   public :: find_eigenvalues, gather_films, is_steady, mode_words, no_growth

   real(wp), parameter :: part = 1.0e-3_wp          !! step of the differences, of the minimum gap left [1]
   real(wp), parameter :: no_load = 1.0e-6_wp       !! load of accelerations that counts as none, of the largest load [1]
   real(wp), parameter :: lost_digits = 1.0e-6_wp   !! real part that counts as none, of its eigenvalue [1]
   real(wp), parameter :: lost_in_all = 1.0e-9_wp   !! the same, of the maximum eigenvalue [1]

contains

   !> Whether the state stays as it is while the drivers continue: they ask for no accelerations. After `look_at`.
   logical function is_steady(system)
      type(mechanism_t), intent(in) :: system  !! the system at the equilibrium

      real(wp), dimension(size(system%linkage%mass)) :: acceleration, ease
      integer :: rank

      ease = 1.0_wp
      call min_correction(system%linkage, system%linkage%rows%gam, ease, acceleration, rank)
      is_steady = norm2(acceleration*position_scale(system)*reshape(system%linkage%mass, [size(acceleration)])) &
                  <= no_load*load_scale(system)
   end function is_steady

   !> Coefficients of all films that act. After `look_at`.
   subroutine gather_films(system, films)
      type(mechanism_t), intent(in) :: system                             !! the system at the equilibrium
      type(film_coefficients_t), allocatable, intent(out) :: films(:)     !! (any) coefficients

      integer :: i, k, n

      n = 0
      do k = 1, size(system%clearance_joints%sets)
         if (has_films(system%clearance_joints%sets(k)%set)) n = n + system%clearance_joints%sets(k)%set%n
      end do
      allocate (films(n))
      n = 0
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (.not. has_films(set)) cycle
            do i = 1, set%n
               n = n + 1
               call describe_film(system, set, i, films(n))
            end do
         end associate
      end do
   end subroutine gather_films

   !> The film of one joint.
   subroutine describe_film(system, set, item, film)
      type(mechanism_t), intent(in) :: system         !! the system at the equilibrium
      class(clearance_set_t), intent(in) :: set       !! the joint's set
      integer, intent(in) :: item                     !! item of the set
      type(film_coefficients_t), intent(out) :: film  !! its film

      type(film_motion_t) :: motion
      type(film_slopes_t) :: slopes
      type(whirl_t) :: whirl

      associate (body => set%items%body(:, item), films => set%laws%films)
         call films%slopes_of(item, body, set%items%s_i(:, item), set%items%s_j(:, item), system%linkage%motion, motion, slopes)
         associate (state => films%state_of(item, body, motion, system%linkage%motion))
            film%load = norm2(state%force)
            film%attitude = turn_between(-state%force, motion%e, motion%speed_sum)
         end associate
         film%journal_speed = 0.5_wp*(motion%speed_sum + motion%speed_difference)
      end associate
      call find_whirl(slopes, whirl)
      film%joint = set%names(item)%s
      film%clearance = set%items%pairs(item)%clearance
      film%eccentricity_ratio = norm2(motion%e)/film%clearance
      film%is_heated = set%laws%films%place(item)%is_heated
      film%temperature = set%laws%films%place(item)%temperature
      film%viscosity = set%laws%films%place(item)%viscosity
      film%stiffness = slopes%stiffness
      film%damping = slopes%damping
      film%error = slopes%error
      film%equivalent_stiffness = whirl%equivalent_stiffness
      film%whirl_frequency = whirl%frequency
      film%critical_mass = whirl%critical_mass
   end subroutine describe_film

   !> Angle from one vector to another, positive with the sign of a speed; 0 of vectors without a direction.
   pure real(wp) function turn_between(from, to, speed)
      real(wp), intent(in) :: from(2), to(2)  !! (2) the vectors [any]
      real(wp), intent(in) :: speed           !! the speed [rad/s]

      turn_between = 0.0_wp
      if (.not. norm2(from)*norm2(to) > 0.0_wp) return
      turn_between = sign(1.0_wp, speed)*atan2(from(1)*to(2) - from(2)*to(1), dot_product(from, to))
   end function turn_between

   !> Eigenvalues at an equilibrium, of the maximum growth first.
   subroutine find_eigenvalues(system, q, balance, eigenvalues)
      type(mechanism_t), intent(inout) :: system                !! the system; left at the equilibrium
      real(wp), intent(in) :: q(:)                              !! (n_q bodies) positions of the equilibrium [any]
      type(balance_t), intent(inout) :: balance                 !! there, with the free motions; evaluations are counted
      real(wp), allocatable, intent(out) :: eigenvalues(:, :)   !! (2, 2 freedoms) real and imaginary parts [1/s]

      real(wp), allocatable :: block(:, :), damping(:, :), mass(:, :), stiffness(:, :)
      real(wp) :: pace
      integer, allocatable :: pivots(:)
      integer :: info, k, n

      n = size(balance%free, 2)
      allocate (eigenvalues(2, 2*n), source=0.0_wp)
      if (n == 0) return
      call free_slopes(system, q, balance, stiffness, damping)
      associate (weight => position_scale(system)**2*reshape(system%linkage%mass, [size(balance%free, 1)]))
         mass = matmul(transpose(balance%free), spread(weight, 2, n)*balance%free)
      end associate
      allocate (pivots(n))
      call dgetrf(n, n, mass, n, pivots, info)
      call dgetrs("N", n, n, mass, n, pivots, stiffness, n, info)
      call dgetrs("N", n, n, mass, n, pivots, damping, n, info)
      pace = sqrt(maxval(abs(stiffness)))  ! time in its units, so that both blocks count alike
      if (.not. pace > 0.0_wp) pace = max(maxval(abs(damping)), tiny(1.0_wp))
      allocate (block(2*n, 2*n), source=0.0_wp)
      do k = 1, n
         block(k, n + k) = 1.0_wp
      end do
      block(n + 1:, :n) = -stiffness/pace**2
      block(n + 1:, n + 1:) = -damping/pace
      call sorted_eigenvalues(block, eigenvalues)
      eigenvalues = pace*eigenvalues
   end subroutine find_eigenvalues

   !> Eigenvalues of a matrix, of the maximum real part first.
   subroutine sorted_eigenvalues(matrix, values)
      real(wp), intent(inout) :: matrix(:, :)  !! (n, n) the matrix, destroyed [1]
      real(wp), intent(out) :: values(:, :)    !! (2, n) real and imaginary parts [1]

      real(wp), dimension(size(matrix, 1)) :: imaginary, real_part
      real(wp) :: left(1, 1), right(1, 1), work(8*size(matrix, 1))
      logical :: is_left(size(matrix, 1))
      integer :: best, info, k, n

      n = size(matrix, 1)
      call dgeev("N", "N", n, matrix, n, real_part, imaginary, left, 1, right, 1, work, size(work), info)
      is_left = .true.
      do k = 1, n
         best = maxloc(real_part, dim=1, mask=is_left)
         is_left(best) = .false.
         values(:, k) = [real_part(best), imaginary(best)]
      end do
   end subroutine sorted_eigenvalues

   !> Stiffness and damping of the whole mechanism against its free motions.
   subroutine free_slopes(system, q, balance, stiffness, damping)
      type(mechanism_t), intent(inout) :: system            !! the system; left at the equilibrium
      real(wp), intent(in) :: q(:)                          !! (n_q bodies) positions [any]
      type(balance_t), intent(inout) :: balance             !! there, with the free motions
      real(wp), allocatable, intent(out) :: stiffness(:, :) !! (freedoms, freedoms) N^T K N [N.m]
      real(wp), allocatable, intent(out) :: damping(:, :)   !! (freedoms, freedoms) N^T C N [N.m.s]

      real(wp), parameter :: place(4) = [-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]  ! in steps [1]
      real(wp), parameter :: weight(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/12.0_wp  ! of the loads there [1]
      type(newton_t) :: newton
      real(wp), dimension(size(balance%free, 1)) :: accelerations, rates, scale
      real(wp) :: q_near(size(q)), speed, step, step_v
      integer :: i, k, n, outcome

      n = size(balance%free, 2)
      scale = position_scale(system)
      call solve_rates(system%linkage, 0.0_wp, newton, q, rates, accelerations, outcome)
      speed = balance%speed*system%linkage%coordinates%max_turn(system%linkage%bodies%n, rates)
      if (.not. speed > 0.0_wp) speed = 1.0_wp  ! 1/s where nothing turns
      step = part*min_gap(system)/system%linkage%scales%length
      step_v = step*speed
      allocate (stiffness(size(scale), n), damping(size(scale), n), source=0.0_wp)
      do k = 1, n
         do i = 1, size(place)
            q_near = q
            call system%linkage%coordinates%add_change(system%linkage%bodies%n, place(i)*step*scale*balance%free(:, k), q_near)
            call look_at(system, q_near, balance%speed)
            stiffness(:, k) = stiffness(:, k) - weight(i)/step*unbalanced_load(system)
            call look_at(system, q, balance%speed, place(i)*step_v*scale*balance%free(:, k))
            damping(:, k) = damping(:, k) - weight(i)/step_v*unbalanced_load(system)
         end do
      end do
      call look_at(system, q, balance%speed)
      balance%n_evaluations = balance%n_evaluations + int(8*n + 1, i8)
      stiffness = matmul(transpose(balance%free), stiffness)
      damping = matmul(transpose(balance%free), damping)
   end subroutine free_slopes

   !> What is left of the gap of the journal that is nearest to its bearing, at least a thousandth of a clearance [m].
   real(wp) function min_gap(system) result(gap)
      type(mechanism_t), intent(in) :: system  !! the system at the equilibrium

      integer :: i, k

      gap = huge(gap)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (.not. has_films(set)) cycle
            do i = 1, set%n
               associate (film => set%laws%films%motion_of(i, set%items%body(:, i), set%items%s_i(:, i), set%items%s_j(:, i), &
                                                           system%linkage%motion), c => set%items%pairs(i)%clearance)
                  gap = min(gap, max(c - norm2(film%e), 1.0e-3_wp*c))
               end associate
            end do
         end associate
      end do
   end function min_gap

   !> Growth that counts as none: what the differences and the eigenvalues lose.
   pure real(wp) function no_growth(eigenvalues)
      real(wp), intent(in) :: eigenvalues(:, :)  !! (2, n) real and imaginary parts, of the maximum growth first [1/s]

      no_growth = max(lost_digits*norm2(eigenvalues(:, 1)), lost_in_all*maxval(norm2(eigenvalues, dim=1)))
   end function no_growth

   !> How the motion of the maximum growth continues, as text.
   function mode_words(linear) result(words)
      type(linearised_t), intent(in) :: linear  !! with eigenvalues and films
      character(:), allocatable :: words        !! as "e-fold in 0.3 s, at 4.1 Hz, 0.498 of the speed of the journal"

      real(wp) :: speed

      associate (growth => linear%eigenvalues(1, 1), frequency => abs(linear%eigenvalues(2, 1)))
         words = "e-fold in "//real_text(1.0_wp/abs(growth), 4)//" s"
         if (.not. frequency > 0.0_wp) return
         words = words//", at "//real_text(frequency/two_pi, 6)//" Hz"
         speed = maxval([0.0_wp, abs(linear%films%journal_speed)])
         if (speed > 0.0_wp) words = words//", "//real_text(frequency/speed, 4)//" times the journal speed"
      end associate
   end function mode_words

end module steady_stability
