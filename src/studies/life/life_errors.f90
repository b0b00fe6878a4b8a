!> Errors of the profiles of a life, in their measures.
!>
!> jumps      twice the change that the sum of all local errors makes; later jumps may change an error, which is not followed
!> starts     the jackknife over the starts of the ensemble: with the measure Q_(m) of the profile without start m, of M starts,
!>            half the interval is  t_(0.975, M - 1) sqrt((M - 1)/M sum (Q_(m) - mean)^2)
!> settling   the change that rates after twice the settling cycles would make, from those of the first and the last profile, linear
!>            in the cycles between; with an ensemble, what exceeds its own scatter
!>
!> Source: B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap (1993), chapter 11 (jackknife). Limits: errors of the
!> integration and of the cells are not in it.
module life_errors
   use batch_means, only: student
   use errors, only: error_t
   use held_jump, only: mean_of
   use kinds, only: wp
   use life_results, only: life_t, node_t
   use life_state, only: life_state_t, n_measure
   use rate_source, only: rate_source_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: beyond_scatter, error_ratio, measure_errors, settling_errors

   real(wp), parameter :: safety = 2.0_wp   !! times the estimated error of all jumps [1]
   real(wp), parameter :: explained = 2.0_wp     !! standard errors of an error that scatter explains [1]
   real(wp), parameter :: deep = 0.5_wp          !! part of the maximum depth above which errors of cells count [1]
   real(wp), parameter :: most_change = 0.1_wp   !! mean of what the change of rates makes over that of what the jump adds [1]

