!> Parts of rows of [tolerance]: measured values, batches of parameters, and words among the choices of a column.
module tolerance_rows
   use deck_parameter, only: check_dimension
   use diagnostics, only: diagnostics_t
   use item, only: item_t, place_of
   use kind_info, only: dim_none, kind_info_t, same_dimension
   use kinds, only: wp
   use number_lists, only: file_to_lists
   use text, only: append_text, split_blank, text_t, to_text
   use tolerance_plan, only: tolerance_plan_t
   use tolerated, only: most_random, new_measured, tolerated_t
   implicit none (type, external)
   private
   public :: measured_lists, number_of, read_batches, refuse, take_measured

   character(5), parameter :: measured_lists(2) = [character(5) :: "value", "count"]   !! in the order of a file's columns

contains

   !> Values that were measured.
   subroutine take_measured(item, is_soft, parameter, mistakes)
      type(item_t), intent(inout) :: item             !! the row; values of a file become lists
      logical, intent(in) :: is_soft                  !! the radians of the parameter may be taken or left
      type(tolerated_t), intent(inout) :: parameter   !! its nominal value is known
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      real(wp), allocatable :: numbers(:)
      integer :: before, twice

      before = mistakes%count()
      call file_to_lists(item, measured_lists, twice)
      call refuse(item, ["plus_minus", "shift     "], "another distribution", mistakes)
      associate (values => item%values(place_of(item, "value")), counts => item%values(place_of(item, "count")))
         if (twice > 0) then
            call mistakes%add(item%values(twice)%location, "the measured values are already given by a file", "given again", &
                              "give columns value and count, or column file")
         else if (.not. values%given) then
            call mistakes%add(item%location, "parameter '"//item%name//"' has no measured values", "no values", &
                              "give column value, as ""10.02 10.03 10.05 mm"", or column file")
         else if (size(values%table, 1) == 0) then
            call mistakes%add(values%location, "parameter '"//item%name//"' has no measured values", "no values")
         else if (counts%given) then
            if (.not. same_dimension(counts%dimensions(1), dim_none)) then
               call mistakes%add(counts%location, "a count has no unit", "parts that have the value")
            else if (size(counts%table, 1) /= size(values%table, 1)) then
               call mistakes%add(counts%location, to_text(size(counts%table, 1))//" counts of "// &
                                 to_text(size(values%table, 1))//" values", "one is expected for each value")
            else if (.not. all(counts%table > 0.0_wp)) then
               call mistakes%add(counts%location, "a count must be positive", "not positive")
            end if
         end if
         call check_dimension(values, parameter%dimension, is_soft, mistakes)
         if (mistakes%count() > before) return
         allocate (numbers(size(values%table, 1)), source=1.0_wp)
         if (counts%given) numbers = counts%table(:, 1)
         call new_measured(parameter, values%table(:, 1), numbers)
      end associate
   end subroutine take_measured

   !> Which parameters deviate together.
   subroutine read_batches(items, plan, mistakes)
      type(item_t), intent(in) :: items(:)            !! (parameters) rows of [tolerance], without errors
      type(tolerance_plan_t), intent(inout) :: plan   !! its parameters are read; batches are set
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      integer :: i, k

      allocate (plan%batches(0))
      do k = 1, size(items)
         associate (batch => items(k)%values(place_of(items(k), "batch")), parameter => plan%parameters(k))
            if (.not. batch%given .or. batch%text == "") then
               call refuse(items(k), ["correlation"], "a batch", mistakes)
               cycle
            end if
            do i = 1, size(plan%batches)
               if (plan%batches(i)%s == batch%text) parameter%batch = i
            end do
            if (parameter%batch == 0) then
               call append_text(plan%batches, batch%text)
               parameter%batch = size(plan%batches)
            end if
            parameter%in_batch = 1.0_wp
            associate (part => items(k)%values(place_of(items(k), "correlation")))
               if (part%given) parameter%in_batch = part%number
            end associate
            if (parameter%n_random() == most_random) then
               call mistakes%add(batch%location, "a fit is of two parts, which are no batch", "of a fit", &
                                 "give hole and shaft a parameter each, with their tolerance classes")
            else if (any([(items(i)%name == batch%text, i=1, size(items))])) then
               call mistakes%add(batch%location, "a batch has the name of a parameter", "take another name")
            end if
         end associate
      end do
      do k = 1, size(items)
         associate (number => plan%parameters(k)%batch)
            if (number == 0) cycle
            if (count(plan%parameters%batch == number) > 1) cycle
            call mistakes%add(items(k)%values(place_of(items(k), "batch"))%location, "batch '"//plan%batches(number)%s// &
                              "' has one parameter only", "no other one deviates with it")
         end associate
      end do
   end subroutine read_batches

   !> Refuse columns that belong to something else.
   subroutine refuse(item, columns, owner, mistakes)
      type(item_t), intent(in) :: item                !! the row
      character(*), intent(in) :: columns(:)          !! their names
      character(*), intent(in) :: owner               !! what they belong to
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      integer :: k

      do k = 1, size(columns)
         associate (value => item%values(place_of(item, trim(columns(k)))))
            if (value%given) call mistakes%add(value%location, trim(columns(k))//" is given without what it belongs to", &
                                               "of "//owner)
         end associate
      end do
   end subroutine refuse

   !> Number of a word among the choices of its column.
   integer function number_of(info, item, column) result(number)
      type(kind_info_t), intent(in) :: info   !! the kind
      type(item_t), intent(in) :: item        !! the row
      character(*), intent(in) :: column      !! the column

      type(text_t), allocatable :: words(:)
      integer :: k

      number = 0
      allocate (words, source=split_blank(info%columns(place_of(item, column))%choices))
      do k = 1, size(words)
         if (words(k)%s == item%values(place_of(item, column))%text) number = k
      end do
   end function number_of

end module tolerance_rows
