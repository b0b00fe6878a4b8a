!> Measures of motion in an expression of Adams as words of a deck: rows of `[request.motion]`, and rates of bodies.
!>
!> | Adams | deck |
!> |---|---|
!> | `DM(i, j)`, `VR(i, j)` | `distance`, `distance_rate` of a row |
!> | `DX DY DZ (i, j, r)` | `position` along the axes of the part of r, summed along those of r |
!> | `VX VY VZ (i, j, r, s)` | `velocity` as the part of s sees it; r is on that part, or s on the ground |
!> | `WX WY WZ (i, j, r)`, r on the ground | `angular_velocity` of the parts |
!>
!> A marker that is omitted is the global frame. Source: the public descriptions of the functions of Adams/Solver.
!> Limits: other measures, and other axes, have no words.
module adams_measures
   use adams_expression, only: is_measure, node_call, node_number, tree_t
   use adams_model, only: adams_model_t
   use deck_draft, only: body_axis, body_name, deck_draft_t, tab
   use kinds, only: wp
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: markers_of, name_measures

   character(*), parameter :: axes = "XYZ"           !! last letter of a component
   character(*), parameter :: measures = " DM DX DY DZ VR VX VY VZ WX WY WZ "   !! that have words
   integer, parameter :: most_seen = 12              !! words of motion that an expression of a deck may have
   real(wp), parameter :: nothing = 1.0e-15_wp       !! less than this of a direction is round-off [1]

