!> How right a run was: warnings of errors that a careful reader should know, and the limits of its deck.
module run_audit
   use errors, only: error_t, exit_audit, set_error
   use guards, only: guards_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use recorder, only: summary_t
   use stop_condition, only: stop_t
   use text, only: append_text, real_text
   implicit none (type, external)
   private
   public :: audit, limits_t, warn_of_errors

   real(wp), parameter :: careful_ledger = 1.0e-4_wp     !! residual of the largest energy that is worth a warning [1]
   real(wp), parameter :: careful_energy = 1.0e-3_wp     !! energy that contacts made, of the largest, that is worth a warning [1]
   real(wp), parameter :: noise = 1.0e3_wp               !! round-off of the ledger, in spacings of what it adds up [1]
   real(wp), parameter :: careful_violation = 1.0e-4_wp  !! violation, of the size of the bodies or a radian, that is [1]

   !> What the results must fulfil, and what ends a run before its end.
   type :: limits_t
      real(wp) :: energy = 0.0_wp      !! maximum residual of the ledger over the largest energy, 0: none [1]
      real(wp) :: violation = 0.0_wp   !! maximum violation of a constraint, 0: none [m]
      real(wp) :: cpu = 0.0_wp         !! processor time allowed, 0: no limit [s]
      real(wp) :: clock = 0.0_wp       !! time allowed by the clock on the wall, 0: no limit [s]
      real(wp) :: wear_from = -huge(1.0_wp)  !! time from which wear is counted [s]
      type(guards_t) :: guards         !! what no mechanism does
      type(stop_t) :: stop             !! conditions that end it by intent
   end type limits_t

contains

   !> What a careful reader of the results should know.
   subroutine warn_of_errors(system, worst, worst_row, lost, added, summary)
      type(mechanism_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: worst                !! maximum violation, over the size of the bodies or one radian [1]
      integer, intent(in) :: worst_row             !! the row it belongs to
      real(wp), intent(in) :: lost                 !! minimum that contacts had lost: negative, they made energy [J]
      real(wp), intent(in) :: added                !! magnitude of what the ledger adds up [J]
      type(summary_t), intent(inout) :: summary    !! warnings are added to it

      if (system%ledger%is_kept) then  ! else the residual is a NaN, which must not be compared
         associate (quality => summary%quality)
            if (quality%energy_residual_max > careful_ledger*quality%energy_max .and. &
                .not. is_round_off(quality%energy_residual_max, added)) then
               call append_text(summary%warnings, "energy balance violated: the energy error reached "// &
                                real_text(quality%energy_residual_max/quality%energy_max, 3)// &
                                " of the maximum energy (limit "//real_text(careful_ledger, 1)//"); reduce the tolerance")
            end if
         end associate
         if (lost < -careful_energy*summary%quality%energy_max) then
            call append_text(summary%warnings, "contacts created up to "//real_text(-lost, 3)//" J: possible causes are a law "// &
                             "without a potential (faces = blend or book; foundation has one), or, with faces, a "// &
                             "corner that overlapped as it passed an end of its guide")
         end if
      end if
      if (worst > careful_violation) then
         call append_text(summary%warnings, "'"//system%linkage%row_name(worst_row)//"' was violated by "// &
                          real_text(worst, 3)// &
                          trim(merge(" rad                      ", " of the size of the bodies", &
                                     system%linkage%rows%is_angle(worst_row)))// &
                          "; check for a jump of a driver, or reduce the tolerance")
      end if
   end subroutine warn_of_errors

   !> Whether a residual of the ledger is the round-off of what it adds up: all there is where nothing moves.
   pure logical function is_round_off(residual, added)
      real(wp), intent(in) :: residual   !! maximum of the run [J]
      real(wp), intent(in) :: added      !! magnitude of what the ledger adds up [J]

      is_round_off = residual <= noise*epsilon(1.0_wp)*added
   end function is_round_off

   !> Compare the results with the deck's limits.
   subroutine audit(summary, added, limits, error)
      type(summary_t), intent(in) :: summary             !! results
      real(wp), intent(in) :: added                      !! magnitude of what the ledger adds up [J]
      type(limits_t), intent(in) :: limits               !! limits
      type(error_t), allocatable, intent(out) :: error   !! a limit is exceeded

      if (limits%energy > 0.0_wp .and. summary%quality%has_ledger) then
         if (.not. (summary%quality%energy_residual_max <= limits%energy*summary%quality%energy_max .or. &
                    is_round_off(summary%quality%energy_residual_max, added))) then
            call set_error(error, exit_audit, "audit failed: the energy error reached "// &
                           real_text(summary%quality%energy_residual_max/summary%quality%energy_max, 3)// &
                           " of the maximum energy, allowed "//real_text(limits%energy, 3)//new_line("a")// &
                           "  = results are saved; reduce the tolerance")
            return
         end if
      end if
      if (limits%violation > 0.0_wp .and. .not. summary%quality%violation_max <= limits%violation) then
         call set_error(error, exit_audit, "audit failed: a constraint was violated by "// &
                        real_text(summary%quality%violation_max, 3)//" m (or rad), allowed "// &
                        real_text(limits%violation, 3)//new_line("a")// &
                        "  = results are saved; reduce the tolerance or raise the stabilisation gains")
      end if
   end subroutine audit

end module run_audit
