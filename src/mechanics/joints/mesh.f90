!> Gears whose radii do not fit where their bodies are: words for messages. Their rows ask for the ratio of the radii only, so that
!> such gears turn, but not as wheels of this size would where they are.
module mesh
   use kinds, only: wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: axes_misfit, close_enough, distance_misfit, line_misfit, pulley_overlap, two_rings

   real(wp), parameter :: close_enough = 1.0e-3_wp  !! difference that is none, of the largest radius [1]
   character(*), parameter :: two_rings = "has two negative radii: at most one gear of a pair is a ring gear"

contains

   !> The centres of gears on parallel axes are as far apart as the sum of the radii; where they coincide there is no line between
   !> them, and the gears couple two turns about one axis.
   function distance_misfit(radius, distance) result(words)
      real(wp), intent(in) :: radius(2)               !! (2) of the gears, that of a ring gear negative [m]
      real(wp), intent(in) :: distance                !! of their axes [m]
      character(:), allocatable :: words              !! what follows the name in a warning; blank: they fit

      words = ""
      if (distance <= close_enough*maxval(abs(radius))) return
      if (abs(abs(sum(radius)) - distance) <= close_enough*maxval(abs(radius))) return
      words = "has radii whose sum needs an axis distance of "//real_text(abs(sum(radius)), 4)//" m, but the distance is "// &
              real_text(distance, 4)//" m: the gears keep their ratio and touch where that ratio divides the distance"
   end function distance_misfit

   !> Pulleys of a belt are beside each other.
   function pulley_overlap(radius, distance) result(words)
      real(wp), intent(in) :: radius(2)               !! (2) of the pulleys, any sign [m]
      real(wp), intent(in) :: distance                !! of their axes [m]
      character(:), allocatable :: words              !! what follows the name in a warning; blank: they fit

      words = ""
      if (distance >= sum(abs(radius))*(1.0_wp - close_enough)) return
      words = "has pulleys that overlap: the sum of their radii is "//real_text(sum(abs(radius)), 4)//" m, the distance of their &
              &centres "//real_text(distance, 4)//" m; the belt keeps its ratio"
   end function pulley_overlap

   !> Axes of bevel gears meet.
   function axes_misfit(radius, gap) result(words)
      real(wp), intent(in) :: radius(2)               !! (2) of the gears [m]
      real(wp), intent(in) :: gap                     !! between their axes [m]
      character(:), allocatable :: words              !! what follows the name in a warning; blank: they fit

      words = ""
      if (gap <= close_enough*maxval(abs(radius))) return
      words = "has skew axes, "//real_text(gap, 4)//" m apart: the gears keep their ratio"
   end function axes_misfit

   !> A pinion is beside its rack's pitch line by its radius, to the left if that is positive.
   function line_misfit(radius, left) result(words)
      real(wp), intent(in) :: radius                  !! of the pinion, negative to the right [m]
      real(wp), intent(in) :: left                    !! its centre's distance from the line, negative to the right [m]
      character(:), allocatable :: words              !! what follows the name in a warning; blank: they fit

      words = ""
      if (abs(radius - left) <= close_enough*abs(radius)) return
      words = "has a pinion of radius "//real_text(radius, 4)//" m, but its centre is "//real_text(left, 4)// &
              " m to the left of the pitch line (negative: to the right): rolling uses the given radius"
   end function line_misfit

end module mesh
