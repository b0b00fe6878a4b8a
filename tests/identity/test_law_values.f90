!> Normal laws against printed values, closed forms and the restitution that two free bodies show.
module test_law_values
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use free_impact, only: impact_t, run_impact
   use kinds, only: wp
   use law_exact, only: exact_hysteresis
   use law_case, only: case_t, force_of, make_case
   use law_fixture, only: steel_mass, steel_pair
   use normal_law, only: n_law_parameter, normal_law_t, parameter_deepest
   use surfaces, only: shape_face, shape_internal, shape_plane, surfaces_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_law_values

contains

   subroutine run_test_law_values(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("forces", test_forces)
      call suite%test("laws_of_cylinders", test_laws_of_cylinders)
      call suite%test("beyond_the_range", test_beyond_the_range)
      call suite%test("every_penetration", test_every_penetration)
      call suite%test("exact_factor", test_exact_factor)
      call suite%test("exact_delivers", test_exact_delivers)
      call suite%test("table_of_restitutions", test_table_of_restitutions)
      call suite%test("damped_cylinders", test_damped_cylinders)
      call suite%test("kelvin_voigt", test_kelvin_voigt)
      call suite%test("plane_face", test_plane_face)
      call suite%test("what_does_not_fit", test_what_does_not_fit)
   end subroutine run_test_law_values

   !> Forces of the damped laws at 10 um, 0.1 m/s, impact at 0.3 m/s: K delta^1.5 (1 + h/3), with h written out for 0.9.
   subroutine test_forces(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(9) = [character(20) :: "lankarani_nikravesh", "hunt_crossley", "herbert_mcwhannell", &
                                             "lee_wang", "gonthier", "zhiying_qishao", "flores", "hu_guo", "exact"]
      real(wp), parameter :: h(9) = [0.1425_wp, 0.15_wp, 0.164835164835_wp, 0.075_wp, 0.211111111111_wp, 0.174049893038_wp, &
                                     0.177777777778_wp, 0.166666666667_wp, 0.16648195_wp]
      real(wp), parameter :: elastic = 2090.32827230_wp  ! [N]
      type(case_t) :: case
      real(wp) :: f(4)
      integer :: k

      do k = 1, size(names)
         call make_case(trim(names(k)), ["restitution"], [0.9_wp], " ", " ", steel_pair(shape_internal), case)
         f = force_of(case, 1.0e-5_wp, 0.1_wp, 0.3_wp)
         call check_close(error, f(1), elastic*(1.0_wp + h(k)/3.0_wp), 5.0e-9_wp, trim(names(k))//": force", relative=.true.)
         call check_close(error, f(2), 1.5e5_wp*elastic*(1.0_wp + h(k)/3.0_wp), 5.0e-9_wp, trim(names(k))//": stiffness", &
                          relative=.true.)
         call check_close(error, f(3), elastic*h(k)/0.3_wp, 5.0e-8_wp, trim(names(k))//": damping", relative=.true.)
         f = force_of(case, 1.0e-5_wp, -0.1_wp, 0.3_wp)
         call check_close(error, f(1), elastic*(1.0_wp - h(k)/3.0_wp), 5.0e-9_wp, trim(names(k))//": parting", relative=.true.)
      end do
   end subroutine test_forces

   !> The laws of cylinders, 15 mm long: force and stiffness at 10 um and the penetration where they turn back.
   subroutine test_laws_of_cylinders(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(3) = [character(21) :: "dubowsky_freudenstein", "goldsmith", "esdu"]
      real(wp), parameter :: force(3) = [2178.15116465_wp, 1003.12455644_wp, 2023.74584636_wp]
      real(wp), parameter :: stiffness(3) = [2.49694236e8_wp, 1.06579125e8_wp, 2.29611604e8_wp]
      real(wp), parameter :: maximum(3) = [1.184211e-3_wp, 5.263158_wp, 2.0e-3_wp]
      type(case_t) :: case
      type(surfaces_t) :: pair
      real(wp) :: f(4)
      integer :: k

      do k = 1, size(names)
         call make_case(trim(names(k)), [" "], [0.0_wp], " ", " ", steel_pair(shape_internal), case)
         f = force_of(case, 1.0e-5_wp, 0.1_wp, 0.3_wp)
         call check_close(error, f([1, 4]), [force(k), force(k)], 1.0e-11_wp, trim(names(k))//": force", relative=.true.)
         call check_close(error, f(2), stiffness(k), 1.0e-8_wp, trim(names(k))//": stiffness", relative=.true.)
         call check_close(error, case%parameters(parameter_deepest), 0.9_wp*maximum(k), 1.0e-6_wp, trim(names(k))//": range", &
                          relative=.true.)
         ! the length of the law's row comes before that of the joint
         pair = steel_pair(shape_internal)
         pair%length = 77.0_wp
         call make_case(trim(names(k)), ["length"], [15.0e-3_wp], " ", " ", pair, case)
         f = force_of(case, 1.0e-5_wp, 0.1_wp, 0.3_wp)
         call check_close(error, f(1), force(k), 1.0e-11_wp, trim(names(k))//": length of the row", relative=.true.)
         ! with sigma/pi the force is the root of delta = a F (ln(B/F) + 1) with both a/pi and B pi
         call make_case(trim(names(k)), [" "], [0.0_wp], "sigma_pi", "on", steel_pair(shape_internal), case)
         f = force_of(case, 1.0e-5_wp, 0.1_wp, 0.3_wp)
         call check_close(error, f(1), acos(-1.0_wp)*force(k), 1.0e-11_wp, trim(names(k))//": sigma/pi", relative=.true.)
      end do
      call make_case("goldsmith", [" "], [0.0_wp], "unit", "mm", steel_pair(shape_internal), case)
      call check_close(error, case%parameters(parameter_deepest), 0.9_wp*5.263158e-6_wp, 1.0e-6_wp, "millimetres: range", &
                       relative=.true.)
   end subroutine test_laws_of_cylinders

   !> At the end of the range force and stiffness are continuous, beyond it the force is a straight line.
   subroutine test_beyond_the_range(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      real(wp) :: a, d, f(4), high(4), low(4), slope

      call make_case("esdu", [" "], [0.0_wp], " ", " ", steel_pair(shape_internal), case)
      a = case%parameters(1)
      d = case%parameters(parameter_deepest)
      low = force_of(case, d*(1.0_wp - 1.0e-9_wp), 0.0_wp, 1.0_wp)
      high = force_of(case, d*(1.0_wp + 1.0e-9_wp), 0.0_wp, 1.0_wp)
      call check_close(error, high(1:2), low(1:2), 1.0e-7_wp, "continuous", relative=.true.)
      slope = high(2)
      f = force_of(case, 3.0_wp*d, 0.0_wp, 1.0_wp)
      call check_close(error, f(1), high(1) + 2.0_wp*d*slope, 1.0e-8_wp, "a straight line", relative=.true.)
      call check_close(error, case%law%potential(3.0_wp*d, case%parameters) - case%law%potential(d, case%parameters), &
                       2.0_wp*d*0.5_wp*(high(1) + f(1)), 1.0e-8_wp, "its energy", relative=.true.)
      ! at the end of the range the formula itself holds: delta = a F (ln(B/F) + 1), B = (a B)/a
      call check_close(error, a*low(1)*(log(case%parameters(2)/a/low(1)) + 1.0_wp), d, 1.0e-8_wp, "the formula", relative=.true.)
   end subroutine test_beyond_the_range

   !> The inverse satisfies the formula over twelve decades of penetration.
   subroutine test_every_penetration(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      real(wp) :: delta, f(4)
      integer :: k

      call make_case("dubowsky_freudenstein", [" "], [0.0_wp], " ", " ", steel_pair(shape_internal), case)
      do k = -300, -1
         delta = case%parameters(parameter_deepest)*10.0_wp**(0.04_wp*k)
         f = force_of(case, delta, 0.0_wp, 1.0_wp)
         associate (a => case%parameters(1), b => case%parameters(2)/case%parameters(1))
            call check_close(error, a*f(1)*(log(b/f(1)) + 1.0_wp), delta, 1.0e-14_wp, "inverse", relative=.true.)
            call check_close(error, f(2)*a*log(b/f(1)), 1.0_wp, 1.0e-12_wp, "stiffness")
         end associate
      end do
   end subroutine test_every_penetration

   !> The factor that delivers the restitution: known values, the equation itself, its limits.
   subroutine test_exact_factor(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: ce(6) = [0.3_wp, 0.5_wp, 0.7_wp, 0.8_wp, 0.9_wp, 0.95_wp]
      real(wp), parameter :: known(6) = [3.08708198_wp, 1.43275053_wp, 0.63482828_wp, 0.37314620_wp, 0.16648195_wp, 0.07892661_wp]
      real(wp) :: h, e
      integer :: k

      do k = 1, size(ce)
         call check_close(error, exact_hysteresis(ce(k)), known(k), 5.1e-9_wp, "known factor")
      end do
      do k = 1, 99
         e = 0.01_wp*k
         h = exact_hysteresis(e)
         call check_close(error, h*e + (1.0_wp + h)*exp(-h*(1.0_wp + e)), 1.0_wp, 2.0e-15_wp, "equation")
         if (k >= 10) call check_close(error, h*(1.0_wp + e), log((1.0_wp + h)/(1.0_wp - h*e)), 1.0e-11_wp, "equation with the log")
      end do
      call check_close(error, exact_hysteresis(1.0_wp), 0.0_wp, 0.0_wp, "elastic")
      ! h = 1.5 (1 - e) + O((1 - e)^2), also where the equation is all cancellation
      call check_close(error, exact_hysteresis(1.0_wp - 1.0e-9_wp), 1.5e-9_wp, 3.0e-8_wp, "nearly elastic", relative=.true.)
      call check_close(error, exact_hysteresis(1.0e-3_wp), 1.0e3_wp, 1.0e-15_wp, "nearly plastic", relative=.true.)
      call check_close(error, exact_hysteresis(1.0e-300_wp), 1.0e300_wp, 1.0e-15_wp, "plastic", relative=.true.)
      ! continuous where its two forms meet
      call check_close(error, exact_hysteresis(0.5_wp - 1.0e-12_wp), exact_hysteresis(0.5_wp), 1.0e-11_wp, "both forms")
   end subroutine test_exact_factor

   !> Two free bodies part with the restitution asked for.
   subroutine test_exact_delivers(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: k

      do k = 1, 10
         call deliver(error, "exact", 0.1_wp*k)
      end do
   end subroutine test_exact_delivers

   !> The laws of cylinders do too, with the same factor.
   subroutine test_damped_cylinders(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(3) = [character(21) :: "dubowsky_freudenstein", "goldsmith", "esdu"]
      integer :: k

      do k = 1, size(names)
         call deliver(error, trim(names(k)), 0.9_wp)
         call deliver(error, trim(names(k)), 0.3_wp)
      end do
   end subroutine test_damped_cylinders

   !> Claim that two free bodies part with ce.
   subroutine deliver(error, name, ce)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      character(*), intent(in) :: name                    !! of the law
      real(wp), intent(in) :: ce                          !! coefficient of restitution [1]

      type(case_t) :: case
      type(impact_t) :: impact

      call make_case(name, ["restitution"], [ce], " ", " ", steel_pair(shape_internal), case)
      call run_impact(case%law, case%parameters, steel_mass, 0.5_wp, impact)
      call check_close(error, -impact%end_rate/0.5_wp, ce, 1.0e-8_wp, name//" delivers "//to_text(ce))
      call check_close(error, impact%lost, 0.5_wp*steel_mass*0.25_wp*(1.0_wp - ce**2), 1.0e-9_wp, name//": energy lost")
   end subroutine deliver

   !> What the laws of Hertz's family deliver instead of ce, from the closed form.
   subroutine test_table_of_restitutions(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(8) = [character(20) :: "hunt_crossley", "herbert_mcwhannell", "lee_wang", &
                                             "lankarani_nikravesh", "gonthier", "zhiying_qishao", "flores", "hu_guo"]
      real(wp), parameter :: ce(4) = [0.3_wp, 0.5_wp, 0.7_wp, 0.9_wp]
      real(wp), parameter :: delivered(4, 8) = reshape([0.581_wp, 0.663_wp, 0.768_wp, 0.909_wp, &
                                                        0.520_wp, 0.594_wp, 0.723_wp, 0.901_wp, &
                                                        0.739_wp, 0.799_wp, 0.869_wp, 0.952_wp, &
                                                        0.684_wp, 0.725_wp, 0.796_wp, 0.913_wp, &
                                                        0.304_wp, 0.488_wp, 0.670_wp, 0.876_wp, &
                                                        0.327_wp, 0.483_wp, 0.680_wp, 0.896_wp, &
                                                        0.256_wp, 0.470_wp, 0.683_wp, 0.894_wp, &
                                                        0.271_wp, 0.488_wp, 0.697_wp, 0.900_wp], [4, 8])
      type(case_t) :: case
      type(impact_t) :: impact
      integer :: i, k

      do k = 1, size(names)
         do i = 1, size(ce)
            call make_case(trim(names(k)), ["restitution"], [ce(i)], " ", " ", steel_pair(shape_internal), case)
            call run_impact(case%law, case%parameters, steel_mass, 0.5_wp, impact)
            call check_close(error, -impact%end_rate/0.5_wp, delivered(i, k), 5.5e-4_wp, trim(names(k))//" for "//to_text(ce(i)))
         end do
      end do
   end subroutine test_table_of_restitutions

   !> Kelvin and Voigt: ce with the square, sqrt(ce) as printed, the dashpot that does not pull.
   subroutine test_kelvin_voigt(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: forms(3) = [character(7) :: "squared", "book", "dashpot"]
      real(wp), parameter :: ce(2) = [0.9_wp, 0.5_wp], cut(2) = [0.902_wp, 0.550_wp], speed = 0.5_wp
      real(wp), parameter :: pi = acos(-1.0_wp)
      type(case_t) :: case
      type(impact_t) :: impact
      real(wp) :: damping, f(4), zeta
      integer :: i, k

      do k = 1, size(forms)
         do i = 1, size(ce)
            call make_case("kelvin_voigt", ["restitution"], ce(i:i), "form", trim(forms(k)), steel_pair(shape_internal), case)
            call run_impact(case%law, case%parameters, steel_mass, speed, impact)
            associate (e => -impact%end_rate/speed)
               select case (trim(forms(k)))
               case ("squared")
                  call check_close(error, e, ce(i), 1.0e-4_wp, "squared")
                  call check_true(error, case%law%jumps_at_turn, "squared jumps where the penetration turns")
               case ("book")
                  call check_close(error, e, sqrt(ce(i)), 1.0e-4_wp, "book")
                  call check_true(error, case%law%jumps_at_turn, "the book's form jumps where the penetration turns")
               case ("dashpot")
                  call check_close(error, e, cut(i), 5.0e-4_wp, "dashpot")
                  call check_true(error, .not. case%law%jumps_at_turn, "the dashpot does not jump")
                  zeta = -log(ce(i))/sqrt(pi**2 + log(ce(i))**2)
                  damping = 2.0_wp*zeta*sqrt(1.5e8_wp*steel_mass)
                  f = force_of(case, 1.0e-5_wp, 0.1_wp, 0.3_wp)
                  call check_close(error, f, [1500.0_wp + 0.1_wp*damping, 1.5e8_wp, damping, 1500.0_wp], 1.0e-14_wp, &
                                   "dashpot: force", relative=.true.)
               end select
               call check_close(error, impact%lost, 0.5_wp*steel_mass*speed**2*(1.0_wp - e**2), 1.0e-4_wp*speed**2*steel_mass, &
                                trim(forms(k))//": energy lost")
            end associate
         end do
      end do
      call make_case("kelvin_voigt", ["restitution"], [0.9_wp], "form", "squared", steel_pair(shape_internal), case)
      f = force_of(case, 1.0e-5_wp, 0.1_wp, 0.3_wp)
      call check_close(error, f, [1500.0_wp, 1.5e8_wp, 0.0_wp, 1500.0_wp], 1.0e-15_wp, "approaching", relative=.true.)
      f = force_of(case, 1.0e-5_wp, -0.1_wp, 0.3_wp)
      call check_close(error, f, [1215.0_wp, 1.215e8_wp, 0.0_wp, 1500.0_wp], 1.0e-15_wp, "parting", relative=.true.)
      call make_case("kelvin_voigt", ["restitution"], [1.0_wp], "form", "squared", steel_pair(shape_internal), case)
      call check_true(error, .not. case%law%jumps_at_turn, "an elastic one does not jump")
   end subroutine test_kelvin_voigt

   !> A square of side 15 mm: K = a/(0.4732 (s_i + s_j)), a half the side; damping as printed, or exact.
   subroutine test_plane_face(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      type(impact_t) :: impact
      type(surfaces_t) :: face
      real(wp) :: f(4), k

      face = steel_pair(shape_face)
      face%width = face%length
      k = 7.5e-3_wp/(0.47320100440934_wp*2.0_wp*4.3961352657e-12_wp)
      call make_case("plane_face", ["restitution"], [0.9_wp], " ", " ", face, case)
      f = force_of(case, 1.0e-6_wp, 0.1_wp, 0.3_wp)
      call check_close(error, f, k*[1.0e-6_wp*1.0475_wp, 1.0475_wp, 1.0e-6_wp*0.475_wp, 1.0e-6_wp], 1.0e-9_wp, "force", &
                       relative=.true.)
      call make_case("plane_face", ["restitution"], [0.5_wp], "damping", "exact", face, case)
      call run_impact(case%law, case%parameters, steel_mass, 0.5_wp, impact)
      call check_close(error, -impact%end_rate/0.5_wp, 0.5_wp, 1.0e-8_wp, "delivers 0.5")
      call make_case("plane_face", [character(11) :: "restitution", "stiffness"], [0.9_wp, 7.0e7_wp], " ", " ", &
                     steel_pair(shape_plane), case)
      call check_equal(error, case%message, "", "a given stiffness fits anything")
      f = force_of(case, 1.0e-6_wp, 0.0_wp, 0.3_wp)
      call check_close(error, f(1), 70.0_wp, 1.0e-15_wp, "given stiffness", relative=.true.)
   end subroutine test_plane_face

   !> Laws say which surfaces they do not fit.
   subroutine test_what_does_not_fit(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(case_t) :: case
      type(surfaces_t) :: pair

      call make_case("hertz", [" "], [0.0_wp], " ", " ", steel_pair(shape_face), case)
      call check_true(error, index(case%message, "plane faces") > 0, "Hertz on a face")
      call make_case("hertz", ["stiffness"], [1.0e9_wp], " ", " ", steel_pair(shape_face), case)
      call check_equal(error, case%message, "", "Hertz on a face with a stiffness")
      call make_case("esdu", [" "], [0.0_wp], " ", " ", steel_pair(shape_plane), case)
      call check_true(error, index(case%message, "pin in a hole") > 0, "a cylinder law on a plane")
      pair = steel_pair(shape_internal)
      pair%length = 0.0_wp
      call make_case("esdu", [" "], [0.0_wp], " ", " ", pair, case)
      call check_true(error, index(case%message, "length") > 0, "a cylinder law without length")
      call make_case("plane_face", [" "], [0.0_wp], " ", " ", steel_pair(shape_internal), case)
      call check_true(error, index(case%message, "plane face") > 0, "the face law on a pin")
   end subroutine test_what_does_not_fit

end module test_law_values
