!> Pictures of a motion at some instants, kept while it continues: places of bodies, forces and eccentricities of clearance joints,
!> loads, paths.
!>
!> A picture is that of the output instant nearest to the time asked for. A path has a place for each row of the window. A run may
!> end before its time: figures at its end have the last row, and windows that end with the run are those before it: the latest
!> pictures, at the intervals of the window, are kept all the time. Positions one over the other are at equal intervals also where
!> it ends within its first window: of that, pictures are kept that are thinned as it continues.
module frames
   use catalogue, only: catalogue_t
   use frame_values, only: bind_source, frame_source_t, frame_t, load_frame, reads_source, save_frame, take_frame
   use kinds, only: wp
   use archive, only: archive_t
   use tracks, only: track_t
   implicit none (type, external)
   private
   public :: frame_keeper_t, frame_plan_t, frame_t, wanted_frames_t

   real(wp), parameter :: same = 1.0e-6_wp   !! what is later by less is the same picture, of the output interval [1]
   integer, parameter :: finer = 8           !! pictures kept of a first window, for each that is requested

   !> Instants that one figure needs.
   type :: wanted_frames_t
      character(:), allocatable :: name     !! of the figure
      real(wp), allocatable :: times(:)     !! (n) increasing [s]
      real(wp) :: from = 0.0_wp             !! start of its window [s]
      real(wp) :: to = -1.0_wp              !! its end; before the start: it has no paths [s]
      real(wp) :: length = 0.0_wp           !! of a window that is reported from the end of the run; 0: it is not [s]
      real(wp) :: gap = 0.0_wp              !! between its pictures; 0: there is one [s]
      logical :: repeats = .false.          !! its last picture is like the first: what repeats omits it
      logical :: has_end = .false.          !! whether it ends with the run, whenever that is
      integer :: body = -1                  !! of a point whose path is followed: its body; -1: there is none
      real(wp) :: s(3) = 0.0_wp             !! (3) the point, in the body's own frame [m]
   end type wanted_frames_t

   !> What all figures need.
   type :: frame_plan_t
      type(wanted_frames_t), allocatable :: wanted(:)  !! (figures) what each needs
      real(wp) :: every = 0.0_wp                       !! output interval [s]
      real(wp) :: first = 0.0_wp                       !! first output instant [s]
      real(wp) :: end = 0.0_wp                         !! end of the run, if nothing ends it before [s]
   end type frame_plan_t

   !> Pictures of a first window, at equal intervals.
   type :: first_window_t
      integer :: n = 0                          !! how many there are
      integer :: stride = 1                     !! output instants from one to the next
      integer :: skipped = 0                    !! output instants since the last
      type(frame_t), allocatable :: frames(:)   !! (n or more) the pictures
   end type first_window_t

   !> Keeps them.
   type :: frame_keeper_t
      type(frame_plan_t) :: plan                          !! what is requested
      type(frame_t), allocatable :: frames(:, :)          !! (most times, figures) pictures
      integer, allocatable :: n(:)                        !! (figures) how many there are of each
      type(track_t), allocatable :: tracks(:)             !! (figures) paths
      logical :: is_wanted = .false.                      !! there are figures that need something
      type(frame_source_t), private :: source                   !! where the numbers are
      type(frame_t), private :: last                      !! picture of the last row
      type(frame_t), allocatable, private :: latest(:, :) !! (most times, figures) the latest pictures, in a ring
      integer, allocatable, private :: n_latest(:)        !! (figures) how many there have been
      type(first_window_t), allocatable, private :: early(:)  !! (figures) of those without paths
   contains
      procedure :: start
      procedure :: reads
      procedure :: sample
      procedure :: follow
      procedure :: finish => finish_frames
      procedure :: save => save_frames
      procedure :: load => load_frames
   end type frame_keeper_t

