!> What the joints and drivers leave free, and which drivers are in excess.
!>
!> From the singular values of the scaled Jacobian, Phi_q = U S V^T: columns of V beyond the rank are motions
!> that no row hinders. A driver is in excess if what it prescribes is prescribed by the joints and the
!> other drivers already: the rows of drivers on the motions that the joints leave free, D V_0, are
!> factorised with pivoting.
!>
!> Source: Flores et al. (2008), section 2.4 (drivers and degrees of freedom); Golub and Van
!> Loan, Matrix Computations, sections 2.5 and 5.4 (rank). Limits: dense; the present position only.
module mobility
   use kinds, only: wp
   use lapack, only: dgeqp3, dgesvd
   use linkage, only: linkage_t
   use row_corrections, only: rank_tolerance, scaled_jacobian
   use text, only: append_text, text_t, to_text
   implicit none (type, external)
   private
   public :: drives, find_mobility, joint_names, mobility_t, moving_bodies, split_space, stiffest_driver

   real(wp), parameter :: takes_part = 1.0e-6_wp   !! minimum entry of a unit vector that counts [1]
   integer, parameter :: most_names = 8            !! names reported in a message

   !> What is free, and which drivers are in excess.
   type :: mobility_t
      integer :: rank = 0                          !! independent rows, drivers included
      integer :: n_left = 0                        !! freedoms that neither joints nor drivers hold
      integer :: n_freedom = 0                     !! freedoms that the joints leave
      integer :: n_driver = 0                      !! rows of drivers
      logical, allocatable :: is_driver(:)         !! (rows) rows of drivers
      logical, allocatable :: is_excess(:)         !! (rows) rows of drivers that others prescribe already
      real(wp), allocatable :: freedom(:)          !! (bodies) how much each body can still move, 0 to 1 [1]
      real(wp), allocatable :: weakest(:)          !! (rows) left singular vector of the minimum singular value [1]
   end type mobility_t

