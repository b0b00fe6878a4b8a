!> The objects `tolerance` and `tolerance_study` of summary.json: a member for each channel that is studied, and what is common.
module tolerance_object
   use dimension_text, only: unit_text
   use json_text, only: json_object_t
   use kinds, only: i8, wp
   use tolerance_plan, only: level_dynamic
   use tolerance_results, only: tolerance_study_t, yield_t
   implicit none (type, external)
   private
   public :: put_tolerances

   character(*), parameter :: positions(4) = [character(6) :: "disc", "circle", "force", "worst"]   !! of pins

contains

   !> Add both objects.
   subroutine put_tolerances(json, study)
      type(json_object_t), intent(inout) :: json       !! grown
      type(tolerance_study_t), intent(in) :: study     !! the study

      type(json_object_t) :: one
      integer :: k

      call one%start(1)
      do k = 1, size(study%requests)
         call one%put_object(study%requests(k)%name, object_of_request(study, k))
      end do
      call json%put_object("tolerance", one%get())
      call json%put_object("tolerance_study", object_of_study(study))
   end subroutine put_tolerances

   !> A channel.
   function object_of_request(study, r) result(text)
      type(tolerance_study_t), intent(in) :: study     !! the study
      integer, intent(in) :: r                         !! number of the channel
      character(:), allocatable :: text                !! the object

      type(json_object_t) :: one

      call one%start(2)
      call one%put_text("unit", study%requests(r)%unit)
      call one%put_object("nominal", series(study%derivatives%values(r, :)))
      call one%put_object("derivative", derivatives())
      if (size(study%pins) > 0) call one%put_object("clearance", clearances())
      associate (low => study%low(r, :), high => study%high(r, :), members => study%members)
         call one%put_object("band", series(0.5_wp*(high - low), ["low ", "high"], reshape([low, high], [size(low), 2])))
         call one%put_object("sigma", series(study%sigma(r, :), [character(12) :: "sampled", "sampled_low", "sampled_high"], &
                             reshape([members%sigma(r, :), members%sigma_low(r, :), members%sigma_high(r, :)], [size(low), 3])))
         call one%put_object("mean", series(study%mean(r, :), [character(12) :: "sampled", "sampled_low", "sampled_high"], &
                             reshape([members%mean(r, :), members%mean(r, :) - members%mean_half(r, :), &
                                      members%mean(r, :) + members%mean_half(r, :)], [size(low), 3])))
         call one%put_object("range", series(members%highest(r, :) - members%lowest(r, :), ["low ", "high"], &
                                             reshape([members%lowest(r, :), members%highest(r, :)], [size(low), 2])))
         call one%put_object("yield", object_of_yield(members%yields(r), 3))
         call one%put_object("capability", interval(members%capability(:, r), 3))
         if (allocated(members%failures)) call one%put_object("failures", interval(members%failures(:, r), 3))
      end associate
      if (allocated(study%allocations)) call one%put_object("cheapest", cheapest())
      if (allocated(study%splits)) call one%put_object("variance", variances())
      call one%put_object("index", indices())
      if (allocated(study%indices%missed)) call one%put_real("index_missed", study%indices%missed(r))
      call one%put_object("histogram", histogram())
      call one%put_real("expansion_error", study%errors(r))
      text = one%get()

   contains

      !> A series over the output times, with others beside it.
      function series(values, names, others) result(object)
         real(wp), intent(in) :: values(:)                 !! (times) values [any]
         character(*), intent(in), optional :: names(:)    !! (n) names of the others
         real(wp), intent(in), optional :: others(:, :)    !! (times, n) these [any]
         character(:), allocatable :: object               !! as text

         type(json_object_t) :: members
         integer :: k

         call members%start(4)
         call members%put_reals("time", study%derivatives%instants%t)
         call members%put_reals("value", values)
         if (present(names)) then
            do k = 1, size(names)
               call members%put_reals(trim(names(k)), others(:, k))
            end do
         end if
         object = members%get()
      end function series

      !> Derivatives by all parameters.
      function derivatives() result(object)
         character(:), allocatable :: object               !! as text

         type(json_object_t) :: members
         integer :: k

         call members%start(3)
         do k = 1, size(study%plan%parameters)
            call members%put_object(study%plan%parameters(k)%name, series(study%slopes(k, r, :)))
         end do
         object = members%get()
      end function derivatives

      !> What pins do.
      function clearances() result(object)
         character(:), allocatable :: object               !! as text

         type(json_object_t) :: members
         integer :: k, n

         n = size(study%plan%parameters)
         call members%start(3)
         do k = 1, size(study%pins)
            associate (found => study%derivatives)
               call members%put_object(study%pins(k)%joint, series(study%widths(n + k, r, :), &
                  [character(11) :: "sigma", "x", "y", "direction_x", "direction_y"], &
                  reshape([sqrt(study%parts(n + k, r, :)), found%pins(1, k, r, :), found%pins(2, k, r, :), &
                           found%directions(1, k, :), found%directions(2, k, :)], [size(found%instants), 5])))
            end associate
         end do
         object = members%get()
      end function clearances

      !> Sobol' indices of all contributors.
      function indices() result(object)
         character(:), allocatable :: object               !! as text

         type(json_object_t) :: members
         real(wp), allocatable :: share(:)
         integer :: k

         call members%start(3)
         do k = 1, size(study%contributors)
            share = study%parts(k, r, :)/max(study%sigma(r, :)**2, tiny(1.0_wp))
            associate (first => study%indices%first(:, k, r, :), total => study%indices%total(:, k, r, :))
               call members%put_object(study%contributors(k)%s, series(first(1, :), &
                  [character(10) :: "low", "high", "total", "total_low", "total_high", "linear"], &
                  reshape([first(2, :), first(3, :), total(1, :), total(2, :), total(3, :), share], [size(share), 6])))
            end associate
         end do
         object = members%get()
      end function indices

      !> The cheapest tolerances.
      function cheapest() result(object)
         character(:), allocatable :: object               !! as text

         type(json_object_t) :: members, widths
         integer :: k

         call members%start(3)
         call members%put_real("target", study%plan%sampling%target)
         call members%put_real("sigma", study%allocations(r)%sigma)
         call members%put_real("cost_now", sum(study%plan%costs))
         call members%put_real("cost", study%allocations(r)%cost)
         call widths%start(4)
         do k = 1, size(study%plan%parameters)
            associate (parameter => study%plan%parameters(k))
               call widths%put_real(parameter%name, 0.5_wp*(parameter%upper - parameter%lower)*study%allocations(r)%factors(k))
            end associate
         end do
         call members%put_object("width", widths%get())
         object = members%get()
      end function cheapest

      !> The variance, between parts and within the motion.
      function variances() result(object)
         character(:), allocatable :: object               !! as text

         type(json_object_t) :: members

         associate (split => study%splits(r))
            call members%start(3)
            call members%put_real("parts", split%parts)
            call members%put_real("motion", split%motion)
            call members%put_object("share_within", interval(split%share, 4))
            call members%put_integer("members", int(split%n_parts, i8))
         end associate
         object = members%get()
      end function variances

      !> The histogram.
      function histogram() result(object)
         character(:), allocatable :: object               !! as text

         type(json_object_t) :: members

         call members%start(3)
         call members%put_real("time", study%derivatives%instants(study%members%at(r))%t)
         call members%put_reals("edges", study%members%edges(:, r))
         call members%put_reals("counts", real(study%members%counts(:, r), wp))
         object = members%get()
      end function histogram

   end function object_of_request

   !> A value with its interval.
   function interval(of, depth) result(text)
      real(wp), intent(in) :: of(3)                    !! (3) value, ends of its interval of 95 % [any]
      integer, intent(in) :: depth                     !! objects around it
      character(:), allocatable :: text                !! the object

      type(json_object_t) :: one

      call one%start(depth)
      call one%put_real("value", of(1))
      call one%put_real("low", of(2))
      call one%put_real("high", of(3))
      text = one%get()
   end function interval

   !> A yield.
   function object_of_yield(yield, depth) result(text)
      type(yield_t), intent(in) :: yield               !! the yield
      integer, intent(in) :: depth                     !! objects around it
      character(:), allocatable :: text                !! the object

      type(json_object_t) :: one

      call one%start(depth)
      call one%put_real("value", real(yield%good, wp)/real(yield%n, wp))
      call one%put_real("low", yield%low)
      call one%put_real("high", yield%high)
      call one%put_integer("good", yield%good)
      call one%put_integer("members", yield%n)
      call one%put_integer("open", yield%open)
      text = one%get()
   end function object_of_yield

   !> How members are made.
   pure function method_of(study) result(word)
      type(tolerance_study_t), intent(in) :: study     !! the study
      character(:), allocatable :: word                !! one word

      word = "expansion"
      if (study%members%is_exact) word = "exact"
      if (study%plan%level == level_dynamic) word = "runs"
   end function method_of

   !> What is common to all channels.
   function object_of_study(study) result(text)
      type(tolerance_study_t), intent(in) :: study     !! the study
      character(:), allocatable :: text                !! the object

      type(json_object_t) :: one, parameters, pins
      integer :: k

      call one%start(1)
      call parameters%start(2)
      do k = 1, size(study%plan%parameters)
         block
            type(json_object_t) :: row

            associate (parameter => study%plan%parameters(k))
               call row%start(3)
               call row%put_text("unit", unit_text(parameter%dimension))
               call row%put_real("nominal", parameter%nominal)
               call row%put_real("lower", parameter%nominal + parameter%lower)
               call row%put_real("upper", parameter%nominal + parameter%upper)
               call row%put_real("mean", parameter%nominal + parameter%mean)
               call row%put_real("sigma", parameter%sigma)
               call parameters%put_object(parameter%name, row%get())
            end associate
         end block
      end do
      call one%put_object("parameters", parameters%get())
      call pins%start(2)
      do k = 1, size(study%pins)
         block
            type(json_object_t) :: row

            call row%start(3)
            call row%put_text("pin", trim(positions(study%pins(k)%position)))
            call row%put_real("clearance", study%pins(k)%clearance)
            call pins%put_object(study%pins(k)%joint, row%get())
         end block
      end do
      call one%put_object("joints", pins%get())
      call one%put_object("yield", object_of_yield(study%members%yield, 2))
      call one%put_text("level", trim(merge("dynamic  ", "kinematic", study%plan%level == level_dynamic)))
      call one%put_text("method", method_of(study))
      call one%put_integer("members", study%members%n)
      call one%put_integer("open", study%members%open)
      call one%put_integer("checked", int(study%n_checked, i8))
      call one%put_integer("checked_open", int(study%n_open, i8))
      call one%put_integer("points", int(study%indices%points, i8))
      call one%put_integer("points_open", study%indices%open)
      call one%put_real("cpu_members", study%cpu_members)
      text = one%get()
   end function object_of_study

end module tolerance_object
