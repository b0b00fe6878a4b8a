!> Runs of analyses that integrate nothing: motions that drivers prescribe, and equilibrium.
submodule(verb_run) verb_run_at_rest
   use assembly_report, only: assembly_t
   use figure_words, only: append_figure, figure_film, figure_t
   use kinematic, only: run_kinematic
   use kinematic_start, only: find_kinematic_start
   use mobility, only: mobility_t
   use motion_run, only: check_member, end_as_asked
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use prescribed_motion, only: newton_t
   use processes, only: listen
   use recorder, only: summary_t
   use run_plan, only: make_plan
   use run_recorder, only: run_recorder_t
   use static, only: equilibrium_t, find_equilibrium, record_equilibrium
   use text, only: append_text
   implicit none (type, external)

contains

   !> Motion prescribed by drivers.
   module procedure run_prescribed
      type(assembly_t) :: assembly
      type(mobility_t) :: mobility
      type(newton_t) :: newton
      type(output_directory_t) :: directory
      type(run_recorder_t) :: keeper
      type(summary_t) :: summary
      real(wp), allocatable :: q(:)
      real(wp) :: limit_cpu

      call check_member(options, loaded, error)
      if (allocated(error)) return
      associate (settings => loaded%scene%settings%kinematic)
         newton%tolerance = settings%number("tolerance")
         newton%most = nint(settings%number("maximum_iterations"))
      end associate
      call find_kinematic_start(loaded%scene, loaded%system, q, assembly, mobility, error)
      if (allocated(error)) return
      call directory%open(directory_of(options, loaded), error)
      if (allocated(error)) return
      call make_plan(options, loaded, directory, assembly, keeper%plan, keeper%figures)
      limit_cpu = loaded%scene%settings%kinematic%number("limit_cpu")
      keeper%plan%life%is_saved = .true.
      call listen(.true.)
      call run_kinematic(loaded%system, q, loaded%plan, newton, limit_cpu, keeper, summary, error)
      call listen(.false.)
      call directory%close()
      call end_as_asked(summary, error)
   end procedure run_prescribed

   !> Equilibrium at rest.
   module procedure run_equilibrium
      type(assembly_t) :: assembly
      type(equilibrium_t) :: equilibrium
      type(output_directory_t) :: directory
      type(run_recorder_t) :: keeper
      type(summary_t) :: summary
      real(wp), allocatable :: q(:), v(:)

      call check_member(options, loaded, error)
      if (allocated(error)) return
      call loaded%system%linkage%deck_state(q, v)
      call find_equilibrium(loaded%scene, loaded%system, q, assembly, equilibrium, error)
      if (allocated(error)) return
      call directory%open(directory_of(options, loaded), error)
      if (allocated(error)) return
      call make_plan(options, loaded, directory, assembly, keeper%plan, keeper%figures)
      call keep_films(keeper%plan, keeper%figures)
      call record_equilibrium(loaded%system, equilibrium, keeper, summary, error)
      call directory%close()
   end procedure run_equilibrium

   !> Of an equilibrium there are figures of films only; a warning for the others.
   subroutine keep_films(plan, figures)
      type(output_plan_t), intent(inout) :: plan                 !! plan of the run
      type(figure_t), allocatable, intent(inout) :: figures(:)   !! (n) its figures

      type(figure_t), allocatable :: films(:)
      integer :: k

      allocate (films(0))
      do k = 1, size(figures)
         if (figures(k)%kind == figure_film) call append_figure(films, figures(k))
      end do
      if (size(films) < size(figures)) then
         call append_text(plan%warnings, "figures omitted: an equilibrium has no time history")
      end if
      plan%with%figures = plan%with%figures .and. size(films) > 0
      call move_alloc(films, figures)
   end subroutine keep_films

end submodule verb_run_at_rest
