!> From where a mechanism is looked at: in the plane as it is, in space from a corner and along the three axes.
!>
!> The views of space stand side by side in one picture, all to one scale, each in a cell of its own.
module scene_views
   use drawing, only: drawing_t, mark_plane
   use frames, only: frame_t
   use kinds, only: wp
   use tracks, only: track_t
   implicit none (type, external)
   private
   public :: extents_t, lay_out_views, projected, view_t

   real(wp), parameter :: gap = 0.3_wp      !! between views, of the maximum extent of one [1]
   real(wp), parameter :: minimum = 0.4_wp    !! workspace of a view, of that extent [1]
   real(wp), parameter :: above = 0.06_wp   !! of a label over the highest view of its row, of that extent [1]

   !> One view.
   type :: view_t
      real(wp) :: right(3) = [1.0_wp, 0.0_wp, 0.0_wp]  !! (3) direction that goes to the right [1]
      real(wp) :: up(3) = [0.0_wp, 1.0_wp, 0.0_wp]     !! (3) direction that goes up [1]
      real(wp) :: shift(2) = 0.0_wp                    !! (2) of its cell within the picture [m]
      real(wp) :: label_at(2) = 0.0_wp                 !! (2) where its label stands [m]
      character(8) :: label = ""                       !! which axes it shows
   end type view_t

   !> The frame of a picture.
   type :: extents_t
      real(wp) :: minimum(2) = huge(1.0_wp)       !! (2) lower left corner [m]
      real(wp) :: maximum(2) = -huge(1.0_wp)   !! (2) upper right corner [m]
   contains
      procedure :: hold
   end type extents_t

contains

   !> A place of the world in a view.
   pure function projected(view, x) result(p)
      type(view_t), intent(in) :: view  !! the view
      real(wp), intent(in) :: x(3)      !! (3) world frame [m]
      real(wp) :: p(2)                  !! (2) in the picture [m]

      p = view%shift + [dot_product(view%right, x), dot_product(view%up, x)]
   end function projected

   !> Make storage for a place.
   pure subroutine hold(self, p)
      class(extents_t), intent(inout) :: self  !! the frame
      real(wp), intent(in) :: p(2)             !! (2) the place [m]

      self%minimum = min(self%minimum, p)
      self%maximum = max(self%maximum, p)
   end subroutine hold

   !> The views of a scene, and the frame of the picture that holds all its frames, paths and arrows.
   subroutine lay_out_views(drawing, list, track, tips, turned_only, views, extents)
      type(drawing_t), intent(in) :: drawing             !! the scene
      type(frame_t), intent(in) :: list(:)               !! (n) frames
      type(track_t), intent(in) :: track                 !! a path
      real(wp), intent(in) :: tips(:, :)                 !! (3, n) ends of arrows, world frame [m]
      logical, intent(in) :: turned_only                 !! in space only the view from a corner
      type(view_t), allocatable, intent(out) :: views(:) !! (1 or 4) views
      type(extents_t), intent(out) :: extents            !! the frame

      type(extents_t), allocatable :: alone(:)
      real(wp) :: maximum, half(2, 2), margin
      integer :: k

      if (drawing%is_spatial) then
         views = spatial_views()
         if (turned_only) views = views(:1)
      else
         allocate (views(1))
      end if
      allocate (alone(size(views)))
      do k = 1, size(views)
         call measure(drawing, list, track, tips, views(k), alone(k))
      end do
      if (size(views) > 1) then
         maximum = maxval([(alone(k)%maximum - alone(k)%minimum, k=1, size(views))])
         half = 0.5_wp*minimum*maximum
         do k = 1, size(views)  ! half the width of a column, half the height of a row
            half(mod(k - 1, 2) + 1, 1) = max(half(mod(k - 1, 2) + 1, 1), 0.5_wp*(alone(k)%maximum(1) - alone(k)%minimum(1)))
            half((k - 1)/2 + 1, 2) = max(half((k - 1)/2 + 1, 2), 0.5_wp*(alone(k)%maximum(2) - alone(k)%minimum(2)))
         end do
         do k = 1, size(views)
            views(k)%shift = (sum(half, dim=1) + gap*maximum)*[real(mod(k - 1, 2), wp), -real((k - 1)/2, wp)]
            views(k)%label_at = views(k)%shift + [0.0_wp, half((k - 1)/2 + 1, 2) + above*maximum]
            views(k)%shift = views(k)%shift - 0.5_wp*(alone(k)%maximum + alone(k)%minimum)
            call extents%hold(views(k)%label_at)
         end do
      end if
      do k = 1, size(views)
         call measure(drawing, list, track, tips, views(k), extents)
      end do
      margin = 0.12_wp*maxval(extents%maximum - extents%minimum)/sqrt(real(size(views), wp))
      margin = max(margin, 0.15_wp*drawing%size)
      extents%minimum = extents%minimum - margin
      extents%maximum = extents%maximum + margin
   end subroutine lay_out_views

   !> From a corner, then along y, x and z.
   function spatial_views() result(views)
      type(view_t) :: views(4)  !! the views

      real(wp), parameter :: azimuth = -0.9_wp, height = 0.45_wp  ! of the eye, from the axis x and above the plane x, y [rad]

      views(1)%right = [-sin(azimuth), cos(azimuth), 0.0_wp]
      views(1)%up = [-sin(height)*cos(azimuth), -sin(height)*sin(azimuth), cos(height)]
      views(2)%right = [1.0_wp, 0.0_wp, 0.0_wp]
      views(2)%up = [0.0_wp, 0.0_wp, 1.0_wp]
      views(2)%label = "x, z"
      views(3)%right = [0.0_wp, 1.0_wp, 0.0_wp]
      views(3)%up = [0.0_wp, 0.0_wp, 1.0_wp]
      views(3)%label = "y, z"
      views(4)%right = [1.0_wp, 0.0_wp, 0.0_wp]
      views(4)%up = [0.0_wp, 1.0_wp, 0.0_wp]
      views(4)%label = "x, y"
   end function spatial_views

   !> Make storage for all frames, the path and the arrows in a view.
   subroutine measure(drawing, list, track, tips, view, extents)
      type(drawing_t), intent(in) :: drawing         !! the scene
      type(frame_t), intent(in) :: list(:)           !! (n) frames
      type(track_t), intent(in) :: track             !! a path
      real(wp), intent(in) :: tips(:, :)             !! (3, n) ends of arrows, world frame [m]
      type(view_t), intent(in) :: view               !! the view
      type(extents_t), intent(inout) :: extents      !! grown

      integer :: f, j, k

      do f = 1, size(list)
         do k = 1, drawing%n_part
            associate (part => drawing%parts(k))
               do j = 1, size(part%s, 2)
                  call extents%hold(projected(view, list(f)%r(:, part%body) + matmul(list(f)%a(:, :, part%body), part%s(:, j))))
               end do
            end associate
         end do
         do k = 1, drawing%n_mark
            associate (mark => drawing%marks(k))
               do j = merge(2, 1, mark%kind == mark_plane), 2
                  call extents%hold(projected(view, list(f)%r(:, mark%body(j)) &
                                              + matmul(list(f)%a(:, :, mark%body(j)), mark%s(:, j))))
               end do
            end associate
         end do
      end do
      do k = 1, track%n
         call extents%hold(projected(view, track%x(:, k)))
      end do
      do k = 1, size(tips, 2)
         call extents%hold(projected(view, tips(:, k)))
      end do
   end subroutine measure

end module scene_views
