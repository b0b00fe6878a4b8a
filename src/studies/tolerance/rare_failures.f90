!> Failures of parts per million, by importance sampling.
!>
!> The normal numbers z of the members come from a mixture of normal distributions around 0 and around the points a_j at which the
!> channel, to first order, is at a limit x_j. With its derivatives g by z, its mean m and its standard deviation s
!> $$ a_j = \frac{x_j - m}{s^2} g, \quad w(z) = \left(p_0 + \sum_j p_j \exp(a_j \cdot z - \tfrac12 a_j^2)\right)^{-1}, \quad
!>    P = \frac{1}{N} \sum w(z) , $$
!> the last sum over the members of N that are beyond a limit at some time, or cannot be assembled. It has no bias. The interval of
!> 95 % is that of the mean; where no member fails its upper end is 3/(N p_0).
!> Source: A. B. Owen, Y. Zhou, J. Am. Stat. Assoc. 95 (2000) 135-143. Limits: of channels that bend much within their scatter the
!> points are far from where members fail, and intervals are wide.
module rare_failures
   use counter_random, only: uniform_at
   use kinds, only: i8, not_a_number, wp
   use mechanism_source, only: mechanism_source_t
   use member_draws, only: draw_t, stream_rare
   use member_values, only: block_length, block_t
   use normal_distribution, only: normal_95, normal_probability, normal_quantile
   use sampled_members, only: inside_limits
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: sample_failures

   real(wp), parameter :: around_zero = 0.1_wp   !! p_0 [1]
   real(wp), parameter :: apart = 0.5_wp         !! normal numbers of the differences for g [1]
   real(wp), parameter :: farthest = 8.0_wp      !! maximum length of a point [1]
   real(wp), parameter :: if_none = 3.0_wp       !! expected failures at the upper end, where there are none [1]

