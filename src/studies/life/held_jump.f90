!> Profiles over a jump of cycles under held loads (`held_loads`), in sub-jumps whose error is controlled.
!>
!> dx/dtau = (1 - tau/J) v_a(x) + tau/J v_b(x) + tau d,   0 < tau < J
!>
!> v_a and v_b under the loads at the start and at the end of the jump, or v_a alone with a drift d. The pressure
!> spreads anew within a depth as small as the overlap, so that the equation is stiff. A sub-jump of h cycles takes the
!> trapezoidal rule, then the backward differentiation formula of order 2, with g = 1 - 1/sqrt(2), w = 1/sqrt(8):
!>
!> k_2 = v(x + g h (k_1 + k_2)),   k_3 = v(x_1),   x_1 = x + h (w k_1 + w k_2 + g k_3),   next k_1 = k_3
!>
!> of order 2, L-stable. Both stages are solved by Newton's method with the derivatives of `held_slopes` and GMRES. The error is the
!> difference from the embedded formula of order 3, filtered by the matrix of the stages. It is at most the tolerance of what the
!> sub-jump adds to the volumes, or of what a twentieth of the jump adds: rates have small jumps where the edges of contact
!> pass cells, whose errors do not add up, because a cell that is worn too deep loses its load.
!> The weights of the method are positive, so that no cell is filled; sums of volumes are those of the rates to round-off.
!> Source: R. E. Bank et al., IEEE Trans. Electron Devices 32 (1985) 1992-2007; M. E. Hosea, L. F. Shampine, Appl. Numer. Math. 20
!> (1996) 21-37.
module held_jump
   use held_loads, only: held_t
   use held_slopes, only: depth_by_volume, implicit_t
   use kinds, only: wp
   use krylov_solver, only: krylov_solver_t
   use life_state, only: life_state_t
   implicit none (type, external)
   private
   public :: follow, mean_of, path_t

   integer, parameter :: most_steps = 2000          !! sub-jumps of a jump, rejected ones counted
   real(wp), parameter :: part = 1.0_wp             !! of the tolerance that a sub-jump may use [1]
   real(wp), parameter :: few = 0.05_wp             !! part of a jump below which a sub-jump is not made to gain accuracy [1]
   real(wp), parameter :: shortest = 1.0e-7_wp      !! part of a jump that a sub-jump is at least [1]
   real(wp), parameter :: careful = 0.9_wp          !! part of the sub-jump that would just be accepted [1]
   real(wp), parameter :: longest_growth = 4.0_wp   !! of a sub-jump over the one before [1]
   real(wp), parameter :: shortest_part = 0.2_wp    !! of a sub-jump that is made again [1]
   real(wp), parameter :: failed_part = 0.25_wp     !! of a sub-jump in which a pin or a stage was not found [1]
   real(wp), parameter :: gamma = 1.0_wp - sqrt(0.5_wp), weight = 0.5_wp*sqrt(0.5_wp)   !! of the method, see above [1]
   integer, parameter :: most_iterations = 8        !! of Newton's method
   real(wp), parameter :: solved = 0.1_wp           !! part of what is allowed that stages may lack [1]
   real(wp), parameter :: linear = 0.02_wp          !! part of the residual that is left of a linear system [1]

   !> Profiles over a jump.
   type :: path_t
      integer :: n = 0                           !! sub-jumps
      real(wp), allocatable :: cycles(:)         !! (0:n) from the start of the jump [1]
      real(wp), allocatable :: sums(:, :, :)     !! (n numbers, starts, 0:n) what has been lost by then [m^3, m]
      real(wp), allocatable :: slope(:, :)       !! (n numbers, 0:n) mean rates there [m^3, m]
      real(wp) :: allowed = huge(1.0_wp)         !! length of the next sub-jump by its error [1]
   end type path_t

