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
   use errors, only: error_t, exit_usage, set_error
   use integration_settings, only: choice_t, new_option
   use integrator_controls, only: onset_interpolate, onset_reject
   use item, only: item_t, option_t
   use kind_info, only: dim_frequency, kind_info_t
   use kinds, only: wp
   use scene, only: analysis_dynamic, scene_t
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

      type(option_t) :: gains(2)
      integer :: c, i, k

      if (scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "option --legacy needs [analysis.dynamic]")
         return
      end if
      associate (settings => scene%settings%integration)
         settings%method = "verner"
         settings%solver%name = "lapack"
         settings%is_reduced = .false.
         settings%is_apart = .false.
         if (.not. settings%controls%fixed_step > 0.0_wp) settings%controls%fixed_step = usual_step
         if (.not. scene%settings%dynamic%is_given("stabilise")) then
            gains(1) = new_option("alpha", usual_gain, dim_frequency)
            gains(2) = new_option("beta", usual_gain, dim_frequency)
            settings%stabilisation = choice_t("baumgarte", gains)
         end if
         if (way == "procedure1") then
            settings%controls%onset = onset_interpolate
         else if (settings%controls%onset /= onset_reject) then
            settings%controls%onset = onset_reject
            settings%controls%onset_limit = usual_limit
         end if
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

end module legacy_way
