!> Histories of the runs of a sweep that kept its channels, thinned for a page: from /channels of sweep.h5.
!>
!> The window of a run is cut into equal parts. Of each part its minimum and maximum stay, between which no peak is lost, and the
!> values at its ends, linear between two rows. Channels are taken in the order of the file, as many as a page has space for.
module kept_histories
   use errors, only: error_t, exit_file, set_error
   use hdf5, only: h5fclose_f, h5gclose_f, h5gopen_f, h5lexists_f, hid_t
   use hdf5_calls, only: open_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: not_a_number, wp
   use run_history, only: read_histories
   use series, only: history_t, series_t
   use text, only: append_text, text_t, to_text
   implicit none (type, external)
   private
   public :: kept_histories_t, n_part, no_histories, read_kept

   integer, parameter :: n_part = 200        !! parts of a window
   integer, parameter :: most_curves = 500   !! channels times runs of a page

   !> The histories.
   type :: kept_histories_t
      type(text_t), allocatable :: names(:)        !! (n) channels
      type(text_t), allocatable :: units(:)        !! (n) their SI units
      integer, allocatable :: runs(:)              !! (m) numbers of the runs
      real(wp), allocatable :: windows(:, :)       !! (2, m) first and last time [s]
      real(wp), allocatable :: values(:, :, :)     !! (n_part + 1, n, m) at the ends of parts; NaN: none [any]
      real(wp), allocatable :: low(:, :, :)        !! (n_part, n, m) minimum of a part; NaN: none [any]
      real(wp), allocatable :: high(:, :, :)       !! (n_part, n, m) maximum [any]
      character(:), allocatable :: note            !! what is left out; blank: nothing
   end type kept_histories_t

