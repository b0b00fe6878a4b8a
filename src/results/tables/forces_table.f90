!> The largest forces of a run as a table, ranked: of each joint, driver, contact, film and force element the largest of the forces
!> that are recorded, with its time.
!>
!> A vector counts by its magnitude, whose maximum is located between rows as that of every channel. An item has one row: where a
!> number is as large as the magnitude of a vector, as the tension of a spring and the force on its body, it has that number's name.
module forces_table
   use catalogue, only: catalogue_t
   use channels, only: selection_t
   use channel_names, only: item_name, scalar_name, scalar_t
   use extremes, only: extreme_t, extremes_t
   use groups_of_catalogue, only: group_clearances, group_contacts, group_drivers, group_forces, group_joints
   use kinds, only: wp
   use name_table, only: name_table_t
   use result_table, only: result_table_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: is_ranked, largest_forces, magnitudes_of_forces

   integer, parameter :: most_rows = 1000          !! of the table
   real(wp), parameter :: same = 1.0e-9_wp         !! relative difference of equal maxima, each located to 1e-11 [1]

contains

   !> Magnitudes of the forces of which a component is recorded, and not the magnitude.
   function magnitudes_of_forces(selection, catalogue) result(magnitudes)
      type(selection_t), intent(in) :: selection          !! what is recorded
      type(catalogue_t), intent(in) :: catalogue          !! what can be recorded
      type(scalar_t), allocatable :: magnitudes(:)        !! (n) the magnitudes

      integer :: item, k, n, pass

      do pass = 1, 2
         n = 0
         do k = 1, size(catalogue%groups)
            do item = 1, size(catalogue%groups(k)%has)
               if (.not. is_ranked(selection, catalogue, k, item)) cycle
               n = n + 1
               if (pass == 2) magnitudes(n) = scalar_t(k, 1, item)
            end do
         end do
         if (pass == 1) allocate (magnitudes(n))
      end do
   end function magnitudes_of_forces

   !> Whether a number is one of them.
   pure logical function is_ranked(selection, catalogue, group, item)
      type(selection_t), intent(in) :: selection          !! what is recorded
      type(catalogue_t), intent(in) :: catalogue          !! what can be recorded
      integer, intent(in) :: group                        !! a quantity
      integer, intent(in) :: item                         !! number of the item in its group

      is_ranked = .false.
      associate (vector => catalogue%groups(group)%vector)
         if (vector == 0) return
         if (.not. is_force(catalogue, group)) return
         is_ranked = any(selection%groups(vector)%mask(:, item)) .and. .not. selection%groups(group)%mask(1, item)
      end associate
   end function is_ranked

   !> The forces, the largest first.
   function largest_forces(extremes, catalogue) result(table)
      type(extremes_t), intent(in) :: extremes      !! what the channels went through
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      type(result_table_t) :: table                 !! a row for each

      type(text_t), allocatable :: channels(:)
      real(wp), allocatable :: force(:), time(:)
      integer, allocatable :: list(:)
      integer :: k, n

      list = strongest(extremes, catalogue)
      n = min(size(list), most_rows)
      allocate (channels(n), force(n), time(n))
      do k = 1, n
         associate (one => extremes%of(list(k)))
            channels(k)%s = scalar_name(catalogue, extremes%channels(list(k)))
            force(k) = extremes%size_of(list(k))
            time(k) = merge(one%max_time, one%min_time, one%maximum >= -one%minimum)
         end associate
      end do
      call table%start("largest_forces", "extremes/forces", n, title="largest forces", &
                       elsewhere="summary.json and in run.h5, /extremes/forces")
      table%left_out = size(list) - n
      table%most = 10
      if (n == 0) table%group = ""
      call table%put("channel", "1", "largest force of each item, the magnitude of a vector", texts=channels, dataset="name", &
                     heading="channel")
      call table%put("force", "N", "its maximum, located between rows too", force, heading="max")
      call table%put("time", "s", "time of the first maximum", time, digits=6)
      if (extremes%has_course()) table%columns(3)%heading = "at"
   end function largest_forces

   !> For each item the number of its largest force that is more than round-off; the largest first.
   function strongest(extremes, catalogue) result(list)
      type(extremes_t), intent(in) :: extremes      !! what the channels went through
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      integer, allocatable :: list(:)               !! (any) numbers of channels

      type(name_table_t) :: items
      real(wp), allocatable :: force(:)
      integer, allocatable :: best(:)
      integer :: at, k, n

      n = size(extremes%channels)
      allocate (best(n))
      call items%start(n)
      n = 0
      do k = 1, size(best)
         associate (one => extremes%channels(k))
            if (.not. is_force(catalogue, one%group) .or. extremes%is_nothing(k) .or. .not. extremes%has_values(k)) cycle
            call items%enter(item_name(catalogue, catalogue%groups(one%group)%item_group, one%item), n + 1, at)
         end associate
         if (at == 0) then
            n = n + 1
            best(n) = k
         else if (extremes%size_of(k) > (1.0_wp + same)*extremes%size_of(best(at))) then
            best(at) = k
         end if
      end do
      force = [(extremes%size_of(best(k)), k=1, n)]
      allocate (list(n))
      do k = 1, n
         at = merge(maxloc(force, dim=1), k, k <= most_rows)
         list(k) = best(at)
         if (k <= most_rows) force(at) = -1.0_wp
      end do
   end function strongest

   !> Whether a quantity is a force, as a single number.
   pure logical function is_force(catalogue, group)
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      integer, intent(in) :: group                  !! the quantity

      integer, parameter :: lists(*) = [group_joints, group_drivers, group_clearances, group_contacts, group_forces]

      associate (this => catalogue%groups(group))
         is_force = any(this%item_group == lists) .and. this%channel%unit == "N" .and. this%channel%components == 1
      end associate
   end function is_force

end module forces_table
