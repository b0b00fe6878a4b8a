!> The kinds of normal laws, of friction laws and of wear laws: two lines each (`use`, `case`), and their number.
module contact_registry
   use friction_ambrosio, only: friction_ambrosio_t
   use friction_brown_mcphee, only: friction_brown_mcphee_t
   use friction_constant, only: friction_constant_t
   use friction_coulomb, only: friction_coulomb_t
   use friction_dahl, only: friction_dahl_t
   use friction_law, only: friction_law_t
   use friction_lugre, only: friction_lugre_t
   use friction_rooney_deravi, only: friction_rooney_deravi_t
   use friction_stribeck, only: friction_stribeck_t
   use friction_threlfall, only: friction_threlfall_t
   use law_dubowsky_freudenstein, only: law_dubowsky_freudenstein_t
   use law_esdu, only: law_esdu_t
   use law_exact, only: law_exact_t
   use law_expression, only: law_expression_t
   use law_flores, only: law_flores_t
   use law_goldsmith, only: law_goldsmith_t
   use law_gonthier, only: law_gonthier_t
   use law_herbert_mcwhannell, only: law_herbert_mcwhannell_t
   use law_hertz, only: law_hertz_t
   use law_hu_guo, only: law_hu_guo_t
   use law_hunt_crossley, only: law_hunt_crossley_t
   use law_johnson, only: law_johnson_t
   use law_kelvin_voigt, only: law_kelvin_voigt_t
   use law_lankarani_nikravesh, only: law_lankarani_nikravesh_t
   use law_lee_wang, only: law_lee_wang_t
   use law_liu, only: law_liu_t
   use law_pereira, only: law_pereira_t
   use law_persson, only: law_persson_t
   use law_plane_face, only: law_plane_face_t
   use law_radzimovsky, only: law_radzimovsky_t
   use law_zhiying_qishao, only: law_zhiying_qishao_t
   use normal_law, only: normal_law_t
   use wear_archard, only: wear_archard_t
   use wear_law, only: wear_law_t
   use wear_reye, only: wear_reye_t
   implicit none (type, external)
   private
   public :: n_friction_kinds, n_law_kinds, n_wear_kinds, new_friction_law, new_normal_law, new_wear_law

contains

   !> Number of normal laws.
   pure integer function n_law_kinds()
      n_law_kinds = 21
   end function n_law_kinds

   !> Number of friction laws.
   pure integer function n_friction_kinds()
      n_friction_kinds = 9
   end function n_friction_kinds

   !> Number of wear laws.
   pure integer function n_wear_kinds()
      n_wear_kinds = 2
   end function n_wear_kinds

   !> A normal law of kind number k, 1 to `n_law_kinds`.
   subroutine new_normal_law(k, law)
      integer, intent(in) :: k                              !! number of the kind
      class(normal_law_t), allocatable, intent(out) :: law  !! the law, without parameters

      select case (k)
      case (1); allocate (law_hertz_t :: law)
      case (2); allocate (law_lankarani_nikravesh_t :: law)
      case (3); allocate (law_kelvin_voigt_t :: law)
      case (4); allocate (law_hunt_crossley_t :: law)
      case (5); allocate (law_herbert_mcwhannell_t :: law)
      case (6); allocate (law_lee_wang_t :: law)
      case (7); allocate (law_gonthier_t :: law)
      case (8); allocate (law_zhiying_qishao_t :: law)
      case (9); allocate (law_flores_t :: law)
      case (10); allocate (law_hu_guo_t :: law)
      case (11); allocate (law_exact_t :: law)
      case (12); allocate (law_dubowsky_freudenstein_t :: law)
      case (13); allocate (law_goldsmith_t :: law)
      case (14); allocate (law_esdu_t :: law)
      case (15); allocate (law_plane_face_t :: law)
      case (16); allocate (law_expression_t :: law)
      case (17); allocate (law_johnson_t :: law)
      case (18); allocate (law_radzimovsky_t :: law)
      case (19); allocate (law_liu_t :: law)
      case (20); allocate (law_pereira_t :: law)
      case (21); allocate (law_persson_t :: law)
      end select
   end subroutine new_normal_law

   !> A friction law of kind number k, 1 to `n_friction_kinds`.
   subroutine new_friction_law(k, law)
      integer, intent(in) :: k                                !! number of the kind
      class(friction_law_t), allocatable, intent(out) :: law  !! the law, without parameters

      select case (k)
      case (1); allocate (friction_ambrosio_t :: law)
      case (2); allocate (friction_constant_t :: law)
      case (3); allocate (friction_rooney_deravi_t :: law)
      case (4); allocate (friction_threlfall_t :: law)
      case (5); allocate (friction_brown_mcphee_t :: law)
      case (6); allocate (friction_coulomb_t :: law)
      case (7); allocate (friction_lugre_t :: law)
      case (8); allocate (friction_stribeck_t :: law)
      case (9); allocate (friction_dahl_t :: law)
      end select
   end subroutine new_friction_law

   !> A wear law of kind number k, 1 to `n_wear_kinds`.
   subroutine new_wear_law(k, law)
      integer, intent(in) :: k                            !! number of the kind
      class(wear_law_t), allocatable, intent(out) :: law  !! the law, without parameters

      select case (k)
      case (1); allocate (wear_archard_t :: law)
      case (2); allocate (wear_reye_t :: law)
      end select
   end subroutine new_wear_law

end module contact_registry
