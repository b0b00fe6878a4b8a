!> The first impacts of a run as a table.
module impacts_table
   use event_list, only: event_list_t, n_event_numbers, number_long_names, number_names, number_units
   use kinds, only: wp
   use result_table, only: in_text_files, only_shown, result_table_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: first_impacts

   integer, parameter :: most_impacts = 200   !! rows
   character(*), parameter :: kind_contact = "contact"  !! kind of event that is an impact
   character(*), parameter :: headings(8) = [character(16) :: "onset", "speed", "peak force", "penetration", "duration", &
      "separation", "energy lost", "impulse"]   !! of the first numbers of an event
   integer, parameter :: digits(size(headings)) = [9, 7, 8, 6, 6, 6, 6, 6]  !! of these numbers

contains

   !> The contacts in the order of their onsets.
   function first_impacts(events) result(table)
      type(event_list_t), intent(in) :: events  !! all events
      type(result_table_t) :: table             !! a row for each

      type(text_t), allocatable :: contacts(:), items(:), joints(:)
      real(wp), allocatable :: numbers(:, :)
      integer, allocatable :: list(:)
      character(:), allocatable :: missing
      integer :: k, n

      list = events%order_by_onset()
      list = pack(list, [(events%word(list(k), 1) == kind_contact, k=1, size(list))])
      n = min(size(list), most_impacts)
      call table%start("first_impacts", "", n, title="first impacts", elsewhere="events.dat and in run.h5, /events")
      table%left_out = size(list) - n
      table%most = 5
      table%most_in_json = 5
      allocate (contacts(n), items(n), numbers(n_event_numbers, n))
      do k = 1, n
         numbers(:, k) = events%numbers(list(k))
         items(k)%s = events%word(list(k), 2)
         contacts(k)%s = events%word(list(k), 3)
      end do
      joints = items
      do k = 1, n
         if (contacts(k)%s /= "") joints(k)%s = items(k)%s//"."//contacts(k)%s
      end do
      call table%put("joint", "1", "joint, and contact within it", texts=joints, formats=only_shown, heading="joint")
      call table%put("item", "1", "joint", texts=items, formats=in_text_files)
      call table%put("contact", "1", "label of the contact within the joint", texts=contacts, formats=in_text_files)
      do k = 1, n_event_numbers
         missing = "-"
         if (number_names(k) == "duration") missing = "in contact"
         call table%put(trim(number_names(k)), trim(number_units(k)), trim(number_long_names(k)), &
                        numbers(k, :), formats=in_text_files, missing=missing)
      end do
      do k = 1, size(headings)
         table%columns(k + 3)%heading = trim(headings(k))
         table%columns(k + 3)%digits = digits(k)
      end do
   end function first_impacts

end module impacts_table
