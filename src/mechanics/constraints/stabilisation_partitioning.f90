!> Coordinate partitioning: only independent coordinates are integrated, the dependent ones follow from the constraints.
!>
!> Columns of Phi_q are sorted by QR with column pivoting, lengths in sizes of the bodies: the first `rank` are the dependent
!> coordinates u, the others the independent ones v. Before every evaluation and at the end of every step
!>
!> Phi(u, v, t) = 0 by Newton's iteration over u,   Phi_u u' = -Phi_t - Phi_v v',
!>
!> both as least squares, so that redundant rows do no harm. Newton starts with the u that the integrator has carried along,
!> which is a better prediction than eq. (2.31) makes from the last step. When the minimum pivot of Phi_u, as a part of the
!> maximum column of Phi_q, has fallen below 0.7 of what it was, the coordinates are sorted anew: a step might otherwise lead
!> across a position where Phi_u has no inverse. The integrator carries all coordinates, so nothing else changes.
!> Source: Flores et al. (2008), section 2.5, eqs. (2.25)-(2.31); R. A. Wehage, E. J. Haug (1982). Limits: dense, for
!> mechanisms of moderate size; at a singular position Phi_u has no inverse, and the step fails.
module stabilisation_partitioning
   use stabilisation, only: stabilisation_t
   use item, only: option_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use lapack, only: dgels, dgeqp3, dgeqrf
   use archive, only: archive_t
   use rows, only: before_side, block_of_side, body_of_side
   use linkage, only: linkage_t
   implicit none (type, external)
   private
   public :: stabilisation_partitioning_t

   real(wp), parameter :: rank_tolerance = 1.0e-9_wp  !! minimum ratio of pivots [1]
   real(wp), parameter :: worse = 0.7_wp              !! of that ratio since the coordinates were sorted: sort anew [1]
   real(wp), parameter :: round_off = 1.0e-14_wp      !! scaled violation at which Newton's iteration ends [1]
   real(wp), parameter :: closed = 1.0e-9_wp          !! scaled violation that counts as fulfilled [1]
   integer, parameter :: n_newton = 10                !! corrections of the positions, at most

   !> Which coordinates are dependent.
   type, extends(stabilisation_t) :: stabilisation_partitioning_t
      integer :: rank = -1                        !! dependent coordinates; -1: not sorted yet
      integer, allocatable :: order(:)            !! (coordinates) dependent ones first
      real(wp) :: quality = 0.0_wp                !! minimum pivot over the maximum column when they were sorted [1]
      real(wp), allocatable :: jac(:, :)          !! (rows, coordinates) scaled Jacobian, then factors [1]
      real(wp), allocatable :: right(:, :)        !! (rows or coordinates, 1) right-hand side and solution [1]
      real(wp), allocatable :: tau(:), work(:)    !! (any) scratch of LAPACK [any]
   contains
      procedure, nopass :: info => partitioning_info
      procedure :: words => partitioning_words
      procedure :: configure => partitioning_configure
      procedure :: correct_stage => partitioning_correct
      procedure :: correct_step => partitioning_correct_step
      procedure, nopass :: is_memory_fixed => partitioning_is_memory_fixed
      procedure :: save => partitioning_save
      procedure :: load => partitioning_load
   end type stabilisation_partitioning_t

