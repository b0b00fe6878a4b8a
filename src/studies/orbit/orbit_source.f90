!> Where scenes with another value of the parameter of a branch come from, and the period that each of them has.
module orbit_source
   use jobs, only: copy_job, job_t
   use kinds, only: wp
   use parameter_source, only: parameter_source_t
   implicit none (type, external)
   private
   public :: branch_source_t, fixed_parameter, orbit_source_t, varied_parameter

   integer, parameter :: fixed_parameter = 0    !! the scene at the present value, for states beside
   integer, parameter :: varied_parameter = 1   !! the scene with another value

   !> Makes scenes of a deck; each has a period.
   type, abstract :: orbit_source_t
   contains
      procedure(scene_interface), deferred :: scene_at
   end type orbit_source_t

   abstract interface
      !> The scene with the parameter changed, and its period.
      subroutine scene_interface(self, p, job, period, reason)
         import :: job_t, orbit_source_t, wp
         implicit none (type, external)
         class(orbit_source_t), intent(inout) :: self        !! the deck
         real(wp), intent(in) :: p                           !! value of the parameter, SI; not used without one [any]
         type(job_t), intent(inout) :: job                   !! the scene with it
         real(wp), intent(out) :: period                     !! of its drivers [s]
         character(:), allocatable, intent(out) :: reason    !! what the deck says of the value; blank: it takes it
      end subroutine scene_interface
   end interface

   !> The scenes for the derivatives of one period.
   type, extends(parameter_source_t) :: branch_source_t
      class(orbit_source_t), pointer :: deck => null()   !! where scenes come from
      type(job_t) :: job                                 !! the scene at the present value
      real(wp) :: end = 0.0_wp                           !! length of the motion [s]
      integer :: n_period = 1                            !! periods of the drivers in it
   contains
      procedure :: make => make_scene
   end type branch_source_t

contains

   !> The scene at the present value or at another one; it ends when that at the present value does.
   subroutine make_scene(self, parameter, value, job, reason)
      class(branch_source_t), intent(inout) :: self       !! the scenes
      integer, intent(in) :: parameter                    !! one of the above
      real(wp), intent(in) :: value                       !! of the parameter, SI [any]
      type(job_t), intent(inout) :: job                   !! the scene
      character(:), allocatable, intent(out) :: reason    !! why there is none; blank: there is

      real(wp) :: period

      reason = ""
      if (parameter == fixed_parameter) then
         call copy_job(self%job, job)
      else
         call self%deck%scene_at(value, job, period, reason)
      end if
      if (reason == "") job%plan%end = self%end
   end subroutine make_scene

end module orbit_source
