!> `gudgeon help`, `gudgeon list`, `gudgeon --version`: everything read from what the kinds say of themselves.
module verb_help
   use build_info, only: compile_flags, compiler, git_sha1
   use command_words, only: command_t, exit_codes, exit_meanings, known_options, known_verbs, option_t, takers_of, words_of_value
   use completions, only: write_completion
   use console, only: say
   use dimension_text, only: unit_text
   use errors, only: error_t, exit_usage, set_error
   use explain_floors, only: floors_manual
   use figure_words, only: call_words
   use expression_functions, only: n_signature, signature_help, signatures
   use integrator, only: integrator_t
   use integrator_registry, only: n_integrator_kinds, new_integrator
   use kind_info, only: cell_condition, cell_duration, cell_expression, cell_file, cell_flag, cell_formula, cell_list, &
      cell_number, cell_reference, cell_vector, cell_words, column_t, in_plane, in_space, kind_info_t, no_bound
   use kind_list, only: all_kinds
   use libraries, only: library_versions
   use man_page, only: write_man_page
   use options, only: any_word, options_t, usage_error
   use mechanism_catalogue, only: energy_info
   use spelling, only: nearest_word
   use text, only: append_text, join, starts_with, text_t, to_text
   use version, only: program_version
   implicit none (type, external)
   private
   public :: list_kinds, show_help, show_version

