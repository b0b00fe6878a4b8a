!> Values of a deck that are possible but unusual, most often a slip of units: notes for a careful reader, never errors.
!>
!> A body: its radius of gyration sqrt(I/m) over the distance of its farthest point, shape or contact surface from its centre of
!> mass; its density where solid shapes are given; a mass or the distance of a point far from all others. Gravity that is none of
!> those of Earth, Mars and Moon. A joint with clearance: clearance over radius; a contact stiffness far from that of Hertz for the
!> materials; a lubricant's viscosity. The assembly: a body that it moved far.
!>
!> Sources: none, limits are those of common machines. Limits: they are wide, so that a note is seldom wrong.
module plausibility
   use assembly_report, only: assembly_t
   use clearance_set, only: clearance_set_t
   use item, only: item_t, place_of
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use mechanism, only: mechanism_t
   use scene, only: scene_t, table_lubricants, table_shapes
   use scene_size, only: extent_of_scene
   use surfaces, only: shape_external, shape_internal, shape_plane, surfaces_t
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: find_notes

   real(wp), parameter :: gyration(2) = [0.05_wp, 10.0_wp]           !! usual radius of gyration over farthest point [1]
   real(wp), parameter :: density(2) = [100.0_wp, 23000.0_wp]        !! usual density: of foams and of tungsten [kg/m^3]
   real(wp), parameter :: spread_of_masses = 1.0e5_wp                !! usual ratio of a mass to the median, at most [1]
   real(wp), parameter :: spread_of_lengths = 300.0_wp               !! the same of distances of points [1]
   real(wp), parameter :: known_gravity(4) = [0.0_wp, 1.62_wp, 3.71_wp, 9.81_wp]  !! none, Moon, Mars, Earth [m/s^2]
   real(wp), parameter :: near_gravity = 0.03_wp                     !! part that known values may be off by [1]
   real(wp), parameter :: clearance_ratio(2) = [1.0e-5_wp, 0.1_wp]   !! usual clearance over radius of journals and balls [1]
   real(wp), parameter :: stiffness_ratio = 100.0_wp                 !! usual contact stiffness over that of Hertz, or inverse [1]
   real(wp), parameter :: viscosity(2) = [1.0e-5_wp, 20.0_wp]        !! usual viscosity: of air and of heavy gear oil, cold [Pa.s]
   real(wp), parameter :: moved_far = 0.05_wp                        !! displacement by assembly, of the mechanism's size [1]
   real(wp), parameter :: turned_far = 5.0_wp*pi/180.0_wp            !! rotation by assembly [rad]
   integer, parameter :: few = 3                                     !! values from which a median means something

