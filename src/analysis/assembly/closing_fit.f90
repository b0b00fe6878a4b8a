!> Closed loops of redundant joints whose numbers are rounded: fitted in least squares, and the rows that do not quite agree set
!> aside.
!>
!> Rounding by e makes rows that should depend on one another independent, with singular values of the order of e: the loop does
!> not close, or cannot move. Gauss-Newton's iteration without singular values below delta finds positions of the minimum misfit
!> nearby; delta is raised until it is well above the misfit found. Then rows are taken one by one, each time that of which most
!> is independent of those taken, those of drivers last; what depends on the others, to delta, is set aside. This counts as
!> rounding if the misfit is within `closing_tolerance`, all drivers are independent, and no row set aside would bend by more
!> than a tenth of its terms along the motions that the others leave free, see `second_order`: rows that do hold something to
!> second order.
!>
!> Source: Golub and Van Loan, Matrix Computations, sections 5.5 (rank-deficient least squares), 5.2 (Gram-Schmidt), 5.4 (pivoting).
!> Limits: dense; rows set aside at the start are set aside for all of the motion.
module closing_fit
   use assembly_report, only: assembly_t
   use kinds, only: pi, wp
   use lapack, only: dgelsd
   use linkage, only: linkage_t
   use mobility, only: drives, joint_names, split_space
   use row_corrections, only: evaluate_rows, min_correction, limit_step, scaled_jacobian, worst_violation
   use second_order, only: find_forms, most_free
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: between, fit_loops, misfit_words

   real(wp), parameter :: minimum = 1.0e-7_wp          !! delta to start with [1]
   real(wp), parameter :: most = 0.1_wp              !! delta that is too much [1]
   real(wp), parameter :: above = 30.0_wp            !! delta over the misfit, at least [1]
   real(wp), parameter :: higher = 10.0_wp           !! the next delta over one that does not do [1]
   real(wp), parameter :: settled = 1.0e-12_wp       !! correction that ends the iteration, sizes or radians [1]
   real(wp), parameter :: no_better = 1.0e-8_wp      !! correction that ends it if it is not half of the one before [1]
   real(wp), parameter :: bent = 0.1_wp              !! second-order form of rows that hold something, of its terms [1]
   real(wp), parameter :: rank_tolerance = 1.0e-9_wp !! of the least squares for combinations [1]
   integer, parameter :: n_newton = 60               !! corrections allowed
   integer, parameter :: most_named = 3              !! joints whose misfit is reported

