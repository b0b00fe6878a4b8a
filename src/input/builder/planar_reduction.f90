!> What the kernels of known and bodies with one degree of freedom of the plane take of joints.
!> Planar: the kernels are of the plane.
module planar_reduction
   use driver_speed, only: driver_speed_t
   use joint_set, only: joint_set_t
   use kinds, only: wp
   use planar_one_dof, only: planar_guide_t
   use planar_prescribed, only: planar_link_t
   use reduced_bodies, only: held_t
   implicit none (type, external)
   private
   public :: planar_guide, planar_link, take_driver

contains

   !> A prescribed body, held by a revolute joint with its driver, or by a rigid joint.
   pure function planar_link(set, k, held, angle) result(link)
      class(joint_set_t), intent(in) :: set   !! the joint's set
      integer, intent(in) :: k                !! its item
      type(held_t), intent(in) :: held        !! how the body is held
      real(wp), intent(in) :: angle(0:)       !! (0:bodies) angles at the start [rad]
      type(planar_link_t) :: link             !! what the kernel needs

      call take_points(set, k, held%side, link%s_body, link%s_base)
      link%body = held%body
      link%base = held%base
      link%slot = held%slot
      link%driver = held%item
      if (held%slot == 0) then
         link%offset = angle(held%body) - angle(held%base)
      else
         link%sign = merge(1.0_wp, -1.0_wp, held%side == 2)
      end if
   end function planar_link

   !> The driver of a prescribed body: what one of constant speed says is kept with the body.
   pure subroutine take_driver(set, link)
      class(joint_set_t), intent(in) :: set      !! the driver's set
      type(planar_link_t), intent(inout) :: link !! what the kernel needs, its driver known

      select type (set)
      type is (driver_speed_t)
         link%is_steady = .true.
         link%start = set%start(link%driver)
         link%speed = set%speed(link%driver)
      end select
   end subroutine take_driver

   !> A body with one degree of freedom, held by a revolute or a translational joint.
   pure function planar_guide(set, k, held, slides, angle, mass) result(guide)
      class(joint_set_t), intent(in) :: set   !! the joint's set
      integer, intent(in) :: k                !! its item
      type(held_t), intent(in) :: held        !! how the body is held
      logical, intent(in) :: slides           !! whether the joint leaves a way, not a turn
      real(wp), intent(in) :: angle(0:)       !! (0:bodies) angles at the start [rad]
      real(wp), intent(in) :: mass(3)         !! (3) masses of the body [kg, kg, kg.m^2]
      type(planar_guide_t) :: guide           !! what the kernel needs

      real(wp) :: s_body(2)

      call take_points(set, k, held%side, s_body, guide%s_base)
      guide%body = held%body
      guide%base = held%base
      guide%mass = mass(1)
      if (slides) then
         guide%offset = angle(held%body) - angle(held%base)
         guide%turned = [cos(guide%offset), sin(guide%offset)]
         guide%arm = set%slide_axis_of(k)
         if (held%side == 1) guide%arm = turn(guide%turned, guide%arm)
         guide%s_base = guide%s_base - turn(guide%turned, s_body)
         guide%ease = 1.0_wp/guide%mass
      else
         guide%turns = 1.0_wp
         guide%arm = -s_body
         guide%ease = 1.0_wp/(mass(3) + guide%mass*dot_product(s_body, s_body))
      end if
   end function planar_guide

   !> Points of a joint in the body that it holds and in its base.
   pure subroutine take_points(set, k, side, s_body, s_base)
      class(joint_set_t), intent(in) :: set   !! the joint's set
      integer, intent(in) :: k                !! its item
      integer, intent(in) :: side             !! side of the body, 1: i, 2: j
      real(wp), intent(out) :: s_body(2)      !! (2) its point, frame of the body [m]
      real(wp), intent(out) :: s_base(2)      !! (2) point of the base, frame of the base [m]

      s_body = merge(set%s_i(:2, k), set%s_j(:2, k), side == 1)
      s_base = merge(set%s_j(:2, k), set%s_i(:2, k), side == 1)
   end subroutine take_points

   !> A plane vector turned by an angle.
   pure function turn(cosine_sine, s) result(turned)
      real(wp), intent(in) :: cosine_sine(2)  !! (2) cosine and sine of the angle [1]
      real(wp), intent(in) :: s(2)            !! (2) the vector [any]
      real(wp) :: turned(2)                   !! (2) the same turned [any]

      turned = [cosine_sine(1)*s(1) - cosine_sine(2)*s(2), cosine_sine(2)*s(1) + cosine_sine(1)*s(2)]
   end function turn

end module planar_reduction
