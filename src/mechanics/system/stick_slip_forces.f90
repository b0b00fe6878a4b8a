!> Storage for the friction forces of contacts that stick, and the small system that they solve.
module stick_slip_forces
   use kinds, only: wp
   use lapack, only: dsyev
   implicit none (type, external)
   private
   public :: stick_slip_forces_t, gripped_t, new_stick_slip_forces, share_of_stick_slips, solve_stick_slips, unit_load_t

   real(wp), parameter :: started = 1.0e-3_wp   !! root of what a contact can hold at least, of the greatest one [1]

   !> Loads of a unit force, and storage for what they are solved in place of.
   type :: unit_load_t
      real(wp), allocatable :: unit(:, :)   !! (n_v, 0:bodies) loads of a unit force [1 or m]
      real(wp), allocatable :: b(:)         !! (rows) right-hand side of the rows, kept [m/s^2 or rad/s^2]
   end type unit_load_t

   !> Storage for a state and its derivative.
   type :: trial_state_t
      real(wp), allocatable :: y(:)      !! (n) state [any]
      real(wp), allocatable :: ydot(:)   !! (n) its derivative [any]
   end type trial_state_t

   !> A tangent of a contact that sticks.
   type :: gripped_t
      integer :: slot = 0      !! set of the contact
      integer :: contact = 0   !! the contact
      integer :: axis = 0      !! the tangent
   end type gripped_t

   !> Contacts whose friction has a memory.
   type :: stick_slip_forces_t
      integer :: n_slip = 0                      !! contacts that may stick: of laws that remember a slip
      integer :: n_bristle = 0                   !! components of the deflections of contacts with bristles
      logical :: have_ways = .false.             !! some of them slide in a plane, along a way that they follow
      real(wp) :: h = 0.0_wp                     !! length of the step in hand [s]
      type(gripped_t), allocatable :: at(:)      !! (n_force) tangents of the contacts that stick, the first ones used
      real(wp), allocatable :: matrix(:, :)      !! (n_force, n_force) what a unit force does to the sliding accelerations [1/kg]
      real(wp), allocatable :: force(:)          !! (n_force) forces [N]
      real(wp), allocatable :: mobility(:)       !! (n_force) its diagonal if the bodies were free [1/kg]
      logical, allocatable :: is_fixed(:)        !! (n_force) whether no force of its own moves it
      real(wp), allocatable :: left(:)           !! (n_force) sliding acceleration that no force can change [m/s^2]
      real(wp), allocatable :: root(:)           !! (n_force) roots of what the contacts can hold [N^0.5]
      real(wp), allocatable :: eigenvalue(:)     !! (n_force) of the scaled matrix [1/kg]
      real(wp), allocatable :: work(:)           !! (any) scratch [any]
      type(unit_load_t) :: load                  !! of a unit force
      type(trial_state_t) :: trial               !! a state a moment later
   end type stick_slip_forces_t

