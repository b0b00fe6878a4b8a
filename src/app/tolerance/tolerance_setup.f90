!> From a deck to what a study of tolerances is asked: channels with their limits, joints with clearance.
module tolerance_setup
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use channels, only: list_scalars, match_word, selection_t
   use deck_mechanisms, only: clearance_of
   use diagnostics, only: diagnostics_t
   use errors, only: error_t, exit_usage, set_error
   use groups_of_catalogue, only: group_motions, group_reactions, group_requests
   use load, only: loaded_t
   use mechanism_catalogue, only: build_catalogue
   use member_draws, only: random_numbers
   use read_tolerance, only: has_tolerances, read_tolerance_plan
   use scene, only: analysis_kinematic
   use sobol_points, only: most_dimensions
   use text, only: append_text, text_t, to_text
   use tolerance_plan, only: indices_by_polynomial, limit_t, pin_disc, plan_sobol
   use tolerance_results, only: found_pin_t, request_t, tolerance_study_t
   use tolerance_words, only: names_of_pins
   implicit none (type, external)
   private
   public :: add_limits, check_sampling, read_plan, set_up_study

contains

   !> Read and settle the plan of a deck. The tables were checked when the deck was loaded.
   subroutine read_plan(loaded, study, error)
      type(loaded_t), intent(inout) :: loaded             !! the deck
      type(tolerance_study_t), intent(out) :: study       !! its plan is set
      type(error_t), allocatable, intent(out) :: error    !! the deck has no tables of tolerances

      type(diagnostics_t) :: ignored  ! there are no errors: the tables were checked

      if (.not. has_tolerances(loaded%deck)) then
         call set_error(error, exit_usage, "the deck has no table [tolerance]"//new_line("a")// &
                        "  = see 'gudgeon help tolerance'")
         return
      end if
      call read_tolerance_plan(loaded%deck, study%plan, ignored)
      call study%plan%settle(loaded%scene%settings%has_analysis(analysis_kinematic))
   end subroutine read_plan

   !> Set up a study of the kinematic level, whose plan is settled.
   subroutine set_up_study(loaded, study, warnings, error)
      type(loaded_t), intent(inout) :: loaded                   !! the deck, of a kinematic analysis
      type(tolerance_study_t), intent(inout) :: study           !! what is asked
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) grown
      type(error_t), allocatable, intent(out) :: error          !! nothing is asked

      integer :: k

      call find_pins(loaded, study, warnings)
      call find_requests(loaded, study)
      allocate (study%contributors(0))
      do k = 1, size(study%plan%parameters)
         call append_text(study%contributors, study%plan%parameters(k)%name)
      end do
      do k = 1, size(study%pins)
         call append_text(study%contributors, study%pins(k)%joint)
      end do
      study%contributors = [study%contributors, study%plan%batches]
      if (size(study%contributors) == 0) then
         call set_error(error, exit_usage, "nothing scatters: no parameter has a tolerance and no revolute joint a clearance"// &
                        new_line("a")//"  = give a row of [tolerance]")
      else if (size(study%requests) == 0) then
         call set_error(error, exit_usage, "no channel is studied"//new_line("a")// &
                        "  = name some as requests of [tolerance.study], or give rows of [request] or [tolerance.limit]")
      else
         call check_sampling(study, 0, error)
      end if
   end subroutine set_up_study

   !> Refuse what the sampling of a study cannot do.
   subroutine check_sampling(study, runs_per_member, error)
      type(tolerance_study_t), intent(in) :: study           !! contributors and pins are set
      integer, intent(in) :: runs_per_member                 !! 0: of the kinematic level
      type(error_t), allocatable, intent(inout) :: error     !! says what, and what else there is

      associate (sampling => study%plan%sampling)
         if (sampling%plan == plan_sobol .and. random_numbers(study) > most_dimensions) then
            call set_error(error, exit_usage, "plan = sobol takes up to "//to_text(most_dimensions)// &
                           " random numbers, and a member has "//to_text(random_numbers(study))//new_line("a")// &
                           "  = use plan = latin_hypercube")
         else if (sampling%indices == indices_by_polynomial .and. runs_per_member == 0) then
            call set_error(error, exit_usage, "indices = polynomial is of the dynamic level: here each member is a position"// &
                           new_line("a")//"  = omit it, or use level = dynamic")
         else if (sampling%indices == indices_by_polynomial .and. runs_per_member > 1) then
            call set_error(error, exit_usage, "indices = polynomial needs one run of a member, and [ensemble] has several"// &
                           new_line("a")//"  = omit it: the scatter within the motion is split from that of the parts instead")
         end if
      end associate
   end subroutine check_sampling

   !> Joints with clearance: planar revolute ones; others are ideal.
   subroutine find_pins(loaded, study, warnings)
      type(loaded_t), intent(in) :: loaded                      !! the deck
      type(tolerance_study_t), intent(inout) :: study           !! pins are set
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) grown

      type(found_pin_t) :: pin
      type(text_t), allocatable :: names(:)
      integer :: i, k, m
      logical :: is_pin

      names = names_of_pins(loaded%scene)
      allocate (study%pins(0))
      associate (ideal => loaded%system%linkage%ideal, rows => loaded%system%linkage%rows)
         do k = 1, size(ideal)
            do i = 1, ideal(k)%set%n
               pin%joint = ideal(k)%set%names(i)%s
               pin%position = pin_disc
               pin%set = k
               pin%item = i
               is_pin = .false.
               do m = 1, size(names)
                  is_pin = is_pin .or. names(m)%s == pin%joint
               end do
               is_pin = is_pin .and. ideal(k)%set%n_row_item == 2
               if (is_pin) is_pin = .not. any(rows%is_angle(ideal(k)%set%first_row + 1:ideal(k)%set%first_row + 2))
               if (.not. is_pin) then
                  call append_text(warnings, "joint '"//pin%joint//"' is taken as ideal: only revolute joints in the plane "// &
                                   "have a clearance here")
                  cycle
               end if
               do m = 1, size(study%plan%pins)
                  if (study%plan%pins(m)%joint == pin%joint) pin%position = study%plan%pins(m)%position
               end do
               pin%clearance = clearance_of(loaded%scene, pin%joint)
               study%pins = [study%pins, pin]
            end do
         end do
      end associate
   end subroutine find_pins

   !> Channels that are studied: those that are named, else all of the tables of requests; and those with limits.
   subroutine find_requests(loaded, study)
      type(loaded_t), intent(in) :: loaded               !! the deck
      type(tolerance_study_t), intent(inout) :: study    !! requests are set

      type(catalogue_t) :: catalogue
      integer :: group, item, k

      call build_catalogue(loaded%system, catalogue)
      allocate (study%requests(0))
      do k = 1, size(study%plan%requests)
         call add_word(study%plan%requests(k)%s, 0)
      end do
      if (size(study%plan%requests) == 0) then
         do group = 1, size(catalogue%groups)
            associate (this => catalogue%groups(group))
               if (.not. any(this%item_group == [group_motions, group_reactions, group_requests])) cycle
               if (index(this%channel%name, "magnitude") > 0) cycle
               do item = 1, size(this%has)
                  if (.not. this%has(item)) cycle
                  do k = 1, this%channel%components
                     call add_scalar(scalar_t(group, k, item), 0)
                  end do
               end do
            end associate
         end do
      end if
      do k = 1, size(study%plan%limits)
         call add_word(study%plan%limits(k)%channel, k)
      end do

   contains

      !> Add the numbers that a word names.
      subroutine add_word(word, limit)
         character(*), intent(in) :: word   !! as in the deck
         integer, intent(in) :: limit       !! number of its limit; 0: none

         type(scalar_t), allocatable :: scalars(:)
         type(selection_t) :: selection
         character(:), allocatable :: hint, message
         integer :: i

         call match_word(word, catalogue, selection, message, hint)
         scalars = list_scalars(selection)
         do i = 1, size(scalars)
            call add_scalar(scalars(i), limit)
         end do
      end subroutine add_word

      !> Add a number, unless it is there, and its limits.
      subroutine add_scalar(scalar, limit)
         type(scalar_t), intent(in) :: scalar   !! the number
         integer, intent(in) :: limit           !! number of its limit; 0: none

         type(request_t) :: request
         integer :: i, m

         m = 0
         do i = 1, size(study%requests)
            if (all(study%requests(i)%at == [scalar%group, scalar%component, scalar%item])) m = i
         end do
         if (m == 0) then
            request%name = scalar_name(catalogue, scalar)
            request%unit = catalogue%groups(scalar%group)%channel%unit
            request%at = [scalar%group, scalar%component, scalar%item]
            study%requests = [study%requests, request]
            m = size(study%requests)
         end if
         if (limit == 0) return
         call add_limits(study%plan%limits(limit), study%requests(m))
      end subroutine add_scalar

   end subroutine find_requests

   !> Add limits to those of a request.
   pure subroutine add_limits(limit, request)
      type(limit_t), intent(in) :: limit         !! the limits
      type(request_t), intent(inout) :: request  !! limited by them too

      request%is_limited = .true.
      request%lower = max(request%lower, limit%lower)
      request%upper = min(request%upper, limit%upper)
   end subroutine add_limits

end module tolerance_setup
