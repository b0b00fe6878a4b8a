!> All results of a run as tables, in the order in which summaries, report.html and run.h5 have them.
!>
!> A new result is a table, and a line here.
module run_tables
   use accuracy_table, only: table_of_accuracy
   use catalogue, only: catalogue_t
   use event_list, only: event_list_t
   use extremes, only: extremes_t, joint_extremes_t
   use extremes_tables, only: channel_extremes, joint_extremes
   use films_table, only: tables_of_films
   use forces_table, only: largest_forces
   use horizon_table, only: table_of_horizon
   use impacts_table, only: first_impacts
   use kinds, only: wp
   use output_plan, only: output_plan_t
   use precision_text, only: growth_words
   use recorder, only: summary_t
   use result_table, only: result_table_t
   use statistics, only: number_t, statistics_t
   use statistics_tables, only: tables_of_statistics
   use summary_table, only: table_of_cost, table_of_summary
   use table_list, only: append_tables, list_of
   use wear_tables, only: tables_of_wear
   implicit none (type, external)
   private
   public :: tables_of_run

contains

   !> The tables.
   function tables_of_run(plan, summary, statistics, numbers, extremes, joints, catalogue, events) result(tables)
      type(output_plan_t), intent(in) :: plan            !! what is known before the run
      type(summary_t), intent(in) :: summary             !! cost and errors
      type(statistics_t), intent(in) :: statistics       !! what was gathered for the statistics
      type(number_t), intent(in) :: numbers(:)           !! (any) the statistics
      type(extremes_t), intent(in) :: extremes           !! what the channels went through
      type(joint_extremes_t), intent(in) :: joints(:)    !! (any) what the joints with clearance went through
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(event_list_t), intent(in) :: events           !! all events
      type(result_table_t), allocatable :: tables(:)     !! (any) the results

      tables = list_of(table_of_summary(summary), table_of_cost(summary))
      call append_tables(tables, tables_of_films(summary%linear))
      call append_tables(tables, tables_of_wear(summary%worn))
      if (plan%accuracy%asked > 0.0_wp) then
         call append_tables(tables, list_of(table_of_accuracy(plan%accuracy, growth_words(plan%accuracy%growth))))
      end if
      if (allocated(plan%horizon%t)) then
         call append_tables(tables, list_of(table_of_horizon(plan%horizon)))
         tables(size(tables))%group = ""  ! in run.h5 since the start
      end if
      call append_tables(tables, tables_of_statistics(statistics, numbers, catalogue, events, summary%time_end))
      call append_tables(tables, list_of(largest_forces(extremes, catalogue), joint_extremes(joints, extremes%has_course()), &
                                         channel_extremes(extremes, catalogue), first_impacts(events)))
   end function tables_of_run

end module run_tables
