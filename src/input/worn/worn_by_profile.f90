!> A profile of wear: depths over the angle, as lists or in a file.
!>
!> Between two samples the area A of the section per angle goes along a line, A = R h + h^2/2 of a hole, r h - h^2/2 of a pin; the
!> last sample and the first one are joined around the circumference. The volume of a cell is L times the integral of A over it,
!> in closed form: the area of the profile is kept, whatever the cells.
!> Signs: angles in the frame of the body that carries the surface, counter-clockwise from its x axis, increasing, over at most one
!> turn; depths are not negative.
module worn_by_profile
   use dimensions, only: dim_angle, dim_length, same_dimension
   use item, only: item_t, place_of
   use kind_info, only: add_file, add_list, kind_info_t
   use kinds, only: pi, wp
   use number_lists, only: file_to_lists
   use text, only: to_text
   use worn_kind, only: add_surface_columns, cell_edge, round_area, set_mistake, worn_kind_t, worn_mistake_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: worn_by_profile_t

   character(5), parameter :: lists(2) = [character(5) :: "angle", "depth"]   !! in the order of a file's columns
   integer, parameter :: fewest = 2                                           !! samples
   real(wp), parameter :: round_off = 1.0e-9_wp                               !! of a turn and of depths [1]

   !> The kind.
   type, extends(worn_kind_t) :: worn_by_profile_t
   contains
      procedure, nopass :: info => profile_info
      procedure, nopass :: fill => profile_fill
   end type worn_by_profile_t

