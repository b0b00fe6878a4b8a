!> Physical dimensions of numbers.
module dimensions
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: dim_acceleration, dim_angle, dim_angular_acceleration, dim_angular_damping, dim_angular_speed
   public :: dim_angular_stiffness, dim_area, dim_contact_stiffness, dim_damping, dim_density, dim_energy
   public :: dim_force, dim_frequency, dim_inertia, dim_length, dim_mass, dim_moment, dim_none, dim_power
   public :: dim_pressure, dim_speed, dim_stiffness, dim_t, dim_temperature, dim_time, dim_viscosity
   public :: same_dimension

   !> Physical dimension as exponents of kg, m, s, rad, K and A.
   !> They are real because a contact stiffness is N/m^1.5, or N/m^n with any n.
   !> An angle is a dimension of its own, so that `5 s^-1` and `5 rad/s` are not confused; a moment
   !> is N.m, and radians are dropped where mechanics drops them (arc length is radius times angle).
   type :: dim_t
      real(wp) :: kg = 0.0_wp   !! exponent of mass [1]
      real(wp) :: m = 0.0_wp    !! exponent of length [1]
      real(wp) :: s = 0.0_wp    !! exponent of time [1]
      real(wp) :: rad = 0.0_wp  !! exponent of plane angle [1]
      real(wp) :: k = 0.0_wp    !! exponent of temperature [1]
      real(wp) :: a = 0.0_wp    !! exponent of electric current [1]
   end type dim_t

   type(dim_t), parameter :: dim_none = dim_t()
   type(dim_t), parameter :: dim_mass = dim_t(kg=1)
   type(dim_t), parameter :: dim_length = dim_t(m=1)
   type(dim_t), parameter :: dim_area = dim_t(m=2)
   type(dim_t), parameter :: dim_time = dim_t(s=1)
   type(dim_t), parameter :: dim_frequency = dim_t(s=-1)
   type(dim_t), parameter :: dim_angle = dim_t(rad=1)
   type(dim_t), parameter :: dim_angular_speed = dim_t(rad=1, s=-1)
   type(dim_t), parameter :: dim_speed = dim_t(m=1, s=-1)
   type(dim_t), parameter :: dim_acceleration = dim_t(m=1, s=-2)
   type(dim_t), parameter :: dim_inertia = dim_t(kg=1, m=2)
   type(dim_t), parameter :: dim_force = dim_t(kg=1, m=1, s=-2)
   type(dim_t), parameter :: dim_moment = dim_t(kg=1, m=2, s=-2)
   type(dim_t), parameter :: dim_energy = dim_t(kg=1, m=2, s=-2)
   type(dim_t), parameter :: dim_power = dim_t(kg=1, m=2, s=-3)
   type(dim_t), parameter :: dim_pressure = dim_t(kg=1, m=-1, s=-2)
   type(dim_t), parameter :: dim_density = dim_t(kg=1, m=-3)
   type(dim_t), parameter :: dim_angular_acceleration = dim_t(rad=1, s=-2)
   type(dim_t), parameter :: dim_stiffness = dim_t(kg=1, s=-2)
   type(dim_t), parameter :: dim_damping = dim_t(kg=1, s=-1)
   type(dim_t), parameter :: dim_angular_stiffness = dim_t(kg=1, m=2, s=-2, rad=-1)
   type(dim_t), parameter :: dim_angular_damping = dim_t(kg=1, m=2, s=-1, rad=-1)
   type(dim_t), parameter :: dim_contact_stiffness = dim_t(kg=1, m=-0.5_wp, s=-2)
   type(dim_t), parameter :: dim_viscosity = dim_t(kg=1, m=-1, s=-1)
   type(dim_t), parameter :: dim_temperature = dim_t(k=1)

contains

   !> Whether two dimensions are the same.
   pure logical function same_dimension(a, b)
      type(dim_t), intent(in) :: a  !! one dimension
      type(dim_t), intent(in) :: b  !! the other

      real(wp), parameter :: close = 1.0e-9_wp  !! exponents nearer than this are the same [1]

      same_dimension = abs(a%kg - b%kg) < close .and. abs(a%m - b%m) < close .and. abs(a%s - b%s) < close &
                     & .and. abs(a%rad - b%rad) < close .and. abs(a%k - b%k) < close &
                     & .and. abs(a%a - b%a) < close
   end function same_dimension

end module dimensions