contains

   !> Freedoms and drivers in excess at the position where the rows were evaluated.
   subroutine find_mobility(linkage, mobility)
      type(linkage_t), intent(in) :: linkage !! the bodies and their rows, rows evaluated
      type(mobility_t), intent(out) :: mobility      !! what is free, and drivers in excess

      real(wp), allocatable :: free(:, :), jac(:, :), joints(:, :), left(:, :)
      integer, allocatable :: drivers(:), others(:)
      integer :: k, m, n, n_v, rank

      m = linkage%rows%n
      n = linkage%coordinates%n_v*linkage%bodies%n
      mobility%is_driver = drives(linkage)
      mobility%n_driver = count(mobility%is_driver)
      drivers = pack([(k, k=1, m)], mobility%is_driver)
      others = pack([(k, k=1, m)], .not. mobility%is_driver)
      call scaled_jacobian(linkage, jac)
      joints = jac(others, :)
      call split_space(joints, rank, left, free)
      mobility%n_freedom = n - rank
      allocate (mobility%is_excess(m), source=.false.)
      call find_excess(jac(drivers, :), free, drivers, mobility%is_excess)
      call split_space(jac, mobility%rank, left, free)
      mobility%n_left = n - mobility%rank
      allocate (mobility%freedom(linkage%bodies%n), mobility%weakest(m), source=0.0_wp)
      n_v = linkage%coordinates%n_v
      do k = 1, linkage%bodies%n
         if (mobility%n_left > 0) mobility%freedom(k) = maxval(norm2(free(n_v*(k - 1) + 1:n_v*k, :), dim=1))
      end do
      if (mobility%rank > 0) mobility%weakest = left(:, mobility%rank)
   end subroutine find_mobility

   !> Which rows belong to drivers.
   function drives(linkage) result(is_driver)
      type(linkage_t), intent(in) :: linkage         !! the bodies and their rows
      logical :: is_driver(linkage%rows%n)           !! (rows) rows of drivers

      integer :: k

      is_driver = .false.
      do k = 1, size(linkage%joints)
         associate (set => linkage%joints(k)%set)
            if (set%is_driver) is_driver(set%first_row + 1:set%first_row + set%n*set%n_row_item) = .true.
         end associate
      end do
   end function drives

   !> Rank, left singular vectors, and an orthonormal basis of the motions that the rows leave free.
   subroutine split_space(jac, rank, left, free, tolerance)
      real(wp), intent(in) :: jac(:, :)                   !! (rows, n) scaled Jacobian [1]
      integer, intent(out) :: rank                        !! independent rows
      real(wp), allocatable, intent(out) :: left(:, :)    !! (rows, rows) left singular vectors [1]
      real(wp), allocatable, intent(out) :: free(:, :)    !! (n, n - rank) free motions [1]
      real(wp), intent(in), optional :: tolerance         !! minimum ratio of singular values, if another than usual [1]

      real(wp), allocatable :: a(:, :), s(:), vt(:, :), work(:)
      real(wp) :: minimum
      integer :: info, k, m, n

      minimum = rank_tolerance
      if (present(tolerance)) minimum = tolerance
      m = size(jac, 1)
      n = size(jac, 2)
      rank = 0
      allocate (left(m, m), vt(n, n), s(min(m, n)), work(8*(m + n) + 64), source=0.0_wp)
      if (m == 0) then
         do k = 1, n
            vt(k, k) = 1.0_wp
         end do
      else
         a = jac
         call dgesvd("A", "A", m, n, a, m, s, left, m, vt, n, work, size(work), info)
         rank = count(s > minimum*s(1))
      end if
      free = transpose(vt(rank + 1:, :))
   end subroutine split_space

   !> Drivers that prescribe what others do already.
   subroutine find_excess(driving, free, drivers, is_excess)
      real(wp), intent(in) :: driving(:, :)      !! (drivers, n) their rows of the Jacobian [1]
      real(wp), intent(in) :: free(:, :)         !! (n, freedoms) motions that the joints leave free [1]
      integer, intent(in) :: drivers(:)          !! (drivers) numbers of the rows
      logical, intent(inout) :: is_excess(:)     !! (rows) set for drivers in excess

      real(wp), allocatable :: a(:, :), tau(:), work(:)
      integer, allocatable :: order(:)
      integer :: info, k, m, n, rank

      m = size(drivers)
      n = size(free, 2)
      is_excess(drivers) = .true.
      if (m == 0 .or. n == 0) return
      a = transpose(matmul(driving, free))
      allocate (order(m), source=0)
      allocate (tau(min(m, n)), work(64*(m + 1)), source=0.0_wp)
      call dgeqp3(n, m, a, n, order, tau, work, size(work), info)
      rank = 0
      do k = 1, min(m, n)
         if (abs(a(k, k)) > rank_tolerance*norm2(driving)) rank = k
      end do
      is_excess(drivers(order(1:rank))) = .false.
   end subroutine find_excess

   !> The driver that takes the maximum part in the minimum singular value: the one that meets a dead centre.
   integer function stiffest_driver(mobility) result(row)
      type(mobility_t), intent(in) :: mobility  !! at a position near the dead centre

      row = maxloc(abs(mobility%weakest), dim=1, mask=mobility%is_driver)
   end function stiffest_driver

   !> Names of the joints and drivers that some rows belong to, each once.
   function joint_names(linkage, is_meant) result(words)
      type(linkage_t), intent(in) :: linkage         !! the bodies and their rows
      logical, intent(in) :: is_meant(:)             !! (rows) which rows
      character(:), allocatable :: words             !! as `'pin' 'guide'`

      type(text_t), allocatable :: names(:)
      integer :: i, k

      allocate (names(0))
      rows: do k = 1, size(is_meant)
         if (.not. is_meant(k)) cycle rows
         do i = 1, size(names)
            if (names(i)%s == linkage%row_name(k)) cycle rows
         end do
         call append_text(names, linkage%row_name(k))
      end do rows
      words = counted_names(names)
   end function joint_names

   !> Names of the bodies that move, those that move most first.
   function moving_bodies(linkage, motion) result(words)
      type(linkage_t), intent(in) :: linkage         !! the bodies and their rows
      real(wp), intent(in) :: motion(:)              !! (bodies) how much each moves, 0 to 1 [1]
      character(:), allocatable :: words             !! as `'rod' 'bob'`

      type(text_t), allocatable :: names(:)
      logical :: is_left(linkage%bodies%n)
      integer :: k

      allocate (names(0))
      is_left = motion > takes_part
      do while (any(is_left))
         k = maxloc(motion, dim=1, mask=is_left)
         is_left(k) = .false.
         call append_text(names, linkage%bodies%names(k)%s)
      end do
      words = counted_names(names)
   end function moving_bodies

   !> Quoted names, cut short if there are many.
   function counted_names(names) result(words)
      type(text_t), intent(in) :: names(:)   !! (any) names
      character(:), allocatable :: words     !! as `'a' 'b' and 12 more`

      integer :: k

      words = ""
      do k = 1, min(size(names), most_names)
         words = words//"'"//names(k)%s//"' "
      end do
      words = trim(words)
      if (size(names) > most_names) words = words//" and "//to_text(size(names) - most_names)//" more"
   end function counted_names

end module mobility
