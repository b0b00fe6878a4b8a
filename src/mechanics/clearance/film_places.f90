!> What joints say of their films: the bearing of a row, how its film acts, and what a film does there.
module film_places
   use film_law, only: film_bearing_t, film_motion_t, max_eccentricity, parameter_clearance, parameter_length, parameter_radius
   use item, only: find_place, item_t
   use joint_level, only: level_hybrid, level_lubricated, level_of
   use kinds, only: not_a_number, wp
   use lubricant, only: oil_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: film_bearing_of, film_place_t, film_state_t, finish_state, place_of_film, share_of

   real(wp), parameter :: min_flow = 1.0e-3_wp  !! side flow that is next to none, of L R c and both angular speeds [1]

   !> How a film acts in a joint.
   type :: film_place_t
      real(wp) :: depth = 0.0_wp          !! d: of the transition to dry contact; 0: there is none [m]
      real(wp) :: gone = 0.0_wp           !! c + d: eccentricity at which nothing of the film acts, fitted to the surfaces [m]
      real(wp) :: extra = 0.0_wp          !! clearance of the film beyond that of the surfaces [m]
      real(wp) :: viscosity = 0.0_wp      !! dynamic [Pa.s]
      real(wp) :: eps_max = 1.0_wp        !! eccentricity ratio beyond which the film's shape stays the same [1]
      logical :: is_sphere = .false.      !! of a ball in a socket
      logical :: has_torque = .false.     !! moments of shear act too
      logical :: is_relative = .false.    !! entrained by the difference of the speeds, as the book has it, not by their sum
      logical :: is_heated = .false.      !! a static analysis finds the temperature by a balance of heat
      real(wp) :: temperature = 0.0_wp    !! of the film, whose viscosity it has [K]
   end type film_place_t

   !> What a film does at a motion.
   type :: film_state_t
      real(wp) :: force(2) = 0.0_wp       !! (2) on the journal, frame of its motion [N]
      real(wp) :: torque = 0.0_wp         !! moment of shear on the journal, where it acts [N.m]
      real(wp) :: share = 0.0_wp          !! part of the film in the transition [1]
      real(wp) :: drag_journal = 0.0_wp   !! moment of shear on the journal, whether it acts or not [N.m]
      real(wp) :: drag_bearing = 0.0_wp   !! the same on the bearing [N.m]
      real(wp) :: power = 0.0_wp          !! that the film turns into heat [W]
      real(wp) :: side_flow = 0.0_wp      !! that leaves at both ends [m^3/s]
      real(wp) :: load(3) = 0.0_wp        !! in space: (3) force on journal or ball, world frame [N]
      real(wp) :: moment(3) = 0.0_wp      !! in space: (3) moment on it about its point, world frame [N.m]
      real(wp) :: shear(3) = 0.0_wp       !! in space: (3) moment of shear on a ball, where it acts, world frame [N.m]
      logical :: has_flow = .false.       !! that is enough to carry heat away
      real(wp) :: rise = 0.0_wp           !! of the temperature, if the side flow takes all heat along; NaN: too little flows [K]
   end type film_state_t

contains

   !> A bearing, as its film sees it; of a pin that is shorter than its bushing, the film has the pin's length.
   pure function film_bearing_of(pair, place) result(bearing)
      type(surfaces_t), intent(in) :: pair      !! the surfaces
      type(film_place_t), intent(in) :: place   !! how the film acts
      type(film_bearing_t) :: bearing           !! the bearing

      bearing = film_bearing_t(pair%radius_j, pair%clearance + place%extra, min(pair%length, pair%length_j), place%viscosity, &
                               place%eps_max, place%is_sphere)
   end function film_bearing_of

   !> How the film of a row acts.
   pure function place_of_film(item, oils) result(place)
      type(item_t), intent(in) :: item     !! the row of a joint with clearance
      type(oil_t), intent(in) :: oils(:)   !! (lubricants) all of them
      type(film_place_t) :: place          !! how it acts

      integer :: level, oil

      level = level_of(item)
      if (level == level_hybrid) place%depth = item%number("e_t0")
      if (level == level_hybrid) place%extra = item%number("e_t1")
      oil = item%reference("lubricant")
      if (oil > 0) place%viscosity = oils(oil)%viscosity
      if (oil > 0) place%temperature = oils(oil)%temperature
      place%eps_max = item%number("eps_max")
      place%is_sphere = find_place(item, "length") == 0
      place%has_torque = item%flag("film_torque")
      if (find_place(item, "entrain") > 0) place%is_relative = item%word("entrain") == "book"
      if (find_place(item, "heat") > 0) then
         place%is_heated = item%word("heat") == "balance" .and. any(level == [level_lubricated, level_hybrid])
      end if
   end function place_of_film

   !> Part of a film that acts: of the length that the journal is in, in the transition to dry contact that of its deeper end.
   pure real(wp) function share_of(place, motion) result(share)
      type(film_place_t), intent(in) :: place    !! how the film acts
      type(film_motion_t), intent(in) :: motion  !! its motion

      share = motion%engaged
      if (place%depth > 0.0_wp) then
         share = share*min(max((place%gone - max_eccentricity(motion))/place%depth, 0.0_wp), 1.0_wp)
      end if
   end function share_of

   !> What follows from the power and the side flow of a film.
   pure subroutine finish_state(parameters, heat, speeds, state)
      real(wp), intent(in) :: parameters(:)         !! (n_film_parameter) fitted to the bearing [any]
      real(wp), intent(in) :: heat                  !! capacity of the lubricant, of its volume [J/(m^3.K)]
      real(wp), intent(in) :: speeds                !! sum of both angular speeds [rad/s]
      type(film_state_t), intent(inout) :: state    !! what the film does

      real(wp) :: minimum

      minimum = min_flow*parameters(parameter_length)*parameters(parameter_radius)*parameters(parameter_clearance)*speeds
      state%has_flow = state%side_flow > minimum
      if (state%has_flow) then
         state%rise = state%power/(heat*state%side_flow)
      else if (state%power > 0.0_wp) then
         state%rise = not_a_number()
      end if
   end subroutine finish_state

end module film_places
