!> What the levels of a revolute joint with clearance need: columns and channels of films, and what a row must have.
module revolute_level
   use bodies, only: material_t
   use item, only: find_place, item_t, place_of
   use joint_level, only: level_clearance, level_hybrid, level_ideal, level_lubricated, level_of
   use kind_info, only: add_channel, add_flag, add_number, add_reference, add_word, dim_length, dim_none, kind_info_t
   use kinds, only: wp
   use surfaces, only: put_inside, surfaces_t, take_materials
   implicit none (type, external)
   private
   public :: add_film_channels, add_film_columns, add_spatial_film_channels, describe_hole, film_channels, find_level_mistake
   public :: pressure_channels
   public :: of_drag_bearing, of_drag_journal, of_eccentricity_ratio, of_film_force, of_film_moment, of_film_power, of_film_pressure
   public :: of_film_thickness, of_film_torque, of_side_flow, of_temperature_rise

   ! channels, behind those of `point_contacts`
   integer, parameter :: of_film_force = 21          !! force on the journal
   integer, parameter :: of_film_torque = 22         !! moment of the shear, where it acts
   integer, parameter :: of_film_thickness = 23      !! minimum thickness
   integer, parameter :: of_film_pressure = 24       !! maximum pressure
   integer, parameter :: of_eccentricity_ratio = 25  !! eccentricity over clearance
   integer, parameter :: of_drag_journal = 26        !! moment of the shear on the journal
   integer, parameter :: of_drag_bearing = 27        !! and on the bearing
   integer, parameter :: of_film_power = 28          !! heat
   integer, parameter :: of_side_flow = 29           !! what leaves at the ends
   integer, parameter :: of_temperature_rise = 30    !! of the lubricant

   integer, parameter :: of_film_moment = 31         !! in space: of the film on the pin

   character(*), parameter :: film_channels = " film_force film_moment film_torque film_thickness film_pressure "// &
                              "eccentricity_ratio drag_journal drag_bearing film_power side_flow temperature_rise "
      !! channels of films
   character(*), parameter :: pressure_channels = " film_pressure "  !! channels of joints whose film has pressures

