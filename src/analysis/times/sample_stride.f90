!> How many steps of an integration lie between two samples of its motion.
!>
!> Steps are followed one by one where accelerations bend; where they are nearly straight between samples the stride doubles. The
!> bend is the distance of the middle one of three samples from the chord through the others, of the largest of the three.
!> The stride depends on the steps and the accelerations only, not on output instants or on what is recorded.
!>
!> Limits: at most `longest` steps.
module sample_stride
   use kinds, only: wp
   use archive, only: archive_t
   implicit none (type, external)
   private
   public :: sample_stride_t

   integer, parameter :: longest = 8               !! steps of the longest stride
   real(wp), parameter :: straight = 1.0e-3_wp     !! bend below which the stride doubles [1]
   real(wp), parameter :: bent = 4.0e-3_wp         !! bend above which it halves [1]
   real(wp), parameter :: round_off = 1.0e-9_wp    !! accelerations below this part of the largest are not judged [1]
   real(wp), parameter :: faded = 1.0e-2_wp        !! accelerations below this part of their own largest count as that [1]

   !> The stride.
   type :: sample_stride_t
      private
      integer :: length = 1                !! steps from one sample to the next
      integer :: n_step = 0                !! steps since the last sample
      integer :: n = 0                     !! samples since the last event, at most 3
      real(wp) :: t(3) = 0.0_wp            !! (3) times of the last samples [s]
      integer :: column(3) = [1, 2, 3]     !! (3) where these samples are in what follows
      real(wp), allocatable :: a(:, :)     !! (m, 3) accelerations, by column [any]
      real(wp), allocatable :: most(:)     !! (m) their maximum magnitudes so far [any]
   contains
      procedure :: begin => begin_stride
      procedure :: forget => forget_samples
      procedure :: is_first
      procedure :: count_step
      procedure :: add_sample
      procedure :: save => save_stride
      procedure :: load => load_stride
   end type sample_stride_t

contains

   !> Start with the first step.
   subroutine begin_stride(self, m)
      class(sample_stride_t), intent(inout) :: self  !! the stride
      integer, intent(in) :: m                       !! accelerations

      allocate (self%a(m, 3), self%most(m), source=0.0_wp)
   end subroutine begin_stride

   !> An event: each step is sampled again.
   pure subroutine forget_samples(self)
      class(sample_stride_t), intent(inout) :: self  !! the stride

      self%length = 1
      self%n_step = 0
      self%n = 0
   end subroutine forget_samples

   !> Whether the step is the first one since an event.
   pure logical function is_first(self)
      class(sample_stride_t), intent(in) :: self  !! the stride

      is_first = self%n <= 1
   end function is_first

   !> A step was made.
   pure subroutine count_step(self, is_due)
      class(sample_stride_t), intent(inout) :: self  !! the stride
      logical, intent(out) :: is_due                 !! its end is to be sampled

      self%n_step = self%n_step + 1
      is_due = self%n_step >= self%length
   end subroutine count_step

   !> A sample; the next stride follows from the bend.
   pure subroutine add_sample(self, t, a)
      class(sample_stride_t), intent(inout) :: self  !! the stride
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: a(:)                   !! (m) accelerations [any]

      real(wp) :: bend

      self%t = [self%t(2:), t]
      self%column = [self%column(2:), self%column(1)]
      self%a(:, self%column(3)) = a
      self%most = max(self%most, abs(a))
      self%n = min(self%n + 1, 3)
      self%n_step = 0
      if (self%n < 3 .or. .not. self%t(3) > self%t(1)) return
      associate (a => self%a, c => self%column)
         bend = bend_of(size(self%most), self%t, a(:, c(1)), a(:, c(2)), a(:, c(3)), self%most)
      end associate
      if (bend < straight) self%length = min(2*self%length, longest)
      if (bend > bent) self%length = max(self%length/2, 1)
   end subroutine add_sample

   !> Bend of the accelerations between three samples.
   pure real(wp) function bend_of(m, t, a1, a2, a3, most) result(bend)
      integer, intent(in) :: m                     !! accelerations
      real(wp), intent(in) :: t(3)                 !! (3) times of the samples [s]
      real(wp), intent(in) :: a1(m), a2(m), a3(m)  !! (m) accelerations there [any]
      real(wp), intent(in) :: most(m)              !! (m) their maximum magnitudes so far [any]

      real(wp) :: floor, part, scale
      integer :: k

      part = (t(2) - t(1))/(t(3) - t(1))
      floor = round_off*maxval(most)
      bend = 0.0_wp
      do k = 1, m
         if (most(k) <= floor) cycle
         scale = max(abs(a1(k)), abs(a2(k)), abs(a3(k)), faded*most(k))
         bend = max(bend, abs(a2(k) - (1.0_wp - part)*a1(k) - part*a3(k))/scale)
      end do
   end function bend_of

   !> Write what is remembered.
   subroutine save_stride(self, archive)
      class(sample_stride_t), intent(in) :: self  !! the stride
      type(archive_t), intent(inout) :: archive         !! receives it

      integer :: k

      if (.not. allocated(self%a)) return
      call archive%put([self%length, self%n_step, self%n])
      call archive%put([self%t, self%most])
      do k = 1, 3
         call archive%put(self%a(:, self%column(k)))
      end do
   end subroutine save_stride

   !> Take it back.
   subroutine load_stride(self, archive)
      class(sample_stride_t), intent(inout) :: self  !! the stride, started
      type(archive_t), intent(inout) :: archive            !! holds it

      integer :: k

      if (.not. allocated(self%a)) return
      call archive%get(self%length)
      call archive%get(self%n_step)
      call archive%get(self%n)
      call archive%get(self%t)
      call archive%get(self%most)
      do k = 1, 3
         call archive%get(self%a(:, self%column(k)))
      end do
   end subroutine load_stride

end module sample_stride
