!> The summaries of a study of periodic orbits, for people and for scripts.
module orbit_report
   use errors, only: error_t
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use load, only: loaded_t
   use options, only: options_t
   use orbit_object, only: put_orbit
   use orbit_results, only: orbit_study_t
   use orbit_tables, only: table_of_bifurcations, table_of_branch, table_of_multipliers, table_of_onsets
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use study_summary, only: add_output, show_summaries, start_summary
   use table_list, only: list_of
   use text, only: counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
   implicit none (type, external)
   private
   public :: report_orbit

contains

   !> Write and show the summaries.
   subroutine report_orbit(options, loaded, plan, study, names, pictures, warnings, error)
      type(options_t), intent(in) :: options                 !! the command line
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(orbit_study_t), intent(in) :: study               !! the study
      type(text_t), intent(in) :: names(:)                   !! (contacts) their names
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      type(error_t), allocatable, intent(out) :: error       !! a file cannot be written

      type(json_object_t) :: json

      call start_summary(json, loaded%path, plan, status_complete, "")
      call put_orbit(json, study, names)
      if (study%plan%parameter /= "") call put_tables(json, list_of(table_of_branch(study)))
      call json%put_list("warnings", warnings)
      call show_summaries(options, plan%directory, text_of(plan, study, names, pictures, warnings), json%get(), error)
   end subroutine report_orbit

   !> The summary for people.
   function text_of(plan, study, names, pictures, warnings) result(text)
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(orbit_study_t), intent(in) :: study               !! the study
      type(text_t), intent(in) :: names(:)                   !! (contacts) their names
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      character(:), allocatable :: text                      !! whole lines

      type(buffer_t) :: lines

      call lines%line(plan%title)
      associate (orbit => study%orbit)
         call lines%line("complete: "//trim(merge("stable  ", "unstable", orbit%is_stable))//" orbit, period "// &
                         real_text(orbit%period, 9)//" s, residual "//real_text(orbit%residual, 2)//" of the scales, tolerance "// &
                         real_text(study%plan%tolerance, 2))
         if (study%plan%joint /= "") call lines%line("phase      "//real_text(orbit%phase, 12)//" rad at the first onset of "// &
                                                     study%plan%joint)
      end associate
      call lines%line("state      "//counted(study%n_free, "free component", "free components")// &
                      "; "//to_text(study%n_cyclic)//" cyclic, omitted")
      call add_table(lines, table_of_multipliers(study))
      call add_table(lines, table_of_onsets(study, names))
      if (study%plan%parameter /= "") call add_branch(lines, study)
      call lines%line("")
      call add_output(lines, plan%directory, "orbit.h5"//trim(merge(", branch.csv", "            ", study%plan%parameter /= "")), &
                      pictures, warnings)
      text = lines%get()
   end function text_of

   !> Lines on the branch.
   subroutine add_branch(lines, study)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(orbit_study_t), intent(in) :: study    !! the study

      associate (branch => study%branch)
         call lines%line("")
         call lines%line("branch     "//counted(size(branch%orbits), "orbit", "orbits")//" over "//study%plan%parameter//", "// &
                         to_text(count(branch%orbits%is_stable))//" stable; "//to_text(study%n_run)//" periods integrated")
         call lines%line("           one end: "//branch%low)
         call lines%line("           other end: "//branch%high)
         call add_table(lines, table_of_bifurcations(study))
      end associate
   end subroutine add_branch

end module orbit_report
