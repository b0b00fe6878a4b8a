!> A deck made of an Adams dataset, and the list of what it does not have.
!>
!> Lengths of tables are in mm or m, as those of the dataset, everything else in SI. An analysis of 1 s is put in, for a dataset
!> does
!> not say how long to run. Every statement is either in the deck, or a setting of Adams, or named in the list.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: those of `adams_parts`, `adams_joints`,
!> `adams_forces`.
module adams_deck
   use adams_arguments, only: name_small_degrees, name_unknown_arguments
   use adams_constraints, only: add_constraints
   use adams_contacts, only: add_contacts
   use adams_elastic, only: add_elastic
   use adams_forces, only: add_forces
   use adams_gears, only: add_gears
   use adams_joints, only: add_joints, add_primitives
   use adams_loads, only: add_loads
   use adams_model, only: adams_model_t, leave_out, part_t
   use adams_motions, only: add_motions
   use adams_names, only: full_names, is_known, is_refused, is_setting, is_understood, reason_against
   use adams_numbers, only: argument_numbers, mistake
   use adams_parts, only: new_model
   use adams_splines, only: name_idle_splines
   use adams_starts, only: sliding_velocity
   use dataset, only: has_word, line_words, read_statements, statement_t
   use deck_draft, only: deck_draft_t, tab
   use deck_table, only: direction_cell, number_cell
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use name_table, only: name_table_t
   use source_text, only: source_t
   use text, only: counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: imported_t, import_dataset

   !> What an import gives.
   type :: imported_t
      character(:), allocatable :: deck              !! text of the deck
      type(text_t), allocatable :: left_out(:)       !! (n) what it does not have
      type(text_t), allocatable :: changed(:)        !! (m) what it has otherwise, or was assumed
      type(text_t), allocatable :: settings(:)       !! (k) statements that are about the simulation
   end type imported_t

