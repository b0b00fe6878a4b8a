!> Drivers whose velocity jumps: what the bodies do at that instant.
!>
!> Where Phi_t jumps, as that of a driver {abs(t - 1 s)} does, the velocities jump with it. Constraints alone act in that instant,
!> by impulses Lambda, and loads and contacts, whose forces are finite, do not:
!>
!> M (v+ - v-) = -Phi_q^T Lambda,   Phi_q v+ + Phi_t+ = 0
!>
!> v+ is the motion nearest to v- in the metric of the masses. What the kinetic energy gains is work of the drivers.
!> Rows that are violated, because the driver itself jumps (no body can follow that; the stabilisation brings it back), get the jump
!> of Phi_t alone: their velocity is that of the way back.
!> Source: Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems (1989), section 11.6 (impulsive motion).
!> Limits: bodies that are known functions of time have smooth drivers, and no jump.
module velocity_jumps
   use contact_places, only: work_drive
   use floors, only: at_rest
   use integrator, only: integrator_t
   use kinds, only: wp
   use mechanism_energy, only: mechanical_energy
   use mechanism, only: mechanism_t
   use archive, only: archive_t
   use text, only: append_text, counted, real_text, text_t
   implicit none (type, external)
   private
   public :: velocity_jumps_t

   !> What is remembered of them.
   type :: velocity_jumps_t
      integer :: n = 0                                 !! jumps so far that are of note
      integer :: row = 0                               !! row of the maximum of them
      real(wp) :: t = 0.0_wp                           !! when it was [s]
      real(wp) :: jump = 0.0_wp                        !! how far its Phi_t jumped [m/s or rad/s]
      real(wp) :: work = 0.0_wp                        !! work of the drivers in all of them [J]
      real(wp), allocatable, private :: phi_t(:)       !! (rows) Phi_t before the instant [m/s or rad/s]
   contains
      procedure :: before_instant
      procedure :: after_instant
      procedure :: warn
      procedure :: save => save_jumps
      procedure :: load => load_jumps
   end type velocity_jumps_t

   real(wp), parameter :: is_violated = 1.0e-6_wp  !! violation of a row whose driver has jumped, of the size of the bodies [1]

contains

   !> Note the rates that the drivers have before an instant.
   subroutine before_instant(self, system, method)
      class(velocity_jumps_t), intent(inout) :: self   !! what is remembered
      type(mechanism_t), intent(inout) :: system   !! the system, still before the instant
      class(integrator_t), intent(in) :: method        !! the integrator, at the instant

      associate (linkage => system%linkage)
         if (linkage%rows%n_solve == 0) return
         call linkage%set_motion(method%t, method%step%y1)
         call linkage%evaluate_rows(method%t)
         self%phi_t = linkage%rows%phi_t(:linkage%rows%n_solve)
      end associate
   end subroutine before_instant

   !> Behind the instant: let the velocities jump with the rates of the drivers.
   subroutine after_instant(self, system, method, status)
      class(velocity_jumps_t), intent(inout) :: self   !! what is remembered
      type(mechanism_t), intent(inout) :: system   !! the system, behind the instant
      class(integrator_t), intent(inout) :: method     !! the integrator, at the instant; its state jumps
      integer, intent(out) :: status                   !! 0: done

      real(wp) :: before, gained
      real(wp), allocatable :: jump(:)
      integer :: k, z

      status = 0
      associate (linkage => system%linkage, n => system%linkage%rows%n_solve, rows => system%linkage%rows, &
                 solution => system%linkage%solution)
         if (n == 0) return
         call linkage%set_motion(method%t, method%step%y1)
         call linkage%evaluate_rows(method%t)
         jump = abs(rows%phi_t(:n) - self%phi_t)
         if (.not. any(jump > 4.0_wp*epsilon(1.0_wp)*abs(self%phi_t))) return
         before = mechanical_energy(system)
         solution%b(:n) = merge(self%phi_t - rows%phi_t(:n), -solution%phi_dot(:n), &
                                solution%row_weight(:n)*abs(rows%phi(:n)) > is_violated)
         call linkage%solve_rows(status)
         if (status /= 0) return
         call linkage%add_change(.true., method%step%y1)
         call linkage%set_motion(method%t, method%step%y1)
         gained = mechanical_energy(system) - before
         if (system%ledger%is_kept) then
            z = system%in_state(work_drive)
            method%step%y1(z) = method%step%y1(z) + gained
         end if
         k = maxloc(solution%row_weight(:n)*jump, dim=1)
         if (.not. solution%row_weight(k)*jump(k) > at_rest*linkage%scales%pace) return
         self%n = self%n + 1
         self%work = self%work + gained
         if (.not. jump(k) > self%jump) return
         self%row = k
         self%t = method%t
         self%jump = jump(k)
      end associate
   end subroutine after_instant

   !> Report of them at the end of a run.
   subroutine warn(self, system, warnings)
      class(velocity_jumps_t), intent(in) :: self             !! what is remembered
      type(mechanism_t), intent(in) :: system             !! the system
      type(text_t), allocatable, intent(inout) :: warnings(:) !! the line is added

      if (self%n == 0) return
      call append_text(warnings, "driver velocities jump at "//counted(self%n, "time point", "time points")// &
                       ", the largest at '"//system%linkage%row_name(self%row)//"', by "//real_text(self%jump, 3)// &
                       trim(merge(" rad/s", " m/s  ", system%linkage%rows%is_angle(self%row)))//" at t = "//real_text(self%t, 6)// &
                       " s; the bodies follow instantaneously and take "//real_text(self%work, 3)//" J from the drivers")
   end subroutine warn

   !> Write what is remembered.
   subroutine save_jumps(self, archive)
      class(velocity_jumps_t), intent(in) :: self   !! what is remembered
      type(archive_t), intent(inout) :: archive           !! receives it

      call archive%put([self%n, self%row])
      call archive%put([self%t, self%jump, self%work])
   end subroutine save_jumps

   !> Take it back.
   subroutine load_jumps(self, archive)
      class(velocity_jumps_t), intent(inout) :: self  !! what is remembered
      type(archive_t), intent(inout) :: archive             !! holds it

      call archive%get(self%n)
      call archive%get(self%row)
      call archive%get(self%t)
      call archive%get(self%jump)
      call archive%get(self%work)
   end subroutine load_jumps

end module velocity_jumps
