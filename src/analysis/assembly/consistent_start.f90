!> A start that fulfils the constraints: positions by Newton's iteration, velocities in one step.
!>
!> Each correction is the minimum one (`row_corrections`), with lengths measured in sizes of the bodies and angles in
!> radians: the bodies stay as near to where the deck puts them as the joints let them.
!> Phi_q dq = -Phi until Phi is at round-off;  Phi_q dv = -(Phi_q v + Phi_t).
!> Velocities that the deck omits give way before those that it gives. Where there are many rows the corrections are those of
!> `sparse_start`.
!> Source: Flores et al. (2008), section 2.2, eqs. (2.10), (2.13). Limits: a position near the start
!> that the deck gives.
module consistent_start
   use assembly_report, only: assembly_t, largest_t
   use branches, only: check_branches
   use closing_fit, only: fit_loops
   use errors, only: error_t
   use kinds, only: wp
   use linkage, only: linkage_t
   use row_corrections, only: change_weights, coordinate_scale, evaluate_rows, min_correction, limit_step, rates, wants_sparse, &
      worst_violation
   use sparse_start, only: new_sparse_start, sparse_start_t
   use start_errors, only: check_finite, name_misfit, position_error, velocity_error
   implicit none (type, external)
   private
   public :: assemble

   real(wp), parameter :: agreed = 1.0e-8_wp            !! maximum rate left over of consistent velocities, of the rates [1]
   real(wp), parameter :: closed = 1.0e-10_wp           !! maximum scaled violation of an assembled mechanism [1]
   real(wp), parameter :: round_off = 1.0e-15_wp        !! scaled violation at which Newton stops early [1]
   real(wp), parameter :: give_way = 1.0e4_wp           !! how much easier a velocity changes that is not given [1]
   integer, parameter :: n_newton = 50                  !! corrections of positions allowed

