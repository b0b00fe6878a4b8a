!> Balls in sockets and pins in bushings as joints: dry contact (`socket_contacts`), films (`socket_films`), or both.
!>
!> Levels are those of the plane, see `clearance_revolute`. Channels of the force and of the moment are those of contacts and film
!> together. Limits: those of both.
module socket_joints
   use film_law, only: film_motion_t
   use film_places, only: film_state_t
   use kinds, only: wp
   use motion, only: cross, motion_t
   use point_contacts, only: of_force, of_moment, of_state, point_report
   use readings, only: readings_t
  use revolute_level, only: of_drag_bearing, of_drag_journal, of_eccentricity_ratio, of_film_force, of_film_moment, of_film_power, &
      of_film_pressure, of_film_thickness, of_film_torque, of_side_flow, of_temperature_rise
   use socket_contacts, only: socket_contacts_t
   use socket_films, only: socket_films_t
   use states_of_contacts, only: state_contact, state_film, state_mixed
   implicit none (type, external)
   private
   public :: socket_joints_t

   !> Balls in sockets or pins in bushings. `set_start` of a geometry calls `seat_films`.
   type, abstract, extends(socket_contacts_t) :: socket_joints_t
   contains
      procedure, non_overridable :: seat_films
      procedure :: report => joints_report
   end type socket_joints_t

contains

   !> Report the films where they are; after the axes are those of the bodies.
   subroutine seat_films(self)
      class(socket_joints_t), intent(inout) :: self  !! the set

      integer :: k

      if (.not. allocated(self%laws%films)) return
      select type (films => self%laws%films)
      type is (socket_films_t)
         allocate (films%seat(self%n))
         films%may_tilt = self%socket(1)%has_axis .and. .not. films%law%knows_tilt()
         do k = 1, self%n
            associate (seat => films%seat(k), socket => self%socket(k))
               seat%body = self%items%body(:, k)
               seat%s_i = self%items%s_i(:, k)
               seat%s_j = self%items%s_j(:, k)
               seat%has_axis = socket%has_axis
               seat%has_ends = socket%has_ends
               seat%axis_j = socket%axis_j
               if (.not. socket%has_axis) cycle
               seat%frame(:, 1) = socket%across
               seat%frame(:, 2) = cross(socket%axis_i, socket%across)
               seat%frame(:, 3) = socket%axis_i
            end associate
         end do
      end select
   end subroutine seat_films

   !> Values that are read: of films here, and what they add to those of contacts.
   subroutine joints_report(self, readings, motion, values)
      class(socket_joints_t), intent(in) :: self   !! the set
      type(readings_t), intent(in) :: readings     !! channels that are read
      type(motion_t), intent(in) :: motion         !! positions and velocities
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      type(film_motion_t) :: film
      type(film_state_t) :: state
      integer :: at, k, m

      call point_report(self, readings, motion, values)
      if (.not. allocated(self%laws%films)) return
      do k = 1, self%n
         film = self%laws%films%motion_of(k, self%items%body(:, k), self%items%s_i(:, k), self%items%s_j(:, k), motion)
         state = self%laws%films%state_of(k, self%items%body(:, k), film, motion)
         do m = 1, readings%n
            if (readings%of(m)%code == of_state) then
               at = readings%of(m)%place + self%before%contacts + (k - 1)*self%n_contact_item
               if (state%share > 0.0_wp) call add_film_state(values(at + 1:at + self%n_contact_item))
            else
               at = readings%of(m)%place + readings%of(m)%width*(self%before%items + k - 1)
               call report_film(self, readings%of(m)%code, k, film, state, values(at + 1:at + readings%of(m)%width))
            end if
         end do
      end do
   end subroutine joints_report

   !> What a film makes of the states of contacts.
   pure subroutine add_film_state(values)
      real(wp), intent(inout) :: values(:)  !! (contacts of an item) the states [1]

      values = real(merge(state_mixed, state_film, nint(values) == state_contact), wp)
   end subroutine add_film_state

   !> A channel that films report, or add to.
   subroutine report_film(self, code, k, film, state, value)
      class(socket_joints_t), intent(in) :: self     !! the set
      integer, intent(in) :: code                    !! the channel
      integer, intent(in) :: k                       !! the item
      type(film_motion_t), intent(in) :: film        !! motion of its film
      type(film_state_t), intent(in) :: state        !! what the film does
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [any]

      select case (code)
      case (of_force); value = value + state%load
      case (of_moment); value = value + state%moment
      case (of_film_force); value = state%load
      case (of_film_moment); value = state%moment
      case (of_film_torque)
         value = state%torque
         if (size(value) == 3) value = state%shear
      case (of_film_pressure); value(1) = self%laws%films%max_pressure(k, film)
      case (of_eccentricity_ratio); value(1) = norm2(film%e)/self%items%pairs(k)%clearance
      case (of_film_thickness)
         value(1) = self%laws%films%law%min_thickness(self%items%pairs(k)%clearance, film, self%laws%films%parameters(:, k))
      case (of_drag_journal); value(1) = state%drag_journal
      case (of_drag_bearing); value(1) = state%drag_bearing
      case (of_film_power); value(1) = state%power
      case (of_side_flow); value(1) = state%side_flow
      case (of_temperature_rise); value(1) = state%rise
      end select
   end subroutine report_film

end module socket_joints
