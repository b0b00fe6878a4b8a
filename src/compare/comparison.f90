!> A comparison of a run with another run, or with columns of another program: all channels, impacts, the verdict.
!>
!> Channels are compared at the output instants of the second (`differences_of_series`), where both have some. A channel differs
!> if the
!> greatest difference is more than what is allowed: the larger of `absolute` and `relative` times its greatest magnitude in the
!> first.
!> By statistics, it differs if its mean or its mean square is further apart than that (for the square: of the magnitudes'
!> product) and
!> the significance, times the number of channels, is below 5 %: of a hundred equal channels not one is to be found different.
!>
!> Limits: impacts are paired in their order, joint by joint.
module comparison
   use channel_spec, only: spec_t
   use column_file, only: column_table_t, find_column_of, unit_in_name
   use differences_of_series, only: at_instants, compare_values, difference_t
   use errors, only: error_t, exit_usage, set_error
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use series, only: history_t, impact_t, series_t
   use spelling, only: nearest_word
   use text, only: append_text, piece, starts_with, text_t, to_text
   use units, only: parse_unit, to_si, unit_t
   implicit none (type, external)
   private
   public :: compare_histories, comparison_t, history_of_columns, pair_t

   !> Impacts of both, in pairs.
   type :: pair_t
      character(:), allocatable :: item       !! joint, and label of the contact
      integer :: number = 0                   !! in the order of the joint's impacts
      type(impact_t) :: a                     !! of the first
      type(impact_t) :: b                     !! of the second
   end type pair_t

   !> Everything that was found.
   type :: comparison_t
      type(difference_t), allocatable :: list(:)        !! (channels)
      type(pair_t), allocatable :: pairs(:)             !! (n) first impacts
      real(wp), allocatable :: t(:)                     !! (m) instants compared [s]
      real(wp), allocatable :: a(:, :)                  !! (m, channels) the first [any]
      real(wp), allocatable :: b(:, :)                  !! (m, channels) the second [any]
      logical :: by_statistics = .false.                !! how it was judged
      integer :: n_different = 0                        !! channels that differ
      type(text_t), allocatable :: missing(:)           !! (k) channels that only one of them has
   end type comparison_t

   integer, parameter :: first_impacts = 10   !! of each joint

