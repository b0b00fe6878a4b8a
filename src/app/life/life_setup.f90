!> From a deck to what a life is asked, and to its simulations.
module life_setup
   use deck_rates, only: deck_rates_t
   use diagnostics, only: diagnostics_t
   use columns, only: cell_index
   use errors, only: error_t, exit_usage, set_error
   use channel_names, only: scalar_t
   use item, only: place_of
   use kinds, only: wp
   use life_results, only: life_plan_t
   use life_times, only: find_spans
   use load, only: loaded_t
   use posix, only: n_processors
   use options, only: options_t
   use run_limits, only: find_scalars, limits_of, words_of
   use read_worn, only: find_worn_mistake
   use scene, only: analysis_dynamic
   use text, only: append_text, text_t
   use wear_monitor, only: new_wear_monitor, wear_monitor_t
   use wear_loads, only: most_nodes, n_load
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: check_request, set_up_life

contains

   !> A life needs its section, a motion and a joint that wears.
   subroutine check_request(loaded, error)
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! what is missing

      if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "a life needs [analysis.dynamic] as the first analysis section of the deck")
      else if (.not. loaded%scene%settings%life%is_present) then
         call set_error(error, exit_usage, "the deck has no section [life]"//new_line("a")// &
                        "  = see 'gudgeon help life'; 'gudgeon run' gives the wear of one run")
      else if (loaded%system%n_wear == 0) then
         call set_error(error, exit_usage, "nothing wears: no joint with clearance names a wear law"//new_line("a")// &
                        "  = give a table [wear.archard] and the column wear of [clearance.revolute]")
      else
         call check_joints(loaded, error)
      end if
   end subroutine check_request

   !> The joints that wear must be such that their contact can be one of worn surfaces.
   subroutine check_joints(loaded, error)
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! the first that is not

      character(:), allocatable :: help, mark, message
      integer :: i, k

      do k = 1, size(loaded%scene%clearances)
         associate (table => loaded%scene%clearances(k))
            do i = 1, size(table%items)
               if (cell_index(table%info, table%items(i), "wear") == 0) cycle
               call find_worn_mistake(table%items(i), message, mark, help)
               if (message == "") cycle
               call set_error(error, exit_usage, message//" in a life"//new_line("a")//"  = "//help)
               return
            end do
         end associate
      end do
   end subroutine check_joints

   !> Set up the simulations.
   subroutine set_up_life(options, loaded, source, surfaces, warnings)
      type(options_t), intent(in) :: options                         !! the command line
      type(loaded_t), intent(inout) :: loaded                        !! the deck; its limits are set
      type(deck_rates_t), intent(inout) :: source                    !! the simulations; journal and directory are not set
      type(worn_surface_t), allocatable, intent(out) :: surfaces(:)  !! (surfaces) at the start
      type(text_t), allocatable, intent(inout) :: warnings(:)        !! (any) grown

      type(diagnostics_t) :: ignored  ! there are no errors: the section was checked when the deck was loaded
      type(wear_monitor_t) :: monitor

      call limits_of(loaded%scene, loaded%catalogue, loaded%limits, warnings)
      call find_spans(loaded%scene, loaded%system, source%spans, ignored)
      allocate (surfaces(0))
      call new_wear_monitor(loaded%system, monitor)
      call monitor%add_surfaces(loaded%system, surfaces)
      call source%state%start(surfaces)
      source%job = loaded%job_t
      source%has_ensemble = loaded%scene%settings%ensemble%is_present
      source%jobs = options%runs%jobs
      if (source%jobs == 0) source%jobs = n_processors()
      call take_settings(loaded, surfaces, source)
      call take_laws(loaded, surfaces, source%plan, warnings)
      if (source%plan%ends%cycles < huge(1.0_wp)) source%plan%stretch = maxval(source%plan%spreads)
   end subroutine set_up_life

   !> The settings of the section.
   subroutine take_settings(loaded, surfaces, source)
      type(loaded_t), intent(in) :: loaded             !! the deck
      type(worn_surface_t), intent(in) :: surfaces(:)  !! (surfaces) at the start
      type(deck_rates_t), intent(inout) :: source      !! its plan is set, but for the laws

      type(scalar_t), allocatable :: scalars(:)
      character(:), allocatable :: hint, message
      integer :: k

      associate (life => loaded%scene%settings%life, plan => source%plan, ends => source%plan%ends, span => source%spans(1))
         plan%measured = nint(life%number("measure"))
         plan%cycle = (span%to - span%from)/plan%measured
         plan%tolerance = life%number("tolerance")
         plan%depth_tolerance = life%number("depth_tolerance")
         plan%n_loads = n_load*most_nodes*(size(surfaces)/2)
         plan%simulations = nint(life%number("simulations"))
         if (source%has_ensemble) plan%starts = nint(loaded%scene%settings%ensemble%number("runs"))
         if (life%number("cycles") > 0.0_wp) ends%cycles = life%number("cycles")
         if (life%number("time") > 0.0_wp) ends%cycles = min(ends%cycles, life%number("time")/plan%cycle)
         if (life%number("depth") > 0.0_wp) ends%depth = life%number("depth")
         if (life%number("clearance") > 0.0_wp) ends%clearance = life%number("clearance")
         plan%clearances = surfaces(1::2)%radius - surfaces(2::2)%radius
         associate (conditions => life%values(place_of(life, "stop"))%conditions)
            allocate (ends%extremes(size(conditions)))
            do k = 1, size(conditions)
               call find_scalars(conditions(k), loaded%catalogue, scalars, message, hint)
               ends%extremes(k)%words = words_of(conditions(k), loaded%catalogue)
               ends%extremes(k)%place = [scalars(1)%group, scalars(1)%component, scalars(1)%item]
               ends%extremes(k)%is_above = conditions(k)%is_above
               ends%extremes(k)%limit = conditions(k)%limit
            end do
         end associate
      end associate
   end subroutine take_settings

   !> What the wear laws say of their coefficients.
   subroutine take_laws(loaded, surfaces, plan, warnings)
      type(loaded_t), intent(in) :: loaded                      !! the deck
      type(worn_surface_t), intent(in) :: surfaces(:)           !! (surfaces) at the start
      type(life_plan_t), intent(inout) :: plan                  !! the spreads are set
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) grown

      integer :: i, k, s
      logical :: runs_in

      allocate (plan%spreads(size(surfaces)), source=1.0_wp)
      runs_in = .false.
      do k = 1, size(loaded%system%clearance_joints%sets)
         associate (set => loaded%system%clearance_joints%sets(k)%set)
            if (.not. allocated(set%laws%wear)) cycle
            do i = 1, size(set%names)
               do s = 1, size(surfaces)
                  if (surfaces(s)%joint == set%names(i)%s) plan%spreads(s) = set%laws%wear%spread
               end do
            end do
            runs_in = runs_in .or. (set%laws%wear%running_in > 0.0_wp .and. set%laws%wear%spread > 1.0_wp)
         end associate
      end do
      if (any(plan%spreads /= plan%spreads(1))) then
         call append_text(warnings, "wear laws differ in their spread: each joint has its own range, without what the wear of "// &
                          "one does to another")
      end if
      if (runs_in) call append_text(warnings, "spread of a law with running_in: its range is an estimate, because the "// &
                                    "coefficient depends on the distance too")
   end subroutine take_laws

end module life_setup
