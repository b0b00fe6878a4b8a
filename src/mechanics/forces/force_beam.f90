!> Beam in the plane: a massless, straight Timoshenko beam between a frame of body i and a frame of body j.
!>
!> Displacement, loads, energy and signs: `planar_frame_spring`, with axes halfway between both ends (s = 1/2), x along the beam
!> from i to j, and the free displacement u_0 = (L, 0). There the stiffness matrix of the beam is diagonal:
!>
!> K = diag( E A/L, 12 E I/(L^3 (1 + phi)), E I/L ),   phi = 12 E I a/(G A L^2),   C = damping_time K
!>
!> E modulus, G shear modulus, A area, I second moment, a ratio of area and shear area, L length. For small displacements of the
!> ends it is the matrix of 6 x 6 of the textbooks; rotations of the beam as a whole may be large.
!>
!> Source: J. S. Przemieniecki, Theory of matrix structural analysis (1968), section 5.6; BEAM in the manual of Adams/Solver, I
!> and J being j and i here. Limits: strains and the bending within a beam are small; take several beams where they are not.
module force_beam
   use bodies, only: points_t
   use item, only: item_t, place_of
   use kind_info, only: add_number, add_reference, dim_angle, dim_area, dim_length, dim_none, dim_pressure, dim_t, dim_time, &
      in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t, point_position
   use planar_frame_spring, only: add_frame_spring_channels, frame_spring_t
   implicit none (type, external)
   private
   public :: dim_second_moment, force_beam_t, shear_flexibility

   type(dim_t), parameter :: dim_second_moment = dim_t(m=4)   !! second moment of an area

   !> All beams of a planar scene.
   type, extends(frame_spring_t) :: force_beam_t
      real(wp), allocatable :: rigidity(:, :)    !! (3, n) E A, E I and 12 E I a/(G A) [N, N.m^2, m^2]
      real(wp), allocatable :: damping_time(:)   !! (n) C over K [s]
      logical, allocatable :: is_open(:, :)      !! (3, n) length, angles of i and j follow from the start
   contains
      procedure, nopass :: info => beam_info
      procedure, nopass :: mistake => beam_mistake
      procedure :: prepare => beam_prepare
      procedure :: set_start => beam_set_start
      procedure, private :: set_stiffness
   end type force_beam_t

contains

   !> Description of the kind.
   function beam_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.beam"
      info%space = in_plane
      info%help = "massless elastic beam with shear between two bodies"
      info%source = "Przemieniecki (1968), section 5.6"
      call add_reference(info, "i", "points", "end of the beam on the first body")
      call add_reference(info, "j", "points", "end of the beam on the second body")
      call add_number(info, "length", dim_length, "free length; default: the distance at the given initial positions", &
                      default="", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "angle_i", dim_angle, "direction of the beam at i in the frame of its body; default: towards j at "// &
                      "the given positions", default="")
      call add_number(info, "angle_j", dim_angle, "direction of the beam at j in the frame of its body; default: that at i at "// &
                      "the given positions", default="")
      call add_number(info, "modulus", dim_pressure, "Young's modulus E", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "area", dim_area, "area A of the section", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "second_moment", dim_second_moment, "second moment I of the section, for bending in the plane", &
                      lower=0.0_wp, open_lower=.true.)
      call add_number(info, "shear_modulus", dim_pressure, "shear modulus G, needed with a shear ratio", default="0 Pa", &
                      lower=0.0_wp)
      call add_number(info, "shear_ratio", dim_none, "area over shear area: 6/5 rectangle, 10/9 circle; 0: rigid in shear", &
                      default="0", lower=0.0_wp)
      call add_number(info, "damping_time", dim_time, "time that times the stiffness matrix is the damping matrix", default="0 s", &
                      lower=0.0_wp)
      call add_frame_spring_channels(info, " at its middle")
   end function beam_info

   !> Shear needs a shear modulus.
   subroutine beam_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = ""
      help = ""
      if (.not. item%number("shear_ratio") > 0.0_wp .or. item%number("shear_modulus") > 0.0_wp) return
      column = place_of(item, "shear_ratio")
      message = "beam '"//item%name//"' has a shear ratio but no shear modulus"
      help = "give the column shear_modulus, or omit shear_ratio"
   end subroutine beam_mistake

   !> 12 E I a/(G A): over the square of a length, flexibility in shear over that in bending; zero of a beam rigid in shear.
   pure real(wp) function shear_flexibility(bending, ratio, shear_modulus, area) result(flexibility)
      real(wp), intent(in) :: bending        !! E I [N.m^2]
      real(wp), intent(in) :: ratio          !! a [1]
      real(wp), intent(in) :: shear_modulus  !! G [Pa]
      real(wp), intent(in) :: area           !! A [m^2]

      flexibility = 0.0_wp
      if (ratio > 0.0_wp) flexibility = 12.0_wp*bending*ratio/(shear_modulus*area)
   end function shear_flexibility

   !> Make the set.
   subroutine beam_prepare(self, items, points)
      class(force_beam_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)        !! (n) rows of the table
      type(points_t), intent(in) :: points        !! all points

      real(wp) :: bending
      integer :: k

      call self%make_storage(items, points)
      self%share = 0.5_wp
      allocate (self%rigidity(3, self%n), self%damping_time(self%n), source=0.0_wp)
      allocate (self%is_open(3, self%n))
      do k = 1, self%n
         associate (item => items(k))
            self%is_open(:, k) = .not. [item%is_given("length"), item%is_given("angle_i"), item%is_given("angle_j")]
            self%free(1, k) = item%number("length")
            self%offset(:, k) = [item%number("angle_i"), item%number("angle_j")]
            bending = item%number("modulus")*item%number("second_moment")
            self%rigidity(:, k) = [item%number("modulus")*item%number("area"), bending, shear_flexibility(bending, &
                                   item%number("shear_ratio"), item%number("shear_modulus"), item%number("area"))]
            self%damping_time(k) = item%number("damping_time")
         end associate
         if (.not. self%is_open(1, k)) call self%set_stiffness(k)
      end do
   end subroutine beam_prepare

   !> Length and directions that the deck omits.
   subroutine beam_set_start(self, motion)
      class(force_beam_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion        !! bodies where the deck puts them

      real(wp) :: d(3)
      integer :: k

      do k = 1, self%n
         associate (i => self%body(1, k), j => self%body(2, k))
            d = point_position(motion, j, self%s(:, 2, k)) - point_position(motion, i, self%s(:, 1, k))
            if (self%is_open(1, k)) self%free(1, k) = norm2(d)
            if (self%is_open(2, k)) self%offset(1, k) = atan2(d(2), d(1)) - motion%angle(i)
            if (self%is_open(3, k)) self%offset(2, k) = self%offset(1, k) + motion%angle(i) - motion%angle(j)
         end associate
         call self%set_stiffness(k)
      end do
   end subroutine beam_set_start

   !> Stiffness and damping of an item whose length is known.
   pure subroutine set_stiffness(self, k)
      class(force_beam_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                    !! item

      associate (l => self%free(1, k), of => self%rigidity(:, k))
         self%stiffness(1, 1, k) = of(1)/l
         self%stiffness(2, 2, k) = 12.0_wp*of(2)/(l*(l**2 + of(3)))
         self%stiffness(3, 3, k) = of(2)/l
      end associate
      self%damping(:, :, k) = self%damping_time(k)*self%stiffness(:, :, k)
   end subroutine set_stiffness

end module force_beam
