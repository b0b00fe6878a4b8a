!> Pictures of a motion at some instants, kept while it goes on: places of bodies, forces and eccentricities of loose joints, loads,
!> paths.
!>
!> A picture is that of the output instant nearest to the time asked for. A path has a place for each row of the window, and is
!> thinned as it grows: memory does not grow with the run. Where two rows of a loose joint become one, the greater force stays.
module frames
   use catalogue, only: catalogue_t
   use catalogue_rooms, only: room_clearances, room_forces
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use scene_poses, only: pose_reader_t
   use tape, only: tape_t
   implicit none (type, external)
   private
   public :: frame_keeper_t, frame_plan_t, frame_t, track_t, wanted_frames_t

   integer, parameter :: longest_track = 4000  !! rows of a path

   !> Instants that one figure wants.
   type :: wanted_frames_t
      character(:), allocatable :: name     !! of the figure
      real(wp), allocatable :: times(:)     !! (n) increasing [s]
      real(wp) :: from = 0.0_wp             !! beginning of its window [s]
      real(wp) :: to = -1.0_wp              !! its end; before the beginning: it has no paths [s]
      integer :: body = -1                  !! of a point whose path is followed: its body; -1: there is none
      real(wp) :: s(3) = 0.0_wp             !! (3) the point, in the body's own frame [m]
   end type wanted_frames_t

   !> What all figures want.
   type :: frame_plan_t
      type(wanted_frames_t), allocatable :: wanted(:)  !! (figures) what each wants
      real(wp) :: every = 0.0_wp                       !! output interval [s]
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

   !> What is followed from row to row.
   type :: track_t
      integer :: n = 0                      !! rows
      integer :: skipped = 0                !! rows since the last
      integer :: stride = 1                 !! rows that become one
      real(wp), allocatable :: t(:)         !! (n or more) times [s]
      real(wp), allocatable :: x(:, :)      !! (3, n or more) the point, world frame [m]
      real(wp), allocatable :: e(:, :, :)   !! (3, joints, n or more) eccentricities, world frame [m]
      real(wp), allocatable :: f(:, :)      !! (joints, n or more) magnitudes of forces [N]
   end type track_t

   !> Keeps them.
   type :: frame_keeper_t
      type(frame_plan_t) :: plan                          !! what is wanted
      type(pose_reader_t) :: reader                       !! what is read of the catalogue
      type(frame_t), allocatable :: frames(:, :)          !! (most times, figures) pictures
      integer, allocatable :: n(:)                        !! (figures) how many there are of each
      type(track_t), allocatable :: tracks(:)             !! (figures) paths
      integer, private :: eccentricity = 0                !! group of the catalogue
      integer, private :: n_joint = 0                     !! joints with clearance
      integer, private :: force = 0                       !! group of the catalogue
      integer, private :: n_force = 0                     !! force elements
      logical :: is_wanted = .false.                      !! there are figures that want something
   contains
      procedure :: start
      procedure :: reads
      procedure :: sample
      procedure :: follow
      procedure :: save => save_frames
      procedure :: load => load_frames
   end type frame_keeper_t

