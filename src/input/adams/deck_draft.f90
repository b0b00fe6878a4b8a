!> A deck that is being made of an Adams dataset: its tables, and the names in them.
!>
!> Names of a deck have letters, digits, `_` and `-`: whatever else stands in a name of Adams/View becomes `_`. Of equal names the
!> later ones get that of their part before them, or their number behind them.
module deck_draft
   use adams_model, only: adams_model_t
   use deck_table, only: deck_table_t, number_cell
   use expression_symbols, only: symbols_t
   use kinds, only: wp
   use name_table, only: name_table_t
   use text, only: replace, split_blank, to_text
   use text_buffer, only: buffer_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: body_axis, body_name, deck_draft_t, joint_t, tab

   character(*), parameter :: tab = achar(9)   !! stands between the cells of a row

   !> A joint of the dataset that the deck has.
   type :: joint_t
      integer :: id = 0                       !! its number in the dataset
      logical :: is_primitive = .false.       !! a JPRIM, no JOINT
      character(:), allocatable :: name       !! as the deck calls it
      character(:), allocatable :: kind       !! kind of the deck, as `joint.revolute`
      integer :: marker(2) = 0                !! (2) its markers I and J, by their places in the list
   end type joint_t

   !> The deck.
   type :: deck_draft_t
      type(deck_table_t), allocatable :: tables(:)   !! (n) in the order in which they are written
      type(joint_t), allocatable :: joints(:)        !! (joints)
      type(name_table_t) :: points                   !! names of points
      type(name_table_t) :: names                    !! names of what has channels
      type(symbols_t) :: functions                   !! that expressions may call
      type(text_list_t) :: asked                     !! what rows of requests report
      type(text_list_t) :: answers                   !! names of these rows
   contains
      procedure :: put => put_row
      procedure :: has => has_table
      procedure :: new_name
      procedure :: point => point_of_marker
      procedure :: put_point
      procedure :: row_of
      procedure :: place_of => place_of_row
      procedure :: write => write_tables
   end type deck_draft_t

