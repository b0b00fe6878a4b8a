!> The contract of wear laws: the volume that two surfaces lose by sliding.
!>
!> dV = kappa dw   of each surface, with the driving work w of a contact: F_N |v_T| dt, or what friction takes (`by_friction`)
!> kappa(s) = k + (k_0 - k) exp(-s/s_0)   running-in over the distance s that the contact has slid; k without running-in
!>
!> Where the pressure stays below a threshold nothing wears (`worn_part`). The pressure of a pin in a hole is that of an arc whose
!> resultant is F_N: p = p_m cos(theta), p_m = F_N/(L R (b + sin b cos b)), b the half angle of the arc at its centre.
!>
!> Signs: volumes are removed material, not negative. Source: J. F. Archard, J. Appl. Phys. 24 (1953) 981; M. Godet, Wear 100 (1984)
!> 437 for the arc. Limits: one coefficient for each surface; debris leaves the contact.
module wear_law
   use item, only: item_t
   use kind_info, only: add_number, dim_length, dim_none, dim_pressure, dim_t, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: add_wear_columns, n_side, of_bearing, of_journal, side_names, wear_law_t, wear_prepare, wear_slot_t

   integer, parameter :: of_bearing = 1   !! the surface of i
   integer, parameter :: of_journal = 2   !! the surface of j
   integer, parameter :: n_side = 2       !! surfaces of a contact
   character(*), parameter :: side_names(n_side) = ["bearing", "journal"]   !! what they are called

   type(dim_t), parameter :: dim_wear = dim_t(kg=-1, m=1, s=2)   !! of k: volume over force and distance, as m^2/N

   !> One row of a table of wear laws.
   type, abstract :: wear_law_t
      character(:), allocatable :: name                 !! name of the row
      logical :: by_friction = .false.                  !! the driving work is what friction takes, not F_N |v_T|
      real(wp) :: coefficient(n_side) = 0.0_wp          !! (2) k of bearing and journal, run in [m^2/N]
      real(wp) :: first_coefficient(n_side) = 0.0_wp    !! (2) k_0, of new surfaces [m^2/N]
      real(wp) :: running_in = 0.0_wp                   !! s_0; 0: none [m]
      real(wp) :: threshold = 0.0_wp                    !! pressure below which nothing wears [Pa]
      real(wp) :: spread = 1.0_wp                       !! factor of k that bounds its 95 % range, up and down; 1: k is known [1]
      real(wp) :: cells = 0.0_wp                        !! cells of each circumference, a whole number [1]
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure :: prepare => wear_prepare
      procedure :: mistake => wear_mistake
      procedure :: coefficients => wear_coefficients
      procedure :: worn_part => wear_worn_part
      procedure :: worn_points => wear_worn_points
   end type wear_law_t

   !> A place for a wear law of any kind.
   type :: wear_slot_t
      class(wear_law_t), allocatable :: law  !! the law
   end type wear_slot_t

   abstract interface
      !> Description of the kind.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name and columns
      end function info_interface
   end interface

