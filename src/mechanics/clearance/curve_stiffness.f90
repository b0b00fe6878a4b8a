!> Normal laws along a curve: parameters fitted to the curvature where the surfaces meet.
!>
!> 1/R_e = kappa + 1/R, kappa positive where the curve is convex, R of a circle; of a face 1/R_e = kappa. A convex place is fitted
!> as a disc of radius 1/kappa beside the circle, a straight or hollow one as a circle of radius R_e on a plane: with Hertz's
!> stiffness both are the same. Parameters that vary are cubic splines over ln R_e.
!>
!> Source: Johnson, Contact mechanics (1985), section 4.2. Limits: laws of cylinders, whose force is not one of R_e alone, fit
!> convex profiles; a point has no R_e, and only laws with a stiffness of their own fit it.
module curve_stiffness
   use curve, only: beyond_stabilisation, curve_t, curve_values
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t, parameter_gentle
   use profile_curve, only: curvature_at, profile_t
   use spline, only: ends_not_a_knot, new_spline
   use surfaces, only: put_beside, shape_face, shape_plane, surfaces_t
   implicit none (type, external)
   private
   public :: fit_curved, law_along_t, parameters_at, put_curved

   integer, parameter :: n_place = 41             !! curvatures that a law is fitted to
   real(wp), parameter :: steady = 1.0e-12_wp     !! change of ln R_e, or of a parameter, that is round-off [1]

   !> The parameters of a law along a curve.
   type :: law_along_t
      logical :: varies = .false.                          !! they change along it
      real(wp) :: reference(n_law_parameter) = 0.0_wp      !! (n_law_parameter) those of the surfaces of the item [any]
      logical :: is_steady(n_law_parameter) = .true.       !! (n_law_parameter) which do not change
      type(curve_t) :: of_radius(n_law_parameter)          !! (n_law_parameter) the others over ln R_e [any]
   end type law_along_t

contains

   !> Surfaces where a curve has a curvature, materials left alone.
   pure subroutine put_curved(pair, radius, is_face, curvature)
      type(surfaces_t), intent(inout) :: pair  !! the pair
      real(wp), intent(in) :: radius           !! R of the circle, 0: a point [m]
      logical, intent(in) :: is_face           !! a face, whose R is infinite
      real(wp), intent(in) :: curvature        !! kappa [1/m]

      real(wp), parameter :: no_material = 1.0_wp  ! compliance of a point, which no stiffness comes of [1/Pa]

      if (is_face) then
         pair%shape = shape_plane
         pair%radius_j = 1.0_wp/curvature
      else if (.not. radius > 0.0_wp) then
         pair%shape = shape_face
         pair%sigma_i = no_material
         pair%sigma_j = no_material
      else if (curvature > 0.0_wp) then
         call put_beside(pair, 1.0_wp/curvature, radius)
      else
         pair%shape = shape_plane
         pair%radius_j = 1.0_wp/(curvature + 1.0_wp/radius)
      end if
   end subroutine put_curved

   !> Fit a law to the curvatures of a curve.
   subroutine fit_curved(law, reference, pair, profile, radius, along)
      class(normal_law_t), intent(in) :: law                     !! the law
      real(wp), intent(in) :: reference(n_law_parameter)         !! (n_law_parameter) fitted to the pair [any]
      type(surfaces_t), intent(in) :: pair                       !! the surfaces of the item
      type(profile_t), intent(in) :: profile                     !! the curve, with nodes
      real(wp), intent(in) :: radius                             !! R of the circle, 0: a point or a face [m]
      type(law_along_t), intent(out) :: along                    !! parameters along the curve

      character(:), allocatable :: help, message
      real(wp) :: inverse(size(profile%u)), parameters(n_law_parameter, n_place), place(n_place), scale
      integer :: k
      type(surfaces_t) :: local

      along%reference = reference
      if (pair%shape == shape_face) return
      do k = 1, size(profile%u)
         inverse(k) = inverse_radius(radius, curvature_at(profile, profile%u(k)))
      end do
      place = -log(maxval(inverse)) + log(maxval(inverse)/minval(inverse))*[(real(k, wp)/(n_place - 1), k=0, n_place - 1)]
      if (place(n_place) - place(1) <= steady) return
      do k = 1, n_place
         local = pair
         call put_curved(local, radius, .not. radius > 0.0_wp, exp(-place(k)) - inverse_radius(radius, 0.0_wp))
         call law%fit(local, parameters(:, k), message, help)
      end do
      parameters(parameter_gentle, :) = reference(parameter_gentle)
      do k = 1, n_law_parameter
         scale = maxval(abs(parameters(k, :)))
         along%is_steady(k) = maxval(parameters(k, :)) - minval(parameters(k, :)) <= steady*scale
         if (.not. along%is_steady(k)) call new_spline(place, parameters(k, :), ends_not_a_knot, beyond_stabilisation, &
                                                       along%of_radius(k))
      end do
      along%varies = .not. all(along%is_steady)
   end subroutine fit_curved

   !> 1/R_e.
   pure real(wp) function inverse_radius(radius, curvature) result(inverse)
      real(wp), intent(in) :: radius     !! R of the circle, 0: a face [m]
      real(wp), intent(in) :: curvature  !! kappa [1/m]

      inverse = curvature
      if (radius > 0.0_wp) inverse = inverse + 1.0_wp/radius
   end function inverse_radius

   !> Parameters at a curvature.
   pure function parameters_at(along, radius, curvature) result(parameters)
      type(law_along_t), intent(in) :: along      !! parameters along the curve
      real(wp), intent(in) :: radius              !! R of the circle, 0: a face [m]
      real(wp), intent(in) :: curvature           !! kappa [1/m]
      real(wp) :: parameters(n_law_parameter)     !! (n_law_parameter) those of the law [any]

      real(wp) :: f(3), place
      integer :: k

      parameters = along%reference
      place = -log(max(inverse_radius(radius, curvature), tiny(1.0_wp)))
      do k = 1, n_law_parameter
         if (along%is_steady(k)) cycle
         call curve_values(along%of_radius(k), place, f)
         parameters(k) = f(1)
      end do
   end function parameters_at

end module curve_stiffness
