!> The extremes of a run in summary.txt: a table of the channels and one of the clearance joints.
module extremes_text
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use channel_noise, only: known_text
   use extremes, only: extremes_t, joint_extremes_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: channel_table, joint_table

   integer, parameter :: most_lines = 40     !! channels in summary.txt
   integer, parameter :: widest_name = 60    !! characters of a name that others are lined up with

contains

   !> The table of the channels for people, without those that are zero all the time.
   subroutine channel_table(lines, extremes, catalogue)
      type(buffer_t), intent(inout) :: lines        !! the summary
      type(extremes_t), intent(in) :: extremes      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded

      character(:), allocatable :: name
      integer, allocatable :: list(:)
      integer :: i, k, n, width

      if (size(extremes%channels) == 0) return
      list = pack([(k, k=1, size(extremes%channels))], &
                  [(extremes%has_values(k) .and. .not. extremes%is_nothing(k), k=1, size(extremes%channels))])
      n = size(list)
      list = list(:min(n, most_lines))
      width = len("extremes")
      do i = 1, size(list)
         width = max(width, min(len(full_name(extremes, catalogue, list(i))), widest_name))
      end do
      call lines%line("")
      if (extremes%has_course()) then
         call lines%line("extremes"//repeat(" ", width + 3)//right("min")//right("at [s]")//right("max")//right("at [s]")// &
                         right("mean")//right("rms"))
      else
         call lines%line("values")
      end if
      do i = 1, size(list)
         k = list(i)
         name = full_name(extremes, catalogue, k)
         associate (one => extremes%shown_extreme(k))
            call lines%add("           "//name//repeat(" ", max(width - len(name), 0))//right(known_text(one%minimum, 5)))
            if (extremes%has_course()) call lines%add(right(known_text(one%min_time, 6))//right(known_text(one%maximum, 5))// &
                                                    right(known_text(one%max_time, 6))// &
                                                    right(known_text(extremes%shown_mean(k), 5))// &
                                                    right(known_text(extremes%shown_rms(k), 5)))
            call lines%line("")
         end associate
      end do
      if (extremes%has_course() .and. .not. extremes%has_time()) call lines%line( &
         "           -: no mean of a single output time")
      if (n > size(list)) call lines%line("           "//to_text(n - size(list))//" more in summary.json and in run.h5, /extremes")
      call rest(count([(extremes%is_nothing(k), k=1, size(extremes%channels))]), "that are zero or round-off")
      call rest(count([(.not. extremes%has_values(k), k=1, size(extremes%channels))]), "without values")

   contains

      !> How many further channels there are.
      subroutine rest(how_many, what)
         integer, intent(in) :: how_many    !! their number
         character(*), intent(in) :: what   !! what they are

         if (how_many > 0) call lines%line("           "//to_text(how_many)//" channels "//what)
      end subroutine rest

   end subroutine channel_table

   !> The table of the clearance joints for people: maximum values, each with its time, that of a speed being the onset.
   subroutine joint_table(lines, joints)
      type(buffer_t), intent(inout) :: lines          !! the summary
      type(joint_extremes_t), intent(in) :: joints(:) !! (n) the joints with contacts

      integer :: k

      if (size(joints) == 0) return
      call lines%line("")
      call lines%line("joints with clearance")
      do k = 1, min(size(joints), most_lines)
         associate (joint => joints(k))
            call lines%add("           "//joint%name//": "//to_text(joint%impacts)//" impacts, "// &
                           known_text(100.0_wp*joint%contact_fraction, 4)//" % of the time in contact")
            if (joint%impacts > 0) then
               call lines%add("; max. "//known_text(joint%speed, 5)//" m/s at "//known_text(joint%speed_onset, 6)//" s, "// &
                              known_text(joint%force, 6)//" N at "//known_text(joint%force_time, 6)//" s, penetration "// &
                              known_text(joint%penetration, 5)//" m at "//known_text(joint%penetration_time, 6)//" s; impulse "// &
                              known_text(joint%impulse, 5)//" N.s")
               if (ieee_is_finite(joint%energy_lost)) call lines%add("; lost "//known_text(joint%energy_lost, 5)//" J")
            end if
            call lines%line("")
         end associate
      end do
      if (size(joints) > most_lines) then
         call lines%line("           "//to_text(size(joints) - most_lines)//" more in summary.json and in run.h5, /extremes")
      end if
   end subroutine joint_table

   !> Name of a number with its unit.
   function full_name(extremes, catalogue, k) result(name)
      type(extremes_t), intent(in) :: extremes      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      integer, intent(in) :: k                      !! which number
      character(:), allocatable :: name             !! as `slider.velocity.x [m/s]`

      name = scalar_name(catalogue, extremes%channels(k))
      if (unit_of(extremes, catalogue, k) /= "1") name = name//" ["//unit_of(extremes, catalogue, k)//"]"
   end function full_name

   !> Unit of a number.
   pure function unit_of(extremes, catalogue, k) result(unit)
      type(extremes_t), intent(in) :: extremes      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      integer, intent(in) :: k                      !! which number
      character(:), allocatable :: unit             !! SI, `1` if none

      unit = catalogue%groups(extremes%channels(k)%group)%channel%unit
   end function unit_of

   !> A string at the right end of a column.
   pure function right(string) result(s)
      character(*), intent(in) :: string   !! any string
      character(:), allocatable :: s       !! never shorter than the string

      integer, parameter :: width = 12     ! of a column

      s = repeat(" ", max(width - len(string), 1))//string
   end function right

end module extremes_text
