!> The object `sensitivity` of summary.json: RESULT: PARAMETER: value, error and, if it is refused, the reason.
module sensitivity_object
   use json_text, only: json_object_t
   use sensitivity_results, only: sensitivity_t
   implicit none (type, external)
   private
   public :: put_sensitivity

contains

   !> Add the object.
   subroutine put_sensitivity(json, study)
      type(json_object_t), intent(inout) :: json     !! grown
      type(sensitivity_t), intent(in) :: study       !! the study

      type(json_object_t) :: all, one, pair
      integer :: k, p

      call all%start(1)
      do k = 1, size(study%plan%results)
         one = json_object_t()
         call one%start(2)
         do p = 1, size(study%plan%parameters)
            pair = json_object_t()
            call pair%start(3)
            call pair%put_real("value", study%derivative(p, k))
            call pair%put_real("error", study%error(p, k))
            if (study%reason(p, k)%s /= "") call pair%put_text("reason", study%reason(p, k)%s)
            call one%put_object(study%plan%parameters(p)%s, pair%get())
         end do
         call all%put_object(study%plan%results(k)%word, one%get())
      end do
      call json%put_object("sensitivity", all%get())
   end subroutine put_sensitivity

end module sensitivity_object
