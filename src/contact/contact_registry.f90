!> The kinds of normal laws and of friction laws: two lines each (`use`, `case`).
module contact_registry
   use friction_ambrosio, only: friction_ambrosio_t
   use friction_coulomb, only: friction_coulomb_t
   use friction_law, only: friction_law_t
   use friction_lugre, only: friction_lugre_t
   use law_hertz, only: law_hertz_t
   use law_lankarani_nikravesh, only: law_lankarani_nikravesh_t
   use normal_law, only: normal_law_t
   implicit none (type, external)
   private
   public :: n_friction_kinds, n_law_kinds, new_friction_law, new_normal_law

   integer, parameter :: n_law_kinds = 2       !! number of normal laws
   integer, parameter :: n_friction_kinds = 3  !! number of friction laws

contains

   !> A normal law of kind number k, 1 to `n_law_kinds`.
   subroutine new_normal_law(k, law)
      integer, intent(in) :: k                              !! number of the kind
      class(normal_law_t), allocatable, intent(out) :: law  !! the law, without parameters

      select case (k)
      case (1); allocate (law_hertz_t :: law)
      case (2); allocate (law_lankarani_nikravesh_t :: law)
      end select
   end subroutine new_normal_law

   !> A friction law of kind number k, 1 to `n_friction_kinds`.
   subroutine new_friction_law(k, law)
      integer, intent(in) :: k                                !! number of the kind
      class(friction_law_t), allocatable, intent(out) :: law  !! the law, without parameters

      select case (k)
      case (1); allocate (friction_ambrosio_t :: law)
      case (2); allocate (friction_coulomb_t :: law)
      case (3); allocate (friction_lugre_t :: law)
      end select
   end subroutine new_friction_law

end module contact_registry