contains

   !> All notes, one line each, with the value and what is usual.
   subroutine find_notes(scene, system, assembly, notes)
      type(scene_t), intent(in) :: scene                     !! the scene
      type(mechanism_t), intent(in) :: system                !! its system
      type(assembly_t), intent(in) :: assembly               !! how the start was found
      type(text_t), allocatable, intent(out) :: notes(:)     !! (any) the lines

      allocate (notes(0))
      call look_at_assembly(scene, assembly, notes)
      call look_at_gravity(scene, notes)
      call look_at_bodies(scene, system, notes)
      call look_at_lengths(scene, notes)
      call look_at_joints(scene, system, notes)
      call look_at_lubricants(scene, notes)
   end subroutine find_notes

   !> Bodies that assembly has moved or turned far.
   subroutine look_at_assembly(scene, assembly, notes)
      type(scene_t), intent(in) :: scene                       !! the scene
      type(assembly_t), intent(in) :: assembly                 !! how the start was found
      type(text_t), allocatable, intent(inout) :: notes(:)     !! (any) grown

      real(wp) :: extent

      extent = extent_of_scene(scene)
      if (assembly%shift%body > 0 .and. assembly%shift%value > moved_far*extent .and. extent > 0.0_wp) then
         call append_text(notes, "assembly moved body '"//scene%bodies%names(assembly%shift%body)%s//"' by "// &
                          real_text(1.0e3_wp*assembly%shift%value, 3)//" mm, "// &
                          real_text(100.0_wp*assembly%shift%value/extent, 2)//" % of the size of the mechanism: check its "// &
                          "initial position, or points of its joints")
      end if
      if (assembly%turn%body > 0 .and. assembly%turn%value > turned_far) then
         call append_text(notes, "assembly rotated body '"//scene%bodies%names(assembly%turn%body)%s//"' by "// &
                          real_text(assembly%turn%value*180.0_wp/pi, 3)//" deg: check its initial angle, or points and "// &
                          "axes of its joints")
      end if
   end subroutine look_at_assembly

   !> Gravity that is none of the known ones.
   subroutine look_at_gravity(scene, notes)
      type(scene_t), intent(in) :: scene                       !! the scene
      type(text_t), allocatable, intent(inout) :: notes(:)     !! (any) grown

      associate (g => norm2(scene%gravity))
         if (any(abs(g - known_gravity) <= near_gravity*known_gravity)) return
         call append_text(notes, "gravity is "//real_text(g, 4)//" m/s^2; usual: 9.81 (Earth), 3.71 (Mars), 1.62 (Moon), 0")
      end associate
   end subroutine look_at_gravity

   !> Radius of gyration, density, and masses far from the others.
   subroutine look_at_bodies(scene, system, notes)
      type(scene_t), intent(in) :: scene                       !! the scene
      type(mechanism_t), intent(in) :: system                  !! its system
      type(text_t), allocatable, intent(inout) :: notes(:)     !! (any) grown

      real(wp), dimension(scene%bodies%n) :: reach, volume
      real(wp) :: middle, ratio
      integer :: k

      call find_reach(scene, system, reach, volume)
      middle = median(scene%bodies%mass)
      do k = 1, scene%bodies%n
         associate (name => scene%bodies%names(k)%s, mass => scene%bodies%mass(k), inertia => scene%bodies%inertia(k))
            if (reach(k) > 0.0_wp) then
               ratio = sqrt(inertia/mass)/reach(k)
               if (ratio < gyration(1) .or. ratio > gyration(2)) then
                  call append_text(notes, "body '"//name//"': its mass and moment of inertia give a radius of gyration of "// &
                                   real_text(1.0e3_wp*sqrt(inertia/mass), 3)//" mm, "//real_text(ratio, 2)// &
                                   " times the distance of its farthest point from its centre of mass ("// &
                                   real_text(1.0e3_wp*reach(k), 3)//" mm); usual: 0.3 to 2 times; check units")
               end if
            end if
            if (volume(k) > 0.0_wp) then
               if (mass/volume(k) < density(1) .or. mass/volume(k) > density(2)) then
                  call append_text(notes, "body '"//name//"': its mass over the volume of its shapes is "// &
                                   real_text(mass/volume(k), 3)//" kg/m^3; usual: 1000 (plastics) to 8000 (steel)")
               end if
            end if
            if (scene%bodies%n < few .or. mass <= spread_of_masses*middle .and. middle <= spread_of_masses*mass) cycle
            call append_text(notes, "body '"//name//"' has a mass of "//real_text(mass, 3)//" kg, "//real_text(mass/middle, 2)// &
                             " times the median of all bodies ("//real_text(middle, 3)//" kg): check units")
         end associate
      end do
   end subroutine look_at_bodies

   !> Distance of what belongs to a body from its centre of mass, and volume of its solid shapes.
   subroutine find_reach(scene, system, reach, volume)
      type(scene_t), intent(in) :: scene           !! the scene
      type(mechanism_t), intent(in) :: system      !! its system
      real(wp), intent(out) :: reach(:)            !! (bodies) the farthest point, shape or surface [m]
      real(wp), intent(out) :: volume(:)           !! (bodies) of the shapes; 0: none has a volume [m^3]

      integer :: i, k

      reach = 0.0_wp
      volume = 0.0_wp
      do k = 1, scene%points%n
         call extend(scene%points%body(k), norm2(scene%points%s(:, k)))
      end do
      do k = 1, size(system%clearance_joints%sets)
         associate (items => system%clearance_joints%sets(k)%set%items)
            if (system%clearance_joints%sets(k)%set%traits%is_gap) cycle  ! corners of a slider: its length is no radius
            do i = 1, size(items%pairs)
               call extend(items%body(1, i), norm2(items%s_i(:, i)) + items%pairs(i)%radius_i)
               call extend(items%body(2, i), norm2(items%s_j(:, i)) + items%pairs(i)%radius_j)
            end do
         end associate
      end do
      do k = 1, size(scene%tables%base(table_shapes)%items)
         associate (item => scene%tables%base(table_shapes)%items(k))
            call extend(item%reference("body"), reach_of_shape(item))
            if (item%reference("body") > 0) volume(item%reference("body")) = volume(item%reference("body")) + volume_of_shape(item)
         end associate
      end do

   contains

      !> Something of a body at some distance.
      subroutine extend(body, distance)
         integer, intent(in) :: body            !! the body, 0: ground
         real(wp), intent(in) :: distance       !! from its centre of mass [m]

         if (body > 0) reach(body) = max(reach(body), distance)
      end subroutine extend

   end subroutine find_reach

   !> The maximum distance of a shape from the centre of mass, at most.
   real(wp) function reach_of_shape(item) result(reach)
      type(item_t), intent(in) :: item   !! row of [shapes]

      reach = norm2([item%number("xi"), item%number("eta"), item%number("zeta")])
      select case (item%word("shape"))
      case ("polygon"); reach = sqrt(2.0_wp)*maxval(abs(item%values(place_of(item, "points"))%table))
      case ("box"); reach = reach + 0.5_wp*norm2([item%number("length"), item%number("width"), item%number("height")])
      case ("cylinder"); reach = reach + norm2([item%number("radius"), 0.5_wp*item%number("length")])
      case default; reach = reach + item%number("radius")
      end select
   end function reach_of_shape

   !> Volume of a solid shape; 0: it is flat.
   real(wp) function volume_of_shape(item) result(volume)
      type(item_t), intent(in) :: item   !! row of [shapes]

      volume = 0.0_wp
      select case (item%word("shape"))
      case ("box"); volume = item%number("length")*item%number("width")*item%number("height")
      case ("cylinder"); volume = pi*item%number("radius")**2*item%number("length")
      case ("sphere"); volume = 4.0_wp/3.0_wp*pi*item%number("radius")**3
      end select
   end function volume_of_shape

   !> Points much farther from the centre of mass of their body, or from the origin of the ground, than most others are.
   subroutine look_at_lengths(scene, notes)
      type(scene_t), intent(in) :: scene                       !! the scene
      type(text_t), allocatable, intent(inout) :: notes(:)     !! (any) grown

      real(wp), allocatable :: length(:)
      real(wp) :: middle
      integer :: k

      length = norm2(scene%points%s(:, :scene%points%n), dim=1)
      if (count(length > 0.0_wp) < few) return
      middle = median(pack(length, length > 0.0_wp))
      do k = 1, size(length)
         if (length(k) <= spread_of_lengths*middle) cycle
         call append_text(notes, "point '"//scene%points%names(k)%s//"' is "//real_text(length(k), 3)// &
                          " m from the origin of its body, "//real_text(length(k)/middle, 2)// &
                          " times the median of all points ("//real_text(middle, 3)//" m): m instead of mm?")
      end do
   end subroutine look_at_lengths

   !> Clearances and contact stiffnesses.
   subroutine look_at_joints(scene, system, notes)
      type(scene_t), intent(in) :: scene                       !! the scene
      type(mechanism_t), intent(in) :: system                  !! its system
      type(text_t), allocatable, intent(inout) :: notes(:)     !! (any) grown

      real(wp) :: hertz, stiffness
      integer :: i, k

      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            stiffness = given_stiffness(scene, set)
            do i = 1, set%n
               associate (pair => set%items%pairs(i), name => set%names(i)%s)
                  if (pair%shape == shape_internal .and. set%traits%is_round .and. pair%radius_i > 0.0_wp) then
                     associate (ratio => pair%clearance/pair%radius_i)
                        if (ratio < clearance_ratio(1) .or. ratio > clearance_ratio(2)) then
                           call append_text(notes, "joint '"//name//"': clearance over radius is "//real_text(ratio, 2)// &
                                            "; usual: 0.0001 to 0.01; check units")
                        end if
                     end associate
                  end if
                  hertz = hertz_stiffness(pair)
                  if (.not. (stiffness > 0.0_wp .and. hertz > 0.0_wp)) cycle
                  if (max(stiffness/hertz, hertz/stiffness) <= stiffness_ratio) cycle
                  call append_text(notes, "joint '"//name//"': the contact stiffness of law '"//set%laws%normal%name//"' is "// &
                                   real_text(stiffness, 3)//" N/m^1.5, "//real_text(stiffness/hertz, 2)// &
                                   " times that of Hertz for its radii and materials ("//real_text(hertz, 3)//" N/m^1.5)")
                  exit
               end associate
            end do
         end associate
      end do
   end subroutine look_at_joints

   !> Stiffness that the deck gives the law of a set, of a force that goes with the penetration to 1.5; 0: none.
   real(wp) function given_stiffness(scene, set) result(stiffness)
      type(scene_t), intent(in) :: scene              !! the scene
      class(clearance_set_t), intent(in) :: set       !! the joints

      integer :: i, k

      stiffness = 0.0_wp
      if (.not. allocated(set%laws%normal)) return
      do k = 1, size(scene%tables%laws)
         associate (table => scene%tables%laws(k))
            if (.not. has_hertz_stiffness(table%info)) cycle
            do i = 1, size(table%items)
               if (table%items(i)%name == set%laws%normal%name) stiffness = table%items(i)%number("stiffness")
            end do
         end associate
      end do
   end function given_stiffness

   !> Whether a kind of law has a column of such a stiffness.
   pure logical function has_hertz_stiffness(info) result(has)
      type(kind_info_t), intent(in) :: info  !! the kind

      integer :: c

      has = .false.
      do c = 1, size(info%columns)
         if (info%columns(c)%name == "stiffness") has = abs(info%columns(c)%dimension%m + 0.5_wp) < 0.1_wp
      end do
   end function has_hertz_stiffness

   !> Stiffness of two balls by Hertz, F = K delta^1.5; 0: radii or materials are not known.
   !>
   !> K = 4/(3 (sigma_i + sigma_j)) sqrt(R), 1/R = 1/R_j +- 1/R_i. Flores et al. (2008), eq. (3.3).
   pure real(wp) function hertz_stiffness(pair) result(stiffness)
      type(surfaces_t), intent(in) :: pair   !! the surfaces

      real(wp) :: curvature

      stiffness = 0.0_wp
      if (pair%sigma_i + pair%sigma_j <= 0.0_wp .or. pair%radius_j <= 0.0_wp) return
      curvature = 1.0_wp/pair%radius_j
      select case (pair%shape)
      case (shape_internal, shape_external)
         if (pair%radius_i <= 0.0_wp) return
         curvature = curvature + merge(1.0_wp, -1.0_wp, pair%shape == shape_external)/pair%radius_i
      case (shape_plane)
      case default
         return
      end select
      if (curvature > 0.0_wp) stiffness = 4.0_wp/(3.0_wp*(pair%sigma_i + pair%sigma_j)*sqrt(curvature))
   end function hertz_stiffness

   !> Viscosities.
   subroutine look_at_lubricants(scene, notes)
      type(scene_t), intent(in) :: scene                       !! the scene
      type(text_t), allocatable, intent(inout) :: notes(:)     !! (any) grown

      integer :: k

      do k = 1, size(scene%lubrication%oils)
         associate (mu => scene%lubrication%oils(k)%viscosity, name => scene%tables%base(table_lubricants)%items(k)%name)
            if (mu >= viscosity(1) .and. mu <= viscosity(2)) cycle
            call append_text(notes, "lubricant '"//name//"' has a viscosity of "//real_text(mu, 3)// &
                             " Pa.s; usual: 0.001 (water) to 2 Pa.s (heavy gear oil); 1 cP = 0.001 Pa.s")
         end associate
      end do
   end subroutine look_at_lubricants

   !> The median of some numbers, by bisection of its logarithm, to a thousandth of itself.
   pure real(wp) function median(x)
      real(wp), intent(in) :: x(:)   !! (n) positive numbers, n > 0 [any]

      real(wp) :: above, below

      below = minval(x)
      above = maxval(x)
      do while (above > 1.001_wp*below)
         median = sqrt(below*above)
         if (2*count(x <= median) >= size(x)) then
            above = median
         else
            below = median
         end if
      end do
      median = above
   end function median

end module plausibility
