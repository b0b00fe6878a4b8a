!> What the kernels of known and bodies with one degree of freedom of space take of joints.
!>
!> With F the frame of a joint in a body (axis z), the rotation of a body against its base is F_base R_z(x) F_body^T, x the turn of
!> the body about z: that of j against i, with its sign changed where the body is i.
module spatial_reduction
   use joint_set, only: joint_set_t
   use kinds, only: wp
   use motion, only: cross
   use reduced_bodies, only: held_t
   use rotations, only: euler_parameters_of, product_of
   use spatial_one_dof, only: spatial_guide_t
   use spatial_joint, only: spatial_joint_t
   use spatial_prescribed, only: spatial_link_t
   implicit none (type, external)
   private
   public :: spatial_guide, spatial_link

   !> A joint as observed from the body that it holds.
   type :: observed_joint_t
      real(wp) :: in_body(3, 3)   !! (3, 3) its axes as columns, frame of the body [1]
      real(wp) :: in_base(3, 3)   !! (3, 3) the same, frame of the base [1]
      real(wp) :: s_body(3)       !! (3) its point, frame of the body [m]
      real(wp) :: s_base(3)       !! (3) the same, frame of the base [m]
      real(wp) :: q_0(4)          !! (4) Euler parameters of the body against the base at angle zero [1]
      real(wp) :: q_1(4)          !! (4) those at half a turn [1]
   end type observed_joint_t

contains

   !> A prescribed body, held by a revolute joint with its driver, or by a rigid joint.
   function spatial_link(set, k, held, x, p) result(link)
      class(joint_set_t), intent(in) :: set   !! the joint's set
      integer, intent(in) :: k                !! its item
      type(held_t), intent(in) :: held        !! how the body is held
      real(wp), intent(in) :: x               !! angle of the driver at the start [rad]
      real(wp), intent(in) :: p(:, 0:)        !! (4, 0:bodies) Euler parameters where the deck puts the bodies [1]
      type(spatial_link_t) :: link            !! what the kernel needs

      type(observed_joint_t) :: seen
      real(wp) :: sense, sign

      seen = observed_from(set, k, held%side)
      link%s_body = seen%s_body
      link%s_base = seen%s_base
      sense = merge(1.0_wp, -1.0_wp, held%side == 2)
      sign = sign_of(cos(0.5_wp*x)*seen%q_0 + sense*sin(0.5_wp*x)*seen%q_1, p(:, held%base), p(:, held%body))
      link%q_0 = sign*seen%q_0
      if (held%slot == 0) return
      link%q_1 = sign*sense*seen%q_1
      link%axis = sense*seen%in_body(:, 3)
   end function spatial_link

   !> A body with one degree of freedom, held by a revolute or a translational joint.
   function spatial_guide(set, k, held, slides, mass, p) result(guide)
      class(joint_set_t), intent(in) :: set   !! the joint's set
      integer, intent(in) :: k                !! its item
      type(held_t), intent(in) :: held        !! how the body is held
      logical, intent(in) :: slides           !! whether the joint leaves a way, not a turn
      real(wp), intent(in) :: mass(6)         !! (6) masses of the body [kg and kg.m^2]
      real(wp), intent(in) :: p(:, 0:)        !! (4, 0:bodies) Euler parameters where the deck puts the bodies [1]
      type(spatial_guide_t) :: guide          !! what the kernel needs

      type(observed_joint_t) :: seen
      real(wp) :: sign

      seen = observed_from(set, k, held%side)
      sign = sign_of(seen%q_0, p(:, held%base), p(:, held%body))  ! the coordinate starts within half a turn of zero
      guide%mass = mass
      guide%q_0 = sign*seen%q_0
      if (slides) then
         guide%slide_axis = seen%in_base(:, 3)
         guide%s_base = seen%s_base - matmul(seen%in_base, matmul(seen%s_body, seen%in_body))
         guide%ease = 1.0_wp/mass(1)
      else
         guide%q_1 = sign*seen%q_1
         guide%turn = seen%in_body(:, 3)
         guide%slide_axis = -seen%s_body
         guide%s_base = seen%s_base
         guide%ease = 1.0_wp/(dot_product(guide%turn, mass(4:)*guide%turn) + mass(1)*sum(cross(guide%turn, guide%slide_axis)**2))
      end if
   end function spatial_guide

   !> The sign of a turn against the base with which the body's Euler parameters start on the side where the deck has them.
   pure real(wp) function sign_of(q, p_base, p)
      real(wp), intent(in) :: q(4)        !! (4) Euler parameters of the turn [1]
      real(wp), intent(in) :: p_base(4)   !! (4) those of the base [1]
      real(wp), intent(in) :: p(4)        !! (4) those of the body [1]

      sign_of = merge(-1.0_wp, 1.0_wp, dot_product(product_of(p_base, q), p) < 0.0_wp)
   end function sign_of

   !> A joint as observed from one of its bodies.
   function observed_from(set, k, side) result(seen)
      class(joint_set_t), intent(in) :: set   !! the joint's set
      integer, intent(in) :: k                !! its item
      integer, intent(in) :: side             !! side of the body, 1: i, 2: j
      type(observed_joint_t) :: seen              !! the joint

      real(wp), parameter :: half_turn(4) = [0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]  ! about z
      real(wp) :: back(4)

      select type (set)
      class is (spatial_joint_t)
         seen%in_body = merge(set%axes%frame_i(:, :, k), set%axes%frame_j(:, :, k), side == 1)
         seen%in_base = merge(set%axes%frame_j(:, :, k), set%axes%frame_i(:, :, k), side == 1)
      class default
         error stop "spatial_reduction: a planar joint"
      end select
      seen%s_body = merge(set%s_i(:, k), set%s_j(:, k), side == 1)
      seen%s_base = merge(set%s_j(:, k), set%s_i(:, k), side == 1)
      back = euler_parameters_of(transpose(seen%in_body))
      seen%q_0 = product_of(euler_parameters_of(seen%in_base), back)
      seen%q_1 = product_of(euler_parameters_of(seen%in_base), product_of(half_turn, back))
   end function observed_from

end module spatial_reduction
