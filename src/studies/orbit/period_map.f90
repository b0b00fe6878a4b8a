!> The map of a period and its derivative: free components of the state after a period from those at its start.
!>
!> $$ z_1 = P(z_0; p), \qquad M = \frac{\partial P}{\partial z_0}, \qquad P_p = \frac{\partial P}{\partial p} + \dot z(T) T'(p) $$
!>
!> The derivatives go along with the motion as those of results do (`sensitivity_column`): each step's own map is derived, through
!> events, so that M is that of the computed motion to about the tolerance.
!>
!> What contacts remember at the start is that of the motion that led there. Limits: those of derivatives of motions; a contact
!> that touches at the start must do so at all starts that are asked for.
module period_map
   use archive, only: archive_t
   use catalogue, only: catalogue_t
   use derived_motion, only: motion_t, restore, take_over_memory
   use errors, only: error_t
   use free_state, only: free_state_t
   use integration_settings, only: integration_t
   use jobs, only: first_line
   use kinds, only: wp
   use mechanism_catalogue, only: build_catalogue
   use moving_part, only: advance_part
   use orbit_source, only: branch_source_t, fixed_parameter, orbit_source_t, varied_parameter
   use sensitivity_column, only: derivative
   use sensitivity_motion, only: after_step, setting_of
   use sensitivity_results, only: found_t
   use varied_system, only: instants_of, want_only
   implicit none (type, external)
   private
   public :: only_end, period_map_t, period_t, with_matrix, with_parameter

   integer, parameter :: only_end = 0         !! no derivatives are wanted
   integer, parameter :: with_matrix = 1      !! those by the start
   integer, parameter :: with_parameter = 2   !! and those by the parameter

   real(wp), parameter :: part_of_state = 1.0e-4_wp      !! first change of free components, of the scales [1]
   real(wp), parameter :: part_of_parameter = 1.0e-4_wp  !! first change of the parameter, of it [1]

   !> What is asked of every period.
   type :: period_map_t
      class(orbit_source_t), pointer :: deck => null()   !! where scenes come from
      type(free_state_t) :: free                         !! components that make up a start
      type(archive_t) :: memory                          !! what the mechanism remembers at the start; none: nothing
      real(wp) :: tolerance = 0.0_wp                     !! of the motion [1]
      integer :: n_period = 1                            !! periods of the drivers in one of the motion
      integer :: n_run = 0                               !! periods that were integrated so far
   contains
      procedure :: settle
      procedure :: follow
   end type period_map_t

   !> A period of the motion.
   type :: period_t
      real(wp), allocatable :: end(:)          !! (m) free components at its end, over their scales [1]
      real(wp), allocatable :: matrix(:, :)    !! (m, m) their derivatives by those at the start [1]
      real(wp), allocatable :: by_p(:)         !! (m) and by the parameter [any]
      real(wp) :: length = 0.0_wp              !! of the period [s]
      type(found_t) :: found                   !! onsets, failures of derivatives
      character(:), allocatable :: reason      !! why it could not be followed; blank: it could
   end type period_t

