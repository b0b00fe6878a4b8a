!> Films of pins in bushings and of balls in sockets, every kind: action and reaction in force and moment, power and its ledger,
!> the same in a turned world, the same as aligned where the tilt goes to nothing, channels. Bodies lie and move anyhow.
module test_spatial_films
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_law, only: film_law_t, film_motion_t
   use film_registry, only: n_film_kinds, new_film_law
   use fixed_random, only: random_t, seed_of
   use kind_info, only: kind_info_t
   use kinds, only: not_a_number, wp
   use mechanism, only: mechanism_t
   use motion, only: cross, loads_t, new_loads
   use point_contacts, only: named_channels
   use read_channel, only: read_loose
   use rotations, only: rotation_of_parameters, turned_by
   use scene_fixture, only: nl, system_of_text
   implicit none (type, external)
   private
   public :: run_test_spatial_films

   real(wp), parameter :: gap = 0.1e-3_wp   !! clearance [m]
   integer, parameter :: n_option = 4       !! ways in which a film acts
   character(*), parameter :: options(n_option) = [character(21) :: "lubricated off 20 0 0", "lubricated on 24 0 0", &
                                                   "hybrid on 16 5 10", "lubricated on 20 0 0"]
      !! level, film_torque, length of the pin and both columns of the transition

   !> A film at a motion.
   type :: bench_t
      type(mechanism_t) :: system           !! two free bodies and a joint
      real(wp) :: q(7, 2) = 0.0_wp          !! (7, bodies) coordinates [m and 1]
      real(wp) :: v(6, 2) = 0.0_wp          !! (6, bodies) velocities [m/s and rad/s]
      type(loads_t) :: loads                !! of the film
      character(:), allocatable :: name     !! of the kind and the option
      logical :: has_shear = .false.        !! film_torque = on
      logical :: takes = .false.            !! a kind that never gives energy
   end type bench_t

   abstract interface
      !> What is claimed of one film.
      subroutine claim(error, bench)
         import :: bench_t, error_t
         implicit none (type, external)
         type(error_t), allocatable, intent(inout) :: error  !! what failed
         type(bench_t), intent(inout) :: bench               !! the film
      end subroutine claim
   end interface

