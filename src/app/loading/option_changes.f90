!> What the command line changes in a deck: its analysis, levels of its joints, tolerance and method.
module option_changes
   use columns, only: column_of
   use errors, only: error_t, exit_usage, set_error
   use item, only: item_t, location_t, place_of
   use joint_level, only: make_ideal
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use legacy_way, only: take_legacy_way
   use options, only: options_t
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names, n_analysis, scene_t
   use spelling, only: nearest_word
   use text, only: to_text
   implicit none (type, external)
   private
   public :: apply_options, choose_analysis

contains

   !> The analysis that the command line names; else the first of the list that the deck has.
   subroutine choose_analysis(options, scene, error)
      type(options_t), intent(in) :: options               !! the command line
      type(scene_t), intent(inout) :: scene                !! the analysis is set
      type(error_t), allocatable, intent(out) :: error     !! the deck has no such analysis

      character(:), allocatable :: known
      integer :: k

      if (.not. allocated(options%change%analysis)) return
      known = ""
      do k = 1, n_analysis
         if (.not. scene%settings%has_analysis(k)) cycle
         known = known//" "//trim(analysis_names(k))
         if (analysis_names(k) /= options%change%analysis) cycle
         scene%analysis = k
         if (scene%states%n > 0 .and. k /= analysis_dynamic) call set_error(error, exit_usage, "[state] needs [analysis.dynamic]")
         return
      end do
      call set_error(error, exit_usage, "the deck has no section [analysis."//options%change%analysis//"]"//new_line("a")// &
                     "  = a line [analysis."//options%change%analysis//"] is enough; analyses in the deck:"//known)
   end subroutine choose_analysis

   !> What the command line changes in the deck.
   subroutine apply_options(options, scene, error)
      type(options_t), intent(in) :: options               !! the command line
      type(scene_t), intent(inout) :: scene                !! levels, tolerance and method are changed
      type(error_t), allocatable, intent(out) :: error     !! an unknown method

      integer :: k

      if (options%change%is_ideal) then
         do k = 1, size(scene%clearances)
            call make_ideal(scene%clearances(k)%items)
         end do
      end if
      if (allocated(options%legacy%way)) call take_legacy_way(options%legacy%way, scene, error)
      if (allocated(error)) return
      if (options%change%tolerance > 0.0_wp) then
         select case (scene%analysis)
         case (analysis_dynamic)
            scene%settings%integration%controls%tolerance = options%change%tolerance
            call check_tolerance(scene%settings%dynamic%info)
         case (analysis_kinematic)
            call set_tolerance(scene%settings%kinematic%info, scene%settings%kinematic%item_t)
         case default
            call set_tolerance(scene%settings%static%info, scene%settings%static%item_t)
         end select
         if (allocated(error)) return
      end if
      if (allocated(options%change%method)) call set_method(options%change%method, scene, error)

   contains

      !> Give the settings the tolerance of the command line.
      subroutine set_tolerance(kind, settings)
         type(kind_info_t), intent(in) :: kind      !! keys
         type(item_t), intent(inout) :: settings    !! settings

         associate (value => settings%values(place_of(settings, "tolerance")))
            value%number = options%change%tolerance
            value%given = .true.
         end associate
         call check_tolerance(kind)
      end subroutine set_tolerance

      !> The tolerance of the command line must be in the bounds of the key.
      subroutine check_tolerance(kind)
         type(kind_info_t), intent(in) :: kind      !! keys

         associate (column => kind%columns(column_of(kind, "tolerance")))
            if (options%change%tolerance >= column%bounds%lower .and. options%change%tolerance <= column%bounds%upper) return
            call set_error(error, exit_usage, "option --tolerance needs a number from "//to_text(column%bounds%lower)//" to "// &
                           to_text(column%bounds%upper)//" for ["//kind%name//"], got "//to_text(options%change%tolerance))
         end associate
      end subroutine check_tolerance

   end subroutine apply_options

   !> Give the scene the integrator of the command line.
   subroutine set_method(method, scene, error)
      character(*), intent(in) :: method                   !! its name
      type(scene_t), intent(inout) :: scene                !! the method is changed
      type(error_t), allocatable, intent(out) :: error     !! there is no integration, or no such integrator

      character(:), allocatable :: known, nearest

      if (scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "option --method needs [analysis.dynamic], not [analysis."// &
                        trim(analysis_names(scene%analysis))//"]")
         return
      end if
      known = scene%settings%dynamic%info%columns(column_of(scene%settings%dynamic%info, "method"))%choices
      if (index(method, " ") > 0 .or. index(" "//known//" ", " "//method//" ") == 0) then
         nearest = nearest_word(method, known)
         if (len(nearest) > 0) nearest = "did you mean '"//nearest//"'? "
         call set_error(error, exit_usage, "unknown method '"//method//"'"//new_line("a")//"  = "//nearest//"methods: "//known)
         return
      end if
      scene%settings%integration%method = method
      scene%settings%integration%places%method = location_t()
   end subroutine set_method

end module option_changes
