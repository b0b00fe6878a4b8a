!> The kinds of films: two lines each (`use`, `case`), and their number.
module film_registry
   use film_butenschoen, only: film_butenschoen_t
   use film_finite, only: film_finite_t
   use film_grid, only: film_grid_t
   use film_law, only: film_law_t
   use film_long_exact, only: film_long_exact_t
   use film_long_gumbel, only: film_long_gumbel_t
   use film_long_sommerfeld, only: film_long_sommerfeld_t
   use film_pinkus_sternlicht, only: film_pinkus_sternlicht_t
   use film_short_exact, only: film_short_exact_t
   use film_short_gumbel, only: film_short_gumbel_t
   use film_short_sommerfeld, only: film_short_sommerfeld_t
   use film_spherical, only: film_spherical_t
   use film_squeeze, only: film_squeeze_t
   implicit none (type, external)
   private
   public :: n_film_kinds, n_journal_film_kinds, new_film_law

contains

   !> Number of films.
   pure integer function n_film_kinds()
      n_film_kinds = 12
   end function n_film_kinds

   !> The first of them, of journals; the last one is of a ball.
   pure integer function n_journal_film_kinds()
      n_journal_film_kinds = n_film_kinds() - 1
   end function n_journal_film_kinds

   !> A film of kind number k, 1 to `n_film_kinds`.
   subroutine new_film_law(k, law)
      integer, intent(in) :: k                            !! number of the kind
      class(film_law_t), allocatable, intent(out) :: law  !! the film, without parameters

      select case (k)
      case (1); allocate (film_short_sommerfeld_t :: law)
      case (2); allocate (film_short_gumbel_t :: law)
      case (3); allocate (film_long_sommerfeld_t :: law)
      case (4); allocate (film_long_gumbel_t :: law)
      case (5); allocate (film_pinkus_sternlicht_t :: law)
      case (6); allocate (film_short_exact_t :: law)
      case (7); allocate (film_long_exact_t :: law)
      case (8); allocate (film_squeeze_t :: law)
      case (9); allocate (film_butenschoen_t :: law)
      case (10); allocate (film_finite_t :: law)
      case (11); allocate (film_grid_t :: law)
      case (12); allocate (film_spherical_t :: law)
      end select
   end subroutine new_film_law

end module film_registry
