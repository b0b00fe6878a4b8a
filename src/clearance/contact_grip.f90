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
!> Signs: forces are those on body j along t. Source: Flores et al. (2008), section 3.5.
module contact_grip
   use friction_law, only: friction_law_t, memory_bristle, memory_none, memory_slip
   use kinds, only: wp
   use memory, only: get, put
   implicit none (type, external)
   private
   public :: grip_t, is_undecided, n_grip_memory, new_grip, slip_force, sticks, tangent_t

   integer, parameter :: sticks = 0         !! value of slip: no sliding
   integer, parameter :: is_undecided = 2   !! value of slip: not known since the onset

   integer, parameter :: n_grip_memory = 4  !! numbers per contact in a checkpoint

   !> How a contact lies, at one motion.
   type :: tangent_t
      real(wp) :: t(3) = 0.0_wp        !! (3) unit tangent, world frame [1]
      real(wp) :: arm_i(3) = 0.0_wp    !! (3) where the force on i acts, from its centre of mass, world frame [m]
      real(wp) :: arm_j(3) = 0.0_wp    !! (3) where the force on j acts, from its centre of mass, world frame [m]
      real(wp) :: v = 0.0_wp           !! sliding velocity of j along t [m/s]
      real(wp) :: drift = 0.0_wp       !! part of its rate that does not depend on accelerations [m/s^2]
      real(wp) :: f_n = 0.0_wp         !! normal force [N]
      real(wp) :: f_t = 0.0_wp         !! friction force on j along t [N]
      logical :: is_driven = .false.   !! it sticks, but drivers alone prescribe how it slides
   end type tangent_t

   !> The grip of all contacts of a set.
   type :: grip_t
      integer :: memory = memory_none                !! what is remembered, as of the law
      integer :: first_bristle = 0                   !! deflections of earlier sets
      integer, allocatable :: slip(:)                !! (contacts) which way they slide, 0: they stick, 2: not decided
      real(wp), allocatable :: band(:)               !! (contacts) speed against the slip at which it ends [m/s]
      real(wp), allocatable :: since(:)              !! (contacts) time of the last decision [s]
      real(wp), allocatable :: z(:)                  !! (contacts) deflections of bristles [m]
      real(wp), allocatable :: origin(:)             !! (contacts) what the state was when they began [m]
      real(wp), allocatable :: z_rate(:)             !! (contacts) their rates [m/s]
      type(tangent_t), allocatable :: tangent(:)     !! (contacts) of the last evaluation
   contains
      procedure :: forget
      procedure :: adopt
      procedure :: save => grip_save
      procedure :: load => grip_load
   end type grip_t

contains

   !> Room for n contacts, if the law remembers anything.
   subroutine new_grip(n, law, grip)
      integer, intent(in) :: n                 !! number of contacts
      class(friction_law_t), intent(in) :: law !! friction law
      type(grip_t), intent(out) :: grip        !! nothing remembered yet

      grip%memory = law%memory
      if (grip%memory == memory_none) return
      allocate (grip%slip(n), source=is_undecided)
      allocate (grip%band(n), grip%since(n), grip%z(n), grip%z_rate(n), grip%origin(n), source=0.0_wp)
      allocate (grip%tangent(n))
   end subroutine new_grip

   !> A contact begins or ends: it is not decided which way it slides, and there is no deflection.
   pure subroutine forget(self, k)
      class(grip_t), intent(inout) :: self  !! the grip
      integer, intent(in) :: k              !! contact of the set

      if (self%memory == memory_none) return
      self%slip(k) = is_undecided
      self%band(k) = 0.0_wp
      self%since(k) = -huge(1.0_wp)
      self%origin(k) = self%origin(k) + self%z(k)
      self%z(k) = 0.0_wp
      self%z_rate(k) = 0.0_wp
      self%tangent(k) = tangent_t()
   end subroutine forget

   !> Take over what is remembered of a contact of another grip of the same law.
   pure subroutine adopt(self, k, other, k_other)
      class(grip_t), intent(inout) :: self  !! the grip
      integer, intent(in) :: k              !! contact of its set
      type(grip_t), intent(in) :: other     !! the other grip
      integer, intent(in) :: k_other        !! contact of that set

      if (self%memory == memory_none) return
      self%slip(k) = other%slip(k_other)
      self%band(k) = other%band(k_other)
      self%since(k) = other%since(k_other)
      self%origin(k) = other%origin(k_other)
   end subroutine adopt

   !> Friction force of a touching contact on body j along t; none of one that sticks, which is found with the accelerations.
   subroutine slip_force(self, law, k)
      type(grip_t), intent(inout) :: self         !! the grip; how contact k lies, with its normal force, is set
      class(friction_law_t), intent(in) :: law    !! friction law
      integer, intent(in) :: k                    !! contact of the set

      real(wp) :: f(1)

      associate (tangent => self%tangent(k))
         tangent%f_t = 0.0_wp
         select case (self%memory)
         case (memory_bristle)
            call law%bristles(tangent%f_n, tangent%v, self%z(k), f(1), self%z_rate(k))
            tangent%f_t = -f(1)
         case (memory_slip)
            if (abs(self%slip(k)) /= 1) return
            call law%force(1, [tangent%f_n], [abs(tangent%v)], f)
            tangent%f_t = -self%slip(k)*f(1)
         end select
      end associate
   end subroutine slip_force

   !> Write what the grip remembers.
   subroutine grip_save(self, row, place)
      class(grip_t), intent(in) :: self   !! the grip
      real(wp), intent(inout) :: row(:)   !! (any) checkpoint [any]
      integer, intent(inout) :: place     !! last place used

      integer :: k

      if (self%memory == memory_none) return
      do k = 1, size(self%slip)
         call put(row, place, self%slip(k))
         call put(row, place, [self%band(k), self%since(k), self%origin(k)])
      end do
   end subroutine grip_save

   !> Read what the grip remembers.
   subroutine grip_load(self, row, place)
      class(grip_t), intent(inout) :: self   !! the grip
      real(wp), intent(in) :: row(:)         !! (any) checkpoint [any]
      integer, intent(inout) :: place        !! last place used

      integer :: k

      if (self%memory == memory_none) return
      do k = 1, size(self%slip)
         call get(row, place, self%slip(k))
         call get(row, place, self%band(k))
         call get(row, place, self%since(k))
         call get(row, place, self%origin(k))
      end do
   end subroutine grip_load

end module contact_grip
