!> A made-up scene for the tests of output/: what it can report, and a place to write to.
module output_scene
   use catalogue, only: catalogue_t, names_of_channels
   use groups_of_catalogue, only: group_bodies, group_clearances, group_contacts, group_drivers, group_energy
   use kind_info, only: add_channel, kind_info_t
   use kinds, only: wp
   use posix, only: list_directory, make_directory, path_exists, process_number, remove_within
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: clean_scratch, fill_scene, is_absent, make_scene, read_whole, scratch_directory

contains

   !> A directory for the files of one test, made and empty.
   function scratch_directory(name) result(path)
      character(*), intent(in) :: name     !! of the test
      character(:), allocatable :: path    !! the directory

      character(200) :: place
      integer :: code

      call get_environment_variable("TMPDIR", place)
      if (len_trim(place) == 0) place = "/tmp"
      path = trim(place)//"/gudgeon_test_"//to_text(process_number())//"_"//name
      call clean_scratch(path)
      code = make_directory(path)
   end function scratch_directory

   !> Remove the directory of a test with all it holds.
   recursive subroutine clean_scratch(path)
      character(*), intent(in) :: path  !! the directory

      type(text_t), allocatable :: names(:)
      integer :: code, k

      call list_directory(path, names, code)
      do k = 1, size(names)
         associate (name => names(k)%s)
            if (index(name, "/") > 0) then
               call clean_scratch(path//"/"//name(1:len(name) - 1))
            else
               code = remove_within(path, name)
            end if
         end associate
      end do
      code = remove_within(path, "../"//path(index(path, "/", back=.true.) + 1:)//"/")
   end subroutine clean_scratch

   !> Two bodies, a driver, a pin with one contact and a guide with two, the ledger.
   subroutine make_scene(scene)
      type(catalogue_t), intent(out) :: scene  !! what can be recorded

      type(kind_info_t) :: body, contact, driver, joint, ledger

      call add_channel(body, "position", "m", "world", 2, "position of the centre of mass")
      call add_channel(body, "velocity", "m/s", "world", 2, "velocity of the centre of mass")
      call add_channel(body, "angle", "rad", "world", 1, "angle")
      call add_channel(driver, "moment", "N.m", "world", 1, "driving moment")
      call add_channel(joint, "eccentricity", "m", "world", 2, "journal from bearing")
      call add_channel(contact, "penetration", "m", "none", 1, "penetration")
      call add_channel(contact, "state", "1", "none", 1, "state")
      call add_channel(ledger, "kinetic", "J", "none", 1, "kinetic energy")
      call add_channel(ledger, "residual", "J", "none", 1, "what does not add up")
      call scene%add_item(group_bodies, "crank", channels=names_of_channels(body))
      call scene%add_item(group_bodies, "slider", channels=names_of_channels(body))
      call scene%add_kind(group_bodies, body)
      call scene%add_item(group_drivers, "motor", channels=names_of_channels(driver))
      call scene%add_kind(group_drivers, driver)
      call scene%add_item(group_clearances, "gudgeon", radius=5.0e-4_wp, channels=names_of_channels(joint))
      call scene%add_item(group_clearances, "guide", radius=1.0e-4_wp, channels=names_of_channels(joint))
      call scene%add_kind(group_clearances, joint)
      call scene%add_item(group_contacts, "gudgeon", channels=names_of_channels(contact))
      call scene%add_item(group_contacts, "guide", label="A", channels=names_of_channels(contact))
      call scene%add_item(group_contacts, "guide", label="B", channels=names_of_channels(contact))
      call scene%add_kind(group_contacts, contact)
      call scene%add_item(group_energy, "energy")
      call scene%add_kind(group_energy, ledger)
      call scene%allocate_data()
   end subroutine make_scene

   !> Values at a time; the state of the last contact stays not known (NaN).
   subroutine fill_scene(scene, t)
      type(catalogue_t), intent(inout) :: scene  !! what can be recorded
      real(wp), intent(in) :: t                  !! time [s]

      integer :: component, group, item, n

      do group = 1, size(scene%groups)
         associate (this => scene%groups(group))
            n = size(this%has)
            do item = 1, n
               if (this%channel%name == "state") then
                  if (item < n) scene%values(scene%place(group, 1, item)) = 1.0_wp
                  cycle
               end if
               do component = 1, this%channel%components
                  scene%values(scene%place(group, component, item)) = value_at(t, group, component, item)
               end do
            end do
         end associate
      end do
   end subroutine fill_scene

   !> A number that says where it belongs.
   pure real(wp) function value_at(t, group, component, item)
      real(wp), intent(in) :: t          !! time [s]
      integer, intent(in) :: group       !! number of the group
      integer, intent(in) :: component   !! its component
      integer, intent(in) :: item        !! its item

      value_at = (100*group + 10*item + component)*(1.0_wp + t)
   end function value_at

   !> Whether there is nothing of this name.
   logical function is_absent(path)
      character(*), intent(in) :: path  !! what must not exist

      is_absent = .not. path_exists(path)
   end function is_absent

   !> All bytes of a file, none if it does not exist.
   function read_whole(path) result(bytes)
      character(*), intent(in) :: path      !! the file
      character(:), allocatable :: bytes    !! what it holds

      integer :: length, status, unit

      bytes = ""
      open (newunit=unit, file=path, access="stream", form="unformatted", action="read", status="old", iostat=status)
      if (status /= 0) return
      inquire (unit, size=length)
      deallocate (bytes)
      allocate (character(max(length, 0)) :: bytes)
      read (unit, iostat=status) bytes
      if (status /= 0) bytes = ""
      close (unit)
   end function read_whole

end module output_scene
