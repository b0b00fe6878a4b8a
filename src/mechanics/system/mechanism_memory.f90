!> What a planar scene remembers, for checkpoints.
submodule(mechanism_state) mechanism_memory
   use checkpoint, only: add_segment, size_of_segments
   use kind_info, only: kind_info_t
   use memory, only: get, put
   use text, only: join, text_t
   implicit none (type, external)

   ! versions of the forms of what is saved: raised where that changes
   integer, parameter :: equations_version = 2  !! of the counters, the characteristic rate, the largest energy and the stretch of
                                                !! smooth time
   integer, parameter :: joint_version = 1      !! of sets of joints and drivers
   integer, parameter :: contact_version = 2    !! of sets of joints with clearance
   integer, parameter :: solver_version = 1     !! of solvers of the augmented equations
   integer, parameter :: n_equations = 10       !! numbers of the first of them

contains

   !> List what the system saves: the counters, the characteristic rate, the largest energy and the stretch of smooth time; the way
   !> of holding the constraints; the solver of the augmented equations and the sets that remember something.
   module procedure mechanism_list_memory
      type(kind_info_t) :: info
      integer :: k

      call add_segment(segments, "the equations", equations_version, n_equations)
      call add_segment(segments, "stabilise = "//self%way%name(), self%way%memory_version(), self%way%memory_size(), &
                     self%way%is_memory_fixed())
      associate (solver => self%linkage%solution%solver)
         k = solver%memory_size()
         if (k > 0) call add_segment(segments, "solver = "//solver%name(), solver_version, k)
      end associate
      do k = 1, size(self%linkage%joints)
         associate (set => self%linkage%joints(k)%set)
            info = set%info()
            call add_set(info%name, set%names, joint_version, set%memory_size(), segments)
         end associate
      end do
      do k = 1, size(self%loading%forces)
         associate (set => self%loading%forces(k)%set)
            info = set%info()
            call add_set(info%name, set%names, set%memory_version(), set%memory_size(), segments)
         end associate
      end do
      do k = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(k)%set)
            info = set%info()
            call add_set(info%name, set%names, contact_version, set%memory_size(), segments)
         end associate
      end do
   end procedure mechanism_list_memory

   !> List a set, if it remembers anything, by its kind and its items.
   subroutine add_set(kind, names, version, n, segments)
      character(*), intent(in) :: kind                        !! as `clearance.revolute`
      type(text_t), intent(in) :: names(:)                    !! (items) their names
      integer, intent(in) :: version                          !! of the form of what the set saves
      integer, intent(in) :: n                                !! numbers that it saves
      type(segment_t), allocatable, intent(inout) :: segments(:)  !! (any) the list, grown

      if (n == 0) return
      call add_segment(segments, kind//" '"//join(names, "', '")//"'", version, n)
   end subroutine add_set

   !> Numbers that a checkpoint needs.
   module procedure mechanism_memory_size
      type(segment_t), allocatable :: segments(:)

      call self%list_memory(segments)
      n = size_of_segments(segments)
   end procedure mechanism_memory_size

   !> Write what the system remembers.
   module procedure mechanism_save
      integer :: k

      call put(row, place, self%n_evaluations)
      call put(row, place, self%linkage%solution%n_damped)
      call put(row, place, [self%linkage%scales%pace, self%linkage%scales%late_rate, self%friction%stick_slips%h, &
                            self%ledger%largest])
      call put(row, place, self%linkage%solution%solver%n_factorisations)
      call put(row, place, self%linkage%segment%low)
      call put(row, place, self%linkage%segment%high)
      call put(row, place, self%linkage%segment%end)
      call self%way%save(row, place)
      call self%linkage%solution%solver%save(row, place)
      do k = 1, size(self%linkage%joints)
         call self%linkage%joints(k)%set%save(row, place)
      end do
      do k = 1, size(self%loading%forces)
         call self%loading%forces(k)%set%save(row, place)
      end do
      do k = 1, size(self%clearance_joints%sets)
         call self%clearance_joints%sets(k)%set%save(row, place)
      end do
   end procedure mechanism_save

   !> Read what the system remembers.
   module procedure mechanism_load
      integer :: k

      call get(row, place, self%n_evaluations)
      call get(row, place, self%linkage%solution%n_damped)
      call get(row, place, self%linkage%scales%pace)
      call get(row, place, self%linkage%scales%late_rate)
      call get(row, place, self%friction%stick_slips%h)
      call get(row, place, self%ledger%largest)
      if (self%ledger%largest > 0.0_wp) call self%scale_quadratures(self%ledger%largest)  ! 0: of a system not yet started
      call get(row, place, self%linkage%solution%solver%n_factorisations)
      call get(row, place, self%linkage%segment%low)
      call get(row, place, self%linkage%segment%high)
      call get(row, place, self%linkage%segment%end)
      call self%way%load(row, place)
      call self%linkage%solution%solver%load(row, place)
      do k = 1, size(self%linkage%joints)
         call self%linkage%joints(k)%set%load(row, place)
      end do
      do k = 1, size(self%loading%forces)
         call self%loading%forces(k)%set%load(row, place)
      end do
      do k = 1, size(self%clearance_joints%sets)
         call self%clearance_joints%sets(k)%set%load(row, place)
      end do
   end procedure mechanism_load

end submodule mechanism_memory
