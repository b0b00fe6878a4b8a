!> What the surfaces of clearance joints lose in a run, step by step, cell by cell.
!>
!> A step takes from each surface the volume  dV = kappa dw,  with the driving work dw by the quadrature of the state, with the
!> order of the method, and kappa the mean of the coefficient over the step:
!>
!> kappa = sum_g a_g P_g kappa_g / sum_g a_g P_g   over Gauss's points g of the interpolant, a_g their weights, P_g the power
!>
!> It is shared out over the cells as a_g P_g kappa_g is. Each point stands for the part a_g of the step, in which its arc sweeps
!> along the surface (`wear_arc`). All weights are positive, so that no cell loses less than nothing; and without running-in and
!> threshold the volume is the coefficient times the quadrature, whatever the method and the shares.
!> A quadrature that is negative, by round-off, is booked with the next step.
!>
!> Source: this program. Limits: shares are as good as the interpolant; the geometry of contact is that of the start.
module wear_monitor
   use archive, only: archive_t
   use gauss_points, only: gauss_places, gauss_weights, n_gauss
   use integrator, only: integrator_t
   use kinds, only: pi, wp
   use mechanism, only: mechanism_t
   use wear_arc, only: add_swept_arc, add_swept_points
   use wear_contact, only: wear_contact_t
   use surfaces, only: surfaces_t
   use wear_loads, only: wear_loads_t
   use wear_law, only: n_side, of_bearing, of_journal, side_names, wear_law_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: new_wear_monitor, wear_monitor_t

   real(wp), parameter :: ends(0:n_gauss) = [0.0_wp, gauss_weights(1), 0.5_wp, 1.0_wp - gauss_weights(1), 1.0_wp]
      !! parts of a stretch that Gauss's points stand for [1]

   real(wp), parameter :: sweep = 4.0_wp       !! cells that the arc passes in a stretch, at most [1]
   integer, parameter :: most_stretches = 400  !! of a step
   real(wp), parameter :: narrowest = 1.0e-9_wp   !! arc of surfaces that just touch [rad]

   !> A contact whose surfaces wear.
   type :: worn_contact_t
      integer :: slot = 0                          !! its set
      integer :: contact = 0                       !! its number there
      real(wp) :: distance = 0.0_wp                !! that it has slid [m]
      real(wp) :: owed = 0.0_wp                    !! driving work that is not booked yet, not positive [J]
      real(wp), allocatable :: volume(:, :)        !! (cells, 2) what bearing and journal have lost [m^3]
      type(wear_loads_t) :: loads                  !! under which loads, where wear is counted from some time on
   end type worn_contact_t

   !> What a contact does at a point of a step.
   type :: sample_t
      type(wear_contact_t) :: wear                !! force, sliding and the arc that wears
      real(wp) :: time = 0.0_wp                   !! that it stands for [s]
      real(wp) :: weight = 0.0_wp                 !! the same times the power [J]
      real(wp) :: from = 0.0_wp, to = 0.0_wp      !! start and end of what it stands for, from its own time [s]
      real(wp) :: kappa(n_side) = 0.0_wp          !! (2) coefficients of bearing and journal there [m^2/N]
   end type sample_t

   !> All of them.
   type :: wear_monitor_t
      real(wp) :: from = -huge(1.0_wp)                !! time from which on wear is counted [s]
      type(worn_contact_t), allocatable :: worn(:)    !! (any) contacts whose surfaces wear
      type(sample_t), allocatable, private :: samples(:)   !! (any) scratch
      real(wp), allocatable, private :: y(:)          !! (n) scratch state [any]
   contains
      procedure :: after_step
      procedure :: add_surfaces
      procedure :: save => monitor_save
      procedure :: load => monitor_load
   end type wear_monitor_t

