!> Joints with clearance of any geometry, brought into contact: what their tests start from.
!>
!> Three items: a journal (ball, slider) of a body in the bearing (on the plane, in the guide) of another, in one of the
!> ground, and the ground's journal in the bearing of a body. They share no body, so that each is brought into contact alone.
!> A slider has its corners C and D at the upper surface, D less deep, or not at all of the third item.
module clearance_bench
   use bodies, only: material_t, points_t
   use check, only: check_true
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t, n_integrand
   use clearance_translational, only: clearance_translational_t
   use contact_registry, only: n_friction_kinds, n_law_kinds, new_friction_law, new_normal_law
   use errors, only: error_t
   use fixed_random, only: random_t, seed_of
   use friction_law, only: friction_law_t, memory_bristle, memory_none, memory_slip
   use curve_rows, only: shape_curve
   use generic_item, only: column_number, fill_item, set_number
   use item, only: item_t
   use kind_info, only: kind_info_t, free_rotation, free_translation
   use kinds, only: wp
   use law_fixture, only: tame
   use motion, only: loads_t, motion_t, new_loads, new_motion
   use planar_kinds, only: is_planar_clearance
   use planar_coordinates, only: new_planar_coordinates, planar_coordinates_t, set_planar_motion
   use normal_law, only: n_law_parameter, normal_law_t
   use text, only: split_blank, text_t
   implicit none (type, external)
   private
   public :: bench_t, claim_all, evaluate_loads, get_gaps, make_bench, move_to, n_all, n_before, n_body, n_item

   integer, parameter :: n_item = 3                  !! items of the set
   integer, parameter :: n_before = 2                !! items of other sets before those of this one
   integer, parameter :: n_all = n_before + 8*n_item + 1  !! items, or contacts, of all sets, at most
   integer, parameter :: n_body = 4                  !! moving bodies
   integer, parameter :: n_form = 4                  !! forms of formulas, or ways of treating faces, at most
   integer, parameter :: body_i(n_item) = [1, 0, 4]  !! bodies of the bearings
   integer, parameter :: body_j(n_item) = [2, 3, 0]  !! bodies of the journals
   integer, parameter :: movable(n_item) = [2, 3, 4] !! bodies that are brought into contact
   real(wp), parameter :: hole = 10.0e-3_wp          !! radius of the bearings [m]
   real(wp), parameter :: gap = 0.5e-3_wp            !! radial clearance [m]
   real(wp), parameter :: depth = 2.0e-5_wp          !! penetration [m]

   !> A set with its motion.
   type :: bench_t
      class(clearance_set_t), allocatable :: set   !! the set, all items touching
      type(motion_t) :: motion                     !! of the bodies
      real(wp) :: q(3, n_body) = 0.0_wp            !! (3, bodies) coordinates [m, m, rad]
      real(wp) :: v(3, n_body) = 0.0_wp            !! (3, bodies) rates [m/s, m/s, rad/s]
      real(wp) :: a(3, n_body) = 0.0_wp            !! (3, bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      logical :: is_book = .false.                 !! formulas as the book prints them
      logical :: has_faces = .false.               !! contacts share faces
      integer, allocatable :: touching(:)          !! contacts of the set that touch
      integer, allocatable :: others(:)            !! places of other sets among the contacts
      integer :: first = 0                         !! place of the set's first contact among all
      integer :: last = 0                          !! place of its last contact
      logical :: has_form = .true.                 !! the kind has such a form, and the law fits it; if not, there is no set
      logical :: is_in_contact = .true.            !! all items have the requested penetration
      character(:), allocatable :: name            !! for messages
   end type bench_t

   abstract interface
      !> What is claimed of one combination.
      subroutine claim(error, bench)
         import :: bench_t, error_t
         implicit none (type, external)
         type(error_t), allocatable, intent(inout) :: error  !! what failed
         type(bench_t), intent(inout) :: bench               !! the combination
      end subroutine claim
   end interface

contains

   !> Claim something of all combinations.
   subroutine claim_all(error, what)
      type(error_t), allocatable, intent(out) :: error  !! what failed
      procedure(claim) :: what                          !! the claim

      type(bench_t) :: bench
      integer :: form, friction, kind, law, n, n_law

      n = 0
      do kind = 1, n_clearance_kinds()
         if (.not. is_planar_clearance(kind)) cycle
         n_law = n
         do law = 1, n_law_kinds()
            do friction = 0, n_friction_kinds()
               do form = 1, n_form
                  call make_bench(kind, law, friction, form, bench)
                  if (.not. bench%has_form) cycle
                  call check_true(error, bench%is_in_contact, bench%name//": all items are in contact")
                  if (allocated(error)) return
                  call what(error, bench)
                  n = n + 1
               end do
            end do
         end do
         call check_true(error, n - n_law >= 2*(n_friction_kinds() + 1), "two laws at least fit each geometry")
      end do
   end subroutine claim_all

   !> A geometry with a normal law, a friction law (0: none) and a form (1 the first that it offers).
   subroutine make_bench(kind, law_kind, friction_kind, form, bench)
      integer, intent(in) :: kind            !! number of the geometry
      integer, intent(in) :: law_kind        !! number of the normal law
      integer, intent(in) :: friction_kind   !! number of the friction law, 0: none
      integer, intent(in) :: form            !! number of the word in column `form`
      type(bench_t), intent(out) :: bench    !! the set, in contact

      class(friction_law_t), allocatable :: friction
      class(normal_law_t), allocatable :: law
      type(item_t) :: items(n_item), law_item
      type(kind_info_t) :: friction_info, info, law_info
      type(material_t) :: materials(n_item)
      type(points_t) :: points
      type(random_t) :: random
      type(text_t), allocatable :: words(:)
      character(:), allocatable :: help, message
      real(wp) :: delta(n_all), parameters(n_law_parameter), rate(n_all)
      integer :: c, k, level, m

      call new_clearance_set(kind, bench%set)
      info = bench%set%info()
      call new_normal_law(law_kind, law)
      law_info = law%info()
      bench%name = info%name//", "//law_info%name
      if (friction_kind > 0) then
         call new_friction_law(friction_kind, friction)
         friction_info = friction%info()
         bench%name = bench%name//", "//friction_info%name
      end if
      random%state = seed_of(bench%name, form)
      call fill_item(law_info, 1, random, law_item)
      call tame(law_info, law_item, .true.)  ! some laws are of other surfaces
      call set_number(law_info, "restitution", 0.7_wp, law_item)
      call law%prepare(law_item)
      if (friction_kind > 0) then
         call fill_item(friction_info, 1, random, law_item)
         call set_number(friction_info, "coefficient", 0.12_wp, law_item)
         call set_number(friction_info, "v0", 1.0e-4_wp, law_item)
         call set_number(friction_info, "v1", 1.0_wp, law_item)
         call set_number(friction_info, "v_r", 1.0e-3_wp, law_item)
         call set_number(friction_info, "v_t", 1.0e-3_wp, law_item)
         call set_number(friction_info, "static_coefficient", 0.15_wp, law_item)
         call set_number(friction_info, "force", 1.0e4_wp, law_item)
         call friction%prepare(law_item)
      end if
      c = column_number(info, "form") + column_number(info, "faces") + column_number(info, "contact")
      level = column_number(info, "level")
      words = split_blank("corrected")
      if (c > 0) words = split_blank(info%columns(c)%choices)
      bench%has_form = form <= size(words)
      if (.not. bench%has_form) return
      bench%is_book = words(form)%s == "book" .and. column_number(info, "form") > 0
      bench%has_faces = column_number(info, "faces") > 0 .and. words(form)%s /= "corners"
      if (bench%has_faces) call add_face_law(bench, random)
      if (.not. bench%has_form) return
      bench%name = bench%name//", "//words(form)%s
      points%n = 2*n_item
      allocate (points%body(2*n_item), points%s(3, 2*n_item))
      points%s = 0.0_wp
      do k = 1, n_item
         call fill_item(info, k, random, items(k))
         call set_number(info, "bearing_radius", hole, items(k))
         call set_number(info, "clearance", gap, items(k))
         call set_number(info, "radius", hole, items(k))
         call set_number(info, "radius_i", hole, items(k))
         call set_number(info, "radius_j", 0.5_wp*hole, items(k))
         call set_number(info, "length", 50.0e-3_wp, items(k))
         call set_number(info, "height", 40.0e-3_wp, items(k))
         call set_number(info, "width", 30.0e-3_wp, items(k))
         call set_number(info, "corner_radius", 1.0e-3_wp, items(k))
         call set_number(info, "gap_upper", gap, items(k))
         call set_number(info, "gap_lower", gap, items(k))
         call set_number(info, "lever", 0.2_wp, items(k))
         call set_number(info, "guide_start", 0.0_wp, items(k))
         call set_number(info, "guide_end", 0.0_wp, items(k))
         if (c > 0) items(k)%values(c)%text = words(form)%s
         call shape_curve(info, k, 3.0_wp*hole, 2.0_wp*(hole + gap), items(k))
         if (level > 0) items(k)%values(level)%text = "clearance"
         points%body(2*k - 1:2*k) = [body_i(k), body_j(k)]
         points%s(1:2, 2*k - 1) = random%vector(2, -0.05_wp, 0.05_wp)
         points%s(1:2, 2*k) = random%vector(2, -0.05_wp, 0.05_wp)
      end do
      call bench%set%new(items, [(2*k - 1, k=1, n_item)], [(2*k, k=1, n_item)], points, law, friction)
      bench%set%before%items = n_before
      bench%set%before%contacts = n_before
      materials%young = 207.0e9_wp
      materials%poisson = 0.3_wp
      bench%set%items%free = [free_rotation, free_translation, free_rotation]
      bench%set%items%slide_axis = reshape([1.0_wp, 0.0_wp, 0.6_wp, 0.8_wp, 0.0_wp, 1.0_wp], [2, n_item])
      call bench%set%take_surfaces(items, materials, [(1.0_wp, k=1, n_body)], [(.false., k=1, n_body)])
      call bench%set%prepare(items)
      do k = 1, n_item
         call bench%set%fit(k)
      end do
      call bench%set%laws%normal%fit(bench%set%items%pairs(1), parameters, message, help)
      bench%has_form = message == ""
      if (.not. bench%has_form) return
      bench%first = n_before + 1
      bench%last = n_before + bench%set%n_contact
      bench%others = [1, 2, (k, k=bench%last + 1, n_all)]
      call new_motion(n_body, bench%motion)
      do k = 1, n_body
         bench%q(:, k) = random%vector(3, -1.0_wp, 1.0_wp)*[0.1_wp, 0.1_wp, 3.0_wp]
         bench%v(:, k) = random%vector(3, -1.0_wp, 1.0_wp)*[1.0_wp, 1.0_wp, 20.0_wp]
         bench%a(:, k) = random%vector(3, -1.0_wp, 1.0_wp)*[100.0_wp, 100.0_wp, 2000.0_wp]
      end do
      do k = 1, n_item
         call align(bench, k)
         m = (k - 1)*bench%set%n_contact_item + 1
         if (bench%set%n_contact_item > 2) m = m + 2
         call bring_into_contact(bench, k, m, random%vector(2, -0.5_wp*gap, 0.5_wp*gap))
         call bench%set%begin_contact(m, 0.0_wp, 5.0_wp, 0.0_wp)
         call let_slip(bench, m)
      end do
      bench%touching = pack([(m, m=1, bench%set%n_contact)], bench%set%contact%is_touching)
      if (bench%set%n_contact_item <= 2) return
      call get_gaps(bench, 0.0_wp, delta, rate)
      do k = 1, n_item
         m = (k - 1)*bench%set%n_contact_item + 4
         if (.not. delta(n_before + m) > 0.0_wp) cycle
         call bench%set%begin_contact(m, 0.0_wp, 4.0_wp, 0.0_wp)
         call let_slip(bench, m)
      end do
      bench%touching = pack([(m, m=1, bench%set%n_contact)], bench%set%contact%is_touching)
      bench%is_in_contact = bench%is_in_contact .and. bench%set%n_touching == 2*n_item - 1
   end subroutine make_bench

   !> A contact that could stick slips the way that it moves; bristles are half bent that way.
   subroutine let_slip(bench, contact)
      type(bench_t), intent(inout) :: bench   !! the set
      integer, intent(in) :: contact          !! its contact

      if (bench%set%stick_slip%memory == memory_none) return
      call bench%set%lie(contact, bench%motion, bench%set%stick_slip%tangent(contact))
      associate (stick_slip => bench%set%stick_slip)
         if (stick_slip%memory == memory_slip) call bench%set%slip_toward(contact, stick_slip%tangent(contact)%v)
         if (stick_slip%memory == memory_bristle) then
            stick_slip%z(1, contact) = sign(0.5_wp*bench%set%laws%friction%bristle_scale(), stick_slip%tangent(contact)%v(1))
         end if
      end associate
   end subroutine let_slip

   !> A law for the faces of a slider.
   subroutine add_face_law(bench, random)
      type(bench_t), intent(inout) :: bench    !! the set
      type(random_t), intent(inout) :: random  !! for its parameters

      class(normal_law_t), allocatable :: law
      type(item_t) :: item
      type(kind_info_t) :: info
      integer :: k

      bench%has_form = .false.
      do k = 1, n_law_kinds()
         call new_normal_law(k, law)
         info = law%info()
         if (info%name /= "contact.plane_face") cycle
         call fill_item(info, 1, random, item)
         call set_number(info, "stiffness", 0.0_wp, item)
         call law%prepare(item)
         allocate (bench%set%laws%face, source=law)
         bench%has_form = .true.
      end do
   end subroutine add_face_law

   !> Turn a slider into its guide, a little askew.
   subroutine align(bench, item)
      type(bench_t), intent(inout) :: bench   !! the set
      integer, intent(in) :: item             !! item

      real(wp), parameter :: tilt(n_item) = [1.0e-4_wp, 2.0e-4_wp, 1.0e-3_wp]
      real(wp) :: along(2), angle(0:n_body), turn

      select type (set => bench%set)
      type is (clearance_translational_t)
         along = set%plane%point_j(:, 8*item - 6) - set%plane%point_j(:, 8*item - 7)
         turn = atan2(set%guide%axis(2, item), set%guide%axis(1, item)) - atan2(along(2), along(1)) + tilt(item)
         angle(0) = 0.0_wp
         angle(1:) = bench%q(3, :)
         if (body_j(item) == movable(item)) then
            bench%q(3, body_j(item)) = angle(body_i(item)) + turn
         else
            bench%q(3, body_i(item)) = angle(body_j(item)) - turn
         end if
      end select
   end subroutine align

   !> Move a body until a contact has the requested penetration: Newton along the gradient.
   subroutine bring_into_contact(bench, item, contact, offset)
      type(bench_t), intent(inout) :: bench   !! the set
      integer, intent(in) :: item             !! item
      integer, intent(in) :: contact          !! its contact
      real(wp), intent(in) :: offset(2)       !! (2) where the journal starts, from the bearing [m]

      real(wp), parameter :: h = 1.0e-8_wp
      real(wp) :: delta(n_all), gradient(2), high(n_all), low(n_all), p_i(2), p_j(2), rate(n_all)
      integer :: attempt, body, c

      body = movable(item)
      call move_to(bench, 0.0_wp)
      associate (set => bench%set, motion => bench%motion)
         p_i = motion%r(1:2, body_i(item)) + matmul(motion%rot(1:2, 1:2, body_i(item)), set%items%s_i(1:2, item))
         p_j = motion%r(1:2, body_j(item)) + matmul(motion%rot(1:2, 1:2, body_j(item)), set%items%s_j(1:2, item))
      end associate
      bench%q(1:2, body) = bench%q(1:2, body) + merge(1.0_wp, -1.0_wp, body == body_j(item))*(p_i + offset - p_j)
      do attempt = 1, 50
         do c = 1, 2
            bench%q(c, body) = bench%q(c, body) + h
            call get_gaps(bench, 0.0_wp, high, rate)
            bench%q(c, body) = bench%q(c, body) - 2.0_wp*h
            call get_gaps(bench, 0.0_wp, low, rate)
            bench%q(c, body) = bench%q(c, body) + h
            gradient(c) = (high(n_before + contact) - low(n_before + contact))/(2.0_wp*h)
         end do
         call get_gaps(bench, 0.0_wp, delta, rate)
         if (abs(delta(n_before + contact) - depth) < 1.0e-15_wp) exit
         bench%q(1:2, body) = bench%q(1:2, body) + gradient*(depth - delta(n_before + contact))/sum(gradient**2)
      end do
      call get_gaps(bench, 0.0_wp, delta, rate)
      bench%is_in_contact = bench%is_in_contact .and. abs(delta(n_before + contact) - depth) < 1.0e-12_wp
   end subroutine bring_into_contact

   !> Motion after a time with the bench's accelerations.
   subroutine move_to(bench, t)
      type(bench_t), intent(inout) :: bench  !! the set
      real(wp), intent(in) :: t              !! time [s]

      type(planar_coordinates_t) :: coordinates
      integer :: k

      call set_planar_motion(n_body, bench%q + t*(bench%v + 0.5_wp*t*bench%a), bench%v + t*bench%a, bench%motion)
      coordinates = new_planar_coordinates()
      call coordinates%accelerate(n_body, [(k, k=1, n_body)], bench%a, bench%motion)
   end subroutine move_to

   !> Penetrations and rates after a time; those of other sets are left at -1.
   subroutine get_gaps(bench, t, delta, rate)
      type(bench_t), intent(inout) :: bench    !! the set
      real(wp), intent(in) :: t                !! time [s]
      real(wp), intent(out) :: delta(n_all)    !! (items of all sets) penetrations [m]
      real(wp), intent(out) :: rate(n_all)     !! (items of all sets) their rates [m/s]

      delta = -1.0_wp
      rate = -1.0_wp
      call move_to(bench, t)
      call bench%set%gaps(bench%motion, delta, rate)
   end subroutine get_gaps

   !> Loads and integrands now; those of other sets are left at -1.
   subroutine evaluate_loads(bench, loads, integrands)
      type(bench_t), intent(inout) :: bench      !! the set
      type(loads_t), intent(out) :: loads        !! loads on the bodies
      real(wp), intent(out) :: integrands(n_integrand, n_all)  !! (3, items of all sets) power lost and normal force [W and N]

      integrands = -1.0_wp
      call new_loads(n_body, loads)
      call move_to(bench, 0.0_wp)
      call bench%set%evaluate(bench%motion, loads, integrands(:, bench%set%before%contacts + 1:))
   end subroutine evaluate_loads

end module clearance_bench
