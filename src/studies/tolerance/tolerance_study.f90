!> A study of tolerances: nominal motion, derivatives, what they give, members, Sobol' indices.
module tolerance_study
   use cost_allocation, only: allocate_tolerances
   use errors, only: error_t
   use exact_member, only: assemble_member
   use expansion, only: expanded_value, find_curvatures
   use first_order, only: combine_derivatives
   use kinds, only: i8, not_a_number, wp
   use mechanism_source, only: mechanism_source_t
   use member_draws, only: draw_t, stream_a, stream_b, stream_check, stream_resamples
   use member_values, only: block_t
   use rare_failures, only: sample_failures
   use sampled_members, only: sample_members
   use sensitivities, only: find_sensitivities
   use sobol_indices, only: find_indices, resample_weights
   use tolerance_plan, only: method_auto, method_exact, pin_circle, pin_disc, pin_force
   use tolerance_results, only: tolerance_study_t
   use varied_mechanism, only: varied_t
   implicit none (type, external)
   private
   public :: compare_plans, is_accurate, run_study

contains

   !> Make a study. What is asked, channels, pins and the instants of the nominal motion are known.
   subroutine run_study(source, nominal, study, error)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(varied_t), intent(inout) :: nominal             !! the nominal one, bound
      type(tolerance_study_t), intent(inout) :: study      !! the study
      type(error_t), allocatable, intent(out) :: error     !! a parameter cannot be changed, or an instant is singular

      real(wp) :: members
      logical :: is_exact

      call find_sensitivities(source, nominal, study, error)
      if (allocated(error)) return
      call find_curvatures(source, study)
      call combine_derivatives(study)
      associate (sampling => study%plan%sampling)
         is_exact = sampling%method == method_exact
         call check_expansion(source, study)
         if (sampling%method == method_auto) then
            members = sampling%members + real(sampling%points, wp)*(size(study%contributors) + 2)
            is_exact = .not. may_expand(study) .and. study%cpu_checked/study%n_checked*members <= sampling%budget
         end if
         call sample_members(source, study, is_exact)
         call sample_failures(source, study, is_exact)
         call allocate_tolerances(study)
         call find_study_indices(source, study, is_exact)
      end associate
      call source%show(1.0_wp)
   end subroutine run_study

   !> Assemble members, and those of the worst case of each channel, and compare them with the expansion.
   subroutine check_expansion(source, study)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(tolerance_study_t), intent(inout) :: study      !! errors are set

      type(draw_t) :: draw
      real(wp), allocatable :: deviations(:), u(:), units(:, :), clearances(:)
      real(wp) :: now, start
      integer :: at, m, r, side

      call cpu_time(start)
      call draw%begin(study)
      allocate (study%errors(size(study%requests)), source=0.0_wp)
      associate (parameters => study%plan%parameters, pins => study%pins)
         allocate (deviations(size(parameters)), u(draw%n), units(2, size(pins)), clearances(size(pins)))
         do m = 1, study%plan%sampling%checked
            call draw%numbers(stream_check, int(m, i8), u)
            call draw%make(study, 1, u, deviations, units, clearances)
            call check_one()
         end do
         do r = 1, size(study%requests)
            at = maxloc(study%sigma(r, :), dim=1)
            do side = -1, 1, 2
               deviations = merge(parameters%upper, parameters%lower, side*study%slopes(:, r, at) > 0.0_wp)
               do m = 1, size(pins)
                  clearances(m) = max(pins(m)%clearance + &
                                      dot_product(study%derivatives%clearance_slopes(:, m), deviations), 0.0_wp)
                  units(:, m) = 0.0_wp
                  associate (slope => study%derivatives%pins(:, m, r, at))
                     if (any(pins(m)%position == [pin_disc, pin_circle]) .and. norm2(slope) > 0.0_wp) then
                        units(:, m) = side*slope/norm2(slope)
                     end if
                  end associate
               end do
               call check_one()
            end do
         end do
      end associate
      call cpu_time(now)
      study%cpu_checked = now - start

   contains

      !> Compare a member with its expansion.
      subroutine check_one()
         real(wp) :: displaced(1, 2, size(study%pins)), value(1), values(size(study%requests), size(study%derivatives%instants))
         logical :: is_open
         integer :: i, k, time

         call assemble_member(source, study, deviations, units, values, is_open)
         study%n_checked = study%n_checked + 1
         if (is_open) study%n_open = study%n_open + 1
         if (is_open) return
         do time = 1, size(values, 2)
            do k = 1, size(study%pins)
               displaced(1, :, k) = clearances(k)*units(:, k)
               if (study%pins(k)%position == pin_force) displaced(1, :, k) = clearances(k)*study%derivatives%directions(:, k, time)
            end do
            do i = 1, size(values, 1)
               call expanded_value(study%derivatives, i, time, reshape(deviations, [1, size(deviations)]), displaced, value)
               study%errors(i) = max(study%errors(i), abs(values(i, time) - value(1)))
            end do
         end do
      end subroutine check_one

   end subroutine check_expansion

   !> Whether the expansion may stand for the mechanism: all can be assembled, and its errors are small.
   logical function may_expand(study)
      type(tolerance_study_t), intent(in) :: study   !! the study, its expansion checked

      may_expand = study%derivatives%has_curvatures .and. study%n_open == 0
      if (may_expand) may_expand = is_accurate(study)
   end function may_expand

   !> Whether the errors of the expansion are small against the standard deviations; of channels that do not scatter, against those
   !> of normal ones between the ends of the worst case, which may be none.
   logical function is_accurate(study)
      type(tolerance_study_t), intent(in) :: study   !! the study, its expansion checked

      real(wp) :: scale(size(study%requests))

      scale = maxval(study%sigma, dim=2)
      where (.not. scale > 0.0_wp) scale = maxval(study%high - study%low, dim=2)/6.0_wp
      is_accurate = all(study%errors <= study%plan%sampling%accuracy*scale + &
                        1.0e-12_wp*maxval(abs(study%derivatives%values), dim=2) .or. .not. scale > 0.0_wp)
   end function is_accurate

   !> Sobol' indices of all channels at all times, of the same plans: A, those with a contributor of B, B.
   subroutine find_study_indices(source, study, is_exact)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(tolerance_study_t), intent(inout) :: study      !! indices are set
      logical, intent(in) :: is_exact                      !! members are assembled

      type(block_t), allocatable :: plans(:)
      type(draw_t) :: draw
      real(wp), allocatable :: mixed(:, :), u_a(:, :), u_b(:, :)
      integer :: k, m, n, n_all

      n = study%plan%sampling%points
      n_all = size(study%contributors)
      call draw%begin(study)
      allocate (u_a(draw%n, n), u_b(draw%n, n), plans(0:n_all + 1))
      do m = 1, n
         call draw%numbers(stream_a, int(m, i8), u_a(:, m))
         call draw%numbers(stream_b, int(m, i8), u_b(:, m))
      end do
      allocate (mixed, source=u_a)
      do k = 0, n_all + 1
         mixed = u_a
         if (k > n_all) mixed = u_b
         if (k > 0 .and. k <= n_all) then
            mixed(draw%first(k):draw%first(k + 1) - 1, :) = u_b(draw%first(k):draw%first(k + 1) - 1, :)
         end if
         call plans(k)%fill(source, study, draw, mixed, is_exact)
         call source%show(0.9_wp + 0.05_wp*k/n_all)
      end do
      call compare_plans(plans, draw%seed, study, source)
   end subroutine find_study_indices

   !> Indices from the plans. Points with a member that cannot be assembled in any of them are omitted.
   subroutine compare_plans(plans, seed, study, source)
      type(block_t), intent(in) :: plans(0:)                         !! (0:contributors + 1) plan A, mixed ones, plan B
      integer, intent(in) :: seed                                    !! of the resamples
      type(tolerance_study_t), intent(inout) :: study                !! indices are set
      class(mechanism_source_t), intent(inout), optional :: source   !! shows how far it is

      real(wp), allocatable :: kept(:, :), values(:), weights(:, :)
      logical, allocatable :: is_closed(:)
      integer :: at, k, n_all, r

      n_all = size(plans) - 2
      allocate (is_closed(plans(0)%n), source=.true.)
      do k = 0, n_all + 1
         is_closed = is_closed .and. .not. plans(k)%is_open
      end do
      associate (indices => study%indices, n_request => size(study%requests), n_time => size(study%derivatives%instants))
         indices%points = count(is_closed)
         indices%open = plans(0)%n - indices%points
         allocate (indices%first(3, n_all, n_request, n_time), indices%total(3, n_all, n_request, n_time), &
                   source=not_a_number())
         if (indices%points < 2) return
         allocate (weights(indices%points, study%plan%sampling%resamples), kept(indices%points, 0:n_all + 1), values(plans(0)%n))
         call resample_weights(seed, stream_resamples, weights)
         do at = 1, n_time
            do r = 1, n_request
               do k = 0, n_all + 1
                  call plans(k)%values(study, r, at, values)
                  kept(:, k) = pack(values, is_closed)
               end do
               call find_indices(kept(:, 0), kept(:, n_all + 1), kept(:, 1:n_all), weights, indices%first(:, :, r, at), &
                                 indices%total(:, :, r, at))
            end do
            if (present(source)) call source%show(0.95_wp + 0.05_wp*at/n_time)
         end do
      end associate
   end subroutine compare_plans

end module tolerance_study
