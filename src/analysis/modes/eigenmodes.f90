!> Modes of a linearised mechanism: eigenvalues, frequencies, damping ratios, shapes and shares of the kinetic energy.
!>
!> $$ A \hat z = \lambda \hat z, \quad f = \frac{|\lambda|}{2\pi}, \quad \zeta = -\frac{\mathrm{Re}\,\lambda}{|\lambda|}, \quad
!> \mathrm{share}_i = \frac{m_i |(D \hat x)_i|^2}{\sum_j m_j |(D \hat x)_j|^2} $$
!>
!> Of a complex pair the eigenvalue with the positive imaginary part stands for both. The mean kinetic energy of a mode has the
!> shares of its displacements, since its rates are lambda times these. Source: Meirovitch, Computational Methods in Structural
!> Dynamics (1980), section 3.10. Limits: dense (LAPACK dgeev); eigenvalues below 1e-7 of the maximum modulus are zero, and so are
!> real parts below 1e-12 of the eigenvalue.
module eigenmodes
   use kinds, only: eps, wp
   use lapack, only: dgeev
   use mechanism, only: mechanism_t
   use modes_results, only: frequency_of, linear_model_t, mode_t, ratio_of
   implicit none (type, external)
   private
   public :: find_modes, follow_branches, growth_of

   real(wp), parameter :: lost = 1.0e-7_wp       !! of the maximum eigenvalue: rounding makes as much of one that is zero twice [1]
   real(wp), parameter :: nothing = 1.0e-12_wp   !! eigenvalue that is zero [1/s]
   real(wp), parameter :: noise = 1.0e-12_wp     !! of an eigenvalue, as real part: rounding makes as much of an undamped mode [1]

