!> Torsional spring, damper and actuator in space, about an axis of body i and one of body j that a joint holds parallel.
!>
!> The angle theta of j against i (`spatial_rows`) has the rate N_i . omega_i + N_j . omega_j. With the moment f of `spring_law`
!> the moments on the bodies are -f N_i and -f N_j, so that the power balance holds when the axes are not quite parallel.
!> Turns are counted: theta is taken next to the one that the last step ended with (`follow`), less than half a turn away.
!>
!> An angle about axes that part is that of their shadows: it changes although nothing turns about them, and at a right angle it has
!> no value, which ends a run. The maximum angle between the axes is kept, and `doubt` reports of it.
!>
!> Signs: the moment on body i about the axis is positive if it takes theta back towards smaller values.
!> Source: Nikravesh (1988), section 4.3; Flores et al. (2008), section 2.3. Limits: a step is shorter than half a turn.
module spatial_torsion_spring
   use bodies, only: points_t
   use force_set, only: force_set_t
   use item, only: item_t
   use joint_frames, only: add_zero_columns, find_frames, from_start
   use kind_info, only: add_channel, add_direction, add_reference, in_space, kind_info_t
   use kinds, only: pi, wp
   use archive, only: archive_t
   use motion, only: loads_t, motion_t
   use spatial_rows, only: angle_between, axis_of, scalar_t, wrapped
   use spring_law, only: add_turning_law, spring_law_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: spatial_torsion_spring_t, words_of_lost_angle

   ! channels
   integer, parameter :: of_moment = 1        !! moment
   integer, parameter :: of_angle = 2         !! angle of j relative to i
   integer, parameter :: of_angular_rate = 3  !! its rate
   integer, parameter :: of_power = 4         !! power given to the mechanism

   real(wp), parameter :: parallel = 0.9999_wp  !! cosine of an angle between axes that is none, 0.8 deg [1]

   !> All torsional springs of a spatial scene.
   type, extends(force_set_t) :: spatial_torsion_spring_t
      integer, allocatable :: body(:, :)            !! (2, n) bodies i and j
      type(spring_law_t), allocatable :: law(:)     !! (n) moment over angle and its rate, and actuator
      real(wp), allocatable :: axis(:, :, :)        !! (3, 2, n) axes of i and j as in the deck; zero: omitted [1]
      real(wp), allocatable :: across(:, :, :)      !! (3, 2, n) x of i and of j as in the deck; zero: omitted [1]
      logical, allocatable :: from_start(:)         !! (n) the angle is zero where the deck puts the bodies
      real(wp), allocatable :: frame(:, :, :, :)    !! (3, 3, 2, n) frames of the axes, frames of the bodies [1]
      real(wp), allocatable :: near(:)              !! (n) angle at the end of the last step [rad]
      real(wp), allocatable :: cosine(:)            !! (n) minimum cosine of the angle between the axes so far [1]
   contains
      procedure, nopass :: info => torsion_info
      procedure :: prepare => torsion_prepare
      procedure :: set_start => torsion_set_start
      procedure :: follow => torsion_follow
      procedure :: doubt => torsion_doubt
      procedure :: evaluate => torsion_evaluate
      procedure :: elastic_energy => torsion_elastic_energy
      procedure :: lost_power => torsion_lost_power
      procedure :: load_on => torsion_load_on
      procedure :: report => torsion_report
      procedure :: bodies_of => torsion_bodies
      procedure, nopass :: memory_version => torsion_memory_version
      procedure :: save => torsion_save
      procedure :: load => torsion_load
   end type spatial_torsion_spring_t

