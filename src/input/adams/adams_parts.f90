!> Units, parts and markers of an Adams dataset, read into its model.
!>
!> A part has a frame of its own (QG; REULER, three turns about z, x, z; or ZG and XG, points on its axis z and in its plane of x
!> and z). A marker lies in it (QP; REULER; ZP and XP). The deck's body has the axes of that frame and the centre of mass as its
!> origin. IP is the tensor about the origin of IM along its axes (CM, if there is no IM), its last three the integrals of xy, xz,
!> yz: J_cm = A J A^T - m (d^2 E - d d^T), d from the centre of mass to the origin of IM.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: markers on rigid parts; no point masses, flexible
!> bodies.
module adams_parts
   use adams_model, only: adams_model_t, marker_t, part_t
   use adams_numbers, only: argument_numbers, id_of, mistake, vector_numbers
   use adams_units, only: read_units
   use dataset, only: find_argument, has_word, line_words, statement_t
   use diagnostics, only: diagnostics_t
   use item, only: location_t
   use kinds, only: wp
   use motion, only: cross
   use rotations, only: rotation_of_axes, rotation_of_sequence
   use text, only: to_text
   implicit none (type, external)
   private
   public :: new_model

   real(wp), parameter :: nothing = 1.0e-15_wp  !! less than this of a direction is round-off [1]