contains

   !> Description of the method.
   function partitioning_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "partitioning"
      info%help = "dependent coordinates solved from the constraints at every evaluation"
      info%source = "Flores et al. (2008), section 2.5, eqs. (2.25)-(2.31)"
   end function partitioning_info

   !> What is done, as text.
   function partitioning_words(self) result(words)
      class(stabilisation_partitioning_t), intent(in) :: self  !! the stabilisation method
      character(:), allocatable :: words              !! as in a deck

      words = self%name()
   end function partitioning_words

   !> No options; evaluations and the ends of steps are corrected.
   subroutine partitioning_configure(self, options, tolerance)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method
      type(option_t), intent(in) :: options(:)           !! (any) none
      real(wp), intent(in) :: tolerance                  !! of the integrator [1]

      self%at_stages = .true.
      self%at_steps = .true.
   end subroutine partitioning_configure

   !> Correct the end of a step; sort anew if the dependent coordinates have become bad ones.
   subroutine partitioning_correct_step(self, linkage, t, y, status)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage          !! the bodies and their rows
      real(wp), intent(in) :: t                          !! time [s]
      real(wp), intent(inout), contiguous :: y(:)        !! (n) state, corrected [any]
      integer, intent(out) :: status                     !! 0: done

      status = 0
      call partitioning_correct(self, linkage, t, y, status)
      if (status == 0 .and. self%rank > 0) call check_quality(self, linkage)
   end subroutine partitioning_correct_step

   !> Dependent coordinates and rates from the independent ones. The motion of the system is that afterwards.
   subroutine partitioning_correct(self, linkage, t, y, status)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(inout) :: linkage          !! the bodies and their rows
      real(wp), intent(in) :: t                          !! time [s]
      real(wp), intent(inout), contiguous :: y(:)        !! (2 positions or more) coordinates and rates, corrected [any]
      integer, intent(out) :: status                     !! 0: done

      real(wp) :: before, now
      integer :: k

      status = 0
      if (linkage%rows%n_solve == 0) return
      if (.not. allocated(self%jac)) call make_storage(self, linkage%rows%n_solve, linkage%coordinates%n_v*linkage%rows%n_unknown)
      if (self%rank < 0) then
         call linkage%set_motion(t, y)
         call linkage%evaluate_rows(t)
         call sort_coordinates(self, linkage)
      end if
      before = huge(1.0_wp)
      associate (n => linkage%rows%n_solve)
         do k = 0, n_newton
            call linkage%set_motion(t, y)
            call linkage%evaluate_rows(t)
            now = linkage%max_violation()
            if (k == n_newton .or. now <= round_off .or. (now <= closed .and. now > 0.5_wp*before)) exit
            before = now
            self%right(:n, 1) = -linkage%rows%phi(:n)*linkage%solution%row_weight(:n)
            call change_dependent(self, linkage, .false., y, status)
            if (status /= 0) return
         end do
         status = merge(0, 1, now <= closed)
         if (status /= 0) return
         self%right(:n, 1) = -linkage%solution%phi_dot(:n)*linkage%solution%row_weight(:n)
      end associate
      call change_dependent(self, linkage, .true., y, status)
      call linkage%set_motion(t, y)
   end subroutine partitioning_correct

   !> Workspace.
   subroutine make_storage(self, m, n)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method
      integer, intent(in) :: m                           !! solved rows
      integer, intent(in) :: n                           !! coordinates

      allocate (self%jac(m, n), self%right(max(m, n), 1), self%tau(min(m, n)), self%work(64*(m + n + 1)), source=0.0_wp)
   end subroutine make_storage

   !> Change of the dependent coordinates, or of their rates, that the right-hand side asks for.
   subroutine change_dependent(self, linkage, to_rates, y, status)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method, right-hand side set
      type(linkage_t), intent(inout) :: linkage          !! the bodies and their rows, evaluated
      logical, intent(in) :: to_rates                    !! whether rates are changed, not coordinates
      real(wp), intent(inout), contiguous :: y(:)        !! (2 positions or more) coordinates and rates [any]
      integer, intent(out) :: status                     !! 0: done

      integer :: c, info, k

      call scaled_jacobian(self, linkage)
      call dgels("N", linkage%rows%n_solve, self%rank, 1, self%jac, size(self%jac, 1), self%right, size(self%right, 1), &
                 self%work, size(self%work), info)
      status = merge(0, 1, info == 0)
      if (status /= 0) return
      associate (n_v => linkage%coordinates%n_v, change => linkage%solution%a)
         change = 0.0_wp
         do k = 1, self%rank
            c = modulo(self%order(k) - 1, n_v) + 1
            associate (body => linkage%rows%unknown((self%order(k) - 1)/n_v + 1))
               change(c, body) = self%right(k, 1)*merge(1.0_wp, linkage%scales%length, linkage%coordinates%is_turn(c))
            end associate
         end do
      end associate
      call linkage%add_change(to_rates, y)
   end subroutine change_dependent

   !> The Jacobian, rows and coordinates scaled, in the order of the coordinates.
   subroutine scaled_jacobian(self, linkage)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(in) :: linkage             !! the bodies and their rows, evaluated

      integer :: body, c, column, k, place(0:linkage%bodies%n), position(size(self%order)), row

      associate (rows => linkage%rows, n_v => linkage%coordinates%n_v, is_turn => linkage%coordinates%is_turn)
         place = 0
         place(rows%unknown) = [(n_v*(k - 1), k=1, rows%n_unknown)]
         position(self%order) = [(k, k=1, size(self%order))]
         self%jac = 0.0_wp
         do k = 1, rows%n_side
            row = rows%side_row(k)
            body = body_of_side(rows, rows%side(k))
            do c = 1, n_v
               column = position(place(body) + c)
               self%jac(row, column) = rows%jac(before_side(n_v, rows%side(k)) + c, block_of_side(rows%side(k))) &
                                       *linkage%solution%row_weight(row)*merge(1.0_wp, linkage%scales%length, is_turn(c))
            end do
         end do
      end associate
   end subroutine scaled_jacobian

   !> Choose the dependent coordinates at the present position.
   subroutine sort_coordinates(self, linkage)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(in) :: linkage             !! the bodies and their rows, evaluated

      integer, allocatable :: pivots(:)
      integer :: info, k, m, n

      m = linkage%rows%n_solve
      n = linkage%coordinates%n_v*linkage%rows%n_unknown
      if (.not. allocated(self%order)) self%order = [(k, k=1, n)]
      call scaled_jacobian(self, linkage)
      allocate (pivots(n), source=0)
      call dgeqp3(m, n, self%jac, m, pivots, self%tau, self%work, size(self%work), info)
      self%rank = count([(abs(self%jac(k, k)) > rank_tolerance*abs(self%jac(1, 1)), k=1, min(m, n))])
      self%order = self%order(pivots)
      self%quality = abs(self%jac(max(1, self%rank), max(1, self%rank)))/abs(self%jac(1, 1))
   end subroutine sort_coordinates

   !> Sort anew if the minimum pivot of the dependent columns has become too small.
   subroutine check_quality(self, linkage)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method
      type(linkage_t), intent(in) :: linkage             !! the bodies and their rows, evaluated

      real(wp) :: maximum, minimum
      integer :: info, k

      call scaled_jacobian(self, linkage)
      maximum = maxval(norm2(self%jac, dim=1))
      call dgeqrf(size(self%jac, 1), self%rank, self%jac, size(self%jac, 1), self%tau, self%work, size(self%work), info)
      minimum = minval([(abs(self%jac(k, k)), k=1, self%rank)])
      if (minimum < worse*self%quality*maximum) call sort_coordinates(self, linkage)
   end subroutine check_quality

   !> The order of the coordinates is not there before the first evaluation.
   pure logical function partitioning_is_memory_fixed() result(is_fixed)
      is_fixed = .false.
   end function partitioning_is_memory_fixed

   !> Write what the method remembers.
   subroutine partitioning_save(self, archive)
      class(stabilisation_partitioning_t), intent(in) :: self  !! the stabilisation method
      type(archive_t), intent(inout) :: archive                !! the checkpoint

      integer :: n

      n = 0
      if (allocated(self%order)) n = size(self%order)   ! nothing is sorted where there are no rows
      call archive%put(real(self%rank, wp))
      call archive%put(self%quality)
      call archive%put(real(n, wp))
      if (n > 0) call archive%put(real(self%order, wp))
   end subroutine partitioning_save

   !> Read what the method remembers.
   subroutine partitioning_load(self, archive)
      class(stabilisation_partitioning_t), intent(inout) :: self  !! the stabilisation method
      type(archive_t), intent(inout) :: archive                   !! the checkpoint

      real(wp), allocatable :: order(:)
      real(wp) :: n, rank

      call archive%get(rank)
      call archive%get(self%quality)
      call archive%get(n)
      self%rank = nint(rank)
      if (nint(n) == 0) return
      allocate (order(nint(n)))
      call archive%get(order)
      self%order = nint(order)
   end subroutine partitioning_load

end module stabilisation_partitioning
