!> The results of a sweep: numbers of every run, and over the runs of each case their mean, standard deviation, minimum and
!> maximum value.
!>
!> Runs are numbered case by case, so that what is written does not depend on which of them ended first. The standard
!> deviation is that of the sample, over n - 1; of one run it is not known.
module sweep_results
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: not_a_number, wp
   use swept, only: sweep_t
   use sweep_journal, only: run_record_t
   use text, only: append_text, join, text_t
   implicit none (type, external)
   private
   public :: case_numbers, n_spread, spread_names, sweep_results_t

   integer, parameter :: n_spread = 4  !! numbers over the runs of a case
   !> Their names.
   character(*), parameter :: spread_names(n_spread) = [character(9) :: "mean", "deviation", "min", "max"]

   !> What came of one run.
   type :: run_result_t
      integer :: exit_code = -1                     !! -1: not run
      character(:), allocatable :: message          !! why, if not 0; else blank
      character(:), allocatable :: warnings         !! what a careful reader should know; blank: nothing
      real(wp), allocatable :: numbers(:)           !! (n) as in `names`, perhaps fewer; NaN: not known [any]
      integer, allocatable :: order(:)              !! (own) its own names, numbers in `names`
      real(wp), allocatable :: poincare_times(:)      !! (m) instants once per period [s]
      real(wp), allocatable :: poincare_samples(:, :)        !! (own channels, m) its channels at them, SI [any]
      integer, allocatable :: poincare_order(:)       !! (own channels) their numbers in `poincare_names`
      real(wp) :: cpu(2) = 0.0_wp                   !! (2) processor time of its start and of itself [s]
   end type run_result_t

   !> All results.
   type :: sweep_results_t
      type(sweep_t) :: sweep                            !! the cases
      integer :: n_member = 1                           !! runs of a case
      logical :: is_ensemble = .false.                  !! whether their starts are perturbed
      type(text_t), allocatable :: names(:)             !! (n) names of the numbers
      type(text_t), allocatable :: units(:)             !! (n) their units
      type(text_t), allocatable :: poincare_names(:)      !! (channels) names of the stroboscopic channels
      type(run_result_t), allocatable :: runs(:)        !! (cases*n_member) case by case
   contains
      procedure :: start => start_results
      procedure :: take => take_run
      procedure :: settle
      procedure :: poincare_of
   end type sweep_results_t

