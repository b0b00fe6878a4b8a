!> The results of a study of periodic orbits as tables: onsets of the orbit, multipliers, branch, bifurcations.
module orbit_tables
   use kinds, only: not_a_number, wp
   use orbit_results, only: bifurcation_names, orbit_study_t, orbit_t
   use result_table, only: in_csv, in_hdf5, result_table_t
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: first_speed, table_of_bifurcations, table_of_branch, table_of_multipliers, table_of_onsets

contains

   !> A row for each onset of the orbit.
   function table_of_onsets(study, names) result(table)
      type(orbit_study_t), intent(in) :: study    !! the study
      type(text_t), intent(in) :: names(:)        !! (contacts) their names
      type(result_table_t) :: table               !! onsets

      type(text_t), allocatable :: contacts(:)
      integer :: k

      associate (orbit => study%orbit)
         allocate (contacts(size(orbit%onset)))
         do k = 1, size(contacts)
            contacts(k)%s = names(orbit%contact(k))%s
         end do
         call table%start("orbit_onsets", "orbit_onsets", size(contacts), title="Onsets of the orbit")
         call table%put("contact", "1", "joint, or joint and contact", texts=contacts, heading="contact")
         call table%put("time", "s", "from the start of the period", orbit%onset, heading="time", digits=10)
         call table%put("impact_speed", "m/s", "normal approach speed", orbit%speed, heading="impact speed", digits=10)
      end associate
   end function table_of_onsets

   !> A row for each multiplier of the orbit.
   function table_of_multipliers(study) result(table)
      type(orbit_study_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! multipliers

      associate (mu => study%orbit%multipliers)
         call table%start("orbit_multipliers", "orbit_multipliers", size(mu), title="Floquet multipliers")
         call table%put("re", "1", "real part", mu%re, heading="real part", digits=9)
         call table%put("im", "1", "imaginary part", mu%im, heading="imaginary part", digits=9)
         call table%put("modulus", "1", "modulus; more than 1: unstable", abs(mu), heading="modulus", digits=9)
      end associate
   end function table_of_multipliers

   !> A row for each orbit of the branch.
   function table_of_branch(study) result(table)
      type(orbit_study_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! the branch

      type(text_t), allocatable :: parts(:)
      real(wp), allocatable :: mu(:, :), z(:, :)
      integer :: k, m, n

      n = size(study%branch%orbits)
      m = study%n_free
      allocate (mu(2*m, n), z(m, n))
      do k = 1, n
         mu(1::2, k) = study%branch%orbits(k)%multipliers%re
         mu(2::2, k) = study%branch%orbits(k)%multipliers%im
         z(:, k) = study%branch%orbits(k)%z*study%scale
      end do
      associate (orbits => study%branch%orbits)
         call table%start("branch", "branch", n)
         call table%put("parameter", "list", "value of the parameter", orbits%p)
         table%units = repeated(study%plan%unit, n)
         call table%put("period", "s", "of the orbit", orbits%period)
         call table%put("phase", "rad", "of the drivers at the first onset of the contact asked for; NaN: none", orbits%phase)
         call table%put("impact_speed", "m/s", "of this onset, or of the first one if no contact is asked for; NaN: none", &
                        [(first_speed(study, orbits(k)), k=1, n)])
         call table%put("onsets", "1", "number of onsets in a period", integers=[(size(orbits(k)%onset), k=1, n)])
         call table%put("stable", "1", "no multiplier has a modulus of more than 1", logicals=orbits%is_stable)
         call table%put("modulus", "1", "maximum of the multipliers", [(maxval(abs(orbits(k)%multipliers)), k=1, n)])
         if (m == 0) return
         allocate (parts(m))
         do k = 1, m
            parts(k)%s = to_text(k)
         end do
         call table%put("start", "1", "free components of the state at the start, SI", [z], shape=[m], parts=parts)
         deallocate (parts)
         allocate (parts(2*m))
         do k = 1, 2*m
            parts(k)%s = to_text((k + 1)/2)//merge(".re", ".im", mod(k, 2) == 1)
         end do
         call table%put("multiplier", "1", "multipliers by descending modulus", [mu], shape=[2*m], parts=parts)
      end associate
   end function table_of_branch

   !> One text for each row.
   pure function repeated(text, n) result(texts)
      character(*), intent(in) :: text            !! the text
      integer, intent(in) :: n                    !! rows
      type(text_t) :: texts(n)                    !! (n) all alike

      integer :: k

      do k = 1, n
         texts(k)%s = text
      end do
   end function repeated

   !> Impact speed of the onset that has the phase.
   pure real(wp) function first_speed(study, orbit) result(speed)
      type(orbit_study_t), intent(in) :: study    !! the study, for the contact
      type(orbit_t), intent(in) :: orbit          !! the orbit

      integer :: k

      speed = not_a_number()
      do k = 1, size(orbit%onset)
         if (study%plan%first > 0) then
            if (orbit%contact(k) < study%plan%first .or. orbit%contact(k) > study%plan%last) cycle
         end if
         speed = orbit%speed(k)
         return
      end do
   end function first_speed

   !> A row for each bifurcation.
   function table_of_bifurcations(study) result(table)
      type(orbit_study_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! bifurcations

      type(text_t), allocatable :: names(:)
      integer :: k

      associate (some => study%branch%bifurcations)
         allocate (names(size(some)))
         do k = 1, size(some)
            names(k)%s = trim(bifurcation_names(some(k)%kind))
         end do
         call table%start("bifurcations", "bifurcations", size(some), title="Bifurcations")
         call table%put("type", "1", "fold, period_doubling, neimark_sacker, symmetry_breaking or grazing", texts=names, &
                        heading="type", formats=in_hdf5 + in_csv)
         call table%put("parameter", "list", "value of the parameter", [(some(k)%orbit%p, k=1, size(some))], &
                        heading=study%plan%parameter, digits=10, formats=in_hdf5 + in_csv)
         table%units = repeated(study%plan%unit, size(some))
         call table%put("phase", "rad", "as of the branch", [(some(k)%orbit%phase, k=1, size(some))], heading="phase", &
                        digits=10, formats=in_hdf5 + in_csv)
      end associate
   end function table_of_bifurcations

end module orbit_tables
