!> The words of the section [modes], held against what a deck has.
module modes_words
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use columns, only: cell_text
   use deck_parameter, only: number_parameter
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: unit_text
   use groups_of_catalogue, only: group_energy
   use item, only: item_t, location_of, location_t, place_of
   use kind_info, only: same_dimension
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use modes_info, only: modes_section
   use modes_results, only: input_driver, input_force, input_moment, modes_input_t, modes_output_t, modes_plan_t, state_names
   use scene, only: scene_t
   use settings, only: read_settings
   use spelling, only: nearest_word
   use text, only: append_text, join, text_t
   use time_plan, only: seconds
   use tolerance_words, only: find_numbers
   implicit none (type, external)
   private
   public :: plan_modes

contains

   !> Read the section and check it; a deck without it gets the defaults.
   subroutine plan_modes(deck, scene, system, catalogue, plan, mistakes)
      type(deck_t), intent(inout) :: deck                !! the deck
      type(scene_t), intent(in) :: scene                 !! its scene
      type(mechanism_t), intent(in) :: system            !! the mechanism, for the drivers
      type(catalogue_t), intent(in) :: catalogue         !! what it can report
      type(modes_plan_t), intent(out) :: plan            !! what is asked for
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      type(item_t) :: section
      integer :: before
      logical :: is_present

      before = mistakes%count()
      call read_settings(deck, modes_section(), section, is_present, mistakes)
      plan%parameter = ""
      plan%unit = ""
      plan%axes_name = "world"
      allocate (plan%inputs(0), plan%outputs(0))
      if (mistakes%count() > before) return
      plan%at = findloc(state_names == section%word("at"), .true., dim=1)
      plan%time = max(0.0_wp, seconds(section%values(place_of(section, "time")), "time", -1.0_wp, system, mistakes))
      plan%axes_name = section%word("axes")
      plan%parameter = section%word("parameter")
      plan%n_point = nint(section%number("points"))
      associate (value => section%values(place_of(section, "points")))
         if (abs(value%number - anint(value%number)) > 0.0_wp) call mistakes%add(value%location, "'points' is not a whole number", &
                                                                                 "not whole")
      end associate
      call find_axes(scene, section, plan, mistakes)
      call read_inputs(scene, section, plan, mistakes)
      call read_outputs(catalogue, section, plan, mistakes)
      if (plan%parameter /= "") call find_range(deck, section, plan, mistakes)
   end subroutine plan_modes

   !> The body of the axes.
   subroutine find_axes(scene, section, plan, mistakes)
      type(scene_t), intent(in) :: scene                 !! the scene
      type(item_t), intent(in) :: section                !! the section
      type(modes_plan_t), intent(inout) :: plan          !! axes are set
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      if (plan%axes_name == "world") return
      plan%axes = number_of(plan%axes_name, scene%bodies%names)
      if (plan%axes > 0) return
      associate (value => section%values(place_of(section, "axes")))
         call mistakes%add(value%location, "'"//plan%axes_name//"' is not a body", "not a body", &
                           hint(plan%axes_name, scene%bodies%names)//"world, or one of: "//join(scene%bodies%names, " "))
      end associate
   end subroutine find_axes

   !> The inputs.
   subroutine read_inputs(scene, section, plan, mistakes)
      type(scene_t), intent(in) :: scene                 !! the scene
      type(item_t), intent(in) :: section                !! the section
      type(modes_plan_t), intent(inout) :: plan          !! inputs are set
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      type(modes_input_t) :: input
      integer :: k

      associate (value => section%values(place_of(section, "inputs")))
         do k = 1, size(value%words)
            input = input_of(scene, value%words(k)%s)
            if (input%kind == 0) then
               call mistakes%add(location_of(value, k), "'"//value%words(k)%s//"' is not an input of this deck", "not an input", &
                                 "write POINT.fx, BODY.fx, BODY.mz, LOAD.fx of [force.point] (in space fz, mx, my), or a driver")
            else if (input%kind == input_driver .and. plan%axes > 0) then
               call mistakes%add(location_of(value, k), "driver '"//value%words(k)%s//"' is no input in axes that turn", &
                                 "not with axes", "omit axes, or give loads as inputs")
            else
               plan%inputs = [plan%inputs, input]
            end if
         end do
      end associate
   end subroutine read_inputs

   !> An input; its kind is 0 where the word names no input.
   function input_of(scene, word) result(input)
      type(scene_t), intent(in) :: scene                 !! the scene
      character(*), intent(in) :: word                   !! as written
      type(modes_input_t) :: input                       !! the input

      character(*), parameter :: letters = "xyz"
      integer :: body, dot, i, k, point

      input%name = word
      do k = 1, size(scene%joints)
         if (index(scene%joints(k)%info%name, "driver.") /= 1) cycle
         do i = 1, size(scene%joints(k)%items)
            if (scene%joints(k)%items(i)%name == word) input%kind = input_driver
         end do
      end do
      dot = index(word, ".", back=.true.)
      if (input%kind > 0 .or. dot /= len(word) - 2 .or. dot < 2) return
      input%axis = index(letters, word(len(word):))
      body = number_of(word(:dot - 1), scene%bodies%names)
      point = number_of(word(:dot - 1), scene%points%names)
      if (body == 0 .and. point == 0) call find_place(scene, word(:dot - 1), body, point)
      select case (word(dot + 1:dot + 1)//merge("s", "p", scene%settings%is_spatial))
      case ("fp")
         if (input%axis < 1 .or. input%axis > 2) return
         input%kind = input_force
      case ("mp")
         if (input%axis /= 3) return
         input%kind = input_moment
      case ("fs")
         if (input%axis > 0) input%kind = input_force
      case ("ms")
         if (input%axis > 0) input%kind = input_moment
      end select
      input%body = body
      if (body == 0 .and. point > 0) then
         input%body = scene%points%body(point)
         input%arm = scene%points%s(:, point)
      end if
      if (input%body == 0) input%kind = 0
   end function input_of

   !> Point or body that a force element names as the place of its load.
   subroutine find_place(scene, name, body, point)
      type(scene_t), intent(in) :: scene                 !! the scene
      character(*), intent(in) :: name                   !! of the element
      integer, intent(inout) :: body                     !! the body, if it names one
      integer, intent(inout) :: point                    !! the point, if it names one

      integer :: i, k

      do k = 1, size(scene%forces)
         do i = 1, size(scene%forces(k)%items)
            associate (info => scene%forces(k)%info, item => scene%forces(k)%items(i))
               if (item%name /= name) cycle
               body = number_of(cell_text(info, item, "body"), scene%bodies%names)
               point = number_of(cell_text(info, item, "point"), scene%points%names)
            end associate
         end do
      end do
   end subroutine find_place

   !> The outputs.
   subroutine read_outputs(catalogue, section, plan, mistakes)
      type(catalogue_t), intent(in) :: catalogue         !! what can be reported
      type(item_t), intent(in) :: section                !! the section
      type(modes_plan_t), intent(inout) :: plan          !! outputs are set
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      type(modes_output_t) :: output
      type(scalar_t), allocatable :: scalars(:)
      integer :: i, k

      associate (value => section%values(place_of(section, "outputs")))
         do k = 1, size(value%words)
            call find_numbers(value%words(k)%s, catalogue, location_of(value, k), .false., scalars, mistakes)
            do i = 1, size(scalars)
               associate (group => catalogue%groups(scalars(i)%group))
                  if (group%item_group == group_energy) then
                     call mistakes%add(location_of(value, k), "'"//value%words(k)%s//"' is an energy, and no output", &
                                       "not an output", "name channels of bodies, joints, forces or contacts")
                     exit
                  end if
                  output%name = scalar_name(catalogue, scalars(i))
                  output%unit = group%channel%unit
                  output%item_group = group%item_group
                  output%channel = group%channel%name
               end associate
               output%item = scalars(i)%item
               output%component = scalars(i)%component
               plan%outputs = [plan%outputs, output]
            end do
         end do
      end associate
   end subroutine read_outputs

   !> The parameter of the diagram and its range.
   subroutine find_range(deck, section, plan, mistakes)
      type(deck_t), intent(in) :: deck                   !! the deck
      type(item_t), intent(in) :: section                !! the section
      type(modes_plan_t), intent(inout) :: plan          !! unit and range are set
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      character(*), parameter :: keys(2) = [character(4) :: "from", "to"]
      integer :: k, n
      type(location_t) :: location

      associate (value => section%values(place_of(section, "parameter")))
         location = value%location
      end associate
      n = number_parameter(deck, plan%parameter, location, mistakes)
      if (n == 0) return
      plan%unit = unit_text(deck%symbols%list(n)%dimension)
      plan%from = section%number("from")
      plan%to = section%number("to")
      do k = 1, size(keys)
         associate (value => section%values(place_of(section, trim(keys(k)))))
            if (.not. value%given) then
               call mistakes%add(location, "[modes] has a parameter and no '"//trim(keys(k))//"'", "no range", &
                                 "give the range of '"//plan%parameter//"' as from and to")
            else if (.not. same_dimension(value%dimensions(1), deck%symbols%list(n)%dimension)) then
               call mistakes%add(value%location, "'"//trim(keys(k))//"' has not the unit of parameter '"//plan%parameter//"'", &
                                 "unit "//plan%unit//" expected")
            else if (k == size(keys) .and. .not. abs(plan%to - plan%from) > 0.0_wp) then
               call mistakes%add(value%location, "'to' must differ from 'from'", "no range")
            end if
         end associate
      end do
   end subroutine find_range

   !> Number of a name in a list, 0: not there.
   pure integer function number_of(name, names) result(number)
      character(*), intent(in) :: name        !! the name
      type(text_t), intent(in) :: names(:)    !! (n) the list

      do number = 1, size(names)
         if (names(number)%s == name) return
      end do
      number = 0
   end function number_of

   !> What may have been meant.
   function hint(name, names) result(words)
      character(*), intent(in) :: name              !! as written
      type(text_t), intent(in) :: names(:)          !! (n) what there is
      character(:), allocatable :: words            !! a question, or blank

      words = nearest_word(name, names)
      if (len(words) > 0) words = "did you mean '"//words//"'? "
   end function hint

end module modes_words
