!> Units of an Adams dataset: factors to SI, and how a deck writes them.
!>
!> A length of the dataset is `length_text` long in a deck, and so on. Lengths below half a metre are written in mm, all others
!> in m.
!> Sources of the factors: the international yard and pound (1959), standard gravity 9.80665 m/s^2.
!> Limits: without UNITS quantities are taken in SI.
module adams_units
   use dataset, only: argument_t, has_word, statement_t, upper_case
   use kinds, only: wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: adams_units_t, read_units

   real(wp), parameter :: pound = 0.45359237_wp       !! [kg]
   real(wp), parameter :: gravity = 9.80665_wp        !! standard gravity [m/s^2]
   real(wp), parameter :: foot = 0.3048_wp            !! [m]

   !> A unit with its name.
   type :: named_t
      character(14) :: name = ""     !! in capitals
      real(wp) :: factor = 1.0_wp    !! to SI [any]
   end type named_t

   type(named_t), parameter :: lengths(*) = [named_t("METER", 1.0_wp), named_t("MILLIMETER", 1.0e-3_wp), &
      named_t("CENTIMETER", 1.0e-2_wp), named_t("KILOMETER", 1.0e3_wp), named_t("INCH", foot/12.0_wp), named_t("FOOT", foot), &
      named_t("MILE", 5280.0_wp*foot), named_t("MICROMETER", 1.0e-6_wp), named_t("NANOMETER", 1.0e-9_wp), &
      named_t("YARD", 3.0_wp*foot)]
   type(named_t), parameter :: masses(*) = [named_t("KILOGRAM", 1.0_wp), named_t("GRAM", 1.0e-3_wp), named_t("TONNE", 1.0e3_wp), &
      named_t("POUND_MASS", pound), named_t("OUNCE_MASS", pound/16.0_wp), named_t("KPOUND_MASS", 1.0e3_wp*pound), &
      named_t("SLUG", pound*gravity/foot), named_t("SLINCH", 12.0_wp*pound*gravity/foot), named_t("US_TON", 2.0e3_wp*pound)]
   type(named_t), parameter :: forces(*) = [named_t("NEWTON", 1.0_wp), named_t("KNEWTON", 1.0e3_wp), &
      named_t("KILONEWTON", 1.0e3_wp), named_t("DYNE", 1.0e-5_wp), named_t("POUND_FORCE", pound*gravity), &
      named_t("OUNCE_FORCE", pound*gravity/16.0_wp), named_t("KPOUND_FORCE", 1.0e3_wp*pound*gravity), &
      named_t("KILOGRAM_FORCE", gravity), named_t("POUNDAL", pound*foot), named_t("MILLINEWTON", 1.0e-3_wp)]
   type(named_t), parameter :: times(*) = [named_t("SECOND", 1.0_wp), named_t("MILLISECOND", 1.0e-3_wp), named_t("MINUTE", &
         60.0_wp), &
      named_t("HOUR", 3600.0_wp), named_t("MICROSECOND", 1.0e-6_wp)]

   !> Units of a dataset.
   type :: adams_units_t
      real(wp) :: length = 1.0_wp        !! [m]
      real(wp) :: mass = 1.0_wp          !! [kg]
      real(wp) :: force = 1.0_wp         !! [N]
      real(wp) :: time = 1.0_wp          !! [s]
      logical :: is_given = .false.      !! the dataset says so
   contains
      procedure :: length_name
      procedure :: length_shown
      procedure :: length_text
      procedure :: force_text
      procedure :: time_text
   end type adams_units_t

