!> What a system reports: the values of its channels at a state.
module mechanism_report
   use balanced_report, only: report_balanced
   use catalogue, only: catalogue_t
   use force_set, only: force_set_t
   use kinds, only: wp
   use linkage, only: linkage_t
   use magnitudes, only: find_magnitudes
   use mechanism_catalogue, only: of_dissipated_contact, of_dissipated_damper, of_dissipated_film, of_dissipated_friction, &
      of_drive_work, of_elastic, of_kinetic, of_load_work, of_potential, of_stabilisation_work
   use mechanism_energy, only: energy_of, energy_t
   use mechanism, only: mechanism_t
   use motion, only: motion_t
   use point_contacts, only: of_force
   use readings, only: reading_plan_t, readings_t
   use request_report, only: report_requests
   implicit none (type, external)
   private
   public :: fill_catalogue, report_evaluated, report_state

contains

   !> Fill the catalogue with the values at a state: evaluates the right-hand side there.
   subroutine report_state(system, t, y, ydot, residual, catalogue, status)
      type(mechanism_t), intent(inout) :: system   !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(system%n)           !! (n) state [any]
      real(wp), intent(inout) :: ydot(system%n)     !! (n) its derivative; of quadratures where they are requested [any]
      real(wp), intent(in) :: residual              !! of the ledger at the last step [J]
      type(catalogue_t), intent(inout) :: catalogue !! values
      integer, intent(out) :: status                !! of the evaluation

      call system%evaluate(t, y, ydot, status)
      if (status == 0) call report_evaluated(system, t, y, ydot, residual, catalogue)
   end subroutine report_state

   !> The same at a state at which the right-hand side was just evaluated.
   subroutine report_evaluated(system, t, y, ydot, residual, catalogue)
      class(mechanism_t), intent(inout) :: system   !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(system%n)           !! (n) state [any]
      real(wp), intent(in) :: ydot(system%n)        !! (n) its derivative [any]
      real(wp), intent(in) :: residual              !! of the ledger at the last step [J]
      type(catalogue_t), intent(inout) :: catalogue !! values

      associate (linkage => system%linkage, plan => catalogue%readings)
         if (plan%balance%is_set) then
            call report_balanced(system, ydot, plan, size(catalogue%values), catalogue%values)
         else if (system%stabiliser%at_stages) then  ! the evaluation was that of a corrected state
            call linkage%set_state(t, y, ydot)
         else
            call linkage%set_acceleration(ydot)
         end if
         if (size(plan%rows%sets) > 0) then
            if (system%is_direct) call system%gather_loads()
            call linkage%find_reactions(t, system%loading%g, plan%rows)
         end if
         if (.not. plan%balance%is_set) call report_bodies(linkage, plan, catalogue%values)
         if (size(plan%of_others) > 0) call report_joints(linkage, plan%of_others, plan%others, catalogue%values)
      end associate
      call report_rest(system, t, y, residual, catalogue)
   end subroutine report_evaluated

   !> Fill the catalogue from what the system holds: motion with accelerations, rows, rates of their
   !> violations, multipliers, states of the contacts. Only what is bound is found; nothing is allocated.
   subroutine fill_catalogue(system, t, y, residual, catalogue)
      class(mechanism_t), intent(in) :: system       !! the system at the state
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(:)                   !! (n) state; without a ledger positions and velocities suffice [any]
      real(wp), intent(in) :: residual               !! of the ledger at the last step [J]
      type(catalogue_t), intent(inout) :: catalogue  !! values

      associate (plan => catalogue%readings)
         call report_bodies(system%linkage, plan, catalogue%values)
         call report_joints(system%linkage, plan%of_joints, plan%joints, catalogue%values)
      end associate
      call report_rest(system, t, y, residual, catalogue)
   end subroutine fill_catalogue

   !> Values of the bodies.
   subroutine report_bodies(linkage, plan, values)
      type(linkage_t), intent(in) :: linkage            !! the linkage at the state
      type(reading_plan_t), intent(in) :: plan          !! what is read
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      if (plan%bodies%n > 0) call linkage%coordinates%report(plan%bodies, linkage%motion, values)
   end subroutine report_bodies

   !> Values of joints and drivers, from rows and multipliers.
   subroutine report_joints(linkage, which, readings, values)
      type(linkage_t), intent(in) :: linkage            !! the linkage at the state
      integer, intent(in) :: which(:)                   !! (any) sets of which something is read
      type(readings_t), intent(in) :: readings(:)       !! (sets) what is read of them
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      integer :: k, m

      do m = 1, size(which)
         k = which(m)
         call linkage%joints(k)%set%report(readings(k), linkage%motion, linkage%coordinates, linkage%rows, &
                                           linkage%solution%lambda, linkage%solution%phi_dot, values)
      end do
   end subroutine report_joints

   !> Values of all else, expressions over channels last.
   subroutine report_rest(system, t, y, residual, catalogue)
      class(mechanism_t), intent(in) :: system       !! the system at the state
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(:)                   !! (n) state; without a ledger positions and velocities suffice [any]
      real(wp), intent(in) :: residual               !! of the ledger at the last step [J]
      type(catalogue_t), intent(inout) :: catalogue  !! values

      integer :: k, m

      associate (linkage => system%linkage, plan => catalogue%readings, values => catalogue%values)
         do m = 1, size(plan%of_clearance_joints)
            k = plan%of_clearance_joints(m)
            call system%clearance_joints%sets(k)%set%report(plan%clearance_joints(k), linkage%motion, values)
         end do
         if (size(plan%ideal) > 0) call report_ideal(system, plan%ideal, values)
         if (size(plan%forces) > 0) call report_forces(system, t, plan%forces, values)
         if (plan%points%n + plan%motions%n + plan%reactions%n > 0) call report_requests(system, t, plan, values)
         if (plan%energy%n > 0) call report_energy(system, y, residual, plan%energy, values)
         do m = 1, plan%states%n
            values(plan%states%of(m)%place + 1) = linkage%motion%states(plan%states%of(m)%code)
         end do
      end associate
      call find_magnitudes(catalogue)
      if (size(catalogue%formulas) > 0) call catalogue%work_out(t)
   end subroutine report_rest

   !> Values of the ledger.
   subroutine report_energy(system, y, residual, readings, values)
      class(mechanism_t), intent(in) :: system          !! the system
      real(wp), intent(in) :: y(:)                      !! (n) state; without a ledger positions and velocities suffice [any]
      real(wp), intent(in) :: residual                  !! of the ledger at the last step [J]
      type(readings_t), intent(in) :: readings          !! what is read of it
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      type(energy_t) :: energy
      integer :: m

      energy = energy_of(system, y)
      do m = 1, readings%n
         values(readings%of(m)%place + 1) = energy_value(energy, readings%of(m)%code, residual)
      end do
   end subroutine report_energy

   !> Values of the joints with clearance that are taken as ideal; they stand behind the others.
   subroutine report_ideal(system, readings, values)
      class(mechanism_t), intent(in) :: system     !! the system
      type(readings_t), intent(in) :: readings(:)  !! (sets) what is read of them
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      real(wp) :: force(3), moment(3)
      integer :: at, i, k, m, n

      n = system%clearance_joints%n
      associate (linkage => system%linkage)
         do k = 1, size(readings)
            do i = 1, linkage%ideal(k)%set%n
               n = n + 1
               do m = 1, readings(k)%n
                  associate (width => readings(k)%of(m)%width)
                     at = readings(k)%of(m)%place + width*(n - 1)
                     if (readings(k)%of(m)%code == of_force) then
                        call linkage%ideal(k)%set%reaction(i, linkage%motion, linkage%coordinates, linkage%rows, &
                                                           linkage%solution%lambda, force, moment)
                        values(at + 1:at + width) = -force(:width)
                     else
                        values(at + 1:at + width) = 0.0_wp
                     end if
                  end associate
               end do
            end do
         end do
      end associate
   end subroutine report_ideal

   !> Values of the force elements.
   subroutine report_forces(system, t, readings, values)
      class(mechanism_t), intent(in) :: system     !! the system
      real(wp), intent(in) :: t                    !! time [s]
      type(readings_t), intent(in) :: readings(:)  !! (sets) what is read of them
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      integer :: at, column, k, m

      column = 0
      do k = 1, size(readings)
         associate (set => system%loading%forces(k)%set)
            do m = 1, readings(k)%n
               associate (width => readings(k)%of(m)%width)
                  at = readings(k)%of(m)%place + width*column
                  call report_set(set, readings(k)%of(m)%code, system%linkage%segment%inside(t), system%linkage%motion, width, &
                                  set%n, values(at + 1:at + width*set%n))
               end associate
            end do
            column = column + set%n
         end associate
      end do
   end subroutine report_forces

   !> A channel of all elements of a set.
   subroutine report_set(set, code, t, motion, n, n_element, values)
      class(force_set_t), intent(in) :: set                !! the set
      integer, intent(in) :: code                          !! the channel
      real(wp), intent(in) :: t                            !! time [s]
      type(motion_t), intent(in) :: motion                 !! positions and velocities
      integer, intent(in) :: n                             !! components of the channel
      integer, intent(in) :: n_element                     !! elements of the set
      real(wp), intent(inout) :: values(n, n_element)      !! (n, n_element) values [any]

      call set%report(code, t, motion, values)
   end subroutine report_set

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
