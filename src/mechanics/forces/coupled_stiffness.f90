!> Whether the couplings of a stiffness matrix match its diagonal: no displacement may have a negative energy.
!>
!> With d_k the diagonal, the matrix K_kl/sqrt(d_k d_l) has no eigenvalue below zero, or one that is round-off; a row without a
!> stiffness on the diagonal has no couplings. Source: from the definition of a positive semidefinite matrix. Limits: none.
module coupled_stiffness
   use item, only: item_t, place_of
   use kinds, only: wp
   use lapack, only: dsyev
   use text, only: split_blank, text_t
   implicit none (type, external)
   private
   public :: find_negative_energy

contains

   !> The first coupling that a row gives, if its matrix has a negative energy.
   subroutine find_negative_energy(item, stiffness, couplings, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      real(wp), intent(in) :: stiffness(:, :)                !! (n, n) symmetric, n at most 6 [any]
      character(*), intent(in) :: couplings                  !! columns of the couplings, blank-separated
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      integer, parameter :: most = 6                         ! rows of the matrix, at most
      real(wp), parameter :: round_off = 1.0e-12_wp          ! of an eigenvalue [1]
      type(text_t), allocatable :: names(:)
      real(wp) :: scaled(most, most), values(most), work(8*most)
      logical :: is_bad
      integer :: info, k, l, n

      column = 0
      message = ""
      help = ""
      n = size(stiffness, 1)
      is_bad = .false.
      scaled = 0.0_wp
      do k = 1, n
         do l = 1, n
            if (.not. abs(stiffness(k, l)) > 0.0_wp) cycle
            is_bad = is_bad .or. .not. min(stiffness(k, k), stiffness(l, l)) > 0.0_wp
            if (.not. is_bad) scaled(k, l) = stiffness(k, l)/(sqrt(stiffness(k, k))*sqrt(stiffness(l, l)))
         end do
      end do
      if (.not. is_bad) then
         call dsyev("N", "L", most, scaled, most, values, work, size(work), info)
         is_bad = info /= 0 .or. values(1) < -round_off
      end if
      if (.not. is_bad) return
      names = split_blank(couplings)
      do k = size(names), 1, -1
         if (item%is_given(names(k)%s)) column = place_of(item, names(k)%s)
      end do
      message = "the couplings of '"//item%name//"' are too large for its stiffnesses: a displacement would have a negative energy"
      help = "the square of a coupling is at most the product of both stiffnesses that it couples"
   end subroutine find_negative_energy

end module coupled_stiffness
