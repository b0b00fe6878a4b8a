!> The gnuplot script of a figure. It reads the `.dat` files beside its folder by column number and
!> writes the picture next to itself, so that it can be edited and run again there.
module figure_script
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use display_units, only: choose_unit, display_unit_t
   use figure_data, only: curve_t, is_visible
   use figure_words, only: figure_orbit, figure_portrait, figure_t
   use kinds, only: wp
   use orbit_script, only: orbit_lines
   use plot_text, only: quoted
   use script_parts, only: axes_t, colours, key_below, largest_y, preamble, source
   use text, only: real_text, replace
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: figure_text

   real(wp), parameter :: peak_ratio = 20.0_wp      !! beyond this the ideal curve gets a panel of its own [1]
   real(wp), parameter :: flat_ratio = 1.0e-9_wp    !! an ideal curve this flat needs none [1]
   real(wp), parameter :: zoom_margin = 0.6_wp      !! beyond the ideal curve in that panel, of its span [1]
   integer, parameter :: most_overlaid = 3          !! more curves are drawn without those of the ideal twin
contains

   !> The whole script of a figure, blank if there is nothing to draw.
   function figure_text(figure, catalogue, title, curves, ideal) result(script)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      character(*), intent(in) :: title           !! of the scene, any text
      type(curve_t), intent(in) :: curves(:)      !! (n) curves of the run
      type(curve_t), intent(in) :: ideal(:)       !! (m) curves of the ideal twin, perhaps none
      character(:), allocatable :: script         !! lines for gnuplot

      type(curve_t), allocatable :: beside(:), drawn(:)
      type(buffer_t) :: lines

      script = ""
      if (size(curves) == 0) return
      select case (figure%kind)
      case (figure_orbit)
         if (size(curves) < 2) return
         call orbit_lines(lines, figure, catalogue, title, curves)
      case default
         drawn = picked(curves, is_visible(curves))
         beside = picked(ideal, is_matching(ideal, drawn) .and. size(drawn) <= most_overlaid)
         call curve_lines(lines, figure, catalogue, title, drawn, beside)
      end select
      script = lines%get()
   end function figure_text

   !> Which curves of the twin belong to those that are drawn.
   pure function is_matching(ideal, drawn) result(wanted)
      type(curve_t), intent(in) :: ideal(:)   !! (m) curves of the twin
      type(curve_t), intent(in) :: drawn(:)   !! (n) curves of the run
      logical :: wanted(size(ideal))          !! (m) whether one has the same name

      integer :: i, k

      wanted = .false.
      do k = 1, size(ideal)
         do i = 1, size(drawn)
            if (ideal(k)%name == drawn(i)%name) wanted(k) = .true.
         end do
      end do
   end function is_matching

   !> Some of a list of curves.
   pure function picked(curves, wanted) result(some)
      type(curve_t), intent(in) :: curves(:)     !! (n) curves
      logical, intent(in) :: wanted(:)           !! (n) whether to take it
      type(curve_t), allocatable :: some(:)      !! (m) those taken

      integer :: k, m

      allocate (some(count(wanted)))
      m = 0
      do k = 1, size(curves)
         if (.not. wanted(k)) cycle
         m = m + 1
         some(m) = curves(k)
      end do
   end function picked

   !> Time histories and portraits.
   subroutine curve_lines(lines, figure, catalogue, title, curves, ideal)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      character(*), intent(in) :: title           !! of the scene, any text
      type(curve_t), intent(in) :: curves(:)      !! (n) curves of the run
      type(curve_t), intent(in) :: ideal(:)       !! (m) curves of the twin
      type(axes_t) :: axes
      real(wp) :: low, high, span
      integer :: last
      logical :: is_portrait, two_panels

      is_portrait = figure%kind == figure_portrait
      last = size(figure%scalars)
      associate (groups => catalogue%groups)
         axes%x = choose_unit("s", curves(1)%x_range(2) - curves(1)%x_range(1))
         if (is_portrait) axes%x = choose_unit(groups(figure%scalars(1)%group)%channel%unit, largest_x(curves))
         axes%y = choose_unit(groups(figure%scalars(last)%group)%channel%unit, largest_y(curves))
      end associate
      two_panels = needs_zoom(curves, ideal)
      call preamble(lines, figure%name, 1200, merge(1000, 800, two_panels))
      if (two_panels) call lines%line("set lmargin at screen 0.12; set rmargin at screen 0.965")
      call lines%line("set ylabel "//quoted(ordinate_label(figure, catalogue, axes%y)))
      if (is_portrait) then
         call lines%line("set xlabel "//quoted(channel_label(figure, catalogue, 1, axes%x)))
         call lines%line("set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.05")
      else
         call lines%line("set xlabel "//quoted("time ["//axes%x%symbol//"]"))
         call lines%line("set autoscale xfix")
         call lines%line("set offsets 0, 0, graph 0.05, "//trim(merge("0         ", "graph 0.05", stands_on_zero(curves))))
      end if
      if (.not. two_panels) then
         call lines%line("set title "//quoted(title)//" font ',17'")
         call plot_lines(lines, figure, axes, curves, ideal)
      else
         call lines%line("set multiplot layout 2,1 title "//quoted(title)//" font ',17'")
         call lines%line("unset key")
         call plot_lines(lines, figure, axes, curves, ideal)
         low = minval(ideal%y_range(1))
         high = maxval(ideal%y_range(2))
         span = high - low
         call lines%line(key_below)
         call lines%line("set title 'the same on the scale of the ideal joints' font ',14'")
         call lines%line("set yrange ["//real_text(axes%y%factor*merge(0.0_wp, low - zoom_margin*span, &
                         stands_on_zero(curves) .and. low < zoom_margin*span), 9)//":"// &
                         real_text(axes%y%factor*(high + zoom_margin*span), 9)//"]")
         call plot_lines(lines, figure, axes, curves, ideal)
         call lines%line("unset multiplot")
      end if
      call lines%line("unset output")
   end subroutine curve_lines

   !> Whether nothing is negative and something is as good as zero: then zero is the lower edge.
   pure logical function stands_on_zero(curves)
      type(curve_t), intent(in) :: curves(:)  !! (n) curves of the run

      real(wp), parameter :: near = 0.05_wp  ! of the greatest value [1]
      real(wp) :: least

      least = minval(curves%y_range(1))
      stands_on_zero = least >= 0.0_wp .and. least < near*maxval(curves%y_range(2))
   end function stands_on_zero

   !> Whether the ideal curve would be a flat line beside the peaks of the run.
   pure logical function needs_zoom(curves, ideal)
      type(curve_t), intent(in) :: curves(:)  !! (n) curves of the run
      type(curve_t), intent(in) :: ideal(:)   !! (m) curves of the twin

      real(wp) :: span

      needs_zoom = .false.
      if (size(ideal) == 0) return
      span = maxval(ideal%y_range(2)) - minval(ideal%y_range(1))
      needs_zoom = largest_y(curves) > peak_ratio*largest_y(ideal) .and. span > flat_ratio*largest_y(curves)
   end function needs_zoom

   !> Greatest magnitude of the abscissas.
   pure real(wp) function largest_x(curves)
      type(curve_t), intent(in) :: curves(:)  !! (n) curves

      largest_x = max(abs(minval(curves%x_range(1))), abs(maxval(curves%x_range(2))))
   end function largest_x

   !> What stands beside the ordinate: the quantity if all curves have the same one.
   function ordinate_label(figure, catalogue, unit) result(label)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      type(display_unit_t), intent(in) :: unit    !! unit shown
      character(:), allocatable :: label          !! as `velocity [m/s]`

      integer :: k, last

      last = size(figure%scalars)
      if (figure%kind == figure_portrait) then
         label = channel_label(figure, catalogue, last, unit)
         return
      end if
      label = replace(catalogue%groups(figure%scalars(1)%group)%channel%name, "_", " ")
      do k = 2, last
         if (figure%scalars(k)%group == figure%scalars(1)%group) cycle
         label = ""
         if (catalogue%groups(figure%scalars(k)%group)%channel%unit == "J") label = "energy"
      end do
      if (len(unit%symbol) > 0) label = label//" ["//unit%symbol//"]"
   end function ordinate_label

   !> Name of a channel of a figure with the unit shown.
   function channel_label(figure, catalogue, k, unit) result(label)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      integer, intent(in) :: k                    !! number of the channel
      type(display_unit_t), intent(in) :: unit    !! unit shown
      character(:), allocatable :: label          !! as `slider.velocity.x [m/s]`

      label = scalar_name(catalogue, figure%scalars(k))
      if (len(unit%symbol) > 0) label = label//" ["//unit%symbol//"]"
   end function channel_label

   !> The plot command: the run's curves, then those of the twin over them.
   subroutine plot_lines(lines, figure, axes, curves, ideal)
      type(buffer_t), intent(inout) :: lines   !! the script
      type(figure_t), intent(in) :: figure     !! the figure
      type(axes_t), intent(in) :: axes         !! its scales
      type(curve_t), intent(in) :: curves(:)   !! (n) curves of the run
      type(curve_t), intent(in) :: ideal(:)    !! (m) curves of the twin

      character(:), allocatable :: name
      integer :: k

      do k = 1, size(curves)
         name = curves(k)%name
         if (figure%kind == figure_portrait) name = "with clearance"
         if (figure%kind == figure_portrait .and. size(ideal) == 0) name = ""
         call lines%add(merge("plot ", "     ", k == 1)//source(curves(k), axes)// &
                        " with lines linewidth 2 linecolor rgb '"//colours(mod(k - 1, size(colours)) + 1)//"'")
         if (len(name) > 0) then
            call lines%add(" title "//quoted(name))
         else
            call lines%add(" notitle")
         end if
         call lines%line(merge(", \", "   ", k < size(curves) .or. size(ideal) > 0))
      end do
      do k = 1, size(ideal)
         call lines%add("     "//source(ideal(k), axes)// &
                        merge(" with lines linewidth 1.6 linecolor rgb '#909090'                ", &
                              " with lines linewidth 1.2 dashtype (12,8) linecolor rgb '#101010'", &
                              figure%kind == figure_portrait))
         if (k == 1) then
            call lines%add(" title 'ideal joints'")
         else
            call lines%add(" notitle")
         end if
         call lines%line(merge(", \", "   ", k < size(ideal)))
      end do
   end subroutine plot_lines

end module figure_script
