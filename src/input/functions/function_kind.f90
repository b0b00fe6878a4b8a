!> The contract of named functions: a row of a table becomes a curve that expressions can call.
module function_kind
   use curve, only: curve_t
   use item, only: item_t
   use kind_info, only: dim_none, dim_t, kind_info_t
   implicit none (type, external)
   private
   public :: function_kind_t, made_t

   !> What a row gives: a curve, or an error.
   type :: made_t
      type(curve_t) :: curve                  !! the function
      type(dim_t) :: dimension = dim_none     !! of its value
      type(dim_t) :: argument = dim_none      !! of what it takes
      integer :: column = 0                   !! column with an error, 0: all is well
      integer :: place = 0                    !! number of the list's entry with the error, 0: all of the cell
      character(:), allocatable :: message    !! what is wrong
      character(:), allocatable :: help       !! what to do
   end type made_t

   !> A kind of function. It holds nothing: rows become curves at once.
   type, abstract :: function_kind_t
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(make_interface), nopass, deferred :: make
   end type function_kind_t

   abstract interface
      !> Description of the kind.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name and columns
      end function info_interface

      !> Make the curve of a row. What it read from files goes into columns, so that the echo of the row holds it.
      subroutine make_interface(item, made)
         import :: item_t, made_t
         implicit none (type, external)
         type(item_t), intent(inout) :: item  !! the row
         type(made_t), intent(out) :: made    !! the curve, or the first error
      end subroutine make_interface
   end interface

end module function_kind
