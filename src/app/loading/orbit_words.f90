!> The words of the section [orbit], held against what a deck has.
module orbit_words
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: unit_text
   use expression_compile, only: symbol_number
   use item, only: item_t, place_of
   use kind_info, only: same_dimension
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use orbit_results, only: orbit_plan_t
   use spelling, only: nearest_word
   use text, only: join, real_text, text_t
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
      if (plan%joint /= "") call find_contacts(section, system, plan, mistakes)
      if (plan%parameter /= "") call find_parameter(deck, section, plan, mistakes)
   end subroutine plan_orbit

   !> The contacts that have the phase.
   subroutine find_contacts(section, system, plan, mistakes)
      type(item_t), intent(in) :: section                !! the section
      type(mechanism_t), intent(in) :: system            !! the mechanism
      type(orbit_plan_t), intent(inout) :: plan          !! contacts are set
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      character(:), allocatable :: names
      integer :: i, k, of_item

      names = ""
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               of_item = set%item_of(i)
               associate (item => set%names(of_item)%s, number => set%before%contacts + i)
                  if (index(names//" ", " "//item//" ") == 0) names = names//" "//item
                  if (plan%joint /= item .and. plan%joint /= item//"."//set%label_of(i)) cycle
                  if (plan%first == 0) plan%first = number
                  plan%last = number
               end associate
            end do
         end associate
      end do
      if (plan%first == 0) then
         associate (value => section%values(place_of(section, "contact")))
            call mistakes%add(value%location, "'"//plan%joint//"' is not a joint with clearance", "not a contact of this deck", &
                              "joints with clearance:"//names)
         end associate
      end if
   end subroutine find_contacts

   !> The parameter and its range.
   subroutine find_parameter(deck, section, plan, mistakes)
      type(deck_t), intent(in) :: deck                   !! the deck
      type(item_t), intent(in) :: section                !! the section
      type(orbit_plan_t), intent(inout) :: plan          !! parameter and range are set
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      type(text_t), allocatable :: names(:)
      character(:), allocatable :: hint
      integer :: n

      associate (name => plan%parameter, value => section%values(place_of(section, "parameter")))
         n = deck%symbols%find(name)
         if (n > deck%symbols%n_parameter) n = 0
         if (n == 0) then
            names = deck%symbols%names_of(functions=.false.)
            hint = nearest_word(name, names)
            if (len(hint) > 0) hint = "did you mean '"//hint//"'? "
            call mistakes%add(value%location, "'"//name//"' is not a parameter of the deck", "not a parameter", &
                              hint//"parameters: "//join(names, " "))
            return
         else if (deck%symbols%list(n)%kind /= symbol_number) then
            call mistakes%add(value%location, "parameter '"//name//"' is not a number", "no branch over a word")
            return
         end if
         plan%p = deck%symbols%list(n)%number
         plan%unit = unit_text(deck%symbols%list(n)%dimension)
      end associate
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
