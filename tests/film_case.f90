!> A film by its name in a bearing, and its force at a motion given along and across the line of centres.
module film_case
   use film_law, only: film_bearing_t, film_law_t, film_motion_t, n_film_parameter
   use film_registry, only: n_film_kinds, new_film_law
   use fixed_random, only: random_t
   use generic_item, only: column_number, fill_item
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: components, film_case_t, force_of, make_film, make_film_kind, motion_of, unit_bearing

   !> A film with what it gives.
   type :: film_case_t
      class(film_law_t), allocatable :: law              !! the film
      type(film_bearing_t) :: bearing                    !! the bearing
      real(wp) :: parameters(n_film_parameter) = 0.0_wp  !! (n_film_parameter) for the bearing [any]
      character(:), allocatable :: name                  !! of the kind, without `film.`
      character(:), allocatable :: message               !! why it does not match, empty: it does
   end type film_case_t

contains

   !> A bearing with mu L R^3/c^2 = mu L^3 R/c^2 = 1 N.s and c = 1 m: forces are those of the books, without dimensions.
   pure function unit_bearing() result(bearing)
      type(film_bearing_t) :: bearing  !! the bearing

      bearing = film_bearing_t(radius=1.0_wp, clearance=1.0_wp, length=1.0_wp, viscosity=1.0_wp, eps_max=0.9999_wp)
   end function unit_bearing

   !> A film by the number of its kind, columns at their defaults.
   subroutine make_film_kind(kind, bearing, case)
      integer, intent(in) :: kind                 !! number of the kind
      type(film_bearing_t), intent(in) :: bearing !! the bearing
      type(film_case_t), intent(out) :: case      !! the film

      class(film_law_t), allocatable :: law
      type(kind_info_t) :: info

      call new_film_law(kind, law)
      info = law%info()
      call make_film(info%name(len("film.") + 1:), " ", " ", bearing, case)
   end subroutine make_film_kind

   !> A film by its name; a word in one column, the others at their defaults.
   subroutine make_film(name, word_column, word, bearing, case)
      character(*), intent(in) :: name            !! of the film, without `film.`
      character(*), intent(in) :: word_column     !! a column of words, blank: none
      character(*), intent(in) :: word            !! what stands in it
      type(film_bearing_t), intent(in) :: bearing !! the bearing
      type(film_case_t), intent(out) :: case      !! the film

      character(:), allocatable :: help
      type(item_t) :: item
      type(kind_info_t) :: info
      type(random_t) :: random
      integer :: c, k, kind

      do kind = 1, n_film_kinds()
         call new_film_law(kind, case%law)
         info = case%law%info()
         if (info%name == "film."//name) exit
      end do
      call fill_item(info, 1, random, item)
      item%values%given = .false.
      do k = 1, size(info%columns)
         if (allocated(info%columns(k)%choices)) item%values(k)%text = info%columns(k)%default
      end do
      c = column_number(info, word_column)
      if (c > 0) item%values(c)%text = word
      case%name = name
      case%bearing = bearing
      call case%law%prepare(item)
      call case%law%fit(bearing, case%parameters, case%message, help)
   end subroutine make_film

   !> A motion by eccentricity ratio, its rate, and Om = w_J + w_B - 2 gamma' with gamma' = 0, turned by an angle.
   pure function motion_of(case, eps, eps_dot, om, turned) result(motion)
      type(film_case_t), intent(in) :: case       !! the film
      real(wp), intent(in) :: eps                 !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot             !! its rate [1/s]
      real(wp), intent(in) :: om                  !! Om [rad/s]
      real(wp), intent(in) :: turned              !! angle of the line of centres [rad]
      type(film_motion_t) :: motion               !! the motion

      motion%e = case%bearing%clearance*eps*[cos(turned), sin(turned)]
      motion%e_dot = case%bearing%clearance*eps_dot*[cos(turned), sin(turned)]
      motion%speed_sum = om
      motion%speed_difference = om
   end function motion_of

   !> The force on the journal at a motion.
   function force_of(case, motion) result(f)
      type(film_case_t), intent(in) :: case       !! the film
      type(film_motion_t), intent(in) :: motion   !! the motion
      real(wp) :: f(2)                            !! (2) force, world frame [N]

      real(wp) :: column(2, 1)

      call case%law%force(1, [motion], case%parameters, column)
      f = column(:, 1)
   end function force_of

   !> Its components along and across the line of centres.
   function components(case, eps, eps_dot, om) result(f)
      type(film_case_t), intent(in) :: case       !! the film
      real(wp), intent(in) :: eps                 !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot             !! its rate [1/s]
      real(wp), intent(in) :: om                  !! Om [rad/s]
      real(wp) :: f(2)                            !! (2) along n and t [N]

      f = force_of(case, motion_of(case, eps, eps_dot, om, 0.0_wp))
   end function components

end module film_case
