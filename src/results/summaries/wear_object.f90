!> The object `wear` of summary.json: for each joint that wears, measures of both surfaces with their interval, cycles and time.
module wear_object
   use json_text, only: json_object_t
   use kinds, only: not_a_number, wp
   use life_state, only: life_state_t, measure_names, n_measure
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: put_wear, put_wear_of_run

contains

   !> Add the object of a run, which knows no interval and no number of cycles.
   subroutine put_wear_of_run(json, surfaces, time)
      type(json_object_t), intent(inout) :: json        !! grown
      type(worn_surface_t), intent(in) :: surfaces(:)   !! (surfaces) bearing and journal of each joint side by side
      real(wp), intent(in) :: time                      !! of the run [s]

      type(life_state_t) :: state
      real(wp) :: values(n_measure, size(surfaces))

      call state%start(surfaces)
      values = state%measures(state%numbers(surfaces))
      call put_wear(json, surfaces, values, values, values, not_a_number(), time)
   end subroutine put_wear_of_run

   !> Add the object, if any surface wears.
   subroutine put_wear(json, surfaces, values, low, high, cycles, time)
      type(json_object_t), intent(inout) :: json        !! grown
      type(worn_surface_t), intent(in) :: surfaces(:)   !! (surfaces) bearing and journal of each joint side by side
      real(wp), intent(in) :: values(:, :)              !! (measures, surfaces) [m, m^3, rad]
      real(wp), intent(in) :: low(:, :)                 !! (measures, surfaces) lower ends of their intervals [m, m^3, rad]
      real(wp), intent(in) :: high(:, :)                !! (measures, surfaces) upper ends [m, m^3, rad]
      real(wp), intent(in) :: cycles                    !! number of cycles; NaN: not known [1]
      real(wp), intent(in) :: time                      !! in which it was worn [s]

      type(json_object_t) :: all, joint, measure, surface
      integer :: i, k

      if (size(surfaces) == 0) return
      call all%start(1)
      do k = 1, size(surfaces)
         if (modulo(k, 2) == 1) then
            joint = json_object_t()
            call joint%start(2)
         end if
         surface = json_object_t()
         call surface%start(3)
         do i = 1, n_measure
            measure = json_object_t()
            call measure%start(4)
            call measure%put_real("value", values(i, k))
            call measure%put_real("low", low(i, k))
            call measure%put_real("high", high(i, k))
            call surface%put_object(trim(measure_names(i)), measure%get())
         end do
         call joint%put_object(surfaces(k)%side, surface%get())
         if (modulo(k, 2) == 1) cycle
         call joint%put_real("cycles", cycles)
         call joint%put_real("time", time)
         call all%put_object(surfaces(k)%joint, joint%get())
      end do
      call json%put_object("wear", all%get())
   end subroutine put_wear

end module wear_object
