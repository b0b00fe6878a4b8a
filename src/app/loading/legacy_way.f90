!> `--legacy`: a deck run as programs of old run it, for like against like.
!>
!> Verner's method with fixed steps (the deck's `step`, else 10 us), Baumgarte's gains of 5 1/s unless the deck stabilises
!> otherwise,
!> the full augmented matrix with partial pivoting, all coordinates of all bodies, all bodies together, and wherever a joint with
!> clearance has a formula of the book beside a corrected one, that of the book (faces of sliders only where they have a law).
!> Onsets of contacts by the book's procedure 1 (`contact_onset = interpolate`) or 2 (`reject limit=0.1um`, unless the deck says
!> another limit).
!>
!> Source: Flores et al. (2008), sections 2.4, 3.5, tables 3.2, 4.2. Limits: films are as the deck's tables say (`form = book`).
module legacy_way
   use dimension_text, only: unit_text
   use errors, only: error_t, exit_usage, set_error
   use item, only: item_t, option_t, place_of
   use kind_info, only: dim_frequency, dim_length, dim_t, kind_info_t
   use kinds, only: wp
   use scene, only: analysis_dynamic, scene_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: take_legacy_way

   real(wp), parameter :: usual_step = 1.0e-5_wp     !! [s]
   real(wp), parameter :: usual_gain = 5.0_wp        !! alpha and beta [1/s]
   real(wp), parameter :: usual_limit = 1.0e-7_wp    !! penetration at an onset [m]

contains

   !> Change the settings of a scene.
   subroutine take_legacy_way(way, scene, error)
      character(*), intent(in) :: way                      !! procedure1 or procedure2
      type(scene_t), intent(inout) :: scene                !! changed
      type(error_t), allocatable, intent(out) :: error     !! it has no dynamic analysis

      integer :: c, i, k

      if (scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "option --legacy needs [analysis.dynamic]")
         return
      end if
      associate (settings => scene%settings%dynamic%item_t)
         call put_word(settings, "method", "verner")
         call put_word(settings, "solver", "lapack")
         call put_word(settings, "coordinates", "full")
         call put_word(settings, "groups", "together")
         associate (step => settings%values(place_of(settings, "step")))
            if (.not. step%number > 0.0_wp) step%number = usual_step
            step%given = .true.
         end associate
         associate (hold => settings%values(place_of(settings, "stabilise")))
            if (.not. hold%given) then
               call put_word(settings, "stabilise", "baumgarte")
               if (allocated(hold%options)) deallocate (hold%options)
               allocate (hold%options(2))
               call put_option(hold%options(1), "alpha", usual_gain, dim_frequency)
               call put_option(hold%options(2), "beta", usual_gain, dim_frequency)
            end if
         end associate
         associate (onset => settings%values(place_of(settings, "contact_onset")))
            if (way == "procedure1") then
               call put_word(settings, "contact_onset", "interpolate")
               if (allocated(onset%options)) deallocate (onset%options)
               allocate (onset%options(0))
            else if (onset%text /= "reject") then
               call put_word(settings, "contact_onset", "reject")
               if (allocated(onset%options)) deallocate (onset%options)
               allocate (onset%options(1))
               call put_option(onset%options(1), "limit", usual_limit, dim_length)
            end if
         end associate
      end associate
      do k = 1, size(scene%clearances)
         do i = 1, size(scene%clearances(k)%items)
            do c = 1, size(scene%clearances(k)%info%columns)
               call take_book(scene%clearances(k)%info, c, scene%clearances(k)%items(i))
            end do
         end do
      end do
   end subroutine take_legacy_way

   !> Give a cell the word of the book, if its column has one.
   subroutine take_book(info, c, item)
      type(kind_info_t), intent(in) :: info      !! the kind
      integer, intent(in) :: c                   !! number of the column
      type(item_t), intent(inout) :: item        !! the row

      associate (column => info%columns(c))
         if (.not. allocated(column%choices)) return
         if (index(" "//column%choices//" ", " book ") > 0 .and. .not. lacks_law(column%name, item)) item%values(c)%text = "book"
         if (column%name == "stiffness" .and. column%choices == "half full") item%values(c)%text = "full"
         if (column%name == "ends" .and. column%choices == "clipped endless") item%values(c)%text = "endless"
      end associate
   end subroutine take_book

   !> Whether the book's way of faces has no law that it needs: such a joint keeps its corners.
   logical function lacks_law(column, item)
      character(*), intent(in) :: column     !! the column
      type(item_t), intent(in) :: item       !! the row

      lacks_law = column == "faces"
      if (lacks_law) lacks_law = item%reference("face_law") == 0
   end function lacks_law

   !> Give a key a word.
   subroutine put_word(settings, key, word)
      type(item_t), intent(inout) :: settings    !! the section
      character(*), intent(in) :: key            !! the key
      character(*), intent(in) :: word           !! its word

      associate (value => settings%values(place_of(settings, key)))
         value%text = word
         value%given = .true.
      end associate
   end subroutine put_word

   !> An option with a number, as if it had been read.
   subroutine put_option(option, name, number, dimension)
      type(option_t), intent(inout) :: option    !! the option
      character(*), intent(in) :: name           !! its name
      real(wp), intent(in) :: number             !! its value, SI [any]
      type(dim_t), intent(in) :: dimension       !! of the value

      option%name = name
      option%text = real_text(number, 6)//unit_text(dimension)
      option%number = number
      option%is_number = .true.
      option%dimension = dimension
   end subroutine put_option

end module legacy_way
