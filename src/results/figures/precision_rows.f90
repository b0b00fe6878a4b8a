!> The numbers that the figures of a comparison of settings are drawn from.
module precision_rows
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use precision_results, only: error_ledger, precision_t, tol_run_done, tol_run_t
   use text, only: to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: any_ledger, any_state, error_axis, front_of, is_above_zero, largest_cpu, min_error, number, numbers_of, &
      smallest_cpu, zero_of_errors, zero_of_ledgers

   real(wp), parameter :: min_error = 1.0e-17_wp   !! drawn for a distance of nothing [1]
   real(wp), parameter :: decade = 0.2_wp            !! workspace beside an error, of it, for which the axis has another decade [1]
   real(wp), parameter :: min_below = 0.1_wp  !! of the reference's own error, drawn for what is less: it cannot be reported [1]

contains

   !> The numbers: a block for each setting, two blank lines between them, then the front from the minimum error on, then the
   !> choice.
   function numbers_of(study) result(text)
      type(precision_t), intent(in) :: study   !! results
      character(:), allocatable :: text        !! whole lines

      type(buffer_t) :: lines
      type(tol_run_t), allocatable :: front(:)
      integer :: i, k

      if (ieee_is_finite(zero_of_errors(study))) call lines%line("# zero errors are drawn at "// &
                                                                number(zero_of_errors(study)))
      if (ieee_is_finite(zero_of_ledgers(study))) call lines%line("# zero energy errors are drawn at "// &
                                                                 number(zero_of_ledgers(study)))
      call lines%line("# tolerance or step [1 or s], error, CPU median [s], CPU minimum [s], right-hand sides, steps, ledger, " // &
                      "state, below")
      do k = 1, size(study%tol_sweeps)
         call lines%line("# "//study%tol_sweeps(k)%name)
         do i = 1, size(study%tol_sweeps(k)%tol_runs)
            call lines%line(row_of(study, study%tol_sweeps(k)%tol_runs(i)))
         end do
         call lines%line("")
         call lines%line("")
      end do
      call lines%line("# front")
      front = front_of(study)
      do k = 1, size(front)
         call lines%line(row_of(study, front(k)))
      end do
      call lines%line("")
      call lines%line("")
      call lines%line("# choice")
      if (study%choice%tol_sweep > 0) call lines%line(row_of(study, &
           study%tol_sweeps(study%choice%tol_sweep)%tol_runs(study%choice%tol_run)))
      text = lines%get()
   end function numbers_of

   !> The runs of the front, from the minimum error on.
   function front_of(study) result(front)
      type(precision_t), intent(in) :: study       !! results
      type(tol_run_t), allocatable :: front(:)        !! (n) runs

      type(tol_run_t), allocatable :: runs(:)
      type(tol_run_t) :: one
      integer :: i, k

      runs = runs_of(study)
      front = runs(pack([(k, k=1, size(runs))], runs%is_front))
      do k = 2, size(front)
         one = front(k)
         do i = k - 1, 1, -1
            if (front(i)%error(study%wanted) <= one%error(study%wanted)) exit
            front(i + 1) = front(i)
         end do
         front(i + 1) = one
      end do
   end function front_of

   !> The numbers of a run.
   function row_of(study, tol_run) result(line)
      type(precision_t), intent(in) :: study   !! results
      type(tol_run_t), intent(in) :: tol_run         !! the run
      character(:), allocatable :: line        !! its row

      real(wp) :: ledger

      ledger = tol_run%error(error_ledger)
      if (is_zero(ledger)) ledger = zero_of_ledgers(study)
      line = number(tol_run%asked)//" "//number(drawn_error(study, &
           tol_run))//" "//number(tol_run%cpu)//" "//number(tol_run%cpu_min)//" "// &
             to_text(tol_run%count%evaluations)//" "//to_text(tol_run%count%steps)//" "//number(ledger)//" "// &
             to_text(tol_run%state)//" "//to_text(merge(1, 0, tol_run%is_below))
   end function row_of

   !> The error at which a run is drawn; NaN or infinite: it is not.
   pure real(wp) function drawn_error(study, tol_run) result(x)
      type(precision_t), intent(in) :: study   !! results
      type(tol_run_t), intent(in) :: tol_run         !! the run

      x = known_error(study, tol_run)
      if (is_zero(x)) x = zero_of_errors(study)
   end function drawn_error

   !> The error of a run; below the reference's own error it cannot be reported.
   pure real(wp) function known_error(study, tol_run) result(x)
      type(precision_t), intent(in) :: study   !! results
      type(tol_run_t), intent(in) :: tol_run   !! the run

      x = tol_run%error(study%wanted)
      if (tol_run%is_below) x = max(x, min_below*study%reference%bar(study%wanted))
   end function known_error

   !> All runs of a study.
   pure function runs_of(study) result(runs)
      type(precision_t), intent(in) :: study        !! results
      type(tol_run_t), allocatable :: runs(:)       !! (n) runs, by setting

      integer :: k

      allocate (runs(0))
      do k = 1, size(study%tol_sweeps)
         runs = [runs, study%tol_sweeps(k)%tol_runs]
      end do
   end function runs_of

   !> Where errors of exactly 0 are drawn on a logarithmic axis, since they have no place of their own: a decade below all others
   !> and all tolerances.
   pure real(wp) function zero_of_errors(study) result(place)
      type(precision_t), intent(in) :: study   !! results

      type(tol_run_t), allocatable :: runs(:)
      real(wp) :: minimum
      integer :: k

      runs = runs_of(study)
      minimum = study%accuracy
      associate (x => [(known_error(study, runs(k)), k=1, size(runs))], bar => study%reference%bar(study%wanted))
         if (is_above_zero(bar)) minimum = min(minimum, min_below*bar)
         minimum = min(minimum, minval(x, mask=is_above_zero(x)))
         do k = 1, size(study%tol_sweeps)
            if (.not. study%tol_sweeps(k)%is_fixed) minimum = min(minimum, minval(study%tol_sweeps(k)%tol_runs%asked))
         end do
         place = not_a_number()
         if (any(is_zero(x))) place = decade_below(minimum)
      end associate
   end function zero_of_errors

   !> The same of residuals of the ledger.
   pure real(wp) function zero_of_ledgers(study) result(place)
      type(precision_t), intent(in) :: study   !! results

      type(tol_run_t), allocatable :: runs(:)

      runs = runs_of(study)
      associate (x => runs%error(error_ledger))
         place = not_a_number()
         if (any(is_zero(x))) place = decade_below(min(epsilon(1.0_wp), minval(x, mask=is_above_zero(x))))
      end associate
   end function zero_of_ledgers

   !> Whether something is a number, above 0.
   elemental logical function is_above_zero(x)
      real(wp), intent(in) :: x   !! the number, or none [any]

      is_above_zero = .false.
      if (ieee_is_finite(x)) is_above_zero = x > 0.0_wp
   end function is_above_zero

   !> Whether something is a number, exactly 0.
   elemental logical function is_zero(x)
      real(wp), intent(in) :: x   !! the number, or none; not below 0 [any]

      is_zero = .false.
      if (ieee_is_finite(x)) is_zero = x <= 0.0_wp
   end function is_zero

   !> A power of ten, a decade below a number and more.
   pure real(wp) function decade_below(x) result(power)
      real(wp), intent(in) :: x   !! the number, above 0 [any]

      power = 10.0_wp**(floor(log10(x)) - 1)
   end function decade_below

   !> The axis of errors, which reaches to those of all runs, of the reference, and to the one requested, in whole decades; errors
   !> of exactly 0 stand on its edge.
   pure function error_axis(study) result(ends)
      type(precision_t), intent(in) :: study   !! results
      integer :: ends(2)                       !! (2) powers of ten

      type(tol_run_t), allocatable :: runs(:)
      real(wp) :: far(2), x
      integer :: k

      runs = runs_of(study)
      far = study%accuracy
      x = study%reference%bar(study%wanted)
      if (is_above_zero(x)) far = [min(far(1), x), max(far(2), x)]
      do k = 1, size(runs)
         x = drawn_error(study, runs(k))
         if (ieee_is_finite(x)) far = [min(far(1), x), max(far(2), x)]
      end do
      ends = [floor(log10(far(1)*(1.0_wp - decade))), ceiling(log10(far(2)*(1.0_wp + decade)))]
      x = zero_of_errors(study)
      if (ieee_is_finite(x)) ends(1) = nint(log10(x))
   end function error_axis

   !> Whether any run kept its ledger.
   pure logical function any_ledger(study)
      type(precision_t), intent(in) :: study  !! results

      type(tol_run_t), allocatable :: runs(:)

      runs = runs_of(study)
      any_ledger = any(ieee_is_finite(runs%error(error_ledger)))
   end function any_ledger

   !> Whether any run is in some state.
   pure logical function any_state(study, state)
      type(precision_t), intent(in) :: study  !! results
      integer, intent(in) :: state            !! of a run

      type(tol_run_t), allocatable :: runs(:)

      runs = runs_of(study)
      any_state = any(runs%state == state)
   end function any_state

   !> Maximum processor time.
   pure real(wp) function largest_cpu(study) result(x)
      type(precision_t), intent(in) :: study  !! results

      type(tol_run_t), allocatable :: runs(:)

      runs = runs_of(study)
      x = max(0.0_wp, maxval(runs%cpu, mask=ieee_is_finite(runs%cpu)))
   end function largest_cpu

   !> Minimum processor time of a run that ended.
   pure real(wp) function smallest_cpu(study) result(x)
      type(precision_t), intent(in) :: study  !! results

      type(tol_run_t), allocatable :: runs(:)

      runs = runs_of(study)
      x = min(largest_cpu(study), minval(runs%cpu, mask=runs%state == tol_run_done))
   end function smallest_cpu

   !> A number as gnuplot reads it.
   function number(x) result(word)
      real(wp), intent(in) :: x              !! the number [any]
      character(:), allocatable :: word      !! its digits, or NaN

      character(24) :: digits

      word = "NaN"
      if (.not. ieee_is_finite(x)) return
      write (digits, "(es24.16e3)") x
      word = trim(adjustl(digits))
   end function number

end module precision_rows
