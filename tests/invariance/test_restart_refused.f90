!> Memory of another run, or of another form, is refused by the name of what differs, and nothing is changed.
module test_restart_refused
   use check, only: check_close, check_equal, check_true, suite_t
   use archive, only: archive_t
   use catalogue, only: catalogue_t
   use deck_scene, only: dry_deck, keeper_t, load_file, loaded_t
   use errors, only: error_t, exit_usage
   use guards, only: guards_t
   use integrator_controls, only: controls_t
   use integrator_registry, only: find_integrator
   use kinds, only: wp
   use moving_part, only: advance_part, begin_part, moving_part_t, new_part
   use run_memory, only: load_part_memory, save_part_memory
   use run_tally, only: run_tally_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_restart_refused

   !> A run that has started.
   type :: begun_t
      type(loaded_t) :: loaded         !! deck, system, integrator
      type(moving_part_t) :: part      !! these in motion
      type(run_tally_t) :: tally       !! of it
      type(keeper_t) :: keeper         !! what it reports
   end type begun_t

contains

   subroutine run_test_restart_refused(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("pieces_have_the_names_of_the_deck", test_names)
      call suite%test("pieces_fill_the_row", test_sizes)
      call suite%test("another_version", test_versions)
      call suite%test("another_size", test_other_size)
      call suite%test("another_size_of_auto", test_size_of_auto)
      call suite%test("a_piece_more_or_less", test_other_list)
      call suite%test("another_law", test_other_law)
      call suite%test("another_method", test_other_method)
      call suite%test("a_row_cut_off", test_cut_row)
   end subroutine run_test_restart_refused

   !> Start the dry slider-crank.
   subroutine begin(run, error, setting, method)
      type(begun_t), intent(out), target :: run              !! the run, at t = 0
      type(error_t), allocatable, intent(out) :: error       !! an error
      character(*), intent(in), optional :: setting          !! a parameter, as name=value
      character(*), intent(in), optional :: method           !! the integrator; absent: the deck's

      type(catalogue_t) :: catalogue
      type(guards_t) :: none

      call load_file(dry_deck, run%loaded, error, setting)
      if (allocated(error)) return
      if (present(method)) call use_method(run%loaded, method)
      call new_part(run%loaded%system, run%loaded%method, run%loaded%plan%output_times, none, run%part)
      call run%keeper%start(catalogue, error)
      if (.not. allocated(error)) call begin_part(run%part, run%loaded%y, 1.0e-2_wp, run%tally, run%keeper, error)
   end subroutine begin

   !> Another integrator with the deck's controls.
   subroutine use_method(loaded, word)
      type(loaded_t), intent(inout) :: loaded   !! the deck
      character(*), intent(in) :: word          !! as in `method = word`

      type(controls_t) :: controls

      controls = loaded%method%controls
      deallocate (loaded%method)
      call find_integrator(word, loaded%method)
      loaded%method%controls = controls
   end subroutine use_method

   !> A checkpoint is refused with a sentence that holds some words, and the run that would read it stays as it is.
   subroutine check_refused(run, checkpoint, words, what, error)
      type(begun_t), intent(inout) :: run                     !! that would read it
      type(archive_t), intent(inout) :: checkpoint         !! memory
      character(*), intent(in) :: words                       !! that the message must hold
      character(*), intent(in) :: what                        !! for messages
      type(error_t), allocatable, intent(inout) :: error      !! first failure

      type(archive_t) :: after, before
      type(error_t), allocatable :: refusal

      if (allocated(error)) return
      call save_part_memory(run%part, before)
      call load_part_memory(checkpoint, run%part, refusal)
      call check_true(error, allocated(refusal), what//" is refused")
      if (allocated(error)) return
      call check_equal(error, refusal%code, exit_usage, what//": exit code")
      call check_true(error, index(refusal%message, words) > 0, what//": '"//words//"' in '"//refusal%message//"'")
      call save_part_memory(run%part, after)
      call check_close(error, after%row(:after%n), before%row(:before%n), 0.0_wp, what//": nothing was changed")
   end subroutine check_refused

   !> A run, and its memory after so many steps.
   subroutine save_after(n_step, run, checkpoint, error)
      integer, intent(in) :: n_step                         !! steps
      type(begun_t), intent(inout) :: run                   !! started, continued with
      type(archive_t), intent(inout) :: checkpoint       !! its memory
      type(error_t), allocatable, intent(inout) :: error    !! first failure

      integer :: k

      do k = 1, n_step
         if (allocated(error)) return
         call advance_part(run%part, run%tally, error)
      end do
      if (allocated(error)) return
      call save_part_memory(run%part, checkpoint)
   end subroutine save_after

   !> A run that has made some steps, what it saved, and another one that has only started.
   subroutine begin_again(n_step, run, saved, fresh, error, change)
      integer, intent(in) :: n_step                             !! steps of the first
      type(begun_t), intent(inout), target :: run               !! the first
      type(archive_t), intent(inout) :: saved                !! its memory
      type(begun_t), intent(inout), target :: fresh             !! the other one
      type(error_t), allocatable, intent(inout) :: error        !! first failure
      character(*), intent(in), optional :: change              !! of the other one's deck

      call begin(run, error)
      call save_after(n_step, run, saved, error)
      if (.not. allocated(error)) call begin(fresh, error, change)
   end subroutine begin_again

   !> The method, the stabilisation method and the clearance joint are named as in the deck.
   subroutine test_names(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: wanted(4) = [character(30) :: "method = auto", "stabilise = baumgarte", &
                                              "clearance.revolute 'gudgeon'", "the contacts from step to step"]
      type(begun_t), target :: run
      type(archive_t) :: saved
      integer :: i, k

      call begin(run, error)
      call save_after(1, run, saved, error)
      if (allocated(error)) return
      do i = 1, size(wanted)
         call check_equal(error, count([(saved%segments(k)%name == wanted(i), k=1, size(saved%segments))]), 1, &
                          "pieces with the name '"//trim(wanted(i))//"'")
      end do
   end subroutine test_names

   !> What a fresh run takes back is what was saved, and the pieces say how much that is.
   subroutine test_sizes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(begun_t), target :: fresh, run
      type(archive_t) :: again, saved

      call begin_again(7, run, saved, fresh, error)
      if (allocated(error)) return
      call check_equal(error, sum(saved%segments%size), saved%n, "numbers of all pieces")
      call check_true(error, all(abs(saved%row(:saved%n)) <= huge(1.0_wp)), "all are numbers")
      if (allocated(error)) return
      call load_part_memory(saved, fresh%part, error)
      if (allocated(error)) return
      call save_part_memory(fresh%part, again)
      call check_close(error, again%row(:again%n), saved%row(:saved%n), 0.0_wp, "saved again")
      call check_close(error, fresh%loaded%method%t, run%loaded%method%t, 0.0_wp, "time")
      call check_true(error, run%loaded%method%t > 0.0_wp, "time has passed")
   end subroutine test_sizes

   !> Each piece in turn is of a form that this program does not read.
   subroutine test_versions(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(begun_t), target :: fresh, run
      type(archive_t) :: other, saved
      integer :: k

      call begin_again(5, run, saved, fresh, error)
      if (allocated(error)) return
      do k = 1, size(saved%segments)
         other = saved
         other%segments(k)%version = saved%segments(k)%version + 1
         call check_refused(fresh, other, other%segments(k)%name//" has version "//to_text(other%segments(k)%version)// &
                            ", supported is version "//to_text(saved%segments(k)%version), "another version", error)
      end do
   end subroutine test_versions

   !> Each piece in turn has a number more, but those whose size the motion decides.
   subroutine test_other_size(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(begun_t), target :: fresh, run
      type(archive_t) :: other, saved
      integer :: k

      call begin_again(5, run, saved, fresh, error)
      if (allocated(error)) return
      do k = 1, size(saved%segments)
         if (.not. saved%segments(k)%is_fixed) cycle
         other = saved
         call other%put(0.0_wp)
         other%segments(size(other%segments))%size = saved%segments(size(saved%segments))%size
         other%segments(k)%size = saved%segments(k)%size + 1
         call check_refused(fresh, other, "the state of "//other%segments(k)%name//" has "//to_text(other%segments(k)%size)// &
                            " number", "another size", error)
      end do
   end subroutine test_other_size

   !> The method that chooses remembers its implicit part in a piece of its own, whose size the motion decides; all else has one
   !> size.
   subroutine test_size_of_auto(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(begun_t), target :: fresh, run
      type(archive_t) :: saved
      integer :: k

      call begin(run, error, method="auto")
      call save_after(5, run, saved, error)
      if (.not. allocated(error)) call begin(fresh, error, method="auto")
      if (allocated(error)) return
      do k = 1, size(saved%segments)
         if (saved%segments(k)%name == "method = auto") exit
      end do
      call check_true(error, k < size(saved%segments), "its piece is there")
      if (allocated(error)) return
      call check_equal(error, saved%segments(k + 1)%name, "implicit part of method = auto", "the next piece")
      call check_equal(error, saved%segments(k + 1)%size, 0, "there is no such part yet")
      saved%segments(k)%size = saved%segments(k)%size + 1
      saved%n = saved%n + 1
      call check_refused(fresh, saved, "the state of method = auto has ", "another size", error)
   end subroutine test_size_of_auto

   !> The last piece is missing, or there is one that nothing has.
   subroutine test_other_list(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(begun_t), target :: fresh, run
      type(archive_t) :: other, saved

      call begin_again(5, run, saved, fresh, error)
      if (allocated(error)) return
      associate (n => size(saved%segments))
         other = saved
         other%segments = saved%segments(:n - 1)
         other%n = saved%n - saved%segments(n)%size
         call check_refused(fresh, other, "the state of "//saved%segments(n)%name//" is missing", "a piece less", error)
         other%segments = saved%segments(:3)
         call check_refused(fresh, other, "the state of "//saved%segments(4)%name//" is missing", "three pieces", error)
         other = saved
         call other%begin("clearance.revolute 'third'", 1)
         call check_refused(fresh, other, "the state of clearance.revolute 'third', which is not part of this run", &
                         "a piece more", error)
         other = saved
         other%segments(n)%name = "clearance.revolute 'third'"
         call check_refused(fresh, other, "the state of clearance.revolute 'third' instead of that of "//saved%segments(n)%name, &
                         "another name", error)
      end associate
   end subroutine test_other_list

   !> A parameter changes no memory; a law whose force jumps where the penetration turns has an event function more.
   subroutine test_other_law(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(begun_t), target :: fresh, run
      type(archive_t) :: saved

      call begin_again(5, run, saved, fresh, error, "c=0.4mm")
      if (allocated(error)) return
      call load_part_memory(saved, fresh%part, error)
      if (allocated(error)) return
      call check_close(error, fresh%loaded%method%t, run%loaded%method%t, 0.0_wp, "taken with another clearance")
      if (.not. allocated(error)) call begin(fresh, error, "law=kelvin_voigt")
      call check_refused(fresh, saved, "the state of the state has "//to_text(saved%segments(1)%size)//" numbers, expected "// &
                         to_text(saved%segments(1)%size + 10), "another law", error)
   end subroutine test_other_law

   !> Memory of Verner's method is none of Adams's.
   subroutine test_other_method(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(begun_t), target :: fresh, run
      type(archive_t) :: saved

      call begin(run, error)
      call save_after(5, run, saved, error)
      if (.not. allocated(error)) call begin(fresh, error, method="adams")
      call check_refused(fresh, saved, "it contains the state of method = auto instead of that of method = adams", &
                         "another method", error)
   end subroutine test_other_method

   !> The list is whole, the row is not.
   subroutine test_cut_row(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(begun_t), target :: fresh, run
      type(archive_t) :: other, saved

      call begin_again(5, run, saved, fresh, error)
      if (allocated(error)) return
      other = saved
      other%n = saved%n - 1
      call check_refused(fresh, other, "its segments describe "//to_text(saved%n), "a row cut off", error)
   end subroutine test_cut_row

end module test_restart_refused