contains

   !> Take a UNITS statement.
   subroutine read_units(statement, units, message)
      type(statement_t), intent(in) :: statement          !! the statement
      type(adams_units_t), intent(inout) :: units         !! what it says
      character(:), allocatable, intent(out) :: message   !! what is not known; empty: all is well

      integer :: k

      message = ""
      units%is_given = .true.
      do k = 1, size(statement%arguments)
         associate (argument => statement%arguments(k))
            if (size(argument%values) == 0) cycle
            select case (argument%name(1:1))
            case ("F"); call take(forces, argument, units%force, message)
            case ("M"); call take(masses, argument, units%mass, message)
            case ("L"); call take(lengths, argument, units%length, message)
            case ("T"); call take(times, argument, units%time, message)
            case ("S"); call take_system(argument%values(1)%s, units, message)
            case default; message = "unknown argument "//argument%name//" of UNITS"
            end select
         end associate
      end do
      if (has_word(statement, "NONE")) message = "UNITS is empty"
   end subroutine read_units

   !> A unit by its name, or by the start of it.
   subroutine take(list, argument, factor, message)
      type(named_t), intent(in) :: list(:)                    !! units that are known
      type(argument_t), intent(in) :: argument                !! with the name
      real(wp), intent(inout) :: factor                       !! to SI [any]
      character(:), allocatable, intent(inout) :: message     !! set if it is not known

      character(:), allocatable :: word
      integer :: k

      word = upper_case(argument%values(1)%s)
      do k = 1, size(list)
         if (index(list(k)%name, word) /= 1) cycle
         factor = list(k)%factor
         return
      end do
      message = "unknown unit '"//argument%values(1)%s//"' of "//argument%name
   end subroutine take

   !> A set of units by its name.
   subroutine take_system(name, units, message)
      character(*), intent(in) :: name                        !! as written
      type(adams_units_t), intent(inout) :: units             !! set
      character(:), allocatable, intent(inout) :: message     !! set if it is not known

      units%time = 1.0_wp
      select case (upper_case(name))
      case ("MKS"); units = adams_units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, .true.)
      case ("MMKS"); units = adams_units_t(1.0e-3_wp, 1.0_wp, 1.0_wp, 1.0_wp, .true.)
      case ("CGS"); units = adams_units_t(1.0e-2_wp, 1.0e-3_wp, 1.0e-5_wp, 1.0_wp, .true.)
      case ("FPS"); units = adams_units_t(foot, pound*gravity/foot, pound*gravity, 1.0_wp, .true.)
      case ("IPS"); units = adams_units_t(foot/12.0_wp, 12.0_wp*pound*gravity/foot, pound*gravity, 1.0_wp, .true.)
      case default; message = "unknown SYSTEM '"//name//"' of UNITS"
      end select
   end subroutine take_system

   !> The unit in which a deck's tables have lengths.
   pure function length_name(self) result(name)
      class(adams_units_t), intent(in) :: self   !! units of the dataset
      character(:), allocatable :: name          !! mm or m

      name = trim(merge("mm", "m ", self%length < 0.5_wp))
   end function length_name

   !> That unit.
   pure real(wp) function length_shown(self)
      class(adams_units_t), intent(in) :: self   !! units of the dataset

      length_shown = merge(1.0e-3_wp, 1.0_wp, self%length < 0.5_wp)
   end function length_shown

   !> A length of the dataset in a deck's expressions, as `1mm` or `25.4mm`.
   pure function length_text(self) result(words)
      class(adams_units_t), intent(in) :: self   !! units of the dataset
      character(:), allocatable :: words         !! a number with its unit

      words = real_text(self%length/self%length_shown(), 15)//self%length_name()
   end function length_text

   !> A force of the dataset.
   pure function force_text(self) result(words)
      class(adams_units_t), intent(in) :: self   !! units of the dataset
      character(:), allocatable :: words         !! a number with its unit

      words = real_text(self%force, 15)//"N"
   end function force_text

   !> A time of the dataset.
   pure function time_text(self) result(words)
      class(adams_units_t), intent(in) :: self   !! units of the dataset
      character(:), allocatable :: words         !! a number with its unit

      words = real_text(self%time, 15)//"s"
   end function time_text

end module adams_units