contains

   !> The kinds and the integrators, with what they are named in a deck, and the energy ledger.
   subroutine known_kinds(kinds)
      type(kind_info_t), allocatable, intent(out) :: kinds(:)  !! (kinds) sections, then `integrator.NAME`

      class(integrator_t), allocatable :: method
      type(kind_info_t), allocatable :: sections(:)
      integer :: k, n

      call all_kinds(sections)
      n = size(sections)
      allocate (kinds(n + n_integrator_kinds() + 1))
      do k = 1, n
         kinds(k) = sections(k)
      end do
      do k = 1, n_integrator_kinds()
         call new_integrator(k, method)
         kinds(n + k) = method%info()
         kinds(n + k)%name = "integrator."//kinds(n + k)%name
         kinds(n + k)%is_table = .false.
      end do
      kinds(n + n_integrator_kinds() + 1) = energy_info(with_works=.true., with_films=.true.)
   end subroutine known_kinds

   !> `gudgeon list`: one line per kind.
   subroutine list_kinds(options, error)
      type(options_t), intent(in) :: options               !! the command line: groups or kinds, none: all
      type(error_t), allocatable, intent(out) :: error     !! no such group or kind

      type(kind_info_t), allocatable :: kinds(:)
      character(:), allocatable :: known
      logical, allocatable :: is_wanted(:)
      integer :: dot, i, k

      call known_kinds(kinds)
      allocate (is_wanted(size(kinds)), source=size(options%operands) == 0)
      do i = 1, size(options%operands)
         known = ""
         associate (word => options%operands(i)%s)
            do k = 1, size(kinds)
               is_wanted(k) = is_wanted(k) .or. kinds(k)%name == word .or. starts_with(kinds(k)%name, word//".")
               dot = index(kinds(k)%name, ".")
               if (dot > 0) then
                  if (index(known//" ", " "//kinds(k)%name(:dot - 1)//" ") == 0) known = known//" "//kinds(k)%name(:dot - 1)
               end if
               known = known//" "//kinds(k)%name
            end do
            if (any([(kinds(k)%name == word .or. starts_with(kinds(k)%name, word//"."), k=1, size(kinds))])) cycle
            call usage_error("unknown type '"//word//"'", word, known, error)
            return
         end associate
      end do
      do k = 1, size(kinds)
         if (is_wanted(k)) call say(kinds(k)%name, second=where_it_is(kinds(k))//kinds(k)%help, column=32)
      end do
   end subroutine list_kinds

   !> Whether a kind is one of decks in the plane or in space only.
   function where_it_is(info) result(words)
      type(kind_info_t), intent(in) :: info     !! the kind
      character(:), allocatable :: words        !! before its help; blank: both

      words = ""
      if (info%space == in_plane) words = "in the plane: "
      if (info%space == in_space) words = "in space: "
   end function where_it_is

   !> `gudgeon --version`.
   subroutine show_version()
      call say("gudgeon "//program_version//" ("//git_sha1//")")
      call say("  "//library_versions())
      call say("  "//compiler)
      call say("  "//compile_flags)
   end subroutine show_version

   !> `gudgeon help [KIND]`, `gudgeon help SORT NAME`, `gudgeon help VERB` (also `gudgeon VERB --help`), or the whole manual.
   subroutine show_help(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! no such kind

      type(kind_info_t), allocatable :: kinds(:)
      type(text_t), allocatable :: names(:)
      character(:), allocatable :: last, wanted
      integer :: k
      logical :: is_found

      call known_kinds(kinds)
      if (options%help%is_manual) then
         call write_manual(kinds)
         return
      end if
      if (options%help%is_man) then
         call write_man_page(kinds)
         return
      end if
      if (allocated(options%help%completion)) then
         call write_completion(options%help%completion, kinds)
         return
      end if
      if (.not. allocated(options%operands)) then
         call write_usage()
         return
      end if
      if (size(options%operands) == 0) then
         call write_usage()
         return
      end if
      wanted = join(options%operands, ".")
      is_found = .false.
      do k = 1, size(known_verbs)
         if (known_verbs(k)%name /= wanted) cycle
         call write_command(known_verbs(k))
         is_found = .true.
      end do
      if (wanted == "functions") then
         call write_functions()
         return
      end if
      allocate (names(0))
      do k = 1, size(kinds)
         call append_text(names, kinds(k)%name)
         last = kinds(k)%name(index(kinds(k)%name, ".", back=.true.) + 1:)
         call append_text(names, last)
         if (last /= kinds(k)%name) call append_text(names, kinds(k)%name(:len(kinds(k)%name) - len(last) - 1))  ! group
         if (kinds(k)%name == wanted .or. last == wanted .or. index(kinds(k)%name, wanted//".") == 1) then
            if (is_found) call say("")
            call write_kind(kinds(k), .false.)
            is_found = .true.
         end if
      end do
      if (is_found) return
      call set_error(error, exit_usage, "no help for '"//wanted//"'"//new_line("a")//"  = "//hint_for(wanted, names, kinds)// &
                     "see 'gudgeon list' for all types")
   end subroutine show_help

   !> What may have been meant by a word without help: a figure, a key or column of a kind, or the name of one.
   function hint_for(wanted, names, kinds) result(hint)
      character(*), intent(in) :: wanted          !! the word
      type(text_t), intent(in) :: names(:)        !! (n) names that have help
      type(kind_info_t), intent(in) :: kinds(:)   !! (kinds) all of them
      character(:), allocatable :: hint           !! blank: nothing is near

      integer :: i, k

      if (any([(call_words(i) == wanted//"(", i=lbound(call_words, 1), ubound(call_words, 1))]) .or. &
          any(wanted == ["orbit ", "panels"])) then
         hint = "a figure: did you mean key figures of [output]? gudgeon help output; "
         return
      end if
      do k = 1, size(kinds)
         if (.not. allocated(kinds(k)%columns)) cycle
         if (.not. any([(kinds(k)%columns(i)%name == wanted, i=1, size(kinds(k)%columns))])) cycle
         hint = trim(merge("column", "key   ", kinds(k)%is_table))
         hint = "did you mean "//hint//" "//wanted//" of ["//kinds(k)%name//"]? gudgeon help "//kinds(k)%name//"; "
         return
      end do
      hint = nearest_word(wanted, names)
      if (hint /= "") hint = "did you mean '"//hint//"'? "
   end function hint_for

   !> What the program can do.
   subroutine write_usage()
      character(:), allocatable :: codes, right
      integer :: k

      call say("gudgeon simulates mechanisms with imperfect joints.")
      call say("")
      do k = 1, size(known_verbs)
         call write_verb(known_verbs(k))
      end do
      call say("")
      call say("Options, and the verbs that take them:")
      do k = 1, size(known_options)
         call write_option(known_options(k), takers_of(trim(known_options(k)%name)))
      end do
      call say("")
      codes = "Exit codes:"
      do k = 1, size(exit_codes)
         right = " "//to_text(exit_codes(k))//" "//trim(exit_meanings(k))//merge(".", ",", k == size(exit_codes))
         if (len(codes) + len(right) > 112) then
            call say(codes)
            codes = repeat(" ", 11)
         end if
         codes = codes//right
      end do
      call say(codes)
      call say("Environment: GUDGEON_GNUPLOT_SECONDS is the maximum time for one figure; default 300 s.")
   end subroutine write_usage

   !> A verb and its options.
   subroutine write_command(verb)
      type(command_t), intent(in) :: verb  !! the verb

      integer :: k

      call write_verb(verb)
      if (verb%options /= "") call say("Options:")
      do k = 1, size(known_options)
         if (any_word(trim(known_options(k)%name), trim(verb%options))) call write_option(known_options(k), "")
      end do
   end subroutine write_command

   !> A verb in one line.
   subroutine write_verb(verb)
      type(command_t), intent(in) :: verb  !! the verb

      character(:), allocatable :: left

      left = "gudgeon "//trim(verb%name)//" "//trim(verb%operand)
      if (verb%options /= "") left = trim(left)//" [OPTION]..."
      call say(trim(left), 2, trim(verb%help), 40)
   end subroutine write_verb

   !> An option in one line, with the words that its value may be.
   subroutine write_option(option, takers)
      type(option_t), intent(in) :: option   !! the option
      character(*), intent(in) :: takers     !! verbs that take it; blank: they are not reported

      character(:), allocatable :: words

      words = trim(option%help)
      if (option%is_repeated) words = words//"; may be repeated"
      if (words_of_value(trim(option%name)) /= "") words = words//": "//words_of_value(trim(option%name))
      if (takers /= "") words = words//" ("//takers//")"
      call say(trim(trim(option%name)//" "//option%value), 2, words, 25)
   end subroutine write_option

   !> The functions of expressions.
   subroutine write_functions()
      integer :: k

      call say("functions of expressions; also the tables [function.*] by their names, and the constant pi")
      do k = 1, n_signature
         call say(trim(signatures(k)), 2, trim(signature_help(k)), 36)
      end do
   end subroutine write_functions

   !> The manual, as a page of Markdown.
   subroutine write_manual(kinds)
      type(kind_info_t), intent(in) :: kinds(:)  !! (kinds) all kinds

      integer :: k

      call say("# Manual of gudgeon "//program_version)
      call say("")
      call say("All tables and settings of a deck, as printed by `gudgeon help --manual`, "// &
               "and the equations from")
      call say("the headers of the source files.")
      call say("")
      call say("```")
      call write_usage()
      call say("```")
      do k = 1, size(kinds)
         call say("")
         call write_kind(kinds(k), .true.)
      end do
      call say("")
      call say("## functions")
      call say("")
      call say("```")
      call write_functions()
      call say("```")
      call floors_manual()
   end subroutine write_manual

   !> All that a kind describes.
   subroutine write_kind(info, is_markdown)
      type(kind_info_t), intent(in) :: info  !! the kind
      logical, intent(in) :: is_markdown     !! as a part of the manual

      character(:), allocatable :: where_known
      integer :: k

      where_known = ""
      if (info%space == in_space) where_known = "In space: "
      if (is_markdown) then
         call say("## "//info%name)
         call say("")
         call say(where_known//info%help//".")
      else
         call say(info%name//": "//where_known//info%help)
      end if
      if (info%source /= "") call say("Source: "//info%source//".")
      if (info%n_row > 0) call say("Constraint rows per item: "//to_text(info%n_row)//".")
      if (.not. allocated(info%columns) .and. .not. allocated(info%channels)) return
      if (is_markdown) call say("")
      if (is_markdown) call say("```")
      if (allocated(info%columns)) then
         call say(trim(merge("columns (besides name):", "keys:                  ", info%is_table)))
         do k = 1, size(info%columns)
            call say(info%columns(k)%name, 2, describe(info%columns(k)), 24)
         end do
      end if
      if (allocated(info%channels)) then
         call say("channels:")
         do k = 1, size(info%channels)
            associate (c => info%channels(k))
               call say(c%name, 2, c%help//" ["//c%unit//"]", 24)
            end associate
         end do
      end if
      if (is_markdown) call say("```")
   end subroutine write_kind

   !> One column as text.
   function describe(column) result(words)
      type(column_t), intent(in) :: column   !! the column
      character(:), allocatable :: words     !! help, what it holds, default, bounds

      words = column%help
      select case (column%cell)
      case (cell_number, cell_vector)
         if (column%is_any) then
            words = words//" [any]"
         else
            words = words//" ["//unit_text(column%dimension)//"]"
         end if
      case (cell_list)
         words = words//" (numbers and a unit, in quotes)"
      case (cell_file)
         words = words//" (a file)"
      case (cell_expression)
         words = words//" ["//unit_text(column%dimension)//", a number or an expression in "//trim(column%variable)
         if (column%sees_motion) words = words//" and channels of the motion"
         words = words//"]"
      case (cell_formula)
         words = words//" (an expression in channels and t)"
      case (cell_duration)
         words = words//" [s]"
      case (cell_flag)
         words = words//" (on or off)"
      case (cell_condition)
         words = words//" (CHANNEL > NUMBER or CHANNEL < NUMBER ...)"
      case (cell_words)
         words = words//" (a list)"
      case (cell_reference)
         words = words//" (name from "//column%refers_to//")"
      case default
         if (allocated(column%choices)) words = words//" ("//column%choices//")"
      end select
      if (allocated(column%options)) words = words//"; options "//column%options
      associate (bounds => column%bounds)
         if (bounds%lower > -no_bound) words = words//"; "//merge("> ", ">=", bounds%open_lower)//" "//to_text(bounds%lower)
         if (bounds%not_zero) words = words//"; not 0"
         if (bounds%upper < no_bound) words = words//"; "//merge("< ", "<=", bounds%open_upper)//" "//to_text(bounds%upper)
      end associate
      if (.not. allocated(column%default)) then
         words = words//"; required"
      else if (column%default /= "") then
         words = words//"; default "//column%default
      end if
   end function describe

end module verb_help