contains

   !> Fit the loops of a linkage that does not close, or whose drivers cannot move it. If it counts as rounding, rows are set aside;
   !> positions are those of the minimum misfit found either way.
   subroutine fit_loops(linkage, q_given, is_closed, q, report, is_fitted)
      type(linkage_t), intent(inout) :: linkage   !! the bodies and their rows
      real(wp), intent(in) :: q_given(:)          !! (n_q bodies) positions to start with [any]
      logical, intent(in) :: is_closed            !! these are closed: it is the motion that rows do not agree on
      real(wp), intent(inout) :: q(:)             !! (n_q bodies) positions of the minimum misfit; else left alone [any]
      type(assembly_t), intent(inout) :: report   !! rows set aside and why
      logical, intent(out) :: is_fitted           !! it is fitted

      real(wp) :: best, delta, misfit, q_fit(size(q)), rest(size(linkage%mass))
      logical :: is_settled

      is_fitted = .false.
      rest = 0.0_wp
      best = huge(1.0_wp)
      delta = minimum
      do while (delta <= most)
         q_fit = q_given
         call close_in_least_squares(linkage, delta, q_fit, is_settled)
         misfit = worst_violation(linkage)
         if (is_settled .and. misfit < best) then
            best = misfit
            q = q_fit
         end if
         if (is_settled .and. misfit <= linkage%scales%misfit .and. delta >= above*misfit) then
            call set_rows_aside(linkage, q_fit, delta, is_closed, report, is_fitted)
            if (is_fitted) q = q_fit
            if (is_fitted) return
         end if
         if (is_closed .and. delta > above*linkage%scales%misfit) exit
         if (is_settled) delta = max(above*misfit, higher*delta)
         if (.not. is_settled) delta = higher*delta
      end do
      call evaluate_rows(linkage, 0.0_wp, q, rest)
   end subroutine fit_loops

   !> Positions of the minimum misfit near some, singular values below a part of the maximum omitted.
   subroutine close_in_least_squares(linkage, delta, q, is_settled)
      type(linkage_t), intent(inout) :: linkage   !! the bodies and their rows; evaluated at rest there
      real(wp), intent(in) :: delta               !! the part [1]
      real(wp), intent(inout) :: q(:)             !! (n_q bodies) positions [any]
      logical, intent(out) :: is_settled          !! the iteration has come to rest

      real(wp), dimension(size(linkage%mass)) :: correction, ease, rest, scale
      real(wp) :: before, now
      integer :: k, rank

      ease = 1.0_wp
      rest = 0.0_wp
      scale = linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n)
      before = huge(1.0_wp)
      is_settled = .false.
      call evaluate_rows(linkage, 0.0_wp, q, rest)
      do k = 1, n_newton
         call min_correction(linkage, -linkage%rows%phi, ease, correction, rank, delta)
         correction = limit_step(linkage, correction)
         call linkage%coordinates%add_change(linkage%bodies%n, correction, q)
         call evaluate_rows(linkage, 0.0_wp, q, rest)
         now = maxval(abs(correction)/scale)
         is_settled = now <= settled .or. (now <= no_better .and. now >= 0.5_wp*before)
         if (is_settled) return
         before = now
      end do
   end subroutine close_in_least_squares

   !> Choose the rows to set aside, and judge whether they may be.
   subroutine set_rows_aside(linkage, q, delta, is_closed, report, is_fitted)
      type(linkage_t), intent(inout) :: linkage   !! the bodies and their rows, evaluated at the positions; rows are set aside
      real(wp), intent(in) :: q(:)                !! (n_q bodies) positions [any]
      real(wp), intent(in) :: delta               !! minimum part of a row that is independent [1]
      logical, intent(in) :: is_closed            !! nothing is open there
      type(assembly_t), intent(inout) :: report   !! rows set aside and why
      logical, intent(out) :: is_fitted           !! it is rounding

      real(wp), allocatable :: combination(:, :), form(:, :, :), free(:, :), jac(:, :), left(:, :)
      logical, dimension(linkage%rows%n) :: is_driver, is_kept
      integer, allocatable :: aside(:), kept(:)
      integer :: k, m, rank, turn
      real(wp) :: threshold

      m = linkage%rows%n
      is_fitted = .false.
      is_driver = drives(linkage)
      call scaled_jacobian(linkage, jac)
      call split_space(jac(pack([(k, k=1, m)], .not. is_driver), :), rank, left, free, delta)
      if (rank == count(.not. is_driver) .or. size(free, 2) > most_free) return
      threshold = delta
      do turn = 1, 20
         call keep_rows(jac, is_driver, linkage%rows%n_solve, threshold, is_kept)
         k = count(is_kept .and. .not. is_driver)
         if (k == rank) exit
         threshold = threshold*merge(2.0_wp, 0.5_wp, k > rank)
      end do
      if (turn > 20 .or. any(is_driver .and. .not. is_kept) .or. any(.not. is_kept(linkage%rows%n_solve + 1:))) return
      aside = pack([(k, k=1, m)], .not. is_kept)
      kept = pack([(k, k=1, m)], is_kept .and. .not. is_driver)
      if (size(free, 2) > 0) then
         call combine(jac, kept, aside, combination)
         call find_forms(linkage, q, free, combination, form, above*delta)
         if (maxval(abs(form)) > bent) return
      end if
      is_fitted = .true.
      report%set_aside = aside
      report%misfit = "the closed loop of "//joint_names(linkage, any(abs(combination_or_all()) > 1.0e-3_wp, dim=2))//" is "// &
         "inconsistent "// &
                      "within the digits of the deck: least-squares fit, "//misfit_words(linkage)
      if (is_closed) report%misfit = "rows of "//joint_names(linkage, .not. is_kept)//" are dependent except for rounding in "// &
         "the deck"
      report%misfit = report%misfit//"; "//to_text(size(aside))//" redundant rows of "//joint_names(linkage, .not. is_kept)// &
                      " are removed; the other rows hold exactly, and reactions belong to these rows"
      linkage%solution%set_aside = aside

   contains

      !> Combinations of the rows, or all of them.
      function combination_or_all() result(part)
         real(wp), allocatable :: part(:, :)   !! (rows, set aside) parts [1]

         if (allocated(combination)) then
            part = combination
         else
            allocate (part(m, 1), source=1.0_wp)
         end if
      end function combination_or_all

   end subroutine set_rows_aside

   !> Independent rows by Gram and Schmidt with pivoting, each time the row of which most is left: first of those that are not
   !> solved for, last of those of drivers. Rows so chosen stay independent over more of the motion than the first ones do.
   pure subroutine keep_rows(jac, is_driver, n_solve, threshold, is_kept)
      real(wp), intent(in) :: jac(:, :)        !! (rows, n) scaled Jacobian [1]
      logical, intent(in) :: is_driver(:)      !! (rows) rows of drivers
      integer, intent(in) :: n_solve           !! rows that are solved for, the first ones
      real(wp), intent(in) :: threshold        !! minimum part of a row that is left [1]
      logical, intent(out) :: is_kept(:)       !! (rows) rows that are independent

      real(wp) :: left(size(jac, 1), size(jac, 2)), part(size(jac, 1)), x(size(jac, 2))
      integer :: pass, row, turn

      is_kept = .false.
      left = jac/spread(norm2(jac, dim=2), 2, size(jac, 2))
      do pass = 1, 3
         do turn = 1, size(jac, 1)
            part = norm2(left, dim=2)
            do row = 1, size(jac, 1)
               if (pass /= merge(3, merge(2, 1, row <= n_solve), is_driver(row)) .or. is_kept(row)) part(row) = 0.0_wp
            end do
            row = maxloc(part, dim=1)
            if (.not. part(row) > threshold) exit
            is_kept(row) = .true.
            x = left(row, :)/part(row)
            left = left - spread(matmul(left, x), 2, size(x))*spread(x, 1, size(left, 1))
            left = left - spread(matmul(left, x), 2, size(x))*spread(x, 1, size(left, 1))
         end do
      end do
   end subroutine keep_rows

   !> The combinations of rows that vanish, one for each row set aside.
   subroutine combine(jac, kept, aside, combination)
      real(wp), intent(in) :: jac(:, :)                       !! (rows, n) scaled Jacobian [1]
      integer, intent(in) :: kept(:)                          !! (any) rows kept
      integer, intent(in) :: aside(:)                         !! (s) rows set aside
      real(wp), allocatable, intent(out) :: combination(:, :) !! (rows, s) parts of the rows [1]

      real(wp), allocatable :: a(:, :), b(:, :), s(:), work(:)
      integer, allocatable :: iwork(:)
      integer :: info, k, m, n, rank

      m = size(kept)
      n = size(jac, 2)
      a = transpose(jac(kept, :))
      allocate (b(max(m, n), size(aside)), s(min(m, n)), work(1), iwork(40*max(1, min(m, n))))
      b(:n, :) = transpose(jac(aside, :))
      call dgelsd(n, m, size(aside), a, n, b, size(b, 1), s, rank_tolerance, rank, work, -1, iwork, info)
      k = int(work(1))
      deallocate (work)
      allocate (work(k))
      call dgelsd(n, m, size(aside), a, n, b, size(b, 1), s, rank_tolerance, rank, work, k, iwork, info)
      allocate (combination(size(jac, 1), size(aside)), source=0.0_wp)
      combination(kept, :) = -b(:m, :)
      do k = 1, size(aside)
         combination(aside(k), k) = 1.0_wp
      end do
   end subroutine combine

   !> How far joints are open, those with the maximum misfit first.
   function misfit_words(linkage, with_bodies) result(words)
      type(linkage_t), intent(in) :: linkage             !! the bodies and their rows, evaluated
      logical, intent(in), optional :: with_bodies       !! the bodies of each joint are named too
      character(:), allocatable :: words        !! as "'b2' is off by 0.0022 mm and 0.0001 deg"

      real(wp) :: scaled(linkage%rows%n)
      logical :: is_driver(linkage%rows%n), is_this(linkage%rows%n)
      integer :: k, n, row

      words = ""
      is_driver = drives(linkage)
      scaled = abs(linkage%rows%phi)*linkage%solution%row_weight
      do n = 1, most_named
         row = maxloc(scaled, dim=1)
         if (n > 1 .and. .not. scaled(row) > 0.1_wp*maxval(abs(linkage%rows%phi)*linkage%solution%row_weight)) exit
         do k = 1, linkage%rows%n
            is_this(k) = linkage%row_name(k) == linkage%row_name(row)
         end do
         if (n > 1) words = words//", "
         words = words//"'"//linkage%row_name(row)//"'"
         if (present(with_bodies)) words = words//between(linkage, row)
         words = words//" is off by"
         if (any(is_this .and. .not. linkage%rows%is_angle)) then
            words = words//" "//real_text(1.0e3_wp*norm2(pack(linkage%rows%phi, is_this .and. .not. linkage%rows%is_angle)), 3)// &
                    " mm"
            if (any(is_this .and. linkage%rows%is_angle)) words = words//" and"
         end if
         if (any(is_this .and. linkage%rows%is_angle)) then
            words = words//" "//real_text(degrees_of(pack(linkage%rows%phi, is_this .and. linkage%rows%is_angle), &
                                                     allocated(linkage%motion%spatial%p) .and. .not. is_driver(row)), 3)//" deg"
         end if
         where (is_this) scaled = -1.0_wp
         if (.not. any(scaled >= 0.0_wp)) exit
      end do
   end function misfit_words

   !> The angle that the rows of a joint are off by: in space rows between axes are sines of angles.
   pure real(wp) function degrees_of(phi, is_sine)
      real(wp), intent(in) :: phi(:)    !! (any) violations of the angle rows of a joint [rad or 1]
      logical, intent(in) :: is_sine    !! they are those of a joint in space

      degrees_of = norm2(phi)
      if (is_sine) degrees_of = asin(min(degrees_of, 1.0_wp))
      degrees_of = degrees_of*180.0_wp/pi
   end function degrees_of

   !> The bodies of a row.
   function between(linkage, row) result(words)
      type(linkage_t), intent(in) :: linkage    !! the bodies and their rows
      integer, intent(in) :: row                !! number of the row
      character(:), allocatable :: words        !! as " between ground and 'rod'"

      integer :: side

      words = " between"
      do side = 1, 2
         associate (body => linkage%rows%body(side, row))
            if (side == 2) words = words//" and"
            if (body == 0) words = words//" ground"
            if (body > 0) words = words//" '"//linkage%bodies%names(max(body, 1))%s//"'"
         end associate
      end do
   end function between

end module closing_fit
