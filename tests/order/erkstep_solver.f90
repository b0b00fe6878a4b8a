!> Verner's method by another hand: ERKStep of SUNDIALS on a system of this program.
!>
!> ERKStep takes every table whose last stage is at c = 1 for one whose last stage is the next step's
!> first. DVERK's eighth stage is at 1 without being that, so a ninth is added: c = 1, its row the
!> weights of order 6, its own weight nought. Nine stages then are Verner's method, not one order less.
module erkstep_solver
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, c_int, c_loc, c_long, c_ptr
   use arkode, only: ark_normal, ark_tstop_return, farkodebutchertable_create, farkodebutchertable_free, farkodeevolve, &
      farkodefree, farkodesetfixedstep, farkodesetmaxnumsteps, farkodesetstoptime, farkodesetuserdata, farkodesstolerances, &
      ferkstepcreate, ferkstepsettable
   use fnvector_serial_mod, only: fn_vmake_serial
   use kinds, only: wp
   use ode_system, only: ode_system_t
   use sundials, only: fn_vdestroy, fn_vgetarraypointer, fsuncontext_free, n_vector, new_context, sunindextype
   implicit none (type, external)
   private
   public :: solve_by_erkstep

   integer, parameter :: n_stage = 9  !! stages of the table

   !> What the library hands back to the right-hand side.
   type :: problem_t
      class(ode_system_t), pointer :: system => null()  !! the system
   end type problem_t

contains

   !> The table, row by row: Verner (1978), coefficients as in Hull, Enright and Jackson's DVERK (1976).
   function corrected_table() result(table)
      type(c_ptr) :: table  !! a table of the library

      real(c_double) :: a(n_stage, n_stage), b(n_stage), c(n_stage), d(n_stage), rows(n_stage*n_stage)

      c = [0.0_wp, 1.0_wp/6.0_wp, 4.0_wp/15.0_wp, 2.0_wp/3.0_wp, 5.0_wp/6.0_wp, 1.0_wp, 1.0_wp/15.0_wp, 1.0_wp, 1.0_wp]
      b = [3.0_wp/40.0_wp, 0.0_wp, 875.0_wp/2244.0_wp, 23.0_wp/72.0_wp, 264.0_wp/1955.0_wp, 0.0_wp, &
           125.0_wp/11592.0_wp, 43.0_wp/616.0_wp, 0.0_wp]
      d = [13.0_wp/160.0_wp, 0.0_wp, 2375.0_wp/5984.0_wp, 5.0_wp/16.0_wp, 12.0_wp/85.0_wp, 3.0_wp/44.0_wp, &
           0.0_wp, 0.0_wp, 0.0_wp]
      ! a(j, i) is entry j of row i
      a = 0.0_wp
      a(:1, 2) = [1.0_wp/6.0_wp]
      a(:2, 3) = [4.0_wp/75.0_wp, 16.0_wp/75.0_wp]
      a(:3, 4) = [5.0_wp/6.0_wp, -8.0_wp/3.0_wp, 5.0_wp/2.0_wp]
      a(:4, 5) = [-165.0_wp/64.0_wp, 55.0_wp/6.0_wp, -425.0_wp/64.0_wp, 85.0_wp/96.0_wp]
      a(:5, 6) = [12.0_wp/5.0_wp, -8.0_wp, 4015.0_wp/612.0_wp, -11.0_wp/36.0_wp, 88.0_wp/255.0_wp]
      a(:5, 7) = [-8263.0_wp/15000.0_wp, 124.0_wp/75.0_wp, -643.0_wp/680.0_wp, -81.0_wp/250.0_wp, 2484.0_wp/10625.0_wp]
      a(:7, 8) = [3501.0_wp/1720.0_wp, -300.0_wp/43.0_wp, 297275.0_wp/52632.0_wp, -319.0_wp/2322.0_wp, &
                  24068.0_wp/84065.0_wp, 0.0_wp, 3850.0_wp/26703.0_wp]
      a(:, 9) = b
      rows = reshape(a, [n_stage*n_stage])
      table = farkodebutchertable_create(int(n_stage, c_int), 6_c_int, 5_c_int, c, rows, b, d)
   end function corrected_table

   !> Right-hand side for the library.
   integer(c_int) function right_hand_side(t, y, ydot, user_data) bind(c) result(status)
      real(c_double), value :: t              !! time [s]
      type(n_vector), intent(inout) :: y      !! state
      type(n_vector), intent(inout) :: ydot   !! its derivative
      type(c_ptr), value :: user_data         !! the problem

      type(problem_t), pointer :: problem
      real(c_double), pointer :: state(:), rate(:)
      integer :: outcome

      call c_f_pointer(user_data, problem)
      state => fn_vgetarraypointer(y)
      rate => fn_vgetarraypointer(ydot)
      call problem%system%evaluate(t, state, rate, outcome)
      status = int(outcome, c_int)
   end function right_hand_side

   !> Integrate from t to t_end, exactly. Steps of one length if `n_step` is given, else by the tolerance.
   subroutine solve_by_erkstep(system, t, t_end, y, status, n_step, tolerance)
      class(ode_system_t), intent(inout), target :: system   !! the system; without events
      real(wp), intent(in) :: t                              !! start [s]
      real(wp), intent(in) :: t_end                          !! end [s]
      real(wp), intent(inout), target :: y(:)                !! (n) state at the start, then at the end [any]
      integer, intent(out) :: status                         !! 0: done
      integer, intent(in), optional :: n_step                !! number of steps of one length
      real(wp), intent(in), optional :: tolerance            !! relative and absolute [any]

      type(c_ptr) :: context, memory, table
      type(n_vector), pointer :: vector
      type(problem_t), target :: problem
      real(c_double) :: reached(1)
      real(c_double), pointer :: state(:)

      problem%system => system
      status = new_context(context)
      vector => fn_vmake_serial(size(y, kind=sunindextype), y, context)
      memory = ferkstepcreate(c_funloc(right_hand_side), t, vector, context)
      if (.not. c_associated(memory)) status = -1
      table = corrected_table()
      if (status == 0) status = int(ferkstepsettable(memory, table))
      if (status == 0) status = int(farkodesetuserdata(memory, c_loc(problem)))
      if (status == 0) status = int(farkodesetmaxnumsteps(memory, 1000000_c_long))
      if (status == 0 .and. present(tolerance)) status = int(farkodesstolerances(memory, tolerance, tolerance))
      if (status == 0 .and. present(n_step)) status = int(farkodesetfixedstep(memory, (t_end - t)/real(n_step, wp)))
      if (status == 0) status = int(farkodesetstoptime(memory, t_end))
      if (status == 0) status = int(farkodeevolve(memory, t_end, vector, reached, ark_normal))
      if (status == ark_tstop_return) status = 0
      if (abs(reached(1) - t_end) > 0.0_wp) status = -2
      state => fn_vgetarraypointer(vector)
      y = state
      call farkodebutchertable_free(table)
      call farkodefree(memory)
      call fn_vdestroy(vector)
      status = merge(status, int(fsuncontext_free(context)), status /= 0)
   end subroutine solve_by_erkstep

end module erkstep_solver
