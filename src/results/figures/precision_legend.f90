!> The legend of a comparison of settings: beside the panels, in as many columns as it needs; below them the reasons of failures.
!>
!> Settings beyond the twelfth have the colours of those before them, and other signs.
module precision_legend
   use failure_reasons, only: reason_t, reasons_of
   use kinds, only: wp
   use plot_text, only: quoted
   use precision_results, only: precision_t, tol_run_failed, tol_run_unrun
   use script_parts, only: colours, preamble
   use text, only: segment, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: colour_of, legend_t, sign_of

   ! in units of layout
   integer, parameter :: row = 30             !! a row of the legend, of which gnuplot makes no more than a panel is high
   integer, parameter :: letter = 11          !! a letter of it
   integer, parameter :: beside = 85          !! its signs
   integer, parameter :: for_letter = 14      !! a letter, where another column follows: what gnuplot takes it for
   integer, parameter :: note_row = 21        !! a row of the reasons
   integer, parameter :: note_middle = 15     !! of the lowest of them, above the edge
   integer, parameter :: left = 125           !! left of a panel
   integer, parameter :: below = 90           !! below it
   integer, parameter :: above = 55           !! above it
   integer, parameter :: right = 25           !! from a panel to the legend

   integer, parameter :: note_letters = 88    !! of a row of the reasons: gnuplot is given no more
   integer, parameter :: first_note = 10      !! labels up to this number are the panel's
   integer, parameter :: signs(4) = [7, 5, 9, 13]   !! of settings with the same colour

   !> A row of the reasons.
   type :: note_t
      integer :: tol_sweep = 0                   !! the setting
      integer :: sign = 0                     !! gnuplot's number of its sign, 0: the row continues
      character(:), allocatable :: words      !! what it says
   end type note_t

   !> A page with panels on the left, the legend on the right and the reasons below.
   type :: legend_t
      private
      integer :: panels(2) = 0                     !! width and height of the panels with their labels, in units of layout
      integer :: page(2) = 0                       !! of all of it, in the same units
      integer :: rows = 0                          !! of the legend
      type(note_t), allocatable :: notes(:)        !! (n) rows of the reasons
   contains
      procedure, public :: begin
      procedure, public :: place
      procedure, public :: margins
   end type legend_t

