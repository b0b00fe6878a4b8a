!> The expansion of second order of channels in the parameters and the places of pins, and its use in place of a mechanism.
!>
!> $$ R \approx R_0 + \sum_i S_i \delta_i + \tfrac12 \sum_{ij} H_{ij} \delta_i \delta_j + \sum_k G_k \cdot e_k
!>    + \tfrac12 \sum_k e_k \cdot K_k e_k $$
!> H comes from differences of mechanisms that are assembled: those of one parameter by two steps, extrapolated; mixed ones by
!> $$ 2 h_i h_j H_{ij} = R(h_i, h_j) + R(-h_i, -h_j) - 2 R_0 - h_i^2 H_{ii} - h_j^2 H_{jj} . $$
!> K likewise, of each pin. Limits: no mixed terms of pins and parameters, or of two pins; parameters without tolerance have
!> no second derivatives; where a mechanism next to the nominal one cannot be assembled they are zero, and the
!> study assembles its members, if its budget allows.
module expansion
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use mechanism_source, only: mechanism_source_t
   use prescribed_motion, only: solved
   use sensitivities, only: pin_rows
   use tolerance_results, only: sensitivities_t, tolerance_study_t
   use varied_mechanism, only: varied_t
   implicit none (type, external)
   private
   public :: expanded_value, find_curvatures, predicted_positions

   real(wp), parameter :: pin_step = 0.005_wp              !! displacement of a pin, of the size of the mechanism [1]
   real(wp), parameter :: parts(2) = [1.0_wp, 0.5_wp]   !! steps, of the longest one of first derivatives [1]

