!> Contacts of an Adams dataset as rows of a deck.
!>
!> | Adams | deck |
!> |---|---|
!> | CONTACT of two ELLIPSOIDs that are spheres | `clearance.discs` |
!> | CONTACT of a sphere and a PLANE, or a BOX | `clearance.plane` |
!> | IMPACT | `contact.expression`, K delta^e + C s^2 (3 - 2 s) rate with s = min(delta/DMAX, 1) |
!> | POISSON | `contact.kelvin_voigt` |
!> | COULOMB_FRICTION | `friction.brown_mcphee` with MU_STATIC at STICTION_TRANSITION_VELOCITY |
!>
!> XSCALE, YSCALE and ZSCALE of an ellipsoid are its diameters. The normal of a PLANE is z of RM. Of a BOX the face counts behind
!> which it lies for the sphere at the start. Source: the public descriptions of the statements of Adams/Solver. Limits: one
!> geometry on each side, outside of each other at the start; planes and faces of boxes have no edges in a deck.
module adams_contacts
   use adams_joints, only: named
   use adams_model, only: adams_model_t, find_statement, leave_out
   use adams_numbers, only: argument_numbers, id_of, mistake
   use dataset, only: expression_of, find_argument, has_word, line_words, statement_t, upper_case
   use deck_draft, only: body_axis, deck_draft_t, tab
   use deck_table, only: direction_cell, number_cell
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: add_contacts

   integer, parameter :: none = 0, sphere = 1, plane = 2, box = 3   !! shapes

   !> The geometry of one side of a contact.
   type :: shape_t
      integer :: kind = none             !! sphere, plane, box; none: no such one
      integer :: marker = 0              !! centre, point of the plane, corner; its place in the list
      real(wp) :: extent(3) = 0.0_wp     !! (3) radius of a sphere; edges of a box along the axes of the marker [m]
   end type shape_t

