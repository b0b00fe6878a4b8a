!> Laws of cylinders of later literature: their formulas written out anew, limits, and where they go over into one another.
module test_cylinder_laws
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: pi, wp
   use law_case, only: case_t, force_of, make_case
   use law_fixture, only: steel_pair
   use normal_law, only: parameter_deepest
   use surfaces, only: shape_external, shape_internal, surfaces_t
   implicit none (type, external)
   private
   public :: run_test_cylinder_laws

   real(wp), parameter :: modulus = 207.0e9_wp/(2.0_wp*0.91_wp)  !! E of steel on steel [Pa]
   real(wp), parameter :: length = 15.0e-3_wp                    !! of the bearing [m]
   real(wp), parameter :: c = 0.5e-3_wp                          !! its clearance [m]

contains

   subroutine run_test_cylinder_laws(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("johnson", test_johnson)
      call suite%test("radzimovsky", test_radzimovsky)
      call suite%test("liu", test_liu)
      call suite%test("pereira", test_pereira)
      call suite%test("persson", test_persson)
      call suite%test("persson_beyond", test_persson_beyond)
      call suite%test("line_contact_agrees", test_agreement)
      call suite%test("what_does_not_fit", test_what_does_not_fit)
   end subroutine run_test_cylinder_laws

   !> An elastic law on the bearing of steel, its words those of the defaults.
   subroutine make(name, case, word_column, word)
      character(*), intent(in) :: name                   !! of the law
      type(case_t), intent(out) :: case                  !! the law
      character(*), intent(in), optional :: word_column  !! a column of words
      character(*), intent(in), optional :: word         !! what stands in it

      if (present(word)) then
         call make_case(name, [" "], [0.0_wp], word_column, word, steel_pair(shape_internal), case)
      else
         call make_case(name, [" "], [0.0_wp], " ", " ", steel_pair(shape_internal), case)
      end if
   end subroutine make

   !> The penetration that the formula has for the force found is the one given.
   subroutine test_johnson(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      real(wp) :: delta, f(4)
      integer :: k

      call make("johnson", case)
      do k = -8, -4
         delta = 10.0_wp**k
         f = force_of(case, delta, 0.2_wp, 0.3_wp)
         associate (per_length => f(1)/length)
            call check_close(error, per_length/(pi*modulus)*(log(4.0_wp*pi*modulus*c/per_length) - 1.0_wp), delta, 1.0e-12_wp, &
                             "Johnson", relative=.true.)
         end associate
      end do
      call check_close(error, case%parameters(parameter_deepest), 0.9_wp*4.0_wp*c*exp(-2.0_wp), 1.0e-12_wp, "its range", &
                       relative=.true.)
   end subroutine test_johnson

   !> The same, with the width of contact of diameters, where it is Hertz's own, and of radii.
   subroutine test_radzimovsky(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: words(2) = [character(9) :: "diameters", "radii"]
      real(wp), parameter :: r_i = 10.0e-3_wp, r_j = 9.5e-3_wp
      type(case_t) :: case
      real(wp) :: b, delta, f(4), k_of(2), width
      integer :: i, k

      k_of = [4.0_wp*r_i*r_j/(2.0_wp*c), r_i*r_j/c]
      do i = 1, size(words)
         call make("radzimovsky", case, "width", trim(words(i)))
         do k = -8, -4
            delta = 10.0_wp**k
            f = force_of(case, delta, 0.2_wp, 0.3_wp)
            b = 1.60_wp*sqrt(f(1)/length*k_of(i)/modulus)
            call check_close(error, f(1)/(pi*modulus*length)*(2.0_wp/3.0_wp + log(4.0_wp*r_i/b) + log(4.0_wp*r_j/b)), delta, &
                             1.0e-12_wp, "Radzimovsky, "//words(i), relative=.true.)
            width = 2.0_wp*sqrt(4.0_wp*f(1)/length*r_i*r_j/c/(pi*modulus))
            if (i == 1) call check_close(error, b, width, 3.0e-3_wp, "width of contact", relative=.true.)
         end do
      end do
   end subroutine test_radzimovsky

   !> With the angle of contact; a power 3/2 when shallow; the energy where its series ends.
   subroutine test_liu(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      real(wp) :: angle, delta, f(4), low, high
      integer :: k

      call make("liu", case)
      do k = -8, -2
         delta = 10.0_wp**k
         angle = acos(c/(c + delta))
         f = force_of(case, delta, 0.2_wp, 0.3_wp)
         call check_close(error, f(1), 0.5_wp*pi*modulus*length*delta*sin(0.5_wp*angle), 1.0e-8_wp, "Liu", relative=.true.)
      end do
      f = force_of(case, 1.0e-8_wp, 0.2_wp, 0.3_wp)
      call check_close(error, f(2), 1.5_wp*f(1)/1.0e-8_wp, 2.0e-5_wp, "a power 3/2", relative=.true.)
      low = case%law%potential(0.02_wp*c*(1.0_wp - 1.0e-12_wp), case%parameters)
      high = case%law%potential(0.02_wp*c*(1.0_wp + 1.0e-12_wp), case%parameters)
      call check_close(error, high, low, 5.0e-11_wp, "its energy", relative=.true.)
   end subroutine test_liu

   !> In millimetres and newtons, as printed; the exponent where its fit changes; the damping of its authors.
   subroutine test_pereira(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      type(surfaces_t) :: pair
      real(wp) :: exponents(2), f(4), n
      integer :: k

      call make("pereira", case)
      n = (0.0151_wp*0.5_wp + 1.151_wp)*0.5_wp**(-0.005_wp)
      f = force_of(case, 2.0e-5_wp, 0.2_wp, 0.3_wp)
      call check_close(error, f(1), (0.965_wp*0.5_wp + 0.0965_wp)*15.0_wp*(modulus*1.0e-6_wp)/0.5_wp*0.02_wp**n, 1.0e-12_wp, &
                       "Pereira", relative=.true.)
      pair = steel_pair(shape_internal)
      do k = 1, 2
         pair%clearance = 0.34954e-3_wp*(1.0_wp + (2*k - 3)*1.0e-9_wp)
         call make_case("pereira", ["restitution"], [0.9_wp], " ", " ", pair, case)
         f = force_of(case, 2.0e-5_wp, 0.0_wp, 0.3_wp)
         exponents(k) = f(2)*2.0e-5_wp/f(1)
      end do
      call check_close(error, exponents(2), exponents(1), 1.0e-5_wp, "the exponent where its fit changes")
      call check_close(error, exponents(1), 1.51_wp*log(349.54_wp)**(-0.151_wp)*0.34954_wp**(-0.005_wp), 1.0e-8_wp, &
                       "of a small clearance")
      f = force_of(case, 2.0e-5_wp, 0.2_wp, 0.3_wp)
      call check_close(error, f(1)/f(4), 1.0_wp + 0.75_wp*0.19_wp*2.0_wp/3.0_wp, 1.0e-12_wp, "damping")
   end subroutine test_pereira

   !> Force against angle as printed, tan(e/2) for s; the half-width of Hertz when it is small; the maximum angle.
   subroutine test_persson(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      real(wp) :: angle, b, delta, f(4)
      integer :: k

      call make("persson", case)
      do k = 1, 13
         angle = 0.1_wp*k
         delta = c*(1.0_wp/cos(angle) - 1.0_wp)
         b = tan(0.5_wp*angle)
         f = force_of(case, delta, 0.2_wp, 0.3_wp)
         call check_close(error, 2.0_wp*modulus*c*length/f(1), (2.0_wp - (log(b**2 + 1.0_wp) + 2.0_wp*b**4)) &
                          /(pi*(b**2 + 1.0_wp)*b**2), 1.0e-10_wp, "Persson", relative=.true.)
      end do
      ! Hertz: a^2 = 4 F R^2/(pi E L c), a = R e
      angle = 1.0e-3_wp
      f = force_of(case, 0.5_wp*c*angle**2*(1.0_wp + 5.0_wp*angle**2/12.0_wp), 0.0_wp, 0.3_wp)
      call check_close(error, 4.0_wp*f(1)/(pi*modulus*length*c), angle**2, 1.0e-6_wp, "Hertz's half-width", relative=.true.)
      b = sqrt(case%parameters(parameter_deepest)/(2.0_wp*c + case%parameters(parameter_deepest))/0.9_wp)
      call check_close(error, log(b**2 + 1.0_wp) + 2.0_wp*b**4, 2.0_wp, 1.0e-6_wp, "where the force has no bound")
   end subroutine test_persson

   !> A straight line beyond nine tenths of the maximum angle, with its energy.
   subroutine test_persson_beyond(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      real(wp) :: d, f(4), high(4), low(4)

      call make("persson", case)
      d = case%parameters(parameter_deepest)
      low = force_of(case, d*(1.0_wp - 1.0e-9_wp), 0.0_wp, 1.0_wp)
      high = force_of(case, d*(1.0_wp + 1.0e-9_wp), 0.0_wp, 1.0_wp)
      call check_close(error, high(1:2), low(1:2), 1.0e-6_wp, "continuous", relative=.true.)
      f = force_of(case, 1.5_wp*d, 0.0_wp, 1.0_wp)
      call check_close(error, f(1), high(1) + 0.5_wp*d*high(2), 1.0e-8_wp, "a straight line", relative=.true.)
      call check_close(error, case%law%potential(1.5_wp*d, case%parameters) - case%law%potential(d, case%parameters), &
                       0.25_wp*d*(high(1) + f(1)), 1.0e-8_wp, "its energy", relative=.true.)
   end subroutine test_persson_beyond

   !> Line contact, a formula and two fits of it: from 2 to 20 um they differ by less than a sixth.
   subroutine test_agreement(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(3) = [character(11) :: "johnson", "radzimovsky", "pereira"]
      type(case_t) :: case
      real(wp) :: f(4), forces(size(names))
      integer :: i, k

      do i = 1, 10
         do k = 1, size(names)
            call make(trim(names(k)), case)
            f = force_of(case, 2.0e-6_wp*i, 0.0_wp, 1.0_wp)
            forces(k) = f(1)
         end do
         call check_true(error, maxval(forces) < 1.17_wp*minval(forces), "laws of line contact agree")
      end do
   end subroutine test_agreement

   !> Surfaces that are no pin in a hole, and clearances that no one fitted.
   subroutine test_what_does_not_fit(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(5) = [character(11) :: "johnson", "radzimovsky", "liu", "pereira", "persson"]
      type(case_t) :: case
      type(surfaces_t) :: pair
      integer :: k

      do k = 1, size(names)
         call make_case(trim(names(k)), [" "], [0.0_wp], " ", " ", steel_pair(shape_external), case)
         call check_true(error, index(case%message, "pin in a hole") > 0, trim(names(k))//" from outside")
         pair = steel_pair(shape_internal)
         pair%length = 0.0_wp
         call make_case(trim(names(k)), [" "], [0.0_wp], " ", " ", pair, case)
         call check_true(error, index(case%message, "length") > 0, trim(names(k))//" without length")
         call make(trim(names(k)), case)
         call check_equal(error, case%message, "", trim(names(k))//" of a pin in a hole")
      end do
      pair%length = length
      pair%clearance = 4.0e-6_wp
      call make_case("pereira", [" "], [0.0_wp], " ", " ", pair, case)
      call check_true(error, index(case%message, "5 um to 10 mm") > 0, "a clearance that is too small")
      pair%clearance = 11.0e-3_wp
      call make_case("pereira", [" "], [0.0_wp], " ", " ", pair, case)
      call check_true(error, index(case%message, "5 um to 10 mm") > 0, "a clearance that is too large")
   end subroutine test_what_does_not_fit

end module test_cylinder_laws
