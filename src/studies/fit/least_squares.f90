!> Least squares with bounds: the method of Levenberg and Marquardt.
!>
!> Minimises F(u) = |r(u)|^2/2 over 0 <= u <= 1 by steps d of the free unknowns,
!>
!> $$ (J^T J + \mu D^2) d = -J^T r , $$
!>
!> D the greatest norms of the columns of J so far. A step is accepted if F falls by at least a small part of what r + J d
!> promises, and mu follows that ratio. An unknown whose step passes a bound is set there, and the others are solved for again; one
!> at a bound stays there while F falls beyond it.
!> Source: D. W. Marquardt, J. SIAM 11 (1963) 431-441; J. J. More, Lecture Notes in Mathematics 630 (1978) 105-116 (D); H. B.
!> Nielsen, IMM-REP-1999-05 (mu). Limits: a local minimum; dense J.
module least_squares
   use kinds, only: wp
   use lapack, only: dgels
   implicit none (type, external)
   private
   public :: end_converged, end_failed, end_limit, end_stalled, minimise, minimum_t, residuals_t

   integer, parameter :: end_converged = 1   !! gradient, step or fall of F are negligible
   integer, parameter :: end_stalled = 2     !! no step makes F less: it is exact to round-off, or the derivatives are wrong
   integer, parameter :: end_limit = 3       !! too many derivatives
   integer, parameter :: end_failed = 4      !! residuals or derivatives at the start cannot be found

   real(wp), parameter :: first_damping = 1.0e-3_wp     !! mu at the start [1]
   real(wp), parameter :: most_damping = 1.0e12_wp      !! mu at which no step makes F less [1]
   real(wp), parameter :: least_ratio = 1.0e-4_wp       !! fall of F over the promised one of an accepted step, at least [1]
   real(wp), parameter :: small_angle = 1.0e-8_wp       !! negligible cosine of r and a column of J [1]
   real(wp), parameter :: small_step = 1.0e-10_wp       !! negligible step [1]
   real(wp), parameter :: small_fall = 1.0e-9_wp        !! negligible fall of F, of F [1]

   real(wp), parameter :: visible_fall = 1.0e-6_wp      !! promised fall of F of a rejected step that is noted, of F [1]

   !> The residuals of a model.
   type, abstract :: residuals_t
   contains
      procedure(residuals_interface), deferred :: evaluate
      procedure(derivatives_interface), deferred :: derive
   end type residuals_t

   abstract interface
      !> The residuals.
      subroutine residuals_interface(self, u, r, is_good)
         import :: residuals_t, wp
         implicit none (type, external)
         class(residuals_t), intent(inout) :: self        !! the model
         real(wp), intent(in) :: u(:)                     !! (n) unknowns [1]
         real(wp), allocatable, intent(out) :: r(:)       !! (m) residuals [1]
         logical, intent(out) :: is_good                  !! .false.: there are none
      end subroutine residuals_interface

      !> The residuals and their derivatives. It may leave some out from now on: m is that of the last call.
      subroutine derivatives_interface(self, u, r, jac, is_good)
         import :: residuals_t, wp
         implicit none (type, external)
         class(residuals_t), intent(inout) :: self        !! the model
         real(wp), intent(in) :: u(:)                     !! (n) unknowns [1]
         real(wp), allocatable, intent(out) :: r(:)       !! (m) residuals [1]
         real(wp), allocatable, intent(out) :: jac(:, :)  !! (m, n) their derivatives [1]
         logical, intent(out) :: is_good                  !! .false.: there are none
      end subroutine derivatives_interface
   end interface

   !> A minimum.
   type :: minimum_t
      integer :: end = end_failed             !! how the search ended, one of the above
      real(wp), allocatable :: u(:)           !! (n) unknowns [1]
      real(wp), allocatable :: r(:)           !! (m) residuals [1]
      real(wp), allocatable :: jac(:, :)      !! (m, n) their derivatives [1]
      integer :: n_derived = 0                !! how often derivatives were found
      integer :: n_evaluated = 0              !! how often residuals were found without derivatives
   end type minimum_t

