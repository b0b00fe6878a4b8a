!> The results of a study of tolerances as tables: channels, contributors, everything over the output times, histograms.
module tolerance_tables
   use dimension_text, only: unit_text
   use kinds, only: not_a_number, wp
   use result_table, only: in_csv, in_hdf5, only_shown, result_table_t
   use text, only: text_t
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: table_of_contributors, table_of_derivatives, table_of_histograms, table_of_requests, table_of_splits, &
      table_of_times, table_of_widths

   integer, parameter :: in_files = in_csv + in_hdf5   !! for programs, but not in JSON, which has objects of its own

contains

   !> The channels, each at the time that is shown of it.
   function table_of_requests(study) result(table)
      type(tolerance_study_t), intent(in) :: study   !! the study
      type(result_table_t) :: table                  !! a row for each channel

      type(text_t), allocatable :: names(:)
      integer, allocatable :: at(:)
      real(wp), allocatable :: yields(:, :)
      integer :: n, r

      n = size(study%requests)
      allocate (names(n), table%units(n), yields(n, 3))
      at = study%members%at
      do r = 1, n
         names(r)%s = study%requests(r)%name
         table%units(r)%s = study%requests(r)%unit
         associate (yield => study%members%yields(r))
            yields(r, :) = [real(yield%good, wp)/real(yield%n, wp), yield%low, yield%high]
         end associate
         if (.not. study%requests(r)%is_limited) yields(r, :) = not_a_number()
      end do
      call table%start("requests", "tolerance_requests", n, title="Channels")
      call table%put("request", "1", "channel", texts=names, heading="channel", formats=in_files)
      call table%put("time", "s", "time at which its mean is next to a limit, in standard deviations; else that of its "// &
                     "maximum deviation", study%derivatives%instants(at)%t, heading="time", formats=in_files)
      call put("nominal", "nominal value", study%derivatives%values, "nominal")
      call put("low", "worst case, lower end", study%low, "worst from")
      call put("high", "worst case, upper end", study%high, "to")
      call put("sigma", "standard deviation, root sum square", study%sigma, "sigma")
      call put("mean", "mean to second order", study%mean, "mean")
      call put("sampled_mean", "mean of the members", study%members%mean, "sampled")
      call put("sampled_sigma", "standard deviation of the members", study%members%sigma, "sigma")
      call table%put("yield", "1", "members within the limits at all times; NaN: no limits", yields(:, 1), heading="yield", &
                     formats=in_files)
      call table%put("yield_low", "1", "lower end of its interval of 95 %", yields(:, 2), heading="95 % from", formats=in_files)
      call table%put("yield_high", "1", "upper end of it", yields(:, 3), heading="to", formats=in_files)
      call table%put("capability", "1", "process capability Cpk: distance of the mean to the next limit, of three standard "// &
                     "deviations; NaN: no limits", study%members%capability(1, :), heading="Cpk", digits=4, formats=in_files)
      call table%put("capability_low", "1", "lower end of its interval of 95 %", study%members%capability(2, :), &
                     formats=in_files)
      call table%put("capability_high", "1", "upper end of it", study%members%capability(3, :), formats=in_files)
      if (allocated(study%members%failures)) call put_failures(study%members%failures)
      if (allocated(study%indices%missed)) then
         call table%put("missed", "1", "part of the variance that the polynomial of the indices misses; NaN: nothing scatters", &
                        study%indices%missed, heading="missed", digits=2, formats=in_files)
      end if
      call table%put("expansion_error", "rows", "maximum error of the expansion in checked members", study%errors, &
                     heading="error", digits=2, formats=in_files)

   contains

      !> The columns of rare failures.
      subroutine put_failures(failures)
         real(wp), intent(in) :: failures(:, :)   !! (3, requests) part that fails, ends of its interval [1]

         call table%put("failures", "1", "failures by importance sampling; NaN: no limits", failures(1, :), &
                        heading="failures", digits=4, formats=in_files)
         call table%put("failures_low", "1", "lower end of its interval of 95 %", failures(2, :), heading="95 % from", &
                        digits=3, formats=in_files)
         call table%put("failures_high", "1", "upper end of it", failures(3, :), heading="to", digits=3, formats=in_files)
      end subroutine put_failures

      !> A column with the values at the times of the rows.
      subroutine put(name, help, values, heading)
         character(*), intent(in) :: name       !! of the column
         character(*), intent(in) :: help       !! one line
         real(wp), intent(in) :: values(:, :)   !! (requests, times) values [any]
         character(*), intent(in) :: heading    !! for people

         call table%put(name, "rows", help, [(values(r, at(r)), r=1, n)], heading=heading, digits=6, formats=in_files)
      end subroutine put

   end function table_of_requests

   !> The cheapest tolerances of each request with limits.
   function table_of_widths(study) result(table)
      type(tolerance_study_t), intent(in) :: study   !! the study, its tolerances allocated
      type(result_table_t) :: table                  !! a row for each such request and parameter

      type(text_t), allocatable :: names(:), parameters(:), shown(:)
      real(wp), allocatable :: x(:, :)
      integer :: k, m, r

      m = size(study%plan%parameters)*count(study%requests%is_limited)
      allocate (names(m), parameters(m), shown(m), table%units(m), x(m, 4))
      m = 0
      do r = 1, size(study%requests)
         if (.not. study%requests(r)%is_limited) cycle
         do k = 1, size(study%plan%parameters)
            m = m + 1
            names(m)%s = study%requests(r)%name
            associate (parameter => study%plan%parameters(k), factor => study%allocations(r)%factors(k))
               parameters(m)%s = parameter%name
               table%units(m)%s = unit_text(parameter%dimension)
               shown(m)%s = names(m)%s//" by "//parameter%name
               x(m, :) = [0.5_wp*(parameter%upper - parameter%lower), 0.5_wp*(parameter%upper - parameter%lower)*factor, &
                          study%plan%costs(k), study%plan%costs(k)/factor]
            end associate
         end do
      end do
      call table%start("widths", "tolerance_widths", m, title="Cheapest tolerances for the target yield")
      call table%put("row", "1", "request and parameter", texts=shown, heading="parameter", formats=only_shown)
      call table%put("request", "1", "request", texts=names, formats=in_files)
      call table%put("parameter", "1", "parameter", texts=parameters, formats=in_files)
      call table%put("width", "rows", "half the width of its tolerance", x(:, 1), heading="now", digits=4, formats=in_files)
      call table%put("cheapest", "rows", "half the cheapest width; NaN: none reaches the yield", x(:, 2), heading="cheapest", &
                     digits=4, formats=in_files)
      call table%put("cost", "1", "cost now", x(:, 3), heading="cost", digits=4, formats=in_files)
      call table%put("cheapest_cost", "1", "cost with the cheapest width; NaN: none reaches the yield", x(:, 4), &
                     heading="cheapest", digits=4, formats=in_files)
   end function table_of_widths

   !> The variance of each number of a run, between parts and within the motion.
   function table_of_splits(study) result(table)
      type(tolerance_study_t), intent(in) :: study   !! the study, its variances split
      type(result_table_t) :: table                  !! a row for each request

      type(text_t) :: names(size(study%splits))
      integer :: r

      allocate (table%units(size(names)))
      do r = 1, size(names)
         names(r)%s = study%requests(r)%name
         table%units(r)%s = study%requests(r)%unit
      end do
      associate (splits => study%splits)
         call table%start("splits", "tolerance_splits", size(names), title="Between parts and within the motion")
         call table%put("request", "1", "number of a run", texts=names, heading="number", formats=in_files)
         call table%put("parts", "rows", "standard deviation between parts", sqrt(splits%parts), heading="between parts", &
                        digits=4, formats=in_files)
         call table%put("motion", "rows", "standard deviation within the motion of a part", sqrt(splits%motion), &
                        heading="within motion", digits=4, formats=in_files)
         call table%put("share", "1", "share of the variance that is within the motion; NaN: nothing scatters", &
                        [(splits(r)%share(1), r=1, size(names))], heading="share within", digits=4, formats=in_files)
         call table%put("share_low", "1", "lower end of its interval of 95 %", [(splits(r)%share(2), r=1, size(names))], &
                        heading="95 % from", digits=4, formats=in_files)
         call table%put("share_high", "1", "upper end of it", [(splits(r)%share(3), r=1, size(names))], heading="to", digits=4, &
                        formats=in_files)
         call table%put("members", "1", "parts none of whose runs failed", integers=splits%n_parts, formats=in_files)
      end associate
   end function table_of_splits

   !> The contributors of each channel at the time that is shown of it, largest first.
   function table_of_contributors(study) result(table)
      type(tolerance_study_t), intent(in) :: study   !! the study
      type(result_table_t) :: table                  !! a row for each channel and contributor

      type(text_t), allocatable :: channels(:), contributors(:), shown(:)
      real(wp), allocatable :: x(:, :)
      integer, allocatable :: order(:)
      integer :: at, i, k, m, n, r

      n = size(study%contributors)
      m = n*size(study%requests)
      allocate (channels(m), contributors(m), shown(m), x(m, 9), table%units(m))
      m = 0
      do r = 1, size(study%requests)
         at = study%members%at(r)
         order = descending(study%parts(:, r, at))
         do i = 1, n
            k = order(i)
            m = m + 1
            channels(m)%s = study%requests(r)%name
            contributors(m)%s = study%contributors(k)%s
            shown(m)%s = channels(m)%s//" by "//contributors(m)%s
            table%units(m)%s = study%requests(r)%unit
            x(m, 1) = study%widths(k, r, at)
            x(m, 2) = sqrt(study%parts(k, r, at))
            x(m, 3) = study%parts(k, r, at)/max(study%sigma(r, at)**2, tiny(1.0_wp))
            x(m, 4:6) = study%indices%first(:, k, r, at)
            x(m, 7:9) = study%indices%total(:, k, r, at)
         end do
      end do
      call table%start("contributors", "tolerance_contributors", m, title="Contributors", elsewhere="tolerance_derivatives.csv")
      call table%put("row", "1", "channel and contributor", texts=shown, heading="contributor", formats=only_shown)
      call table%put("request", "1", "channel", texts=channels, formats=in_files)
      call table%put("contributor", "1", "parameter, joint or batch", texts=contributors, formats=in_files)
      call table%put("width", "rows", "what it adds to half the width of the worst case", x(:, 1), heading="worst case", &
                     formats=in_files)
      call table%put("sigma", "rows", "standard deviation that it makes, to first order", x(:, 2), heading="sigma", &
                     formats=in_files)
      call table%put("linear", "1", "its part of the variance, to first order", x(:, 3), heading="part", digits=4, &
                     formats=in_files)
      call table%put("first", "1", "Sobol' index; NaN: nothing scatters", x(:, 4), heading="Sobol' index", digits=3, &
                     formats=in_files)
      call table%put("first_low", "1", "lower end of its interval of 95 %", x(:, 5), heading="95 % from", digits=3, &
                     formats=in_files)
      call table%put("first_high", "1", "upper end of it", x(:, 6), heading="to", digits=3, formats=in_files)
      call table%put("total", "1", "total index; NaN: nothing scatters", x(:, 7), heading="total", digits=3, formats=in_files)
      call table%put("total_low", "1", "lower end of its interval of 95 %", x(:, 8), formats=in_files)
      call table%put("total_high", "1", "upper end of it", x(:, 9), formats=in_files)
   end function table_of_contributors

   !> Order of numbers, largest first.
   pure function descending(x) result(order)
      real(wp), intent(in) :: x(:)        !! (n) numbers [any]
      integer :: order(size(x))           !! (n) their places

      logical :: is_left(size(x))
      integer :: k

      is_left = .true.
      do k = 1, size(x)
         order(k) = maxloc(x, dim=1, mask=is_left)
         is_left(order(k)) = .false.
      end do
   end function descending

   !> Everything of the channels over the output times.
   function table_of_times(study) result(table)
      type(tolerance_study_t), intent(in) :: study   !! the study
      type(result_table_t) :: table                  !! a row for each channel and time

      type(text_t), allocatable :: channels(:)
      integer :: at, m, n_time, r

      n_time = size(study%derivatives%instants)
      m = n_time*size(study%requests)
      allocate (channels(m), table%units(m))
      do r = 1, size(study%requests)
         do at = 1, n_time
            m = (r - 1)*n_time + at
            channels(m)%s = study%requests(r)%name
            table%units(m)%s = study%requests(r)%unit
         end do
      end do
      m = n_time*size(study%requests)
      call table%start("times", "tolerance_times", m)
      call table%put("request", "1", "channel", texts=channels, formats=in_files)
      call table%put("unit", "1", "its SI unit", texts=table%units, formats=in_csv)
      call table%put("time", "s", "output time", [(study%derivatives%instants%t, r=1, size(study%requests))], formats=in_files)
      call put("nominal", "nominal value", study%derivatives%values)
      call put("low", "worst case, lower end", study%low)
      call put("high", "worst case, upper end", study%high)
      call put("sigma", "standard deviation, root sum square", study%sigma)
      call put("mean", "mean to second order", study%mean)
      call put("sampled_mean", "mean of the members", study%members%mean)
      call put("sampled_mean_half", "half of its interval of 95 %", study%members%mean_half)
      call put("sampled_sigma", "standard deviation of the members", study%members%sigma)
      call put("sampled_sigma_low", "lower end of its interval of 95 %", study%members%sigma_low)
      call put("sampled_sigma_high", "upper end of it", study%members%sigma_high)
      call put("lowest", "lowest value of a member", study%members%lowest)
      call put("highest", "highest value of a member", study%members%highest)

   contains

      !> A column.
      subroutine put(name, help, values)
         character(*), intent(in) :: name       !! of the column
         character(*), intent(in) :: help       !! one line
         real(wp), intent(in) :: values(:, :)   !! (requests, times) values [any]

         call table%put(name, "rows", help, reshape(transpose(values), [size(values)]), formats=in_files)
      end subroutine put

   end function table_of_times

   !> Everything of the contributors over the output times.
   function table_of_derivatives(study) result(table)
      type(tolerance_study_t), intent(in) :: study   !! the study
      type(result_table_t) :: table                  !! a row for each channel, contributor and time

      type(text_t), allocatable :: by(:), channels(:), contributors(:)
      real(wp), allocatable :: x(:, :)
      integer :: at, k, m, n, r

      n = size(study%contributors)
      m = n*size(study%requests)*size(study%derivatives%instants)
      allocate (by(m), channels(m), contributors(m), table%units(m), x(m, 10))
      m = 0
      do r = 1, size(study%requests)
         do k = 1, n
            do at = 1, size(study%derivatives%instants)
               m = m + 1
               channels(m)%s = study%requests(r)%name
               contributors(m)%s = study%contributors(k)%s
               table%units(m)%s = study%requests(r)%unit
               by(m)%s = "m"
               x(m, 1) = study%derivatives%instants(at)%t
               x(m, 2) = not_a_number()
               if (k <= size(study%plan%parameters)) then
                  by(m)%s = unit_text(study%plan%parameters(k)%dimension)
                  x(m, 2) = study%slopes(k, r, at)
               end if
               x(m, 3) = study%widths(k, r, at)
               x(m, 4) = sqrt(study%parts(k, r, at))
               x(m, 5:7) = study%indices%first(:, k, r, at)
               x(m, 8:10) = study%indices%total(:, k, r, at)
            end do
         end do
      end do
      call table%start("derivatives", "tolerance_derivatives", m)
      call table%put("request", "1", "channel", texts=channels, formats=in_files)
      call table%put("unit", "1", "its SI unit", texts=table%units, formats=in_csv)
      call table%put("contributor", "1", "parameter, joint or batch", texts=contributors, formats=in_files)
      call table%put("contributor_unit", "1", "its SI unit", texts=by, formats=in_files)
      call table%put("time", "s", "output time", x(:, 1), formats=in_files)
      call table%put("derivative", "1", "derivative of the channel by the parameter, in the units of both; NaN: a joint", x(:, 2), &
                     formats=in_files)
      call table%put("width", "rows", "what it adds to half the width of the worst case", x(:, 3), formats=in_files)
      call table%put("sigma", "rows", "standard deviation that it makes, to first order", x(:, 4), formats=in_files)
      call table%put("first", "1", "Sobol' index; NaN: nothing scatters", x(:, 5), formats=in_files)
      call table%put("first_low", "1", "lower end of its interval of 95 %", x(:, 6), formats=in_files)
      call table%put("first_high", "1", "upper end of it", x(:, 7), formats=in_files)
      call table%put("total", "1", "total index; NaN: nothing scatters", x(:, 8), formats=in_files)
      call table%put("total_low", "1", "lower end of its interval of 95 %", x(:, 9), formats=in_files)
      call table%put("total_high", "1", "upper end of it", x(:, 10), formats=in_files)
   end function table_of_derivatives

   !> Histograms of the channels.
   function table_of_histograms(study) result(table)
      type(tolerance_study_t), intent(in) :: study   !! the study
      type(result_table_t) :: table                  !! a row for each channel and bin

      type(text_t), allocatable :: channels(:)
      integer :: bin, m, n, r

      n = size(study%members%counts, 1)
      m = n*size(study%requests)
      allocate (channels(m), table%units(m))
      do r = 1, size(study%requests)
         do bin = 1, n
            channels((r - 1)*n + bin)%s = study%requests(r)%name
            table%units((r - 1)*n + bin)%s = study%requests(r)%unit
         end do
      end do
      call table%start("histograms", "tolerance_histograms", m)
      call table%put("request", "1", "channel", texts=channels, formats=in_hdf5)
      associate (edges => study%members%edges)
         call table%put("from", "rows", "lower edge of the bin; the outer bins have all beyond", reshape(edges(:n - 1, :), [m]), &
                        formats=in_hdf5)
         call table%put("to", "rows", "upper edge of the bin", reshape(edges(1:n, :), [m]), formats=in_hdf5)
      end associate
      call table%put("members", "1", "members in it", counts=reshape(study%members%counts, [m]), formats=in_hdf5)
   end function table_of_histograms

end module tolerance_tables
