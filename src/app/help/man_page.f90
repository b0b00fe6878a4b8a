!> `gudgeon help --man`: the man page, in the macros of man(7), from the tables of verbs and options and from the kinds.
!>
!> Limits: a kind stands there with its one line; its columns are reported by `gudgeon help KIND`.
module man_page
   use command_words, only: exit_codes, exit_meanings, known_options, known_verbs, words_of_value
   use console, only: say
   use kind_info, only: kind_info_t
   use text, only: to_text
   use version, only: program_date, program_version
   implicit none (type, external)
   private
   public :: write_man_page

contains

   !> Write the page.
   subroutine write_man_page(kinds)
      type(kind_info_t), intent(in) :: kinds(:)  !! (kinds) every table and section of a deck

      call say('.TH GUDGEON 1 "'//program_date//'" "gudgeon '//program_version//'" "User Commands"')
      call say(".nh")
      call say(".SH NAME")
      call say("gudgeon \- simulate mechanisms with imperfect joints")
      call write_synopsis()
      call say(".SH DESCRIPTION")
      call write_text("gudgeon reads a deck, a text file of tables that describes bodies, joints, clearances, contact and "// &
                      "friction laws. It integrates the equations of motion to a given error and writes HDF5, time "// &
                      "histories and figures.")
      call say(".SH COMMANDS")
      call write_commands()
      call say(".SH OPTIONS")
      call write_options()
      call say(".SH DECK")
      call write_deck(kinds)
      call say(".SH EXIT STATUS")
      call write_exit_status()
      call write_surroundings()
      call write_examples()
   end subroutine write_man_page

   !> One line for each verb.
   subroutine write_synopsis()
      integer :: k

      call say(".SH SYNOPSIS")
      do k = 1, size(known_verbs)
         associate (verb => known_verbs(k))
            if (k > 1) call say(".br")
            call say(".B gudgeon "//roff(trim(verb%name)))
            if (verb%operand /= "") call say(".I "//roff(trim(verb%operand)))
            if (verb%options /= "") call say("[\fIoption\fR]...")
         end associate
      end do
   end subroutine write_synopsis

   !> What each verb does and which options it takes.
   subroutine write_commands()
      integer :: k

      do k = 1, size(known_verbs)
         associate (verb => known_verbs(k))
            call say(".TP")
            call say("\fB"//roff(trim(verb%name))//"\fR \fI"//roff(trim(verb%operand))//"\fR")
            call write_text(trim(verb%help)//".")
            if (verb%options /= "") call write_text("Options: "//trim(verb%options)//".")
         end associate
      end do
   end subroutine write_commands

   !> What each option does.
   subroutine write_options()
      character(:), allocatable :: words
      integer :: k

      do k = 1, size(known_options)
         associate (option => known_options(k))
            call say(".TP")
            call say("\fB"//roff(trim(option%name))//"\fR \fI"//roff(trim(option%value))//"\fR")
            call write_text(trim(option%help)//trim(merge("; may be repeated", "                 ", option%is_repeated))//".")
            words = words_of_value(trim(option%name))
            if (words /= "") call write_text("One of: "//words//".")
         end associate
      end do
   end subroutine write_options

   !> The kinds that a deck may hold.
   subroutine write_deck(kinds)
      type(kind_info_t), intent(in) :: kinds(:)  !! (kinds) every table and section of a deck

      integer :: k

      call write_text("Tables and sections of a deck. To see the columns and keys of one, with units, defaults and "// &
                      "bounds, run")
      call say(".B gudgeon help")
      call say(".IR KIND .")
      do k = 1, size(kinds)
         call say(".TP")
         call say(".B "//roff(kinds(k)%name))
         call write_text(kinds(k)%help//".")
      end do
   end subroutine write_deck

   !> What the exit codes mean.
   subroutine write_exit_status()
      integer :: k

      do k = 1, size(exit_codes)
         call say(".TP")
         call say(".B "//to_text(exit_codes(k)))
         call write_text(trim(exit_meanings(k))//".")
      end do
   end subroutine write_exit_status

   !> Environment and files.
   subroutine write_surroundings()
      call say(".SH ENVIRONMENT")
      call entry("PATH", "command to run gnuplot, which draws the figures. Without gnuplot only the scripts are written.")
      call entry("GUDGEON_GNUPLOT_SECONDS", "maximum time for one figure in seconds. Default: 300. After that gnuplot is killed.")
      call say(".SH FILES")
      call entry("outputs/NAME/", "results of NAME.deck in the working directory: run.h5, time histories (.dat), "// &
                 "events.dat, figures/, summary.txt, summary.json, deck.echo (the deck with all defaults), and "// &
                 ".gudgeon, which marks the directory as output of gudgeon.")
      call entry("share/gudgeon/decks/", "example decks, under the installation prefix.")
   end subroutine write_surroundings

   !> How it is called.
   subroutine write_examples()
      call say(".SH EXAMPLES")
      call say(".nf")
      call say(roff("gudgeon new my && gudgeon run my.deck"))
      call say(roff("gudgeon run my.deck --set c=0.1mm --tolerance 1e-10 --out tight"))
      call say(roff("gudgeon explain my.deck | less"))
      call say(".fi")
      call say(".SH SEE ALSO")
      call say(".BR gnuplot (1),")
      call say(".BR h5dump (1)")
      call say(".PP")
      call write_text("P. Flores, J. Ambrosio, J. C. P. Claro and H. M. Lankarani, Kinematics and Dynamics of Multibody "// &
                      "Systems with Imperfect Joints, Springer, 2008.")
   end subroutine write_examples

   !> A word in bold and a paragraph on it.
   subroutine entry(word, words)
      character(*), intent(in) :: word   !! the word
      character(*), intent(in) :: words  !! the paragraph

      call say(".TP")
      call say(".B "//roff(word))
      call write_text(words)
   end subroutine entry

   !> A paragraph, broken into lines at blanks.
   subroutine write_text(words)
      character(*), intent(in) :: words  !! plain text

      integer, parameter :: longest = 76
      integer :: first, last

      first = 1
      do while (len(words) - first >= longest)
         last = first - 2 + index(words(first:first + longest), " ", back=.true.)
         if (last < first) exit
         call say(roff(words(first:last)))
         first = last + 2
      end do
      call say(roff(words(first:)))
   end subroutine write_text

   !> Plain text as roff writes it: nothing in it is a request or an escape.
   pure function roff(plain) result(s)
      character(*), intent(in) :: plain    !! the text
      character(:), allocatable :: s       !! with escapes

      integer :: k

      s = ""
      do k = 1, len(plain)
         select case (plain(k:k))
         case ("\"); s = s//"\e"
         case ("-"); s = s//"\-"
         case ("`"); s = s//"\(ga"
         case ("^"); s = s//"\(ha"
         case ("~"); s = s//"\(ti"
         case ("'"); s = s//"\(aq"
         case (".")
            if (k == 1) s = s//"\&"
            s = s//"."
         case default; s = s//plain(k:k)
         end select
      end do
   end function roff

end module man_page
