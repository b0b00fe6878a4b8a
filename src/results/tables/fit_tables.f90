!> The results of a fit as tables: unknowns, their correlations, sensors, the search, and data beside the model.
module fit_tables
   use fit_results, only: fit_t
   use kinds, only: not_a_number, wp
   use least_squares, only: end_converged, end_limit
   use result_table, only: in_csv, in_hdf5, in_json, result_table_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: table_of_correlations, table_of_data, table_of_search, table_of_sensors, table_of_unknowns

contains

   !> A row for each unknown.
   function table_of_unknowns(fit) result(table)
      type(fit_t), intent(in) :: fit           !! the fit
      type(result_table_t) :: table            !! values and intervals

      type(text_t), allocatable :: names(:), notes(:), units(:)
      integer :: k

      associate (n => size(fit%places))
         allocate (names(n), notes(n), units(n))
         do k = 1, n
            names(k)%s = fit%places(k)%name
            units(k)%s = fit%places(k)%unit
            notes(k)%s = ""
            if (.not. fit%is_seen(k)) notes(k)%s = "not seen"
            if (fit%partner(k) > 0) notes(k)%s = notes(k)%s//merge(", ", "  ", .not. fit%is_seen(k))//"not separated from "// &
               fit%places(fit%partner(k))%name
            notes(k)%s = trim(adjustl(notes(k)%s))
         end do
         call table%start("fit_parameters", "fit", n, title="Parameters")
         call table%put("parameter", "1", "PARAMETER, PARAMETER.SET, SENSOR.offset or SENSOR.delay", texts=names, &
                        heading="parameter")
         call table%put("value", "list", "its value", fit%value, heading="value", digits=8)
         call table%put("low", "list", "lower end of its 95 % interval; of one that is not seen, the lower bound", fit%low, &
                        heading="95 % from", digits=8)
         call table%put("high", "list", "upper end of its 95 % interval; of one that is not seen, the upper bound", fit%high, &
                        heading="to", digits=8)
         call table%put("deviation", "list", "its standard deviation along what the data see", fit%deviation, heading="deviation", &
                        digits=3)
         call table%put("seen", "1", "whether the data see it", logicals=fit%is_seen)
         call table%put("note", "1", "not seen, or which unknown it cannot be separated from", texts=notes, &
                        heading="note")
         call table%put("unit", "1", "its SI unit", texts=units, formats=in_json + in_csv)
         table%units = units
      end associate
   end function table_of_unknowns

   !> A row for each pair of unknowns.
   function table_of_correlations(fit) result(table)
      type(fit_t), intent(in) :: fit           !! the fit
      type(result_table_t) :: table            !! correlations

      type(text_t), allocatable :: one(:), other(:)
      real(wp), allocatable :: r(:)
      integer :: i, k, n, row

      n = size(fit%places)
      allocate (one(n*(n - 1)/2), other(n*(n - 1)/2), r(n*(n - 1)/2))
      row = 0
      do k = 1, n
         do i = k + 1, n
            row = row + 1
            one(row)%s = fit%places(k)%name
            other(row)%s = fit%places(i)%name
            r(row) = fit%correlation(k, i)
         end do
      end do
      call table%start("fit_correlations", "fit_correlations", row, title="Correlations")
      call table%put("parameter", "1", "one unknown", texts=one, heading="parameter")
      call table%put("with", "1", "the other one", texts=other, heading="with")
      call table%put("correlation", "1", "correlation of both", r, heading="correlation", digits=3)
   end function table_of_correlations

   !> A row for each sensor.
   function table_of_sensors(fit) result(table)
      type(fit_t), intent(in) :: fit           !! the fit
      type(result_table_t) :: table            !! noise and residuals

      type(text_t), allocatable :: channels(:), names(:), units(:)
      integer :: k

      associate (sensors => fit%sensors)
         allocate (channels(size(sensors)), names(size(sensors)), units(size(sensors)))
         do k = 1, size(sensors)
            channels(k)%s = sensors(k)%channel
            names(k)%s = sensors(k)%name
            units(k)%s = sensors(k)%unit
         end do
         call table%start("fit_sensors", "fit_sensors", size(sensors), title="Sensors")
         call table%put("sensor", "1", "name of the sensor", texts=names, heading="sensor")
         call table%put("channel", "1", "its channel", texts=channels, heading="channel")
         call table%put("data", "1", "numbers that were fitted", integers=sensors%n_used, heading="data")
         call table%put("sigma", "list", "standard deviation of its noise", sensors%sigma, heading="sigma", digits=4)
         call table%put("given", "1", "whether the deck gives it; else it is that of the residuals", logicals=sensors%is_given)
         call table%put("rms", "list", "root mean square of its residuals", sensors%rms, heading="residuals", digits=4)
         call table%put("unit", "1", "its SI unit", texts=units, formats=in_json + in_csv)
         table%units = units
      end associate
   end function table_of_sensors

   !> Facts of the search.
   function table_of_search(fit) result(table)
      type(fit_t), intent(in) :: fit           !! the fit
      type(result_table_t) :: table            !! facts only

      call table%start("fit_search", "fit_search", 0, object="fit_search")
      call table%fact("data", fit%n_data)
      call table%fact("deviation", fit%deviation_of_residuals)
      call table%fact("end", end_words(fit%search%end))
      call table%fact("derivatives", fit%search%n_derived)
      call table%fact("motions", fit%search%n_motion)
   end function table_of_search

   !> How the search ended.
   pure function end_words(end) result(words)
      integer, intent(in) :: end                  !! as `least_squares` has it
      character(:), allocatable :: words          !! one or two

      words = "stalled"
      if (end == end_converged) words = "converged"
      if (end == end_limit) words = "too many iterations"
   end function end_words

   !> A row for each number of the data.
   function table_of_data(fit) result(table)
      type(fit_t), intent(in) :: fit           !! the fit
      type(result_table_t) :: table            !! data, model, residuals

      type(text_t), allocatable :: sensors(:), sets(:), units(:)
      real(wp), allocatable :: x(:, :)
      integer :: i, k, n, s

      n = 0
      do k = 1, size(fit%sets)
         n = n + size(fit%sets(k)%x)
      end do
      allocate (sensors(n), sets(n), units(n), x(4, n))
      n = 0
      do k = 1, size(fit%sets)
         associate (set => fit%sets(k))
            do s = 1, size(fit%sensors)
               do i = 1, size(set%t)
                  n = n + 1
                  sets(n)%s = set%name
                  sensors(n)%s = fit%sensors(s)%name
                  units(n)%s = fit%sensors(s)%unit
                  x(:, n) = [set%t(i), set%x(s, i), set%model(s, i), not_a_number()]
                  x(4, n) = (set%x(s, i) - set%model(s, i))/fit%sensors(s)%sigma
               end do
            end do
         end associate
      end do
      call table%start("data", "fit_data", n, elsewhere="fit.csv")
      call table%put("set", "1", "set of data", texts=sets, formats=in_hdf5 + in_csv)
      call table%put("sensor", "1", "sensor", texts=sensors, formats=in_hdf5 + in_csv)
      call table%put("time", "s", "time of the motion", x(1, :), formats=in_hdf5 + in_csv)
      call table%put("data", "list", "what the sensor shows; NaN: nothing", x(2, :), formats=in_hdf5 + in_csv)
      call table%put("model", "list", "what it should show; NaN: not fitted", x(3, :), formats=in_hdf5 + in_csv)
      call table%put("residual", "1", "data less model, in standard deviations; NaN: not fitted", x(4, :), formats=in_hdf5 + in_csv)
      call table%put("unit", "1", "SI unit of data and model", texts=units, formats=in_csv)
      table%units = units
   end function table_of_data

end module fit_tables
