!> Sobol' indices of members that were run, by a polynomial through them.
!>
!> The polynomial is one of the deviation of each parameter; of parameters of a batch, one of the normal numbers of parameter and
!> batch; of a fit, one of hole and shaft each. Where it misses more than a fifth of the variance there are no indices.
!> Source and formulas: sparse_polynomial.
module polynomial_study
   use gauss_points, only: five_places, five_weights, n_five
   use kinds, only: i8, not_a_number, wp
   use member_draws, only: draw_t, stream_members
   use normal_distribution, only: normal_quantile
   use orthogonal_polynomials, only: family_t, max_degree, new_family
   use run_design, only: run_design_t
   use sparse_polynomial, only: fit_polynomial, polynomial_t
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: most_missed, take_polynomials

   real(wp), parameter :: most_missed = 0.2_wp   !! part of a variance that a polynomial may miss [1]
   integer, parameter :: halvings = 40           !! panels of the nodes towards 0 and towards 1

contains

   !> Fit polynomials to all requests and take their indices.
   subroutine take_polynomials(study, design, values, is_failed)
      type(tolerance_study_t), intent(inout) :: study   !! the study; its indices are set
      type(run_design_t), intent(in) :: design          !! the cases
      real(wp), intent(in) :: values(:, :)              !! (requests, cases) values [any]
      logical, intent(in) :: is_failed(:)               !! (cases) failed

      type(draw_t) :: draw
      type(family_t), allocatable :: families(:)
      type(polynomial_t) :: polynomial
      integer, allocatable :: good(:), owners(:)
      real(wp), allocatable :: p(:, :, :), u(:), y(:)
      integer :: j, m, r

      call draw%begin(study)
      call find_families(study, draw, families, owners)
      good = pack([(m, m=1, design%n_member)], .not. is_failed([(design%member(m), m=1, design%n_member)]))
      allocate (p(0:max_degree, draw%n, size(good)), u(draw%n), y(size(good)))
      do m = 1, size(good)
         call draw%numbers(stream_members, int(good(m), i8), u)
         do j = 1, draw%n
            p(:, j, m) = families(j)%values(number_at(study, draw, owners(j), j, u(j)))
         end do
      end do
      associate (found => study%indices, n => size(study%contributors))
         found%points = size(good)
         found%open = design%n_member - size(good)
         allocate (found%first(3, n, size(values, 1), 1), found%total(3, n, size(values, 1), 1), source=not_a_number())
         allocate (found%missed(size(values, 1)), source=not_a_number())
         do r = 1, size(values, 1)
            do m = 1, size(good)
               y(m) = values(r, design%member(good(m)))
            end do
            if (.not. maxval(y) - minval(y) > 64.0_wp*epsilon(1.0_wp)*maxval(abs(y))) cycle
            call fit_polynomial(p, families%degree, y, polynomial)
            found%missed(r) = polynomial%missed
            if (polynomial%missed > most_missed) cycle
            call polynomial%indices(owners, found%first(:, :, r, 1), found%total(:, :, r, 1))
         end do
      end associate
   end subroutine take_polynomials

   !> The polynomials of each random number, and whose number it is.
   subroutine find_families(study, draw, families, owners)
      type(tolerance_study_t), intent(in) :: study                !! parameters and batches
      type(draw_t), intent(in) :: draw                            !! their numbers
      type(family_t), allocatable, intent(out) :: families(:)     !! (numbers) polynomials
      integer, allocatable, intent(out) :: owners(:)              !! (numbers) number of the contributor

      real(wp), allocatable :: u(:), w(:), x(:)
      integer :: i, j, k

      allocate (families(draw%n), owners(draw%n))
      do k = 1, size(draw%first) - 1
         do j = draw%first(k), draw%first(k + 1) - 1
            owners(j) = k
            call find_nodes(study, k, u, w)
            allocate (x(size(u)))
            do i = 1, size(u)
               x(i) = number_at(study, draw, k, j, u(i))
            end do
            families(j) = new_family(x, w)
            deallocate (x)
         end do
      end do
   end subroutine find_families

   !> Random numbers and weights that give the moments of a distribution: Gauss's rule in panels that are halved towards both
   !> ends; of measured values one number in each of their intervals.
   pure subroutine find_nodes(study, owner, u, w)
      type(tolerance_study_t), intent(in) :: study      !! parameters
      integer, intent(in) :: owner                      !! number of the contributor
      real(wp), allocatable, intent(out) :: u(:)        !! (n) numbers between 0 and 1 [1]
      real(wp), allocatable, intent(out) :: w(:)        !! (n) their probabilities [1]

      real(wp) :: width
      integer :: k

      if (owner <= size(study%plan%parameters)) then
         associate (parameter => study%plan%parameters(owner))
            if (allocated(parameter%upto) .and. parameter%batch == 0) then
               w = parameter%upto - [0.0_wp, parameter%upto(:size(parameter%upto) - 1)]
               u = parameter%upto - 0.5_wp*w
               return
            end if
         end associate
      end if
      allocate (u(2*halvings*n_five), w(2*halvings*n_five))
      width = 0.5_wp
      do k = 0, halvings - 1
         width = 0.5_wp*width
         if (k == halvings - 1) width = 2.0_wp*width   ! the last panel reaches the end
         associate (low => u(k*n_five + 1:(k + 1)*n_five), high => u((halvings + k)*n_five + 1:(halvings + k + 1)*n_five))
            low = width*(five_places + merge(0.0_wp, 1.0_wp, k == halvings - 1))
            high = 1.0_wp - low
         end associate
         w(k*n_five + 1:(k + 1)*n_five) = width*five_weights
         w((halvings + k)*n_five + 1:(halvings + k + 1)*n_five) = width*five_weights
      end do
   end subroutine find_nodes

   !> The number of which the polynomials are, of a random number.
   pure real(wp) function number_at(study, draw, owner, j, u) result(x)
      type(tolerance_study_t), intent(in) :: study   !! parameters
      type(draw_t), intent(in) :: draw               !! their numbers
      integer, intent(in) :: owner                   !! number of the contributor
      integer, intent(in) :: j                       !! of the random number
      real(wp), intent(in) :: u                      !! its value [1]

      if (owner > size(study%plan%parameters)) then
         x = normal_quantile(u)
      else if (study%plan%parameters(owner)%batch > 0) then
         x = normal_quantile(u)
      else if (j == draw%first(owner)) then
         x = study%plan%parameters(owner)%deviation([u, 0.5_wp])
      else
         x = study%plan%parameters(owner)%deviation([0.5_wp, u])
      end if
   end function number_at

end module polynomial_study
