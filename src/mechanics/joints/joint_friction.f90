!> Friction in ideal joints: which items of a set rub, by which laws, and how they lie.
!>
!> An item that has friction has one sliding velocity v between its surfaces, v = row . (rates of i and j), of body j against body
!> i, and a normal force N from its multipliers and what presses the surfaces together without any load (`preload`). The law of
!> friction gives the force on body j along v from N and v, as it does for a contact; as a load on the rates it is `row` times it.
!>
!> Signs: forces are those on body j along the sliding velocity that is positive. Source: Flores et al. (2008), section 3.5, for the
!> laws; radius of the pin and preload as in the joint friction of Altair MotionSolve (reference manual, Force: Joint Friction),
!> where the preload is a friction force and here is the normal force that it comes from. Limits: a law that sticks at located
!> events (`memory_slip`) is none for a joint; those with bristles hold by these.
module joint_friction
   use friction_law, only: friction_law_t, friction_slot_t, memory_bristle
   use item, only: item_t
   use kind_info, only: add_channel, add_number, add_reference, dim_force, dim_length, kind_info_t
   use kinds, only: wp
   use text, only: split_blank, text_t
   implicit none (type, external)
   private
   public :: add_friction_columns, friction_channels, joint_friction_t, law_force, most_rows, new_joint_friction
   public :: of_friction_force, of_friction_moment

   integer, parameter :: most_rows = 5     !! rows of an item, at most
   integer, parameter :: most_lengths = 3  !! lengths that a kind needs, at most

   integer, parameter :: of_friction_moment = 7  !! channel of what turns against friction
   integer, parameter :: of_friction_force = 8   !! channel of what slides
   character(*), parameter :: friction_channels = " friction_moment friction_force "
      !! channels that an item has only if it has friction

   !> Friction of the items of a set.
   type :: joint_friction_t
      integer :: n = 0                               !! items with friction
      integer, allocatable :: item(:)                !! (n) the items
      type(friction_slot_t), allocatable :: law(:)   !! (n) their laws
      real(wp), allocatable :: length(:, :)          !! (most_lengths, n) that the kind's `press` and `slide` need [m]
      real(wp), allocatable :: preload(:)            !! (n) normal force without load [N]
      real(wp), allocatable :: z(:)                  !! (n) deflections of bristles [m]
      real(wp), allocatable :: z_rate(:)             !! (n) their rates [m/s]
      ! of the last evaluation
      real(wp), allocatable :: v(:)                  !! (n) sliding velocities [m/s]
      real(wp), allocatable :: row(:, :)             !! (2 n_v, n) what the rates of i and j add to them [1 or m]
      real(wp), allocatable :: frame(:, :, :)        !! (3, 3, n) in space: axes of the joint as columns, world frame [1]
      real(wp), allocatable :: force(:)              !! (n) friction force on body j [N]
   end type joint_friction_t

contains

   !> The columns of friction in a joint, but for further lengths, and the channel of an item that has friction.
   subroutine add_friction_columns(info, length, length_help, preload_help, channel, unit, channel_help)
      type(kind_info_t), intent(inout) :: info     !! the kind
      character(*), intent(in) :: length           !! column of the length
      character(*), intent(in) :: length_help      !! what it is
      character(*), intent(in) :: preload_help     !! what is pressed together without load
      character(*), intent(in) :: channel, unit    !! channel of the friction, and its unit
      character(*), intent(in) :: channel_help     !! what it reports

      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table but those that stick by "// &
                         "events (coulomb; constant with v1 = 0), or none", default="none")
      call add_number(info, length, dim_length, length_help, default="0 m", lower=0.0_wp)
      call add_number(info, "preload", dim_force, preload_help, default="0 N", lower=0.0_wp)
      call add_channel(info, channel, unit, "joint", 1, channel_help, &
                       merge(of_friction_moment, of_friction_force, channel == "friction_moment"))
   end subroutine add_friction_columns

   !> Storage for the items with friction.
   subroutine new_joint_friction(items, laws, lengths, n_v, friction)
      type(item_t), intent(in) :: items(:)               !! (items) rows of the table; it has the columns of friction
      type(friction_slot_t), intent(in) :: laws(:)       !! (laws) friction laws
      character(*), intent(in) :: lengths                !! blank-separated columns of lengths
      integer, intent(in) :: n_v                         !! rates of a body
      type(joint_friction_t), intent(out) :: friction    !! friction of those with friction

      type(text_t), allocatable :: names(:)
      integer :: c, k, law, n

      names = split_blank(lengths)
      allocate (friction%item(size(items)), source=0)
      do k = 1, size(items)
         law = items(k)%reference("friction")
         if (law == 0) cycle
         if (.not. laws(law)%law%is_active()) cycle
         friction%n = friction%n + 1
         friction%item(friction%n) = k
      end do
      n = friction%n
      friction%item = friction%item(:n)
      allocate (friction%law(n), friction%length(most_lengths, n), friction%preload(n), friction%z(n), friction%z_rate(n), &
                friction%v(n), friction%force(n), friction%row(2*n_v, n), friction%frame(3, 3, n))
      friction%length = 0.0_wp
      friction%frame = 0.0_wp
      friction%z = 0.0_wp
      friction%z_rate = 0.0_wp
      friction%v = 0.0_wp
      friction%force = 0.0_wp
      friction%row = 0.0_wp
      do k = 1, n
         associate (item => items(friction%item(k)))
            law = item%reference("friction")
            allocate (friction%law(k)%law, source=laws(law)%law)
            do c = 1, size(names)
               friction%length(c, k) = item%number(names(c)%s)
            end do
            friction%preload(k) = item%number("preload")
         end associate
      end do
   end subroutine new_joint_friction

   !> Friction force on body j along the sliding velocity of an item, for a normal force, and the rate of its bristles.
   pure subroutine law_force(law, is_steady, normal_force, v, z, force, z_rate)
      class(friction_law_t), intent(in) :: law   !! friction law
      logical, intent(in) :: is_steady           !! as of steady sliding, whatever the law remembers
      real(wp), intent(in) :: normal_force       !! not negative [N]
      real(wp), intent(in) :: v                  !! sliding velocity [m/s]
      real(wp), intent(in) :: z                  !! deflection of the bristles [m]
      real(wp), intent(out) :: force             !! friction force on body j [N]
      real(wp), intent(out) :: z_rate            !! rate of the deflection; zero without bristles [m/s]

      real(wp) :: f(1), rate(1)

      z_rate = 0.0_wp
      if (law%memory == memory_bristle .and. .not. is_steady) then
         call law%bristles(1, normal_force, [v], [z], f, rate)
         z_rate = rate(1)
         force = -f(1)
      else
         call law%force(1, [normal_force], [abs(v)], f)
         force = -sign(f(1), v)
      end if
   end subroutine law_force

end module joint_friction
