!> Version of the program.
module version
   implicit none (type, external)
   private
   public :: program_date, program_version

   character(*), parameter :: program_version = "1.0.0"     !! of gudgeon
   character(*), parameter :: program_date = "2026-11-29"   !! of this version

end module version
