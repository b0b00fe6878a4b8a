!> The summaries of a study: how the one for scripts starts and the one for people ends, and how both are written and shown.
module study_summary
   use console, only: say
   use errors, only: error_t
   use json_text, only: json_object_t
   use options, only: options_t
   use output_plan, only: output_plan_t
   use text, only: text_t
   use text_buffer, only: buffer_t
   use text_file, only: replace_file
   use version, only: program_version
   implicit none (type, external)
   private
   public :: add_output, show_summaries, start_summary

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

   !> End the summary for people: where the results are, and the warnings.
   subroutine add_output(lines, directory, files, pictures, warnings)
      type(buffer_t), intent(inout) :: lines        !! grown
      character(*), intent(in) :: directory         !! of the results
      character(*), intent(in) :: files             !! written there; blank: none is named
      type(text_t), intent(in) :: pictures(:)       !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)       !! (m) what was noticed

      integer :: k

      call lines%line("output     "//directory//"/")
      if (files /= "") call lines%line("           "//files)
      do k = 1, size(pictures)
         call lines%line("           "//pictures(k)%s)
      end do
      do k = 1, size(warnings)
         call lines%line("warning: "//warnings(k)%s)
      end do
   end subroutine add_output

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