contains

   !> Sample the failures of each channel with limits, if that is asked for.
   subroutine sample_failures(source, study, is_exact)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(tolerance_study_t), intent(inout) :: study      !! failures are set; its members are known
      logical, intent(in) :: is_exact                      !! members are assembled

      type(draw_t) :: draw
      integer :: r

      if (study%plan%sampling%rare == 0) return
      allocate (study%members%failures(3, size(study%requests)), source=not_a_number())
      call draw%begin(study)
      do r = 1, size(study%requests)
         if (study%requests(r)%is_limited) call sample_one(source, study, draw, r, is_exact)
      end do
   end subroutine sample_failures

   !> The same of one channel.
   subroutine sample_one(source, study, draw, r, is_exact)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(tolerance_study_t), intent(inout) :: study      !! failures are set
      type(draw_t), intent(in) :: draw                     !! makes members
      integer, intent(in) :: r                             !! number of the channel
      logical, intent(in) :: is_exact                      !! members are assembled

      type(block_t) :: some
      real(wp) :: half, mean, points(draw%n, 0:2), parts(0:2), square, u(draw%n, block_length), w(block_length)
      integer(i8) :: done
      integer :: m, n

      call find_points(study, draw, r, points, parts)
      done = 0
      mean = 0.0_wp
      square = 0.0_wp
      do while (done < study%plan%sampling%rare)
         n = int(min(int(block_length, i8), study%plan%sampling%rare - done))
         do m = 1, n
            call draw_member(draw, r, done + m, points, parts, u(:, m), w(m))
         end do
         call some%fill(source, study, draw, u(:, :n), is_exact)
         where (inside_limits(some, study, r)) w(:n) = 0.0_wp
         mean = mean + sum(w(:n))
         square = square + sum(w(:n)**2)
         done = done + n
      end do
      mean = mean/done
      half = normal_95*sqrt(max(square/done - mean**2, 0.0_wp)/done)
      study%members%failures(:, r) = [mean, max(mean - half, 0.0_wp), min(mean + half, 1.0_wp)]
      if (.not. mean > 0.0_wp) study%members%failures(3, r) = min(if_none/(done*parts(0)), 1.0_wp)
   end subroutine sample_one

   !> Points of the mixture, and the part of each.
   subroutine find_points(study, draw, r, points, parts)
      type(tolerance_study_t), intent(in) :: study   !! the study
      type(draw_t), intent(in) :: draw               !! makes members
      integer, intent(in) :: r                       !! number of the channel
      real(wp), intent(out) :: points(:, 0:)         !! (numbers, 0:2) around zero, at both limits [1]
      real(wp), intent(out) :: parts(0:)             !! (0:2) parts of the members, 0 of a limit that is not there [1]

      real(wp) :: ahead(2)

      points = 0.0_wp
      parts = [1.0_wp, 0.0_wp, 0.0_wp]
      associate (at => study%members%at(r), asked => study%requests(r))
         if (.not. study%sigma(r, at) > 0.0_wp) return
         ahead = [asked%lower, asked%upper] - study%mean(r, at)
         parts(1:2) = merge(1.0_wp, 0.0_wp, abs(ahead) < 0.5_wp*huge(1.0_wp))
         points(:, 1) = derivatives_by_numbers(study, draw, r)/study%sigma(r, at)
         points(:, 2) = points(:, 1)*min(ahead(2)/study%sigma(r, at), farthest)
         points(:, 1) = points(:, 1)*max(ahead(1)/study%sigma(r, at), -farthest)
         parts(1:2) = parts(1:2)/sum(parts(1:2))*(1.0_wp - around_zero)
         parts(0) = around_zero
      end associate
   end subroutine find_points

   !> Derivatives of a channel by the normal numbers, through the deviations of the parameters.
   function derivatives_by_numbers(study, draw, r) result(g)
      type(tolerance_study_t), intent(in) :: study   !! the study
      type(draw_t), intent(in) :: draw               !! makes members
      integer, intent(in) :: r                       !! number of the channel
      real(wp) :: g(draw%n)                          !! derivatives [any]

      real(wp) :: clearances(size(study%pins)), deviations(size(study%plan%parameters), 2), u(draw%n), units(2, size(study%pins))
      integer :: k, side

      do k = 1, draw%n
         do side = 1, 2
            u = 0.5_wp
            u(k) = normal_probability((side - 1.5_wp)*2.0_wp*apart)
            call draw%make(study, study%members%at(r), u, deviations(:, side), units, clearances)
         end do
         g(k) = dot_product(study%slopes(:, r, study%members%at(r)), deviations(:, 2) - deviations(:, 1))/(2.0_wp*apart)
      end do
   end function derivatives_by_numbers

   !> Random numbers of a member, and its weight.
   subroutine draw_member(draw, r, member, points, parts, u, w)
      type(draw_t), intent(in) :: draw         !! makes members
      integer, intent(in) :: r                 !! number of the channel
      integer(i8), intent(in) :: member        !! number of the member, from 1
      real(wp), intent(in) :: points(:, 0:)    !! (numbers, 0:2) points of the mixture [1]
      real(wp), intent(in) :: parts(0:)        !! (0:2) parts of the members [1]
      real(wp), intent(out) :: u(:)            !! (numbers) between 0 and 1, both excluded [1]
      real(wp), intent(out) :: w               !! weight [1]

      real(wp) :: chosen, z(size(u))
      integer :: j, k

      call draw%numbers(stream_rare + r, member, u)
      chosen = uniform_at(draw%seed, stream_rare + r, member - 1_i8, draw%n)
      j = 0
      if (chosen > parts(0)) j = 1
      if (chosen > parts(0) + parts(1)) j = 2
      do k = 1, size(u)
         z(k) = normal_quantile(u(k)) + points(k, j)
         if (abs(points(k, j)) > 0.0_wp) u(k) = min(max(normal_probability(z(k)), tiny(w)), 1.0_wp - 0.5_wp*epsilon(w))
      end do
      w = parts(0)
      do j = 1, 2
         if (parts(j) > 0.0_wp) w = w + parts(j)*exp(min(dot_product(points(:, j), z) - 0.5_wp*sum(points(:, j)**2), 700.0_wp))
      end do
      w = 1.0_wp/w
   end subroutine draw_member

end module rare_failures