contains

   !> Description of the kind.
   function torsion_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.torsion_spring"
      info%space = in_space
      info%help = "torsional spring, damper and actuator between two bodies, about an axis that a joint keeps parallel in both"
      info%source = "Nikravesh (1988), section 4.3"
      info%counts_turns = .true.
      call add_reference(info, "i", "bodies", "first body")
      call add_reference(info, "j", "bodies", "second body")
      call add_direction(info, "axis_i", "axis, in the frame of body i", default='"0 0 1"')
      call add_direction(info, "axis_j", "axis, in the frame of body j; default: consistent with the given positions", default="")
      call add_zero_columns(info)
      call add_turning_law(info)
      call add_channel(info, "moment", "N.m", "joint", 1, "moment on the body of i about the axis", of_moment)
      call add_channel(info, "angle", "rad", "joint", 1, "angle of j relative to i about the axis, accumulated over "// &
         "revolutions", of_angle)
      call add_channel(info, "angular_rate", "rad/s", "joint", 1, "rate of the angle", of_angular_rate)
      call add_channel(info, "power", "W", "none", 1, "total power of spring, damper and actuator on the bodies", of_power)
   end function torsion_info

   !> Make the set.
   subroutine torsion_prepare(self, items, points)
      class(spatial_torsion_spring_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                    !! (n) rows of the table
      type(points_t), intent(in) :: points                    !! all points

      integer :: k

      self%n = size(items)
      allocate (self%names(self%n), self%body(2, self%n), self%law(self%n), self%from_start(self%n))
      allocate (self%axis(3, 2, self%n), self%across(3, 2, self%n), self%frame(3, 3, 2, self%n), self%near(self%n), source=0.0_wp)
      allocate (self%cosine(self%n), source=1.0_wp)
      do k = 1, self%n
         associate (item => items(k))
            self%names(k)%s = items(k)%name
            self%body(:, k) = [item%reference("i"), item%reference("j")]
            self%axis(:, 1, k) = item%direction("axis_i")
            self%axis(:, 2, k) = item%direction("axis_j")
            self%across(:, 1, k) = item%direction("x_i")
            self%across(:, 2, k) = item%direction("x_j")
            self%from_start(k) = item%word("zero") == from_start
            call self%law(k)%prepare(item, "free_angle")
         end associate
      end do
   end subroutine torsion_prepare

   !> Frames of the axes, and the angles that the deck puts the bodies at.
   subroutine torsion_set_start(self, motion)
      class(spatial_torsion_spring_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion                    !! bodies where the deck puts them

      integer :: k

      do k = 1, self%n
         call find_frames(motion, self%body(:, k), self%axis(:, 1, k), self%axis(:, 2, k), self%from_start(k), &
                          self%frame(:, :, 1, k), self%frame(:, :, 2, k), self%across(:, :, k))
      end do
      call self%follow(motion)
   end subroutine torsion_set_start

   !> A step has ended: count on from here.
   subroutine torsion_follow(self, motion)
      class(spatial_torsion_spring_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion                    !! positions

      type(scalar_t) :: angle
      integer :: k

      do k = 1, self%n
         angle = angle_of(self, k, motion)
         self%near(k) = angle%value
         self%cosine(k) = min(self%cosine(k), dot_product(axis_of(motion, self%body(1, k), self%frame(:, 3, 1, k)), &
                                                          axis_of(motion, self%body(2, k), self%frame(:, 3, 2, k))))
      end do
   end subroutine torsion_follow

   !> The axes came apart.
   function torsion_doubt(self, k) result(doubt)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                             !! item
      character(:), allocatable :: doubt                   !! what does not match; blank: nothing

      doubt = ""
      if (self%cosine(k) >= parallel) return
      doubt = "has an angle between its axes of "//real_text(acos(max(self%cosine(k), -1.0_wp))*180.0_wp/pi, 3)// &
              " deg: its angle is valid only if a joint keeps the axes parallel"
   end function torsion_doubt

   !> That the axes have come to be a right angle or more apart: what follows its name in a message.
   function words_of_lost_angle(self, k) result(words)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                             !! item
      character(:), allocatable :: words                   !! what is wrong

      words = "has an undefined angle: the angle between its axes is "//real_text(acos(max(self%cosine(k), &
         -1.0_wp))*180.0_wp/pi, 4)// &
              " deg, the limit is 90 deg; add a joint that keeps them parallel"
   end function words_of_lost_angle

   !> Angle of an item, turns counted.
   pure function angle_of(self, k, motion) result(angle)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                             !! item
      type(motion_t), intent(in) :: motion                 !! positions and velocities
      type(scalar_t) :: angle                              !! the angle [rad]

      angle = angle_between(motion, self%body(:, k), self%frame(:, :, 1, k), self%frame(:, :, 2, k))
      angle%value = self%near(k) + wrapped(angle%value - self%near(k))
   end function angle_of

   !> Add the loads of all items; the power is that of the actuators.
   subroutine torsion_evaluate(self, t, motion, loads, power)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                            !! time [s]
      type(motion_t), intent(in) :: motion                 !! positions and velocities
      type(loads_t), intent(inout) :: loads                !! loads on the bodies
      real(wp), intent(inout) :: power                     !! power given to the mechanism [W]

      type(scalar_t) :: angle
      real(wp) :: actuator, moment
      integer :: k

      do k = 1, self%n
         angle = angle_of(self, k, motion)
         call self%law(k)%force(t, motion, angle%value, angle%rate, moment, actuator)
         associate (i => self%body(1, k), j => self%body(2, k))
            loads%moment(:, i) = loads%moment(:, i) - moment*angle%turn_i
            loads%moment(:, j) = loads%moment(:, j) - moment*angle%turn_j
         end associate
         power = power - actuator*angle%rate
      end do
   end subroutine torsion_evaluate

   !> Energy stored by stiffness and law.
   pure real(wp) function torsion_elastic_energy(self, motion) result(energy)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion                 !! positions

      type(scalar_t) :: angle
      integer :: k

      energy = 0.0_wp
      do k = 1, self%n
         angle = angle_of(self, k, motion)
         call self%law(k)%add_energy(angle%value, energy)
      end do
   end function torsion_elastic_energy

   !> Power lost in the dampers.
   pure real(wp) function torsion_lost_power(self, motion) result(power)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion                 !! positions and velocities

      type(scalar_t) :: angle
      integer :: k

      power = 0.0_wp
      do k = 1, self%n
         angle = angle_of(self, k, motion)
         power = power + self%law(k)%lost_power(angle%rate)
      end do
   end function torsion_lost_power

   !> Moment of an item on the body of i or j.
   subroutine torsion_load_on(self, k, side, t, motion, force, moment, place)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                             !! item
      integer, intent(in) :: side                          !! 1: on the body of i, 2: on that of j
      real(wp), intent(in) :: t                            !! time [s]
      type(motion_t), intent(in) :: motion                 !! positions and velocities
      real(wp), intent(out) :: force(3)                    !! (3) none [N]
      real(wp), intent(out) :: moment(3)                   !! (3) world frame [N.m]
      real(wp), intent(out) :: place(3)                    !! (3) centre of mass: any place will do [m]

      type(scalar_t) :: angle
      real(wp) :: actuator, f

      angle = angle_of(self, k, motion)
      call self%law(k)%force(t, motion, angle%value, angle%rate, f, actuator)
      force = 0.0_wp
      moment = -f*angle%turn_i
      if (side == 2) moment = -f*angle%turn_j
      place = motion%r(:, self%body(side, k))
   end subroutine torsion_load_on

   !> Values of a channel for all items.
   subroutine torsion_report(self, code, t, motion, values)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: code                          !! the channel
      real(wp), intent(in) :: t                            !! time [s]
      type(motion_t), intent(in) :: motion                 !! positions and velocities
      real(wp), intent(inout) :: values(:, :)              !! (components, n) values [N.m, rad, rad/s or W]

      type(scalar_t) :: angle
      real(wp) :: actuator, moment
      integer :: k

      do k = 1, self%n
         angle = angle_of(self, k, motion)
         call self%law(k)%force(t, motion, angle%value, angle%rate, moment, actuator)
         select case (code)
         case (of_moment)
            values(1, k) = moment
         case (of_angle)
            values(1, k) = angle%value
         case (of_angular_rate)
            values(1, k) = angle%rate
         case (of_power)
            values(1, k) = -moment*angle%rate
         end select
      end do
   end subroutine torsion_report

   !> The bodies that an item acts on.
   pure function torsion_bodies(self, i) result(bodies)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: i                             !! number of the item
      integer :: bodies(2)                                 !! both, 0: ground

      bodies = self%body(:, i)
   end function torsion_bodies

   !> Version of the form of what the set saves: since the second with how far the axes were apart.
   pure integer function torsion_memory_version() result(version)
      version = 2
   end function torsion_memory_version

   !> Write what the set remembers.
   subroutine torsion_save(self, archive)
      class(spatial_torsion_spring_t), intent(in) :: self  !! the set
      type(archive_t), intent(inout) :: archive            !! the checkpoint

      integer :: k

      do k = 1, self%n
         call archive%put(self%near(k))
         call archive%put(self%cosine(k))
      end do
   end subroutine torsion_save

   !> Read what the set remembers.
   subroutine torsion_load(self, archive)
      class(spatial_torsion_spring_t), intent(inout) :: self  !! the set
      type(archive_t), intent(inout) :: archive               !! the checkpoint

      integer :: k

      do k = 1, self%n
         call archive%get(self%near(k))
         call archive%get(self%cosine(k))
      end do
   end subroutine torsion_load

end module spatial_torsion_spring
