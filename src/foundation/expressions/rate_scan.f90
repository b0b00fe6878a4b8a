!> How long a step over a function of time may be without passing over what the function does, from the left to the right.
!>
!> The range is divided into stretches by halves until, of every operation f_k of the expression that bends,
!>
!> h^2 max|f_k''| <= 8 (max f_k - min f_k),
!>
!> so that the line between the ends of a stretch is off by less than what f_k changes in all, or f_k changes by less than
!> an eighth of that: a step of this length sees a pulse; its error control does the rest. Where the bounds of f_k'' are those
!> of the function everywhere (a sine), a stretch is not divided but has a characteristic rate of its own. Of a sine this gives 4
!> rad, of exp(-(t/T)^2) steps of T to 2 T where it is not flat.
!>
!> Stretches are made as they are asked for, from a stack. Limits: an operation without a maximum or minimum value (a pole) gives no
!> characteristic rate; of products and sums only the operands do.
module rate_scan
   use expression, only: expression_t
   use expression_bounds, only: bound_expression
   use kinds, only: eps, wp
   implicit none (type, external)
   private
   public :: new_rate_scan, rate_scan_t

   integer, parameter :: deepest = 60              !! stretches on the stack
   integer, parameter :: n_ahead = 8               !! stretches known ahead
   integer, parameter :: most_stretches = 1000000  !! that are looked through for the shortest characteristic rate
   integer, parameter :: n_quarter = 4             !! parts of a stretch that must all bend for a characteristic rate of its own
   integer, parameter :: n_look = 4                !! places looked at in each of them
   real(wp), parameter :: uniform = 0.25_wp        !! of the shortest characteristic rate: what counts as bending [1]
   real(wp), parameter :: golden = 0.61803398874989485_wp  !! places looked at are multiples of it [1]
   real(wp), parameter :: part_of_change = 0.125_wp  !! change that no characteristic rate is asked for [1]

   !> A stretch with its characteristic rate.
   type :: stretch_t
      real(wp) :: begin = 0.0_wp   !! where it starts [s]
      real(wp) :: end = 0.0_wp     !! where it ends [s]
      real(wp) :: pace = 0.0_wp    !! longest step on it [s]
   end type stretch_t

   !> A search.
   type :: rate_scan_t
      type(expression_t) :: f                    !! the function
      real(wp), allocatable :: change(:)         !! (operations) maximum less minimum value [any]
      logical :: is_calm = .true.                !! it limits no step
      real(wp) :: most = 0.0_wp                  !! maximum change of the function in a step, 0: any [any]
      real(wp) :: left = 0.0_wp                  !! where the stretches start that are left [s]
      real(wp) :: right(deepest) = 0.0_wp        !! (deepest) their ends, the first one on top [s]
      integer :: depth = 0                       !! how many
      type(stretch_t) :: ahead(n_ahead)          !! stretches found, the present one first
      integer :: n = 0                           !! how many
   contains
      procedure :: stop_after => rate_scan_stop_after
      procedure :: shortest => rate_scan_shortest
   end type rate_scan_t