contains

   !> Columns of a film.
   subroutine add_film_columns(info, is_sphere)
      type(kind_info_t), intent(inout) :: info  !! the geometry
      logical, intent(in) :: is_sphere          !! that of a ball in a socket

      call add_reference(info, "film", "film.", "lubricant film, a row of a film table, or none", default="none")
      call add_reference(info, "lubricant", "lubricant", "lubricant of the film, a row of [lubricant]", default="none")
      if (.not. is_sphere) then
         call add_word(info, "entrain", "entrainment speed: sum of the absolute angular speeds, or relative speed of journal and " &
                       //"bearing, as in Flores et al. (2008)", default="inertial", choices="inertial book")
      end if
      call add_flag(info, "film_torque", "shear moments of the film on journal and bearing", default="off")
      if (.not. is_sphere) then
         call add_word(info, "heat", "off: the film has the temperature of the lubricant; balance: a static analysis adds half "// &
            "of " &
                       //"the temperature rise", default="off", choices="off balance")
      end if
      call add_number(info, "eps_max", dim_none, "eccentricity ratio at which a lubricated run stops, and beyond which a " &
                      //"film force keeps its form", default="0.99999", lower=0.0_wp, upper=1.0_wp, open_lower=.true., &
                         open_upper=.true.)
      call add_number(info, "roughness", dim_length, "surface roughness, a twentieth of the minimum safe film thickness; " &
                      //"0: unknown", default="0 m", lower=0.0_wp)
      call add_number(info, "e_t0", dim_length, "hybrid: depth beyond the clearance over which the film fades out and the "// &
         "contact " &
                      //"fades in; 0: both forces add up", default="0 m", lower=0.0_wp)
      call add_number(info, "e_t1", dim_length, "hybrid: extra clearance of the film, greater than e_t0", default="0 m", &
                      lower=0.0_wp)
   end subroutine add_film_columns

   !> Channels of a film.
   subroutine add_film_channels(info)
      type(kind_info_t), intent(inout) :: info  !! the geometry

      call add_channel(info, "film_force", "N", "world", 2, "force of the film on the journal", of_film_force)
      call add_channel(info, "film_torque", "N.m", "world", 1, "shear moment of the film on the journal, as applied", &
                       of_film_torque)
      call add_channel(info, "film_thickness", "m", "none", 1, "minimum film thickness; of a round bore clearance minus " &
                       //"eccentricity", of_film_thickness)
      call add_channel(info, "film_pressure", "Pa", "none", 1, "maximum film pressure at mid-length, in steps of one degree; " &
                       //"for films with a pressure field: grid, squeeze, short and long", of_film_pressure)
      call add_channel(info, "eccentricity_ratio", "1", "none", 1, "eccentricity ratio", of_eccentricity_ratio)
      call add_channel(info, "drag_journal", "N.m", "world", 1, "shear moment on the journal, applied or not", &
                       of_drag_journal)
      call add_channel(info, "drag_bearing", "N.m", "world", 1, "shear moment on the bearing, applied or not", &
                       of_drag_bearing)
      call add_channel(info, "film_power", "W", "none", 1, "power dissipated in the film", of_film_power)
      call add_channel(info, "side_flow", "m^3/s", "none", 1, "lubricant flow out of both ends of the bearing", of_side_flow)
      call add_channel(info, "temperature_rise", "K", "none", 1, "of the lubricant, if the side flow carries all heat; " &
                       //"NaN where that flow is below L R c (|w_i| + |w_j|)/1000", of_temperature_rise)
   end subroutine add_film_channels

   !> Channels of a film in space.
   subroutine add_spatial_film_channels(info, is_sphere)
      type(kind_info_t), intent(inout) :: info  !! the geometry
      logical, intent(in) :: is_sphere          !! a ball in a socket, not a pin in a bushing

      if (is_sphere) then
         call add_channel(info, "film_force", "N", "world", 2, "force of the film on the ball", of_film_force)
         call add_channel(info, "film_torque", "N.m", "world", 2, "shear moment of the film on the ball, as applied", &
                          of_film_torque)
      else
         call add_channel(info, "film_force", "N", "world", 2, "force of the film on the pin", of_film_force)
         call add_channel(info, "film_moment", "N.m", "world", 2, "moment of the film on the pin about its middle", of_film_moment)
         call add_channel(info, "film_torque", "N.m", "joint", 1, "shear moment of the film on the pin about the axis of " &
                          //"the bushing, as applied", of_film_torque)
      end if
      call add_channel(info, "film_thickness", "m", "none", 1, "minimum film thickness, at the thinner end", &
                       of_film_thickness)
      call add_channel(info, "eccentricity_ratio", "1", "none", 1, "eccentricity ratio at the middle of the film", &
                       of_eccentricity_ratio)
      call add_channel(info, "film_power", "W", "none", 1, "power dissipated in the film", of_film_power)
      if (is_sphere) return
      call add_channel(info, "film_pressure", "Pa", "none", 1, "maximum film pressure at mid-length, in steps of one degree; " &
                       //"for films with a pressure field: grid, squeeze, short and long", of_film_pressure)
      call add_channel(info, "drag_journal", "N.m", "joint", 1, "shear moment on the pin, applied or not", &
                       of_drag_journal)
      call add_channel(info, "drag_bearing", "N.m", "joint", 1, "shear moment on the bushing, applied or not", &
                       of_drag_bearing)
      call add_channel(info, "side_flow", "m^3/s", "none", 1, "lubricant flow out of both ends of the bushing", of_side_flow)
      call add_channel(info, "temperature_rise", "K", "none", 1, "of the lubricant, if the side flow carries all heat; " &
                       //"NaN where that flow is below L R c (|w_i| + |w_j|)/1000", of_temperature_rise)
   end subroutine add_spatial_film_channels

   !> A pin in a hole or a ball in a socket. Where a film alone is between the surfaces, its end is that of the gap.
   pure subroutine describe_hole(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      call put_inside(pair, item%number("bearing_radius"), item%number("clearance"), &
                      merge(item%number("eps_max"), 1.0_wp, level_of(item) == level_lubricated))
      call take_materials(pair, materials, item%reference("material"), item%reference("journal_material"))
   end subroutine describe_hole

   !> What is wrong with a row as to its level: contact needs a material and a law, a film a lubricant and a length.
   subroutine find_level_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      integer :: level

      column = 0
      message = ""
      help = ""
      level = level_of(item)
      if (level == level_ideal) return
      if (level /= level_lubricated) then
         if (item%reference("law") == 0) call find("law", "no contact law", "name a row of a contact table in column law")
         if (item%reference("material") == 0) call find("material", "no material", "name a row of [material] in column material")
      end if
      if (level /= level_clearance) then
         if (item%reference("film") == 0) call find("film", "no film", "name a row of a film table in column film")
         if (item%reference("lubricant") == 0) then
            call find("lubricant", "no lubricant", "name a row of [lubricant] in column lubricant")
         end if
         if (find_place(item, "length") > 0) then  ! of a ball there is none
            if (.not. item%number("length") > 0.0_wp) then
               call find("length", "no length", "give the length of the bearing along its axis")
            end if
         end if
      end if
      if (level /= level_hybrid) return
      if (.not. item%number("e_t1") > item%number("e_t0") .and. item%number("e_t0") > 0.0_wp) then
         call find("e_t1", "an e_t1 not greater than e_t0", "the film must vanish at c + e_t0, before its clearance "// &
            "ends at c + e_t1")
      end if
      if (.not. item%number("e_t1") < item%number("clearance")) then
         call find("e_t1", "an e_t1 not smaller than the clearance", "e_t0 and e_t1 must be small compared with the clearance")
      end if

   contains

      !> The first error stands.
      subroutine find(name, what, advice)
         character(*), intent(in) :: name    !! column at fault
         character(*), intent(in) :: what    !! what the joint has or lacks
         character(*), intent(in) :: advice  !! what would be right

         if (column > 0) return
         column = place_of(item, name)
         message = "joint '"//item%name//"' with level = "//item%word("level")//" has "//what
         help = advice
      end subroutine find

   end subroutine find_level_mistake

end module revolute_level