contains

   !> Measures of a node, and their errors by jumps and starts.
   subroutine measure_errors(state, x, error, sums, node)
      type(life_state_t), intent(in) :: state   !! the surfaces
      real(wp), intent(in) :: x(:)              !! (n) volumes and distances [m^3, m]
      real(wp), intent(in) :: error(:)          !! (n) sum of the local errors [m^3, m]
      real(wp), intent(in) :: sums(:, :)        !! (n, starts) what each start would have taken so far [m^3, m]
      type(node_t), intent(inout) :: node       !! measures and errors are set

      node%measures = state%measures(x)
      node%by_jumps = safety*abs(state%measures(max(x + error, 0.0_wp)) - node%measures)
      node%by_starts = jackknife(state, x, sums)
      node%by_settling = 0.0_wp*node%measures
   end subroutine measure_errors

   !> Half of the 95 % interval of measures by the scatter between starts.
   function jackknife(state, x, sums) result(half)
      type(life_state_t), intent(in) :: state                !! the surfaces
      real(wp), intent(in) :: x(:)                           !! (n) mean profile [m^3, m]
      real(wp), intent(in) :: sums(:, :)                     !! (n, starts) what each start has added [m^3, m]
      real(wp) :: half(n_measure, size(state%surfaces))      !! (measures, surfaces) [m, m^3, rad]

      real(wp) :: list(n_measure, size(state%surfaces), size(sums, 2)), mean(size(x))
      integer :: m

      half = 0.0_wp
      associate (n => size(sums, 2))
         if (n < 2) return
         mean = sum(sums, dim=2)/n
         do m = 1, n
            list(:, :, m) = state%measures(max(x + (mean - sums(:, m))/(n - 1), 0.0_wp))
         end do
         half = student(n - 1)*sqrt((n - 1.0_wp)/n*sum((list - spread(sum(list, dim=3)/n, 3, n))**2, dim=3))
      end associate
   end function jackknife

   !> Errors by settling of all nodes: rates after twice the settling cycles, for the first and the last profile.
   subroutine settling_errors(life, source, place, rates, error)
      type(life_t), intent(inout) :: life                !! the life; errors of its nodes are set
      class(rate_source_t), intent(inout) :: source      !! what gives the rates
      real(wp), intent(in) :: place(:)                   !! (n) last profile that was simulated [m^3, m]
      real(wp), intent(in) :: rates(:, :)                !! (n, starts) its rates [m^3, m]
      type(error_t), allocatable, intent(out) :: error   !! a simulation failed

      real(wp), allocatable :: change(:, :, :), first(:, :), loads(:, :), values(:)
      integer :: k

      if (life%last < 2) return
      allocate (first(size(rates, 1), size(rates, 2)), change(size(rates, 1), size(rates, 2), 2), &
                loads(life%plan%n_loads, size(rates, 2)), values(size(life%plan%ends%extremes)), source=0.0_wp)
      call source%find(life%state%surfaces, 1, 1, first, values, loads, error)  ! known: it was the first
      if (.not. allocated(error)) then
         call source%find(life%state%surfaces, life%simulated + 1, 2, change(:, :, 1), values, loads, error)
      end if
      if (.not. allocated(error)) then
         call source%find(life%state%worn(place), life%simulated + 2, 2, change(:, :, 2), values, loads, error)
      end if
      if (allocated(error)) return
      life%simulated = life%simulated + 2
      change(:, :, 1) = change(:, :, 1) - first
      change(:, :, 2) = change(:, :, 2) - rates
      do k = 1, life%n
         call settle(life%state, change, life%nodes(life%n)%cycles, life%nodes(k))
      end do
   end subroutine settling_errors

   !> Error by settling of a node.
   subroutine settle(state, change, cycles, node)
      type(life_state_t), intent(in) :: state     !! the surfaces
      real(wp), intent(in) :: change(:, :, :)     !! (n, starts, 2) of rates, of the first and the last profile [m^3, m]
      real(wp), intent(in) :: cycles              !! of the last profile [1]
      type(node_t), intent(inout) :: node         !! its error is set

      real(wp) :: part
      real(wp), allocatable :: sums(:, :), mean(:)

      part = 0.5_wp*node%cycles/cycles
      sums = node%cycles*((1.0_wp - part)*change(:, :, 1) + part*change(:, :, 2))
      mean = sum(sums, dim=2)/size(sums, 2)
      node%by_settling = abs(state%measures(max(node%x + mean, 0.0_wp)) - node%measures)
      node%by_settling = max(node%by_settling - jackknife(state, max(node%x + mean, 0.0_wp), sums), 0.0_wp)
   end subroutine settle

   !> Maximum over the surfaces of the error of depth, and of the change of the rates, over what is allowed. The change falls as J,
   !> the error over what is added as J^2: the square of the first stands beside the second.
   real(wp) function error_ratio(life, x, gain, local, change) result(ratio)
      type(life_t), intent(in) :: life       !! the life
      real(wp), intent(in) :: x(:)           !! (n) where the jump starts [m^3, m]
      real(wp), intent(in) :: gain(:)        !! (n) what it adds [m^3, m]
      real(wp), intent(in) :: local(:, :)    !! (n, starts) its local errors [m^3, m]
      real(wp), intent(in) :: change(:, :)   !! (n, starts) what the change of the rates makes [m^3, m]

      type(worn_surface_t), allocatable :: surfaces(:)
      real(wp), allocatable :: added(:), errors(:)
      real(wp) :: most
      integer :: k

      ratio = 0.0_wp
      surfaces = life%state%worn(x)
      do k = 1, size(surfaces)
         allocate (added(size(surfaces(k)%volume)))
         call life%state%smooth_depths(k, x + gain, gain, added)
         most = maxval(added)
         if (most > 0.0_wp) then
            associate (depths => surfaces(k)%depths() + added)
               errors = merge(unexplained(life, k, x + gain, local), 0.0_wp, depths > deep*maxval(depths))
               ratio = max(ratio, maxval(errors)/(most*(life%plan%tolerance + life%plan%depth_tolerance/maxval(depths))))
            end associate
            errors = unexplained(life, k, x + gain, change)
            ratio = max(ratio, (sum(errors)/(most_change*sum(added)))**2)
         end if
         deallocate (added)
      end do
   end function error_ratio

   !> Depths of a change of a surface, less what the scatter between starts explains.
   function unexplained(life, k, x, change) result(errors)
      type(life_t), intent(in) :: life       !! the life
      integer, intent(in) :: k               !! number of the surface
      real(wp), intent(in) :: x(:)           !! (n) where [m^3, m]
      real(wp), intent(in) :: change(:, :)   !! (n, starts) the change [m^3, m]

      real(wp) :: errors(size(life%state%surfaces(k)%volume))   !! (cells) magnitudes [m]

      real(wp) :: depths(size(errors), size(change, 2)), scatter(size(errors))
      integer :: m

      do m = 1, size(change, 2)
         call life%state%smooth_depths(k, x, change(:, m), depths(:, m))
      end do
      scatter = 0.0_wp
      associate (n => size(change, 2))
         if (n > 1) scatter = sqrt(sum((depths - spread(mean_of(depths), 2, n))**2, dim=2)/(n*(n - 1.0_wp)))
      end associate
      errors = max(abs(mean_of(depths)) - explained*scatter, 0.0_wp)
   end function unexplained

   !> Local errors less what the scatter between starts explains, the same for each start; of one start they are not changed.
   pure function beyond_scatter(local) result(errors)
      real(wp), intent(in) :: local(:, :)                          !! (n, starts) local errors [m^3, m]
      real(wp) :: errors(size(local, 1), size(local, 2))           !! (n, starts) what is left of their mean [m^3, m]

      real(wp) :: mean(size(local, 1)), scatter(size(local, 1))

      errors = local
      associate (n => size(local, 2))
         if (n < 2) return
         mean = mean_of(local)
         scatter = sqrt(sum((local - spread(mean, 2, n))**2, dim=2)/(n*(n - 1.0_wp)))
         errors = spread(sign(max(abs(mean) - explained*scatter, 0.0_wp), mean), 2, n)
      end associate
   end function beyond_scatter

end module life_errors
