!> Lubricants: their viscosity, by its value or by a grade and a temperature.
!>
!> ISO VG:  ln(mu/mu_x) = (159.55657/(T + 95) - 0.181913) ln(rho VG/(1e6 mu_x)),   mu_x = 0.18 mPa.s, rho = 900 kg/m^3, T in degC
!> SAE:     mu = mu_0 exp( b/(1.8 T + 127) ),   mu_0 and b of each grade, T in degC
!>
!> Sources: G. Vogel's equation with the constants of DIN 31654 for oils of ISO 3448 (VG is the kinematic viscosity at 40 degC in
!> mm^2/s, viscosity index about 100: 159.55657/135 - 0.181913 = 1, so that 40 degC is met); A. Seireg and S. Dandage, Empirical
!> design procedure for the thermodynamic behavior of journal bearings, J. Lubrication Technology 104 (1982) 135-148, for
!> single-grade oils of SAE J300, their constants as R. G. Budynas and J. K. Nisbett, Shigley's Mechanical Engineering Design,
!> section 12-6, have them.
!> Limits: mineral oils between 0 and 150 degC, at the pressure of the surroundings; Newtonian.
module lubricant
   use item, only: item_t, place_of
   use kind_info, only: add_number, add_word, dim_density, dim_t, dim_temperature, dim_viscosity, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: lubricant_info, lubricant_mistake, oil_of_row, oil_t, viscosity_at, viscosity_of_grade

   character(*), parameter :: iso_grades = "iso_vg_10 iso_vg_15 iso_vg_22 iso_vg_32 iso_vg_46 iso_vg_68 iso_vg_100 iso_vg_150 "// &
                              "iso_vg_220 iso_vg_320 iso_vg_460 iso_vg_680 iso_vg_1000"  !! grades of ISO 3448
   integer, parameter :: sae_grade(6) = [10, 20, 30, 40, 50, 60]  !! numbers of SAE J300
   real(wp), parameter :: reyn = 6894.757_wp  !! viscosity, lbf.s/in^2 [Pa.s]
   real(wp), parameter :: sae_factor(6) = reyn*1.0e-6_wp*[0.0158_wp, 0.0136_wp, 0.0141_wp, 0.0121_wp, 0.0170_wp, 0.0187_wp]
      !! mu_0 of each SAE grade [Pa.s]
   real(wp), parameter :: sae_slope(6) = [1157.5_wp, 1271.6_wp, 1360.0_wp, 1474.4_wp, 1509.6_wp, 1564.0_wp]
      !! b of each, degrees of Fahrenheit [1]
   real(wp), parameter :: ice = 273.15_wp     !! 0 degC [K]

   type(dim_t), parameter :: dim_specific_heat = dim_t(m=2, s=-2, k=-1)  !! J/(kg.K)

   !> A lubricant.
   type :: oil_t
      character(12) :: grade = "none"        !! its grade, none: its viscosity is given
      real(wp) :: viscosity = 0.0_wp         !! dynamic, at its temperature [Pa.s]
      real(wp) :: temperature = 0.0_wp       !! of the film, or of what comes in where a balance of heat is asked for [K]
      real(wp) :: heat = 0.0_wp              !! density times heat capacity [J/(m^3.K)]
   end type oil_t

contains

   !> The deck table of lubricants.
   function lubricant_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "lubricant"
      info%help = "lubricants: viscosity, or grade and temperature"
      info%source = "DIN 31654 (ISO VG); Seireg and Dandage (1982) (SAE)"
      call add_number(info, "viscosity", dim_viscosity, "dynamic viscosity; default: that of the grade", &
                      default="0 Pa.s", lower=0.0_wp)
      call add_word(info, "grade", "grade of a mineral oil", default="none", &
                    choices="none "//iso_grades//" sae_10 sae_20 sae_30 sae_40 sae_50 sae_60")
      call add_number(info, "temperature", dim_temperature, "temperature of the film, for a grade", default="40 degC", &
                      lower=ice, upper=ice + 150.0_wp)
      call add_number(info, "density", dim_density, "for the temperature rise", default="900 kg/m^3", lower=0.0_wp, &
                      open_lower=.true.)
      call add_number(info, "heat_capacity", dim_specific_heat, "for the temperature rise; with the density 1.8 MJ/(m^3.K), " &
                      //"as in DIN 31652", default="2000 J/(kg.K)", lower=0.0_wp, open_lower=.true.)
   end function lubricant_info

   !> Viscosity and grade: one of them, not both.
   subroutine lubricant_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = ""
      help = ""
      if ((item%number("viscosity") > 0.0_wp) .neqv. (item%word("grade") /= "none")) return
      column = place_of(item, "viscosity")
      help = "give either the viscosity, or a grade and its temperature"
      if (item%number("viscosity") > 0.0_wp) then
         message = "lubricant '"//item%name//"' has both a viscosity and a grade"
      else
         message = "lubricant '"//item%name//"' has no viscosity"
      end if
   end subroutine lubricant_mistake

   !> The lubricant of a row.
   pure type(oil_t) function oil_of_row(item) result(oil)
      type(item_t), intent(in) :: item  !! the row

      oil%grade = item%word("grade")
      oil%viscosity = item%number("viscosity")
      oil%temperature = item%number("temperature")
      oil%heat = item%number("density")*item%number("heat_capacity")
      if (.not. oil%viscosity > 0.0_wp) oil%viscosity = viscosity_at(oil, oil%temperature)
   end function oil_of_row

   !> Dynamic viscosity at a temperature [Pa.s]; of one without a grade the same at any.
   pure real(wp) function viscosity_at(oil, temperature) result(viscosity)
      type(oil_t), intent(in) :: oil       !! the lubricant
      real(wp), intent(in) :: temperature  !! of the film [K]

      viscosity = oil%viscosity
      if (oil%grade /= "none") viscosity = viscosity_of_grade(trim(oil%grade), temperature)
   end function viscosity_at

   !> Dynamic viscosity of a grade [Pa.s]; 0 of one that is not known.
   pure real(wp) function viscosity_of_grade(grade, temperature) result(viscosity)
      character(*), intent(in) :: grade    !! as iso_vg_46 or sae_30
      real(wp), intent(in) :: temperature  !! of the oil [K]

      real(wp), parameter :: density = 900.0_wp      ! of the formula [kg/m^3]
      real(wp), parameter :: pole = 0.18e-3_wp       ! viscosity at which all grades meet [Pa.s]
      real(wp) :: celsius, number
      integer :: k, status

      viscosity = 0.0_wp
      celsius = temperature - ice
      if (index(grade, "iso_vg_") == 1) then
         read (grade(len("iso_vg_") + 1:), *, iostat=status) number
         if (status /= 0) return
         viscosity = pole*exp((159.55657_wp/(celsius + 95.0_wp) - 0.181913_wp)*log(density*number*1.0e-6_wp/pole))
      else if (index(grade, "sae_") == 1) then
         read (grade(len("sae_") + 1:), *, iostat=status) number
         if (status /= 0) return
         k = findloc(sae_grade, nint(number), dim=1)
         if (k > 0) viscosity = sae_factor(k)*exp(sae_slope(k)/(1.8_wp*celsius + 127.0_wp))
      end if
   end function viscosity_of_grade

end module lubricant