contains

   !> Make positions and velocities consistent with the constraints at t = 0.
   !>
   !> Length: one step after the other, each of which can end it.
   subroutine assemble(linkage, q, v, report, error, is_sparse)
      type(linkage_t), intent(inout) :: linkage          !! all joints ideal
      real(wp), intent(inout) :: q(:)                    !! (n_q bodies) coordinates [any]
      real(wp), intent(inout) :: v(:)                    !! (n_v bodies) their rates [m/s or rad/s]
      type(assembly_t), intent(out) :: report            !! how it went
      type(error_t), allocatable, intent(out) :: error   !! cannot be assembled, names the worst joint
      logical, intent(in), optional :: is_sparse         !! whether matrices are sparse; absent: where there are many rows

      type(sparse_start_t) :: sparse
      logical :: is_fitted, with_sparse
      real(wp), allocatable :: correction(:), ease(:), q_fit(:), q_given(:), right(:), v_given(:)
      integer :: n

      n = size(v)
      allocate (report%dependent(0), report%shared(0), report%set_aside(0))
      report%misfit = ""
      linkage%solution%set_aside = [integer ::]
      is_fitted = .false.
      if (linkage%rows%n == 0) return
      allocate (correction(n), right(linkage%rows%n))
      allocate (ease(n), source=1.0_wp)
      with_sparse = wants_sparse(linkage, is_sparse)
      if (with_sparse) call new_sparse_start(linkage%bodies%n, linkage%rows, sparse)
      q_given = q
      call close_positions()
      if (allocated(error)) return
      call evaluate_rows(linkage, 0.0_wp, q, v)
      if (.not. worst_violation(linkage) <= closed .and. .not. with_sparse) call fit_positions()
      if (allocated(error)) return
      report%residual = maxval(abs(linkage%rows%phi))
      call linkage%coordinates%difference(linkage%bodies%n, q_given, q, correction)
      report%moved = maxval(abs(correction)*coordinate_scale(linkage))
      call find_moved_bodies()
      if (.not. worst_violation(linkage) <= closed) then
         call position_error(linkage, q_given, v, report%misfit, error)
         return
      end if
      call check_branches(linkage, error)
      if (allocated(error)) return
      call check_finite(linkage, linkage%rows%phi_t, error)
      if (allocated(error)) return
      ease = merge(1.0_wp, give_way, reshape(linkage%bodies%is_rate_given, [n]))
      v_given = v
      call find_velocities()
      if (.not. agree() .and. .not. with_sparse .and. .not. is_fitted) call fit_velocities()
      correction = merge(abs(v - v_given)*coordinate_scale(linkage), 0.0_wp, ease <= 1.0_wp)
      report%rate_changed = maxval(correction)
      report%changed_body = (maxloc(correction, dim=1) - 1)/linkage%coordinates%n_v + 1
      if (.not. agree()) call velocity_error(linkage, right, error)

   contains

      !> Positions of a loop that closes but for the digits of the deck; else the misfit is reported.
      subroutine fit_positions()
         q_fit = q
         call fit_loops(linkage, q_given, .false., q_fit, report, is_fitted)
         if (is_fitted) then
            q = q_fit
            call close_positions()
            if (allocated(error)) return
         else
            call name_misfit(linkage, q_fit, report)
         end if
         call evaluate_rows(linkage, 0.0_wp, q, v)
      end subroutine fit_positions

      !> Velocities of a loop that closes, and could move but for the digits of the deck.
      subroutine fit_velocities()
         q_fit = q
         call fit_loops(linkage, q, .true., q_fit, report, is_fitted)
         call evaluate_rows(linkage, 0.0_wp, q, v_given)
         if (.not. is_fitted) return
         v = v_given
         call find_velocities()
      end subroutine fit_velocities

      !> The bodies that were displaced and rotated most.
      subroutine find_moved_bodies()
         real(wp) :: shift, turn
         integer :: body

         associate (n_v => linkage%coordinates%n_v, n_axis => linkage%coordinates%n_axis)
            do body = 1, linkage%bodies%n
               associate (change => correction(n_v*(body - 1) + 1:n_v*body))
                  shift = norm2(change(:n_axis))
                  turn = linkage%coordinates%max_turn(1, change)
               end associate
               if (shift > report%shift%value) report%shift = largest_t(shift, body)
               if (turn > report%turn%value) report%turn = largest_t(turn, body)
            end do
         end associate
      end subroutine find_moved_bodies

      !> The minimum change of the velocities that makes them consistent.
      subroutine find_velocities()
         integer :: k

         do k = 1, merge(1, 2, with_sparse)  ! the second takes away the round-off of the first, as refinement does
            call rates(linkage, v, right)
            call correct(-right)
            v = v + correction
         end do
      end subroutine find_velocities

      !> Whether velocities fulfil all rows.
      logical function agree()
         real(wp) :: largest

         call rates(linkage, v, right)
         largest = maxval(max(abs(v), abs(v_given))*coordinate_scale(linkage))  ! where nothing is left free v is round-off alone
         agree = .not. maxval(abs(right)*linkage%solution%row_weight) &
                 > agreed*(largest + maxval(abs(linkage%rows%phi_t)*linkage%solution%row_weight))
      end function agree

      !> Newton's iteration on the positions, until round-off or no longer better.
      subroutine close_positions()
         real(wp) :: before, now
         integer :: i

         before = huge(1.0_wp)
         do i = 1, n_newton
            call evaluate_rows(linkage, 0.0_wp, q, v)
            call check_finite(linkage, linkage%rows%phi, error)
            if (allocated(error)) return
            now = worst_violation(linkage)
            if (now <= round_off .or. (now <= closed .and. now >= 0.5_wp*before)) exit
            before = now
            call correct(-linkage%rows%phi)
            call linkage%coordinates%add_change(linkage%bodies%n, limit_step(linkage, correction), q)
            report%corrections = i
         end do
      end subroutine close_positions

      !> The minimum change of positions or velocities.
      subroutine correct(change)
         real(wp), intent(in) :: change(:)  !! (rows) what the rows should change by [m or rad, or rates]

         if (with_sparse) then
            call sparse%correct(linkage%rows%jac, change_weights(linkage, ease), change, correction, report%rank)
         else
            call min_correction(linkage, change, ease, correction, report%rank)
         end if
      end subroutine correct

   end subroutine assemble

end module consistent_start
