!> The contracts of bodies that are omitted of the unknowns: those whose motion is a known function of time, and those with one
!> coordinate.
!>
!> A prescribed body is tied to the ground or to a prescribed body by a driven joint that leaves a turn, or by a rigid one. Its
!> coordinates leave the unknowns, and the rows that fix it, as many as it has rates, leave the equations. Their multipliers come
!> back by inverse dynamics, body by body from the last to the first:
!>
!> Phi_b^T lambda = g_b - M_b a_b - ( Phi^T lambda of all other rows )_b.
!>
!> A body with one degree of freedom is tied to the ground or to a prescribed body by one joint that leaves a turn or a way along an
!> axis, and by nothing else: one coordinate describes it. The rows of the joint leave the equations; their multipliers are the
!> least-squares solution of Phi_q^T lambda = g - M a in the metric of the masses, which is exact: the right-hand side has no part
!> along the freedom.
!>
!> Signs: as the rows of the joints; the reaction on a body is -Phi_q^T lambda.
!> Source: Flores et al. (2008), eqs. (2.1), (2.14), in the coordinates of the joints. Limits: those of the space, which has the
!> kernels.
module reduced_bodies
   use coordinates, only: most_rates
   use joint_set, only: joint_slot_t
   use kinds, only: wp
   use motion, only: motion_t
   use rows, only: rows_t
   implicit none (type, external)
   private
   public :: one_dof_bodies_t, held_t, prescribed_bodies_t

   !> How a body is held.
   type :: held_t
      integer :: body = 0             !! the body
      integer :: base = 0             !! what it is tied to, 0: the ground
      integer :: side = 0             !! side of the body in the rows that hold it, 1: i, 2: j
      integer :: row(most_rates) = 0  !! rows that hold it, as many as there are
      integer :: slot = 0             !! set of its driver, 0: none
      integer :: item = 0             !! item of the driver
   end type held_t

   !> Bodies of known motion, each after the body that it is tied to.
   type, abstract :: prescribed_bodies_t
      integer :: n = 0                          !! number of prescribed bodies
      type(held_t), allocatable :: held(:)      !! (n) how they are held
      real(wp) :: t = -huge(1.0_wp)             !! time of the motion that is set [s]
      logical :: is_finite = .true.             !! whether that motion is finite numbers
   contains
      procedure(prescribed_move_interface), deferred :: move
      procedure(prescribed_power_interface), deferred, nopass :: power
      procedure(prescribed_multipliers_interface), deferred, nopass :: find_multipliers
   end type prescribed_bodies_t

   !> Bodies with one coordinate: those that turn, then those that slide.
   type, abstract :: one_dof_bodies_t
      integer :: n = 0                          !! number of bodies with one degree of freedom
      integer :: n_turning = 0                  !! those of them that turn, the first ones
      type(held_t), allocatable :: held(:)      !! (n) how they are held
   contains
      procedure(one_dof_move_interface), deferred :: move
      procedure(one_dof_rates_interface), deferred :: rates
      procedure(one_dof_response_interface), deferred :: response
      procedure(one_dof_acceleration_interface), deferred :: set_acceleration
      procedure(one_dof_coordinates_interface), deferred :: read_coordinates
      procedure(one_dof_multipliers_interface), deferred :: find_multipliers
   end type one_dof_bodies_t

   abstract interface
      !> Positions, velocities and accelerations of the prescribed bodies at a time; nothing to do if that is their present time.
      subroutine prescribed_move_interface(self, joints, t, motion)
         import :: joint_slot_t, prescribed_bodies_t, motion_t, wp
         implicit none (type, external)
         class(prescribed_bodies_t), intent(inout) :: self             !! the bodies
         type(joint_slot_t), intent(in), contiguous :: joints(:)  !! (sets) joints and drivers
         real(wp), intent(in) :: t                                !! time [s]
         type(motion_t), intent(inout) :: motion                  !! the motion of the prescribed bodies is set
      end subroutine prescribed_move_interface

      !> Power that the drivers of prescribed bodies give to the mechanism, with the bodies that they guide counted among them. The
      !> rows that fix these bodies are fulfilled, so that it is lambda^T Phi_t = -lambda^T Phi_q v: what accelerates the bodies and
      !> what the solved rows take from them, times their speed.
      pure real(wp) function prescribed_power_interface(driven, rows, mass, g, lambda, motion) result(power)
         import :: motion_t, rows_t, wp
         implicit none (type, external)
         integer, intent(in), contiguous :: driven(:)        !! the prescribed bodies, and those that they guide
         type(rows_t), intent(in) :: rows                    !! the solved rows, evaluated
         real(wp), intent(in), contiguous :: mass(:, :)      !! (n_v, bodies) masses [kg or kg.m^2]
         real(wp), intent(in), contiguous :: g(:, 0:)        !! (n_v, 0:bodies) applied loads [N or N.m]
         real(wp), intent(in), contiguous :: lambda(:)       !! (rows) multipliers of the solved rows [N or N.m]
         type(motion_t), intent(in) :: motion                !! motion, with accelerations
      end function prescribed_power_interface

      !> Multipliers of the rows that fix the prescribed bodies. Those of other rows with prescribed bodies are there, and all these
      !> rows are evaluated.
      subroutine prescribed_multipliers_interface(n_rate, n_body, n_row, n_block, held, carried, jac, mass, g, a, rest, lambda)
         import :: held_t, wp
         implicit none (type, external)
         integer, intent(in) :: n_rate                         !! rates of a body
         integer, intent(in) :: n_body                         !! number of bodies
         integer, intent(in) :: n_row                          !! number of rows
         integer, intent(in) :: n_block                        !! number of blocks of Phi_q
         type(held_t), intent(in), contiguous :: held(:)       !! (n) how the bodies are held
         integer, intent(in), contiguous :: carried(:, :)      !! (3, sides) prescribed bodies in other rows: row, place, body
         real(wp), intent(in) :: jac(2*n_rate, n_block)        !! (2 n_v, blocks) Phi_q of all rows [1 or m]
         real(wp), intent(in) :: mass(n_rate, n_body)          !! (n_v, bodies) masses [kg or kg.m^2]
         real(wp), intent(in) :: g(n_rate, 0:n_body)           !! (n_v, 0:bodies) applied loads [N or N.m]
         real(wp), intent(in) :: a(n_rate, 0:n_body)           !! (n_v, 0:bodies) accelerations of the rates [m/s^2 or rad/s^2]
         real(wp), intent(inout) :: rest(n_rate, 0:n_body)     !! (n_v, 0:bodies) scratch: what the rows of a body carry [N or N.m]
         real(wp), intent(inout) :: lambda(n_row)              !! (rows) multipliers; those of the fixing rows are set [N or N.m]
      end subroutine prescribed_multipliers_interface

      !> Positions and velocities of the bodies with one degree of freedom; the motion of their bases is set, accelerations too. No
      !> allocation.
      pure subroutine one_dof_move_interface(self, x, x_dot, motion)
         import :: one_dof_bodies_t, motion_t, wp
         implicit none (type, external)
         class(one_dof_bodies_t), intent(inout) :: self   !! the bodies
         real(wp), intent(in) :: x(self%n)               !! (n) coordinates [rad or m]
         real(wp), intent(in) :: x_dot(self%n)           !! (n) their rates [rad/s or m/s]
         type(motion_t), intent(inout) :: motion         !! the motion of the bodies with one degree of freedom is set
      end subroutine one_dof_move_interface

      !> Rates of the coordinates and their derivatives at the motion that is set. Status 1 if one is not a finite number.
      pure subroutine one_dof_rates_interface(self, n_v, n_body, g, x_dot, rate, x_ddot, status)
         import :: one_dof_bodies_t, wp
         implicit none (type, external)
         class(one_dof_bodies_t), intent(in) :: self          !! the bodies, moved
         integer, intent(in) :: n_v                          !! rates of a body
         integer, intent(in) :: n_body                       !! number of bodies
         real(wp), intent(in) :: g(n_v, 0:n_body)            !! (n_v, 0:bodies) applied loads [N or N.m]
         real(wp), intent(in) :: x_dot(self%n)               !! (n) rates of the coordinates [rad/s or m/s]
         real(wp), intent(inout) :: rate(self%n)             !! (n) the same, derivatives of the coordinates [rad/s or m/s]
         real(wp), intent(inout) :: x_ddot(self%n)           !! (n) second derivatives [rad/s^2 or m/s^2]
         integer, intent(out) :: status                      !! 0: all finite
      end subroutine one_dof_rates_interface

      !> Accelerations of the bodies with one degree of freedom under loads, with those that they have by their motion or without:
      !> then what the loads add to them.
      pure subroutine one_dof_response_interface(self, g, with_own, motion, a)
         import :: one_dof_bodies_t, motion_t, wp
         implicit none (type, external)
         class(one_dof_bodies_t), intent(in) :: self          !! the bodies, moved
         real(wp), intent(in), contiguous :: g(:, 0:)        !! (n_v, 0:bodies) loads [N or N.m]
         logical, intent(in) :: with_own                     !! with the accelerations by the motion
         type(motion_t), intent(in) :: motion                !! accelerations of the bases
         real(wp), intent(inout), contiguous :: a(:, 0:)     !! (n_v, 0:bodies) accelerations of the rates [m/s^2 or rad/s^2]
      end subroutine one_dof_response_interface

      !> Accelerations of the bodies with one degree of freedom from the second derivatives of their coordinates, at the motion that
      !> is set.
      pure subroutine one_dof_acceleration_interface(self, x_ddot, motion)
         import :: one_dof_bodies_t, motion_t, wp
         implicit none (type, external)
         class(one_dof_bodies_t), intent(in) :: self      !! the bodies, moved
         real(wp), intent(in) :: x_ddot(self%n)          !! (n) second derivatives [rad/s^2 or m/s^2]
         type(motion_t), intent(inout) :: motion         !! accelerations of the bodies with one degree of freedom are set
      end subroutine one_dof_acceleration_interface

      !> Coordinates and rates from a motion of all bodies that fulfils the joints.
      pure subroutine one_dof_coordinates_interface(self, motion, x, x_dot)
         import :: one_dof_bodies_t, motion_t, wp
         implicit none (type, external)
         class(one_dof_bodies_t), intent(in) :: self      !! the bodies
         type(motion_t), intent(in) :: motion            !! positions and velocities
         real(wp), intent(out) :: x(self%n)              !! (n) coordinates [rad or m]
         real(wp), intent(out) :: x_dot(self%n)          !! (n) their rates [rad/s or m/s]
      end subroutine one_dof_coordinates_interface

      !> Multipliers of the rows of the joints of bodies with one degree of freedom; the rows are evaluated.
      subroutine one_dof_multipliers_interface(self, n_which, which, n_v, n_body, rows, mass, g, a, lambda)
         import :: one_dof_bodies_t, rows_t, wp
         implicit none (type, external)
         class(one_dof_bodies_t), intent(in) :: self          !! the bodies
         integer, intent(in) :: n_which                      !! how many are meant
         integer, intent(in) :: which(n_which)               !! (n_which) their numbers
         integer, intent(in) :: n_v                          !! rates of a body
         integer, intent(in) :: n_body                       !! number of bodies
         type(rows_t), intent(in) :: rows                    !! all rows
         real(wp), intent(in) :: mass(n_v, n_body)           !! (n_v, bodies) masses [kg or kg.m^2]
         real(wp), intent(in) :: g(n_v, 0:n_body)            !! (n_v, 0:bodies) applied loads [N or N.m]
         real(wp), intent(in) :: a(n_v, 0:n_body)            !! (n_v, 0:bodies) accelerations of the rates [m/s^2 or rad/s^2]
         real(wp), intent(inout) :: lambda(rows%n)           !! (rows) multipliers; those of the joints are set [N or N.m]
      end subroutine one_dof_multipliers_interface
   end interface

end module reduced_bodies
