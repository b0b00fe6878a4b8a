!> What a planar scene remembers, for checkpoints.
submodule(mechanism_state) mechanism_memory
   use kind_info, only: kind_info_t
   use text, only: join, text_t
   implicit none (type, external)

   ! versions of the forms of what is saved: raised where that changes
   integer, parameter :: equations_version = 2  !! of the counters, the characteristic rate, the largest energy and the stretch of
                                                !! smooth time
   integer, parameter :: joint_version = 1      !! of sets of joints and drivers
   integer, parameter :: contact_version = 3    !! of sets of joints with clearance
   integer, parameter :: solver_version = 1     !! of solvers of the augmented equations

contains

   !> Write what the system remembers: the counters, the characteristic rate, the largest energy and the stretch of smooth time;
   !> the way of holding the constraints; the solver of the augmented equations and the sets that remember something.
   module procedure mechanism_save
      type(kind_info_t) :: info
      integer :: k

      associate (solution => self%linkage%solution, segment => self%linkage%segment)
         call archive%begin("the equations", equations_version)
         call archive%put(self%n_evaluations)
         call archive%put(solution%n_damped)
         call archive%put([self%linkage%scales%pace, self%linkage%scales%late_rate, self%friction%stick_slips%h, &
                           self%ledger%largest])
         call archive%put(solution%solver%n_factorisations)
         call archive%put([segment%low, segment%high, segment%end])
         call archive%begin("stabilise = "//self%stabiliser%name(), self%stabiliser%memory_version(), &
                            self%stabiliser%is_memory_fixed())
         call self%stabiliser%save(archive)
         call archive%begin("solver = "//solution%solver%name(), solver_version)
         call solution%solver%save(archive)
      end associate
      call archive%drop_empty()
      do k = 1, size(self%linkage%joints)
         associate (set => self%linkage%joints(k)%set)
            info = set%info()
            call archive%begin(words_of(info, set%names), joint_version)
            call set%save(archive)
         end associate
         call archive%drop_empty()
      end do
      do k = 1, size(self%loading%forces)
         associate (set => self%loading%forces(k)%set)
            info = set%info()
            call archive%begin(words_of(info, set%names), set%memory_version())
            call set%save(archive)
         end associate
         call archive%drop_empty()
      end do
      do k = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(k)%set)
            info = set%info()
            call archive%begin(words_of(info, set%names), contact_version)
            call set%save(archive)
         end associate
         call archive%drop_empty()
      end do
   end procedure mechanism_save

   !> A set by its kind and its items, as `clearance.revolute 'gudgeon'`.
   function words_of(info, names) result(words)
      type(kind_info_t), intent(in) :: info       !! its kind
      type(text_t), intent(in) :: names(:)        !! (items) their names
      character(:), allocatable :: words          !! name of its segment

      words = info%name//" '"//join(names, "', '")//"'"
   end function words_of

   !> Read what the system remembers.
   module procedure mechanism_load
      integer :: k

      call archive%get(self%n_evaluations)
      call archive%get(self%linkage%solution%n_damped)
      call archive%get(self%linkage%scales%pace)
      call archive%get(self%linkage%scales%late_rate)
      call archive%get(self%friction%stick_slips%h)
      call archive%get(self%ledger%largest)
      if (self%ledger%largest > 0.0_wp) call self%scale_quadratures(self%ledger%largest)  ! 0: of a system not yet started
      call archive%get(self%linkage%solution%solver%n_factorisations)
      call archive%get(self%linkage%segment%low)
      call archive%get(self%linkage%segment%high)
      call archive%get(self%linkage%segment%end)
      call self%stabiliser%load(archive)
      call self%linkage%solution%solver%load(archive)
      do k = 1, size(self%linkage%joints)
         call self%linkage%joints(k)%set%load(archive)
      end do
      do k = 1, size(self%loading%forces)
         call self%loading%forces(k)%set%load(archive)
      end do
      do k = 1, size(self%clearance_joints%sets)
         call self%clearance_joints%sets(k)%set%load(archive)
      end do
   end procedure mechanism_load

end submodule mechanism_memory
