!> Which kinds planar scenes know: tests of the plane loop over these.
module planar_kinds
   use clearance_registry, only: new_clearance_set
   use clearance_set, only: clearance_set_t
   use force_registry, only: new_force_set
   use force_set, only: force_set_t
   use joint_registry, only: new_joint_set
   use joint_set, only: joint_set_t
   use kind_info, only: is_of_space
   implicit none (type, external)
   private
   public :: is_planar_clearance, is_planar_force, is_planar_joint

contains

   !> Whether planar scenes know a kind of joint.
   logical function is_planar_joint(kind)
      integer, intent(in) :: kind   !! number of the kind

      class(joint_set_t), allocatable :: set

      call new_joint_set(kind, set)
      is_planar_joint = is_of_space(set%info(), .false.)
   end function is_planar_joint

   !> Whether planar scenes know a kind of force element.
   logical function is_planar_force(kind)
      integer, intent(in) :: kind   !! number of the kind

      class(force_set_t), allocatable :: set

      call new_force_set(kind, set)
      is_planar_force = is_of_space(set%info(), .false.)
   end function is_planar_force

   !> Whether planar scenes know a geometry.
   logical function is_planar_clearance(kind)
      integer, intent(in) :: kind   !! number of the geometry

      class(clearance_set_t), allocatable :: set

      call new_clearance_set(kind, set)
      is_planar_clearance = is_of_space(set%info(), .false.)
   end function is_planar_clearance

end module planar_kinds
