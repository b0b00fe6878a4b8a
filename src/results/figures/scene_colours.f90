!> Colours of a drawn mechanism: red, green and blue in one number.
module scene_colours
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: body_colour, dark, grey, red

   integer, parameter :: dark = 4210752   !! of symbols, #404040
   integer, parameter :: grey = 7368816   !! of names of points, #707070
   integer, parameter :: red = 13715803   !! of forces, #d1495b

contains

   !> Colour of a body, the ground's grey; paler: nearer to white.
   pure integer function body_colour(body, paleness) result(colour)
      integer, intent(in) :: body          !! the body, 0: ground
      real(wp), intent(in) :: paleness     !! 0: as it is, 1: white [1]

      integer, parameter :: reds(8) = [31, 46, 123, 201, 23, 140, 90, 60]
      integer, parameter :: greens(8) = [111, 139, 79, 138, 162, 86, 110, 60]
      integer, parameter :: blues(8) = [180, 87, 163, 0, 184, 75, 30, 120]
      integer :: k, parts(3)

      k = modulo(body - 1, 8) + 1
      parts = [reds(k), greens(k), blues(k)]
      if (body == 0) parts = 112
      parts = nint(255.0_wp - (255.0_wp - real(parts, wp))*(1.0_wp - paleness))
      colour = 65536*parts(1) + 256*parts(2) + parts(3)
   end function body_colour

end module scene_colours
