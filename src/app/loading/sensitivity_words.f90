!> The words of the section [sensitivity]: parameters and results, held against what a deck has.
module sensitivity_words
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use channels, only: list_scalars, match_word, selection_t
   use contact_words, only: find_contacts
   use deck_parameter, only: number_parameter
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: unit_text
   use groups_of_catalogue, only: group_energy
   use item, only: item_t, location_of, place_of
   use kind_info, only: dim_time, same_dimension
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use numbers, only: number_length
   use sensitivity_results, only: asked_t, is_of_contact, n_result_kind, result_names, result_units, result_value, &
      sensitivity_plan_t
   use text, only: to_text
   use units, only: parse_unit, read_quantity, unit_t
   implicit none (type, external)
   private
   public :: plan_sensitivity

   integer, parameter :: most_onsets = 100000   !! number of an onset, at most
   character(*), parameter :: forms = "write JOINT.onset(N), and likewise impact_speed, peak_force, peak_penetration, duration, " &
      //"release_speed; at(CHANNEL,TIME), max(CHANNEL), min(CHANNEL)"

contains

   !> What the section asks for.
   subroutine plan_sensitivity(deck, section, system, catalogue, end, plan, mistakes)
      type(deck_t), intent(in) :: deck                   !! the deck, for its parameters
      type(item_t), intent(in) :: section                !! the section
      type(mechanism_t), intent(in) :: system            !! the mechanism, for its contacts
      type(catalogue_t), intent(in) :: catalogue         !! what it can report
      real(wp), intent(in) :: end                        !! of the motion [s]
      type(sensitivity_plan_t), intent(out) :: plan      !! what is asked for
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      type(asked_t), allocatable :: some(:)
      character(:), allocatable :: hint, message
      integer :: k

      plan%tolerance = section%number("tolerance")
      plan%end = end
      call plan_parameters(deck, section, plan, mistakes)
      allocate (plan%results(0))
      associate (value => section%values(place_of(section, "results")))
         do k = 1, size(value%words)
            call read_result(value%words(k)%s, system, catalogue, end, some, message, hint)
            if (message == "") then
               plan%results = [plan%results, some]
            else
               call mistakes%add(location_of(value, k), message, "not a result of this deck", hint)
            end if
         end do
      end associate
   end subroutine plan_sensitivity

   !> The parameters.
   subroutine plan_parameters(deck, section, plan, mistakes)
      type(deck_t), intent(in) :: deck                       !! the deck
      type(item_t), intent(in) :: section                    !! the section
      type(sensitivity_plan_t), intent(inout) :: plan        !! parameters are set
      type(diagnostics_t), intent(inout) :: mistakes         !! errors found

      integer :: k, n

      associate (value => section%values(place_of(section, "parameters")))
         plan%parameters = value%words
         allocate (plan%units(size(value%words)), plan%values(size(value%words)))
         do k = 1, size(value%words)
            plan%units(k)%s = ""
            plan%values(k) = 0.0_wp
            n = number_parameter(deck, value%words(k)%s, location_of(value, k), mistakes)
            if (n == 0) cycle
            plan%values(k) = deck%symbols%list(n)%number
            plan%units(k)%s = unit_text(deck%symbols%list(n)%dimension)
         end do
      end associate
   end subroutine plan_parameters

   !> Read a result.
   subroutine read_result(word, system, catalogue, end, some, message, hint)
      character(*), intent(in) :: word                         !! as in the deck
      type(mechanism_t), intent(in) :: system                  !! the mechanism
      type(catalogue_t), intent(in) :: catalogue               !! what it can report
      real(wp), intent(in) :: end                              !! of the motion [s]
      type(asked_t), allocatable, intent(out) :: some(:)       !! (n) what it asks for, one for each number of a range
      character(:), allocatable, intent(out) :: message        !! what is wrong; blank: nothing
      character(:), allocatable, intent(out) :: hint           !! what to do

      type(asked_t) :: asked
      integer :: dot, k, open

      allocate (some(0))
      message = "'"//word//"' is not a result"
      hint = forms
      open = index(word, "(")
      if (open < 2 .or. word(len(word):) /= ")") return
      dot = index(word(:open - 1), ".", back=.true.)
      do k = 1, n_result_kind
         if (word(dot + 1:open - 1) == trim(result_names(k)) .and. (is_of_contact(k) .eqv. dot > 0)) exit
      end do
      if (k > n_result_kind) return
      asked%word = word
      asked%kind = k
      asked%unit = trim(result_units(k))
      message = ""
      if (is_of_contact(k)) then
         call read_onsets(word(:dot - 1), word(:open - 1), word(open + 1:len(word) - 1), system, asked, some, message, hint)
      else
         call read_channel(word(open + 1:len(word) - 1), catalogue, end, asked, message, hint)
         if (message == "") some = [asked]
      end if
   end subroutine read_result

   !> Contacts of a joint, and which of their onsets.
   subroutine read_onsets(joint, head, range, system, asked, some, message, hint)
      character(*), intent(in) :: joint                           !! name of the joint, or JOINT.CONTACT
      character(*), intent(in) :: head                            !! the word before the parenthesis
      character(*), intent(in) :: range                           !! N or A..B
      type(mechanism_t), intent(in) :: system                     !! the mechanism
      type(asked_t), intent(inout) :: asked                       !! what all of them have in common
      type(asked_t), allocatable, intent(inout) :: some(:)        !! (n) one for each onset
      character(:), allocatable, intent(inout) :: message, hint   !! as in `read_result`

      integer :: dots, first, k, last, status(2)

      call find_contacts(system, joint, asked%first, asked%last, message, hint)
      if (message /= "") return
      dots = index(range, "..")
      if (dots == 0) then
         read (range, *, iostat=status(1)) first
         status(2) = status(1)
         last = first
      else
         read (range(:dots - 1), *, iostat=status(1)) first
         read (range(dots + 2:), *, iostat=status(2)) last
      end if
      if (any(status /= 0) .or. verify(range, "0123456789.") > 0) first = 0
      if (first < 1 .or. last < first .or. last > most_onsets) then
         message = "'"//range//"' is not the number of an onset"
         hint = "number onsets of the joint from 1, as "//head//"(1) or "//head//"(1..5)"
         return
      end if
      do k = first, last
         asked%ordinal = k
         asked%word = head//"("//to_text(k)//")"
         some = [some, asked]
      end do
   end subroutine read_onsets

   !> A channel, perhaps with a time.
   subroutine read_channel(words, catalogue, end, asked, message, hint)
      character(*), intent(in) :: words                           !! between the parentheses
      type(catalogue_t), intent(in) :: catalogue                  !! what can be reported
      real(wp), intent(in) :: end                                 !! of the motion [s]
      type(asked_t), intent(inout) :: asked                       !! channel and time are set
      character(:), allocatable, intent(inout) :: message, hint   !! as in `read_result`

      type(scalar_t), allocatable :: scalars(:)
      type(selection_t) :: selection
      integer :: comma

      comma = index(words//",", ",")
      call match_word(words(:comma - 1), catalogue, selection, message, hint)
      if (message /= "") return
      scalars = list_scalars(selection)
      if (size(scalars) /= 1) then
         message = "'"//words(:comma - 1)//"' is not a single number"
         hint = "name one component of a channel, as slider.position.x"
         return
      end if
      asked%channel = [scalars(1)%group, scalars(1)%component, scalars(1)%item]
      asked%unit = catalogue%groups(scalars(1)%group)%channel%unit
      if (catalogue%groups(scalars(1)%group)%item_group == group_energy) then
         message = "'"//words(:comma - 1)//"' has no derivatives: energies are sums over contacts"
         hint = "name a channel of bodies, joints or contacts"
      else if (asked%kind == result_value) then
         call read_time(words(min(comma + 1, len(words) + 1):), end, asked%t, message, hint)
      else if (comma <= len(words)) then
         message = "'"//words//"' has more than a channel"
         hint = forms
      end if
   end subroutine read_channel

   !> A time of the motion with its unit.
   subroutine read_time(words, end, t, message, hint)
      character(*), intent(in) :: words                           !! as `5ms`
      real(wp), intent(in) :: end                                 !! of the motion [s]
      real(wp), intent(out) :: t                                  !! the time [s]
      character(:), allocatable, intent(inout) :: message, hint   !! as in `read_result`

      type(unit_t) :: unit
      character(:), allocatable :: wrong
      integer :: first, last, n
      logical :: is_good

      t = 0.0_wp
      n = number_length(words)
      is_good = n > 0 .and. n < len(words)
      if (is_good) then
         call parse_unit(adjustl(words(n + 1:)), unit, wrong, first, last)
         is_good = wrong == ""
         if (is_good) is_good = same_dimension(unit%dimension, dim_time)
         if (is_good) call read_quantity(words(:n), unit, t, is_good)
      end if
      if (.not. is_good) then
         message = "'"//words//"' is not a time"
         hint = "write at(CHANNEL,TIME) with a time and its unit, as at(slider.velocity.x,5ms)"
      else if (t < 0.0_wp .or. t > end) then
         message = "'"//words//"' is not within the motion"
         hint = "give a time from 0 s to the end of the motion"
      end if
   end subroutine read_time

end module sensitivity_words
