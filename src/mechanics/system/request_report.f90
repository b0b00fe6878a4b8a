!> What requests report: points, places, reactions at points, and expressions over channels.
module request_report
   use catalogue, only: bound_formula_t, catalogue_t
   use groups_of_catalogue, only: n_groups, group_contacts, group_motions, group_points, group_reactions, group_requests
   use kind_info, only: channel_t, kind_info_t
   use kinds, only: wp
   use magnitudes, only: add_magnitudes
   use mechanism, only: mechanism_t
   use reaction_at, only: find_reaction
   use readings, only: reading_plan_t, readings_t
   use requests, only: formula_t, motion_request_info, of_reaction_force, point_channels, reaction_info, requests_t, source_t
   use observed_motion, only: place_values
   use observable, only: place_t
   implicit none (type, external)
   private
   public :: add_requests, bind_requests, report_requests

contains

   !> Items and channels of requests, then the magnitudes of all vectors. Expressions over channels that this catalogue does not
   !> have are omitted.
   subroutine add_requests(requests, catalogue)
      type(requests_t), intent(in) :: requests         !! what is asked
      type(catalogue_t), intent(inout) :: catalogue    !! grows; all other items and groups are there

      integer :: k

      if (.not. allocated(requests%points)) then  ! a system that was not made from a deck
         call add_magnitudes(catalogue)
         return
      end if
      if (size(requests%points) > 0) call add(group_points, point_channels(), catalogue%offer%points)
      do k = 1, size(requests%points)
         call catalogue%add_item(group_points, requests%points(k)%s)
      end do
      if (size(requests%motions) > 0) call add(group_motions, motion_request_info(), catalogue%offer%motions)
      do k = 1, size(requests%motions)
         call catalogue%add_item(group_motions, requests%motions(k)%name)
      end do
      if (size(requests%reactions) > 0) call add(group_reactions, reaction_info(requests%is_spatial), catalogue%offer%reactions)
      do k = 1, size(requests%reactions)
         call catalogue%add_item(group_reactions, requests%reactions(k)%name)
      end do
      call add_magnitudes(catalogue)
      if (size(requests%formulas) > 0) call catalogue%add_item(group_requests, "request")
      allocate (catalogue%formulas(size(requests%formulas)))
      do k = 1, size(requests%formulas)
         call add_formula(requests%formulas(k), catalogue, catalogue%formulas(k))
      end do

   contains

      !> The channels of a sort of requests.
      subroutine add(item_group, info, offer)
         integer, intent(in) :: item_group                !! their group
         type(kind_info_t), intent(in) :: info      !! their channels
         type(readings_t), intent(inout) :: offer   !! what they report

         call catalogue%add_kind(item_group, info)
         call catalogue%list(item_group, info, offer)
      end subroutine add

   end subroutine add_requests

   !> A group for an expression, if all of its channels are there.
   subroutine add_formula(formula, catalogue, bound)
      type(formula_t), intent(in) :: formula           !! the expression
      type(catalogue_t), intent(inout) :: catalogue    !! grows
      type(bound_formula_t), intent(out) :: bound      !! the expression in it; without a group if it cannot be reported

      type(channel_t) :: channel
      integer :: k

      allocate (bound%source(3, size(formula%sources)))
      do k = 1, size(formula%sources)
         call find_source(formula%sources(k), catalogue, bound%source(:, k))
         if (bound%source(1, k) == 0) return
      end do
      channel%name = formula%name
      channel%unit = formula%unit
      channel%frame = "none"
      channel%help = formula%text
      call catalogue%add_group(group_requests, channel)
      bound%expression = formula%expression
      bound%group = catalogue%n_group
   end subroutine add_formula

   !> Group, component and item of a channel; zeros if the catalogue does not have it.
   pure subroutine find_source(source, catalogue, place)
      type(source_t), intent(in) :: source          !! the channel by its names
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      integer, intent(out) :: place(3)              !! (3) where it is

      integer :: k

      place = 0
      do k = 1, catalogue%item_groups(source%item_group)%n
         if (catalogue%item_groups(source%item_group)%names(k)%s /= source%item) cycle
         if (source%item_group == group_contacts) then
            if (catalogue%item_groups(source%item_group)%labels(k)%s /= source%label) cycle
         end if
         place = [catalogue%find_group(source%item_group, source%channel), source%component, k]
         return
      end do
   end subroutine find_source

   !> Bind what is requested of points, places and reactions, one by one.
   subroutine bind_requests(catalogue)
      type(catalogue_t), intent(inout) :: catalogue   !! its readings are set

      integer :: k

      associate (plan => catalogue%readings, offer => catalogue%offer, item_groups => catalogue%item_groups)
         call catalogue%bind(offer%points, plan%points, [(k, k=1, item_groups(group_points)%n)])
         call catalogue%bind(offer%motions, plan%motions, [(k, k=1, item_groups(group_motions)%n)])
         call catalogue%bind(offer%reactions, plan%reactions, [(k, k=1, item_groups(group_reactions)%n)])
      end associate
   end subroutine bind_requests

   !> Values of all that is bound. No allocation.
   subroutine report_requests(system, t, plan, values)
      type(mechanism_t), intent(in) :: system        !! the system at the state, with reactions where they are read
      real(wp), intent(in) :: t                      !! time [s]
      type(reading_plan_t), intent(in) :: plan       !! what is read
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      real(wp) :: force(3), moment(3)
      integer :: m

      do m = 1, plan%points%n
         call report_place(system, system%requests%places(plan%points%of(m)%item), plan%points, m, values)
      end do
      do m = 1, plan%motions%n
         call report_place(system, system%requests%motions(plan%motions%of(m)%item)%place, plan%motions, m, values)
      end do
      do m = 1, plan%reactions%n
         associate (at => plan%reactions%of(m)%place, width => plan%reactions%of(m)%width)
            call find_reaction(system, t, system%requests%reactions(plan%reactions%of(m)%item), force, moment)
            if (plan%reactions%of(m)%code == of_reaction_force) then
               values(at + 1:at + width) = force(:width)
            else
               values(at + 1:at + width) = moment(merge(3, 1, width == 1):)
            end if
         end associate
      end do
   end subroutine report_requests

   !> Value of one quantity of a place.
   subroutine report_place(system, place, readings, m, values)
      type(mechanism_t), intent(in) :: system        !! the system at the state
      type(place_t), intent(in) :: place             !! the place
      type(readings_t), intent(in) :: readings       !! what is read
      integer, intent(in) :: m                       !! number of the reading
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      real(wp) :: x(3)

      x = place_values(place, readings%of(m)%code, system%linkage%motion)
      associate (at => readings%of(m)%place, width => readings%of(m)%width)
         values(at + 1:at + width) = x(:width)
      end associate
   end subroutine report_place

end module request_report
