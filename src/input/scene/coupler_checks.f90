!> What a row of joint.coupler cannot say of itself: coordinates that its joints have, factors that fit each other.
module coupler_checks
   use columns, only: cell_index, column_of
   use diagnostics, only: diagnostics_t
   use dimension_text, only: unit_text
   use item, only: item_t
   use kind_info, only: dim_angle, dim_length, dim_t, kind_info_t, same_dimension
   use kinds, only: wp
   use scene, only: scene_t
   use ties, only: find_joint
   implicit none (type, external)
   private
   public :: check_coupler

   character(1), parameter :: digit(3) = ["1", "2", "3"]

contains

   !> Check a row: its coordinates first, then its factors.
   subroutine check_coupler(scene, info, item, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(kind_info_t), intent(in) :: info               !! the kind
      type(item_t), intent(in) :: item                    !! the row
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      logical :: is_angle(3), is_bad
      integer :: e, m, n

      n = merge(3, 2, cell_index(info, item, "joint_3") > 0)
      if (n == 2 .and. item%is_given("scale_3")) then
         call complain(info, item, "scale_3", "coupler '"//item%name//"' has a third scale without a joint", &
                       "joint_3 is not given", "give joint_3, or omit scale_3", diagnostics)
      end if
      is_bad = .false.
      do e = 1, n
         call find_coordinate(scene, info, item, e, is_angle(e), is_bad, diagnostics)
      end do
      if (is_bad) return
      do e = 2, n
         do m = 1, e - 1
            if (cell_index(info, item, "joint_"//digit(e)) /= cell_index(info, item, "joint_"//digit(m)) &
                .or. (is_angle(e) .neqv. is_angle(m))) cycle
            call complain(info, item, "joint_"//digit(e), "coupler '"//item%name//"' names one coordinate twice", &
                          "is joint_"//digit(m)//" already", "name different joints, or different coordinates of one", diagnostics)
            return
         end do
      end do
      call check_scales(info, item, is_angle(:n), diagnostics)
   end subroutine check_coupler

   !> Which coordinate of a joint is meant, and whether the joint has it.
   subroutine find_coordinate(scene, info, item, e, is_angle, is_bad, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(kind_info_t), intent(in) :: info               !! the kind
      type(item_t), intent(in) :: item                    !! the row
      integer, intent(in) :: e                            !! number of the joint
      logical, intent(out) :: is_angle                    !! the angle; else the displacement
      logical, intent(inout) :: is_bad                    !! set if the joint does not have it
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      character(:), allocatable :: kind_name, wanted
      integer :: kind, row

      call find_joint(scene, cell_index(info, item, "joint_"//digit(e)), kind, row)
      kind_name = scene%joints(kind)%info%name
      wanted = item%word("of_"//digit(e))
      is_angle = wanted == "angle" .or. (wanted == "own" .and. kind_name /= "joint.translational")
      if (.not. (kind_name == "joint.translational" .and. wanted == "angle" &
                 .or. kind_name == "joint.revolute" .and. wanted == "displacement")) return
      is_bad = .true.
      call complain(info, item, "of_"//digit(e), "joint '"//scene%joints(kind)%items(row)%name//"' has no "//wanted// &
                    " to couple", "it is a "//kind_name, "use own, or name another joint", diagnostics)
   end subroutine find_coordinate

   !> Factors differ from zero, and all terms are angles or all lengths, or of one other dimension.
   subroutine check_scales(info, item, is_angle, diagnostics)
      type(kind_info_t), intent(in) :: info               !! the kind
      type(item_t), intent(in) :: item                    !! the row
      logical, intent(in) :: is_angle(:)                  !! (joints) whether their angles are coupled
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      type(dim_t) :: term, total
      integer :: e

      total = term_of(1)
      do e = 1, size(is_angle)
         if (.not. abs(item%number("scale_"//digit(e))) > 0.0_wp) then
            call complain(info, item, "scale_"//digit(e), "coupler '"//item%name//"' has a factor of zero", &
                          "scale_"//digit(e)//" must not be zero", "give the factor of joint_"//digit(e), diagnostics)
            return
         end if
         term = term_of(e)
         if (same_dimension(term, total)) cycle
         call complain(info, item, "scale_"//digit(e), "coupler '"//item%name//"' adds unlike terms: scale_1 s_1 is in "// &
                       unit_text(total)//", scale_"//digit(e)//" s_"//digit(e)//" in "//unit_text(term), "does not match", &
                       "give a factor of length per angle beside a displacement, as scale_1 = 5 mm/rad", diagnostics)
         return
      end do
      if (.not. item%is_given("offset")) return
      if (same_dimension(item%values(column_of(info, "offset"))%dimensions(1), total)) return
      call complain(info, item, "offset", "the offset of coupler '"//item%name//"' is no sum of its terms", &
                    "must be in "//unit_text(total), "give it with that unit, or omit it", diagnostics)

   contains

      !> Dimension of a factor times its coordinate.
      function term_of(e) result(dimension)
         integer, intent(in) :: e   !! number of the joint
         type(dim_t) :: dimension   !! of the term

         dimension = item%values(column_of(info, "scale_"//digit(e)))%dimensions(1)
         if (is_angle(e)) dimension%rad = dimension%rad + dim_angle%rad
         if (.not. is_angle(e)) dimension%m = dimension%m + dim_length%m
      end function term_of

   end subroutine check_scales

   !> Report a mistake at a cell.
   subroutine complain(info, item, column, summary, note, help, diagnostics)
      type(kind_info_t), intent(in) :: info               !! the kind
      type(item_t), intent(in) :: item                    !! the row
      character(*), intent(in) :: column                  !! the cell's column
      character(*), intent(in) :: summary                 !! what is wrong
      character(*), intent(in) :: note                    !! a few words beside the caret
      character(*), intent(in) :: help                    !! what to do
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      call diagnostics%add(item%values(column_of(info, column))%location, summary, note, help)
   end subroutine complain

end module coupler_checks
