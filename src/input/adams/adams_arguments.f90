!> Arguments of the statements that a deck has words for; what else a statement says is named.
!>
!> Names may be abbreviated, down to one letter: a name that is the start of a known one is taken for that.
!> Source: the public descriptions of the statements of Adams/Solver.
module adams_arguments
   use adams_model, only: adams_model_t, leave_out
   use dataset, only: line_words, statement_t, upper_case
   use text, only: split_blank, text_t, to_text
   implicit none (type, external)
   private
   public :: name_small_degrees, name_unknown_arguments

contains

   !> Put arguments that nothing reads on the list of what is omitted.
   subroutine name_unknown_arguments(model, statement)
      type(adams_model_t), intent(inout) :: model      !! the dataset
      type(statement_t), intent(in) :: statement       !! one of its statements, with its name in full

      type(text_t), allocatable :: known(:)
      integer :: i, k

      if (known_arguments(statement%keyword) == "") return
      known = split_blank(known_arguments(statement%keyword))
      do k = 1, size(statement%arguments)
         associate (name => statement%arguments(k)%name)
            if (len(name) == 0) cycle
            if (any([(index(known(i)%s, name) == 1, i=1, size(known))])) cycle
            call leave_out(model, statement, "its "//name//" has no equivalent in a deck", statement%arguments(k)%at)
         end associate
      end do
   end subroutine name_unknown_arguments

   !> Report of degrees in expressions that may be meant as exponents of Fortran: `1D-3` is a degree less 3.
   subroutine name_small_degrees(model, statement)
      type(adams_model_t), intent(inout) :: model      !! the dataset
      type(statement_t), intent(in) :: statement       !! one of its statements, with its name in full

      character(*), parameter :: digits = "0123456789", expressions(7) = ["FUNCTION", "FX      ", "FY      ", "FZ      ", &
                                                                          "TX      ", "TY      ", "TZ      "]
      character(:), allocatable :: text
      integer :: at, first, k, last

      do k = 1, size(statement%arguments)
         associate (it => statement%arguments(k))
            if (len(it%name) == 0 .or. size(it%values) == 0) cycle
            if (.not. any(index(expressions, it%name) == 1)) cycle
            text = upper_case(it%values(1)%s)
            do at = 2, len(text) - 2
               if (text(at:at) /= "D" .or. scan(text(at + 1:at + 1), "+-") == 0) cycle
               if (scan(text(at + 2:at + 2), digits) == 0) cycle
               first = verify(text(:at - 1), digits//".", back=.true.) + 1
               if (verify(text(first:at - 1), ".") == 0) cycle
               if (first > 1) then
                  if (verify(text(first - 1:first - 1), "ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == 0) cycle
               end if
               last = at + 1 + verify(text(at + 2:)//" ", digits) - 1
               call model%changed%add(line_words(it%at)//"'"//it%values(1)%s(first:last)//"' is "//text(first:at - 1)// &
                     merge(" degrees plus ", " degrees minus", text(at + 1:at + 1) == "+")//" "//text(at + 2:last)// &
                     "; use E for the exponent")
            end do
         end associate
      end do
   end subroutine name_small_degrees

   !> Arguments that are read, or that say nothing of a mechanism; blank: that is for the reader of the statement to say.
   pure function known_arguments(keyword) result(names)
      character(*), intent(in) :: keyword         !! name of the statement
      character(:), allocatable :: names          !! in capitals, in full

      select case (keyword)
      case ("PART"); names = "GROUND MASS CM IM IP QG REULER EULER ZG XG VX VY VZ WX WY WZ VM WM EXACT X Y Z PSI THETA PHI MATERIAL"
      case ("MARKER"); names = "PART QP REULER EULER ZP XP USEXP FLOATING FLEX_BODY POINT_MASS"
      case ("JOINT")
         names = "I J REVOLUTE TRANSLATIONAL CYLINDRICAL SPHERICAL UNIVERSAL HOOKE PLANAR FIXED SCREW CONVEL RACKPIN " &
                 //"PITCH PD IC ICROT ICTRAN"
      case ("JPRIM"); names = "I J ATPOINT INLINE INPLANE ORIENTATION PARALLEL_AXES PERPENDICULAR"
      case ("MOTION")
         names = "JOINT I J TRANSLATIONAL ROTATIONAL X Y Z B1 B2 B3 DISPLACEMENT VELOCITY ACCELERATION ICDISP ICVEL FUNCTION"
      case ("SFORCE"); names = "I J TRANSLATIONAL ROTATIONAL ACTIONONLY FUNCTION ROUTINE"
      case ("SPRINGDAMPER"); names = "I J TRANSLATIONAL ROTATIONAL K C LENGTH FORCE KT CT ANGLE TORQUE"
      case ("BUSHING"); names = "I J K C KT CT FORCE TORQUE"
      case ("FIELD"); names = "I J KMATRIX CMATRIX CRATIO FORCE LENGTH"
      case ("BEAM"); names = "I J LENGTH IXX IYY IZZ AREA ASY ASZ EMODULUS GMODULUS CMATRIX CRATIO"
      case ("CONTACT")
         names = "IGEOM JGEOM IMPACT STIFFNESS EXPONENT DAMPING DMAX POISSON PENALTY RESTITUTION_COEFFICIENT COULOMB_FRICTION " &
                 //"MU_STATIC MU_DYNAMIC STICTION_TRANSITION_VELOCITY FRICTION_TRANSITION_VELOCITY IFUNCTION IROUTINE"
      case ("VFORCE"); names = "I JFLOAT RM FX FY FZ FUNCTION ROUTINE"
      case ("VTORQUE"); names = "I JFLOAT RM TX TY TZ FUNCTION ROUTINE"
      case ("GFORCE"); names = "I JFLOAT RM FX FY FZ TX TY TZ FUNCTION ROUTINE"
      case ("GEAR"); names = "JOINTS CV"
      case ("COUPLER"); names = "JOINTS TYPE SCALES FUNCTION ROUTINE"
      case ("SPLINE"); names = "X Y LINEAR_EXTRAPOLATE"
      case ("ACCGRAV", "GRAVITY"); names = "IGRAV JGRAV KGRAV"
      case default; names = ""
      end select
   end function known_arguments

end module adams_arguments