contains

   !> Put the words of a deck into all measures of an expression; rows of requests go to the deck.
   subroutine name_measures(model, draft, tree, message)
      type(adams_model_t), intent(inout) :: model            !! the dataset
      type(deck_draft_t), intent(inout) :: draft             !! the deck
      type(tree_t), intent(inout) :: tree                    !! the expression
      character(:), allocatable, intent(out) :: message      !! what has no words; blank: all have

      integer :: k, n_seen

      message = ""
      n_seen = 0
      do k = 1, tree%n       ! before any row goes to the deck
         if (tree%nodes(k)%kind /= node_call) cycle
         if (.not. is_measure(tree%nodes(k)%name)) cycle
         if (index(measures, " "//tree%nodes(k)%name//" ") == 0) message = "function "//tree%nodes(k)%name// &
            " is not supported (measures of motion that are:"//trim(measures)//")"
         if (message /= "") return
      end do
      do k = 1, tree%n
         if (tree%nodes(k)%kind /= node_call) cycle
         if (.not. is_measure(tree%nodes(k)%name)) cycle
         call name_one(model, draft, tree, k, n_seen, message)
         if (message == "" .and. n_seen > most_seen) message = "it depends on more components of motion than an expression supports"
         if (message /= "") return
      end do
   end subroutine name_measures

   !> The words of one measure.
   subroutine name_one(model, draft, tree, node, n_seen, message)
      type(adams_model_t), intent(inout) :: model               !! the dataset
      type(deck_draft_t), intent(inout) :: draft                !! the deck
      type(tree_t), intent(inout) :: tree                       !! the expression
      integer, intent(in) :: node                               !! the measure
      integer, intent(inout) :: n_seen                          !! components of motion that the expression has
      character(:), allocatable, intent(inout) :: message       !! set: why it has no words

      character(:), allocatable :: unit
      integer :: axis, marker(4)

      associate (it => tree%nodes(node))
         call markers_of(model, tree, node, marker, message)
         if (message /= "") return
         axis = index(axes, it%name(2:2))
         if (it%name(1:1) == "W") then
            call name_spin(model, marker, axis, n_seen, it%words, message)
            return
         end if
         unit = "/"//model%units%length_text()
         if (it%name(1:1) == "V") unit = "*"//model%units%time_text()//unit
         if (axis > 0) then
            call name_component(model, draft, marker, axis, it%name(1:1) == "V", n_seen, it%words, message)
         else
            call name_row(model, draft, marker(:2), 0, .false., it%words, message)
            if (message /= "") return
            it%words = it%words//"."//trim(merge("distance     ", "distance_rate", it%name == "DM"))
            n_seen = n_seen + 1
         end if
         if (message == "") it%words = "("//it%words//unit//")"
      end associate
   end subroutine name_one

   !> The markers that a measure names, by their places in the list.
   subroutine markers_of(model, tree, node, marker, message)
      type(adams_model_t), intent(in) :: model                  !! the dataset
      type(tree_t), intent(in) :: tree                          !! the expression
      integer, intent(in) :: node                               !! the measure
      integer, intent(out) :: marker(4)                         !! (4) I, J, R, S; 0: the global frame
      character(:), allocatable, intent(out) :: message         !! set: a marker is not there

      integer :: id, k

      marker = 0
      message = ""
      associate (it => tree%nodes(node))
         do k = 1, min(4, size(it%arguments))
            if (tree%nodes(it%arguments(k))%kind /= node_number) then
               message = "an argument of "//it%name//" is not the number of a marker"
               return
            end if
            id = nint(min(max(tree%nodes(it%arguments(k))%value, 0.0_wp), 1.0e9_wp))
            if (id == 0) cycle
            marker(k) = model%marker(id)
            if (marker(k) == 0) message = "marker "//to_text(id)//" of "//it%name//" is not a MARKER of a rigid part"
         end do
         if (marker(1) == 0 .and. message == "") message = it%name//" has no marker"
      end associate
   end subroutine markers_of

   !> A component of a place or velocity along an axis of R.
   subroutine name_component(model, draft, marker, axis, is_rate, n_seen, words, message)
      type(adams_model_t), intent(inout) :: model               !! the dataset
      type(deck_draft_t), intent(inout) :: draft                !! the deck
      integer, intent(in) :: marker(4)                          !! (4) I, J, R, S; 0: the global frame
      integer, intent(in) :: axis                               !! of R, 1 to 3
      logical, intent(in) :: is_rate                            !! a velocity
      integer, intent(inout) :: n_seen                          !! components of motion that the expression has
      character(:), allocatable, intent(out) :: words           !! a quantity of a deck
      character(:), allocatable, intent(inout) :: message       !! set: why it has no words

      character(:), allocatable :: channel, row
      real(wp) :: direction(3)
      integer :: k
      logical :: is_true

      words = ""
      is_true = is_rate .and. is_fixed(model, marker(4)) .and. .not. is_fixed(model, marker(3))
      if (is_rate .and. .not. is_true .and. part_of(model, marker(3)) /= part_of(model, marker(4))) then
         message = "a velocity observed from one part, in axes of another part"
         return
      end if
      call name_row(model, draft, marker(:2), marker(3), is_true, row, message)
      if (message /= "") return
      channel = "."//trim(merge("velocity", "position", is_rate))//"."
      direction = 0.0_wp
      direction(axis) = 1.0_wp
      if (marker(3) > 0) direction = body_axis(model, marker(3), axis)
      do k = 1, 3
         if (abs(direction(k)) <= nothing) cycle
         if (words /= "") words = words//" + "
         words = words//factor(direction(k))//row//channel//achar(iachar("x") + k - 1)
         n_seen = n_seen + 1
      end do
      words = "("//words//")"
   end subroutine name_component

   !> The row that reports how marker I moves against J.
   subroutine name_row(model, draft, marker, frame, is_true, name, message)
      type(adams_model_t), intent(inout) :: model               !! the dataset
      type(deck_draft_t), intent(inout) :: draft                !! the deck
      integer, intent(in) :: marker(2)                          !! (2) I and J; 0: the global frame
      integer, intent(in) :: frame                              !! marker whose part has the axes; 0: the global frame
      logical, intent(in) :: is_true                            !! rates are those that the world sees
      character(:), allocatable, intent(out) :: name            !! of the row
      character(:), allocatable, intent(inout) :: message       !! set: why there is none

      character(:), allocatable :: body, from, observer, point
      logical :: is_new

      name = ""
      from = "none"
      if (marker(2) == 0 .and. .not. is_fixed(model, frame)) then
         message = "a position relative to the global origin in axes of a moving part"
         return
      end if
      call draft%point(model, marker(1), point)
      if (marker(2) > 0) call draft%point(model, marker(2), from)
      body = "ground"
      if (.not. is_fixed(model, frame)) body = body_name(model%parts(model%markers(frame)%part)%name, .false.)
      observer = trim(merge("world", "frame", is_true))
      call draft%row_of("seen_"//point//"_"//from//"_"//body//"_"//observer, name, is_new)
      if (is_new) call draft%put("request.motion", "name point from frame observer", &
                                 name//tab//point//tab//from//tab//body//tab//observer)
   end subroutine name_row

   !> A component of the angular velocity of I against J, along an axis of the ground.
   subroutine name_spin(model, marker, axis, n_seen, words, message)
      type(adams_model_t), intent(in) :: model                  !! the dataset
      integer, intent(in) :: marker(4)                          !! (4) I, J, R, S; 0: the global frame
      integer, intent(in) :: axis                               !! of R, 1 to 3
      integer, intent(inout) :: n_seen                          !! components of motion that the expression has
      character(:), allocatable, intent(out) :: words           !! a plain number
      character(:), allocatable, intent(inout) :: message       !! set: why it has no words

      real(wp) :: direction(3)
      integer :: k, side

      words = ""
      if (.not. is_fixed(model, marker(3))) then
         message = "an angular velocity in axes of a moving part"
         return
      end if
      direction = 0.0_wp
      direction(axis) = 1.0_wp
      if (marker(3) > 0) direction = body_axis(model, marker(3), axis)
      do side = 1, 2
         if (is_fixed(model, marker(side))) cycle
         associate (part => model%parts(model%markers(marker(side))%part))
            if (index(part%name, "-") > 0) message = "the name of its part, "//part%name//", is not allowed in expressions"
            do k = 1, 3
               if (abs(direction(k)) <= nothing) cycle
               words = words//" + "//factor(merge(1.0_wp, -1.0_wp, side == 1)*direction(k))//part%name//".angular_velocity."// &
                       achar(iachar("x") + k - 1)
               n_seen = n_seen + 1
            end do
         end associate
      end do
      if (words == "") then
         words = "0"
      else
         words = "(("//words(4:)//")*"//model%units%time_text()//"/1rad)"
      end if
   end subroutine name_spin

   !> A factor before what it multiplies.
   pure function factor(x) result(words)
      real(wp), intent(in) :: x               !! the factor [1]
      character(:), allocatable :: words      !! blank for one

      words = "("//real_text(x, 17)//")*"
      if (.not. abs(x - 1.0_wp) > 0.0_wp) words = ""
   end function factor

   !> Whether a marker does not move.
   pure logical function is_fixed(model, marker)
      type(adams_model_t), intent(in) :: model  !! the dataset
      integer, intent(in) :: marker             !! by its place in the list; 0: the global frame

      is_fixed = marker == 0
      if (marker > 0) is_fixed = model%parts(model%markers(marker)%part)%is_ground
   end function is_fixed

   !> The part of a marker; of one that does not move 0.
   pure integer function part_of(model, marker)
      type(adams_model_t), intent(in) :: model  !! the dataset
      integer, intent(in) :: marker             !! by its place in the list; 0: the global frame

      part_of = 0
      if (.not. is_fixed(model, marker)) part_of = model%markers(marker)%part
   end function part_of

end module adams_measures
