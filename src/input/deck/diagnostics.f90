!> The errors of a deck, collected and shown with the text they stand in.
!>
!>     error: unknown column 'clearence' in table clearance.revolute
!>       --> inputs/slider_crank_dry.deck:50:30
!>        |
!>     50 | name     bearing   journal   clearence[mm]   level
!>        |                              ^^^^^^^^^ not a column of this kind
!>        = did you mean 'clearance'? columns: name bearing journal bearing_radius clearance ...
!>
!> They are sorted by place, doubled ones are dropped, and at most 20 are shown.
module diagnostics
   use errors, only: error_t, exit_deck, set_error
   use item, only: location_t
   use source_text, only: line_of, source_t
   use text, only: printable, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: diagnostics_t

   integer, parameter :: most_shown = 20     !! errors that are written out
   integer, parameter :: most_kept = 5000    !! errors that are remembered; more are only counted
   integer, parameter :: widest_line = 120   !! characters of a deck line that are shown

   !> One error.
   type :: mistake_t
      type(location_t) :: location          !! where
      character(:), allocatable :: summary  !! what
      character(:), allocatable :: note     !! beside the caret, may be empty
      character(:), allocatable :: help     !! what to do, may be empty
   end type mistake_t

   !> All errors found so far.
   type :: diagnostics_t
      private
      type(mistake_t), allocatable :: mistakes(:)  !! (capacity)
      integer :: n_kept = 0                        !! errors in the list
      integer :: n_all = 0                         !! errors found
   contains
      procedure :: add
      procedure :: count => count_mistakes
      procedure :: to_error
   end type diagnostics_t

