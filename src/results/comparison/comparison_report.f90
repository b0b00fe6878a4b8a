!> A comparison as text for people, and as an object of JSON.
module comparison_report
   use comparison, only: comparison_t
   use comparison_tables, only: table_of_channels, table_of_moments, table_of_pairs
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use kinds, only: i8
   use table_list, only: list_of
   use text, only: counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
   implicit none (type, external)
   private
   public :: comparison_json, comparison_text, verdict_text

   integer, parameter :: most_missing = 20   !! channels of one alone that are named

contains

   !> The verdict in a line.
   function verdict_text(found) result(words)
      type(comparison_t), intent(in) :: found     !! what was found
      character(:), allocatable :: words          !! one line

      words = counted(size(found%list), "channel", "channels")
      if (found%n_different == 0) then
         words = words//" compared, all within tolerance"
      else
         words = to_text(found%n_different)//" of "//words//" differ"
         if (found%n_different == 1) words = words//"s"
         words = words//" by more than the tolerance"
      end if
      if (found%by_statistics) words = words//" (means and RMS)"
   end function verdict_text

   !> For people.
   function comparison_text(found, first, second) result(text)
      type(comparison_t), intent(in) :: found     !! what was found
      character(*), intent(in) :: first           !! where A was read
      character(*), intent(in) :: second          !! where B was read
      character(:), allocatable :: text           !! whole lines

      type(buffer_t) :: lines
      integer :: k

      call lines%line("A          "//first)
      call lines%line("B          "//second)
      call lines%line("compared   "//counted(size(found%t), "time", "times")//" of B, "//real_text(found%t(1), 6)//" to "// &
                      real_text(found%t(size(found%t)), 6)//" s")
      call add_table(lines, table_of_channels(found))
      if (found%by_statistics) call add_table(lines, table_of_moments(found))
      call add_table(lines, table_of_pairs(found))
      do k = 1, min(size(found%missing), most_missing)
         call lines%line("not compared: "//found%missing(k)%s)
      end do
      if (size(found%missing) > most_missing) call lines%line("not compared: "//to_text(size(found%missing) - most_missing)// &
            " more")
      call lines%line("")
      call lines%line(verdict_text(found))
      text = lines%get()
   end function comparison_text

   !> For scripts.
   function comparison_json(found, first, second, directory, figures, warnings) result(text)
      type(comparison_t), intent(in) :: found     !! what was found
      character(*), intent(in) :: first           !! where A was read
      character(*), intent(in) :: second          !! where B was read
      character(*), intent(in) :: directory       !! of the output
      type(text_t), intent(in) :: figures(:)      !! (n) pictures
      type(text_t), intent(in) :: warnings(:)     !! (m) what was not made
      character(:), allocatable :: text           !! an object

      type(json_object_t) :: json

      call json%start(0)
      call json%put_text("a", first)
      call json%put_text("b", second)
      call json%put_text("directory", directory)
      call json%put_text("verdict", verdict_text(found))
      call json%put_logical("by_statistics", found%by_statistics)
      call json%put_integer("instants", int(size(found%t), i8))
      call json%put_integer("different", int(found%n_different, i8))
      call put_tables(json, list_of(table_of_channels(found), table_of_pairs(found)))
      call json%put_list("not_compared", found%missing)
      call json%put_list("figures", figures)
      call json%put_list("warnings", warnings)
      text = json%get()
   end function comparison_json

end module comparison_report
