!> Harmonic function of the time.
!>
!> f(t) = offset + amplitude sin(angular_frequency t + phase)
!>
!> Source: Flores et al. (2008), section 2.2 (driver functions). Limits: none.
module function_harmonic
   use curve, only: beyond_same
   use dimension_text, only: dimension_name
   use function_kind, only: function_kind_t, made_t
   use item, only: item_t, place_of
   use kind_info, only: add_any_number, add_number, dim_angle, dim_angular_speed, dim_time, kind_info_t, same_dimension
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: function_harmonic_t

   !> The kind.
   type, extends(function_kind_t) :: function_harmonic_t
   contains
      procedure, nopass :: info => harmonic_info
      procedure, nopass :: make => harmonic_make
   end type function_harmonic_t

contains

   !> Description of the kind.
   function harmonic_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "function.harmonic"
      info%help = "sine of the time; expressions call it by its name: {swing(t)}"
      info%source = "Flores et al. (2008), section 2.2"
      call add_any_number(info, "amplitude", "amplitude")
      call add_number(info, "angular_frequency", dim_angular_speed, "angular frequency; 2 pi times the frequency")
      call add_number(info, "phase", dim_angle, "phase at t = 0", default="0 rad")
      call add_any_number(info, "offset", "mean value", default="0")
   end function harmonic_info

   !> The curve of a row.
   subroutine harmonic_make(item, made)
      type(item_t), intent(inout) :: item  !! the row
      type(made_t), intent(out) :: made    !! the curve, or the first error

      associate (amplitude => item%values(place_of(item, "amplitude")), offset => item%values(place_of(item, "offset")))
         made%argument = dim_time
         made%dimension = amplitude%dimensions(1)
         made%curve%beyond = beyond_same
         made%curve%amplitude = amplitude%number
         made%curve%angular_frequency = item%number("angular_frequency")
         made%curve%phase = item%number("phase")
         allocate (made%curve%x(1), source=0.0_wp)
         allocate (made%curve%c(0:0, 1), source=offset%number)
         if (.not. offset%given .or. same_dimension(offset%dimensions(1), made%dimension)) return
         made%column = place_of(item, "offset")
         made%message = "the amplitude is "//dimension_name(made%dimension)
         made%help = "amplitude and offset need the same dimension"
      end associate
   end subroutine harmonic_make

end module function_harmonic
