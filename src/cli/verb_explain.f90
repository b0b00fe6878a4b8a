!> `gudgeon explain DECK` and `gudgeon check DECK`: what would run, without running it.
module verb_explain
   use console, only: say
   use build_system, only: levels_ideal, new_system
   use clearance_set, only: clearance_set_t
   use consistent_start, only: assembly_t
   use deck_reader, only: all_defaults
   use errors, only: error_t
   use explain_dropped, only: say_dropped
   use explain_floors, only: floors_of_scene
   use explain_guards, only: say_guards
   use explain_instants, only: explain_instants_of
   use imsl_names, only: is_imsl_name
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use kinematic_start, only: find_kinematic_start
   use load, only: check_swept_words, load_deck, loaded_t
   use mobility, only: find_mobility, mobility_t
   use options, only: options_t
   use mechanism, only: mechanism_t
   use row_plan, only: contact_rows_text
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names, analysis_static, n_analysis, scene_t
   use start_state, only: find_start, redundancy_text
   use static, only: equilibrium_t, find_equilibrium
   use text, only: real_text, replace, text_t, to_text
   use time_plan, only: last_instant
   implicit none (type, external)
   private
   public :: check_deck, explain_deck

contains

   !> Find every mistake without integrating.
   subroutine check_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! mistakes of the deck, or no assembly

      type(assembly_t) :: assembly
      type(loaded_t) :: loaded
      real(wp), allocatable :: y(:)

      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_swept_words(options, loaded, error)
      if (.not. allocated(error)) call find_begin(loaded, y, assembly, error)
      if (allocated(error)) return
      call say(loaded%path//": no mistakes; "//counted(loaded%system%linkage%bodies%n, "body", "bodies")//", "// &
               counted(loaded%system%linkage%rows%n, "constraint row", "constraint rows")//", "// &
               counted(loaded%system%n_loose, "loose joint", "loose joints")//"; assembled to "// &
               real_text(assembly%residual, 2)//" m or rad"//sweep_text(loaded))
   end subroutine check_deck

   !> How many cases and runs a sweep of the deck has; blank if it has none.
   function sweep_text(loaded) result(words)
      type(loaded_t), intent(in) :: loaded     !! the deck
      character(:), allocatable :: words       !! as `; a sweep of 4 cases, 16 runs each`

      words = ""
      if (loaded%sweep%is_present) words = "; a sweep of "//counted(loaded%sweep%n_cases(), "case", "cases")
      if (.not. loaded%scene%has_ensemble) return
      if (words == "") words = "; an ensemble"
      associate (n => nint(loaded%scene%ensemble%number("runs")))
         words = words//", "//counted(n, "run", "runs")//" each"
      end associate
   end function sweep_text

   !> Where the analysis of the deck begins; the equilibrium of a static one.
   subroutine find_begin(loaded, y, assembly, error)
      type(loaded_t), intent(inout) :: loaded              !! the deck
      real(wp), allocatable, intent(out) :: y(:)           !! (at least 6 bodies) positions and velocities [any]
      type(assembly_t), intent(out) :: assembly            !! how it was found
      type(error_t), allocatable, intent(out) :: error     !! there is none

      type(equilibrium_t) :: equilibrium
      type(mobility_t) :: mobility
      real(wp), allocatable :: q(:), v(:)

      select case (loaded%scene%analysis)
      case (analysis_kinematic)
         call find_kinematic_start(loaded%scene, loaded%system, q, assembly, mobility, error)
         if (.not. allocated(error)) y = [q, 0.0_wp*q]
      case (analysis_static)
         call loaded%system%linkage%deck_state(q, v)
         call find_equilibrium(loaded%scene, loaded%system, q, assembly, equilibrium, error)
         if (.not. allocated(error)) y = [q, 0.0_wp*q]
      case default
         call find_start(loaded%scene, loaded%system, y, assembly, error)
      end select
   end subroutine find_begin

   !> Say what is modelled and what was dropped.
   subroutine explain_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! mistakes of the deck, or no assembly

      type(assembly_t) :: assembly
      type(error_t), allocatable :: start_error
      type(loaded_t) :: loaded
      type(mechanism_t) :: twin
      type(text_t), allocatable :: defaults(:)
      real(wp), allocatable :: y(:)
      integer :: k

      call load_deck(options, loaded, error)
      if (allocated(error)) return
      call new_system(loaded%scene, levels_ideal, twin)
      call find_begin(loaded, y, assembly, start_error)
      call say(loaded%path//": "//loaded%scene%title)
      call explain_size(loaded%scene, loaded%system, twin)
      call explain_start(loaded, assembly, allocated(start_error))
      if (allocated(start_error) .and. allocated(y)) deallocate (y)
      call explain_loose(loaded, y)
      call say_dropped(loaded%scene, loaded%system)
      call explain_method(loaded)
      call explain_instants_of(loaded)
      call say_guards(loaded)
      if (allocated(y) .and. loaded%scene%analysis == analysis_dynamic) call floors_of_scene(loaded%system, y, loaded%plan%end)
      if (len(sweep_text(loaded)) > 0) call say("'gudgeon sweep' runs"//replace(sweep_text(loaded), ";", ""))
      defaults = all_defaults(loaded%deck)
      call say("")
      call say("defaults taken")
      do k = 1, size(defaults)
         if (is_worth(loaded%scene, defaults(k)%s)) call say(defaults(k)%s, 2)
      end do
      if (allocated(start_error)) call move_alloc(start_error, error)
   end subroutine explain_deck

   !> Whether a default says something: not if it is an IMSL name, or a control that was given under that.
   logical function is_worth(scene, line)
      type(scene_t), intent(in) :: scene   !! the scene
      character(*), intent(in) :: line     !! `kind item key = default`

      integer :: k

      is_worth = .true.
      do k = 1, n_analysis
         if (index(line, "analysis."//trim(analysis_names(k))//" ") == 0) cycle
         is_worth = k == scene%analysis .or. (k == analysis_static .and. scene%analysis == analysis_dynamic .and. &
                                              scene%dynamic%word("start") == "static")
      end do
      if (.not. is_worth) return
      do k = 1, size(scene%dynamic_kind%columns)
         associate (name => scene%dynamic_kind%columns(k)%name)
            if (index(line, "analysis.dynamic "//name//" = ") == 0) cycle
            is_worth = .not. (is_imsl_name(name) .or. scene%dynamic%values(k)%given)
         end associate
      end do
   end function is_worth

   !> A number with the word for it.
   function counted(n, one, many) result(words)
      integer, intent(in) :: n               !! the number
      character(*), intent(in) :: one        !! word for one
      character(*), intent(in) :: many       !! word for several
      character(:), allocatable :: words     !! as `3 bodies`

      words = to_text(n)//" "//many
      if (n == 1) words = to_text(n)//" "//one
   end function counted

   !> Coordinates, rows and degrees of freedom.
   subroutine explain_size(scene, system, twin)
      type(scene_t), intent(in) :: scene            !! the scene
      type(mechanism_t), intent(in) :: system   !! its system
      type(mechanism_t), intent(in) :: twin     !! with all joints ideal

      integer :: k

      call say("")
      call say("model")
      associate (linkage => system%linkage, names => system%linkage%bodies%names, n => system%linkage%bodies%n)
         call say(counted(n, "planar body", "planar bodies")//", "//to_text(size(linkage%mass))//" coordinates", 2)
         do k = 1, linkage%reduced%known%n
            call say("'"//names(linkage%reduced%known%item(k)%body)%s//"' moves as a known function of time", 2)
         end do
         do k = 1, linkage%reduced%guided%n
            call say("'"//names(linkage%reduced%guided%item(k)%body)%s//"' keeps one coordinate, that of '"// &
                     linkage%row_name(linkage%reduced%guided%item(k)%row(1))//"'", 2)
         end do
      end associate
      if (system%linkage%rows%n > system%linkage%rows%n_solve) then
         call say(counted(system%n_position, "coordinate", "coordinates")//" unknown, "// &
                  counted(system%linkage%rows%n_solve, "row", "rows")//" solved", 2)
      end if
      do k = 1, size(scene%joints)
         call count_kind(scene%joints(k)%info, scene%joints(k)%items)
      end do
      do k = 1, size(scene%forces)
         call count_kind(scene%forces(k)%info, scene%forces(k)%items)
      end do
      do k = 1, size(scene%functions)
         call count_kind(scene%functions(k)%info, scene%functions(k)%items)
      end do
      if (size(system%linkage%ideal) > 0) then
         call say(counted(system%linkage%ideal(1)%set%n, "joint", "joints")//" with clearance taken as ideal, "// &
                  to_text(system%linkage%ideal(1)%set%n_row_item*system%linkage%ideal(1)%set%n)//" rows", 2)
      end if
      call say(counted(system%linkage%rows%n, "constraint row", "constraint rows")//": coordinates less rows "// &
               to_text(size(system%linkage%mass) - system%linkage%rows%n)//"; with all joints ideal "// &
               to_text(size(twin%linkage%mass) - twin%linkage%rows%n), 2)
      if (norm2(system%loading%gravity) > 0.0_wp) then
         call say("gravity "//to_text(system%loading%gravity(1))//" "//to_text(system%loading%gravity(2))//" m/s^2", 2)
      end if
   end subroutine explain_size

   !> How the mechanism was assembled, its degrees of freedom, redundant rows.
   subroutine explain_start(loaded, assembly, has_failed)
      type(loaded_t), intent(in) :: loaded       !! the deck
      type(assembly_t), intent(in) :: assembly   !! how the start was found
      logical, intent(in) :: has_failed          !! there is no start

      type(mobility_t) :: mobility

      if (has_failed) then
         call say(trim(merge("NOT assembled   ", "NOT ready to run", loaded%scene%analysis == analysis_dynamic))// &
                  ": the error below says why", 2)
         return
      end if
      call say(counted(size(loaded%system%linkage%mass) - loaded%system%linkage%rows%n + size(assembly%dependent), &
                       "degree of freedom", "degrees of freedom"), 2)
      if (loaded%scene%analysis == analysis_kinematic) then
         call find_mobility(loaded%system%linkage, mobility)
         call say(counted(mobility%n_freedom, "degree of freedom", "degrees of freedom")//" without drivers, "// &
                  counted(mobility%n_driver, "driver", "drivers"), 2)
      end if
      if (loaded%system%linkage%solution%is_redundant) then
         call say(redundancy_text(loaded%system, assembly), 2)
      else
         call say("no redundant rows", 2)
      end if
      call say("assembled in "//counted(assembly%corrections, "correction", "corrections")//", residual "// &
               real_text(assembly%residual, 2)//" m or rad, bodies moved by up to "//real_text(assembly%moved, 3)// &
               " m", 2)
      if (assembly%rate_changed > 0.0_wp) then
         call say("given velocities changed by up to "//real_text(assembly%rate_changed, 3)//" m/s (body '"// &
                  loaded%scene%bodies%names(assembly%changed_body)%s//"')", 2)
      end if
   end subroutine explain_start

   !> How many items a kind has.
   subroutine count_kind(info, items)
      type(kind_info_t), intent(in) :: info   !! the kind
      type(item_t), intent(in) :: items(:)    !! its rows

      if (size(items) == 0) return
      if (info%n_row > 0) then
         call say(to_text(size(items))//" "//info%name//", "//counted(info%n_row*size(items), "row", "rows")// &
                  trim(merge(" at the start only", "                  ", info%is_start_only)), 2)
      else
         call say(to_text(size(items))//" "//info%name, 2)
      end if
   end subroutine count_kind

   !> Loose joints: laws, stiffness, initial gap, time scale of a contact against the output interval.
   subroutine explain_loose(loaded, y)
      type(loaded_t), intent(inout) :: loaded         !! the deck
      real(wp), allocatable, intent(in) :: y(:)       !! (n) start; unallocated: none was found [any]

      real(wp), parameter :: speeds(3) = [0.1_wp, 1.0_wp, 10.0_wp]  ! of impacts, as examples [m/s]
      real(wp), allocatable :: delta(:), rate(:)
      character(:), allocatable :: law, words
      real(wp) :: step
      integer :: c, i, k, last, v

      if (loaded%system%n_loose == 0) return
      step = loaded%scene%dynamic%number("step")
      call say("")
      call say("loose joints")
      allocate (delta(loaded%system%n_contact), rate(loaded%system%n_contact), source=0.0_wp)
      if (allocated(y)) call loaded%system%events(0.0_wp, y, delta, rate)
      do k = 1, size(loaded%system%clearances)
         associate (set => loaded%system%clearances(k)%set)
            law = set%law%name
            if (allocated(set%friction)) law = law//", friction "//set%friction%name
            do i = 1, set%n
               c = (i - 1)*set%n_contact_item + 1
               words = ""
               if (set%is_round) words = "radial clearance "//to_text(1.0e3_wp*set%clearance(i))//" mm, "
               call say(set%names(i)%s//": "//words//"law "//law//", "//set%law%story(set%parameters(:, c)), 2)
               last = set%first_contact + i*set%n_contact_item
               if (allocated(y)) call say("gap at the start "//real_text(-1.0e3_wp*maxval( &
                  delta(last - set%n_contact_item + 1:last)), 6)//" mm", 4)
               if (loaded%scene%analysis /= analysis_dynamic) cycle
               do v = 1, size(speeds)
                  if (.not. contact_time(loaded%system, set, c, speeds(v)) > 0.0_wp) then
                     call say("no impact of free bodies: drivers move both, or the law stores nothing", 4)
                     exit
                  end if
                  call say("an elastic impact at "//to_text(speeds(v))//" m/s lasts about "// &
                           real_text(1.0e6_wp*contact_time(loaded%system, set, c, speeds(v)), 3)//" us, "// &
                           real_text(contact_time(loaded%system, set, c, speeds(v))/loaded%plan%every, 2)// &
                           " output intervals"//steps_of(contact_time(loaded%system, set, c, speeds(v)), step), 4)
               end do
               call explain_validity(set%pairs(i)%speed_limit)
            end do
         end associate
      end do
   end subroutine explain_loose

   !> A duration in fixed steps, or what variable steps do with it.
   function steps_of(duration, step) result(words)
      real(wp), intent(in) :: duration     !! of an impact [s]
      real(wp), intent(in) :: step         !! length of fixed steps, 0: variable [s]
      character(:), allocatable :: words   !! to follow the duration

      words = "; the first step of a contact is a hundredth of it"
      if (step > 0.0_wp) words = ", "//real_text(duration/step, 2)//" fixed steps"
   end function steps_of

   !> Duration of an impact.
   real(wp) function contact_time(system, set, contact, speed)
      type(mechanism_t), intent(in) :: system   !! the system
      class(clearance_set_t), intent(in) :: set     !! the joint's set
      integer, intent(in) :: contact                !! contact of the set
      real(wp), intent(in) :: speed                 !! impact speed [m/s]

      contact_time = set%contact_time(contact, speed, system%linkage%inverse_mass(1, :))
   end function contact_time

   !> Impact speed up to which contact is quasi-static.
   subroutine explain_validity(speed_limit)
      real(wp), intent(in) :: speed_limit  !! huge: not known [m/s]

      if (speed_limit >= huge(speed_limit)) return
      call say("the law is quasi-static: strictly for impacts below "//real_text(speed_limit, 3)//" m/s (1e-5 sqrt(E/rho))", 4)
   end subroutine explain_validity

   !> Method, solver, stabilisation and times.
   subroutine explain_method(loaded)
      type(loaded_t), intent(in) :: loaded  !! the deck

      character(:), allocatable :: fixed, hold, solver

      call say("")
      call say("method")
      select case (loaded%scene%analysis)
      case (analysis_kinematic)
         call say("positions by Newton's iteration, forces by inverse dynamics, at every output instant", 2)
         call explain_times(loaded)
         return
      case (analysis_static)
         call say("descent, then KINSOL, to "//to_text(loaded%scene%static%number("tolerance"))// &
                  " of the largest load", 2)
         return
      end select
      associate (settings => loaded%scene%dynamic)
         solver = settings%word("solver")
         if (solver == "auto") then
            solver = loaded%system%linkage%solution%solver%name()//" (auto: "//reason_of_solver(loaded%system)//")"
         end if
         fixed = "variable steps"
         if (settings%number("step") > 0.0_wp) then
            fixed = "fixed steps of "//to_text(settings%number("step"))//" s: the tolerance is not used"
         end if
         call say("integrator "//settings%word("method")//", tolerance "// &
                  to_text(settings%number("tolerance")), 2)
         call say(fixed, 2)
         call say("solver "//solver, 2)
         hold = loaded%system%way%words()
         if (settings%word("stabilise") == "auto") hold = hold//" (auto: "//reason_of_hold(loaded%system)//")"
         call say("stabilisation "//hold, 2)
      end associate
      call explain_times(loaded)
   end subroutine explain_method

   !> Times of the motion and of its output.
   subroutine explain_times(loaded)
      type(loaded_t), intent(in) :: loaded  !! the deck

      character(:), allocatable :: words

      call say("from 0 to "//to_text(loaded%plan%end)//" s; output from "//to_text(loaded%plan%first_output)// &
               " s every "//to_text(loaded%plan%every)//" s, "// &
               counted(1 + int(last_instant(loaded%plan)), "instant", "instants"), 2)
      words = contact_rows_text(loaded%scene, loaded%system)
      if (len(words) > 0) call say(words, 2)
   end subroutine explain_times

   !> Why `auto` has chosen the solver.
   function reason_of_solver(system) result(words)
      type(mechanism_t), intent(in) :: system   !! the system
      character(:), allocatable :: words            !! the reason

      select case (system%linkage%solution%solver%name())
      case ("schur")
         words = "equal to pivoting to round-off, and the fastest for these rows"
      case ("sparse")
         words = "bodies carry so many joints that the Schur complement fills up"
      case default
         words = "as the stabilisation"
      end select
   end function reason_of_solver

   !> Why `auto` has chosen the stabilisation.
   function reason_of_hold(system) result(words)
      type(mechanism_t), intent(in) :: system   !! the system
      character(:), allocatable :: words            !! the reason

      select case (system%way%name())
      case ("none")
         words = "there is nothing to hold, or the integrator holds by itself"
      case ("baumgarte")
         words = "a driver jumps, and a jump cannot be projected"
      case default
         words = "no violation is left, and no gains disturb the motion"
      end select
   end function reason_of_hold

end module verb_explain
