!> From the tables of [fit] to what a fit is asked. Channels are names here: who knows the scene looks them up.
module read_fit
   use deck_parameter, only: check_dimension, number_parameter
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name
   use fit_info, only: fit_sensor_info, fit_set_info, fit_study_info, fit_table_info
   use fit_plan, only: data_set_t, fit_plan_t, sensor_t, unknown_t
   use item, only: item_t, place_of
   use kind_info, only: dim_time, same_dimension
   use kinds, only: wp
   use settings, only: has_section, read_settings
   use tables, only: read_items
   use text, only: split_blank
   implicit none (type, external)
   private
   public :: has_fit, read_fit_plan

contains

   !> Whether a deck has tables of a fit.
   logical function has_fit(deck)
      type(deck_t), intent(in) :: deck   !! the deck

      has_fit = has_section(deck, "fit") .or. has_section(deck, "fit.sensor") .or. has_section(deck, "fit.set") .or. &
                has_section(deck, "fit.study")
   end function has_fit

   !> Read all tables of a fit.
   subroutine read_fit_plan(deck, plan, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(fit_plan_t), intent(out) :: plan           !! what it asks; of use only without errors
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(item_t), allocatable :: items(:)
      integer :: before, k

      before = mistakes%count()
      call read_items(deck, fit_table_info(), items, mistakes)
      allocate (plan%unknowns(size(items)))
      do k = 1, size(items)
         if (mistakes%count() == before) call read_unknown(deck, items(k), plan%unknowns(k), mistakes)
      end do
      call read_items(deck, fit_sensor_info(), items, mistakes)
      allocate (plan%sensors(size(items)))
      do k = 1, size(items)
         call read_sensor(items(k), plan%sensors(k), mistakes)
      end do
      call read_items(deck, fit_set_info(), items, mistakes)
      allocate (plan%sets(size(items)))
      do k = 1, size(items)
         call read_set(items(k), plan%sets(k), mistakes)
      end do
      call read_study(deck, plan, mistakes)
   end subroutine read_fit_plan

   !> A row of [fit].
   subroutine read_unknown(deck, item, unknown, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(item_t), intent(in) :: item                !! the row
      type(unknown_t), intent(out) :: unknown         !! what it says
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      integer :: k

      unknown%name = item%name
      k = number_parameter(deck, item%name, item%location, mistakes)
      if (k == 0) return
      associate (symbol => deck%symbols%list(k), lower => item%values(place_of(item, "lower")), &
                 upper => item%values(place_of(item, "upper")), start => item%values(place_of(item, "start")))
         unknown%dimension = symbol%dimension
         unknown%lower = lower%number
         unknown%upper = upper%number
         unknown%start = symbol%number
         unknown%is_each = item%word("each") == "yes"
         call check_dimension(lower, symbol%dimension, symbol%is_soft, mistakes)
         call check_dimension(upper, symbol%dimension, symbol%is_soft, mistakes)
         call check_dimension(start, symbol%dimension, symbol%is_soft, mistakes)
         if (.not. unknown%lower < unknown%upper) then
            call mistakes%add(upper%location, "the upper bound is not above the lower one", "not above")
         else if (start%given) then
            unknown%start = start%number
            if (unknown%start < unknown%lower .or. unknown%start > unknown%upper) then
               call mistakes%add(start%location, "the start is not within the bounds", "outside")
            end if
         else if (unknown%start < unknown%lower .or. unknown%start > unknown%upper) then
            call mistakes%add(item%location, "the value of parameter '"//item%name//"' in the deck is not within its bounds", &
                              "outside", "give start, or other bounds")
         end if
      end associate
   end subroutine read_unknown

   !> A row of [fit.sensor].
   subroutine read_sensor(item, sensor, mistakes)
      type(item_t), intent(in) :: item                !! the row
      type(sensor_t), intent(out) :: sensor           !! what it says
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      sensor%name = item%name
      sensor%delay = item%number("delay")
      associate (channel => item%values(place_of(item, "channel")), sigma => item%values(place_of(item, "sigma")), &
                 offset => item%values(place_of(item, "offset")))
         sensor%channel = channel%text
         sensor%location = channel%location
         sensor%column = item%word("column")
         sensor%has = [sigma%given, offset%given]
         sensor%at = [sigma%location, offset%location]
         sensor%dimensions = [sigma%dimensions(1), offset%dimensions(1)]
         if (sigma%given) sensor%sigma = sigma%number
         if (offset%given) sensor%offset = offset%number
         if (sigma%given .and. .not. sensor%sigma > 0.0_wp) then
            call mistakes%add(sigma%location, "sigma must be positive", "not positive")
         end if
         if (offset%given .and. .not. sensor%offset > 0.0_wp) then
            call mistakes%add(offset%location, "the maximum offset must be positive", "not positive")
         end if
      end associate
   end subroutine read_sensor

   !> A row of [fit.set].
   subroutine read_set(item, set, mistakes)
      type(item_t), intent(in) :: item                !! the row
      type(data_set_t), intent(out) :: set            !! what it says
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      integer :: k

      set%name = item%name
      set%file = nint(item%number("file"))
      set%from = item%number("from")
      set%to = item%number("to")
      set%changes = split_blank(item%word("set"))
      associate (to => item%values(place_of(item, "to")), changes => item%values(place_of(item, "set")))
         if (.not. set%to > set%from) call mistakes%add(to%location, "the last time is not after the first one", "not after")
         do k = 1, size(set%changes)
            if (index(set%changes(k)%s, "=") > 1) cycle
            call mistakes%add(changes%location, "'"//set%changes(k)%s//"' is not NAME=VALUE", "no change of a parameter", &
                              "write changes with blanks between them only, as ""height=50mm speed=3m/s""")
         end do
      end associate
   end subroutine read_set

   !> The section [fit.study].
   subroutine read_study(deck, plan, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(fit_plan_t), intent(inout) :: plan         !! settings are set
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(item_t) :: study
      logical :: is_present

      call read_settings(deck, fit_study_info(), study, is_present, mistakes)
      plan%tolerance = study%number("tolerance")
      plan%most = nint(study%number("iterations"))
      allocate (plan%until(0))
      associate (until => study%values(place_of(study, "until")))
         if (.not. until%given) return
         plan%until = until%table(:, 1)
         if (.not. same_dimension(until%dimensions(1), dim_time)) then
            call mistakes%add(until%location, "wrong dimension of until", "this is "//dimension_name(until%dimensions(1))// &
                              ", time is expected")
         else if (any(plan%until <= 0.0_wp) .or. any(plan%until(2:) <= plan%until(:size(plan%until) - 1))) then
            call mistakes%add(until%location, "the times are not positive and ascending", "times of until")
         end if
      end associate
   end subroutine read_study

end module read_fit
