!> The contract of given wear: a row of a table says how a surface of a joint is worn at the start.
!>
!> A row becomes the worn volumes of the cells of a surface, so that the area of its section is kept whatever the form it is given
!> in.
module worn_kind
   use item, only: item_t
   use kind_info, only: add_reference, add_word, kind_info_t
   use kinds, only: pi, wp
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: add_surface_columns, cell_edge, round_area, set_mistake, worn_kind_t, worn_mistake_t

   !> What is wrong with a row.
   type :: worn_mistake_t
      character(:), allocatable :: column   !! where; blank: the whole row
      integer :: place = 0                  !! number of the list's entry, 0: all of the cell
      character(:), allocatable :: message  !! one line
      character(:), allocatable :: help     !! what to do, may be blank
   end type worn_mistake_t

   !> A kind of given wear. It holds nothing: rows become volumes at once.
   type, abstract :: worn_kind_t
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure, nopass :: surfaces => one_surface
      procedure(fill_interface), nopass, deferred :: fill
   end type worn_kind_t

   abstract interface
      !> Description of the kind.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name and columns
      end function info_interface

      !> Worn volumes of a surface that the row names.
      subroutine fill_interface(item, cells, other_radius, surface, mistake)
         import :: item_t, worn_mistake_t, worn_surface_t, wp
         implicit none (type, external)
         type(item_t), intent(inout) :: item                          !! the row; what it read from a file becomes lists
         integer, intent(in) :: cells                                 !! of the circumference
         real(wp), intent(in) :: other_radius                         !! of the surface that it touches, new [m]
         type(worn_surface_t), intent(inout) :: surface               !! from `surfaces`, with radius and length; volumes are set
         type(worn_mistake_t), allocatable, intent(out) :: mistake    !! the first error
      end subroutine fill_interface
   end interface

contains

   !> Say what is wrong.
   pure subroutine set_mistake(mistake, column, place, message, help)
      type(worn_mistake_t), allocatable, intent(inout) :: mistake   !! made
      character(*), intent(in) :: column                            !! where; blank: the whole row
      integer, intent(in) :: place                                  !! number of the list's entry, 0: all of the cell
      character(*), intent(in) :: message                           !! one line
      character(*), intent(in) :: help                              !! what to do, may be blank

      if (.not. allocated(mistake)) allocate (mistake)
      mistake%column = column
      mistake%place = place
      mistake%message = message
      mistake%help = help
   end subroutine set_mistake

   !> Columns of a row that is one surface.
   subroutine add_surface_columns(info)
      type(kind_info_t), intent(inout) :: info   !! the kind

      call add_reference(info, "joint", "clearance.", "joint with clearance")
      call add_word(info, "surface", "which of its surfaces is worn", choices="bearing journal")
   end subroutine add_surface_columns

   !> The surfaces that a row gives: the one that it names, unless the kind says otherwise.
   subroutine one_surface(item, list)
      type(item_t), intent(in) :: item                               !! the row
      type(worn_surface_t), allocatable, intent(out) :: list(:)      !! (n) joint and side of each

      allocate (list(1))
      list(1)%joint = item%word("joint")
      list(1)%side = item%word("surface")
   end subroutine one_surface

   !> Where a cell ends.
   elemental real(wp) function cell_edge(cell, cells) result(angle)
      integer, intent(in) :: cell    !! number of the cell; 0: where the first starts
      integer, intent(in) :: cells   !! of the circumference

      angle = 2.0_wp*pi*cell/cells   ! [rad]
   end function cell_edge

   !> Area of the section per angle that is worn off where a surface is h deep: that of a hole, or of a pin.
   elemental real(wp) function round_area(surface, depth) result(area)
      type(worn_surface_t), intent(in) :: surface   !! hole or pin, with its radius
      real(wp), intent(in) :: depth                 !! h [m]

      area = depth*(surface%radius + merge(0.5_wp, -0.5_wp, surface%is_hole)*depth)   ! [m^2]
   end function round_area

end module worn_kind
