!> One page of everything that a run has to say: report.html.
!>
!> The page has its pictures in it, asks no network and has no script of its own; an animation is its own page in a frame.
module report_page
   use figure_words, only: figure_t
   use html_table, only: add_section, head
   use html_text, only: base_64, escaped, in_attribute
   use kinds, only: i8
   use output_plan, only: output_plan_t
   use posix, only: utc_time
   use recorder, only: summary_t
   use report_deck, only: deck_tables
   use report_style, only: page_style
   use summary_writer, only: accuracy_lines, cost_lines, headline, outcome_t
   use system_file, only: read_file
   use text, only: segment, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: add_deck_text, add_figures, add_list, add_origin, name_of, report_name, report_text

   character(*), parameter :: report_name = "report.html"       !! the file
   integer(i8), parameter :: largest_picture = 100000000_i8     !! bytes of a picture that is taken in

contains

   !> The page.
   function report_text(plan, summary, outcome, figures, more) result(page)
      type(output_plan_t), intent(in) :: plan      !! what is known of the run
      type(summary_t), intent(in) :: summary       !! cost and errors
      type(outcome_t), intent(in) :: outcome       !! what the run left behind
      type(figure_t), intent(in) :: figures(:)     !! (n) the figures
      character(*), intent(in) :: more             !! the summary for people
      character(:), allocatable :: page            !! HTML

      type(buffer_t) :: lines
      integer :: k

      call lines%line("<!DOCTYPE html>")
      call lines%line("<html lang=""en""><head><meta charset=""utf-8""><title>"//escaped(name_of(plan), .true.)//"</title>")
      do k = 1, size(page_style)
         call lines%line(trim(page_style(k)))
      end do
      call lines%line("</head><body><h1>"//escaped(name_of(plan), .true.)//"</h1>")
      call lines%line("<p class=""status "//escaped(summary%status, .true.)//""">"//escaped(headline(summary), .true.)//"</p>")
      if (len_trim(summary%message) > 0) call lines%line("<p>"//escaped(summary%message, .true.)//"</p>")
      if (len_trim(summary%equilibrium) > 0) call lines%line("<p>equilibrium: "//escaped(summary%equilibrium, .true.)//"</p>")
      call add_list(lines, "warnings", "Warnings", outcome%warnings)
      call add_list(lines, "notes", "Unusual values of the deck", plan%notes)
      call add_figures(lines, plan%directory, outcome%pictures, figures)
      do k = 1, size(outcome%tables)
         call add_section(lines, outcome%tables(k))
      end do
      call cost_table(lines, summary)
      call head(lines, "summary", "Summary")
      call lines%line("<details><summary>summary.txt</summary><pre>")
      call add_text(lines, more)
      call lines%line("</pre></details>")
      call add_origin(lines, plan, .false.)
      call head(lines, "deck", "The deck with all defaults, in SI units")
      if (allocated(plan%origin%deck_echo)) call deck_tables(lines, plan%origin%deck_echo)
      call add_deck_text(lines, plan)
      call lines%line("</body></html>")
      page = lines%get()
   end function report_text

   !> A list with its heading, if there is something on it.
   subroutine add_list(lines, anchor, title, list)
      type(buffer_t), intent(inout) :: lines       !! the page
      character(*), intent(in) :: anchor           !! of the heading
      character(*), intent(in) :: title            !! heading
      type(text_t), intent(in) :: list(:)          !! (n) what is on it

      integer :: k

      if (size(list) == 0) return
      call head(lines, anchor, title)
      call lines%line("<ul>")
      do k = 1, size(list)
         call lines%line("<li>"//escaped(list(k)%s, .true.)//"</li>")
      end do
      call lines%line("</ul>")
   end subroutine add_list

   !> What the run is called.
   function name_of(plan) result(name)
      type(output_plan_t), intent(in) :: plan      !! what is known of the run
      character(:), allocatable :: name            !! its title, or its deck

      name = plan%title
      if (len_trim(name) == 0) name = plan%origin%deck_name
   end function name_of

   !> The pictures of the run.
   subroutine add_figures(lines, directory, pictures, figures)
      type(buffer_t), intent(inout) :: lines       !! the page
      character(*), intent(in) :: directory        !! of the run
      type(text_t), intent(in) :: pictures(:)      !! (m) paths within the directory
      type(figure_t), intent(in) :: figures(:)     !! (n) the figures

      character(:), allocatable :: bytes, message
      integer :: k

      if (size(pictures) == 0) return
      call head(lines, "figures", "Figures")
      do k = 1, size(pictures)
         if (is_played(pictures(k)%s)) cycle
         call read_file(directory//"/"//pictures(k)%s, .true., largest_picture, bytes, message)
         call lines%add("<figure>")
         if (len(message) > 0) then
            call lines%add("<p>"//escaped(pictures(k)%s//": "//message, .true.)//"</p>")
         else if (ending(pictures(k)%s) == "html") then
            call lines%add("<iframe sandbox=""allow-scripts allow-same-origin"" title="""//word_of(pictures(k)%s)// &
                           """ srcdoc="""//in_attribute(bytes)//"""></iframe>")
         else
            call lines%add("<img alt="""//word_of(pictures(k)%s)//""" src=""data:image/"//ending(pictures(k)%s)//";base64,"// &
                           base_64(bytes)//""">")
         end if
         call lines%line("<figcaption>"//word_of(pictures(k)%s)//"</figcaption></figure>")
      end do

   contains

      !> Whether a moving picture is also there as a page, which shows it.
      pure logical function is_played(path)
         character(*), intent(in) :: path  !! of the picture

         integer :: i

         is_played = .false.
         if (ending(path) /= "gif") return
         is_played = any([(pictures(i)%s == segment(path, 1, len(path) - 3)//"html", i=1, size(pictures))])
      end function is_played

      !> The word of the deck that a picture was made for.
      function word_of(path) result(word)
         character(*), intent(in) :: path         !! of the picture
         character(:), allocatable :: word        !! text of the page

         integer :: i

         word = path
         do i = 1, size(figures)
            if (path == "figures/"//figures(i)%name//"."//ending(path)) word = figures(i)%word
         end do
         word = escaped(word, .true.)
      end function word_of

   end subroutine add_figures

   !> What stands behind the last dot.
   pure function ending(path) result(s)
      character(*), intent(in) :: path         !! a path
      character(:), allocatable :: s           !! as `png`

      s = path(index(path, ".", back=.true.) + 1:)
   end function ending

   !> Which deck, program and command the run or study is of.
   subroutine add_origin(lines, plan, is_study)
      type(buffer_t), intent(inout) :: lines       !! the page
      type(output_plan_t), intent(in) :: plan      !! what is known of the run
      logical, intent(in) :: is_study              !! many runs, whose parameters differ

      integer :: k

      call head(lines, "origin", "Run information")
      call lines%line("<table>")
      call row(lines, "deck", plan%origin%deck_name)
      call row(lines, "command", plan%origin%command)
      call row(lines, "program", "gudgeon "//plan%origin%program_version//" ("//plan%origin%git_sha1//")")
      call row(lines, "libraries", plan%origin%libraries)
      call row(lines, "written", utc_time())
      if (.not. is_study) call row(lines, "degrees of freedom", to_text(plan%n_freedom))
      do k = 1, merge(0, size(plan%origin%parameter_names), is_study)
         call row(lines, "parameter "//plan%origin%parameter_names(k)%s, plan%origin%parameter_texts(k)%s)
      end do
      call lines%line("</table>")
   end subroutine add_origin

   !> The deck as it was read, folded.
   subroutine add_deck_text(lines, plan)
      type(buffer_t), intent(inout) :: lines       !! the page
      type(output_plan_t), intent(in) :: plan      !! what is known of the run

      call lines%line("<details><summary>the original deck</summary><pre>")
      call add_text(lines, plan%origin%deck_text)
      call lines%line("</pre></details>")
   end subroutine add_deck_text

   !> A row of two cells of text.
   subroutine row(lines, name, words)
      type(buffer_t), intent(inout) :: lines  !! the page
      character(*), intent(in) :: name        !! what it is
      character(*), intent(in) :: words       !! what there is to say

      call lines%line("<tr><td>"//escaped(name, .true.)//"</td><td class=""text"">"//escaped(words, .true.)//"</td></tr>")
   end subroutine row

   !> Cost and error, as the summary has them.
   subroutine cost_table(lines, summary)
      type(buffer_t), intent(inout) :: lines      !! the page
      type(summary_t), intent(in) :: summary      !! of the run

      type(buffer_t) :: words

      call head(lines, "cost", "Cost and accuracy")
      call cost_lines(words, summary)
      call accuracy_lines(words, summary)
      call lines%line("<pre>")
      call lines%add(words%get())
      call lines%line("</pre>")
   end subroutine cost_table

   !> Text of several lines.
   subroutine add_text(lines, text)
      type(buffer_t), intent(inout) :: lines       !! the page
      character(*), intent(in) :: text             !! any text

      integer :: first, length

      first = 1
      do while (first <= len(text))
         length = index(text(first:), new_line("a")) - 1
         if (length < 0) length = len(text) - first + 1
         call lines%line(escaped(text(first:first + length - 1), .true.))
         first = first + length + 1
      end do
   end subroutine add_text

end module report_page
