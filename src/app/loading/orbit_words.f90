!> The words of the section [orbit], held against what a deck has.
module orbit_words
   use contact_words, only: find_contacts
   use deck_parameter, only: number_parameter
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: unit_text
   use item, only: item_t, place_of
   use kind_info, only: same_dimension
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use orbit_results, only: orbit_plan_t
   use text, only: real_text
   use time_plan, only: seconds
   implicit none (type, external)
   private
   public :: plan_orbit

contains

   !> What the section asks for.
   subroutine plan_orbit(deck, section, system, plan, mistakes)
      type(deck_t), intent(in) :: deck                   !! the deck, for its parameters
      type(item_t), intent(in) :: section                !! the section
      type(mechanism_t), intent(in) :: system            !! the mechanism, for contacts and drivers
      type(orbit_plan_t), intent(out) :: plan            !! what is asked for
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      integer :: k
      character(*), parameter :: whole(3) = [character(7) :: "periods", "settle", "points"]

      plan%n_period = nint(section%number("periods"))
      plan%n_settle = nint(section%number("settle"))
      plan%most = nint(section%number("points"))
      plan%step = section%number("step")
      plan%tolerance = section%number("tolerance")
      plan%phase = section%number("phase")
      plan%joint = section%word("contact")
      plan%parameter = section%word("parameter")
      plan%unit = ""
      do k = 1, size(whole)
         associate (value => section%values(place_of(section, trim(whole(k)))))
            if (abs(value%number - anint(value%number)) > 0.0_wp) call mistakes%add( &
               value%location, "'"//trim(whole(k))//"' is not a whole number", "not whole")
         end associate
      end do
      associate (value => section%values(place_of(section, "period")))
         if (mistakes%count() == 0) then
            if (.not. seconds(value, "period", -1.0_wp, system, mistakes) > 0.0_wp .and. mistakes%count() == 0) then
               call mistakes%add(value%location, "the period must be a positive time", "not positive")
            end if
         end if
      end associate
      if (plan%joint /= "") call take_contacts(section, system, plan, mistakes)
      if (plan%parameter /= "") call find_parameter(deck, section, plan, mistakes)
   end subroutine plan_orbit

   !> The contacts that have the phase.
   subroutine take_contacts(section, system, plan, mistakes)
      type(item_t), intent(in) :: section                !! the section
      type(mechanism_t), intent(in) :: system            !! the mechanism
      type(orbit_plan_t), intent(inout) :: plan          !! contacts are set
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      character(:), allocatable :: help, message

      call find_contacts(system, plan%joint, plan%first, plan%last, message, help)
      associate (value => section%values(place_of(section, "contact")))
         if (message /= "") call mistakes%add(value%location, message, "not a contact of this deck", help)
      end associate
   end subroutine take_contacts

   !> The parameter and its range.
   subroutine find_parameter(deck, section, plan, mistakes)
      type(deck_t), intent(in) :: deck                   !! the deck
      type(item_t), intent(in) :: section                !! the section
      type(orbit_plan_t), intent(inout) :: plan          !! parameter and range are set
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      integer :: n

      associate (value => section%values(place_of(section, "parameter")))
         n = number_parameter(deck, plan%parameter, value%location, mistakes)
      end associate
      if (n == 0) return
      plan%p = deck%symbols%list(n)%number
      plan%unit = unit_text(deck%symbols%list(n)%dimension)
      call take_bound("from", plan%from)
      call take_bound("to", plan%to)
      if (mistakes%count() > 0) return
      associate (value => section%values(place_of(section, "to")))
         if (.not. plan%from < plan%to) call mistakes%add(value%location, "'to' must be greater than 'from'", "not greater")
      end associate
      if (plan%p < plan%from .or. plan%p > plan%to) then
         associate (value => section%values(place_of(section, "parameter")))
            call mistakes%add(value%location, "parameter '"//plan%parameter//"' is "//real_text(plan%p, 6)//", not within "// &
                              real_text(plan%from, 6)//" to "//real_text(plan%to, 6)//" (SI)", "the branch does not start", &
                              "give other bounds, or another value of the parameter")
         end associate
      end if

   contains

      !> One end of the range.
      subroutine take_bound(key, bound)
         character(*), intent(in) :: key      !! of the section
         real(wp), intent(out) :: bound       !! its value [any]

         associate (value => section%values(place_of(section, key)))
            bound = value%number
            if (.not. value%given) then
               call mistakes%add(value%location, "[orbit] has a parameter and no '"//key//"'", "no range", &
                                 "give the range of '"//plan%parameter//"' as from and to")
            else if (.not. same_dimension(value%dimensions(1), deck%symbols%list(n)%dimension)) then
               call mistakes%add(value%location, "'"//key//"' has not the unit of parameter '"//plan%parameter//"'", &
                                 "unit "//plan%unit//" expected")
            end if
         end associate
      end subroutine take_bound

   end subroutine find_parameter

end module orbit_words
