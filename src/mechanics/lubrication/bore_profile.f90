!> The bore of a journal bearing that is not round: lobes, measured gaps, and a pressure dam in any of them.
!>
!> The inscribed circle of the bore has the clearance c. What the bore adds to the gap of the round bearing is G c, at the angle
!> theta in the frame of the bearing's body:
!>
!> h = c [1 + G(theta, y)] - e.u,   u = (cos theta, sin theta)
!>
!> Lobes: n equal arcs from theta_0 on, each a circle of the clearance c_p = c/(1 - m) with the preload m, whose smallest gap lies
!> at theta_k = theta_0 + (k - 1 + a) 2 pi/n with the offset a:
!>
!> G = m/(1 - m) [1 - cos(theta - theta_k)]
!>
!> n = 2 and a = 1/2 is the lemon bore, m its ellipticity; a = 1 are offset halves whose gap narrows counter-clockwise all the way.
!> Points: G c goes along lines between the samples, around the circumference. Dam: G grows by depth/c in an arc, |y| < its part of
!> the length. Where G jumps it is taken from the side of an angle that is named, `of`.
!>
!> Signs: angles counter-clockwise from the x axis of the bearing's body. Source: J. W. Lund and K. K. Thomsen, A calculation method
!> and data for the dynamic coefficients of oil-lubricated journal bearings, ASME (1978), for lobes and preload. Limits: G >= 0; the
!> surface turns with the body of the bearing.
module bore_profile
   use dimensions, only: same_dimension
   use item, only: item_t, place_of
   use kind_info, only: add_list, add_number, add_word, dim_angle, dim_length, dim_none, kind_info_t
   use kinds, only: two_pi, wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: add_bore_columns, bore_mistake, bore_t, bore_words, new_bore, same_bore

   !> A bore. The dam is there where it has a depth.
   type :: bore_t
      integer :: lobes = 0                 !! n; 0: no lobes
      real(wp) :: preload = 0.0_wp         !! m [1]
      real(wp) :: offset = 0.5_wp          !! a [1]
      real(wp) :: start = 0.0_wp           !! theta_0 [rad]
      real(wp) :: dam_start = 0.0_wp       !! where the dam starts [rad]
      real(wp) :: dam_arc = 0.0_wp         !! how far it reaches, counter-clockwise, below a turn [rad]
      real(wp) :: dam_depth = 0.0_wp       !! its depth, 0: no dam [m]
      real(wp) :: dam_length = 1.0_wp      !! part of the bearing's length, in the middle; 1: from end to end [1]
      real(wp), allocatable :: angle(:)    !! (samples) of the measured gap, increasing, within a turn; none: not measured [rad]
      real(wp), allocatable :: depth(:)    !! (samples) G c there [m]
   contains
      procedure :: is_round
      procedure :: depth_at
      procedure :: in_dam
      procedure :: edges
      procedure :: min_gap
   end type bore_t

   character(*), parameter :: of_lobes(4) = [character(10) :: "lobes", "preload", "offset", "bore_angle"]
   character(*), parameter :: of_points(2) = [character(11) :: "bore_angles", "bore_depths"]
   character(*), parameter :: of_dam(4) = [character(10) :: "dam_start", "dam_end", "dam_depth", "dam_length"]

