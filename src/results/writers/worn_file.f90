!> The worn surfaces that a run left in its run.h5, as `run_profiles` takes them: a line for each cell.
!>
!> A file that carries a checksum is looked at first; any other is read in a copy of this process before, which a damaged file may
!> end.
module worn_file
   use checksum, only: seal_none, seal_state, seal_wrong, survives
   use hdf5, only: h5fclose_f, hid_t
   use hdf5_calls, only: open_file
   use hdf5_read, only: has_dataset, read_reals, read_texts
   use kinds, only: i8, wp
   use system_file, only: read_file
   use text, only: exact_text, text_t
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: read_worn_file

   character(*), parameter :: group = "wear_profiles"   !! where run.h5 has them

contains

   !> Read the worn surfaces of a run.
   subroutine read_worn_file(path, only_regular, most, bytes, message, is_stream)
      character(*), intent(in) :: path                     !! of the file
      logical, intent(in) :: only_regular                  !! pipes and devices are refused in any case
      integer(i8), intent(in) :: most                      !! any size of the file will do
      character(:), allocatable, intent(out) :: bytes      !! lines `joint side volume`; empty if it cannot be read
      character(:), allocatable, intent(out) :: message    !! empty: success; else why not
      logical, intent(out) :: is_stream                    !! it can be read again

      character(:), allocatable :: start
      integer :: state

      bytes = ""
      is_stream = .false.
      call read_file(path, .true., 0_i8, start, message)
      if (index(message, "too large") == 0) then   ! there is none that can be opened, or it is empty
         if (len(message) == 0) message = "it is empty"
         return
      end if
      message = ""
      state = seal_state(path)
      if (state == seal_none) then
         if (.not. survives(can_be_read, path)) state = seal_wrong
      end if
      if (state == seal_wrong) then
         message = "it is corrupt, was changed after it was written, or is not a file of gudgeon"
      else
         call take_surfaces(path, bytes, message)
      end if
   end subroutine read_worn_file

   !> Whether a file can be read, or refused with words.
   logical function can_be_read(path)
      character(*), intent(in) :: path                     !! of the file

      character(:), allocatable :: bytes, message

      call take_surfaces(path, bytes, message)
      can_be_read = .true.
   end function can_be_read

   !> The lines of a file.
   subroutine take_surfaces(path, bytes, message)
      character(*), intent(in) :: path                     !! of the file
      character(:), allocatable, intent(out) :: bytes      !! lines `joint side volume`
      character(:), allocatable, intent(out) :: message    !! empty: success; else why not

      type(buffer_t) :: lines
      type(text_t), allocatable :: joints(:), sides(:)
      real(wp), allocatable :: volumes(:)
      integer(hid_t) :: file
      integer :: closed, k, status

      bytes = ""
      message = ""
      status = 0
      call open_file(path, file, status)
      if (file < 0) then
         message = "it is not an HDF5 file"
         return
      end if
      if (has_dataset(file, group, "volume")) then
         call read_texts(file, group//"/joint", joints, status)
         call read_texts(file, group//"/surface", sides, status)
         call read_reals(file, group//"/volume", volumes, status)
         if (status < 0) message = "its worn surfaces cannot be read"
      else
         message = "it has no worn surfaces: no joint of that run has a wear law"
      end if
      call h5fclose_f(file, closed)
      if (len(message) > 0) return
      do k = 1, size(volumes)
         call lines%line(joints(k)%s//" "//sides(k)%s//" "//exact_text(volumes(k)))
      end do
      bytes = lines%get()
   end subroutine take_surfaces

end module worn_file
