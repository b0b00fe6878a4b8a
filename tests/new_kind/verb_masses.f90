!> `gudgeon masses DECK`: the mass of each body, and their sum.
module verb_masses
   use console, only: say
   use errors, only: error_t
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use options, only: options_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: list_masses

contains

   !> Write the list; with `--total` the sum only.
   subroutine list_masses(options, error)
      type(options_t), intent(in) :: options            !! the command line
      type(error_t), allocatable, intent(out) :: error  !! errors of the deck

      type(loaded_t) :: loaded
      real(wp) :: total
      integer :: k

      call load_deck(options, loaded, error)
      if (allocated(error)) return
      total = 0.0_wp
      associate (bodies => loaded%scene%bodies)
         do k = 1, bodies%n
            total = total + bodies%mass(k)
            if (.not. options%is_total) call say(bodies%names(k)%s//" "//real_text(bodies%mass(k), 6)//" kg")
         end do
      end associate
      call say("total "//real_text(total, 6)//" kg")
   end subroutine list_masses

end module verb_masses
