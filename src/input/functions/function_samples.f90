!> Smooth curve through samples: a cubic spline, twice continuously differentiable, or Akima's curve, whose second derivative jumps
!> at the samples.
!>
!> The samples stand in the row, as two lists in quotes with a unit each, or in a text file whose first line
!> names two columns with their units, as `t[ms] lift[mm]`. The argument is what the places are: a time for drivers
!> and loads, or any other quantity.
!>
!> `ends` closes the spline: not_a_knot (exact for cubics), natural (no curvature at the ends), clamped (no slope
!> there), fmm (third derivatives of cubics through four samples). `beyond` says what is outside the samples: error (the function
!> does not exist, which ends a run that gets there), hold (the value of the end), linear (the tangent of the end), periodic (the
!> samples repeat; the last value is the first one, and the curve closes smoothly, so that `ends` has no meaning).
!>
!> Source: de Boor, A practical guide to splines (1978), chapter IV; H. Akima, J. ACM 17 (1970) 589-602. Limits: at least 4 samples;
!> hold and linear have a jump of the first or second derivative at the end unless the samples flatten out there.
module function_samples
   use akima, only: new_akima
   use curve, only: beyond_error, beyond_stabilisation, beyond_linear, beyond_periodic
   use function_kind, only: function_kind_t, made_t
   use item, only: item_t, place_of
   use kind_info, only: add_file, add_list, add_word, kind_info_t
   use kinds, only: wp
   use number_lists, only: file_to_lists
   use spline, only: ends_clamped, ends_fmm, ends_natural, ends_not_a_knot, ends_periodic, min_samples, new_spline
   use text, only: to_text
   implicit none (type, external)
   private
   public :: function_samples_t

   character(5), parameter :: lists(2) = [character(5) :: "at", "value"]  !! columns of lists, in the order of a file's columns
   real(wp), parameter :: closed = 1.0e-9_wp  !! difference of the ends of a period, of the maximum value [1]

   !> The kind.
   type, extends(function_kind_t) :: function_samples_t
   contains
      procedure, nopass :: info => samples_info
      procedure, nopass :: make => samples_make
   end type function_samples_t

contains

   !> Description of the kind.
   function samples_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "function.samples"
      info%help = "smooth curve through samples; expressions call it by its name: {lift(t)}"
      info%source = "de Boor (1978), chapter IV; Akima (1970)"
      call add_list(info, "at", "abscissas of the samples, increasing", default="")
      call add_list(info, "value", "ordinates of the samples", default="")
      call add_file(info, "file", "two-column file, relative to the deck, with names and units in the first line; instead of at " &
                    //"and value", default="")
      call add_word(info, "curve", "interpolation: a cubic spline, or Akima's curve, which is less sensitive to an outlier " &
                    //"but has kinks in the second derivative", default="spline", choices="spline akima")
      call add_word(info, "ends", "end condition of a spline; default: not_a_knot", default="", &
                    choices="not_a_knot natural clamped fmm")
      call add_word(info, "beyond", "continuation outside the samples", default="error", choices="error hold linear periodic")
   end function samples_info

   !> The curve of a row.
   subroutine samples_make(item, made)
      type(item_t), intent(inout) :: item  !! the row; samples of a file become lists
      type(made_t), intent(out) :: made    !! the curve, or the first error

      call file_to_lists(item, lists, made%column)
      if (made%column > 0) then
         made%message = "the samples are already given by a file"
         made%help = "give columns at and value, or column file"
         return
      end if
      call check_samples(item, made)
      if (made%column > 0) return
      associate (at => item%values(place_of(item, "at")), value => item%values(place_of(item, "value")))
         made%argument = at%dimensions(1)
         made%dimension = value%dimensions(1)
         if (item%word("curve") == "akima") then
            call new_akima(at%table(:, 1), value%table(:, 1), beyond_of(item), made%curve)
         else
            call new_spline(at%table(:, 1), value%table(:, 1), ends_of(item), beyond_of(item), made%curve)
         end if
      end associate
   end subroutine samples_make

   !> Whether there are enough samples, in order, and closed if they repeat.
   subroutine check_samples(item, made)
      type(item_t), intent(in) :: item     !! the row
      type(made_t), intent(inout) :: made  !! receives an error

      integer :: k, n, places, values

      made%help = ""
      do k = 1, 2
         if (item%is_given(trim(lists(k)))) cycle
         call complain(trim(lists(k)), "the samples are missing")
         made%help = "give columns at and value, as ""0 10 20 30 ms"", or column file"
         return
      end do
      places = place_of(item, "at")
      values = place_of(item, "value")
      associate (x => item%values(places)%table(:, 1), y => item%values(values)%table(:, 1))
         n = size(x)
         if (size(y) /= n) then
            call complain("value", to_text(size(y))//" values at "//to_text(n)//" places")
         else if (n < min_samples) then
            call complain("at", "there are "//to_text(n)//" samples, a smooth curve needs at least "//to_text(min_samples))
         else if (.not. all(x(2:) > x(:n - 1))) then
            do k = 2, n
               if (.not. x(k) > x(k - 1)) exit
            end do
            call complain("at", "sample "//to_text(k)//" is not greater than sample "//to_text(k - 1))
            made%place = k
            made%help = "abscissas must increase from sample to sample"
         else if (beyond_of(item) == beyond_periodic .and. abs(y(n) - y(1)) > closed*maxval(abs(y))) then
            call complain("value", "the last value differs from the first one")
            made%help = "with beyond = periodic the last sample must equal the first sample of the next period"
         else if (beyond_of(item) == beyond_periodic .and. item%is_given("ends")) then
            call complain("ends", "a periodic curve has no end conditions")
            made%help = "omit column ends, or write -"
         else if (item%word("curve") == "akima" .and. item%is_given("ends")) then
            call complain("ends", "the end conditions of Akima's curve follow from its samples")
            made%help = "omit column ends, or write -; curve = spline has end conditions"
         end if
      end associate

   contains

      !> Note an error.
      subroutine complain(column, message)
         character(*), intent(in) :: column   !! where it is
         character(*), intent(in) :: message  !! what is wrong

         made%column = place_of(item, column)
         made%message = message
      end subroutine complain

   end subroutine check_samples

   !> How the spline of a row is closed.
   pure integer function ends_of(item) result(ends)
      type(item_t), intent(in) :: item  !! the row

      select case (item%word("ends"))
      case ("natural")
         ends = ends_natural
      case ("clamped")
         ends = ends_clamped
      case ("fmm")
         ends = ends_fmm
      case default
         ends = ends_not_a_knot
      end select
      if (beyond_of(item) == beyond_periodic) ends = ends_periodic
   end function ends_of

   !> What is outside the samples of a row.
   pure integer function beyond_of(item) result(beyond)
      type(item_t), intent(in) :: item  !! the row

      select case (item%word("beyond"))
      case ("hold")
         beyond = beyond_stabilisation
      case ("linear")
         beyond = beyond_linear
      case ("periodic")
         beyond = beyond_periodic
      case default
         beyond = beyond_error
      end select
   end function beyond_of

end module function_samples
