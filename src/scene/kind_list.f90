!> Every kind and section that a deck may hold, in the order of the manual.
module kind_list
   use bodies, only: bodies_info, material_info, points_info
   use spatial_bodies, only: spatial_bodies_info, spatial_points_info
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t
   use contact_registry, only: n_friction_kinds, n_law_kinds, new_friction_law, new_normal_law
   use film_law, only: film_law_t
   use film_registry, only: n_film_kinds, new_film_law
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_set_t
   use friction_law, only: friction_law_t
   use function_kind, only: function_kind_t
   use function_registry, only: n_function_kinds, new_function_kind
   use guard_info, only: guards_info
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t
   use kind_info, only: kind_info_t
   use lubricant, only: lubricant_info
   use normal_law, only: normal_law_t
   use precision_info, only: precision_section
   use requests, only: motion_request_info, reaction_info, request_info
   use shapes, only: shapes_info
   use section_info, only: dynamic_info, kinematic_info, output_info, scene_info, static_info
   use study_info, only: ensemble_info, statistics_info, sweep_info
   implicit none (type, external)
   private
   public :: all_kinds, clearance_info, film_info, force_info, friction_info, function_info, joint_info, law_info

contains

   !> What kind number k of joints and drivers says of itself.
   function joint_info(k) result(info)
      integer, intent(in) :: k   !! number in the registry
      type(kind_info_t) :: info  !! the kind

      class(joint_set_t), allocatable :: set

      call new_joint_set(k, set)
      info = set%info()
   end function joint_info

   !> What kind number k of force elements says of itself.
   function force_info(k) result(info)
      integer, intent(in) :: k   !! number in the registry
      type(kind_info_t) :: info  !! the kind

      class(force_set_t), allocatable :: set

      call new_force_set(k, set)
      info = set%info()
   end function force_info

   !> What kind number k of named functions says of itself.
   function function_info(k) result(info)
      integer, intent(in) :: k   !! number in the registry
      type(kind_info_t) :: info  !! the kind

      class(function_kind_t), allocatable :: kind

      call new_function_kind(k, kind)
      info = kind%info()
   end function function_info

   !> What geometry number k says of itself.
   function clearance_info(k) result(info)
      integer, intent(in) :: k   !! number in the registry
      type(kind_info_t) :: info  !! the kind

      class(clearance_set_t), allocatable :: set

      call new_clearance_set(k, set)
      info = set%info()
   end function clearance_info

   !> What normal law number k says of itself.
   function law_info(k) result(info)
      integer, intent(in) :: k   !! number in the registry
      type(kind_info_t) :: info  !! the kind

      class(normal_law_t), allocatable :: law

      call new_normal_law(k, law)
      info = law%info()
   end function law_info

   !> What friction law number k says of itself.
   function friction_info(k) result(info)
      integer, intent(in) :: k   !! number in the registry
      type(kind_info_t) :: info  !! the kind

      class(friction_law_t), allocatable :: law

      call new_friction_law(k, law)
      info = law%info()
   end function friction_info

   !> What film number k says of itself.
   function film_info(k) result(info)
      integer, intent(in) :: k   !! number in the registry
      type(kind_info_t) :: info  !! the kind

      class(film_law_t), allocatable :: law

      call new_film_law(k, law)
      info = law%info()
   end function film_info

   !> All kinds.
   subroutine all_kinds(kinds)
      type(kind_info_t), allocatable, intent(out) :: kinds(:)  !! (kinds) in the order of the manual

      integer :: k, n

      allocate (kinds(21 + n_joint_kinds + n_force_kinds + n_function_kinds + n_clearance_kinds + n_law_kinds &
                      + n_friction_kinds + n_film_kinds))
      kinds(1) = scene_info()
      kinds(2) = bodies_info()
      kinds(3) = points_info()
      kinds(4) = spatial_bodies_info()
      kinds(5) = spatial_points_info()
      kinds(6) = shapes_info()
      n = 6
      do k = 1, n_joint_kinds
         kinds(n + k) = joint_info(k)
      end do
      n = n + n_joint_kinds
      do k = 1, n_force_kinds
         kinds(n + k) = force_info(k)
      end do
      n = n + n_force_kinds
      do k = 1, n_function_kinds
         kinds(n + k) = function_info(k)
      end do
      n = n + n_function_kinds
      kinds(n + 1) = material_info()
      n = n + 1
      do k = 1, n_clearance_kinds
         kinds(n + k) = clearance_info(k)
      end do
      n = n + n_clearance_kinds
      do k = 1, n_law_kinds
         kinds(n + k) = law_info(k)
      end do
      n = n + n_law_kinds
      do k = 1, n_friction_kinds
         kinds(n + k) = friction_info(k)
      end do
      n = n + n_friction_kinds
      kinds(n + 1) = lubricant_info()
      n = n + 1
      do k = 1, n_film_kinds
         kinds(n + k) = film_info(k)
      end do
      n = n + n_film_kinds
      kinds(n + 1) = dynamic_info()
      kinds(n + 2) = kinematic_info()
      kinds(n + 3) = static_info()
      kinds(n + 4) = guards_info()
      kinds(n + 5) = request_info()
      kinds(n + 6) = motion_request_info()
      kinds(n + 7) = reaction_info(is_spatial=.false.)
      kinds(n + 8) = reaction_info(is_spatial=.true.)
      kinds(n + 9) = output_info()
      kinds(n + 10) = statistics_info()
      kinds(n + 11) = sweep_info()
      kinds(n + 12) = ensemble_info()
      kinds(n + 13) = precision_section()
   end subroutine all_kinds

end module kind_list
