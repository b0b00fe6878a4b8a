!> Every kind and section that a deck may hold, in the order of the manual. Each is asked once; what it said is kept until the
!> program ends, so that tables and sections of scenes point to it and hold no copies.
module kind_list
   use bodies, only: bodies_info, material_info, points_info
   use spatial_bodies, only: spatial_bodies_info, spatial_points_info
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t
   use contact_registry, only: n_friction_kinds, n_law_kinds, n_wear_kinds, new_friction_law, new_normal_law, new_wear_law
   use film_law, only: film_law_t
   use film_registry, only: n_film_kinds, new_film_law
   use fit_info, only: fit_sensor_info, fit_set_info, fit_study_info, fit_table_info
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_set_t
   use friction_law, only: friction_law_t
   use function_kind, only: function_kind_t
   use function_registry, only: n_function_kinds, new_function_kind
   use guard_info, only: guards_info
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t
   use kind_info, only: is_of_space, kind_info_t
   use lubricant, only: lubricant_info
   use normal_law, only: normal_law_t
   use precision_info, only: precision_section
   use requests, only: motion_request_info, reaction_info, request_info
   use shapes, only: shapes_info
   use section_info, only: dynamic_info, kinematic_info, output_info, scene_info, static_info
   use modes_info, only: modes_section
   use orbit_info, only: orbit_section
   use sensitivity_info, only: sensitivity_section
   use state_equations, only: state_info
   use study_info, only: ensemble_info, life_info, statistics_info, sweep_info
   use tolerance_info, only: tolerance_joint_info, tolerance_limit_info, tolerance_study_info, tolerance_table_info
   use wear_law, only: wear_law_t
   use worn_kind, only: worn_kind_t
   use worn_registry, only: n_worn_kinds, new_worn_kind
   implicit none (type, external)
   private
   public :: all_kinds, clearance_info, film_info, force_info, friction_info, function_info, joint_info, kind_named, known, law_info
   public :: wear_info, worn_info

   ! where the kinds of a registry stand in the list: behind these
   integer :: before_joints       !! sections and tables of the scene
   integer :: before_forces       !! joints
   integer :: before_functions    !! forces
   integer :: before_clearances   !! functions, materials
   integer :: before_laws         !! clearances
   integer :: before_frictions    !! laws of contact
   integer :: before_wears        !! laws of friction
   integer :: before_films        !! laws of wear, lubricants
   integer :: before_worn         !! films
   integer :: before_settings     !! surfaces that are worn at the start

   type(kind_info_t), allocatable, protected, target :: known(:)  !! (kinds) what they said, once they were asked

