!> One page of a study of many runs: report.html.
!>
!> The page has everything in it and asks no network. For the runs of a sweep, which may be an ensemble, its script draws a result
!> over a parameter or another result, the distribution over the runs, and of a run that is picked its row and its histories; below
!> stands the table of the runs. A study of tolerances has its figures and the tables of its summary.
module study_page
   use figure_words, only: figure_t
   use html_table, only: add_section, head
   use html_text, only: escaped
   use kept_histories, only: kept_histories_t
   use output_plan, only: output_plan_t
   use page_files, only: page_file, page_head, page_study, study_scripts, study_style
   use report_page, only: add_deck_text, add_figures, add_list, add_origin, name_of
   use result_table, only: result_table_t
   use sweep_page_data, only: sweep_data
   use sweep_results, only: sweep_results_t
   use text, only: text_t
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: study_page_text

contains

   !> The page.
   function study_page_text(plan, status, headline, warnings, tables, pictures, results, preferred, histories) result(page)
      type(output_plan_t), intent(in) :: plan               !! what is known of the study
      character(*), intent(in) :: status                    !! complete, failed or stopped
      character(*), intent(in) :: headline                  !! what was run
      type(text_t), intent(in) :: warnings(:)               !! (m) what was noticed
      type(result_table_t), intent(in) :: tables(:)         !! (any) tables of the summary
      type(text_t), intent(in) :: pictures(:)               !! (any) pictures that the page takes in, paths within the directory
      type(sweep_results_t), intent(in), optional :: results        !! results of the runs; absent: figures and tables only
      character(*), intent(in), optional :: preferred               !! with it: numbers that figures draw, each between commas
      type(kept_histories_t), intent(in), optional :: histories     !! with it: of runs whose channels were kept
      character(:), allocatable :: page                     !! HTML

      type(buffer_t) :: lines
      type(figure_t) :: no_words(0)
      integer :: k

      call lines%line("<!DOCTYPE html>")
      call lines%line("<html lang=""en""><head><meta charset=""utf-8""><meta name=""viewport"" content=""width=device-width"">"// &
                      "<title>"//escaped(name_of(plan), .true.)//"</title>")
      call lines%add(page_file(study_style))
      call lines%add(page_file(page_head))
      call lines%line("<h1>"//escaped(name_of(plan), .true.)//"</h1>")
      call lines%line("<p class=""status "//status//""">"//escaped(headline, .true.)//"</p>")
      if (present(results)) call lines%add(page_file(page_study))
      call lines%line("<section>")
      call add_list(lines, "warnings", "Warnings", warnings)
      call add_figures(lines, plan%directory, pictures, no_words)
      do k = 1, size(tables)
         call add_section(lines, tables(k))
      end do
      call add_origin(lines, plan, .true.)
      call head(lines, "deck", "The deck")
      call add_deck_text(lines, plan)
      call lines%line("</section>")
      if (present(results)) call add_scripts()
      call lines%line("</body></html>")
      page = lines%get()

   contains

      !> The data and what draws them.
      subroutine add_scripts()
         call lines%line("<script>")
         call lines%add(sweep_data(results, preferred, histories))
         do k = 1, size(study_scripts)
            call lines%add(page_file(study_scripts(k)))
         end do
         call lines%line("</script>")
      end subroutine add_scripts

   end function study_page_text

end module study_page
