!> The results of a life as tables: its end, the surfaces there with their intervals, what each error adds, all jumps, profiles.
module life_tables
   use kinds, only: wp
   use life_results, only: life_t, node_t
   use life_spread, only: spread_of_measures
   use life_state, only: measure_arc, measure_depth, measure_names, measure_units, measure_volume, n_measure
   use result_table, only: in_csv, in_hdf5, result_table_t
   use text, only: text_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: table_of_budget, table_of_jumps, table_of_life, tables_of_life_profiles, table_of_surfaces_at_end

   integer, parameter :: most_profiles = 200   !! profiles in a file, the first and the last among them

contains

   !> Where the life ended.
   function table_of_life(life) result(table)
      type(life_t), intent(in) :: life         !! the life
      type(result_table_t) :: table            !! facts only

      real(wp) :: factor

      associate (node => life%nodes(life%last), plan => life%plan)
         factor = maxval(plan%spreads)
         call table%start("life", "life", 0, object="life")
         call table%fact("ended_by", life%reason)
         call table%fact("cycles", node%cycles)
         call table%fact("cycles_low", max(node%cycles - life%cycles_half, 0.0_wp))
         call table%fact("cycles_high", node%cycles + life%cycles_half)
         call table%fact("time", node%cycles*plan%cycle)
         call table%fact("time_low", max(node%cycles - life%cycles_half, 0.0_wp)*plan%cycle)
         call table%fact("time_high", (node%cycles + life%cycles_half)*plan%cycle)
         call table%fact("cycles_spread_low", merge(node%cycles, node%cycles/factor, life%ends_by_cycles))
         call table%fact("cycles_spread_high", merge(node%cycles, node%cycles*factor, life%ends_by_cycles))
         call table%fact("spread", factor)
         call table%fact("cycle", plan%cycle)
         call table%fact("jumps", life%last - 1)
         call table%fact("rejected", life%rejected)
         call table%fact("profiles", life%simulated)
         call table%fact("starts", plan%starts)
         call table%fact("tolerance", plan%tolerance)
      end associate
   end function table_of_life

   !> Measures of each surface at the end.
   function table_of_surfaces_at_end(life) result(table)
      type(life_t), intent(in) :: life         !! the life
      type(result_table_t) :: table            !! a row for each surface and measure

      real(wp), allocatable :: half(:, :), high(:, :), low(:, :)

      associate (node => life%nodes(life%last))
         half = node%half()
         call spread_of_measures(life, life%last, low, high)
         call begin_rows(life, "measures", "life_measures", "Worn surfaces", table)
         call table%put("value", "rows", "at the end of the life", [node%measures], heading="value")
         call table%put("low", "rows", "lower end of the 95 % interval of numerical errors", [max(node%measures - half, 0.0_wp)], &
                        heading="95 % from")
         call table%put("high", "rows", "upper end of it", [node%measures + half], heading="to")
         call table%put("spread_low", "rows", "lower end of the 95 % range by the uncertainty of the wear coefficient", [low], &
                        heading="by k from")
         call table%put("spread_high", "rows", "upper end of it; NaN: the life ended before it was known", [high], heading="to")
      end associate
   end function table_of_surfaces_at_end

   !> What each error adds to the interval.
   function table_of_budget(life) result(table)
      type(life_t), intent(in) :: life         !! the life
      type(result_table_t) :: table            !! a row for each surface and measure

      associate (node => life%nodes(life%last))
         call begin_rows(life, "errors", "life_errors", "Errors", table)
         call table%put("jumps", "rows", "by all jumps", [node%by_jumps], heading="jumps", digits=2)
         call table%put("settling", "rows", "by motion that has not settled", [node%by_settling], heading="settling", digits=2)
         call table%put("starts", "rows", "half of the 95 % interval by the scatter between starts", [node%by_starts], &
                        heading="starts", digits=2)
         call table%put("together", "rows", "square root of the sum of their squares", [node%half()], heading="together", digits=2)
      end associate
   end function table_of_budget

   !> A table with a row for each surface and measure.
   subroutine begin_rows(life, name, group, title, table)
      type(life_t), intent(in) :: life             !! the life
      character(*), intent(in) :: name             !! of the table
      character(*), intent(in) :: group            !! in HDF5 files
      character(*), intent(in) :: title            !! for people
      type(result_table_t), intent(out) :: table   !! with its first columns

      type(text_t), allocatable :: joints(:), measures(:), shown(:), sides(:)
      integer :: i, k, m

      associate (surfaces => life%state%surfaces)
         m = n_measure*size(surfaces)
         allocate (joints(m), sides(m), measures(m), shown(m), table%units(m), table%is_minor(m))
         table%is_minor = .false.
         do k = 1, size(surfaces)
            do i = 1, n_measure
               m = n_measure*(k - 1) + i
               joints(m)%s = surfaces(k)%joint
               sides(m)%s = surfaces(k)%side
               measures(m)%s = trim(measure_names(i))
               shown(m)%s = surfaces(k)%joint//" "//surfaces(k)%side//" "//measures(m)%s
               table%units(m)%s = trim(measure_units(i))
               table%is_minor(m) = .not. life%nodes(life%last)%measures(measure_volume, k) > 0.0_wp
            end do
         end do
         call table%start(name, group, size(joints), object="life", title=title)
         call table%put("row", "1", "surface and measure", texts=shown, heading="surface", formats=0)
         call table%put("joint", "1", "joint of the surface", texts=joints)
         call table%put("surface", "1", "bearing or journal", texts=sides)
         call table%put("measure", "1", "depth_max, volume or arc", texts=measures)
      end associate
   end subroutine begin_rows

   !> All nodes: starts and ends of jumps, a row for each and each surface.
   function table_of_jumps(life) result(table)
      type(life_t), intent(in) :: life         !! the life
      type(result_table_t) :: table            !! the rows

      type(text_t), allocatable :: joints(:), sides(:)
      real(wp), allocatable :: columns(:, :), high(:, :), low(:, :), half(:, :)
      integer :: i, j, k, m

      associate (surfaces => life%state%surfaces)
         m = life%last*size(surfaces)
         allocate (joints(m), sides(m), columns(m, 3*n_measure + 4))
         m = 0
         do j = 1, life%last
            half = life%nodes(j)%half()
            call spread_of_measures(life, j, low, high)
            do k = 1, size(surfaces)
               m = m + 1
               joints(m)%s = surfaces(k)%joint
               sides(m)%s = surfaces(k)%side
               columns(m, 1) = life%nodes(j)%cycles
               columns(m, 2) = life%nodes(j)%cycles*life%plan%cycle
               do i = 1, n_measure
                  columns(m, 3*i) = life%nodes(j)%measures(i, k)
                  columns(m, 3*i + 1) = max(life%nodes(j)%measures(i, k) - half(i, k), 0.0_wp)
                  columns(m, 3*i + 2) = life%nodes(j)%measures(i, k) + half(i, k)
               end do
               columns(m, 3*n_measure + 3) = low(measure_depth, k)
               columns(m, 3*n_measure + 4) = high(measure_depth, k)
            end do
         end do
      end associate
      call table%start("jumps", "life_jumps", size(joints))
      call table%put("cycles", "1", "number of cycles", columns(:, 1), formats=in_csv + in_hdf5)
      call table%put("time", "s", "time", columns(:, 2), formats=in_csv + in_hdf5)
      call table%put("joint", "1", "joint of the surface", texts=joints, formats=in_csv + in_hdf5)
      call table%put("surface", "1", "bearing or journal", texts=sides, formats=in_csv + in_hdf5)
      do i = 1, n_measure
         call put(trim(measure_names(i)), trim(measure_units(i)), measure_help(i), 3*i)
         call put(trim(measure_names(i))//"_low", trim(measure_units(i)), &
                  "lower end of its 95 % interval of numerical errors", 3*i + 1)
         call put(trim(measure_names(i))//"_high", trim(measure_units(i)), "upper end of it", 3*i + 2)
      end do
      call put("depth_spread_low", "m", "lower end of the 95 % range of depth_max by the wear coefficient", 3*n_measure + 3)
      call put("depth_spread_high", "m", "upper end of it; NaN: not followed so far", 3*n_measure + 4)

   contains

      !> Put a column of numbers.
      subroutine put(name, unit, help, at)
         character(*), intent(in) :: name      !! of the column
         character(*), intent(in) :: unit      !! SI
         character(*), intent(in) :: help      !! what it is
         integer, intent(in) :: at             !! its number

         call table%put(name, unit, help, columns(:, at), formats=in_csv + in_hdf5)
      end subroutine put

   end function table_of_jumps

   !> What a measure is.
   pure function measure_help(i) result(help)
      integer, intent(in) :: i                 !! number of the measure
      character(:), allocatable :: help        !! one line

      select case (i)
      case (measure_depth); help = "maximum worn depth"
      case (measure_volume); help = "worn volume"
      case (measure_arc); help = "worn arc"
      end select
   end function measure_help

   !> Profiles at the nodes, a table for each surface that wears.
   function tables_of_life_profiles(life) result(tables)
      type(life_t), intent(in) :: life                  !! the life
      type(result_table_t), allocatable :: tables(:)    !! (any) a row for each profile

      type(result_table_t) :: table
      real(wp), allocatable :: depths(:, :), volumes(:, :)
      integer, allocatable :: list(:)
      integer :: j, k

      allocate (tables(0))
      list = profile_nodes(life, most_profiles)
      do k = 1, size(life%state%surfaces)
         if (.not. life%nodes(life%last)%measures(measure_volume, k) > 0.0_wp) cycle
         associate (surface => life%state%surfaces(k), n => size(life%state%surfaces(k)%volume))
            allocate (depths(n, size(list)), volumes(n, size(list)))
            do j = 1, size(list)
               call profile_of(life, life%nodes(list(j)), k, depths(:, j), volumes(:, j))
            end do
            call table%start("profiles", "life_profiles/"//surface%joint//"/"//surface%side, size(list))
            call table%put("cycles", "1", "number of cycles", life%nodes(list)%cycles, formats=in_hdf5)
            call table%put("depth", "m", "depth of each cell", [depths], formats=in_hdf5, shape=[n])
            call table%put("volume", "m^3", "what each cell has lost", [volumes], formats=in_hdf5, shape=[n])
            tables = [tables, table]
            deallocate (depths, volumes)
         end associate
      end do
   end function tables_of_life_profiles

   !> Depths and volumes of the cells of a surface at a node.
   subroutine profile_of(life, node, k, depths, volumes)
      type(life_t), intent(in) :: life          !! the life
      type(node_t), intent(in) :: node          !! the node
      integer, intent(in) :: k                  !! number of the surface
      real(wp), intent(out) :: depths(:)        !! (cells) depths [m]
      real(wp), intent(out) :: volumes(:)       !! (cells) volumes [m^3]

      type(worn_surface_t), allocatable :: surfaces(:)

      surfaces = life%state%worn(node%x)
      depths = surfaces(k)%depths()
      volumes = surfaces(k)%volume
   end subroutine profile_of

   !> Nodes whose profiles are kept: the first, the last, and some between, evenly in their number.
   pure function profile_nodes(life, most) result(list)
      type(life_t), intent(in) :: life          !! the life
      integer, intent(in) :: most               !! profiles at most
      integer, allocatable :: list(:)           !! (any) numbers of the nodes

      integer :: k

      associate (n => min(most, life%last))
         list = [(1 + nint((life%last - 1)*real(k - 1, wp)/max(n - 1, 1)), k=1, n)]
      end associate
   end function profile_nodes

end module life_tables