contains

   !> All of them.
   subroutine add_contacts(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      integer :: k

      do k = 1, size(model%statements)
         if (model%statements(k)%keyword == "CONTACT") call add_contact(model, draft, model%statements(k), mistakes)
      end do
   end subroutine add_contacts

   !> A contact.
   subroutine add_contact(model, draft, statement, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(:), allocatable :: friction, law, name, point_i, point_j, reason
      type(shape_t) :: i, j

      call find_shape(model, statement, "IGEOM", i, reason, mistakes)
      if (reason == "") call find_shape(model, statement, "JGEOM", j, reason, mistakes)
      if (reason == "" .and. i%kind /= sphere .and. j%kind /= sphere) reason = "neither side is a sphere"
      if (reason == "" .and. .not. (has_word(statement, "IMPACT", 2) .or. has_word(statement, "POISSON", 2))) then
         reason = "its force is user code outside the dataset"
      end if
      if (reason /= "") then
         call leave_out(model, statement, reason//"; see the joints with clearance, clearance.*")
         return
      end if
      call draft%new_name(named(statement), statement%id, name)
      call put_law(model, draft, statement, name//"_law", mistakes)
      call put_friction(model, draft, statement, name//"_friction", friction, mistakes)
      if (.not. draft%has("material")) call draft%put("material", "name young[Pa] poisson", "of_contacts"//tab//"2e11"//tab//"0.3")
      law = tab//"of_contacts"//tab//name//"_law"//tab//friction
      if (i%kind == sphere .and. j%kind == sphere) then
         call draft%point(model, j%marker, point_i)
         call draft%point(model, i%marker, point_j)
         call draft%put("clearance.discs", "name i j radius_i[m] radius_j[m] material law friction", name//tab//point_i//tab// &
                        point_j//tab//number_cell(j%extent(1), 0.0_wp)//tab//number_cell(i%extent(1), 0.0_wp)//law)
      else if (i%kind == sphere) then
         call put_on_plane(model, draft, statement, name, j, i, law)
      else
         call put_on_plane(model, draft, statement, name, i, j, law)
      end if
   end subroutine add_contact

   !> The geometry of one side.
   subroutine find_shape(model, statement, side, shape, reason, mistakes)
      type(adams_model_t), intent(inout) :: model             !! the dataset
      type(statement_t), intent(in) :: statement              !! the contact
      character(*), intent(in) :: side                        !! IGEOM or JGEOM
      type(shape_t), intent(out) :: shape                     !! the geometry
      character(:), allocatable, intent(out) :: reason        !! why a deck cannot have it; blank: it can
      type(diagnostics_t), intent(inout) :: mistakes          !! collects what is wrong

      real(wp), parameter :: same = 1.0e-9_wp   ! diameters of a sphere, over them [1]
      real(wp) :: numbers(3)
      real(wp), allocatable :: ids(:)
      integer :: at

      reason = ""
      call argument_numbers(statement, side, ids, mistakes, 2)
      if (size(ids) /= 1) then
         reason = side//" has "//to_text(size(ids))//" geometries where a deck has one"
         return
      end if
      at = find_statement(model, "GRAPHICS", nint(min(abs(ids(1)), 1.0e9_wp)))
      if (at == 0) then
         reason = "its "//side//" is no GRAPHICS of the dataset"
         return
      end if
      associate (graphics => model%statements(at), length => model%units%length)
         if (has_word(graphics, "ELLIPSOID", 3)) then
            shape%marker = model%marker(id_of(graphics, "CM", mistakes))
            call read_three(graphics, [character(6) :: "XSCALE", "YSCALE", "ZSCALE"], numbers, mistakes)
            if (maxval(numbers) - minval(numbers) <= same*maxval(abs(numbers))) shape%kind = sphere
            shape%extent = 0.5_wp*length*numbers
         else if (has_word(graphics, "PLANE", 1)) then
            shape%marker = model%marker(id_of(graphics, "RM", mistakes))
            shape%kind = plane
         else if (has_word(graphics, "BOX", 2)) then
            shape%marker = model%marker(id_of(graphics, "CORNER", mistakes, 2))
            call read_three(graphics, [character(6) :: "X", "Y", "Z"], numbers, mistakes)
            shape%kind = box
            shape%extent = length*numbers
         end if
         if (shape%marker == 0) reason = "its "//side//" has no marker of a rigid part"
         if (shape%kind == sphere .and. .not. shape%extent(1) > 0.0_wp) reason = "its "//side//" has no size"
         if (shape%kind == none) reason = "its "//side//" is no sphere, plane or box"
         graphics%is_used = reason == ""
      end associate
   end subroutine find_shape

   !> Three arguments of a number each; zeros without them.
   subroutine read_three(statement, names, numbers, mistakes)
      type(statement_t), intent(in) :: statement        !! the statement
      character(*), intent(in) :: names(3)              !! (3) of the arguments
      real(wp), intent(out) :: numbers(3)               !! (3) the numbers [any]
      type(diagnostics_t), intent(inout) :: mistakes    !! collects what is wrong

      integer :: k

      do k = 1, 3
         numbers(k) = number_of(statement, trim(names(k)), 1, mistakes)
      end do
   end subroutine read_three

   !> The number of an argument; 0 without it.
   real(wp) function number_of(statement, name, minimum, mistakes) result(number)
      type(statement_t), intent(in) :: statement        !! the statement
      character(*), intent(in) :: name                  !! of the argument
      integer, intent(in) :: minimum                    !! letters that do for it
      type(diagnostics_t), intent(inout) :: mistakes    !! collects what is wrong

      real(wp), allocatable :: found(:)

      number = 0.0_wp
      if (find_argument(statement, name, minimum) == 0) return
      call argument_numbers(statement, name, found, mistakes, minimum, wanted=1)
      if (size(found) > 0) number = found(1)
   end function number_of

   !> A sphere on a plane, or on the face of a box.
   subroutine put_on_plane(model, draft, statement, name, base, ball, law)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the contact
      character(*), intent(in) :: name                   !! of the row
      type(shape_t), intent(in) :: base                  !! plane or box
      type(shape_t), intent(in) :: ball                  !! the sphere
      character(*), intent(in) :: law                    !! cells of material, law and friction

      character(*), parameter :: letters = "xyz"
      character(:), allocatable :: centre, foot
      real(wp) :: beyond(3, 2), normal(3), place(3)
      integer :: at(2)

      at = [3, 2]
      if (base%kind == box) then
         ! how far the centre lies beyond the faces
         place = matmul(transpose(model%axes(base%marker)), model%place(ball%marker) - model%place(base%marker))
         beyond(:, 1) = min(base%extent, 0.0_wp) - place
         beyond(:, 2) = place - max(base%extent, 0.0_wp)
         at = maxloc(beyond)
         if (beyond(at(1), at(2)) <= 0.0_wp) then
            call leave_out(model, statement, "the sphere starts within the box")
            return
         end if
      end if
      normal = merge(1.0_wp, -1.0_wp, at(2) == 2)*body_axis(model, base%marker, at(1))
      call draft%point(model, base%marker, foot)
      if (base%kind == box) then
         place = 0.0_wp
         place(at(1)) = merge(max(base%extent(at(1)), 0.0_wp), min(base%extent(at(1)), 0.0_wp), at(2) == 2)
         call put_face_point(model, draft, base%marker, place, name//"_face", foot)
      end if
      call draft%point(model, ball%marker, centre)
      call draft%put("clearance.plane", "name plane ball axis_i radius[m] material law friction", name//tab//foot//tab//centre// &
                     tab//direction_cell(normal)//tab//number_cell(ball%extent(1), 0.0_wp)//law)
      call model%changed%add(line_words(statement%at)//named(statement)//": the "// &
                             trim(merge("plane          ", "face of the box", base%kind == plane))//" across "// &
                             letters(at(1):at(1))//" has no edges in a deck")
   end subroutine put_on_plane

   !> A point on the face of a box, for which the dataset has no marker.
   subroutine put_face_point(model, draft, marker, place, name, foot)
      type(adams_model_t), intent(in) :: model               !! the dataset
      type(deck_draft_t), intent(inout) :: draft             !! the deck
      integer, intent(in) :: marker                          !! the corner
      real(wp), intent(in) :: place(3)                       !! (3) from the corner, its axes [m]
      character(*), intent(in) :: name                       !! of the point
      character(:), allocatable, intent(out) :: foot         !! the same, unless a point has that name

      integer :: previous

      foot = name
      call draft%points%enter(foot, -1, previous)
      do while (previous /= 0)
         foot = foot//"_"
         call draft%points%enter(foot, -1, previous)
      end do
      call draft%put_point(model, foot, marker, place)
   end subroutine put_face_point

   !> The law of the normal force.
   subroutine put_law(model, draft, statement, name, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the contact
      character(*), intent(in) :: name                   !! of the row
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(:), allocatable :: power, share, text
      real(wp) :: damping, depth, exponent, stiffness

      associate (u => model%units)
         if (.not. has_word(statement, "IMPACT", 2)) then
            stiffness = number_of(statement, "PENALTY", 2, mistakes)*u%force/u%length
            call draft%put("contact.kelvin_voigt", "name stiffness[N/m] restitution", name//tab//real_text(stiffness, 15)//tab// &
                           real_text(number_of(statement, "RESTITUTION_COEFFICIENT", 1, mistakes), 15))
            call model%changed%add(line_words(statement%at)//named(statement)//": POISSON is contact.kelvin_voigt")
         else
            exponent = number_of(statement, "EXPONENT", 1, mistakes)
            if (find_argument(statement, "EXPONENT", 1) == 0) exponent = 1.0_wp
            stiffness = number_of(statement, "STIFFNESS", 4, mistakes)*u%force/u%length**exponent
            damping = number_of(statement, "DAMPING", 2, mistakes)*u%force/u%length*u%time
            depth = number_of(statement, "DMAX", 2, mistakes)*u%length
            power = real_text(exponent, 15)
            text = real_text(stiffness, 15)//"N/m^"//power//"*delta^"//power
            share = "1"
            if (depth > 0.0_wp) then
               share = "min(delta/"//real_text(depth, 15)//"m, 1)"
               share = share//"^2*(3 - 2*"//share//")"
            end if
            if (damping > 0.0_wp) text = text//" + "//real_text(damping, 15)//"N.s/m*"//share//"*rate"
            call draft%put("contact.expression", "name force", name//tab//"{"//text//"}")
         end if
      end associate
      if (.not. stiffness > 0.0_wp) call mistake(mistakes, statement%at, named(statement)//" has no stiffness", &
                                                 "IMPACT needs STIFFNESS, POISSON needs PENALTY")
   end subroutine put_law

   !> The law of friction, if there is friction.
   subroutine put_friction(model, draft, statement, name, cell, mistakes)
      type(adams_model_t), intent(inout) :: model             !! the dataset
      type(deck_draft_t), intent(inout) :: draft              !! the deck
      type(statement_t), intent(in) :: statement              !! the contact
      character(*), intent(in) :: name                        !! of the row
      character(:), allocatable, intent(out) :: cell          !! the same; blank: no friction
      type(diagnostics_t), intent(inout) :: mistakes          !! collects what is wrong

      character(:), allocatable :: switch
      real(wp) :: dynamic, speed, static

      cell = ""
      switch = upper_case(expression_of(statement, "COULOMB_FRICTION", 1))
      if (switch == "" .or. switch == "OFF") return
      static = number_of(statement, "MU_STATIC", 4, mistakes)
      dynamic = number_of(statement, "MU_DYNAMIC", 4, mistakes)
      speed = number_of(statement, "STICTION_TRANSITION_VELOCITY", 4, mistakes)*model%units%length/model%units%time
      if (max(static, dynamic) <= 0.0_wp) return
      if (.not. speed > 0.0_wp) then
         call mistake(mistakes, statement%at, named(statement)//" has friction and no STICTION_TRANSITION_VELOCITY", "")
         return
      end if
      cell = name
      call draft%put("friction.brown_mcphee", "name coefficient static_coefficient v_t[m/s]", name//tab//real_text(dynamic, 15)// &
                     tab//real_text(max(static, dynamic), 15)//tab//real_text(speed, 15))
      call model%changed%add(line_words(statement%at)//named(statement)//": friction falls from MU_STATIC to MU_DYNAMIC as "// &
                             "friction.brown_mcphee does")
   end subroutine put_friction

end module adams_contacts
