!> Systems with known and bodies with one degree of freedom, against the same deck with all bodies among the unknowns.
!>
!> At any state of the other bodies, and with the known ones where their drivers need them, both systems of equations must
!> give the same accelerations, reactions, driving moments and powers: nothing but which rows are solved for differs.
module reduction_comparison
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use catalogue, only: catalogue_t
   use check, only: check_close, check_equal, check_true
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use mechanism_energy, only: energy_of, energy_t
   use mechanism_catalogue, only: build_catalogue
   use mechanism_report, only: report_state
   use recorder, only: summary_t
   use scene_fixture, only: nl, start_text, system_of_text
   use text, only: replace, to_text
   implicit none (type, external)
   private
   public :: both_systems, compare_at, compare_often, compare_works, complete_state, with_word

   character(*), parameter :: words(2) = ["full  ", "fewest"]  !! words of `coordinates`

contains

   !> A deck with its driven bodies among the unknowns, or not.
   function with_word(deck, word) result(text)
      character(*), intent(in) :: deck     !! the deck without that key, [analysis.dynamic] at its end
      character(*), intent(in) :: word     !! full or fewest
      character(:), allocatable :: text    !! with it

      text = replace(deck, "coordinates = full"//nl, "")//nl//"coordinates = "//trim(word)
   end function with_word

   !> Both systems of a deck.
   subroutine both_systems(deck, n_known, full, small, start, error)
      character(*), intent(in) :: deck                        !! the deck
      integer, intent(in) :: n_known                          !! bodies that must be known
      type(mechanism_t), intent(out) :: full              !! with all bodies unknown
      type(mechanism_t), intent(out) :: small             !! without the known ones
      real(wp), allocatable, intent(out) :: start(:)          !! (small's n) state at t = 0 of the latter [any]
      type(error_t), allocatable, intent(inout) :: error      !! first failure

      call system_of_text(with_word(deck, words(1)), full, error)
      if (allocated(error)) return
      call start_text(with_word(deck, words(2)), small, start, error)
      if (allocated(error)) return
      call check_equal(error, full%linkage%reduced%known%n, 0, "known bodies, unknown")
      call check_equal(error, small%linkage%reduced%known%n, n_known, "known bodies")
   end subroutine both_systems

   !> State of all bodies from that of the unknown ones and the time.
   subroutine complete_state(small, t, y, full)
      type(mechanism_t), intent(inout) :: small   !! the system without the prescribed bodies
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (small's n) its state [any]
      real(wp), intent(out) :: full(:)                !! (full's n) state of all bodies, works as those of y [any]

      integer :: k, n

      n = small%linkage%bodies%n
      call small%linkage%set_motion(t, y)
      do k = 1, n
         associate (coordinates => small%linkage%coordinates, n_q => small%linkage%coordinates%n_q, &
                    n_v => small%linkage%coordinates%n_v)
            call coordinates%read_motion(small%linkage%motion, k, full(n_q*(k - 1) + 1:n_q*k), &
                                         full(n_q*n + n_v*(k - 1) + 1:n_q*n + n_v*k))
         end associate
      end do
      associate (coordinates => small%linkage%coordinates, linkage => small%linkage)
         full((coordinates%n_q + coordinates%n_v)*n + 1:) = y(linkage%n_position + linkage%n_rate + 1:)
      end associate
   end subroutine complete_state

   !> All that both systems report at a time, the unknown bodies somewhat out of place, as if nothing held them exactly. A system
   !> that is evaluated the direct way is compared in the general one too, and one way with the other.
   subroutine compare_at(full, small, t, y, error)
      type(mechanism_t), intent(inout) :: full        !! with all bodies unknown
      type(mechanism_t), intent(inout) :: small       !! without the known ones
      real(wp), intent(in) :: t                           !! time [s]
      real(wp), intent(in) :: y(:)                        !! (small's n) a state [any]
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      real(wp) :: direct(small%n), general(small%n)
      integer :: status
      logical :: is_direct

      if (allocated(error)) return
      is_direct = small%is_direct
      call compare_form(full, small, t, y, error)
      if (.not. is_direct .or. allocated(error)) return
      call small%evaluate(t, y, direct, status)
      small%is_direct = .false.
      call small%evaluate(t, y, general, status)
      call compare_form(full, small, t, y, error)
      call compare_reports(small, t, y, error)
      small%is_direct = .true.
      call check_close(error, direct, general, 1.0e-13_wp*maxval(abs(general)), "the direct way at t = "//to_text(t))
   end subroutine compare_at

   !> What a system reports the direct way, by balances, against what it reports the general one, from rows and multipliers.
   subroutine compare_reports(system, t, y, error)
      type(mechanism_t), intent(inout) :: system          !! a system that is evaluated the direct way; the general one is set
      real(wp), intent(in) :: t                           !! time [s]
      real(wp), intent(in) :: y(:)                        !! (n) a state [any]
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      type(catalogue_t) :: of(2)
      real(wp) :: rate(system%n)
      integer :: first, form, k, last, status

      do form = 1, 2
         system%is_direct = form == 1
         call build_catalogue(system, of(form))
         call report_state(system, t, y, rate, 0.0_wp, of(form), status)
         call check_equal(error, status, 0, "status of a form")
         call check_true(error, of(form)%readings%balance%is_set .eqv. form == 1, "balances are found the direct way")
      end do
      do k = 1, size(of(1)%groups)
         associate (group => of(1)%groups(k))
            first = of(1)%place(k, 1, 1)
            last = first + group%channel%components*size(group%has) - 1
            associate (a => of(1)%values(first:last), b => of(2)%values(first:last))
               call check_true(error, all(ieee_is_nan(a) .eqv. ieee_is_nan(b)), "the same items have "//group%channel%name)
               call check_close(error, pack(a, .not. ieee_is_nan(a)), pack(b, .not. ieee_is_nan(b)), &
                                3.0e-13_wp*max(1.0_wp, maxval(abs(b), .not. ieee_is_nan(b))), &
                                group%channel%name//" the direct way at t = "//to_text(t))
            end associate
         end associate
      end do
   end subroutine compare_reports

   !> The same in the form that the system without them has now.
   subroutine compare_form(full, small, t, y, error)
      type(mechanism_t), intent(inout) :: full                !! with all bodies unknown
      type(mechanism_t), intent(inout) :: small               !! without the known ones
      real(wp), intent(in) :: t                               !! time [s]
      real(wp), intent(in) :: y(:)                            !! (small's n) state [any]
      type(error_t), allocatable, intent(inout) :: error      !! first failure

      type(catalogue_t) :: of_full, of_small
      real(wp) :: rate_full(full%n), rate_small(small%n), y_full(full%n)
      integer :: k, other, status

      call complete_state(small, t, y, y_full)
      call build_catalogue(full, of_full)
      call build_catalogue(small, of_small)
      rate_full = 0.0_wp
      rate_small = 0.0_wp
      call report_state(small, t, y, rate_small, 0.0_wp, of_small, status)
      call check_equal(error, status, 0, "status without the known bodies")
      call report_state(full, t, y_full, rate_full, 0.0_wp, of_full, status)
      call check_equal(error, status, 0, "status")
      call check_equal(error, size(of_small%groups), size(of_full%groups), "groups")
      if (allocated(error)) return
      do k = 1, size(of_full%groups)
         associate (room => of_full%groups(k)%item_group, name => of_full%groups(k)%channel%name)
            other = of_small%find_group(room, name)
            call check_true(error, other > 0, name//" is reported by both")
            if (allocated(error)) return
            call compare(values_of(of_small, other), values_of(of_full, k), of_full%item_groups(room)%name//" "//name)
         end associate
      end do
      associate (of_small => rate_small(small%linkage%n_position + small%linkage%n_rate + 1:), &
                 of_full => rate_full(full%linkage%n_position + full%linkage%n_rate + 1:))
         call check_close(error, of_small, of_full, 1.0e-10_wp*maxval(abs(of_full)), "powers at t = "//to_text(t))
      end associate

   contains

      !> Values of a quantity of all items.
      pure function values_of(catalogue, group) result(values)
         type(catalogue_t), intent(in) :: catalogue   !! what is reported
         integer, intent(in) :: group                 !! number of the quantity
         real(wp), allocatable :: values(:)           !! (components of all items) its values [any]

         associate (first => catalogue%place(group, 1, 1), n => catalogue%groups(group)%channel%components)
            values = catalogue%values(first:first + n*size(catalogue%groups(group)%has) - 1)
         end associate
      end function values_of

      !> Compare a channel of all items.
      subroutine compare(actual, expected, name)
         real(wp), intent(in) :: actual(:)        !! (components of all items) values [any]
         real(wp), intent(in) :: expected(:)      !! (components of all items) values [any]
         character(*), intent(in) :: name         !! the channel

         real(wp), allocatable :: a(:), e(:)

         call check_true(error, all(ieee_is_nan(actual) .eqv. ieee_is_nan(expected)), "the same items have "//name)
         a = pack(actual, .not. ieee_is_nan(actual))
         e = pack(expected, .not. ieee_is_nan(expected))
         call check_close(error, a, e, 1.0e-10_wp*max(1.0e-3_wp, maxval(abs(e))), name//" at t = "//to_text(t))
      end subroutine compare

   end subroutine compare_form

   !> Random states about a start at random times.
   subroutine compare_often(deck, n_known, t_end, error)
      character(*), intent(in) :: deck                    !! the deck
      integer, intent(in) :: n_known                      !! bodies that must be known
      real(wp), intent(in) :: t_end                       !! maximum time [s]
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      type(mechanism_t) :: full, small
      type(random_t) :: random
      real(wp), allocatable :: start(:), y(:)
      integer :: k, n, n_rate

      call both_systems(deck, n_known, full, small, start, error)
      if (allocated(error)) return
      random%state = 81_i8
      n = small%linkage%n_position
      n_rate = small%linkage%n_rate
      do k = 1, 10
         y = start
         y(1:n) = y(1:n) + random%vector(n, -0.01_wp, 0.01_wp)
         y(n + 1:n + n_rate) = y(n + 1:n + n_rate) + random%vector(n_rate, -3.0_wp, 3.0_wp)
         call compare_at(full, small, random%between(0.0_wp, t_end), y, error)
      end do
   end subroutine compare_often

   !> Works and energies after a run agree, and the ledger closes, with all coordinates and without.
   subroutine compare_works(deck, end, min_work, error)
      character(*), intent(in) :: deck                        !! the deck, without its analysis
      real(wp), intent(in) :: end                             !! of the run [s]
      real(wp), intent(in) :: min_work                      !! that the drivers do [J]
      type(error_t), allocatable, intent(inout) :: error      !! first failure

      type(energy_t) :: energy(2)
      type(keeper_t) :: keeper(2)
      type(loaded_t), allocatable :: loaded(:)
      type(summary_t) :: summary(2)
      integer :: k

      allocate (loaded(2))
      do k = 1, 2
         call load_text("deck = 1"//nl//with_word(deck//"[analysis.dynamic]"//nl//"end = "//to_text(end)//" s"//nl// &
                                                "tolerance = 1e-11", words(k))//nl, loaded(k), error)
         if (allocated(error)) return
         call run_to_end(loaded(k), keeper(k), summary(k), error)
         if (allocated(error)) return
         energy(k) = energy_of(loaded(k)%system, loaded(k)%method%step%y1)
         associate (quality => summary(k)%quality)
            call check_true(error, quality%energy_residual_max < 1.0e-8_wp*quality%energy_max, "the ledger closes, "//words(k))
         end associate
      end do
      associate (a => energy(1), b => energy(2))
         call check_close(error, [b%kinetic, b%potential, b%elastic, b%drive_work, b%load_work, b%dissipated_damper], &
                          [a%kinetic, a%potential, a%elastic, a%drive_work, a%load_work, a%dissipated_damper], 1.0e-7_wp, &
                          "energies and works", relative=.true.)
         call check_true(error, abs(a%drive_work) > min_work, "the drivers work")
         call check_true(error, abs(b%stabilisation_work) < 1.0e-9_wp*abs(b%drive_work), "nothing is left to the stabilisation")
      end associate
   end subroutine compare_works

end module reduction_comparison
