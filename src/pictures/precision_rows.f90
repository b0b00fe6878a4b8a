!> The numbers that the figures of a comparison of settings are drawn from.
module precision_rows
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use precision_results, only: error_ledger, precision_t, rung_t
   use text, only: to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: drawn_error, front_of, least_error, number, numbers_of

   real(wp), parameter :: least_error = 1.0e-17_wp   !! drawn for an error of nothing [1]
   real(wp), parameter :: least_below = 0.1_wp       !! of the reference's own error, drawn for what is less: it cannot be told [1]

contains

   !> The numbers: a block for each setting, two blank lines between them, then the front from the least error on, then the choice.
   function numbers_of(study) result(text)
      type(precision_t), intent(in) :: study   !! results
      character(:), allocatable :: text        !! whole lines

      type(buffer_t) :: lines
      type(rung_t), allocatable :: front(:)
      integer :: i, k

      call lines%line("# asked [1 or s], error, CPU median [s], CPU least [s], right-hand sides, steps, ledger, state, below")
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
      if (ieee_is_finite(ledger)) ledger = max(ledger, least_error)
      line = number(rung%asked)//" "//number(drawn_error(study, rung))//" "//number(rung%cpu)//" "//number(rung%cpu_least)//" "// &
             to_text(rung%count%evaluations)//" "//to_text(rung%count%steps)//" "//number(ledger)//" "// &
             to_text(rung%state)//" "//to_text(merge(1, 0, rung%is_below))
   end function row_of

   !> The error at which a run is drawn; NaN or infinite: it is not.
   pure real(wp) function drawn_error(study, rung) result(x)
      type(precision_t), intent(in) :: study   !! results
      type(rung_t), intent(in) :: rung         !! the run

      x = rung%error(study%wanted)
      if (ieee_is_finite(x)) x = max(x, least_error)
      if (rung%is_below) x = max(x, least_below*study%reference%bar(study%wanted))
   end function drawn_error

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
