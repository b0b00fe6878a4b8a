!> A normal law by its name, with the numbers that a test gives it, fitted to surfaces.
module law_case
   use contact_registry, only: n_law_kinds, new_normal_law
   use fixed_random, only: random_t
   use generic_item, only: column_number, fill_item, set_number
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use law_fixture, only: tame
   use normal_law, only: n_law_parameter, normal_law_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: case_t, force_of, make_case

   !> A law with what it gives.
   type :: case_t
      class(normal_law_t), allocatable :: law           !! the law
      real(wp) :: parameters(n_law_parameter) = 0.0_wp  !! (n_law_parameter) for surfaces of steel [any]
      character(:), allocatable :: message              !! why it does not match, empty: it does
   end type case_t

contains

   !> A law by its name, its columns by name and value, a word in one column.
   subroutine make_case(name, columns, values, word_column, word, surfaces, case)
      character(*), intent(in) :: name                !! of the law, without `contact.`
      character(*), intent(in) :: columns(:)          !! (n) columns of numbers
      real(wp), intent(in) :: values(:)               !! (n) their numbers, SI [any]
      character(*), intent(in) :: word_column         !! a column of words or `on`, blank: none
      character(*), intent(in) :: word                !! what stands in it
      type(surfaces_t), intent(in) :: surfaces        !! the surfaces
      type(case_t), intent(out) :: case               !! the law

      character(:), allocatable :: help
      type(item_t) :: item
      type(kind_info_t) :: info
      type(random_t) :: random
      integer :: c, k, kind

      do kind = 1, n_law_kinds()
         call new_normal_law(kind, case%law)
         info = case%law%info()
         if (info%name == "contact."//name) exit
      end do
      call fill_item(info, 1, random, item)
      call tame(info, item, .false.)
      do k = 1, size(info%columns)
         if (.not. allocated(info%columns(k)%default)) cycle
         item%values(k)%flag = .false.
         if (allocated(info%columns(k)%choices)) item%values(k)%text = info%columns(k)%default
      end do
      call set_number(info, "length", 0.0_wp, item)
      call set_number(info, "restitution", 1.0_wp, item)
      do k = 1, size(columns)
         call set_number(info, trim(columns(k)), values(k), item)
      end do
      c = column_number(info, word_column)
      if (c > 0) then
         item%values(c)%text = word
         item%values(c)%flag = word == "on"
      end if
      call case%law%prepare(item)
      call case%law%fit(surfaces, case%parameters, case%message, help)
   end subroutine make_case

   !> Force, derivatives and elastic part of one contact.
   function force_of(case, delta, rate, impact_speed) result(f)
      type(case_t), intent(in) :: case           !! the law
      real(wp), intent(in) :: delta              !! penetration [m]
      real(wp), intent(in) :: rate               !! its rate [m/s]
      real(wp), intent(in) :: impact_speed       !! rate at the onset [m/s]
      real(wp) :: f(4)                           !! (4) force, dF/ddelta, dF/drate, elastic part [N, N/m, N.s/m, N]

      call case%law%force(1, [delta], [rate], [impact_speed], case%parameters, f(1:1), f(2:2), f(3:3), f(4:4))
   end function force_of

end module law_case
