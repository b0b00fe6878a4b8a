!> A study of tolerances whose members were run: derivatives, members, Sobol' indices, or the split of the variance.
!>
!> Everything is at one time, the end of the motion. Derivatives are differences of the cases beside the nominal one,
!> $$ S_k = \frac{R(s_k) - R(-s_k)}{2 s_k}, \quad H_{kk} = \frac{R(s_k) + R(-s_k) - 2 R_0}{s_k^2} , $$
!> s_k the standard deviation. Where cases have several runs, S is the plane of least squares through the means of the members, and
!> H is zero. A member is good if its first run is within the limits: so members are independent. A run that failed is not good.
!> Source: R. H. Myers, D. C. Montgomery, Response Surface Methodology (2002), chapter 2.
module simulated_study
   use cost_allocation, only: allocate_tolerances
   use first_order, only: combine_derivatives
   use kinds, only: i8, not_a_number, wp
   use lapack, only: dgelsd
   use member_draws, only: draw_t
   use member_values, only: block_t
   use polynomial_study, only: take_polynomials
   use run_design, only: run_design_t
   use sample_moments, only: sample_t
   use sampled_members, only: begin_members, end_members, find_capabilities, take_block
   use tolerance_plan, only: indices_by_polynomial
   use tolerance_results, only: tolerance_study_t
   use tolerance_study, only: compare_plans
   use variance_split, only: split_variance
   use worst_members, only: find_worst
   implicit none (type, external)
   private
   public :: take_runs

