!> Beam in space: a massless, straight Timoshenko beam between a frame of body i and a frame of body j.
!>
!> Displacement, loads, energy and signs: `spatial_frame_spring`, with axes halfway between both ends (s = 1/2), x along the beam
!> from i to j, y and z along the principal axes of the section, and the free displacement u_0 = (L, 0, 0). There the stiffness
!> matrix of the beam is diagonal:
!>
!> K = diag( E A/L, 12 E I_z/(L^3 (1 + phi_y)), 12 E I_y/(L^3 (1 + phi_z)), G J/L, E I_y/L, E I_z/L ),   C = damping_time K
!> phi_y = 12 E I_z a_y/(G A L^2),   phi_z = 12 E I_y a_z/(G A L^2)
!>
!> E modulus, G shear modulus, A area, I second moments, J torsion constant, a ratios of area and shear area, L length. For small
!> displacements of the ends it is the matrix of 12 x 12 of the textbooks; rotations of the beam as a whole may be large.
!>
!> Source: J. S. Przemieniecki, Theory of matrix structural analysis (1968), section 5.6; BEAM in the manual of Adams/Solver, I
!> and J being j and i here. Limits: strains and the bending within a beam are small; take several beams where they are not; the
!> centroid is the shear centre; less than half a turn between the ends.
module spatial_beam
   use bodies, only: points_t
   use force_beam, only: dim_second_moment, shear_flexibility
   use item, only: item_t
   use joint_frames, only: find_frames
   use kind_info, only: add_direction, add_number, add_reference, dim_area, dim_length, dim_none, dim_pressure, dim_time, &
      in_space, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t, point_position
   use spatial_frame_spring, only: add_frame_spring_channels, frame_spring_t
   implicit none (type, external)
   private
   public :: spatial_beam_t

   !> What a beam is made of.
   type :: section_t
      real(wp) :: rigidity(4) = 0.0_wp    !! (4) E A, G J, E I_y, E I_z [N, N.m^2]
      real(wp) :: shear(2) = 0.0_wp       !! (2) 12 E I a/(G A) for bending along y and along z [m^2]
      real(wp) :: damping_time = 0.0_wp   !! C over K [s]
      logical :: is_open = .false.        !! the length follows from the start
   end type section_t

   !> All beams of a spatial scene.
   type, extends(frame_spring_t) :: spatial_beam_t
      real(wp), allocatable :: direction(:, :, :, :)   !! (3, 2, 2, n) axis and y of i and of j as in the deck; zero: omitted [1]
      type(section_t), allocatable :: section(:)       !! (n) rigidities, damping
   contains
      procedure, nopass :: info => beam_info
      procedure :: prepare => beam_prepare
      procedure :: set_start => beam_set_start
   end type spatial_beam_t