contains

   !> The modes, by frequency; those that do not oscillate first, by their eigenvalues.
   subroutine find_modes(system, model, modes)
      type(mechanism_t), intent(in) :: system               !! for the bodies
      type(linear_model_t), intent(in) :: model             !! the matrices
      type(mode_t), allocatable, intent(out) :: modes(:)    !! (n) the modes

      real(wp), dimension(model%n_state) :: im, re
      real(wp) :: a(model%n_state, model%n_state), left(1, 1), right(model%n_state, model%n_state), work(8*model%n_state + 8)
      real(wp) :: zero
      integer :: info, k, n

      n = model%n_state
      allocate (modes(0))
      if (n == 0) return
      a = model%a
      call dgeev("N", "V", n, a, n, re, im, left, 1, right, n, work, size(work), info)
      zero = max(nothing, lost*maxval(hypot(re, im)))
      do k = 1, n
         if (im(k) < 0.0_wp) cycle
         if (abs(re(k)) <= noise*hypot(re(k), im(k)) + 4.0_wp*eps*maxval(hypot(re, im))) re(k) = 0.0_wp
         if (hypot(re(k), im(k)) <= zero) then
            call add_mode((0.0_wp, 0.0_wp), cmplx(right(:model%n_free, k), 0.0_wp, wp))
            if (im(k) > 0.0_wp) call add_mode((0.0_wp, 0.0_wp), cmplx(right(:model%n_free, k + 1), 0.0_wp, wp))
         else if (im(k) > 0.0_wp) then
            call add_mode(cmplx(re(k), im(k), wp), cmplx(right(:model%n_free, k), right(:model%n_free, k + 1), wp))
         else
            call add_mode(cmplx(re(k), 0.0_wp, wp), cmplx(right(:model%n_free, k), 0.0_wp, wp))
         end if
      end do

   contains

      !> A mode with an eigenvalue and its displacements.
      subroutine add_mode(eigenvalue, x)
         complex(wp), intent(in) :: eigenvalue    !! its eigenvalue [1/s]
         complex(wp), intent(in) :: x(:)          !! (freedoms) its displacements [any]

         type(mode_t) :: mode

         mode%eigenvalue = eigenvalue
         mode%damping_ratio = ratio_of(eigenvalue)
         mode%frequency = frequency_of(eigenvalue)
         call shape_of(system, model, x, mode)
         call insert(mode, modes)
      end subroutine add_mode

   end subroutine find_modes

   !> Shape and shares of a mode.
   subroutine shape_of(system, model, x, mode)
      type(mechanism_t), intent(in) :: system         !! for the bodies
      type(linear_model_t), intent(in) :: model       !! directions and masses
      complex(wp), intent(in) :: x(:)                 !! (freedoms) its displacements [any]
      type(mode_t), intent(inout) :: mode             !! shape and shares are set

      complex(wp) :: moved(size(model%mass))
      real(wp) :: energy(size(model%mass))
      integer :: greatest

      moved = matmul(model%direction, x)
      energy = model%mass*abs(moved)**2
      if (sum(energy) > 0.0_wp) then
         greatest = maxloc(energy, dim=1)
         moved = moved/(moved(greatest)/abs(moved(greatest)))/sqrt(sum(energy))
         energy = energy/sum(energy)
      end if
      associate (n_v => system%linkage%coordinates%n_v, n => system%linkage%bodies%n, unknown => system%linkage%rows%unknown)
         if (allocated(mode%share)) deallocate (mode%share, mode%shape)
         allocate (mode%share(n_v, n), source=0.0_wp)
         allocate (mode%shape(n_v, n), source=(0.0_wp, 0.0_wp))
         mode%share(:, unknown) = reshape(energy, [n_v, size(unknown)])
         mode%shape(:, unknown) = reshape(moved, [n_v, size(unknown)])
      end associate
   end subroutine shape_of

   !> Insert a mode in order.
   subroutine insert(mode, modes)
      type(mode_t), intent(in) :: mode                         !! the mode
      type(mode_t), allocatable, intent(inout) :: modes(:)     !! (n) in order, one more

      integer :: k

      do k = 1, size(modes)
         if (modes(k)%frequency > mode%frequency) exit
         if (modes(k)%frequency < mode%frequency) cycle
         if (modes(k)%eigenvalue%re > mode%eigenvalue%re) exit
      end do
      modes = [modes(:k - 1), mode, modes(k:)]
   end subroutine insert

   !> Greatest real part of some eigenvalues, and which one has it; -huge without any.
   pure subroutine growth_of(eigenvalues, growth, which)
      complex(wp), intent(in) :: eigenvalues(:)    !! (n) eigenvalues [1/s]
      real(wp), intent(out) :: growth              !! greatest real part [1/s]
      integer, intent(out) :: which                !! its number, 0: none

      growth = -huge(1.0_wp)
      which = maxloc(eigenvalues%re, dim=1)
      if (which > 0) growth = eigenvalues(which)%re
   end subroutine growth_of

   !> Branches of eigenvalues: each takes the branch of the nearest one of before that is left, the nearest pairs first. An
   !> eigenvalue that finds none begins a branch.
   pure subroutine follow_branches(before, branch_before, now, branch, n_branch)
      complex(wp), intent(in) :: before(:)         !! (m) eigenvalues of the value before [1/s]
      integer, intent(in) :: branch_before(:)      !! (m) their branches
      complex(wp), intent(in) :: now(:)            !! (n) eigenvalues [1/s]
      integer, intent(out) :: branch(:)            !! (n) their branches
      integer, intent(inout) :: n_branch           !! branches so far

      real(wp) :: apart(size(before), size(now))
      integer :: at(2), k

      do k = 1, size(now)
         apart(:, k) = abs(before - now(k))
      end do
      branch = 0
      do k = 1, min(size(before), size(now))
         at = minloc(apart)
         branch(at(2)) = branch_before(at(1))
         apart(at(1), :) = huge(1.0_wp)
         apart(:, at(2)) = huge(1.0_wp)
      end do
      do k = 1, size(now)
         if (branch(k) > 0) cycle
         n_branch = n_branch + 1
         branch(k) = n_branch
      end do
   end subroutine follow_branches

end module eigenmodes
