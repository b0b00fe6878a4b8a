!> A long side of a slider at a surface: how its two corners share the force of a face. See `clearance_translational`.
!>
!> Penetrations d_1, d_2 at the ends of a side, x the place of the resultant over the length, from corner 1:
!> both positive   d = (d_1 + d_2)/2,          x = (d_1 + 2 d_2) / (3 (d_1 + d_2)),   U = K (d_1^2 + d_1 d_2 + d_2^2)/6
!> only d_1        d = d_1 l/2,  l = d_1/(d_1 - d_2),   x = l/3,                        U = K d_1^2 l/6
!> The force K d has the shares 1 - x and x at the corners, which are the derivatives of U by d_1 and d_2.
!>
!> Source: Flores et al. (2008), (4.26), (4.27): the centroid of the penetrating area is the resultant of a linear foundation.
module slider_faces
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t
   implicit none (type, external)
   private
   public :: bedding_energy, blend_energy, find_blend, find_face

contains

   !> Resultant of springs under the part of a side that penetrates.
   pure subroutine find_bedding(d, depth, x)
      real(wp), intent(in) :: d(2)     !! (2) penetrations of the corners [m]
      real(wp), intent(out) :: depth   !! mean penetration over the whole length [m]
      real(wp), intent(out) :: x       !! place of the resultant, from corner 1, over the length [1]

      depth = 0.0_wp
      x = 0.5_wp
      if (maxval(d) <= 0.0_wp) return
      if (minval(d) >= 0.0_wp) then
         depth = 0.5_wp*(d(1) + d(2))
         x = (d(1) + 2.0_wp*d(2))/(3.0_wp*(d(1) + d(2)))
      else if (d(1) > 0.0_wp) then
         x = d(1)/(3.0_wp*(d(1) - d(2)))
         depth = 1.5_wp*d(1)*x
      else
         x = d(2)/(3.0_wp*(d(2) - d(1)))
         depth = 1.5_wp*d(2)*x
         x = 1.0_wp - x
      end if
   end subroutine find_bedding

   !> Energy of these springs.
   pure real(wp) function bedding_energy(law, parameters, d) result(energy)
      class(normal_law_t), intent(in) :: law               !! face law, linear
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the face law [any]
      real(wp), intent(in) :: d(2)                         !! (2) penetrations of the corners [m]

      real(wp) :: stiffness

      energy = 0.0_wp
      if (maxval(d) <= 0.0_wp) return
      stiffness = 2.0_wp*law%potential(1.0_wp, parameters)
      if (minval(d) >= 0.0_wp) then
         energy = stiffness*(d(1)**2 + d(1)*d(2) + d(2)**2)/6.0_wp
      else
         energy = stiffness*maxval(d)**3/(6.0_wp*abs(d(1) - d(2)))
      end if
   end function bedding_energy

   !> Forces of a face at its corners, and their elastic parts.
   subroutine find_face(law, parameters, d, rate, impact_speed, f, f_elastic)
      class(normal_law_t), intent(in) :: law               !! face law, linear
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the face law [any]
      real(wp), intent(in) :: d(2)                         !! (2) penetrations of the corners [m]
      real(wp), intent(in) :: rate(2)                      !! (2) their rates [m/s]
      real(wp), intent(in) :: impact_speed(2)              !! (2) rates at their onsets [m/s]
      real(wp), intent(out) :: f(2)                        !! (2) normal forces at the corners [N]
      real(wp), intent(out) :: f_elastic(2)                !! (2) elastic parts [N]

      real(wp) :: depth, elastic(1), slope_delta(1), slope_rate(1), speed, total(1), weight(2), x

      call find_bedding(d, depth, x)
      weight = max(d, 0.0_wp)
      speed = 1.0_wp
      if (sum(weight) > 0.0_wp) speed = sum(weight*impact_speed)/sum(weight)
      call law%force(1, [depth], [(1.0_wp - x)*rate(1) + x*rate(2)], [speed], parameters, total, slope_delta, slope_rate, elastic)
      f = total(1)*[1.0_wp - x, x]
      f_elastic = elastic(1)*[1.0_wp - x, x]
   end subroutine find_face

   !> Weight of the face in the blend, S(r) with r the lesser penetration over the greater, and its derivatives.
   pure subroutine find_weight(d, weight, by_d)
      real(wp), intent(in) :: d(2)      !! (2) penetrations of the corners [m]
      real(wp), intent(out) :: weight   !! of the face [1]
      real(wp), intent(out) :: by_d(2)  !! (2) derivatives by the penetrations [1/m]

      real(wp) :: r
      integer :: k

      weight = 0.0_wp
      by_d = 0.0_wp
      if (minval(d) <= 0.0_wp) return
      k = minloc(d, dim=1)
      r = d(k)/d(3 - k)
      weight = r*r*(3.0_wp - 2.0_wp*r)
      by_d(k) = 6.0_wp*r*(1.0_wp - r)/d(3 - k)
      by_d(3 - k) = -by_d(k)*r
   end subroutine find_weight

   !> Blend the forces of two corners, given, with those of the face.
   subroutine find_blend(law, parameters, d, rate, impact_speed, corner_energy, f, f_elastic)
      class(normal_law_t), intent(in) :: law               !! face law, linear
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the face law [any]
      real(wp), intent(in) :: d(2)                         !! (2) penetrations of the corners [m]
      real(wp), intent(in) :: rate(2)                      !! (2) their rates [m/s]
      real(wp), intent(in) :: impact_speed(2)              !! (2) rates at their onsets [m/s]
      real(wp), intent(in) :: corner_energy                !! elastic energy of the two corners [J]
      real(wp), intent(inout) :: f(2)                      !! (2) normal forces at the corners [N]
      real(wp), intent(inout) :: f_elastic(2)              !! (2) derivatives of the elastic energy [N]

      real(wp) :: by_d(2), face(2), face_elastic(2), weight

      call find_weight(d, weight, by_d)
      call find_face(law, parameters, d, rate, impact_speed, face, face_elastic)
      f = (1.0_wp - weight)*f + weight*face
      f_elastic = (1.0_wp - weight)*f_elastic + weight*face_elastic &
                  + by_d*(bedding_energy(law, parameters, d) - corner_energy)
   end subroutine find_blend

   !> Elastic energy of the blend.
   pure real(wp) function blend_energy(law, parameters, d, corner_energy) result(energy)
      class(normal_law_t), intent(in) :: law               !! face law, linear
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the face law [any]
      real(wp), intent(in) :: d(2)                         !! (2) penetrations of the corners [m]
      real(wp), intent(in) :: corner_energy                !! elastic energy of the two corners [J]

      real(wp) :: by_d(2), weight

      call find_weight(d, weight, by_d)
      energy = (1.0_wp - weight)*corner_energy + weight*bedding_energy(law, parameters, d)
   end function blend_energy

end module slider_faces
