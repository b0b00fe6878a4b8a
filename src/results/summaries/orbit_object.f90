!> The object `orbit` of summary.json.
module orbit_object
   use json_text, only: json_object_t
   use orbit_results, only: bifurcation_names, orbit_study_t
   use text, only: exact_text, text_t
   implicit none (type, external)
   private
   public :: put_orbit

contains

   !> Add the object.
   subroutine put_orbit(json, study, names)
      type(json_object_t), intent(inout) :: json     !! grown
      type(orbit_study_t), intent(in) :: study       !! the study
      type(text_t), intent(in) :: names(:)           !! (contacts) their names

      type(json_object_t) :: object, one
      type(text_t), allocatable :: list(:)
      integer :: k

      call object%start(1)
      associate (orbit => study%orbit, plan => study%plan)
         call object%put_real("period", orbit%period)
         call object%put_real("phase", orbit%phase)
         call object%put_logical("stable", orbit%is_stable)
         allocate (list(size(orbit%multipliers)))
         do k = 1, size(list)
            list(k)%s = "["//exact_text(orbit%multipliers(k)%re)//", "//exact_text(orbit%multipliers(k)%im)//"]"
         end do
         call object%put_objects("multipliers", list)
         deallocate (list)
         allocate (list(size(orbit%onset)))
         do k = 1, size(list)
            one = json_object_t()
            call one%start(2)
            call one%put_text("contact", names(orbit%contact(k))%s)
            call one%put_real("time", orbit%onset(k))
            call one%put_real("impact_speed", orbit%speed(k))
            list(k)%s = one%get()
         end do
         call object%put_objects("events", list)
         call object%put_real("residual", orbit%residual)
         deallocate (list)
         allocate (list(size(study%branch%bifurcations)))
         do k = 1, size(list)
            associate (bifurcation => study%branch%bifurcations(k))
               one = json_object_t()
               call one%start(2)
               call one%put_text("type", trim(bifurcation_names(bifurcation%kind)))
               call one%put_text("parameter", plan%parameter)
               call one%put_real("value", bifurcation%orbit%p)
               call one%put_real("phase", bifurcation%orbit%phase)
               list(k)%s = one%get()
            end associate
         end do
         call object%put_objects("bifurcations", list)
         if (plan%parameter /= "") then
            deallocate (list)
            allocate (list(2))
            list(1)%s = study%branch%low
            list(2)%s = study%branch%high
            call object%put_list("branch_ends", list)
         end if
      end associate
      call json%put_object("orbit", object%get())
   end subroutine put_orbit

end module orbit_object
