!> What the contacts of joints did between two instants, from the list of events.
module contact_statistics
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_contacts
   use event_list, only: event_list_t, n_event_numbers
   use kinds, only: wp
   use name_table, only: name_table_t
   use text, only: text_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: histogram, joint_statistics, joint_statistics_t, joints_of, statistics_of_joints

   !> What the contacts of a joint did in the window.
   type :: joint_statistics_t
      character(:), allocatable :: name                 !! of the joint
      real(wp) :: contact_fraction = 0.0_wp             !! of the time [1]
      real(wp), allocatable :: speeds(:)                !! (impacts) impact speeds [m/s]
      real(wp), allocatable :: forces(:)                !! (impacts) peak forces [N]
      real(wp) :: max_force = -huge(1.0_wp)        !! maximum peak force in the window, whenever its contact started [N]
   end type joint_statistics_t

contains

   !> The joints that have contacts.
   function joints_of(catalogue) result(names)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      type(text_t), allocatable :: names(:)       !! (n) each once

      type(text_list_t) :: found
      integer :: k

      associate (contacts => catalogue%item_groups(group_contacts))
         do k = 1, size(contacts%names)
            if (k > 1) then  ! contacts of a joint stand together
               if (contacts%names(k)%s == contacts%names(k - 1)%s) cycle
            end if
            call found%add(contacts%names(k)%s)
         end do
      end associate
      names = found%get()
   end function joints_of

   !> Contact fractions and impacts of joints between two instants, in one pass through the events.
   subroutine statistics_of_joints(names, events, from, until, joints)
      type(text_t), intent(in) :: names(:)                             !! (n) names of the joints
      type(event_list_t), intent(in) :: events                         !! all events
      real(wp), intent(in) :: from                                     !! start of the window [s]
      real(wp), intent(in) :: until                                    !! its end [s]
      type(joint_statistics_t), allocatable, intent(out) :: joints(:)  !! (n) what their contacts did

      type(name_table_t) :: table
      real(wp) :: begin, closed(size(names)), covered(size(names)), end, numbers(n_event_numbers)
      integer, allocatable :: joint_of(:), order(:)
      integer :: j, k, n(size(names)), pass

      call table%list(names)
      order = events%order_by_onset()
      allocate (joints(size(names)), joint_of(size(order)))
      do k = 1, size(order)
         joint_of(k) = 0
         if (events%word(order(k), 1) == "contact") joint_of(k) = table%find(events%word(order(k), 2))
      end do
      do pass = 1, 2
         n = 0
         closed = 0.0_wp
         covered = from
         do k = 1, size(order)
            j = joint_of(k)
            if (j == 0) cycle
            numbers = events%numbers(order(k))
            begin = numbers(1)
            end = until
            if (ieee_is_finite(numbers(5))) end = min(until, begin + numbers(5))
            if (begin >= from .and. begin < until) then
               n(j) = n(j) + 1
               if (pass == 2) joints(j)%speeds(n(j)) = numbers(2)
               if (pass == 2) joints(j)%forces(n(j)) = numbers(3)
            end if
            associate (force => numbers(3), at => numbers(9))
               if (at >= from .and. at <= until) joints(j)%max_force = max(joints(j)%max_force, force)
            end associate
            ! contacts come in the order of their onsets: what reaches beyond those before is new
            closed(j) = closed(j) + max(0.0_wp, end - max(begin, covered(j)))
            covered(j) = max(covered(j), end)
         end do
         if (pass == 2) exit
         do j = 1, size(names)
            allocate (joints(j)%speeds(n(j)), joints(j)%forces(n(j)), source=0.0_wp)
         end do
      end do
      do j = 1, size(names)
         joints(j)%name = names(j)%s
         if (until > from) joints(j)%contact_fraction = closed(j)/(until - from)
      end do
   end subroutine statistics_of_joints

   !> Contact fraction and impacts of a joint between two instants.
   subroutine joint_statistics(name, events, from, until, joint)
      character(*), intent(in) :: name                  !! of the joint
      type(event_list_t), intent(in) :: events          !! all events
      real(wp), intent(in) :: from                      !! start of the window [s]
      real(wp), intent(in) :: until                     !! its end [s]
      type(joint_statistics_t), intent(out) :: joint    !! what its contacts did

      type(joint_statistics_t), allocatable :: joints(:)
      type(text_t) :: names(1)

      names(1)%s = name
      call statistics_of_joints(names, events, from, until, joints)
      joint = joints(1)
   end subroutine joint_statistics

   !> How many values lie between equally spaced edges from 0 to the maximum value; an edge belongs to the upper bin.
   pure subroutine histogram(values, edges, counts)
      real(wp), intent(in) :: values(:)       !! (any) not negative [any]
      real(wp), intent(out) :: edges(:)       !! (bins + 1) [any]
      integer, intent(out) :: counts(:)       !! (bins)

      integer :: bin, k, n
      real(wp) :: top

      n = size(counts)
      counts = 0
      top = 0.0_wp
      if (size(values) > 0) top = maxval(values)
      edges = [(top*real(k, wp)/real(n, wp), k=0, n)]
      do k = 1, size(values)
         do bin = 1, n - 1
            if (values(k) < edges(bin + 1)) exit
         end do
         counts(bin) = counts(bin) + 1
      end do
   end subroutine histogram

end module contact_statistics