contains

   subroutine run_test_spatial_films(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("balance_and_power", test_balance_and_power)
      call suite%test("turned", test_turned)
      call suite%test("aligned", test_aligned)
      call suite%test("channels", test_channels)
   end subroutine run_test_spatial_films

   !> Claim something of every kind in every way.
   subroutine claim_all(error, what)
      type(error_t), allocatable, intent(out) :: error  !! what failed
      procedure(claim) :: what                          !! the claim

      class(film_law_t), allocatable :: law
      type(bench_t), allocatable :: bench
      type(kind_info_t) :: info
      type(random_t) :: random
      integer :: kind, option, sample

      do kind = 1, n_film_kinds()
         call new_film_law(kind, law)
         info = law%info()
         do option = 1, n_option
            allocate (bench)
            bench%name = info%name//", "//trim(options(option))
            bench%has_shear = index(options(option), " on ") > 0
            bench%takes = index(" film.short_gumbel film.long_gumbel film.butenschoen ", " "//info%name//" ") == 0
            call system_of_text(deck_of(info%name, law%is_of_sphere(), options(option)), bench%system, error)
            if (allocated(error)) return
            random%state = seed_of(bench%name, option)
            do sample = 1, 3
               call lay(random, merge(1.0_wp, 0.0_wp, .not. law%is_of_sphere()), bench)
               call what(error, bench)
               if (allocated(error)) return
            end do
            deallocate (bench)
         end do
      end do
   end subroutine claim_all

   !> Two free bodies with a joint between them.
   function deck_of(film, is_sphere, option) result(text)
      character(*), intent(in) :: film     !! name of the kind
      logical, intent(in) :: is_sphere     !! a ball
      character(*), intent(in) :: option   !! how it acts
      character(:), allocatable :: text    !! a deck

      character(20) :: words(5)

      read (option, *) words
      text = "[scene]"//nl//"space = spatial"//nl//"gravity = 0 0 0 m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]"//nl// &
             "housing 0.7 2e-3 3e-3 4e-3"//nl//"shaft 0.3 5e-4 6e-4 7e-4"//nl// &
             "[points]"//nl//"name body xi[m] eta[m] zeta[m]"//nl//"hole housing 0.03 -0.02 0.01"//nl// &
             "pin shaft -0.01 0.015 0.02"//nl//"[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
             "[lubricant]"//nl//"name viscosity"//nl//"oil 0.4Pa.s"//nl//"[contact.hertz]"//nl//"name"//nl//"dry"//nl// &
             "["//film//"]"//nl//"name"//nl//"wet"//nl
      if (is_sphere) then
         text = text//"[clearance.spherical]"//nl//"name bearing journal bearing_radius[mm] clearance[mm] material law film "// &
                "lubricant level film_torque e_t0[um] e_t1[um]"//nl//"joint hole pin 10 0.1 steel dry wet oil "// &
                trim(words(1))//" "//trim(words(2))//" "//trim(words(4))//" "//trim(words(5))//nl
      else
         text = text//"[clearance.revolute]"//nl//"name bearing journal axis_i bearing_radius[mm] clearance[mm] material law "// &
                "film lubricant length[mm] level film_torque journal_length[mm] e_t0[um] e_t1[um]"//nl// &
                'joint hole pin "1 2 -2" 10 0.1 steel dry wet oil 20 '//trim(option)//nl
      end if
      text = text//"[analysis.dynamic]"//nl//"start = given"//nl//"end = 1 s"
   end function deck_of

   !> Lay the journal anyhow in its bearing, and the bearing anyhow; and find what the film does.
   subroutine lay(random, tilts, bench)
      type(random_t), intent(inout) :: random   !! where numbers come from
      real(wp), intent(in) :: tilts             !! size of tilts, of the one that is meant [1]
      type(bench_t), intent(inout) :: bench     !! the film

      real(wp) :: turn(4)
      integer :: k

      turn = random%vector(4, -1.0_wp, 1.0_wp)
      turn = turn/norm2(turn)
      bench%q(:3, 1) = random%vector(3, -0.1_wp, 0.1_wp)
      bench%q(4:, 1) = turn
      bench%q(4:, 2) = turned_by(turn, tilts*1.5e-3_wp*random%vector(3, -1.0_wp, 1.0_wp))
      bench%q(:3, 2) = bench%q(:3, 1) + matmul(rotation_of_parameters(bench%q(4:, 1)), [0.03_wp, -0.02_wp, 0.01_wp]) &
                       - matmul(rotation_of_parameters(bench%q(4:, 2)), [-0.01_wp, 0.015_wp, 0.02_wp]) &
                       + 0.5_wp*gap*random%vector(3, -1.0_wp, 1.0_wp)
      do k = 1, 2
         bench%v(:, k) = random%vector(6, -1.0_wp, 1.0_wp)*[0.1_wp, 0.1_wp, 0.1_wp, 30.0_wp, 30.0_wp, 30.0_wp]
      end do
      call find(bench)
   end subroutine lay

   !> What the film does at the motion.
   subroutine find(bench)
      type(bench_t), intent(inout) :: bench  !! the film

      call new_loads(2, bench%loads)
      associate (linkage => bench%system%linkage, set => bench%system%clearance_joints%sets(1)%set)
         call linkage%coordinates%move(2, [1, 2], bench%q, bench%v, linkage%motion)
         call set%laws%films%bear(set%items%body, set%items%s_i, set%items%s_j, linkage%motion, bench%loads)
      end associate
   end subroutine find

   subroutine test_balance_and_power(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, balance_and_power)
   end subroutine test_balance_and_power

   !> Forces add up to nothing, moments about one point too; what the bodies lose is what the film takes; with the shear it takes.
   subroutine balance_and_power(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the film

      real(wp) :: given, moment(3), scale, work
      integer :: k

      associate (f => bench%loads%force, m => bench%loads%moment, motion => bench%system%linkage%motion)
         scale = norm2(f(:, 2)) + 100.0_wp*norm2(m(:, 2))
         call check_true(error, scale > 0.0_wp, bench%name//" acts")
         call check_close(error, sum(f, dim=2)/scale, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, bench%name//": forces")
         moment = 0.0_wp
         given = 0.0_wp
         work = 0.0_wp
         do k = 1, 2
            moment = moment + m(:, k) + cross(motion%r(:, k), f(:, k))
            given = given + dot_product(f(:, k), motion%v(:, k)) + dot_product(m(:, k), motion%omega(:, k))
            work = work + norm2(f(:, k)) + norm2(m(:, k))*norm2(motion%omega(:, k))
         end do
         call check_close(error, moment/scale, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, bench%name//": moments")
         associate (films => bench%system%clearance_joints%sets(1)%set%laws%films)
            call check_close(error, given/work, -films%power/work, 1.0e-13_wp, bench%name//": power")
            if (bench%has_shear .and. bench%takes) call check_true(error, films%power > 0.0_wp, bench%name//": takes power")
         end associate
      end associate
   end subroutine balance_and_power

   subroutine test_turned(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, turned)
   end subroutine test_turned

   !> In a world that is turned, forces and moments are turned.
   subroutine turned(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the film

      real(wp), parameter :: by(3) = [0.7_wp, -1.1_wp, 0.4_wp]  ! axis times angle, frame of the first body [rad]
      real(wp) :: before(3, 2), first(3, 3), rotation(3, 3), scale
      integer :: k

      before(:, 1) = bench%loads%force(:, 2)
      before(:, 2) = bench%loads%moment(:, 2)
      scale = sum(abs(before))
      first = rotation_of_parameters(bench%q(4:, 1))
      rotation = matmul(rotation_of_parameters(turned_by(bench%q(4:, 1), by)), transpose(first))
      do k = 1, 2
         bench%q(:3, k) = matmul(rotation, bench%q(:3, k))
         bench%v(:3, k) = matmul(rotation, bench%v(:3, k))
         bench%q(4:, k) = turned_by(bench%q(4:, k), matmul(transpose(rotation_of_parameters(bench%q(4:, k))), matmul(first, by)))
      end do
      call find(bench)
      call check_close(error, bench%loads%force(:, 2)/scale, matmul(rotation, before(:, 1))/scale, 1.0e-7_wp, bench%name//": force")
      call check_close(error, bench%loads%moment(:, 2)/scale, matmul(rotation, before(:, 2))/scale, 1.0e-7_wp, &
                       bench%name//": moment")
   end subroutine turned

   subroutine test_aligned(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, aligned)
   end subroutine test_aligned

   !> A tilt of 1e-9 of the clearance, and one of none: the same force. So the whole grid is that of its half.
   subroutine aligned(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the film

      type(film_motion_t) :: film
      real(wp) :: f(2, 2), f_1(2, 2)

      associate (set => bench%system%clearance_joints%sets(1)%set)
         film = set%laws%films%motion_of(1, set%items%body(:, 1), set%items%s_i(:, 1), set%items%s_j(:, 1), &
                                         bench%system%linkage%motion)
         if (set%laws%films%law%is_of_sphere()) return
         film%tilt = 0.0_wp
         film%tilt_dot = 0.0_wp
         call set%laws%films%law%force_of_one(film, set%laws%films%parameters(:, 1), f(:, 1), f_1(:, 1))
         film%tilt = 1.0e-9_wp*gap*[0.6_wp, -0.8_wp]
         call set%laws%films%law%force_of_one(film, set%laws%films%parameters(:, 1), f(:, 2), f_1(:, 2))
         call check_close(error, f(:, 2)/norm2(f), f(:, 1)/norm2(f), 1.0e-7_wp, bench%name//": force")
         call check_close(error, f_1(:, 2)/norm2(f), f_1(:, 1)/norm2(f), 1.0e-7_wp, bench%name//": moment")
      end associate
   end subroutine aligned

   subroutine test_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, channels)
   end subroutine test_channels

   !> Every channel is filled; force and moment are those of the loads.
   subroutine channels(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the film

      type(kind_info_t) :: info
      real(wp), allocatable :: values(:, :)
      real(wp) :: at_point(3), scale
      logical :: is_of_contact
      integer :: c

      associate (set => bench%system%clearance_joints%sets(1)%set, motion => bench%system%linkage%motion, loads => bench%loads)
         info = set%info()
         scale = sum(abs(loads%force(:, 2))) + sum(abs(loads%moment(:, 2)))
         at_point = loads%moment(:, 2) - cross(matmul(motion%rot(:, :, 2), set%items%s_j(:, 1)), loads%force(:, 2))
         do c = 1, size(info%channels)
            associate (channel => info%channels(c))
               if (channel%name == "contact_point" .or. channel%name == "p_v") cycle  ! nothing touches
               if (channel%name == "film_pressure" .and. .not. set%laws%films%law%has_field()) cycle
               is_of_contact = index(" penetration penetration_rate normal_force friction_force state"//named_channels, &
                                     " "//channel%name//" ") > 0
               allocate (values(merge(3, 1, channel%components == 2), merge(set%n_contact, 1, is_of_contact)), &
                         source=not_a_number())
               call read_loose(set, channel%name, motion, values)
               call check_true(error, all(ieee_is_finite(values)), bench%name//": channel "//channel%name)
               select case (channel%name)
               case ("force", "film_force")
                  call check_close(error, values(:, 1)/scale, loads%force(:, 2)/scale, 1.0e-12_wp, bench%name//": force")
               case ("moment", "film_moment")
                  call check_close(error, values(:, 1)/scale, at_point/scale, 1.0e-12_wp, bench%name//": moment")
               case ("film_power")
                  if (bench%has_shear) call check_close(error, values(1, 1), set%laws%films%power, 1.0e-12_wp, &
                                                        bench%name//": power", relative=.true.)
               end select
               deallocate (values)
            end associate
         end do
      end associate
   end subroutine channels

end module test_spatial_films