contains

   !> What kind number k of joints and drivers describes.
   function joint_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_joints + k)
   end function joint_info

   !> What kind number k of force elements describes.
   function force_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_forces + k)
   end function force_info

   !> What kind number k of named functions describes.
   function function_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_functions + k)
   end function function_info

   !> What geometry number k describes.
   function clearance_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_clearances + k)
   end function clearance_info

   !> What normal law number k describes.
   function law_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_laws + k)
   end function law_info

   !> What friction law number k describes.
   function friction_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_frictions + k)
   end function friction_info

   !> What wear law number k describes.
   function wear_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_wears + k)
   end function wear_info

   !> What film number k describes.
   function film_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_films + k)
   end function film_info

   !> What kind number k of given wear describes.
   function worn_info(k) result(info)
      integer, intent(in) :: k            !! number in the registry
      type(kind_info_t), pointer :: info  !! the kind

      call ask_all()
      info => known(before_worn + k)
   end function worn_info

   !> The kind or section of a name; there must be one.
   function kind_named(name, is_spatial) result(info)
      character(*), intent(in) :: name    !! as in a deck
      logical, intent(in) :: is_spatial   !! in spatial scenes, not planar ones
      type(kind_info_t), pointer :: info  !! the kind

      integer :: k

      call ask_all()
      do k = 1, size(known)
         info => known(k)
         if (info%name == name .and. is_of_space(info, is_spatial)) return
      end do
      error stop "internal error: unknown type"
   end function kind_named

   !> All kinds.
   subroutine all_kinds(kinds)
      type(kind_info_t), allocatable, intent(out) :: kinds(:)  !! (kinds) in the order of the manual

      call ask_all()
      kinds = known
   end subroutine all_kinds

   !> Ask all kinds, unless that was done.
   subroutine ask_all()
      class(clearance_set_t), allocatable :: clearance
      class(force_set_t), allocatable :: force
      class(friction_law_t), allocatable :: friction
      class(function_kind_t), allocatable :: function
      class(joint_set_t), allocatable :: joint
      class(normal_law_t), allocatable :: law
      integer :: k

      if (allocated(known)) return
      before_joints = 6
      before_forces = before_joints + n_joint_kinds()
      before_functions = before_forces + n_force_kinds()
      before_clearances = before_functions + n_function_kinds() + 1
      before_laws = before_clearances + n_clearance_kinds()
      before_frictions = before_laws + n_law_kinds()
      before_wears = before_frictions + n_friction_kinds()
      before_films = before_wears + n_wear_kinds() + 1
      before_worn = before_films + n_film_kinds()
      before_settings = before_worn + n_worn_kinds()
      allocate (known(before_settings + 26))
      known(1) = scene_info()
      known(2) = bodies_info()
      known(3) = points_info()
      known(4) = spatial_bodies_info()
      known(5) = spatial_points_info()
      known(6) = shapes_info()
      do k = 1, n_joint_kinds()
         call new_joint_set(k, joint)
         known(before_joints + k) = joint%info()
      end do
      do k = 1, n_force_kinds()
         call new_force_set(k, force)
         known(before_forces + k) = force%info()
      end do
      do k = 1, n_function_kinds()
         call new_function_kind(k, function)
         known(before_functions + k) = function%info()
      end do
      known(before_clearances) = material_info()
      do k = 1, n_clearance_kinds()
         call new_clearance_set(k, clearance)
         known(before_clearances + k) = clearance%info()
      end do
      do k = 1, n_law_kinds()
         call new_normal_law(k, law)
         known(before_laws + k) = law%info()
      end do
      do k = 1, n_friction_kinds()
         call new_friction_law(k, friction)
         known(before_frictions + k) = friction%info()
      end do
      call ask_wears()
      known(before_films) = lubricant_info()
      call ask_films()
      call ask_worn()
      call ask_settings()
   end subroutine ask_all

   !> Ask the wear laws.
   subroutine ask_wears()
      class(wear_law_t), allocatable :: wear
      integer :: k

      do k = 1, n_wear_kinds()
         call new_wear_law(k, wear)
         known(before_wears + k) = wear%info()
      end do
   end subroutine ask_wears

   !> Ask the films.
   subroutine ask_films()
      class(film_law_t), allocatable :: film
      integer :: k

      do k = 1, n_film_kinds()
         call new_film_law(k, film)
         known(before_films + k) = film%info()
      end do
   end subroutine ask_films

   !> Ask the kinds of given wear.
   subroutine ask_worn()
      class(worn_kind_t), allocatable :: worn
      integer :: k

      do k = 1, n_worn_kinds()
         call new_worn_kind(k, worn)
         known(before_worn + k) = worn%info()
      end do
   end subroutine ask_worn

   !> Ask the sections of settings.
   subroutine ask_settings()
      known(before_settings + 1) = dynamic_info()
      known(before_settings + 2) = kinematic_info()
      known(before_settings + 3) = static_info()
      known(before_settings + 4) = guards_info()
      known(before_settings + 5) = request_info()
      known(before_settings + 6) = motion_request_info()
      known(before_settings + 7) = reaction_info(is_spatial=.false.)
      known(before_settings + 8) = reaction_info(is_spatial=.true.)
      known(before_settings + 9) = output_info()
      known(before_settings + 10) = statistics_info()
      known(before_settings + 11) = sweep_info()
      known(before_settings + 12) = ensemble_info()
      known(before_settings + 13) = life_info()
      known(before_settings + 14) = sensitivity_section()
      known(before_settings + 15) = tolerance_table_info()
      known(before_settings + 16) = tolerance_joint_info()
      known(before_settings + 17) = tolerance_limit_info()
      known(before_settings + 18) = tolerance_study_info()
      known(before_settings + 19) = fit_table_info()
      known(before_settings + 20) = fit_sensor_info()
      known(before_settings + 21) = fit_set_info()
      known(before_settings + 22) = fit_study_info()
      known(before_settings + 23) = precision_section()
      known(before_settings + 24) = orbit_section()
      known(before_settings + 25) = modes_section()
      known(before_settings + 26) = state_info()
   end subroutine ask_settings

end module kind_list