contains

   !> Columns of every wear law.
   subroutine add_wear_columns(info, over)
      type(kind_info_t), intent(inout) :: info  !! the kind
      character(*), intent(in) :: over          !! what the volume is divided by

      call add_number(info, "bearing", dim_wear, "wear coefficient of the surface of i: worn volume over "//over// &
                      "; 0: it does not wear", lower=0.0_wp)
      call add_number(info, "journal", dim_wear, "the same of the surface of j", lower=0.0_wp)
      call add_number(info, "threshold", dim_pressure, "pressure of the contact below which nothing wears", &
                      default="0 Pa", lower=0.0_wp)
      call add_number(info, "running_in", dim_length, "sliding distance over which the surfaces run in: the coefficient goes as " &
                      //"exp(-s/running_in) from its first value to its last; 0: they are run in", default="0 m", lower=0.0_wp)
      call add_number(info, "bearing_first", dim_wear, "wear coefficient of the surface of i where it is new; read "// &
                      "with running_in", default="0 m^2/N", lower=0.0_wp)
      call add_number(info, "journal_first", dim_wear, "the same of the surface of j", default="0 m^2/N", lower=0.0_wp)
      call add_number(info, "spread", dim_none, "uncertainty of the wear coefficients, for `gudgeon life`: they lie between " &
                      //"k/spread and k spread with a probability of 95 %, as a lognormal number; both surfaces together", &
                      default="1", lower=1.0_wp, upper=1000.0_wp)
      call add_number(info, "cells", dim_none, "cells of each circumference, whose worn volumes are kept", default="360", &
                      lower=8.0_wp, upper=36000.0_wp)
   end subroutine add_wear_columns

   !> Take the parameters from a row of the kind's table.
   subroutine wear_prepare(self, item)
      class(wear_law_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item          !! the row

      self%name = item%name
      self%coefficient = [item%number("bearing"), item%number("journal")]
      self%first_coefficient = [item%number("bearing_first"), item%number("journal_first")]
      self%running_in = item%number("running_in")
      self%threshold = item%number("threshold")
      self%spread = item%number("spread")
      self%cells = item%number("cells")
   end subroutine wear_prepare

   !> First coefficients belong to surfaces that run in; cells are counted.
   function wear_mistake(self) result(message)
      class(wear_law_t), intent(in) :: self   !! the law
      character(:), allocatable :: message    !! one line, empty: all is well

      message = ""
      if (any(self%first_coefficient > 0.0_wp) .and. .not. self%running_in > 0.0_wp) then
         message = "bearing_first and journal_first need running_in, the distance over which they apply"
      else if (abs(self%cells - anint(self%cells)) > 0.0_wp) then
         message = "cells is not a whole number"
      end if
   end function wear_mistake

   !> Worn volume over driving work of both surfaces.
   pure function wear_coefficients(self, distance) result(kappa)
      class(wear_law_t), intent(in) :: self   !! the law
      real(wp), intent(in) :: distance        !! s, what the contact has slid so far [m]
      real(wp) :: kappa(n_side)               !! (2) of bearing and journal [m^2/N]

      kappa = self%coefficient
      if (.not. self%running_in > 0.0_wp) return
      kappa = kappa + (self%first_coefficient - self%coefficient)*exp(-distance/self%running_in)
   end function wear_coefficients

   !> Part of an arc in which the pressure exceeds the threshold: the angle up to which it does, and its part of the force.
   pure subroutine wear_worn_part(self, force, area, half_angle, worn_angle, part)
      class(wear_law_t), intent(in) :: self     !! the law
      real(wp), intent(in) :: force             !! F_N [N]
      real(wp), intent(in) :: area              !! radius times length; read with a threshold [m^2]
      real(wp), intent(in) :: half_angle        !! b of the arc [rad]
      real(wp), intent(out) :: worn_angle       !! up to which it wears; 0: nowhere [rad]
      real(wp), intent(out) :: part             !! of the driving work that wears, 0 to 1 [1]

      real(wp) :: maximum

      worn_angle = half_angle
      part = 1.0_wp
      if (.not. self%threshold > 0.0_wp) return
      maximum = force/(area*(half_angle + sin(half_angle)*cos(half_angle)))
      worn_angle = 0.0_wp
      part = 0.0_wp
      if (.not. maximum > self%threshold) return
      worn_angle = min(acos(self%threshold/maximum), half_angle)
      part = sin(worn_angle)/sin(half_angle)
   end subroutine wear_worn_part

   !> The same of an arc that is given by points, with the pressure p = F_N d/(R L int d cos(theta - phi) dtheta): points below the
   !> threshold lose their overlap.
   pure subroutine wear_worn_points(self, force, area, angle, middle, width, d, part)
      class(wear_law_t), intent(in) :: self     !! the law
      real(wp), intent(in) :: force             !! F_N [N]
      real(wp), intent(in) :: area              !! radius times length; read with a threshold [m^2]
      real(wp), intent(in) :: angle(:)          !! (points) where they are [rad]
      real(wp), intent(in) :: middle            !! phi, direction of the force [rad]
      real(wp), intent(in) :: width(:)          !! (points) angles that they stand for [rad]
      real(wp), intent(inout) :: d(:)           !! (points) overlap, to which the pressure is proportional [m]
      real(wp), intent(out) :: part             !! of the driving work that wears, 0 to 1 [1]

      real(wp) :: whole

      whole = sum(d*width)
      part = merge(1.0_wp, 0.0_wp, whole > 0.0_wp)
      if (.not. (self%threshold > 0.0_wp .and. whole > 0.0_wp)) return
      where (.not. force*d > self%threshold*(area*sum(d*width*cos(angle - middle)))) d = 0.0_wp
      part = sum(d*width)/whole
   end subroutine wear_worn_points

end module wear_law
