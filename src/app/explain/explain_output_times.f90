!> What `gudgeon explain` says of instants at which functions of time are not smooth, and of the maximum step.
module explain_output_times
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_set_halting_mode, ieee_set_status, ieee_status_type, ieee_usual
   use console, only: say
   use output_times, only: watched_t
   use kinds, only: wp
   use integrator_controls, only: onset_words
   use load, only: loaded_t
   use root_scan, only: place_t
   use scene, only: analysis_dynamic, table_t
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: explain_output_times_of

   integer, parameter :: n_shown = 6             !! instants that are named, of one cell
   integer, parameter :: most_counted = 100000   !! instants that are counted

contains

   !> Instants by cell of the deck, paces, and the limit that is in force.
   subroutine explain_output_times_of(loaded)
      type(loaded_t), intent(in) :: loaded   !! the deck

      type(ieee_status_type) :: status
      type(watched_t) :: cell
      character(:), allocatable :: onset
      real(wp) :: fixed, maximum
      integer :: k

      if (loaded%scene%analysis /= analysis_dynamic) return
      associate (controls => loaded%scene%settings%integration%controls)
         fixed = controls%fixed_step
         maximum = controls%maximum_step
         onset = trim(onset_words(controls%onset))
      end associate
      call say("")
      call say("time points, where steps end, and maximum step")
      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      do k = 1, loaded%plan%output_times%n
         cell = loaded%plan%output_times%cells(k)
         call explain_places(cell)
         call explain_rates(cell)
      end do
      call ieee_set_status(status)
      do k = 1, size(loaded%scene%forces)
         call explain_observables(loaded%scene%forces(k))
      end do
      do k = 1, loaded%plan%output_times%samples%n
         call say("state equations are sampled every "//real_text(loaded%plan%output_times%samples%every(k), 6)// &
                  " s, where steps end", 2)
      end do
      if (all([(size(loaded%plan%output_times%cells(k)%scans) == 0, k=1, loaded%plan%output_times%n)])) then
         call say("all functions of time are smooth", 2)
      else
         call say("steps end at these times, and the integrator restarts there", 2)
      end if
      if (fixed > 0.0_wp) then
         call say("fixed steps of "//real_text(fixed, 6)//" s: shorter changes may be missed", 2)
      else if (maximum > 0.0_wp) then
         call say("maximum step "//real_text(maximum, 6)//" s (maximum_step): shorter changes may be missed", 2)
      else
         if (loaded%plan%output_times%paces) call say("the step is limited by the functions of time listed above", 2)
         if (loaded%system%clearance_joints%n > 0) then
            call say("the step is limited to a quarter revolution of any body with contacts", 2)
         end if
         call say("the error tolerance determines the step", 2)
      end if
      if (loaded%system%clearance_joints%n == 0) return
      if (onset == "located") then
         call say("contact detection: 8 points per step, and at least once per output interval", 2)
      else
         call say("contact detection: at the ends of steps only (contact_onset = "//onset//"); the run may miss a contact "// &
            "shorter "// &
                  "than a step, and then warns; reduce maximum_step to avoid this", 2)
      end if
   end subroutine explain_output_times_of

   !> What the loads of a table see of the motion.
   subroutine explain_observables(table)
      type(table_t), intent(in) :: table   !! rows of a kind

      character(:), allocatable :: words
      integer :: c, i, m

      do i = 1, size(table%items)
         do c = 1, size(table%info%columns)
            if (.not. table%info%columns(c)%sees_motion) cycle
            associate (value => table%items(i)%values(c))
               if (.not. allocated(value%expression)) cycle
               if (.not. allocated(value%expression%observables)) cycle
               words = ""
               do m = 1, size(value%expression%observables)
                  words = words//" "//value%expression%observables(m)%word
               end do
               call say(table%items(i)%name//"."//table%info%columns(c)%name//" depends on"//words//"; step-size control " &
                        //"handles kinks in these", 2)
            end associate
         end do
      end do
   end subroutine explain_observables

   !> The instants of a cell.
   subroutine explain_places(cell)
      type(watched_t), intent(inout) :: cell   !! the cell; its searches are used up

      type(place_t) :: next(size(cell%scans))
      character(:), allocatable :: words
      real(wp) :: t
      integer :: k, n

      if (size(next) == 0) return
      words = ""
      n = 0
      do k = 1, size(next)
         call cell%scans(k)%next(next(k))
      end do
      do
         t = minval(next%at)
         if (t >= huge(t) .or. n == most_counted) exit
         n = n + 1
         if (n <= n_shown) words = words//" "//real_text(t, 9)
         do k = 1, size(next)
            do while (next(k)%at <= t)
               call cell%scans(k)%next(next(k))
            end do
         end do
      end do
      if (n == 0) then
         call say(cell%name//": smooth", 2)
      else if (n <= n_shown) then
         call say(cell%name//": not smooth at t ="//words//" s", 2)
      else if (n == most_counted) then
         call say(cell%name//": not smooth at more than "//to_text(n)//" times, t ="//words//" ... s", 2)
      else
         call say(cell%name//": not smooth at "//to_text(n)//" times, t ="//words//" ... s", 2)
      end if
   end subroutine explain_places

   !> The shortest characteristic rate of a cell.
   subroutine explain_rates(cell)
      type(watched_t), intent(inout) :: cell   !! the cell; its search is used up

      real(wp) :: at, pace

      if (cell%pace%is_calm) return
      call cell%pace%shortest(pace, at)
      if (pace >= huge(pace)) return
      call say(cell%name//": maximum step "//real_text(pace, 3)//" s near t = "//real_text(at, 6)//" s, its fastest change", 2)
   end subroutine explain_rates

end module explain_output_times