contains

   !> Find all second derivatives. The first ones are known.
   subroutine find_curvatures(source, study)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(tolerance_study_t), intent(inout) :: study      !! second derivatives are set

      real(wp), allocatable :: ahead(:, :), behind(:, :), deviations(:)
      integer, allocatable :: list(:)
      integer :: i, j, k, n

      associate (found => study%derivatives, parameters => study%plan%parameters)
         n = size(parameters)
         allocate (found%curvatures(n, n, size(study%requests), size(found%instants)), source=0.0_wp)
         allocate (ahead, mold=found%values)
         allocate (behind, mold=found%values)
         list = pack([(k, k=1, n)], [(parameters(k)%upper > parameters(k)%lower, k=1, n)])
         do i = 1, size(list)
            call find_own(list(i))
            call source%show(0.5_wp + 0.1_wp*i/size(list))
         end do
         do i = 1, size(list)
            do j = 1, i - 1
               call find_mixed(list(i), list(j))
            end do
            call source%show(0.6_wp + 0.1_wp*i/size(list))
         end do
         call find_pin_curvatures(source, study)
         found%has_curvatures = all(ieee_is_finite(found%curvatures)) .and. all(ieee_is_finite(found%pin_curvatures))
         where (.not. ieee_is_finite(found%pin_curvatures)) found%pin_curvatures = 0.0_wp
         where (.not. ieee_is_finite(found%curvatures)) found%curvatures = 0.0_wp
      end associate

   contains

      !> Second derivatives by one parameter.
      subroutine find_own(p)
         integer, intent(in) :: p   !! number of the parameter

         real(wp) :: h
         integer :: l

         associate (found => study%derivatives)
            do l = 1, 2
               h = parts(l)*found%steps(p)
               deviations = [(merge(h, 0.0_wp, k == p), k=1, n)]
               call values_of(deviations, ahead)
               call values_of(-deviations, behind)
               if (l == 1) found%curvatures(p, p, :, :) = (ahead + behind - 2.0_wp*found%values)/h**2
            end do
            found%curvatures(p, p, :, :) = (4.0_wp*(ahead + behind - 2.0_wp*found%values)/h**2 &
                                            - found%curvatures(p, p, :, :))/3.0_wp
         end associate
      end subroutine find_own

      !> Mixed second derivatives of two parameters.
      subroutine find_mixed(p, q)
         integer, intent(in) :: p   !! number of a parameter
         integer, intent(in) :: q   !! number of another one

         real(wp) :: h(2)

         h = parts(2)*study%derivatives%steps([p, q])
         deviations = [(merge(h(1), 0.0_wp, k == p) + merge(h(2), 0.0_wp, k == q), k=1, n)]
         call values_of(deviations, ahead)
         call values_of(-deviations, behind)
         associate (found => study%derivatives)
            found%curvatures(p, q, :, :) = (ahead + behind - 2.0_wp*found%values - h(1)**2*found%curvatures(p, p, :, :) &
                                            - h(2)**2*found%curvatures(q, q, :, :))/(2.0_wp*product(h))
            found%curvatures(q, p, :, :) = found%curvatures(p, q, :, :)
         end associate
      end subroutine find_mixed

      !> Channels of an assembled mechanism at all instants; NaN where it cannot be assembled.
      subroutine values_of(changes, values)
         real(wp), intent(in) :: changes(:)      !! (parameters) deviations [any]
         real(wp), intent(out) :: values(:, :)   !! (requests, times) values [any]

         type(error_t), allocatable :: error
         type(varied_t) :: varied
         real(wp) :: clearances(size(study%pins)), no_pins(2, size(study%pins)), q(size(study%derivatives%instants(1)%q))
         real(wp), allocatable :: none(:)
         integer :: at, outcome

         values = not_a_number()
         no_pins = 0.0_wp
         call source%build(changes, varied, clearances, error)
         if (allocated(error)) return
         allocate (none(varied%system%linkage%rows%n), source=0.0_wp)
         do at = 1, size(study%derivatives%instants)
            associate (instant => study%derivatives%instants(at))
               call predicted_positions(study%derivatives, at, varied, changes, no_pins, q)
               call varied%assemble(instant, none, q, outcome)
               if (outcome == solved) call varied%values_at(instant, q, values(:, at), outcome)
               if (outcome /= solved) values(:, at) = not_a_number()
               call varied%follow()
            end associate
         end do
      end subroutine values_of

   end subroutine find_curvatures

   !> Second derivatives by the places of pins.
   subroutine find_pin_curvatures(source, study)
      class(mechanism_source_t), intent(inout) :: source   !! gives the nominal mechanism
      type(tolerance_study_t), intent(inout) :: study      !! second derivatives by pins are set

      real(wp), parameter :: ways(2, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], [2, 3])
      type(error_t), allocatable :: error
      type(varied_t) :: nominal
      real(wp) :: clearances(size(study%pins)), h, one(size(study%requests), 3), sides(size(study%requests), 2)
      integer :: at, k, side, way

      associate (found => study%derivatives)
         allocate (found%pin_curvatures(3, size(study%pins), size(study%requests), size(found%instants)), source=0.0_wp)
         if (size(study%pins) == 0) return
         call source%build([(0.0_wp, k=1, size(study%plan%parameters))], nominal, clearances, error)
         if (allocated(error)) return  ! it was built before
         h = pin_step*nominal%system%linkage%scales%length
         do at = 1, size(found%instants)
            do k = 1, size(study%pins)
               do way = 1, 3
                  do side = 1, 2
                     call values_of_pin(merge(h, -h, side == 1)*ways(:, way), sides(:, side))
                  end do
                  one(:, way) = (sum(sides, dim=2) - 2.0_wp*found%values(:, at))/h**2
               end do
               found%pin_curvatures(1:2, k, :, at) = transpose(one(:, 1:2))
               found%pin_curvatures(3, k, :, at) = 0.5_wp*(one(:, 3) - one(:, 1) - one(:, 2))
            end do
            call nominal%follow()
         end do
      end associate

   contains

      !> Channels with a displaced pin; NaN where the mechanism cannot be assembled.
      subroutine values_of_pin(e, values)
         real(wp), intent(in) :: e(2)         !! (2) displacement [m]
         real(wp), intent(out) :: values(:)   !! (requests) values [any]

         real(wp) :: displaced(2, size(study%pins)), q(size(study%derivatives%instants(1)%q))
         real(wp) :: none(size(study%plan%parameters)), right(nominal%system%linkage%rows%n)
         integer :: outcome, rows(2)

         displaced = 0.0_wp
         displaced(:, k) = e
         none = 0.0_wp
         right = 0.0_wp
         rows = pin_rows(nominal, study%pins(k))
         right(rows) = e
         call predicted_positions(study%derivatives, at, nominal, none, displaced, q)
         call nominal%assemble(study%derivatives%instants(at), right, q, outcome)
         if (outcome == solved) call nominal%values_at(study%derivatives%instants(at), q, values, outcome)
         if (outcome /= solved) values = not_a_number()
      end subroutine values_of_pin

   end subroutine find_pin_curvatures

   !> Positions of a changed mechanism to first order.
   subroutine predicted_positions(found, at, varied, deviations, displaced, q)
      type(sensitivities_t), intent(in) :: found     !! derivatives
      integer, intent(in) :: at                      !! number of the instant
      type(varied_t), intent(in) :: varied           !! the mechanism, for its coordinates
      real(wp), intent(in) :: deviations(:)          !! (parameters) deviations [any]
      real(wp), intent(in) :: displaced(:, :)        !! (2, pins) displacements of pins [m]
      real(wp), intent(out) :: q(:)                  !! (n_q bodies) positions [any]

      q = found%instants(at)%q
      associate (linkage => varied%system%linkage)
         call linkage%coordinates%add_change(linkage%bodies%n, matmul(found%tangents(:, :, at), deviations) + &
                                             matmul(found%pin_tangents(:, :, at), reshape(displaced, [size(displaced)])), q)
      end associate
   end subroutine predicted_positions

   !> A channel at an instant by the expansion, of many members.
   pure subroutine expanded_value(found, request, at, deviations, displaced, values)
      type(sensitivities_t), intent(in) :: found       !! derivatives
      integer, intent(in) :: request                   !! number of the channel
      integer, intent(in) :: at                        !! number of the instant
      real(wp), intent(in) :: deviations(:, :)         !! (members, parameters) deviations [any]
      real(wp), intent(in) :: displaced(:, :, :)       !! (members, 2, pins) displacements of pins [m]
      real(wp), intent(out) :: values(:)               !! (members) values [any]

      integer :: i, j

      values = found%values(request, at)
      do i = 1, size(deviations, 2)
         values = values + deviations(:, i)*(found%slopes(i, request, at) + &
                                             0.5_wp*found%curvatures(i, i, request, at)*deviations(:, i))
         do j = 1, i - 1
            if (abs(found%curvatures(j, i, request, at)) > 0.0_wp) then
               values = values + found%curvatures(j, i, request, at)*deviations(:, i)*deviations(:, j)
            end if
         end do
      end do
      do i = 1, size(displaced, 3)
         associate (x => displaced(:, 1, i), y => displaced(:, 2, i), slope => found%pins(:, i, request, at), &
                    curvature => found%pin_curvatures(:, i, request, at))
            values = values + x*(slope(1) + 0.5_wp*curvature(1)*x + curvature(3)*y) + y*(slope(2) + 0.5_wp*curvature(2)*y)
         end associate
      end do
   end subroutine expanded_value

end module expansion
