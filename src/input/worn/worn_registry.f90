!> The kinds of given wear: two lines each (`use`, `case`), and their number.
module worn_registry
   use worn_by_arc, only: worn_by_arc_t
   use worn_kind, only: worn_kind_t
   use worn_by_profile, only: worn_by_profile_t
   use worn_by_run, only: worn_by_run_t
   use worn_uniform, only: worn_uniform_t
   implicit none (type, external)
   private
   public :: n_worn_kinds, new_worn_kind

contains

   !> Number of kinds.
   pure integer function n_worn_kinds()
      n_worn_kinds = 4
   end function n_worn_kinds

   !> Kind number k, 1 to `n_worn_kinds`.
   subroutine new_worn_kind(k, kind)
      integer, intent(in) :: k                              !! number of the kind
      class(worn_kind_t), allocatable, intent(out) :: kind  !! the kind

      select case (k)
      case (1); allocate (worn_by_arc_t :: kind)
      case (2); allocate (worn_uniform_t :: kind)
      case (3); allocate (worn_by_profile_t :: kind)
      case (4); allocate (worn_by_run_t :: kind)
      end select
   end subroutine new_worn_kind

end module worn_registry
