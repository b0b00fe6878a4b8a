!> Columns of another program as a history: channels in SI with the names of a run's, and impacts where a normal force rises from
!> zero.
!>
!> Limits: the columns of one file.
module column_history
   use channel_spec, only: spec_t
   use column_file, only: column_table_t, find_column_of, unit_in_name
   use errors, only: error_t, exit_usage, set_error
   use kinds, only: not_a_number, wp
   use name_table, only: name_table_t
   use series, only: append_series, enter_names, history_t, impact_t, series_t
   use spelling, only: nearest_word
   use text, only: append_text, segment, starts_with, text_t, to_text
   use units, only: parse_unit, to_si, unit_t
   implicit none (type, external)
   private
   public :: history_of_columns

contains

   !> Columns as a history: the channels that are asked for, or those whose names are channels.
   subroutine history_of_columns(path, table, specs, time, like, history, error)
      character(*), intent(in) :: path                    !! of the file
      type(column_table_t), intent(in) :: table           !! its columns
      type(spec_t), intent(in) :: specs(:)                !! (n) what is asked for; none: all that have names of channels
      type(spec_t), intent(in) :: time                    !! column of the time
      type(history_t), intent(in) :: like                 !! the run that has the channels
      type(history_t), intent(out) :: history             !! the columns
      type(error_t), allocatable, intent(out) :: error    !! no such column or channel, or a unit that does not match

      character(*), parameter :: row_kind = "row_kind"  ! of the text files of a run
      character(:), allocatable :: base
      type(spec_t) :: spec
      real(wp), allocatable :: kinds(:)
      type(name_table_t) :: known, more
      integer :: k, n

      history%path = path
      n = 0
      allocate (history%list(0), history%impacts(0))
      call enter_names(like%list, known)
      spec = time
      if (size(spec%columns) == 0) call append_text(spec%columns, "1")
      call take_column(table, spec, spec%columns(1)%s, "s", history%time, error)
      if (allocated(error)) return
      history%time = time%scale*history%time + time%offset
      allocate (history%is_output(size(history%time)), source=.true.)
      if (find_column_of(table, row_kind) > 0) then  ! of a run: some rows are of contacts
         spec = spec_t()
         spec%channel = row_kind
         spec%unit = ""
         call take_column(table, spec, row_kind, "1", kinds, error)
         if (allocated(error)) return
         history%is_output = kinds < 0.5_wp
      end if
      do k = 2, size(history%time)
         if (history%time(k) < history%time(k - 1)) call set_error(error, exit_usage, "the time of "//path//" decreases at row "// &
               to_text(k))
         if (allocated(error)) return
      end do
      do k = 1, size(specs)
         call take_spec(table, specs(k), like, known, history, more, n, error)
         if (allocated(error)) return
      end do
      if (size(specs) == 0) call take_names()
      if (allocated(error)) return
      call cut()
      if (size(history%list) == 0) call set_error(error, exit_usage, "no column of "//path//" has the name of a channel"// &
         new_line("a")//"  = assign columns to channels:  --channel ""slider.position.x=2 unit=mm""")

   contains

      !> Take the columns whose names are channels.
      subroutine take_names()
         base = path(index(path, "/", back=.true.) + 1:)
         base = segment(base, 1, index(base//".", ".") - 1)
         do k = 1, size(like%list)
            spec = spec_t()
            spec%channel = like%list(k)%name
            spec%unit = ""
            allocate (spec%columns(0))
            call append_text(spec%columns, spec%channel)
            if (find_column_of(table, spec%channel) == 0 .and. starts_with(spec%channel, base//".")) then
               spec%columns(1)%s = spec%channel(len(base) + 2:)
            end if
            if (find_column_of(table, spec%columns(1)%s) > 0) call take_spec(table, spec, like, known, history, more, n, error)
            if (allocated(error)) return
         end do
      end subroutine take_names

      !> Give back the room that the list does not need.
      subroutine cut()
         type(series_t), allocatable :: list(:)
         logical :: is_used(size(history%list))

         allocate (list(0))
         is_used = .false.
         is_used(:n) = .true.
         call append_series(list, history%list, is_used)
         call move_alloc(list, history%list)
      end subroutine cut

   end subroutine history_of_columns

   !> Twice as much storage for series.
   subroutine make_storage(list)
      type(series_t), allocatable, intent(inout) :: list(:)   !! grown

      type(series_t), allocatable :: grown(:), larger(:)

      allocate (grown(0), larger(size(list) + 16))
      call append_series(grown, list, spread(.true., 1, size(list)))
      call append_series(grown, larger, spread(.true., 1, size(larger)))
      call move_alloc(grown, list)
   end subroutine make_storage

   !> A column in SI.
   subroutine take_column(table, spec, word, si, x, error)
      type(column_table_t), intent(in) :: table            !! the columns
      type(spec_t), intent(in) :: spec                     !! for the unit
      character(*), intent(in) :: word                     !! name or number of the column
      character(*), intent(in) :: si                       !! SI unit of the channel
      real(wp), allocatable, intent(out) :: x(:)           !! (n) its numbers [any]
      type(error_t), allocatable, intent(out) :: error     !! no such column, or a unit that does not match

      character(:), allocatable :: message, name
      type(text_t), allocatable :: known(:)
      type(unit_t) :: unit, wanted
      integer :: first, k, last

      k = find_column_of(table, word)
      if (k == 0) then
         known = table%names
         name = nearest_word(word, known)
         if (name /= "") name = "; did you mean '"//name//"'?"
         call set_error(error, exit_usage, "no column '"//word//"' for "//spec%channel//name//new_line("a")//"  = there are "// &
                        to_text(size(table%x, 1))//" columns:"//listed(known))
         return
      end if
      name = spec%unit
      if (name == "" .and. size(table%names) > 0) name = unit_in_name(table%names(k)%s)
      if (name == "") name = si
      call parse_unit(name, unit, message, first, last)
      if (message == "" .and. si /= "") then
         call parse_unit(si, wanted, message, first, last)
         if (.not. alike(unit, wanted)) message = "unit '"//name//"' does not match "//spec%channel//", which is in "//si
      end if
      if (message /= "") then
         call set_error(error, exit_usage, message//new_line("a")//"  = column '"//word//"'; give its unit with unit=...")
         return
      end if
      x = [(to_si(table%x(k, first), unit), first=1, size(table%x, 2))]
   end subroutine take_column

   !> Names in a row.
   pure function listed(names) result(words)
      type(text_t), intent(in) :: names(:)     !! (n) the names
      character(:), allocatable :: words       !! each in quotes, with a blank before it

      integer :: k

      words = ""
      do k = 1, size(names)
         words = words//" '"//names(k)%s//"'"
      end do
      if (size(names) == 0) words = " without names; use numbers from 1 on"
   end function listed

   !> Whether two units measure the same; radians are no dimension where the other has none.
   pure logical function alike(a, b)
      type(unit_t), intent(in) :: a   !! a unit
      type(unit_t), intent(in) :: b   !! another one

      alike = abs(a%dimension%kg - b%dimension%kg) + abs(a%dimension%m - b%dimension%m) + abs(a%dimension%s - b%dimension%s) + &
              abs(a%dimension%k - b%dimension%k) < 1.0e-9_wp
   end function alike

   !> The columns of one channel, or of a vector.
   subroutine take_spec(table, spec, like, known, history, more, n_more, error)
      type(column_table_t), intent(in) :: table            !! the columns
      type(spec_t), intent(in) :: spec                     !! what is asked for
      type(history_t), intent(in) :: like                  !! the run that has the channels
      type(name_table_t), intent(in) :: known              !! its channels
      type(history_t), intent(inout) :: history            !! grown; its list has room
      type(name_table_t), intent(inout) :: more            !! its channels
      integer, intent(inout) :: n_more                     !! how many
      type(error_t), allocatable, intent(out) :: error     !! no such column or channel

      character(1), parameter :: axes(3) = ["x", "y", "z"]
      type(series_t) :: new(3)
      type(text_t), allocatable :: columns(:)
      real(wp), allocatable :: x(:, :)
      integer :: c, i, k, n
      logical :: is_vector

      columns = spec%columns
      if (size(columns) == 0) call append_text(columns, spec%channel)
      n = size(columns)
      is_vector = n > 1
      if (n > 3) then
         call set_error(error, exit_usage, spec%channel//" has more than three columns")
         return
      end if
      allocate (x(size(history%time), 3), source=0.0_wp)
      do c = 1, n
         new(c)%name = spec%channel
         if (is_vector) new(c)%name = spec%channel//"."//axes(c)
         i = known%find(new(c)%name)
         if (i == 0) then
            call set_error(error, exit_usage, "the run has no channel '"//new(c)%name//"'"//nearest_of(like, new(c)%name))
            return
         end if
         new(c)%unit = like%list(i)%unit
         call take_column(table, spec, columns(c)%s, new(c)%unit, new(c)%x, error)
         if (allocated(error)) return
         x(:, c) = spec%scale*new(c)%x + spec%offset
      end do
      if (is_vector) x = matmul(x, transpose(spec%turn))
      do c = 1, n
         call more%enter(new(c)%name, n_more + 1, k)
         if (k > 0) cycle      ! the first that names it
         n_more = n_more + 1
         new(c)%x = x(:, c)
         if (n_more > size(history%list)) call make_storage(history%list)
         history%list(n_more) = new(c)
         if (index(new(c)%name, ".normal_force") > 0) call add_impacts(new(c), history)
      end do
   end subroutine take_spec

   !> Impacts where a normal force rises from zero.
   subroutine add_impacts(force, history)
      type(series_t), intent(in) :: force            !! of a contact
      type(history_t), intent(inout) :: history      !! grown

      type(impact_t) :: new
      integer :: i, last

      do i = 2, size(force%x)
         if (.not. (force%x(i) > 0.0_wp .and. force%x(i - 1) <= 0.0_wp)) cycle
         new%item = force%name(:index(force%name, ".normal_force") - 1)
         new%time = history%time(i - 1)
         new%speed = not_a_number()
         do last = i, size(force%x) - 1
            if (force%x(last + 1) <= 0.0_wp) exit
         end do
         new%force = maxval(force%x(i:min(last, size(force%x))))
         history%impacts = [history%impacts, new]
      end do
   end subroutine add_impacts

   !> The channel that was probably meant.
   function nearest_of(history, name) result(words)
      type(history_t), intent(in) :: history   !! the history
      character(*), intent(in) :: name         !! as written
      character(:), allocatable :: words       !! for a message

      type(text_t), allocatable :: known(:)
      integer :: k

      allocate (known(size(history%list)))
      do k = 1, size(known)
         known(k)%s = history%list(k)%name
      end do
      words = nearest_word(name, known)
      if (words /= "") words = "; did you mean '"//words//"'?"
   end function nearest_of

end module column_history
