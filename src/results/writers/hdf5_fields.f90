!> Unwrapped films in run.h5: a group /film_fields/NAME for each (docs/reference/output.md).
module hdf5_fields
   use film_fields, only: film_field_t, moment_end, moment_min
   use hdf5, only: hid_t
   use hdf5_datasets, only: real_dataset
   use hdf5_scales, only: add_scale, close_scales, scales_t, take_scales_of_path
   use hdf5_table, only: write_tables
   use kinds, only: i8, wp
   use result_table, only: result_table_t
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

      integer :: k

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

      character(len(path) + 6) :: dimensions(2)
      type(result_table_t) :: table
      type(scales_t) :: scales
      integer :: peak(2)

      peak = maxloc(field%pressure)
      call table%start(field%request%name, path, 0)
      call table%fact("joint", field%request%joint)
      call table%fact("film", field%film)
      select case (field%request%moment)
      case (moment_end); call table%fact("moment", "end of the run")
      case (moment_min); call table%fact("moment", "minimum film thickness")
      case default; call table%fact("moment", "time")
      end select
      call table%fact("time", field%t)
      call table%fact("clearance", field%clearance)
      call table%fact("bearing_angle", field%angle)
      call table%fact("eccentricity_ratio", norm2(field%e)/field%clearance)
      call table%fact("eccentricity_angle", atan2(field%e(2), field%e(1)))
      call table%fact("pressure_max", field%pressure(peak(1), peak(2)))
      call table%fact("pressure_max_angle", field%theta(peak(2)))
      call table%fact("gap_min", minval(field%gap))
      call write_tables(file, [table], status)
      associate (m => size(field%y), n => size(field%theta))
         call real_dataset(file, path//"/theta", [n], field%theta, "rad", "angle around the bearing, frame of its body", status)
         call real_dataset(file, path//"/y", [m], field%y, "m", "axial position, from the middle", status)
         call real_dataset(file, path//"/pressure", [m, n], reshape(field%pressure, [m*n]), "Pa", &
                           "film pressure relative to that at the ends", status)
         call real_dataset(file, path//"/gap", [m, n], reshape(field%gap, [m*n]), "m", "film thickness", status)
      end associate
      dimensions = [character(len(path) + 6) :: path//"/theta", path//"/y"]
      call add_scale(scales, file, dimensions(1), status)
      call add_scale(scales, file, dimensions(2), status)
      call take_scales_of_path(scales, file, path//"/pressure", dimensions, status)
      call take_scales_of_path(scales, file, path//"/gap", dimensions, status)
      call close_scales(scales, file, status)
   end subroutine write_field

end module hdf5_fields
