!> Version of the program.
module version
   implicit none (type, external)
   private
   public :: program_version

   character(*), parameter :: program_version = "0.1.0"  !! of gudgeon

end module version
