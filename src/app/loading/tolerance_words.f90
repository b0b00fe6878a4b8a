!> The words of [tolerance] tables against a scene: joints with clearance, channels and their limits.
module tolerance_words
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use channels, only: list_scalars, match_word, selection_t
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name
   use item, only: location_t
   use kind_info, only: dim_none, dim_t, same_dimension
   use read_tolerance, only: read_tolerance_plan
   use run_limits, only: dimension_of
   use run_numbers, only: find_run_numbers
   use scene, only: analysis_kinematic, scene_t
   use spelling, only: nearest_word
   use statistics, only: number_t
   use text, only: append_text, join, text_t
   use tolerance_plan, only: level_dynamic, tolerance_plan_t
   use units, only: parse_unit, unit_t
   implicit none (type, external)
   private
   public :: check_tolerances, find_numbers, names_of_pins

contains

   !> Read the tables of a deck, and check them against its scene.
   subroutine check_tolerances(deck, scene, catalogue, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(scene_t), intent(in) :: scene              !! its scene
      type(catalogue_t), intent(in) :: catalogue      !! all that it can report
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(scalar_t), allocatable :: scalars(:)
      type(text_t), allocatable :: names(:)
      type(tolerance_plan_t) :: plan
      character(:), allocatable :: help
      integer :: k

      call read_tolerance_plan(deck, plan, mistakes)
      if (mistakes%count() > 0) return
      call plan%settle(scene%settings%has_analysis(analysis_kinematic))
      if (plan%level == level_dynamic) then
         call check_numbers(plan, scene, catalogue, mistakes)
         return
      end if
      names = names_of_pins(scene)
      do k = 1, size(plan%pins)
         if (any_of(plan%pins(k)%joint, names)) cycle
         help = nearest_word(plan%pins(k)%joint, names)
         if (len(help) > 0) help = "did you mean '"//help//"'? "
         call mistakes%add(plan%pins(k)%location, "'"//plan%pins(k)%joint//"' is not a planar revolute joint with clearance", &
                           "not such a joint", help//"joints of [clearance.revolute]: "//join(names, " "))
      end do
      do k = 1, size(plan%requests)
         call find_numbers(plan%requests(k)%s, catalogue, plan%places(k), .false., scalars, mistakes)
      end do
      do k = 1, size(plan%limits)
         associate (limit => plan%limits(k))
            call find_numbers(limit%channel, catalogue, limit%location, .true., scalars, mistakes)
            if (size(scalars) == 0) cycle
            call check_limit(dimension_of(catalogue, scalars(1)), limit%dimensions, limit%has, limit%at, mistakes)
         end associate
      end do
   end subroutine check_tolerances

   !> Words of the dynamic level: requests and limits are numbers of a run, joints are simulated.
   subroutine check_numbers(plan, scene, catalogue, mistakes)
      type(tolerance_plan_t), intent(in) :: plan      !! the plan
      type(scene_t), intent(in) :: scene              !! the scene
      type(catalogue_t), intent(in) :: catalogue      !! all that it can report
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(number_t), allocatable :: numbers(:)
      character(:), allocatable :: channel, hint, message
      integer :: k

      do k = 1, size(plan%pins)
         call mistakes%add(plan%pins(k)%location, "a pin has a position at the kinematic level only", "simulated", &
                           "omit [tolerance.joint], or give level = kinematic in [tolerance.study]")
      end do
      do k = 1, size(plan%requests)
         call find_run_numbers(plan%requests(k)%s, scene, catalogue, .false., numbers, channel, message, hint)
         if (message /= "") call mistakes%add(plan%places(k), message, "unknown here", hint)
      end do
      do k = 1, size(plan%limits)
         associate (limit => plan%limits(k))
            call find_run_numbers(limit%channel, scene, catalogue, .true., numbers, channel, message, hint)
            if (message /= "") then
               call mistakes%add(limit%location, message, "unknown here", hint)
            else
               call check_limit(dimension_in(numbers(1)%unit), limit%dimensions, limit%has, limit%at, mistakes)
            end if
         end associate
      end do
   end subroutine check_numbers

   !> Dimension of a unit.
   type(dim_t) function dimension_in(symbol) result(dimension)
      character(*), intent(in) :: symbol   !! the unit, `1` if none

      type(unit_t) :: unit
      character(:), allocatable :: message
      integer :: first, last

      dimension = dim_none
      if (symbol == "1") return
      call parse_unit(symbol, unit, message, first, last)
      dimension = unit%dimension
   end function dimension_in

   !> Limits must have the dimension of their channel.
   subroutine check_limit(dimension, dimensions, has, at, mistakes)
      type(dim_t), intent(in) :: dimension            !! of the channel
      type(dim_t), intent(in) :: dimensions(2)        !! (2) of the limits
      logical, intent(in) :: has(2)                   !! (2) whether they are given
      type(location_t), intent(in) :: at(2)           !! (2) where they stand
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      integer :: k

      do k = 1, 2
         if (.not. has(k) .or. same_dimension(dimension, dimensions(k))) cycle
         call mistakes%add(at(k), "wrong dimension of a limit", "this is "//dimension_name(dimensions(k))//", "// &
                           dimension_name(dimension)//" is expected")
      end do
   end subroutine check_limit

   !> The numbers that a word names.
   subroutine find_numbers(word, catalogue, location, is_one, scalars, mistakes)
      character(*), intent(in) :: word                        !! as in the deck
      type(catalogue_t), intent(in) :: catalogue              !! what can be reported
      type(location_t), intent(in) :: location                !! where the word stands
      logical, intent(in) :: is_one                           !! it must name one number
      type(scalar_t), allocatable, intent(out) :: scalars(:)  !! (n) the numbers; none after an error
      type(diagnostics_t), intent(inout) :: mistakes          !! errors found

      type(selection_t) :: selection
      character(:), allocatable :: hint, message

      call match_word(word, catalogue, selection, message, hint)
      scalars = list_scalars(selection)
      if (message == "" .and. is_one .and. size(scalars) /= 1) then
         message = "'"//word//"' is not a single number"
         hint = "name one component of a channel, as slider.position.x"
      end if
      if (message == "") return
      call mistakes%add(location, message, "unknown here", hint)
      scalars = scalars(:0)
   end subroutine find_numbers

   !> Names of the planar revolute joints with clearance: those of a table with a bearing and a clearance.
   function names_of_pins(scene) result(names)
      type(scene_t), intent(in) :: scene          !! the scene
      type(text_t), allocatable :: names(:)       !! (n) their names

      integer :: c, i, k
      logical :: has_bearing, has_clearance

      allocate (names(0))
      if (scene%settings%is_spatial) return
      do k = 1, size(scene%clearances)
         associate (table => scene%clearances(k))
            has_bearing = .false.
            has_clearance = .false.
            do c = 1, size(table%info%columns)
               has_bearing = has_bearing .or. table%info%columns(c)%name == "bearing"
               has_clearance = has_clearance .or. table%info%columns(c)%name == "clearance"
            end do
            if (.not. (has_bearing .and. has_clearance)) cycle
            do i = 1, size(table%items)
               call append_text(names, table%items(i)%name)
            end do
         end associate
      end do
   end function names_of_pins

   !> Whether a name is in a list.
   pure logical function any_of(name, names)
      character(*), intent(in) :: name        !! the name
      type(text_t), intent(in) :: names(:)    !! (n) the list

      integer :: k

      any_of = .false.
      do k = 1, size(names)
         any_of = any_of .or. names(k)%s == name
      end do
   end function any_of

end module tolerance_words