contains

   !> Columns as a history: the channels that are asked for, or those whose names are channels.
   subroutine history_of_columns(path, table, specs, time, like, history, error)
      character(*), intent(in) :: path                    !! of the file
      type(column_table_t), intent(in) :: table           !! its columns
      type(spec_t), intent(in) :: specs(:)                !! (n) what is asked for; none: all that have names of channels
      type(spec_t), intent(in) :: time                    !! column of the time
      type(history_t), intent(in) :: like                 !! the run that has the channels
      type(history_t), intent(out) :: history             !! the columns
      type(error_t), allocatable, intent(out) :: error    !! no such column or channel, or a unit that does not fit

      character(:), allocatable :: base
      type(spec_t) :: spec
      integer :: k

      history%path = path
      allocate (history%list(0), history%impacts(0))
      spec = time
      if (size(spec%columns) == 0) call append_text(spec%columns, "1")
      call take_column(table, spec, spec%columns(1)%s, "s", history%time, error)
      if (allocated(error)) return
      history%time = time%scale*history%time + time%offset
      allocate (history%is_output(size(history%time)), source=.true.)
      do k = 2, size(history%time)
         if (history%time(k) < history%time(k - 1)) call set_error(error, exit_usage, "the time of "//path//" falls at row "// &
               to_text(k))
         if (allocated(error)) return
      end do
      do k = 1, size(specs)
         call take_spec(table, specs(k), like, history, error)
         if (allocated(error)) return
      end do
      if (size(specs) > 0) return
      base = path(index(path, "/", back=.true.) + 1:)
      base = piece(base, 1, index(base//".", ".") - 1)
      do k = 1, size(like%list)
         spec = spec_t()
         spec%channel = like%list(k)%name
         spec%unit = ""
         allocate (spec%columns(0))
         call append_text(spec%columns, spec%channel)
         if (find_column_of(table, spec%channel) == 0 .and. starts_with(spec%channel, base//".")) then
            spec%columns(1)%s = spec%channel(len(base) + 2:)
         end if
         if (find_column_of(table, spec%columns(1)%s) > 0) call take_spec(table, spec, like, history, error)
         if (allocated(error)) return
      end do
      if (size(history%list) == 0) call set_error(error, exit_usage, "no column of "//path//" has the name of a channel"// &
         new_line("a")//"  = say which column is which:  --channel ""slider.position.x=2 unit=mm""")
   end subroutine history_of_columns

   !> A column in SI.
   subroutine take_column(table, spec, word, si, x, error)
      type(column_table_t), intent(in) :: table            !! the columns
      type(spec_t), intent(in) :: spec                     !! for the unit
      character(*), intent(in) :: word                     !! name or number of the column
      character(*), intent(in) :: si                       !! SI unit of the channel
      real(wp), allocatable, intent(out) :: x(:)           !! (n) its numbers [any]
      type(error_t), allocatable, intent(out) :: error     !! no such column, or a unit that does not fit

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
         if (.not. alike(unit, wanted)) message = "unit '"//name//"' does not fit "//spec%channel//", which is in "//si
      end if
      if (message /= "") then
         call set_error(error, exit_usage, message//new_line("a")//"  = column '"//word//"'; say its unit with unit=...")
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
      if (size(names) == 0) words = " they have no names; use numbers from 1 on"
   end function listed

   !> Whether two units measure the same; radians are no dimension where the other has none.
   pure logical function alike(a, b)
      type(unit_t), intent(in) :: a   !! a unit
      type(unit_t), intent(in) :: b   !! another one

      alike = abs(a%dimension%kg - b%dimension%kg) + abs(a%dimension%m - b%dimension%m) + abs(a%dimension%s - b%dimension%s) + &
              abs(a%dimension%k - b%dimension%k) < 1.0e-9_wp
   end function alike

   !> The columns of one channel, or of a vector.
   subroutine take_spec(table, spec, like, history, error)
      type(column_table_t), intent(in) :: table            !! the columns
      type(spec_t), intent(in) :: spec                     !! what is asked for
      type(history_t), intent(in) :: like                  !! the run that has the channels
      type(history_t), intent(inout) :: history            !! grown
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
         i = number_of(like, new(c)%name)
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
         do k = 1, size(history%list)
            if (history%list(k)%name == new(c)%name) exit
         end do
         if (k <= size(history%list)) cycle      ! the first that names it
         new(c)%x = x(:, c)
         history%list = [history%list, new(c)]
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

   !> Number of a channel in a history; 0: it is not there.
   pure integer function number_of(history, name) result(k)
      type(history_t), intent(in) :: history   !! the history
      character(*), intent(in) :: name         !! of the channel

      do k = 1, size(history%list)
         if (history%list(k)%name == name) return
      end do
      k = 0
   end function number_of

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

   !> Compare two histories.
   !> Length: instants, channels and verdict are found in one pass.
   subroutine compare_histories(a, b, specs, absolute, relative, by_statistics, found, error)
      type(history_t), intent(in) :: a                      !! the first
      type(history_t), intent(in) :: b                      !! the second
      type(spec_t), intent(in) :: specs(:)                  !! (n) channels that are asked for; none: all
      real(wp), intent(in) :: absolute                      !! difference allowed [any]
      real(wp), intent(in) :: relative                      !! the same, of the greatest magnitude [1]
      logical, intent(in) :: by_statistics                  !! how to judge
      type(comparison_t), intent(out) :: found              !! what was found
      type(error_t), allocatable, intent(out) :: error      !! nothing to compare

      real(wp), allocatable :: own(:), x(:)
      logical, allocatable :: is_inside(:)
      type(difference_t) :: new
      integer :: i, k, s

      found%by_statistics = by_statistics
      allocate (found%list(0), found%missing(0))
      own = pack(a%time, a%is_output)
      if (size(own) < 2 .or. count(b%is_output) < 1) then
         call set_error(error, exit_usage, "there are too few instants to compare: "//to_text(size(own))//" and "// &
                        to_text(count(b%is_output)))
         return
      end if
      is_inside = b%is_output .and. b%time >= own(1) - 1.0e-9_wp*(own(size(own)) - own(1)) .and. &
                  b%time <= own(size(own)) + 1.0e-9_wp*(own(size(own)) - own(1))
      found%t = pack(b%time, is_inside)
      if (size(found%t) == 0) then
         call set_error(error, exit_usage, "the times of both have nothing in common: shift or scale them with --time")
         return
      end if
      allocate (found%a(size(found%t), size(b%list)), found%b(size(found%t), size(b%list)))
      do k = 1, size(b%list)
         i = number_of(a, b%list(k)%name)
         s = spec_of(specs, b%list(k)%name)
         if (size(specs) > 0 .and. s == 0) cycle
         if (i == 0) then
            call append_text(found%missing, b%list(k)%name//" is in "//b%path//" only")
            cycle
         end if
         new = difference_t()
         new%name = b%list(k)%name
         new%unit = a%list(i)%unit
         x = pack(a%list(i)%x, a%is_output)
         associate (n => size(found%list) + 1)
            call at_instants(own, x, found%t, found%a(:, n), new%interpolation)
            found%b(:, n) = pack(b%list(k)%x, is_inside)
            if (s > 0) then
               call compare_values(found%t, found%a(:, n), found%b(:, n), specs(s)%modulo, new)
            else
               call compare_values(found%t, found%a(:, n), found%b(:, n), 0.0_wp, new)
            end if
         end associate
         call judge(new, allowance(specs, s, absolute, .true.), allowance(specs, s, relative, .false.), by_statistics, &
               size(b%list))
         found%list = [found%list, new]
      end do
      do i = 1, size(a%list)
         if (number_of(b, a%list(i)%name) > 0 .or. size(specs) > 0) cycle
         call append_text(found%missing, a%list(i)%name//" is in "//a%path//" only")
      end do
      found%n_different = count(found%list%is_different)
      if (size(found%list) == 0) call set_error(error, exit_usage, "both have no channel in common")
      call pair_impacts(a, b, found)
   end subroutine compare_histories

   !> The request that a channel goes with; 0: none.
   pure integer function spec_of(specs, name) result(s)
      type(spec_t), intent(in) :: specs(:)   !! (n) requests
      character(*), intent(in) :: name       !! of the channel

      do s = 1, size(specs)
         if (specs(s)%channel == name .or. starts_with(name, specs(s)%channel//".")) return
      end do
      s = 0
   end function spec_of

   !> What a request allows, or all.
   pure real(wp) function allowance(specs, s, common, is_absolute) result(x)
      type(spec_t), intent(in) :: specs(:)     !! (n) requests
      integer, intent(in) :: s                 !! number of the request; 0: none
      real(wp), intent(in) :: common           !! of all [any]
      logical, intent(in) :: is_absolute       !! which of the two

      x = common
      if (s == 0) return
      if (is_absolute .and. specs(s)%absolute >= 0.0_wp) x = specs(s)%absolute
      if (.not. is_absolute .and. specs(s)%relative >= 0.0_wp) x = specs(s)%relative
   end function allowance

   !> The verdict on a channel.
   subroutine judge(difference, absolute, relative, by_statistics, n_channel)
      type(difference_t), intent(inout) :: difference   !! compared
      real(wp), intent(in) :: absolute                  !! allowed [any]
      real(wp), intent(in) :: relative                  !! allowed [1]
      logical, intent(in) :: by_statistics              !! how
      integer, intent(in) :: n_channel                  !! channels that are judged

      real(wp), parameter :: level = 0.05_wp   ! significance of all together [1]

      associate (d => difference)
         d%allowed = max(absolute, relative*d%peak(1))
         d%is_different = .true.
         if (d%n == 0) return
         d%is_different = d%greatest > d%allowed
         if (.not. by_statistics) return
         d%is_different = (abs(d%mean%a%value - d%mean%b%value) > d%allowed .and. .not. is_chance(d%mean%significance)) .or. &
                          (abs(d%square%a%value - d%square%b%value) > d%allowed*maxval(d%peak) .and. &
                           .not. is_chance(d%square%significance))
      end associate

   contains

      !> Whether a difference may be chance; one of which that is not known is none.
      pure logical function is_chance(significance)
         real(wp), intent(in) :: significance   !! probability of such a difference by chance; NaN: not known [1]

         is_chance = .false.
         if (ieee_is_finite(significance)) is_chance = significance*real(n_channel, wp) >= level
      end function is_chance

   end subroutine judge

   !> The first impacts of each joint, in pairs.
   subroutine pair_impacts(a, b, found)
      type(history_t), intent(in) :: a             !! the first
      type(history_t), intent(in) :: b             !! the second
      type(comparison_t), intent(inout) :: found   !! with the pairs

      type(pair_t) :: new
      integer :: i, j, k, n

      allocate (found%pairs(0))
      do i = 1, size(a%impacts)
         n = count([(a%impacts(k)%item == a%impacts(i)%item, k=1, i)])
         if (n > first_impacts) cycle
         k = 0
         do j = 1, size(b%impacts)
            if (b%impacts(j)%item /= a%impacts(i)%item) cycle
            k = k + 1
            if (k == n) exit
         end do
         if (k < n .or. j > size(b%impacts)) cycle
         new%item = a%impacts(i)%item
         new%number = n
         new%a = a%impacts(i)
         new%b = b%impacts(j)
         found%pairs = [found%pairs, new]
      end do
   end subroutine pair_impacts

end module comparison
