!> Which channels the statistics are of.
submodule(statistics) statistics_words
   implicit none (type, external)

contains

   !> The numbers that words name, then further ones, each once.
   module procedure take_words
      type(item_finder_t) :: finder
      type(scalar_t), allocatable :: scalars(:)
      type(selection_t) :: taken
      character(:), allocatable :: hint, message
      integer :: k, n

      allocate (list(64))
      n = 0
      call taken%clear(catalogue)
      if (allocated(words)) then
         call finder%start(catalogue)
         do k = 1, size(words)
            call find_scalars(words(k)%s, catalogue, finder, scalars, message, hint)
            call add_scalars(scalars)
         end do
      end if
      call add_scalars(more)
      list = list(:n)

   contains

      !> Append numbers that are not in the list yet; it grows by doubling.
      subroutine add_scalars(scalars)
         type(scalar_t), intent(in) :: scalars(:)  !! (any) numbers

         type(scalar_t), allocatable :: larger(:)
         integer :: i

         do i = 1, size(scalars)
            associate (is_taken => taken%groups(scalars(i)%group)%mask(scalars(i)%component, scalars(i)%item))
               if (is_taken) cycle
               is_taken = .true.
            end associate
            if (n == size(list)) then
               allocate (larger(2*n))
               larger(:n) = list
               call move_alloc(larger, list)
            end if
            n = n + 1
            list(n) = scalars(i)
         end do
      end subroutine add_scalars

   end procedure take_words

end submodule statistics_words
