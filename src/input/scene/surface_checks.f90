!> What rows of clearance joints cannot say of themselves: whether their laws, films and wear laws match their surfaces.
module surface_checks
   use clearance_set, only: clearance_set_t
   use columns, only: cell_index, column_of
   use film_law, only: film_bearing_t, n_film_parameter
   use film_places, only: film_bearing_of, place_of_film
   use item, only: item_t
   use joint_level, only: level_clearance, level_ideal, level_lubricated, level_of
   use kind_info, only: in_space, kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter
   use scene, only: scene_t
   use surfaces, only: shape_face, surfaces_t
   implicit none (type, external)
   private
   public :: check_law

contains

   !> The normal law of a clearance joint must fit its surfaces.
   subroutine check_law(scene, info, item, set, column, message, help)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(kind_info_t), intent(in) :: info               !! the geometry
      type(item_t), intent(in) :: item                    !! the row
      class(clearance_set_t), intent(in) :: set           !! any set of the geometry
      integer, intent(out) :: column                      !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message   !! what is wrong
      character(:), allocatable, intent(out) :: help      !! what would be right

      type(kind_info_t) :: law_info
      type(surfaces_t) :: pair
      real(wp) :: parameters(n_law_parameter)
      integer :: face_law, law_number

      column = 0
      message = ""
      help = ""
      if (level_of(item) == level_ideal) return
      call set%describe(item, scene%materials, pair)
      law_number = cell_index(info, item, "law")
      if (law_number > 0) call scene%laws(law_number)%law%fit(pair, parameters, message, help)
      if (message /= "") column = column_of(info, "law")
      if (column == 0) call check_film(scene, info, item, pair, column, message, help)
      if (column == 0) call check_wear(scene, info, item, pair, column, message, help)
      if (column > 0) return
      face_law = cell_index(info, item, "face_law")
      if (face_law == 0) return
      pair%shape = shape_face
      associate (law => scene%laws(face_law)%law)
         law_info = law%info()
         call law%fit(pair, parameters, message, help)
         if (law_info%name /= "contact.plane_face") then
            message = "'"//law%name//"' is not a law of a plane face"
            help = "name a row of contact.plane_face"
         end if
      end associate
      if (message /= "") column = column_of(info, "face_law")
   end subroutine check_law

   !> Surfaces that wear must touch, and have an area; a law of the work of friction needs friction.
   subroutine check_wear(scene, info, item, pair, column, message, help)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(kind_info_t), intent(in) :: info               !! the geometry
      type(item_t), intent(in) :: item                    !! the row
      type(surfaces_t), intent(in) :: pair                !! its surfaces
      integer, intent(inout) :: column                    !! column at fault, 0: all is well
      character(:), allocatable, intent(inout) :: message !! what is wrong
      character(:), allocatable, intent(inout) :: help    !! what would be right

      integer :: friction, wear
      logical :: has_friction

      wear = cell_index(info, item, "wear")
      if (wear == 0) return
      friction = cell_index(info, item, "friction")
      has_friction = .false.
      if (friction > 0) has_friction = scene%frictions(friction)%law%is_active()
      if (level_of(item) == level_lubricated) then
         message = "joint '"//item%name//"' with level = lubricated has a wear law"
         help = "its surfaces do not touch: use level = clearance or hybrid, or wear = none"
      else if (.not. pair%length > 0.0_wp) then
         message = "joint '"//item%name//"' has a wear law but no length"
         help = "the depth of wear is volume over area: give the length of the joint along its axis"
      else if (scene%wears(wear)%law%by_friction .and. .not. has_friction) then
         message = "joint '"//item%name//"' has the wear law '"//scene%wears(wear)%law%name//"' but no friction"
         help = "this law is one of the work of friction: name a row of a friction table, or use wear.archard"
      end if
      if (message /= "") column = column_of(info, "wear")
   end subroutine check_wear

   !> The film of a clearance joint must fit its bearing.
   subroutine check_film(scene, info, item, pair, column, message, help)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(kind_info_t), intent(in) :: info                 !! the geometry
      type(item_t), intent(in) :: item                      !! the row
      type(surfaces_t), intent(in) :: pair                  !! its surfaces
      integer, intent(inout) :: column                      !! column at fault, 0: all is well
      character(:), allocatable, intent(inout) :: message   !! what is wrong
      character(:), allocatable, intent(inout) :: help      !! what would be right

      type(film_bearing_t) :: bearing
      real(wp) :: parameters(n_film_parameter)
      integer :: film

      film = cell_index(info, item, "film")
      if (film == 0 .or. level_of(item) == level_clearance) return
      bearing = film_bearing_of(pair, place_of_film(item, scene%lubrication%oils))
      associate (law => scene%lubrication%films(film)%law)
         call law%fit(bearing, parameters, message, help)
         if (law%is_of_sphere() .neqv. bearing%is_sphere) then
            message = "film '"//law%name//"' is for a ball in a socket"
            help = "use a row of another film table, as film.finite"
            if (bearing%is_sphere) message = "film '"//law%name//"' is for a journal in a bearing"
            if (bearing%is_sphere) help = "use a row of film.spherical"
         end if
         if (message == "" .and. law%has_bore()) call check_bore(info, item, message, help)
      end associate
      if (message /= "") column = column_of(info, "film")
      if (message /= "" .or. bearing%is_sphere) return
      if (item%word("heat") == "off") return
      if (item%reference("lubricant") == 0) return
      if (scene%lubrication%oils(item%reference("lubricant"))%grade /= "none") return
      column = column_of(info, "heat")
      message = "joint '"//item%name//"' has a heat balance, but the viscosity of its lubricant does not depend on temperature"
      help = "give the lubricant a grade and its inlet temperature"
   end subroutine check_film

   !> A bore that is not round is that of a film alone between journals in the plane: surfaces that touch are round.
   subroutine check_bore(info, item, message, help)
      type(kind_info_t), intent(in) :: info                 !! the geometry
      type(item_t), intent(in) :: item                      !! the row
      character(:), allocatable, intent(inout) :: message   !! what is wrong
      character(:), allocatable, intent(inout) :: help      !! what would be right

      if (info%space == in_space) then
         message = "film '"//item%word("film")//"' has a bore that is not round, which a spatial joint does not know"
         help = "use a planar scene, or bore = round and dam = none"
      else if (level_of(item) /= level_lubricated) then
         message = "film '"//item%word("film")//"' has a bore that is not round, but the surfaces that touch are round"
         help = "use level = lubricated, or bore = round and dam = none"
      end if
   end subroutine check_bore

end module surface_checks