contains

   !> Start a search over a range.
   subroutine new_rate_scan(f, first, last, most, scan)
      type(expression_t), intent(in) :: f      !! the function
      real(wp), intent(in) :: first            !! start of the range [s]
      real(wp), intent(in) :: last             !! its end [s]
      real(wp), intent(in) :: most             !! maximum change of the function in a step, 0: any [any]
      type(rate_scan_t), intent(out) :: scan   !! the search

      real(wp) :: bend(size(f%code)), jet(2, 3), range(2, size(f%code))

      scan%f = f
      call bound_expression(f, [first, last], jet, range, bend)
      allocate (scan%change(size(f%code)), source=0.0_wp)
      where (abs(range(1, :)) < huge(1.0_wp) .and. abs(range(2, :)) < huge(1.0_wp) .and. bend > 0.0_wp)
         scan%change = range(2, :) - range(1, :)
      end where
      scan%most = most
      scan%is_calm = .not. (any(scan%change > 0.0_wp) .or. most > 0.0_wp)
      scan%left = first
      scan%right(1) = last
      scan%depth = merge(0, 1, scan%is_calm)
   end subroutine new_rate_scan

   !> Where a step that starts at a time must end at the latest.
   subroutine rate_scan_stop_after(self, t, stop)
      class(rate_scan_t), intent(inout) :: self  !! the search; times must not fall from call to call
      real(wp), intent(in) :: t                  !! start of the step [s]
      real(wp), intent(out) :: stop              !! its latest end; beyond all numbers if nothing limits it [s]

      integer :: k

      stop = huge(1.0_wp)
      if (self%is_calm) return
      do
         do while (self%n > 0)
            if (self%ahead(1)%end > t) exit
            self%ahead(1:self%n - 1) = self%ahead(2:self%n)
            self%n = self%n - 1
         end do
         if (self%n > 0 .or. self%depth == 0) exit
         call find_stretch(self)
      end do
      if (self%n == 0) return
      stop = t + self%ahead(1)%pace
      k = 1
      do
         if (stop <= self%ahead(k)%end) exit
         if (k == self%n) then
            if (self%n == n_ahead) then
               stop = self%ahead(k)%end
               exit
            end if
            if (self%depth == 0) exit
            call find_stretch(self)
            if (k == self%n) exit
         end if
         k = k + 1
         stop = min(stop, max(self%ahead(k)%begin, t + self%ahead(k)%pace))
      end do
   end subroutine rate_scan_stop_after

   !> The shortest characteristic rate and where it is; the search is at its end afterwards.
   subroutine rate_scan_shortest(self, pace, at)
      class(rate_scan_t), intent(inout) :: self  !! the search, just started
      real(wp), intent(out) :: pace              !! longest step there; beyond all numbers if nothing limits it [s]
      real(wp), intent(out) :: at                !! middle of the stretch [s]

      integer :: k

      pace = huge(1.0_wp)
      at = 0.0_wp
      do k = 1, most_stretches
         if (self%depth == 0) exit
         self%n = 0
         call find_stretch(self)
         if (self%ahead(1)%pace >= pace) cycle
         pace = self%ahead(1)%pace
         at = 0.5_wp*(self%ahead(1)%begin + self%ahead(1)%end)
      end do
   end subroutine rate_scan_shortest

   !> Find the next stretch.
   subroutine find_stretch(self)
      class(rate_scan_t), intent(inout) :: self  !! the search

      real(wp) :: a, b, middle, pace
      real(wp) :: bend(size(self%f%code)), jet(2, 3), range(2, size(self%f%code))

      do
         a = self%left
         b = self%right(self%depth)
         call bound_expression(self%f, [a, b], jet, range, bend)
         pace = pace_of(self, bend, range, jet, b - a)
         middle = a + 0.5_wp*(b - a)
         if (pace >= b - a .or. self%depth == deepest .or. b - a <= 64.0_wp*eps*abs(b) .or. middle <= a .or. middle >= b) exit
         if (bends_all_over(self, a, b, pace)) exit
         self%depth = self%depth + 1
         self%right(self%depth) = middle
      end do
      self%left = b
      self%depth = self%depth - 1
      self%n = self%n + 1
      self%ahead(self%n) = stretch_t(a, b, pace)
   end subroutine find_stretch

   !> Longest step that the bends allow.
   pure real(wp) function pace_of(self, bend, range, jet, width) result(pace)
      class(rate_scan_t), intent(in) :: self  !! the search
      real(wp), intent(in) :: bend(:)         !! (operations) maximum second derivatives [any]
      real(wp), intent(in) :: range(:, :)     !! (2, operations) bounds of the results [any]
      real(wp), intent(in) :: jet(2, 3)       !! (2, 3) bounds of the function and its derivatives [any]
      real(wp), intent(in) :: width           !! length of the stretch, 0: an instant [s]

      integer :: k

      pace = huge(1.0_wp)
      if (self%most > 0.0_wp .and. maxval(abs(jet(:, 2))) > 0.0_wp) pace = self%most/maxval(abs(jet(:, 2)))
      do k = 1, size(bend)
         if (.not. self%change(k) > 0.0_wp .or. .not. bend(k) > 0.0_wp) cycle
         if (width > 0.0_wp .and. range(2, k) - range(1, k) <= part_of_change*self%change(k)) then
            pace = min(pace, max(width, sqrt(8.0_wp*(self%change(k)/bend(k)))))
         else
            pace = min(pace, sqrt(8.0_wp*(self%change(k)/bend(k))))
         end if
      end do
   end function pace_of

   !> Whether a function bends as much as its bounds say in all parts of a stretch.
   logical function bends_all_over(self, a, b, pace)
      class(rate_scan_t), intent(in) :: self  !! the search
      real(wp), intent(in) :: a               !! start of the stretch [s]
      real(wp), intent(in) :: b               !! its end [s]
      real(wp), intent(in) :: pace            !! by the bounds [s]

      real(wp) :: t
      real(wp) :: bend(size(self%f%code)), jet(2, 3), range(2, size(self%f%code))
      integer :: i, k
      logical :: does_bend

      bends_all_over = pace > 0.0_wp
      do i = 1, n_quarter
         if (.not. bends_all_over) return
         does_bend = .false.
         do k = 1, n_look
            t = a + (b - a)*(real(i - 1, wp) + modulo(golden*(k + n_look*i), 1.0_wp))/n_quarter
            call bound_expression(self%f, [t, t], jet, range, bend)
            does_bend = does_bend .or. uniform*pace_of(self, bend, range, jet, 0.0_wp) <= pace
         end do
         bends_all_over = does_bend
      end do
   end function bends_all_over

end module rate_scan
