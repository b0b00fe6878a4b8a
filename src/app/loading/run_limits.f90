!> What ends a motion before its end, and what its results must fulfil: from the settings of a scene to `limits_t`.
module run_limits
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use channels, only: list_scalars, match_word, selection_t
   use dimension_text, only: dimension_name
   use diagnostics, only: diagnostics_t
   use item, only: condition_t, item_t, place_of
   use kind_info, only: dim_none, dim_t, same_dimension
   use run_audit, only: limits_t
   use scene, only: analysis_dynamic, analysis_kinematic, scene_t
   use text, only: append_text, real_text, text_t
   use units, only: parse_unit, unit_t
   implicit none (type, external)
   private
   public :: dimension_of, check_conditions, find_scalars, has_conditions, limits_of, words_of

contains

   !> Limits of a run. Conditions on channels that its joints, taken as ideal, do not have are omitted, with a warning.
   subroutine limits_of(scene, catalogue, limits, warnings)
      type(scene_t), intent(in) :: scene                        !! the scene
      type(catalogue_t), intent(in) :: catalogue                !! what it can report
      type(limits_t), intent(out) :: limits                     !! limits, but for the guards, which follow from the system
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) appended to

      type(scalar_t), allocatable :: scalars(:)
      character(:), allocatable :: hint, message
      integer :: k

      if (scene%analysis == analysis_kinematic) limits%cpu = scene%settings%kinematic%number("limit_cpu")
      if (scene%analysis /= analysis_dynamic) return
      limits%energy = scene%settings%integration%energy_limit
      limits%violation = scene%settings%integration%violation_limit
      limits%cpu = scene%settings%integration%cpu_limit
      associate (conditions => scene%settings%guards%values(place_of(scene%settings%guards, "stop"))%conditions)
         do k = 1, size(conditions)
            call find_scalars(conditions(k), catalogue, scalars, message, hint)
            if (message /= "") then
               call append_text(warnings, "condition '"//words_of(conditions(k), catalogue)//"' ignored: the joint is ideal")
            else
               associate (at => scalars(1))
                  call limits%stop%add(words_of(conditions(k), catalogue), at%group, at%component, at%item, &
                                       conditions(k)%is_above, conditions(k)%limit)
               end associate
            end if
         end do
      end associate
   end subroutine limits_of

   !> Whether a scene has conditions that end a run, or a life.
   pure logical function has_conditions(scene)
      type(scene_t), intent(in) :: scene              !! the scene

      has_conditions = size(scene%settings%guards%values(place_of(scene%settings%guards, "stop"))%conditions) > 0
      if (.not. scene%settings%life%is_present) return
      has_conditions = has_conditions .or. size(scene%settings%life%values(place_of(scene%settings%life, "stop"))%conditions) > 0
   end function has_conditions

   !> Check all conditions of a scene.
   subroutine check_conditions(scene, catalogue, mistakes)
      type(scene_t), intent(in) :: scene              !! the scene
      type(catalogue_t), intent(in) :: catalogue      !! what its clearance joints can report
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      call check_section(scene%settings%guards, catalogue, mistakes)
      if (scene%settings%life%is_present) call check_section(scene%settings%life, catalogue, mistakes)
   end subroutine check_conditions

   !> Conditions must name one number of a channel of the scene, and compare it with a number of its dimension.
   subroutine check_section(section, catalogue, mistakes)
      class(item_t), intent(in) :: section            !! the section
      type(catalogue_t), intent(in) :: catalogue      !! what its clearance joints can report
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(scalar_t), allocatable :: scalars(:)
      type(dim_t) :: dimension
      character(:), allocatable :: hint, message
      integer :: k

      associate (conditions => section%values(place_of(section, "stop"))%conditions)
         do k = 1, size(conditions)
            call find_scalars(conditions(k), catalogue, scalars, message, hint)
            if (message /= "") then
               call mistakes%add(conditions(k)%location, message, "not a single number of this deck", hint)
               cycle
            end if
            dimension = dimension_of(catalogue, scalars(1))
            if (same_dimension(dimension, conditions(k)%dimension)) cycle
            call mistakes%add(conditions(k)%limit_location, "wrong dimension in a condition on '"//conditions(k)%channel//"'", &
                              "this is "//dimension_name(conditions(k)%dimension)//", "//dimension_name(dimension)// &
                              " is expected")
         end do
      end associate
   end subroutine check_section

   !> The number that the channel of a condition names.
   subroutine find_scalars(condition, catalogue, scalars, message, hint)
      type(condition_t), intent(in) :: condition              !! the condition
      type(catalogue_t), intent(in) :: catalogue              !! what can be reported
      type(scalar_t), allocatable, intent(out) :: scalars(:)  !! (n) numbers that it names, one if all is well
      character(:), allocatable, intent(out) :: message       !! what is wrong, blank if nothing is
      character(:), allocatable, intent(out) :: hint          !! what may have been meant

      type(selection_t) :: selection

      call match_word(condition%channel, catalogue, selection, message, hint)
      if (message /= "") return
      scalars = list_scalars(selection)
      if (size(scalars) == 1) return
      message = "'"//condition%channel//"' is not a single number"
      hint = "name one component of a channel, as slider.position.x"
   end subroutine find_scalars

   !> Dimension of a channel.
   type(dim_t) function dimension_of(catalogue, scalar) result(dimension)
      type(catalogue_t), intent(in) :: catalogue    !! what can be reported
      type(scalar_t), intent(in) :: scalar          !! the number

      type(unit_t) :: unit
      character(:), allocatable :: message
      integer :: first, last

      dimension = dim_none
      associate (symbol => catalogue%groups(scalar%group)%channel%unit)
         if (symbol == "1") return
         call parse_unit(symbol, unit, message, first, last)
         dimension = unit%dimension
      end associate
   end function dimension_of

   !> A condition as text, its limit in the SI unit of the channel.
   function words_of(condition, catalogue) result(words)
      type(condition_t), intent(in) :: condition    !! the condition
      type(catalogue_t), intent(in) :: catalogue    !! what can be reported
      character(:), allocatable :: words            !! channel, sign, limit

      type(scalar_t), allocatable :: scalars(:)
      character(:), allocatable :: hint, message

      words = condition%channel//merge(" > ", " < ", condition%is_above)//real_text(condition%limit, 6)
      call find_scalars(condition, catalogue, scalars, message, hint)
      if (message /= "") return
      associate (symbol => catalogue%groups(scalars(1)%group)%channel%unit)
         if (symbol /= "1") words = words//" "//symbol
      end associate
   end function words_of

end module run_limits
