!> Identities of every normal law, by differences; restitution and printed values.
module test_contact_laws
   use bodies, only: material_t
   use check, only: check_close, check_equal, check_true, suite_t
   use contact_registry, only: n_law_kinds, new_normal_law
   use differences, only: five_point, places
   use errors, only: error_t
   use fixed_random, only: random_t
   use free_impact, only: impact_t, run_impact
   use generic_item, only: column_number, fill_item, set_number
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: i8, wp
   use normal_law, only: least_impact_speed, normal_law_t
   use stiffness, only: internal_stiffness
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_contact_laws

   real(wp), parameter :: steel_pin = 6.61019840e10_wp  !! stiffness of a 9.5 mm pin in a 10 mm hole, steel [N/m^1.5]
   integer, parameter :: n_row = 4                      !! rows of each law
   integer, parameter :: n_sample = 40                  !! states of a contact

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
      call suite%test("gentle_onset", test_gentle_onset)
      call suite%test("stiffness_from_steel", test_stiffness_from_steel)
   end subroutine run_test_contact_laws

   !> A row of a normal law with any numbers.
   subroutine make_law(kind, row, law, name)
      integer, intent(in) :: kind                              !! number of the law
      integer, intent(in) :: row                               !! number of the row
      class(normal_law_t), allocatable, intent(out) :: law     !! the law
      character(:), allocatable, intent(out) :: name           !! for messages

      type(item_t) :: item
      type(kind_info_t) :: info
      type(random_t) :: random

      random%state = int(100*kind + row, i8)
      call new_normal_law(kind, law)
      info = law%info()
      call fill_item(info, row, random, item)
      call law%prepare(item)
      name = info%name//" row "//to_text(row)
   end subroutine make_law

   !> A row of a normal law with a given restitution.
   subroutine make_restitution(kind, restitution, law, has_restitution)
      integer, intent(in) :: kind                            !! number of the law
      real(wp), intent(in) :: restitution                    !! coefficient of restitution [1]
      class(normal_law_t), allocatable, intent(out) :: law   !! the law
      logical, intent(out) :: has_restitution                !! whether the law has such a column

      type(item_t) :: item
      type(random_t) :: random

      call new_normal_law(kind, law)
      call fill_item(law%info(), 1, random, item)
      has_restitution = column_number(law%info(), "restitution") > 0
      call set_number(law%info(), "restitution", restitution, item)
      call law%prepare(item)
   end subroutine make_restitution

   !> Force of one contact of the steel pin.
   subroutine force_of(law, delta, rate, impact_speed, f, df_ddelta, df_drate, f_elastic)
      class(normal_law_t), intent(in) :: law            !! the law
      real(wp), intent(in) :: delta                     !! penetration [m]
      real(wp), intent(in) :: rate                      !! its rate [m/s]
      real(wp), intent(in) :: impact_speed              !! rate at the onset [m/s]
      real(wp), intent(out) :: f                        !! force [N]
      real(wp), intent(out), optional :: df_ddelta      !! derivative by penetration [N/m]
      real(wp), intent(out), optional :: df_drate       !! derivative by rate [N.s/m]
      real(wp), intent(out), optional :: f_elastic      !! elastic part [N]

      real(wp) :: value(1), by_delta(1), by_rate(1), elastic(1)

      call law%force(1, [delta], [rate], [impact_speed], [steel_pin], value, by_delta, by_rate, elastic)
      f = value(1)
      if (present(df_ddelta)) df_ddelta = by_delta(1)
      if (present(df_drate)) df_drate = by_rate(1)
      if (present(f_elastic)) f_elastic = elastic(1)
   end subroutine force_of

   !> dF/ddelta and dF/drate against differences, where the force is not cut off.
   subroutine test_derivatives(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      character(:), allocatable :: name
      type(random_t) :: random
      real(wp) :: by_delta, by_rate, delta, f, near(4, 2), rate, speed
      integer :: k, kind, row, sample

      do kind = 1, n_law_kinds
         do row = 1, n_row
            call make_law(kind, row, law, name)
            do sample = 1, n_sample
               delta = 10.0_wp**random%between(-8.0_wp, -4.0_wp)
               speed = 10.0_wp**random%between(-2.0_wp, 1.0_wp)
               rate = random%between(-1.0_wp, 1.0_wp)*speed
               call force_of(law, delta, rate, speed, f, by_delta, by_rate)
               if (f <= 0.0_wp) cycle
               do k = 1, 4
                  call force_of(law, delta*(1.0_wp + 1.0e-3_wp*places(k)), rate, speed, near(k, 1))
                  call force_of(law, delta, rate + 1.0e-3_wp*places(k)*speed, speed, near(k, 2))
               end do
               if (minval(near) <= 0.0_wp) cycle
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
      character(:), allocatable :: name
      type(random_t) :: random
      real(wp) :: by_delta, by_rate, elastic, f, rate
      integer :: kind, row, sample

      do kind = 1, n_law_kinds
         do row = 1, n_row
            call make_law(kind, row, law, name)
            do sample = 1, n_sample
               rate = -10.0_wp**random%between(-3.0_wp, 3.0_wp)
               call force_of(law, 10.0_wp**random%between(-8.0_wp, -4.0_wp), rate, 0.3_wp, f, by_delta, by_rate, elastic)
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
      character(:), allocatable :: name
      real(wp), parameter :: apart(4) = [0.0_wp, -1.0e-300_wp, -1.0e-9_wp, -1.0e-3_wp]
      real(wp), parameter :: rates(3) = [-1.0_wp, 0.0_wp, 1.0_wp]
      real(wp) :: by_delta, by_rate, elastic, f
      integer :: i, k, kind

      do kind = 1, n_law_kinds
         call make_law(kind, 1, law, name)
         do k = 1, size(apart)
            do i = 1, size(rates)
               call force_of(law, apart(k), rates(i), 0.3_wp, f, by_delta, by_rate, elastic)
               call check_close(error, [f, by_delta, by_rate, elastic], [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, &
                                name//": apart")
            end do
            call check_close(error, law%potential(apart(k), steel_pin), 0.0_wp, 0.0_wp, name//": energy apart")
         end do
      end do
   end subroutine test_no_force_apart

   !> The derivative of the stored energy is the elastic part of the force, whatever the rate.
   subroutine test_potential(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      character(:), allocatable :: name
      type(random_t) :: random
      real(wp) :: delta, elastic, energy(4), f
      integer :: k, kind, row, sample

      do kind = 1, n_law_kinds
         do row = 1, n_row
            call make_law(kind, row, law, name)
            do sample = 1, n_sample
               delta = 10.0_wp**random%between(-8.0_wp, -4.0_wp)
               call force_of(law, delta, random%between(-1.0_wp, 1.0_wp), 0.3_wp, f, f_elastic=elastic)
               do k = 1, 4
                  energy(k) = law%potential(delta*(1.0_wp + 1.0e-3_wp*places(k)), steel_pin)
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
      character(:), allocatable :: name
      type(random_t) :: random
      real(wp), dimension(n) :: by_delta, by_rate, delta, elastic, f, rate, speed, stiff
      real(wp), dimension(1) :: by_delta_1, by_rate_1, elastic_1, f_1
      integer :: k, kind

      do kind = 1, n_law_kinds
         call make_law(kind, 1, law, name)
         delta = random%vector(n, -1.0e-5_wp, 3.0e-5_wp)
         rate = random%vector(n, -2.0_wp, 2.0_wp)
         speed = random%vector(n, 0.1_wp, 1.0_wp)
         stiff = random%vector(n, 0.5_wp, 2.0_wp)*steel_pin
         call law%force(n, delta, rate, speed, stiff, f, by_delta, by_rate, elastic)
         do k = 1, n
            call law%force(1, delta(k:k), rate(k:k), speed(k:k), stiff(k:k), f_1, by_delta_1, by_rate_1, elastic_1)
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
      type(impact_t) :: impact
      type(kind_info_t) :: info
      character(:), allocatable :: name
      real(wp) :: e, h
      integer :: i, k, kind
      logical :: has_restitution

      do kind = 1, n_law_kinds
         do k = 1, size(ce)
            call make_restitution(kind, ce(k), law, has_restitution)
            info = law%info()
            name = info%name//", restitution "//to_text(ce(k))
            h = damping_factor(law)
            if (h < 0.0_wp) cycle
            do i = 1, size(speeds)
               call run_impact(law, steel_pin, 0.1_wp, speeds(i), impact)
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
   function damping_factor(law) result(h)
      class(normal_law_t), intent(in) :: law  !! the law
      real(wp) :: h                           !! the factor [1]

      real(wp) :: elastic, f, other
      integer :: k

      call force_of(law, 1.0e-6_wp, 0.3_wp, 0.3_wp, f, f_elastic=elastic)
      h = f/elastic - 1.0_wp
      do k = -2, 4
         call force_of(law, 1.0e-6_wp*2.0_wp**k, 0.1_wp*real(k, wp), 0.3_wp, f, f_elastic=elastic)
         other = elastic*max(0.0_wp, 1.0_wp + h*0.1_wp*real(k, wp)/0.3_wp)
         if (abs(f - other) > 1.0e-12_wp*elastic) h = -1.0_wp
         if (h < 0.0_wp) return
      end do
   end function damping_factor

   !> Lankarani and Nikravesh's law with restitution 0.9 and onset at 0.3 m/s, computed independently.
   subroutine test_printed_values(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      type(kind_info_t) :: info
      real(wp) :: f
      integer :: kind, n_found
      logical :: has_restitution

      n_found = 0
      do kind = 1, n_law_kinds
         call make_restitution(kind, 0.9_wp, law, has_restitution)
         info = law%info()
         select case (info%name)
         case ("contact.hertz")
            call force_of(law, 1.0e-5_wp, 0.1_wp, 0.3_wp, f)
            call check_close(error, f, 2090.32827230_wp, 1.0e-9_wp, "Hertz", relative=.true.)
         case ("contact.lankarani_nikravesh")
            call force_of(law, 1.0e-5_wp, 0.1_wp, 0.3_wp, f)
            call check_close(error, f, 2189.61886523_wp, 2.0e-9_wp, "approaching", relative=.true.)
            call force_of(law, 1.0e-5_wp, -0.1_wp, 0.3_wp, f)
            call check_close(error, f, 1991.03767936_wp, 2.0e-9_wp, "parting", relative=.true.)
         case default
            cycle
         end select
         n_found = n_found + 1
      end do
      call check_equal(error, n_found, 2, "laws with known values")
   end subroutine test_printed_values

   !> A contact that opened with almost no speed is damped as one that opened with 1 mm/s.
   subroutine test_gentle_onset(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(normal_law_t), allocatable :: law
      character(:), allocatable :: name
      real(wp) :: f, floored
      integer :: kind

      do kind = 1, n_law_kinds
         call make_law(kind, 2, law, name)
         call force_of(law, 1.0e-6_wp, 1.0e-3_wp, least_impact_speed, floored)
         call force_of(law, 1.0e-6_wp, 1.0e-3_wp, 1.0e-9_wp, f)
         call check_close(error, f, floored, 0.0_wp, name//": slow onset")
         call force_of(law, 1.0e-6_wp, 1.0e-3_wp, 0.0_wp, f)
         call check_close(error, f, floored, 0.0_wp, name//": onset without speed")
      end do
   end subroutine test_gentle_onset

   !> A 9.5 mm pin in a 10 mm hole, and the pin of another material.
   subroutine test_stiffness_from_steel(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(material_t) :: bronze, steel
      real(wp) :: k

      steel%young = 207.0e9_wp
      steel%poisson = 0.3_wp
      k = internal_stiffness(10.0e-3_wp, 0.5e-3_wp, steel, steel)
      call check_close(error, k, steel_pin, 1.0e-8_wp, "steel in steel", relative=.true.)
      ! as stiff as can be (nu^2 = 1): half the compliance is gone, the stiffness doubles
      bronze%young = 1.0e11_wp
      bronze%poisson = -1.0_wp
      call check_close(error, internal_stiffness(10.0e-3_wp, 0.5e-3_wp, steel, bronze), 2.0_wp*k, 1.0e-14_wp, &
                       "one of them rigid", relative=.true.)
      call check_close(error, internal_stiffness(10.0e-3_wp, 0.5e-3_wp, bronze, steel), 2.0_wp*k, 1.0e-14_wp, &
                       "the other rigid", relative=.true.)
   end subroutine test_stiffness_from_steel

end module test_contact_laws
