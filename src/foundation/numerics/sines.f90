!> Sine and cosine of an angle together, for those who call it: loops that must not call include its text.
module sines
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: sine_cosine

contains

   include "sine_cosine.inc"

end module sines