contains

   !> Storage for contacts that may stick.
   subroutine new_stick_slip_forces(n_slip, n_force, n_bristle, a, n_row, n, stick_slips)
      integer, intent(in) :: n_slip               !! contacts that may stick
      integer, intent(in) :: n_force              !! their tangents
      integer, intent(in) :: n_bristle            !! components of the deflections of contacts with bristles
      real(wp), intent(in) :: a(:, 0:)            !! (n_v, 0:bodies) accelerations, for the shape of loads [any]
      integer, intent(in) :: n_row                !! rows
      integer, intent(in) :: n                    !! entries of the state
      type(stick_slip_forces_t), intent(out) :: stick_slips   !! workspace

      stick_slips%n_slip = n_slip
      stick_slips%n_bristle = n_bristle
      if (n_slip == 0) return
      stick_slips%have_ways = n_force > n_slip
      allocate (stick_slips%at(n_force))
      allocate (stick_slips%is_fixed(n_force), source=.false.)
      allocate (stick_slips%matrix(n_force, n_force), stick_slips%mobility(n_force), stick_slips%left(n_force), &
                stick_slips%force(n_force), &
                stick_slips%root(n_force), stick_slips%eigenvalue(n_force), &
                stick_slips%work(34*n_force), stick_slips%load%unit(size(a, 1), 0:ubound(a, 2)), stick_slips%load%b(n_row), &
                     stick_slips%trial%y(n), &
                stick_slips%trial%ydot(n), source=0.0_wp)
   end subroutine new_stick_slip_forces

   !> Forces x with A x = r, A symmetric and positive semidefinite; where contacts share a load, the solution that uses each
   !> to the same part of what it can hold: minimum sum of x^2/L_c, L_c = c_s F_N. A contact that starts has no normal force
   !> yet, but it counts (`started`). What no force can change of r is left: where drivers prescribe the sliding.
   subroutine solve_stick_slips(n, lead, matrix, mobility, minimum, root, force, left, eigenvalue, work)
      integer, intent(in) :: n                      !! contacts
      integer, intent(in) :: lead                   !! first extent of the matrix
      real(wp), intent(inout) :: matrix(lead, n)    !! (lead, n) A, destroyed [1/kg]
      real(wp), intent(in) :: mobility(n)           !! (n) diagonal of A if the bodies were free [1/kg]
      real(wp), intent(in) :: minimum                 !! mobility taken as zero, of that [1]
      real(wp), intent(in) :: root(n)               !! (n) roots of L_c, positive [N^0.5]
      real(wp), intent(inout) :: force(n)           !! (n) r [m/s^2], then x [N]
      real(wp), intent(out) :: left(n)              !! (n) r - A x [m/s^2]
      real(wp), intent(out) :: eigenvalue(n)        !! (n) scratch [1/kg]
      real(wp), intent(out) :: work(:)              !! (34 n) scratch [any]

      real(wp) :: bound, part, maximum
      integer :: i, info, j

      left = 0.0_wp
      if (n == 1) then
         if (matrix(1, 1) > minimum*mobility(1)) then
            force(1) = force(1)/matrix(1, 1)
         else
            left(1) = force(1)
            force(1) = 0.0_wp
         end if
         return
      end if
      maximum = maxval(root)
      do j = 1, n
         do i = 1, n
            matrix(i, j) = weight(root(i), maximum)*matrix(i, j)*weight(root(j), maximum)
         end do
         force(j) = weight(root(j), maximum)*force(j)
      end do
      call dsyev("V", "U", n, matrix, lead, eigenvalue, work, size(work), info)
      bound = minimum*max(eigenvalue(n), maxval(weight(root, maximum)**2*mobility))
      work(:n) = 0.0_wp
      do i = 1, n
         part = dot_product(matrix(:n, i), force)
         if (info /= 0 .or. eigenvalue(i) <= bound) then
            left = left + part*matrix(:n, i)
         else
            work(:n) = work(:n) + part/eigenvalue(i)*matrix(:n, i)
         end if
      end do
      left = left/weight(root, maximum)
      force = weight(root, maximum)*work(:n)
   end subroutine solve_stick_slips

   !> What a contact counts for.
   elemental real(wp) function weight(root, maximum)
      real(wp), intent(in) :: root      !! root of what it can hold [N^0.5]
      real(wp), intent(in) :: maximum   !! the greatest one, positive [N^0.5]

      weight = max(root/maximum, started)
   end function weight

   !> How far each force takes part in those x with A x = 0, which change no acceleration: the diagonal of the projection onto
   !> them, of A scaled by the mobilities of free bodies.
   subroutine share_of_stick_slips(n, lead, matrix, mobility, minimum, share, eigenvalue, work)
      integer, intent(in) :: n                      !! forces
      integer, intent(in) :: lead                   !! first extent of the matrix
      real(wp), intent(inout) :: matrix(lead, n)    !! (lead, n) A, destroyed [1/kg]
      real(wp), intent(in) :: mobility(n)           !! (n) diagonal of A if the bodies were free [1/kg]
      real(wp), intent(in) :: minimum                 !! mobility taken as zero, of that [1]
      real(wp), intent(out) :: share(n)             !! (n) 0: the force is unique, 1: it changes no acceleration [1]
      real(wp), intent(out) :: eigenvalue(n)        !! (n) scratch [1]
      real(wp), intent(out) :: work(:)              !! (34 n) scratch [any]

      integer :: i, info, j

      do j = 1, n
         do i = 1, n
            matrix(i, j) = matrix(i, j)/sqrt(max(mobility(i)*mobility(j), tiny(1.0_wp)))
         end do
      end do
      call dsyev("V", "U", n, matrix, lead, eigenvalue, work, size(work), info)
      share = 0.0_wp
      if (info /= 0) return
      do i = 1, n
         if (eigenvalue(i) > minimum*max(eigenvalue(n), 1.0_wp)) exit
         share = share + matrix(:n, i)**2
      end do
   end subroutine share_of_stick_slips

end module stick_slip_forces
