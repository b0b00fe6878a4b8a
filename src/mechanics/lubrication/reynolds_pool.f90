!> Grids of films, shared by all that are alike.
!>
!> A grid is made when it is first asked for, one for each L/D (with tilt, another one), and stays as long as the program: all films
!> with the same supplies, bore, resolution and boundary share them. Each solution starts with the wet cells of the one before and
!> does not depend on it.
module reynolds_pool
   use bore_profile, only: bore_t, same_bore
   use kinds, only: wp
   use reynolds_grid, only: boundary_reynolds, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   implicit none (type, external)
   private
   public :: columns_of, find_grid, find_pool, grid_form_t, grid_pool_t, rows_of

   integer, parameter :: columns_of(3) = [80, 160, 240]           !! of the words of `resolution`
   integer, parameter :: rows_of(3) = [10, 16, 24]                !! rows of the half length
   real(wp), parameter :: same_ratio = 1.0e-12_wp                 !! ratios L/D that differ by less are equal [1]

   !> What grids are like.
   type :: grid_form_t
      type(supply_t), allocatable :: supply(:)       !! where lubricant comes in, pressures in Pa
      integer :: resolution = 2                      !! coarse, normal, fine
      integer :: boundary = boundary_reynolds        !! where pressures end
      type(bore_t) :: bore                           !! the bore
   end type grid_form_t

   !> Grids that films share.
   type :: grid_pool_t
      type(grid_form_t) :: form                      !! what they are like
      type(grid_pool_t), pointer :: next => null()   !! the pool made before
      type(reynolds_grid_t), allocatable :: grid(:)  !! the grids
      real(wp), allocatable :: pressure(:)           !! (grids) P of the supplies in the last solution; huge: no solution [1/s]
   end type grid_pool_t

   type(grid_pool_t), pointer :: last_pool => null()  !! of all that were made: films come and go, and copies of them

contains

   !> The pool of grids of a form; it is made if it is not there.
   subroutine find_pool(form, pool)
      type(grid_form_t), intent(in) :: form              !! what they are like
      type(grid_pool_t), pointer, intent(out) :: pool    !! the pool

      pool => last_pool
      do while (associated(pool))
         if (same_form(pool%form, form)) return
         pool => pool%next
      end do
      allocate (pool)
      pool%form = form
      pool%next => last_pool
      allocate (pool%grid(0), pool%pressure(0))
      last_pool => pool
   end subroutine find_pool

   !> Whether grids are alike.
   pure logical function same_form(a, b)
      type(grid_form_t), intent(in) :: a  !! one form
      type(grid_form_t), intent(in) :: b  !! the other

      same_form = a%resolution == b%resolution .and. a%boundary == b%boundary .and. size(a%supply) == size(b%supply)
      if (same_form) same_form = all(are_equal(a%supply, b%supply))
      if (same_form) same_form = same_bore(a%bore, b%bore)
   end function same_form

   !> Whether two supplies are one and the same.
   elemental logical function are_equal(a, b)
      type(supply_t), intent(in) :: a  !! one
      type(supply_t), intent(in) :: b  !! the other

      are_equal = (a%is_at_widest_gap .eqv. b%is_at_widest_gap) .and. &
                  .not. any(abs([a%angle - b%angle, a%width - b%width, a%length - b%length, a%pressure - b%pressure]) > 0.0_wp)
   end function are_equal

   !> Number of the grid of an L/D; it is made if it is not there.
   subroutine find_grid(pool, ratio, is_tilted, number)
      type(grid_pool_t), intent(inout) :: pool  !! the grids
      real(wp), intent(in) :: ratio             !! L/D [1]
      logical, intent(in) :: is_tilted          !! over the whole length
      integer, intent(out) :: number            !! of the grid

      type(reynolds_grid_t), allocatable :: grids(:)
      integer :: n

      n = size(pool%grid)
      do number = 1, n
         if (pool%grid(number)%is_whole .neqv. is_tilted) cycle
         if (abs(pool%grid(number)%ratio - ratio) <= same_ratio*ratio) return
      end do
      allocate (grids(n + 1))
      grids(:n) = pool%grid
      associate (form => pool%form)
         if (form%bore%is_round()) then
            call new_reynolds_grid(grids(number), ratio, columns_of(form%resolution), rows_of(form%resolution), form%boundary, &
                                   form%supply, is_tilted)
         else
            call new_reynolds_grid(grids(number), ratio, columns_of(form%resolution), rows_of(form%resolution), form%boundary, &
                                   form%supply, is_tilted, form%bore)
         end if
      end associate
      call move_alloc(grids, pool%grid)
      pool%pressure = [pool%pressure, huge(1.0_wp)]
   end subroutine find_grid

end module reynolds_pool
