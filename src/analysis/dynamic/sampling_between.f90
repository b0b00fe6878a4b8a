!> What is reported of a motion between its rows: extremes, stroboscopic instants, films.
submodule(sampling) sampling_between
   use interpolation, only: fit_inner, inner_places, interpolate
   implicit none (type, external)

contains

   !> The row that was just reported, and extremes between it and the rows before.
   module procedure find_extremes
      real(wp) :: rough, t_between
      integer :: status
      logical :: counts, is_new, is_there

      whole%system%traits%with_quadratures = self%catalogue%readings%energy%n > 0
      call self%peaks%add_row(t, self%catalogue%values, self%y, self%ydot, is_written)
      do
         call self%peaks%ask(t_between, is_there)
         if (.not. is_there) exit
         call self%peaks%take_pair(is_new)
         status = 0
         if (self%peaks%is_first()) then
            self%peaks%pair%has_inner = .false.
            call report_between(self, whole%system, t_between, residual, status)
            rough = self%catalogue%values(self%peaks%asked_for())
         end if
         self%peaks%pair%has_inner = .not. is_new
         if (is_new .and. status == 0) call add_inner(self, whole%system, status)
         if (status == 0) call report_between(self, whole%system, t_between, residual, status)
         if (status /= 0) rough = huge(1.0_wp)
         if (status == 0 .and. .not. self%peaks%is_first()) rough = self%catalogue%values(self%peaks%asked_for())
         call self%peaks%answer(self%catalogue%values, rough, counts)
         if (counts) call tell_between(t_between, self%peaks%asked_for(), self%catalogue, recorder)
      end do
      whole%system%traits%with_quadratures = .true.
   end procedure find_extremes

   !> Derivatives at the inner places between two rows.
   subroutine add_inner(self, system, status)
      class(sampler_t), intent(inout) :: self         !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      integer, intent(out) :: status                  !! of the evaluations

      integer :: k, n

      n = n_of(system)
      associate (pair => self%peaks%pair)
         do k = 1, size(inner_places)
            call interpolate(pair, system%n_position, system%traits%n_turning, inner_places(k), n, self%y(:n))
            self%n_reports = self%n_reports + 1
            call system%evaluate(pair%t0 + inner_places(k)*pair%h, self%y, pair%inner(:, k), status)
            if (status /= 0) return
         end do
         call fit_inner(pair, system%n_position, system%traits%n_turning, n)
      end associate
   end subroutine add_inner

   !> Fill the catalogue at an instant between two rows.
   subroutine report_between(self, system, t, residual, status)
      class(sampler_t), intent(inout) :: self         !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: t                       !! the instant [s]
      real(wp), intent(in) :: residual                !! of the ledger at the last step [J]
      integer, intent(out) :: status                  !! of the evaluation

      integer :: n

      n = n_of(system)
      associate (pair => self%peaks%pair)
         call interpolate(pair, system%n_position, system%traits%n_turning, (t - pair%t0)/pair%h, n, self%y(:n))
      end associate
      self%n_reports = self%n_reports + 1
      call report_state(system, t, self%y, self%ydot, residual, self%catalogue, status)
   end subroutine report_between

   !> Entries of a state that are requested.
   pure integer function n_of(system)
      type(mechanism_t), intent(in) :: system         !! the system

      n_of = system%n
      if (.not. system%traits%with_quadratures) n_of = n_of - system%n_quadrature
   end function n_of

   !> The end of a step as a row that is not written, and extremes near it.
   module procedure follow_step
      type(error_t), allocatable :: error
      logical :: is_due, is_edge

      is_due = begins
      is_edge = .not. begins .and. (self%stride%is_first() .or. .not. whole%is_smooth)
      if (.not. begins) call self%stride%count_step(is_due)
      if (.not. is_due .and. whole%is_smooth) return
      if (whole%t < plan%first_output .or. whole%t > self%until) return
      call self%aside%leave()
      associate (step => whole%parts(1)%method%step)
         if (is_edge .and. self%peaks%last_row() <= step%t0) then   ! a stretch may be a single step
            call report(self, whole, step%t0 + 0.5_wp*step%h, .false., 0.0_wp, residual, error)
            if (.not. allocated(error)) call find_extremes(self, whole, step%t0 + 0.5_wp*step%h, .false., residual, recorder)
         end if
      end associate
      call report(self, whole, whole%t, .false., 0.0_wp, residual, error)
      if (.not. allocated(error)) then
         associate (linkage => whole%system%linkage)
            call self%stride%add_sample(whole%t, self%ydot(linkage%n_position + 1:linkage%n_position + linkage%n_rate))
         end associate
         if (self%t_row < whole%t .and. (begins .or. .not. whole%is_smooth)) then  ! values of both sides; else steps are chance
            call tell_sample(whole%t, self%peaks, self%catalogue, recorder)
         end if
         if (self%t_row < whole%t .or. begins) call find_extremes(self, whole, whole%t, .false., residual, recorder)
      end if
      call self%aside%come_back()
   end procedure follow_step

   !> All stroboscopic instants up to the time that all have reached.
   module procedure take_poincare
      real(wp) :: reached, t

      reached = min(whole%t, self%until)
      call self%aside%leave()
      do while (self%n_poincare < size(plan%poincare_samples))
         t = plan%poincare_samples(self%n_poincare + 1)
         if (t > reached .or. t >= whole%system%linkage%segment%end) exit
         call report(self, whole, t, .false., 0.0_wp, residual, error)
         if (allocated(error)) return
         call recorder%poincare(t, self%catalogue)
         self%n_poincare = self%n_poincare + 1
      end do
      call self%aside%come_back()
   end procedure take_poincare

   !> Films of an instant, as a row of that instant has them.
   module procedure take_field
      call report(self, whole, t, .false., 0.0_wp, residual, error)
      if (.not. allocated(error)) call self%films%tell_at(whole%system, t, recorder)
   end procedure take_field

end submodule sampling_between
