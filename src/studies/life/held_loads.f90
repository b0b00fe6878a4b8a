!> Wear per cycle of any profile under the loads of a simulated cycle: what the profile changes of the contact is followed, what it
!> changes of the motion is not.
!>
!> A simulation gives nodes (`wear_loads`): places of the pin, exponents p of the normal law, volumes. Held is the elastic normal
!> force of each node,  f = delta^p d(delta)/de.  On another profile the pin is where f is the same: two equations for e, by
!> Newton's method with the derivative  delta^p (H/M' + (p - 3/2)/delta g g^T),  g = d(delta)/de,  H = 2 int u u^T dtheta  over the
!> overlap (`surface_overlap`). A step is halved where it loses the contact, or where the missing force at its end points back more
!> than it pointed along it at its start: where the energy is convex such steps converge. At its place a node takes its volumes in
!> proportion to the overlap.
!>
!> Where a light load has no such place, on surfaces that touch in several arcs, the pin is where f is nearest. The error of a jump,
!> found from loads that are simulated at its end, holds what that makes.
!>
!> v(x) = max(model(x) + v_s - model(x_s), 0), scaled so that each surface loses what it does in the simulation
!>
!> with the rates v_s that were simulated with the profiles x_s: at x_s the model is exact.
!> Signs: rates are not negative. Source: this program. Limits: bearings and journals in the plane.
module held_loads
   use held_slopes, only: slopes_t
   use kinds, only: wp
   use life_state, only: life_state_t
   use overlap_rays, only: pin_t
   use overlap_sums, only: arc_t, to_gradient
   use surface_overlap, only: find_overlap, overlap_t
   use surface_profile, only: new_profile
   use surfaces, only: surfaces_t
   use wear_arc, only: add_swept_points
   use wear_loads, only: most_nodes, n_load
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: held_t, new_held

   integer, parameter :: most_iterations = 40         !! of Newton's method
   real(wp), parameter :: close = 1.0e-6_wp           !! what may be left of the force, relative [1]
   real(wp), parameter :: enough = 0.9_wp             !! part of a step's work that the missing force may take back at its end [1]
   integer, parameter :: every = 2                    !! of so many nodes one is taken
   real(wp), parameter :: longest = 1.0e-3_wp         !! step of Newton's method over |e|, beside two penetrations [1]
   real(wp), parameter :: hertz = 1.5_wp              !! exponent with which the foundation is linear [1]
   real(wp), parameter :: none(2) = [0.0_wp, 0.0_wp]  !! nodes do not sweep [rad]

   !> What a simulation gave, from each start.
   type :: held_t
      real(wp), allocatable :: rates(:, :)          !! (n, starts) per cycle [m^3, m]
      real(wp), allocatable :: defect(:, :)         !! (n, starts) what the model lacks of them [m^3]
      real(wp), allocatable :: nodes(:, :, :, :)    !! (6, nodes, contacts, starts) see `wear_loads` [m, rad, 1, m^3]
      real(wp), allocatable :: force(:, :, :, :)    !! (2, nodes, contacts, starts) f [m^p]
      type(slopes_t) :: slopes                      !! derivatives of the mean of the rates that were found last
   contains
      procedure :: at => rates_at
   end type held_t

