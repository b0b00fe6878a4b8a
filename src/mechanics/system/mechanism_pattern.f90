!> Where the residual of `mechanism_dae` has entries: a body couples with itself, and with those that it shares joints, forces or
!> contacts with. All bodies have all their coordinates, as many as rates, and contacts no states of their own.
submodule(mechanism_state) mechanism_pattern
   use rows, only: next_block, rows_t
   implicit none (type, external)

   !> Neighbours of bodies, of each those of a list.
   type :: couplings_t
      integer, allocatable :: last(:)    !! (0:bodies) place of the last neighbour of each body
      integer, allocatable :: other(:)   !! (any) neighbours, body by body
      logical, allocatable :: by_joint(:)  !! (any) through the multipliers of a joint
   end type couplings_t

contains

   !> Column by column: coordinates, rates, quadratures, both sets of multipliers.
   module procedure mechanism_dae_pattern
      type(couplings_t) :: near
      integer :: block, body, first, i, k, level, m, n, n_entry, n_v, pass, place(0:self%linkage%bodies%n)

      n = self%linkage%rows%n_unknown
      n_v = self%linkage%coordinates%n_v
      m = self%n_row
      place = 0
      place(self%linkage%rows%unknown) = [(k, k=1, n)]
      call find_couplings(self, place, near)
      allocate (column(self%n + 2*m + 1), source=0)
      do pass = 1, 2
         n_entry = 0
         do level = 0, 1  ! coordinates, rates
            do k = 1, n
               body = self%linkage%rows%unknown(k)
               do i = 1, n_v
                  column(n_v*n*level + n_v*(k - 1) + i) = n_entry
                  call add_body(n_v*(k - 1))
                  call add_body(n_v*n + n_v*(k - 1))
                  do first = near%last(body - 1) + 1, near%last(body)
                     if (near%by_joint(first) .and. level == 0) call add_body(n_v*(place(near%other(first)) - 1))
                     call add_body(n_v*n + n_v*(place(near%other(first)) - 1))
                  end do
                  do first = self%linkage%rows%last_side(body - 1) + 1, self%linkage%rows%last_side(body)
                     call add_entry(self%n + self%linkage%rows%side_row(first) - 1)
                     if (level == 0) call add_entry(self%n + m + self%linkage%rows%side_row(first) - 1)
                  end do
               end do
            end do
         end do
         do i = 2*n_v*n + 1, self%n
            column(i) = n_entry
            call add_entry(i - 1)
         end do
         do level = 1, 0, -1  ! lambda acts on rates, mu on coordinates
            do i = 1, m
               column(self%n + merge(0, m, level == 1) + i) = n_entry
               block = i
               do while (block > 0)
                  do k = 1, 2
                     body = place(self%linkage%rows%body(k, block))
                     if (body > 0) call add_body(n_v*n*level + n_v*(body - 1))
                  end do
                  block = next_block(self%linkage%rows, block)
               end do
               call add_entry(self%n + merge(0, m, level == 1) + i - 1)  ! of a row that is omitted
            end do
         end do
         column(self%n + 2*m + 1) = n_entry
         if (pass == 1) allocate (row(n_entry), source=0)
      end do

   contains

      !> One entry of the present column.
      subroutine add_entry(number)
         integer, intent(in) :: number  !! its row, from 0

         n_entry = n_entry + 1
         if (pass == 2) row(n_entry) = number
      end subroutine add_entry

      !> Entries for the coordinates or rates of a body.
      subroutine add_body(before)
         integer, intent(in) :: before  !! rows before them

         integer :: j

         do j = 0, n_v - 1
            call add_entry(before + j)
         end do
      end subroutine add_body

   end procedure mechanism_dae_pattern

   !> M^{-1} Phi_q^T, row by row, the first body of each before the second, and after them 1 of a row that is omitted.
   module procedure mechanism_dae_spread
      integer :: block, body, i, k, n
      logical :: is_left_out(self%n_row)

      n = 0
      is_left_out = .false.
      do k = 1, size(self%linkage%solution%left_out)
         is_left_out(self%linkage%solution%left_out(k)) = .true.
      end do
      associate (rows => self%linkage%rows, n_v => self%linkage%coordinates%n_v)
         do i = 1, self%n_row
            block = i
            do while (block > 0)
               do k = 1, 2
                  body = rows%body(k, block)
                  if (body == 0) cycle
                  if (self%linkage%reduced%is_known(body)) cycle
                  values(n + 1:n + n_v) = self%linkage%inverse_mass(:, body)*rows%jac(n_v*(k - 1) + 1:n_v*k, block)
                  n = n + n_v
               end do
               block = next_block(rows, block)
            end do
            n = n + 1
            values(n) = merge(1.0_wp, 0.0_wp, is_left_out(i))
         end do
      end associate
   end procedure mechanism_dae_spread

   !> Which bodies depend on which: pairs that joints, forces and contacts name, each in both directions and once.
   !> Length: one list, counted and then filled by the same loops.
   subroutine find_couplings(self, place, near)
      class(mechanism_state_t), intent(in) :: self  !! the system
      integer, intent(in) :: place(0:)              !! (0:bodies) number of each among the unknown ones, 0: none
      type(couplings_t), intent(out) :: near        !! the neighbours

      integer, allocatable :: seen(:)
      integer :: body, i, k, kept, n, pass

      allocate (near%last(0:self%linkage%bodies%n), source=0)
      do pass = 1, 2
         do k = 1, size(self%linkage%joints)
            if (.not. self%linkage%joints(k)%set%is_solved .or. self%linkage%joints(k)%set%sides_apart) cycle
            call couple_all(self%linkage%joints(k)%set%body, .true.)
         end do
         call couple_blocks(self%linkage%rows)
         do k = 1, size(self%linkage%ideal)
            if (.not. self%linkage%ideal(k)%set%sides_apart) call couple_all(self%linkage%ideal(k)%set%body, .true.)
         end do
         do k = 1, size(self%clearance_joints%sets)
            call couple_all(self%clearance_joints%sets(k)%set%items%body, .false.)
         end do
         do k = 1, size(self%loading%forces)
            do i = 1, self%loading%forces(k)%set%n
               call couple(self%loading%forces(k)%set%bodies_of(i), .false.)
            end do
         end do
         if (pass == 2) exit
         do body = 1, self%linkage%bodies%n
            near%last(body) = near%last(body) + near%last(body - 1)
         end do
         n = near%last(self%linkage%bodies%n)
         allocate (near%other(n), source=0)
         allocate (near%by_joint(n), source=.false.)
         do body = self%linkage%bodies%n, 1, -1  ! places before the first: filled from there
            near%last(body) = near%last(body - 1)
         end do
      end do
      ! each neighbour once: those through joints stand first
      allocate (seen(0:self%linkage%bodies%n), source=0)
      kept = 0
      n = 0
      do body = 1, self%linkage%bodies%n
         do i = n + 1, near%last(body)
            if (seen(near%other(i)) == body) cycle
            seen(near%other(i)) = body
            kept = kept + 1
            near%other(kept) = near%other(i)
            near%by_joint(kept) = near%by_joint(i)
         end do
         n = near%last(body)
         near%last(body) = kept
      end do

   contains

      !> The pairs of a set.
      subroutine couple_all(body, by_joint)
         integer, intent(in) :: body(:, :)   !! (2, n) bodies
         logical, intent(in) :: by_joint     !! whether they are of a joint

         integer :: j

         do j = 1, size(body, 2)
            call couple(body(:, j), by_joint)
         end do
      end subroutine couple_all

      !> The pairs of rows that tie more than two bodies.
      subroutine couple_blocks(rows)
         type(rows_t), intent(in) :: rows   !! the rows

         integer :: block, end, other, side

         do block = rows%n + 1, rows%n_block
            other = rows%owner(block)
            do while (other > 0)
               do side = 1, 2
                  do end = 1, 2
                     if (other == block .and. side == end) cycle
                     call couple([rows%body(side, block), rows%body(end, other)], .true.)
                  end do
               end do
               other = next_block(rows, other)
            end do
         end do
      end subroutine couple_blocks

      !> Both are neighbours of one another, if both are unknown and not the same.
      subroutine couple(body, by_joint)
         integer, intent(in) :: body(2)      !! bodies
         logical, intent(in) :: by_joint     !! whether they are of a joint

         integer :: side

         if (place(body(1)) == 0 .or. place(body(2)) == 0 .or. body(1) == body(2)) return
         do side = 1, 2
            near%last(body(side)) = near%last(body(side)) + 1
            if (pass == 1) cycle
            near%other(near%last(body(side))) = body(3 - side)
            near%by_joint(near%last(body(side))) = by_joint
         end do
      end subroutine couple

   end subroutine find_couplings

end submodule mechanism_pattern
