!> Identities of every joint with clearance, for all laws, with and without friction, in all forms.
module test_clearances
   use check, only: check_close, check_true, suite_t
   use clearance_bench, only: bench_t, claim_all, evaluate_loads, get_gaps, move_to, n_all, n_before, n_body, n_item
   use clearance_set, only: loss_contact, loss_friction, n_integrand, normal_impulse
   use contact_memory, only: approaches, parts
   use differences, only: five_point, places, six_places, six_point
   use errors, only: error_t
   use faced_contacts, only: faced_contacts_t
   use kinds, only: wp
   use motion, only: loads_t
   use point_contact, only: point_contact_t
   use read_channel, only: read_loose
   implicit none (type, external)
   private
   public :: run_test_clearances

   real(wp), parameter :: tick = 1.0e-7_wp  !! step of differences in time [s]

contains

   subroutine run_test_clearances(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("penetration_rate", test_penetration_rate)
      call suite%test("action_and_reaction", test_action_and_reaction)
      call suite%test("power", test_power)
      call suite%test("elastic_energy", test_elastic_energy)
      call suite%test("force_rate", test_force_rate)
   end subroutine run_test_clearances

   subroutine test_penetration_rate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, penetration_rate)
   end subroutine test_penetration_rate

   !> The rate of penetration against differences of penetration; other sets' places are left alone.
   subroutine penetration_rate(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      real(wp), parameter :: h = 4.0e-7_wp  ! the normal of a pin turns by some 1e4 rad/s
      real(wp) :: delta(n_all, 4), expected(n_all), rate(n_all)
      integer :: k

      do k = 1, 4
         call get_gaps(bench, places(k)*h, delta(:, k), rate)
      end do
      expected = [(five_point(delta(k, :), h), k=1, n_all)]
      expected(bench%others) = -1.0_wp
      call get_gaps(bench, 0.0_wp, delta(:, 1), rate)
      call check_close(error, rate, expected, 1.0e-9_wp, bench%name//": rate")
      call check_true(error, all(abs(delta(bench%others, 1) + 1.0_wp) <= 0.0_wp), bench%name//": others")
   end subroutine penetration_rate

   subroutine test_action_and_reaction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, action_and_reaction)
   end subroutine test_action_and_reaction

   !> Forces add up to zero; moments about the origin too, but for the book's couple penetration times friction.
   subroutine action_and_reaction(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp) :: couple, delta(n_all), friction(1, n_all), integrands(n_integrand, n_all), moment, rate(n_all), scale
      integer :: body

      call evaluate_loads(bench, loads, integrands)
      scale = sum(abs(loads%force))
      call check_true(error, scale > 1000.0_wp, bench%name//": there are forces")
      call check_close(error, sum(loads%force, dim=2), [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp*scale, bench%name//": forces")
      moment = 0.0_wp
      do body = 0, n_body
         moment = moment + loads%moment(3, body) + bench%motion%r(1, body)*loads%force(2, body) &
                  - bench%motion%r(2, body)*loads%force(1, body)
      end do
      couple = 0.0_wp
      if (bench%is_book .and. .not. bench%has_faces) then
         call get_gaps(bench, 0.0_wp, delta, rate)
         friction = 0.0_wp
         call read_loose(bench%set, "friction_force", bench%motion, friction)
         couple = sum(delta(n_before + 1:n_before + n_item)*friction(1, n_before + 1:n_before + n_item))
         if (allocated(bench%set%laws%friction)) call check_true(error, abs(couple) > 1.0e-6_wp, bench%name//": there is a couple")
      end if
      call check_close(error, moment, couple, 1.0e-13_wp*scale, bench%name//": moments about the origin")
   end subroutine action_and_reaction

   subroutine test_power(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, power)
   end subroutine test_power

   !> Power of the loads + power lost + rate of elastic energy = 0; friction only takes, if it acts where it is measured.
   !> The elastic energy of faces is differentiated, that of single contacts is the law's.
   subroutine power(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp), dimension(bench%set%n_contact) :: elastic, f
      real(wp) :: delta(n_all), given, integrands(n_integrand, n_all), rate(n_all), scale, stored
      integer :: body

      call elastic_forces(bench, f, elastic)
      stored = face_energy_rate(bench)
      call get_gaps(bench, 0.0_wp, delta, rate)
      bench%set%contact%course = merge(approaches, parts, rate(bench%first:bench%last) >= 0.0_wp)
      call evaluate_loads(bench, loads, integrands)
      call get_gaps(bench, 0.0_wp, delta, rate)
      associate (set => bench%set, first => bench%first, last => bench%last)
         if (.not. bench%has_faces) stored = sum(elastic*rate(first:last))
         scale = sum(abs(elastic*rate(first:last)))
         given = 0.0_wp
         do body = 1, n_body
            given = given + dot_product(loads%force(:, body), bench%motion%v(:, body)) &
                    + dot_product(loads%moment(:, body), bench%motion%omega(:, body))
         end do
         call check_close(error, given + sum(integrands([loss_contact, loss_friction], first:last)) + stored, 0.0_wp, &
                          merge(1.0e-10_wp, 1.0e-12_wp, bench%has_faces)*scale, bench%name//": power")
         if (.not. bench%has_faces) then
            call check_close(error, integrands(loss_contact, first:last), (f - elastic)*rate(first:last), 1.0e-13_wp*scale, &
                             bench%name//": lost in contact")
            call check_close(error, integrands(normal_impulse, first:last), f, 1.0e-13_wp*sum(abs(f)), bench%name//": normal force")
         end if
         if (allocated(set%laws%friction)) then
            call check_true(error, maxval(abs(integrands(loss_friction, first:last))) > 1.0_wp, bench%name//": friction works")
            if (.not. bench%is_book) then
               call check_true(error, minval(integrands(loss_friction, first:last)) >= 0.0_wp, bench%name//": friction only takes")
            end if
         else
            call check_true(error, maxval(abs(integrands(loss_friction, first:last))) <= 0.0_wp, bench%name//": no friction")
         end if
      end associate
      call check_true(error, all(abs(integrands(:, bench%others) + 1.0_wp) <= 0.0_wp), bench%name//": what is integrated of others")
   end subroutine power

   !> Normal forces of the touching contacts and their elastic parts, each by itself.
   subroutine elastic_forces(bench, f, elastic)
      type(bench_t), intent(inout) :: bench   !! the set
      real(wp), intent(out) :: f(:)           !! (n_contact) forces [N]
      real(wp), intent(out) :: elastic(:)     !! (n_contact) elastic parts [N]

      real(wp), dimension(size(f)) :: by_delta, by_rate, d, speed
      real(wp) :: delta(n_all), rate(n_all)

      call get_gaps(bench, 0.0_wp, delta, rate)
      associate (set => bench%set)
         d = merge(delta(bench%first:bench%last), 0.0_wp, set%contact%is_touching)
         speed = merge(set%contact%impact_speed, 1.0_wp, set%contact%is_touching)
         call set%laws%normal%force(size(f), d, rate(bench%first:bench%last), speed, set%laws%parameters, f, by_delta, by_rate, &
                                    elastic)
      end associate
   end subroutine elastic_forces

   !> Rate of the elastic energy of faces, by differences along the penetrations alone: those of a motion have the round-off
   !> of positions. Zero for a geometry without faces.
   real(wp) function face_energy_rate(bench) result(energy_rate)
      type(bench_t), intent(inout) :: bench   !! the set

      real(wp), parameter :: h = 4.0e-9_wp
      type(point_contact_t), allocatable :: contacts(:), later(:)
      real(wp) :: energy(4)
      integer :: c, item, k

      energy_rate = 0.0_wp
      if (.not. bench%has_faces) return
      call move_to(bench, 0.0_wp)
      energy = 0.0_wp
      select type (set => bench%set)
      class is (faced_contacts_t)
         allocate (contacts(set%n_contact_item))
         do item = 1, set%n
            do c = 1, set%n_contact_item
               call set%measure((item - 1)*set%n_contact_item + c, .false., bench%motion, contacts(c))
            end do
            do k = 1, 4
               later = contacts
               later%delta = contacts%delta + places(k)*h*contacts%rate
               energy(k) = energy(k) + set%face_energy(item, later)
            end do
         end do
      end select
      energy_rate = five_point(energy, h)
   end function face_energy_rate

   !> Rate of the elastic energy by differences.
   real(wp) function energy_rate(bench, h)
      type(bench_t), intent(inout) :: bench   !! the set
      real(wp), intent(in) :: h               !! step [s]

      real(wp) :: energy(4)
      integer :: k

      do k = 1, 4
         call move_to(bench, places(k)*h)
         energy(k) = bench%set%elastic_energy(bench%motion)
      end do
      energy_rate = five_point(energy, h)
   end function energy_rate

   subroutine test_elastic_energy(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, elastic_energy)
   end subroutine test_elastic_energy

   !> The set's elastic energy changes by elastic force times rate; only touching contacts store any.
   subroutine elastic_energy(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      real(wp), dimension(bench%set%n_contact) :: elastic, f
      real(wp) :: delta(n_all), rate(n_all), slope
      integer :: m

      ! a point at the end of a lever turns by some 1e4 rad/s: at `tick` its difference is off by 2e-8, at a third of it by 2e-10
      slope = energy_rate(bench, merge(tick, 0.3_wp*tick, bench%has_faces))
      if (bench%has_faces) then  ! what the rate has to do with the forces is the claim of `power`
         call check_close(error, slope, face_energy_rate(bench), 1.0e-6_wp, bench%name//": rate of the elastic energy", &
                          relative=.true.)
         return
      end if
      call elastic_forces(bench, f, elastic)
      call get_gaps(bench, 0.0_wp, delta, rate)
      associate (set => bench%set, first => bench%first, last => bench%last)
         call check_close(error, slope, sum(elastic*rate(first:last)), 1.0e-8_wp*sum(abs(elastic*rate(first:last))), &
                          bench%name//": rate of the elastic energy")
         m = bench%touching(2)
         set%contact%is_touching = .false.
         set%contact(m)%is_touching = .true.
         call check_close(error, set%elastic_energy(bench%motion), set%laws%normal%potential(delta(n_before + m), &
                          set%laws%parameters(:, m)), &
                          1.0e-12_wp, bench%name//": of one contact", relative=.true.)
      end associate
   end subroutine elastic_energy

   subroutine test_force_rate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, force_rate)
   end subroutine test_force_rate

   !> What the monitor sees: penetration, rate, force, and the rate of the force against differences along a motion. A contact that
   !> moves slowly by chance has its rate as right as one at the maximum speed of all, F v/delta: differences know no better.
   subroutine force_rate(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      real(wp) :: delta, delta_all(n_all), f, force(6), h, normal(1, n_all), rate, rate_all(n_all), slope, unused(3)
      integer :: item, k, m

      h = merge(0.4_wp*tick, tick, bench%has_faces)  ! a face is shared as the lesser of two depths says
      do m = 1, size(bench%touching)
         item = bench%touching(m)
         do k = 1, size(six_places)
            call move_to(bench, six_places(k)*h)
            call bench%set%monitor(item, bench%motion, unused(1), unused(2), force(k), unused(3))
         end do
         call get_gaps(bench, 0.0_wp, delta_all, rate_all)
         call bench%set%monitor(item, bench%motion, delta, rate, f, slope)
         call check_true(error, minval(force) > 100.0_wp, bench%name//": the force is not cut off")
         call check_close(error, slope, six_point(force, h), 1.0e-7_wp*max(abs(slope), f*maxval(abs(rate_all))/abs(delta)), &
                          bench%name//": rate of the force")
         call check_close(error, [delta, rate], [delta_all(n_before + item), rate_all(n_before + item)], 0.0_wp, &
                          bench%name//": penetration")
         normal = 0.0_wp
         call read_loose(bench%set, "normal_force", bench%motion, normal)
         call check_close(error, f, normal(1, n_before + item), 0.0_wp, bench%name//": force")
      end do
   end subroutine force_rate

end module test_clearances