contains

   !> Start a page: its size, and of one panel its place above the reasons.
   subroutine begin(self, lines, study, name, panels, titles, with_notes)
      class(legend_t), intent(out) :: self      !! the page
      type(buffer_t), intent(inout) :: lines    !! the script
      type(precision_t), intent(in) :: study    !! results
      character(*), intent(in) :: name          !! of the figure's files
      integer, intent(in) :: panels(2)          !! width and height of the panels with their labels, in units of layout
      type(text_t), intent(in) :: titles(:)     !! (n) what stands in the legend
      logical, intent(in) :: with_notes         !! one panel above the reasons; else several without

      integer :: columns, k, longest

      longest = maxval([(len(titles(k)%s), k=1, size(titles))])
      self%rows = (panels(2) - above - below)/row
      if (.not. with_notes) self%rows = (panels(2) - above - 2*below - right)/(2*row)
      columns = (size(titles) - 1)/self%rows + 1
      self%notes = notes_of(study)
      if (.not. with_notes) self%notes = self%notes(:0)
      self%panels = panels
      self%page = panels + [(columns - 1)*(for_letter*longest + beside) + letter*longest + beside, note_row*size(self%notes)]
      call preamble(lines, name, self%page(1), self%page(2))
      if (.not. with_notes) return
      associate (n => size(self%notes))
         call lines%line("set lmargin at screen "//part(left, self%page(1))//"; set rmargin at screen "// &
                         part(panels(1) - right, self%page(1)))
         call lines%line("set tmargin at screen "//part(self%page(2) - above, self%page(2))//"; set bmargin at screen "// &
                         part(below + note_row*n, self%page(2)))
         do k = 1, n
            call lines%line("set label "//to_text(first_note + k)//" "//quoted(self%notes(k)%words)//" at screen "// &
                            part(left, self%page(1))//", screen "//part(note_row*(n - k) + note_middle, self%page(2))// &
                            " left font ',12' textcolor rgb '"//colour_of(self%notes(k)%tol_sweep)//"'"//sign_text(self%notes(k)))
         end do
      end associate
   end subroutine begin

   !> Put the legend into its place.
   subroutine place(self, lines)
      class(legend_t), intent(in) :: self       !! the page
      type(buffer_t), intent(inout) :: lines    !! the script

      call lines%line("set key noautotitle at screen "//part(self%panels(1), self%page(1))//", screen "// &
                      part(self%page(2) - above, self%page(2))//" left top vertical Left reverse samplen 2 spacing 1.15 "// &
                      "maxrows "//to_text(self%rows))
   end subroutine place

   !> The place of several panels, beside the legend.
   function margins(self) result(words)
      class(legend_t), intent(in) :: self       !! the page
      character(:), allocatable :: words        !! for `set multiplot layout`

      words = "margins screen "//part(left, self%page(1))//", "//part(self%panels(1) - right, self%page(1))//", "// &
              part(below, self%page(2))//", "//part(self%page(2) - above, self%page(2))//" spacing screen "// &
              part(left + right, self%page(1))//", "//part(below + right, self%page(2))
   end function margins

   !> A length as a part of the page.
   function part(length, whole) result(word)
      integer, intent(in) :: length       !! from the left or from below, in units of layout
      integer, intent(in) :: whole        !! of the page, in the same units
      character(:), allocatable :: word   !! as `0.95`

      word = real_text(real(length, wp)/real(whole, wp), 5)
   end function part

   !> Colour of a setting.
   pure character(7) function colour_of(k) result(colour)
      integer, intent(in) :: k   !! number of the setting, from 1

      colour = colours(mod(k - 1, size(colours)) + 1)
   end function colour_of

   !> Sign of a setting's points, gnuplot's number.
   function sign_of(k) result(word)
      integer, intent(in) :: k            !! number of the setting, from 1
      character(:), allocatable :: word   !! as `7`

      word = to_text(signs(mod((k - 1)/size(colours), size(signs)) + 1))
   end function sign_of

   !> The sign before a row of the reasons.
   function sign_text(note) result(words)
      type(note_t), intent(in) :: note       !! the row
      character(:), allocatable :: words     !! for `set label`

      words = " offset 2,0 point pointtype "//to_text(note%sign)
      if (note%sign > 0) words = words//" pointsize 1.3 linewidth 2 linecolor rgb '"//colour_of(note%tol_sweep)//"'"
      if (note%sign == 0) words = words//" linecolor rgb '#ffffff'"
   end function sign_text

   !> Why runs failed, each reason of a setting once, and which settings were not run at all.
   function notes_of(study) result(notes)
      type(precision_t), intent(in) :: study      !! results
      type(note_t), allocatable :: notes(:)       !! (n) rows

      integer, parameter :: failure = 2, nothing = 1  ! signs
      type(reason_t), allocatable :: reasons(:)
      character(:), allocatable :: words
      integer :: i, k

      allocate (notes(0))
      do k = 1, size(study%tol_sweeps)
         associate (tol_sweep => study%tol_sweeps(k))
            if (all(tol_sweep%tol_runs%state == tol_run_unrun)) then
               call append_rows(notes, k, nothing, tol_sweep%name//" not run: "//tol_sweep%tol_runs(1)%reason)
            end if
            reasons = reasons_of(tol_sweep%tol_runs, tol_run_failed)
            do i = 1, size(reasons)
               words = tol_sweep%name//" failed: "//tol_sweep%tol_runs(reasons(i)%first)%reason
               if (reasons(i)%n > 1) words = words//" ("//to_text(reasons(i)%n)//" runs)"
               call append_rows(notes, k, failure, words)
            end do
         end associate
      end do
   end function notes_of

   !> Append a sentence in rows that are not too long.
   subroutine append_rows(notes, tol_sweep, sign, words)
      type(note_t), allocatable, intent(inout) :: notes(:)   !! (n) rows, grown
      integer, intent(in) :: tol_sweep                          !! the setting
      integer, intent(in) :: sign                            !! gnuplot's number of its sign
      character(*), intent(in) :: words                      !! the sentence

      character(:), allocatable :: rest
      integer :: cut, now

      rest = words
      now = sign
      do while (len(rest) > note_letters)
         cut = index(rest(:note_letters), " ", back=.true.)
         if (cut == 0) cut = note_letters
         call append_row(rest(:cut))
         rest = segment(rest, cut + 1)
         now = 0
      end do
      call append_row(rest)

   contains

      !> Append a row.
      subroutine append_row(words_of_row)
         character(*), intent(in) :: words_of_row   !! what it says

         type(note_t) :: row

         row = note_t(tol_sweep, now, words_of_row)
         notes = [notes, row]
      end subroutine append_row

   end subroutine append_rows

end module precision_legend
