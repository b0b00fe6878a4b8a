!> Paths of a point and of clearance joints through the rows of a run.
!>
!> A path is thinned as it grows: memory does not grow with the run. Where two rows of a clearance joint become one, the greater
!> force stays.
module tracks
   use kinds, only: wp
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: greater, track_t

   integer, parameter :: longest = 4000  !! rows of a path

   !> What is followed from row to row.
   type :: track_t
      integer :: n = 0                      !! rows
      integer :: skipped = 0                !! rows since the last
      integer :: stride = 1                 !! rows that become one
      real(wp), allocatable :: t(:)         !! (n or more) times [s]
      real(wp), allocatable :: x(:, :)      !! (3, n or more) the point, world frame [m]
      real(wp), allocatable :: e(:, :, :)   !! (3, joints, n or more) eccentricities, world frame [m]
      real(wp), allocatable :: f(:, :, :)   !! (3, joints, n or more) forces on the journals, world frame [N]
   contains
      procedure :: add
      procedure :: drop
      procedure :: save => save_track
      procedure :: load => load_track
   end type track_t

contains

   !> Append a row, or join it to the last. When there is no storage, rows go that are of no use any more, or every other one.
   subroutine add(self, t, x, e, f, since)
      class(track_t), intent(inout) :: self   !! the path
      real(wp), intent(in) :: t               !! time [s]
      real(wp), intent(in) :: x(3)            !! (3) the point [m]
      real(wp), intent(in) :: e(:, :)         !! (3, joints) eccentricities [m]
      real(wp), intent(in) :: f(:, :)         !! (3, joints) forces on the journals [N]
      real(wp), intent(in) :: since           !! rows before it are of no use [s]

      if (.not. allocated(self%t)) call make_storage(size(f, 2), self)
      if (self%n > 0 .and. self%skipped < self%stride - 1) then
         self%skipped = self%skipped + 1
         self%f(:, :, self%n) = greater(self%f(:, :, self%n), f)
         return
      end if
      if (self%n == longest) then
         call self%drop(since)
         if (2*self%n > longest) call thin(self)
      end if
      self%skipped = 0
      self%n = self%n + 1
      self%t(self%n) = t
      self%x(:, self%n) = x
      self%e(:, :, self%n) = e
      self%f(:, :, self%n) = f
   end subroutine add

   !> Storage for a path.
   subroutine make_storage(n_joint, track)
      integer, intent(in) :: n_joint          !! joints with clearance
      type(track_t), intent(inout) :: track   !! the path

      allocate (track%t(longest), track%x(3, longest), track%e(3, n_joint, longest), track%f(3, n_joint, longest))
   end subroutine make_storage

   !> Of two forces of each joint the greater.
   pure function greater(f, g) result(h)
      real(wp), intent(in) :: f(:, :)                 !! (3, joints) forces [N]
      real(wp), intent(in) :: g(:, :)                 !! (3, joints) others [N]
      real(wp) :: h(3, size(f, 2))                    !! (3, joints) one of both [N]

      integer :: k

      do k = 1, size(f, 2)
         h(:, k) = f(:, k)
         if (norm2(g(:, k)) > norm2(f(:, k))) h(:, k) = g(:, k)
      end do
   end function greater

   !> Two rows become one.
   subroutine thin(track)
      type(track_t), intent(inout) :: track   !! the path

      integer :: k

      do k = 1, track%n/2
         track%t(k) = track%t(2*k - 1)
         track%x(:, k) = track%x(:, 2*k - 1)
         track%e(:, :, k) = track%e(:, :, 2*k - 1)
         track%f(:, :, k) = greater(track%f(:, :, 2*k - 1), track%f(:, :, 2*k))
      end do
      track%n = track%n/2
      track%stride = 2*track%stride
   end subroutine thin

   !> Rows before a time go.
   subroutine drop(self, before)
      class(track_t), intent(inout) :: self   !! the path
      real(wp), intent(in) :: before          !! the time [s]

      integer :: k, n

      n = count(self%t(:self%n) < before)
      if (n == 0) return
      do k = n + 1, self%n
         self%t(k - n) = self%t(k)
         self%x(:, k - n) = self%x(:, k)
         self%e(:, :, k - n) = self%e(:, :, k)
         self%f(:, :, k - n) = self%f(:, :, k)
      end do
      self%n = self%n - n
   end subroutine drop

   !> Write the path so far.
   subroutine save_track(self, archive)
      class(track_t), intent(in) :: self   !! the path
      type(archive_t), intent(inout) :: archive  !! receives it

      integer :: i

      call archive%put([self%n, self%skipped, self%stride])
      do i = 1, self%n
         call archive%put([self%t(i), self%x(:, i), reshape(self%e(:, :, i), [size(self%e(:, :, i))]), &
                           reshape(self%f(:, :, i), [size(self%f(:, :, i))])])
      end do
   end subroutine save_track

   !> Take it back.
   subroutine load_track(self, n_joint, archive)
      class(track_t), intent(inout) :: self   !! the path
      integer, intent(in) :: n_joint          !! joints with clearance
      type(archive_t), intent(inout) :: archive     !! holds it

      integer :: i, k

      call archive%get(self%n)
      call archive%get(self%skipped)
      call archive%get(self%stride)
      if (self%n > 0 .and. .not. allocated(self%t)) call make_storage(n_joint, self)
      do i = 1, self%n
         call archive%get(self%t(i))
         call archive%get(self%x(:, i))
         do k = 1, n_joint
            call archive%get(self%e(:, k, i))
         end do
         do k = 1, n_joint
            call archive%get(self%f(:, k, i))
         end do
      end do
   end subroutine load_track

end module tracks