contains

   !> Begin with nothing.
   subroutine start(self, plan, catalogue)
      class(frame_keeper_t), intent(out) :: self  !! the keeper
      type(frame_plan_t), intent(in) :: plan      !! what is wanted
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded

      integer :: k, n

      self%plan = plan
      if (.not. allocated(self%plan%wanted)) allocate (self%plan%wanted(0))
      n = size(self%plan%wanted)
      allocate (self%n(n), source=0)
      self%is_wanted = n > 0
      allocate (self%tracks(n))
      allocate (self%frames(max(0, maxval([(size(self%plan%wanted(k)%times), k=1, n)])), n))
      if (.not. self%is_wanted) return
      call self%reader%bind(catalogue)
      self%eccentricity = catalogue%find_group(room_clearances, "eccentricity")
      self%n_joint = size(catalogue%rooms(room_clearances)%names)
      self%force = catalogue%find_group(room_forces, "force")
      self%n_force = size(catalogue%rooms(room_forces)%names)
   end subroutine start

   !> Whether a group of the catalogue is read.
   pure logical function reads(self, group)
      class(frame_keeper_t), intent(in) :: self  !! the keeper
      integer, intent(in) :: group               !! number of the group

      reads = self%is_wanted
      if (reads) reads = self%reader%reads(group) .or. group == self%eccentricity .or. group == self%force
   end function reads

   !> An output instant.
   subroutine sample(self, t, catalogue)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper
      real(wp), intent(in) :: t                     !! time [s]
      type(catalogue_t), intent(in) :: catalogue    !! values at t

      integer :: k

      do k = 1, size(self%n)
         do while (self%n(k) < size(self%plan%wanted(k)%times))
            if (t < self%plan%wanted(k)%times(self%n(k) + 1) - 0.5_wp*self%plan%every) exit
            self%n(k) = self%n(k) + 1
            call take_frame(self, t, catalogue, self%frames(self%n(k), k))
         end do
      end do
      call self%follow(t, catalogue)
   end subroutine sample

   !> The values of a picture.
   subroutine take_frame(self, t, catalogue, frame)
      type(frame_keeper_t), intent(in) :: self    !! the keeper
      real(wp), intent(in) :: t                   !! time [s]
      type(catalogue_t), intent(in) :: catalogue  !! values at t
      type(frame_t), intent(out) :: frame         !! the picture

      integer :: k

      frame%t = t
      allocate (frame%r(3, 0:self%reader%n_body), frame%a(3, 3, 0:self%reader%n_body))
      allocate (frame%f(3, self%n_joint), frame%e(3, self%n_joint), frame%load(3, self%n_force))
      call self%reader%frames(catalogue, frame%r, frame%a)
      do k = 1, self%n_joint
         frame%f(:, k) = vector_of(catalogue, self%reader%joint_force, k)
         frame%e(:, k) = vector_of(catalogue, self%eccentricity, k)
      end do
      do k = 1, self%n_force
         frame%load(:, k) = vector_of(catalogue, self%force, k)
      end do
   end subroutine take_frame

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

   !> A row of any kind: paths go on.
   subroutine follow(self, t, catalogue)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper
      real(wp), intent(in) :: t                     !! time [s]
      type(catalogue_t), intent(in) :: catalogue    !! values at t

      real(wp) :: a(3, 3, 0:self%reader%n_body), e(3, self%n_joint), f(self%n_joint), r(3, 0:self%reader%n_body), x(3)
      integer :: i, k

      if (.not. self%is_wanted) return
      if (.not. any([(t >= self%plan%wanted(k)%from - 0.5_wp*self%plan%every .and. t <= self%plan%wanted(k)%to, &
                      k=1, size(self%n))])) return
      call self%reader%frames(catalogue, r, a)
      do i = 1, self%n_joint
         e(:, i) = vector_of(catalogue, self%eccentricity, i)
         f(i) = norm2(vector_of(catalogue, self%reader%joint_force, i))
      end do
      do k = 1, size(self%n)
         associate (this => self%plan%wanted(k))
            if (t < this%from - 0.5_wp*self%plan%every .or. t > this%to) cycle
            x = 0.0_wp
            if (this%body >= 0) x = r(:, this%body) + matmul(a(:, :, this%body), this%s)
            call add_row(self%tracks(k), t, x, e, f)
         end associate
      end do
   end subroutine follow

   !> Room for a path.
   subroutine new_track(n_joint, track)
      integer, intent(in) :: n_joint          !! joints with clearance
      type(track_t), intent(inout) :: track   !! the path

      allocate (track%t(longest_track), track%x(3, longest_track), track%e(3, n_joint, longest_track))
      allocate (track%f(n_joint, longest_track))
   end subroutine new_track

   !> Append a row to a path, or join it to the last.
   subroutine add_row(track, t, x, e, f)
      type(track_t), intent(inout) :: track   !! the path
      real(wp), intent(in) :: t               !! time [s]
      real(wp), intent(in) :: x(3)            !! (3) the point [m]
      real(wp), intent(in) :: e(:, :)         !! (3, joints) eccentricities [m]
      real(wp), intent(in) :: f(:)            !! (joints) magnitudes of forces [N]

      integer :: k

      if (.not. allocated(track%t)) call new_track(size(f), track)
      if (track%n > 0 .and. track%skipped < track%stride - 1) then
         track%skipped = track%skipped + 1
         track%f(:, track%n) = max(track%f(:, track%n), f)
         return
      end if
      if (track%n == longest_track) then
         do k = 1, longest_track/2
            track%t(k) = track%t(2*k - 1)
            track%x(:, k) = track%x(:, 2*k - 1)
            track%e(:, :, k) = track%e(:, :, 2*k - 1)
            track%f(:, k) = max(track%f(:, 2*k - 1), track%f(:, 2*k))
         end do
         track%n = longest_track/2
         track%stride = 2*track%stride
      end if
      track%skipped = 0
      track%n = track%n + 1
      track%t(track%n) = t
      track%x(:, track%n) = x
      track%e(:, :, track%n) = e
      track%f(:, track%n) = f
   end subroutine add_row

   !> Write the pictures and paths so far.
   subroutine save_frames(self, tape)
      class(frame_keeper_t), intent(in) :: self  !! the keeper
      type(tape_t), intent(inout) :: tape        !! receives them

      integer :: i, k

      do k = 1, size(self%n)
         call tape%put(self%n(k))
         do i = 1, self%n(k)
            associate (frame => self%frames(i, k))
               call tape%put(frame%t)
               call tape%put(reshape(frame%r, [size(frame%r)]))
               call tape%put(reshape(frame%a, [size(frame%a)]))
               call tape%put(reshape(frame%f, [size(frame%f)]))
               call tape%put(reshape(frame%e, [size(frame%e)]))
               call tape%put(reshape(frame%load, [size(frame%load)]))
            end associate
         end do
         associate (track => self%tracks(k))
            call tape%put([track%n, track%skipped, track%stride])
            do i = 1, track%n
               call tape%put([track%t(i), track%x(:, i), reshape(track%e(:, :, i), [3*self%n_joint]), track%f(:, i)])
            end do
         end associate
      end do
   end subroutine save_frames

   !> Take them back.
   subroutine load_frames(self, tape)
      class(frame_keeper_t), intent(inout) :: self  !! the keeper, started
      type(tape_t), intent(inout) :: tape           !! holds them

      integer :: i, k

      do k = 1, size(self%n)
         call tape%get(self%n(k))
         do i = 1, self%n(k)
            call load_frame(self, tape, self%frames(i, k))
         end do
         associate (track => self%tracks(k))
            call tape%get(track%n)
            call tape%get(track%skipped)
            call tape%get(track%stride)
            if (track%n > 0 .and. .not. allocated(track%t)) call new_track(self%n_joint, track)
            do i = 1, track%n
               call load_row(tape, i, track)
            end do
         end associate
      end do
   end subroutine load_frames

   !> Take back a picture.
   subroutine load_frame(self, tape, frame)
      type(frame_keeper_t), intent(in) :: self     !! the keeper
      type(tape_t), intent(inout) :: tape          !! holds it
      type(frame_t), intent(out) :: frame          !! the picture

      integer :: k

      allocate (frame%r(3, 0:self%reader%n_body), frame%a(3, 3, 0:self%reader%n_body))
      allocate (frame%f(3, self%n_joint), frame%e(3, self%n_joint), frame%load(3, self%n_force))
      call tape%get(frame%t)
      do k = 0, self%reader%n_body
         call tape%get(frame%r(:, k))
      end do
      do k = 0, 3*self%reader%n_body + 2
         call tape%get(frame%a(:, modulo(k, 3) + 1, k/3))
      end do
      do k = 1, self%n_joint
         call tape%get(frame%f(:, k))
      end do
      do k = 1, self%n_joint
         call tape%get(frame%e(:, k))
      end do
      do k = 1, self%n_force
         call tape%get(frame%load(:, k))
      end do
   end subroutine load_frame

   !> Take back a row of a path.
   subroutine load_row(tape, i, track)
      type(tape_t), intent(inout) :: tape     !! holds it
      integer, intent(in) :: i                !! its number
      type(track_t), intent(inout) :: track   !! the path

      integer :: k

      call tape%get(track%t(i))
      call tape%get(track%x(:, i))
      do k = 1, size(track%e, 2)
         call tape%get(track%e(:, k, i))
      end do
      call tape%get(track%f(:, i))
   end subroutine load_row

end module frames
