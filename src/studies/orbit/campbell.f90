!> The Campbell diagram of a mechanism: its eigenvalues over a parameter, and the values at which it becomes unstable or stable.
!>
!> Between two neighbouring values, where the greatest real part changes its sign, its zero is found by the Illinois method.
!> Eigenvalues of neighbouring values that are nearest to each other are of one branch.
!> Source: M. Dowell and P. Jarratt, BIT 11 (1971) 168-174; Friswell et al., Dynamics of Rotating Machines (2010), section 3.7.
!> Limits: two changes between neighbouring values are not seen; branches may be exchanged where they come close.
module campbell
   use catalogue, only: catalogue_t
   use eigenmodes, only: find_modes, follow_branches, growth_of
   use errors, only: error_t, exit_assembly, set_error
   use jobs, only: first_line, job_t
   use kinds, only: wp
   use linear_model, only: linearise
   use linear_state, only: find_state, linear_state_t
   use modes_results, only: campbell_point_t, linear_model_t, mode_t, modes_input_t, modes_plan_t, modes_study_t, no_growth, &
      onset_t
   use parameter_source, only: parameter_source_t
   use text, only: append_text, real_text
   implicit none (type, external)
   private
   public :: find_campbell

   integer, parameter :: the_parameter = 1          !! its number in the source
   integer, parameter :: most = 60                  !! steps of a bracket
   real(wp), parameter :: close = 1.0e-10_wp        !! width of a bracket in the end, of the range [1]

contains

   !> Find the diagram. A value without such a state is left out, with a warning.
   subroutine find_campbell(source, study, error)
      class(parameter_source_t), intent(inout) :: source           !! where decks with other values come from
      type(modes_study_t), intent(inout) :: study                  !! points, onsets and warnings are set
      type(error_t), allocatable, intent(out) :: error             !! no value has a state

      type(campbell_point_t) :: point
      character(:), allocatable :: reason
      real(wp) :: p
      integer :: k, n_branch

      n_branch = 0
      associate (plan => study%plan)
         do k = 1, plan%n_point
            p = plan%from + (plan%to - plan%from)*real(k - 1, wp)/real(max(1, plan%n_point - 1), wp)
            call find_point(source, plan, p, point, reason, error)
            if (reason /= "") call append_text(study%warnings, plan%parameter//" = "//real_text(p, 6)//" "//plan%unit//": "//reason)
            if (allocated(error)) then
               if (k < plan%n_point .or. size(study%points) > 0) deallocate (error)
               cycle
            end if
            allocate (point%branch(size(point%eigenvalues)))
            if (size(study%points) == 0) then
               n_branch = 0
               call follow_branches([complex(wp) ::], [integer ::], point%eigenvalues, point%branch, n_branch)
            else
               n_branch = maxval(most_branch(study%points))
               associate (before => study%points(size(study%points)))
                  call follow_branches(before%eigenvalues, before%branch, point%eigenvalues, point%branch, n_branch)
                  call find_onset(source, plan, before, point, study%onsets)
               end associate
            end if
            study%points = [study%points, point]
         end do
      end associate
   end subroutine find_campbell

   !> Greatest branch of each point.
   pure function most_branch(points) result(branch)
      type(campbell_point_t), intent(in) :: points(:)    !! (n) points
      integer :: branch(size(points))                    !! (n) their greatest branches

      integer :: k

      do k = 1, size(points)
         branch(k) = maxval([0, points(k)%branch])
      end do
   end function most_branch

   !> Eigenvalues at a value.
   subroutine find_point(source, plan, p, point, reason, error)
      class(parameter_source_t), intent(inout) :: source           !! where decks with other values come from
      type(modes_plan_t), intent(in) :: plan                       !! what is asked for
      real(wp), intent(in) :: p                                    !! the value [any]
      type(campbell_point_t), intent(out) :: point                 !! eigenvalues by frequency, no branches
      character(:), allocatable, intent(out) :: reason             !! why the modes were not found; blank: they were
      type(error_t), allocatable, intent(out) :: error             !! the same

      type(linear_state_t), target :: state
      type(job_t) :: job
      type(catalogue_t) :: nothing
      type(linear_model_t) :: model
      type(mode_t), allocatable :: modes(:)
      type(modes_input_t) :: none(0)
      integer :: k, status

      point%p = p
      call source%make(the_parameter, p, job, reason)
      if (reason == "") call find_state(job, plan, state, error)
      if (allocated(error)) reason = first_line(error%message)
      if (reason == "") then
         call linearise(state%mover%system, state%t, state%y, plan%axes, none, [integer ::], nothing, model, status)
         if (status /= 0) reason = "the equations cannot be solved there"
      end if
      if (reason /= "") then
         if (.not. allocated(error)) call set_error(error, exit_assembly, reason)
         return
      end if
      call find_modes(state%mover%system, model, modes)
      point%eigenvalues = [(modes(k)%eigenvalue, k=1, size(modes))]
   end subroutine find_point

   !> The value between two points at which the greatest real part changes its sign, if it does.
   subroutine find_onset(source, plan, before, point, onsets)
      class(parameter_source_t), intent(inout) :: source           !! where decks with other values come from
      type(modes_plan_t), intent(in) :: plan                       !! what is asked for
      type(campbell_point_t), intent(in) :: before, point          !! neighbours
      type(onset_t), allocatable, intent(inout) :: onsets(:)       !! (n) one more, if there is one

      type(campbell_point_t) :: middle
      type(error_t), allocatable :: error
      type(onset_t) :: onset
      character(:), allocatable :: reason
      real(wp) :: g(2), growth, p(2)
      integer :: k, which

      if (size(before%eigenvalues) == 0 .or. size(point%eigenvalues) == 0) return
      p = [before%p, point%p]
      call growth_of(before%eigenvalues, g(1), which)
      call growth_of(point%eigenvalues, g(2), which)
      if (abs(g(1)) <= no_growth*maxval(abs(before%eigenvalues))) return
      if (abs(g(2)) <= no_growth*maxval(abs(point%eigenvalues))) return
      if (g(1)*g(2) > 0.0_wp) return
      onset%is_loss = g(1) < 0.0_wp
      do k = 1, most
         call find_point(source, plan, (p(1)*g(2) - p(2)*g(1))/(g(2) - g(1)), middle, reason, error)
         if (reason /= "") return
         call growth_of(middle%eigenvalues, growth, which)
         onset%p = middle%p
         onset%eigenvalue = middle%eigenvalues(which)
         if (.not. abs(growth) > 0.0_wp) exit
         if (growth*g(2) < 0.0_wp) then
            p(1) = p(2)
            g(1) = g(2)
         else
            g(1) = 0.5_wp*g(1)
         end if
         if (abs(middle%p - p(2)) <= close*abs(plan%to - plan%from)) exit
         p(2) = middle%p
         g(2) = growth
      end do
      onsets = [onsets, onset]
   end subroutine find_onset

end module campbell
