!> The last step of the method that chooses, by the part that made it; the state that the parts share.
submodule(auto) auto_parts
   use exchange, only: swap
   use integrator, only: integrator_prepare_output, integrator_reach, integrator_within
   use one_step, only: one_step_refine
   use step_course, only: course_even
   implicit none (type, external)

   real(wp), parameter :: in_films = 0.01_wp           !! tolerance of the implicit method over TOL where films act [1]
   real(wp), parameter :: min_in_films = 1.0e-12_wp  !! minimum tolerance that this factor leads to [1]

contains

   !> State within the last step by a shorter step of the method that made it.
   module procedure auto_refine
      if (.not. self%is_implicit) then
         call one_step_refine(self, system, s, y, status)
         return
      end if
      call lend_state(self, system, status)
      if (status == advance_step) call self%stiff%refine(system, s, y, status)
      call take_state(self)
   end procedure auto_refine

   !> What interpolation in the last step needs.
   module procedure auto_prepare_output
      if (self%is_implicit) then
         call lend_state(self, system, status)
         if (status == advance_step) call self%stiff%prepare_output(system, status)
         call take_state(self)
      else if (self%is_eighth) then
         status = 0
         if (self%step%has_inner .or. self%step%h <= 0.0_wp) return
         associate (count => self%count)
            count%n_output_evaluations = count%n_output_evaluations - count%n_evaluations
            if (.not. self%eight%are_of(self%step)) call self%refine(system, 1.0_wp, self%scratch, status)
            if (status == 0) call self%eight%fit_output(system, self%step, count%n_evaluations, status)
            count%n_output_evaluations = count%n_output_evaluations + count%n_evaluations
         end associate
         self%step%has_inner = status == 0
      else
         call integrator_prepare_output(self, system, status)
      end if
   end procedure auto_prepare_output

   !> State at a place of the last step, by interpolation.
   module procedure auto_within
      if (self%is_implicit) then
         call self%stiff%within_step(self%step, system, s, y)
      else if (self%is_eighth .and. self%step%has_inner) then
         call self%eight%within(system, self%step, s, y)
      else
         call integrator_within(self, system, s, y)
      end if
   end procedure auto_within

   !> State at a time within the last step as rows report it.
   module procedure auto_reach
      integer :: status

      if (.not. self%is_implicit) then
         call integrator_reach(self, system, t, y)
         return
      end if
      call lend_state(self, system, status)
      if (status == advance_step) call self%stiff%reach(system, t, y)
      call take_state(self)
   end procedure auto_reach

   !> The implicit part gets what every integrator keeps; it is made when it is requested first.
   module procedure lend_state
      status = advance_step
      if (.not. allocated(self%stiff)) then
         allocate (self%stiff)
         call self%stiff%prepare(system%n)
      end if
      if (allocated(self%saved)) call take_saved(self, system, status)
      call exchange_arrays(self)
      associate (own => self%stiff)
         own%controls = implicit_controls(self, system)
         own%t = self%t
         own%count = self%count
         own%step%t0 = self%step%t0
         own%step%h = self%step%h
         own%step%course = course_even
         own%step%has_inner = self%step%has_inner
         own%events%look = self%events%look
         own%events%n_happened = self%events%n_happened
      end associate
   end procedure lend_state

   !> Film forces amplify errors of states. Stability keeps explicit steps short, so that their error is far below the tolerance.
   !> The implicit method has a hundredth of the tolerance where films act, to be as accurate.
   module procedure implicit_controls
      controls = self%controls
      if (system%traits%has_films) then
         controls%tolerance = max(in_films*controls%tolerance, min(controls%tolerance, min_in_films))
      end if
   end procedure implicit_controls

   !> It gives it back.
   module procedure take_state
      call exchange_arrays(self)
      associate (own => self%stiff)
         self%t = own%t
         self%count = own%count
         self%step%t0 = own%step%t0
         self%step%h = own%step%h
         self%step%course = own%step%course
         self%step%has_inner = own%step%has_inner
         self%events%n_happened = own%events%n_happened
      end associate
   end procedure take_state

   !> The arrays that every integrator keeps change places with those of the implicit part; those of onsets that are not located
   !> are not requested there.
   subroutine exchange_arrays(self)
      class(auto_t), intent(inout) :: self       !! the integrator

      call swap(self%step%y0, self%stiff%step%y0)
      call swap(self%step%y1, self%stiff%step%y1)
      call swap(self%step%f0, self%stiff%step%f0)
      call swap(self%step%f1, self%stiff%step%f1)
      call swap(self%step%inner, self%stiff%step%inner)
      call swap(self%trial, self%stiff%trial)
      call swap(self%scale, self%stiff%scale)
      call swap(self%scratch, self%stiff%scratch)
      associate (here => self%events, there => self%stiff%events)
         call swap(here%g0, there%g0)
         call swap(here%rate0, there%rate0)
         call swap(here%g1, there%g1)
         call swap(here%rate1, there%rate1)
         call swap(here%g, there%g)
         call swap(here%rate, there%rate)
         call swap(here%noise, there%noise)
         call swap(here%threshold, there%threshold)
         call swap(here%kept_g, there%kept_g)
         call swap(here%kept_rate, there%kept_rate)
         call swap(here%is_hidden, there%is_hidden)
         call swap(here%happened, there%happened)
      end associate
   end subroutine exchange_arrays

end submodule auto_parts
