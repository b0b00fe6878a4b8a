!> How a row of a joint with clearance is modelled: column `level`.
module joint_level
   use item, only: find_place, item_t
   implicit none (type, external)
   private
   public :: level_clearance, level_hybrid, level_ideal, level_lubricated, level_of, make_ideal

   integer, parameter :: level_ideal = 1        !! as an ideal joint
   integer, parameter :: level_clearance = 2    !! dry contact
   integer, parameter :: level_lubricated = 3   !! a film
   integer, parameter :: level_hybrid = 4       !! a film, and dry contact where it is thin
   character(*), parameter :: words(4) = [character(10) :: "ideal", "clearance", "lubricated", "hybrid"]  !! as in a deck

contains

   !> The level of a row; 0: its geometry has none.
   pure integer function level_of(item) result(level)
      type(item_t), intent(in) :: item   !! the row

      integer :: place

      level = 0
      place = find_place(item, "level")
      if (place > 0) level = findloc(words == item%values(place)%text, .true., dim=1)
   end function level_of

   !> Make a row an ideal joint; a geometry without one keeps its contacts.
   elemental subroutine make_ideal(item)
      type(item_t), intent(inout) :: item   !! the row

      integer :: place

      place = find_place(item, "level")
      if (place == 0) return
      item%values(place)%text = trim(words(level_ideal))
      item%values(place)%given = .true.
   end subroutine make_ideal

end module joint_level
