!> Statements of Adams by name: abbreviations in full, and which of them have a place in a deck.
!>
!> A name may be cut after the letters that make it the only one of the list; a name that could be two is taken as written.
!> Source: the public descriptions of the statements of Adams/Solver.
module adams_names
   use dataset, only: statement_t
   use text, only: split_blank, text_t
   implicit none (type, external)
   private
   public :: full_names, is_known, is_refused, is_setting, is_understood, reason_against

   character(*), parameter :: understood = &
      "ACCGRAV GRAVITY JOINT JPRIM MARKER MOTION GEAR COUPLER PART SFORCE SPRINGDAMPER UNITS VFORCE VTORQUE GFORCE VARIABLE GCON " &
      //"SPLINE BEAM BUSHING FIELD CONTACT"
   character(*), parameter :: refused = "NFORCE FLEX_BODY FE_PART FEMDATA"   !! elastic bodies
   character(*), parameter :: settings = "DEBUG EQUILIBRIUM GRAPHICS IC INTEGRATOR KINEMATICS LSOLVER OUTPUT PREFERENCES " &
      //"REQUEST MREQUEST RESULTS TITLE LIST MATERIAL"   !! no part of the mechanism
   character(*), parameter :: others = "ADAMS_DOC_FILENAME ARRAY CURVE CVCV CVSF DIFF DV END " &
      //"FRICTION FORCE GSE LSE MATRIX MFORCE PINPUT POINT_MASS POUTPUT PTCV PTSF RULE SENSOR SFSF " &
      //"STRING SURFACE TFSISO TIRE UCON USERCON"

contains

   !> Put the names of all statements in full; words without a slash are no abbreviations.
   subroutine full_names(statements)
      type(statement_t), intent(inout) :: statements(:)   !! (n) their keywords are changed

      type(text_t), allocatable :: known(:)
      integer :: found, i, k

      known = split_blank(understood//" "//refused//" "//settings//" "//others)
      do k = 1, size(statements)
         found = 0
         if (.not. statements(k)%has_slash) cycle
         do i = 1, size(known)
            if (index(known(i)%s, statements(k)%keyword) /= 1) cycle
            if (known(i)%s == statements(k)%keyword) then
               found = i
               exit
            end if
            found = merge(i, -1, found == 0)
         end do
         if (found > 0) statements(k)%keyword = known(found)%s
      end do
   end subroutine full_names

   !> Whether there is such a statement, with a slash behind its name.
   pure logical function is_known(statement)
      type(statement_t), intent(in) :: statement  !! its name in full

      is_known = statement%has_slash .and. &
                 is_one(statement%keyword, understood//" "//refused//" "//settings//" "//others)
   end function is_known

   !> Whether a deck can have what a statement says.
   pure logical function is_understood(keyword)
      character(*), intent(in) :: keyword  !! in full

      is_understood = is_one(keyword, understood)
   end function is_understood

   !> Whether a model with such a statement is no mechanism of rigid bodies.
   pure logical function is_refused(keyword)
      character(*), intent(in) :: keyword  !! in full

      is_refused = is_one(keyword, refused)
   end function is_refused

   !> Whether a statement is about the simulation and not the mechanism.
   pure logical function is_setting(keyword)
      character(*), intent(in) :: keyword  !! in full

      is_setting = is_one(keyword, settings)
   end function is_setting

   !> Why a deck does not have what a statement says.
   pure function reason_against(keyword) result(reason)
      character(*), intent(in) :: keyword          !! in full
      character(:), allocatable :: reason          !! one line

      select case (keyword)
      case ("FRICTION")
         reason = "its law is not supported; joints of a deck name a row of friction.* in their column 'friction'"
      case ("MFORCE", "CURVE", "MATRIX", "STRING", "ARRAY")
         reason = "it belongs to statements that are not supported"
      case ("CVCV", "PTCV", "CVSF", "PTSF", "SFSF", "SURFACE"); reason = "contact of curves and surfaces is not supported"
      case ("DIFF", "GSE", "LSE", "TFSISO", "DV", "PINPUT", "POUTPUT", "SENSOR", "RULE")
         reason = "user-defined equations and control are not supported"
      case ("UCON", "USERCON"); reason = "user-defined constraints are not supported"
      case ("GCON"); reason = "user-defined constraints except distances are not supported"
      case ("POINT_MASS"); reason = "gudgeon supports only bodies with inertia"
      case ("TIRE", "FORCE"); reason = "user code outside the dataset"
      case default; reason = "not supported"
      end select
   end function reason_against

   !> Whether a word stands in a list.
   pure logical function is_one(word, list)
      character(*), intent(in) :: word  !! the word
      character(*), intent(in) :: list  !! blank-separated

      is_one = index(" "//list//" ", " "//word//" ") > 0
   end function is_one

end module adams_names
