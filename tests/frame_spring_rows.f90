!> Rows of bushings and beams for tests: some numbers given, the others zero.
module frame_spring_rows
   use fixed_random, only: random_t
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_set_t
   use generic_item, only: column_number, fill_item
   use item, only: item_t
   use kind_info, only: is_of_space, kind_info_t
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: find_set, make_item

contains

   !> A row of a kind with its numbers zero but those given.
   subroutine make_item(info, names, numbers, item)
      type(kind_info_t), intent(in) :: info      !! the kind
      character(*), intent(in) :: names(:)       !! (n) columns
      real(wp), intent(in) :: numbers(:)         !! (n) their numbers, SI [any]
      type(item_t), intent(out) :: item          !! the row

      type(random_t) :: random
      integer :: c

      random%state = 3_i8
      call fill_item(info, 1, random, item)
      do c = 1, size(item%values)
         item%values(c)%number = 0.0_wp
         item%values(c)%given = .false.
         if (allocated(item%values(c)%table)) deallocate (item%values(c)%table)
      end do
      do c = 1, size(names)
         item%values(column_number(info, trim(names(c))))%number = numbers(c)
         item%values(column_number(info, trim(names(c))))%given = .true.
      end do
      item%values(column_number(info, "i"))%index = 1
      item%values(column_number(info, "j"))%index = 2
   end subroutine make_item

   !> An empty set of a kind.
   subroutine find_set(name, is_spatial, set, info)
      character(*), intent(in) :: name                       !! of the kind
      logical, intent(in) :: is_spatial                      !! of space
      class(force_set_t), allocatable, intent(out) :: set    !! the set
      type(kind_info_t), intent(out) :: info                 !! the kind

      integer :: k

      do k = 1, n_force_kinds()
         call new_force_set(k, set)
         info = set%info()
         if (info%name == name .and. is_of_space(info, is_spatial)) return
      end do
      error stop "frame_spring_rows: no such kind"
   end subroutine find_set

end module frame_spring_rows
