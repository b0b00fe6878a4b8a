!> The words of [fit] tables against a scene: channels of the sensors.
module fit_words
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name
   use fit_plan, only: fit_plan_t
   use groups_of_catalogue, only: group_energy
   use kind_info, only: same_dimension
   use read_fit, only: read_fit_plan
   use run_limits, only: dimension_of
   use tolerance_words, only: find_numbers
   implicit none (type, external)
   private
   public :: plan_fit

contains

   !> Read the tables of a deck, and check them against its scene.
   subroutine plan_fit(deck, catalogue, plan, scalars, mistakes)
      type(deck_t), intent(inout) :: deck                        !! the deck
      type(catalogue_t), intent(in) :: catalogue                 !! all that it can report
      type(fit_plan_t), intent(out) :: plan                      !! what the fit is asked
      type(scalar_t), allocatable, intent(out) :: scalars(:)     !! (sensors) their channels
      type(diagnostics_t), intent(inout) :: mistakes             !! errors found

      type(scalar_t), allocatable :: some(:)
      integer :: i, k

      call read_fit_plan(deck, plan, mistakes)
      allocate (scalars(0))
      if (mistakes%count() > 0) return
      do k = 1, size(plan%sensors)
         associate (sensor => plan%sensors(k))
            call find_numbers(sensor%channel, catalogue, sensor%location, .true., some, mistakes)
            if (size(some) == 0) cycle
            scalars = [scalars, some]
            if (catalogue%groups(some(1)%group)%item_group == group_energy) then
               call mistakes%add(sensor%location, "'"//sensor%channel//"' has no derivatives: energies are sums over contacts", &
                                 "an energy", "name a channel of bodies, joints or contacts")
            end if
            do i = 1, 2
               if (.not. sensor%has(i) .or. same_dimension(sensor%dimensions(i), dimension_of(catalogue, some(1)))) cycle
               call mistakes%add(sensor%at(i), "wrong dimension of a sensor", "this is "//dimension_name(sensor%dimensions(i))// &
                                 ", "//dimension_name(dimension_of(catalogue, some(1)))//" is expected")
            end do
         end associate
      end do
   end subroutine plan_fit

end module fit_words
