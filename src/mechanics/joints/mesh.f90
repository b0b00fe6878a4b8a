!> Gears whose radii do not fit where their bodies are: words for messages. Their rows ask for the ratio of the radii only, so that
!> such gears turn, but not as wheels of this size would where they are.
module mesh
   use kinds, only: wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: axes_misfit, close_enough, distance_misfit, line_misfit, two_rings

   real(wp), parameter :: close_enough = 1.0e-3_wp  !! difference that is none, of the largest radius [1]
   character(*), parameter :: two_rings = "has two negative radii: one gear of a pair at most is a ring gear"

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
      words = "has radii for axes that are "//real_text(abs(sum(radius)), 4)//" m apart, but they are "//real_text(distance, 4)// &
              " m apart: the gears keep the ratio of their radii and touch where these divide that distance"
   end function distance_misfit

   !> Axes of bevel gears meet.
   function axes_misfit(radius, gap) result(words)
      real(wp), intent(in) :: radius(2)               !! (2) of the gears [m]
      real(wp), intent(in) :: gap                     !! between their axes [m]
      character(:), allocatable :: words              !! what follows the name in a warning; blank: they fit

      words = ""
      if (gap <= close_enough*maxval(abs(radius))) return
      words = "is on axes that are neither parallel nor meet: they pass "//real_text(gap, 4)// &
              " m from each other; the gears keep the ratio of their radii"
   end function axes_misfit

   !> A pinion is beside its rack's pitch line by its radius, to the left if that is positive.
   function line_misfit(radius, left) result(words)
      real(wp), intent(in) :: radius                  !! of the pinion, negative to the right [m]
      real(wp), intent(in) :: left                    !! its centre's distance from the line, negative to the right [m]
      character(:), allocatable :: words              !! what follows the name in a warning; blank: they fit

      words = ""
      if (abs(radius - left) <= close_enough*abs(radius)) return
      words = "has a pinion of radius "//real_text(radius, 4)//" m whose centre is "//real_text(left, 4)// &
              " m to the left of the pitch line (negative: to the right): it rolls as the radius says"
   end function line_misfit

end module mesh
