!> Sum of the magnitudes of the forces that act on each body at rest: the scale of the residual of equilibrium.
!>
!> $$ s_b = \sum_k \sqrt{|L f_k|^2 + |m_k|^2} $$
!>
!> over weight, items of force elements, contacts, lubricant films and constraint rows that load body b; f_k and m_k are force and
!> moment about the centre of mass, L the size of the bodies. At equilibrium their sum vanishes, and s_b does not.
!>
!> Limits: contacts count by their normal force at an arm of L, films by their force; no friction and no damping at rest.
module acting_forces
   use clearance_set, only: clearance_set_t, normal_impulse
   use film_law, only: film_motion_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use motion, only: cross
   implicit none (type, external)
   private
   public :: max_acting, has_films

contains

   !> The maximum of the sums of all bodies, after an evaluation of loads and rows and with the multipliers set [N.m].
   real(wp) function max_acting(system)
      class(mechanism_t), intent(in) :: system   !! the system

      real(wp) :: acting(0:system%linkage%bodies%n)
      integer :: k

      acting = 0.0_wp
      do k = 1, system%linkage%bodies%n
         acting(k) = norm2(system%loading%weight(:, k))*system%linkage%scales%length
      end do
      call add_elements(system, acting)
      do k = 1, size(system%clearance_joints%sets)
         call add_contacts(system, system%clearance_joints%sets(k)%set, acting)
      end do
      call add_rows(system, acting)
      max_acting = maxval([0.0_wp, acting(1:)])
   end function max_acting

   !> Add the loads of force elements.
   subroutine add_elements(system, acting)
      class(mechanism_t), intent(in) :: system   !! the system
      real(wp), intent(inout) :: acting(0:)      !! (0:bodies) sums of magnitudes [N.m]

      real(wp), dimension(3) :: force, moment, place
      integer :: bodies(2), i, k, side

      associate (motion => system%linkage%motion, length => system%linkage%scales%length)
         do k = 1, system%loading%n_set
            associate (set => system%loading%forces(k)%set)
               do i = 1, set%n
                  bodies = set%bodies_of(i)
                  do side = 1, 2
                     if (bodies(side) == 0) cycle
                     call set%load_on(i, side, 0.0_wp, motion, force, moment, place)
                     moment = moment + cross(place - motion%r(:, bodies(side)), force)
                     acting(bodies(side)) = acting(bodies(side)) + norm2([length*force, moment])
                  end do
               end do
            end associate
         end do
      end associate
   end subroutine add_elements

   !> Add the normal forces of the contacts of a set, and the forces of its films.
   subroutine add_contacts(system, set, acting)
      class(mechanism_t), intent(in) :: system   !! the system
      class(clearance_set_t), intent(in) :: set  !! one of its sets
      real(wp), intent(inout) :: acting(0:)      !! (0:bodies) sums of magnitudes [N.m]

      type(film_motion_t) :: relative
      integer :: i, item

      associate (length => system%linkage%scales%length, motion => system%linkage%motion, items => set%items)
         do i = 1, set%n_contact
            item = set%item_of(i)
            associate (bodies => items%body(:, item))
               acting(bodies) = acting(bodies) + length*abs(system%clearance_joints%integrands(normal_impulse, &
                                                                                               set%before%contacts + i))
            end associate
         end do
         if (.not. has_films(set)) return
         do i = 1, set%n
            associate (bodies => items%body(:, i), films => set%laws%films)
               relative = films%motion_of(i, bodies, items%s_i(:, i), items%s_j(:, i), motion)
               associate (state => films%state_of(i, bodies, relative, motion))
                  acting(bodies) = acting(bodies) + length*norm2(state%force)
               end associate
            end associate
         end do
      end associate
   end subroutine add_contacts

   !> Add what each constraint row gives to its bodies.
   pure subroutine add_rows(system, acting)
      class(mechanism_t), intent(in) :: system   !! the system
      real(wp), intent(inout) :: acting(0:)      !! (0:bodies) sums of magnitudes [N.m]

      real(wp) :: scale(system%linkage%coordinates%n_v)
      integer :: block, body, side

      associate (rows => system%linkage%rows, n_v => system%linkage%coordinates%n_v, lambda => system%linkage%solution%lambda)
         scale = system%linkage%coordinates%scales(system%linkage%scales%length, 1)
         do block = 1, rows%n_block
            do side = 1, 2
               body = rows%body(side, block)
               if (body == 0) cycle
               acting(body) = acting(body) + abs(lambda(rows%owner(block))) &
                              *norm2(rows%jac(n_v*(side - 1) + 1:n_v*side, block)*scale)
            end do
         end do
      end associate
   end subroutine add_rows

   !> Whether films act in a set.
   pure logical function has_films(set)
      class(clearance_set_t), intent(in) :: set  !! the set

      has_films = .false.
      if (allocated(set%laws%films)) has_films = set%laws%films%acts
   end function has_films

end module acting_forces
