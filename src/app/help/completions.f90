!> `gudgeon help --completion SHELL`: what completes the words of the program in bash and in zsh, from the tables of verbs and
!> options and from the names of the kinds.
!>
!> Completed are verbs, the options of a verb, words that an option takes, decks, kinds to be helped with, and the
!> parameters of the deck on the line for `--set`.
module completions
   use command_words, only: command_t, find_option, known_options, known_verbs, option_t, verb_names, words_of_value
   use console, only: say
   use kind_info, only: kind_info_t
   use text, only: segment, split_blank, text_t
   implicit none (type, external)
   private
   public :: write_completion

   ! names of the parameters of a deck, each with an equals sign
   character(*), parameter :: find_parameters = &
      "awk '/^[[:blank:]]*\[/ { inside = /\[parameters\]/ } inside && /^[[:blank:]]*[A-Za-z_][A-Za-z_0-9]*[[:blank:]]*=/ "// &
      "{ sub(/[[:blank:]]*=.*/, ""=""); sub(/^[[:blank:]]*/, """"); print }'"

contains

   !> Write the completion for a shell.
   subroutine write_completion(shell, kinds)
      character(*), intent(in) :: shell            !! bash or zsh
      type(kind_info_t), intent(in) :: kinds(:)    !! (kinds) what help knows

      select case (shell)
      case ("zsh"); call write_zsh(kind_words(kinds))
      case default; call write_bash(kind_words(kinds))
      end select
   end subroutine write_completion

   !> Names of the kinds, blank-separated.
   pure function kind_words(kinds) result(words)
      type(kind_info_t), intent(in) :: kinds(:)  !! (kinds) the kinds
      character(:), allocatable :: words         !! their names

      integer :: k

      words = ""
      do k = 1, size(kinds)
         words = words//" "//kinds(k)%name
      end do
      words = segment(words, 2)
   end function kind_words

   !> For bash.
   subroutine write_bash(names)
      character(*), intent(in) :: names  !! of the kinds, blank-separated

      integer :: k

      call say("# bash completion of gudgeon, made by: gudgeon help --completion bash")
      call say("_gudgeon() {")
      call say("local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]}", 4)
      call say("local deck part options=''", 4)
      call say("COMPREPLY=()", 4)
      call say("if ((COMP_CWORD == 1)); then", 4)
      call say("COMPREPLY=($(compgen -W '"//verb_names()//"' -- ""$word""))", 8)
      call say("return", 8)
      call say("fi", 4)
      call say("# --option=value is three words here", 4)
      call say("if [[ $word == = ]]; then word=''; fi", 4)
      call say("if [[ $before == = ]] && ((COMP_CWORD > 2)); then before=${COMP_WORDS[COMP_CWORD-2]}; fi", 4)
      call say("if [[ ${COMP_WORDS[COMP_CWORD]} == = ]]; then before=${COMP_WORDS[COMP_CWORD-1]}; fi", 4)
      call say("case $before in", 4)
      do k = 1, size(known_options)
         call write_bash_value(known_options(k))
      end do
      call say("esac", 4)
      call say("case $verb in", 4)
      do k = 1, size(known_verbs)
         associate (verb => known_verbs(k))
            if (verb%options /= "") call say(trim(verb%name)//") options='"//trim(verb%options)//"' ;;", 8)
         end associate
      end do
      call say("esac", 4)
      call say("if [[ $word == -* ]]; then", 4)
      call say("COMPREPLY=($(compgen -W ""$options"" -- ""$word""))", 8)
      call say("return", 8)
      call say("fi", 4)
      call say("case $verb in", 4)
      do k = 1, size(known_verbs)
         call write_bash_operand(known_verbs(k), names)
      end do
      call say("esac", 4)
      call say("}")
      call say("complete -F _gudgeon gudgeon")
   end subroutine write_bash

   !> What bash offers as the value of an option.
   subroutine write_bash_value(option)
      type(option_t), intent(in) :: option  !! the option

      character(:), allocatable :: words

      if (option%value == "") return
      call say(trim(option%name)//")", 8)
      words = words_of_value(trim(option%name))
      if (words /= "") then
         call say("COMPREPLY=($(compgen -W '"//words//"' -- ""$word""))", 12)
      else if (option%value == "DIR") then
         call say("compopt -o filenames 2>/dev/null", 12)
         call say("mapfile -t COMPREPLY < <(compgen -d -- ""$word"")", 12)
      else if (option%value == "NAME=VALUE") then
         call say("compopt -o nospace 2>/dev/null", 12)
         call say("for part in ""${COMP_WORDS[@]:2}""; do [[ $part == *.deck && -f $part ]] && deck=$part; done", 12)
         call say("if [[ -n $deck ]]; then", 12)
         call say("COMPREPLY=($(compgen -W ""$("//find_parameters//" ""$deck"")"" -- ""$word""))", 16)
         call say("fi", 12)
      end if
      call say("return ;;", 12)
   end subroutine write_bash_value

   !> What bash offers as what a verb works on.
   subroutine write_bash_operand(verb, names)
      type(command_t), intent(in) :: verb  !! the verb
      character(*), intent(in) :: names    !! of the kinds, blank-separated

      select case (verb%operand)
      case ("DECK", "DECK DATA")
         call say(trim(verb%name)//")", 8)
         call say("compopt -o filenames 2>/dev/null", 12)
         call say("mapfile -t COMPREPLY < <(compgen -f -X '!*.deck' -- ""$word""; compgen -d -- ""$word"") ;;", 12)
      case ("[KIND]")
         call say(trim(verb%name)//") COMPREPLY=($(compgen -W '"//names//"' -- ""$word"")) ;;", 8)
      end select
   end subroutine write_bash_operand

   !> For zsh.
   subroutine write_zsh(names)
      character(*), intent(in) :: names  !! of the kinds, blank-separated

      integer :: k

      call say("#compdef gudgeon")
      call say("# zsh completion of gudgeon, made by: gudgeon help --completion zsh")
      call say("_gudgeon_parameters() {")
      call say("local part deck", 4)
      call say("local -a parameters", 4)
      call say("for part in $words; do [[ $part == *.deck && -f $part ]] && deck=$part; done", 4)
      call say("[[ -n $deck ]] || return 1", 4)
      call say("parameters=(${(f)""$("//find_parameters//" ""$deck"")""})", 4)
      call say("compadd -S '' -a parameters", 4)
      call say("}")
      call say("_gudgeon() {")
      call say("local -a verbs", 4)
      call say("if ((CURRENT == 2)); then", 4)
      call say("verbs=(", 8)
      do k = 1, size(known_verbs)
         call say("'"//trim(known_verbs(k)%name)//":"//quoted(trim(known_verbs(k)%help))//"'", 12)
      end do
      call say(")", 8)
      call say("_describe -t commands verb verbs", 8)
      call say("return", 8)
      call say("fi", 4)
      call say("shift words", 4)
      call say("((CURRENT--))", 4)
      call say("case $words[1] in", 4)
      do k = 1, size(known_verbs)
         if (known_verbs(k)%options /= "" .or. known_verbs(k)%operand /= "") call write_zsh_verb(known_verbs(k), names)
      end do
      call say("esac", 4)
      call say("}")
      call say("if [[ $funcstack[1] == _gudgeon ]]; then _gudgeon ""$@""; else compdef _gudgeon gudgeon; fi")
   end subroutine write_zsh

   !> What zsh offers after a verb.
   subroutine write_zsh_verb(verb, names)
      type(command_t), intent(in) :: verb  !! the verb
      character(*), intent(in) :: names    !! of the kinds, blank-separated

      type(option_t) :: option
      type(text_t), allocatable :: options(:)
      character(:), allocatable :: takes
      integer :: k

      call say(trim(verb%name)//") _arguments \", 4)
      options = split_blank(verb%options)
      do k = 1, size(options)
         option = find_option(options(k)%s)
         takes = ""
         if (option%value /= "") takes = "="
         takes = trim(merge("*", " ", option%is_repeated))//trim(option%name)//takes//"["//quoted(trim(option%help))//"]"
         if (option%value /= "") takes = takes//":"//trim(option%value)//":"//zsh_values(option)
         call say("'"//takes//"' \", 8)
      end do
      select case (verb%operand)
      case ("DECK", "DECK DATA"); call say("'1:deck:_files -g ""*.deck""' ;;", 8)
      case ("[KIND]"); call say("'*:kind:("//names//")' ;;", 8)
      case default; call say("'1:name:' ;;", 8)
      end select
   end subroutine write_zsh_verb

   !> What zsh offers as the value of an option.
   function zsh_values(option) result(action)
      type(option_t), intent(in) :: option      !! the option
      character(:), allocatable :: action       !! as `_arguments` reads it

      action = words_of_value(trim(option%name))
      if (action /= "") then
         action = "("//action//")"
      else if (option%value == "DIR") then
         action = "_files -/"
      else if (option%value == "NAME=VALUE") then
         action = "_gudgeon_parameters"
      end if
   end function zsh_values

   !> Help as it stands in single quotes between brackets and colons.
   pure function quoted(plain) result(s)
      character(*), intent(in) :: plain    !! one line
      character(:), allocatable :: s       !! with escapes

      integer :: k

      s = ""
      do k = 1, len(plain)
         select case (plain(k:k))
         case ("'"); s = s//"'\''"
         case ("[", "]", ":", "\"); s = s//"\"//plain(k:k)
         case default; s = s//plain(k:k)
         end select
      end do
   end function quoted

end module completions
