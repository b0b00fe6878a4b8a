!> Units: factors, dimensions, errors, and SI text that reads back.
module test_units
   use check, only: check_close, check_equal, check_true, suite_t
   use dimension_text, only: base_text, dimension_name, unit_text
   use errors, only: error_t
   use kind_info, only: dim_angle, dim_angular_speed, dim_area, dim_contact_stiffness, dim_damping, dim_density, dim_energy, &
                      & dim_force, dim_frequency, dim_inertia, dim_length, dim_mass, dim_none, dim_power, dim_pressure, &
                      & dim_speed, dim_stiffness, dim_t, dim_temperature, dim_time, dim_viscosity, same_dimension
   use kinds, only: pi, wp
   use units, only: parse_unit, read_quantity, to_si, unit_factor, unit_t
   implicit none (type, external)
   private
   public :: run_test_units

contains

   !> All tests of this file.
   subroutine run_test_units(suite)
      type(suite_t), intent(inout) :: suite  !! the suite

      call suite%test("factors", test_factors)
      call suite%test("compounds", test_compounds)
      call suite%test("exact_values", test_exact_values)
      call suite%test("temperature", test_temperature)
      call suite%test("mistakes", test_mistakes)
      call suite%test("suggestions", test_suggestions)
      call suite%test("si_text", test_si_text)
   end subroutine run_test_units

   !> Parse a unit and compare its factor and dimension.
   subroutine expect(error, string, factor, dimension)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: string                  !! the unit
      real(wp), intent(in) :: factor                      !! to SI [any]
      type(dim_t), intent(in) :: dimension                !! what it measures

      type(unit_t) :: unit
      character(:), allocatable :: message
      integer :: first, last

      call parse_unit(string, unit, message, first, last)
      call check_equal(error, message, "", string)
      call check_close(error, unit_factor(unit), factor, 4.0e-16_wp, string, relative=.true.)
      call check_true(error, same_dimension(unit%dimension, dimension), string//": dimension")
   end subroutine expect

   !> Names and prefixes.
   subroutine test_factors(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call expect(error, "1", 1.0_wp, dim_none)
      call expect(error, "m", 1.0_wp, dim_length)
      call expect(error, "mm", 1.0e-3_wp, dim_length)
      call expect(error, "cm", 1.0e-2_wp, dim_length)
      call expect(error, "um", 1.0e-6_wp, dim_length)
      call expect(error, "nm", 1.0e-9_wp, dim_length)
      call expect(error, "km", 1.0e3_wp, dim_length)
      call expect(error, "g", 1.0e-3_wp, dim_mass)
      call expect(error, "kg", 1.0_wp, dim_mass)
      call expect(error, "mg", 1.0e-6_wp, dim_mass)
      call expect(error, "t", 1.0e3_wp, dim_mass)
      call expect(error, "ms", 1.0e-3_wp, dim_time)
      call expect(error, "min", 60.0_wp, dim_time)
      call expect(error, "h", 3600.0_wp, dim_time)
      call expect(error, "kN", 1.0e3_wp, dim_force)
      call expect(error, "GPa", 1.0e9_wp, dim_pressure)
      call expect(error, "bar", 1.0e5_wp, dim_pressure)
      call expect(error, "mJ", 1.0e-3_wp, dim_energy)
      call expect(error, "kW", 1.0e3_wp, dim_power)
      call expect(error, "kHz", 1.0e3_wp, dim_frequency)
      call expect(error, "deg", pi/180.0_wp, dim_angle)
      call expect(error, "rev", 2.0_wp*pi, dim_angle)
      call expect(error, "rpm", pi/30.0_wp, dim_angular_speed)
      call expect(error, "mrad", 1.0e-3_wp, dim_angle)
      call expect(error, "cP", 1.0e-3_wp, dim_viscosity)
      call expect(error, "P", 0.1_wp, dim_viscosity)
      call expect(error, "inch", 0.0254_wp, dim_length)
      call expect(error, "ft", 0.3048_wp, dim_length)
      call expect(error, "lb", 0.45359237_wp, dim_mass)
      call expect(error, "slug", 14.593902937206364_wp, dim_mass)
      call expect(error, "lbf", 4.4482216152605_wp, dim_force)
      call expect(error, "psi", 6894.757293168361_wp, dim_pressure)
      call expect(error, "kpsi", 6894757.293168361_wp, dim_pressure)
      call expect(error, "hp", 745.6998715822702_wp, dim_power)
      call expect(error, "gal/inch", 0.003785411784_wp/0.0254_wp, dim_area)
   end subroutine test_factors

   !> Products, quotients, exponents, parentheses.
   subroutine test_compounds(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call expect(error, "kg.m^2", 1.0_wp, dim_inertia)
      call expect(error, "kg*m^2", 1.0_wp, dim_inertia)
      call expect(error, "g.cm^2", 1.0e-7_wp, dim_inertia)
      call expect(error, "N.s/m", 1.0_wp, dim_damping)
      call expect(error, "N/mm", 1.0e3_wp, dim_stiffness)
      call expect(error, "m/s^2", 1.0_wp, dim_t(m=1, s=-2))
      call expect(error, "km/h", 1.0_wp/3.6_wp, dim_speed)
      call expect(error, "1/s", 1.0_wp, dim_frequency)
      call expect(error, "s^-1", 1.0_wp, dim_frequency)
      call expect(error, "rev/min", pi/30.0_wp, dim_angular_speed)
      call expect(error, "N/m^1.5", 1.0_wp, dim_contact_stiffness)
      call expect(error, "N/mm^1.5", 10.0_wp**4.5_wp, dim_contact_stiffness)
      call expect(error, "N.m^-1.5", 1.0_wp, dim_contact_stiffness)
      call expect(error, "g/cm^3", 1.0e3_wp, dim_density)
      call expect(error, "mPa.s", 1.0e-3_wp, dim_viscosity)
      call expect(error, "W/(m.K)", 1.0_wp, dim_t(kg=1, m=1, s=-3, k=-1))
      call expect(error, "J/kg/K", 1.0_wp, dim_t(m=2, s=-2, k=-1))
      call expect(error, "(mm)^2", 1.0e-6_wp, dim_area)
   end subroutine test_compounds

   !> A value does not depend on the unit it was written in.
   subroutine test_exact_values(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call same("0.1", "mm", 1.0e-4_wp)
      call same("25", "mm", 0.025_wp)
      call same("207", "GPa", 207.0e9_wp)
      call same("0.3", "us", 0.3e-6_wp)
      call same("0.7", "g/cm^3", 700.0_wp)
      call same("7", "min", 420.0_wp)

   contains

      !> Read a quantity and compare bit by bit.
      subroutine same(number, name, expected)
         character(*), intent(in) :: number    !! as written
         character(*), intent(in) :: name      !! of the unit
         real(wp), intent(in) :: expected      !! value in SI [any]

         type(unit_t) :: unit
         character(:), allocatable :: message
         real(wp) :: x
         integer :: first, last
         logical :: is_finite

         call parse_unit(name, unit, message, first, last)
         call read_quantity(number, unit, x, is_finite)
         call check_true(error, is_finite, number//" "//name)
         call check_close(error, x, expected, 0.0_wp, number//" "//name)
      end subroutine same

   end subroutine test_exact_values

   !> Degrees Celsius have an offset and stand alone.
   subroutine test_temperature(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(unit_t) :: unit
      character(:), allocatable :: message
      integer :: first, last

      call parse_unit("degC", unit, message, first, last)
      call check_true(error, same_dimension(unit%dimension, dim_temperature), "degC is a temperature")
      call check_close(error, to_si(20.0_wp, unit), 293.15_wp, 1.0e-13_wp, "20 degC")
      call parse_unit("degC/s", unit, message, first, last)
      call check_equal(error, message, "degC must stand alone; use K in a compound unit", "degC/s")
   end subroutine test_temperature

   !> Errors and where they are.
   subroutine test_mistakes(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call refuse("", "the unit is missing", 1, 0)
      call refuse("kg.", "the unit is incomplete", 4, 4)
      call refuse("kg..m", "'.' is not allowed here in a unit", 4, 4)
      call refuse("N/m.s", "a product after a division is ambiguous; use parentheses", 4, 5)
      call refuse("m^", "the exponent of a unit must be a number up to 9, as in s^-1 or m^1.5", 2, 3)
      call refuse("m^99", "the exponent of a unit must be a number up to 9, as in s^-1 or m^1.5", 2, 4)
      call refuse("W/(m.K", "missing closing parenthesis", 6, 6)
      call refuse("m)", "')' is not allowed in a unit", 2, 2)
      call refuse("kg.furlong", "unknown unit 'furlong'", 4, 10)
      call refuse("Kkg", "unknown unit 'Kkg': did you mean 'kg'?", 1, 3)

   contains

      !> Must be refused.
      subroutine refuse(string, expected, at, until)
         character(*), intent(in) :: string    !! the unit
         character(*), intent(in) :: expected  !! message
         integer, intent(in) :: at             !! where it is wrong
         integer, intent(in) :: until          !! where that ends

         type(unit_t) :: unit
         character(:), allocatable :: message
         integer :: first, last

         call parse_unit(string, unit, message, first, last)
         call check_equal(error, message, expected, string)
         call check_equal(error, first, at, string//": first")
         call check_equal(error, last, until, string//": last")
      end subroutine refuse

   end subroutine test_mistakes

   !> What is meant by wrong names.
   subroutine test_suggestions(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call suggest("s2", "s^2")
      call suggest("Nm", "N.m")
      call suggest("kNm", "kN.m")
      call suggest("Kg", "kg")
      call suggest("mmm", "mm")
      call suggest("mpa", "MPa")
      call suggest("sec", "s")
      call suggest("degrees", "deg")
      call suggest("Newton", "N")

   contains

      !> Compare the suggestion.
      subroutine suggest(string, expected)
         character(*), intent(in) :: string    !! the wrong unit
         character(*), intent(in) :: expected  !! the right one

         type(unit_t) :: unit
         character(:), allocatable :: message
         integer :: first, last

         call parse_unit(string, unit, message, first, last)
         call check_equal(error, message, "unknown unit '"//string//"': did you mean '"//expected//"'?", string)
      end subroutine suggest

   end subroutine test_suggestions

   !> The SI text of a dimension reads back to the same dimension with factor 1.
   subroutine test_si_text(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      integer :: kg, m, rad, s

      call check_equal(error, unit_text(dim_force), "N", "force")
      call check_equal(error, unit_text(dim_energy), "N.m", "energy")
      call check_equal(error, unit_text(dim_angular_speed), "rad/s", "angular speed")
      call check_equal(error, unit_text(dim_density), "kg/m^3", "density")
      call check_equal(error, unit_text(dim_contact_stiffness), "N/m^1.5", "contact stiffness")
      call check_equal(error, unit_text(dim_none), "1", "none")
      call check_equal(error, unit_text(dim_t(kg=2, m=-0.5_wp, k=1)), "kg^2.m^-0.5.K", "an odd one")
      call check_equal(error, base_text(dim_force), "kg.m.s^-2", "force in base units")
      call check_equal(error, dimension_name(dim_length), "a length [m]", "name of a length")
      call check_equal(error, dimension_name(dim_none), "a dimensionless number", "name of none")
      do kg = -1, 1
         do m = -3, 3
            do s = -3, 2
               do rad = -1, 1
                  associate (dimension => dim_t(kg=real(kg, wp), m=0.5_wp*m, s=real(s, wp), rad=real(rad, wp)))
                     call expect(error, unit_text(dimension), 1.0_wp, dimension)
                  end associate
               end do
            end do
         end do
      end do
   end subroutine test_si_text

end module test_units
