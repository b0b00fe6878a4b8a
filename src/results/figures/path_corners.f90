!> Whether the rows of a path are too far apart for lines between them: these turn by more than `corner` at most of the rows.
module path_corners
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: chord_words, corners_t

   real(wp), parameter :: corner = 0.2_wp   !! turn of a path at a row that can be seen [rad]
   character(*), parameter :: chord_words = "straight lines between output times: use a smaller every"  !! what a figure says then

   !> Counts them from place to place.
   type :: corners_t
      integer :: n_place = 0                     !! places so far, one on the other counted once; 0 starts another line
      integer, private :: n = 0                  !! places between two lines
      integer, private :: n_corner = 0           !! those with a corner
      real(wp), private :: at(3) = 0.0_wp        !! (3) the last place [any]
      real(wp), private :: way(3) = 0.0_wp       !! (3) from that before it [any]
   contains
      procedure :: add
      procedure :: are_most
   end type corners_t

contains

   !> Come to a place.
   pure subroutine add(self, x)
      class(corners_t), intent(inout) :: self   !! the count
      real(wp), intent(in) :: x(:)              !! (2 or 3) the place, as it is drawn [any]

      real(wp) :: next(3), way(3)

      next = 0.0_wp
      next(:size(x)) = x
      way = next - self%at
      if (self%n_place > 0 .and. .not. norm2(way) > 0.0_wp) return
      if (self%n_place > 1) then
         self%n = self%n + 1
         if (dot_product(self%way, way) < cos(corner)*norm2(self%way)*norm2(way)) self%n_corner = self%n_corner + 1
      end if
      self%n_place = self%n_place + 1
      self%at = next
      self%way = way
   end subroutine add

   !> Whether most places have one.
   pure logical function are_most(self)
      class(corners_t), intent(in) :: self   !! the count

      are_most = 2*self%n_corner > self%n
   end function are_most

end module path_corners
