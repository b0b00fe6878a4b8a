!> Stiffness and damping of a film: differences of its force.
submodule(film_law) film_differences
   implicit none (type, external)

contains

   !> Stiffness and damping at a motion.
   module procedure film_linearise
      real(wp), parameter :: part = 1.0e-3_wp  ! of the longer step [1]
      real(wp) :: coarse(2, 2, 2), gap, speed, v(2)
      integer :: k

      associate (c => parameters(parameter_clearance))
         gap = c - min(norm2(motion%e), c*parameters(parameter_eps_max))
         v = squeezing_velocity(motion)
         speed = max(norm2(v), 0.05_wp*c*abs(motion%speed_sum))
         if (.not. speed > 0.0_wp) speed = c
         speed = speed*gap/c
      end associate
      do k = 1, 2
         coarse(:, k, 1) = film_slope(self, motion, parameters, k, part*gap, 0.0_wp)
         coarse(:, k, 2) = film_slope(self, motion, parameters, k, 0.0_wp, part*speed)
         slopes%stiffness(:, k) = -film_slope(self, motion, parameters, k, 0.5_wp*part*gap, 0.0_wp)
         slopes%damping(:, k) = -film_slope(self, motion, parameters, k, 0.0_wp, 0.5_wp*part*speed)
      end do
      slopes%error = max(difference(coarse(:, :, 1), slopes%stiffness), difference(coarse(:, :, 2), slopes%damping))

   contains

      !> What two results differ by, as a part of the maximum entry; one of them has the other sign.
      pure real(wp) function difference(a, b)
         real(wp), intent(in) :: a(2, 2), b(2, 2)  !! (2, 2) the results [any]

         difference = maxval(abs(a + b))/max(maxval(abs(b)), tiny(1.0_wp))
      end function difference

   end procedure film_linearise

   !> Derivative of the force over one component of the eccentricity, or of its rate.
   function film_slope(self, motion, parameters, component, step_e, step_e_dot) result(slope)
      class(film_law_t), intent(in) :: self                    !! the film
      type(film_motion_t), intent(in) :: motion                !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)     !! (n_film_parameter) from `fit` [any]
      integer, intent(in) :: component                         !! 1: x; 2: y
      real(wp), intent(in) :: step_e                           !! step of the eccentricity, or zero [m]
      real(wp), intent(in) :: step_e_dot                       !! step of its rate, or zero [m/s]
      real(wp) :: slope(2)                                     !! (2) derivative [N/m or N.s/m]

      real(wp), parameter :: place(4) = [-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]  ! in steps [1]
      real(wp), parameter :: weight(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/12.0_wp  ! of the forces there [1]
      type(film_motion_t) :: moved(1)
      real(wp) :: f(2, 1)
      integer :: k

      slope = 0.0_wp
      do k = 1, size(place)
         moved(1) = motion
         moved(1)%e(component) = moved(1)%e(component) + place(k)*step_e
         moved(1)%e_dot(component) = moved(1)%e_dot(component) + place(k)*step_e_dot
         call self%force(1, moved, reshape(parameters, [n_film_parameter, 1]), f)
         slope = slope + weight(k)*f(:, 1)
      end do
      slope = slope/(step_e + step_e_dot)
   end function film_slope

end submodule film_differences
