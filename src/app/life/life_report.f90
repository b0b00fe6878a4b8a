!> The summaries of a life, for people and for scripts.
module life_report
   use errors, only: error_t
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use kinds, only: i8, wp
   use life_results, only: life_t
   use life_tables, only: table_of_budget, table_of_life, table_of_surfaces_at_end
   use load, only: loaded_t
   use options, only: options_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete, status_failed
   use study_summary, only: add_output, show_summaries, start_summary
   use table_list, only: list_of
   use text, only: counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
   use wear_object, only: put_wear
   use wear_tables, only: tables_of_wear
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: report_life

contains

   !> Write and show the summaries.
   subroutine report_life(options, loaded, plan, life, n_made, pictures, warnings, failure, error)
      type(options_t), intent(in) :: options                 !! the command line
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(life_t), intent(in) :: life                       !! the life
      integer, intent(in) :: n_made                          !! simulations made now
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      type(error_t), allocatable, intent(in) :: failure      !! why the life ended early; unallocated: it did not
      type(error_t), allocatable, intent(out) :: error       !! a file cannot be written

      character(:), allocatable :: object, text

      text = text_of(plan, life, n_made, pictures, warnings, failure)
      object = object_of(loaded, plan, life, n_made, pictures, warnings, failure)
      call show_summaries(options, plan%directory, text, object, error)
   end subroutine report_life

   !> The summary for people.
   function text_of(plan, life, n_made, pictures, warnings, failure) result(text)
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(life_t), intent(in) :: life                       !! the life
      integer, intent(in) :: n_made                          !! simulations made now
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      type(error_t), allocatable, intent(in) :: failure      !! why the life ended early
      character(:), allocatable :: text                      !! whole lines

      type(buffer_t) :: lines

      call lines%line(plan%title)
      associate (node => life%nodes(life%last))
         if (allocated(failure)) then
            call lines%line("failed after "//real_text(node%cycles, 6)//" cycles: "//failure%message)
         else
            call lines%line("complete: "//real_text(node%cycles, 6)//" cycles, "//real_text(node%cycles*life%plan%cycle, 6)// &
                            " s; ended by "//life%reason)
            call lines%line(interval_text(life))
         end if
      end associate
      call lines%line("")
      call lines%line("jumps      "//to_text(life%last - 1)//", "//to_text(life%rejected)//" rejected; "// &
                      counted(life%simulated, "profile", "profiles")//" simulated from "// &
                      counted(life%plan%starts, "start", "starts")//", "//to_text(n_made)//" simulations made now")
      call add_table(lines, table_of_surfaces_at_end(life))
      call add_table(lines, table_of_budget(life))
      call lines%line("")
      call add_output(lines, plan%directory, "life.h5, life.csv (all jumps)", pictures, warnings)
      text = lines%get()
   end function text_of

   !> The interval of the life.
   function interval_text(life) result(line)
      type(life_t), intent(in) :: life          !! the life
      character(:), allocatable :: line         !! one line

      real(wp) :: factor

      factor = maxval(life%plan%spreads)
      associate (cycles => life%nodes(life%last)%cycles)
         if (life%ends_by_cycles) then
            line = "           wear at the end: see below"
         else
            line = "           95 %: "//real_text(max(cycles - life%cycles_half, 0.0_wp), 6)//" to "// &
                   real_text(cycles + life%cycles_half, 6)//" cycles by numerical errors"
            if (factor > 1.0_wp) line = line//"; "//real_text(cycles/factor, 3)//" to "//real_text(cycles*factor, 3)// &
                                        " by the wear coefficient"
         end if
      end associate
   end function interval_text

   !> The summary for scripts.
   function object_of(loaded, plan, life, n_made, pictures, warnings, failure) result(object)
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(life_t), intent(in) :: life                       !! the life
      integer, intent(in) :: n_made                          !! simulations made now
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      type(error_t), allocatable, intent(in) :: failure      !! why the life ended early
      character(:), allocatable :: object                    !! as text

      type(json_object_t) :: json
      type(worn_surface_t), allocatable :: worn(:)

      if (allocated(failure)) then
         call start_summary(json, loaded%path, plan, status_failed, failure%message)
      else
         call start_summary(json, loaded%path, plan, status_complete, "")
      end if
      call json%put_integer("made", int(n_made, i8))
      associate (node => life%nodes(life%last))
         call put_wear(json, life%state%surfaces, node%measures, max(node%measures - node%half(), 0.0_wp), &
                       node%measures + node%half(), node%cycles, node%cycles*life%plan%cycle)
         call put_tables(json, list_of(table_of_life(life), table_of_surfaces_at_end(life), table_of_budget(life)))
         worn = life%state%worn(node%x)
         call put_tables(json, tables_of_wear(worn))
      end associate
      call json%put_list("figures", pictures)
      call json%put_list("warnings", warnings)
      object = json%get()
   end function object_of

end module life_report
