!> Where settings of a comparison do not do as they are asked, and why, as text.
module bend_text
   use kinds, only: wp
   use precision_results, only: bend_lost, bend_luck, bend_scatter, bend_short, bend_steps, bend_t, bend_violation, tol_sweep_t, &
      precision_t, tol_run_done
   use text, only: append_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: add_bends, bends_of

   real(wp), parameter :: held = 1.1_wp      !! steps up to so many times the fewest that are possible are the deck's maximum [1]

contains

   !> A line for each.
   subroutine add_bends(lines, study)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(precision_t), intent(in) :: study      !! results

      type(text_t), allocatable :: remarks(:)
      integer :: k

      remarks = bends_of(study)
      do k = 1, size(remarks)
         call lines%line(remarks(k)%s)
      end do
   end subroutine add_bends

   !> Runs whose steps the deck's maximum one holds, so that their tolerance changes nothing, and stretches of tolerances or steps
   !> over which errors do not fall.
   function bends_of(study) result(remarks)
      type(precision_t), intent(in) :: study        !! results
      type(text_t), allocatable :: remarks(:)       !! (n) one line each

      integer :: i, k, n

      allocate (remarks(0))
      do k = 1, size(study%tol_sweeps)
         associate (tol_sweep => study%tol_sweeps(k))
            n = 0
            if (.not. tol_sweep%is_fixed .and. study%longest_step > 0.0_wp) then
               n = count(tol_sweep%tol_runs%state == tol_run_done &
                         .and. tol_sweep%tol_runs%count%steps*study%longest_step < held*study%end)
            end if
            if (n > 0) call append_text(remarks, "held: "//tol_sweep%name//", "//to_text(n)// &
                                        " runs: the 'maximum_step' of the deck, "//real_text(study%longest_step, 3)// &
                                        " s, limits the steps, not the tolerance")
            do i = 1, size(tol_sweep%bends)
               call append_text(remarks, "bent: "//tol_sweep%name//" "//stretch(tol_sweep, tol_sweep%bends(i))// &
                                ": errors fall by less than a factor of 3 over two decades; "//cause_text(tol_sweep, &
                                                                                                          tol_sweep%bends(i)))
            end do
         end associate
      end do
   end function bends_of

   !> From what to what a bend goes.
   function stretch(tol_sweep, bend) result(words)
      type(tol_sweep_t), intent(in) :: tol_sweep       !! the tolerance sweep
      type(bend_t), intent(in) :: bend           !! its bend
      character(:), allocatable :: words         !! as `1e-4 to 1e-7`

      words = real_text(tol_sweep%tol_runs(bend%first)%asked, 2)//" to "//real_text(tol_sweep%tol_runs(bend%last)%asked, 2)
      if (tol_sweep%is_fixed) words = words//" s"
   end function stretch

   !> Why.
   function cause_text(tol_sweep, bend) result(words)
      type(tol_sweep_t), intent(in) :: tol_sweep       !! the tolerance sweep
      type(bend_t), intent(in) :: bend           !! its bend
      character(:), allocatable :: words         !! one clause

      select case (bend%cause)
      case (bend_steps)
         words = "its number of steps hardly changes ("//to_text(tol_sweep%tol_runs(bend%first)%count%steps)//" to "// &
                 to_text(tol_sweep%tol_runs(bend%last)%count%steps)//"): stability or events determine the steps"
      case (bend_violation)
         words = "the constraint violation stays constant too: the stabilisation determines both"
      case (bend_lost)
         words = "the errors are as large as the motion itself"
      case (bend_short)
         words = "the errors are constant: their source, as a grazing contact, is shorter than all these steps"
      case (bend_luck)
         words = "the errors of neighbouring runs scatter: in some runs errors of opposite sign cancel"
      case (bend_scatter)
         words = "cause unknown"
      end select
   end function cause_text

end module bend_text
