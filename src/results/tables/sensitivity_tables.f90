!> The results of a study of sensitivities as tables: the derivatives, the results that they are of, the motion.
module sensitivity_tables
   use kinds, only: not_a_number, wp
   use result_table, only: in_csv, in_hdf5, in_json, result_table_t
   use sensitivity_results, only: sensitivity_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: table_of_derivatives, table_of_motion, table_of_parameters, table_of_results

contains

   !> A row for each result and parameter.
   function table_of_derivatives(study) result(table)
      type(sensitivity_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! derivatives and errors

      type(text_t), allocatable :: parameters(:), results(:), units(:), reasons(:)
      integer :: k, n, p, row

      p = size(study%plan%parameters)
      n = p*size(study%plan%results)
      allocate (parameters(n), results(n), units(n), reasons(n))
      do row = 1, n
         k = (row - 1)/p + 1
         associate (q => row - (k - 1)*p)
            results(row)%s = study%plan%results(k)%word
            parameters(row)%s = study%plan%parameters(q)%s
            units(row)%s = unit_of(study%plan%results(k)%unit, study%plan%units(q)%s)
            reasons(row)%s = study%reason(q, k)%s
         end associate
      end do
      call table%start("derivatives", "sensitivity", n, title="Derivatives", elsewhere="sensitivity.csv")
      table%most = 400
      call table%put("result", "1", "what is derived, as in the deck", texts=results, formats=in_hdf5 + in_csv, heading="result")
      call table%put("parameter", "1", "by which parameter", texts=parameters, formats=in_hdf5 + in_csv, heading="by")
      call table%put("value", "1", "the derivative, in its unit; NaN: refused, see reason", [study%derivative], &
                     formats=in_hdf5 + in_csv, heading="derivative", digits=9)
      call table%put("error", "1", "its estimated error, in its unit; NaN: refused", [study%error], formats=in_hdf5 + in_csv, &
                     heading="error", digits=2)
      call table%put("unit", "1", "SI unit of the derivative and its error", texts=units, formats=in_hdf5 + in_csv, &
                     heading="unit")
      call table%put("reason", "1", "why it is refused; blank: it is not", texts=reasons, formats=in_hdf5 + in_csv)
   end function table_of_derivatives

   !> The unit of a derivative.
   pure function unit_of(result_unit, parameter_unit) result(unit)
      character(*), intent(in) :: result_unit       !! SI; 1: none
      character(*), intent(in) :: parameter_unit    !! SI; blank or 1: none
      character(:), allocatable :: unit             !! of their quotient

      unit = result_unit
      if (parameter_unit == "" .or. parameter_unit == "1") return
      if (scan(parameter_unit, "/.") > 0) then
         unit = result_unit//"/("//parameter_unit//")"
      else
         unit = result_unit//"/"//parameter_unit
      end if
   end function unit_of

   !> A row for each result.
   function table_of_results(study) result(table)
      type(sensitivity_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! the results themselves

      type(text_t), allocatable :: results(:), units(:)
      integer :: k

      associate (n => size(study%plan%results))
         allocate (results(n), units(n))
         do k = 1, n
            results(k)%s = study%plan%results(k)%word
            units(k)%s = study%plan%results(k)%unit
         end do
         call table%start("sensitivity_results", "sensitivity_results", n, title="Results")
         call table%put("result", "1", "as in the deck", texts=results, heading="result")
         call table%put("time", "s", "when; NaN: the motion has no such result", study%t, heading="time [s]", digits=8)
         call table%put("value", "list", "the result; NaN: the motion has none", study%value, heading="value", digits=9)
         call table%put("error", "list", "its estimated error; NaN: the motion has no such result", study%value_error, &
                        heading="error", digits=2)
         call table%put("unit", "1", "its SI unit", texts=units, formats=in_json + in_csv, heading="unit")
         table%units = units
      end associate
   end function table_of_results

   !> A row for each parameter.
   function table_of_parameters(study) result(table)
      type(sensitivity_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! values, and how far grazing is

      real(wp) :: grazing(size(study%grazing))

      grazing = study%grazing
      where (grazing >= huge(1.0_wp)) grazing = not_a_number()
      call table%start("sensitivity_parameters", "sensitivity_parameters", size(grazing), title="Parameters")
      call table%put("parameter", "1", "name of the parameter", texts=study%plan%parameters, heading="parameter")
      call table%put("value", "list", "its value in the deck", study%plan%values, heading="value", digits=9)
      call table%put("grazing", "list", "minimum change of the parameter at which an onset grazes, by the derivative of its " &
                     //"speed; NaN: no onset depends on it", grazing, heading="grazing at", digits=3)
      call table%put("unit", "1", "its SI unit", texts=study%plan%units, formats=in_json + in_csv, heading="unit")
      table%units = study%plan%units
   end function table_of_parameters

   !> Facts of the motion.
   function table_of_motion(study) result(table)
      type(sensitivity_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! facts only

      call table%start("motion", "motion", 0, object="motion")
      call table%fact("tolerance", study%plan%tolerance)
      call table%fact("end", study%plan%end)
      call table%fact("horizon", merge(study%horizon, not_a_number(), study%horizon < huge(1.0_wp)))
      call table%fact("steps", study%n_step)
      call table%fact("events", study%n_event)
   end function table_of_motion

end module sensitivity_tables
