!> What is found from the accelerations: multipliers of the rows that are not solved for, and the powers of the ledger.
submodule(planar_system) planar_reactions
   use guided_motion, only: find_guided_multipliers
   use known_motion, only: find_multipliers, power_of_known
   implicit none (type, external)

contains

   !> Multipliers of the rows that fix the bodies that are not solved for, at the state evaluated last. Reports want them.
   module procedure planar_find_reactions
      integer :: k

      do k = self%n_solved_set + 1, size(self%joints)
         call self%joints(k)%set%evaluate(self%piece%inside(t), self%motion, self%rows)
      end do
      do k = 1, self%known%n
         call copy(self%known%item(k)%body)
      end do
      do k = 1, self%guided%n
         call copy(self%guided%item(k)%body)
      end do
      call find_guided_multipliers(self%guided, self%rows, self%mass, self%g, self%a, self%lambda)
      call find_multipliers(self%known, self%rows, self%carried, self%mass, self%g, self%a, self%rest, self%lambda)

   contains

      !> Acceleration of a body that is not solved for.
      subroutine copy(body)
         integer, intent(in) :: body  !! the body

         self%a(:, body) = [self%motion%a(1, body), self%motion%a(2, body), self%motion%alpha(3, body)]
      end subroutine copy

   end procedure planar_find_reactions

   !> Powers of the ledger.
   module procedure ledger_rates
      integer :: k

      power(work_drive) = 0.0_wp
      power(work_stabilisation) = 0.0_wp
      if (self%known%n > 0) then
         power(work_drive) = power_of_known(size(self%driven), self%driven, self%rows%n_known, self%rows%known, self%n_body, &
                                            self%rows%n, self%mass, self%g, self%rows%jac, self%lambda, self%motion%v, &
                                            self%motion%omega, self%motion%a, self%motion%alpha)
      end if
      do k = 1, self%rows%n_solve
         power(work_drive) = power(work_drive) + self%lambda(k)*self%rows%phi_t(k)
         power(work_stabilisation) = power(work_stabilisation) - self%lambda(k)*self%phi_dot(k)
      end do
      power(work_load) = self%load_power
      power(lost_damper) = 0.0_wp
      do k = 1, size(self%forces)
         power(lost_damper) = power(lost_damper) + self%forces(k)%set%lost_power(self%motion)
      end do
      do k = 1, self%n_contact
         power(n_ledger + 2*k - 1) = self%losses(1, k)
         power(n_ledger + 2*k) = self%losses(2, k)
      end do
   end procedure ledger_rates

end submodule planar_reactions
