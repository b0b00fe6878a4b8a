!> The scene of a deck whose parameters have other numbers than when it was read: only what they stand in is read again.
module change_scene
   use clearance_registry, only: n_clearance_kinds
   use contact_registry, only: n_friction_kinds, n_law_kinds, n_wear_kinds
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use film_registry, only: n_film_kinds
   use force_registry, only: n_force_kinds
   use joint_registry, only: n_joint_kinds
   use kind_info, only: is_of_space
   use read_films, only: check_lubricants, make_films
   use read_laws, only: make_frictions, make_laws, make_wears
   use read_scene, only: check_space, finish_scene, list_names, resolve_tables
   use read_states, only: make_states
   use references, only: add_names, directory_t
   use scene, only: n_base, scene_t, table_t
   use tables, only: read_items
   use text, only: starts_with
   use worn_registry, only: n_worn_kinds
   implicit none (type, external)
   private
   public :: scene_with_changes

contains

   !> Bring a scene up to date. Names and words are those of before. Without success the deck must be read anew: something has
   !> changed beyond the tables of bodies, joints, forces, clearances, laws, films and worn surfaces, or there are errors.
   subroutine scene_with_changes(deck, is_touched, scene, is_done)
      type(deck_t), intent(inout) :: deck           !! the deck with other numbers (`change_parameters`)
      logical, intent(in) :: is_touched(:)          !! (sections) whether they may mean something else
      type(scene_t), intent(inout) :: scene         !! of the deck as it was; of use only after success
      logical, intent(out) :: is_done               !! success

      type(diagnostics_t) :: mistakes
      type(directory_t) :: directory
      logical :: has_changed, is_read(size(is_touched))
      integer :: k

      is_read = .not. is_touched
      do k = 1, size(is_read)  ! tables of studies are no part of the scene
         associate (name => deck%sections(k)%name//".")
            is_read(k) = is_read(k) .or. starts_with(name, "tolerance.") .or. starts_with(name, "fit.")
         end associate
      end do
      do k = 1, n_base
         call read_again(scene%tables%base(k))
      end do
      do k = 1, n_joint_kinds()
         call read_again(scene%joints(k))
      end do
      do k = 1, n_force_kinds()
         call read_again(scene%forces(k))
      end do
      do k = 1, n_clearance_kinds()
         call read_again(scene%clearances(k))
      end do
      call read_again(scene%tables%states, has_changed)
      if (has_changed) call make_states(deck, scene, mistakes)
      do k = 1, n_worn_kinds()
         call read_again(scene%tables%worn(k))
      end do
      call list_names(scene, directory)
      call make_again()
      is_done = all(is_read) .and. mistakes%count() == 0
      if (.not. is_done) return
      deck%defaults%n = deck%n_written  ! what is read again takes the same defaults
      call resolve_tables(directory, scene, mistakes)
      call check_lubricants(scene, mistakes)
      call check_space(scene, mistakes)
      if (mistakes%count() == 0) call finish_scene(deck, scene, mistakes)
      is_done = mistakes%count() == 0

   contains

      !> Read the rows of a kind again, if they may mean something else.
      subroutine read_again(table, has_changed)
         type(table_t), intent(inout) :: table                !! the kind and its rows
         logical, intent(out), optional :: has_changed        !! whether they were read

         logical :: is_meant
         integer :: i

         is_meant = .false.
         do i = 1, size(is_touched)
            if (.not. is_touched(i)) cycle
            if (deck%sections(i)%name /= table%info%name) cycle
            if (.not. is_of_space(table%info, scene%settings%is_spatial)) cycle
            is_meant = .true.
            is_read(i) = .true.
         end do
         if (is_meant) call read_items(deck, table%info, table%items, mistakes)
         if (present(has_changed)) has_changed = is_meant
      end subroutine read_again

      !> Laws and films: those of rows that were read again are made again, all have their names.
      subroutine make_again()
         integer :: i, n
         logical :: has_changed

         n = 0
         do i = 1, n_law_kinds()
            call read_again(scene%tables%laws(i), has_changed)
            associate (items => scene%tables%laws(i)%items)
               if (has_changed) call make_laws(i, items, mistakes%count() > 0, scene%laws(n + 1:), mistakes)
               call add_names(items, directory%laws)
               n = n + size(items)
            end associate
         end do
         n = 0
         do i = 1, n_friction_kinds()
            call read_again(scene%tables%frictions(i), has_changed)
            associate (items => scene%tables%frictions(i)%items)
               if (has_changed) call make_frictions(i, items, mistakes%count() > 0, scene%frictions(n + 1:), mistakes)
               call add_names(items, directory%frictions)
               n = n + size(items)
            end associate
         end do
         n = 0
         do i = 1, n_wear_kinds()
            call read_again(scene%tables%wears(i), has_changed)
            associate (items => scene%tables%wears(i)%items)
               if (has_changed) call make_wears(i, items, mistakes%count() > 0, scene%wears(n + 1:), mistakes)
               call add_names(items, directory%wears)
               n = n + size(items)
            end associate
         end do
         n = 0
         do i = 1, n_film_kinds()
            call read_again(scene%tables%films(i), has_changed)
            associate (items => scene%tables%films(i)%items)
               if (has_changed) call make_films(i, items, mistakes%count() > 0, scene%lubrication%films(n + 1:), mistakes)
               call add_names(items, directory%films)
               n = n + size(items)
            end associate
         end do
      end subroutine make_again

   end subroutine scene_with_changes

end module change_scene
