!> Unwrapped films in run.h5: a group /film_fields/NAME for each (docs/output.md).
module hdf5_fields
   use film_fields, only: film_field_t, moment_end, moment_min
   use hdf5, only: h5gclose_f, hid_t
   use hdf5_attributes, only: real_attribute, text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: real_dataset
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: bytes_of_fields, write_fields

   integer(i8), parameter :: bytes_of_group = 8192_i8  !! that a group takes beside its numbers

contains

   !> Bytes that films take in the file.
   pure integer(i8) function bytes_of_fields(fields) result(bytes)
      type(film_field_t), intent(in) :: fields(:)  !! (any) films

      integer :: k

      bytes = 0
      do k = 1, size(fields)
         bytes = bytes + bytes_of_group + 8_i8*(2*size(fields(k)%pressure) + size(fields(k)%theta) + size(fields(k)%y))
      end do
   end function bytes_of_fields

   !> Write the groups, if there are any.
   subroutine write_fields(file, fields, status)
      integer(hid_t), intent(in) :: file           !! the file
      type(film_field_t), intent(in) :: fields(:)  !! (any) films
      integer, intent(inout) :: status             !! negative: failed

      integer(hid_t) :: group
      integer :: closed, k

      if (size(fields) == 0) return
      call new_group(file, "film_fields", group, status)
      if (status >= 0) call h5gclose_f(group, closed)
      do k = 1, size(fields)
         call write_field(file, "film_fields/"//fields(k)%request%name, fields(k), status)
      end do
   end subroutine write_fields

   !> One film.
   subroutine write_field(file, path, field, status)
      integer(hid_t), intent(in) :: file         !! the file
      character(*), intent(in) :: path           !! of the group
      type(film_field_t), intent(in) :: field    !! the film
      integer, intent(inout) :: status           !! negative: failed

      integer(hid_t) :: group
      integer :: closed, peak(2)

      call new_group(file, path, group, status)
      if (status < 0) return
      peak = maxloc(field%pressure)
      call text_attribute(group, "joint", field%request%joint, status)
      call text_attribute(group, "film", field%film, status)
      select case (field%request%moment)
      case (moment_end); call text_attribute(group, "moment", "end of the run", status)
      case (moment_min); call text_attribute(group, "moment", "minimum film thickness", status)
      case default; call text_attribute(group, "moment", "time", status)
      end select
      call real_attribute(group, "time", field%t, status)
      call real_attribute(group, "clearance", field%clearance, status)
      call real_attribute(group, "bearing_angle", field%angle, status)
      call real_attribute(group, "eccentricity_ratio", norm2(field%e)/field%clearance, status)
      call real_attribute(group, "eccentricity_angle", atan2(field%e(2), field%e(1)), status)
      call real_attribute(group, "pressure_max", field%pressure(peak(1), peak(2)), status)
      call real_attribute(group, "pressure_max_angle", field%theta(peak(2)), status)
      call real_attribute(group, "gap_min", minval(field%gap), status)
      call h5gclose_f(group, closed)
      associate (m => size(field%y), n => size(field%theta))
         call real_dataset(file, path//"/theta", [n], field%theta, "rad", "angle around the bearing, frame of its body", status)
         call real_dataset(file, path//"/y", [m], field%y, "m", "axial position, from the middle", status)
         call real_dataset(file, path//"/pressure", [m, n], reshape(field%pressure, [m*n]), "Pa", &
                           "film pressure relative to that at the ends", status)
         call real_dataset(file, path//"/gap", [m, n], reshape(field%gap, [m*n]), "m", "film thickness", status)
      end associate
   end subroutine write_field

end module hdf5_fields
