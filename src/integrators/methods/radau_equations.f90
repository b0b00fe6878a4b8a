!> The equations of Radau IIA: Newton's iteration for the stages of a step, and the filtered estimate of its error.
submodule(radau) radau_equations
   use integrator_controls, only: norm_euclidean
   use quadrature_error, only: by_one_step, counts_quadratures, max_error
   use radau_products, only: real_eigenvalue
   implicit none (type, external)

   real(wp), parameter :: e(3) = -[13.0_wp + 7.0_wp*sqrt(6.0_wp), 13.0_wp - 7.0_wp*sqrt(6.0_wp), 1.0_wp] &
                          /3.0_wp                       !! of the error estimate [1]

   integer, parameter :: n_newton(2) = [8, 16]          !! (2) iterations, at most: of a step, and of a part of one
   integer, parameter :: many(2) = [5, 4]               !! (2) iterations after which the next step is no longer than the last: by
                                                        !! GMRES, and with the matrix
   integer, parameter :: too_many = 5                   !! iterations, slower than `slow`, after which the matrix is made anew
   real(wp), parameter :: slow = 0.2_wp                 !! ratio of successive changes [1]
   real(wp), parameter :: min_ratio = 0.1_wp          !! of successive changes with the matrix; acceleration makes some less [1]
   real(wp), parameter :: hopeless = 2.0_wp             !! ratio of successive changes at which the iteration is given up [1]
   real(wp), parameter :: out_of_reach = 1.0_wp/sqrt(eps)  !! change of the stages over the scales that no motion makes [1]
   real(wp), parameter :: part_of_tolerance = 0.03_wp   !! of TOL': error left by the iteration, at most [1]
   real(wp), parameter :: part_in_films = 0.1_wp        !! of TOL: error left in a row where films act, at most: they amplify it [1]
   real(wp), parameter :: most_in_films = 1.0e-10_wp    !! the same at loose tolerances [1]
   real(wp), parameter :: conservative = 3.0_wp         !! ratio of that, as it is estimated with the matrix, to what is left [1]
   real(wp), parameter :: noise = 10.0_wp*eps           !! minimum error of the iteration, over the scales [1]
   real(wp), parameter :: left_by_gmres(2) = [3.0e-4_wp, 1.0e-2_wp]  !! (2) of the residual of Newton's equations: minimum, most [1]
   real(wp), parameter :: left_by_filter = 0.1_wp       !! of the residual of the filter of the error [1]

