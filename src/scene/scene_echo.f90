!> The deck as understood: every table and setting, every default written out, in SI.
module scene_echo
   use deck_types, only: deck_t
   use echo, only: echo_items, echo_settings, echo_start
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_static, scene_t, table_t
   use section_info, only: scene_info
   implicit none (type, external)
   private
   public :: echo_scene

contains

   !> Text of a deck that means the same scene.
   function echo_scene(deck, scene) result(text)
      type(deck_t), intent(in) :: deck     !! the deck, for its parameters
      type(scene_t), intent(in) :: scene   !! the scene
      character(:), allocatable :: text    !! a deck

      text = "# the deck as understood: every default written out, units in SI"//new_line("a")//echo_start(deck)//new_line("a")// &
             echo_settings(scene_info(), scene%header)
      call add(scene%functions)
      call add(scene%base)
      call add(scene%joints)
      call add(scene%forces)
      call add(scene%clearances)
      call add(scene%law_tables)
      call add(scene%friction_tables)
      if (scene%has_analysis(analysis_dynamic)) text = text//echo_settings(scene%dynamic_kind, scene%dynamic)
      if (scene%has_analysis(analysis_kinematic)) text = text//echo_settings(scene%kinematic_kind, scene%kinematic)
      if (scene%has_analysis(analysis_static)) text = text//echo_settings(scene%static_kind, scene%static)
      text = text//echo_settings(scene%output_kind, scene%output)
      if (scene%has_statistics) text = text//echo_settings(scene%statistics_kind, scene%statistics)
      if (scene%has_ensemble) text = text//echo_settings(scene%ensemble_kind, scene%ensemble)
      if (scene%has_precision) text = text//echo_settings(scene%precision_kind, scene%precision)

   contains

      !> Add all tables of a group.
      subroutine add(tables)
         type(table_t), intent(in) :: tables(:)  !! tables

         integer :: k

         do k = 1, size(tables)
            if (size(tables(k)%items) > 0) text = text//echo_items(tables(k)%info, tables(k)%items)
         end do
      end subroutine add

   end function echo_scene

end module scene_echo
