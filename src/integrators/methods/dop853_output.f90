!> States of `dop853` between the ends of a step, from three more stages.
!>
!> With u the parameter of the place in the step and w = 1 - u
!>
!> $$ y = y_0 + u (t_1 + w (t_2 + u (t_3 + w (t_4 + u (t_5 + w (t_6 + u (t_7 + w t_8))))))) $$
!>
!> Rates, other states and quadratures: the interpolant of order 7 of the method, t_8 = 0. It would be the worst of the results of
!> positions: where steps are long, its error is some hundred times that at the end of the step. Their second derivatives are known
!> at both ends and at the three stages, and give a polynomial of degree 8 with an error like that at the end. Euler parameters are
!> positions. Where time does not go evenly (`step_course`), it is the interpolant of order 7 for positions too.
!>
!> Source: E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993), section II.6; of
!> positions: interpolation of Hermite and Birkhoff.
submodule(dop853_stages) dop853_output
   use rotations, only: second_rate_of_parameters
   use step_course, only: along, parameter_of
   implicit none (type, external)

   real(wp), parameter :: c_inner(3) = [1.0_wp/10.0_wp, 1.0_wp/5.0_wp, &
      7.0_wp/9.0_wp]  !! places of the stages for interpolation [1]
   real(wp), parameter :: a14(13) = [0.056167502283047954_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.25350021021662483_wp, &
      -0.2462390374708025_wp, -0.12419142326381637_wp, 0.15329179827876568_wp, 0.00820105229563469_wp, &
      0.007567897660545699_wp, -0.008298_wp]  !! stage 14 [1]
   real(wp), parameter :: a15(14) = [0.03183464816350214_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.028300909672366776_wp, &
      0.053541988307438566_wp, -0.05492374857139099_wp, 0.0_wp, 0.0_wp, -0.00010834732869724932_wp, 0.0003825710908356584_wp, &
      -0.00034046500868740456_wp, 0.1413124436746325_wp]  !! stage 15 [1]
   real(wp), parameter :: a16(15) = [-0.42889630158379194_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, -4.697621415361164_wp, &
      7.683421196062599_wp, 4.06898981839711_wp, 0.3567271874552811_wp, 0.0_wp, 0.0_wp, 0.0_wp, -0.0013990241651590145_wp, &
      2.9475147891527724_wp, -9.15095847217987_wp]  !! stage 16 [1]
   real(wp), parameter :: d4(16) = [-8.428938276109013_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.5667149535193777_wp, &
      -3.0689499459498917_wp, 2.38466765651207_wp, 2.117034582445028_wp, -0.871391583777973_wp, 2.2404374302607883_wp, &
      0.6315787787694688_wp, -0.08899033645133331_wp, 18.148505520854727_wp, -9.194632392478356_wp, &
      -4.436036387594894_wp]  !! of the interpolant's term 4 [1]
   real(wp), parameter :: d5(16) = [10.427508642579134_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 242.28349177525817_wp, &
      165.20045171727028_wp, -374.5467547226902_wp, -22.113666853125306_wp, 7.733432668472264_wp, -30.674084731089398_wp, &
      -9.332130526430229_wp, 15.697238121770845_wp, -31.139403219565178_wp, -9.35292435884448_wp, &
      35.81684148639408_wp]  !! of the interpolant's term 5 [1]
   real(wp), parameter :: d6(16) = [19.985053242002433_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, -387.0373087493518_wp, &
      -189.17813819516758_wp, 527.8081592054236_wp, -11.57390253995963_wp, 6.8812326946963_wp, -1.0006050966910838_wp, &
      0.7777137798053443_wp, -2.778205752353508_wp, -60.19669523126412_wp, 84.32040550667716_wp, &
      11.99229113618279_wp]  !! of the interpolant's term 6 [1]
   real(wp), parameter :: d7(16) = [-25.69393346270375_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, -154.18974869023643_wp, &
      -231.5293791760455_wp, 357.6391179106141_wp, 93.40532418362432_wp, -37.45832313645163_wp, 104.0996495089623_wp, &
      29.8402934266605_wp, -43.53345659001114_wp, 96.32455395918828_wp, -39.17726167561544_wp, &
      -149.72683625798564_wp]  !! of the interpolant's term 7 [1]

