!> Named functions of a deck: every kind by its registry, then what decks write and what comes out.
module test_functions
   use check, only: check_close, check_equal, check_true, suite_t
   use curve, only: curve_values
   use differences, only: five_point, places
   use errors, only: error_t
   use expression, only: expression_t
   use fixed_random, only: random_t, seed_of
   use function_kind, only: function_kind_t, made_t
   use function_registry, only: n_function_kinds, new_function_kind
   use generic_item, only: fill_item
   use item, only: item_t
   use kind_info, only: dim_length, dim_t, kind_info_t, same_dimension
   use kinds, only: i8, pi, wp
   use scene, only: scene_t
   use scene_fixture, only: nl, read_scene_text
   implicit none (type, external)
   private
   public :: run_test_functions

contains

   subroutine run_test_functions(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("derivatives", test_derivatives)
      call suite%test("values", test_values)
      call suite%test("arguments", test_arguments)
      call suite%test("lengths_as_arguments", test_lengths_as_arguments)
   end subroutine run_test_functions

   !> Every kind: first and second derivatives are those of the value.
   subroutine test_derivatives(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-3_wp
      class(function_kind_t), allocatable :: kind
      type(item_t) :: item
      type(kind_info_t) :: info
      type(made_t) :: made
      type(random_t) :: random
      real(wp) :: f(3), near(3, 4)
      integer :: i, k, seed

      do k = 1, n_function_kinds()
         call new_function_kind(k, kind)
         info = kind%info()
         do seed = 1, 3
            random%state = seed_of(info%name, seed)
            call fill_item(info, seed, random, item)
            do i = 1, size(info%columns)
               ! c0, c1 ... of a polynomial have a dimension of their own each
               if (info%columns(i)%is_any .and. scan(info%columns(i)%name, "0123456789") == 2) then
                  item%values(i)%dimensions(1) = dim_t(m=1, s=real(1 - i, wp))
               end if
               select case (info%columns(i)%name)  ! of a cam that rises there
               case ("rise", "return"); item%values(i)%number = 2.0_wp
               case ("dwell", "start"); item%values(i)%number = 0.5_wp
               case ("period"); item%values(i)%number = 9.0_wp
               end select
               ! ends follow from the samples where the curve is Akima's
               if (info%columns(i)%name == "ends") item%values(i)%given = item%values(i)%given .and. item%word("curve") /= "akima"
               if (info%columns(i)%name == "end") item%values(i)%number = 3.0_wp  ! behind every origin, and where it is looked at
            end do
            call kind%make(item, made)
            call check_equal(error, made%column, 0, info%name//": no error")
            if (allocated(error)) return
            do i = 1, 4
               call curve_values(made%curve, 1.43_wp + places(i)*step, near(:, i))
            end do
            call curve_values(made%curve, 1.43_wp, f)
            call check_close(error, [five_point(near(1, :), step), five_point(near(2, :), step)], f(2:3), 1.0e-8_wp, &
                             info%name//": derivatives")
            call check_true(error, abs(f(2)) > 1.0e-6_wp, info%name//": it moves")
         end do
      end do
   end subroutine test_derivatives

   !> A deck around some tables of functions and the force of a point, whose x component is an expression.
   subroutine read_force(tables, source, expression, error)
      character(*), intent(in) :: tables                         !! tables of functions
      character(*), intent(in) :: source                         !! cell in column fx
      type(expression_t), intent(out) :: expression              !! what it is
      type(error_t), allocatable, intent(inout) :: error         !! first failure; errors in it

      type(scene_t) :: scene
      integer :: k

      call read_scene_text("[parameters]"//nl//"w = 3 rad/s"//nl//"size = 2 N"//nl// &
                           "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"mass 1 1 0 0"//nl// &
                           "[points]"//nl//"name body xi[m] eta[m]"//nl//"middle mass 0 0"//nl//tables//nl// &
                           "[force.point]"//nl//"name point fx"//nl//"push middle "//source//nl// &
                           "[analysis.dynamic]"//nl//"end = 1 s", scene, error)
      if (allocated(error)) return
      do k = 1, size(scene%forces)
         if (size(scene%forces(k)%items) > 0) expression = scene%forces(k)%items(1)%values(2)%expression
      end do
   end subroutine read_force

   !> Check value and derivatives of an expression.
   subroutine check_jet(error, expression, t, expected, what)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      type(expression_t), intent(in) :: expression        !! the expression
      real(wp), intent(in) :: t                           !! time [s]
      real(wp), intent(in) :: expected(3)                 !! (3) value and derivatives [any]
      character(*), intent(in) :: what                    !! for the message

      real(wp) :: jet(3)

      if (allocated(error)) return
      call expression%evaluate(t, jet(1), jet(2), jet(3))
      call check_close(error, jet, expected, 1.0e-11_wp, what)
   end subroutine check_jet

   !> Polynomial, harmonic and samples as decks write them, by hand.
   subroutine test_values(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(expression_t) :: expression
      real(wp) :: t

      t = 0.6_wp
      call read_force("[function.polynomial]"//nl//"name c0 c1[N/s] c3 origin"//nl//"rise 2N 3 -400mN/s^3 100ms", &
                      "{rise(t)}", expression, error)
      call check_jet(error, expression, t, [2.0_wp + 1.5_wp - 0.4_wp*0.125_wp, 3.0_wp - 1.2_wp*0.25_wp, -2.4_wp*0.5_wp], &
                     "polynomial")
      call read_force("[function.polynomial]"//nl//"name c0 c1[N/s] origin end beyond"//nl// &
                      "held 2N 3 0.1s 0.5s -"//nl//"on 2N 3 0.1s 0.5s linear"//nl//"ahead 2N 3 0.7s 1s -", &
                      "{held(t) + 10*on(t) + 100*ahead(t)}", expression, error)
      call check_jet(error, expression, t, [3.2_wp + 35.0_wp + 200.0_wp, 30.0_wp, 0.0_wp], "polynomials that end")
      call read_force("[function.harmonic]"//nl//"name amplitude angular_frequency phase[deg] offset"//nl// &
                      "sway {size} {w} 30 1kN", "{2*sway(t)}", expression, error)
      call check_jet(error, expression, t, 2.0_wp*[1000.0_wp + 2.0_wp*sin(1.8_wp + pi/6.0_wp), 6.0_wp*cos(1.8_wp + pi/6.0_wp), &
                                                   -18.0_wp*sin(1.8_wp + pi/6.0_wp)], "harmonic")
      ! samples of 5 t^3 with a unit in the header, one beside the list, one glued
      call read_force("[function.samples]"//nl//"name at[ms] value"//nl// &
                      "push ""0 200 400ms 800 1s"" ""0 0.04 0.32 2.56 5 N""", "{push(t)}", expression, error)
      call check_jet(error, expression, t, [5.0_wp*t**3, 15.0_wp*t**2, 30.0_wp*t], "samples")
   end subroutine test_values

   !> The argument may be any expression of the right dimension; functions of functions; constants.
   subroutine test_arguments(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: square = "[function.polynomial]"//nl//"name c2 c1"//nl//"late 1s^-1 -"//nl//"twice 3N/s^2 0N/s"
      type(expression_t) :: expression
      real(wp) :: t

      t = 0.7_wp
      call read_force(square, "{twice(2*t - 0.1s)}", expression, error)
      call check_jet(error, expression, t, [3.0_wp*1.3_wp**2, 12.0_wp*1.3_wp, 24.0_wp], "inner derivative")
      call read_force(square, "{twice(late(t)) + twice(t)}", expression, error)
      call check_jet(error, expression, t, [3.0_wp*t**4 + 3.0_wp*t**2, 12.0_wp*t**3 + 6.0_wp*t, 36.0_wp*t**2 + 6.0_wp], &
                     "function of a function")
      call read_force(square, "{twice(2s)^2/(1 N)}", expression, error)
      call check_jet(error, expression, t, [144.0_wp, 0.0_wp, 0.0_wp], "constant argument")
      call check_true(error, expression%is_constant, "a constant")
      call read_force(square, "{1N*2^(twice(1s)/(1N))}", expression, error)
      call check_jet(error, expression, t, [8.0_wp, 0.0_wp, 0.0_wp], "constant exponent")
   end subroutine test_arguments

   !> Samples over a length: a dimension of their own, in and out.
   subroutine test_lengths_as_arguments(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(expression_t) :: expression
      type(scene_t) :: scene
      integer :: k
      real(wp) :: x

      call read_force("[function.samples]"//nl//"name at value beyond"//nl// &
                      "stop ""0 1 2 3 mm"" ""0 2 8 18 N"" linear", "{stop(4mm/s*t)}", expression, error)
      x = 4.0_wp*0.5_wp
      call check_jet(error, expression, 0.5_wp, [2.0_wp*x**2, 16.0_wp*x, 64.0_wp], "force over length")
      if (allocated(error)) return
      call check_true(error, size(expression%curves) == 1, "one curve is kept")
      call check_true(error, .not. expression%is_smooth(), "its curvature jumps at the last sample")
      call check_close(error, expression%curves(1)%x(4), 3.0e-3_wp, 1.0e-18_wp, "places in SI")
      call read_scene_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"mass 1 1 0 0"//nl// &
                           "[function.samples]"//nl//"name at value"//nl//"way ""0 1 2 3 s"" ""0 0 0 1 mm"""//nl// &
                           "[analysis.dynamic]"//nl//"end = 1 s", scene, error)
      if (allocated(error)) return
      do k = 1, n_function_kinds()
         if (size(scene%tables%functions(k)%items) == 0) cycle
         call check_true(error, same_dimension(scene%tables%functions(k)%items(1)%values(2)%dimensions(1), dim_length), "a length")
      end do
   end subroutine test_lengths_as_arguments

end module test_functions
