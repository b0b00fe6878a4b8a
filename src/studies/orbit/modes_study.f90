!> A study of modes: the modes of a deck at a state, its matrices, and its Campbell diagram.
module modes_study
   use campbell, only: find_campbell
   use catalogue, only: catalogue_t
   use eigenmodes, only: find_modes
   use errors, only: error_t, exit_integration, exit_usage, set_error
   use jobs, only: job_t
   use kinds, only: wp
   use linear_model, only: linearise
   use linear_state, only: find_state, linear_state_t
   use mechanism_catalogue, only: bind_channels, build_catalogue
   use mechanism, only: mechanism_t
   use modes_results, only: input_driver, modes_input_t, modes_study_t
   use parameter_source, only: parameter_source_t
   use text, only: append_text, real_text
   implicit none (type, external)
   private
   public :: study_modes

   real(wp), parameter :: at_rest = 1.0e-6_wp     !! free acceleration, of that of the loads, that is none [1]
   real(wp), parameter :: steady = 1.0e-6_wp      !! turning of directions, of the speeds, that is none [1]

contains

   !> Find state, matrices, modes and diagram.
   subroutine study_modes(job, source, study, error)
      type(job_t), intent(in) :: job                               !! the deck
      class(parameter_source_t), intent(inout) :: source           !! the deck with other values of the parameter
      type(modes_study_t), intent(inout) :: study                  !! the plan is set, the rest follows
      type(error_t), allocatable, intent(out) :: error             !! there is no such state

      type(linear_state_t), target :: state
      type(catalogue_t) :: catalogue
      integer, allocatable :: channels(:, :), place(:)
      integer :: k, status

      call find_state(job, study%plan, state, error)
      if (allocated(error)) return
      associate (system => state%mover%system)
         study%t = state%t
         study%state = state%words
         study%warnings = state%warnings
         study%bodies = system%linkage%bodies%names
         study%n_body = system%linkage%bodies%n
         call name_components()
         call build_catalogue(system, catalogue)
         do k = 1, size(catalogue%groups)
            catalogue%groups(k)%is_wanted = .false.
         end do
         call find_drivers(system, study%plan%inputs)
         allocate (channels(3, size(study%plan%outputs)), place(size(study%plan%outputs)))
         do k = 1, size(study%plan%outputs)
            associate (output => study%plan%outputs(k))
               channels(:, k) = [catalogue%find_group(output%item_group, output%channel), output%component, output%item]
               if (channels(1, k) > 0) catalogue%groups(channels(1, k))%is_wanted(channels(3, k)) = .true.
            end associate
         end do
         if (any(channels(1, :) == 0)) then
            call set_error(error, exit_usage, "channel '"//study%plan%outputs(findloc(channels(1, :), 0, dim=1))%name// &
                           "' is not there at "//state%words)
            return
         end if
         call bind_channels(system, catalogue)
         do k = 1, size(place)
            place(k) = catalogue%place(channels(1, k), channels(2, k), channels(3, k))
         end do
         call linearise(system, state%t, state%y, study%plan%axes, study%plan%inputs, place, catalogue, study%model, status)
         if (status /= 0) then
            call set_error(error, exit_integration, "the equations cannot be solved beside "//state%words)
            return
         end if
         call find_modes(system, study%model, study%modes)
      end associate
      call judge_state(study)
      allocate (study%points(0), study%onsets(0))
      if (study%plan%parameter /= "") call find_campbell(source, study, error)

   contains

      !> Names of the directions of a body: those of displacements, then turns.
      subroutine name_components()
         character(*), parameter :: planar(3) = [character(5) :: "x", "y", "angle"]
         character(*), parameter :: spatial(6) = [character(2) :: "x", "y", "z", "rx", "ry", "rz"]
         integer :: j

         associate (n_v => state%mover%system%linkage%coordinates%n_v)
            allocate (study%components(n_v))
            do j = 1, n_v
               if (n_v == size(planar)) study%components(j)%s = trim(planar(j))
               if (n_v == size(spatial)) study%components(j)%s = trim(spatial(j))
            end do
         end associate
      end subroutine name_components

   end subroutine study_modes

   !> Rows of the drivers that are inputs.
   subroutine find_drivers(system, inputs)
      type(mechanism_t), intent(in) :: system             !! the system
      type(modes_input_t), intent(inout) :: inputs(:)     !! (n) rows are set

      integer :: i, j, k

      do k = 1, size(inputs)
         if (inputs(k)%kind /= input_driver) cycle
         do j = 1, size(system%linkage%joints)
            associate (set => system%linkage%joints(j)%set)
               if (.not. set%is_driver) cycle
               do i = 1, set%n
                  if (set%names(i)%s == inputs(k)%name) inputs(k)%row = set%first_row + (i - 1)*set%n_row_item + 1
               end do
            end associate
         end do
         inputs(k)%is_angle = system%linkage%rows%is_angle(inputs(k)%row)
      end do
   end subroutine find_drivers

   !> Warn where the state is no equilibrium, or the directions turn.
   subroutine judge_state(study)
      type(modes_study_t), intent(inout) :: study      !! warnings are added

      associate (model => study%model)
         if (model%residual > at_rest) call append_text(study%warnings, "the state is not an equilibrium: loads of " &
            //real_text(model%residual, 3)//" of the forces that act are not balanced; the eigenvalues are those of the instant")
         if (model%moving > 0) call append_text(study%warnings, model%others(model%moving)%s//" changes at the state; the "// &
                                                "eigenvalues are those of the instant")
         if (model%unsteady > steady .and. model%n_free > 0) call append_text(study%warnings, "the motion is not steady in axes " &
            //study%plan%axes_name//": directions turn by "//real_text(model%unsteady, 3)//" of the speeds; the eigenvalues are " &
            //"those of the instant")
      end associate
   end subroutine judge_state

end module modes_study
