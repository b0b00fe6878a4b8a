!> The tables of films and lubricants.
module read_films
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use film_law, only: film_slot_t
   use film_registry, only: n_film_kinds, new_film_law
   use item, only: item_t
   use kind_list, only: film_info
   use lubricant, only: lubricant_mistake
   use references, only: add_names, directory_t
   use scene, only: scene_t, table_lubricants
   use scene_checks, only: report_doubled
   use tables, only: read_items
   implicit none (type, external)
   private
   public :: check_lubricants, films_from_deck, make_films

contains

   !> Films: one object per row, names unique over all kinds of films.
   subroutine films_from_deck(deck, scene, directory, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! films are set
      type(directory_t), intent(inout) :: directory       !! names of the films are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: before, k, n

      allocate (scene%lubrication%films(0), directory%films(0))
      do k = 1, n_film_kinds()
         scene%tables%films(k)%info => film_info(k)
         before = diagnostics%count()
         call read_items(deck, scene%tables%films(k)%info, scene%tables%films(k)%items, diagnostics)
         associate (items => scene%tables%films(k)%items)
            n = size(scene%lubrication%films)
            call grow_films(scene%lubrication%films, n + size(items))
            call report_doubled(items, directory%films, diagnostics)
            call make_films(k, items, diagnostics%count() > before, scene%lubrication%films(n + 1:), diagnostics)
            call add_names(items, directory%films)
         end associate
      end do
   end subroutine films_from_deck

   !> The films of the rows of one kind.
   subroutine make_films(kind, items, has_mistakes, films, diagnostics)
      integer, intent(in) :: kind                         !! number in the registry
      type(item_t), intent(in) :: items(:)                !! (n) rows
      logical, intent(in) :: has_mistakes                 !! no film is made of rows with errors
      type(film_slot_t), intent(inout) :: films(:)        !! (n or more) the films
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: i
      logical :: is_broken

      is_broken = has_mistakes
      do i = 1, size(items)
         call new_film_law(kind, films(i)%law)
         if (is_broken) cycle
         call films(i)%law%prepare(items(i))
         is_broken = films(i)%law%mistake() /= ""
         if (is_broken) call diagnostics%add(items(i)%location, films(i)%law%mistake(), "in this row")
      end do
   end subroutine make_films

   !> Rows of lubricants as a whole.
   subroutine check_lubricants(scene, diagnostics)
      type(scene_t), intent(in) :: scene                  !! tables
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      character(:), allocatable :: help, message
      integer :: column, i

      associate (items => scene%tables%base(table_lubricants)%items)
         do i = 1, size(items)
            call lubricant_mistake(items(i), column, message, help)
            if (column == 0) cycle
            call diagnostics%add(items(i)%location, message, "in this row", help)
         end do
      end associate
   end subroutine check_lubricants

   !> Longer list of films.
   subroutine grow_films(films, n)
      type(film_slot_t), allocatable, intent(inout) :: films(:)  !! list, grown
      integer, intent(in) :: n                                   !! new length

      type(film_slot_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(n))
      do k = 1, size(films)
         call move_alloc(films(k)%law, grown(k)%law)
      end do
      call move_alloc(grown, films)
   end subroutine grow_films

end module read_films
