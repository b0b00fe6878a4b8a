!> One picture of a motion: places of bodies, forces and eccentricities of clearance joints, loads; read from the catalogue, kept on
!> a archive.
module frame_values
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_clearances, group_forces
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use scene_poses, only: pose_reader_t
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: bind_source, frame_source_t, frame_t, load_frame, reads_source, save_frame, take_frame

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
   type :: frame_source_t
      type(pose_reader_t) :: reader         !! what is read of the catalogue
      integer :: eccentricity = 0           !! group of the catalogue
      integer :: n_joint = 0                !! joints with clearance
      integer :: force = 0                  !! group of the catalogue
      integer :: n_force = 0                !! force elements
   end type frame_source_t

contains

   !> Find the groups of the catalogue.
   subroutine bind_source(source, catalogue)
      type(frame_source_t), intent(out) :: source  !! where the numbers are
      type(catalogue_t), intent(in) :: catalogue   !! what can be recorded

      call source%reader%bind(catalogue)
      source%eccentricity = catalogue%find_group(group_clearances, "eccentricity")
      source%n_joint = size(catalogue%item_groups(group_clearances)%names)
      source%force = catalogue%find_group(group_forces, "force")
      source%n_force = size(catalogue%item_groups(group_forces)%names)
   end subroutine bind_source

   !> Whether a group of the catalogue is read.
   pure logical function reads_source(source, group)
      type(frame_source_t), intent(in) :: source  !! where the numbers are
      integer, intent(in) :: group                !! number of the group

      reads_source = source%reader%reads(group) .or. group == source%eccentricity .or. group == source%force
   end function reads_source

   !> The values of a picture.
   subroutine take_frame(source, t, catalogue, frame)
      type(frame_source_t), intent(in) :: source  !! where they are
      real(wp), intent(in) :: t                   !! time [s]
      type(catalogue_t), intent(in) :: catalogue  !! values at t
      type(frame_t), intent(inout) :: frame       !! the picture

      integer :: k

      frame%t = t
      if (.not. allocated(frame%r)) call make_storage(source, frame)
      call source%reader%frames(catalogue, frame%r, frame%a)
      do k = 1, source%n_joint
         frame%f(:, k) = vector_of(catalogue, source%reader%joint_force, k)
         frame%e(:, k) = vector_of(catalogue, source%eccentricity, k)
      end do
      do k = 1, source%n_force
         frame%load(:, k) = vector_of(catalogue, source%force, k)
      end do
   end subroutine take_frame

   !> Storage for a picture.
   subroutine make_storage(source, frame)
      type(frame_source_t), intent(in) :: source  !! how many numbers it has
      type(frame_t), intent(inout) :: frame       !! the picture

      allocate (frame%r(3, 0:source%reader%n_body), frame%a(3, 3, 0:source%reader%n_body))
      allocate (frame%f(3, source%n_joint), frame%e(3, source%n_joint), frame%load(3, source%n_force))
   end subroutine make_storage

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

   !> Write a picture.
   subroutine save_frame(frame, archive)
      type(frame_t), intent(in) :: frame   !! the picture
      type(archive_t), intent(inout) :: archive  !! receives it

      call archive%put(frame%t)
      call archive%put(reshape(frame%r, [size(frame%r)]))
      call archive%put(reshape(frame%a, [size(frame%a)]))
      call archive%put(reshape(frame%f, [size(frame%f)]))
      call archive%put(reshape(frame%e, [size(frame%e)]))
      call archive%put(reshape(frame%load, [size(frame%load)]))
   end subroutine save_frame

   !> Take back a picture.
   subroutine load_frame(source, archive, frame)
      type(frame_source_t), intent(in) :: source   !! how many numbers it has
      type(archive_t), intent(inout) :: archive          !! holds it
      type(frame_t), intent(out) :: frame          !! the picture

      integer :: k

      call make_storage(source, frame)
      call archive%get(frame%t)
      do k = 0, source%reader%n_body
         call archive%get(frame%r(:, k))
      end do
      do k = 0, 3*source%reader%n_body + 2
         call archive%get(frame%a(:, modulo(k, 3) + 1, k/3))
      end do
      do k = 1, source%n_joint
         call archive%get(frame%f(:, k))
      end do
      do k = 1, source%n_joint
         call archive%get(frame%e(:, k))
      end do
      do k = 1, source%n_force
         call archive%get(frame%load(:, k))
      end do
   end subroutine load_frame

end module frame_values
