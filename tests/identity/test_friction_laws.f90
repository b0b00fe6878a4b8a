!> Identities of every friction law, and the ramp of Ambrosio's.
module test_friction_laws
   use check, only: check_close, check_equal, check_true, suite_t
   use contact_registry, only: n_friction_kinds, new_friction_law
   use errors, only: error_t
   use fixed_random, only: random_t, seed_of
   use friction_law, only: friction_law_t, memory_none, memory_slip
   use generic_item, only: column_number, fill_item, set_number
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_test_friction_laws

   integer, parameter :: n_row = 4  !! rows of each law

contains

   subroutine run_test_friction_laws(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("magnitude", test_magnitude)
      call suite%test("ramp", test_ramp)
      call suite%test("mistake", test_mistake)
      call suite%test("constant", test_constant)
      call suite%test("rooney_deravi", test_rooney_deravi)
      call suite%test("threlfall", test_threlfall)
      call suite%test("brown_mcphee", test_brown_mcphee)
      call suite%test("stribeck", test_stribeck)
      call suite%test("dahl", test_dahl)
   end subroutine run_test_friction_laws

   !> A row of a friction law with any numbers that make sense together.
   subroutine make_friction(kind, row, law, item)
      integer, intent(in) :: kind                                 !! number of the law
      integer, intent(in) :: row                                  !! number of the row
      class(friction_law_t), allocatable, intent(out) :: law      !! the law
      type(item_t), intent(out) :: item                           !! its row

      type(kind_info_t) :: info
      type(random_t) :: random
      integer :: attempt

      call new_friction_law(kind, law)
      info = law%info()
      random%state = seed_of(info%name, row)
      do attempt = 1, 100
         call new_friction_law(kind, law)
         call fill_item(law%info(), row, random, item)
         call law%prepare(item)
         if (law%mistake() == "") return
      end do
   end subroutine make_friction

   !> Not negative, not above the maximum coefficient times the normal force and in proportion to it, or constant.
   subroutine test_magnitude(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 9
      real(wp), parameter :: speed(n) = [0.0_wp, 1.0e-9_wp, 0.3_wp, 0.7_wp, 1.0_wp, 1.5_wp, 2.0_wp, 3.0_wp, 1.0e6_wp]
      class(friction_law_t), allocatable :: law
      type(item_t) :: item
      type(kind_info_t) :: info
      real(wp), dimension(n) :: f, force, limit, twice
      integer :: c, k, kind, row

      do kind = 1, n_friction_kinds()
         do row = 1, n_row
            call make_friction(kind, row, law, item)
            info = law%info()
            call check_true(error, law%mistake() == "", info%name//": the row makes sense")
            force = [(100.0_wp*k, k=1, n)]
            call law%force(n, force, speed, f)
            call law%force(n, 2.0_wp*force, speed, twice)
            if (law%memory == memory_none) call check_close(error, f(1), 0.0_wp, 0.0_wp, info%name//": nothing at rest")
            call check_close(error, twice(2:), merge(1.0_wp, 2.0_wp, column_number(info, "force") > 0)*f(2:), 1.0e-14_wp, &
                             info%name//": proportional, or constant", relative=.true.)
            call check_true(error, all(f >= 0.0_wp), info%name//": not negative")
            call check_true(error, maxval(f) > 0.0_wp, info%name//": there is a force")
            call check_true(error, law%is_active(), info%name//": active")
            c = column_number(info, "coefficient")
            if (c == 0) cycle
            limit = max(item%values(c)%number, number_of("static_coefficient"))*force + number_of("viscosity")*speed*force
            ! a smooth peak is a little higher
            call check_true(error, all(f <= limit*(1.0_wp + 2.0e-3_wp)), &
                            info%name//": at most the greatest coefficient times the normal force")
            call set_number(info, "coefficient", 0.0_wp, item)
            call set_number(info, "static_coefficient", 0.0_wp, item)
            call set_number(info, "viscosity", 0.0_wp, item)
            call law%prepare(item)
            call check_true(error, .not. law%is_active(), info%name//": without coefficient not active")
         end do
      end do

   contains

      !> Number in a column of the row, 0 if the kind has no such column.
      real(wp) function number_of(name)
         character(*), intent(in) :: name   !! the column

         number_of = 0.0_wp
         if (column_number(info, name) > 0) number_of = item%values(column_number(info, name))%number
      end function number_of

   end subroutine test_magnitude

   !> Ambrosio's ramp: nothing up to v0, in proportion up to v1, then all of c_f F_N.
   subroutine test_ramp(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: speed(7) = [0.0_wp, 0.5e-3_wp, 1.0e-3_wp, 2.0e-3_wp, 4.0e-3_wp, 5.0e-3_wp, 50.0_wp]
      real(wp), parameter :: part(7) = [0.0_wp, 0.0_wp, 0.0_wp, 0.25_wp, 0.75_wp, 1.0_wp, 1.0_wp]
      class(friction_law_t), allocatable :: law
      real(wp) :: f(7)

      call make_ambrosio(0.12_wp, 1.0e-3_wp, 5.0e-3_wp, law)
      call law%force(7, spread(500.0_wp, 1, 7), speed, f)
      call check_close(error, f, 60.0_wp*part, 1.0e-12_wp, "ramp")
      call make_ambrosio(0.12_wp, 0.0_wp, 5.0e-3_wp, law)
      call law%force(2, [500.0_wp, 500.0_wp], [0.0_wp, 1.0e-3_wp], f(1:2))
      call check_close(error, f(1:2), [0.0_wp, 12.0_wp], 1.0e-12_wp, "ramp from zero")
   end subroutine test_ramp

   !> A law by its name, its numbers in the order of its columns, and a word in the last one.
   subroutine make_named(name, numbers, word, law)
      character(*), intent(in) :: name                          !! without `friction.`
      real(wp), intent(in) :: numbers(:)                        !! (n) SI [any]
      character(*), intent(in) :: word                          !! blank: none
      class(friction_law_t), allocatable, intent(out) :: law    !! the law

      type(item_t) :: item
      type(kind_info_t) :: info
      integer :: kind

      do kind = 1, n_friction_kinds()
         call make_friction(kind, 1, law, item)
         info = law%info()
         if (info%name == "friction."//name) exit
      end do
      item%values(1:size(numbers))%number = numbers
      if (word /= " ") item%values(size(item%values))%text = word
      call law%prepare(item)
   end subroutine make_named

   !> The same force whatever the normal force, with a ramp or, as printed, without.
   subroutine test_constant(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(friction_law_t), allocatable :: law
      real(wp) :: f(5)

      call make_named("constant", [3.0_wp, 1.0e-3_wp, 100.0_wp], " ", law)
      call law%force(5, [1.0_wp, 1.0_wp, 1.0e6_wp, 0.0_wp, 5.0_wp], [0.0_wp, 0.25e-3_wp, 7.0_wp, 7.0_wp, 1.0e-3_wp], f)
      call check_close(error, f, [0.0_wp, 0.75_wp, 3.0_wp, 0.0_wp, 3.0_wp], 1.0e-15_wp, "with a ramp")
      call make_named("constant", [3.0_wp, 0.0_wp, 100.0_wp], " ", law)
      call law%force(3, [1.0_wp, 1.0_wp, 1.0e6_wp], [0.0_wp, 1.0e-12_wp, 7.0_wp], f(1:3))
      call check_close(error, f(1:3), [3.0_wp, 3.0_wp, 3.0_wp], 0.0_wp, "as printed, sliding at any speed")
      call check_true(error, law%memory == memory_slip, "sticks")
      call check_close(error, [law%stick_limit(1.0_wp), law%stick_limit(0.0_wp)], [3.0_wp, 0.0_wp], 0.0_wp, "what it holds")
   end subroutine test_constant

   !> In proportion to the speed up to v1, then all of c_f F_N.
   subroutine test_rooney_deravi(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(friction_law_t), allocatable :: law
      real(wp) :: f(4)

      call make_named("rooney_deravi", [0.1_wp, 2.0e-3_wp], " ", law)
      call law%force(4, spread(500.0_wp, 1, 4), [0.0_wp, 0.5e-3_wp, 2.0e-3_wp, 9.0_wp], f)
      call check_close(error, f, [0.0_wp, 12.5_wp, 50.0_wp, 50.0_wp], 1.0e-14_wp, "ramp")
   end subroutine test_rooney_deravi

   !> The exponential below v_r, the three ways above, and a rise instead of a jump; the slope at rest is 3 c_f F_N/v_r.
   subroutine test_threlfall(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: full = 50.0_wp, knee = 0.950212931632136_wp  ! [N], 1 - exp(-3)
      real(wp), parameter :: v_r = 2.0e-3_wp  ! [m/s]
      real(wp), parameter :: speed(5) = [0.0_wp, 1.0e-9_wp, 1.0e-3_wp, v_r, 4.0e-3_wp]
      class(friction_law_t), allocatable :: law
      real(wp) :: f(5)

      call make_named("threlfall", [0.1_wp, 2.0e-3_wp], "continuous", law)
      call law%force(5, spread(500.0_wp, 1, 5), speed, f)
      call check_close(error, f, full*[0.0_wp, 1.5e-6_wp, 0.776869839851570_wp, knee, knee], 1.0e-8_wp, "continuous")
      call make_named("threlfall", [0.1_wp, 2.0e-3_wp], "exponential", law)
      call law%force(5, spread(500.0_wp, 1, 5), speed, f)
      call check_close(error, f(4:), full*[knee, 0.997521247823334_wp], 1.0e-12_wp, "exponential")
      call make_named("threlfall", [0.1_wp, 2.0e-3_wp], "book", law)
      call law%force(5, spread(500.0_wp, 1, 5), speed, f)
      call check_close(error, f(3:), full*[0.776869839851570_wp, 1.0_wp, 1.0_wp], 1.0e-12_wp, "book")
      if (allocated(error)) return
      call law%force(5, spread(500.0_wp, 1, 5), v_r*[0.98_wp, 0.984_wp, 0.99_wp, 0.995_wp, 1.0_wp - 1.0e-9_wp], f)
      call check_close(error, f, full*[0.947134271261650_wp, 0.952_wp, 0.97_wp, 0.985_wp, 1.0_wp - 3.0e-9_wp], 1.0e-12_wp, &
                       "rise to the full force")
   end subroutine test_threlfall

   !> mu_s at v_t but for 1 - tanh(4), mu_d far beyond, the viscous part in proportion; smooth.
   subroutine test_brown_mcphee(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(friction_law_t), allocatable :: law
      real(wp) :: f(4)

      call make_named("brown_mcphee", [0.1_wp, 0.16_wp, 2.0e-3_wp, 0.0_wp], " ", law)
      call law%force(4, spread(500.0_wp, 1, 4), [0.0_wp, 2.0e-3_wp, 4.0e-3_wp, 10.0_wp], f)
      ! at 2 v_t: mu_d tanh(8) + 0.06 * 2/(1.75)^2
      call check_close(error, f, 500.0_wp*[0.0_wp, 0.16_wp - 0.1_wp*(1.0_wp - 0.999329299739067_wp), &
                                           0.1_wp*0.999999774929676_wp + 0.12_wp/3.0625_wp, 0.1_wp], 1.0e-8_wp, "Stribeck")
      call make_named("brown_mcphee", [0.1_wp, 0.16_wp, 2.0e-3_wp, 0.01_wp], " ", law)
      call law%force(1, [500.0_wp], [10.0_wp], f(1:1))
      call check_close(error, f(1), 500.0_wp*(0.1_wp + 0.1_wp), 1.0e-8_wp, "viscous")
      call make_named("brown_mcphee", [0.2_wp, 0.16_wp, 2.0e-3_wp, 0.0_wp], " ", law)
      call check_true(error, index(law%mistake(), "static") > 0, "static below coefficient")
   end subroutine test_brown_mcphee

   !> The sliding coefficient far beyond v_s, the static one between v_0 and v_s, one part in e at v_s; the viscous part.
   subroutine test_stribeck(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(friction_law_t), allocatable :: law
      real(wp) :: f(4)

      call make_named("stribeck", [0.1_wp, 0.16_wp, 1.0e-2_wp, 1.0e-6_wp, 2.0_wp, 0.0_wp], " ", law)
      call law%force(4, spread(500.0_wp, 1, 4), [0.0_wp, 1.0e-4_wp, 1.0e-2_wp, 1.0_wp], f)
      call check_close(error, f, 500.0_wp*[0.0_wp, 0.16_wp - 0.06_wp*0.99995000166e-4_wp, &
                                           0.1_wp + 0.06_wp*0.367879441171442_wp, 0.1_wp], 1.0e-8_wp, "Stribeck's curve")
      call make_named("stribeck", [0.1_wp, 0.1_wp, 1.0e-2_wp, 1.0e-3_wp, 1.0_wp, 0.02_wp], " ", law)
      call law%force(2, spread(500.0_wp, 1, 2), [1.0e-3_wp, 10.0_wp], f(:2))
      call check_close(error, f(:2), 500.0_wp*[0.1_wp*0.761594155955765_wp + 2.0e-5_wp, 0.1_wp + 0.2_wp], 1.0e-9_wp, "its parts")
      call make_named("stribeck", [0.2_wp, 0.16_wp, 1.0e-2_wp, 1.0e-3_wp, 2.0_wp, 0.0_wp], " ", law)
      call check_true(error, index(law%mistake(), "static") > 0, "static below coefficient")
   end subroutine test_stribeck

   !> The deflections that follow for a way s from z = 0: mu/sigma (1 - exp(-sigma s/mu)) for i = 1 and, of sigma s/mu = x,
   !> mu/sigma x/(1 + x) for i = 2; back from the steady one it yields twice as fast as it started; steady is steady.
   subroutine test_dahl(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: mu = 0.3_wp, sigma = 2.0e4_wp, v = 0.07_wp
      class(friction_law_t), allocatable :: law
      real(wp) :: f(1), rate(1), x
      integer :: k

      do k = 0, 6
         x = 0.5_wp*k
         call make_named("dahl", [mu, sigma, 1.0_wp], " ", law)
         call law%bristles(1, 100.0_wp, [v], [mu/sigma*(1.0_wp - exp(-x))], f, rate)
         call check_close(error, rate(1), v*exp(-x), 1.0e-14_wp, "ductile: rate")
         call check_close(error, f(1), 100.0_wp*mu*(1.0_wp - exp(-x)), 1.0e-12_wp, "ductile: force")
         call make_named("dahl", [mu, sigma, 2.0_wp], " ", law)
         call law%bristles(1, 100.0_wp, [v], [mu/sigma*x/(1.0_wp + x)], f, rate)
         call check_close(error, rate(1), v/(1.0_wp + x)**2, 1.0e-14_wp, "a greater exponent: rate")
         call law%bristles(1, 100.0_wp, [-v], [-mu/sigma*x/(1.0_wp + x)], f, rate)
         call check_close(error, rate(1), -v/(1.0_wp + x)**2, 1.0e-14_wp, "the other way: rate")
      end do
      call make_named("dahl", [mu, sigma, 1.0_wp], " ", law)
      call law%bristles(1, 100.0_wp, [v], [mu/sigma], f, rate)
      call check_close(error, [f, rate], [30.0_wp, 0.0_wp], 1.0e-13_wp, "steady")
      call law%bristles(1, 100.0_wp, [-v], [mu/sigma], f, rate)
      call check_close(error, rate(1), -2.0_wp*v, 1.0e-14_wp, "back")
      call law%bristles(1, 100.0_wp, [v], [1.1_wp*mu/sigma], f, rate)
      call check_close(error, rate(1), -0.1_wp*v, 1.0e-13_wp, "what is too far comes back")
   end subroutine test_dahl

   !> Ambrosio's law with given numbers.
   subroutine make_ambrosio(coefficient, v0, v1, law)
      real(wp), intent(in) :: coefficient                       !! c_f [1]
      real(wp), intent(in) :: v0                                !! no force below [m/s]
      real(wp), intent(in) :: v1                                !! full force above [m/s]
      class(friction_law_t), allocatable, intent(out) :: law    !! the law

      type(item_t) :: item
      type(kind_info_t) :: info
      integer :: kind

      do kind = 1, n_friction_kinds()
         call make_friction(kind, 1, law, item)
         info = law%info()
         if (info%name == "friction.ambrosio") exit
      end do
      call set_number(info, "coefficient", coefficient, item)
      call set_number(info, "v0", v0, item)
      call set_number(info, "v1", v1, item)
      call law%prepare(item)
   end subroutine make_ambrosio

   !> A ramp that does not rise is an error of the deck.
   subroutine test_mistake(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(friction_law_t), allocatable :: law

      call make_ambrosio(0.1_wp, 1.0e-3_wp, 1.0e-3_wp, law)
      call check_true(error, index(law%mistake(), "v1") > 0, "v1 = v0 is a mistake")
      call make_ambrosio(0.1_wp, 2.0e-3_wp, 1.0e-3_wp, law)
      call check_true(error, index(law%mistake(), "v1") > 0, "v1 < v0 is a mistake")
      call make_ambrosio(0.1_wp, 1.0e-3_wp, 1.001e-3_wp, law)
      call check_equal(error, law%mistake(), "", "v1 > v0")
   end subroutine test_mistake

end module test_friction_laws
