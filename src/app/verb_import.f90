!> `gudgeon import MODEL.adm`: a deck made of the mechanical part of an Adams dataset.
module verb_import
   use adams_deck, only: import_dataset, imported_t
   use console, only: say
   use diagnostics, only: diagnostics_t
   use errors, only: error_t, exit_file, exit_usage, set_error
   use load, only: load_deck, loaded_t
   use options, only: options_t
   use posix, only: make_directory, path_exists
   use source_text, only: read_source, source_t
   use text, only: append_text, counted, lower, text_t
   use text_file, only: fail_file, write_file
   implicit none (type, external)
   private
   public :: import_model

contains

   !> Write the deck beside the current directory's files, or into `--out`, and say what it does not have.
   subroutine import_model(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! no dataset, errors in it, or no place for the deck

      type(diagnostics_t) :: mistakes
      type(imported_t) :: imported
      type(loaded_t), save :: loaded
      type(options_t) :: check
      type(source_t) :: source
      character(:), allocatable :: message, path
      integer :: code

      if (size(options%operands) /= 1) then
         call set_error(error, exit_usage, "'gudgeon import' needs one dataset: gudgeon import MODEL.adm writes MODEL.deck")
         return
      end if
      call read_source(options%operands(1)%s, source, message, may_be_stream=.true.)
      if (message /= "") then
         call set_error(error, exit_file, "cannot read '"//options%operands(1)%s//"': "//message)
         return
      end if
      path = deck_path(options)
      if (path_exists(path)) then
         call set_error(error, exit_file, "'"//path//"' exists already"//new_line("a")// &
                        "  = move the existing file, or choose another directory with --out DIRECTORY")
         return
      end if
      call import_dataset(source, base_name(options%operands(1)%s), imported, mistakes)
      call mistakes%to_error([source], error)
      if (allocated(error)) return
      if (allocated(options%directory)) then
         code = make_directory(options%directory)
         if (code /= 0) call fail_file(error, "cannot make the directory", options%directory, code, &
                                       "Choose another one with --out DIRECTORY.")
      end if
      if (.not. allocated(error)) call write_file(path, imported%deck, error)
      if (allocated(error)) return
      call report(path, imported)
      check%verb = "check"
      check%command = options%command
      check%write = "all"
      allocate (check%operands(0), check%change%overrides(0))
      call append_text(check%operands, path)
      call load_deck(check, loaded, error)
      if (allocated(error)) error%message = "the deck was written, but cannot be run without changes:"//new_line("a")//error%message
   end subroutine import_model

   !> Where the deck goes.
   function deck_path(options) result(path)
      type(options_t), intent(in) :: options     !! the command line
      character(:), allocatable :: path          !! of the deck

      path = base_name(options%operands(1)%s)
      if (len(path) > 4) then
         if (lower(path(len(path) - 3:)) == ".adm") path = without_end(path, 4)
      end if
      path = path//".deck"
      if (allocated(options%directory)) path = options%directory//"/"//path
   end function deck_path

   !> The name of a file without its directory.
   pure function base_name(path) result(name)
      character(*), intent(in) :: path       !! of the file
      character(:), allocatable :: name      !! behind the last slash

      name = path(index(path, "/", back=.true.) + 1:)
   end function base_name

   !> A text without its last characters.
   pure function without_end(text, n) result(part)
      character(*), intent(in) :: text       !! the text
      integer, intent(in) :: n               !! characters that are dropped
      character(:), allocatable :: part      !! the rest

      part = text(:len(text) - n)
   end function without_end

   !> What was made, and what not.
   subroutine report(path, imported)
      character(*), intent(in) :: path              !! of the deck
      type(imported_t), intent(in) :: imported      !! what was made

      call say(path//" written. Run it:   gudgeon run "//path//" --set end=2s")
      call say_list("not supported, omitted from the deck", imported%left_out)
      call say_list("changed or assumed", imported%changed)
      call say_list("Adams settings without effect on the mechanism", imported%settings)
      if (size(imported%left_out) == 0) call say("the whole mechanism was converted")
   end subroutine report

   !> A list with its heading.
   subroutine say_list(heading, list)
      character(*), intent(in) :: heading       !! what it is
      type(text_t), intent(in) :: list(:)       !! (n) its lines

      integer :: k

      if (size(list) == 0) return
      call say(heading//" ("//counted(size(list), "item", "items")//")")
      do k = 1, size(list)
         call say(list(k)%s, 2)
      end do
   end subroutine say_list

end module verb_import