contains

   !> Nothing has been run yet.
   subroutine start_results(self)
      class(sweep_results_t), intent(inout) :: self  !! the results; sweep and n_member are known

      integer :: k

      allocate (self%names(0), self%units(0), self%poincare_names(0))
      allocate (self%runs(self%sweep%n_cases()*self%n_member))
      do k = 1, size(self%runs)
         self%runs(k)%message = "not run"
         self%runs(k)%warnings = ""
         allocate (self%runs(k)%numbers(0), self%runs(k)%poincare_times(0), self%runs(k)%poincare_samples(0, 0))
         allocate (self%runs(k)%order(0), self%runs(k)%poincare_order(0))
      end do
   end subroutine start_results

   !> Take what a run gave.
   subroutine take_run(self, record)
      class(sweep_results_t), intent(inout) :: self  !! the results
      type(run_record_t), intent(in) :: record       !! what came of the run

      integer :: at, k

      associate (run => self%runs(record%number), member => record%member)
         run = run_result_t()
         run%exit_code = record%exit_code
         run%message = record%message
         run%warnings = join(member%warnings, "; ")
         run%poincare_times = member%poincare_times
         run%poincare_samples = member%poincare_samples
         run%cpu = [member%cpu_start, member%cpu_run]
         allocate (run%numbers(size(self%names)), source=not_a_number())
         allocate (run%order(size(member%numbers)), run%poincare_order(size(member%poincare_names)))
         do k = 1, size(member%numbers)
            call find_name(member%numbers(k)%name, self%names, at)
            if (at > size(self%units)) call append_text(self%units, member%numbers(k)%unit)
            if (at > size(run%numbers)) run%numbers = [run%numbers, not_a_number()]
            run%numbers(at) = member%numbers(k)%value
            run%order(k) = at
         end do
         do k = 1, size(member%poincare_names)
            call find_name(member%poincare_names(k)%s, self%poincare_names, run%poincare_order(k))
         end do
      end associate
   end subroutine take_run

   !> The number of a name, which is appended if it is new.
   subroutine find_name(name, names, at)
      character(*), intent(in) :: name                           !! the name
      type(text_t), allocatable, intent(inout) :: names(:)       !! (n) all names
      integer, intent(out) :: at                                 !! its number

      do at = 1, size(names)
         if (names(at)%s == name) return
      end do
      call append_text(names, name)
   end subroutine find_name

   !> Put the names in the order in which the runs have them, the first run first: not in that in which these ended.
   subroutine settle(self)
      class(sweep_results_t), intent(inout) :: self  !! the results

      real(wp), allocatable :: numbers(:)
      integer :: from(size(self%names)), k, n, place(size(self%names)), poincare_place(size(self%poincare_names))

      place = 0
      poincare_place = 0
      do k = 1, size(self%runs)
         call enter(self%runs(k)%order, place)
         call enter(self%runs(k)%poincare_order, poincare_place)
      end do
      call reorder(self%names, place)
      call reorder(self%units, place)
      call reorder(self%poincare_names, poincare_place)
      do n = 1, size(place)
         from(place(n)) = n
      end do
      do k = 1, size(self%runs)
         associate (run => self%runs(k))
            run%order = place(run%order)
            run%poincare_order = poincare_place(run%poincare_order)
            allocate (numbers(size(place)), source=not_a_number())
            do n = 1, size(place)
               if (from(n) <= size(run%numbers)) numbers(n) = run%numbers(from(n))
            end do
            call move_alloc(numbers, run%numbers)
         end associate
      end do

   contains

      !> Give names that have no place yet the next ones.
      pure subroutine enter(order, places)
         integer, intent(in) :: order(:)         !! (m) numbers of names
         integer, intent(inout) :: places(:)     !! (n) their new numbers, 0: none yet

         integer :: i

         do i = 1, size(order)
            if (places(order(i)) == 0) places(order(i)) = maxval(places) + 1
         end do
      end subroutine enter

      !> Move texts to their new places.
      subroutine reorder(list, places)
         type(text_t), allocatable, intent(inout) :: list(:)  !! (n) texts
         integer, intent(inout) :: places(:)                  !! (n) their places; texts that no run has come last

         type(text_t), allocatable :: moved(:)
         integer :: i

         allocate (moved(size(list)))
         do i = 1, size(list)
            if (places(i) == 0) places(i) = maxval(places) + 1
            moved(places(i))%s = list(i)%s
         end do
         call move_alloc(moved, list)
      end subroutine reorder

   end subroutine settle

   !> The stroboscopic samples of a run, a row for each of `poincare_names`; NaN where the run has no such channel.
   function poincare_of(self, number) result(poincare_samples)
      class(sweep_results_t), intent(in) :: self     !! the results
      integer, intent(in) :: number                  !! of the run
      real(wp), allocatable :: poincare_samples(:, :)         !! (channels, m) the channels, SI [any]

      integer :: k

      associate (run => self%runs(number))
         allocate (poincare_samples(size(self%poincare_names), size(run%poincare_times)), source=not_a_number())
         do k = 1, size(run%poincare_order)
            poincare_samples(run%poincare_order(k), :) = run%poincare_samples(k, :)
         end do
      end associate
   end function poincare_of

   !> A number over the runs of a case that have it: how many, and mean, deviation, minimum and maximum.
   pure subroutine case_numbers(self, case_number, number, n, spread)
      class(sweep_results_t), intent(in) :: self     !! the results
      integer, intent(in) :: case_number             !! of the case
      integer, intent(in) :: number                  !! of the number
      integer, intent(out) :: n                      !! runs that ended well and have the number
      real(wp), intent(out) :: spread(n_spread)      !! (4) as `spread_names`; NaN: not known [any]

      real(wp) :: sample(self%n_member)
      integer :: k

      n = 0
      do k = (case_number - 1)*self%n_member + 1, case_number*self%n_member
         associate (run => self%runs(k))
            if (run%exit_code /= 0 .or. size(run%numbers) < number) cycle
            if (ieee_is_nan(run%numbers(number))) cycle
            n = n + 1
            sample(n) = run%numbers(number)
         end associate
      end do
      spread = not_a_number()
      if (n == 0) return
      spread(1) = sum(sample(1:n))/real(n, wp)
      if (n > 1) spread(2) = sqrt(sum((sample(1:n) - spread(1))**2)/real(n - 1, wp))
      spread(3:4) = [minval(sample(1:n)), maxval(sample(1:n))]
   end subroutine case_numbers

end module sweep_results
