!> Units that have a name of their own.
!>
!> US customary units are exact by definition: 1 inch = 25.4 mm, 1 lb = 0.45359237 kg, 1 lbf = 1 lb x 9.80665 m/s^2 (NIST Special
!> Publication 811 (2008), appendix B); hp is 550 ft.lbf/s, gal the US gallon of 231 cubic inches.
module named_units
   use kind_info, only: dim_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: n_named, named, named_unit_t, spelt_out, unit_t

   !> A unit: x of it are `(x + offset)*numerator/denominator*10**power` in SI.
   type :: unit_t
      real(wp) :: numerator = 1.0_wp    !! of the factor [1]
      real(wp) :: denominator = 1.0_wp  !! of the factor [1]
      integer :: power = 0              !! of ten
      real(wp) :: offset = 0.0_wp       !! of degrees Celsius, else zero [K]
      type(dim_t) :: dimension          !! what it measures
   end type unit_t

   !> A unit that has a name of its own.
   type :: named_unit_t
      character(4) :: name = ""       !! as written
      character(8) :: prefixes = ""   !! letters that may stand before it
      type(unit_t) :: unit            !! its factor and dimension
   end type named_unit_t

   real(wp), parameter :: kelvin_of_ice = 273.15_wp  !! 0 degC [K]

   integer, parameter :: n_named = 31
   type(named_unit_t), parameter :: named(n_named) = [ &
      & named_unit_t("m", "GMkdcmun", unit_t(dimension=dim_t(m=1))), &
      & named_unit_t("g", "Mkmun", unit_t(power=-3, dimension=dim_t(kg=1))), &
      & named_unit_t("s", "munp", unit_t(dimension=dim_t(s=1))), &
      & named_unit_t("N", "GMkmun", unit_t(dimension=dim_t(kg=1, m=1, s=-2))), &
      & named_unit_t("Pa", "GMkmu", unit_t(dimension=dim_t(kg=1, m=-1, s=-2))), &
      & named_unit_t("J", "GMkmun", unit_t(dimension=dim_t(kg=1, m=2, s=-2))), &
      & named_unit_t("W", "GMkmun", unit_t(dimension=dim_t(kg=1, m=2, s=-3))), &
      & named_unit_t("Hz", "GMkm", unit_t(dimension=dim_t(s=-1))), &
      & named_unit_t("rad", "mun", unit_t(dimension=dim_t(rad=1))), &
      & named_unit_t("K", "m", unit_t(dimension=dim_t(k=1))), &
      & named_unit_t("t", "", unit_t(power=3, dimension=dim_t(kg=1))), &
      & named_unit_t("min", "", unit_t(numerator=6.0_wp, power=1, dimension=dim_t(s=1))), &
      & named_unit_t("h", "", unit_t(numerator=36.0_wp, power=2, dimension=dim_t(s=1))), &
      & named_unit_t("deg", "", unit_t(numerator=pi, denominator=18.0_wp, power=-1, dimension=dim_t(rad=1))), &
      & named_unit_t("rev", "", unit_t(numerator=2.0_wp*pi, dimension=dim_t(rad=1))), &
      & named_unit_t("rpm", "", unit_t(numerator=pi, denominator=3.0_wp, power=-1, dimension=dim_t(rad=1, s=-1))), &
      & named_unit_t("bar", "m", unit_t(power=5, dimension=dim_t(kg=1, m=-1, s=-2))), &
      & named_unit_t("P", "cm", unit_t(power=-1, dimension=dim_t(kg=1, m=-1, s=-1))), &
      & named_unit_t("degC", "", unit_t(offset=kelvin_of_ice, dimension=dim_t(k=1))), &
      & named_unit_t("inch", "", unit_t(numerator=254.0_wp, power=-4, dimension=dim_t(m=1))), &
      & named_unit_t("ft", "", unit_t(numerator=3048.0_wp, power=-4, dimension=dim_t(m=1))), &
      & named_unit_t("lb", "", unit_t(numerator=45359237.0_wp, power=-8, dimension=dim_t(kg=1))), &
      & named_unit_t("lbf", "", unit_t(numerator=44482216152605.0_wp, power=-13, dimension=dim_t(kg=1, m=1, s=-2))), &
      & named_unit_t("slug", "", unit_t(numerator=14.593902937206365_wp, dimension=dim_t(kg=1))), &
      & named_unit_t("psi", "k", unit_t(numerator=6894.7572931683613_wp, dimension=dim_t(kg=1, m=-1, s=-2))), &
      & named_unit_t("hp", "", unit_t(numerator=745.69987158227022_wp, dimension=dim_t(kg=1, m=2, s=-3))), &
      & named_unit_t("gal", "", unit_t(numerator=3785411784.0_wp, power=-12, dimension=dim_t(m=3))), &
      & named_unit_t("A", "kmun", unit_t(dimension=dim_t(a=1))), &
      & named_unit_t("V", "kmu", unit_t(dimension=dim_t(kg=1, m=2, s=-3, a=-1))), &
      & named_unit_t("Ohm", "Mkm", unit_t(dimension=dim_t(kg=1, m=2, s=-3, a=-2))), &
      & named_unit_t("H", "mun", unit_t(dimension=dim_t(kg=1, m=2, s=-2, a=-2)))]

   character(*), parameter :: spelt_out = "sec:s second:s seconds:s meter:m metre:m newton:N degree:deg degrees:deg " &
      & //"radian:rad radians:rad celsius:degC C:degC kelvin:K kilogram:kg gram:g minute:min hour:h hr:h turn:rev " &
      & //"turns:rev revolution:rev pascal:Pa joule:J watt:W hertz:Hz msec:ms poise:P micron:um " &
      & //"rps:rev/s rads:rad/s degs:deg/s mps:m/s mms:mm/s kmh:km/h kph:km/h in:inch inches:inch foot:ft feet:ft lbs:lb " &
      & //"pound:lb pounds:lb lbm:lb gallon:gal ampere:A volt:V ohm:Ohm henry:H"

end module named_units
