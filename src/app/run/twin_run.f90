!> The motion of a mechanism with all its joints ideal, beside which figures show the run proper.
module twin_run
   use assembly_report, only: assembly_t
   use build_system, only: levels_ideal, new_system
   use dynamic, only: run_dynamic
   use errors, only: error_t
   use integrator, only: integrator_t
   use kinds, only: wp
   use load, only: loaded_t
   use mechanism, only: mechanism_t
   use output_plan, only: lifetime_t, show_nothing
   use recorder, only: summary_t
   use run_limits, only: twin_limits
   use run_recorder, only: run_recorder_t
   use scene_method, only: new_method
   use start_state, only: find_start, ideal_start_t
   use subsystems, only: new_subsystems, subsystem_t
   implicit none (type, external)
   private
   public :: run_twin

contains

   !> The mechanism with ideal joints, text files only, for the figures.
   subroutine run_twin(loaded, proper, ideal, error)
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(run_recorder_t), intent(inout) :: proper        !! recorder of the run proper, gets the curves of this one
      type(ideal_start_t), intent(inout) :: ideal          !! the start with ideal joints, if the run proper has found it
      type(error_t), allocatable, intent(out) :: error     !! there is no reference run

      class(integrator_t), allocatable :: method
      type(assembly_t) :: assembly
      type(mechanism_t) :: system
      type(run_recorder_t) :: keeper
      type(subsystem_t), allocatable :: subsystems(:)
      type(summary_t) :: summary
      real(wp), allocatable :: y(:)

      call new_system(loaded%scene, levels_ideal, system)
      if (size(system%linkage%ideal) == 0) return  ! no joint is another without clearance
      call find_start(loaded%scene, levels_ideal, system, y, assembly, error, ideal=ideal)
      if (allocated(error)) return
      call new_method(loaded%scene, method)
      keeper%plan = proper%plan
      keeper%figures = proper%figures
      keeper%rows%labels = proper%rows%labels
      keeper%plan%suffix = ".ideal"
      keeper%plan%life = lifetime_t()
      keeper%plan%with%hdf5 = .false.
      keeper%plan%with%summary = .false.
      keeper%plan%with%motion = .false.
      keeper%plan%with%figures = .false.
      keeper%plan%with%report = .false.
      keeper%plan%with%progress = .false.
      keeper%plan%show = show_nothing
      call new_subsystems(loaded%scene, levels_ideal, system, method, loaded%plan%end, subsystems)
      call run_dynamic(system, method, subsystems, y, loaded%plan, twin_limits(loaded%scene, system), keeper, summary, &
                       error)
      proper%ideal_rows = keeper%rows
   end subroutine run_twin

end module twin_run
