!> Newton's iteration of KINSOL, with line search, on the equations of equilibrium.
!>
!> Unknowns ( x, mu ): scaled changes of the positions, scaled multipliers of independent rows. Equations: the scaled load out of
!> balance over the largest load, and the scaled rows. The Jacobian is the full one, also where loads do
!> work in a closed path, by KINSOL's differences.
!>
!> Source: Hindmarsh et al. (2005), SUNDIALS, KINSOL with KIN_LINESEARCH and its dense linear solver. Limits: the
!> Jacobian must be regular: no indifferent equilibrium.
module static_kinsol
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, c_int, c_loc, c_long, c_ptr
   use fkinsol_mod, only: fkinfree, fkininit, fkinsetfuncnormtol, fkinsetlinearsolver, fkinsetnummaxiters, &
      fkinsetscaledsteptol, fkinsetuserdata, fkinsol, kin_linesearch, kin_linesearch_nonconv
   use fnvector_serial_mod, only: fn_vmake_serial
   use fsunlinsol_dense_mod, only: fsunlinsol_dense
   use fsunmatrix_dense_mod, only: fsundensematrix
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use static_problem, only: look_at, position_scale, unbalanced_load
   use sundials, only: fn_vdestroy, fn_vgetarraypointer, fsuncontext_free, fsunlinsolfree, fsunmatdestroy, n_vector, new_context, &
      new_kinsol, sunindextype, sunlinearsolver, sunmatrix
   implicit none (type, external)
   private
   public :: polish

   real(wp), parameter :: min_step = 1.0e-15_wp  !! shortest step, scaled [1]

   !> What the library hands back to the equations.
   type :: problem_t
      class(mechanism_t), pointer :: system => null()  !! the system
      logical, allocatable :: is_independent(:)            !! (rows) rows that are solved for
      real(wp) :: load = 1.0_wp                            !! largest load [N.m]
      real(wp), allocatable :: start(:)                    !! (n_q bodies) positions that the unknowns are changes from [any]
   end type problem_t

contains

   !> Equations of equilibrium for the library.
   integer(c_int) function equations(unknowns, values, user_data) bind(c) result(status)
      type(n_vector), intent(inout) :: unknowns   !! scaled changes of positions, and multipliers
      type(n_vector), intent(inout) :: values     !! what should be zero
      type(c_ptr), value :: user_data             !! the problem

      type(problem_t), pointer :: problem
      real(c_double), pointer :: f(:), x(:)
      integer :: n

      call c_f_pointer(user_data, problem)
      x => fn_vgetarraypointer(unknowns)
      f => fn_vgetarraypointer(values)
      n = size(problem%system%linkage%mass)
      call look_at(problem%system, moved(problem, x(1:n)))
      call set_multipliers(problem, x(n + 1:))
      f(1:n) = unbalanced_load(problem%system)/problem%load
      f(n + 1:) = pack(problem%system%linkage%rows%phi*problem%system%linkage%solution%row_weight, problem%is_independent)
      status = 0_c_int
   end function equations

   !> Positions after scaled changes from those of the start.
   function moved(problem, x) result(q)
      type(problem_t), intent(in) :: problem   !! the problem
      real(wp), intent(in) :: x(:)             !! (n_v bodies) changes over their scales [1]
      real(wp) :: q(size(problem%start))       !! (n_q bodies) positions [any]

      q = problem%start
      call problem%system%linkage%coordinates%add_change(problem%system%linkage%bodies%n, x*position_scale(problem%system), q)
   end function moved

   !> The multipliers of a system from scaled ones of independent rows.
   subroutine set_multipliers(problem, mu)
      type(problem_t), intent(inout) :: problem   !! the problem; the system's lambda is set
      real(wp), intent(in) :: mu(:)               !! (independent rows) multipliers over the largest load [1]

      problem%system%linkage%solution%lambda = unpack(mu*problem%load, problem%is_independent, &
                                                      0.0_wp)*problem%system%linkage%solution%row_weight
   end subroutine set_multipliers

   !> Polish an equilibrium.
   subroutine polish(system, dependent, load, tolerance, most, q, is_solved)
      class(mechanism_t), intent(inout), target :: system  !! the system, balance evaluated at the start
      integer, intent(in) :: dependent(:)                      !! rows that depend on others
      real(wp), intent(in) :: load                             !! largest load [N.m]
      real(wp), intent(in) :: tolerance                        !! maximum value of an equation allowed [1]
      integer, intent(in) :: most                              !! iterations allowed
      real(wp), intent(inout) :: q(:)                          !! (n_q bodies) positions, polished if solved [any]
      logical, intent(out) :: is_solved                        !! the iteration ended by the tolerance, or by round-off

      type(n_vector), pointer :: scale, unknowns
      type(sunmatrix), pointer :: matrix
      type(sunlinearsolver), pointer :: solver
      type(c_ptr) :: context, memory
      type(problem_t), target :: problem
      real(wp), allocatable, target :: ones(:), x(:)
      real(c_double), pointer :: solution(:)
      integer(sunindextype) :: n
      integer :: status

      problem%system => system
      problem%load = load
      allocate (problem%is_independent(system%linkage%rows%n), source=.true.)
      problem%is_independent(dependent) = .false.
      problem%start = q
      x = [0.0_wp*position_scale(system), &
           pack(system%linkage%solution%lambda/system%linkage%solution%row_weight/load, problem%is_independent)]
      allocate (ones(size(x)), source=1.0_wp)
      n = size(x, kind=sunindextype)
      status = new_context(context)
      unknowns => fn_vmake_serial(n, x, context)
      scale => fn_vmake_serial(n, ones, context)
      matrix => fsundensematrix(n, n, context)
      solver => fsunlinsol_dense(unknowns, matrix, context)
      memory = new_kinsol(context)
      if (.not. c_associated(memory)) status = -1
      if (status == 0) status = int(fkinsetuserdata(memory, c_loc(problem)))
      if (status == 0) status = int(fkininit(memory, c_funloc(equations), unknowns))
      if (status == 0) status = int(fkinsetlinearsolver(memory, solver, matrix))
      if (status == 0) status = int(fkinsetnummaxiters(memory, int(most, c_long)))
      if (status == 0) status = int(fkinsetfuncnormtol(memory, tolerance))
      if (status == 0) status = int(fkinsetscaledsteptol(memory, min_step))
      if (status == 0) status = int(fkinsol(memory, unknowns, int(kin_linesearch, c_int), scale, scale))
      is_solved = status >= 0 .or. status == kin_linesearch_nonconv  ! stopped by round-off
      if (is_solved) then
         solution => fn_vgetarraypointer(unknowns)
         q = moved(problem, solution(1:size(system%linkage%mass)))
      end if
      call fkinfree(memory)
      status = int(fsunlinsolfree(solver))
      call fsunmatdestroy(matrix)
      call fn_vdestroy(scale)
      call fn_vdestroy(unknowns)
      status = int(fsuncontext_free(context))
   end subroutine polish

end module static_kinsol
