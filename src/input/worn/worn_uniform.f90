!> A surface that is worn evenly all round.
!>
!> Volume of a cell of the width w: V = L w (R h + h^2/2) of a hole, L w (r h - h^2/2) of a pin.
!> Signs: h is not negative. Limits: a pin keeps some of its radius.
module worn_uniform
   use item, only: item_t
   use kind_info, only: add_number, dim_length, kind_info_t
   use kinds, only: pi, wp
   use worn_kind, only: add_surface_columns, round_area, set_mistake, worn_kind_t, worn_mistake_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: worn_uniform_t

   !> The kind.
   type, extends(worn_kind_t) :: worn_uniform_t
   contains
      procedure, nopass :: info => uniform_info
      procedure, nopass :: fill => uniform_fill
   end type worn_uniform_t

contains

   !> Description of the kind.
   function uniform_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "worn.uniform"
      info%help = "surfaces that are worn evenly all round at the start"
      info%source = ""
      call add_surface_columns(info)
      call add_number(info, "depth", dim_length, "depth of wear", lower=0.0_wp)
   end function uniform_info

   !> Worn volumes of a surface.
   subroutine uniform_fill(item, cells, other_radius, surface, mistake)
      type(item_t), intent(inout) :: item                          !! the row
      integer, intent(in) :: cells                                 !! of the circumference
      real(wp), intent(in) :: other_radius                         !! of the surface that it touches [m]
      type(worn_surface_t), intent(inout) :: surface               !! with radius and length; volumes are set
      type(worn_mistake_t), allocatable, intent(out) :: mistake    !! a pin without a radius

      real(wp) :: depth

      depth = item%number("depth")
      if (.not. (surface%is_hole .or. depth < surface%radius)) then
         call set_mistake(mistake, "depth", 0, "the journal is worn through", "the depth of a journal is smaller than its radius")
         return
      end if
      allocate (surface%volume(cells))
      surface%volume = surface%length*2.0_wp*pi/cells*round_area(surface, depth)
   end subroutine uniform_fill

end module worn_uniform
