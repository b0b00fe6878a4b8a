!> The reaction of a joint, driver or spring at a point, along the axes of a body.
!>
!> With its load on the body, force F and moment M about where it reports its own, R:  M_P = M + (R - P) x F.
!>
!> Signs: what acts on the body of i, or on that of j. Source: Flores et al. (2008), eq. (2.24). Limits: none.
module reaction_at
   use joint_set, only: joint_set_t
   use kinds, only: not_a_number, wp
   use linkage, only: linkage_t
   use mechanism, only: mechanism_t
   use motion, only: cross, motion_t, point_position
   use requests, only: reaction_request_t, source_force, source_ideal, source_joint, source_clearance_joints, &
      source_none
   use observable, only: place_t
   implicit none (type, external)
   private
   public :: bind_reactions, find_reaction

contains

   !> Find what has the reactions by its name.
   subroutine bind_reactions(system)
      class(mechanism_t), intent(inout) :: system   !! the system, its joints are there

      integer :: i, k, m

      if (.not. allocated(system%requests%reactions)) return
      do m = 1, size(system%requests%reactions)
         associate (reaction => system%requests%reactions(m))
            reaction%source = source_none
            do k = 1, size(system%linkage%joints)
               call look(source_joint, system%linkage%joints(k)%set, reaction)
            end do
            do k = 1, size(system%linkage%ideal)
               call look(source_ideal, system%linkage%ideal(k)%set, reaction)
            end do
            do k = 1, size(system%clearance_joints%sets)
               do i = 1, system%clearance_joints%sets(k)%set%n
                  if (system%clearance_joints%sets(k)%set%names(i)%s /= reaction%joint) cycle
                  reaction%source = source_clearance_joints
                  reaction%slot = k
                  reaction%item = i
               end do
            end do
            do k = 1, size(system%loading%forces)
               do i = 1, system%loading%forces(k)%set%n
                  if (system%loading%forces(k)%set%names(i)%s /= reaction%joint) cycle
                  reaction%source = source_force
                  reaction%slot = k
                  reaction%item = i
               end do
            end do
         end associate
      end do

   contains

      !> Take the joint from a set if it is there.
      subroutine look(source, set, reaction)
         integer, intent(in) :: source                        !! which sets these are
         class(joint_set_t), intent(in) :: set                !! the set
         type(reaction_request_t), intent(inout) :: reaction  !! what is searched

         integer :: item

         do item = 1, set%n
            if (set%names(item)%s /= reaction%joint) cycle
            reaction%source = source
            reaction%slot = k
            reaction%item = item
         end do
      end subroutine look

   end subroutine bind_reactions

   !> Force and moment of a reaction; NaN if its joint is not there. No allocation.
   subroutine find_reaction(system, t, reaction, force, moment)
      class(mechanism_t), intent(in) :: system            !! the system at a state, with all multipliers
      real(wp), intent(in) :: t                           !! time [s]
      type(reaction_request_t), intent(in) :: reaction    !! what is asked
      real(wp), intent(out) :: force(3)                   !! (3) on the body, along the axes of the frame [N]
      real(wp), intent(out) :: moment(3)                  !! (3) on the body about the point, along the same axes [N.m]

      real(wp) :: p(3)

      associate (linkage => system%linkage, motion => system%linkage%motion)
         select case (reaction%source)
         case (source_joint)
            call of_joint(linkage, linkage%joints(reaction%slot)%set, reaction, force, moment, p)
         case (source_ideal)
            call of_joint(linkage, linkage%ideal(reaction%slot)%set, reaction, force, moment, p)
         case (source_clearance_joints)
            associate (set => system%clearance_joints%sets(reaction%slot)%set)
               call set%load_on_j(reaction%item, motion, force, moment)
               p = motion%r(:, set%items%body(2, reaction%item))
            end associate
            if (.not. reaction%on_j) then
               force = -force
               moment = -moment
            end if
         case (source_force)
            associate (set => system%loading%forces(reaction%slot)%set)
               call set%load_on(reaction%item, merge(2, 1, reaction%on_j), linkage%segment%inside(t), motion, force, moment, p)
            end associate
         case default
            force = not_a_number()
            moment = force
            return
         end select
         if (reaction%has_point) then
            moment = moment + cross(p - point_position(motion, reaction%place%body, reaction%place%s), force)
         else if (reaction%source == source_clearance_joints) then
            associate (set => system%clearance_joints%sets(reaction%slot)%set, k => reaction%item)
               moment = moment + cross(p - point_position(motion, set%items%body(2, k), set%items%s_j(:, k)), force)
            end associate
         end if
         force = along_axes(force, motion, reaction%place)
         moment = along_axes(moment, motion, reaction%place)
      end associate
   end subroutine find_reaction

   !> The reaction of an ideal joint or a driver where it reports its own.
   subroutine of_joint(linkage, set, reaction, force, moment, p)
      type(linkage_t), intent(in) :: linkage              !! the linkage at a state
      class(joint_set_t), intent(in) :: set               !! the set
      type(reaction_request_t), intent(in) :: reaction    !! what is asked
      real(wp), intent(out) :: force(3)                   !! (3) on the body, world frame [N]
      real(wp), intent(out) :: moment(3)                  !! (3) on the body about p, world frame [N.m]
      real(wp), intent(out) :: p(3)                       !! (3) the point, world frame [m]

      call set%reaction(reaction%item, linkage%motion, linkage%coordinates, linkage%rows, linkage%solution%lambda, force, moment, &
                        merge(2, 1, reaction%on_j))
      p = set%reaction_point(reaction%item, linkage%motion)
   end subroutine of_joint

   !> A vector of the world along the axes of a body.
   pure function along_axes(x, motion, place) result(y)
      real(wp), intent(in) :: x(3)            !! (3) world frame [any]
      type(motion_t), intent(in) :: motion    !! positions
      type(place_t), intent(in) :: place      !! whose frame names the body
      real(wp) :: y(3)                        !! (3) along its axes, those that the deck gives it [any]

      y = x
      if (place%frame == 0) return
      y = matmul(x, motion%rot(:, :, place%frame))
      if (allocated(motion%spatial%own)) y = matmul(motion%spatial%own(:, :, place%frame), y)
   end function along_axes

end module reaction_at
