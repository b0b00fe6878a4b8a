!> Rows of normal laws, fitted to surfaces of steel that suit them: what their tests start from.
module law_fixture
   use bodies, only: material_t
   use contact_registry, only: new_normal_law
   use expression_compile, only: compile_expression, fault_t, symbols_t
   use fixed_random, only: random_t, seed_of
   use generic_item, only: column_number, fill_item, set_number
   use item, only: item_t
   use kind_info, only: dim_contact_stiffness, dim_stiffness, kind_info_t, same_dimension
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t
   use surfaces, only: set_materials, shape_external, shape_face, shape_internal, shape_plane, surfaces_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: fit_surfaces, make_law, make_restitution, steel, steel_mass, steel_pair, steel_pin, tame

   real(wp), parameter :: steel_pin = 6.61019840e10_wp  !! stiffness of a 9.5 mm pin in a 10 mm hole, steel [N/m^1.5]
   real(wp), parameter :: steel_mass = 0.1_wp           !! reduced mass of the pair [kg]

contains

   !> Steel.
   pure function steel() result(material)
      type(material_t) :: material  !! with the speed limit of 0.051 m/s

      material%young = 207.0e9_wp
      material%poisson = 0.3_wp
      material%density = 7850.0_wp
   end function steel

   !> Surfaces of steel: radii 10 and 9.5 mm, length 15 mm, width 10 mm.
   pure function steel_pair(shape) result(pair)
      integer, intent(in) :: shape  !! internal, external, plane or face
      type(surfaces_t) :: pair      !! the surfaces

      pair%shape = shape
      pair%radius_i = 10.0e-3_wp
      pair%radius_j = 9.5e-3_wp
      pair%clearance = 0.5e-3_wp
      pair%length = 15.0e-3_wp
      pair%width = 10.0e-3_wp
      pair%inverse_mass = 1.0_wp/steel_mass
      call set_materials(pair, steel(), steel())
   end function steel_pair

   !> Parameters for the first surfaces that the law fits.
   subroutine fit_surfaces(law, parameters)
      class(normal_law_t), intent(in) :: law                !! the law
      real(wp), intent(out) :: parameters(n_law_parameter)  !! (n_law_parameter) [any]

      character(:), allocatable :: help, message
      integer, parameter :: shapes(4) = [shape_internal, shape_external, shape_plane, shape_face]
      integer :: k

      do k = 1, size(shapes)
         call law%fit(steel_pair(shapes(k)), parameters, message, help)
         if (message == "") return
      end do
      error stop "law_fixture: a law fits no surfaces"
   end subroutine fit_surfaces

   !> Numbers of a row that make sense: a stiffness like that of steel, or, unless it shall be given, none if it can come from
   !> the surfaces.
   subroutine tame(info, item, is_given)
      type(kind_info_t), intent(in) :: info  !! the law
      type(item_t), intent(inout) :: item    !! its row
      logical, intent(in) :: is_given        !! the row gives the stiffness

      type(fault_t), allocatable :: fault
      type(symbols_t) :: none
      integer :: c

      if (info%name == "contact.expression") then
         call compile_expression("6.6e10 N/m^1.5*delta^1.5*(1 + 0.2*rate/v0)", none, .true., item%values(1)%expression, fault, &
                                 info%columns(1)%variable, info%columns(1)%argument)
         if (allocated(fault)) error stop "law_fixture: the expression is wrong"
      end if
      c = column_number(info, "stiffness")
      if (c == 0) return
      if (same_dimension(info%columns(c)%dimension, dim_contact_stiffness)) item%values(c)%number = steel_pin
      if (same_dimension(info%columns(c)%dimension, dim_stiffness)) item%values(c)%number = 1.5e8_wp
      if (allocated(info%columns(c)%default) .and. .not. is_given) item%values(c)%number = 0.0_wp
   end subroutine tame

   !> A row of a normal law with any numbers.
   subroutine make_law(kind, row, law, parameters, name)
      integer, intent(in) :: kind                              !! number of the law
      integer, intent(in) :: row                               !! number of the row
      class(normal_law_t), allocatable, intent(out) :: law     !! the law
      real(wp), intent(out) :: parameters(n_law_parameter)     !! (n_law_parameter) for surfaces that suit it [any]
      character(:), allocatable, intent(out) :: name           !! for messages

      type(item_t) :: item
      type(kind_info_t) :: info
      type(random_t) :: random

      call new_normal_law(kind, law)
      info = law%info()
      random%state = seed_of(info%name, row)
      call fill_item(info, row, random, item)
      call tame(info, item, .false.)
      call law%prepare(item)
      call fit_surfaces(law, parameters)
      name = info%name//" row "//to_text(row)
   end subroutine make_law

   !> A row of a normal law with a given restitution.
   subroutine make_restitution(kind, restitution, law, parameters, has_restitution)
      integer, intent(in) :: kind                            !! number of the law
      real(wp), intent(in) :: restitution                    !! coefficient of restitution [1]
      class(normal_law_t), allocatable, intent(out) :: law   !! the law
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) for surfaces that suit it [any]
      logical, intent(out) :: has_restitution                !! whether the law has such a column

      type(item_t) :: item
      type(random_t) :: random

      call new_normal_law(kind, law)
      call fill_item(law%info(), 1, random, item)
      has_restitution = column_number(law%info(), "restitution") > 0
      call set_number(law%info(), "restitution", restitution, item)
      call tame(law%info(), item, .false.)
      call law%prepare(item)
      call fit_surfaces(law, parameters)
   end subroutine make_restitution

end module law_fixture
