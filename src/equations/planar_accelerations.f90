!> Accelerations and multipliers of a planar scene.
submodule(planar_system) planar_accelerations
   use guided_motion, only: guided_response
   implicit none (type, external)

   real(wp), parameter :: damping(2) = [1.0e-9_wp, 1.0e-5_wp]  !! (2) of rows nearly, or always, dependent; round-off over it
                                                               !! shows in reactions that are not unique [1]
   integer, parameter :: n_refinement(2) = [3, 30]   !! refinements of these solutions, at most
   real(wp), parameter :: contradiction = 1.0e-2_wp  !! residual of rows always dependent that is an error [1]

contains

   !> Where rows depend on one another, or nearly so, the damped solution: it stays finite, and the control of the step decides
   !> what is good enough. Status 1 if rows that always depend on others contradict them.
   module procedure find_accelerations
      integer :: k

      status = 0
      if (self%guided%n > 0 .and. self%grips%n_slip > 0) then
         call guided_response(self%guided, g, must_agree, self%motion%alpha, self%a)
      end if
      if (self%rows%n_unknown == 0) return
      self%bad_row = 1
      if (.not. self%is_redundant) then
         call self%solver%solve(self%inverse_mass, self%rows, g, self%b, self%a, self%lambda, self%bad_row)
      end if
      if (self%bad_row == 0) return
      self%n_damped = self%n_damped + 1
      k = merge(2, 1, self%is_redundant)
      call self%solver%solve_damped(self%inverse_mass, self%rows, g, self%b, damping(k), n_refinement(k), self%a, &
                                    self%lambda, self%bad_row)
      if (self%bad_row == 0 .and. must_agree .and. (self%is_redundant .or. self%solver%is_iterative)) then
         if (.not. self%solver%left_over <= contradiction) then
            self%bad_row = maxloc(abs(self%solver%residual(:self%rows%n_solve)), dim=1)
         end if
      end if
      if (self%bad_row > 0) status = 1
   end procedure find_accelerations

end submodule planar_accelerations
