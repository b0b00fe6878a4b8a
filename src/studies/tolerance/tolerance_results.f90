!> What a study of tolerances finds.
module tolerance_results
   use kinds, only: i8, wp
   use text, only: text_t
   use tolerance_plan, only: tolerance_plan_t
   use variance_split, only: split_t
   use varied_mechanism, only: instant_t
   implicit none (type, external)
   private
   public :: allocation_t, found_pin_t, indices_t, members_t, request_t, sensitivities_t, tolerance_study_t, worst_t, yield_t

   !> A channel that is studied.
   type :: request_t
      character(:), allocatable :: name    !! as slider.position.x
      character(:), allocatable :: unit    !! SI unit, `1` if none
      integer :: at(3) = 0                 !! (3) group, component and item in the catalogue
      real(wp) :: lower = -huge(1.0_wp)    !! lower limit [any]
      real(wp) :: upper = huge(1.0_wp)     !! upper limit [any]
      logical :: is_limited = .false.      !! it has a limit
   end type request_t

   !> A joint with clearance.
   type :: found_pin_t
      character(:), allocatable :: joint   !! its name
      integer :: position = 1              !! where the pin may be, as of `tolerance_plan`
      integer :: set = 0                   !! number of its set among the ideal ones
      integer :: item = 0                  !! number in the set
      real(wp) :: clearance = 0.0_wp       !! radial, nominal [m]
   end type found_pin_t

   !> Derivatives at the output times.
   type :: sensitivities_t
      type(instant_t), allocatable :: instants(:)          !! (times) the nominal motion
      real(wp), allocatable :: steps(:)                    !! (parameters) longest steps of differences [any]
      real(wp), allocatable :: values(:, :)                !! (requests, times) nominal values [any]
      real(wp), allocatable :: slopes(:, :, :)             !! (parameters, requests, times) derivatives [any]
      real(wp), allocatable :: curvatures(:, :, :, :)      !! (parameters, parameters, requests, times) second derivatives [any]
      real(wp), allocatable :: pins(:, :, :, :)            !! (2, pins, requests, times) by x, y of a displaced pin [any]
      real(wp), allocatable :: pin_curvatures(:, :, :, :)  !! (3, pins, requests, times) second ones by xx, yy, xy of it [any]
      real(wp), allocatable :: tangents(:, :, :)           !! (n_v bodies, parameters, times) of the positions [any]
      real(wp), allocatable :: pin_tangents(:, :, :)       !! (n_v bodies, 2 pins, times) the same by x, y of pins [any]
      real(wp), allocatable :: directions(:, :, :)         !! (2, pins, times) where the force presses a pin; 0: no force [1]
      real(wp), allocatable :: clearance_slopes(:, :)      !! (parameters, pins) derivatives of the clearances [any]
      logical :: has_curvatures = .true.                   !! .false.: a mechanism next to the nominal one cannot be assembled
   end type sensitivities_t

   !> Members within their limits.
   type :: yield_t
      integer(i8) :: good = 0                !! members within the limits at all output times
      integer(i8) :: n = 0                   !! members
      integer(i8) :: open = 0                !! members that cannot be assembled at some output time; they are not good
      real(wp) :: low = 0.0_wp               !! Wilson's interval of 95 % [1]
      real(wp) :: high = 1.0_wp              !! [1]
   end type yield_t

   !> A member with an extreme value.
   type :: worst_t
      integer(i8) :: number = 0              !! of the member, from 1; 0: none has a value
      real(wp) :: value = 0.0_wp             !! of the channel, at the time that is shown of it [any]
   end type worst_t

   !> What the members give.
   !> Components: moments, yields and histograms of the same members.
   type :: members_t
      logical :: is_exact = .false.                        !! each was assembled
      integer(i8) :: n = 0                                 !! members
      integer(i8) :: open = 0                              !! members that cannot be assembled
      real(wp), allocatable :: mean(:, :)                  !! (requests, times) of those that can [any]
      real(wp), allocatable :: sigma(:, :)                 !! (requests, times) standard deviations [any]
      real(wp), allocatable :: mean_half(:, :)             !! (requests, times) half of the 95 % interval of the mean [any]
      real(wp), allocatable :: sigma_low(:, :)             !! (requests, times) ends of that of the standard deviation [any]
      real(wp), allocatable :: sigma_high(:, :)            !! (requests, times) [any]
      real(wp), allocatable :: lowest(:, :)                !! (requests, times) lowest value [any]
      real(wp), allocatable :: highest(:, :)               !! (requests, times) highest value [any]
      type(yield_t), allocatable :: yields(:)              !! (requests) within the limits of each
      type(yield_t) :: yield                               !! within all limits
      real(wp), allocatable :: capability(:, :)            !! (3, requests) Cpk, ends of its interval; NaN: no limits [1]
      real(wp), allocatable :: failures(:, :)              !! (3, requests) rare failures, ends of the interval; NaN: no limits [1]
      integer, allocatable :: at(:)                        !! (requests) number of the time that is shown, see `shown_time`
      integer(i8) :: taken = 0                             !! members taken so far
      type(worst_t), allocatable :: worst(:, :)            !! (2, requests) those with the lowest and the highest value then
      real(wp), allocatable :: worst_deviations(:, :, :)   !! (parameters, 2, requests) their deviations; NaN: none [any]
      real(wp), allocatable :: worst_pins(:, :, :, :)      !! (2, pins, 2, requests) displacements x, y of their pins [m]
      real(wp), allocatable :: edges(:, :)                 !! (0:bins, requests) of the histograms [any]
      integer(i8), allocatable :: counts(:, :)             !! (bins, requests) members between them
   end type members_t

   !> The cheapest tolerances for a request.
   type :: allocation_t
      real(wp) :: sigma = 0.0_wp               !! standard deviation that has the yield asked for; NaN: no limits [any]
      real(wp), allocatable :: factors(:)      !! (parameters) widths, of those of the deck; NaN: none reach the yield [1]
      real(wp) :: cost = 0.0_wp                !! sum of the costs that change; NaN: none reach the yield [1]
   end type allocation_t

   !> Sobol' indices.
   type :: indices_t
      integer :: points = 0                                !! of the plan; of a polynomial, members
      real(wp), allocatable :: first(:, :, :, :)           !! (3, contributors, requests, times) value, ends of its interval [1]
      real(wp), allocatable :: total(:, :, :, :)           !! (3, contributors, requests, times) the same of total indices [1]
      integer(i8) :: open = 0                              !! members of the plan that cannot be assembled; their points are omitted
      real(wp), allocatable :: missed(:)                   !! (requests) part of the variance a polynomial misses; else unset [1]
   end type indices_t

   !> A study.
   !> Components: what is asked, and each level of what is found.
   type :: tolerance_study_t
      type(tolerance_plan_t) :: plan                       !! what is asked
      type(request_t), allocatable :: requests(:)          !! (requests) channels that are studied
      type(found_pin_t), allocatable :: pins(:)            !! (pins) joints with clearance
      type(sensitivities_t) :: derivatives                 !! at the output times
      real(wp), allocatable :: slopes(:, :, :)             !! (parameters, requests, times) derivatives, with pins under force [any]
      real(wp), allocatable :: parts(:, :, :)              !! (contributors, requests, times) of the first-order variance [any]
      real(wp), allocatable :: widths(:, :, :)             !! (contributors, requests, times) of the worst case [any]
      real(wp), allocatable :: low(:, :)                   !! (requests, times) worst case, lower end [any]
      real(wp), allocatable :: high(:, :)                  !! (requests, times) worst case, upper end [any]
      real(wp), allocatable :: sigma(:, :)                 !! (requests, times) root sum square [any]
      real(wp), allocatable :: mean(:, :)                  !! (requests, times) mean to second order [any]
      type(members_t) :: members                           !! what sampled mechanisms give
      real(wp) :: cpu_members = 0.0_wp                     !! processor time of them [s]
      type(indices_t) :: indices                           !! how much each contributor scatters them
      real(wp) :: cpu_checked = 0.0_wp                     !! processor time of checked members [s]
      integer :: n_checked = 0                             !! members that were assembled to check the expansion
      integer :: n_open = 0                                !! of these, members that cannot be assembled
      real(wp), allocatable :: errors(:)                   !! (requests) maximum error of the expansion in them [any]
      type(text_t), allocatable :: contributors(:)         !! (contributors) names: parameters, then joints, then batches
      type(allocation_t), allocatable :: allocations(:)    !! (requests) cheapest tolerances; unallocated: no costs are given
      type(split_t), allocatable :: splits(:)              !! (requests) between parts and within the motion; unallocated: not split
   end type tolerance_study_t

end module tolerance_results
