!> State equations of the deck in the state of a mechanism: where they stand, their values, rates, scales and samples.
submodule(mechanism_state) mechanism_states
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use errors, only: exit_integration, set_error
   use text, only: real_text
   implicit none (type, external)

contains

   !> Entries of the state before those of the state equations, which stand before the quadratures.
   module procedure mechanism_before_states
      place = self%n - self%n_quadrature - self%loading%states%n_state
   end procedure mechanism_before_states

   !> Values at t = 0, the first samples taken.
   module procedure mechanism_begin_states
      if (self%loading%states%n == 0) return
      associate (before => self%before_states(), n => self%loading%states%n_state)
         call self%loading%states%begin(y(before + 1:before + n))
      end associate
      call self%sample_states(0.0_wp, y, error)
   end procedure mechanism_begin_states

   !> Values of the states, for the loads.
   module procedure mechanism_take_states
      associate (before => self%before_states(), states => self%loading%states)
         call states%take(y(before + 1:before + states%n_state), self%linkage%motion)
      end associate
   end procedure mechanism_take_states

   !> Rates, as of the last evaluation.
   module procedure mechanism_state_rates
      associate (before => self%before_states(), states => self%loading%states, linkage => self%linkage)
         call states%rates(linkage%segment%inside(t), linkage%motion, ydot(before + 1:before + states%n_state))
         status = merge(0, 1, all(ieee_is_finite(ydot(before + 1:before + states%n_state))))
      end associate
   end procedure mechanism_state_rates

   !> Error scales.
   module procedure mechanism_state_weights
      associate (before => self%before_states(), states => self%loading%states)
         call states%weights(y(before + 1:before + states%n_state), scale(before + 1:before + states%n_state))
      end associate
   end procedure mechanism_state_weights

   !> Take the samples that are due.
   module procedure mechanism_sample_states
      integer :: bad

      associate (before => self%before_states(), states => self%loading%states, linkage => self%linkage)
         if (states%n_sampled == 0) return
         call linkage%set_motion(t, y)
         call self%take_states(y)
         call states%work_out(linkage%segment%inside(t), linkage%motion)
         call states%sample(t, linkage%motion, y(before + 1:before + states%n_state), bad)
         if (bad > 0) call set_error(error, exit_integration, "the sample of state '"//states%rows(bad)%name// &
                                     "' is not finite at t = "//real_text(t, 6)//" s")
      end associate
   end procedure mechanism_sample_states

end submodule mechanism_states