contains

   !> Description of the kind.
   function beam_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      character(1), parameter :: axis(2) = ["y", "z"]
      integer :: c

      info%name = "force.beam"
      info%space = in_space
      info%help = "massless elastic beam with shear and torsion between two bodies"
      info%source = "Przemieniecki (1968), section 5.6"
      info%counts_turns = .true.
      call add_reference(info, "i", "points", "end of the beam on the first body")
      call add_reference(info, "j", "points", "end of the beam on the second body")
      call add_number(info, "length", dim_length, "free length; default: the distance at the given initial positions", &
                      default="", lower=0.0_wp, open_lower=.true.)
      call add_direction(info, "axis_i", "axis of the beam at i, towards j, in the frame of its body; default: towards j at "// &
                         "the given positions", default="")
      call add_direction(info, "axis_j", "the same axis at j, in the frame of its body; default: parallel at the given "// &
                         "positions", default="")
      call add_direction(info, "y_i", "y axis of the section, in the frame of the body of i; default: the body axis after the "// &
                         "one nearest to the beam", default="")
      call add_direction(info, "y_j", "the same axis at j, in the frame of its body; default: parallel at the given positions", &
                         default="")
      call add_number(info, "modulus", dim_pressure, "Young's modulus E", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "shear_modulus", dim_pressure, "shear modulus G", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "area", dim_area, "area A of the section", lower=0.0_wp, open_lower=.true.)
      do c = 1, 2
         call add_number(info, "second_moment_"//axis(c), dim_second_moment, "second moment of the section, for bending about "// &
                         axis(c), lower=0.0_wp, open_lower=.true.)
      end do
      call add_number(info, "torsion_constant", dim_second_moment, "torsion constant J of the section", lower=0.0_wp, &
                      open_lower=.true.)
      do c = 1, 2
         call add_number(info, "shear_ratio_"//axis(c), dim_none, "area over shear area for shear along "//axis(c)// &
                         ": 6/5 rectangle, 10/9 circle; 0: rigid in shear", default="0", lower=0.0_wp)
      end do
      call add_number(info, "damping_time", dim_time, "time that times the stiffness matrix is the damping matrix", default="0 s", &
                      lower=0.0_wp)
      call add_frame_spring_channels(info, " at its middle")
   end function beam_info

   !> Make the set.
   subroutine beam_prepare(self, items, points)
      class(spatial_beam_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)          !! (n) rows of the table
      type(points_t), intent(in) :: points          !! all points

      integer :: k

      call self%make_storage(items, points)
      self%share = 0.5_wp
      allocate (self%direction(3, 2, 2, self%n), source=0.0_wp)
      allocate (self%section(self%n))
      do k = 1, self%n
         associate (item => items(k), of => self%section(k)%rigidity)
            self%section(k)%is_open = .not. item%is_given("length")
            self%free(1, k) = item%number("length")
            self%direction(:, :, 1, k) = reshape([item%direction("axis_i"), item%direction("y_i")], [3, 2])
            self%direction(:, :, 2, k) = reshape([item%direction("axis_j"), item%direction("y_j")], [3, 2])
            of = [item%number("modulus")*item%number("area"), item%number("shear_modulus")*item%number("torsion_constant"), &
                  item%number("modulus")*item%number("second_moment_y"), item%number("modulus")*item%number("second_moment_z")]
            self%section(k)%shear = [shear_flexibility(of(4), item%number("shear_ratio_y"), item%number("shear_modulus"), &
                                                  item%number("area")), &
                                shear_flexibility(of(3), item%number("shear_ratio_z"), item%number("shear_modulus"), &
                                                  item%number("area"))]
            self%section(k)%damping_time = item%number("damping_time")
         end associate
      end do
   end subroutine beam_prepare

   !> Length and frames that the deck omits, and the stiffness.
   subroutine beam_set_start(self, motion)
      class(spatial_beam_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion          !! bodies where the deck puts them

      real(wp) :: axis(3), d(3), k_diagonal(6)
      integer :: c, end, k

      do k = 1, self%n
         associate (i => self%body(1, k), j => self%body(2, k), l => self%free(1, k), of => self%section(k)%rigidity, &
                    direction => self%direction(:, :, :, k))
            d = point_position(motion, j, self%s(:, 2, k)) - point_position(motion, i, self%s(:, 1, k))
            if (self%section(k)%is_open) l = norm2(d)
            axis = direction(:, 1, 1)
            if (.not. any(abs(axis) > 0.0_wp)) axis = matmul(motion%spatial%own(:, :, i), matmul(d, motion%rot(:, :, i)))
            ! find_frames has the axis third: y, z, x
            call find_frames(motion, self%body(:, k), axis, direction(:, 1, 2), .not. any(abs(direction(:, 2, 2)) > 0.0_wp), &
                             self%frame(:, :, 1, k), self%frame(:, :, 2, k), direction(:, 2, :))
            do end = 1, 2
               self%frame(:, :, end, k) = self%frame(:, [3, 1, 2], end, k)
            end do
            k_diagonal(1:3) = [of(1)/l, 12.0_wp*of(4)/(l*(l**2 + self%section(k)%shear(1))), &
                               12.0_wp*of(3)/(l*(l**2 + self%section(k)%shear(2)))]
            k_diagonal(4:6) = of(2:4)/l
            do c = 1, 6
               self%stiffness(c, c, k) = k_diagonal(c)
               self%damping(c, c, k) = self%section(k)%damping_time*k_diagonal(c)
            end do
         end associate
      end do
      call self%follow(motion)
   end subroutine beam_set_start

end module spatial_beam
