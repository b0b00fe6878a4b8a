!> Films in bores that are not round, as decks have them: a round bore off the centre, frames that turn, dissipation.
module test_bored_film
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_case, only: film_case_t, force_of
   use film_grid, only: film_grid_t
   use film_law, only: film_bearing_t, film_motion_t
   use fixed_random, only: random_t
   use generic_item, only: column_number, fill_item
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: two_pi, wp
   use reynolds_grid, only: boundary_full, boundary_reynolds
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_bored_film

contains

   subroutine run_test_bored_film(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("round_off_centre", test_round_off_centre)
      call suite%test("turning_frame", test_turning_frame)
      call suite%test("dissipation", test_dissipation)
   end subroutine run_test_bored_film

   !> A film whose bore is a lobe or lobes, R = 10 mm, c = 0.1 mm (or another), L/D = 1.
   subroutine make_lobed(boundary, n, preload, offset, start, clearance, case)
      character(*), intent(in) :: boundary      !! word of the column
      integer, intent(in) :: n                  !! lobes, 0: round
      real(wp), intent(in) :: preload           !! of each [1]
      real(wp), intent(in) :: offset            !! of each [1]
      real(wp), intent(in) :: start             !! of the first [rad]
      real(wp), intent(in) :: clearance         !! of the inscribed circle [m]
      type(film_case_t), intent(out) :: case    !! the film

      character(:), allocatable :: help
      type(item_t) :: item
      type(kind_info_t) :: info
      type(random_t) :: random

      allocate (film_grid_t :: case%law)
      info = case%law%info()
      call fill_item(info, 1, random, item)
      item%values%given = .false.
      item%values(column_number(info, "preload"))%given = n > 0
      item%values(column_number(info, "boundary"))%text = boundary
      item%values(column_number(info, "resolution"))%text = "fine"
      item%values(column_number(info, "bore"))%text = merge("round", "lobes", n == 0)
      item%values(column_number(info, "lobes"))%number = real(n, wp)
      item%values(column_number(info, "preload"))%number = preload
      item%values(column_number(info, "offset"))%number = offset
      item%values(column_number(info, "bore_angle"))%number = start
      call case%law%prepare(item)
      if (case%law%mistake() /= "") error stop "the bore has a mistake"
      case%bearing = film_bearing_t(0.01_wp, clearance, 0.02_wp, 0.05_wp, 0.9999_wp)
      call case%law%fit(case%bearing, case%parameters, case%message, help)
   end subroutine make_lobed

   !> One lobe is a round bore of a larger radius whose centre lies off that of the body, and goes around with it: forces and
   !> moments are those of the round film there, whatever turns. So the motion of the bore is in the equation as it shall be.
   subroutine test_round_off_centre(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: c = 1.0e-4_wp, m = 0.4_wp, w_j = 70.0_wp, w_b = -40.0_wp, start = 0.3_wp, angle = 0.8_wp
      type(film_case_t) :: lobe, round
      type(film_motion_t) :: motion, shifted
      real(wp) :: d(2), f(2), f_round(2), size_of_moment, t_b, t_b_round, t_j, t_j_round
      integer :: boundary

      do boundary = boundary_reynolds, boundary_full
         call make_lobed(merge("reynolds", "full    ", boundary == boundary_reynolds), 1, m, 0.25_wp, start, c, lobe)
         call make_lobed(merge("reynolds", "full    ", boundary == boundary_reynolds), 0, m, 0.25_wp, start, c/(1.0_wp - m), round)
         motion%e = c*[0.3_wp, -0.5_wp]
         motion%e_dot = c*[11.0_wp, 17.0_wp]
         motion%speed_sum = w_j + w_b
         motion%speed_difference = w_j - w_b
         motion%angle = angle
         associate (place => angle + start + 0.25_wp*two_pi)
            d = c*m/(1.0_wp - m)*[cos(place), sin(place)]
         end associate
         shifted = motion
         shifted%e = motion%e + d
         shifted%e_dot = motion%e_dot + w_b*[-d(2), d(1)]
         f = force_of(lobe, motion)
         f_round = force_of(round, shifted)
         call check_close(error, f, f_round, 1.5e-3_wp*norm2(f_round), "force, boundary "//to_text(boundary))
         call lobe%law%torques(motion, lobe%parameters, f, t_j, t_b)
         call round%law%torques(shifted, round%parameters, f_round, t_j_round, t_b_round)
         size_of_moment = abs(t_j_round) + abs(t_b_round)
         call check_close(error, t_j, t_j_round, 1.5e-3_wp*size_of_moment, "moment on the journal")
         call check_close(error, t_b, t_b_round + (d(1)*f_round(2) - d(2)*f_round(1)), 1.5e-3_wp*size_of_moment, &
                          "moment on the bearing, about the centre of its body")
         call check_close(error, lobe%law%min_thickness(c, motion, lobe%parameters), c/(1.0_wp - m) - norm2(shifted%e), &
                          1.0e-12_wp*c, "thickness")
         if (boundary == boundary_full) cycle
         call check_close(error, lobe%law%side_flow(motion, lobe%parameters), round%law%side_flow(shifted, round%parameters), &
                          5.0e-3_wp, "side flow", relative=.true.)
      end do
   end subroutine test_round_off_centre

   !> Pressures in a frame that turns with the bearing are those of a bearing at rest; what turns as one body has none.
   subroutine test_turning_frame(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: c = 1.0e-4_wp, w = 33.0_wp, theta(5) = [0.1_wp, 1.0_wp, 2.5_wp, 4.0_wp, 5.5_wp]
      type(film_case_t) :: case
      type(film_motion_t) :: rest, turning
      real(wp) :: gap(2, 5), gap_turning(2, 5), p(2, 5), p_turning(2, 5)

      call make_lobed("reynolds", 3, 0.6_wp, 0.7_wp, 0.2_wp, c, case)
      rest%e = c*[0.2_wp, -0.6_wp]
      rest%e_dot = c*[3.0_wp, 5.0_wp]
      rest%speed_sum = 50.0_wp
      rest%speed_difference = 50.0_wp
      turning = rest
      turning%angle = 1.1_wp
      turning%e = turned(rest%e)
      turning%e_dot = turned(rest%e_dot) + w*[-turning%e(2), turning%e(1)]
      turning%speed_sum = rest%speed_sum + 2.0_wp*w
      call case%law%field(rest, case%parameters, theta, [0.0_wp, 0.5_wp], p, gap)
      call case%law%field(turning, case%parameters, theta, [0.0_wp, 0.5_wp], p_turning, gap_turning)
      call check_close(error, pack(p_turning, .true.), pack(p, .true.), 1.0e-9_wp*maxval(p), "pressures")
      call check_true(error, maxval(p) > 0.0_wp, "there are pressures")
      call check_close(error, pack(gap_turning, .true.), pack(gap, .true.), 1.0e-12_wp*c, "gaps")
      rest%speed_sum = 2.0_wp*w
      rest%speed_difference = 0.0_wp
      rest%e_dot = w*[-rest%e(2), rest%e(1)]
      call check_close(error, force_of(case, rest), [0.0_wp, 0.0_wp], 1.0e-9_wp, "one body")

   contains

      !> A vector that is turned with the bearing.
      pure function turned(x) result(y)
         real(wp), intent(in) :: x(2)  !! (2) the vector [any]
         real(wp) :: y(2)              !! (2) turned [any]

         y = [cos(1.1_wp)*x(1) - sin(1.1_wp)*x(2), sin(1.1_wp)*x(1) + cos(1.1_wp)*x(2)]
      end function turned

   end subroutine test_turning_frame

   !> No bore gives energy back: forces and moments of shear together take what the gap takes, whatever moves.
   subroutine test_dissipation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: c = 1.0e-4_wp
      type(film_case_t) :: case
      type(film_motion_t) :: motion
      type(random_t) :: random
      real(wp) :: balance, f(2), power, t_b, t_j, w(2)
      integer :: k

      call make_lobed("reynolds", 2, 0.7_wp, 1.0_wp, 0.0_wp, c, case)
      do k = 1, 40
         motion%e = c*[random%between(-0.6_wp, 0.6_wp), random%between(-0.6_wp, 0.6_wp)]
         motion%e_dot = c*[random%between(-30.0_wp, 30.0_wp), random%between(-30.0_wp, 30.0_wp)]
         w = [random%between(-30.0_wp, 30.0_wp), random%between(-30.0_wp, 30.0_wp)]
         motion%speed_sum = sum(w)
         motion%speed_difference = w(1) - w(2)
         motion%angle = random%between(-3.0_wp, 3.0_wp)
         f = force_of(case, motion)
         call case%law%torques(motion, case%parameters, f, t_j, t_b)
         power = -dot_product(f, motion%e_dot) - t_j*w(1) - t_b*w(2)
         call check_true(error, power > 0.0_wp, "power is taken, state "//to_text(k))
         balance = t_j + t_b + motion%e(1)*f(2) - motion%e(2)*f(1)
         call check_close(error, balance, 0.0_wp, 1.0e-12_wp*(abs(t_j) + abs(t_b)), "moments balance")
      end do
   end subroutine test_dissipation

end module test_bored_film
