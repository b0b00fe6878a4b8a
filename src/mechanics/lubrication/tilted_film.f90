!> Films that know aligned journals only, where the journal is tilted: two aligned halves.
submodule(film_law) tilted_film
   implicit none (type, external)

contains

   !> Force and first moment of two aligned halves.
   module procedure film_tilted_force
      type(film_motion_t) :: half(2)
      real(wp) :: half_speed, of_rate, of_tilt, side, two(2, 2), v(2), w(2)
      integer :: k

      call self%halves(parameters, of_tilt, of_rate)
      half_speed = 0.5_wp*motion%speed_sum
      v = squeezing_velocity(motion)
      w = motion%tilt_dot - half_speed*[-motion%tilt(2), motion%tilt(1)]
      do k = 1, 2
         side = real(2*k - 3, wp)
         half(k) = motion
         half(k)%tilt = 0.0_wp
         half(k)%tilt_dot = 0.0_wp
         half(k)%e = motion%e + side*of_tilt*motion%tilt
         half(k)%e_dot = v + side*of_rate*w + half_speed*[-half(k)%e(2), half(k)%e(1)]
      end do
      call self%force(2, half, spread(parameters, 2, 2), two)
      f = 0.5_wp*(two(:, 1) + two(:, 2))
      f_1 = 0.5_wp*of_rate*(two(:, 2) - two(:, 1))
   end procedure film_tilted_force

   !> Places of the halves of a film of finite length.
   module procedure film_halves
      real(wp), parameter :: series_below = 0.02_wp  ! L/D where both parts of b^2 cancel [1]
      real(wp) :: square, x

      x = 0.5_wp*parameters(parameter_length)/parameters(parameter_radius)
      if (x < series_below) then
         square = (1.0_wp + (2.0_wp/5.0_wp - 2.0_wp/21.0_wp)*x**2)/15.0_wp
      else
         square = (1.0_wp/3.0_wp - (x/tanh(x) - 1.0_wp)/x**2)/(1.0_wp - tanh(x)/x)
      end if
      of_rate = sqrt(square)
      of_tilt = of_rate*(2.0_wp - (15.0_wp*square - 1.0_wp)/4.0_wp)
   end procedure film_halves

end submodule tilted_film
