!> How a run went: summary.txt for people, summary.json for scripts.
module summary_writer
   use accuracy_text, only: accuracy_json, asked_lines, extreme_lines
   use catalogue, only: catalogue_t
   use channel_noise, only: known_text, shown
   use display_units, only: choose_unit, display_unit_t
   use event_list, only: event_list_t, number_names
   use extremes, only: extremes_t, joint_extremes_t
   use extremes_tables, only: channel_extremes, joint_extremes
   use extremes_text, only: channel_table, joint_table
   use horizon_table, only: table_of_horizon
   use horizon_text, only: add_horizon
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use json_table, only: put_facts, put_rows
   use json_text, only: json_object_t
   use kinds, only: i8, wp
   use linear_text, only: linear_json, linear_lines
   use output_plan, only: output_plan_t
   use plot_text, only: valid_utf8
   use posix, only: utc_time
   use recorder, only: row_end, row_jump, row_onset, row_peak, status_complete, summary_t
   use statistics, only: number_t
   use summary_table, only: relative_residual, seconds_per_rhs, table_of_cost, table_of_summary
   use text, only: append_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_table, only: one_line
   implicit none (type, external)
   private
   public :: accuracy_lines, complete_summary, cost_lines, first_impacts, headline, outcome_t, summary_json, summary_lines

   integer, parameter :: most_impacts = 5          !! rows of the table of first impacts
   integer, parameter :: most_channels = 1000      !! rows of the table of extremes in summary.json
   real(wp), parameter :: worth_telling = 1.0e-6_wp  !! way of a body in the assembly [m]
   character(*), parameter :: kind_contact = "contact"  !! kind of event that is an impact

   !> What a run left behind besides its numbers.
   type :: outcome_t
      type(text_t), allocatable :: files(:)     !! (n) files of data, paths within the directory
      type(text_t), allocatable :: csv(:)       !! (any) those of them that are comma-separated too
      type(text_t), allocatable :: pictures(:)  !! (m) pictures, paths within the directory
      type(number_t), allocatable :: numbers(:) !! (l) the statistics
      type(text_t), allocatable :: warnings(:)  !! (k) what a careful reader should know, and what was not made
      type(extremes_t) :: extremes              !! what the channels went through
      type(joint_extremes_t), allocatable :: joints(:)  !! (j) what the clearance joints went through
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
   function summary_lines(plan, summary, events, outcome, catalogue) result(text)
      type(output_plan_t), intent(in) :: plan      !! what is known of the run
      type(summary_t), intent(in) :: summary       !! cost and errors
      type(event_list_t), intent(in) :: events     !! all events
      type(outcome_t), intent(in) :: outcome       !! what the run left behind
      type(catalogue_t), intent(in) :: catalogue   !! what could be recorded
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
      if (plan%accuracy%asked > 0.0_wp) call extreme_lines(lines, plan%accuracy)
      call add_horizon(lines, plan%horizon)
      call impact_lines(lines, events)
      if (outcome%extremes%has_course()) call joint_table(lines, outcome%joints)
      call channel_table(lines, outcome%extremes, catalogue)
      call number_lines(lines, plan, outcome%numbers)
      call lines%line("")
      call lines%line("output     "//plan%directory//"/")
      if (plan%with%hdf5) call lines%line("           run.h5")
      call lines%line("           "//to_text(size(outcome%files))//" time histories (.dat), events.dat")
      if (plan%with%csv) call lines%line("           "//to_text(size(outcome%csv))//" comma-separated files (.csv)")
      do k = 1, size(outcome%pictures)
         call lines%line("           "//outcome%pictures(k)%s)
      end do
      if (plan%with%report) call lines%line("           report.html")
      do k = 1, size(outcome%warnings)
         call lines%line("warning: "//outcome%warnings(k)%s)
      end do
      text = lines%get()
   end function summary_lines

   !> How the run ended, and with what it was made.
   function headline(summary) result(line)
      type(summary_t), intent(in) :: summary  !! of the run
      character(:), allocatable :: line       !! one line

      type(display_unit_t) :: unit

      unit = choose_unit("s", max(abs(summary%time_start), abs(summary%time_end)))
      line = summary%status//": "//to_text(unit%factor*summary%time_start)//" to "// &
             to_text(unit%factor*summary%time_end)//" "//unit%symbol
      if (len(summary%method%integrator) > 0) line = line//", "//summary%method%integrator
      if (summary%method%tolerance > 0.0_wp) line = line//" at tolerance "//to_text(summary%method%tolerance)
      if (len(summary%method%solver) > 0) line = line//", "//summary%method%solver
      if (len(summary%method%stabilisation) > 0) line = line//", "//summary%method%stabilisation
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
                      real_text(summary%quality%violation_rate_max, 3)//" m/s")
   end subroutine accuracy_lines

   !> Numbers of the first contacts, in the order of their onsets.
   function first_impacts(events, most) result(list)
      type(event_list_t), intent(in) :: events  !! all events
      integer, intent(in) :: most               !! at most so many
      integer, allocatable :: list(:)           !! (n) numbers of events

      integer, allocatable :: order(:)
      integer :: k

      allocate (list(0))
      order = events%order_by_onset()
      do k = 1, size(order)
         if (size(list) == most) exit
         if (events%word(order(k), 1) == kind_contact) list = [list, order(k)]
      end do
   end function first_impacts

   !> The table of first impacts.
   subroutine impact_lines(lines, events)
      type(buffer_t), intent(inout) :: lines     !! the summary
      type(event_list_t), intent(in) :: events   !! all events

      integer, allocatable :: list(:)
      character(:), allocatable :: item
      integer :: k

      list = first_impacts(events, most_impacts)
      if (size(list) == 0) return
      call lines%line("")
      call lines%line("first impacts     onset [s]   speed [m/s]   peak force [N]   duration [s]   joint")
      do k = 1, size(list)
         item = events%word(list(k), 2)
         if (len_trim(events%word(list(k), 3)) > 0) item = item//"."//events%word(list(k), 3)
         associate (numbers => events%numbers(:, list(k)))
            call lines%line(right(known_text(numbers(1), 9), 27)//right(known_text(numbers(2), 7), 14)// &
                            right(known_text(numbers(3), 8), 17)//right(ended(numbers(5)), 15)//"   "//item)
         end associate
      end do
   end subroutine impact_lines

   !> The statistics.
   subroutine number_lines(lines, plan, numbers)
      type(buffer_t), intent(inout) :: lines     !! the summary
      type(output_plan_t), intent(in) :: plan    !! what is known of the run
      type(number_t), intent(in) :: numbers(:)   !! (any) the statistics

      character(:), allocatable :: name
      integer :: k

      if (size(numbers) == 0) return
      call lines%line("")
      call lines%line("statistics from "//real_text(plan%statistics%after, 9)//" s on")
      do k = 1, size(numbers)
         name = numbers(k)%name
         if (numbers(k)%unit /= "1") name = name//" ["//numbers(k)%unit//"]"
         call lines%line("           "//name//right(known_text(shown(numbers(k)%value, numbers(k)%noise), 9), &
                                                    max(58 - len(name), 2)))
      end do
   end subroutine number_lines

   !> A duration as text.
   pure function ended(duration) result(s)
      real(wp), intent(in) :: duration   !! of a contact; NaN: not ended [s]
      character(:), allocatable :: s     !! the number, or words

      s = "in contact"
      if (ieee_is_finite(duration)) s = real_text(duration, 6)
   end function ended

   !> A string moved to the right end of a field.
   pure function right(string, width) result(s)
      character(*), intent(in) :: string   !! any string
      integer, intent(in) :: width         !! of the field
      character(:), allocatable :: s       !! never shorter than the string

      s = repeat(" ", max(width - len(string), 1))//string
   end function right

   !> The summary for scripts.
   function summary_json(plan, summary, events, outcome, catalogue) result(text)
      type(output_plan_t), intent(in) :: plan      !! what is known of the run
      type(summary_t), intent(in) :: summary       !! cost and errors
      type(event_list_t), intent(in) :: events     !! all events
      type(outcome_t), intent(in) :: outcome       !! what the run left behind
      type(catalogue_t), intent(in) :: catalogue   !! what could be recorded
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
      call put_facts(json, table_of_summary(summary))
      call put_facts(json, table_of_cost(summary))
      call linear_json(json, summary%linear)
      if (plan%accuracy%asked > 0.0_wp) call json%put_object("accuracy", accuracy_json(plan%accuracy))
      if (allocated(plan%horizon%t)) call put_facts(json, table_of_horizon(plan%horizon))
      if (plan%statistics%is_wanted) call json%put_object("statistics", numbers_object(outcome%numbers))
      call put_rows(json, joint_extremes(outcome%joints), 1)
      call put_rows(json, channel_extremes(outcome%extremes, catalogue), 1, most_channels)
      call json%put_objects("first_impacts", impact_objects(events))
      call json%put_list("files", outcome%files)
      if (plan%with%csv) call json%put_list("csv", outcome%csv)
      call json%put_list("figures", outcome%pictures)
      call json%put_list("warnings", outcome%warnings)
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

   !> The statistics as an object.
   function numbers_object(numbers) result(object)
      type(number_t), intent(in) :: numbers(:)      !! (any) the statistics
      character(:), allocatable :: object           !! as text

      type(json_object_t) :: json
      integer :: k

      call json%start(1)
      do k = 1, size(numbers)
         call json%put_real(numbers(k)%name, numbers(k)%value)
      end do
      object = json%get()
   end function numbers_object

   !> The first impacts as objects.
   function impact_objects(events) result(objects)
      type(event_list_t), intent(in) :: events      !! all events
      type(text_t), allocatable :: objects(:)       !! (n) objects as text

      integer, allocatable :: list(:)
      integer :: i, k

      allocate (objects(0))
      list = first_impacts(events, most_impacts)
      do k = 1, size(list)
         block
            type(json_object_t) :: json

            call json%start(1)
            call json%put_text("item", events%word(list(k), 2))
            call json%put_text("contact", events%word(list(k), 3))
            do i = 1, size(number_names)
               call json%put_real(trim(number_names(i)), events%numbers(i, list(k)))
            end do
            call append_text(objects, json%get())
         end block
      end do
   end function impact_objects

end module summary_writer
