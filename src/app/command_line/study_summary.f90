!> The summaries of a study: how the one for scripts starts, and how both are written and shown.
module study_summary
   use console, only: say
   use errors, only: error_t
   use json_text, only: json_object_t
   use options, only: options_t
   use output_plan, only: output_plan_t
   use text_file, only: replace_file
   use version, only: program_version
   implicit none (type, external)
   private
   public :: show_summaries, start_summary

contains

   !> Start the summary for scripts.
   subroutine start_summary(json, deck, plan, status, message)
      type(json_object_t), intent(inout) :: json    !! started
      character(*), intent(in) :: deck              !! path of the deck
      type(output_plan_t), intent(in) :: plan       !! what files say
      character(*), intent(in) :: status            !! complete, or failed
      character(*), intent(in) :: message           !! why it failed; blank: it did not

      call json%start(0)
      call json%put_text("program", "gudgeon "//program_version)
      call json%put_text("deck", deck)
      call json%put_text("title", plan%title)
      call json%put_text("directory", plan%directory)
      call json%put_text("status", status)
      call json%put_text("message", message)
   end subroutine start_summary

   !> Write both summaries, and show the one that is asked for.
   subroutine show_summaries(options, directory, text, object, error)
      type(options_t), intent(in) :: options               !! the command line
      character(*), intent(in) :: directory                !! of the results
      character(*), intent(in) :: text                     !! the summary for people, whole lines
      character(*), intent(in) :: object                   !! the summary for scripts
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written

      call replace_file(directory//"/summary.txt", text, error)
      if (.not. allocated(error)) call replace_file(directory//"/summary.json", object//new_line("a"), error)
      if (options%is_json) then
         call say(object)
      else if (.not. options%is_quiet) then
         call say(text(:len(text) - 1))
      end if
   end subroutine show_summaries

end module study_summary