contains

   !> Start with nothing.
   subroutine start(self, plan, catalogue)
      class(frame_keeper_t), intent(out) :: self  !! the keeper
      type(frame_plan_t), intent(in) :: plan      !! what is requested
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded

      integer :: k, most, n

      self%plan = plan
      if (.not. allocated(self%plan%wanted)) allocate (self%plan%wanted(0))
      n = size(self%plan%wanted)
      allocate (self%n(n), self%n_latest(n), source=0)
      self%is_wanted = n > 0
      allocate (self%tracks(n), self%early(n))
      most = max(0, maxval([(size(self%plan%wanted(k)%times), k=1, n)]))
      allocate (self%frames(most, n), self%latest(most, n))
      if (.not. self%is_wanted) return
      call bind_source(self%source, catalogue)
   end subroutine start

   !> Whether a group of the catalogue is read.
   pure logical function reads(self, group)
      class(frame_keeper_t), intent(in) :: self  !! the keeper
      integer, intent(in) :: group               !! number of the group

      reads = self%is_wanted
      if (reads) reads = reads_source(self%source, group)
   end function reads

   !> An output instant.
   subroutine sample(self, t, catalogue)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper
      real(wp), intent(in) :: t                     !! time [s]
      type(catalogue_t), intent(in) :: catalogue    !! values at t

      integer :: k

      do k = 1, size(self%n)
         associate (this => self%plan%wanted(k), near => 0.5_wp*self%plan%every)
            do while (self%n(k) < size(this%times))
               if (t < this%times(self%n(k) + 1) - near) exit
               self%n(k) = self%n(k) + 1
               call take_frame(self%source, t, catalogue, self%frames(self%n(k), k))
            end do
            if (is_early(self%plan, this, t)) call go_on(self%early(k), size(this%times), self%source, t, catalogue)
            if (.not. (this%length > 0.0_wp .and. this%gap > 0.0_wp)) cycle
            do while (t >= self%plan%first + self%n_latest(k)*this%gap - near)
               call take_frame(self%source, t, catalogue, self%latest(modulo(self%n_latest(k), size(this%times)) + 1, k))
               self%n_latest(k) = self%n_latest(k) + 1
            end do
         end associate
      end do
      call self%follow(t, catalogue)
   end subroutine sample

   !> Whether a time is within the first window of positions one over the other.
   pure logical function is_early(plan, wanted, t)
      type(frame_plan_t), intent(in) :: plan       !! what is requested
      type(wanted_frames_t), intent(in) :: wanted  !! the figure
      real(wp), intent(in) :: t                    !! the time [s]

      is_early = wanted%gap > 0.0_wp .and. wanted%to < wanted%from .and. &
                 t < plan%first + real(size(wanted%times) - 1, wp)*wanted%gap
   end function is_early

   !> One more output instant of a first window. When there is no storage, every other picture goes.
   subroutine go_on(early, most, source, t, catalogue)
      type(first_window_t), intent(inout) :: early  !! the pictures
      integer, intent(in) :: most                   !! how many are requested
      type(frame_source_t), intent(in) :: source          !! where the values are
      real(wp), intent(in) :: t                     !! time [s]
      type(catalogue_t), intent(in) :: catalogue    !! values at t

      integer :: i

      if (early%n > 0 .and. early%skipped < early%stride - 1) then
         early%skipped = early%skipped + 1
         return
      end if
      if (.not. allocated(early%frames)) allocate (early%frames(finer*most))
      if (early%n == size(early%frames)) then
         early%n = early%n/2
         early%stride = 2*early%stride
         do i = 2, early%n
            early%frames(i) = early%frames(2*i - 1)
         end do
      end if
      early%skipped = 0
      early%n = early%n + 1
      call take_frame(source, t, catalogue, early%frames(early%n))
   end subroutine go_on

   !> A row of any kind: paths continue, and it is the last one.
   subroutine follow(self, t, catalogue)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper
      real(wp), intent(in) :: t                     !! time [s]
      type(catalogue_t), intent(in) :: catalogue    !! values at t

      real(wp) :: x(3)
      integer :: k

      if (.not. any(self%plan%wanted%has_end)) return
      call take_frame(self%source, t, catalogue, self%last)
      do k = 1, size(self%n)
         associate (this => self%plan%wanted(k), near => 0.5_wp*self%plan%every, last => self%last)
            if (t > this%to) cycle
            if (t < this%from - near .and. .not. this%length > 0.0_wp) cycle
            x = 0.0_wp
            if (this%body >= 0) x = last%r(:, this%body) + matmul(last%a(:, :, this%body), this%s)
            call self%tracks(k)%add(t, x, last%e, last%f, merge(t - this%length, this%from, this%length > 0.0_wp) - near)
         end associate
      end do
   end subroutine follow

   !> The run has ended, perhaps before its time.
   subroutine finish_frames(self)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper

      real(wp) :: from
      integer :: k
      logical :: has_ended

      if (.not. allocated(self%last%r)) return
      has_ended = self%last%t < self%plan%end - 0.5_wp*self%plan%every
      do k = 1, size(self%n)
         associate (this => self%plan%wanted(k))
            from = this%from
            if (has_ended .and. this%has_end) then
               if (this%length > 0.0_wp) from = max(self%last%t - this%length, self%plan%first)
               call end_early(self, k, from)
            end if
            if (self%tracks(k)%n > 0) call self%tracks(k)%drop(from - 0.5_wp*self%plan%every)
         end associate
      end do
   end subroutine finish_frames

   !> Pictures of a figure whose run ended before its time: those of its first window at equal intervals if it ended within that,
   !> else the latest ones of a window that is reported from the end, those so far of another; and that of the last row where there
   !> is storage for it.
   subroutine end_early(self, k, from)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper
      integer, intent(in) :: k                      !! the figure
      real(wp), intent(in) :: from                  !! start of its window [s]

      integer :: before, i, j, most, slot

      most = size(self%plan%wanted(k)%times)
      if (is_early(self%plan, self%plan%wanted(k), self%last%t) .and. self%early(k)%n > 0) then
         self%n(k) = 0
         before = 0
         associate (early => self%early(k), first => self%plan%first, last => self%last%t)
            do i = 0, most - 2
               j = minloc(abs(early%frames(:early%n)%t - first - (last - first)*real(i, wp)/real(most - 1, wp)), dim=1)
               if (j <= before .or. last - early%frames(j)%t <= same*self%plan%every) cycle
               before = j
               self%n(k) = self%n(k) + 1
               self%frames(self%n(k), k) = early%frames(j)
            end do
         end associate
         self%n(k) = self%n(k) + 1
         self%frames(self%n(k), k) = self%last
         return
      end if
      if (self%plan%wanted(k)%length > 0.0_wp .or. most == 1) self%n(k) = 0
      do i = max(self%n_latest(k) - most, 0), self%n_latest(k) - 1
         slot = modulo(i, most) + 1
         if (self%latest(slot, k)%t < from - 0.5_wp*self%plan%every) cycle
         self%n(k) = self%n(k) + 1
         self%frames(self%n(k), k) = self%latest(slot, k)
      end do
      if (self%n(k) == most) return
      if (self%n(k) > 0) then
         if (self%last%t - self%frames(self%n(k), k)%t <= same*self%plan%every) return
      end if
      self%n(k) = self%n(k) + 1
      self%frames(self%n(k), k) = self%last
   end subroutine end_early

   !> Write the pictures and paths so far.
   subroutine save_frames(self, archive)
      class(frame_keeper_t), intent(in) :: self  !! the keeper
      type(archive_t), intent(inout) :: archive        !! receives them

      integer :: i, k

      do k = 1, size(self%n)
         call archive%put([self%n(k), self%n_latest(k)])
         do i = 1, self%n(k)
            call save_frame(self%frames(i, k), archive)
         end do
         do i = 1, min(self%n_latest(k), size(self%plan%wanted(k)%times))
            call save_frame(self%latest(i, k), archive)
         end do
         call archive%put([self%early(k)%n, self%early(k)%stride, self%early(k)%skipped])
         do i = 1, self%early(k)%n
            call save_frame(self%early(k)%frames(i), archive)
         end do
         call self%tracks(k)%save(archive)
      end do
      call archive%put(merge(1, 0, allocated(self%last%r)))
      if (allocated(self%last%r)) call save_frame(self%last, archive)
   end subroutine save_frames

   !> Take them back.
   subroutine load_frames(self, archive)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper, started
      type(archive_t), intent(inout) :: archive           !! holds them

      integer :: has_last, i, k

      do k = 1, size(self%n)
         call archive%get(self%n(k))
         call archive%get(self%n_latest(k))
         do i = 1, self%n(k)
            call load_frame(self%source, archive, self%frames(i, k))
         end do
         do i = 1, min(self%n_latest(k), size(self%plan%wanted(k)%times))
            call load_frame(self%source, archive, self%latest(i, k))
         end do
         associate (early => self%early(k))
            call archive%get(early%n)
            call archive%get(early%stride)
            call archive%get(early%skipped)
            if (early%n > 0) allocate (early%frames(finer*size(self%plan%wanted(k)%times)))
            do i = 1, early%n
               call load_frame(self%source, archive, early%frames(i))
            end do
         end associate
         call self%tracks(k)%load(self%source%n_joint, archive)
      end do
      call archive%get(has_last)
      if (has_last == 1) call load_frame(self%source, archive, self%last)
   end subroutine load_frames

end module frames
