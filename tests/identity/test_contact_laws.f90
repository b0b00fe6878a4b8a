!> Identities of every normal law, by differences; restitution and printed values.
module test_contact_laws
   use bodies, only: material_t
   use check, only: check_close, check_equal, check_true, suite_t
   use contact_registry, only: n_law_kinds
   use differences, only: five_point, places
   use errors, only: error_t
   use fixed_random, only: random_t
   use free_impact, only: impact_t, run_impact
   use kind_info, only: kind_info_t
   use elastic_waves, only: bar_speed, share_of_waves
   use kinds, only: wp
   use law_fixture, only: make_law, make_restitution, steel, steel_mass, steel_pair, steel_pin
   use normal_law, only: n_law_parameter, normal_law_t
   use stiffness, only: curved_stiffness, face_stiffness
   use surfaces, only: set_materials, shape_external, shape_face, shape_internal, shape_plane, surfaces_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_contact_laws

   integer, parameter :: n_row = 4      !! rows of each law
   integer, parameter :: n_sample = 40  !! states of a contact

contains

   subroutine run_test_contact_laws(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("derivatives", test_derivatives)
      call suite%test("never_pulls", test_never_pulls)
      call suite%test("no_force_apart", test_no_force_apart)
      call suite%test("potential", test_potential)
      call suite%test("many_at_once", test_many_at_once)
      call suite%test("restitution", test_restitution)
      call suite%test("printed_values", test_printed_values)
      call suite%test("stiffness_from_steel", test_stiffness_from_steel)
      call suite%test("stiffness_of_faces", test_stiffness_of_faces)
      call suite%test("contact_time", test_contact_time)
   end subroutine run_test_contact_laws

   !> Force of one contact.
   subroutine force_of(law, parameters, delta, rate, impact_speed, f, df_ddelta, df_drate, f_elastic)
      class(normal_law_t), intent(in) :: law            !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the contact [any]
      real(wp), intent(in) :: delta                     !! penetration [m]
      real(wp), intent(in) :: rate                      !! its rate [m/s]
      real(wp), intent(in) :: impact_speed              !! rate at the onset [m/s]
      real(wp), intent(out) :: f                        !! force [N]
      real(wp), intent(out), optional :: df_ddelta      !! derivative by penetration [N/m]
      real(wp), intent(out), optional :: df_drate       !! derivative by rate [N.s/m]
      real(wp), intent(out), optional :: f_elastic      !! elastic part [N]

      real(wp) :: value(1), by_delta(1), by_rate(1), elastic(1)

      call law%force(1, [delta], [rate], [impact_speed], parameters, value, by_delta, by_rate, elastic)
      f = value(1)
      if (present(df_ddelta)) df_ddelta = by_delta(1)
      if (present(df_drate)) df_drate = by_rate(1)
      if (present(f_elastic)) f_elastic = elastic(1)
   end subroutine force_of

   !> dF/ddelta and dF/drate against differences, where the force is not cut off.
   subroutine test_derivatives(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      real(wp) :: parameters(n_law_parameter)
      character(:), allocatable :: name
      type(random_t) :: random
      real(wp) :: by_delta, by_rate, delta, f, near(4, 2), rate, speed
      integer :: k, kind, row, sample

      do kind = 1, n_law_kinds()
         do row = 1, n_row
            call make_law(kind, row, law, parameters, name)
            do sample = 1, n_sample
               delta = 10.0_wp**random%between(-8.0_wp, -4.0_wp)
               speed = 10.0_wp**random%between(-2.0_wp, 1.0_wp)
               rate = random%between(-1.0_wp, 1.0_wp)*speed
               call force_of(law, parameters, delta, rate, speed, f, by_delta, by_rate)
               if (f <= 0.0_wp) cycle
               do k = 1, 4
                  call force_of(law, parameters, delta*(1.0_wp + 1.0e-3_wp*places(k)), rate, speed, near(k, 1))
                  call force_of(law, parameters, delta, rate + 1.0e-3_wp*places(k)*speed, speed, near(k, 2))
               end do
               if (minval(near) <= 0.0_wp) cycle
               if (law%jumps_at_turn .and. abs(rate) < 3.0e-3_wp*speed) cycle
               call check_close(error, by_delta, five_point(near(:, 1), 1.0e-3_wp*delta), 1.0e-9_wp*f/delta, name//": dF/ddelta")
               call check_close(error, by_rate, five_point(near(:, 2), 1.0e-3_wp*speed), 1.0e-9_wp*f/speed, name//": dF/drate")
            end do
         end do
      end do
   end subroutine test_derivatives

   !> The force is never negative, however fast the surfaces part; where it is cut off it does not change.
   subroutine test_never_pulls(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      real(wp) :: parameters(n_law_parameter)
      character(:), allocatable :: name
      type(random_t) :: random
      real(wp) :: by_delta, by_rate, elastic, f, rate
      integer :: kind, row, sample

      do kind = 1, n_law_kinds()
         do row = 1, n_row
            call make_law(kind, row, law, parameters, name)
            do sample = 1, n_sample
               rate = -10.0_wp**random%between(-3.0_wp, 3.0_wp)
               call force_of(law, parameters, 10.0_wp**random%between(-8.0_wp, -4.0_wp), rate, 0.3_wp, f, by_delta, by_rate, &
                             elastic)
               call check_true(error, f >= 0.0_wp, name//": the force does not pull")
               call check_true(error, elastic > 0.0_wp, name//": there is an elastic part")
               call check_true(error, (f - elastic)*rate >= 0.0_wp, name//": damping takes energy")
               if (f > 0.0_wp) cycle
               call check_close(error, [by_delta, by_rate], [0.0_wp, 0.0_wp], 0.0_wp, name//": cut off")
            end do
         end do
      end do
   end subroutine test_never_pulls

   !> No penetration, no force, no energy; also for the last digits of a surface that just touches.
   subroutine test_no_force_apart(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      real(wp) :: parameters(n_law_parameter)
      character(:), allocatable :: name
      real(wp), parameter :: apart(4) = [0.0_wp, -1.0e-300_wp, -1.0e-9_wp, -1.0e-3_wp]
      real(wp), parameter :: rates(3) = [-1.0_wp, 0.0_wp, 1.0_wp]
      real(wp) :: by_delta, by_rate, elastic, f
      integer :: i, k, kind

      do kind = 1, n_law_kinds()
         call make_law(kind, 1, law, parameters, name)
         do k = 1, size(apart)
            do i = 1, size(rates)
               call force_of(law, parameters, apart(k), rates(i), 0.3_wp, f, by_delta, by_rate, elastic)
               call check_close(error, [f, by_delta, by_rate, elastic], [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, &
                                name//": apart")
            end do
            call check_close(error, law%potential(apart(k), parameters), 0.0_wp, 0.0_wp, name//": energy apart")
         end do
      end do
   end subroutine test_no_force_apart

   !> The derivative of the stored energy is the elastic part of the force, whatever the rate.
   subroutine test_potential(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      real(wp) :: parameters(n_law_parameter)
      character(:), allocatable :: name
      type(random_t) :: random
      real(wp) :: delta, elastic, energy(4), f
      integer :: k, kind, row, sample

      do kind = 1, n_law_kinds()
         do row = 1, n_row
            call make_law(kind, row, law, parameters, name)
            do sample = 1, n_sample
               delta = 10.0_wp**random%between(-8.0_wp, -4.0_wp)
               call force_of(law, parameters, delta, random%between(-1.0_wp, 1.0_wp), 0.3_wp, f, f_elastic=elastic)
               do k = 1, 4
                  energy(k) = law%potential(delta*(1.0_wp + 1.0e-3_wp*places(k)), parameters)
               end do
               call check_close(error, elastic, five_point(energy, 1.0e-3_wp*delta), 1.0e-9_wp, name//": elastic force", &
                                relative=.true.)
            end do
         end do
      end do
   end subroutine test_potential

   !> Many contacts in one call are the same as one after the other.
   subroutine test_many_at_once(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 5
      class(normal_law_t), allocatable :: law
      real(wp) :: parameters(n_law_parameter)
      character(:), allocatable :: name
      type(random_t) :: random
      real(wp), dimension(n) :: by_delta, by_rate, delta, elastic, f, rate, speed
      real(wp) :: many(n_law_parameter, n)
      real(wp), dimension(1) :: by_delta_1, by_rate_1, elastic_1, f_1
      integer :: k, kind

      do kind = 1, n_law_kinds()
         call make_law(kind, 1, law, parameters, name)
         delta = random%vector(n, -1.0e-5_wp, 3.0e-5_wp)
         rate = random%vector(n, -2.0_wp, 2.0_wp)
         speed = random%vector(n, 0.1_wp, 1.0_wp)
         many = spread(parameters, 2, n)
         many(1, :) = random%vector(n, 0.5_wp, 2.0_wp)*many(1, :)
         call law%force(n, delta, rate, speed, many, f, by_delta, by_rate, elastic)
         do k = 1, n
            call law%force(1, delta(k:k), rate(k:k), speed(k:k), many(:, k:k), f_1, by_delta_1, by_rate_1, elastic_1)
            call check_close(error, [f(k), by_delta(k), by_rate(k), elastic(k)], &
                             [f_1(1), by_delta_1(1), by_rate_1(1), elastic_1(1)], 1.0e-14_wp, name//": contact "//to_text(k), &
                             relative=.true.)
         end do
      end do
   end subroutine test_many_at_once

   !> Two free bodies part with e from h(1+e) = ln[(1+h)/(1-h e)] if F = F_elastic (1 + h rate/v0), whatever
   !> stiffness, mass and speed; elastic contact returns e = 1; the energy lost is what damping took.
   subroutine test_restitution(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: ce(4) = [0.9_wp, 0.8_wp, 0.7_wp, 0.5_wp], speeds(2) = [0.3_wp, 4.0_wp]
      ! of Lankarani and Nikravesh's law, from the closed form [1]
      real(wp), parameter :: known(4) = [0.913_wp, 0.847_wp, 0.796_wp, 0.725_wp]
      class(normal_law_t), allocatable :: law
      real(wp) :: parameters(n_law_parameter)
      type(impact_t) :: impact
      type(kind_info_t) :: info
      character(:), allocatable :: name
      real(wp) :: e, h
      integer :: i, k, kind
      logical :: has_restitution

      do kind = 1, n_law_kinds()
         do k = 1, size(ce)
            call make_restitution(kind, ce(k), law, parameters, has_restitution)
            info = law%info()
            name = info%name//", restitution "//to_text(ce(k))
            h = damping_factor(law, parameters)
            if (h < 0.0_wp) cycle
            do i = 1, size(speeds)
               call run_impact(law, parameters, steel_mass, speeds(i), impact)
               e = -impact%end_rate/speeds(i)
               call check_close(error, h*(1.0_wp + e), log((1.0_wp + h)/(1.0_wp - h*e)), 1.0e-8_wp, name//": restitution")
               call check_close(error, impact%lost, 0.05_wp*speeds(i)**2*(1.0_wp - e**2), 1.0e-8_wp*speeds(i)**2, &
                                name//": energy lost")
               if (h <= 0.0_wp) call check_close(error, e, 1.0_wp, 1.0e-9_wp, name//": elastic")
               if (info%name == "contact.lankarani_nikravesh") then
                  call check_close(error, e, known(k), 5.0e-4_wp, name//": against the table")
               end if
            end do
            if (.not. has_restitution) exit
         end do
      end do
   end subroutine test_restitution

   !> Factor h of F = F_elastic (1 + h rate/v0); negative if the law is of another form.
   function damping_factor(law, parameters) result(h)
      class(normal_law_t), intent(in) :: law               !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the contact [any]
      real(wp) :: h                                        !! the factor [1]

      real(wp) :: elastic, f, other
      integer :: k

      call force_of(law, parameters, 1.0e-6_wp, 0.3_wp, 0.3_wp, f, f_elastic=elastic)
      h = f/elastic - 1.0_wp
      do k = -2, 4
         call force_of(law, parameters, 1.0e-6_wp*2.0_wp**k, 0.1_wp*real(k, wp), 0.3_wp, f, f_elastic=elastic)
         other = elastic*max(0.0_wp, 1.0_wp + h*0.1_wp*real(k, wp)/0.3_wp)
         if (abs(f - other) > 1.0e-12_wp*elastic) h = -1.0_wp
         if (h < 0.0_wp) return
      end do
   end function damping_factor

   !> Lankarani and Nikravesh's law with restitution 0.9 and onset at 0.3 m/s, computed independently.
   subroutine test_printed_values(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      real(wp) :: parameters(n_law_parameter)
      type(kind_info_t) :: info
      real(wp) :: f
      integer :: kind, n_found
      logical :: has_restitution

      n_found = 0
      do kind = 1, n_law_kinds()
         call make_restitution(kind, 0.9_wp, law, parameters, has_restitution)
         info = law%info()
         select case (info%name)
         case ("contact.hertz")
            call force_of(law, parameters, 1.0e-5_wp, 0.1_wp, 0.3_wp, f)
            call check_close(error, f, 2090.32827230_wp, 1.0e-9_wp, "Hertz", relative=.true.)
         case ("contact.lankarani_nikravesh")
            call force_of(law, parameters, 1.0e-5_wp, 0.1_wp, 0.3_wp, f)
            call check_close(error, f, 2189.61886523_wp, 2.0e-9_wp, "approaching", relative=.true.)
            call force_of(law, parameters, 1.0e-5_wp, -0.1_wp, 0.3_wp, f)
            call check_close(error, f, 1991.03767936_wp, 2.0e-9_wp, "parting", relative=.true.)
         case default
            cycle
         end select
         n_found = n_found + 1
      end do
      call check_equal(error, n_found, 2, "laws with known values")
   end subroutine test_printed_values

   !> Curved surfaces of 10 and 9.5 mm, of steel and with another material.
   subroutine test_stiffness_from_steel(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(material_t) :: rigid
      type(surfaces_t) :: pair
      real(wp) :: k

      k = curved_stiffness(steel_pair(shape_internal))
      call check_close(error, k, steel_pin, 1.0e-8_wp, "a pin in a hole", relative=.true.)
      call check_close(error, curved_stiffness(steel_pair(shape_plane)), 1.47808530e10_wp, 1.0e-8_wp, "a ball on a plane", &
                       relative=.true.)
      call check_close(error, curved_stiffness(steel_pair(shape_external)), k*sqrt(0.5_wp/19.5_wp), 1.0e-14_wp, "two balls", &
                       relative=.true.)
      call check_close(error, curved_stiffness(steel_pair(shape_face)), 0.0_wp, 0.0_wp, "a face is not curved")
      pair = steel_pair(shape_internal)
      call check_close(error, pair%sigma_i, 4.3961352657e-12_wp, 1.0e-10_wp, "compliance", relative=.true.)
      ! steel has waves of 5135 m/s; Hunter: 1.04 (v/c)^(3/5) of the energy
      call check_close(error, pair%speed_limit, 5135.0_wp*exp(log(0.1_wp/1.04_wp)*5.0_wp/3.0_wp), 1.0e-4_wp, "speed limit", &
                       relative=.true.)
      call check_close(error, bar_speed(pair%speed_limit), 5135.0_wp, 1.0e-4_wp, "speed of waves", relative=.true.)
      call check_close(error, share_of_waves(1.0_wp, 5135.0_wp), 0.006179_wp, 1.0e-3_wp, "share at 1 m/s", relative=.true.)
      call check_close(error, share_of_waves(1.0e9_wp, 5135.0_wp), 1.0_wp, 0.0_wp, "no more than all")
      ! as stiff as can be (nu^2 = 1): half the compliance is gone, the stiffness doubles
      rigid%young = 1.0e11_wp
      rigid%poisson = -1.0_wp
      call set_materials(pair, steel(), rigid)
      call check_close(error, curved_stiffness(pair), 2.0_wp*k, 1.0e-14_wp, "one of them rigid", relative=.true.)
      call set_materials(pair, rigid, steel())
      call check_close(error, curved_stiffness(pair), 2.0_wp*k, 1.0e-14_wp, "the other rigid", relative=.true.)
   end subroutine test_stiffness_from_steel

   !> Plane faces: the mean displacement of uniformly loaded rectangles against tabled values, whichever side is the longer.
   subroutine test_stiffness_of_faces(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: aspect(5) = [1.0_wp, 2.0_wp, 3.0_wp, 5.0_wp, 10.0_wp]
      real(wp), parameter :: m(5) = [0.9464_wp, 0.9195_wp, 0.8815_wp, 0.8164_wp, 0.7104_wp]
      type(surfaces_t) :: pair
      real(wp) :: expected
      integer :: k

      pair = steel_pair(shape_face)
      do k = 1, size(aspect)
         expected = 0.01_wp*sqrt(aspect(k))/(m(k)*(pair%sigma_i + pair%sigma_j))
         pair%length = 0.01_wp*aspect(k)
         pair%width = 0.01_wp
         call check_close(error, face_stiffness(pair), expected, 6.0e-5_wp, "a long face", relative=.true.)
         pair%width = pair%length
         pair%length = 0.01_wp
         call check_close(error, face_stiffness(pair), expected, 6.0e-5_wp, "a wide face", relative=.true.)
      end do
      pair%width = 0.0_wp
      call check_close(error, face_stiffness(pair), 0.0_wp, 0.0_wp, "a face without width")
   end subroutine test_stiffness_of_faces

   !> Time of an impact against the closed forms of K delta^1.5, at any speed; none without a speed or a mass.
   subroutine test_contact_time(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      character(:), allocatable :: name
      type(impact_t) :: impact
      type(kind_info_t) :: info
      real(wp), parameter :: speeds(4) = [1.0e-9_wp, 1.0e-6_wp, 1.0_wp, 100.0_wp]
      real(wp) :: parameters(n_law_parameter), time
      integer :: k, kind

      do kind = 1, n_law_kinds()
         call make_law(kind, 1, law, parameters, name)
         do k = 1, size(speeds)
            call check_close(error, law%contact_time(parameters, speeds(k), 0.0_wp), 0.0_wp, 0.0_wp, name//": without mass")
            time = law%contact_time(parameters, speeds(k), 1.0_wp/steel_mass)
            call check_true(error, time > 0.0_wp .and. time <= 1.0_wp, name//": duration")
         end do
         call check_close(error, law%contact_time(parameters, 0.0_wp, 1.0_wp), 0.0_wp, 0.0_wp, name//": without speed")
         info = law%info()
         if (info%name /= "contact.hertz") cycle
         time = law%contact_time(parameters, 1.0e-6_wp, 1.0e6_wp/steel_mass)
         call check_close(error, time, 3.21804_wp*(1.0e-12_wp*steel_mass**2/(steel_pin**2*1.0e-6_wp))**0.2_wp, 1.0e-5_wp*time, &
                          "Hertz, small and slow")
         time = law%contact_time(parameters, 2.0_wp, 1.0_wp/steel_mass)
         call check_close(error, time, 3.21804_wp*(steel_mass**2/(steel_pin**2*2.0_wp))**0.2_wp, 1.0e-5_wp, "Hertz", &
                          relative=.true.)
         call run_impact(law, parameters, steel_mass, 2.0_wp, impact)
         call check_close(error, time, impact%duration, 1.0e-7_wp, "Hertz, integrated", relative=.true.)
      end do
   end subroutine test_contact_time

end module test_contact_laws
