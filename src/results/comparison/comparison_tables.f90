!> A comparison of two runs as tables: a row for each channel, and for each pair of impacts.
module comparison_tables
   use comparison, only: comparison_t
   use differences_of_series, only: difference_t
   use kinds, only: wp
   use result_table, only: in_csv, in_json, in_text_files, only_shown, result_table_t
   use text, only: counted, real_text, text_t, to_text
   implicit none (type, external)
   private
   public :: table_of_channels, table_of_moments, table_of_pairs

contains

   !> The channels.
   function table_of_channels(found) result(table)
      type(comparison_t), intent(in) :: found     !! what was found
      type(result_table_t) :: table               !! a row for each channel

      type(text_t) :: remarks(size(found%list))
      integer :: k

      call start_channels(table, found, "channels")
      associate (d => found%list)
         do k = 1, size(d)
            remarks(k)%s = trim(merge("differs", "       ", d(k)%is_different))//of_output_times(d(k))//of_interpolation(d(k))
         end do
         call table%put("unit", "1", "its unit", texts=table%units, formats=in_text_files)
         call table%put("instants", "1", "times compared", integers=d%n, formats=in_text_files)
         call put_counts(in_json)
         call table%put("differs", "1", "the verdict", logicals=d%is_different, formats=in_json)
         call table%put("rms", "list", "root mean square of the differences", d%rms, heading="RMS", digits=3)
         call table%put("greatest", "list", "maximum difference", d%maximum, heading="maximum", digits=3)
         call table%put("at", "s", "its time", d%at, heading="at", digits=3)
         call table%put("allowed", "list", "tolerance", d%allowed, heading="tolerance", digits=3)
         call table%put("differs", "1", "the verdict", logicals=d%is_different, formats=in_csv)
         call table%put("interpolation", "list", "error of the interpolation at most", d%interpolation)
         call table%put("peak_a", "list", "maximum magnitude of A", d%peak(1), heading="peak A", digits=3)
         call table%put("peak_a_at", "s", "its time", d%peak_at(1))
         call table%put("peak_b", "list", "maximum magnitude of B", d%peak(2), heading="peak B", digits=3)
         call table%put("peak_b_at", "s", "its time", d%peak_at(2))
         call table%put("lag", "s", "of B behind A; NaN: unknown", d%lag, heading="lag", digits=3)
         call table%put("magnitude", "1", "error of magnitude of Sprague and Geers", d%magnitude, heading="magn.", digits=2)
         call table%put("phase", "1", "error of phase of Sprague and Geers", d%phase, heading="phase", digits=2)
         call table%put("mean_a", "list", "mean of A", d%mean%a%value)
         call table%put("mean_a_half", "list", "half of its interval", d%mean%a%half)
         call table%put("mean_b", "list", "mean of B", d%mean%b%value)
         call table%put("mean_b_half", "list", "half of its interval", d%mean%b%half)
         call table%put("mean_significance", "1", "probability of such a difference by chance", d%mean%significance)
         call table%put("square_a", "list", "mean square of A", d%square%a%value)
         call table%put("square_a_half", "list", "half of its interval", d%square%a%half, formats=in_json)
         call table%put("square_b", "list", "mean square of B", d%square%b%value)
         call table%put("square_b_half", "list", "half of its interval", d%square%b%half, formats=in_json)
         call table%put("square_significance", "1", "probability of such a difference by chance", d%square%significance)
         call put_counts(in_csv)
         call table%put("remarks", "1", "verdict, and times not compared", texts=remarks, formats=only_shown, heading="")
      end associate

   contains

      !> Times that were not compared, by reason.
      subroutine put_counts(formats)
         integer, intent(in) :: formats   !! which files have them here

         call table%put("only_a", "1", "times with a value in A only", integers=found%list%only(1), formats=formats)
         call table%put("only_b", "1", "times with a value in B only", integers=found%list%only(2), formats=formats)
         call table%put("neither", "1", "times without a value", integers=found%list%neither, formats=formats)
         call table%put("unsettled", "1", "times at which A changes between its rows", integers=found%list%unsettled, &
                        formats=formats)
      end subroutine put_counts

   end function table_of_channels

   !> Begin a table of the channels.
   subroutine start_channels(table, found, name)
      type(result_table_t), intent(inout) :: table    !! the table
      type(comparison_t), intent(in) :: found         !! what was found
      character(*), intent(in) :: name                !! of the table

      type(text_t) :: names(size(found%list)), units(size(found%list))
      integer :: k

      do k = 1, size(names)
         names(k)%s = found%list(k)%name
         units(k)%s = found%list(k)%unit
      end do
      call table%start(name, "", size(names), title="channel")
      call table%put("channel", "1", "name of the channel", texts=names, heading="channel")
      table%most = size(names)
      table%most_in_json = size(names)
      table%units = units
      table%noise = found%list%noise
   end subroutine start_channels

   !> Means and RMS with their significance.
   function table_of_moments(found) result(table)
      type(comparison_t), intent(in) :: found     !! what was found
      type(result_table_t) :: table               !! a row for each channel

      call start_channels(table, found, "moments")
      deallocate (table%noise)
      associate (mean => found%list%mean, square => found%list%square)
         call table%put("mean_a", "list", "mean of A", mean%a%value, heading="mean A", digits=3)
         call table%put("mean_a_half", "list", "half of its interval", mean%a%half, heading="+-", digits=3)
         call table%put("mean_b", "list", "mean of B", mean%b%value, heading="mean B", digits=3)
         call table%put("mean_b_half", "list", "half of its interval", mean%b%half, heading="+-", digits=3)
         call table%put("p_mean", "1", "probability of such a difference by chance", mean%significance, heading="p", digits=3)
         call table%put("rms_a", "list", "root mean square of A", sqrt(square%a%value), heading="RMS A", digits=3)
         call table%put("rms_b", "list", "root mean square of B", sqrt(square%b%value), heading="RMS B", digits=3)
         call table%put("p_rms", "1", "probability of such a difference by chance", square%significance, heading="p", digits=3)
      end associate
   end function table_of_moments

   !> First impacts of both runs.
   function table_of_pairs(found) result(table)
      type(comparison_t), intent(in) :: found     !! what was found
      type(result_table_t) :: table               !! a row for each pair

      type(text_t) :: items(size(found%pairs)), names(size(found%pairs))
      integer :: k

      do k = 1, size(names)
         items(k)%s = found%pairs(k)%item
         names(k)%s = items(k)%s//" "//to_text(found%pairs(k)%number)
      end do
      call table%start("impacts", "", size(names), title="impact")
      table%most = size(names)
      table%most_in_json = size(names)
      associate (p => found%pairs)
         call table%put("name", "1", "joint and number", texts=names, formats=only_shown, heading="impact")
         call table%put("item", "1", "joint, and label of the contact", texts=items, formats=in_text_files)
         call table%put("number", "1", "in the order of the joint's impacts", integers=p%number)
         call table%put("onset_a", "s", "onset in A", p%a%time, heading="onset A", digits=9)
         call table%put("onset_b", "s", "onset in B", p%b%time)
         call table%put("later", "s", "onset in B less that in A", p%b%time - p%a%time, formats=only_shown, &
                        heading="B - A", digits=3)
         call table%put("impact_speed_a", "m/s", "impact speed in A", p%a%speed, heading="speed A", digits=3)
         call table%put("impact_speed_b", "m/s", "impact speed in B", p%b%speed, heading="speed B", digits=3)
         call table%put("peak_force_a", "N", "peak force in A", p%a%force, heading="peak A", digits=3)
         call table%put("peak_force_b", "N", "peak force in B", p%b%force, heading="peak B", digits=3)
      end associate
   end function table_of_pairs

   !> At how many times both were compared, where that is not all, and why.
   function of_output_times(difference) result(words)
      type(difference_t), intent(in) :: difference   !! of a channel
      character(:), allocatable :: words             !! blank where all were compared

      words = ""
      associate (d => difference)
         if (d%only(1) > 0) words = words//", value only in A at "//to_text(d%only(1))
         if (d%only(2) > 0) words = words//", value only in B at "//to_text(d%only(2))
         if (d%neither > 0) words = words//", in neither at "//to_text(d%neither)
         if (d%unsettled > 0) words = words//", A changes between its rows at "//to_text(d%unsettled)
         if (words /= "") words = "  ("//counted(d%n, "time", "times")//" compared"//words//")"
      end associate
   end function of_output_times

   !> What the interpolation may have added, where that matters.
   function of_interpolation(difference) result(words)
      type(difference_t), intent(in) :: difference   !! of a channel
      character(:), allocatable :: words             !! blank where it does not matter

      words = ""
      if (difference%n == 0) return
      if (difference%interpolation > 0.1_wp*max(difference%allowed, difference%maximum)) then
         words = "  (interpolation up to "//real_text(difference%interpolation, 2)//")"
      end if
   end function of_interpolation

end module comparison_tables
