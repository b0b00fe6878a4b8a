!> Where a number has an extreme within a step: as exactly as the method gives the states there.
module extreme_place
   use contact_peaks, only: trend_t
   use catalogue, only: catalogue_t
   use integrator, only: integrator_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use observed, only: observed_t
   implicit none (type, external)
   private
   public :: find_flat_place, find_turn

   real(wp), parameter :: spacing = 0.05_wp        !! of the places that a polynomial goes through, of the step [1]
   integer, parameter :: n_round = 3               !! polynomials, each about the extreme of the one before
   integer, parameter :: most_corrections = 8      !! of a place where a rate vanishes
   real(wp), parameter :: close_enough = 1.0e-12_wp   !! correction that is the last, of the step [1]

contains

   !> Where the rate of a force or a penetration vanishes: Newton's iteration with differences of the rate.
   subroutine find_turn(system, method, catalogue, what, place, value, y, ydot, status)
      type(mechanism_t), intent(inout) :: system       !! the system
      class(integrator_t), intent(inout) :: method     !! the method after a step
      type(catalogue_t), intent(inout) :: catalogue    !! of its channels
      type(observed_t), intent(in) :: what             !! which number, of a contact
      real(wp), intent(inout) :: place                 !! in the step, about; then better [1]
      real(wp), intent(out) :: value                   !! the number there [any]
      real(wp), intent(inout), contiguous :: y(:)      !! (n) scratch [any]
      real(wp), intent(inout), contiguous :: ydot(:)   !! (n) scratch [any]
      integer, intent(out) :: status                   !! 0: done

      real(wp) :: before, correction, slope
      type(trend_t) :: beside, x
      integer :: k

      before = place
      value = 0.0_wp
      do k = 1, most_corrections
         call at(place, x)
         if (status /= 0) return
         value = x%value
         call at(place + merge(-0.01_wp, 0.01_wp, place > 0.5_wp), beside)
         if (status /= 0) return
         slope = (beside%rate - x%rate)/merge(-0.01_wp, 0.01_wp, place > 0.5_wp)
         if (.not. slope < 0.0_wp) return
         correction = -x%rate/slope
         if (abs(place + correction - before) > 0.5_wp) return
         place = min(1.0_wp, max(0.0_wp, place + correction))
         if (abs(correction) < close_enough) exit
      end do
      call at(place, x)
      if (status == 0) value = x%value

   contains

      !> The number and its rate at a place.
      subroutine at(s, trend)
         real(wp), intent(in) :: s                !! the place [1]
         type(trend_t), intent(out) :: trend      !! what is there

         call method%refine(system, s, y, status)
         if (status == 0) call what%at(system, catalogue, method%step%t0 + s*method%step%h, y, ydot, trend, status)
      end subroutine at

   end subroutine find_turn

   !> Where a channel has an extreme: that of the polynomial of degree 4 through five places about it.
   subroutine find_flat_place(system, method, catalogue, what, place, value, y, ydot, status)
      type(mechanism_t), intent(inout) :: system       !! the system
      class(integrator_t), intent(inout) :: method     !! the method after a step
      type(catalogue_t), intent(inout) :: catalogue    !! of its channels
      type(observed_t), intent(in) :: what             !! which number
      real(wp), intent(inout) :: place                 !! in the step, about; then better [1]
      real(wp), intent(out) :: value                   !! the number there [any]
      real(wp), intent(inout), contiguous :: y(:)      !! (n) scratch [any]
      real(wp), intent(inout), contiguous :: ydot(:)   !! (n) scratch [any]
      integer, intent(out) :: status                   !! 0: done

      real(wp) :: a(4), middle, x(-2:2), z
      type(trend_t) :: trend
      integer :: i, k

      value = 0.0_wp
      do k = 1, n_round
         middle = min(1.0_wp - 2.0_wp*spacing, max(2.0_wp*spacing, place))
         do i = -2, 2
            call method%refine(system, middle + i*spacing, y, status)
            if (status == 0) call what%at(system, catalogue, method%step%t0 + (middle + i*spacing)*method%step%h, y, ydot, trend, &
                                          status)
            if (status /= 0) return
            x(i) = trend%value
         end do
         a(1) = (x(-2) - 8.0_wp*x(-1) + 8.0_wp*x(1) - x(2))/12.0_wp
         a(2) = (-x(-2) + 16.0_wp*x(-1) - 30.0_wp*x(0) + 16.0_wp*x(1) - x(2))/24.0_wp
         a(3) = (-x(-2) + 2.0_wp*x(-1) - 2.0_wp*x(1) + x(2))/12.0_wp
         a(4) = (x(-2) - 4.0_wp*x(-1) + 6.0_wp*x(0) - 4.0_wp*x(1) + x(2))/24.0_wp
         z = (place - middle)/spacing
         do i = 1, most_corrections
            associate (slope => a(1) + z*(2.0_wp*a(2) + z*(3.0_wp*a(3) + z*4.0_wp*a(4))), &
                       bend => 2.0_wp*a(2) + z*(6.0_wp*a(3) + z*12.0_wp*a(4)))
               if (.not. abs(bend) > 0.0_wp) exit
               z = min(2.5_wp, max(-2.5_wp, z - slope/bend))
            end associate
         end do
         value = x(0) + z*(a(1) + z*(a(2) + z*(a(3) + z*a(4))))
         place = min(1.0_wp, max(0.0_wp, middle + z*spacing))
      end do
   end subroutine find_flat_place

end module extreme_place
