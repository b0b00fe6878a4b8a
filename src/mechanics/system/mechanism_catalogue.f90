!> The catalogue of a system: its items and channels, and which of them are read of which set.
!>
!> Names are compared when it is built, once for each set; what a set reports is a list of numbers from then on (`offer`), of which
!> those are bound that someone needs.
module mechanism_catalogue
   use balanced_report, only: bind_balance
   use catalogue, only: catalogue_t, names_of_channels
   use groups_of_catalogue, only: group_bodies, group_clearances, group_contacts, group_drivers, group_energy, group_forces, &
        group_joints, group_states
   use joint_friction, only: friction_channels
   use joint_set, only: joint_set_t, of_coordinate
   use kind_info, only: add_channel, channel_t, kind_info_t
   use kinds, only: not_a_number
   use magnitudes, only: spread_to_vectors
   use mechanism, only: mechanism_t
   use point_contacts, only: named_channels, of_eccentricity, of_force
   use readings, only: reading_plan_t
   use requests, only: source_joint
   use request_report, only: add_requests, bind_requests
   use revolute_level, only: film_channels, pressure_channels
   use text, only: text_t
   implicit none (type, external)
   private
   public :: bind_channels, build_catalogue, energy_info
   public :: of_dissipated_contact, of_dissipated_damper, of_dissipated_film, of_dissipated_friction, of_drive_work, of_elastic, &
      of_kinetic, of_load_work, of_potential, of_stabilisation_work

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
      !! channels of a clearance joint that belong to its contact

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
      call add_channel(info, "drive_work", "J", "none", 1, "work of drivers since t = 0", of_drive_work)
      call add_channel(info, "load_work", "J", "none", 1, "work of applied loads since t = 0", of_load_work)
      call add_channel(info, "stabilisation_work", "J", "none", 1, "work of constraint forces due to constraint drift since t "// &
         "= 0", &
                       of_stabilisation_work)
      call add_channel(info, "dissipated_contact", "J", "none", 1, "energy dissipated by damping in contacts since t = 0", &
                       of_dissipated_contact)
      call add_channel(info, "dissipated_friction", "J", "none", 1, "energy dissipated by friction since t = 0", &
         of_dissipated_friction)
      call add_channel(info, "dissipated_damper", "J", "none", 1, "energy dissipated in dampers since t = 0", of_dissipated_damper)
      if (with_films) call add_channel(info, "dissipated_film", "J", "none", 1, "energy dissipated by lubricant films since t "// &
         "= 0", &
                       of_dissipated_film)
      call add_channel(info, "residual", "J", "none", 1, "residual of the energy balance, at the end of the step that contains "// &
         "the sample", &
                       of_residual)
   end function energy_info

   !> All items and channels of a system.
   subroutine build_catalogue(system, catalogue)
      class(mechanism_t), intent(in) :: system        !! the system
      type(catalogue_t), intent(out) :: catalogue     !! what it can report

      type(kind_info_t) :: info
      character(:), allocatable :: channels
      integer :: i, k

      catalogue%n_coordinates = system%linkage%coordinates%n_axis
      info = system%linkage%coordinates%bodies_info()
      channels = names_of_channels(info)
      do k = 1, system%linkage%bodies%n
         call catalogue%add_item(group_bodies, system%linkage%bodies%names(k)%s, channels=channels)
      end do
      call catalogue%add_kind(group_bodies, info)
      call catalogue%list(group_bodies, info, catalogue%offer%bodies)
      call add_joints(system, catalogue)
      call add_clearance_joint(system, catalogue)
      allocate (catalogue%offer%ideal(size(system%linkage%ideal)))
      do k = 1, size(system%linkage%ideal)
         call ideal_info(info)
         call catalogue%add_kind(group_clearances, info)
         call catalogue%list(group_clearances, info, catalogue%offer%ideal(k))
         do i = 1, system%linkage%ideal(k)%set%n
            call catalogue%add_item(group_clearances, system%linkage%ideal(k)%set%names(i)%s, channels=names_of_channels(info))
         end do
      end do
      allocate (catalogue%offer%forces(size(system%loading%forces)))
      do k = 1, size(system%loading%forces)
         associate (set => system%loading%forces(k)%set)
            info = set%info()
            call catalogue%add_kind(group_forces, info)
            call catalogue%list(group_forces, info, catalogue%offer%forces(k))
            do i = 1, set%n
               call catalogue%add_item(group_forces, set%names(i)%s, channels=names_of_channels(info))
            end do
         end associate
      end do
      if (system%ledger%has_energies) then
         call catalogue%add_item(group_energy, "energy")
         info = energy_info(system%ledger%is_kept, system%clearance_joints%has_films)
         call catalogue%add_kind(group_energy, info)
         call catalogue%list(group_energy, info, catalogue%offer%energy)
      end if
      if (system%loading%states%n > 0) then
         call catalogue%add_item(group_states, "state")
         info = system%loading%states%info()
         call catalogue%add_kind(group_states, info)
         call catalogue%list(group_states, info, catalogue%offer%states)
      end if
      call add_requests(system%requests, catalogue)
      call catalogue%allocate_data()
      call bind_channels(system, catalogue)
   end subroutine build_catalogue

   !> Bind the channels that are requested to the sets that report them: what a sample finds.
   subroutine bind_channels(system, catalogue)
      class(mechanism_t), intent(in) :: system        !! the system
      type(catalogue_t), intent(inout) :: catalogue   !! what it can report; its readings are set

      integer :: k

      call catalogue%spread_wants()
      call spread_to_vectors(catalogue)
      call bind_requests(catalogue)
      associate (plan => catalogue%readings, offer => catalogue%offer)
         call catalogue%bind(offer%bodies, plan%bodies, [(k, k=1, system%linkage%bodies%n)])
         call catalogue%bind(offer%energy, plan%energy)
         call catalogue%bind(offer%states, plan%states)
         if (allocated(plan%joints)) deallocate (plan%joints, plan%ideal, plan%clearance_joints, plan%forces)
         allocate (plan%joints(size(offer%joints)), plan%ideal(size(offer%ideal)))
         allocate (plan%clearance_joints(size(offer%clearance_joints)), plan%forces(size(offer%forces)))
         do k = 1, size(plan%joints)
            call catalogue%bind(offer%joints(k), plan%joints(k), system%linkage%joints(k)%set%column)
         end do
         do k = 1, size(plan%ideal)
            call catalogue%bind(offer%ideal(k), plan%ideal(k))
         end do
         call bind_balance(system, plan)
         call list_rows(system, plan)
         do k = 1, size(plan%clearance_joints)
            call catalogue%bind(offer%clearance_joints(k), plan%clearance_joints(k))
         end do
         do k = 1, size(plan%forces)
            call catalogue%bind(offer%forces(k), plan%forces(k))
         end do
         plan%of_joints = pack([(k, k=1, size(plan%joints))], plan%joints%n > 0)
         plan%of_clearance_joints = pack([(k, k=1, size(plan%clearance_joints))], plan%clearance_joints%n > 0)
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
            do m = 1, plan%others(k)%n
               if (plan%others(k)%of(m)%code /= of_coordinate) call mark(joints(k)%set, plan%others(k)%of(m)%item)
            end do
         end do
         do m = 1, plan%reactions%n
            associate (reaction => system%requests%reactions(plan%reactions%of(m)%item))
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

   !> Joints and drivers, each in the order of their columns; those with friction have the channels of friction.
   subroutine add_joints(system, catalogue)
      class(mechanism_t), intent(in) :: system       !! the system
      type(catalogue_t), intent(inout) :: catalogue  !! items and channels are added

      type(kind_info_t) :: info
      type(text_t) :: channels(2, size(system%linkage%joints))
      integer :: driver, k, n

      allocate (catalogue%offer%joints(size(system%linkage%joints)))
      do k = 1, size(system%linkage%joints)
         associate (set => system%linkage%joints(k)%set)
            info = set%info()
            if (set%friction%n > 0) channels(2, k)%s = names_of_channels(info)
            if (set%friction%n == 0) call take_out(friction_channels, info)
            call catalogue%add_kind(merge(group_drivers, group_joints, set%is_driver), info)
            call catalogue%list(merge(group_drivers, group_joints, set%is_driver), info, catalogue%offer%joints(k))
            if (set%friction%n > 0) call take_out(friction_channels, info)
            channels(1, k)%s = names_of_channels(info)
         end associate
      end do
      do driver = 0, 1
         n = 0
         do k = 1, size(system%linkage%joints)
            if (system%linkage%joints(k)%set%is_driver .eqv. driver == 1) n = n + system%linkage%joints(k)%set%n
         end do
         call add_items(driver == 1, n)
      end do

   contains

      !> The items of all sets of joints, or of drivers.
      subroutine add_items(is_driver, n)
         logical, intent(in) :: is_driver   !! drivers, not joints
         integer, intent(in) :: n           !! number of items

         integer :: i, item(n), k, has_friction, slot(n)

         do k = 1, size(system%linkage%joints)
            associate (set => system%linkage%joints(k)%set)
               if (set%is_driver .neqv. is_driver) cycle
               slot(set%column) = k
               item(set%column) = [(i, i=1, set%n)]
            end associate
         end do
         do i = 1, n
            associate (set => system%linkage%joints(slot(i))%set)
               has_friction = merge(2, 1, any(set%friction%item == item(i)))
               call catalogue%add_item(merge(group_drivers, group_joints, is_driver), set%names(item(i))%s, &
                                       channels=channels(has_friction, slot(i))%s)
            end associate
         end do
      end subroutine add_items

   end subroutine add_joints

   !> Clearance joints and their contacts, with the channels of films where there are some.
   subroutine add_clearance_joint(system, catalogue)
      class(mechanism_t), intent(in) :: system       !! the system
      type(catalogue_t), intent(inout) :: catalogue  !! items and channels are added

      type(kind_info_t) :: info, of_contact, of_joint
      character(:), allocatable :: contact_names, joint_names, missing
      integer :: c, i, k

      allocate (catalogue%offer%clearance_joints(size(system%clearance_joints%sets)))
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            info = set%info()
            missing = film_channels
            if (allocated(set%laws%films)) then
               missing = pressure_channels
               if (set%laws%films%law%has_field()) missing = ""
            end if
            call take_out(missing, info)
            call split_channels(info, of_joint, of_contact)
            call catalogue%add_kind(group_clearances, of_joint)
            call catalogue%add_kind(group_contacts, of_contact)
            call catalogue%list(group_clearances, info, catalogue%offer%clearance_joints(k))
            joint_names = names_of_channels(of_joint)
            contact_names = names_of_channels(of_contact)
            do i = 1, set%n
               call catalogue%add_item(group_clearances, set%names(i)%s, channels=joint_names, &
                                       radius=merge(set%items%pairs(i)%clearance, not_a_number(), set%traits%is_round))
               do c = 1, set%n_contact_item
                  call catalogue%add_item(group_contacts, set%names(i)%s, label=set%label_of(c), channels=contact_names)
               end do
            end do
         end associate
      end do
   end subroutine add_clearance_joint

   !> Take some channels out of what a kind reports.
   pure subroutine take_out(names, info)
      character(*), intent(in) :: names          !! their names, each between blanks
      type(kind_info_t), intent(inout) :: info   !! the kind

      type(channel_t), allocatable :: kept(:)
      logical, allocatable :: stays(:)
      integer :: k, n

      if (.not. allocated(info%channels) .or. len(names) == 0) return
      stays = [(index(names, " "//info%channels(k)%name//" ") == 0, k=1, size(info%channels))]
      if (all(stays)) return
      allocate (kept(count(stays)))
      n = 0
      do k = 1, size(stays)
         if (.not. stays(k)) cycle
         n = n + 1
         kept(n)%components = info%channels(k)%components
         kept(n)%code = info%channels(k)%code
         call move_alloc(info%channels(k)%name, kept(n)%name)
         call move_alloc(info%channels(k)%unit, kept(n)%unit)
         call move_alloc(info%channels(k)%frame, kept(n)%frame)
         call move_alloc(info%channels(k)%help, kept(n)%help)
      end do
      call move_alloc(kept, info%channels)
   end subroutine take_out

   !> The channels of a joint with clearance that is taken as ideal.
   subroutine ideal_info(info)
      type(kind_info_t), intent(out) :: info  !! channels

      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the journal relative to that of the bearing", &
         of_eccentricity)
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

end module mechanism_catalogue
