!> Events that a look at the ends of a step would miss or make up: grazing, in and out, off the wall.
module test_grazing
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use event_description, only: check_description, run_through, description_t
   use kinds, only: pi, wp
   use ode_examples, only: new_particles, particles_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_grazing

contains

   subroutine run_test_grazing(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("in_and_out_within_a_step", test_in_and_out)
      call suite%test("grazing_by_a_nanometre", test_grazing_throw)
      call suite%test("grazing_of_a_spring", test_grazing_spring)
      call suite%test("touching_only", test_touching)
      call suite%test("brief_one_before_another", test_brief_before_another)
      call suite%test("start_on_the_wall", test_start_on_the_wall)
      call suite%test("leaving_for_ever", test_leaving_for_ever)
      call suite%test("zero_for_ever", test_zero_for_ever)
   end subroutine run_test_grazing

   !> A throw that is above the wall for a small part of one long step, wherever that part is.
   subroutine test_in_and_out(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 2.0_wp
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: depth, half, top
      integer :: i, k

      do k = 1, 6
         depth = 10.0_wp**(-k)
         half = sqrt(2.0_wp*depth)
         do i = 1, 50
            top = half + (step - 2.0_wp*half)*i/50.0_wp
            if (top < 1.01_wp*half) cycle
            allocate (method)
            method%controls%initial_step = step
            call new_particles([-1.0_wp], [0.0_wp], [1], [0.5_wp*top**2 - depth], [1.0_wp], system)
            call run_through(system, [0.0_wp, top], 1.5_wp*step, method, description)
            call check_description(error, description, 2, 1.0e-15_wp, "in and out")
            call check_close(error, description%time(1:2), [top - half, top + half], 1.0e-11_wp, "times")
            call check_true(error, description%n_step <= 6, "few steps")
            deallocate (method)
         end do
      end do
   end subroutine test_in_and_out

   !> A throw whose top is 1e-9 m above the wall is seen, one whose top is 1e-9 m below it is not.
   subroutine test_grazing_throw(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: depth, top
      integer :: i, k

      do k = 1, 2
         depth = merge(1.0e-9_wp, -1.0e-9_wp, k == 1)
         do i = 1, 200
            top = 0.01_wp*i
            allocate (method)
            method%controls%initial_step = 1.9_wp
            call new_particles([-1.0_wp], [0.0_wp], [1], [0.5_wp*top**2 - depth], [1.0_wp], system)
            call run_through(system, [0.0_wp, top], 4.0_wp, method, description)
            call check_description(error, description, merge(2, 0, k == 1), 1.0e-15_wp, "grazing")
            if (k == 1) call check_close(error, description%time(1:2), top + sqrt(2.0_wp*depth)*[-1.0_wp, 1.0_wp], 1.0e-10_wp, &
                                         "times")
            deallocate (method)
         end do
      end do
   end subroutine test_grazing_throw

   !> The same with x = sin t, whose path is no polynomial, at the tolerance that this needs.
   subroutine test_grazing_spring(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: phase
      integer :: i, k

      do k = 1, 2
         do i = 1, 40
            phase = 0.037_wp*i
            allocate (method)
            method%controls%tolerance = 1.0e-12_wp
            call new_particles([0.0_wp], [1.0_wp], [1], [1.0_wp - merge(1.0e-9_wp, -1.0e-9_wp, k == 1)], [1.0_wp], system)
            call run_through(system, [sin(phase), cos(phase)], 4.0_wp*pi, method, description)
            call check_description(error, description, merge(4, 0, k == 1), 1.0e-15_wp, "grazing spring")
            deallocate (method)
         end do
      end do
   end subroutine test_grazing_spring

   !> A top exactly on the wall is an event or none, but the run continues.
   subroutine test_touching(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: top
      integer :: i

      do i = 1, 100
         top = 0.017_wp*i
         allocate (method)
         method%controls%initial_step = 1.9_wp
         call new_particles([-1.0_wp], [0.0_wp], [1], [0.5_wp*top**2], [1.0_wp], system)
         call run_through(system, [0.0_wp, top], 4.0_wp, method, description)
         call check_true(error, description%n_event <= 2, "at most an onset and an end")
         call check_description(error, description, description%n_event, 1.0e-14_wp, "touching")
         call check_true(error, description%n_step < 20, "few steps")
         deallocate (method)
      end do
   end subroutine test_touching

   !> One particle is above its wall only briefly, just before another meets its own.
   subroutine test_brief_before_another(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: half = 1.0e-3_wp  ! of the brief contact [s]
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: top
      integer :: i, k

      do k = 1, 2
         do i = 1, 90
            top = 0.01_wp*i
            allocate (method)
            method%controls%initial_step = 1.0_wp
            call new_particles([-1.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [k, 3 - k], [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp], system)
            system%wall(k) = 0.5_wp*(top**2 - half**2)
            system%wall(3 - k) = top + 0.004_wp
            call run_through(system, [0.0_wp, 0.0_wp, top, 1.0_wp], 1.0_wp, method, description)
            call check_description(error, description, 3, 1.0e-15_wp, "a brief contact before another")
            call check_close(error, description%time(1:3), top + [-half, half, 0.004_wp], 1.0e-11_wp, "times")
            deallocate (method)
         end do
      end do
   end subroutine test_brief_before_another

   !> An event just handled leaves its function at zero, give or take the last digits: no second event.
   subroutine test_start_on_the_wall(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: place(3) = [1.0e-18_wp, 0.0_wp, -1.0e-18_wp]
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      integer :: k

      do k = 1, 3
         ! away from the wall, and back to it at t = 2
         allocate (method)
         call new_particles([1.0_wp], [0.0_wp], [1], [0.0_wp], [1.0_wp], system)
         call run_through(system, [place(k), -1.0_wp], 3.0_wp, method, description)
         call check_equal(error, description%n_event, 1, "event on the way back")
         call check_close(error, description%time(1), 2.0_wp, 2.0e-15_wp, "its time")
         call check_true(error, description%is_complete .and. description%n_step < 20, "few steps")
         deallocate (method)
         ! through the wall at once
         allocate (method)
         call new_particles([0.0_wp], [0.0_wp], [1], [0.0_wp], [1.0_wp], system)
         call run_through(system, [place(k), 1.0_wp], 3.0_wp, method, description)
         call check_equal(error, description%n_event, 1, "event at the start")
         call check_close(error, description%time(1), 0.0_wp, 1.0e-15_wp, "its time")
         call check_true(error, description%is_complete .and. description%n_step < 20, "few steps")
         deallocate (method)
      end do
   end subroutine test_start_on_the_wall

   !> The same far from the origin, and away for ever, faster and faster: no event.
   subroutine test_leaving_for_ever(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: far, speed
      integer :: i, k

      far = 1000.0_wp
      do k = 1, 12
         speed = 10.0_wp**(2 - k)
         do i = -2, 2
            allocate (method)
            call new_particles([-1.0_wp], [0.0_wp], [1], [far], [1.0_wp], system)
            call run_through(system, [far + i*spacing(far), -speed], 1.0_wp, method, description)
            call check_equal(error, description%n_event, 0, "no event")
            call check_true(error, description%is_complete .and. description%n_step < 20, "few steps")
            deallocate (method)
         end do
      end do
   end subroutine test_leaving_for_ever

   !> A particle that lies on its wall for ever is no event.
   subroutine test_zero_for_ever(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t) :: method
      type(description_t) :: description

      call new_particles([0.0_wp, 0.0_wp], [0.0_wp, 1.0_wp], [1, 2], [0.3_wp, 0.5_wp], [1.0_wp, 1.0_wp], system)
      call run_through(system, [0.3_wp, 0.0_wp, 0.0_wp, 1.0_wp], 3.0_wp, method, description)
      call check_description(error, description, 2, 1.0e-15_wp, "one lies, the other passes")
      call check_true(error, all(description%number(1:2) == 2), "only the second")
   end subroutine test_zero_for_ever

end module test_grazing
