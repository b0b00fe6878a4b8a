!> The list `modes` of summary.json, and the object `linear_model`.
module modes_object
   use json_text, only: json_object_t, json_string
   use kinds, only: i8, wp
   use modes_results, only: mode_t, modes_study_t
   use modes_tables, only: stability_of
   use text, only: exact_text, text_t
   implicit none (type, external)
   private
   public :: put_modes

   real(wp), parameter :: least = 1.0e-3_wp   !! share of a direction that is written [1]

contains

   !> Add list and object.
   subroutine put_modes(json, study)
      type(json_object_t), intent(inout) :: json     !! grown
      type(modes_study_t), intent(in) :: study       !! the study

      type(json_object_t) :: object, one
      type(text_t), allocatable :: list(:)
      integer :: k

      call object%start(1)
      call object%put_text("state", study%state)
      call object%put_real("time", study%t)
      call object%put_text("axes", study%plan%axes_name)
      call object%put_integer("degrees_of_freedom", int(study%model%n_free, i8))
      call object%put_integer("states", int(study%model%n_state, i8))
      call object%put_text("stability", stability_of(study))
      call object%put_real("residual", study%model%residual)
      call object%put_real("unsteady", study%model%unsteady)
      call object%put_list("inputs", study%model%inputs)
      allocate (list(size(study%plan%outputs)))
      do k = 1, size(list)
         list(k)%s = study%plan%outputs(k)%name
      end do
      call object%put_list("outputs", list)
      call json%put_object("linear_model", object%get())
      deallocate (list)
      allocate (list(size(study%modes)))
      do k = 1, size(list)
         associate (mode => study%modes(k))
            one = json_object_t()
            call one%start(1)
            call one%put_reals("eigenvalue", [mode%eigenvalue%re, mode%eigenvalue%im])
            call one%put_real("frequency", mode%frequency)
            call one%put_real("damping_ratio", mode%damping_ratio)
            call one%put_object("participation", participation(study, mode))
            list(k)%s = one%get()
         end associate
      end do
      call json%put_objects("modes", list)
   end subroutine put_modes

   !> Shares of the directions of bodies, those that matter.
   function participation(study, mode) result(text)
      type(modes_study_t), intent(in) :: study       !! for the names
      type(mode_t), intent(in) :: mode               !! the mode
      character(:), allocatable :: text              !! an object

      integer :: i, k

      text = ""
      do k = 1, size(mode%share, 2)
         do i = 1, size(mode%share, 1)
            if (mode%share(i, k) < least) cycle
            if (text /= "") text = text//", "
            text = text//json_string(study%bodies(k)%s//"."//study%components(i)%s)//": "//exact_text(mode%share(i, k))
         end do
      end do
      text = "{"//text//"}"
   end function participation

end module modes_object
