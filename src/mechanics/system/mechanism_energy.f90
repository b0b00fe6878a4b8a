!> The energy ledger of a planar scene at one state.
!>
!> residual = E - E_0 - (drive + load + stabilisation work) + (lost in contacts, by friction, in dampers and films),
!> E = kinetic + potential + elastic. It is zero but for the error of the integration: an error
!> measure that needs no reference solution.
module mechanism_energy
   use clearance_set, only: loss_contact, loss_friction
   use contact_places, only: lost_damper, place_of_film_loss, place_of_joint_loss, place_of_loss, work_drive, work_load, &
      work_stabilisation
   use cut_off, only: lost_by_damping
   use kinds, only: wp
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: energy_t, energy_of, mechanical_energy

   !> Energies and work done since the start.
   type :: energy_t
      real(wp) :: kinetic = 0.0_wp              !! kinetic energy [J]
      real(wp) :: potential = 0.0_wp            !! of gravity, zero at the world's origin [J]
      real(wp) :: elastic = 0.0_wp              !! stored in contacts and springs [J]
      real(wp) :: drive_work = 0.0_wp           !! done by drivers [J]
      real(wp) :: load_work = 0.0_wp            !! done by applied loads [J]
      real(wp) :: stabilisation_work = 0.0_wp   !! done by constraint forces on the drift [J]
      real(wp) :: dissipated_contact = 0.0_wp   !! lost by damping in contacts [J]
      real(wp) :: dissipated_friction = 0.0_wp  !! lost by friction [J]
      real(wp) :: dissipated_damper = 0.0_wp    !! lost in dampers [J]
      real(wp) :: dissipated_film = 0.0_wp      !! taken by lubricant films [J]
   contains
      procedure :: mechanical
      procedure :: balance
      procedure :: largest_work
      procedure :: magnitude
   end type energy_t

contains

   !> Kinetic, potential and elastic energy together.
   pure real(wp) function mechanical(self)
      class(energy_t), intent(in) :: self  !! energies

      mechanical = self%kinetic + self%potential + self%elastic
   end function mechanical

   !> What stays the same but for errors: mechanical energy less work done plus losses.
   pure real(wp) function balance(self)
      class(energy_t), intent(in) :: self  !! energies

      balance = self%mechanical() - (self%drive_work + self%load_work + self%stabilisation_work) &
                + self%dissipated_contact + self%dissipated_friction + self%dissipated_damper + self%dissipated_film
   end function balance

   !> The largest work or loss.
   pure real(wp) function largest_work(self)
      class(energy_t), intent(in) :: self  !! energies

      largest_work = max(abs(self%drive_work), abs(self%load_work), abs(self%stabilisation_work), abs(self%dissipated_contact), &
                         abs(self%dissipated_friction), abs(self%dissipated_damper), abs(self%dissipated_film))
   end function largest_work

   !> Size of what the balance adds up, for its round-off.
   pure real(wp) function magnitude(self)
      class(energy_t), intent(in) :: self  !! energies

      magnitude = self%kinetic + abs(self%potential) + abs(self%elastic) + abs(self%drive_work) + abs(self%load_work) &
                  + abs(self%stabilisation_work) + abs(self%dissipated_contact) + abs(self%dissipated_friction) &
                  + abs(self%dissipated_damper) + abs(self%dissipated_film)
   end function magnitude

   !> Mechanical energy of the present motion.
   real(wp) function mechanical_energy(system) result(total)
      class(mechanism_t), intent(in) :: system     !! the system, its motion set

      type(energy_t) :: energy

      call add_mechanical(system, energy)
      total = energy%mechanical()
   end function mechanical_energy

   !> Kinetic, potential and elastic energy of the present motion.
   subroutine add_mechanical(system, energy)
      class(mechanism_t), intent(in) :: system     !! the system, its motion set
      type(energy_t), intent(inout) :: energy          !! energies

      integer :: k

      associate (motion => system%linkage%motion, mass => system%linkage%mass, gravity => system%loading%gravity)
         energy%kinetic = system%linkage%coordinates%kinetic_energy(system%linkage%bodies%n, mass, motion)
         energy%potential = potential_energy(system%linkage%bodies%n, system%linkage%bodies%mass, gravity, motion%r)
      end associate
      do k = 1, size(system%loading%forces)
         energy%elastic = energy%elastic + system%loading%forces(k)%set%elastic_energy(system%linkage%motion)
      end do
      if (.not. any_acts(system)) return
      do k = 1, size(system%clearance_joints%sets)
         energy%elastic = energy%elastic + system%clearance_joints%sets(k)%set%elastic_energy(system%linkage%motion)
      end do
   end subroutine add_mechanical

   !> Sum of -m g . r, body by body.
   pure real(wp) function potential_energy(n, mass, gravity, r) result(total)
      integer, intent(in) :: n               !! number of bodies
      real(wp), intent(in) :: mass(n)        !! (n) masses [kg]
      real(wp), intent(in) :: gravity(3)     !! (3) acceleration of gravity, world frame [m/s^2]
      real(wp), intent(in) :: r(3, 0:n)      !! (3, 0:n) centres of mass, world frame [m]

      integer :: k

      total = 0.0_wp
      do k = 1, n
         total = total - mass(k)*(gravity(1)*r(1, k) + gravity(2)*r(2, k) + gravity(3)*r(3, k))
      end do
   end function potential_energy

   !> Energies at a state. Works without a ledger too; then the work terms are zero.
   function energy_of(system, y) result(energy)
      class(mechanism_t), intent(in) :: system     !! the system; its motion must be that of the state
      real(wp), intent(in) :: y(:)                     !! (n) state [any]
      type(energy_t) :: energy                         !! energies

      integer :: first, i, k, z

      call add_mechanical(system, energy)
      if (.not. system%ledger%is_kept) return
      first = system%in_state(0)
      energy%drive_work = y(first + work_drive)
      energy%load_work = y(first + work_load)
      energy%stabilisation_work = y(first + work_stabilisation)
      energy%dissipated_damper = y(first + lost_damper)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               z = first + place_of_loss(set%before%contacts + i, loss_contact)
               energy%dissipated_contact = energy%dissipated_contact + lost_by_damping(set, i, system%linkage%motion, y(z))
               z = first + place_of_loss(set%before%contacts + i, loss_friction)
               energy%dissipated_friction = energy%dissipated_friction + y(z)
            end do
         end associate
      end do
      if (system%friction%rubbing%n > 0) then
         energy%dissipated_friction = energy%dissipated_friction + y(first + place_of_joint_loss(system%clearance_joints%n_contact))
      end if
      if (system%clearance_joints%has_films) then
         energy%dissipated_film = y(first + place_of_film_loss(system%clearance_joints%n_contact, system%friction%rubbing%n > 0))
      end if
   end function energy_of

   !> Whether any contact touches, or may have a force without it.
   pure logical function any_acts(system)
      class(mechanism_t), intent(in) :: system  !! the system

      integer :: k

      any_acts = .false.
      do k = 1, size(system%clearance_joints%sets)
         any_acts = any_acts .or. system%clearance_joints%sets(k)%set%n_touching > 0 &
              .or. system%clearance_joints%sets(k)%set%laws%normal%acts_apart
      end do
   end function any_acts

end module mechanism_energy
