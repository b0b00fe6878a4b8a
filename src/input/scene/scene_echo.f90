!> The deck as understood: every table and setting, every default written out, in SI.
module scene_echo
   use deck_types, only: deck_t
   use echo, only: echo_items, echo_settings, echo_start
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_static, scene_t, section_t, table_t
   implicit none (type, external)
   private
   public :: echo_scene

contains

   !> Text of a deck that means the same scene.
   function echo_scene(deck, scene) result(text)
      type(deck_t), intent(in) :: deck     !! the deck, for its parameters
      type(scene_t), intent(in) :: scene   !! the scene
      character(:), allocatable :: text    !! a deck

      type(section_t) :: dynamic

      text = "# the deck with all defaults, in SI units"//new_line("a")//echo_start(deck)//new_line("a")// &
             echo_settings(scene%settings%header%info, scene%settings%header%item_t)
      call add(scene%tables%functions)
      call add(scene%tables%base)
      call add(scene%joints)
      call add(scene%forces)
      call add(scene%clearances)
      call add(scene%tables%laws)
      call add(scene%tables%frictions)
      call add(scene%tables%wears)
      call add(scene%tables%films)
      call add(scene%tables%worn)
      if (scene%states%n > 0) text = text//echo_items(scene%tables%states%info, scene%tables%states%items)
      call add(scene%tables%requests)
      dynamic = scene%settings%dynamic
      call scene%settings%integration%write(dynamic%item_t)
      call add_section(scene%settings%has_analysis(analysis_dynamic), dynamic)
      call add_section(scene%settings%has_analysis(analysis_kinematic), scene%settings%kinematic)
      call add_section(scene%settings%has_analysis(analysis_static), scene%settings%static)
      call add_section(scene%settings%guards%is_present, scene%settings%guards)
      call add_section(.true., scene%settings%output)
      call add_section(scene%settings%statistics%is_present, scene%settings%statistics)
      call add_section(scene%settings%ensemble%is_present, scene%settings%ensemble)
      call add_section(scene%settings%life%is_present, scene%settings%life)
      call add_section(scene%settings%precision%is_present, scene%settings%precision)

   contains

      !> Add all tables of a group.
      subroutine add(tables)
         type(table_t), intent(in) :: tables(:)  !! tables

         integer :: k

         do k = 1, size(tables)
            if (size(tables(k)%items) > 0) text = text//echo_items(tables(k)%info, tables(k)%items)
         end do
      end subroutine add

      !> Add a section that is worth telling.
      subroutine add_section(is_worth, section)
         logical, intent(in) :: is_worth           !! whether it is
         type(section_t), intent(in) :: section    !! the section

         if (is_worth) text = text//echo_settings(section%info, section%item_t)
      end subroutine add_section

   end function echo_scene

end module scene_echo
