!> IMSL's names of the integrator's controls: folded into the plain ones, so that nothing is said twice.
module imsl_names
   use cell_checks, only: check_range
   use columns, only: column_of
   use diagnostics, only: diagnostics_t
   use item, only: item_t, place_of
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: fold_imsl_names, is_imsl_name

   character(*), parameter :: plain(6) = [character(20) :: "tolerance", "initial_step", "minimum_step", "maximum_step", &
                                                           "maximum_steps", "maximum_evaluations"]  !! plain names
   character(*), parameter :: imsl(6) = [character(6) :: "tol", "hinit", "hmin", "hmax", "mxstep", "mxfcn"]
      !! IMSL's names of the same
   character(*), parameter :: norms(0:3) = [character(9) :: "mixed", "absolute", "relative", "euclidean"]
      !! words for INORM = 0 to 3

contains

   !> Whether a key is IMSL's name of another one.
   pure logical function is_imsl_name(name)
      character(*), intent(in) :: name  !! the key

      is_imsl_name = any(imsl == name) .or. name == "inorm"
   end function is_imsl_name

   !> Move what stands under IMSL's names to the plain ones.
   subroutine fold_imsl_names(info, item, diagnostics)
      type(kind_info_t), intent(in) :: info               !! kind of the settings
      type(item_t), intent(inout) :: item                 !! the settings
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      do k = 1, size(plain)
         associate (own => item%values(place_of(item, trim(plain(k)))), other => item%values(place_of(item, trim(imsl(k)))))
            if (other%number > 0.0_wp) then
               if (own%given .and. abs(own%number - other%number) > 0.0_wp) then
                  call diagnostics%add(other%location, "'"//trim(imsl(k))//"' and '"//trim(plain(k))// &
                                       "' are two names of the same setting", "differs from '"//trim(plain(k))//"'", &
                                       "give only one of them")
               end if
               own%number = other%number
               own%given = .true.
               own%location = other%location
               call check_range(info%columns(column_of(info, trim(plain(k)))), own%number, "1", own%location, "in key "// &
                                trim(imsl(k))//" of "//info%name, diagnostics)
            end if
            other%number = 0.0_wp
            other%given = .false.
            if (k >= 5 .and. abs(own%number - anint(own%number)) > 0.0_wp) then
               call diagnostics%add(own%location, "'"//trim(plain(k))//"' must be an integer", "not an integer")
            end if
         end associate
      end do
      associate (norm => item%values(place_of(item, "norm")), inorm => item%values(place_of(item, "inorm")))
         if (inorm%number < 0.0_wp .or. inorm%number > real(ubound(norms, 1), wp)) return
         if (abs(inorm%number - anint(inorm%number)) > 0.0_wp) then
            call diagnostics%add(inorm%location, "'inorm' must be 0, 1, 2 or 3", "not one of these")
         else if (norm%given .and. norm%text /= trim(norms(nint(inorm%number)))) then
            call diagnostics%add(inorm%location, "'inorm' and 'norm' are two names of the same setting", "differs from 'norm'", &
                                 "give only one of them")
         else
            norm%text = trim(norms(nint(inorm%number)))
            norm%given = .true.
            inorm%number = -1.0_wp
            inorm%given = .false.
         end if
      end associate
   end subroutine fold_imsl_names

end module imsl_names
