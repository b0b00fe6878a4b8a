!> What studies have in common at their start: what they need of the deck, their directory, and the echo of their tables.
module study_request
   use diagnostics, only: diagnostics_t
   use echo, only: echo_items, echo_settings
   use errors, only: error_t, exit_usage, set_error
   use integration_method, only: abilities_t, steps_fixed
   use integration_settings, only: integration_t
   use integrator, only: integrator_t
   use integrator_controls, only: onset_located
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use load, only: loaded_t
   use one_step, only: one_step_t
   use number_lists, only: file_to_lists
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use rock4, only: rock4_t
   use run_place, only: directory_of
   use run_plan, only: tell_origin
   use scene, only: analysis_dynamic
   use settings, only: read_settings
   use tables, only: read_items
   use text, only: text_t
   implicit none (type, external)
   private
   public :: check_derivable, echo_of_rows, echo_of_section, open_study

contains

   !> Derivatives through a motion need their tables, a dynamic analysis, and a method whose steps have a map.
   subroutine check_derivable(loaded, is_present, table, who, error)
      type(loaded_t), intent(in) :: loaded                 !! the deck
      logical, intent(in) :: is_present                    !! it has the tables of the study
      character(*), intent(in) :: table                    !! the first one: "table [NAME]" or "section [NAME]"
      character(*), intent(in) :: who                      !! needs it, with the verb
      type(error_t), allocatable, intent(out) :: error     !! what is missing

      if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, who//" [analysis.dynamic] as the first analysis section of the deck")
      else if (.not. is_present) then
         call set_error(error, exit_usage, "the deck has no "//table//new_line("a")//"  = see 'gudgeon help "// &
            table(scan(table, "[") + 1:len(table) - 1)//"'")
      else
         call check_one_step(loaded%scene%settings%integration, who, error)
      end if
   end subroutine check_derivable

   !> A one-step method with variable steps that locates onsets.
   subroutine check_one_step(settings, who, error)
      type(integration_t), intent(in) :: settings          !! of the deck
      character(*), intent(in) :: who                      !! needs it, with the verb
      type(error_t), allocatable, intent(out) :: error     !! it is not

      class(integrator_t), allocatable :: method
      type(abilities_t) :: can

      call settings%new_method(method)
      can = method%abilities()
      select type (method)
      class is (rock4_t)
         call set_error(error, exit_usage, "method "//method%name()//" chooses its stages by the steps before: they have no " &
                        //"derivative"//new_line("a")//"  = give method = auto, verner, dop853 or radau, or --method")
      class is (one_step_t)
         if (can%steps == steps_fixed .or. settings%controls%fixed_step > 0.0_wp) then
            call set_error(error, exit_usage, who//" variable steps"//new_line("a")// &
                           "  = omit step, and give method = auto, verner, dop853 or radau")
         else if (settings%controls%onset /= onset_located) then
            call set_error(error, exit_usage, who//" contact_onset = located")
         end if
      class default
         call set_error(error, exit_usage, "method "//method%name()//" is not a one-step method: its steps depend on earlier " &
                        //"ones"//new_line("a")//"  = give method = auto, verner, dop853 or radau, or --method")
      end select
   end subroutine check_one_step

   !> Make the directory of the results, and what files say of their origin.
   subroutine open_study(options, loaded, directory, plan, warnings, error)
      type(options_t), intent(in) :: options                     !! the command line
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(output_directory_t), intent(inout) :: directory       !! opened
      type(output_plan_t), intent(inout) :: plan                 !! directory, title and origin are set
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) those of the directory go before
      type(error_t), allocatable, intent(out) :: error           !! no directory

      call directory%open(directory_of(options, loaded), error)
      if (allocated(error)) return
      warnings = [directory%warnings, warnings]
      plan%directory = directory%path
      plan%title = loaded%scene%title
      call tell_origin(options, loaded, plan)
      call plan%complete()
   end subroutine open_study

   !> The rows of a table as a deck; blank without rows. There are no errors: the tables were checked.
   function echo_of_rows(loaded, info, lists) result(text)
      type(loaded_t), intent(inout) :: loaded         !! the deck; defaults are noted
      type(kind_info_t), intent(in) :: info           !! the table
      character(*), intent(in), optional :: lists(:)  !! lists that a file of a row may have
      character(:), allocatable :: text               !! lines of a deck

      type(diagnostics_t) :: ignored
      type(item_t), allocatable :: items(:)
      integer :: k, twice

      text = ""
      call read_items(loaded%deck, info, items, ignored)
      do k = 1, merge(size(items), 0, present(lists))
         call file_to_lists(items(k), lists, twice)
      end do
      if (size(items) > 0) text = echo_items(info, items)
   end function echo_of_rows

   !> The same of a section.
   function echo_of_section(loaded, info) result(text)
      type(loaded_t), intent(inout) :: loaded      !! the deck; defaults are noted
      type(kind_info_t), intent(in) :: info        !! the section
      character(:), allocatable :: text            !! lines of a deck

      type(diagnostics_t) :: ignored
      type(item_t) :: keys
      logical :: is_present

      call read_settings(loaded%deck, info, keys, is_present, ignored)
      text = echo_settings(info, keys)
   end function echo_of_section

end module study_request
