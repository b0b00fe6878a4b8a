!> What a film on a grid does: force, couple of a tilt, side flow, friction, maximum pressure, minimum film.
!>
!> With scales: forces mu L R^3/c^2, flow c R^3/(3 L), friction mu L R^3/c; P in 1/s, so that forces and flow are per unit of time.
!> The moment of friction on the journal is -(mu L R^3/c) (w_J - w_B) J - (e x F)_z/2, J = (1/2) int d(theta) dy/h over the
!> part of the film that is liquid: over all of it, or where there is pressure. A bore that is not round adds the pressure on its
!> slopes, f_G = (1/2) int P dG d(y), see `reynolds_grid`: the moment on the journal has c/2 mu L R^3/c^2 f_G more.
module reynolds_results
   use kinds, only: wp
   use reynolds_grid, only: drag, reynolds_grid_t
   implicit none (type, external)
   private
   public :: film_result_t, get_result

   !> What a film does, in the bearing's frame.
   type :: film_result_t
      real(wp) :: f(2) = 0.0_wp       !! (2) force on the journal over mu L R^3/c^2 [1/s]
      real(wp) :: f_1(2) = 0.0_wp     !! (2) its moment along the length, over half of it [1/s]
      real(wp) :: side_flow = 0.0_wp  !! flow out of both ends over c R^3/(3 L) [1/s]
      real(wp) :: shear_all = 0.0_wp  !! J of a gap that is full all round [1]
      real(wp) :: shear_wet = 0.0_wp  !! J of the part with pressure [1]
      real(wp) :: p_max = 0.0_wp !! maximum P [1/s]
      real(wp) :: h_min = 0.0_wp    !! minimum gap over c [1]
      real(wp) :: f_bore = 0.0_wp   !! f_G [1/s]
   end type film_result_t

contains

   !> The results of the solution that the grid holds.
   pure subroutine get_result(self, result)
      class(reynolds_grid_t), intent(in) :: self  !! the grid
      type(film_result_t), intent(out) :: result  !! its results

      real(wp) :: area, gap, middle, part, push, step, u(2), y
      integer :: j, k, m

      m = self%film%m
      part = merge(0.5_wp, 1.0_wp, self%is_whole)
      associate (p => self%film%p, e => self%state%e, g => self%state%g)
         do k = 1, self%film%n
            step = self%theta(k) - self%theta(k - 1)
            middle = 0.5_wp*(self%theta(k) + self%theta(k - 1))
            u = [cos(middle), sin(middle)]
            do j = 1, m
               y = 0.5_wp*(self%y(j) + self%y(j - 1))
               push = p(j, k)*self%weight(j)*2.0_wp*sin(0.5_wp*step)*part
               result%f = result%f - push*u
               result%f_1 = result%f_1 - push*y*u
               gap = 1.0_wp - dot_product(e + y*g, u)
               area = (self%y(j) - self%y(j - 1))*step*part
               result%shear_all = result%shear_all + area/gap
               if (p(j, k) > 0.0_wp) result%shear_wet = result%shear_wet + area/gap
            end do
            result%side_flow = result%side_flow + end_flow(self, m, k)
            if (self%is_whole) result%side_flow = result%side_flow + end_flow(self, 1, k)
         end do
         result%side_flow = part*result%side_flow
         if (.not. self%is_whole) result%f_1 = 0.0_wp
         result%p_max = maxval(p)
         result%h_min = 1.0_wp - max(norm2(e + g), norm2(e - g))
         if (self%bored%is_there) call add_bore(self, part, result)
         if (self%bored%is_there) result%h_min = min(self%bored%bore%min_gap(e + g, self%state%per_clearance), &
                                                     self%bored%bore%min_gap(e - g, self%state%per_clearance))
      end associate
   end subroutine get_result

   !> Shear in the gap of a bore that is not round, and the pressure on its slopes.
   pure subroutine add_bore(self, part, result)
      class(reynolds_grid_t), intent(in) :: self     !! the grid
      real(wp), intent(in) :: part                   !! of the cells in the mean over the length [1]
      type(film_result_t), intent(inout) :: result   !! shear and f_bore are set

      real(wp) :: shear
      integer :: j, k

      result%shear_all = 0.0_wp
      result%shear_wet = 0.0_wp
      do k = 1, self%film%n
         do j = 1, self%film%m
            shear = part*(self%y(j) - self%y(j - 1))*(self%theta(k) - self%theta(k - 1)) &
                    /self%gap(j, k, 0.5_wp*(self%y(j) + self%y(j - 1)))
            result%shear_all = result%shear_all + shear
            if (self%film%p(j, k) > 0.0_wp) result%shear_wet = result%shear_wet + shear
            result%f_bore = result%f_bore + part*self%weight(j)*bore_push(self, j, k)
         end do
      end do
   end subroutine add_bore

   !> Pressure on the rise of the bore in a cell, and on the step behind it.
   pure real(wp) function bore_push(self, j, k) result(push)
      class(reynolds_grid_t), intent(in) :: self  !! the grid
      integer, intent(in) :: j, k                 !! row and column

      associate (p => self%film%p, next => modulo(k, self%film%n) + 1)
         push = p(j, k)*self%bored%rise(j, k) &
                + self%bored%step_push(j, k, [p(j, k), p(j, next)], 0.5_wp*drag*self%state%spin*self%weight(j), self%film%is_full)
      end associate
   end function bore_push

   !> Flow out of the end of a column, int h^3 |dP/dy| d(theta): what the end row hands on, and the part of its source that is not
   !> in it.
   pure real(wp) function end_flow(self, j, k)
      class(reynolds_grid_t), intent(in) :: self  !! the grid
      integer, intent(in) :: j                    !! row at the end
      integer, intent(in) :: k                    !! the column

      real(wp) :: end, gap, middle, rest, u(2)

      end_flow = 0.0_wp
      if (.not. abs(self%film%p(j, k)) > 0.0_wp) return
      associate (theta => self%theta(k - 1:k), y => self%y(j - 1:j))
         middle = 0.5_wp*(theta(1) + theta(2))
         u = [cos(middle), sin(middle)]
         end = merge(y(1), y(2), j == 1 .and. self%is_whole)
         gap = 1.0_wp - dot_product(self%state%e + end*self%state%g, u)
         rest = self%ratio**2*drag*dot_product(self%state%v + end*self%state%w, u)*(y(2) - y(1) - self%weight(j))
         if (self%bored%is_there) then
            gap = self%gap(j, k, end)
            rest = self%ratio**2*drag*self%source_at(j, k, end)*(y(2) - y(1) - self%weight(j))
         end if
         end_flow = (gap**3*self%film%p(j, k)/(0.5_wp*(y(2) - y(1))) + rest)*(theta(2) - theta(1))
      end associate
   end function end_flow

end module reynolds_results
