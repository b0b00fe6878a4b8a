!> What a study of modes asks for and finds.
module modes_results
   use kinds, only: not_a_number, two_pi, wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: at_equilibrium, at_steady, at_time, campbell_point_t, input_driver, input_force, input_moment, linear_model_t
   public :: frequency_of, no_growth, ratio_of
   public :: mode_t, modes_input_t, modes_output_t, modes_plan_t, modes_study_t, onset_t, state_names

   integer, parameter :: at_equilibrium = 1   !! the static equilibrium; with films the steady state
   integer, parameter :: at_steady = 2        !! a steady motion
   integer, parameter :: at_time = 3          !! an instant of the motion
   character(*), parameter :: state_names(3) = [character(11) :: "equilibrium", "steady", "time"]   !! as in a deck

   integer, parameter :: input_force = 1    !! a force on a point
   integer, parameter :: input_moment = 2   !! a moment on a body
   integer, parameter :: input_driver = 3   !! what a driver adds to its displacement, and the rates of that

   real(wp), parameter :: no_growth = 1.0e-9_wp   !! real part without growth or decay, over the maximum eigenvalue [1]

   !> An input.
   type :: modes_input_t
      character(:), allocatable :: name    !! as in the deck
      integer :: kind = 0                  !! one of the above
      integer :: body = 0                  !! of a load
      integer :: axis = 0                  !! of a load: 1, 2, 3
      real(wp) :: arm(3) = 0.0_wp          !! (3) of a force, body frame [m]
      integer :: row = 0                   !! of a driver: its row, once the mechanism is made
      logical :: is_angle = .false.        !! of a driver: its row is an angle
   end type modes_input_t

   !> An output.
   type :: modes_output_t
      character(:), allocatable :: name        !! of the channel and its component
      character(:), allocatable :: unit        !! SI
      integer :: item_group = 0                !! of the catalogue
      character(:), allocatable :: channel     !! the quantity
      integer :: item = 0, component = 0       !! item of the group, component of the quantity
   end type modes_output_t

   !> What is asked for.
   type :: modes_plan_t
      integer :: at = at_equilibrium                       !! one of the above
      real(wp) :: time = 0.0_wp                            !! of the instant [s]
      integer :: axes = 0                                  !! body in whose axes motions are resolved, 0: the world's
      character(:), allocatable :: axes_name               !! its name, or world
      type(modes_input_t), allocatable :: inputs(:)        !! (n) inputs
      type(modes_output_t), allocatable :: outputs(:)      !! (n) outputs
      character(:), allocatable :: parameter               !! of the Campbell diagram; blank: none
      character(:), allocatable :: unit                    !! of the parameter, SI
      real(wp) :: from = 0.0_wp, to = 0.0_wp               !! its range [any]
      integer :: n_point = 0                               !! its values
   end type modes_plan_t

   !> A mechanism linearised at a state: z' = A z + B u, y = C z + D u.
   type :: linear_model_t
      integer :: n_free = 0                           !! degrees of freedom; as many speeds follow their displacements in z
      integer :: n_state = 0                          !! states
      real(wp), allocatable :: a(:, :), b(:, :)       !! (states, states or inputs) A and B [any]
      real(wp), allocatable :: c(:, :), d(:, :)       !! (outputs, states or inputs) C and D [any]
      real(wp), allocatable :: direction(:, :)        !! (rates, freedoms) local displacements of the first states [any]
      real(wp), allocatable :: mass(:)                !! (rates) [kg or kg.m^2]
      type(text_t), allocatable :: others(:)          !! (any) names of the states after displacements and speeds
      type(text_t), allocatable :: inputs(:)          !! (inputs) their names, of drivers three each
      type(text_t), allocatable :: input_units(:)     !! (inputs) SI
      real(wp) :: residual = 0.0_wp                   !! free acceleration over that of the loads alone [1]
      real(wp), allocatable :: rest(:)                !! (freedoms) free accelerations, in the metric of the masses [any]
      real(wp) :: unsteady = 0.0_wp                   !! as of `motion_frame` [1]
      integer :: moving = 0                           !! of `others` that whose rate is the greatest; 0: all are at rest
   end type linear_model_t

   !> A mode.
   type :: mode_t
      complex(wp) :: eigenvalue = (0.0_wp, 0.0_wp)     !! of a pair that with the positive imaginary part [1/s]
      real(wp) :: frequency = 0.0_wp                   !! |lambda|/(2 pi) of a pair, 0 of a real one [Hz]
      real(wp) :: damping_ratio = 0.0_wp               !! -re/|lambda|; NaN where that is zero [1]
      real(wp), allocatable :: share(:, :)             !! (n_v, bodies) of the kinetic energy [1]
      complex(wp), allocatable :: shape(:, :)          !! (n_v, bodies) local displacements, the greatest share real [m or rad]
   end type mode_t

   !> The modes at a value of the parameter.
   type :: campbell_point_t
      real(wp) :: p = 0.0_wp                           !! the value [any]
      complex(wp), allocatable :: eigenvalues(:)       !! (n) of modes, in the order of the branches [1/s]
      integer, allocatable :: branch(:)                !! (n) their branches
   end type campbell_point_t

   !> A value at which a mode becomes unstable, or stable.
   type :: onset_t
      real(wp) :: p = 0.0_wp                           !! of the parameter [any]
      complex(wp) :: eigenvalue = (0.0_wp, 0.0_wp)     !! there [1/s]
      logical :: is_loss = .false.                     !! stable below it, unstable above
   end type onset_t

   !> What was found.
   type :: modes_study_t
      type(modes_plan_t) :: plan                       !! what was asked for
      character(:), allocatable :: state               !! words on the state
      real(wp) :: t = 0.0_wp                           !! its time [s]
      integer :: n_body = 0                            !! bodies
      type(text_t), allocatable :: bodies(:)           !! (bodies) names
      type(text_t), allocatable :: components(:)       !! (n_v) names of directions
      type(linear_model_t) :: model                    !! the matrices
      type(mode_t), allocatable :: modes(:)            !! (n) by frequency
      type(campbell_point_t), allocatable :: points(:) !! (n) of the diagram
      type(onset_t), allocatable :: onsets(:)          !! (n) changes of stability in it
      type(text_t), allocatable :: warnings(:)         !! (n) what was noticed
   end type modes_study_t

contains

   !> Natural frequency of an eigenvalue; 0 of a real one.
   elemental real(wp) function frequency_of(value) result(frequency)
      complex(wp), intent(in) :: value            !! the eigenvalue [1/s]

      frequency = 0.0_wp
      if (abs(value%im) > 0.0_wp) frequency = abs(value)/two_pi
   end function frequency_of

   !> Damping ratio of an eigenvalue; NaN of zero.
   elemental real(wp) function ratio_of(value) result(ratio)
      complex(wp), intent(in) :: value            !! the eigenvalue [1/s]

      ratio = not_a_number()
      if (abs(value) > 0.0_wp) ratio = (0.0_wp - value%re)/abs(value)  ! never -0
   end function ratio_of

end module modes_results
