!> Bushing in space: stiffness and damping along and about three axes of body i, between a frame of i and one of j.
!>
!> Displacement, loads, energy and signs: `spatial_frame_spring`, with the axes of i (s = 0) and no free displacement. z is axis_i,
!> x is x_i, the same in j; where these coincide the bushing is not turned. K has the stiffnesses on its diagonal; couplings are
!> above it and mirrored below; C = diag(dampings) + damping_time K. For small rotations psi are the angles about the axes of i, as
!> in BUSHING; a rotation about one axis alone is the angle about it, up to half a turn. What Adams adds for large rotations about
!> several axes differs: there is no potential energy in it, here there is.
!>
!> Source: the public description of BUSHING in the manual of Adams/Solver, I and J being j and i here; FIELD for the full matrix.
!> Limits: less than half a turn.
module spatial_bushing
   use bodies, only: points_t
   use coupled_stiffness, only: find_negative_energy
   use item, only: item_t, place_of
   use joint_frames, only: add_zero_columns, find_frames, from_start
   use kind_info, only: add_direction, add_list, add_number, add_reference, dim_angular_damping, dim_angular_stiffness, &
      dim_damping, dim_force, dim_moment, dim_stiffness, dim_t, dim_time, in_space, kind_info_t, same_dimension
   use kinds, only: wp
   use motion, only: motion_t
   use spatial_frame_spring, only: add_frame_spring_channels, frame_spring_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: spatial_bushing_t

   type(dim_t), parameter :: dim_coupling = dim_t(kg=1, m=1, s=-2, rad=-1)  !! force over angle
   character(1), parameter :: axis_name(3) = ["x", "y", "z"]                !! axes
   character(*), parameter :: couplings = "coupling angular_coupling cross_coupling"  !! columns of the full matrix

   !> All bushings of a spatial scene.
   type, extends(frame_spring_t) :: spatial_bushing_t
      real(wp), allocatable :: direction(:, :, :, :)   !! (3, 2, 2, n) axis and x of i and of j as in the deck; zero: omitted [1]
      logical, allocatable :: from_start(:)            !! (n) not turned where the deck puts the bodies
   contains
      procedure, nopass :: info => bushing_info
      procedure, nopass :: mistake => bushing_mistake
      procedure :: prepare => bushing_prepare
      procedure :: set_start => bushing_set_start
   end type spatial_bushing_t

