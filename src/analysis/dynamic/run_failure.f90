!> Why a motion in time cannot be followed to its end, as text.
module run_failure
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use errors, only: error_t, exit_file, exit_integration, set_error
   use fixed_step, only: too_long
   use integrator, only: advance_failed_evaluation, advance_no_memory, advance_too_many_evaluations, &
      advance_too_many_steps, integrator_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use motion, only: loads_t
   use readings, only: wanted_rows_t
   use shaky, only: dead_centre_line
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: constraints_lost, describe_failure, events_without_end, film_ended, guard_reached, off_branch, &
      stopped_words, time_used_up

   ! failures beside those of `advance`
   integer, parameter :: constraints_lost = -100    !! a violation beyond all measure
   integer, parameter :: events_without_end = -101  !! event follows event while hardly any time passes
   integer, parameter :: guard_reached = -102       !! what no mechanism does, as the guards say
   integer, parameter :: time_used_up = -103        !! the processor time allowed
   integer, parameter :: film_ended = -104          !! a film that nothing helps to hold surfaces apart
   integer, parameter :: off_branch = -105               !! a joint on another branch, or where its rows say nothing

contains

   !> Say when, where and why the integration cannot continue, and what to try.
   !> Length: a line of the message after the other.
   subroutine describe_failure(system, method, status, error, reason)
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator; fixed steps: its last step is lost
      integer, intent(in) :: status                       !! how it failed
      type(error_t), allocatable, intent(out) :: error    !! the message
      character(*), intent(in), optional :: reason        !! of a guard: what it says

      type(wanted_rows_t) :: wanted
      real(wp), allocatable :: ydot(:)
      character(:), allocatable :: message, where_singular
      integer :: code, row

      where_singular = ""
      if (system%is_direct) call system%gather_loads()
      associate (linkage => system%linkage, bad_row => system%linkage%solution%bad_row)
         if (bad_row > 0) where_singular = ": they are singular; check joint or driver '"//linkage%row_name(bad_row)//"'"
         if (linkage%rows%n > linkage%rows%n_solve) then
            call linkage%list_wanted(spread(.true., 1, linkage%rows%n), wanted)
            call linkage%find_reactions(linkage%reduced%known%t, system%loading%g, wanted)
         end if
         if (bad_row == 0) where_singular = not_finite(system)
      end associate
      select case (status)
      case (advance_too_many_steps)
         message = "the run reached the maximum number of steps (maximum_steps, MXSTEP)"
      case (advance_too_many_evaluations)
         message = "the run reached the maximum number of evaluations (maximum_evaluations, MXFCN)"
      case (advance_failed_evaluation)
         message = "the equations of motion cannot be solved"//where_singular
      case (constraints_lost)
         message = "the constraints are violated: a joint is open by a tenth of the size of the bodies, or an angle error "// &
            "reached one radian"
      case (events_without_end)
         message = "events accumulate at '"//last_event(system, method)//"' without progress in time"
      case (guard_reached, film_ended, off_branch)
         message = reason
      case (advance_no_memory)
         message = "not enough memory for the matrices of the method, of "//to_text(system%n)//" states"
      case (time_used_up)
         message = "the run exceeded its CPU time limit (limit_cpu)"
      case default
         message = "the error exceeds the tolerance even at the minimum step"
         if (where_singular /= "") message = message//", the equations of motion have no solution"//where_singular
      end select
      message = message//new_line("a")//"  = at t = "//real_text(method%t, 9)//" s, after "//to_text(method%count%n_steps)// &
                " steps, the last of "//real_text(method%step%h, 3)//" s"
      allocate (ydot(system%n), source=0.0_wp)
      call system%evaluate(method%t, method%step%y1, ydot, code)
      if (system%linkage%rows%n_solve > 0) then
         row = maxloc(abs(system%linkage%rows%phi(:system%linkage%rows%n_solve)), dim=1)
         message = message//new_line("a")//"  = largest constraint violation there: '"//system%linkage%row_name(row)//"', "// &
            "violated by "// &
                   real_text(abs(system%linkage%rows%phi(row)), 3)//trim(merge(" rad", " m  ", system%linkage%rows%is_angle(row)))
      end if
      if (all(status /= [advance_too_many_steps, advance_too_many_evaluations, advance_no_memory, time_used_up, guard_reached, &
                         film_ended])) message = message//dead_centre_line(system%linkage)
      message = message//wedged_joint(system)//deepest_contact(system, method)//new_line("a")// &
                "  = results up to the last output time are saved; "
      call blame_step(system, method, status, message)
      call set_error(error, merge(exit_file, exit_integration, status == advance_no_memory), message)
   end subroutine describe_failure

   !> What to try; and where a fixed step is too long, that first: whatever else was noticed came of it.
   subroutine blame_step(system, method, status, message)
      type(mechanism_t), intent(inout) :: system              !! the system
      class(integrator_t), intent(inout) :: method            !! the integrator; fixed steps: its last step is lost
      integer, intent(in) :: status                           !! how it failed
      character(:), allocatable, intent(inout) :: message     !! what is known

      character(:), allocatable :: cause

      cause = ""
      select case (status)
      case (advance_failed_evaluation, constraints_lost, events_without_end, guard_reached, off_branch)
         cause = too_long(system, method)
      end select
      if (cause == "") then
         message = message//advice(status)
      else
         message = cause//new_line("a")//"  = reported by: "//message//"use a shorter step, or a method with step-size control"
      end if
   end subroutine blame_step

   !> What is not a finite number after an evaluation that failed: a driver, or a load.
   function not_finite(system) result(words)
      type(mechanism_t), intent(in) :: system   !! the system, evaluated
      character(:), allocatable :: words            !! to follow "cannot be solved", blank if all is finite

      integer :: k, pass

      words = ""
      do pass = 1, 2  ! first the rows that are functions of time themselves
         associate (rows => system%linkage%rows)
            do k = 1, rows%n
               if (ieee_is_finite(rows%phi_t(k)) &
                   .and. (pass == 1 .or. (ieee_is_finite(rows%phi(k)) .and. ieee_is_finite(rows%gam(k))))) cycle
               words = ": '"//system%linkage%row_name(k)//"', or one of its derivatives, is not finite"
               return
            end do
         end associate
      end do
      do k = 1, system%linkage%bodies%n
         if (all(ieee_is_finite(system%loading%g(:, k)))) cycle
         words = bad_element(system)
         if (words /= "") return
         words = ": a load on body '"//system%linkage%bodies%names(k)%s//"' is not finite"
         return
      end do
   end function not_finite

   !> The force element whose load is not a finite number at the motion that was evaluated, or those of one kind among which it is.
   function bad_element(system) result(words)
      type(mechanism_t), intent(in) :: system   !! the system, evaluated
      character(:), allocatable :: words        !! to follow "cannot be solved", blank if it is none

      type(loads_t) :: loads
      real(wp) :: power
      integer :: i, k

      words = ""
      associate (linkage => system%linkage, n => system%linkage%bodies%n)
         allocate (loads%force(3, 0:n), loads%moment(3, 0:n))
         do k = 1, size(system%loading%forces)
            associate (set => system%loading%forces(k)%set)
               loads%force = 0.0_wp
               loads%moment = 0.0_wp
               power = 0.0_wp
               call set%evaluate(linkage%segment%inside(linkage%motion%t), linkage%motion, loads, power)
               do i = 1, set%n
                  associate (bodies => set%bodies_of(i))
                     if (all(ieee_is_finite(loads%force(:, bodies))) .and. all(ieee_is_finite(loads%moment(:, bodies)))) cycle
                  end associate
                  words = words//trim(merge(" or", ":  ", words /= ""))//" '"//set%names(i)%s//"'"
               end do
            end associate
            if (words == "") cycle
            words = ": the load of force element"//words(2:)//" is not finite"
            return
         end do
      end associate
   end function bad_element

   !> The ideal joint for which no friction force was found.
   function wedged_joint(system) result(words)
      type(mechanism_t), intent(in) :: system   !! the system, evaluated
      character(:), allocatable :: words        !! a line of the message, blank if there is none

      words = ""
      if (system%friction%rubbing%wedged == 0) return
      associate (set => system%linkage%joints(system%friction%rubbing%slot(system%friction%rubbing%wedged))%set, &
                 m => system%friction%rubbing%place(system%friction%rubbing%wedged))
         words = new_line("a")//"  = friction in '"//set%names(set%friction%item(m))%s// &
                 "' raises its own normal force: the joint jams"
      end associate
   end function wedged_joint

   !> The touching contact with the maximum penetration.
   function deepest_contact(system, method) result(words)
      type(mechanism_t), intent(inout) :: system   !! the system
      class(integrator_t), intent(in) :: method        !! the integrator
      character(:), allocatable :: words               !! a line of the message, blank if nothing touches

      real(wp) :: delta(system%clearance_joints%n_contact), deepest, rate(system%clearance_joints%n_contact)
      integer :: i, k

      words = ""
      if (system%clearance_joints%n == 0) return
      deepest = -1.0_wp
      call system%events(method%t, method%step%y1, delta, rate)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching .or. -delta(set%before%contacts + i) <= deepest) cycle
               deepest = -delta(set%before%contacts + i)
               words = new_line("a")//"  = deepest contact there: '"//set%names(set%item_of(i))%s//"', penetration "// &
                       real_text(deepest, 3)//" m"
            end do
         end associate
      end do
   end function deepest_contact

   !> The joint of the last event.
   function last_event(system, method) result(name)
      type(mechanism_t), intent(in) :: system   !! the system
      class(integrator_t), intent(in) :: method     !! the integrator, at an event
      character(:), allocatable :: name             !! name of the joint

      integer :: contact, slot

      call system%find_contact(method%events%happened(1), slot, contact)
      associate (set => system%clearance_joints%sets(slot)%set)
         name = set%names(set%item_of(contact))%s
      end associate
   end function last_event

   !> What to try after a failure.
   pure function advice(status) result(words)
      integer, intent(in) :: status         !! how the integration failed
      character(:), allocatable :: words    !! what to try

      select case (status)
      case (advance_too_many_steps, advance_too_many_evaluations, time_used_up)
         words = "raise the limit, or use a larger tolerance"
      case (advance_no_memory)
         words = "use method = verner or adams, which need no matrices"
      case (constraints_lost)
         words = "reduce the tolerance"
      case (events_without_end)
         words = "reduce the tolerance; with stick-slip friction, use method = radau or a friction law without sticking"
      case (guard_reached)
         words = "check loads, drivers and clearances, or change the guard in section [guards]; a driver may turn the "// &
                 "mechanism through a dead centre: --analysis kinematic finds the time"
      case (off_branch)
         words = "reduce the tolerance or the step; if this motion is intended, choose a joint that permits it"
      case (film_ended)
         words = "set level = hybrid to continue with dry contact, or use a lubricant of higher viscosity"
      case (advance_failed_evaluation)
         words = "check for a dead centre, or for a load or driver undefined at that time"
      case default
         words = "use a larger tolerance or a smaller minimum_step, or check for a dead centre or a jump of a load or driver"
      end select
   end function advice

   !> That a run was ended from outside, and whether it can continue.
   function stopped_words(t, stopped_by, saved_at, n_part) result(words)
      real(wp), intent(in) :: t              !! where it was stopped [s]
      character(*), intent(in) :: stopped_by !! by what, as `a signal`
      real(wp), intent(in) :: saved_at       !! time of its last checkpoint, negative: none [s]
      integer, intent(in) :: n_part          !! parts with steps of their own
      character(:), allocatable :: words     !! one line

      words = "stopped by "//trim(stopped_by)//" at t = "//real_text(t, 9)//" s"
      if (saved_at >= 0.0_wp) then
         words = words//"; saved at t = "//real_text(saved_at, 9)//" s; --resume continues from there"
      else
         words = words//"; not saved: "//trim(merge("groups of bodies with separate steps", &
                                                           "a method with history               ", n_part > 1))// &
                 " can be saved only at the times of the key 'checkpoint' in [analysis.dynamic]"
      end if
   end function stopped_words

end module run_failure
