!> What a contact remembers between its onset and its end.
module contact_memory
   use kinds, only: wp
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: approaches, contact_memory_t, parts, rests

   integer, parameter :: approaches = 1        !! course: the penetration grows
   integer, parameter :: parts = -1            !! course: it falls
   integer, parameter :: rests = 0             !! course: a load between both forces keeps it from either

   !> What it went through besides its maximum values.
   type :: course_of_contact_t
      real(wp) :: force_at = 0.0_wp        !! when the force was maximum [s]
      real(wp) :: penetration_at = 0.0_wp  !! when the penetration was maximum [s]
      real(wp) :: impulse = 0.0_wp         !! of the normal force since the onset [N.s]
   end type course_of_contact_t

   !> One contact.
   type :: contact_memory_t
      logical :: is_touching = .false.          !! between onset and end
      real(wp) :: onset = 0.0_wp                !! time of the onset [s]
      real(wp) :: impact_speed = 0.0_wp         !! normal approach speed at the onset [m/s]
      real(wp) :: peak_force = 0.0_wp           !! maximum normal force since the onset [N]
      real(wp) :: peak_penetration = 0.0_wp     !! maximum penetration since the onset [m]
      type(course_of_contact_t) :: went         !! when these were, and the impulse
      real(wp) :: loss_at_onset = 0.0_wp        !! what the ledger had lost in the contact by then [J]
      integer :: course = approaches            !! approaches, parts or rests: laws that jump at a turn of the penetration
      real(wp) :: rest_speed = 0.0_wp           !! maximum rate of one that rests [m/s]
      real(wp) :: contact_rate = 0.0_wp                !! how fast it swings, pi over the time of an impact [rad/s]
      logical :: is_dry = .false.               !! beyond the transition of a film, which is gone there
      logical :: is_cut_off = .false.           !! without a force at the end of the last step: see `cut_off`
      real(wp) :: held = 0.0_wp                 !! what it had lost and still stored there together [J]
      real(wp) :: amends = 0.0_wp               !! what its loss is beyond the quadrature of the ledger [J]
   contains
      procedure :: save => contact_save
      procedure :: load => contact_load
   end type contact_memory_t

contains

   !> Write it.
   subroutine contact_save(self, archive)
      class(contact_memory_t), intent(in) :: self  !! the contact
      type(archive_t), intent(inout) :: archive    !! the checkpoint

      call archive%put(self%is_touching)
      call archive%put([self%onset, self%impact_speed, self%peak_force, self%peak_penetration, self%loss_at_onset, &
                            self%rest_speed, self%contact_rate, self%held, self%amends, self%went%force_at, &
                                 self%went%penetration_at, &
                            self%went%impulse])
      call archive%put(self%course)
      call archive%put(self%is_cut_off)
      call archive%put(self%is_dry)
   end subroutine contact_save

   !> Read it.
   subroutine contact_load(self, archive)
      class(contact_memory_t), intent(inout) :: self  !! the contact
      type(archive_t), intent(inout) :: archive       !! the checkpoint

      call archive%get(self%is_touching)
      call archive%get(self%onset)
      call archive%get(self%impact_speed)
      call archive%get(self%peak_force)
      call archive%get(self%peak_penetration)
      call archive%get(self%loss_at_onset)
      call archive%get(self%rest_speed)
      call archive%get(self%contact_rate)
      call archive%get(self%held)
      call archive%get(self%amends)
      call archive%get(self%went%force_at)
      call archive%get(self%went%penetration_at)
      call archive%get(self%went%impulse)
      call archive%get(self%course)
      call archive%get(self%is_cut_off)
      call archive%get(self%is_dry)
   end subroutine contact_load

end module contact_memory
