!> What the surfaces of joints lost in a run, as tables: a row for each surface, and a row for each cell of each surface.
module wear_tables
   use kinds, only: wp
   use result_table, only: in_hdf5, result_table_t
   use table_list, only: list_of
   use text, only: text_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: tables_of_wear

contains

   !> All that is known of worn surfaces.
   function tables_of_wear(worn) result(tables)
      type(worn_surface_t), allocatable, intent(in) :: worn(:)   !! (any) the surfaces; unallocated: none
      type(result_table_t), allocatable :: tables(:)             !! none if no surface wears

      allocate (tables(0))
      if (.not. allocated(worn)) return
      if (size(worn) == 0) return
      tables = list_of(table_of_surfaces(worn), table_of_profiles(worn))
   end function tables_of_wear

   !> The surfaces.
   function table_of_surfaces(worn) result(table)
      type(worn_surface_t), intent(in) :: worn(:)   !! (n) the surfaces
      type(result_table_t) :: table                 !! a row for each

      type(text_t) :: joints(size(worn)), sides(size(worn))
      real(wp) :: angle(size(worn)), depth(size(worn))
      integer :: k

      do k = 1, size(worn)
         joints(k)%s = worn(k)%joint
         sides(k)%s = worn(k)%side
         call worn(k)%max_depth(depth(k), angle(k))
      end do
      call table%start("worn_surfaces", "wear", size(worn), title="Wear")
      call table%put("joint", "1", "joint of each surface", texts=joints, heading="joint")
      call table%put("surface", "1", "bearing or journal", texts=sides, heading="surface")
      call table%put("volume", "m^3", "worn volume", [(sum(worn(k)%volume), k=1, size(worn))], heading="volume")
      call table%put("depth_max", "m", "maximum depth of a cell", depth, heading="depth")
      call table%put("depth_angle", "rad", "middle of that cell, in the frame of the body that carries the surface", angle, &
                     heading="at angle")
      call table%put("arc", "rad", "angle of all that has lost something, at the centre of the surface", &
                     [(worn(k)%arc(), k=1, size(worn))], heading="worn arc")
      call table%put("distance", "m", "that the surfaces have slid on each other", worn%distance, heading="slid")
   end function table_of_surfaces

   !> Their profiles.
   function table_of_profiles(worn) result(table)
      type(worn_surface_t), intent(in) :: worn(:)   !! (n) the surfaces
      type(result_table_t) :: table                 !! a row for each cell of each

      type(text_t), allocatable :: joints(:), sides(:)
      integer :: i, k, m, n

      n = sum([(size(worn(k)%volume), k=1, size(worn))])
      allocate (joints(n), sides(n))
      m = 0
      do k = 1, size(worn)
         do i = 1, size(worn(k)%volume)
            m = m + 1
            joints(m)%s = worn(k)%joint
            sides(m)%s = worn(k)%side
         end do
      end do
      call table%start("worn_profiles", "wear_profiles", n)
      call table%put("joint", "1", "joint of each cell", texts=joints, formats=in_hdf5)
      call table%put("surface", "1", "bearing or journal", texts=sides, formats=in_hdf5)
      call table%put("angle", "rad", "direction of the middle of each cell, in the frame of the body that carries it", &
                     [(worn(k)%angle([(i, i=1, size(worn(k)%volume))]), k=1, size(worn))], formats=in_hdf5)
      call table%put("depth", "m", "depth of each cell", [(worn(k)%depths(), k=1, size(worn))], &
                     formats=in_hdf5)
      call table%put("volume", "m^3", "what each cell has lost", [(worn(k)%volume, k=1, size(worn))], formats=in_hdf5)
   end function table_of_profiles

end module wear_tables