contains

   !> Put a row into a table, which is made if it is not there.
   subroutine put_row(self, name, header, cells)
      class(deck_draft_t), intent(inout) :: self   !! the deck
      character(*), intent(in) :: name             !! of the kind
      character(*), intent(in) :: header           !! blank-separated columns, the same at every call
      character(*), intent(in) :: cells            !! the row, a `tab` between two cells; blank ones: the default

      type(deck_table_t) :: new
      integer :: k

      if (.not. allocated(self%tables)) allocate (self%tables(0))
      do k = 1, size(self%tables)
         if (self%tables(k)%name == name) exit
      end do
      if (k > size(self%tables)) then
         call new%start(name, split_blank(header))
         self%tables = [self%tables, new]
      end if
      call self%tables(k)%add(cells)
   end subroutine put_row

   !> Whether the deck has a table.
   pure logical function has_table(self, name)
      class(deck_draft_t), intent(in) :: self      !! the deck
      character(*), intent(in) :: name             !! of the kind

      integer :: k

      has_table = .false.
      if (.not. allocated(self%tables)) return
      do k = 1, size(self%tables)
         if (self%tables(k)%name == name) has_table = .true.
      end do
   end function has_table

   !> A name of something that has channels.
   subroutine new_name(self, wanted, id, name)
      class(deck_draft_t), intent(inout) :: self           !! the deck
      character(*), intent(in) :: wanted                   !! as in the dataset
      integer, intent(in) :: id                            !! its number there
      character(:), allocatable, intent(out) :: name       !! as in the deck

      integer :: previous

      name = clean(wanted)
      call self%names%enter(name, id, previous)
      do while (previous /= 0 .or. name == "ground")
         name = name//"_"//to_text(id)
         call self%names%enter(name, id, previous)
      end do
   end subroutine new_name

   !> The row of a request, by what it reports; its name has a place in expressions.
   subroutine row_of(self, key, name, is_new)
      class(deck_draft_t), intent(inout) :: self           !! the deck
      character(*), intent(in) :: key                      !! what it reports
      character(:), allocatable, intent(out) :: name       !! of the row
      logical, intent(out) :: is_new                       !! whether it is to be written

      integer :: k

      k = self%place_of(key)
      is_new = k == 0
      if (.not. is_new) then
         name = self%answers%at(k)
         return
      end if
      call self%new_name(replace(key, "-", "_"), self%asked%n + 1, name)
      call self%asked%add(key)
      call self%answers%add(name)
   end subroutine row_of

   !> Place among the rows so far of the one that reports something; 0: there is none.
   integer function place_of_row(self, key) result(k)
      class(deck_draft_t), intent(in) :: self   !! the deck
      character(*), intent(in) :: key           !! what it reports

      character(:), allocatable :: asked

      do k = 1, self%asked%n
         asked = self%asked%at(k)
         if (asked == key) return
      end do
      k = 0
   end function place_of_row

   !> A name with nothing but what a deck's names have.
   pure function clean(wanted) result(name)
      character(*), intent(in) :: wanted        !! any text
      character(:), allocatable :: name         !! a name

      character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
      integer, parameter :: longest = 60
      integer :: k

      name = wanted
      do k = 1, len(name)
         if (index(letters//"_-", name(k:k)) == 0) name(k:k) = "_"
      end do
      if (scan(name, letters) == 0) name = "unnamed"
      if (len(name) > longest) name = wanted_part(name, longest)
   end function clean

   !> The first letters of a name.
   pure function wanted_part(name, n) result(part)
      character(*), intent(in) :: name     !! a name
      integer, intent(in) :: n             !! letters requested
      character(:), allocatable :: part    !! the first of them

      part = name(:n)
   end function wanted_part

   !> The point of a marker; its row is written when it is first asked for.
   subroutine point_of_marker(self, model, k, name)
      class(deck_draft_t), intent(inout) :: self           !! the deck
      type(adams_model_t), intent(inout) :: model          !! the dataset
      integer, intent(in) :: k                             !! the marker, by its place in the list
      character(:), allocatable, intent(out) :: name       !! of the point

      integer :: previous

      associate (marker => model%markers(k), part => model%parts(model%markers(k)%part))
         if (.not. marker%is_used) then
            name = clean(marker%name)
            call self%points%enter(name, marker%id, previous)
            if (previous /= 0) then
               name = clean(part%name//"_"//marker%name)
               call self%points%enter(name, marker%id, previous)
            end if
            do while (previous /= 0)
               name = name//"_"//to_text(marker%id)
               call self%points%enter(name, marker%id, previous)
            end do
            marker%is_used = .true.
            marker%name = name
            call self%put_point(model, name, k, [0.0_wp, 0.0_wp, 0.0_wp])
         end if
         name = marker%name
      end associate
   end subroutine point_of_marker

   !> The row of a point.
   subroutine put_point(self, model, name, k, place)
      class(deck_draft_t), intent(inout) :: self    !! the deck
      type(adams_model_t), intent(in) :: model      !! the dataset
      character(*), intent(in) :: name              !! of the point
      integer, intent(in) :: k                      !! a marker, by its place in the list
      real(wp), intent(in) :: place(3)              !! (3) the point in its axes [m]

      character(:), allocatable :: length
      real(wp) :: r(3), size_of_part, unit

      associate (marker => model%markers(k), part => model%parts(model%markers(k)%part))
         r = marker%r + matmul(marker%a, place) - part%centre
         if (part%is_ground) r = model%place(k) + matmul(model%axes(k), place)
         unit = model%units%length_shown()
         length = "["//model%units%length_name()//"]"
         size_of_part = (maxval(abs(r)) + maxval(abs(part%centre)) + tiny(unit))/unit
         call self%put("points", "name body xi"//length//" eta"//length//" zeta"//length, name//tab// &
                       body_name(part%name, part%is_ground)//tab//number_cell(r(1)/unit, size_of_part)//tab// &
                       number_cell(r(2)/unit, size_of_part)//tab//number_cell(r(3)/unit, size_of_part))
      end associate
   end subroutine put_point

   !> How a deck calls a part.
   pure function body_name(name, is_ground) result(word)
      character(*), intent(in) :: name          !! of the part
      logical, intent(in) :: is_ground          !! whether it is the ground
      character(:), allocatable :: word         !! of the body

      word = name
      if (is_ground) word = "ground"
   end function body_name

   !> An axis of a marker in the frame of its body.
   pure function body_axis(model, k, axis) result(x)
      type(adams_model_t), intent(in) :: model  !! the dataset
      integer, intent(in) :: k                  !! the marker, by its place in the list
      integer, intent(in) :: axis               !! 1 to 3
      real(wp) :: x(3)                          !! (3) the axis; of the ground in the world [1]

      real(wp) :: a(3, 3)

      x = model%markers(k)%a(:, axis)
      if (.not. model%parts(model%markers(k)%part)%is_ground) return
      a = model%axes(k)
      x = a(:, axis)
   end function body_axis

   !> Write bodies and points, then all other tables.
   subroutine write_tables(self, buffer)
      class(deck_draft_t), intent(in) :: self    !! the deck
      type(buffer_t), intent(inout) :: buffer    !! its text

      integer :: k, pass

      if (.not. allocated(self%tables)) return   ! of a dataset with nothing but ground
      do pass = 1, 3
         do k = 1, size(self%tables)
            select case (self%tables(k)%name)
            case ("bodies"); if (pass == 1) call self%tables(k)%write(buffer)
            case ("points"); if (pass == 2) call self%tables(k)%write(buffer)
            case default; if (pass == 3) call self%tables(k)%write(buffer)
            end select
         end do
      end do
   end subroutine write_tables

end module deck_draft
