!> Which bodies of a scene one joint leaves a single freedom against the ground or a body of known motion.
!>
!> A body is guided when one revolute or translational joint ties it to such a body, and no other row of a joint or driver
!> holds it, and it does not rub: then the coordinate of the joint describes it. Springs, loads and contacts may act on it.
module find_one_dof
   use build_clearances, only: is_ideal
   use clearance_registry, only: n_clearance_kinds
   use find_prescribed, only: joint_bodies, has_friction
   use joint_registry, only: n_joint_kinds
   use kind_info, only: free_rotation, free_translation
   use scene, only: scene_t
   use ties, only: tie_of, tie_t
   implicit none (type, external)
   private
   public :: find_one_dof_bodies, guide_t

   !> How a body with one degree of freedom is held.
   type :: guide_t
      integer :: body = 0   !! the body
      integer :: kind = 0   !! kind of the joint
      integer :: item = 0   !! its row in the table of the kind
   end type guide_t

contains

   !> The bodies with one degree of freedom, those that turn first.
   subroutine find_one_dof_bodies(scene, is_known, levels, guides)
      type(scene_t), intent(in) :: scene                    !! the scene
      logical, intent(in) :: is_known(0:)                   !! (0:bodies) bodies of known motion, the ground among them
      integer, intent(in) :: levels                         !! how joints with clearance are taken
      type(guide_t), allocatable, intent(out) :: guides(:)  !! (bodies with one degree of freedom) how they are held

      integer, parameter :: leaves(2) = [free_rotation, free_translation]
      integer :: body(2), i, k, n, n_joint(0:scene%bodies%n), pass

      call count_joints(scene, levels, n_joint)
      allocate (guides(scene%bodies%n))
      n = 0
      do pass = 1, 2
         do k = 1, n_joint_kinds()
            if (scene%joints(k)%info%free /= leaves(pass)) cycle
            do i = 1, size(scene%joints(k)%items)
               body = joint_bodies(scene, k, i)
               if (is_known(body(1)) .eqv. is_known(body(2))) cycle
               if (is_known(body(1))) body(1) = body(2)
               if (n_joint(body(1)) /= 1 .or. has_friction(scene, scene%joints(k)%items(i))) cycle
               n = n + 1
               guides(n) = guide_t(body(1), k, i)
            end do
         end do
      end do
      guides = guides(:n)
   end subroutine find_one_dof_bodies

   !> Joints and drivers at each body.
   subroutine count_joints(scene, levels, n_joint)
      type(scene_t), intent(in) :: scene                     !! the scene
      integer, intent(in) :: levels                          !! how joints with clearance are taken
      integer, intent(out) :: n_joint(0:scene%bodies%n)      !! (0:bodies) their number

      type(tie_t) :: tie
      integer :: i, k

      n_joint = 0
      do k = 1, n_joint_kinds()
         if (scene%joints(k)%info%is_start_only) cycle
         do i = 1, size(scene%joints(k)%items)
            tie = tie_of(scene, scene%joints(k)%info, scene%joints(k)%items(i))
            call count_pair(tie%body)
            call count_pair(tie%more(:2))
            call count_pair(tie%more(3:))
         end do
      end do
      do k = 1, n_clearance_kinds()
         associate (items => scene%clearances(k)%items)
            do i = 1, size(items)
               if (.not. is_ideal(items(i), levels)) cycle
               tie = tie_of(scene, scene%clearances(k)%info, items(i))
               call count_pair(tie%body)
            end do
         end associate
      end do

   contains

      !> One joint more at both bodies.
      subroutine count_pair(body)
         integer, intent(in) :: body(2)  !! (2) the bodies, 0: ground

         n_joint(body(1)) = n_joint(body(1)) + 1
         n_joint(body(2)) = n_joint(body(2)) + 1
      end subroutine count_pair

   end subroutine count_joints

end module find_one_dof
