!> The figures of a life: worn depth over cycles with its bands, and profiles, depth over angle, at some of the nodes.
!>
!> `life.dat` has a block for each worn surface: cycles, depth, ends of the 95 % interval of numerical errors, ends of the range by
!> the wear coefficient. `life_profiles.dat` has a block for each surface and profile: angle, depth.
module life_plots
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: pi, wp
   use life_results, only: life_t
   use life_spread, only: spread_of_measures
   use life_state, only: measure_depth, measure_volume
   use plot_text, only: quoted
   use script_parts, only: colours, preamble
   use text, only: append_text, exact_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: write_life_plots

   integer, parameter :: most_surfaces = 4    !! whose profiles are drawn
   integer, parameter :: most_profiles = 8    !! of a surface that are drawn

contains

   !> Write numbers and scripts into the folder of the figures.
   subroutine write_life_plots(folder, title, heading, life, names, error)
      character(*), intent(in) :: folder                       !! of the figures
      character(*), intent(in) :: title                        !! of the scene, any text
      character(*), intent(in) :: heading                      !! lines with `#`
      type(life_t), intent(in) :: life                         !! the life
      type(text_t), allocatable, intent(out) :: names(:)       !! (n) figures written
      type(error_t), allocatable, intent(out) :: error         !! a file cannot be written

      integer, allocatable :: list(:)

      allocate (names(0))
      list = worn_list(life)
      if (size(list) == 0 .or. life%last < 2) return
      call write_file(folder//"/life.dat", heading//depth_rows(life, list), error)
      if (.not. allocated(error)) call write_file(folder//"/life.gp", depth_script(life, list, title), error)
      if (allocated(error)) return
      call append_text(names, "life")
      list = list(:min(most_surfaces, size(list)))
      call write_file(folder//"/life_profiles.dat", heading//profile_rows(life, list), error)
      if (.not. allocated(error)) call write_file(folder//"/life_profiles.gp", profile_script(life, list, title), error)
      if (.not. allocated(error)) call append_text(names, "life_profiles")
   end subroutine write_life_plots

   !> Surfaces that have lost something.
   pure function worn_list(life) result(list)
      type(life_t), intent(in) :: life     !! the life
      integer, allocatable :: list(:)      !! (any) their numbers

      integer :: k

      list = pack([(k, k=1, size(life%state%surfaces))], life%nodes(life%last)%measures(measure_volume, :) > 0.0_wp)
   end function worn_list

   !> Depth over cycles.
   function depth_rows(life, list) result(text)
      type(life_t), intent(in) :: life     !! the life
      integer, intent(in) :: list(:)       !! (any) surfaces
      character(:), allocatable :: text    !! whole lines

      type(buffer_t) :: lines
      real(wp), allocatable :: half(:, :), high(:, :), low(:, :)
      integer :: i, j

      do i = 1, size(list)
         call lines%line("# cycles, depth_max[m], low[m], high[m], spread_low[m], spread_high[m] of "//name_of(life, list(i)))
         do j = 1, life%last
            half = life%nodes(j)%half()
            call spread_of_measures(life, j, low, high)
            where (.not. ieee_is_finite(high)) low = high  ! a band has both ends
            associate (depth => life%nodes(j)%measures(measure_depth, list(i)), error => half(measure_depth, list(i)))
               call lines%line(number_row([life%nodes(j)%cycles, depth, max(depth - error, 0.0_wp), depth + error, &
                                           low(measure_depth, list(i)), high(measure_depth, list(i))]))
            end associate
         end do
         call lines%line("")
         call lines%line("")
      end do
      text = lines%get()
   end function depth_rows

   !> Depth over cycles with its bands.
   function depth_script(life, list, title) result(script)
      type(life_t), intent(in) :: life     !! the life
      integer, intent(in) :: list(:)       !! (any) surfaces
      character(*), intent(in) :: title    !! of the scene, any text
      character(:), allocatable :: script  !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: unit
      character(:), allocatable :: colour
      integer :: i
      logical :: has_spread

      unit = choose_unit("m", maxval(life%nodes(life%last)%measures(measure_depth, :)))
      has_spread = any(life%plan%spreads > 1.0_wp)
      call preamble(lines, "life", 1200, 800)
      call lines%line("set title "//quoted(title)//" font ',17'")
      call lines%line("set xlabel 'cycles'; set rmargin 5")
      call lines%line("set ylabel "//quoted("maximum worn depth ["//unit%symbol//"]"))
      call lines%line("set format x '%g'; set yrange [0:*]; f = "//real_text(unit%factor, 9))
      call lines%line("set style fill noborder")
      do i = 1, size(list)
         colour = " linecolor rgb '"//colours(1 + modulo(i - 1, size(colours)))//"'"
         if (has_spread) then
            call lines%line(opening(i, 1)//"'life.dat' index "//to_text(i - 1)//" using 1:($5*f):($6*f) with filledcurves fill "// &
                            "transparent solid 0.15"//colour//" title "//quoted(name_of(life, list(i))// &
                                                                               ", 95 % by the wear coefficient")//", \")
         end if
         call lines%line(opening(i, merge(2, 1, has_spread))//"'life.dat' index "//to_text(i - 1)// &
                         " using 1:($3*f):($4*f) with filledcurves fill transparent solid 0.4"//colour//" title "// &
                         quoted(name_of(life, list(i))//", 95 % by numerical errors")//", \")
         call lines%line("     'life.dat' index "//to_text(i - 1)//" using 1:($2*f) with linespoints linewidth 2 pointtype 7 "// &
                         "pointsize 0.5"//colour//" title "//quoted(name_of(life, list(i)))// &
                         trim(merge(", \", "   ", i < size(list))))
      end do
      call lines%line("unset output")
      script = lines%get()

   contains

      !> What a line of the plot starts with.
      pure function opening(surface, entry) result(words)
         integer, intent(in) :: surface    !! number of the surface
         integer, intent(in) :: entry      !! number of its entry
         character(5) :: words             !! `plot `, or blanks

         words = merge("plot ", "     ", surface == 1 .and. entry == 1)
      end function opening

   end function depth_script

   !> Profiles at some nodes.
   function profile_rows(life, list) result(text)
      type(life_t), intent(in) :: life     !! the life
      integer, intent(in) :: list(:)       !! (any) surfaces
      character(:), allocatable :: text    !! whole lines

      type(buffer_t) :: lines
      type(worn_surface_t), allocatable :: surfaces(:)
      real(wp), allocatable :: depths(:)
      integer, allocatable :: nodes(:)
      integer :: c, i, j, n
      real(wp) :: angle

      nodes = drawn_nodes(life)
      do i = 1, size(list)
         do j = 1, size(nodes)
            surfaces = life%state%worn(life%nodes(nodes(j))%x)
            depths = surfaces(list(i))%depths()
            n = size(depths)
            call lines%line("# angle[rad], depth[m] of "//name_of(life, list(i))//" after "// &
                            exact_text(life%nodes(nodes(j))%cycles)//" cycles")
            do c = 1, n
               angle = surfaces(list(i))%angle(1 + modulo(c - 1 + n/2, n))
               call lines%line(number_row([angle - merge(2.0_wp*pi, 0.0_wp, c <= n - n/2), depths(1 + modulo(c - 1 + n/2, n))]))
            end do
            call lines%line("")
            call lines%line("")
         end do
      end do
      text = lines%get()
   end function profile_rows

   !> Depth over angle.
   function profile_script(life, list, title) result(script)
      type(life_t), intent(in) :: life     !! the life
      integer, intent(in) :: list(:)       !! (any) surfaces
      character(*), intent(in) :: title    !! of the scene, any text
      character(:), allocatable :: script  !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: unit
      integer, allocatable :: nodes(:)
      integer :: i, j

      nodes = drawn_nodes(life)
      call preamble(lines, "life_profiles", 1200, merge(800, 1500, size(list) == 1))
      call lines%line("set multiplot layout "//to_text(size(list))//",1 title "//quoted(title)//" font ',17'")
      call lines%line("set xlabel 'angle in the frame of the body [deg]'; set xrange [-180:180]; set xtics 45; set yrange [0:*]")
      call lines%line("set key right outside vertical Left reverse samplen 2 title 'after cycles'")
      do i = 1, size(list)
         unit = choose_unit("m", life%nodes(life%last)%measures(measure_depth, list(i)))
         call lines%line("set ylabel "//quoted("worn depth of "//name_of(life, list(i))//" ["//unit%symbol//"]"))
         do j = 1, size(nodes)
            call lines%line(merge("plot ", "     ", j == 1)//"'life_profiles.dat' index "// &
                            to_text((i - 1)*size(nodes) + j - 1)//" using ($1*180/pi):($2*"//real_text(unit%factor, 9)// &
                            ") with lines linewidth 2 linecolor rgb '"//colours(1 + modulo(j - 1, size(colours)))//"' title '"// &
                            real_text(life%nodes(nodes(j))%cycles, 3)//"'"//trim(merge(", \", "   ", j < size(nodes))))
         end do
      end do
      call lines%line("unset multiplot; unset output")
      script = lines%get()
   end function profile_script

   !> Nodes whose profiles are drawn: at equal steps of the depth.
   function drawn_nodes(life) result(list)
      type(life_t), intent(in) :: life          !! the life
      integer, allocatable :: list(:)           !! (any) their numbers

      real(wp) :: depths(life%last)
      integer :: j, k

      do j = 1, life%last
         depths(j) = maxval(life%nodes(j)%measures(measure_depth, :))
      end do
      list = [integer ::]
      do k = 1, most_profiles
         j = minloc(abs(depths - depths(life%last)*k/most_profiles), dim=1)
         if (size(list) > 0) then
            if (j == list(size(list))) cycle
         end if
         list = [list, j]
      end do
   end function drawn_nodes

   !> A surface as text.
   pure function name_of(life, k) result(name)
      type(life_t), intent(in) :: life          !! the life
      integer, intent(in) :: k                  !! its number
      character(:), allocatable :: name         !! joint and side

      name = life%state%surfaces(k)%joint//" "//life%state%surfaces(k)%side
   end function name_of

end module life_plots