contains

   !> None.
   subroutine no_histories(list)
      type(kept_histories_t), intent(out) :: list   !! empty

      allocate (list%names(0), list%units(0), list%runs(0), list%windows(2, 0), list%values(n_part + 1, 0, 0))
      allocate (list%low(n_part, 0, 0), list%high(n_part, 0, 0))
      list%note = ""
   end subroutine no_histories

   !> Read them.
   subroutine read_kept(path, n_run, list, error)
      character(*), intent(in) :: path                     !! of sweep.h5
      integer, intent(in) :: n_run                         !! runs of the sweep
      type(kept_histories_t), intent(out) :: list          !! thinned
      type(error_t), allocatable, intent(out) :: error     !! the file cannot be read

      type(history_t) :: history
      integer(hid_t) :: file, group
      integer, allocatable :: owners(:)
      integer :: closed, i, k, n, n_channel, status

      call no_histories(list)
      status = 0
      call open_file(path, file, status)
      if (status < 0) call set_error(error, exit_file, "cannot read '"//path//"'")
      if (allocated(error)) return
      call find_runs(file, n_run, owners)
      n = 0
      do k = 1, size(owners)
         call h5gopen_f(file, "channels/"//to_text(owners(k)), group, status)
         if (status < 0) exit
         call read_histories(group, history, status)
         call h5gclose_f(group, closed)
         if (status < 0) exit
         if (size(history%time) < 2) cycle
         if (.not. history%time(size(history%time)) > history%time(1)) cycle
         if (n == 0) then
            n_channel = min(size(history%list), most_curves/size(owners))
            call start_list()
         end if
         n = n + 1
         list%runs(n) = owners(k)
         list%windows(:, n) = [history%time(1), history%time(size(history%time))]
         do i = 1, size(list%names)
            call take(history, list%names(i)%s, list%values(:, i, n), list%low(:, i, n), list%high(:, i, n))
         end do
      end do
      call h5fclose_f(file, closed)
      if (status < 0) call set_error(error, exit_file, "cannot read the channels of '"//path//"': the file is corrupt")
      list%runs = list%runs(:n)

   contains

      !> Names and units of the channels, as the first run has them, and space for their values.
      subroutine start_list()
         do i = 1, n_channel
            call append_text(list%names, history%list(i)%name)
            call append_text(list%units, history%list(i)%unit)
         end do
         if (n_channel < size(history%list)) then
            list%note = "Histories of "//to_text(n_channel)//" of "//to_text(size(history%list))// &
                        " channels, so that the page stays below 5 MB; all are in sweep.h5. "
         end if
         deallocate (list%runs, list%windows, list%values, list%low, list%high)
         allocate (list%runs(size(owners)), list%windows(2, size(owners)), list%values(n_part + 1, n_channel, size(owners)))
         allocate (list%low(n_part, n_channel, size(owners)), list%high(n_part, n_channel, size(owners)))
      end subroutine start_list

   end subroutine read_kept

   !> Runs whose channels are in the file.
   subroutine find_runs(file, n_run, owners)
      integer(hid_t), intent(in) :: file                   !! the file
      integer, intent(in) :: n_run                         !! runs of the sweep
      integer, allocatable, intent(out) :: owners(:)       !! (m) numbers of runs

      integer :: code, k
      logical :: is_there(n_run)

      is_there = .false.
      call h5lexists_f(file, "channels", is_there(1), code)
      if (code >= 0 .and. is_there(1)) then
         do k = 1, n_run
            call h5lexists_f(file, "channels/"//to_text(k), is_there(k), code)
            if (code < 0) is_there(k) = .false.
         end do
      end if
      owners = pack([(k, k=1, n_run)], is_there)
   end subroutine find_runs

   !> One channel of a run; NaN where the run does not have it.
   subroutine take(history, name, values, low, high)
      type(history_t), intent(in) :: history    !! of the run
      character(*), intent(in) :: name          !! of the channel
      real(wp), intent(out) :: values(:)        !! (n_part + 1) at the ends of the parts [any]
      real(wp), intent(out) :: low(:)           !! (n_part) minima [any]
      real(wp), intent(out) :: high(:)          !! (n_part) maxima [any]

      integer :: i

      values = not_a_number()
      low = not_a_number()
      high = not_a_number()
      do i = 1, size(history%list)
         if (history%list(i)%name == name) call thin(history%time, history%list(i), values, low, high)
      end do
   end subroutine take

   !> Values at the ends of equal parts of the window, and extremes of the rows within and of these values.
   subroutine thin(time, series, values, low, high)
      real(wp), intent(in) :: time(:)           !! (rows) increasing [s]
      type(series_t), intent(in) :: series      !! (rows) the channel
      real(wp), intent(out) :: values(:)        !! (n_part + 1) at the ends of the parts [any]
      real(wp), intent(inout) :: low(:)         !! (n_part) minima, NaN before [any]
      real(wp), intent(inout) :: high(:)        !! (n_part) maxima, NaN before [any]

      real(wp) :: t, w, width
      integer :: k, r

      width = (time(size(time)) - time(1))/real(n_part, wp)
      r = 1
      do k = 1, n_part + 1
         t = time(1) + width*real(k - 1, wp)
         do while (r < size(time) - 1)
            if (time(r + 1) > t) exit
            r = r + 1
         end do
         w = 0.0_wp
         if (time(r + 1) > time(r)) w = min(1.0_wp, (t - time(r))/(time(r + 1) - time(r)))
         if (series%is_state .or. series%turn > 0.0_wp) w = real(int(w), wp)   ! it jumps between rows
         values(k) = series%x(r)
         if (w > 0.0_wp) values(k) = (1.0_wp - w)*series%x(r) + w*series%x(r + 1)
         if (k > 1) call widen(k - 1, values(k))
         if (k <= n_part) call widen(k, values(k))
      end do
      do r = 1, size(time)
         call widen(min(n_part, 1 + int((time(r) - time(1))/width)), series%x(r))
      end do

   contains

      !> Take a value into a part.
      subroutine widen(part, x)
         integer, intent(in) :: part    !! number of the part
         real(wp), intent(in) :: x      !! the value [any]

         if (ieee_is_nan(x)) return
         if (ieee_is_nan(low(part))) then
            low(part) = x
            high(part) = x
         end if
         low(part) = min(low(part), x)
         high(part) = max(high(part), x)
      end subroutine widen

   end subroutine thin

end module kept_histories