contains

   !> The contacts of a system, with what their surfaces have lost at the start.
   subroutine new_wear_monitor(system, monitor)
      type(mechanism_t), intent(in) :: system        !! the system
      type(wear_monitor_t), intent(out) :: monitor   !! the monitor

      integer :: i, item, k, m

      allocate (monitor%worn(0), monitor%samples(n_gauss), monitor%y(merge(system%n, 0, system%n_wear > 0)))
      if (system%n_wear == 0) return
      deallocate (monitor%worn)
      allocate (monitor%worn(sum([(merge(system%clearance_joints%sets(k)%set%n_contact, 0, &
                                         allocated(system%clearance_joints%sets(k)%set%laws%wear)), &
                                   k=1, size(system%clearance_joints%sets))])))
      m = 0
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (.not. allocated(set%laws%wear)) cycle
            do i = 1, set%n_contact
               m = m + 1
               monitor%worn(m)%slot = k
               monitor%worn(m)%contact = i
               allocate (monitor%worn(m)%volume(nint(set%laws%wear%cells), n_side), source=0.0_wp)
               item = set%item_of(i)
               if (.not. allocated(set%items%pairs(item)%worn)) cycle
               associate (profiles => set%items%pairs(item)%worn)
                  if (.not. profiles%hole%is_round()) monitor%worn(m)%volume(:, of_bearing) = profiles%hole%volume
                  if (.not. profiles%pin%is_round()) monitor%worn(m)%volume(:, of_journal) = profiles%pin%volume
                  monitor%worn(m)%distance = profiles%distance
               end associate
            end do
         end associate
      end do
   end subroutine new_wear_monitor

   !> What the last step took. The system comes back to the end of the step.
   subroutine after_step(self, system, method)
      class(wear_monitor_t), intent(inout) :: self    !! the monitor
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method    !! the integrator, after a step

      integer :: m
      logical :: has_moved

      has_moved = .false.
      if (.not. method%t > self%from) return
      do m = 1, size(self%worn)
         associate (worn => self%worn(m), set => system%clearance_joints%sets(self%worn(m)%slot)%set)
            if (.not. set%contact(worn%contact)%is_touching) cycle
            call wear_in_step(worn, max((self%from - method%step%t0)/method%step%h, 0.0_wp), self%from > -huge(1.0_wp), &
                              self%samples, self%y, system, method)
            has_moved = .true.
         end associate
      end do
      if (has_moved) call system%linkage%set_state(method%t, method%step%y1, method%step%f1)
   end subroutine after_step

   !> What it took of the surfaces of a contact.
   subroutine wear_in_step(worn, first, keeps_loads, samples, y, system, method)
      type(worn_contact_t), intent(inout) :: worn                     !! the contact
      real(wp), intent(in) :: first                                   !! part of the step that is not counted [1]
      logical, intent(in) :: keeps_loads                              !! the loads are kept
      type(sample_t), allocatable, intent(inout) :: samples(:)        !! (any) scratch, grown
      real(wp), intent(inout), contiguous :: y(:)                     !! (n) scratch state [any]
      type(mechanism_t), intent(inout) :: system                      !! the system
      class(integrator_t), intent(inout) :: method                    !! the integrator, after a step

      real(wp) :: lost(n_gauss*most_stretches, n_side), volume, work
      integer :: k, n, place, side

      associate (set => system%clearance_joints%sets(worn%slot)%set, h => method%step%h)
         place = system%place_of_wear(set%before%contacts + worn%contact)
         work = worn%owed + method%step%y1(place) - method%step%y0(place)
         if (first > 0.0_wp) then
            call method%within(system, first, y)
            work = method%step%y1(place) - y(place)
         end if
         worn%owed = min(work, 0.0_wp)
         n = 1
         call take_samples(worn, first, n, samples, y, system, method)
         do k = 1, n_gauss
            n = max(n, ceiling(maxval(abs(samples(k)%wear%turn))*h*size(worn%volume, 1)/(2.0_wp*pi*sweep)))
         end do
         n = min(n, most_stretches)
         if (n > 1) call take_samples(worn, first, n, samples, y, system, method)
         n = n*n_gauss
         if (.not. sum(samples(:n)%weight) > 0.0_wp) samples(:n)%weight = samples(:n)%time
         lost(:n, :) = 0.0_wp
         do side = 1, n_side
            associate (shares => samples(:n)%weight*samples(:n)%kappa(side))
               if (.not. (work > 0.0_wp .and. sum(shares) > 0.0_wp)) cycle
               volume = work*sum(shares)/sum(samples(:n)%weight)
               lost(:n, side) = volume*shares/sum(shares)
               do k = 1, n
                  if (shares(k) > 0.0_wp) call add_shares(samples(k), side, lost(k, side), worn%volume(:, side))
               end do
            end associate
         end do
         worn%distance = worn%distance + sum(samples(:n)%time*samples(:n)%wear%speed)
         if (.not. keeps_loads) return
         do k = 1, n
            call worn%loads%add(samples(k)%wear, lost(k, :))
         end do
      end associate
   end subroutine wear_in_step

   !> Share out what a point of a step takes from a surface.
   pure subroutine add_shares(sample, side, volume, cells)
      type(sample_t), intent(in) :: sample         !! the point
      integer, intent(in) :: side                  !! the surface
      real(wp), intent(in) :: volume               !! what is taken [m^3]
      real(wp), intent(inout) :: cells(:)          !! (cells) added to [m^3]

      associate (wear => sample%wear, by => sample%wear%turn(side)*[sample%from, sample%to])
         if (.not. wear%is_worn) then
            call add_swept_arc(cells, wear%direction(side) + by(1), wear%direction(side) + by(2), wear%half_angle(side), volume)
            return
         end if
         associate (arc => wear%arc, n => wear%arc%n)
            if (side == of_bearing) then
               call add_swept_points(cells, arc%hole(:n), arc%width(:n), arc%d(:n)*arc%width(:n), by, volume)
            else
               call add_swept_points(cells, arc%pin(:n), arc%width(:n), arc%d(:n)*arc%width(:n), by, volume)
            end if
         end associate
      end associate
   end subroutine add_shares

   !> What a contact does at Gauss's points of stretches of a step, and its coefficients there.
   subroutine take_samples(worn, first, n, samples, y, system, method)
      type(worn_contact_t), intent(in) :: worn                        !! the contact
      real(wp), intent(in) :: first                                   !! part of the step that is not counted [1]
      integer, intent(in) :: n                                        !! stretches of the step
      type(sample_t), allocatable, intent(inout) :: samples(:)        !! (n_gauss n or more) samples, grown
      real(wp), intent(inout), contiguous :: y(:)                     !! (n) scratch state [any]
      type(mechanism_t), intent(inout) :: system                      !! the system
      class(integrator_t), intent(inout) :: method                    !! the integrator, after a step

      real(wp) :: distance, part, place
      integer :: g, item, k, m

      if (size(samples) < n*n_gauss) then
         deallocate (samples)
         allocate (samples(n*n_gauss))
      end if
      distance = worn%distance
      associate (set => system%clearance_joints%sets(worn%slot)%set, h => (1.0_wp - first)*method%step%h/n)
         item = set%item_of(worn%contact)
         do k = 1, n
            do g = 1, n_gauss
               m = n_gauss*(k - 1) + g
               associate (sample => samples(m))
                  place = first + (1.0_wp - first)*(k - 1 + gauss_places(g))/n
                  call method%within(system, place, y)
                  call system%linkage%set_motion(method%step%t0 + place*method%step%h, y)
                  call set%wear_at(worn%contact, system%linkage%motion, sample%wear)
                  sample%time = gauss_weights(g)*h
                  sample%weight = sample%time*sample%wear%power
                  sample%from = (ends(g - 1) - gauss_places(g))*h
                  sample%to = (ends(g) - gauss_places(g))*h
                  call find_worn_part(set%laws%wear, set%items%pairs(item), sample%wear, part)
                  sample%kappa = part*set%laws%wear%coefficients(distance - sample%from*sample%wear%speed)
                  distance = distance + sample%time*sample%wear%speed
               end associate
            end do
         end do
      end associate
   end subroutine take_samples

   !> Part of an arc that wears, which is cut to it.
   pure subroutine find_worn_part(law, pair, wear, part)
      class(wear_law_t), intent(in) :: law           !! the law
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(wear_contact_t), intent(inout) :: wear    !! the contact
      real(wp), intent(out) :: part                  !! of the driving work that wears, 0 to 1 [1]

      real(wp) :: worn_angle

      if (wear%is_worn) then
         part = 0.0_wp
         if (wear%arc%n == 0) return   ! apart: there may be no storage for points
         call law%worn_points(wear%force, pair%radius_i*pair%length, wear%arc%hole(:wear%arc%n), wear%direction(of_bearing), &
                              wear%arc%width(:wear%arc%n), wear%arc%d(:wear%arc%n), part)
         return
      end if
      wear%half_angle = max(wear%half_angle, narrowest)
      call law%worn_part(wear%force, pair%radius_i*pair%length, wear%half_angle(1), worn_angle, part)
      wear%half_angle = wear%half_angle*worn_angle/wear%half_angle(1)
   end subroutine find_worn_part

   !> Append the surfaces of a system.
   subroutine add_surfaces(self, system, surfaces)
      class(wear_monitor_t), intent(in) :: self                           !! the monitor
      type(mechanism_t), intent(in) :: system                             !! the system
      type(worn_surface_t), allocatable, intent(inout) :: surfaces(:)     !! (any) appended to, bearing and journal of each contact

      type(worn_surface_t) :: surface
      integer :: item, m, side

      do m = 1, size(self%worn)
         associate (worn => self%worn(m), set => system%clearance_joints%sets(self%worn(m)%slot)%set)
            item = set%item_of(worn%contact)
            surface%joint = set%names(item)%s
            surface%length = set%items%pairs(item)%length
            surface%distance = worn%distance
            do side = 1, n_side
               surface%side = trim(side_names(side))
               surface%is_hole = side == of_bearing
               surface%radius = merge(set%items%pairs(item)%radius_i, set%items%pairs(item)%radius_j, side == of_bearing)
               surface%volume = worn%volume(:, side)
               if (allocated(surface%loads)) deallocate (surface%loads)
               if (side == of_bearing) surface%loads = worn%loads%nodes()
               surfaces = [surfaces, surface]
            end do
         end associate
      end do
   end subroutine add_surfaces

   !> Write what the monitor remembers.
   subroutine monitor_save(self, archive)
      class(wear_monitor_t), intent(in) :: self   !! the monitor
      type(archive_t), intent(inout) :: archive   !! the checkpoint

      integer :: m, side

      do m = 1, size(self%worn)
         call archive%put([self%worn(m)%distance, self%worn(m)%owed])
         do side = 1, n_side
            call archive%put(self%worn(m)%volume(:, side))
         end do
      end do
   end subroutine monitor_save

   !> Read what the monitor remembers.
   subroutine monitor_load(self, archive)
      class(wear_monitor_t), intent(inout) :: self   !! the monitor
      type(archive_t), intent(inout) :: archive      !! the checkpoint

      integer :: k, m, side

      do m = 1, size(self%worn)
         call archive%get(self%worn(m)%distance)
         call archive%get(self%worn(m)%owed)
         do side = 1, n_side
            do k = 1, size(self%worn(m)%volume, 1)
               call archive%get(self%worn(m)%volume(k, side))
            end do
         end do
      end do
   end subroutine monitor_load

end module wear_monitor