contains

   !> Understand units, parts and markers.
   subroutine new_model(title, statements, model, mistakes)
      character(*), intent(in) :: title                      !! first line of the dataset
      type(statement_t), intent(in) :: statements(:)         !! (n) its statements, with their names in full
      type(adams_model_t), intent(out) :: model              !! what they say
      type(diagnostics_t), intent(inout) :: mistakes         !! collects what is wrong

      character(:), allocatable :: message
      integer :: k

      model%title = title
      model%statements = statements
      do k = 1, size(statements)
         if (statements(k)%keyword /= "UNITS") cycle
         call read_units(statements(k), model%units, message)
         if (message /= "") call mistake(mistakes, statements(k)%at, message, "")
      end do
      if (.not. model%units%is_given) call model%changed%add("no UNITS: m, kg, N, s are assumed")
      call read_parts(model, mistakes)
      call read_markers(model, mistakes)
      do k = 1, size(model%parts)
         if (.not. model%parts(k)%is_ground) call read_mass(model, model%parts(k), mistakes)
      end do
   end subroutine new_model

   !> Frames of all parts.
   subroutine read_parts(model, mistakes)
      type(adams_model_t), intent(inout) :: model       !! the dataset
      type(diagnostics_t), intent(inout) :: mistakes    !! collects what is wrong

      type(part_t) :: new
      integer :: k, n

      model%joints = pack([(k, k=1, size(model%statements))], &
                          [(model%statements(k)%keyword == "JOINT", k=1, size(model%statements))])
      allocate (model%parts(count([(model%statements(k)%keyword == "PART", k=1, size(model%statements))])))
      n = 0
      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (it%keyword /= "PART") cycle
            new = part_t(id=it%id, statement=k)
            new%is_ground = has_word(it, "GROUND", 2)
            new%name = "PART_"//to_text(it%id)
            if (it%view_name /= "") new%name = it%view_name
            if (new%is_ground) new%name = "ground"
            call read_frame(model%units%length, it, "QG", "ZG", "XG", .false., new%r, new%a, mistakes)
            n = n + 1
            model%parts(n) = new
         end associate
      end do
      if (size(model%parts) == 0) call mistake(mistakes, location_t(1, 1, 1, 1), "the dataset has no PART", &
                                                     "check that it is an Adams dataset (.adm)")
   end subroutine read_parts

   !> Origin and axes of a part or marker.
   subroutine read_frame(length, statement, origin, on_z, on_x, x_first, r, a, mistakes)
      real(wp), intent(in) :: length                    !! unit of the dataset [m]
      type(statement_t), intent(in) :: statement        !! PART or MARKER
      character(*), intent(in) :: origin                !! argument of the origin
      character(*), intent(in) :: on_z                  !! argument of a point on the axis z
      character(*), intent(in) :: on_x                  !! argument of a point in the plane of x and z
      logical, intent(in) :: x_first                    !! that point is on the axis x, the other in the plane
      real(wp), intent(out) :: r(3)                     !! (3) origin [m]
      real(wp), intent(out) :: a(3, 3)                  !! (3, 3) axes as columns [1]
      type(diagnostics_t), intent(inout) :: mistakes    !! collects what is wrong

      real(wp) :: angles(3), x(3), y(3), z(3)
      logical :: has_angles, has_origin, has_x, has_z

      call vector_numbers(statement, origin, r, has_origin, mistakes)
      call vector_numbers(statement, "REULER", angles, has_angles, mistakes)
      if (.not. has_angles) call vector_numbers(statement, "EULER", angles, has_angles, mistakes)
      call vector_numbers(statement, on_z, z, has_z, mistakes)
      call vector_numbers(statement, on_x, x, has_x, mistakes)
      a = rotation_of_sequence("zxz", angles)
      if (has_z .or. has_x) then
         z = merge(z - r, [0.0_wp, 0.0_wp, 1.0_wp], has_z)
         x = merge(x - r, [1.0_wp, 0.0_wp, 0.0_wp], has_x)
         if (x_first) then
            a = rotation_of_axes(x, cross(z, x))
         else
            if (.not. has_x .and. norm2(cross(z, x)) <= 1.0e-6_wp*norm2(z)) x = [0.0_wp, 0.0_wp, -sign(1.0_wp, z(1))]
            y = cross(z, x)
            a = rotation_of_axes(y, z)
            a = reshape([cross(a(:, 1), a(:, 2)), a(:, 1), a(:, 2)], [3, 3])
         end if
         if (.not. any(abs(a) > 0.0_wp)) call mistake(mistakes, statement%at, "the points "//on_z//" and "//on_x// &
                                                      " are collinear, or at the origin", "")
      end if
      where (abs(a) < nothing) a = 0.0_wp
      where (abs(abs(a) - 1.0_wp) < nothing) a = sign(1.0_wp, a)
      r = r*length
   end subroutine read_frame

   !> All markers.
   subroutine read_markers(model, mistakes)
      type(adams_model_t), intent(inout) :: model       !! the dataset
      type(diagnostics_t), intent(inout) :: mistakes    !! collects what is wrong

      type(marker_t) :: new
      integer :: id, ids(size(model%parts)), k, last, n

      ids = [(model%parts(k)%id, k=1, size(model%parts))]
      allocate (model%markers(count([(model%statements(k)%keyword == "MARKER", k=1, size(model%statements))])))
      n = 0
      last = 0
      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (it%keyword == "PART") last = it%id
            if (it%keyword /= "MARKER") cycle
            if (has_word(it, "FLOATING", 2) .or. find_argument(it, "FLEX_BODY", 2) > 0 .or. &
                find_argument(it, "POINT_MASS", 2) > 0) cycle
            id = id_of(it, "PART", mistakes, 1)
            if (find_argument(it, "PART", 1) == 0) id = last
            new = marker_t(id=it%id)
            new%part = findloc(ids, id, dim=1)
            if (new%part == 0) then
               call mistake(mistakes, it%at, "MARKER/"//to_text(it%id)//" is on PART/"//to_text(id)//", which does not exist", "")
               cycle
            end if
            new%name = "MARKER_"//to_text(it%id)
            if (it%view_name /= "") new%name = it%view_name
            call read_frame(model%units%length, it, "QP", "ZP", "XP", has_word(it, "USEXP", 3), new%r, new%a, mistakes)
            n = n + 1
            model%markers(n) = new
         end associate
      end do
      model%markers = model%markers(:n)
   end subroutine read_markers

   !> Mass, centre of mass and tensor of inertia of a part.
   subroutine read_mass(model, part, mistakes)
      type(adams_model_t), intent(inout) :: model       !! the dataset, with its markers
      type(part_t), intent(inout) :: part               !! the part
      type(diagnostics_t), intent(inout) :: mistakes    !! collects what is wrong

      real(wp), allocatable :: ip(:), mass(:)
      real(wp) :: d(3), j(3, 3)
      integer :: cm, im, k
      character(:), allocatable :: words

      associate (it => model%statements(part%statement), unit => model%units%mass*model%units%length**2)
         call argument_numbers(it, "MASS", mass, mistakes, 1)
         if (size(mass) > 0) part%mass = mass(1)*model%units%mass
         cm = marker_of(model, it, "CM", mistakes)
         im = marker_of(model, it, "IM", mistakes)
         if (cm > 0) part%centre = model%markers(cm)%r
         if (im == 0) im = cm
         call argument_numbers(it, "IP", ip, mistakes)
         if (size(ip) > 0 .and. size(ip) /= 3 .and. size(ip) /= 6) call mistake(mistakes, &
                                                             it%arguments(find_argument(it, "IP"))%at, &
                                                             "IP needs three or six numbers", "")
         if (min(part%mass, minval(ip(:min(3, size(ip))))) < 0.0_wp) call mistake(mistakes, it%at, "PART/"//to_text(part%id)// &
                                                                         " has a negative mass or moment of inertia", "")
         j = 0.0_wp
         if (size(ip) >= 3) then
            do k = 1, 3
               j(k, k) = ip(k)*unit
            end do
         end if
         if (size(ip) == 6) then
            j(1, 2:3) = -ip(4:5)*unit
            j(2, 3) = -ip(6)*unit
            j(2:3, 1) = j(1, 2:3)
            j(3, 2) = j(2, 3)
         end if
         if (im > 0) then
            j = matmul(model%markers(im)%a, matmul(j, transpose(model%markers(im)%a)))
            d = model%markers(im)%r - part%centre
            j = j + part%mass*matmul(reshape(d, [3, 1]), reshape(d, [1, 3]))
            do k = 1, 3
               j(k, k) = j(k, k) - part%mass*dot_product(d, d)
            end do
         end if
         part%inertia = j
         words = "PART/"//to_text(part%id)//" ("//part%name//")"
         if (.not. part%mass > 0.0_wp) then
            part%mass = 1.0e-6_wp
            call model%changed%add(line_words(it%at)//words//" has no mass: 1e-6 kg assumed")
         end if
         if (.not. (j(1, 1) > 0.0_wp .and. j(2, 2) > 0.0_wp .and. j(3, 3) > 0.0_wp)) then
            part%inertia = 0.0_wp
            do k = 1, 3
               part%inertia(k, k) = 1.0e-6_wp*part%mass
            end do
            call model%changed%add(line_words(it%at)//words// &
                  " has no moments of inertia: mass times 1e-6 m^2 assumed")
         end if
      end associate
   end subroutine read_mass

   !> The marker of an argument, by its place in the list; 0: there is no such argument, or no such marker.
   integer function marker_of(model, statement, name, mistakes) result(marker)
      type(adams_model_t), intent(in) :: model          !! the dataset, with its markers
      type(statement_t), intent(in) :: statement        !! the statement
      character(*), intent(in) :: name                  !! of the argument
      type(diagnostics_t), intent(inout) :: mistakes    !! collects what is wrong

      integer :: k

      marker = model%marker(id_of(statement, name, mistakes))
      k = find_argument(statement, name)
      if (marker == 0 .and. k > 0) call mistake(mistakes, statement%arguments(k)%at, "the "//name//" marker does not exist", "")
   end function marker_of

end module adams_parts