contains

   !> Columns of a bore.
   subroutine add_bore_columns(info)
      type(kind_info_t), intent(inout) :: info  !! the film

      call add_word(info, "bore", "bore: round; equal circular arcs (lobes), 2 are a lemon bore; measured gaps (points)", &
                    default="round", choices="round lobes points")
      call add_number(info, "lobes", dim_none, "lobes: number of arcs", default="2", lower=1.0_wp, upper=12.0_wp)
      call add_number(info, "preload", dim_none, "lobes: preload or ellipticity, 1 - clearance of bearing/clearance of lobe", &
                      default="0", lower=0.0_wp, upper=1.0_wp, open_upper=.true.)
      call add_number(info, "offset", dim_none, "lobes: where the gap of a lobe is smallest, over its arc from its start, " &
                      //"counter-clockwise", default="0.5", lower=0.0_wp, upper=1.0_wp)
      call add_number(info, "bore_angle", dim_angle, "lobes: start of the first one, from x of the bearing body", default="0 deg")
      call add_list(info, "bore_angles", "points: directions from x of the bearing body, increasing, within a turn", default="")
      call add_list(info, "bore_depths", "points: depths of the bore there outside of its inscribed circle", default="")
      call add_word(info, "dam", "pressure dam: none, or a pocket that ends in a step", default="none", choices="none step")
      call add_number(info, "dam_start", dim_angle, "dam: start of the pocket, from x of the bearing body", default="0 deg")
      call add_number(info, "dam_end", dim_angle, "dam: end of the pocket, counter-clockwise from its start", default="0 deg")
      call add_number(info, "dam_depth", dim_length, "dam: depth of the pocket", default="0 m", lower=0.0_wp)
      call add_number(info, "dam_length", dim_none, "dam: axial length of the pocket over that of the bearing; 1: all of it", &
                      default="1", lower=0.0_wp, upper=1.0_wp, open_lower=.true.)
   end subroutine add_bore_columns

   !> The bore of a row that has no mistake.
   subroutine new_bore(item, bore)
      type(item_t), intent(in) :: item    !! the row
      type(bore_t), intent(out) :: bore   !! its bore

      integer :: angles, depths

      allocate (bore%angle(0), bore%depth(0))
      select case (item%word("bore"))
      case ("lobes")
         bore%lobes = nint(item%number("lobes"))
         bore%preload = item%number("preload")
         bore%offset = item%number("offset")
         bore%start = item%number("bore_angle")
      case ("points")
         angles = place_of(item, "bore_angles")
         depths = place_of(item, "bore_depths")
         bore%angle = item%values(angles)%table(:, 1)
         bore%depth = item%values(depths)%table(:, 1)
      end select
      if (item%word("dam") == "none") return
      bore%dam_start = item%number("dam_start")
      bore%dam_arc = modulo(item%number("dam_end") - bore%dam_start, two_pi)
      bore%dam_depth = item%number("dam_depth")
      bore%dam_length = item%number("dam_length")
   end subroutine new_bore

   !> What is wrong with the bore of a row: columns that its words do not use, or miss; samples that are no profile.
   function bore_mistake(item) result(message)
      type(item_t), intent(in) :: item      !! the row
      character(:), allocatable :: message  !! one line, empty: all is well

      message = unused(item, "bore", "lobes", of_lobes, [2.0_wp, 0.0_wp, 0.5_wp, 0.0_wp])
      if (message == "") message = unused(item, "bore", "points", of_points)
      if (message == "") message = unused(item, "dam", "step", of_dam, [0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp])
      if (message /= "") return
      if (item%word("bore") == "lobes" .and. .not. item%is_given("preload")) message = "bore = lobes needs column preload"
      if (item%word("bore") == "points") message = points_mistake(item)
      if (message /= "" .or. item%word("dam") == "none") return
      if (.not. (item%is_given("dam_start") .and. item%is_given("dam_end") .and. item%is_given("dam_depth"))) then
         message = "dam = step needs columns dam_start, dam_end and dam_depth"
      else if (.not. modulo(item%number("dam_end") - item%number("dam_start"), two_pi) > 0.0_wp) then
         message = "the dam ends where it starts: give an arc of less than a turn"
      end if
   end function bore_mistake

   !> A column that is given, and has not its default, though the word that it belongs to is not.
   function unused(item, column, word, names, defaults) result(message)
      type(item_t), intent(in) :: item                !! the row
      character(*), intent(in) :: column              !! of words
      character(*), intent(in) :: word                !! to which the columns belong
      character(*), intent(in) :: names(:)            !! (n) the columns
      real(wp), intent(in), optional :: defaults(:)   !! (n) of numbers; absent: lists [any]
      character(:), allocatable :: message            !! one line, empty: all is well

      integer :: k
      logical :: is_changed

      message = ""
      if (item%word(column) == word) return
      do k = 1, size(names)
         is_changed = item%is_given(trim(names(k)))
         if (is_changed .and. present(defaults)) is_changed = abs(item%number(trim(names(k))) - defaults(k)) > 0.0_wp
         if (is_changed) message = "column "//trim(names(k))//" belongs to "//column//" = "//word//", but "//column//" = " &
                                   //item%word(column)
      end do
   end function unused

   !> What is wrong with measured gaps.
   function points_mistake(item) result(message)
      type(item_t), intent(in) :: item      !! the row
      character(:), allocatable :: message  !! one line, empty: all is well

      integer :: n

      message = ""
      if (.not. (item%is_given("bore_angles") .and. item%is_given("bore_depths"))) then
         message = "bore = points needs columns bore_angles and bore_depths"
         return
      end if
      associate (angle => item%values(place_of(item, "bore_angles")), depth => item%values(place_of(item, "bore_depths")))
         n = size(angle%table, 1)
         if (size(depth%table, 1) /= n) then
            message = to_text(size(depth%table, 1))//" bore_depths at "//to_text(n)//" bore_angles"
         else if (n < 3) then
            message = "there are "//to_text(n)//" bore_angles, a bore needs at least 3"
         else if (.not. same_dimension(angle%dimensions(1), dim_angle)) then
            message = "bore_angles are not angles: give a unit as deg"
         else if (.not. same_dimension(depth%dimensions(1), dim_length)) then
            message = "bore_depths are not lengths: give a unit as um"
         else if (any(angle%table(2:, 1) <= angle%table(:n - 1, 1))) then
            message = "bore_angles must increase from sample to sample"
         else if (angle%table(n, 1) - angle%table(1, 1) >= two_pi) then
            message = "bore_angles must lie within one turn: omit a last sample that is the first one"
         else if (any(depth%table(:, 1) < 0.0_wp)) then
            message = "a depth of the bore is negative: depths are measured from its inscribed circle"
         end if
      end associate
   end function points_mistake

   !> A bore that is not round, in words.
   function bore_words(bore) result(words)
      type(bore_t), intent(in) :: bore     !! the bore
      character(:), allocatable :: words   !! as "; 2 lobes of preload 0.5, offset 0.5"; empty: it is round

      words = ""
      if (bore%is_round()) return
      if (bore%lobes > 0) words = "; "//to_text(bore%lobes)//" lobes of preload "//to_text(bore%preload)//", offset " &
                                  //to_text(bore%offset)
      if (size(bore%depth) > 0) words = "; bore given at "//to_text(size(bore%depth))//" points"
      if (bore%dam_depth > 0.0_wp) words = words//"; dam "//to_text(1.0e6_wp*bore%dam_depth)//" um deep"
   end function bore_words

   !> Whether two bores are one and the same.
   pure logical function same_bore(a, b)
      type(bore_t), intent(in) :: a  !! one
      type(bore_t), intent(in) :: b  !! the other

      same_bore = a%is_round() .and. b%is_round()
      if (a%is_round() .or. b%is_round()) return
      if (a%lobes /= b%lobes .or. size(a%angle) /= size(b%angle)) return
      same_bore = .not. (any(abs([a%preload, a%offset, a%start] - [b%preload, b%offset, b%start]) > 0.0_wp) .or. &
         any(abs([a%dam_start, a%dam_arc, a%dam_depth, a%dam_length] - [b%dam_start, b%dam_arc, b%dam_depth, b%dam_length]) &
             > 0.0_wp) .or. any(abs([a%angle - b%angle, a%depth - b%depth]) > 0.0_wp))
   end function same_bore

   !> Whether nothing is added to the gap.
   pure logical function is_round(self)
      class(bore_t), intent(in) :: self  !! the bore

      is_round = .not. (self%lobes > 0 .and. self%preload > 0.0_wp .or. self%dam_depth > 0.0_wp)
      if (allocated(self%depth)) is_round = is_round .and. .not. any(self%depth > 0.0_wp)
   end function is_round

   !> G without the dam, and in each lobe its continuation.
   pure real(wp) function depth_at(self, theta, of, per_clearance) result(g)
      class(bore_t), intent(in) :: self          !! the bore
      real(wp), intent(in) :: theta              !! where [rad]
      real(wp), intent(in) :: of                 !! an angle in the lobe that counts [rad]
      real(wp), intent(in) :: per_clearance      !! 1/c [1/m]

      real(wp) :: share, turned
      integer :: k, n, next

      g = 0.0_wp
      if (self%lobes > 0) then
         g = self%preload/(1.0_wp - self%preload)*2.0_wp*sin(0.5_wp*(theta - thinnest(self, of)))**2
      else if (size(self%angle) > 0) then
         n = size(self%angle)
         turned = self%angle(1) + modulo(theta - self%angle(1), two_pi)
         k = count(self%angle <= turned)
         next = modulo(k, n) + 1
         share = (turned - self%angle(k))/(self%angle(next) - self%angle(k) + merge(two_pi, 0.0_wp, next == 1))
         g = per_clearance*((1.0_wp - share)*self%depth(k) + share*self%depth(next))
      end if
   end function depth_at

   !> Where the gap of the lobe of an angle is smallest [rad].
   pure real(wp) function thinnest(self, of)
      class(bore_t), intent(in) :: self  !! the bore
      real(wp), intent(in) :: of         !! an angle in the lobe [rad]

      associate (arc => two_pi/self%lobes)
         thinnest = self%start + arc*(floor((of - self%start)/arc) + self%offset)
      end associate
   end function thinnest

   !> Whether an angle lies in the arc of the dam.
   pure logical function in_dam(self, theta)
      class(bore_t), intent(in) :: self  !! the bore
      real(wp), intent(in) :: theta      !! the angle [rad]

      in_dam = self%dam_depth > 0.0_wp .and. modulo(theta - self%dam_start, two_pi) < self%dam_arc
   end function in_dam

   !> Angles where G jumps, or its slope: starts of lobes and both ends of the dam.
   pure function edges(self) result(angle)
      class(bore_t), intent(in) :: self      !! the bore
      real(wp), allocatable :: angle(:)      !! (n) angles, in no order [rad]

      integer :: k

      angle = [(self%start + two_pi*k/max(self%lobes, 1), k=0, self%lobes - 1)]
      if (self%dam_depth > 0.0_wp) angle = [angle, self%dam_start, self%dam_start + self%dam_arc]
   end function edges

   !> Smallest gap over c, of all round and over the length: at the ends of the arcs in which it is smooth, or where its slope is
   !> zero within one.
   pure real(wp) function min_gap(self, e, per_clearance) result(gap)
      class(bore_t), intent(in) :: self     !! the bore
      real(wp), intent(in) :: e(2)          !! (2) eccentricity, bearing's frame [1]
      real(wp), intent(in) :: per_clearance !! 1/c [1/m]

      real(wp) :: arc, first, last, middle, place, slope
      real(wp), allocatable :: start(:)
      integer :: k

      gap = huge(1.0_wp)
      start = [self%edges(), self%angle]
      do k = 1, size(start)
         first = start(k)
         arc = minval(modulo(start - first, two_pi), mask=modulo(start - first, two_pi) > 0.0_wp)
         if (size(start) == 1) arc = two_pi
         last = first + min(arc, two_pi)
         middle = 0.5_wp*(first + last)
         if (self%lobes > 0) then
            associate (c => self%preload/(1.0_wp - self%preload), u => thinnest(self, middle))
               place = atan2(c*sin(u) + e(2), c*cos(u) + e(1))
            end associate
         else
            slope = (self%depth_at(last, middle, per_clearance) - self%depth_at(first, middle, per_clearance))/(last - first)
            place = atan2(e(2), e(1)) - asin(max(-1.0_wp, min(1.0_wp, slope/max(norm2(e), tiny(1.0_wp)))))
         end if
         place = first + modulo(place - first, two_pi)
         if (place > last) place = first
         gap = min(gap, gap_at(first), gap_at(place), gap_at(last))
      end do

   contains

      !> The gap at an angle of the arc.
      pure real(wp) function gap_at(theta)
         real(wp), intent(in) :: theta  !! the angle [rad]

         gap_at = 1.0_wp + self%depth_at(theta, middle, per_clearance) - e(1)*cos(theta) - e(2)*sin(theta)
         if (self%in_dam(middle) .and. .not. self%dam_length < 1.0_wp) gap_at = gap_at + per_clearance*self%dam_depth
      end function gap_at

   end function min_gap

end module bore_profile
