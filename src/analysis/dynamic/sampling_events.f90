!> Rows before and after events, and before instants at which functions of time are not smooth.
submodule(sampling) sampling_events
   implicit none (type, external)

contains

   !> The row before the events at the end of the last steps, where a contact ends or a force may jump.
   module procedure before_events
      integer :: k, kind
      logical :: begins, ends, has_end, jumps

      has_end = .false.
      self%has_onset = .false.
      self%has_jump = .false.
      do k = 1, size(parts)
         associate (part => whole%parts(parts(k)))
            call part%monitor%extrapolate(part%system, part%method, ends, begins, jumps)
         end associate
         has_end = has_end .or. ends
         self%has_onset = self%has_onset .or. begins
         self%has_jump = self%has_jump .or. jumps
      end do
      if (.not. (has_end .or. self%has_jump)) then
         call forget(self)
         return
      end if
      kind = merge(row_peak, row_jump, whole%owes_row())
      if (has_end) kind = row_end
      if (self%t_row < whole%t) call put_row_here(self, whole, plan, kind, 0.0_wp, residual, recorder, error)
      call forget(self)
      call whole%note_row()
   end procedure before_events

   !> The row before an instant at which functions of time are not smooth, if one is owed. What is due behind it is found anew.
   module procedure before_instant
      self%due = -huge(1.0_wp)
      if (whole%owes_row() .and. self%t_row < whole%t) then
         call put_row_here(self, whole, plan, row_peak, 0.0_wp, residual, recorder, error)
         call whole%note_row()
      end if
      call forget(self)
   end procedure before_instant

   !> The row after the events, where a contact started or a force may have jumped.
   module procedure after_events
      if (.not. (self%has_onset .or. self%has_jump)) return
      call put_row_here(self, whole, plan, merge(row_onset, row_jump, self%has_onset), maxval(whole%parts(parts)%monitor%shift), &
                        residual, recorder, error)
      call whole%note_row()
   end procedure after_events

end submodule sampling_events