contains

   !> Let the motion of the deck settle, and take the state after some periods as the start.
   subroutine settle(self, p, n_settle, z, reason)
      class(period_map_t), intent(inout) :: self              !! free components and memory are set
      real(wp), intent(in) :: p                               !! value of the parameter [any]
      integer, intent(in) :: n_settle                         !! periods of the drivers
      real(wp), allocatable, intent(out) :: z(:)              !! (m) free components then, over their scales [1]
      character(:), allocatable, intent(out) :: reason        !! why not; blank: done

      type(motion_t), target :: motion
      type(branch_source_t) :: source
      type(error_t), allocatable :: error
      type(archive_t) :: none
      real(wp) :: period
      integer :: status

      source%deck => self%deck
      call self%deck%scene_at(p, source%job, period, reason)
      if (reason /= "") return
      self%memory = none
      source%job%plan%end = max(1, n_settle)*period
      associate (mover => motion%mover)
         call mover%start(source%job, setting_of(source%job%scene%settings%integration), self%tolerance, source%job%plan%end, error)
         if (.not. allocated(error)) then
            call self%free%find(mover%system, mover%method%step%y1, status)
            if (status /= 0) reason = "the constraints cannot be solved beside the start"
            call restore(motion)
            if (reason == "" .and. n_settle > 0) call mover%advance(n_settle*period, error)
         end if
         if (allocated(error)) reason = first_line(error%message)
         if (reason /= "") return
         z = self%free%of(mover%method%step%y1)
         if (any_touches(motion)) call mover%system%save(self%memory)
      end associate
   end subroutine settle

   !> Whether any contact touches.
   pure logical function any_touches(motion)
      type(motion_t), intent(in) :: motion    !! the motion

      integer :: k

      any_touches = .false.
      do k = 1, size(motion%mover%system%clearance_joints%sets)
         associate (set => motion%mover%system%clearance_joints%sets(k)%set)
            any_touches = any_touches .or. any(set%contact%is_touching)
         end associate
      end do
   end function any_touches

   !> Follow the motion for a period, perhaps with its derivatives.
   subroutine follow(self, p, z, wanted, period)
      class(period_map_t), intent(inout) :: self     !! what is asked of every period
      real(wp), intent(in) :: p                      !! value of the parameter [any]
      real(wp), intent(in) :: z(:)                   !! (m) free components at the start, over their scales [1]
      integer, intent(in) :: wanted                  !! one of the above
      type(period_t), intent(out) :: period          !! what it is like

      type(motion_t), target :: motion
      type(branch_source_t), target :: source
      real(wp), allocatable :: basis(:, :)
      type(error_t), allocatable :: error
      integer :: k, m

      source%deck => self%deck
      call self%deck%scene_at(p, source%job, period%length, period%reason)
      if (period%reason /= "") return
      period%length = self%n_period*period%length
      source%end = period%length
      source%job%plan%end = period%length
      m = merge(size(z), 0, wanted >= with_matrix)
      allocate (motion%columns(m + merge(1, 0, wanted == with_parameter)), motion%results(0))
      call period%found%start(0, size(motion%columns))
      self%n_run = self%n_run + 1
      call start_mover(self, source, motion, z, basis, period%reason)
      if (period%reason == "") call start_columns(self, source, motion, p, z, basis, period%reason)
      if (period%reason == "") then
         do while (motion%mover%method%t < period%length)
            call advance_part(motion%mover%part, motion%mover%tally, error, period%length)
            if (.not. allocated(error)) call after_step(motion, period%length, period%found, error)
            if (allocated(error)) exit
         end do
         if (allocated(error)) period%reason = first_line(error%message)
      end if
      if (period%reason == "") then
         do k = 1, size(motion%columns)
            if (.not. motion%columns(k)%is_active) period%reason = "no derivatives: "//motion%columns(k)%reason
         end do
      end if
      if (period%reason == "") then
         period%end = self%free%of(motion%mover%method%step%y1)
         allocate (period%matrix(size(z), m))
         do k = 1, m
            period%matrix(:, k) = self%free%of(motion%columns(k)%s)
         end do
         if (wanted == with_parameter) call find_by_parameter(self, motion, p, period)
      end if
      do k = 1, size(motion%columns)
         call motion%columns(k)%free()
      end do
   end subroutine follow

   !> The mechanism at the start of the period.
   subroutine start_mover(self, source, motion, z, basis, reason)
      class(period_map_t), intent(inout) :: self                 !! what is asked of every period
      type(branch_source_t), intent(inout) :: source             !! the scene
      type(motion_t), target, intent(inout) :: motion            !! its mechanism starts
      real(wp), intent(in) :: z(:)                               !! (m) free components at the start, over their scales [1]
      real(wp), allocatable, intent(out) :: basis(:, :)          !! (n, m) derivative of the state by them [any]
      character(:), allocatable, intent(inout) :: reason         !! why not; blank: done

      type(error_t), allocatable :: error
      type(archive_t) :: copy
      real(wp), allocatable :: y(:)
      integer :: status
      logical :: is_good

      associate (mover => motion%mover)
         call mover%start(source%job, setting_of(source%job%scene%settings%integration), self%tolerance, source%end, error)
         if (allocated(error)) then
            reason = first_line(error%message)
            return
         end if
         y = mover%method%step%y1
         call self%free%embed(mover%system, z, y, status)
         allocate (basis(size(y), size(z)))
         if (status == 0 .and. size(motion%columns) > 0) call self%free%basis(mover%system, z, y, basis, status)
         if (status /= 0) then
            reason = "the constraints cannot be solved at the start of the period"
            return
         end if
         if (self%memory%n > 0) then
            copy = self%memory
            copy%place = 0
            call mover%system%load(copy)
         end if
         call mover%put(y, is_good)
         if (.not. is_good) reason = "a contact that does not touch at the start of the period has a penetration there: " &
                                     //"shift the start of the period, by the phase of the drivers"
      end associate
   end subroutine start_mover

   !> The derivatives at the start of the period.
   subroutine start_columns(self, source, motion, p, z, basis, reason)
      class(period_map_t), intent(in) :: self                          !! what is asked of every period
      type(branch_source_t), target, intent(inout) :: source           !! the scene
      type(motion_t), target, intent(inout) :: motion                  !! its derivatives start
      real(wp), intent(in) :: p                                        !! value of the parameter [any]
      real(wp), intent(in) :: z(:)                                     !! (m) free components, over their scales [1]
      real(wp), intent(in) :: basis(:, :)                              !! (n, m) derivative of the state by them [any]
      character(:), allocatable, intent(inout) :: reason               !! why not; blank: done

      type(integration_t) :: settings
      integer :: i, k, status

      associate (variation => motion%variation, mover => motion%mover)
         variation%setting = setting_of(source%job%scene%settings%integration)
         variation%tolerance = self%tolerance
         variation%source => source
         variation%base => mover%system
         allocate (variation%channels(3, 0))
         settings = source%job%scene%settings%integration
         call variation%setting%apply(self%tolerance, settings)
         call motion%map%begin(settings, mover%system, mover%method%step%y1, source%end, status)
         call build_catalogue(mover%system, motion%catalogue)
         call want_only(mover%system, variation%channels, motion%catalogue)
         variation%instants = instants_of(source%job, mover%system)
         do k = 1, size(motion%columns)
            associate (column => motion%columns(k))
               if (k <= size(z)) then
                  call column%begin(variation, fixed_parameter, 0.0_wp, part_of_state, mover%method)
               else
                  call column%begin(variation, varied_parameter, p, part_of_parameter, mover%method)
               end if
               if (.not. column%is_active) then
                  reason = column%reason
                  return
               end if
               column%s = 0.0_wp
               if (k <= size(z)) then
                  column%s = basis(:, k)
                  cycle
               end if
               associate (b => column%beside)
                  do i = 1, 4
                     b(i)%y = b(i)%start
                     call self%free%embed(b(i)%system, z, b(i)%y, status)
                     if (status /= 0) reason = "the constraints cannot be solved with the parameter changed"
                  end do
                  do i = 1, size(column%s)
                     column%s(i) = derivative([b(1)%y(i), b(2)%y(i), b(3)%y(i), b(4)%y(i)], b%e)
                  end do
               end associate
            end associate
         end do
      end associate
      if (reason /= "") return
      motion%is_behind_events = .true.
      call take_over_memory(motion)
      call restore(motion)
   end subroutine start_columns

   !> Derivative of the end by the parameter; the length of the period may depend on it.
   subroutine find_by_parameter(self, motion, p, period)
      class(period_map_t), intent(inout) :: self     !! what is asked of every period
      type(motion_t), intent(inout) :: motion        !! at the end of the period
      real(wp), intent(in) :: p                      !! value of the parameter [any]
      type(period_t), intent(inout) :: period        !! the derivative is set

      real(wp) :: length(4)

      associate (column => motion%columns(size(motion%columns)), method => motion%mover%method)
         call find_lengths(self, p, column%beside%e, length, period%reason)
         if (period%reason /= "") return
         period%by_p = self%free%of(column%s) &
                       + self%free%of(method%step%f1)*self%n_period*derivative(length, column%beside%e)
      end associate
   end subroutine find_by_parameter

   !> Periods beside.
   subroutine find_lengths(self, p, e, length, reason)
      class(period_map_t), intent(inout) :: self              !! what is asked of every period
      real(wp), intent(in) :: p                               !! value of the parameter [any]
      real(wp), intent(in) :: e(4)                            !! (4) changes of it [any]
      real(wp), intent(out) :: length(4)                      !! (4) periods of the drivers [s]
      character(:), allocatable, intent(inout) :: reason      !! why not; blank: found

      call lengths_of(self%deck)

   contains

      !> Ask the deck.
      subroutine lengths_of(deck)
         use jobs, only: job_t
         class(orbit_source_t), intent(inout) :: deck   !! where scenes come from

         type(job_t) :: job
         integer :: k

         do k = 1, 4
            call deck%scene_at(p + e(k), job, length(k), reason)
            if (reason /= "") return
         end do
      end subroutine lengths_of

   end subroutine find_lengths

end module period_map
