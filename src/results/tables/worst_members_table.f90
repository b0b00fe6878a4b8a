!> The members with the lowest and the highest value of each channel of a study of tolerances, as a table.
!>
!> Parts of a member are its parameters, then x and y of each pin. The share of a parameter with deviation d and limits a and b is
!> $$ \frac{2 d - a - b}{b - a} , $$
!> -1 and 1 at the limits; that of a pin is its displacement over its nominal clearance.
module worst_members_table
   use dimension_text, only: unit_text
   use kinds, only: i8, not_a_number, wp
   use result_table, only: in_csv, in_hdf5, result_table_t
   use text, only: append_text, join, text_t
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: table_of_worst

   integer, parameter :: most_shown = 12   !! parts that people see in a row

contains

   !> The table.
   function table_of_worst(study) result(table)
      type(tolerance_study_t), intent(in) :: study   !! the study
      type(result_table_t) :: table                  !! two rows for each channel, the lowest first

      type(text_t), allocatable :: channels(:), names(:), units(:)
      integer(i8), allocatable :: numbers(:)
      character(:), allocatable :: heading
      real(wp), allocatable :: deviations(:, :), shares(:, :), values(:)
      integer :: i, m, r

      call find_parts(study, names, units)
      m = 2*size(study%requests)
      allocate (channels(m), numbers(m), table%units(m), values(m), deviations(size(names), m), shares(size(names), m))
      values = not_a_number()
      do m = 1, size(channels)
         r = (m + 1)/2
         i = 2 - modulo(m, 2)
         channels(m)%s = study%requests(r)%name
         table%units(m)%s = study%requests(r)%unit
         numbers(m) = study%members%worst(i, r)%number
         if (numbers(m) > 0_i8) values(m) = study%members%worst(i, r)%value
         deviations(:, m) = [study%members%worst_deviations(:, i, r), study%members%worst_pins(:, :, i, r)]
         shares(:, m) = shares_of(study, deviations(:, m))
      end do
      if (size(names) <= most_shown) heading = "of its tolerance"
      call table%start("worst", "tolerance_worst", size(channels), title="Members with the lowest and the highest value", &
                       elsewhere="tolerance.h5")
      call table%fact("parts", join(names, " "), formats=in_hdf5)
      call table%put("request", "1", "channel", texts=channels, heading="channel", formats=in_csv + in_hdf5)
      call table%put("member", "1", "number of the member; 0: none has a value", counts=numbers, heading="member", &
                     formats=in_csv + in_hdf5)
      call table%put("value", "rows", "its value; NaN: none has one", values, heading="value", digits=6, formats=in_csv + in_hdf5)
      call table%put("deviation", join(units, " "), "deviations of the parameters, displacements of the pins; NaN: there is no "// &
                     "member", [deviations], shape=[size(names)], parts=names, formats=in_hdf5)
      call table%put("share", "1", "these, from the middle of the tolerance in half its width, pins in nominal clearances; "// &
                     "NaN: no width", [shares], shape=[size(names)], parts=names, heading=heading, digits=3, formats=in_hdf5)
      if (allocated(heading)) call append_text(table%notes, "parameters: -1 to 1 between the limits of their tolerances; "// &
                                               "pins: displacement in clearances")
   end function table_of_worst

   !> Names and units of the parts of a member.
   subroutine find_parts(study, names, units)
      type(tolerance_study_t), intent(in) :: study        !! parameters and pins
      type(text_t), allocatable, intent(out) :: names(:)  !! (parts) names
      type(text_t), allocatable, intent(out) :: units(:)  !! (parts) SI units

      integer :: k

      allocate (names(0), units(0))
      do k = 1, size(study%plan%parameters)
         call append_text(names, study%plan%parameters(k)%name)
         call append_text(units, unit_text(study%plan%parameters(k)%dimension))
      end do
      do k = 1, size(study%pins)
         call append_text(names, study%pins(k)%joint//".x")
         call append_text(names, study%pins(k)%joint//".y")
         call append_text(units, "m")
         call append_text(units, "m")
      end do
   end subroutine find_parts

   !> Where the parts of a member stand in their tolerances.
   pure function shares_of(study, deviations) result(shares)
      type(tolerance_study_t), intent(in) :: study   !! parameters and pins
      real(wp), intent(in) :: deviations(:)          !! (parts) deviations and displacements [any]
      real(wp) :: shares(size(deviations))           !! (parts) shares; NaN: no width [1]

      integer :: k, n

      n = size(study%plan%parameters)
      shares = not_a_number()
      do k = 1, n
         associate (lower => study%plan%parameters(k)%lower, upper => study%plan%parameters(k)%upper)
            if (upper > lower) shares(k) = (2.0_wp*deviations(k) - lower - upper)/(upper - lower)
         end associate
      end do
      do k = 1, size(study%pins)
         associate (place => n + 2*k - 1, c => study%pins(k)%clearance)
            if (c > 0.0_wp) shares(place:place + 1) = deviations(place:place + 1)/c
         end associate
      end do
   end function shares_of

end module worst_members_table
