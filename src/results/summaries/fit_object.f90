!> The object `fit` of summary.json: PARAMETER: value, ends of the 95 % interval, standard deviation, and whether the data see it.
module fit_object
   use fit_results, only: fit_t
   use json_text, only: json_object_t
   implicit none (type, external)
   private
   public :: put_fit

contains

   !> Add the object.
   subroutine put_fit(json, fit)
      type(json_object_t), intent(inout) :: json     !! grown
      type(fit_t), intent(in) :: fit                 !! the fit

      type(json_object_t) :: all, one
      integer :: k

      call all%start(1)
      do k = 1, size(fit%places)
         one = json_object_t()
         call one%start(2)
         call one%put_real("value", fit%value(k))
         call one%put_real("low", fit%low(k))
         call one%put_real("high", fit%high(k))
         call one%put_real("deviation", fit%deviation(k))
         call one%put_logical("seen", fit%is_seen(k))
         call one%put_text("unit", fit%places(k)%unit)
         call all%put_object(fit%places(k)%name, one%get())
      end do
      call json%put_object("fit", all%get())
   end subroutine put_fit

end module fit_object
