!> Pictures of a motion at some instants, kept while it goes on: places of bodies, forces and eccentricities of loose joints, loads,
!> paths.
!>
!> A picture is that of the output instant nearest to the time asked for. A path has a place for each row of the window. A run may
!> end before its time: figures at its end have the last row, and windows that end with the run are those before it: the latest
!> pictures, at the intervals of the window, are kept all the time.
module frames
   use catalogue, only: catalogue_t
   use catalogue_rooms, only: room_clearances, room_forces
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use scene_poses, only: pose_reader_t
   use tape, only: tape_t
   use tracks, only: track_t
   implicit none (type, external)
   private
   public :: frame_keeper_t, frame_plan_t, frame_t, wanted_frames_t

   real(wp), parameter :: same = 1.0e-6_wp   !! what is later by less is the same picture, of the output interval [1]

   !> Instants that one figure wants.
   type :: wanted_frames_t
      character(:), allocatable :: name     !! of the figure
      real(wp), allocatable :: times(:)     !! (n) increasing [s]
      real(wp) :: from = 0.0_wp             !! beginning of its window [s]
      real(wp) :: to = -1.0_wp              !! its end; before the beginning: it has no paths [s]
      real(wp) :: length = 0.0_wp           !! of a window that is told from the end of the run; 0: it is not [s]
      real(wp) :: gap = 0.0_wp              !! between its pictures; 0: there is one [s]
      logical :: has_end = .false.          !! whether it ends with the run, whenever that is
      integer :: body = -1                  !! of a point whose path is followed: its body; -1: there is none
      real(wp) :: s(3) = 0.0_wp             !! (3) the point, in the body's own frame [m]
   end type wanted_frames_t

   !> What all figures want.
   type :: frame_plan_t
      type(wanted_frames_t), allocatable :: wanted(:)  !! (figures) what each wants
      real(wp) :: every = 0.0_wp                       !! output interval [s]
      real(wp) :: first = 0.0_wp                       !! first output instant [s]
      real(wp) :: end = 0.0_wp                         !! end of the run, if nothing ends it before [s]
   end type frame_plan_t

   !> One picture.
   type :: frame_t
      real(wp) :: t = 0.0_wp                !! its time [s]
      real(wp), allocatable :: r(:, :)      !! (3, 0:bodies) centres of mass, world frame [m]
      real(wp), allocatable :: a(:, :, :)   !! (3, 3, 0:bodies) own frames to the world's [1]
      real(wp), allocatable :: f(:, :)      !! (3, joints with clearance) forces on the journals, world frame [N]
      real(wp), allocatable :: e(:, :)      !! (3, joints with clearance) eccentricities, world frame [m]
      real(wp), allocatable :: load(:, :)   !! (3, force elements) forces on their first bodies, world frame [N]
   end type frame_t

   !> Where the numbers of a picture are found.
   type :: source_t
      type(pose_reader_t) :: reader         !! what is read of the catalogue
      integer :: eccentricity = 0           !! group of the catalogue
      integer :: n_joint = 0                !! joints with clearance
      integer :: force = 0                  !! group of the catalogue
      integer :: n_force = 0                !! force elements
   end type source_t

   !> Keeps them.
   type :: frame_keeper_t
      type(frame_plan_t) :: plan                          !! what is wanted
      type(frame_t), allocatable :: frames(:, :)          !! (most times, figures) pictures
      integer, allocatable :: n(:)                        !! (figures) how many there are of each
      type(track_t), allocatable :: tracks(:)             !! (figures) paths
      logical :: is_wanted = .false.                      !! there are figures that want something
      type(source_t), private :: source                   !! where the numbers are
      type(frame_t), private :: last                      !! picture of the last row
      type(frame_t), allocatable, private :: latest(:, :) !! (most times, figures) the latest pictures, in a ring
      integer, allocatable, private :: n_latest(:)        !! (figures) how many there have been
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

   !> Begin with nothing.
   subroutine start(self, plan, catalogue)
      class(frame_keeper_t), intent(out) :: self  !! the keeper
      type(frame_plan_t), intent(in) :: plan      !! what is wanted
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded

      integer :: k, most, n

      self%plan = plan
      if (.not. allocated(self%plan%wanted)) allocate (self%plan%wanted(0))
      n = size(self%plan%wanted)
      allocate (self%n(n), self%n_latest(n), source=0)
      self%is_wanted = n > 0
      allocate (self%tracks(n))
      most = max(0, maxval([(size(self%plan%wanted(k)%times), k=1, n)]))
      allocate (self%frames(most, n), self%latest(most, n))
      if (.not. self%is_wanted) return
      associate (source => self%source)
         call source%reader%bind(catalogue)
         source%eccentricity = catalogue%find_group(room_clearances, "eccentricity")
         source%n_joint = size(catalogue%rooms(room_clearances)%names)
         source%force = catalogue%find_group(room_forces, "force")
         source%n_force = size(catalogue%rooms(room_forces)%names)
      end associate
   end subroutine start

   !> Whether a group of the catalogue is read.
   pure logical function reads(self, group)
      class(frame_keeper_t), intent(in) :: self  !! the keeper
      integer, intent(in) :: group               !! number of the group

      reads = self%is_wanted
      if (reads) reads = self%source%reader%reads(group) .or. group == self%source%eccentricity .or. group == self%source%force
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
            if (.not. (this%length > 0.0_wp .and. this%gap > 0.0_wp)) cycle
            do while (t >= self%plan%first + self%n_latest(k)*this%gap - near)
               call take_frame(self%source, t, catalogue, self%latest(modulo(self%n_latest(k), size(this%times)) + 1, k))
               self%n_latest(k) = self%n_latest(k) + 1
            end do
         end associate
      end do
      call self%follow(t, catalogue)
   end subroutine sample

   !> The values of a picture.
   subroutine take_frame(source, t, catalogue, frame)
      type(source_t), intent(in) :: source        !! where they are
      real(wp), intent(in) :: t                   !! time [s]
      type(catalogue_t), intent(in) :: catalogue  !! values at t
      type(frame_t), intent(inout) :: frame       !! the picture

      integer :: k

      frame%t = t
      if (.not. allocated(frame%r)) call make_room(source, frame)
      call source%reader%frames(catalogue, frame%r, frame%a)
      do k = 1, source%n_joint
         frame%f(:, k) = vector_of(catalogue, source%reader%joint_force, k)
         frame%e(:, k) = vector_of(catalogue, source%eccentricity, k)
      end do
      do k = 1, source%n_force
         frame%load(:, k) = vector_of(catalogue, source%force, k)
      end do
   end subroutine take_frame

   !> Room for a picture.
   subroutine make_room(source, frame)
      type(source_t), intent(in) :: source        !! how many numbers it has
      type(frame_t), intent(inout) :: frame       !! the picture

      allocate (frame%r(3, 0:source%reader%n_body), frame%a(3, 3, 0:source%reader%n_body))
      allocate (frame%f(3, source%n_joint), frame%e(3, source%n_joint), frame%load(3, source%n_force))
   end subroutine make_room

   !> A vector of an item; zero where it is not known.
   pure function vector_of(catalogue, group, item) result(x)
      type(catalogue_t), intent(in) :: catalogue  !! values
      integer, intent(in) :: group                !! group of the catalogue, 0: none
      integer, intent(in) :: item                 !! the item
      real(wp) :: x(3)                            !! (3) the vector [any]

      x = 0.0_wp
      if (group == 0) return
      associate (values => catalogue%value(group, item))
         if (.not. any(ieee_is_nan(values))) x(:size(values)) = values
      end associate
   end function vector_of

   !> A row of any kind: paths go on, and it is the last one.
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
            call self%tracks(k)%add(t, x, last%e, norm2(last%f, 1), merge(t - this%length, this%from, this%length > 0.0_wp) - near)
         end associate
      end do
   end subroutine follow

   !> The run has ended, perhaps before its time.
   subroutine finish_frames(self)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper

      real(wp) :: from
      integer :: k
      logical :: is_early

      if (.not. allocated(self%last%r)) return
      is_early = self%last%t < self%plan%end - 0.5_wp*self%plan%every
      do k = 1, size(self%n)
         associate (this => self%plan%wanted(k))
            from = this%from
            if (is_early .and. this%has_end) then
               if (this%length > 0.0_wp) from = max(self%last%t - this%length, self%plan%first)
               call end_early(self, k, from)
            end if
            if (self%tracks(k)%n > 0) call self%tracks(k)%drop(from - 0.5_wp*self%plan%every)
         end associate
      end do
   end subroutine finish_frames

   !> Pictures of a figure whose run ended before its time: the latest ones of a window that is told from the end, those so far of
   !> another, and that of the last row where there is room for it.
   subroutine end_early(self, k, from)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper
      integer, intent(in) :: k                      !! the figure
      real(wp), intent(in) :: from                  !! beginning of its window [s]

      integer :: i, most, slot

      most = size(self%plan%wanted(k)%times)
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
   subroutine save_frames(self, tape)
      class(frame_keeper_t), intent(in) :: self  !! the keeper
      type(tape_t), intent(inout) :: tape        !! receives them

      integer :: i, k

      do k = 1, size(self%n)
         call tape%put([self%n(k), self%n_latest(k)])
         do i = 1, self%n(k)
            call save_frame(self%frames(i, k), tape)
         end do
         do i = 1, min(self%n_latest(k), size(self%plan%wanted(k)%times))
            call save_frame(self%latest(i, k), tape)
         end do
         call self%tracks(k)%save(tape)
      end do
      call tape%put(merge(1, 0, allocated(self%last%r)))
      if (allocated(self%last%r)) call save_frame(self%last, tape)
   end subroutine save_frames

   !> Write a picture.
   subroutine save_frame(frame, tape)
      type(frame_t), intent(in) :: frame   !! the picture
      type(tape_t), intent(inout) :: tape  !! receives it

      call tape%put(frame%t)
      call tape%put(reshape(frame%r, [size(frame%r)]))
      call tape%put(reshape(frame%a, [size(frame%a)]))
      call tape%put(reshape(frame%f, [size(frame%f)]))
      call tape%put(reshape(frame%e, [size(frame%e)]))
      call tape%put(reshape(frame%load, [size(frame%load)]))
   end subroutine save_frame

   !> Take them back.
   subroutine load_frames(self, tape)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper, started
      type(tape_t), intent(inout) :: tape           !! holds them

      integer :: has_last, i, k

      do k = 1, size(self%n)
         call tape%get(self%n(k))
         call tape%get(self%n_latest(k))
         do i = 1, self%n(k)
            call load_frame(self%source, tape, self%frames(i, k))
         end do
         do i = 1, min(self%n_latest(k), size(self%plan%wanted(k)%times))
            call load_frame(self%source, tape, self%latest(i, k))
         end do
         call self%tracks(k)%load(self%source%n_joint, tape)
      end do
      call tape%get(has_last)
      if (has_last == 1) call load_frame(self%source, tape, self%last)
   end subroutine load_frames

   !> Take back a picture.
   subroutine load_frame(source, tape, frame)
      type(source_t), intent(in) :: source         !! how many numbers it has
      type(tape_t), intent(inout) :: tape          !! holds it
      type(frame_t), intent(out) :: frame          !! the picture

      integer :: k

      call make_room(source, frame)
      call tape%get(frame%t)
      do k = 0, source%reader%n_body
         call tape%get(frame%r(:, k))
      end do
      do k = 0, 3*source%reader%n_body + 2
         call tape%get(frame%a(:, modulo(k, 3) + 1, k/3))
      end do
      do k = 1, source%n_joint
         call tape%get(frame%f(:, k))
      end do
      do k = 1, source%n_joint
         call tape%get(frame%e(:, k))
      end do
      do k = 1, source%n_force
         call tape%get(frame%load(:, k))
      end do
   end subroutine load_frame

end module frames
