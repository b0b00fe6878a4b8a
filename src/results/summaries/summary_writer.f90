!> How a run went: summary.txt for people, summary.json for scripts.
module summary_writer
   use accuracy_text, only: asked_lines
   use display_units, only: choose_unit, display_unit_t
   use horizon_text, only: add_horizon
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use kinds, only: i8, wp
   use linear_text, only: linear_lines
   use output_plan, only: output_plan_t
   use plot_text, only: valid_utf8
   use posix, only: utc_time
   use recorder, only: row_end, row_jump, row_onset, row_peak, status_complete, summary_t
   use result_table, only: result_table_t
   use statistics, only: number_t
   use summary_table, only: relative_residual, seconds_per_rhs
   use text, only: counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
   use text_table, only: one_line
   use wear_object, only: put_wear_of_run
   implicit none (type, external)
   private
   public :: accuracy_lines, complete_summary, cost_lines, headline, outcome_t, summary_json, summary_lines

   real(wp), parameter :: worth_telling = 1.0e-6_wp  !! way of a body in the assembly [m]

   !> What a run left behind besides its numbers.
   type :: outcome_t
      type(text_t), allocatable :: files(:)     !! (n) files of data, paths within the directory
      type(text_t), allocatable :: csv(:)       !! (any) those of them that are comma-separated too
      type(text_t), allocatable :: solids(:)    !! (any) worn surfaces as STL
      type(text_t), allocatable :: pictures(:)  !! (m) pictures, paths within the directory
      type(number_t), allocatable :: numbers(:) !! (l) the statistics
      type(text_t), allocatable :: warnings(:)  !! (k) what a careful reader should know, and what was not made
      type(result_table_t), allocatable :: tables(:)    !! (any) the results
   end type outcome_t

