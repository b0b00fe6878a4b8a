!> The files that a deck was read from, kept in memory, so that it can be read again exactly as it was.
!>
!> Nothing is kept unless it is asked for. From then on a file is read from the disk once; what it held then is what every later
!> reading gets, in this process and in its copies, whatever becomes of the file. Of a file with a reader of its own that is what
!> the reader takes from it.
module file_store
   use kinds, only: i8
   use system_file, only: read_file
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: changed_files, keep_files, kept_file_t, kept_files, put_files, read_kept, reader_interface

   abstract interface
      !> Read a file, all of it or what matters of it.
      subroutine reader_interface(path, only_regular, most, bytes, message, is_stream)
         import :: i8
         implicit none (type, external)
         character(*), intent(in) :: path                     !! of the file
         logical, intent(in) :: only_regular                  !! whether pipes and devices are refused
         integer(i8), intent(in) :: most                      !! bytes that are read at most
         character(:), allocatable, intent(out) :: bytes      !! what it holds; empty if it cannot be read
         character(:), allocatable, intent(out) :: message    !! empty: success; else why not
         logical, intent(out) :: is_stream                    !! whether it can be read but once
      end subroutine reader_interface
   end interface

   !> A file as it was when it was first read.
   type :: kept_file_t
      character(:), allocatable :: path      !! by which it was asked for
      character(:), allocatable :: bytes     !! what it held
      character(:), allocatable :: message   !! why it could not be read; blank: it was
      logical :: is_stream = .false.         !! it came through a pipe
      procedure(reader_interface), pointer, nopass :: reader => null()   !! what reads it; null: all of it is read
   end type kept_file_t

   logical :: is_keeping = .false.                 !! whether files are kept
   type(kept_file_t), allocatable :: store(:)      !! (n) the files

contains

   !> From now on keep what is read.
   subroutine keep_files()
      is_keeping = .true.
      if (.not. allocated(store)) allocate (store(0))
   end subroutine keep_files

   !> Read everything that a file or stream holds, from memory if it was read before.
   subroutine read_kept(path, only_regular, most, bytes, message, is_stream, reader)
      character(*), intent(in) :: path                     !! of the file
      logical, intent(in) :: only_regular                  !! whether pipes and devices are refused
      integer(i8), intent(in) :: most                      !! bytes that are read at most
      character(:), allocatable, intent(out) :: bytes      !! what it holds; empty if it cannot be read
      character(:), allocatable, intent(out) :: message    !! empty: success; else why not
      logical, intent(out) :: is_stream                    !! whether it can be read but once
      procedure(reader_interface), optional :: reader      !! what reads it; absent: all of it is read

      type(kept_file_t) :: file
      integer :: k

      if (is_keeping) then
         do k = 1, size(store)
            if (store(k)%path /= path) cycle
            bytes = store(k)%bytes
            message = store(k)%message
            is_stream = store(k)%is_stream
            return
         end do
      end if
      if (present(reader)) file%reader => reader
      call read_anew(file, path, only_regular, most, bytes, message, is_stream)
      if (.not. is_keeping) return
      file%path = path
      file%bytes = bytes
      file%message = message
      file%is_stream = is_stream
      store = [store, file]
   end subroutine read_kept

   !> Read a file by its own reader, if it has one.
   subroutine read_anew(file, path, only_regular, most, bytes, message, is_stream)
      type(kept_file_t), intent(in) :: file                !! knows its reader
      character(*), intent(in) :: path                     !! of the file
      logical, intent(in) :: only_regular                  !! whether pipes and devices are refused
      integer(i8), intent(in) :: most                      !! bytes that are read at most
      character(:), allocatable, intent(out) :: bytes      !! what it holds; empty if it cannot be read
      character(:), allocatable, intent(out) :: message    !! empty: success; else why not
      logical, intent(out) :: is_stream                    !! whether it can be read but once

      if (associated(file%reader)) then
         call file%reader(path, only_regular, most, bytes, message, is_stream)
      else
         call read_file(path, only_regular, most, bytes, message, is_stream)
      end if
   end subroutine read_anew

   !> What is kept, in the order in which it was first read.
   function kept_files() result(files)
      type(kept_file_t), allocatable :: files(:)  !! (n) the files

      call keep_files()
      files = store
   end function kept_files

   !> Take files as they were in another process, in place of all that is kept.
   subroutine put_files(files)
      type(kept_file_t), intent(in) :: files(:)  !! (n) the files

      is_keeping = .true.
      store = files
   end subroutine put_files

   !> The files that are not any more what they were.
   function changed_files() result(paths)
      type(text_t), allocatable :: paths(:)  !! (n) their paths

      character(:), allocatable :: bytes, message
      logical :: is_stream
      integer :: k

      allocate (paths(0))
      if (.not. is_keeping) return
      do k = 1, size(store)
         if (store(k)%is_stream) cycle
         call read_anew(store(k), store(k)%path, .true., len(store(k)%bytes, i8) + 1_i8, bytes, message, is_stream)
         if (bytes /= store(k)%bytes .or. len(bytes) /= len(store(k)%bytes) .or. &
             (len(message) > 0 .neqv. len(store(k)%message) > 0)) call append_text(paths, store(k)%path)
      end do
   end function changed_files

end module file_store