contains

   !> Description of the kind.
   function bushing_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      integer :: c

      info%name = "force.bushing"
      info%space = in_space
      info%help = "elastic bushing: stiffness and damping along and about three axes of body i"
      info%source = "Adams/Solver, BUSHING"
      info%counts_turns = .true.
      call add_reference(info, "i", "points", "point of the first body, whose axes count")
      call add_reference(info, "j", "points", "point of the second body")
      call add_direction(info, "axis_i", "z axis of the bushing, in the frame of the body of i", default='"0 0 1"')
      call add_direction(info, "axis_j", "the same of j, in the frame of its body; default: parallel at the given positions", &
                         default="")
      call add_zero_columns(info)
      do c = 1, 3
         call add_number(info, "stiffness_"//axis_name(c), dim_stiffness, "stiffness along "//axis_name(c), default="0 N/m", &
                         lower=0.0_wp)
      end do
      do c = 1, 3
         call add_number(info, "angular_stiffness_"//axis_name(c), dim_angular_stiffness, "stiffness about "//axis_name(c), &
                         default="0 N.m/rad", lower=0.0_wp)
      end do
      do c = 1, 3
         call add_number(info, "damping_"//axis_name(c), dim_damping, "damping along "//axis_name(c), default="0 N.s/m", &
                         lower=0.0_wp)
      end do
      do c = 1, 3
         call add_number(info, "angular_damping_"//axis_name(c), dim_angular_damping, "damping about "//axis_name(c), &
                         default="0 N.m.s/rad", lower=0.0_wp)
      end do
      call add_number(info, "damping_time", dim_time, "time that times the stiffness matrix is added to the damping", &
                      default="0 s", lower=0.0_wp)
      do c = 1, 3
         call add_number(info, "preload_"//axis_name(c), dim_force, "force on the body of i along "//axis_name(c)// &
                         " at zero displacement", default="0 N")
      end do
      do c = 1, 3
         call add_number(info, "preload_moment_"//axis_name(c), dim_moment, "moment on the body of i about "//axis_name(c)// &
                         " at zero displacement", default="0 N.m")
      end do
      call add_list(info, "coupling", "stiffness couplings xy, xz, yz of displacements, in N/m", default="")
      call add_list(info, "angular_coupling", "stiffness couplings xy, xz, yz of rotations, in N.m/rad", default="")
      call add_list(info, "cross_coupling", "stiffness couplings in N/rad: forces x, then y, then z, each over rotations x y z", &
                    default="")
      call add_frame_spring_channels(info, "")
   end function bushing_info

   !> Numbers of a list; zero where it is omitted or has another count.
   pure function list_of(item, name, n) result(numbers)
      type(item_t), intent(in) :: item   !! the row
      character(*), intent(in) :: name   !! column
      integer, intent(in) :: n           !! how many
      real(wp) :: numbers(n)             !! (n) SI [any]

      numbers = 0.0_wp
      associate (value => item%values(place_of(item, name)))
         if (.not. allocated(value%table)) return
         if (size(value%table) == n) numbers = value%table(:, 1)
      end associate
   end function list_of

   !> Stiffness of a row.
   pure function stiffness_of(item) result(stiffness)
      type(item_t), intent(in) :: item   !! the row
      real(wp) :: stiffness(6, 6)        !! (6, 6) K [N/m, N/rad or N.m/rad]

      integer, parameter :: pair(2, 3) = reshape([1, 2, 1, 3, 2, 3], [2, 3])
      real(wp) :: angular(3), linear(3)
      integer :: c

      stiffness = 0.0_wp
      linear = list_of(item, "coupling", 3)
      angular = list_of(item, "angular_coupling", 3)
      stiffness(1:3, 4:6) = transpose(reshape(list_of(item, "cross_coupling", 9), [3, 3]))
      stiffness(4:6, 1:3) = transpose(stiffness(1:3, 4:6))
      do c = 1, 3
         stiffness(c, c) = item%number("stiffness_"//axis_name(c))
         stiffness(c + 3, c + 3) = item%number("angular_stiffness_"//axis_name(c))
         stiffness(pair(1, c), pair(2, c)) = linear(c)
         stiffness(pair(2, c), pair(1, c)) = linear(c)
         stiffness(pair(1, c) + 3, pair(2, c) + 3) = angular(c)
         stiffness(pair(2, c) + 3, pair(1, c) + 3) = angular(c)
      end do
   end function stiffness_of

   !> Lists of couplings have their counts and units, and give no energy away.
   subroutine bushing_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      call check_list("coupling", 3, dim_stiffness, "N/m")
      if (column == 0) call check_list("angular_coupling", 3, dim_angular_stiffness, "N.m/rad")
      if (column == 0) call check_list("cross_coupling", 9, dim_coupling, "N/rad")
      if (column == 0) call find_negative_energy(item, stiffness_of(item), couplings, column, message, help)

   contains

      !> One list.
      subroutine check_list(name, n, dimension, unit)
         character(*), intent(in) :: name           !! column
         integer, intent(in) :: n                   !! how many numbers
         type(dim_t), intent(in) :: dimension       !! of them
         character(*), intent(in) :: unit           !! as text

         column = 0
         message = ""
         help = ""
         if (.not. item%is_given(name)) return
         associate (value => item%values(place_of(item, name)))
            if (.not. allocated(value%table)) return
            if (size(value%table) == n .and. same_dimension(value%dimensions(1), dimension)) return
         end associate
         column = place_of(item, name)
         message = "column "//name//" of '"//item%name//"' is not "//to_text(n)//" numbers in "//unit
         help = "write "//to_text(n)//" numbers and a unit in quotes, as ""1 0 0 ... "//unit//""""
      end subroutine check_list

   end subroutine bushing_mistake

   !> Make the set.
   subroutine bushing_prepare(self, items, points)
      class(spatial_bushing_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table
      type(points_t), intent(in) :: points             !! all points

      integer :: c, k

      call self%make_storage(items, points)
      allocate (self%direction(3, 2, 2, self%n), source=0.0_wp)
      allocate (self%from_start(self%n))
      do k = 1, self%n
         associate (item => items(k))
            self%direction(:, :, 1, k) = reshape([item%direction("axis_i"), item%direction("x_i")], [3, 2])
            self%direction(:, :, 2, k) = reshape([item%direction("axis_j"), item%direction("x_j")], [3, 2])
            self%from_start(k) = item%word("zero") == from_start
            self%stiffness(:, :, k) = stiffness_of(item)
            self%damping(:, :, k) = item%number("damping_time")*self%stiffness(:, :, k)
            do c = 1, 3
               self%damping(c, c, k) = self%damping(c, c, k) + item%number("damping_"//axis_name(c))
               self%damping(c + 3, c + 3, k) = self%damping(c + 3, c + 3, k) + item%number("angular_damping_"//axis_name(c))
               self%preload(c, k) = item%number("preload_"//axis_name(c))
               self%preload(c + 3, k) = item%number("preload_moment_"//axis_name(c))
            end do
         end associate
      end do
   end subroutine bushing_prepare

   !> Frames, and the rotations that the deck puts the bodies at.
   subroutine bushing_set_start(self, motion)
      class(spatial_bushing_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion             !! bodies where the deck puts them

      integer :: k

      do k = 1, self%n
         call find_frames(motion, self%body(:, k), self%direction(:, 1, 1, k), self%direction(:, 1, 2, k), self%from_start(k), &
                          self%frame(:, :, 1, k), self%frame(:, :, 2, k), self%direction(:, 2, :, k))
      end do
      call self%follow(motion)
   end subroutine bushing_set_start

end module spatial_bushing