contains

   !> Find the minimum next to a start.
   subroutine minimise(model, start, most, found)
      class(residuals_t), intent(inout) :: model   !! the residuals
      real(wp), intent(in) :: start(:)             !! (n) first unknowns, between 0 and 1 [1]
      integer, intent(in) :: most                  !! derivatives, at most
      type(minimum_t), intent(out) :: found        !! what is found

      real(wp) :: damping, growth, d(size(start)), fall, norms(size(start)), promised
      real(wp), allocatable :: r(:)
      logical :: is_free(size(start)), is_good

      found%u = min(1.0_wp, max(0.0_wp, start))
      norms = 0.0_wp
      damping = first_damping
      growth = 2.0_wp
      do
         found%end = end_failed
         call model%derive(found%u, found%r, found%jac, is_good)
         if (.not. is_good) return
         found%n_derived = found%n_derived + 1
         norms = max(norms, norm2(found%jac, dim=1))
         is_free = are_free(found%u, matmul(found%r, found%jac))
         found%end = end_converged
         if (is_flat(found, is_free)) return
         if (found%n_derived > most) exit
         do
            call find_step(found, is_free, damping, norms, d, promised)
            if (maxval(abs(d)) <= small_step) return
            fall = -1.0_wp
            is_good = promised > 0.0_wp   ! a step that is cut at bounds may promise nothing
            if (is_good) then
               if (promised <= small_fall*0.5_wp*sum(found%r**2)) return
               call model%evaluate(found%u + d, r, is_good)
               found%n_evaluated = found%n_evaluated + 1
            end if
            if (is_good) fall = 0.5_wp*(sum(found%r**2) - sum(r**2))
            if (fall >= least_ratio*promised .and. fall > 0.0_wp) exit
            damping = damping*growth
            growth = 2.0_wp*growth
            if (promised > visible_fall*0.5_wp*sum(found%r**2)) found%end = end_stalled
            if (damping > most_damping) return
         end do
         found%u = min(1.0_wp, max(0.0_wp, found%u + d))
         damping = damping*max(1.0_wp/3.0_wp, 1.0_wp - (2.0_wp*fall/promised - 1.0_wp)**3)
         growth = 2.0_wp
         if (max(fall, promised) > small_fall*0.5_wp*sum(r**2)) cycle
         call model%derive(found%u, found%r, found%jac, is_good)
         found%n_derived = found%n_derived + 1
         found%end = merge(end_converged, end_failed, is_good)
         return
      end do
      found%end = end_limit
   end subroutine minimise

   !> Which unknowns may move: one at a bound beyond which F falls may not.
   pure function are_free(u, slope) result(is_free)
      real(wp), intent(in) :: u(:)        !! (n) unknowns [1]
      real(wp), intent(in) :: slope(:)    !! (n) derivatives of F [1]
      logical :: is_free(size(u))         !! (n) whether they may

      is_free = .not. ((u <= 0.0_wp .and. slope >= 0.0_wp) .or. (u >= 1.0_wp .and. slope <= 0.0_wp))
   end function are_free

   !> Whether the residuals are at right angles to the columns of all free unknowns.
   pure logical function is_flat(found, is_free)
      type(minimum_t), intent(in) :: found       !! unknowns, residuals and derivatives
      logical, intent(in) :: is_free(:)          !! (n) which unknowns may move

      real(wp) :: length
      integer :: k

      length = norm2(found%r)
      is_flat = .true.
      do k = 1, size(is_free)
         if (.not. is_free(k)) cycle
         is_flat = is_flat .and. abs(dot_product(found%r, found%jac(:, k))) <= small_angle*length*norm2(found%jac(:, k))
      end do
   end function is_flat

   !> The damped step within the bounds, and the fall of F that it promises.
   subroutine find_step(found, is_free, damping, norms, d, promised)
      type(minimum_t), intent(in) :: found       !! unknowns, residuals and derivatives
      logical, intent(in) :: is_free(:)          !! (n) which unknowns may move
      real(wp), intent(in) :: damping            !! mu [1]
      real(wp), intent(in) :: norms(:)           !! (n) D [1]
      real(wp), intent(out) :: d(:)              !! (n) the step [1]
      real(wp), intent(out) :: promised          !! fall of F of the linear model [1]

      real(wp) :: to(size(d))
      real(wp), allocatable :: a(:, :), b(:), work(:)
      integer, allocatable :: list(:)
      logical :: moves(size(d))
      integer :: info, k, m, n

      d = 0.0_wp
      moves = is_free
      m = size(found%r)
      do
         list = pack([(k, k=1, size(d))], moves)
         n = size(list)
         if (n == 0) exit
         allocate (a(m + n, n), b(m + n), work(64*n + m + n), source=0.0_wp)
         b(:m) = -found%r - matmul(found%jac, merge(0.0_wp, d, moves))
         do k = 1, n
            a(:m, k) = found%jac(:, list(k))
            a(m + k, k) = sqrt(damping)*norms(list(k))
            if (.not. norms(list(k)) > 0.0_wp) a(m + k, k) = 1.0_wp
         end do
         call dgels("N", m + n, n, 1, a, m + n, b, m + n, work, size(work), info)
         d(list) = b(:n)
         deallocate (a, b, work)
         to = found%u + d
         if (all(to >= 0.0_wp .and. to <= 1.0_wp .or. .not. moves)) exit
         where (moves) d = min(1.0_wp, max(0.0_wp, to)) - found%u
         moves = moves .and. to >= 0.0_wp .and. to <= 1.0_wp
      end do
      promised = 0.5_wp*(sum(found%r**2) - sum((found%r + matmul(found%jac, d))**2))
   end subroutine find_step

end module least_squares
