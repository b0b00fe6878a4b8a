!> Whether a motion is reported at the instants of its contacts, besides the output instants.
module row_plan
   use item, only: place_of
   use mechanism, only: mechanism_t
   use scene, only: analysis_dynamic, scene_t
   use section_info, only: most_row_contacts
   use text, only: to_text
   implicit none (type, external)
   private
   public :: contact_rows_text, has_contact_rows

contains

   !> Whether there are rows at contacts.
   logical function has_contact_rows(scene, system) result(has_rows)
      type(scene_t), intent(in) :: scene           !! the scene
      type(mechanism_t), intent(in) :: system  !! its system

      has_rows = .false.
      if (scene%analysis /= analysis_dynamic .or. system%clearance_joints%n_contact == 0) return
      select case (scene%settings%output%word("contact_rows"))
      case ("on")
         has_rows = .true.
      case ("auto")
         has_rows = system%clearance_joints%n_contact <= most_row_contacts
      end select
   end function has_contact_rows

   !> The same as text, blank where there are no contacts.
   function contact_rows_text(scene, system) result(words)
      type(scene_t), intent(in) :: scene           !! the scene
      type(mechanism_t), intent(in) :: system  !! its system
      character(:), allocatable :: words           !! as `rows at the onset, peak and end of every contact (contact_rows = auto)`

      words = ""
      if (scene%analysis /= analysis_dynamic .or. system%clearance_joints%n_contact == 0) return
      associate (word => scene%settings%output%values(place_of(scene%settings%output, "contact_rows"))%text)
         words = "output rows at onset, peak and separation of every contact"
         if (.not. has_contact_rows(scene, system)) words = "no "//words
         words = words//" (contact_rows = "//word
         if (word == "auto") words = words//": up to "//to_text(most_row_contacts)//" contacts, here "// &
                                 to_text(system%clearance_joints%n_contact)
      end associate
      words = words//")"
   end function contact_rows_text

end module row_plan