contains

   !> Make a deck of a dataset.
   subroutine import_dataset(source, file, imported, mistakes)
      type(source_t), intent(in) :: source                 !! the dataset
      character(*), intent(in) :: file                     !! its name, for the deck to say
      type(imported_t), intent(out) :: imported            !! the deck
      type(diagnostics_t), intent(inout) :: mistakes       !! collects what is wrong

      type(adams_model_t) :: model
      type(deck_draft_t) :: draft
      type(statement_t), allocatable :: statements(:)
      type(buffer_t) :: buffer
      type(text_list_t) :: settings
      character(:), allocatable :: title
      integer :: k

      call read_statements(source, title, statements)
      call full_names(statements)
      call name_foreign(statements, mistakes)
      if (mistakes%count() > 0) return
      call name_refused(statements, mistakes)
      call name_doubles(statements, mistakes)
      if (mistakes%count() > 0) return
      call new_model(title, statements, model, mistakes)
      if (mistakes%count() > 0) return
      call add_bodies(model, draft, mistakes)
      call add_joints(model, draft, mistakes)
      call add_primitives(model, draft, mistakes)
      call add_constraints(model, draft)
      call add_gears(model, draft, mistakes)
      call add_motions(model, draft, mistakes)
      call add_forces(model, draft, mistakes)
      call add_loads(model, draft, mistakes)
      call add_elastic(model, draft, mistakes)
      call add_contacts(model, draft, mistakes)
      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (is_setting(it%keyword)) then
               if (.not. it%is_used) call settings%add(line_words(it%at)//it%keyword)
            else if (is_understood(it%keyword)) then
               call name_unknown_arguments(model, it)
               call name_small_degrees(model, it)
               call name_idle_splines(model, draft, it)
            else
               call leave_out(model, it, reason_against(it%keyword))
            end if
         end associate
      end do
      imported%left_out = model%left_out%get()
      imported%changed = model%changed%get()
      imported%settings = settings%get()
      call write_head(model, file, imported, buffer, mistakes)
      call draft%write(buffer)
      call buffer%line(new_line("a")//"[analysis.dynamic]")
      call buffer%line("end        = {end}")
      call buffer%line("tolerance  = 1e-8")
      call buffer%line("")
      call buffer%line("[output]")
      call buffer%line("every      = {every}")
      call buffer%line("channels   = *")
      imported%deck = buffer%get()
   end subroutine import_dataset

   !> A file without any statement of Adams is no dataset.
   subroutine name_foreign(statements, mistakes)
      type(statement_t), intent(in) :: statements(:)       !! (n) statements, their names in full
      type(diagnostics_t), intent(inout) :: mistakes       !! collects what is wrong

      integer :: k

      if (size(statements) == 0) return
      if (any([(is_known(statements(k)), k=1, size(statements))])) return
      call mistake(mistakes, statements(1)%at, "the file has no statement of an Adams dataset; the first line "// &
                   "is invalid", &
                   "a statement is a name with a slash, as PART/2, MASS = 1; a deck needs no import: gudgeon run DECK")
   end subroutine name_foreign

   !> Statements of what gudgeon does not model are errors: without them the dataset is of another mechanism.
   subroutine name_refused(statements, mistakes)
      type(statement_t), intent(in) :: statements(:)       !! (n) statements, their names in full
      type(diagnostics_t), intent(inout) :: mistakes       !! collects what is wrong

      integer :: k

      do k = 1, size(statements)
         if (.not. (is_refused(statements(k)%keyword) .and. statements(k)%has_slash)) cycle
         call mistake(mistakes, statements(k)%at, statements(k)%keyword//"/"//to_text(statements(k)%id)// &
            " is an elastic body; gudgeon supports rigid bodies only", &
            "remove it from the dataset, or replace it by a SPRINGDAMPER or a FIXED joint")
      end do
   end subroutine name_refused

   !> Two statements of one name and number are an error: nobody can say which of them is meant.
   subroutine name_doubles(statements, mistakes)
      type(statement_t), intent(in) :: statements(:)       !! (n) statements, their names in full
      type(diagnostics_t), intent(inout) :: mistakes       !! collects what is wrong

      type(name_table_t) :: seen
      character(:), allocatable :: name
      integer :: first, k

      do k = 1, size(statements)
         associate (it => statements(k))
            if (.not. is_understood(it%keyword) .or. it%id < 0) cycle
            name = it%keyword//"/"//to_text(it%id)
            call seen%enter(name, k, first)
            if (first > 0) call mistake(mistakes, it%at, name//" is defined twice", "first in line "// &
                                        to_text(statements(first)%at%line))
         end associate
      end do
   end subroutine name_doubles

   !> Title, what is omitted, gravity, parameters.
   subroutine write_head(model, file, imported, buffer, mistakes)
      type(adams_model_t), intent(in) :: model             !! the dataset
      character(*), intent(in) :: file                     !! its name
      type(imported_t), intent(in) :: imported             !! what is omitted
      type(buffer_t), intent(inout) :: buffer              !! the deck
      type(diagnostics_t), intent(inout) :: mistakes       !! collects what is wrong

      real(wp) :: gravity(3)
      integer :: i, k
      real(wp), allocatable :: numbers(:)
      character(5), parameter :: names(3) = ["IGRAV", "JGRAV", "KGRAV"]

      call buffer%line("# Made from the Adams dataset "//one_line(file)//" by gudgeon import.")
      call add_list(buffer, "Not supported, omitted from this deck:", imported%left_out)
      call add_list(buffer, "Changed or assumed:", imported%changed)
      call buffer%line("deck = 1")
      call buffer%line("")
      call buffer%line("[scene]")
      call buffer%line("title    = """//quoted(one_line(model%title))//"""")
      call buffer%line("space    = spatial")
      gravity = 0.0_wp
      do k = 1, size(model%statements)
         if (model%statements(k)%keyword /= "ACCGRAV" .and. model%statements(k)%keyword /= "GRAVITY") cycle
         do i = 1, 3
            call argument_numbers(model%statements(k), names(i), numbers, mistakes, 1)
            if (size(numbers) > 0) gravity(i) = numbers(1)*model%units%length/model%units%time**2
         end do
      end do
      call buffer%line("gravity  = "//real_text(gravity(1), 15)//" "//real_text(gravity(2), 15)//" "//real_text(gravity(3), 15)// &
                       " m/s^2")
      call buffer%line("")
      call buffer%line("[parameters]               # a dataset has no end time:  --set end=5s")
      call buffer%line("end      = 1 s")
      call buffer%line("every    = 10 ms")
   end subroutine write_head

   !> A list in comments.
   subroutine add_list(buffer, heading, list)
      type(buffer_t), intent(inout) :: buffer   !! the deck
      character(*), intent(in) :: heading       !! what it is
      type(text_t), intent(in) :: list(:)       !! (n) lines

      integer :: k

      if (size(list) == 0) return
      call buffer%line("#")
      call buffer%line("# "//heading)
      do k = 1, size(list)
         call buffer%line("#   "//one_line(list(k)%s))
      end do
   end subroutine add_list

   !> A text without control characters.
   pure function one_line(text) result(plain)
      character(*), intent(in) :: text        !! any text
      character(len(text)) :: plain           !! blanks for control characters

      integer :: k

      plain = text
      do k = 1, len(text)
         if (iachar(text(k:k)) < 32 .or. iachar(text(k:k)) == 127) plain(k:k) = " "
      end do
   end function one_line

   !> A text as it stands between quotes in a deck.
   pure function quoted(text) result(inner)
      character(*), intent(in) :: text          !! any text
      character(:), allocatable :: inner        !! with signs before quotes

      integer :: k

      inner = ""
      do k = 1, len(text)
         if (text(k:k) == """" .or. text(k:k) == "\") inner = inner//"\"
         inner = inner//text(k:k)
      end do
   end function quoted

   !> Rows of the bodies.
   subroutine add_bodies(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(:), allocatable :: eta, inertia, length, name, xi
      real(wp) :: centre(3), size_of_all, unit
      integer :: k
      type(text_t) :: turn(3), velocity(3)

      length = model%units%length_name()
      unit = model%units%length_shown()
      inertia = "[kg."//length//"^2]"
      size_of_all = 0.0_wp
      do k = 1, size(model%parts)
         size_of_all = max(size_of_all, maxval(abs(model%parts(k)%r)) + maxval(abs(model%parts(k)%centre)))
      end do
      do k = 1, size(model%parts)
         associate (part => model%parts(k))
            if (part%is_ground) cycle
            call draft%new_name(part%name, part%id, name)
            part%name = name
            centre = part%r + matmul(part%a, part%centre)
            xi = ""
            eta = ""
            if (maxval(abs(part%a - reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3]))) > 0.0_wp) then
               xi = direction_cell(part%a(:, 1))
               eta = direction_cell(part%a(:, 2))
            end if
            call find_velocities(model, k, velocity, turn, mistakes)
            associate (j => part%inertia/unit**2, most => maxval(abs(part%inertia))/unit**2)
               call draft%put("bodies", "name mass[kg] ixx"//inertia//" iyy"//inertia//" izz"//inertia//" ixy"//inertia//" ixz"// &
                              inertia//" iyz"//inertia//" x["//length//"] y["//length//"] z["//length//"] xi_axis eta_axis vx["// &
                              length//"/s] vy["//length//"/s] vz["//length//"/s] wx[rad/s] wy[rad/s] wz[rad/s]", &
                              name//tab//real_text(part%mass, 15)//tab//real_text(j(1, 1), 15)//tab//real_text(j(2, 2), 15)// &
                                    tab//real_text(j(3, 3), 15)//tab//number_cell(-j(1, 2), most)//tab//number_cell(-j(1, 3), &
                                          most)//tab//number_cell(-j(2, 3), most)//tab//number_cell(centre(1)/unit, &
                                                size_of_all/unit)//tab//number_cell(centre(2)/unit, size_of_all/unit)//tab// &
                                                      number_cell(centre(3)/unit, size_of_all/unit)//tab//xi//tab//eta//tab// &
                                                            velocity(1)%s//tab//velocity(2)%s//tab//velocity(3)%s//tab// &
                                                                  turn(1)%s//tab//turn(2)%s//tab//turn(3)%s)
            end associate
         end associate
      end do
   end subroutine add_bodies

   !> Velocities at the start as cells: of the centre of mass along the axes of VM, of the turn along those of WM, or of CM.
   subroutine find_velocities(model, number, velocity, turn, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      integer, intent(in) :: number                      !! of the part in the list
      type(text_t), intent(out) :: velocity(3)           !! (3) cells, in the deck's unit of length
      type(text_t), intent(out) :: turn(3)               !! (3) cells
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp) :: a(3, 3), slide(3)
      integer :: k, marker
      logical :: slides
      real(wp), allocatable :: id(:)

      associate (part => model%parts(number), it => model%statements(model%parts(number)%statement), &
                 factor => model%units%length/model%units%time/model%units%length_shown())
         a = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
         call argument_numbers(it, "VM", id, mistakes)
         if (size(id) > 0) then
            marker = model%marker(nint(id(1)))
            if (marker == 0) call mistake(mistakes, it%at, "its VM marker is missing", "")
            if (marker > 0) a = model%axes(marker)
         end if
         call velocity_cells(it, ["VX", "VY", "VZ"], a, factor, velocity, mistakes)
         call sliding_velocity(model, number, slide, slides, mistakes)
         do k = 1, merge(3, 0, slides)
            velocity(k)%s = real_text(merge(slide(k)*factor, 0.0_wp, abs(slide(k)) > 1.0e-14_wp*norm2(slide)), 15)
         end do
         a = part%a
         call argument_numbers(it, "WM", id, mistakes)
         if (size(id) == 0) call argument_numbers(it, "CM", id, mistakes)
         if (size(id) > 0) then
            marker = model%marker(nint(id(1)))
            if (marker == 0) call mistake(mistakes, it%at, "its WM marker is missing", "")
            if (marker > 0) a = model%axes(marker)
         end if
         call velocity_cells(it, ["WX", "WY", "WZ"], a, 1.0_wp/model%units%time, turn, mistakes)
         if (has_word(it, "EXACT")) call model%changed%add(line_words(it%at)//"EXACT of PART/"//to_text(part%id)// &
                                                            ": assembly moves all bodies as little as possible")
      end associate
      do k = 1, 3
         if (.not. allocated(turn(k)%s)) turn(k)%s = ""
      end do
   end subroutine find_velocities

   !> Three components along the axes of the world; what the dataset does not give stays free, where the axes are those of the
   !> world.
   subroutine velocity_cells(statement, names, a, factor, cells, mistakes)
      type(statement_t), intent(in) :: statement         !! the part
      character(2), intent(in) :: names(3)               !! (3) arguments
      real(wp), intent(in) :: a(3, 3)                    !! (3, 3) axes that they are along, world [1]
      real(wp), intent(in) :: factor                     !! from the dataset to the deck [any]
      type(text_t), intent(out) :: cells(3)              !! (3) the components; blank: free
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp) :: x(3), world(3)
      real(wp), allocatable :: numbers(:)
      logical :: is_given(3), is_touched
      integer :: k

      x = 0.0_wp
      is_given = .false.
      do k = 1, 3
         call argument_numbers(statement, names(k), numbers, mistakes)
         is_given(k) = size(numbers) > 0
         if (is_given(k)) x(k) = numbers(1)*factor
      end do
      world = matmul(a, x)
      do k = 1, 3
         is_touched = any(is_given .and. abs(a(k, :)) > 1.0e-12_wp)
         cells(k)%s = ""
         if (is_touched) cells(k)%s = real_text(merge(world(k), 0.0_wp, abs(world(k)) > 1.0e-14_wp*norm2(x)), 15)
      end do
   end subroutine velocity_cells

end module adams_deck
