!> What contacts remember of their friction, and how they lie: for laws with a memory (`friction_law`).
!>
!> A contact slides (slip = 1 or -1, the sign of v_T), sticks (0), or is undecided since its onset. With bristles it has a
!> deflection z. The tangential row of a contact is
!>
!> v_T = t . (v_j - v_i),  v_T' = t . (a_j + alpha_j x s_j - a_i - alpha_i x s_i) + drift,
!>
!> velocities of the material points at arms s_i, s_j from the centres of mass, and drift what of v_T' does not depend on
!> accelerations: the normal turns, and the points of contact move through the bodies.
!>
!> In space a contact has two tangents. The first lies along `way`, the direction in which it slid at the end of the last step: slip
!> is 1 and ends where the velocity along it does. Sliding friction is against the velocity; where that is next to none along the
!> way (`still`), the way stays as it was decided, and friction is as if the velocity along it were that. So it is for a slip that
!> starts from next to none, up to a greater speed (`slow`): a contact may creep that others hold, and the direction of its sliding
!> would change faster than steps can follow. The deflection of bristles is a vector of the tangent plane, which the normal takes
!> along as it turns (with the mean spin of both bodies about it):
!>
!> F_T = -F (v_T + ...)/|v_T|,   z' = (rate by the law) + w x z,   w = n x n' + n (n . (w_i + w_j))/2
!>
!> Signs: forces are those on body j along t. Source: Flores et al. (2008), section 3.5.
module contact_stick_slip
   use friction_law, only: friction_law_t, memory_bristle, memory_none, memory_slip
   use kinds, only: wp
   use archive, only: archive_t
   use motion, only: cross
   implicit none (type, external)
   private
   public :: gives_way, stick_slip_t, is_undecided, new_stick_slip, slip_force, sticks, tangent_t

   integer, parameter :: sticks = 0         !! value of slip: no sliding
   integer, parameter :: is_undecided = 2   !! value of slip: not known since the onset, or since its slip ended
   integer, parameter :: gives_way = 3      !! value of slip: it stuck, and is to slip

   !> How a contact lies, at one motion.
   type :: tangent_t
      real(wp) :: t(3, 2) = 0.0_wp     !! (3, 2) unit tangents, in the plane one; world frame [1]
      real(wp) :: slip_direction(3) = 0.0_wp  !! (3) in space: last direction of sliding at the end of a step; zero: none yet [1]
      real(wp) :: spin(3) = 0.0_wp     !! (3) in space: angular velocity of the tangent plane [rad/s]
      real(wp) :: arm_i(3) = 0.0_wp    !! (3) where the force on i acts, from its centre of mass, world frame [m]
      real(wp) :: arm_j(3) = 0.0_wp    !! (3) where the force on j acts, from its centre of mass, world frame [m]
      real(wp) :: v(2) = 0.0_wp        !! (2) sliding velocity of j along the tangents [m/s]
      real(wp) :: drift(2) = 0.0_wp    !! (2) part of its rate that does not depend on accelerations [m/s^2]
      real(wp) :: f_n = 0.0_wp         !! normal force [N]
      real(wp) :: f_t(2) = 0.0_wp      !! (2) friction force on j along the tangents [N]
      logical :: is_driven = .false.   !! it sticks, but drivers alone prescribe how it slides
   end type tangent_t

   !> The stick-slip state of all contacts of a set.
   type :: stick_slip_t
      integer :: memory = memory_none                !! what is remembered, as of the law
      integer :: first_bristle = 0                   !! components of deflections of earlier sets
      integer :: n_tangent = 1                       !! tangents of a contact: 1 in the plane, 2 in space
      integer :: n_component = 1                     !! components of a deflection: 1 in the plane, 3 in space
      integer, allocatable :: slip(:)                !! (contacts) which way they slide, 0: they stick, 2: not decided
      integer, allocatable :: was(:)                 !! (contacts) the same before the last decision
      real(wp), allocatable :: band(:)               !! (contacts) speed against the slip at which it ends [m/s]
      real(wp), allocatable :: since(:)              !! (contacts) time of the last decision [s]
      real(wp), allocatable :: still(:)              !! (contacts) in space: speed that is next to none [m/s]
      real(wp), allocatable :: slow(:)               !! (contacts) in space: the same until it has been exceeded; 0: none [m/s]
      real(wp), allocatable :: shared_from(:)        !! (contacts) first time at which a friction force was not unique [s]
      real(wp), allocatable :: z(:, :)               !! (n_component, contacts) deflections, along t or in the world's frame [m]
      real(wp), allocatable :: origin(:, :)          !! (n_component, contacts) what the state was when they started [m]
      real(wp), allocatable :: z_rate(:, :)          !! (n_component, contacts) their rates [m/s]
      type(tangent_t), allocatable :: tangent(:)     !! (contacts) of the last evaluation
   contains
      procedure :: forget
      procedure :: adopt
      procedure :: save => stick_slip_save
      procedure :: load => stick_slip_load
   end type stick_slip_t

