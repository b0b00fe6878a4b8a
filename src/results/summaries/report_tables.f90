!> Tables of report.html: extremes, clearance joints, impacts, statistics, cost and error. Numbers are in units that read well.
module report_tables
   use catalogue, only: catalogue_t
   use channel_noise, only: shown_value => shown
   use channel_names, only: scalar_name
   use display_units, only: choose_unit, display_unit_t
   use event_list, only: event_list_t, number_units
   use extremes, only: extremes_t, joint_extremes_t
   use html_text, only: escaped
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use recorder, only: summary_t
   use statistics, only: number_t
   use summary_writer, only: accuracy_lines, cost_lines, first_impacts
   use text, only: real_text, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: cost_table, extremes_table, head, impact_table, joint_table, number_table, row

   integer, parameter :: most_channels = 2000  !! in the table of extremes
   integer, parameter :: most_joints = 500     !! in the table of clearance joints
   integer, parameter :: most_impacts = 200    !! in the table of impacts
   integer, parameter :: digits = 5            !! of a number

contains

   !> The heading of a section.
   subroutine head(lines, name, words)
      type(buffer_t), intent(inout) :: lines  !! the page
      character(*), intent(in) :: name        !! to be linked to
      character(*), intent(in) :: words       !! what it says

      call lines%line("<h2 id="""//name//""">"//escaped(words, .true.)//"</h2>")
   end subroutine head

   !> A row of two cells of text.
   subroutine row(lines, name, words)
      type(buffer_t), intent(inout) :: lines  !! the page
      character(*), intent(in) :: name        !! what it is
      character(*), intent(in) :: words       !! what there is to say

      call lines%line("<tr><td>"//escaped(name, .true.)//"</td><td class=""text"">"//escaped(words, .true.)//"</td></tr>")
   end subroutine row

   !> The start of a table.
   subroutine begin_table(lines, columns)
      type(buffer_t), intent(inout) :: lines      !! the page
      character(*), intent(in) :: columns(:)      !! (n) their names

      integer :: k

      call lines%add("<div class=""scroll""><table><thead><tr>")
      do k = 1, size(columns)
         call lines%add("<th>"//escaped(trim(columns(k)), .true.)//"</th>")
      end do
      call lines%line("</tr></thead><tbody>")
   end subroutine begin_table

   !> Its end.
   subroutine end_table(lines, left_out, where)
      type(buffer_t), intent(inout) :: lines  !! the page
      integer, intent(in) :: left_out         !! rows that there was no storage for
      character(*), intent(in) :: where       !! where they are

      call lines%line("</tbody></table></div>")
      if (left_out > 0) call lines%line("<p>"//to_text(left_out)//" more: "//escaped(where, .true.)//"</p>")
   end subroutine end_table

   !> A cell with a number in a unit.
   function cell(x, unit) result(s)
      real(wp), intent(in) :: x                   !! the number, SI [any]
      type(display_unit_t), intent(in) :: unit    !! how it is shown
      character(:), allocatable :: s              !! the cell

      s = "<td>"//real_text(unit%factor*x, digits)//"</td>"
      if (.not. ieee_is_finite(x)) s = "<td>unknown</td>"
   end function cell

   !> A cell with a number and the unit that suits it.
   function own_cell(x, si) result(s)
      real(wp), intent(in) :: x                   !! the number, SI [any]
      character(*), intent(in) :: si              !! its unit
      character(:), allocatable :: s              !! the cell

      type(display_unit_t) :: unit

      s = "<td>unknown</td>"
      if (.not. ieee_is_finite(x)) return
      unit = choose_unit(si, abs(x))
      s = "<td>"//real_text(unit%factor*x, digits)//" "//unit%symbol//"</td>"
   end function own_cell

   !> What the channels went through.
   subroutine extremes_table(lines, extremes, catalogue, time_end)
      type(buffer_t), intent(inout) :: lines        !! the page
      type(extremes_t), intent(in) :: extremes      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      real(wp), intent(in) :: time_end              !! of the run [s]

      type(display_unit_t) :: time, unit
      integer :: k, n

      if (size(extremes%channels) == 0) return
      time = choose_unit("s", abs(time_end))
      n = min(size(extremes%channels), most_channels)
      if (.not. extremes%has_course()) then
         call values_table(lines, extremes, catalogue)
         return
      end if
      call head(lines, "extremes", "Extremes of the channels")
      call begin_table(lines, [character(16) :: "channel", "unit", "minimum", "at ["//time%symbol//"]", "maximum", &
                               "at ["//time%symbol//"]", "mean", "rms"])
      do k = 1, n
         associate (one => extremes%shown_extreme(k))
            unit = choose_unit(catalogue%groups(extremes%channels(k)%group)%channel%unit, extremes%size_of(k))
            call lines%line("<tr><td>"//escaped(scalar_name(catalogue, extremes%channels(k)), .true.)//"</td><td>"// &
                            unit%symbol//"</td>"//cell(one%minimum, unit)//cell(one%min_time, time)//cell(one%maximum, unit)// &
                            cell(one%max_time, time)//cell(extremes%shown_mean(k), unit)// &
                            cell(extremes%shown_rms(k), unit)//"</tr>")
         end associate
      end do
      call end_table(lines, size(extremes%channels) - n, "run.h5, /extremes/channels")
   end subroutine extremes_table

   !> Values of the channels at one instant.
   subroutine values_table(lines, extremes, catalogue)
      type(buffer_t), intent(inout) :: lines        !! the page
      type(extremes_t), intent(in) :: extremes      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded

      type(display_unit_t) :: unit
      integer :: k, n

      n = min(size(extremes%channels), most_channels)
      call head(lines, "extremes", "Values of the channels")
      call begin_table(lines, [character(7) :: "channel", "unit", "value"])
      do k = 1, n
         associate (one => extremes%shown_extreme(k))
            unit = choose_unit(catalogue%groups(extremes%channels(k)%group)%channel%unit, extremes%size_of(k))
            call lines%line("<tr><td>"//escaped(scalar_name(catalogue, extremes%channels(k)), .true.)//"</td><td>"// &
                            unit%symbol//"</td>"//cell(one%minimum, unit)//"</tr>")
         end associate
      end do
      call end_table(lines, size(extremes%channels) - n, "run.h5, /extremes/channels")
   end subroutine values_table

   !> What the clearance joints went through.
   subroutine joint_table(lines, joints, time_end)
      type(buffer_t), intent(inout) :: lines            !! the page
      type(joint_extremes_t), intent(in) :: joints(:)   !! (n) the joints with contacts
      real(wp), intent(in) :: time_end                  !! of the run [s]

      type(display_unit_t) :: time
      integer :: k, n

      if (size(joints) == 0) return
      time = choose_unit("s", abs(time_end))
      n = min(size(joints), most_joints)
      call head(lines, "joints", "Joints with clearance")
      call begin_table(lines, [character(26) :: "joint", "impacts", "in contact [% of time]", "impact speed", &
                               "at ["//time%symbol//"]", "force", "at ["//time%symbol//"]", "penetration", &
                               "at ["//time%symbol//"]", "impulse", "energy lost"])
      do k = 1, n
         associate (joint => joints(k))
            call lines%add("<tr><td>"//escaped(joint%name, .true.)//"</td><td>"//to_text(joint%impacts)//"</td><td>"// &
                           real_text(100.0_wp*joint%contact_fraction, 4)//"</td>")
            if (joint%impacts == 0) then
               call lines%line(repeat("<td></td>", 8)//"</tr>")
            else
               call lines%line(own_cell(joint%speed, "m/s")//cell(joint%speed_onset, time)//own_cell(joint%force, "N")// &
                               cell(joint%force_time, time)//own_cell(joint%penetration, "m")// &
                               cell(joint%penetration_time, time)//own_cell(joint%impulse, "N.s")// &
                               own_cell(joint%energy_lost, "J")//"</tr>")
            end if
         end associate
      end do
      call end_table(lines, size(joints) - n, "run.h5, /extremes/joints")
   end subroutine joint_table

   !> The first impacts.
   subroutine impact_table(lines, events, time_end)
      type(buffer_t), intent(inout) :: lines       !! the page
      type(event_list_t), intent(in) :: events     !! all events
      real(wp), intent(in) :: time_end             !! of the run [s]

      integer, parameter :: shown(*) = [2, 3, 4, 5, 6, 8, 7]  ! columns of the list of events
      integer, allocatable :: list(:)
      type(display_unit_t) :: time
      integer :: i, k, n

      list = first_impacts(events, most_impacts)
      if (size(list) == 0) return
      time = choose_unit("s", abs(time_end))
      call head(lines, "impacts", "Impacts, by onset time")
      call begin_table(lines, [character(16) :: "joint", "contact", "onset ["//time%symbol//"]", "impact speed", "peak force", &
                               "penetration", "duration", "separation speed", "impulse", "energy lost"])
      do k = 1, size(list)
         call lines%add("<tr><td>"//escaped(events%word(list(k), 2), .true.)//"</td><td>"// &
                        escaped(events%word(list(k), 3), .true.)//"</td>"//cell(events%numbers(1, list(k)), time))
         do i = 1, size(shown)
            call lines%add(own_cell(events%numbers(shown(i), list(k)), trim(number_units(shown(i)))))
         end do
         call lines%line("</tr>")
      end do
      n = 0
      do k = 1, events%n
         if (events%word(k, 1) == "contact") n = n + 1
      end do
      call end_table(lines, n - size(list), "events.dat, and run.h5, /events")
   end subroutine impact_table

   !> The statistics.
   subroutine number_table(lines, after, numbers)
      type(buffer_t), intent(inout) :: lines      !! the page
      real(wp), intent(in) :: after               !! end of the transient [s]
      type(number_t), intent(in) :: numbers(:)    !! (any) the statistics

      integer :: k

      if (size(numbers) == 0) return
      call head(lines, "statistics", "Statistics from "//real_text(after, 6)//" s on")
      call begin_table(lines, [character(8) :: "number", "value"])
      do k = 1, size(numbers)
         call lines%line("<tr><td>"//escaped(numbers(k)%name, .true.)//"</td>"// &
                         own_cell(shown_value(numbers(k)%value, numbers(k)%noise), numbers(k)%unit)//"</tr>")
      end do
      call end_table(lines, 0, "")
   end subroutine number_table

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

end module report_tables
