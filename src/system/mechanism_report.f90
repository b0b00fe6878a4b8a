!> What a planar scene reports: its catalogue of channels, and their values at a state.
module mechanism_report
   use catalogue, only: catalogue_t, group_t, room_bodies, room_clearances, room_contacts, room_drivers, room_energy, room_forces, &
      room_joints
   use clearance_set, only: clearance_set_t
   use joint_friction, only: friction_channels
   use joint_set, only: joint_set_t, of_coordinate
   use kind_info, only: add_channel, kind_info_t
   use kinds, only: not_a_number, wp
   use linkage, only: linkage_t
   use mechanism_energy, only: energy_of, energy_t
   use mechanism, only: mechanism_t
   use point_contacts, only: named_channels, of_eccentricity, of_force
   use readings, only: reading_plan_t, readings_t
   use requests, only: source_joint
   use request_report, only: add_requests, bind_requests, report_requests
   use revolute_level, only: film_channels, pressure_channels
   implicit none (type, external)
   private
   public :: bind_channels, build_catalogue, energy_info, fill_catalogue, report_state

   ! channels of the ledger
   integer, parameter :: of_kinetic = 1               !! kinetic energy
   integer, parameter :: of_potential = 2             !! of gravity
   integer, parameter :: of_elastic = 3               !! stored in contacts and springs
   integer, parameter :: of_drive_work = 4            !! done by drivers
   integer, parameter :: of_load_work = 5             !! done by applied loads
   integer, parameter :: of_stabilisation_work = 6    !! done on the drift of constraints
   integer, parameter :: of_dissipated_contact = 7    !! lost by damping in contacts
   integer, parameter :: of_dissipated_friction = 8   !! lost by friction
   integer, parameter :: of_dissipated_damper = 9     !! lost in dampers
   integer, parameter :: of_dissipated_film = 10      !! taken by films
   integer, parameter :: of_residual = 11             !! what does not add up

   character(*), parameter :: contact_channels = &
      " penetration penetration_rate normal_force friction_force state contact_point"//named_channels
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
      call add_channel(info, "kinetic", "J", "none", 1, "kinetic energy", of_kinetic)
      call add_channel(info, "potential", "J", "none", 1, "potential energy of gravity, zero at the origin", of_potential)
      call add_channel(info, "elastic", "J", "none", 1, "elastic energy stored in contacts and springs", of_elastic)
      if (.not. with_works) return
      call add_channel(info, "drive_work", "J", "none", 1, "work done by drivers since the start", of_drive_work)
      call add_channel(info, "load_work", "J", "none", 1, "work done by applied loads since the start", of_load_work)
      call add_channel(info, "stabilisation_work", "J", "none", 1, "work of constraint forces on the drift since the start", &
                       of_stabilisation_work)
      call add_channel(info, "dissipated_contact", "J", "none", 1, "lost by damping in contacts since the start", &
                       of_dissipated_contact)
      call add_channel(info, "dissipated_friction", "J", "none", 1, "lost by friction since the start", of_dissipated_friction)
      call add_channel(info, "dissipated_damper", "J", "none", 1, "lost in dampers since the start", of_dissipated_damper)
      if (with_films) call add_channel(info, "dissipated_film", "J", "none", 1, "taken by lubricant films since the start", &
                       of_dissipated_film)
      call add_channel(info, "residual", "J", "none", 1, "what does not add up, at the end of the step that holds the sample", &
                       of_residual)
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
      call add_requests(system%requests, catalogue)
      call catalogue%allocate_data()
      call bind_channels(system, catalogue)
   end subroutine build_catalogue

   !> Bind the channels that are wanted to the sets that tell them: what a sample finds.
   subroutine bind_channels(system, catalogue)
      class(mechanism_t), intent(in) :: system        !! the system
      type(catalogue_t), intent(inout) :: catalogue   !! what it can report; its readings are set

      type(kind_info_t) :: info
      integer :: k

      call catalogue%spread_wants()
      call bind_requests(catalogue)
      associate (plan => catalogue%readings, joints => system%linkage%joints)
         call catalogue%bind(room_bodies, system%linkage%coordinates%bodies_info(), plan%bodies)
         call catalogue%bind(room_energy, energy_info(.true., .true.), plan%energy)
         if (allocated(plan%joints)) deallocate (plan%joints, plan%ideal, plan%loose, plan%forces)
         allocate (plan%joints(size(joints)), plan%ideal(size(system%linkage%ideal)))
         allocate (plan%loose(size(system%loose%sets)), plan%forces(size(system%loading%forces)))
         do k = 1, size(joints)
            info = joint_info(joints(k)%set, joints(k)%set%friction%n > 0)
            call catalogue%bind(merge(room_drivers, room_joints, joints(k)%set%is_driver), info, plan%joints(k), &
                                joints(k)%set%column)
         end do
         call ideal_info(info)
         do k = 1, size(plan%ideal)
            call catalogue%bind(room_clearances, info, plan%ideal(k))
         end do
         call list_rows(system, plan)
         do k = 1, size(plan%loose)
            call catalogue%bind(room_clearances, loose_info(system%loose%sets(k)%set), plan%loose(k))
         end do
         do k = 1, size(plan%forces)
            call catalogue%bind(room_forces, system%loading%forces(k)%set%info(), plan%forces(k))
         end do
      end associate
   end subroutine bind_channels

   !> The rows of joints and drivers that something is read of, and what they need of those that are not solved for.
   subroutine list_rows(system, plan)
      class(mechanism_t), intent(in) :: system         !! the system
      type(reading_plan_t), intent(inout) :: plan      !! what is read of its sets; their rows are listed

      logical :: is_read(system%linkage%rows%n)
      integer :: k, m

      is_read = .false.
      associate (joints => system%linkage%joints)
         do k = 1, size(joints)
            do m = 1, plan%joints(k)%n
               if (plan%joints(k)%code(m) /= of_coordinate) call mark(joints(k)%set, plan%joints(k)%item(m))
            end do
         end do
         do m = 1, plan%reactions%n
            associate (reaction => system%requests%reactions(plan%reactions%item(m)))
               if (reaction%source == source_joint) call mark(joints(reaction%slot)%set, reaction%item)
            end associate
         end do
      end associate
      call system%linkage%list_wanted(is_read, plan%rows)

   contains

      !> The rows of an item are read.
      subroutine mark(set, item)
         class(joint_set_t), intent(in) :: set   !! the set
         integer, intent(in) :: item             !! the item

         associate (first => set%first_row + (item - 1)*set%n_row_item)
            is_read(first + 1:first + set%n_row_item) = .true.
         end associate
      end subroutine mark

   end subroutine list_rows

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

      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the journal from that of the bearing", of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the journal", of_force)
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
               call add_channel(contact_info, c%name, c%unit, c%frame, c%components, c%help, c%code)
            else
               call add_channel(joint_info, c%name, c%unit, c%frame, c%components, c%help, c%code)
            end if
         end associate
      end do
   end subroutine split_channels

   !> Fill the catalogue with the values at a state: evaluates the right-hand side there.
   subroutine report_state(system, t, y, ydot, residual, catalogue, status)
      class(mechanism_t), intent(inout) :: system   !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in), contiguous :: y(:)      !! (n) state [any]
      real(wp), intent(inout), contiguous :: ydot(:)  !! (n) its derivative; of quadratures where they are wanted [any]
      real(wp), intent(in) :: residual              !! of the ledger at the last step [J]
      type(catalogue_t), intent(inout) :: catalogue !! values
      integer, intent(out) :: status                !! of the evaluation

      call system%evaluate(t, y, ydot, status)
      if (status /= 0) return
      if (system%way%at_stages) then  ! the evaluation was that of a corrected state
         call system%linkage%set_state(t, y, ydot)
      else
         call system%linkage%set_acceleration(ydot)
      end if
      if (size(catalogue%readings%rows%sets) > 0) then
         call system%linkage%find_reactions(t, system%loading%g, catalogue%readings%rows)
      end if
      call fill_catalogue(system, t, y, residual, catalogue)
   end subroutine report_state

   !> Fill the catalogue from what the system holds: motion with accelerations, rows, rates of their
   !> violations, multipliers, states of the contacts. Only what is bound is found; nothing is allocated.
   subroutine fill_catalogue(system, t, y, residual, catalogue)
      class(mechanism_t), intent(in) :: system       !! the system at the state
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(:)                   !! (n) state; without a ledger positions and velocities suffice [any]
      real(wp), intent(in) :: residual               !! of the ledger at the last step [J]
      type(catalogue_t), intent(inout) :: catalogue  !! values

      type(energy_t) :: energy
      integer :: k, m

      associate (linkage => system%linkage, plan => catalogue%readings, groups => catalogue%groups)
         if (plan%bodies%n > 0) call linkage%coordinates%report(plan%bodies, linkage%motion, groups)
         do k = 1, size(plan%joints)
            if (plan%joints(k)%n == 0) cycle
            call linkage%joints(k)%set%report(plan%joints(k), linkage%motion, linkage%coordinates, linkage%rows, &
                                              linkage%solution%lambda, linkage%solution%phi_dot, groups)
         end do
         do k = 1, size(plan%loose)
            if (plan%loose(k)%n > 0) call system%loose%sets(k)%set%report(plan%loose(k), linkage%motion, groups)
         end do
         call report_ideal(system, plan%ideal, groups)
         call report_forces(system, t, plan%forces, groups)
         call report_requests(system, t, plan, groups)
         if (plan%energy%n > 0) energy = energy_of(system, y)
         do m = 1, plan%energy%n
            groups(plan%energy%group(m))%data(1, 1) = energy_value(energy, plan%energy%code(m), residual)
         end do
      end associate
      call catalogue%work_out(t)
   end subroutine fill_catalogue

   !> Values of the joints with clearance that are taken as ideal; they stand behind the loose ones.
   subroutine report_ideal(system, readings, groups)
      class(mechanism_t), intent(in) :: system     !! the system
      type(readings_t), intent(in) :: readings(:)  !! (sets) what is read of them
      type(group_t), intent(inout) :: groups(:)    !! (groups) values

      real(wp) :: force(3), moment(3)
      integer :: i, k, m, n

      n = system%loose%n
      associate (linkage => system%linkage)
         do k = 1, size(readings)
            do i = 1, linkage%ideal(k)%set%n
               n = n + 1
               do m = 1, readings(k)%n
                  associate (values => groups(readings(k)%group(m))%data)
                     if (readings(k)%code(m) == of_force) then
                        call linkage%ideal(k)%set%reaction(i, linkage%motion, linkage%coordinates, linkage%rows, &
                                                           linkage%solution%lambda, force, moment)
                        values(:, n) = -force(:size(values, 1))
                     else
                        values(:, n) = 0.0_wp
                     end if
                  end associate
               end do
            end do
         end do
      end associate
   end subroutine report_ideal

   !> Values of the force elements.
   subroutine report_forces(system, t, readings, groups)
      class(mechanism_t), intent(in) :: system     !! the system
      real(wp), intent(in) :: t                    !! time [s]
      type(readings_t), intent(in) :: readings(:)  !! (sets) what is read of them
      type(group_t), intent(inout) :: groups(:)    !! (groups) values

      integer :: column, k, m

      column = 0
      do k = 1, size(readings)
         associate (set => system%loading%forces(k)%set)
            do m = 1, readings(k)%n
               associate (values => groups(readings(k)%group(m))%data)
                  call set%report(readings(k)%code(m), system%linkage%piece%inside(t), system%linkage%motion, &
                                  values(:, column + 1:column + set%n))
               end associate
            end do
            column = column + set%n
         end associate
      end do
   end subroutine report_forces

   !> One term of the ledger.
   pure real(wp) function energy_value(energy, code, residual) result(value)
      type(energy_t), intent(in) :: energy   !! energies
      integer, intent(in) :: code            !! the term
      real(wp), intent(in) :: residual       !! at the last step [J]

      select case (code)
      case (of_kinetic); value = energy%kinetic
      case (of_potential); value = energy%potential
      case (of_elastic); value = energy%elastic
      case (of_drive_work); value = energy%drive_work
      case (of_load_work); value = energy%load_work
      case (of_stabilisation_work); value = energy%stabilisation_work
      case (of_dissipated_contact); value = energy%dissipated_contact
      case (of_dissipated_friction); value = energy%dissipated_friction
      case (of_dissipated_damper); value = energy%dissipated_damper
      case (of_dissipated_film); value = energy%dissipated_film
      case default; value = residual
      end select
   end function energy_value

end module mechanism_report
