!> What rows do to motions that they allow to first order: the second-order test of rigidity.
!>
!> With free motions v, Phi_q v = 0, and self-stresses w, w^T Phi_q = 0, a motion v continues to second order if
!>
!> $$ w^T (\Phi_q v)_q v = 0 $$
!>
!> for all w. Where a combination of self-stresses makes this form semidefinite and not zero, motions outside its kernel end as they
!> start: the assembly is infinitesimally mobile (shaky). In linkages that move, as Bennett's, the form vanishes; where branches of
!> the motion meet, as in a flat parallelogram, it is indefinite.
!>
!> Source: R. Connelly and W. Whiteley, Second-order rigidity and prestress stability for tensegrity frameworks, SIAM J. Discrete
!> Math. 9 (1996) 453-491. Limits: dense; up to 40 free motions; a combination is searched for by the perceptron's iteration.
module second_order
   use kinds, only: wp
   use lapack, only: dsyev
   use linkage, only: linkage_t
   use row_corrections, only: evaluate_rows
   implicit none (type, external)
   private
   public :: find_definite, find_forms, most_free

   integer, parameter :: most_free = 40             !! free motions that are tested, at most
   integer, parameter :: n_search = 200             !! steps of the perceptron
   real(wp), parameter :: vanishing = 1.0e-4_wp     !! form that counts as none, of the sum of its magnitudes [1]
   real(wp), parameter :: minimum = 1.0e-6_wp         !! terms of a form that count, for unit motions and stresses [1]
   real(wp), parameter :: round_off = 1.0e-6_wp     !! negative eigenvalue that counts as none, of the same [1]

contains

   !> The forms of some self-stresses on some free motions, each over the sum of the magnitudes of its terms; nothing of the rows'
   !> dependence on time. The rows are evaluated at rest afterwards.
   subroutine find_forms(linkage, q, free, stress, form, floor_terms)
      type(linkage_t), intent(inout) :: linkage           !! the bodies and their rows
      real(wp), intent(in) :: q(:)                        !! (n_q bodies) positions [any]
      real(wp), intent(in) :: free(:, :)                  !! (n_v bodies, f) scaled motions [1]
      real(wp), intent(in) :: stress(:, :)                !! (rows, s) combinations of scaled rows [1]
      real(wp), allocatable, intent(out) :: form(:, :, :) !! (f, f, s) forms [1]
      real(wp), intent(in), optional :: floor_terms       !! terms that count as none, if others than usual [1]

      real(wp), allocatable :: bend(:, :, :)
      real(wp), dimension(linkage%rows%n) :: rest
      real(wp) :: magnitude(size(stress, 2))
      real(wp) :: none
      integer :: f, i, j, k

      none = minimum
      if (present(floor_terms)) none = floor_terms
      f = size(free, 2)
      allocate (bend(linkage%rows%n, f, f), form(f, f, size(stress, 2)), source=0.0_wp)
      rest = bend_along(0.0_wp*free(:, 1))
      do i = 1, f
         bend(:, i, i) = bend_along(free(:, i)) - rest
      end do
      do i = 1, f
         do j = 1, i - 1
            bend(:, i, j) = 0.5_wp*(bend_along(free(:, i) + free(:, j)) - rest - bend(:, i, i) - bend(:, j, j))
            bend(:, j, i) = bend(:, i, j)
         end do
      end do
      magnitude = 0.0_wp
      do j = 1, f
         do i = 1, f
            form(i, j, :) = matmul(bend(:, i, j), stress)
            magnitude = max(magnitude, matmul(abs(bend(:, i, j)), abs(stress)))
         end do
      end do
      do k = 1, size(magnitude)
         if (magnitude(k) > none*maxval(abs(stress(:, k)))) then
            form(:, :, k) = form(:, :, k)/magnitude(k)
         else
            form(:, :, k) = 0.0_wp  ! terms that are round-off
         end if
         if (maxval(abs(form(:, :, k))) <= vanishing) form(:, :, k) = 0.0_wp
      end do
      call evaluate_rows(linkage, 0.0_wp, q, 0.0_wp*free(:, 1))

   contains

      !> Scaled second derivatives of the rows along a motion, the even part in the motion.
      function bend_along(x) result(gamma)
         real(wp), intent(in) :: x(:)             !! (n_v bodies) scaled motion [1]
         real(wp) :: gamma(linkage%rows%n)        !! (rows) gamma [1]

         associate (scale => linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n))
            call evaluate_rows(linkage, 0.0_wp, q, scale*x)
            gamma = linkage%rows%gam
            call evaluate_rows(linkage, 0.0_wp, q, -scale*x)
            gamma = 0.5_wp*(gamma + linkage%rows%gam)*linkage%solution%row_weight
         end associate
      end function bend_along

   end subroutine find_forms

   !> A combination of forms that is semidefinite and not zero, and the motions outside its kernel.
   subroutine find_definite(form, combination, modes, is_found)
      real(wp), intent(in) :: form(:, :, :)                !! (f, f, s) forms [1]
      real(wp), intent(out) :: combination(:)              !! (s) parts of the forms in it [1]
      real(wp), allocatable, intent(out) :: modes(:, :)    !! (f, any) orthonormal motions outside its kernel [1]
      logical, intent(out) :: is_found                     !! there is one

      real(wp) :: total(size(form, 1), size(form, 1)), value(size(form, 1)), work(64*size(form, 1)), slope(size(form, 3))
      integer :: info, k, n, step, trial

      n = size(form, 1)
      allocate (modes(n, 0))
      is_found = .false.
      do trial = 1, 2*size(form, 3)  ! each form, either sign
         combination = 0.0_wp
         combination((trial + 1)/2) = merge(1.0_wp, -1.0_wp, mod(trial, 2) == 1)
         if (.not. maxval(abs(form(:, :, (trial + 1)/2))) > 0.0_wp) cycle
         do step = 1, n_search
            total = 0.0_wp
            do k = 1, size(combination)
               total = total + combination(k)/norm2(combination)*form(:, :, k)
            end do
            call dsyev("V", "U", n, total, n, value, work, size(work), info)
            is_found = value(1) >= -round_off .and. value(n) > vanishing
            if (is_found) exit
            do k = 1, size(slope)
               slope(k) = dot_product(total(:, 1), matmul(form(:, :, k), total(:, 1)))
            end do
            if (.not. norm2(slope) > round_off) exit  ! no combination holds this motion
            combination = combination + slope/norm2(slope)
            if (.not. norm2(combination) > round_off) exit
         end do
         if (.not. is_found) cycle
         modes = total(:, pack([(k, k=1, n)], value > vanishing))
         return
      end do
   end subroutine find_definite

end module second_order
