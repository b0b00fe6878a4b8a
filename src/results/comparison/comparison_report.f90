!> A comparison as text for people, as rows, and as an object of JSON.
module comparison_report
   use channel_noise, only: shown
   use comparison, only: comparison_t
   use differences_of_series, only: difference_t, moments_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use json_text, only: json_object_t
   use kinds, only: i8, wp
   use text, only: counted, exact_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: comparison_json, comparison_rows, comparison_text, verdict_text

   integer, parameter :: most_missing = 20   !! channels of one alone that are named
   integer, parameter :: cell_width = 11     !! of a column of numbers with three digits
   integer, parameter :: short_width = 10    !! of one of numbers with two

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
      integer :: k, width

      call lines%line("A          "//first)
      call lines%line("B          "//second)
      call lines%line("compared   "//counted(size(found%t), "time", "times")//" of B, "//real_text(found%t(1), 6)//" to "// &
                      real_text(found%t(size(found%t)), 6)//" s")
      call lines%line("")
      width = 20
      do k = 1, size(found%list)
         width = max(width, len(found%list(k)%name) + len(found%list(k)%unit) + 4)
      end do
      call lines%line(padded("channel", width)//heads([character(10) :: "RMS", "maximum", "at [s]", "tolerance", "peak A", &
                      "peak B", "lag [s]"], cell_width)//trim(heads([character(5) :: "magn.", "phase"], short_width)))
      do k = 1, size(found%list)
         associate (d => found%list(k))
            call lines%line(trim(padded(d%name//" ["//d%unit//"]", width)//cell(shown(d%rms, d%noise))// &
                            cell(shown(d%maximum, d%noise))//cell(d%at)//cell(d%allowed)//cell(shown(d%peak(1), d%noise))// &
                            cell(shown(d%peak(2), d%noise))//cell(d%lag)//short(d%magnitude)//short(d%phase)// &
                            trim(merge("differs  ", "         ", d%is_different))//of_output_times(d)//of_interpolation(d)))
         end associate
      end do
      if (found%by_statistics) call add_statistics(lines, found, width)
      if (size(found%pairs) > 0) then
         call lines%line("")
         call lines%line(padded("impact", width)//padded("onset A [s]", 17)//padded("B - A [s]", cell_width)// &
                         padded("speed A", cell_width)//padded("speed B [m/s]", 14)//padded("peak A", cell_width)//"peak B [N]")
         do k = 1, size(found%pairs)
            associate (p => found%pairs(k))
               call lines%line(padded(p%item//" "//to_text(p%number), width)//padded(real_text(p%a%time, 9), 17)// &
                               cell(p%b%time - p%a%time)//cell(p%a%speed)//padded(cell(p%b%speed), 14)//cell(p%a%force)// &
                               trim(cell(p%b%force)))
            end associate
         end do
      end if
      do k = 1, min(size(found%missing), most_missing)
         call lines%line("not compared: "//found%missing(k)%s)
      end do
      if (size(found%missing) > most_missing) call lines%line("not compared: "//to_text(size(found%missing) - most_missing)// &
            " more")
      call lines%line("")
      call lines%line(verdict_text(found))
      text = lines%get()
   end function comparison_text

   !> Means and RMS with their significance.
   subroutine add_statistics(lines, found, width)
      type(buffer_t), intent(inout) :: lines      !! the text
      type(comparison_t), intent(in) :: found     !! what was found
      integer, intent(in) :: width                !! of the first column

      integer :: k

      call lines%line("")
      call lines%line(padded("channel", width)//trim(heads([character(6) :: "mean A", "+-", "mean B", "+-", "p", "RMS A", "RMS B", &
                      "p"], cell_width)))
      do k = 1, size(found%list)
         associate (d => found%list(k))
            call lines%line(trim(padded(d%name//" ["//d%unit//"]", width)//cell(d%mean%a%value)//cell(d%mean%a%half)// &
                            cell(d%mean%b%value)//cell(d%mean%b%half)//cell(d%mean%significance)// &
                            cell(sqrt(d%square%a%value))//cell(sqrt(d%square%b%value))//cell(d%square%significance)))
         end associate
      end do
   end subroutine add_statistics

   !> At how many instants both were compared, where that is not all, and why.
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

   !> A text of some width.
   pure function padded(text, width) result(s)
      character(*), intent(in) :: text     !! the text
      integer, intent(in) :: width         !! at least
      character(:), allocatable :: s       !! with blanks behind it

      s = text//repeat(" ", max(0, width - len(text)))
   end function padded

   !> A number with three digits, at most `-1.23e-100`, and a blank behind it.
   pure function cell(x) result(s)
      real(wp), intent(in) :: x            !! the number [any]
      character(:), allocatable :: s       !! with blanks behind it

      s = "-"
      if (ieee_is_finite(x)) s = real_text(x, 3)
      s = padded(s, cell_width)
   end function cell

   !> A measure of Sprague and Geers with two digits, at most `-1.2e-100`, and a blank behind it.
   pure function short(x) result(s)
      real(wp), intent(in) :: x            !! the measure [1]
      character(:), allocatable :: s       !! with blanks behind it

      s = "-"
      if (ieee_is_finite(x)) s = real_text(x, 2)
      s = padded(s, short_width)
   end function short

   !> Headings of columns of numbers.
   pure function heads(words, width) result(s)
      character(*), intent(in) :: words(:) !! (n) a heading each
      integer, intent(in) :: width         !! of a column
      character(:), allocatable :: s       !! the line

      integer :: k

      s = ""
      do k = 1, size(words)
         s = s//padded(trim(words(k)), width)
      end do
   end function heads

   !> A row of numbers for each channel.
   function comparison_rows(found) result(text)
      type(comparison_t), intent(in) :: found     !! what was found
      character(:), allocatable :: text           !! comma-separated, SI

      type(buffer_t) :: lines
      integer :: k

      call lines%line("channel,unit,instants,rms,greatest,at,allowed,differs,interpolation,peak_a,peak_a_at,peak_b,peak_b_at,"// &
                      "lag,magnitude,phase,mean_a,mean_a_half,mean_b,mean_b_half,mean_significance,square_a,square_b,"// &
                      "square_significance,only_a,only_b,neither,unsettled")
      do k = 1, size(found%list)
         associate (d => found%list(k))
            call lines%line(d%name//","//d%unit//","//to_text(d%n)//joined([d%rms, d%maximum, d%at, d%allowed])//","// &
                            to_text(merge(1, 0, d%is_different))//joined([d%interpolation, d%peak(1), d%peak_at(1), d%peak(2), &
                            d%peak_at(2), d%lag, d%magnitude, d%phase, d%mean%a%value, d%mean%a%half, d%mean%b%value, &
                            d%mean%b%half, d%mean%significance, d%square%a%value, d%square%b%value, d%square%significance])// &
                            ","//to_text(d%only(1))//","//to_text(d%only(2))//","//to_text(d%neither)//","//to_text(d%unsettled))
         end associate
      end do
      text = lines%get()
   end function comparison_rows

   !> Numbers with a comma before each; nothing stands for one that is not known.
   pure function joined(x) result(s)
      real(wp), intent(in) :: x(:)         !! (n) numbers [any]
      character(:), allocatable :: s       !! the row

      integer :: k

      s = ""
      do k = 1, size(x)
         s = s//","
         if (ieee_is_finite(x(k))) s = s//exact_text(x(k))
      end do
   end function joined

   !> For scripts.
   !> Length: a line for each member.
   function comparison_json(found, first, second, directory, figures, warnings) result(text)
      type(comparison_t), intent(in) :: found     !! what was found
      character(*), intent(in) :: first           !! where A was read
      character(*), intent(in) :: second          !! where B was read
      character(*), intent(in) :: directory       !! of the output
      type(text_t), intent(in) :: figures(:)      !! (n) pictures
      type(text_t), intent(in) :: warnings(:)     !! (m) what was not made
      character(:), allocatable :: text           !! an object

      type(json_object_t) :: json, one
      type(text_t), allocatable :: channels(:), pairs(:)
      integer :: k

      allocate (channels(size(found%list)), pairs(size(found%pairs)))
      do k = 1, size(found%list)
         associate (d => found%list(k))
            one = json_object_t()
            call one%start(2)
            call one%put_text("channel", d%name)
            call one%put_text("unit", d%unit)
            call one%put_integer("instants", int(d%n, i8))
            call one%put_integer("only_a", int(d%only(1), i8))
            call one%put_integer("only_b", int(d%only(2), i8))
            call one%put_integer("neither", int(d%neither, i8))
            call one%put_integer("unsettled", int(d%unsettled, i8))
            call one%put_logical("differs", d%is_different)
            call one%put_real("rms", d%rms)
            call one%put_real("greatest", d%maximum)
            call one%put_real("at", d%at)
            call one%put_real("allowed", d%allowed)
            call one%put_real("interpolation", d%interpolation)
            call one%put_real("peak_a", d%peak(1))
            call one%put_real("peak_a_at", d%peak_at(1))
            call one%put_real("peak_b", d%peak(2))
            call one%put_real("peak_b_at", d%peak_at(2))
            call one%put_real("lag", d%lag)
            call one%put_real("magnitude", d%magnitude)
            call one%put_real("phase", d%phase)
            call put_moments(one, "mean", d%mean)
            call put_moments(one, "square", d%square)
            channels(k)%s = one%get()
         end associate
      end do
      do k = 1, size(found%pairs)
         associate (p => found%pairs(k))
            one = json_object_t()
            call one%start(2)
            call one%put_text("item", p%item)
            call one%put_integer("number", int(p%number, i8))
            call one%put_real("onset_a", p%a%time)
            call one%put_real("onset_b", p%b%time)
            call one%put_real("impact_speed_a", p%a%speed)
            call one%put_real("impact_speed_b", p%b%speed)
            call one%put_real("peak_force_a", p%a%force)
            call one%put_real("peak_force_b", p%b%force)
            pairs(k)%s = one%get()
         end associate
      end do
      call json%start(0)
      call json%put_text("a", first)
      call json%put_text("b", second)
      call json%put_text("directory", directory)
      call json%put_text("verdict", verdict_text(found))
      call json%put_logical("by_statistics", found%by_statistics)
      call json%put_integer("instants", int(size(found%t), i8))
      call json%put_integer("different", int(found%n_different, i8))
      call json%put_objects("channels", channels)
      call json%put_objects("impacts", pairs)
      call json%put_list("not_compared", found%missing)
      call json%put_list("figures", figures)
      call json%put_list("warnings", warnings)
      text = json%get()
   end function comparison_json

   !> A mean of both.
   subroutine put_moments(json, name, moments)
      type(json_object_t), intent(inout) :: json   !! the object
      character(*), intent(in) :: name             !! of the mean
      type(moments_t), intent(in) :: moments       !! the means

      call json%put_real(name//"_a", moments%a%value)
      call json%put_real(name//"_a_half", moments%a%half)
      call json%put_real(name//"_b", moments%b%value)
      call json%put_real(name//"_b_half", moments%b%half)
      call json%put_real(name//"_significance", moments%significance)
   end subroutine put_moments

end module comparison_report