contains

   !> Add an error.
   subroutine add(self, location, summary, note, help)
      class(diagnostics_t), intent(inout) :: self  !! the collection
      type(location_t), intent(in) :: location     !! where it stands
      character(*), intent(in) :: summary          !! one line: what is wrong
      character(*), intent(in), optional :: note   !! a few words beside the caret
      character(*), intent(in), optional :: help   !! what to do

      integer :: i, n

      do i = self%n_kept, max(1, self%n_kept - 40), -1
         if (same_place(self%mistakes(i)%location, location) .and. self%mistakes(i)%summary == summary) return
      end do
      self%n_all = self%n_all + 1
      if (self%n_kept == most_kept) return
      if (.not. allocated(self%mistakes)) allocate (self%mistakes(16))
      if (self%n_kept == size(self%mistakes)) call grow(self)
      self%n_kept = self%n_kept + 1
      n = self%n_kept
      self%mistakes(n)%location = location
      self%mistakes(n)%summary = summary
      self%mistakes(n)%note = ""
      if (present(note)) self%mistakes(n)%note = note
      self%mistakes(n)%help = ""
      if (present(help)) self%mistakes(n)%help = help
   end subroutine add

   !> Number of errors found.
   pure integer function count_mistakes(self)
      class(diagnostics_t), intent(in) :: self  !! the collection

      count_mistakes = self%n_all
   end function count_mistakes

   !> Turn the errors into an error with the exit code of decks; unallocated if there are none.
   subroutine to_error(self, sources, error)
      class(diagnostics_t), intent(in) :: self          !! the collection
      type(source_t), intent(in) :: sources(:)          !! (n) texts that the locations point to
      type(error_t), allocatable, intent(out) :: error  !! message as shown above, first word `error:`

      type(buffer_t) :: buffer
      integer :: order(self%n_kept)
      integer :: k, n_shown

      if (self%n_all == 0) return
      call sort(self, order)
      n_shown = min(self%n_kept, most_shown)
      do k = 1, n_shown
         if (k > 1) call buffer%line("")
         if (k > 1) call buffer%line("")
         call render(self%mistakes(order(k)), sources, buffer)
      end do
      if (self%n_all > n_shown) then
         call buffer%line("")
         call buffer%line("")
         call buffer%add("... and "//to_text(self%n_all - n_shown)//" more")
      end if
      call set_error(error, exit_deck, buffer%get())
   end subroutine to_error

   !> Write one error, without the end of its last line.
   subroutine render(mistake, sources, buffer)
      type(mistake_t), intent(in) :: mistake    !! the error
      type(source_t), intent(in) :: sources(:)  !! (n) texts
      type(buffer_t), intent(inout) :: buffer   !! where it is written

      character(:), allocatable :: indent, number
      type(location_t) :: at

      call buffer%add("error: "//mistake%summary)
      at = mistake%location
      indent = " "
      if (at%file >= 1 .and. at%file <= size(sources)) then
         number = ""
         if (sources(at%file)%is_file .and. at%line > 0) number = to_text(at%line)
         indent = repeat(" ", max(1, len(number)))
         call buffer%line("")
         call buffer%add(indent//"--> "//sources(at%file)%name)
         if (len(number) > 0) call buffer%add(":"//number//":"//to_text(shown_column(sources(at%file), at)))
         if (at%line > 0) call render_line(sources(at%file), at, indent, number, mistake%note, buffer)
      else if (len(mistake%note) > 0) then
         call buffer%line("")
         call buffer%add(indent//" = "//mistake%note)
      end if
      if (len(mistake%help) > 0) then
         call buffer%line("")
         call buffer%add(indent//" = "//mistake%help)
      end if
   end subroutine render

   !> Write the deck line and the carets below it.
   subroutine render_line(source, at, indent, number, note, buffer)
      type(source_t), intent(in) :: source     !! the text
      type(location_t), intent(in) :: at       !! what is marked
      character(*), intent(in) :: indent       !! blanks as wide as the number
      character(*), intent(in) :: number       !! of the line, may be empty
      character(*), intent(in) :: note         !! beside the caret
      type(buffer_t), intent(inout) :: buffer  !! where it is written

      character(:), allocatable :: line, marks
      integer :: first, i, last, left, right

      line = line_of(source, at%line)
      first = max(1, min(at%first, len(line) + 1))
      last = max(first, min(at%last, len(line)))
      left = 1
      if (first > widest_line - 20) left = first - widest_line/2
      right = min(len(line), left + widest_line - 1)
      last = min(last, right + 1)
      marks = ""
      do i = left, last
         if (i <= len(line)) then
            if (is_continuation(line(i:i))) cycle
         end if
         if (i >= first) then
            marks = marks//"^"
         else if (line(i:i) == achar(9)) then
            marks = marks//achar(9)
         else
            marks = marks//" "
         end if
      end do
      call buffer%line("")
      call buffer%line(indent//" |")
      call buffer%add(number//indent(1:len(indent) - len(number))//" | ")
      call buffer%line(printable(line(left:right)))
      call buffer%add(indent//" | "//marks)
      if (len(note) > 0) call buffer%add(" "//note)
   end subroutine render_line

   !> Column as people count: characters, not bytes.
   pure integer function shown_column(source, at)
      type(source_t), intent(in) :: source  !! the text
      type(location_t), intent(in) :: at    !! place in it

      character(:), allocatable :: line
      integer :: i

      line = line_of(source, at%line)
      shown_column = at%first
      do i = 1, min(at%first - 1, len(line))
         if (is_continuation(line(i:i))) shown_column = shown_column - 1
      end do
   end function shown_column

   !> Whether a byte continues a character of UTF-8.
   pure logical function is_continuation(byte)
      character, intent(in) :: byte  !! any byte

      is_continuation = iachar(byte) >= 128 .and. iachar(byte) < 192
   end function is_continuation

   !> Order of the errors by file, line and column; equal ones keep their order.
   pure subroutine sort(self, order)
      class(diagnostics_t), intent(in) :: self  !! the collection
      integer, intent(out) :: order(:)          !! (n_kept) numbers of the errors in order

      integer :: i, k, n_sorted

      n_sorted = 0
      do i = 1, self%n_kept
         k = n_sorted
         do while (k > 0)
            if (.not. is_before(self%mistakes(i)%location, self%mistakes(order(k))%location)) exit
            order(k + 1) = order(k)
            k = k - 1
         end do
         order(k + 1) = i
         n_sorted = n_sorted + 1
      end do
   end subroutine sort

   !> Whether one place is before another; nowhere comes last.
   pure logical function is_before(a, b)
      type(location_t), intent(in) :: a  !! one place
      type(location_t), intent(in) :: b  !! the other

      integer :: file_a, file_b

      file_a = merge(huge(1), a%file, a%file == 0)
      file_b = merge(huge(1), b%file, b%file == 0)
      if (file_a /= file_b) then
         is_before = file_a < file_b
      else if (a%line /= b%line) then
         is_before = a%line < b%line
      else
         is_before = a%first < b%first
      end if
   end function is_before

   !> Whether two places are the same.
   pure logical function same_place(a, b)
      type(location_t), intent(in) :: a  !! one place
      type(location_t), intent(in) :: b  !! the other

      same_place = a%file == b%file .and. a%line == b%line .and. a%first == b%first .and. a%last == b%last
   end function same_place

   !> Make storage for more.
   subroutine grow(self)
      class(diagnostics_t), intent(inout) :: self  !! the collection

      type(mistake_t), allocatable :: larger(:)
      integer :: i

      allocate (larger(2*size(self%mistakes)))
      do i = 1, self%n_kept
         larger(i)%location = self%mistakes(i)%location
         call move_alloc(self%mistakes(i)%summary, larger(i)%summary)
         call move_alloc(self%mistakes(i)%note, larger(i)%note)
         call move_alloc(self%mistakes(i)%help, larger(i)%help)
      end do
      call move_alloc(larger, self%mistakes)
   end subroutine grow

end module diagnostics
