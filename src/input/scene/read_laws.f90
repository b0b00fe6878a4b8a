!> Contact laws, friction laws and wear laws of a deck: one object per row.
module read_laws
   use contact_registry, only: n_friction_kinds, n_law_kinds, n_wear_kinds, new_friction_law, new_normal_law, new_wear_law
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use item, only: item_t
   use kind_info, only: is_of_space
   use kind_list, only: friction_info, law_info, wear_info
   use references, only: add_names, directory_t
   use scene, only: friction_slot_t, law_slot_t, scene_t
   use scene_checks, only: report_doubled
   use tables, only: read_items
   use wear_law, only: wear_slot_t
   implicit none (type, external)
   private
   public :: laws_from_deck, make_frictions, make_laws, make_wears

contains

   !> Normal laws, friction laws and wear laws: one object per row, names unique over all kinds of laws.
   subroutine laws_from_deck(deck, scene, directory, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! laws are set
      type(directory_t), intent(inout) :: directory       !! names of the laws are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: before, k, n

      allocate (scene%laws(0), scene%frictions(0), directory%laws(0), directory%frictions(0))
      do k = 1, n_law_kinds()
         scene%tables%laws(k)%info => law_info(k)
         before = diagnostics%count()
         call read_items(deck, scene%tables%laws(k)%info, scene%tables%laws(k)%items, diagnostics)
         associate (items => scene%tables%laws(k)%items)
            n = size(scene%laws)
            call grow_laws(scene%laws, n + size(items))
            call report_doubled(items, directory%laws, diagnostics)
            call make_laws(k, items, diagnostics%count() > before, scene%laws(n + 1:), diagnostics)
            call add_names(items, directory%laws)
         end associate
      end do
      do k = 1, n_friction_kinds()
         scene%tables%frictions(k)%info => friction_info(k)
         before = diagnostics%count()
         if (is_of_space(scene%tables%frictions(k)%info, scene%settings%is_spatial)) then
            call read_items(deck, scene%tables%frictions(k)%info, scene%tables%frictions(k)%items, diagnostics)
         else
            allocate (scene%tables%frictions(k)%items(0))
         end if
         associate (items => scene%tables%frictions(k)%items)
            n = size(scene%frictions)
            call grow_frictions(scene%frictions, n + size(items))
            call report_doubled(items, directory%frictions, diagnostics)
            call make_frictions(k, items, diagnostics%count() > before, scene%frictions(n + 1:), diagnostics)
            call add_names(items, directory%frictions)
         end associate
      end do
      call wears_from_deck(deck, scene, directory, diagnostics)
   end subroutine laws_from_deck

   !> Wear laws.
   subroutine wears_from_deck(deck, scene, directory, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! wear laws are set
      type(directory_t), intent(inout) :: directory       !! names of the wear laws are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: before, k, n
      logical :: has_mistakes(n_wear_kinds())

      do k = 1, n_wear_kinds()
         scene%tables%wears(k)%info => wear_info(k)
         before = diagnostics%count()
         call read_items(deck, scene%tables%wears(k)%info, scene%tables%wears(k)%items, diagnostics)
         has_mistakes(k) = diagnostics%count() > before
      end do
      allocate (scene%wears(sum([(size(scene%tables%wears(k)%items), k=1, n_wear_kinds())])), directory%wears(0))
      n = 0
      do k = 1, n_wear_kinds()
         associate (items => scene%tables%wears(k)%items)
            call report_doubled(items, directory%wears, diagnostics)
            call make_wears(k, items, has_mistakes(k), scene%wears(n + 1:), diagnostics)
            call add_names(items, directory%wears)
            n = n + size(items)
         end associate
      end do
   end subroutine wears_from_deck

   !> The normal laws of the rows of one kind.
   subroutine make_laws(kind, items, has_mistakes, laws, diagnostics)
      integer, intent(in) :: kind                         !! number in the registry
      type(item_t), intent(in) :: items(:)                !! (n) rows
      logical, intent(in) :: has_mistakes                 !! no law is made of rows with errors
      type(law_slot_t), intent(inout) :: laws(:)          !! (n or more) the laws
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: i
      logical :: is_broken

      is_broken = has_mistakes
      do i = 1, size(items)
         call new_normal_law(kind, laws(i)%law)
         if (is_broken) cycle
         call laws(i)%law%prepare(items(i))
         is_broken = laws(i)%law%mistake() /= ""
         if (is_broken) call diagnostics%add(items(i)%location, laws(i)%law%mistake(), "in this row")
      end do
   end subroutine make_laws

   !> The friction laws of the rows of one kind.
   subroutine make_frictions(kind, items, has_mistakes, laws, diagnostics)
      integer, intent(in) :: kind                         !! number in the registry
      type(item_t), intent(in) :: items(:)                !! (n) rows
      logical, intent(in) :: has_mistakes                 !! no law is made of rows with errors
      type(friction_slot_t), intent(inout) :: laws(:)     !! (n or more) the laws
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: i
      logical :: is_broken

      is_broken = has_mistakes
      do i = 1, size(items)
         call new_friction_law(kind, laws(i)%law)
         if (is_broken) cycle
         call laws(i)%law%prepare(items(i))
         is_broken = laws(i)%law%mistake() /= ""
         if (is_broken) call diagnostics%add(items(i)%location, laws(i)%law%mistake(), "in this row")
      end do
   end subroutine make_frictions

   !> The wear laws of the rows of one kind.
   subroutine make_wears(kind, items, has_mistakes, laws, diagnostics)
      integer, intent(in) :: kind                         !! number in the registry
      type(item_t), intent(in) :: items(:)                !! (n) rows
      logical, intent(in) :: has_mistakes                 !! no law is made of rows with errors
      type(wear_slot_t), intent(inout) :: laws(:)         !! (n or more) the laws
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: i
      logical :: is_broken

      is_broken = has_mistakes
      do i = 1, size(items)
         call new_wear_law(kind, laws(i)%law)
         if (is_broken) cycle
         call laws(i)%law%prepare(items(i))
         is_broken = laws(i)%law%mistake() /= ""
         if (is_broken) call diagnostics%add(items(i)%location, laws(i)%law%mistake(), "in this row")
      end do
   end subroutine make_wears

   !> Longer list of laws.
   subroutine grow_laws(laws, n)
      type(law_slot_t), allocatable, intent(inout) :: laws(:)  !! list, grown
      integer, intent(in) :: n                                 !! new length

      type(law_slot_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(n))
      do k = 1, size(laws)
         call move_alloc(laws(k)%law, grown(k)%law)
      end do
      call move_alloc(grown, laws)
   end subroutine grow_laws

   !> Longer list of friction laws.
   subroutine grow_frictions(laws, n)
      type(friction_slot_t), allocatable, intent(inout) :: laws(:)  !! list, grown
      integer, intent(in) :: n                                      !! new length

      type(friction_slot_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(n))
      do k = 1, size(laws)
         call move_alloc(laws(k)%law, grown(k)%law)
      end do
      call move_alloc(grown, laws)
   end subroutine grow_frictions

end module read_laws
