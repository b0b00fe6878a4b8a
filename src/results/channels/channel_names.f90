!> Names of channels: `slider.velocity.x`, `gudgeon.penetration`, `guide.A.penetration`, `energy.residual`.
!>
!> A contact belongs to its joint. Its label stands in the name only if the joint has several contacts.
module channel_names
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_contacts, group_energy
   implicit none (type, external)
   private
   public :: base_name, component_letter, item_name, label_in_name, scalar_name, scalar_t

   !> One number of the catalogue.
   type :: scalar_t
      integer :: group = 0      !! number of the group, 0: none
      integer :: component = 0  !! its component
      integer :: item = 0       !! its item
   end type scalar_t

contains

   !> The letter of a component: x, y, z, or e0 to e3 for Euler parameters; blank for a scalar.
   pure function component_letter(n_components, component) result(letter)
      integer, intent(in) :: n_components    !! components of the quantity
      integer, intent(in) :: component       !! which of them
      character(:), allocatable :: letter    !! what stands behind the last dot

      character(*), parameter :: letters = "xyz"

      select case (n_components)
      case (1)
         letter = ""
      case (2, 3)
         letter = letters(component:component)
      case default
         letter = "e"//achar(iachar("0") + mod(component - 1, 10))
      end select
   end function component_letter

   !> Name of an item as users write it; of a contact, its joint's.
   pure function item_name(catalogue, item_group, item) result(name)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      integer, intent(in) :: item_group                 !! group of the item
      integer, intent(in) :: item                 !! its number there
      character(:), allocatable :: name           !! what stands before the first dot

      name = catalogue%item_groups(item_group)%names(item)%s
      if (item_group == group_energy .and. len_trim(name) == 0) name = "energy"
   end function item_name

   !> Label of a contact if its joint has several, else blank.
   pure function label_in_name(catalogue, item_group, item) result(label)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      integer, intent(in) :: item_group                 !! group of the item
      integer, intent(in) :: item                 !! its number there
      character(:), allocatable :: label          !! what stands between the joint and the quantity

      integer :: k

      label = ""
      if (item_group /= group_contacts) return
      associate (contacts => catalogue%item_groups(item_group))
         do k = max(1, item - 1), min(size(contacts%names), item + 1)  ! those of a joint stand together
            if (k /= item .and. contacts%names(k)%s == contacts%names(item)%s) label = contacts%labels(item)%s
         end do
      end associate
   end function label_in_name

   !> Name of a quantity of an item, without a component.
   pure function base_name(catalogue, group, item) result(name)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      integer, intent(in) :: group                !! number of the group
      integer, intent(in) :: item                 !! number of the item
      character(:), allocatable :: name           !! as `slider.velocity`

      character(:), allocatable :: label
      integer :: item_group

      item_group = catalogue%groups(group)%item_group
      name = item_name(catalogue, item_group, item)
      label = label_in_name(catalogue, item_group, item)
      if (len(label) > 0) name = name//"."//label
      name = name//"."//catalogue%groups(group)%channel%name
   end function base_name

   !> Name of one number.
   pure function scalar_name(catalogue, scalar) result(name)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      type(scalar_t), intent(in) :: scalar        !! the number
      character(:), allocatable :: name           !! as `slider.velocity.x`

      character(:), allocatable :: letter

      name = base_name(catalogue, scalar%group, scalar%item)
      letter = component_letter(catalogue%groups(scalar%group)%channel%components, scalar%component)
      if (len(letter) > 0) name = name//"."//letter
   end function scalar_name

end module channel_names
