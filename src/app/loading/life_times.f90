!> The times of the simulations of a life, from `cycle`, `settle` and `measure` of [life]; and what this section must have.
module life_times
   use diagnostics, only: diagnostics_t
   use item, only: place_of, value_t
   use kinds, only: wp
   use life_rates, only: span_t
   use mechanism, only: mechanism_t
   use scene, only: scene_t
   use time_plan, only: seconds
   implicit none (type, external)
   private
   public :: check_life, find_spans

contains

   !> Check the section.
   subroutine check_life(scene, system, mistakes)
      type(scene_t), intent(in) :: scene              !! the scene, with the section
      type(mechanism_t), intent(in) :: system         !! its system, for the drivers
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(span_t) :: spans(2)

      associate (life => scene%settings%life)
         call check_whole("settle")
         call check_whole("measure")
         if (.not. (life%number("cycles") > 0.0_wp .or. life%number("time") > 0.0_wp .or. life%number("depth") > 0.0_wp .or. &
                    life%number("clearance") > 0.0_wp .or. size(life%values(place_of(life, "stop"))%conditions) > 0)) then
            call mistakes%add(life%location, "[life] has no limit", "no end", "give cycles, time, depth, clearance or stop")
         end if
      end associate
      call find_spans(scene, system, spans, mistakes)

   contains

      !> A number of cycles is whole.
      subroutine check_whole(key)
         character(*), intent(in) :: key   !! of the section

         associate (value => scene%settings%life%values(place_of(scene%settings%life, key)))
            if (abs(value%number - anint(value%number)) > 0.0_wp) call mistakes%add( &
               value%location, "'"//key//"' is not a whole number of cycles", "not whole")
         end associate
      end subroutine check_whole

   end subroutine check_life

   !> The measured cycles of a simulation, and of one with twice the settling cycles (at least one more).
   subroutine find_spans(scene, system, spans, mistakes)
      type(scene_t), intent(in) :: scene              !! the scene, with the section
      type(mechanism_t), intent(in) :: system         !! its system, for the drivers
      type(span_t), intent(out) :: spans(2)           !! (2) the times of both
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      real(wp) :: settle(2)
      integer :: k

      associate (life => scene%settings%life)
         settle = life%number("settle")
         settle(2) = settle(2) + max(settle(2), 1.0_wp)
         do k = 1, 2
            spans(k)%from = time_of(settle(k))
            spans(k)%to = time_of(settle(k) + life%number("measure"))
            if (mistakes%count() > 0) return
            if (.not. spans(k)%to > spans(k)%from) call mistakes%add( &
               life%values(place_of(life, "cycle"))%location, "the cycle must be a positive time", "not positive")
            if (mistakes%count() > 0) return
         end do
      end associate

   contains

      !> Time at which a number of cycles has passed.
      real(wp) function time_of(cycles) result(t)
         real(wp), intent(in) :: cycles   !! since the start [1]

         type(value_t) :: value

         t = 0.0_wp
         if (.not. cycles > 0.0_wp .or. mistakes%count() > 0) return
         value = scene%settings%life%values(place_of(scene%settings%life, "cycle"))
         value%number = value%number*cycles
         t = seconds(value, "cycle", -1.0_wp, system, mistakes)
      end function time_of

   end subroutine find_spans

end module life_times
