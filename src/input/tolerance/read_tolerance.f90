!> From the tables of [tolerance] to what a study of tolerances is asked. Channels and joints are names here: who knows the scene
!> looks them up.
module read_tolerance
   use deck_parameter, only: check_dimension, number_parameter
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name
   use iso_fits, only: read_fit
   use item, only: item_t, place_of
   use kind_info, only: dim_length, kind_info_t, same_dimension
   use kinds, only: wp
   use settings, only: has_section, read_settings
   use tables, only: read_items
   use text, only: text_t
   use tolerance_info, only: tolerance_joint_info, tolerance_limit_info, tolerance_study_info, tolerance_table_info
   use tolerance_plan, only: limit_t, tolerance_plan_t
   use tolerance_rows, only: number_of, read_batches, refuse, take_measured
   use tolerated, only: new_fit, new_tolerance, shape_lognormal, shape_measured, shape_normal, shape_truncated, tolerated_t
   implicit none (type, external)
   private
   public :: has_tolerances, read_tolerance_plan

   integer, parameter :: fewest_points = 10   !! of a plan of Sobol' indices

contains

   !> Whether a deck has tables of tolerances.
   logical function has_tolerances(deck)
      type(deck_t), intent(in) :: deck   !! the deck

      has_tolerances = has_section(deck, "tolerance") .or. has_section(deck, "tolerance.joint") .or. &
                       has_section(deck, "tolerance.limit") .or. has_section(deck, "tolerance.study")
   end function has_tolerances

   !> Read all tables of tolerances.
   subroutine read_tolerance_plan(deck, plan, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(tolerance_plan_t), intent(out) :: plan     !! what it asks; of use only without errors
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(item_t), allocatable :: items(:)
      type(kind_info_t) :: info
      integer :: before, k

      before = mistakes%count()
      call read_items(deck, tolerance_table_info(), items, mistakes)
      allocate (plan%parameters(size(items)), plan%costs(size(items)))
      do k = 1, size(items)
         plan%costs(k) = items(k)%number("cost")
         if (mistakes%count() == before) call read_parameter(deck, items(k), plan%parameters(k), mistakes)
      end do
      if (mistakes%count() == before) call read_batches(items, plan, mistakes)
      info = tolerance_joint_info()
      call read_items(deck, info, items, mistakes)
      allocate (plan%pins(size(items)))
      do k = 1, size(items)
         plan%pins(k)%joint = items(k)%name
         plan%pins(k)%position = number_of(info, items(k), "pin")
         plan%pins(k)%location = items(k)%location
      end do
      call read_items(deck, tolerance_limit_info(), items, mistakes)
      allocate (plan%limits(size(items)))
      do k = 1, size(items)
         call read_limit(items(k), plan%limits(k), mistakes)
      end do
      call read_sampling(deck, plan, mistakes)
   end subroutine read_tolerance_plan

   !> A row of [tolerance].
   subroutine read_parameter(deck, item, parameter, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(item_t), intent(inout) :: item             !! the row; values of a file become lists
      type(tolerated_t), intent(inout) :: parameter   !! what it says
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      integer :: k

      parameter%name = item%name
      k = number_parameter(deck, item%name, item%location, mistakes)
      if (k == 0) return
      associate (symbol => deck%symbols%list(k))
         parameter%nominal = symbol%number
         parameter%dimension = symbol%dimension
         if (item%values(place_of(item, "fit"))%given) then
            call take_fit(item, parameter, mistakes)
         else if (number_of(tolerance_table_info(), item, "distribution") == shape_measured) then
            call take_measured(item, symbol%is_soft, parameter, mistakes)
         else
            call take_limits(item, symbol%is_soft, parameter, mistakes)
         end if
         if (parameter%shape /= shape_measured) call refuse(item, ["value", "count", "file "], "distribution = measured", mistakes)
      end associate
   end subroutine read_parameter

   !> Limits and distribution without a fit.
   subroutine take_limits(item, is_soft, parameter, mistakes)
      type(item_t), intent(in) :: item                !! the row
      logical, intent(in) :: is_soft                  !! the radians of the parameter may be taken or left
      type(tolerated_t), intent(inout) :: parameter   !! its nominal value is known
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      real(wp) :: shift
      integer :: shape
      logical :: is_normal

      shape = number_of(tolerance_table_info(), item, "distribution")
      is_normal = any(shape == [shape_normal, shape_truncated, shape_lognormal])
      associate (half => item%values(place_of(item, "plus_minus")), cp => item%values(place_of(item, "cp")), &
                 move => item%values(place_of(item, "shift")))
         shift = 0.0_wp
         if (move%given) shift = move%number
         if (.not. half%given) then
            call mistakes%add(item%location, "parameter '"//item%name//"' has no tolerance", "no width", &
                              "give plus_minus or fit")
         else if (half%number < 0.0_wp) then
            call mistakes%add(half%location, "plus_minus must not be negative", "negative")
         else if (abs(item%number("cp") - 1.0_wp) > 0.0_wp .and. .not. is_normal) then
            call mistakes%add(cp%location, "cp is given for a distribution without it", "of normal, truncated and lognormal")
         else if (abs(shift) > 0.0_wp .and. .not. is_normal) then
            call mistakes%add(move%location, "shift is given for a distribution without it", "of normal, truncated and lognormal")
         else if (abs(shift) > half%number) then
            call mistakes%add(move%location, "the shifted mean is outside of the tolerance", "more than plus_minus")
         else if (shape == shape_lognormal .and. parameter%nominal + shift <= 0.0_wp) then
            call mistakes%add(item%location, "a lognormal parameter must be positive", "'"//item%name//"' is not")
         else
            call new_tolerance(parameter, shape, -half%number, half%number, item%number("cp"), shift)
         end if
         call check_dimension(half, parameter%dimension, is_soft, mistakes)
         call check_dimension(move, parameter%dimension, is_soft, mistakes)
      end associate
   end subroutine take_limits

   !> Limits by a fit.
   subroutine take_fit(item, parameter, mistakes)
      type(item_t), intent(in) :: item                !! the row
      type(tolerated_t), intent(inout) :: parameter   !! its nominal value is known
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      character(:), allocatable :: message
      real(wp) :: limits(2, 2)
      integer :: n

      associate (fit => item%values(place_of(item, "fit")), diameter => item%values(place_of(item, "diameter")), &
                 half => item%values(place_of(item, "plus_minus")), move => item%values(place_of(item, "shift")))
         call read_fit(fit%text, diameter%number, n, limits, message)
         if (.not. diameter%given) message = "a fit needs its diameter"
         if (message /= "") then
            call mistakes%add(merge(diameter%location, fit%location, index(message, "the diameter") > 0), "invalid fit '"// &
                              fit%text//"'", message)
         else if (.not. same_dimension(parameter%dimension, dim_length)) then
            call mistakes%add(item%location, "parameter '"//item%name//"' is "//dimension_name(parameter%dimension), &
                              "a fit gives a length")
         else if (half%given .or. (move%given .and. abs(move%number) > 0.0_wp) .or. &
                  number_of(tolerance_table_info(), item, "distribution") /= shape_truncated) then
            call mistakes%add(fit%location, "a fit gives the limits and a truncated normal distribution", "more than a fit", &
                              "omit plus_minus, shift and distribution")
         else if (n == 2) then
            call new_fit(parameter, limits(:, 1), limits(:, 2), item%number("cp"))
         else
            limits(:, 1) = limits(:, 1) + diameter%number - parameter%nominal
            call new_tolerance(parameter, shape_truncated, limits(1, 1), limits(2, 1), item%number("cp"), 0.0_wp)
         end if
      end associate
   end subroutine take_fit

   !> A row of [tolerance.limit].
   subroutine read_limit(item, limit, mistakes)
      type(item_t), intent(in) :: item                !! the row
      type(limit_t), intent(out) :: limit             !! what it says
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      associate (channel => item%values(place_of(item, "channel")), lower => item%values(place_of(item, "lower")), &
                 upper => item%values(place_of(item, "upper")))
         limit%channel = channel%text
         limit%location = channel%location
         limit%has = [lower%given, upper%given]
         limit%at = [lower%location, upper%location]
         limit%dimensions = [lower%dimensions(1), upper%dimensions(1)]
         if (lower%given) limit%lower = lower%number
         if (upper%given) limit%upper = upper%number
         if (.not. any(limit%has)) call mistakes%add(item%location, "limit '"//item%name//"' limits nothing", "no limit", &
                                                     "give lower, upper or both")
         if (limit%lower > limit%upper) call mistakes%add(upper%location, "the upper limit is below the lower one", "less")
      end associate
   end subroutine read_limit

   !> The section [tolerance.study].
   subroutine read_sampling(deck, plan, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(tolerance_plan_t), intent(inout) :: plan   !! requests and sampling are set
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(item_t) :: study
      type(kind_info_t) :: info
      logical :: is_present

      info = tolerance_study_info()
      call read_settings(deck, info, study, is_present, mistakes)
      associate (requests => study%values(place_of(study, "requests")), sampling => plan%sampling)
         plan%requests = requests%words
         plan%places = requests%places
         plan%level = number_of(info, study, "level")
         sampling%members = nint(study%number("members"))
         sampling%seed = nint(study%number("seed"))
         sampling%plan = number_of(info, study, "plan")
         sampling%method = number_of(info, study, "method")
         sampling%accuracy = study%number("accuracy")
         sampling%budget = study%number("budget")
         sampling%checked = nint(study%number("checked"))
         sampling%indices = number_of(info, study, "indices")
         sampling%points = nint(study%number("points"))
         sampling%resamples = nint(study%number("resamples"))
         sampling%bins = nint(study%number("bins"))
         sampling%rare = nint(study%number("rare"))
         sampling%target = study%number("target")
         if (sampling%members == 1) call mistakes%add(study%values(place_of(study, "members"))%location, &
                                                      "one member has no standard deviation", "give 2 or more")
         if (sampling%points > 0 .and. sampling%points < fewest_points) then
            call mistakes%add(study%values(place_of(study, "points"))%location, "too few points for Sobol' indices", &
                              "give 10 or more")
         end if
      end associate
   end subroutine read_sampling

end module read_tolerance
