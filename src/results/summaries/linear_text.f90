!> Films at a steady state and small motions about it, as text.
module linear_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: pi, two_pi, wp
   use linearised, only: film_coefficients_t, linearised_t
   use text, only: append_text, real_text, text_t
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: film_lines, linear_lines

   integer, parameter :: n_digit = 5                                      !! digits that are printed
   character(*), parameter :: place(4) = ["xx", "xy", "yx", "yy"]         !! of the entries of a matrix, row by row
   integer, parameter :: row(4) = [1, 1, 2, 2], column(4) = [1, 2, 1, 2]  !! of these entries

   real(wp), parameter :: ice = 273.15_wp                                 !! 0 degC [K]

contains

   !> Films, and the speed at which whirl sets in; nothing if no film was linearised.
   subroutine linear_lines(lines, linear)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(linearised_t), intent(in) :: linear    !! what is known

      type(text_t), allocatable :: words(:)
      integer :: i, k

      if (.not. allocated(linear%films)) return
      do k = 1, size(linear%films)
         words = film_lines(linear%films(k))
         call lines%line("film       "//words(1)%s)
         do i = 2, size(words)
            call lines%line("           "//words(i)%s)
         end do
      end do
      if (linear%is_searched) call lines%line("whirl      "//linear%onset_words)
   end subroutine linear_lines

   !> A film as text.
   function film_lines(film) result(words)
      type(film_coefficients_t), intent(in) :: film  !! the film
      type(text_t), allocatable :: words(:)          !! (2 to 5) lines

      allocate (words(0))
      call append_text(words, film%joint//": eccentricity "//real_text(film%eccentricity_ratio, n_digit)// &
                       " of the clearance, attitude angle "//real_text(film%attitude*180.0_wp/pi, n_digit)//" deg, load "// &
                       real_text(film%load, n_digit)//" N, journal at "//real_text(film%journal_speed, n_digit)//" rad/s")
      if (film%is_heated) then
         call append_text(words, "temperature "//real_text(film%temperature - ice, n_digit)// &
                          " degC from the heat balance, viscosity "//real_text(film%viscosity, n_digit)//" Pa.s")
      end if
      if (.not. film%load > 0.0_wp) then
         call append_text(words, "no film force")
         return
      end if
      call append_text(words, "stiffness [N/m]   "//entries(film%stiffness, film%error))
      call append_text(words, "damping [N.s/m]   "//entries(film%damping, film%error)//"; error "//real_text(film%error, 1))
      call append_text(words, "rigid rotor: "//rotor_words(film))
   end function film_lines

   !> The entries of a matrix; those within the error of the maximum as zero.
   function entries(matrix, error) result(words)
      real(wp), intent(in) :: matrix(2, 2)   !! (2, 2) the matrix [any]
      real(wp), intent(in) :: error          !! of the maximum entry, as a part of it [1]
      character(:), allocatable :: words     !! as `xx 1.5 xy 2 ...`

      real(wp), parameter :: round_off = 1.0e-12_wp  ! of the maximum entry at least [1]
      real(wp) :: value
      integer :: k

      words = ""
      do k = 1, size(place)
         value = matrix(row(k), column(k))
         if (abs(value) <= max(error, round_off)*maxval(abs(matrix))) value = 0.0_wp
         words = words//"  "//place(k)//" "//real_text(value, n_digit)
      end do
   end function entries

   !> When a rigid rotor whirls.
   function rotor_words(film) result(words)
      type(film_coefficients_t), intent(in) :: film  !! the film
      character(:), allocatable :: words             !! to follow the rotor

      if (.not. ieee_is_finite(film%critical_mass)) then
         words = "no whirl at any mass"
      else if (.not. film%critical_mass > 0.0_wp) then
         words = "whirl at any mass"
      else
         words = "critical mass "//real_text(film%critical_mass, n_digit)//" kg, whirl frequency "// &
                 real_text(film%whirl_frequency/two_pi, n_digit)//" Hz"//ratio_words(film)
      end if
   end function rotor_words

   !> The frequency of a whirl over the speed of the journal.
   function ratio_words(film) result(words)
      type(film_coefficients_t), intent(in) :: film  !! the film
      character(:), allocatable :: words             !! as `, 0.49 of the journal's speed`; blank where that stands

      words = ""
      if (abs(film%journal_speed) > 0.0_wp) words = ", "//real_text(film%whirl_frequency/abs(film%journal_speed), n_digit)// &
                                                    " times the journal speed"
   end function ratio_words

end module linear_text