contains

   !> Newton's iteration for the stages: with the matrix that is at hand, then with a new one (not for a row, which steps must not
   !> depend on); where it is not known, the step is too long for it, or a new one does not do though the step has been shortened
   !> for it or cannot be, by GMRES.
   module procedure find_stages
      logical :: is_new

      call self%set_scales(system, self%step%y0)
      self%first_z(:, :) = self%z
      is_new = self%is_stale .and. .not. (self%is_wide .or. self%is_row)
      if (is_new) call renew_matrix(self, system)
      if (self%matrix%is_known .and. .not. self%is_wide) then
         call iterate(self, system, h, is_part, .true., is_found, status)
         if (is_found .or. status < 0) return
         if (.not. (is_new .or. self%is_row)) then
            self%z(:, :) = self%first_z
            call renew_matrix(self, system)
            if (self%matrix%is_known) call iterate(self, system, h, is_part, .true., is_found, status)
            if (is_found .or. status < 0) return
         end if
         if (.not. (is_part .or. self%has_failed .or. self%controls%fixed_step > 0.0_wp)) then
            self%has_failed = .true.
            return
         end if
         self%z(:, :) = self%first_z
      end if
      call iterate(self, system, h, is_part, .false., is_found, status)
   end procedure find_stages

   !> The matrix at the start of the step.
   subroutine renew_matrix(self, system)
      class(radau_t), intent(inout) :: self                  !! the integrator, scales set
      class(ode_system_t), intent(inout), target :: system   !! the system

      call begin_differences(self, system)
      call self%matrix%renew(system, self%filter)
      nullify (self%filter%system)
      self%count%n_evaluations = self%count%n_evaluations + self%filter%n_evaluation
      self%is_stale = .false.
   end subroutine renew_matrix

   !> The iteration, with the matrix or by GMRES. Where no estimate of the error says what is enough, as with fixed steps, that
   !> with the matrix, which gains little with each of its cheap iterations, continues to round-off.
   !> Length: one loop, what it starts with and what it leaves.
   subroutine iterate(self, system, h, is_part, by_matrix, is_found, status)
      class(radau_t), intent(inout) :: self                 !! the integrator; `z` is where it starts, then what it finds
      class(ode_system_t), intent(inout), target :: system  !! the system
      real(wp), intent(in) :: h                             !! length of the step [s]
      logical, intent(in) :: is_part                        !! of an accepted step
      logical, intent(in) :: by_matrix                      !! with the matrix
      logical, intent(out) :: is_found                      !! whether the iteration has converged
      integer, intent(out) :: status                        !! of the evaluations

      real(wp) :: before, enough, eta, minimum, left, now, theta, tolerance
      integer :: k, most
      logical :: is_search

      is_search = is_part .and. .not. self%is_row
      most = n_newton(merge(2, 1, is_part))
      tolerance = lenient(self%controls%tolerance)
      enough = left_in_steps(tolerance, by_matrix)
      if (is_part) enough = left_in_rows(self%controls%tolerance, system%traits%has_films)
      minimum = merge(noise, enough, is_search .or. (by_matrix .and. self%controls%fixed_step > 0.0_wp))
      eta = min(max(left_by_gmres(1), 10.0_wp*tolerance), left_by_gmres(2))
      if (is_search) eta = left_by_gmres(1)
      call begin_stages(self, h)
      if (by_matrix) then
         eta = min_ratio
         call self%matrix%factorise(h)
         call self%secants%begin()
      end if
      self%stage%system => system
      self%contraction = max(self%contraction, eps)**0.8_wp
      before = 0.0_wp
      theta = 0.0_wp
      is_found = .false.
      do k = 1, most
         call evaluate_stages(self, system, h, status)
         if (status /= 0) exit
         call set_side(self%n, h, self%z, self%stage%f, self%side)
         if (by_matrix) then
            call solve_by_matrix(self, system, self%n, self%side, self%change)
         else
            call self%stage_solver%solve(self%stage, self%side, self%weight, eta, self%change, status)
         end if
         if (status /= 0) exit
         now = maximum(self, self%change)
         if (.not. now < out_of_reach) exit
         if (by_matrix) call self%secants%improve(self%weight, self%change)
         call add_change(self%n, self%change, self%z)
         if (k > 1) then
            theta = max(eta, now/before)
            self%contraction = theta/max(1.0_wp - theta, eps)
         end if
         left = self%contraction*now
         is_found = (left <= merge(enough, minimum, k == most) .and. theta < 1.0_wp) &
                    .or. (theta >= 0.5_wp .and. now <= 0.01_wp*tolerance)
         if (is_found .or. (theta >= hopeless .and. .not. is_part)) exit
         before = now
      end do
      nullify (self%stage%system)
      self%count%n_evaluations = self%count%n_evaluations + self%stage%n_evaluation
      if (.not. is_found) self%contraction = 1.0_wp
      if (by_matrix) self%is_stale = k >= too_many .and. theta > slow
      if (.not. is_part) then
         if (by_matrix) then
            self%h_matrix = merge(h, huge(1.0_wp), self%has_failed .or. k >= many(2))
         else
            self%h_gmres = merge(h, huge(1.0_wp), k >= many(1))
         end if
      end if
      ! what follows from the derivatives at the stages asks for those at the stages found
      if (status == 0 .and. is_found .and. size(self%y) > 2*system%n_position - system%traits%n_turning) then
         call evaluate_stages(self, system, h, status)
      end if
   end subroutine iterate

   !> Error that the iteration may leave in a step.
   pure real(wp) function left_in_steps(tolerance, by_matrix)
      real(wp), intent(in) :: tolerance  !! TOL' [1]
      logical, intent(in) :: by_matrix   !! whether it is that with the matrix

      left_in_steps = max(noise, tolerance*min(part_of_tolerance, merge(conservative, 1.0_wp, by_matrix)*sqrt(tolerance)))
   end function left_in_steps

   !> Error that the iteration, or interpolation, may leave in a row.
   pure real(wp) function left_in_rows(tolerance, has_films)
      real(wp), intent(in) :: tolerance  !! TOL [1]
      logical, intent(in) :: has_films   !! whether films act

      left_in_rows = tolerance
      if (has_films) left_in_rows = min(part_in_films*tolerance, most_in_films)
      left_in_rows = max(noise, left_in_rows)
   end function left_in_rows

   !> Newton's equations with the matrix.
   subroutine solve_by_matrix(self, system, n, side, change)
      class(radau_t), intent(inout) :: self          !! the integrator, stages evaluated
      class(ode_system_t), intent(in) :: system      !! the system
      integer, intent(in) :: n                       !! entries without quadratures
      real(wp), intent(in) :: side(n, 3)             !! (n, 3) what is left of the equations [any]
      real(wp), intent(out) :: change(n, 3)          !! (n, 3) changes of the stages [any]

      call self%matrix%solve_stages(system, self%stage%y, side, change)
   end subroutine solve_by_matrix

   !> What differences at the start of the step need.
   subroutine begin_differences(self, system)
      class(radau_t), intent(inout) :: self                  !! the integrator, scales set
      class(ode_system_t), intent(in), target :: system      !! the system

      associate (filter => self%filter)
         filter%t = self%step%t0
         filter%n_evaluation = 0
         filter%scale(:) = self%scale(:self%n)
         filter%y(:) = self%step%y0
         filter%f(:) = self%step%f0
         filter%system => system
      end associate
   end subroutine begin_differences

   !> What the products need.
   subroutine begin_stages(self, h)
      class(radau_t), intent(inout) :: self  !! the integrator, scales set
      real(wp), intent(in) :: h              !! length of the step [s]

      associate (n => self%n)
         self%stage%t = self%step%t0
         self%stage%h = h
         self%stage%n_evaluation = 0
         self%stage%scale(:) = self%scale(:n)
         self%weight(:n) = self%scale(:n)
         self%weight(n + 1:2*n) = self%scale(:n)
         self%weight(2*n + 1:) = self%scale(:n)
      end associate
   end subroutine begin_stages

   !> The right-hand side at the stages.
   module procedure evaluate_stages
      integer :: i, k

      associate (y => self%stage%y, y0 => self%step%y0)
         do k = 1, 3
            do i = 1, self%n
               y(i, k) = y0(i) + self%z(i, k)
            end do
            y(self%n + 1:, k) = y0(self%n + 1:)
            self%count%n_evaluations = self%count%n_evaluations + 1
            call system%evaluate(self%step%t0 + c(k)*h, y(:, k), self%stage%f(:, k), status)
            if (status /= 0) return
         end do
      end associate
   end procedure evaluate_stages

   !> What is left of the equations, -Z_i + h sum a_ij F_j.
   pure subroutine set_side(n, h, z, f, side)
      integer, intent(in) :: n            !! entries without quadratures
      real(wp), intent(in) :: h           !! length of the step [s]
      real(wp), intent(in) :: z(n, 3)     !! (n, 3) changes at the stages [any]
      real(wp), intent(in) :: f(:, :)     !! (all, 3) derivatives there [any]
      real(wp), intent(out) :: side(n, 3) !! (n, 3) what is left [any]

      integer :: i, k

      do k = 1, 3
         do i = 1, n
            side(i, k) = h*(a(k, 1)*f(i, 1) + a(k, 2)*f(i, 2) + a(k, 3)*f(i, 3)) - z(i, k)
         end do
      end do
   end subroutine set_side

   !> Add a change to the stages.
   pure subroutine add_change(n, change, z)
      integer, intent(in) :: n              !! entries without quadratures
      real(wp), intent(in) :: change(n, 3)  !! (n, 3) the change [any]
      real(wp), intent(inout) :: z(n, 3)    !! (n, 3) changes at the stages [any]

      z = z + change
   end subroutine add_change

   !> TOL': the error that the embedded formula may have.
   pure elemental real(wp) function lenient(tolerance)
      real(wp), intent(in) :: tolerance  !! TOL [1]

      lenient = 0.1_wp*tolerance**(2.0_wp/3.0_wp)
   end function lenient

   !> Norm of one or more vectors over the scales.
   pure real(wp) function maximum(self, x)
      class(radau_t), intent(in) :: self   !! the integrator, scales set
      real(wp), intent(in) :: x(:)         !! (n, or several times n) the vectors [any]

      real(wp) :: part
      integer :: i

      maximum = 0.0_wp
      do i = 1, size(x)
         part = abs(x(i))/self%scale(1 + modulo(i - 1, self%n))
         if (self%controls%norm == norm_euclidean) then
            maximum = maximum + part**2
         else if (.not. part <= maximum) then
            maximum = part  ! a NaN comes through
         end if
      end do
      if (self%controls%norm == norm_euclidean) maximum = sqrt(maximum)
   end function maximum

   !> Norm of the estimate.
   module procedure estimate_error
      real(wp), parameter :: stiff = 1.5_wp   ! ratio of what is left of the equations, or unfiltered, to the estimate [1]
      real(wp) :: noisy
      integer :: i, n

      n = self%n
      status = 0
      call self%set_scales(system, self%trial)
      call begin_differences(self, system)
      call set_side(n, h, self%z, self%stage%f, self%side)
      noisy = maximum(self, self%side)
      associate (filter => self%filter, side => self%side(:n), estimate => self%change(:n))
         filter%h = h
         do i = 1, n
            side(i) = (h*self%step%f0(i) + e(1)*self%z(i, 1) + e(2)*self%z(i, 2) + e(3)*self%z(i, 3))/real_eigenvalue
         end do
         noisy = max(noisy, maximum(self, side))
         call filter_side(self, system, h, status)
         if (status == 0) self%norm = maximum(self, estimate)/lenient(self%controls%tolerance)
         self%is_stiff = status == 0 .and. noisy > stiff*maximum(self, estimate)
         if (status == 0 .and. self%norm > 1.0_wp .and. self%before%h <= 0.0_wp) then
            self%y(:) = self%step%y0
            self%y(:n) = self%y(:n) + estimate
            self%count%n_evaluations = self%count%n_evaluations + 1
            call system%evaluate(self%step%t0, self%y, filter%rate, status)
            side(:) = side + h/real_eigenvalue*(filter%rate(:n) - self%step%f0(:n))
            if (status == 0) call filter_side(self, system, h, status)
            if (status == 0) self%norm = maximum(self, estimate)/lenient(self%controls%tolerance)
         end if
         nullify (filter%system)
         self%count%n_evaluations = self%count%n_evaluations + filter%n_evaluation
      end associate

   end procedure estimate_error

   !> Filter of the error: change = (I - h J/u)^-1 side, of the first n entries.
   subroutine filter_side(self, system, h, status)
      class(radau_t), intent(inout) :: self          !! the integrator, differences started
      class(ode_system_t), intent(in) :: system      !! the system
      real(wp), intent(in) :: h                      !! length of the step [s]
      integer, intent(inout) :: status               !! of the evaluations

      associate (side => self%side(:self%n), change => self%change(:self%n))
         if (self%matrix%is_known) call self%matrix%factorise(h)
         if (self%matrix%is_known) then
            call self%matrix%solve_filter(system, self%step%y0, side, change)
         else
            call self%filter_solver%solve(self%filter, side, self%filter%scale, left_by_filter, change, status)
         end if
      end associate
   end subroutine filter_side

   !> Norm of the filtered residual.
   module procedure filter_residual
      real(wp) :: h

      h = self%step%h
      status = 0
      call self%set_scales(system, self%step%y1)
      call begin_differences(self, system)
      self%filter%h = h
      self%side(:self%n) = h/real_eigenvalue*self%side(:self%n)
      call filter_side(self, system, h, status)
      error = maximum(self, self%change(:self%n))/left_in_rows(self%controls%tolerance, system%traits%has_films)
      nullify (self%filter%system)
      self%count%n_evaluations = self%count%n_evaluations + self%filter%n_evaluation
   end procedure filter_residual

   !> Norm of the error estimate, or that of the quadratures.
   module procedure radau_error_norm
      norm = self%norm
      if (counts_quadratures(system, norm)) norm = max(norm, quadrature_norm(self, system, h))
   end procedure radau_error_norm

   !> Norm of the error estimates of the quadratures.
   real(wp) function quadrature_norm(self, system, h) result(norm)
      class(radau_t), intent(inout) :: self      !! the integrator, stages found
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      real(wp), parameter :: weight(3) = [e(1)*a(1, 1) + e(2)*a(2, 1) + e(3)*a(3, 1), &
                                          e(1)*a(1, 2) + e(2)*a(2, 2) + e(3)*a(3, 2), &
                                          e(1)*a(1, 3) + e(2)*a(2, 3) + e(3)*a(3, 3)]  ! of the derivatives at the stages [1]
      real(wp) :: part
      integer :: i, n

      n = self%n
      part = h/(real_eigenvalue*lenient(self%controls%tolerance))
      associate (f0 => self%step%f0, f => self%stage%f)
         do i = 1, system%n_quadrature
            self%scratch(n + i) = part*(f0(n + i) + weight(1)*f(n + i, 1) + weight(2)*f(n + i, 2) + weight(3)*f(n + i, 3))
         end do
      end associate
      norm = max_error(system%n_quadrature, self%scratch(n + 1:), system%traits%quadrature_scale, by_one_step)
   end function quadrature_norm

end submodule radau_equations