contains

   !> Description of the kind.
   function profile_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "worn.profile"
      info%help = "surfaces that are worn at the start by a profile: depth over angle"
      info%source = ""
      call add_surface_columns(info)
      call add_list(info, "angle", "directions from the x axis of the body that carries the surface, increasing, within a turn", &
                    default="")
      call add_list(info, "depth", "depths at these directions", default="")
      call add_file(info, "file", "two-column file of angle and depth, relative to the deck, with names and units in the first " &
                    //"line, as JOINT.bearing.csv of a run; instead of angle and depth", default="")
   end function profile_info

   !> Worn volumes of a surface.
   subroutine profile_fill(item, cells, other_radius, surface, mistake)
      type(item_t), intent(inout) :: item                          !! the row; samples of a file become lists
      integer, intent(in) :: cells                                 !! of the circumference
      real(wp), intent(in) :: other_radius                         !! of the surface that it touches [m]
      type(worn_surface_t), intent(inout) :: surface               !! with radius and length; volumes are set
      type(worn_mistake_t), allocatable, intent(out) :: mistake    !! samples that are no profile

      integer :: angle, depth, twice

      call file_to_lists(item, lists, twice)
      if (twice > 0) then
         call set_mistake(mistake, trim(item%values(twice)%column), 0, "the profile is already given by a file", &
                                  "give columns angle and depth, or column file")
         return
      end if
      call check_samples(item, surface, mistake)
      if (allocated(mistake)) return
      angle = place_of(item, "angle")
      depth = place_of(item, "depth")
      surface%volume = surface%length*areas_of_cells(item%values(angle)%table(:, 1), &
                                                     round_area(surface, item%values(depth)%table(:, 1)), cells)
   end subroutine profile_fill

   !> Integrals over the cells of a function that goes along lines between samples, around the circumference.
   pure function areas_of_cells(angle, area, cells) result(sums)
      real(wp), intent(in) :: angle(:)   !! (n) increasing, over at most a turn [rad]
      real(wp), intent(in) :: area(:)    !! (n) values there [m^2]
      integer, intent(in) :: cells       !! of the circumference
      real(wp) :: sums(cells)            !! integrals [m^2]

      real(wp) :: a(2), edge, from, x(2)
      integer :: cell, k, n

      sums = 0.0_wp
      n = size(angle)
      do k = 1, n
         x = [angle(k), angle(modulo(k, n) + 1)]
         a = [area(k), area(modulo(k, n) + 1)]
         if (k == n) x(2) = x(2) + 2.0_wp*pi
         from = x(1)
         cell = floor(from*cells/(2.0_wp*pi))
         do while (from < x(2))
            cell = cell + 1
            edge = min(cell_edge(cell, cells), x(2))
            if (.not. edge > from) cycle
            associate (sum => sums(modulo(cell - 1, cells) + 1))
               sum = sum + (edge - from)*(a(1) + (a(2) - a(1))*(0.5_wp*(from + edge) - x(1))/(x(2) - x(1)))
            end associate
            from = edge
         end do
      end do
   end function areas_of_cells

   !> Whether the lists are a profile. A last sample a turn behind the first one is the first one.
   subroutine check_samples(item, surface, mistake)
      type(item_t), intent(inout) :: item                          !! the row
      type(worn_surface_t), intent(in) :: surface                  !! with its radius
      type(worn_mistake_t), allocatable, intent(out) :: mistake    !! what is wrong

      integer :: k, n

      do k = 1, size(lists)
         if (item%is_given(trim(lists(k)))) cycle
         call complain(trim(lists(k)), 0, "the profile is missing", &
                       "give columns angle and depth, as ""0 10 20 deg"" and ""0 3 0 um"", or column file")
         return
      end do
      associate (angle => item%values(place_of(item, "angle")), depth => item%values(place_of(item, "depth")))
         n = size(angle%table, 1)
         if (size(depth%table, 1) /= n) then
            call complain("depth", 0, to_text(size(depth%table, 1))//" depths at "//to_text(n)//" angles", "")
         else if (n < fewest) then
            call complain("angle", 0, "there are "//to_text(n)//" samples, a profile needs at least "//to_text(fewest), "")
         else if (.not. same_dimension(angle%dimensions(1), dim_angle)) then
            call complain("angle", 0, "not an angle", "give a unit of angles, as deg")
         else if (.not. same_dimension(depth%dimensions(1), dim_length)) then
            call complain("depth", 0, "not a length", "give a unit of lengths, as um")
         end if
         if (allocated(mistake)) return
         do k = 2, n
            if (angle%table(k, 1) > angle%table(k - 1, 1)) cycle
            call complain("angle", k, "sample "//to_text(k)//" is not greater than sample "//to_text(k - 1), &
                          "angles must increase from sample to sample")
            return
         end do
         do k = 1, n
            if (depth%table(k, 1) >= 0.0_wp .and. (surface%is_hole .or. depth%table(k, 1) < surface%radius)) cycle
            if (depth%table(k, 1) < 0.0_wp) call complain("depth", k, "the depth is negative", "depths of wear are not negative")
            if (depth%table(k, 1) > 0.0_wp) call complain("depth", k, "the journal is worn through", &
                                                          "the depth of a journal is smaller than its radius")
            return
         end do
         if (angle%table(n, 1) - angle%table(1, 1) > 2.0_wp*pi*(1.0_wp + round_off)) then
            call complain("angle", n, "the angles are more than a turn", "give one turn")
         else if (angle%table(n, 1) - angle%table(1, 1) > 2.0_wp*pi*(1.0_wp - round_off)) then
            if (abs(depth%table(n, 1) - depth%table(1, 1)) > round_off*maxval(depth%table)) then
               call complain("depth", n, "the last depth differs from the first one, which is at the same place", &
                             "omit the last sample, or give it the depth of the first one")
               return
            end if
            angle%table = angle%table(:n - 1, :)
            depth%table = depth%table(:n - 1, :)
         end if
      end associate

   contains

      !> Note an error.
      subroutine complain(column, place, message, help)
         character(*), intent(in) :: column    !! where it is
         integer, intent(in) :: place          !! number of the sample, 0: all
         character(*), intent(in) :: message   !! what is wrong
         character(*), intent(in) :: help      !! what to do

         call set_mistake(mistake, column, place, message, help)
      end subroutine complain

   end subroutine check_samples

end module worn_by_profile
