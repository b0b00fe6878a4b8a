!> The processor of this machine, as the system names it.
module processor
   use posix, only: host_name
   implicit none (type, external)
   private
   public :: processor_name

   character(*), parameter :: list = "/proc/cpuinfo"     !! where Linux reports it
   character(*), parameter :: key = "model name"         !! before the name

contains

   !> Its name; where the system has no such list, or no name in it, that of the machine.
   function processor_name() result(name)
      character(:), allocatable :: name  !! one line

      character(256) :: line
      integer :: status, unit

      name = host_name()
      open (newunit=unit, file=list, status="old", action="read", iostat=status)
      if (status /= 0) return
      do
         read (unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (index(line, key) /= 1) cycle
         name = trim(adjustl(line(index(line, ":") + 1:)))
         exit
      end do
      close (unit)
   end function processor_name

end module processor
