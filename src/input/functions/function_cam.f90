!> Rise, dwell and return of a cam's follower, of an angle or of the time.
!>
!> f(x) = L s((x - x_0)/b_1) - L s_r((x - x_0 - b_1 - b_2)/b_3)
!>
!> L lift; b_1 rise, b_2 dwell, b_3 return; s and s_r the laws of both (`rise_laws`). Before the start it is 0; with a period it
!> repeats itself, without one it stays where it ends. Without a return it rises and stays.
!>
!> Laws are those whose acceleration has no jumps. Where a formula changes is an instant, so that steps end there.
!> Source: R. L. Norton, Cam design and manufacturing handbook (2002), chapters 3 and 4. Limits: none.
module function_cam
   use curve, only: beyond_stabilisation, beyond_periodic, rise_t
   use dimension_text, only: dimension_name, unit_text
   use function_kind, only: function_kind_t, made_t
   use item, only: item_t, place_of
   use kind_info, only: add_any_number, add_word, kind_info_t, same_dimension
   use kinds, only: eps, wp
   use rise_laws, only: number_of_rise
   use text, only: to_text
   implicit none (type, external)
   private
   public :: function_cam_t

   character(*), parameter :: laws = "cycloidal poly345 poly4567 modified_sine"   !! laws without jumps of the acceleration
   character(*), parameter :: lengths(4) = [character(6) :: "start", "dwell", "return", "period"]  !! like column rise

   !> The kind.
   type, extends(function_kind_t) :: function_cam_t
   contains
      procedure, nopass :: info => cam_info
      procedure, nopass :: make => cam_make
   end type function_cam_t

contains

   !> Description of the kind.
   function cam_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "function.cam"
      info%help = "rise, dwell and return of a cam follower; expressions call it by its name: {lift(w*t)}"
      info%source = "R. L. Norton, Cam design and manufacturing handbook (2002), chapters 3 and 4"
      call add_word(info, "law", "motion law of the rise", default="cycloidal", choices=laws)
      call add_any_number(info, "lift", "height of the rise")
      call add_any_number(info, "rise", "angle or time of the rise")
      call add_any_number(info, "dwell", "angle or time of the dwell", default="")
      call add_any_number(info, "return", "angle or time of the return; default: no return", default="")
      call add_word(info, "return_law", "motion law of the return; default: that of the rise", default="", choices=laws)
      call add_any_number(info, "start", "start of the rise", default="")
      call add_any_number(info, "period", "angle or time of one period; default: not periodic", default="")
   end function cam_info

   !> The curve of a row.
   subroutine cam_make(item, made)
      type(item_t), intent(inout) :: item  !! the row
      type(made_t), intent(out) :: made    !! the curve, or the first error

      character(:), allocatable :: word
      real(wp) :: begin, total

      call check_row(item, made)
      if (made%column > 0) return
      associate (lift => item%values(place_of(item, "lift")), rise => item%values(place_of(item, "rise")))
         made%dimension = lift%dimensions(1)
         made%argument = rise%dimensions(1)
         begin = item%number("start")
         total = rise%number + item%number("dwell") + item%number("return")
         made%curve%beyond = beyond_stabilisation
         if (item%is_given("period")) then
            made%curve%beyond = beyond_periodic
            total = item%number("period")
         end if
         made%curve%x = [begin, begin + total]
         allocate (made%curve%c(0:0, 1), source=0.0_wp)
         made%curve%rises = [rise_t(number_of_rise(item%word("law")), begin, rise%number, lift%number)]
         if (.not. item%is_given("return")) return
         word = item%word("return_law")
         if (word == "") word = item%word("law")
         made%curve%rises = [made%curve%rises, rise_t(number_of_rise(word), begin + rise%number + item%number("dwell"), &
                                                      item%number("return"), -lift%number)]
      end associate
   end subroutine cam_make

   !> Whether lengths are of one dimension and fit together.
   subroutine check_row(item, made)
      type(item_t), intent(in) :: item     !! the row
      type(made_t), intent(inout) :: made  !! receives an error

      real(wp) :: total
      integer :: k

      made%help = ""
      associate (rise => item%values(place_of(item, "rise")))
         do k = 1, size(lengths)
            associate (value => item%values(place_of(item, trim(lengths(k)))))
               if (.not. value%given .or. same_dimension(value%dimensions(1), rise%dimensions(1))) cycle
               call complain(trim(lengths(k)), "this is "//dimension_name(value%dimensions(1))//", the rise takes "// &
                             dimension_name(rise%dimensions(1)))
               return
            end associate
         end do
         total = rise%number + item%number("dwell") + item%number("return")
         if (.not. rise%number > 0.0_wp) then
            call complain("rise", "the rise must be positive")
         else if (item%number("dwell") < 0.0_wp) then
            call complain("dwell", "the dwell must not be negative")
         else if (item%is_given("return") .and. .not. item%number("return") > 0.0_wp) then
            call complain("return", "the return must be positive")
         else if (item%is_given("dwell") .and. .not. item%is_given("return")) then
            call complain("dwell", "without a return the dwell has no end")
            made%help = "give column return, or omit dwell"
         else if (item%is_given("period") .and. .not. item%is_given("return")) then
            call complain("period", "without a return the function cannot be periodic")
            made%help = "give column return"
         else if (item%is_given("period") .and. item%number("period") < total*(1.0_wp - 8.0_wp*eps)) then
            call complain("period", "the period is shorter than the sum of rise, dwell and return")
            made%help = "their sum is "//to_text(total)
            if (unit_text(rise%dimensions(1)) /= "1") made%help = made%help//" "//unit_text(rise%dimensions(1))
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

   end subroutine check_row

end module function_cam
