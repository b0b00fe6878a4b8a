!> Surfaces as an earlier run left them: all that it wore, or those of one joint, or one of them.
!>
!> Worn volumes are taken, so that none is lost on the way. Where the cells are others, each old cell is shared out over the new
!> ones by the part of its width that they have.
module worn_by_run
   use item, only: item_t, place_of
   use kind_info, only: add_file, add_reference, add_word, kind_info_t
   use kinds, only: wp
   use run_profiles, only: columns_of_profiles
   use text, only: split_blank, text_t
   use worn_kind, only: set_mistake, worn_kind_t, worn_mistake_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: resampled, worn_by_run_t

   !> The kind.
   type, extends(worn_kind_t) :: worn_by_run_t
   contains
      procedure, nopass :: info => run_info
      procedure, nopass :: surfaces => run_surfaces
      procedure, nopass :: fill => run_fill
   end type worn_by_run_t

contains

   !> Description of the kind.
   function run_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "worn.run"
      info%help = "surfaces that are worn at the start as an earlier run left them"
      info%source = ""
      call add_file(info, "run", "run.h5 of an earlier run, or life.h5 of a life, relative to the deck, with the joints of this " &
                    //"deck")
      info%columns(size(info%columns))%size = columns_of_profiles
      call add_reference(info, "joint", "clearance.", "joint whose surfaces are taken; omitted: all that the run wore", default="")
      call add_word(info, "surface", "the surface that is taken; omitted: both", default="", choices="bearing journal")
   end function run_info

   !> The surfaces of the run that the row asks for, with the volumes of the run's cells.
   subroutine run_surfaces(item, list)
      type(item_t), intent(in) :: item                               !! the row, its file read
      type(worn_surface_t), allocatable, intent(out) :: list(:)      !! (n) joint, side and volumes; none: the run has no such

      type(text_t), allocatable :: words(:)
      type(worn_surface_t) :: surface
      integer :: first, k, last

      allocate (list(0))
      associate (file => item%values(place_of(item, "run")))
         last = 0
         do k = 1, size(file%words)
            words = split_blank(file%words(k)%s)
            first = last + 1
            last = last + nint(file%table(k, 1))
            surface%joint = words(1)%s
            surface%side = words(2)%s
            surface%volume = file%table(size(file%words) + first:size(file%words) + last, 1)
            if (item%word("joint") /= "" .and. item%word("joint") /= surface%joint) cycle
            if (item%word("surface") /= "" .and. item%word("surface") /= surface%side) cycle
            list = [list, surface]
         end do
      end associate
   end subroutine run_surfaces

   !> The volumes in the cells of this deck.
   subroutine run_fill(item, cells, other_radius, surface, mistake)
      type(item_t), intent(inout) :: item                          !! the row
      integer, intent(in) :: cells                                 !! of the circumference
      real(wp), intent(in) :: other_radius                         !! of the surface that it touches [m]
      type(worn_surface_t), intent(inout) :: surface               !! from `surfaces`, with radius and length
      type(worn_mistake_t), allocatable, intent(out) :: mistake    !! a pin without a radius

      surface%volume = resampled(surface%volume, cells)
      if (surface%is_through()) call set_mistake(mistake, "run", 0, "the journal of '"//surface%joint//"' is worn through", &
                                                         "take an earlier state of it")
   end subroutine run_fill

   !> Volumes of other cells of the same circumference: their sum is kept.
   pure function resampled(volume, cells) result(other)
      real(wp), intent(in) :: volume(:)   !! (n) of the old cells [m^3]
      integer, intent(in) :: cells        !! number of new ones
      real(wp) :: other(cells)            !! of the new cells [m^3]

      integer :: from, k, m, n, to

      n = size(volume)
      other = 0.0_wp
      if (n == cells) other = volume
      if (n == cells) return
      do k = 1, n   ! in parts of a turn over n times cells, which are whole numbers
         do m = (k - 1)*cells/n + 1, (k*cells - 1)/n + 1
            from = max((k - 1)*cells, (m - 1)*n)
            to = min(k*cells, m*n)
            other(m) = other(m) + volume(k)*(to - from)/cells
         end do
      end do
   end function resampled

end module worn_by_run
