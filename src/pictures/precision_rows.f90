!> The numbers that the figures of a comparison of settings are drawn from.
module precision_rows
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use precision_results, only: error_ledger, precision_t, rung_done, rung_t
   use text, only: to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: any_ledger, error_axis, front_of, is_above_zero, largest_cpu, least_error, number, numbers_of, smallest_cpu, &
      zero_of_errors, zero_of_ledgers

   real(wp), parameter :: least_error = 1.0e-17_wp   !! drawn for a distance of nothing [1]
   real(wp), parameter :: decade = 0.2_wp            !! room beside an error, of it, for which the axis has another decade [1]
   real(wp), parameter :: least_below = 0.1_wp       !! of the reference's own error, drawn for what is less: it cannot be told [1]

contains

   !> The numbers: a block for each setting, two blank lines between them, then the front from the least error on, then the choice.
   function numbers_of(study) result(text)
      type(precision_t), intent(in) :: study   !! results
      character(:), allocatable :: text        !! whole lines

      type(buffer_t) :: lines
      type(rung_t), allocatable :: front(:)
      integer :: i, k

      if (ieee_is_finite(zero_of_errors(study))) call lines%line("# zero errors are drawn at "// &
                                                                number(zero_of_errors(study)))
      if (ieee_is_finite(zero_of_ledgers(study))) call lines%line("# zero energy errors are drawn at "// &
                                                                 number(zero_of_ledgers(study)))
      call lines%line("# tolerance or step [1 or s], error, CPU median [s], CPU minimum [s], right-hand sides, steps, "// &
                      "ledger, state, below")
      do k = 1, size(study%ladders)
         call lines%line("# "//study%ladders(k)%name)
         do i = 1, size(study%ladders(k)%rungs)
            call lines%line(row_of(study, study%ladders(k)%rungs(i)))
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
      if (study%choice%ladder > 0) call lines%line(row_of(study, study%ladders(study%choice%ladder)%rungs(study%choice%rung)))
      text = lines%get()
   end function numbers_of

   !> The runs of the front, from the least error on.
   function front_of(study) result(front)
      type(precision_t), intent(in) :: study       !! results
      type(rung_t), allocatable :: front(:)        !! (n) runs

      type(rung_t) :: one
      integer :: i, k

      allocate (front(0))
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            if (study%ladders(k)%rungs(i)%is_front) front = [front, study%ladders(k)%rungs(i)]
         end do
      end do
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
   function row_of(study, rung) result(line)
      type(precision_t), intent(in) :: study   !! results
      type(rung_t), intent(in) :: rung         !! the run
      character(:), allocatable :: line        !! its row

      real(wp) :: ledger

      ledger = rung%error(error_ledger)
      if (is_zero(ledger)) ledger = zero_of_ledgers(study)
      line = number(rung%asked)//" "//number(drawn_error(study, rung))//" "//number(rung%cpu)//" "//number(rung%cpu_least)//" "// &
             to_text(rung%count%evaluations)//" "//to_text(rung%count%steps)//" "//number(ledger)//" "// &
             to_text(rung%state)//" "//to_text(merge(1, 0, rung%is_below))
   end function row_of

   !> The error at which a run is drawn; NaN or infinite: it is not.
   pure real(wp) function drawn_error(study, rung) result(x)
      type(precision_t), intent(in) :: study   !! results
      type(rung_t), intent(in) :: rung         !! the run

      x = rung%error(study%wanted)
      if (rung%is_below) x = max(x, least_below*study%reference%bar(study%wanted))
      if (is_zero(x)) x = zero_of_errors(study)
   end function drawn_error

   !> Where errors of exactly 0 are drawn on a logarithmic axis, since they have no place of their own: a decade below all others
   !> and all tolerances.
   pure real(wp) function zero_of_errors(study) result(place)
      type(precision_t), intent(in) :: study   !! results

      real(wp) :: least, x
      integer :: i, k

      place = not_a_number()
      least = study%accuracy
      x = study%reference%bar(study%wanted)
      if (is_above_zero(x)) least = min(least, least_below*x)
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            x = study%ladders(k)%rungs(i)%error(study%wanted)
            if (study%ladders(k)%rungs(i)%is_below) x = max(x, least_below*study%reference%bar(study%wanted))
            if (is_above_zero(x)) least = min(least, x)
            if (is_zero(x)) place = 0.0_wp
         end do
         if (.not. study%ladders(k)%is_fixed) least = min(least, minval(study%ladders(k)%rungs%asked))
      end do
      if (ieee_is_finite(place)) place = decade_below(least)
   end function zero_of_errors

   !> The same of residuals of the ledger.
   pure real(wp) function zero_of_ledgers(study) result(place)
      type(precision_t), intent(in) :: study   !! results

      real(wp) :: least
      integer :: i, k

      place = not_a_number()
      least = epsilon(1.0_wp)
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            associate (x => study%ladders(k)%rungs(i)%error(error_ledger))
               if (is_above_zero(x)) least = min(least, x)
               if (is_zero(x)) place = 0.0_wp
            end associate
         end do
      end do
      if (ieee_is_finite(place)) place = decade_below(least)
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

   !> The axis of errors, which reaches to those of all runs, of the reference, and to the one wanted, in whole decades; errors of
   !> exactly 0 stand on its edge.
   pure function error_axis(study) result(ends)
      type(precision_t), intent(in) :: study   !! results
      integer :: ends(2)                       !! (2) powers of ten

      real(wp) :: far(2), x
      integer :: i, k

      far = study%accuracy
      x = study%reference%bar(study%wanted)
      if (is_above_zero(x)) far = [min(far(1), x), max(far(2), x)]
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            x = drawn_error(study, study%ladders(k)%rungs(i))
            if (ieee_is_finite(x)) far = [min(far(1), x), max(far(2), x)]
         end do
      end do
      ends = [floor(log10(far(1)*(1.0_wp - decade))), ceiling(log10(far(2)*(1.0_wp + decade)))]
      x = zero_of_errors(study)
      if (ieee_is_finite(x)) ends(1) = nint(log10(x))
   end function error_axis

   !> Whether any run kept its ledger.
   pure logical function any_ledger(study)
      type(precision_t), intent(in) :: study  !! results

      integer :: i, k

      any_ledger = .false.
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            if (ieee_is_finite(study%ladders(k)%rungs(i)%error(error_ledger))) any_ledger = .true.
         end do
      end do
   end function any_ledger

   !> Greatest processor time.
   pure real(wp) function largest_cpu(study) result(x)
      type(precision_t), intent(in) :: study  !! results

      integer :: i, k

      x = 0.0_wp
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            if (ieee_is_finite(study%ladders(k)%rungs(i)%cpu)) x = max(x, study%ladders(k)%rungs(i)%cpu)
         end do
      end do
   end function largest_cpu

   !> Least processor time of a run that ended.
   pure real(wp) function smallest_cpu(study) result(x)
      type(precision_t), intent(in) :: study  !! results

      integer :: i, k

      x = largest_cpu(study)
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            if (study%ladders(k)%rungs(i)%state == rung_done) x = min(x, study%ladders(k)%rungs(i)%cpu)
         end do
      end do
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
