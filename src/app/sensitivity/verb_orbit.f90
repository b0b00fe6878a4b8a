!> `gudgeon orbit DECK`: a periodic orbit, its multipliers, and its branch over a parameter.
module verb_orbit
   use csv_table, only: csv_text
   use deck_orbits, only: deck_orbits_t
   use echo, only: echo_settings
   use errors, only: error_t, exit_integration, set_error
   use file_store, only: keep_files
   use gnuplot_runs, only: draw_figures, make_folder
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use mechanism, only: mechanism_t
   use options, only: options_t
   use orbit_info, only: orbit_section
   use orbit_plots, only: write_orbit_plots
   use orbit_report, only: report_orbit
   use orbit_results, only: orbit_study_t
   use orbit_study, only: study_orbits
   use orbit_tables, only: table_of_bifurcations, table_of_branch, table_of_multipliers, table_of_onsets
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use run_limits, only: limits_of
   use scene_echo, only: echo_scene
   use study_request, only: check_derivable, open_study
   use table_file, only: write_table_file
   use table_list, only: list_of
   use text, only: text_t
   use text_file, only: replace_file
   use text_table, only: file_heading
   implicit none (type, external)
   private
   public :: orbit_deck

contains

   !> Find the orbit that the deck asks for.
   subroutine orbit_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, no directory, or no orbit

      type(deck_orbits_t), save, target :: source
      type(loaded_t), save :: loaded
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(orbit_study_t) :: study
      type(text_t), allocatable :: names(:), pictures(:), warnings(:)
      character(:), allocatable :: reason

      call keep_files()
      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_derivable(loaded, loaded%orbit%is_present, "section [orbit]", "orbits need", error)
      if (allocated(error)) return
      allocate (warnings(0))
      call limits_of(loaded%scene, loaded%catalogue, loaded%limits, warnings)
      call open_study(options, loaded, directory, plan, warnings, error)
      if (allocated(error)) return
      if (options%change%tolerance > 0.0_wp) loaded%orbit%plan%tolerance = options%change%tolerance
      study%plan = loaded%orbit%plan
      source%deck%options = options
      source%plan = loaded%orbit%plan
      names = contact_names(loaded%system)
      call study_orbits(source, study, reason)
      if (reason /= "") call set_error(error, exit_integration, "no periodic orbit: "//reason)
      if (.not. allocated(error)) call write_results(loaded, plan, study, names, pictures, warnings, error)
      if (.not. allocated(error)) call report_orbit(options, loaded, plan, study, names, pictures, warnings, error)
      call directory%close()
   end subroutine orbit_deck

   !> Names of the contacts: of the joint, with a dot and a label where a joint has several.
   function contact_names(system) result(names)
      type(mechanism_t), intent(in) :: system    !! the mechanism
      type(text_t), allocatable :: names(:)      !! (contacts) names

      integer :: i, k

      allocate (names(system%clearance_joints%n_contact))
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               associate (name => names(set%before%contacts + i))
                  name%s = set%names(set%item_of(i))%s
                  if (set%label_of(i) /= "") name%s = name%s//"."//set%label_of(i)
               end associate
            end do
         end associate
      end do
   end function contact_names

   !> The files and the figure.
   subroutine write_results(loaded, plan, study, names, pictures, warnings, error)
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(output_plan_t), intent(in) :: plan                    !! what files say
      type(orbit_study_t), intent(in) :: study                   !! the study
      type(text_t), intent(in) :: names(:)                       !! (contacts) their names
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(text_t), allocatable :: figures(:)
      character(:), allocatable :: folder

      allocate (pictures(0))
      call replace_file(plan%directory//"/deck.echo", echo_scene(loaded%deck, loaded%scene)// &
                        echo_settings(orbit_section(), loaded%orbit%keys), error)
      if (.not. allocated(error)) then
         call write_table_file("orbit.h5", "gudgeon orbit", plan, status_complete, &
                               list_of(table_of_multipliers(study), table_of_onsets(study, names), table_of_branch(study), &
                                       table_of_bifurcations(study)), error)
      end if
      if (allocated(error) .or. study%plan%parameter == "") return
      call replace_file(plan%directory//"/branch.csv", csv_text(table_of_branch(study)), error)
      if (allocated(error)) return
      folder = plan%directory//"/figures"
      call make_folder(folder, error)
      if (.not. allocated(error)) call write_orbit_plots(folder, plan%title, file_heading(plan), study, figures, error)
      if (.not. allocated(error)) call draw_figures(folder, figures, pictures, warnings)
   end subroutine write_results

end module verb_orbit
