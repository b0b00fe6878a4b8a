!> Round-off of penetrations and of their rates: small differences of the coordinates and velocities of two bodies.
!>
!> r = c eps (|r_i| + |r_j| + (1 + |phi_i|) l_i + (1 + |phi_j|) l_j + s),   l how far surfaces are from the centres of mass, phi the
!> angles: cosines of an angle that counts turns are as inexact as its last digit. s is what other bodies hand on through joints.
!> Of the rates: c eps (|v_i| + |v_j| + |w_i| (|r_j - r_i| + l_i) + |w_j| l_j), and where the normal is the direction of an
!> eccentricity, these velocities times r over the clearance.
!>
!> Source: N. J. Higham, Accuracy and Stability of Numerical Algorithms (2002), section 3.1, the constants of a dozen operations
!> gathered in c. Limits: bounds of what an evaluation rounds, not of what a motion has gathered.
module gap_noise
   use clearance_set, only: clearance_set_t
   use kinds, only: eps, wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: find_gap_noise

   real(wp), parameter :: operations = 8.0_wp  !! c: round-offs that may add up [1]

contains

   !> Bounds for all contacts of a set.
   pure subroutine find_gap_noise(set, motion, shared, noise, rate_noise)
      class(clearance_set_t), intent(in) :: set  !! the set
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(in) :: shared             !! s: lengths that joints hand on to all bodies [m]
      real(wp), intent(out) :: noise(:)          !! (n_contact) of penetrations [m]
      real(wp), intent(out) :: rate_noise(:)     !! (n_contact) of their rates [m/s]

      real(wp) :: span(2), speed
      integer :: item, k

      do k = 1, set%n_contact
         item = set%item_of(k)
         span = set%span_of(k)
         associate (i => set%items%body(1, item), j => set%items%body(2, item))
            noise(k) = operations*eps*(abs(motion%r(1, i)) + abs(motion%r(2, i)) + abs(motion%r(1, j)) + abs(motion%r(2, j)) &
                                       + abs(motion%r(3, i)) + abs(motion%r(3, j)) &
                                       + (1.0_wp + abs(motion%angle(i)))*span(1) + (1.0_wp + abs(motion%angle(j)))*span(2) &
                                       + shared)
            speed = abs(motion%v(1, i)) + abs(motion%v(2, i)) + abs(motion%v(1, j)) + abs(motion%v(2, j)) &
                    + abs(motion%v(3, i)) + abs(motion%v(3, j)) &
                    + sum(abs(motion%omega(:, j)))*span(2) + sum(abs(motion%omega(:, i))) &
                    *(abs(motion%r(1, j) - motion%r(1, i)) + abs(motion%r(2, j) - motion%r(2, i)) &
                      + abs(motion%r(3, j) - motion%r(3, i)) + span(1))
            rate_noise(k) = operations*eps*speed
            if (set%traits%is_round) rate_noise(k) = rate_noise(k) + speed*noise(k)/set%items%pairs(item)%clearance
         end associate
      end do
   end subroutine find_gap_noise

end module gap_noise
