!> Films at a steady state and small motions about it, as a table: facts of the mechanism, and a row for each film.
module films_table
   use linearised, only: linearised_t
   use result_table, only: in_text_files, result_table_t
   use table_list, only: list_of
   use text, only: text_t
   implicit none (type, external)
   private
   public :: tables_of_films

   character(*), parameter :: places(4) = ["xx", "xy", "yx", "yy"]  !! of the entries of a matrix, row by row

contains

   !> All that is known of films at a steady state, and of small motions about it.
   function tables_of_films(linear) result(tables)
      type(linearised_t), intent(in) :: linear           !! what is known
      type(result_table_t), allocatable :: tables(:)     !! none if no film was linearised

      allocate (tables(0))
      if (.not. allocated(linear%films)) return
      tables = list_of(table_of_films(linear), table_of_eigenvalues(linear), table_of_onset(linear))
   end function tables_of_films

   !> The films.
   function table_of_films(linear) result(table)
      type(linearised_t), intent(in) :: linear     !! what is known, its films allocated
      type(result_table_t) :: table                !! a row for each film

      type(text_t), allocatable :: names(:)
      integer :: k, n

      n = size(linear%films)
      allocate (names(n))
      do k = 1, n
         names(k)%s = linear%films(k)%joint
      end do
      call table%start("films", "films", n)
      associate (films => linear%films)
         call table%put("joint", "1", "joint of each film", texts=names, dataset="names")
         call table%put("eccentricity_ratio", "1", "eccentricity ratio", films%eccentricity_ratio)
         call table%put("attitude", "rad", "attitude angle: from the load to the journal centre, in the direction of "// &
            "entrainment", films%attitude)
         call table%put("load", "N", "magnitude of the film force", films%load)
         call table%put("journal_speed", "rad/s", "absolute angular speed of the journal body", films%journal_speed)
         call table%put("heated", "1", "the temperature follows from the heat balance", logicals=films%is_heated, &
                        formats=in_text_files)
         call table%put("temperature", "K", "of the film; undefined for a lubricant without a grade", films%temperature)
         call table%put("viscosity", "Pa.s", "dynamic viscosity of the film", films%viscosity)
         call table%put("stiffness", "N/m", "negative derivative of the film force by the eccentricity, world frame", &
                        [(transpose(films(k)%stiffness), k=1, n)], shape=[2, 2], parts=names_of("stiffness_", places))
         call table%put("damping", "N.s/m", "negative derivative of the film force by the rate of the eccentricity, world "// &
            "frame", [(transpose(films(k)%damping), k=1, n)], shape=[2, 2], parts=names_of("damping_", places))
         call table%put("error", "1", "error of stiffness and damping, relative to the maximum entry", films%error)
         call table%put("equivalent_stiffness", "N/m", "critical mass of a rigid rotor, at the onset of whirl", &
                        films%equivalent_stiffness)
         call table%put("whirl_frequency", "rad/s", "whirl frequency of that rotor; NaN: no whirl", films%whirl_frequency)
         call table%put("critical_mass", "kg", "stability limit of the rotor mass: whirl above it; NaN: no whirl", &
                        films%critical_mass)
      end associate
   end function table_of_films

   !> Names of the parts of a value.
   pure function names_of(start, ends) result(names)
      character(*), intent(in) :: start          !! what all begin with
      character(*), intent(in) :: ends(:)        !! (n) what each ends with
      type(text_t) :: names(size(ends))          !! (n) as `stiffness_xy`

      integer :: k

      do k = 1, size(names)
         names(k)%s = start//trim(ends(k))
      end do
   end function names_of

   !> Whether the motion is stable, and the eigenvalues if that is known.
   function table_of_eigenvalues(linear) result(table)
      type(linearised_t), intent(in) :: linear     !! what is known
      type(result_table_t) :: table                !! a row for each eigenvalue

      call table%start("eigenvalues", "films", 0, "small_motions")
      call table%fact("judged", linear%is_judged)
      if (.not. linear%is_judged) return
      associate (values => linear%eigenvalues)
         table%n = size(values, 2)
         call table%put("eigenvalues", "1/s", "eigenvalues of the mechanism: real and imaginary parts, fastest growth first", &
                        reshape(values, [size(values)]), shape=[2], &
                        parts=names_of("", [character(9) :: "growth", "frequency"]))
      end associate
   end function table_of_eigenvalues

   !> The speed at which whirl sets in.
   function table_of_onset(linear) result(table)
      type(linearised_t), intent(in) :: linear     !! what is known
      type(result_table_t) :: table                !! facts only

      call table%start("onset", "films", 0, "small_motions")
      if (.not. linear%is_searched) return
      call table%fact("onset_text", linear%onset_words)
      call table%fact("onset", linear%onset)
      call table%fact("onset_frequency", linear%onset_frequency)
      call table%fact("searched_to", linear%searched_to)
   end function table_of_onset

end module films_table
