!> Films at a steady state and small motions about it in an HDF5 file: the group `films` of a static analysis.
module films_group
   use hdf5, only: h5gclose_f, hid_t
   use hdf5_attributes, only: long_attribute, real_attribute, text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: real_dataset, text_dataset
   use kinds, only: i8, wp
   use linearised, only: linearised_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: write_films

contains

   !> Write the group; nothing if no film was linearised.
   subroutine write_films(file, linear, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(linearised_t), intent(in) :: linear    !! what is known
      integer, intent(inout) :: status            !! negative: failed

      type(text_t), allocatable :: names(:)
      integer(hid_t) :: group
      integer :: closed, k, n

      if (.not. allocated(linear%films)) return
      call new_group(file, "films", group, status)
      if (status < 0) return
      call long_attribute(group, "judged", int(merge(1, 0, linear%is_judged), i8), status)
      if (linear%is_searched) then
         call text_attribute(group, "onset_text", linear%onset_words, status)
         call real_attribute(group, "onset", linear%onset, status)
         call real_attribute(group, "onset_frequency", linear%onset_frequency, status)
         call real_attribute(group, "searched_to", linear%searched_to, status)
      end if
      call h5gclose_f(group, closed)
      associate (films => linear%films)
         n = size(films)
         allocate (names(n))
         do k = 1, n
            names(k)%s = films(k)%joint
         end do
         call text_dataset(file, "films/names", names, .false., "joint of each film", status)
         call put("eccentricity_ratio", films%eccentricity_ratio, "1", "eccentricity ratio")
         call put("attitude", films%attitude, "rad", "attitude angle: from the load to the journal centre, in the direction of "// &
            "entrainment")
         call put("load", films%load, "N", "magnitude of the film force")
         call put("journal_speed", films%journal_speed, "rad/s", "absolute angular speed of the journal body")
         call put("temperature", films%temperature, "K", "of the film; undefined for a lubricant without a grade")
         call put("viscosity", films%viscosity, "Pa.s", "dynamic viscosity of the film")
         call put("error", films%error, "1", "error of stiffness and damping, relative to the maximum entry")
         call put("equivalent_stiffness", films%equivalent_stiffness, "N/m", "critical mass of a rigid rotor, at the onset of "// &
            "whirl")
         call put("whirl_frequency", films%whirl_frequency, "rad/s", "whirl frequency of that rotor; NaN: no whirl")
         call put("critical_mass", films%critical_mass, "kg", "stability limit of the rotor mass: whirl above it; NaN: no whirl")
         call real_dataset(file, "films/stiffness", [2, 2, n], [(transpose(films(k)%stiffness), k=1, n)], "N/m", &
                           "negative derivative of the film force by the eccentricity, world frame", status)
         call real_dataset(file, "films/damping", [2, 2, n], [(transpose(films(k)%damping), k=1, n)], "N.s/m", &
                           "negative derivative of the film force by the rate of the eccentricity, world frame", status)
      end associate
      if (.not. linear%is_judged) return
      associate (values => linear%eigenvalues)
         call real_dataset(file, "films/eigenvalues", shape(values), reshape(values, [size(values)]), "1/s", &
                           "eigenvalues of the mechanism: real and imaginary parts, fastest growth first", status)
      end associate

   contains

      !> A number of each film.
      subroutine put(name, values, units, long_name)
         character(*), intent(in) :: name         !! of the dataset
         real(wp), intent(in) :: values(:)        !! (n) the numbers [any]
         character(*), intent(in) :: units        !! SI unit
         character(*), intent(in) :: long_name    !! what they are

         call real_dataset(file, "films/"//name, [size(values)], values, units, long_name, status)
      end subroutine put

   end subroutine write_films

end module films_group
