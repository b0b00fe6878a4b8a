!> The rigid parts and markers of an Adams dataset, in SI, and what is said of the rest. `adams_parts` reads them.
!>
!> A part has a frame of its own, a marker lies in it; both stand where they are at the start.
module adams_model
   use adams_units, only: adams_units_t
   use dataset, only: line_words, statement_t
   use item, only: location_t
   use kinds, only: wp
   use text, only: to_text
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: adams_model_t, find_statement, leave_out, marker_t, part_t

   !> A part.
   type :: part_t
      integer :: id = 0                     !! its number
      character(:), allocatable :: name     !! as the deck calls it
      logical :: is_ground = .false.        !! it does not move
      real(wp) :: r(3) = 0.0_wp             !! (3) origin of its frame, world [m]
      real(wp) :: a(3, 3) = 0.0_wp          !! (3, 3) its frame to the world [1]
      real(wp) :: centre(3) = 0.0_wp        !! (3) centre of mass in its frame [m]
      real(wp) :: mass = 0.0_wp             !! [kg]
      real(wp) :: inertia(3, 3) = 0.0_wp    !! (3, 3) tensor about the centre of mass, its axes [kg.m^2]
      integer :: statement = 0              !! number of its statement
   end type part_t

   !> A marker.
   type :: marker_t
      integer :: id = 0                     !! its number
      character(:), allocatable :: name     !! as the deck calls it
      integer :: part = 0                   !! number of its part in the list
      real(wp) :: r(3) = 0.0_wp             !! (3) in the frame of the part [m]
      real(wp) :: a(3, 3) = 0.0_wp          !! (3, 3) its axes in that frame [1]
      logical :: is_used = .false.          !! the deck has a point there
   end type marker_t

   !> A dataset that is understood.
   type :: adams_model_t
      character(:), allocatable :: title               !! first line
      type(statement_t), allocatable :: statements(:)  !! (n) all
      integer, allocatable :: joints(:)                !! (joints) indices of the JOINT statements
      type(adams_units_t) :: units                     !! of its numbers
      type(part_t), allocatable :: parts(:)            !! (parts) in the order of the dataset
      type(marker_t), allocatable :: markers(:)        !! (markers) in the order of the dataset
      type(text_list_t) :: left_out                    !! what the deck does not have, a line each
      type(text_list_t) :: changed                     !! what it has otherwise, or was assumed, a line each
   contains
      procedure :: marker => find_marker
      procedure :: place => place_of_marker
      procedure :: axes => axes_of_marker
   end type adams_model_t

contains

   !> Say that something is not in the deck.
   subroutine leave_out(model, statement, reason, at)
      type(adams_model_t), intent(inout) :: model       !! the dataset
      type(statement_t), intent(in) :: statement        !! what is omitted
      character(*), intent(in) :: reason                !! why
      type(location_t), intent(in), optional :: at      !! where, if not all of it is meant

      type(location_t) :: place

      place = statement%at
      if (present(at)) place = at
      call model%left_out%add(line_words(place)//title_of(statement)//": "//reason)
   end subroutine leave_out

   !> A statement as people call it.
   function title_of(statement) result(words)
      type(statement_t), intent(in) :: statement   !! the statement
      character(:), allocatable :: words           !! as `JOINT/3 (hinge)`

      words = statement%keyword
      if (statement%id >= 0) words = words//"/"//to_text(statement%id)
      if (statement%view_name /= "") words = words//" ("//statement%view_name//")"
   end function title_of

   !> Number of a statement by its name and number; 0: there is none.
   pure integer function find_statement(model, keyword, id) result(k)
      type(adams_model_t), intent(in) :: model   !! the dataset
      character(*), intent(in) :: keyword        !! name of the statement
      integer, intent(in) :: id                  !! its number

      do k = 1, size(model%statements)
         if (model%statements(k)%id == id .and. model%statements(k)%keyword == keyword) return
      end do
      k = 0
   end function find_statement

   !> Number of a marker in the list; 0: there is none.
   pure integer function find_marker(self, id) result(k)
      class(adams_model_t), intent(in) :: self   !! the dataset
      integer, intent(in) :: id                  !! its number in the dataset

      do k = 1, size(self%markers)
         if (self%markers(k)%id == id) return
      end do
      k = 0
   end function find_marker

   !> Where a marker is at the start.
   pure function place_of_marker(self, k) result(r)
      class(adams_model_t), intent(in) :: self   !! the dataset
      integer, intent(in) :: k                   !! the marker, by its place in the list
      real(wp) :: r(3)                           !! (3) world [m]

      associate (part => self%parts(self%markers(k)%part))
         r = part%r + matmul(part%a, self%markers(k)%r)
      end associate
   end function place_of_marker

   !> The axes of a marker at the start.
   pure function axes_of_marker(self, k) result(a)
      class(adams_model_t), intent(in) :: self   !! the dataset
      integer, intent(in) :: k                   !! the marker, by its place in the list
      real(wp) :: a(3, 3)                        !! (3, 3) as columns, world [1]

      a = matmul(self%parts(self%markers(k)%part)%a, self%markers(k)%a)
   end function axes_of_marker

end module adams_model