contains

   !> Take the runs of all cases. That of the nominal case did not fail.
   subroutine take_runs(study, design, end, values, is_failed)
      type(tolerance_study_t), intent(inout) :: study   !! what is asked; the rest is set
      type(run_design_t), intent(in) :: design          !! the cases
      real(wp), intent(in) :: end                       !! of the motion [s]
      real(wp), intent(in) :: values(:, :, :)           !! (requests, starts, cases) values; of failed runs zero [any]
      logical, intent(in) :: is_failed(:, :)            !! (starts, cases) runs that failed

      integer :: n, n_request

      n = size(design%steps)
      n_request = size(values, 1)
      associate (found => study%derivatives)
         allocate (found%instants(1), found%clearance_slopes(n, 0), found%pins(2, 0, n_request, 1), &
                   found%pin_curvatures(3, 0, n_request, 1), found%directions(2, 0, 1))
         allocate (found%curvatures(n, n, n_request, 1), found%slopes(n, n_request, 1), source=0.0_wp)
         found%instants(1)%t = end
         found%steps = design%steps
         found%values = reshape(sum(values(:, :, 1), dim=2)/size(values, 2), [n_request, 1])
      end associate
      if (design%n_start == 1) then
         call find_differences(study, design, values(:, 1, :), is_failed(1, :))
      else
         call find_plane(study, design, values, is_failed)
         call split_all(study, design, values, is_failed)
      end if
      call combine_derivatives(study)
      call take_members(study, design, values(:, 1, :), is_failed(1, :))
      call allocate_tolerances(study)
      call take_plans(study, design, values(:, 1, :), is_failed(1, :))
   end subroutine take_runs

   !> Derivatives by differences; zero where a run failed.
   subroutine find_differences(study, design, values, is_failed)
      type(tolerance_study_t), intent(inout) :: study   !! the study
      type(run_design_t), intent(in) :: design          !! the cases
      real(wp), intent(in) :: values(:, :)              !! (requests, cases) values [any]
      logical, intent(in) :: is_failed(:)               !! (cases) failed

      integer :: k

      do k = 1, size(design%steps)
         associate (h => design%steps(k), above => design%beside(k, 1), below => design%beside(k, 2))
            if (.not. h > 0.0_wp) cycle
            if (is_failed(above) .or. is_failed(below)) then
               study%derivatives%has_curvatures = .false.
               cycle
            end if
            study%derivatives%slopes(k, :, 1) = (values(:, above) - values(:, below))/(2.0_wp*h)
            study%derivatives%curvatures(k, k, :, 1) = (values(:, above) + values(:, below) - 2.0_wp*values(:, 1))/h**2
         end associate
      end do
   end subroutine find_differences

   !> Derivatives by the plane through the means of the members.
   subroutine find_plane(study, design, values, is_failed)
      type(tolerance_study_t), intent(inout) :: study   !! the study
      type(run_design_t), intent(in) :: design          !! the cases
      real(wp), intent(in) :: values(:, :, :)           !! (requests, starts, cases) values [any]
      logical, intent(in) :: is_failed(:, :)            !! (starts, cases) failed

      real(wp), parameter :: negligible = 1.0e-10_wp    ! singular value, of the largest one [1]
      integer, allocatable :: good(:), iwork(:), list(:)
      real(wp), allocatable :: a(:, :), b(:, :), s(:), work(:)
      integer :: info, k, m, n, rank

      list = pack([(k, k=1, size(design%steps))], study%plan%parameters%sigma > 0.0_wp)
      good = members_without_failure(design, is_failed)
      m = size(good)
      n = size(list) + 1
      study%derivatives%has_curvatures = m > n
      if (m <= n) return
      allocate (a(m, n), source=1.0_wp)
      do k = 1, n - 1
         a(:, k) = design%deviations(list(k), good)/study%plan%parameters(list(k))%sigma
      end do
      b = transpose(sum(values(:, :, good), dim=2))/size(values, 2)
      allocate (s(n), work(64*(m + n)*(size(b, 2) + 8)), iwork(64*n))
      call dgelsd(m, n, size(b, 2), a, m, b, m, s, negligible, rank, work, size(work), iwork, info)
      if (info /= 0) study%derivatives%has_curvatures = .false.
      if (info /= 0) return
      do k = 1, n - 1
         study%derivatives%slopes(list(k), :, 1) = b(k, :)/study%plan%parameters(list(k))%sigma
      end do
   end subroutine find_plane

   !> Cases of the members none of whose runs failed.
   pure function members_without_failure(design, is_failed) result(good)
      type(run_design_t), intent(in) :: design          !! the cases
      logical, intent(in) :: is_failed(:, :)            !! (starts, cases) failed
      integer, allocatable :: good(:)                   !! (any) numbers of cases

      integer :: m

      good = [integer ::]
      do m = 1, design%n_member
         if (.not. any(is_failed(:, design%member(m)))) good = [good, design%member(m)]
      end do
   end function members_without_failure

   !> Split the variance of each request, over the members none of whose runs failed.
   subroutine split_all(study, design, values, is_failed)
      type(tolerance_study_t), intent(inout) :: study   !! the study
      type(run_design_t), intent(in) :: design          !! the cases
      real(wp), intent(in) :: values(:, :, :)           !! (requests, starts, cases) values [any]
      logical, intent(in) :: is_failed(:, :)            !! (starts, cases) failed

      integer, allocatable :: good(:)
      integer :: r

      good = members_without_failure(design, is_failed)
      allocate (study%splits(size(values, 1)))
      do r = 1, size(values, 1)
         study%splits(r) = split_variance(values(r, :, good))
      end do
   end subroutine split_all

   !> Moments, yields and histograms of the members, and the error of the expansion in them.
   subroutine take_members(study, design, values, is_failed)
      type(tolerance_study_t), intent(inout) :: study   !! the study
      type(run_design_t), intent(in) :: design          !! the cases
      real(wp), intent(in) :: values(:, :)              !! (requests, cases) values of first runs [any]
      logical, intent(in) :: is_failed(:)               !! (cases) failed

      type(block_t) :: some
      type(draw_t) :: draw
      type(sample_t), allocatable :: samples(:, :)
      real(wp) :: high, low
      integer :: bin, k, m, r
      integer, allocatable :: cases(:), good(:)

      call begin_members(study, .true., samples)
      allocate (cases(design%n_member))
      do m = 1, size(cases)
         cases(m) = design%member(m)
      end do
      good = pack(cases, .not. is_failed(cases))
      associate (edges => study%members%edges, found => study%derivatives)
         do r = 1, size(values, 1)
            low = minval(values(r, good))
            high = maxval(values(r, good))
            edges(:, r) = found%values(r, 1)
            if (.not. low < high) cycle
            do bin = 0, ubound(edges, 1)
               edges(bin, r) = low + (high - low)*bin/ubound(edges, 1)
            end do
         end do
         call some%take(values(:, cases), is_failed(cases))
         call take_block(some, study, samples)
         call end_members(samples, study%members)
         call find_capabilities(study)
         call draw%begin(study)
         call find_worst(study, draw)
         study%n_checked = size(good)
         study%n_open = size(cases) - size(good)
         allocate (study%errors(size(values, 1)), source=0.0_wp)
         do k = 1, size(good)
            do r = 1, size(values, 1)
               associate (by => design%deviations(:, good(k)))
                  study%errors(r) = max(study%errors(r), abs(values(r, good(k)) - found%values(r, 1) - &
                     dot_product(by, found%slopes(:, r, 1) + 0.5_wp*matmul(found%curvatures(:, :, r, 1), by))))
               end associate
            end do
         end do
      end associate
   end subroutine take_members

   !> Sobol' indices, by a polynomial or by plans, if there are some.
   subroutine take_plans(study, design, values, is_failed)
      type(tolerance_study_t), intent(inout) :: study   !! the study
      type(run_design_t), intent(in) :: design          !! the cases
      real(wp), intent(in) :: values(:, :)              !! (requests, cases) values [any]
      logical, intent(in) :: is_failed(:)               !! (cases) failed

      type(block_t), allocatable :: plans(:)
      integer, allocatable :: cases(:)
      integer :: k, m, n

      if (design%n_start == 1 .and. study%plan%sampling%indices == indices_by_polynomial) then
         call take_polynomials(study, design, values, is_failed)
         return
      end if
      n = size(study%contributors)
      if (design%n_point == 0) then
         study%indices%points = 0
         study%indices%open = 0_i8
         allocate (study%indices%first(3, n, size(values, 1), 1), study%indices%total(3, n, size(values, 1), 1), &
                   source=not_a_number())
         return
      end if
      allocate (plans(0:n + 1), cases(design%n_point))
      do k = 0, n + 1
         do m = 1, size(cases)
            cases(m) = design%point(k, m)
         end do
         call plans(k)%take(values(:, cases), is_failed(cases))
      end do
      call compare_plans(plans, design%seed, study)
   end subroutine take_plans

end module simulated_study