contains

   !> Three more stages, and the terms.
   module procedure stages_fit_output
      real(wp) :: bend(system%n_position, 5)  ! (position, place) second derivatives at 0, at the stages, at 1 [any]
      real(wp) :: change
      integer :: course, i, n, n_wanted

      n = system%n - system%n_quadrature
      n_wanted = merge(system%n, n, system%traits%with_quadratures)
      course = step%course
      self%k(:, 13) = pace_at(course, 1.0_wp)*step%f1
      call find_bends(system, step%y0, self%k(:, 1), bend(:, 1))
      call find_bends(system, step%y1, self%k(:, 13), bend(:, 5))
      call stage(14, a14, status)
      if (status == 0) call stage(15, a15, status)
      if (status == 0) call stage(16, a16, status)
      if (status /= 0) return
      associate (k => self%k, term => self%term)
         do i = 1, n_wanted
            change = step%y1(i) - step%y0(i)
            term(i, 1) = change
            term(i, 2) = step%h*k(i, 1) - change
            term(i, 3) = change - step%h*k(i, 13) - term(i, 2)
            if (i <= system%n_position .and. course == course_even) then
               call fit_bends(step%h**2*bend(i, :), term(i, :))
               cycle
            end if
            term(i, 4) = step%h*(d4(1)*k(i, 1) + dot_product(d4(6:), k(i, 6:)))
            term(i, 5) = step%h*(d5(1)*k(i, 1) + dot_product(d5(6:), k(i, 6:)))
            term(i, 6) = step%h*(d6(1)*k(i, 1) + dot_product(d6(6:), k(i, 6:)))
            term(i, 7) = step%h*(d7(1)*k(i, 1) + dot_product(d7(6:), k(i, 6:)))
            term(i, 8) = 0.0_wp
         end do
      end associate

   contains

      !> One stage for the interpolant.
      subroutine stage(i, a, status)
         integer, intent(in) :: i        !! the stage
         real(wp), intent(in) :: a(:)    !! (i - 1) its coefficients [1]
         integer, intent(out) :: status  !! of the evaluation

         integer :: e, j

         do concurrent(e=1:n)
            self%y(e) = a(1)*self%k(e, 1)
         end do
         do j = 6, i - 1
            do concurrent(e=1:n)
               self%y(e) = self%y(e) + a(j)*self%k(e, j)
            end do
         end do
         do concurrent(e=1:n)
            self%y(e) = step%y0(e) + step%h*self%y(e)
         end do
         call system%evaluate(step%t0 + along(course, c_inner(i - 13))*step%h, self%y, self%k(:, i), status)
         call find_bends(system, self%y, self%k(:, i), bend(:, i - 12))
         self%k(:, i) = pace_at(course, c_inner(i - 13))*self%k(:, i)
         n_evaluation = n_evaluation + 1
      end subroutine stage

   end procedure stages_fit_output

   !> Second derivatives of positions.
   pure subroutine find_bends(system, y, f, bend)
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: y(:)               !! (n) state [any]
      real(wp), intent(in) :: f(:)               !! (n) its derivative [any]
      real(wp), intent(out) :: bend(:)           !! (position) second derivatives [any]

      integer :: body, k, v

      do body = 1, system%traits%n_turning
         k = 7*body - 6
         v = system%n_position + 6*body - 5
         bend(k:k + 2) = f(v:v + 2)
         bend(k + 3:k + 6) = second_rate_of_parameters(y(k + 3:k + 6), y(v + 3:v + 5), f(v + 3:v + 5))
      end do
      k = 7*system%traits%n_turning
      v = system%n_position + 6*system%traits%n_turning
      bend(k + 1:) = f(v + 1:v + system%n_position - k)
   end subroutine find_bends

   !> Terms 4 to 8 of a position from its second derivatives.
   pure subroutine fit_bends(bend, term)
      real(wp), intent(in) :: bend(5)      !! (5) second derivatives by u at 0, at the stages, at 1 [any]
      real(wp), intent(inout) :: term(:)   !! (8) terms, the first three known [any]

      ! second derivatives at the stages of u^3 w^3, u^4 w^3 and u^4 w^4
      real(wp), parameter :: of_6(3) = c_inner*(6.0_wp + c_inner*(-36.0_wp + c_inner*(60.0_wp - 30.0_wp*c_inner))), &
         of_7(3) = c_inner**2*(12.0_wp + c_inner*(-60.0_wp + c_inner*(90.0_wp - 42.0_wp*c_inner))), &
         of_8(3) = c_inner**2*(12.0_wp + c_inner*(-80.0_wp + c_inner*(180.0_wp + c_inner*(-168.0_wp + 56.0_wp*c_inner)))), &
         rest_7(2:3) = of_7(2:) - of_6(2:)*(of_7(1)/of_6(1)), rest_8(2:3) = of_8(2:) - of_6(2:)*(of_8(1)/of_6(1)), &
         last = rest_8(3) - rest_8(2)*(rest_7(3)/rest_7(2))
      real(wp) :: missing(3)

      term(4) = 0.5_wp*bend(1) + term(2) - term(3)
      term(5) = 0.5_wp*bend(5) + term(2) + 2.0_wp*term(3) - term(4)
      missing = bend(2:4) + 2.0_wp*term(2) - (2.0_wp - 6.0_wp*c_inner)*term(3) &
                - (2.0_wp + 12.0_wp*c_inner*(c_inner - 1.0_wp))*term(4) &
                - c_inner*(6.0_wp + c_inner*(-24.0_wp + 20.0_wp*c_inner))*term(5)
      missing(2:) = missing(2:) - of_6(2:)/of_6(1)*missing(1)
      term(8) = (missing(3) - rest_7(3)/rest_7(2)*missing(2))/last
      term(7) = (missing(2) - rest_8(2)*term(8))/rest_7(2)
      term(6) = (missing(1) - of_7(1)*term(7) - of_8(1)*term(8))/of_6(1)
   end subroutine fit_bends

   !> By the terms.
   module procedure stages_within
      integer :: n

      n = system%n
      if (.not. system%traits%with_quadratures) n = n - system%n_quadrature
      call sum_terms(n, system%n, parameter_of(step%course, s), step%y0, self%term, y)
   end procedure stages_within

   !> The sum of the terms.
   pure subroutine sum_terms(n, n_all, u, y0, term, y)
      integer, intent(in) :: n                     !! entries that are requested
      integer, intent(in) :: n_all                 !! entries of the state
      real(wp), intent(in) :: u                    !! parameter of the place in the step, 0 to 1 [1]
      real(wp), intent(in) :: y0(n_all)            !! (n_all) state at its start [any]
      real(wp), intent(in) :: term(n_all, n_term)  !! (n_all, 8) terms [any]
      real(wp), intent(inout) :: y(n_all)          !! (n_all) state, n entries are set [any]

      real(wp) :: w
      integer :: i

      w = 1.0_wp - u
      do i = 1, n
         y(i) = y0(i) + u*(term(i, 1) + w*(term(i, 2) + u*(term(i, 3) + w*(term(i, 4) + u*(term(i, 5) + w*(term(i, 6) &
                                                                               + u*(term(i, 7) + w*term(i, 8))))))))
      end do
   end subroutine sum_terms

end submodule dop853_output