contains

   !> Follow the profiles over a jump.
   subroutine follow(state, x, jump, tolerance, a, path, is_good, b, drift)
      type(life_state_t), intent(in) :: state              !! the surfaces
      real(wp), intent(in) :: x(:)                         !! (n) at the start [m^3, m]
      real(wp), intent(in) :: jump                         !! cycles [1]
      real(wp), intent(in) :: tolerance                    !! of volumes, over what is added [1]
      type(held_t), intent(inout), target :: a             !! loads at the start
      type(path_t), intent(inout) :: path                  !! set; `allowed` is the length of the first sub-jump
      logical, intent(out) :: is_good                      !! the end was reached
      type(held_t), intent(inout), optional, target :: b   !! loads at the end
      real(wp), intent(in), optional :: drift(:, :)        !! (n, starts) growth of the rates per cycle [m^3, m]

      type(implicit_t) :: matrix
      type(krylov_solver_t) :: solver
      real(wp), dimension(:, :), allocatable :: k1, k2, k3, sums, trial
      real(wp) :: h, ratio, tau
      integer :: status, tried
      logical :: is_last

      call start(is_good)
      h = min(path%allowed, jump)
      do tried = 1, most_steps
         if (.not. is_good) return
         is_last = jump - tau - h < 1.0e-9_wp*jump
         if (is_last) h = jump - tau
         call try_sub_jump(is_good)
         if (.not. is_good) then
            h = failed_part*h
            is_good = h > shortest*jump
            cycle
         end if
         ratio = error_of_sub_jump()/max(1.0_wp, few*jump/h)
         if (ratio <= 1.0_wp) then
            tau = merge(jump, tau + h, is_last)
            sums = trial
            k1 = k3
            call append(path, tau, sums, mean_of(k1))
         end if
         h = h*max(shortest_part, min(longest_growth, careful*max(ratio, 1.0e-9_wp)**(-1.0_wp/3.0_wp)))
         if (ratio <= 1.0_wp) path%allowed = h
         if (is_last .and. ratio <= 1.0_wp) return
         is_good = h > shortest*jump
      end do
      is_good = .false.

   contains

      !> Rates at the start, and what solves for stages.
      subroutine start(is_found)
         logical, intent(out) :: is_found      !! each pin was found

         call begin(path)
         allocate (sums(size(x), size(a%rates, 2)), source=0.0_wp)
         k1 = sums
         k2 = sums
         k3 = sums
         matrix%a => a%slopes
         if (present(b)) matrix%b => b%slopes
         tau = 0.0_wp
         call solver%open(size(x), status)
         is_found = status == 0
         if (is_found) call rates_of(tau, sums, k1, is_found)
         if (is_found) call append(path, tau, sums, mean_of(k1))
      end subroutine start

      !> Rates of the stages of a sub-jump, and its end.
      subroutine try_sub_jump(is_found)
         logical, intent(out) :: is_found      !! the stages were found

         k2 = k1
         call find_stage(tau + 2.0_wp*gamma*h, sums + gamma*h*k1, k2, is_found)
         if (.not. is_found) return
         trial = sums + weight*h*(k1 + k2)
         k3 = max(k2 + (1.0_wp/(2.0_wp*gamma) - 1.0_wp)*(k2 - k1), 0.0_wp)
         call find_stage(tau + h, trial, k3, is_found)
         trial = trial + gamma*h*k3
      end subroutine try_sub_jump

      !> Rates after some cycles of the jump.
      subroutine rates_of(cycles, lost, rates, is_found)
         real(wp), intent(in) :: cycles        !! since the start of the jump [1]
         real(wp), intent(in) :: lost(:, :)    !! (n, starts) what has been lost [m^3, m]
         real(wp), intent(inout) :: rates(:, :) !! (n, starts) per cycle; set [m^3, m]
         logical, intent(out) :: is_found      !! each pin was found

         real(wp), allocatable :: more(:, :), y(:)

         y = x + max(mean_of(lost), 0.0_wp)
         call a%at(state, y, rates, is_found)
         if (present(drift)) rates = rates + cycles*drift
         if (.not. (present(b) .and. is_found)) return
         allocate (more(size(rates, 1), size(rates, 2)))
         call b%at(state, y, more, is_found)
         rates = (1.0_wp - cycles/jump)*rates + (cycles/jump)*more
      end subroutine rates_of

      !> Rates of a stage:  k = v(y),  y = base + gamma h k,  by Newton's method.
      subroutine find_stage(cycles, base, rates, is_found)
         real(wp), intent(in) :: cycles          !! since the start of the jump [1]
         real(wp), intent(in) :: base(:, :)      !! (n, starts) what has been lost but for this stage [m^3, m]
         real(wp), intent(inout) :: rates(:, :)  !! (n, starts) a guess, and what they are per cycle [m^3, m]
         logical, intent(out) :: is_found        !! it was found

         real(wp), allocatable :: left(:), lost(:, :), place(:), step(:)
         integer :: iteration, m

         place = mean_of(base + gamma*h*rates)
         lost = base
         step = 0.0_wp*place
         do iteration = 1, most_iterations
            do m = 1, size(lost, 2)
               lost(:, m) = place
            end do
            call rates_of(cycles, lost, rates, is_found)
            if (.not. is_found) return
            left = mean_of(base + gamma*h*rates) - place
            matrix%by = depth_by_volume(state, x + place)
            call matrix%prepare(gamma*h, merge(cycles/jump, 0.0_wp, present(b)))
            if (error_over(h*mean_of(rates), left) <= solved*max(1.0_wp, few*jump/h)) return
            call solver%solve(matrix, left, 0.0_wp*left + 1.0_wp, linear, step, status)
            place = max(place + step/matrix%diagonal, 0.0_wp)
         end do
         is_found = .false.
      end subroutine find_stage

      !> Error of the sub-jump over what is allowed.
      real(wp) function error_of_sub_jump() result(most)
         real(wp), allocatable :: error(:), step(:)

         error = (h/3.0_wp)*mean_of((4.0_wp*weight - 1.0_wp)*k1 - k2 + 2.0_wp*gamma*k3)
         step = error
         call solver%solve(matrix, error, 0.0_wp*error + 1.0_wp, linear, step, status)
         most = error_over(mean_of(trial - sums), step/matrix%diagonal)
      end function error_of_sub_jump

      !> Error over what is allowed, maximum over the surfaces.
      real(wp) function error_over(gain, error) result(most)
         real(wp), intent(in) :: gain(:)    !! (n) what the sub-jump adds [m^3, m]
         real(wp), intent(in) :: error(:)   !! (n) its error [m^3, m]

         integer :: k

         most = 0.0_wp
         do k = 1, size(state%surfaces)
            associate (first => state%before(k) + 1, last => state%before(k) + size(state%surfaces(k)%volume))
               associate (all => sum(abs(gain(first:last))))
                  if (.not. all <= 0.0_wp) most = max(most, sum(abs(error(first:last)))/(part*tolerance*all))
               end associate
            end associate
         end do
      end function error_over

   end subroutine follow

   !> An empty path.
   subroutine begin(path)
      type(path_t), intent(inout) :: path   !! `allowed` is kept

      path%n = -1
      if (allocated(path%cycles)) deallocate (path%cycles, path%sums, path%slope)
   end subroutine begin

   !> Append to a path.
   subroutine append(path, cycles, sums, slope)
      type(path_t), intent(inout) :: path     !! grown
      real(wp), intent(in) :: cycles          !! since the start of the jump [1]
      real(wp), intent(in) :: sums(:, :)      !! (n, starts) what has been lost [m^3, m]
      real(wp), intent(in) :: slope(:)        !! (n) mean rates [m^3, m]

      type(path_t) :: longer

      if (.not. allocated(path%cycles)) then
         allocate (path%cycles(0:7), path%sums(size(sums, 1), size(sums, 2), 0:7), path%slope(size(slope), 0:7))
      else if (path%n == ubound(path%cycles, 1)) then
         associate (n => path%n)
            allocate (longer%cycles(0:2*n + 1), longer%sums(size(sums, 1), size(sums, 2), 0:2*n + 1), &
                      longer%slope(size(slope), 0:2*n + 1))
            longer%cycles(:n) = path%cycles
            longer%sums(:, :, :n) = path%sums
            longer%slope(:, :n) = path%slope
         end associate
         call move_alloc(longer%cycles, path%cycles)
         call move_alloc(longer%sums, path%sums)
         call move_alloc(longer%slope, path%slope)
      end if
      path%n = path%n + 1
      path%cycles(path%n) = cycles
      path%sums(:, :, path%n) = sums
      path%slope(:, path%n) = slope
   end subroutine append

   !> Mean over the starts.
   pure function mean_of(list) result(mean)
      real(wp), intent(in) :: list(:, :)        !! (n, starts) one of each start [any]
      real(wp) :: mean(size(list, 1))           !! (n) their mean [any]

      mean = sum(list, dim=2)/size(list, 2)
   end function mean_of

end module held_jump