contains

   !> A summary without unallocated strings.
   function complete_summary(summary) result(full)
      type(summary_t), intent(in) :: summary  !! as it came
      type(summary_t) :: full                 !! the same, strings not given blank

      full = summary
      if (.not. allocated(full%warnings)) allocate (full%warnings(0))
      if (.not. allocated(full%status)) full%status = status_complete
      if (.not. allocated(full%message)) full%message = ""
      if (.not. allocated(full%method%integrator)) full%method%integrator = ""
      if (.not. allocated(full%method%solver)) full%method%solver = ""
      if (.not. allocated(full%method%stabilisation)) full%method%stabilisation = ""
      if (.not. allocated(full%equilibrium)) full%equilibrium = ""
   end function complete_summary

   !> The summary for people.
   function summary_lines(plan, summary, outcome) result(text)
      type(output_plan_t), intent(in) :: plan      !! what is known of the run
      type(summary_t), intent(in) :: summary       !! cost and errors
      type(outcome_t), intent(in) :: outcome       !! what the run left behind
      character(:), allocatable :: text            !! whole lines

      type(buffer_t) :: lines
      integer :: k

      if (len_trim(plan%title) > 0) call lines%line(one_line(valid_utf8(plan%title)))
      call lines%line(headline(summary))
      if (len_trim(summary%message) > 0) call lines%line(trim(summary%message))
      if (len(summary%equilibrium) > 0) call lines%line("equilibrium: "//summary%equilibrium)
      call linear_lines(lines, summary%linear)
      call lines%line("")
      if (plan%moved > worth_telling) call lines%line("start      initial assembly correction: up to "//real_text(plan%moved, 3)// &
                                                      " m")
      call cost_lines(lines, summary)
      call accuracy_lines(lines, summary)
      if (plan%accuracy%asked > 0.0_wp) call asked_lines(lines, plan%accuracy)
      call lines%line("events     "//to_text(summary%count%events)//" located, "//to_text(summary%count%contacts)// &
                      " impacts; "//to_text(summary%count%samples)//" output times")
      if (sum(summary%count%rows(row_onset:row_jump)) > 0) then
         call lines%line("rows       "//to_text(sum(summary%count%rows(row_onset:row_jump)))//" additional output rows at "// &
            "contact events: "// &
                         to_text(summary%count%rows(row_onset))//" onsets, "//to_text(summary%count%rows(row_peak))//" peaks, "// &
                         to_text(summary%count%rows(row_end))//" separations, "//to_text(summary%count%rows(row_jump))//" jumps")
      else if (len(plan%contact_rows) > 0 .and. .not. plan%with%contact_rows) then
         call lines%line("rows       "//plan%contact_rows)
      end if
      call add_horizon(lines, plan%horizon)
      do k = 1, size(outcome%tables)
         call add_table(lines, outcome%tables(k))
      end do
      call lines%line("")
      call lines%line("output     "//plan%directory//"/")
      if (plan%with%hdf5) call lines%line("           run.h5")
      if (plan%with%motion) call lines%line("           motion.vtkhdf")
      call lines%line("           "//counted(size(outcome%files), "time history", "time histories")//" (.dat), events.dat")
      if (plan%with%csv) then
         call lines%line("           "//counted(size(outcome%csv), "comma-separated file", "comma-separated files")//" (.csv)")
      end if
      do k = 1, size(outcome%solids)
         call lines%line("           "//outcome%solids(k)%s)
      end do
      do k = 1, size(outcome%pictures)
         call lines%line("           "//outcome%pictures(k)%s)
      end do
      if (plan%with%report) call lines%line("           report.html")
      do k = 1, size(outcome%warnings)
         call lines%line("warning: "//outcome%warnings(k)%s)
      end do
      do k = 1, size(plan%notes)
         call lines%line("note: "//plan%notes(k)%s)
      end do
      text = lines%get()
   end function summary_lines

   !> How the run ended, and with what it was made.
   function headline(summary) result(line)
      type(summary_t), intent(in) :: summary  !! of the run
      character(:), allocatable :: line       !! one line

      type(display_unit_t) :: unit

      unit = choose_unit("s", max(abs(summary%time_start), abs(summary%time_end)))
      line = summary%status//": at "
      if (summary%time_end > summary%time_start) line = summary%status//": "//to_text(unit%factor*summary%time_start)//" to "
      line = line//to_text(unit%factor*summary%time_end)//" "//unit%symbol
      if (len(summary%method%integrator) > 0) line = line//", "//summary%method%integrator
      if (summary%method%tolerance > 0.0_wp) line = line//" at tolerance "//to_text(summary%method%tolerance)
      if (len(summary%method%solver) > 0) line = line//", solver "//summary%method%solver
      if (summary%method%stabilisation == "none") then
         line = line//", no stabilisation needed"
      else if (len(summary%method%stabilisation) > 0) then
         line = line//", stabilisation "//summary%method%stabilisation
      end if
   end function headline

   !> What the run cost.
   subroutine cost_lines(lines, summary)
      type(buffer_t), intent(inout) :: lines   !! the summary
      type(summary_t), intent(in) :: summary   !! of the run

      real(wp) :: each

      call lines%line("cost       "//real_text(summary%cpu_seconds, 4)//" s CPU, "// &
                      to_text(summary%count%steps)//" steps, "// &
                      to_text(summary%count%rejected_steps)//" rejected")
      call lines%add("           "//to_text(summary%count%rhs_evaluations)//" right-hand sides")
      if (summary%count%output_evaluations > 0) call lines%add(" ("//to_text(summary%count%output_evaluations)//" for output)")
      each = seconds_per_rhs(summary)
      if (ieee_is_finite(each)) call lines%add(", "//real_text(1.0e9_wp*each, 3)//" ns each")
      call lines%line(", "//to_text(summary%count%factorisations)//" factorisations")
      if (summary%groups > 1) call lines%line("           "//to_text(summary%groups)//" groups of bodies integrated separately")
   end subroutine cost_lines

   !> How right the run is.
   subroutine accuracy_lines(lines, summary)
      type(buffer_t), intent(inout) :: lines   !! the summary
      type(summary_t), intent(in) :: summary   !! of the run

      real(wp) :: relative

      if (summary%quality%has_ledger) then
         call lines%add("accuracy   energy residual "//real_text(summary%quality%energy_residual_max, 3)//" J")
         relative = relative_residual(summary)
         if (ieee_is_finite(relative)) call lines%add(", "//real_text(relative, 3)//" of the maximum energy ("// &
                                                      real_text(summary%quality%energy_max, 4)//" J)")
         call lines%line("")
      else
         call lines%line("accuracy   energy balance is off")
      end if
      call lines%line("           constraint violation "//real_text(summary%quality%violation_max, 3)//" m, rate "// &
                      real_text(summary%quality%violation_rate_max, 3)//" m/s, at the ends of steps")
   end subroutine accuracy_lines

   !> The summary for scripts.
   function summary_json(plan, summary, outcome) result(text)
      type(output_plan_t), intent(in) :: plan      !! what is known of the run
      type(summary_t), intent(in) :: summary       !! cost and errors of the run
      type(outcome_t), intent(in) :: outcome       !! what the run left behind
      character(:), allocatable :: text            !! one object

      type(json_object_t) :: json

      call json%start(0)
      call json%put_text("program", "gudgeon "//plan%origin%program_version)
      call json%put_text("git_sha1", plan%origin%git_sha1)
      call json%put_text("created", utc_time())
      call json%put_text("deck", plan%origin%deck_name)
      call json%put_object("parameters", parameter_object(plan))
      call json%put_text("title", plan%title)
      call json%put_text("directory", plan%directory)
      call json%put_integer("degrees_of_freedom", int(plan%n_freedom, i8))
      call json%put_real("assembly_moved", plan%moved)
      call put_tables(json, outcome%tables)
      if (allocated(summary%worn)) call put_wear_of_run(json, summary%worn, summary%time_end - summary%time_start)
      call json%put_list("files", outcome%files)
      if (plan%with%csv) call json%put_list("csv", outcome%csv)
      if (plan%with%worn_stl > 0.0_wp) call json%put_list("stl", outcome%solids)
      call json%put_list("figures", outcome%pictures)
      call json%put_list("warnings", outcome%warnings)
      call json%put_list("notes", plan%notes)
      text = json%get()//new_line("a")
   end function summary_json

   !> The parameters in force, as written.
   function parameter_object(plan) result(object)
      type(output_plan_t), intent(in) :: plan       !! what is known of the run
      character(:), allocatable :: object           !! as text

      type(json_object_t) :: json
      integer :: k

      call json%start(1)
      do k = 1, size(plan%origin%parameter_names)
         call json%put_text(plan%origin%parameter_names(k)%s, plan%origin%parameter_texts(k)%s)
      end do
      object = json%get()
   end function parameter_object

end module summary_writer