contains

   !> Storage for n contacts, if the law remembers anything.
   subroutine new_stick_slip(n, is_spatial, law, stick_slip)
      integer, intent(in) :: n                 !! number of contacts
      logical, intent(in) :: is_spatial        !! contacts in space, not in the plane
      class(friction_law_t), intent(in) :: law !! friction law
      type(stick_slip_t), intent(out) :: stick_slip        !! nothing remembered yet

      stick_slip%memory = law%memory
      if (stick_slip%memory == memory_none) return
      allocate (stick_slip%slip(n), stick_slip%was(n), source=is_undecided)
      if (is_spatial) then
         stick_slip%n_tangent = 2
         stick_slip%n_component = 3
      end if
      allocate (stick_slip%band(n), stick_slip%since(n), stick_slip%still(n), stick_slip%slow(n), source=0.0_wp)
      allocate (stick_slip%shared_from(n), source=huge(1.0_wp))
      allocate (stick_slip%z(stick_slip%n_component, n), stick_slip%z_rate(stick_slip%n_component, n), &
                stick_slip%origin(stick_slip%n_component, n), source=0.0_wp)
      allocate (stick_slip%tangent(n))
   end subroutine new_stick_slip

   !> A contact starts or ends: it is not decided which way it slides, and there is no deflection.
   pure subroutine forget(self, k)
      class(stick_slip_t), intent(inout) :: self  !! the stick-slip state
      integer, intent(in) :: k              !! contact of the set

      if (self%memory == memory_none) return
      self%slip(k) = is_undecided
      self%was(k) = is_undecided
      self%band(k) = 0.0_wp
      self%since(k) = -huge(1.0_wp)
      self%still(k) = 0.0_wp
      self%slow(k) = 0.0_wp
      self%origin(:, k) = self%origin(:, k) + self%z(:, k)
      self%z(:, k) = 0.0_wp
      self%z_rate(:, k) = 0.0_wp
      self%tangent(k) = tangent_t()
   end subroutine forget

   !> Take over what is remembered of a contact of another stick-slip state of the same law.
   pure subroutine adopt(self, k, other, k_other)
      class(stick_slip_t), intent(inout) :: self  !! the stick-slip state
      integer, intent(in) :: k              !! contact of its set
      type(stick_slip_t), intent(in) :: other     !! the other stick-slip state
      integer, intent(in) :: k_other        !! contact of that set

      if (self%memory == memory_none) return
      self%slip(k) = other%slip(k_other)
      self%band(k) = other%band(k_other)
      self%since(k) = other%since(k_other)
      self%still(k) = other%still(k_other)
      self%slow(k) = other%slow(k_other)
      self%shared_from(k) = other%shared_from(k_other)
      self%origin(:, k) = other%origin(:, k_other)
      self%tangent(k)%slip_direction = other%tangent(k_other)%slip_direction
   end subroutine adopt

   !> Friction force of a touching contact on body j along its tangents; none of one that sticks, which is found with the
   !> accelerations.
   subroutine slip_force(self, law, k)
      type(stick_slip_t), intent(inout) :: self         !! the stick-slip state; how contact k lies, with its normal force, is set
      class(friction_law_t), intent(in) :: law    !! friction law
      integer, intent(in) :: k                    !! contact of the set

      real(wp) :: along, f(1)

      associate (tangent => self%tangent(k))
         tangent%f_t = 0.0_wp
         select case (self%memory)
         case (memory_bristle)
            call bend(self, law, k)
         case (memory_slip)
            if (abs(self%slip(k)) /= 1) return
            call law%force(1, [tangent%f_n], [hypot(tangent%v(1), tangent%v(2))], f)
            if (self%n_tangent == 1) then
               tangent%f_t(1) = -self%slip(k)*f(1)
            else
               along = max(tangent%v(1), self%still(k), self%slow(k), tiny(1.0_wp))
               tangent%f_t = -f(1)*[along, tangent%v(2)]/hypot(along, tangent%v(2))
            end if
         end select
      end associate
   end subroutine slip_force

   !> Force of the bristles of a contact, and the rate of their deflection.
   subroutine bend(self, law, k)
      type(stick_slip_t), intent(inout) :: self         !! the stick-slip state; how contact k lies, with its normal force, is set
      class(friction_law_t), intent(in) :: law    !! friction law
      integer, intent(in) :: k                    !! contact of the set

      real(wp) :: f(self%n_component)

      associate (tangent => self%tangent(k), n => self%n_component, z => self%z(:, k))
         if (n == 1) then
            call law%bristles(n, tangent%f_n, tangent%v(:n), z, f, self%z_rate(:, k))
            tangent%f_t(1) = -f(1)
         else
            call law%bristles(n, tangent%f_n, matmul(tangent%t, tangent%v), z, f, self%z_rate(:, k))
            self%z_rate(:, k) = self%z_rate(:, k) + cross(tangent%spin, z)
            tangent%f_t = -matmul(f, tangent%t)
         end if
      end associate
   end subroutine bend

   !> Write what the stick-slip state remembers.
   subroutine stick_slip_save(self, archive)
      class(stick_slip_t), intent(in) :: self   !! the stick-slip state
      type(archive_t), intent(inout) :: archive !! the checkpoint

      integer :: k

      if (self%memory == memory_none) return
      do k = 1, size(self%slip)
         call archive%put(self%slip(k))
         call archive%put([self%band(k), self%since(k), self%shared_from(k), self%origin(:, k)])
         if (self%n_tangent > 1) call archive%put([self%still(k), self%slow(k), self%tangent(k)%slip_direction])
      end do
   end subroutine stick_slip_save

   !> Read what the stick-slip state remembers.
   subroutine stick_slip_load(self, archive)
      class(stick_slip_t), intent(inout) :: self   !! the stick-slip state
      type(archive_t), intent(inout) :: archive    !! the checkpoint

      integer :: i, k

      if (self%memory == memory_none) return
      do k = 1, size(self%slip)
         call archive%get(self%slip(k))
         call archive%get(self%band(k))
         call archive%get(self%since(k))
         call archive%get(self%shared_from(k))
         do i = 1, self%n_component
            call archive%get(self%origin(i, k))
         end do
         if (self%n_tangent == 1) cycle
         call archive%get(self%still(k))
         call archive%get(self%slow(k))
         do i = 1, 3
            call archive%get(self%tangent(k)%slip_direction(i))
         end do
      end do
   end subroutine stick_slip_load

end module contact_stick_slip