contains

   !> Hold the loads of simulations with some profiles.
   subroutine new_held(state, x, rates, loads, held)
      type(life_state_t), intent(in) :: state     !! the surfaces
      real(wp), intent(in) :: x(:)                !! (n) the profiles [m^3, m]
      real(wp), intent(in) :: rates(:, :)         !! (n, starts) that were simulated [m^3, m]
      real(wp), intent(in) :: loads(:, :)         !! (6 nodes contacts, starts) or (0, starts): none known [m, rad, 1, m^3]
      type(held_t), intent(inout) :: held         !! set

      type(surfaces_t), allocatable :: pairs(:)
      logical :: is_good
      integer :: m

      held%rates = rates
      held%defect = 0.0_wp*rates
      associate (contacts => size(state%surfaces)/2)
         held%nodes = reshape(loads, [n_load, merge(most_nodes, 0, size(loads) > 0), contacts, size(loads, 2)])
         held%nodes = held%nodes(:, every::every, :, :)
         held%nodes(5:, :, :, :) = every*held%nodes(5:, :, :, :)
         held%force = 0.0_wp*held%nodes(:2, :, :, :)
      end associate
      call held%slopes%clear()
      if (size(loads) == 0) return
      call take_volumes(state, held)
      call find_pairs(state, x, pairs)
      call keep_forces(pairs, held)
      call merge_nodes(held)
      do m = 1, size(rates, 2)
         call add_nodes(state, pairs, held, m, held%defect(:, m), is_good)
         held%defect(:, m) = held%rates(:, m) - held%defect(:, m)
      end do
      held%defect(state%n - size(state%surfaces) + 1:, :) = 0.0_wp
   end subroutine new_held

   !> Scale the rates so that their sums are the volumes of the nodes: these are no differences of volumes that are large.
   pure subroutine take_volumes(state, held)
      type(life_state_t), intent(in) :: state   !! the surfaces
      type(held_t), intent(inout) :: held       !! its rates are scaled

      real(wp) :: lost
      integer :: k, m

      do m = 1, size(held%rates, 2)
         do k = 1, size(state%surfaces)
            associate (rates => held%rates(state%before(k) + 1:state%before(k) + size(state%surfaces(k)%volume), m))
               lost = sum(rates)
               if (lost > 0.0_wp) rates = rates*(sum(held%nodes(6 - modulo(k, 2), :, (k + 1)/2, m))/lost)
            end associate
         end do
      end do
   end subroutine take_volumes

   !> Rates of other profiles under the same loads.
   subroutine rates_at(self, state, x, rates, is_good)
      class(held_t), intent(inout) :: self        !! the loads; where pins are is remembered
      type(life_state_t), intent(in) :: state     !! the surfaces
      real(wp), intent(in) :: x(:)                !! (n) the profiles [m^3, m]
      real(wp), intent(out) :: rates(:, :)        !! (n, starts) per cycle [m^3, m]
      logical, intent(out) :: is_good             !! each pin was found

      type(surfaces_t), allocatable :: pairs(:)
      real(wp) :: lost
      integer :: first, k, last, m

      rates = self%rates
      is_good = .true.
      call self%slopes%clear()
      if (size(self%nodes) == 0) return
      call find_pairs(state, x, pairs)
      do m = 1, size(rates, 2)
         associate (v => rates(:, m))
            v(:state%n - size(state%surfaces)) = 0.0_wp
            call add_nodes(state, pairs, self, m, v, is_good)
            if (.not. is_good) return
            do k = 1, size(state%surfaces)
               first = state%before(k) + 1
               last = state%before(k) + size(state%surfaces(k)%volume)
               v(first:last) = max(v(first:last) + self%defect(first:last, m), 0.0_wp)
               lost = sum(v(first:last))
               if (lost > 0.0_wp) v(first:last) = v(first:last)*(sum(self%rates(first:last, m))/lost)
            end do
         end associate
      end do
   end subroutine rates_at

   !> Pairs of surfaces with profiles.
   subroutine find_pairs(state, x, pairs)
      type(life_state_t), intent(in) :: state                  !! the surfaces
      real(wp), intent(in) :: x(:)                             !! (n) the profiles [m^3, m]
      type(surfaces_t), allocatable, intent(out) :: pairs(:)   !! (contacts) bearing and journal

      type(worn_surface_t), allocatable :: worn(:)
      integer :: k

      worn = state%worn(x)
      allocate (pairs(size(worn)/2))
      do k = 1, size(pairs)
         associate (pair => pairs(k), hole => worn(2*k - 1), journal => worn(2*k))
            pair%radius_i = hole%radius
            pair%radius_j = journal%radius
            pair%clearance = hole%radius - journal%radius
            pair%length = hole%length
            allocate (pair%worn)
            call new_profile(pair%worn%hole, .true., hole%radius, hole%length, hole%volume)
            if (any(journal%volume > 0.0_wp)) then
               call new_profile(pair%worn%pin, .false., journal%radius, journal%length, journal%volume)
            end if
         end associate
      end do
   end subroutine find_pairs

   !> The forces that are held: those at the places of the nodes.
   subroutine keep_forces(pairs, held)
      type(surfaces_t), intent(in) :: pairs(:)   !! (contacts) the profiles of the simulations
      type(held_t), intent(inout) :: held        !! its forces are set; nodes that do not overlap have none

      type(overlap_t) :: overlap
      integer :: c, k, m

      do m = 1, size(held%nodes, 4)
         do c = 1, size(pairs)
            do k = 1, size(held%nodes, 2)
               associate (node => held%nodes(:, k, c, m))
                  if (.not. (sum(node(5:)) > 0.0_wp .and. node(4) > 0.0_wp)) cycle
                  call find_overlap(pairs(c), pin_at(node(:2), node(3)), to_gradient, overlap)
                  if (overlap%delta > 0.0_wp) held%force(:, k, c, m) = overlap%delta**node(4)*overlap%gradient
               end associate
            end do
         end do
      end do
   end subroutine keep_forces

   !> Merge nodes under nearly one load into the first of them, whose force becomes their mean: a load that is constant but for a
   !> vibration has one node. What that changes is of second order in the differences.
   pure subroutine merge_nodes(held)
      type(held_t), intent(inout) :: held   !! volumes and forces of merged nodes are zero

      real(wp), parameter :: same = 1.0e-2_wp, same_angle = 1.0e-4_wp  ! part of the force, angle of a pin that wears [1, rad]
      integer :: c, first, k, m

      do m = 1, size(held%nodes, 4)
         do c = 1, size(held%nodes, 3)
            associate (nodes => held%nodes(:, :, c, m), forces => held%force(:, :, c, m))
               do k = 2, size(nodes, 2)
                  do first = 1, k - 1
                     if (.not. (sum(nodes(5:, first)) > 0.0_wp .and. sum(nodes(5:, k)) > 0.0_wp)) cycle
                     if (norm2(forces(:, k) - forces(:, first)) > same*norm2(forces(:, k))) cycle
                     if (nodes(6, k) > 0.0_wp .and. abs(nodes(3, k) - nodes(3, first)) > same_angle) cycle
                     forces(:, first) = (sum(nodes(5:, first))*forces(:, first) + sum(nodes(5:, k))*forces(:, k)) &
                                        /(sum(nodes(5:, first)) + sum(nodes(5:, k)))
                     nodes(5:, first) = nodes(5:, first) + nodes(5:, k)
                     nodes(5:, k) = 0.0_wp
                     forces(:, k) = 0.0_wp
                     exit
                  end do
               end do
            end associate
         end do
      end do
   end subroutine merge_nodes

   !> Add what nodes of a start take.
   subroutine add_nodes(state, pairs, held, start, rates, is_good)
      type(life_state_t), intent(in) :: state     !! the surfaces
      type(surfaces_t), intent(in) :: pairs(:)    !! (contacts) their profiles
      type(held_t), intent(inout) :: held         !! the loads; places of pins are set
      integer, intent(in) :: start                !! number of the start
      real(wp), intent(inout) :: rates(:)         !! (n) added to [m^3]
      logical, intent(out) :: is_good             !! each pin was found

      type(arc_t) :: arc
      integer :: c, k

      is_good = .true.
      do c = 1, size(pairs)
         associate (i => state%before(2*c - 1), j => state%before(2*c), n_i => size(state%surfaces(2*c - 1)%volume), &
                    n_j => size(state%surfaces(2*c)%volume))
            do k = 1, size(held%nodes, 2)
               associate (node => held%nodes(:, k, c, start), force => held%force(:, k, c, start))
                  if (.not. maxval(abs(force)) > 0.0_wp) cycle
                  call place_pin(pairs(c), force, node(4), node(3), node(:2), arc, is_good)
                  if (.not. is_good) return
                  associate (n => arc%n, width => arc%width(:arc%n))
                     call add_swept_points(rates(i + 1:i + n_i), arc%hole(:n), width, arc%d(:n)*width, none, node(5))
                     call add_swept_points(rates(j + 1:j + n_j), arc%pin(:n), width, arc%d(:n)*width, none, node(6))
                  end associate
                  call held%slopes%add(arc, node(4), node(5:)/size(held%rates, 2), [i, j], [n_i, n_j])
               end associate
            end do
         end associate
      end do
   end subroutine add_nodes

   !> Find where the pin is under a force.
   pure subroutine place_pin(pair, force, p, turned, e, arc, is_good)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      real(wp), intent(in) :: force(2)         !! (2) f [m^p]
      real(wp), intent(in) :: p                !! exponent of the normal law [1]
      real(wp), intent(in) :: turned           !! angle of the pin's body less that of the hole's [rad]
      real(wp), intent(inout) :: e(2)          !! (2) centre of the pin: a guess, and where it is [m]
      type(arc_t), intent(inout) :: arc        !! points of the overlap there
      logical, intent(out) :: is_good          !! it was found

      type(overlap_t) :: overlap
      real(wp) :: best, guess(2), here(2), left(2), magnitude, nearest(2), step(2), work
      integer :: iteration
      logical :: touches

      magnitude = norm2(force)
      best = huge(1.0_wp)
      guess = e
      here = e
      work = 0.0_wp
      step = 0.0_wp
      do iteration = 1, most_iterations
         call find_overlap(pair, pin_at(e, turned), to_gradient, overlap, arc)
         associate (delta => overlap%delta, g => overlap%gradient)
            touches = delta > 0.0_wp .and. arc%n > 0
            if (.not. (touches .or. work > 0.0_wp)) then   ! no contact so far
               e = e + (0.5_wp*magnitude**(1.0_wp/p) - delta)*g/dot_product(g, g)
               cycle
            end if
            left = force
            if (touches) left = force - delta**p*g
            is_good = touches .and. norm2(left) <= close*magnitude
            if (is_good) return
            if (.not. touches .or. dot_product(left, step) < -enough*work) then   ! too far
               step = 0.5_wp*step
               work = 0.5_wp*work
               e = here + step
               cycle
            end if
            if (norm2(left) < best) nearest = e
            best = min(best, norm2(left))
            here = e
            step = newton_step(overlap, arc, p, left)
            step = step*min(1.0_wp, (2.0_wp*delta + longest*norm2(e))/max(norm2(step), tiny(1.0_wp)))
            work = dot_product(left, step)
            e = e + step
         end associate
      end do
      e = guess
      is_good = best < huge(1.0_wp)
      if (is_good) call find_overlap(pair, pin_at(nearest, turned), to_gradient, overlap, arc)
      is_good = is_good .and. overlap%delta > 0.0_wp .and. arc%n > 0
   end subroutine place_pin

   !> Newton's step of the pin.
   pure function newton_step(overlap, arc, p, left) result(step)
      type(overlap_t), intent(in) :: overlap   !! the overlap
      type(arc_t), intent(in) :: arc           !! its points
      real(wp), intent(in) :: p                !! exponent of the normal law [1]
      real(wp), intent(in) :: left(2)          !! (2) force that is missing [m^p]
      real(wp) :: step(2)                      !! (2) of the pin [m]

      real(wp) :: across(2), along(2), f_n, f_t, g_n, g_t, h(2, 2), middle, pressed, square, width
      integer :: k

      middle = sum(arc%hole(:arc%n)*arc%width(:arc%n))/sum(arc%width(:arc%n))
      h = 0.0_wp
      pressed = 0.0_wp
      do k = 1, arc%n   ! cos^2 and sin^2 of the angles from the middle of the arc to the fourth order
         width = 2.0_wp*arc%width(k)
         square = (arc%hole(k) - middle)**2
         square = min(square*(1.0_wp - square/3.0_wp), 1.0_wp)
         h(1, 1) = h(1, 1) + width*(1.0_wp - square)
         h(2, 2) = h(2, 2) + width*square
         pressed = pressed + width*arc%d(k)*(1.0_wp - 0.5_wp*square)
      end do
      along = [cos(middle), sin(middle)]
      across = [-along(2), along(1)]
      associate (g => overlap%gradient, delta => overlap%delta)
         g_n = dot_product(g, along)
         g_t = dot_product(g, across)
         h = h*(g_n/pressed)
         h(1, 1) = h(1, 1) + ((p - hertz)/delta)*g_n**2
         h(2, 1) = h(2, 1) + ((p - hertz)/delta)*g_n*g_t
         h(1, 2) = h(2, 1)
         h(2, 2) = h(2, 2) + ((p - hertz)/delta)*g_t**2
         h = h*delta**p
      end associate
      f_n = dot_product(left, along)
      f_t = dot_product(left, across)
      step = ((h(2, 2)*f_n - h(1, 2)*f_t)*along + (h(1, 1)*f_t - h(2, 1)*f_n)*across) &
             /(h(1, 1)*h(2, 2) - h(1, 2)*h(2, 1))
   end function newton_step

   !> A pin at rest, axes of the hole's body.
   pure type(pin_t) function pin_at(e, turned) result(pin)
      real(wp), intent(in) :: e(2)      !! (2) its centre from the hole's [m]
      real(wp), intent(in) :: turned    !! angle of its body less that of the hole's [rad]

      pin%e = e
      pin%angle = [0.0_wp, turned]
      pin%distance = norm2(e)
      if (pin%distance > tiny(1.0_wp)) pin%phi = atan2(e(2), e(1))
   end function pin_at

end module held_loads
