!> What a planar scene reports: its catalogue of channels, and their values at a state.
module mechanism_report
   use catalogue, only: catalogue_t, room_bodies, room_clearances, room_contacts, room_drivers, room_energy, room_forces, &
      room_joints
   use clearance_set, only: clearance_set_t
   use joint_friction, only: friction_channels
   use joint_set, only: joint_set_t
   use kind_info, only: add_channel, kind_info_t
   use kinds, only: not_a_number, wp
   use mechanism_energy, only: energy_of, energy_t
   use mechanism, only: mechanism_t
   use revolute_level, only: film_channels, pressure_channels
   implicit none (type, external)
   private
   public :: build_catalogue, energy_info, fill_catalogue, report_state

   character(*), parameter :: contact_channels = " penetration penetration_rate normal_force friction_force state "
      !! channels of a loose joint that belong to its contact

contains

   !> The channels of the ledger; without its works only the energies, which are functions of the state.
   function energy_info(with_works, with_films) result(info)
      logical, intent(in) :: with_works   !! whether works and losses are integrated
      logical, intent(in) :: with_films   !! whether there are lubricant films
      type(kind_info_t) :: info           !! name and channels

      info%name = "energy"
      info%help = "the energy ledger"
      info%source = "power balance of the equations of motion"
      info%is_table = .false.
      call add_channel(info, "kinetic", "J", "none", 1, "kinetic energy")
      call add_channel(info, "potential", "J", "none", 1, "potential energy of gravity, zero at the origin")
      call add_channel(info, "elastic", "J", "none", 1, "elastic energy stored in contacts and springs")
      if (.not. with_works) return
      call add_channel(info, "drive_work", "J", "none", 1, "work done by drivers since the start")
      call add_channel(info, "load_work", "J", "none", 1, "work done by applied loads since the start")
      call add_channel(info, "stabilisation_work", "J", "none", 1, "work of constraint forces on the drift since the start")
      call add_channel(info, "dissipated_contact", "J", "none", 1, "lost by damping in contacts since the start")
      call add_channel(info, "dissipated_friction", "J", "none", 1, "lost by friction since the start")
      call add_channel(info, "dissipated_damper", "J", "none", 1, "lost in dampers since the start")
      if (with_films) call add_channel(info, "dissipated_film", "J", "none", 1, "taken by lubricant films since the start")
      call add_channel(info, "residual", "J", "none", 1, "what does not add up, at the end of the step that holds the sample")
   end function energy_info

   !> All items and channels of a system.
   subroutine build_catalogue(system, catalogue)
      class(mechanism_t), intent(in) :: system    !! the system
      type(catalogue_t), intent(out) :: catalogue     !! what it can report

      type(kind_info_t) :: contact_info, info, joint_info
      integer :: c, i, k

      catalogue%n_coordinates = system%linkage%coordinates%n_axis
      info = system%linkage%coordinates%bodies_info()
      do k = 1, system%linkage%bodies%n
         call catalogue%add_item(room_bodies, system%linkage%bodies%names(k)%s, info=info)
      end do
      call catalogue%add_kind(room_bodies, info)
      do k = 1, size(system%linkage%joints)
         associate (set => system%linkage%joints(k)%set)
            call catalogue%add_kind(merge(room_drivers, room_joints, set%is_driver), joint_info(set, set%friction%n > 0))
         end associate
      end do
      call add_joint_items(system, .false., catalogue)
      call add_joint_items(system, .true., catalogue)
      do k = 1, size(system%loose%sets)
         associate (set => system%loose%sets(k)%set)
            info = loose_info(set)
            call split_channels(info, joint_info, contact_info)
            call catalogue%add_kind(room_clearances, joint_info)
            call catalogue%add_kind(room_contacts, contact_info)
            do i = 1, set%n
               call catalogue%add_item(room_clearances, set%names(i)%s, info=joint_info, &
                                       radius=merge(set%items%clearance(i), not_a_number(), set%traits%is_round))
               do c = 1, set%n_contact_item
                  call catalogue%add_item(room_contacts, set%names(i)%s, label=set%labels(c)%s, info=contact_info)
               end do
            end do
         end associate
      end do
      do k = 1, size(system%linkage%ideal)
         call ideal_info(joint_info)
         call catalogue%add_kind(room_clearances, joint_info)
         do i = 1, system%linkage%ideal(k)%set%n
            call catalogue%add_item(room_clearances, system%linkage%ideal(k)%set%names(i)%s, info=joint_info)
         end do
      end do
      do k = 1, size(system%loading%forces)
         associate (set => system%loading%forces(k)%set)
            call catalogue%add_kind(room_forces, set%info())
            do i = 1, set%n
               call catalogue%add_item(room_forces, set%names(i)%s, info=set%info())
            end do
         end associate
      end do
      if (system%ledger%has_energies) then
         call catalogue%add_item(room_energy, "energy")
         call catalogue%add_kind(room_energy, energy_info(system%ledger%is_kept, system%loose%has_films))
      end if
      call catalogue%allocate_data()
   end subroutine build_catalogue

   !> Joints, or drivers, in the order of their columns.
   subroutine add_joint_items(system, is_driver, catalogue)
      class(mechanism_t), intent(in) :: system        !! the system
      logical, intent(in) :: is_driver                    !! drivers, not joints
      type(catalogue_t), intent(inout) :: catalogue       !! items are added

      integer, allocatable :: item(:), slot(:)
      integer :: i, k, n

      n = 0
      do k = 1, size(system%linkage%joints)
         if (system%linkage%joints(k)%set%is_driver .eqv. is_driver) n = n + system%linkage%joints(k)%set%n
      end do
      allocate (item(n), slot(n), source=0)
      do k = 1, size(system%linkage%joints)
         associate (set => system%linkage%joints(k)%set)
            if (set%is_driver .neqv. is_driver) cycle
            slot(set%column) = k
            item(set%column) = [(i, i=1, set%n)]
         end associate
      end do
      do k = 1, n
         associate (set => system%linkage%joints(slot(k))%set)
            call catalogue%add_item(merge(room_drivers, room_joints, is_driver), set%names(item(k))%s, &
                                    info=joint_info(set, any(set%friction%item == item(k))))
         end associate
      end do
   end subroutine add_joint_items

   !> What a set of joints announces, with the channels of friction or without.
   function joint_info(set, rubs) result(info)
      class(joint_set_t), intent(in) :: set   !! the set
      logical, intent(in) :: rubs             !! with these
      type(kind_info_t) :: info               !! what is reported

      integer :: k

      info = set%info()
      if (rubs .or. .not. allocated(info%channels)) return
      info%channels = pack(info%channels, [(index(friction_channels, " "//info%channels(k)%name//" ") == 0, &
                                            k=1, size(info%channels))])
   end function joint_info

   !> What a set of loose joints announces, with the channels of films or without.
   function loose_info(set) result(info)
      class(clearance_set_t), intent(in) :: set   !! the set
      type(kind_info_t) :: info                   !! what is reported

      integer :: k

      character(:), allocatable :: missing

      info = set%info()
      missing = film_channels
      if (allocated(set%laws%films)) missing = pressure_channels
      if (allocated(set%laws%films)) then
         if (set%laws%films%law%has_field()) return
      end if
      info%channels = pack(info%channels, [(index(missing, " "//info%channels(k)%name//" ") == 0, k=1, size(info%channels))])
   end function loose_info

   !> The channels of a joint with clearance that is taken as ideal.
   subroutine ideal_info(info)
      type(kind_info_t), intent(out) :: info  !! channels

      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the journal from that of the bearing")
      call add_channel(info, "force", "N", "world", 2, "force on the journal")
   end subroutine ideal_info

   !> Split the channels of a geometry into those of the joint and those of its contact.
   subroutine split_channels(info, joint_info, contact_info)
      type(kind_info_t), intent(in) :: info           !! the geometry
      type(kind_info_t), intent(out) :: joint_info    !! channels of the joint
      type(kind_info_t), intent(out) :: contact_info  !! channels of the contact

      integer :: k

      do k = 1, size(info%channels)
         associate (c => info%channels(k))
            if (index(contact_channels, " "//c%name//" ") > 0) then
               call add_channel(contact_info, c%name, c%unit, c%frame, c%components, c%help)
            else
               call add_channel(joint_info, c%name, c%unit, c%frame, c%components, c%help)
            end if
         end associate
      end do
   end subroutine split_channels

   !> Fill the catalogue with the values at a state: evaluates the right-hand side there.
   subroutine report_state(system, t, y, ydot, residual, catalogue, status)
      class(mechanism_t), intent(inout) :: system   !! the system
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(in) :: y(:)                      !! (n) state [any]
      real(wp), intent(out) :: ydot(:)                  !! (n) its derivative [any]
      real(wp), intent(in) :: residual                  !! of the ledger at the last step [J]
      type(catalogue_t), intent(inout) :: catalogue     !! values
      integer, intent(out) :: status                    !! of the evaluation

      call system%evaluate(t, y, ydot, status)
      if (status /= 0) return
      call system%linkage%set_state(t, y, ydot)
      if (system%linkage%rows%n > system%linkage%rows%n_solve) call system%linkage%find_reactions(t, system%loading%g)
      call fill_catalogue(system, t, y, residual, catalogue)
   end subroutine report_state

   !> Fill the catalogue from what the system holds: motion with accelerations, rows, rates of their
   !> violations, multipliers, states of the contacts.
   subroutine fill_catalogue(system, t, y, residual, catalogue)
      class(mechanism_t), intent(in) :: system      !! the system at the state
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(in) :: y(:)                      !! (n) state; without a ledger positions and velocities suffice [any]
      real(wp), intent(in) :: residual                  !! of the ledger at the last step [J]
      type(catalogue_t), intent(inout) :: catalogue     !! values

      type(energy_t) :: energy
      integer :: k

      if (system%ledger%has_energies .and. any(catalogue%groups%is_wanted .and. catalogue%groups%room == room_energy)) then
         energy = energy_of(system, y)
      end if
      do k = 1, size(catalogue%groups)
         associate (group => catalogue%groups(k))
            if (.not. group%is_wanted) cycle
            select case (group%room)
            case (room_bodies)
               call system%linkage%coordinates%report(group%channel%name, system%linkage%motion, group%data)
            case (room_joints)
               call report_joints(system, .false., catalogue, k)
            case (room_drivers)
               call report_joints(system, .true., catalogue, k)
            case (room_clearances, room_contacts)
               call report_clearances(system, group%channel%name, group%data)
            case (room_forces)
               call report_forces(system, t, group%channel%name, group%data)
            case (room_energy)
               group%data(1, 1) = energy_value(energy, group%channel%name, residual)
            end select
         end associate
      end do
   end subroutine fill_catalogue

   !> Values of a channel of the joints, or of the drivers: of the sets that have it.
   subroutine report_joints(system, is_driver, catalogue, group)
      class(mechanism_t), intent(in) :: system       !! the system
      logical, intent(in) :: is_driver               !! drivers, not joints
      type(catalogue_t), intent(inout) :: catalogue  !! values
      integer, intent(in) :: group                   !! number of the channel's group

      logical :: has
      integer :: k

      associate (linkage => system%linkage, channel => catalogue%groups(group)%channel%name)
         do k = 1, size(linkage%joints)
            associate (set => linkage%joints(k)%set)
               if (set%is_driver .neqv. is_driver) cycle
               has = catalogue%item_has(group, set%column(1))
               if (set%friction%n > 0) has = has .or. catalogue%item_has(group, set%column(set%friction%item(1)))
               if (.not. has) cycle
               call set%report(channel, linkage%motion, linkage%coordinates, linkage%rows, linkage%solution%lambda, &
                               linkage%solution%phi_dot, catalogue%groups(group)%data)
            end associate
         end do
      end associate
   end subroutine report_joints

   !> Values of a channel of the joints with clearance, loose ones first, then those taken as ideal.
   subroutine report_clearances(system, channel, values)
      class(mechanism_t), intent(in) :: system  !! the system
      character(*), intent(in) :: channel           !! the channel
      real(wp), intent(inout) :: values(:, :)       !! (components, items) values [any]

      real(wp) :: force(3), moment(3)
      integer :: i, k, n

      do k = 1, size(system%loose%sets)
         call system%loose%sets(k)%set%report(channel, system%linkage%motion, values)
      end do
      n = system%loose%n
      associate (linkage => system%linkage)
         do k = 1, size(linkage%ideal)
            do i = 1, linkage%ideal(k)%set%n
               n = n + 1
               select case (channel)
               case ("force")
                  call linkage%ideal(k)%set%reaction(i, linkage%motion, linkage%coordinates, linkage%rows, &
                                                     linkage%solution%lambda, force, moment)
                  values(:, n) = -force(:size(values, 1))
               case ("eccentricity")
                  values(:, n) = 0.0_wp
               end select
            end do
         end do
      end associate
   end subroutine report_clearances

   !> Values of a channel of the force elements.
   subroutine report_forces(system, t, channel, values)
      class(mechanism_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      character(*), intent(in) :: channel           !! the channel
      real(wp), intent(inout) :: values(:, :)       !! (components, items) values [any]

      integer :: column, k

      column = 0
      do k = 1, size(system%loading%forces)
         associate (set => system%loading%forces(k)%set)
            call set%report(channel, system%linkage%piece%inside(t), system%linkage%motion, values(:, column + 1:column + set%n))
            column = column + set%n
         end associate
      end do
   end subroutine report_forces

   !> One term of the ledger.
   pure real(wp) function energy_value(energy, channel, residual) result(value)
      type(energy_t), intent(in) :: energy   !! energies
      character(*), intent(in) :: channel    !! the term
      real(wp), intent(in) :: residual       !! at the last step [J]

      select case (channel)
      case ("kinetic"); value = energy%kinetic
      case ("potential"); value = energy%potential
      case ("elastic"); value = energy%elastic
      case ("drive_work"); value = energy%drive_work
      case ("load_work"); value = energy%load_work
      case ("stabilisation_work"); value = energy%stabilisation_work
      case ("dissipated_contact"); value = energy%dissipated_contact
      case ("dissipated_friction"); value = energy%dissipated_friction
      case ("dissipated_damper"); value = energy%dissipated_damper
      case ("dissipated_film"); value = energy%dissipated_film
      case default; value = residual
      end select
   end function energy_value

end module mechanism_report
