!> Identities of every joint with clearance in space, for all normal and friction laws that space knows: a geometry is tested by
!> being registered (`spatial_clearance_bench`).
module test_spatial_clearances
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_true, suite_t
   use clearance_set, only: loss_contact, loss_friction, n_integrand
   use contact_stick_slip, only: tangent_t
   use differences, only: five_point, places
   use errors, only: error_t
   use friction_law, only: memory_bristle, memory_none
   use kinds, only: not_a_number, wp
   use motion, only: cross, loads_t, new_loads
   use point_contact, only: most_of_item
   use point_contacts, only: named_channels
   use read_channel, only: read_loose
   use revolute_level, only: film_channels
   use spatial_clearance_bench, only: bench_t, claim_all, move, n_body, tick
   implicit none (type, external)
   private
   public :: run_test_spatial_clearances

contains

   subroutine run_test_spatial_clearances(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("penetration", test_penetration)
      call suite%test("action_and_reaction", test_action_and_reaction)
      call suite%test("power", test_power)
      call suite%test("force_rate", test_force_rate)
      call suite%test("channels", test_channels)
      call suite%test("sliding", test_sliding)
   end subroutine run_test_spatial_clearances

   subroutine test_penetration(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, penetration)
   end subroutine test_penetration

   !> The rate of penetration against differences of penetration.
   subroutine penetration(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      real(wp) :: delta(most_of_item, 4), now(most_of_item), rate(most_of_item)
      integer :: k

      do k = 1, 4
         call move(bench, places(k)*tick)
         call bench%set%gaps(bench%motion, delta(:, k), rate)
      end do
      call move(bench, 0.0_wp)
      call bench%set%gaps(bench%motion, now, rate)
      do k = 1, bench%set%n_contact
         call check_close(error, rate(k), five_point(delta(k, :), tick), 1.0e-7_wp, bench%name//": rate of penetration")
      end do
   end subroutine penetration

   subroutine test_action_and_reaction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, action_and_reaction)
   end subroutine test_action_and_reaction

   !> Forces add up to zero, and moments about one point.
   subroutine action_and_reaction(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp) :: integrands(n_integrand, most_of_item), moment(3), scale
      integer :: k

      call new_loads(n_body, loads)
      bench%motion%number = 1
      call bench%set%evaluate(bench%motion, loads, integrands(:, :bench%set%n_contact))
      scale = sum(abs(loads%force))
      call check_true(error, scale > 100.0_wp, bench%name//": there are forces")
      if (allocated(error)) return
      call check_close(error, sum(loads%force, dim=2)/scale, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, bench%name//": forces")
      moment = 0.0_wp
      do k = 1, n_body
         moment = moment + loads%moment(:, k) + cross(bench%motion%r(:, k), loads%force(:, k))
      end do
      call check_close(error, moment/scale, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, bench%name//": moments")
   end subroutine action_and_reaction

   subroutine test_power(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, power)
   end subroutine test_power

   !> Power of the loads: less the rate of the stored energy, by differences, less what damping and friction take. So the force does
   !> the work that it stores, beyond an end of the bushing too.
   subroutine power(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp) :: given, integrands(n_integrand, most_of_item), scale, stored(4)
      integer :: k

      call new_loads(n_body, loads)
      call bench%set%evaluate(bench%motion, loads, integrands(:, :bench%set%n_contact))
      given = 0.0_wp
      do k = 1, n_body
         given = given + dot_product(loads%force(:, k), bench%motion%v(:, k)) &
                 + dot_product(loads%moment(:, k), bench%motion%omega(:, k))
      end do
      do k = 1, 4
         call move(bench, places(k)*tick)
         stored(k) = bench%set%elastic_energy(bench%motion)
      end do
      call move(bench, 0.0_wp)
      scale = sum(abs(loads%force))  ! powers, at speeds of about 1 m/s
      call check_close(error, given/scale, (-five_point(stored, tick) - sum(integrands(loss_contact, :bench%set%n_contact)) &
                                            - sum(integrands(loss_friction, :bench%set%n_contact)))/scale, 1.0e-7_wp, &
                       bench%name//": power")
      if (bench%set%stick_slip%memory == memory_bristle) return  ! which may give back what they have stored
      call check_true(error, all(integrands(loss_friction, :bench%set%n_contact) >= 0.0_wp), bench%name//": friction takes")
   end subroutine power

   subroutine test_force_rate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, force_rate)
   end subroutine test_force_rate

   !> The rate of the normal force, second derivative of the penetration included, against differences of the force.
   subroutine force_rate(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      real(wp) :: delta, f(4), force, rate, slope
      integer :: c, k

      if (bench%set%laws%normal%jumps_at_turn) return
      do c = 1, bench%set%n_contact
         if (.not. bench%set%contact(c)%is_touching) cycle
         do k = 1, 4
            call move(bench, places(k)*tick)
            call bench%set%monitor(c, bench%motion, delta, rate, f(k), slope)
         end do
         call move(bench, 0.0_wp)
         call bench%set%monitor(c, bench%motion, delta, rate, force, slope)
         call check_close(error, slope/force, five_point(f, tick)/force, 1.0e-3_wp + 3.0e-7_wp*abs(slope/force), &
                          bench%name//": rate of the force")
      end do
   end subroutine force_rate

   subroutine test_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, channels)
   end subroutine test_channels

   !> Every channel that a geometry announces is filled, but those of films; the force on the journal is that of the loads.
   subroutine channels(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp), allocatable :: taken(:, :), values(:, :)
      real(wp) :: integrands(n_integrand, most_of_item), scale
      logical :: is_of_contact
      integer :: c

      call new_loads(n_body, loads)
      bench%motion%number = 1
      call bench%set%evaluate(bench%motion, loads, integrands(:, :bench%set%n_contact))
      scale = sum(abs(loads%force))
      do c = 1, size(bench%info%channels)
         associate (channel => bench%info%channels(c))
            if (index(film_channels//" p_v ", " "//channel%name//" ") > 0) cycle  ! p v is one of pins with a length
            is_of_contact = index(" penetration penetration_rate normal_force friction_force state contact_point"//named_channels, &
                                  " "//channel%name//" ") > 0
            allocate (values(merge(3, 1, channel%components == 2), merge(bench%set%n_contact, 1, is_of_contact)), &
                      source=not_a_number())
            bench%motion%number = 2  ! not the one of the evaluation
            call read_loose(bench%set, channel%name, bench%motion, values)
            call check_true(error, all(ieee_is_finite(values)), bench%name//": channel "//channel%name)
            taken = values
            bench%motion%number = 1
            call read_loose(bench%set, channel%name, bench%motion, taken)
            call check_close(error, reshape(taken, [size(taken)]), reshape(values, [size(values)]), &
                             1.0e-14_wp*maxval(abs(values)), bench%name//": evaluated "//channel%name)
            if (channel%name == "force") then
               call check_close(error, values(:, 1)/scale, loads%force(:, 2)/scale, 1.0e-14_wp, bench%name//": force")
            end if
            deallocate (values)
         end associate
      end do
   end subroutine channels

   subroutine test_sliding(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, sliding)
   end subroutine test_sliding

   !> Rates of the sliding velocities along the tangents, by accelerations and drift, against differences; the tangents are at right
   !> angles to each other and to the normal, which turns as the tangent plane does.
   subroutine sliding(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(tangent_t) :: later, tangent
      real(wp) :: a(3), n(3, 4), normal(3), v(2, 4)
      integer :: c, k

      if (bench%set%stick_slip%memory == memory_none) return
      do c = 1, bench%set%n_contact
         call bench%set%lie(c, bench%motion, tangent)
         tangent%slip_direction = tangent%t(:, 1) + 0.3_wp*tangent%t(:, 2)
         call bench%set%lie(c, bench%motion, tangent)
         later = tangent
         do k = 1, 4
            call move(bench, places(k)*tick)
            call bench%set%lie(c, bench%motion, later)
            v(:, k) = later%v
            n(:, k) = cross(later%t(:, 1), later%t(:, 2))
         end do
         call move(bench, 0.0_wp)
         a = bench%motion%a(:, 2) + cross(bench%motion%alpha(:, 2), tangent%arm_j) - bench%motion%a(:, 1) &
             - cross(bench%motion%alpha(:, 1), tangent%arm_i)
         do k = 1, 2
            call check_close(error, dot_product(tangent%t(:, k), a) + tangent%drift(k), five_point(v(k, :), tick), &
                             1.0e-6_wp*(100.0_wp + abs(tangent%drift(k))), bench%name//": rate of sliding")
         end do
         normal = cross(tangent%t(:, 1), tangent%t(:, 2))
         call check_close(error, pack(matmul(transpose(tangent%t), tangent%t), .true.), [1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], &
                          1.0e-13_wp, bench%name//": tangents at right angles")
         call check_close(error, cross(tangent%spin, normal), [(five_point(n(k, :), tick), k=1, 3)], 1.0e-4_wp, &
                          bench%name//": turn of the tangent plane")
      end do
   end subroutine sliding

end module test_spatial_clearances
