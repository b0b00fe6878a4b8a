!> Magnitudes of vectors as channels: `pin.force.magnitude` = sqrt(Fx^2 + Fy^2 + Fz^2), of every vector of the catalogue.
!>
!> A magnitude is a group of its own behind that of its vector, reported only where it is named. Components that an item does not
!> have are NaN and count nothing; a vector without components has no magnitude (NaN).
module magnitudes
   use catalogue, only: catalogue_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kind_info, only: channel_t
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: add_magnitudes, find_magnitudes, spread_to_vectors

   character(*), parameter :: word = "magnitude"   !! what stands in the place of a component

contains

   !> Add a magnitude for every vector so far; expressions over channels come later.
   subroutine add_magnitudes(catalogue)
      type(catalogue_t), intent(inout) :: catalogue   !! grows

      type(channel_t) :: channel
      integer :: item_group, k

      do k = 1, catalogue%n_group
         channel = catalogue%groups(k)%channel
         if (channel%components /= catalogue%n_coordinates) cycle
         channel%help = "magnitude of "//channel%name//": "//channel%help
         channel%name = channel%name//"."//word
         channel%frame = "none"
         channel%components = 1
         item_group = catalogue%groups(k)%item_group  ! the list of groups may move
         call catalogue%add_group(item_group, channel)
         catalogue%groups(catalogue%n_group)%vector = k
      end do
   end subroutine add_magnitudes

   !> Request the vectors whose magnitudes are requested, and list these.
   pure subroutine spread_to_vectors(catalogue)
      type(catalogue_t), intent(inout) :: catalogue   !! vectors are requested

      integer :: item, k, n, pass

      if (allocated(catalogue%magnitudes)) deallocate (catalogue%magnitudes)
      do pass = 1, 2
         n = 0
         do k = 1, size(catalogue%groups)
            associate (group => catalogue%groups(k), vector => catalogue%groups(k)%vector)
               if (vector == 0) cycle
               do item = 1, size(group%has)
                  if (.not. (group%has(item) .and. group%is_wanted(item))) cycle
                  n = n + 1
                  if (pass == 1) catalogue%groups(vector)%is_wanted(item) = .true.
                  if (pass == 2) catalogue%magnitudes(:, n) = [catalogue%place(k, 1, item), catalogue%place(vector, 0, item)]
               end do
            end associate
         end do
         if (pass == 1) allocate (catalogue%magnitudes(2, n))
      end do
   end subroutine spread_to_vectors

   !> Values of the requested magnitudes, when the vectors are filled. No allocation.
   pure subroutine find_magnitudes(catalogue)
      type(catalogue_t), intent(inout) :: catalogue   !! values

      integer :: k

      do k = 1, size(catalogue%magnitudes, 2)
         associate (at => catalogue%magnitudes(:, k))
            catalogue%values(at(1)) = magnitude(catalogue%values(at(2) + 1:at(2) + catalogue%n_coordinates))
         end associate
      end do
   end subroutine find_magnitudes

   !> Magnitude of a vector.
   pure real(wp) function magnitude(x)
      real(wp), intent(in) :: x(:)   !! (n) components; NaN: there is none [any]

      integer :: i

      magnitude = not_a_number()
      if (.not. all(ieee_is_nan(x))) magnitude = norm2([(merge(0.0_wp, x(i), ieee_is_nan(x(i))), i=1, size(x))])
   end function magnitude

end module magnitudes
