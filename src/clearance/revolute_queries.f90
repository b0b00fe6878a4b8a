!> What is asked of loose revolute joints beside their evaluation: gaps, how contacts lie, forces and their rates, channels.
submodule(clearance_revolute) revolute_queries
   use catalogue, only: state_contact, state_free
   implicit none (type, external)

contains

   !> How a contact lies. The normal turns with e' . t / |e|, and the point of contact goes along with it: of its velocity only
   !> the part along the normal counts, that of the centre P_k and the rate at which it comes nearer to it.
   module procedure revolute_lie
      type(contact_t) :: contact
      real(wp) :: longer, p_i(2), p_j(2), s_i(2), s_j(2), turn
      integer :: i, j

      i = self%body(1, k)
      j = self%body(2, k)
      call measure(self, k, motion, contact)
      call measure_sliding(self, k, motion, contact)
      tangent%t = [-contact%normal(2), contact%normal(1)]
      tangent%arm_i = contact%arm_i
      tangent%arm_j = contact%arm_j
      tangent%v = contact%v_t_work
      longer = merge(0.0_wp, 0.5_wp*contact%rate, self%journal(k)%is_book)  ! rate of the distance from the bearing's centre
      call find_centres(self, k, motion, s_i, s_j)
      p_i = motion%omega(3, i)*[-s_i(2), s_i(1)]  ! of the centres, from those of mass
      p_j = motion%omega(3, j)*[-s_j(2), s_j(1)]
      turn = dot_product(motion%v(1:2, j) + p_j - motion%v(1:2, i) - p_i, tangent%t) &
             /(self%journal(k)%side*max(abs(contact%distance), tiny(1.0_wp)))
      tangent%drift = -turn*contact%rate + motion%omega(3, j)*(dot_product(contact%normal, p_j) - longer) &
                      - motion%omega(3, i)*(dot_product(contact%normal, p_i) + longer)
   end procedure revolute_lie

   !> Penetration and its rate for all items.
   module procedure revolute_gaps
      type(contact_t) :: contact
      integer :: k

      do k = 1, self%n
         call measure(self, k, motion, contact)
         delta(self%first_contact + k) = contact%delta
         rate(self%first_contact + k) = contact%rate
      end do
   end procedure revolute_gaps

   !> Normal force of a touching item and its rate:
   !> F' = dF/ddelta delta' + dF/drate delta'',  delta'' = n . e'' + (|e'|^2 - delta'^2) / |e|.
   module procedure revolute_watch
      type(contact_t) :: contact
      real(wp) :: acceleration(2), arm_i(2), arm_j(2), df_ddelta, df_drate, e_dot(2), f_t
      integer :: i, j

      i = self%body(1, k)
      j = self%body(2, k)
      call evaluate_item(self, k, motion, contact, force, df_ddelta, df_drate, f_t)
      delta = contact%delta
      rate = contact%rate
      call find_centres(self, k, motion, arm_i, arm_j)
      e_dot = motion%v(1:2, j) - motion%v(1:2, i) + motion%omega(3, j)*[-arm_j(2), arm_j(1)] &
              - motion%omega(3, i)*[-arm_i(2), arm_i(1)]
      acceleration = motion%a(1:2, j) - motion%a(1:2, i) &
                     + motion%alpha(3, j)*[-arm_j(2), arm_j(1)] - motion%omega(3, j)**2*arm_j &
                     - motion%alpha(3, i)*[-arm_i(2), arm_i(1)] + motion%omega(3, i)**2*arm_i
      force_rate = df_ddelta*rate + df_drate*(contact%normal(1)*acceleration(1) + contact%normal(2)*acceleration(2) &
                   + (e_dot(1)**2 + e_dot(2)**2 - rate**2)/(self%journal(k)%side*max(abs(contact%distance), tiny(1.0_wp))))
   end procedure revolute_watch

   !> Values of a channel for all items.
   module procedure revolute_report
      type(contact_t) :: contact
      real(wp) :: df_ddelta, df_drate, f_n, f_t
      integer :: column, contact_column, k

      do k = 1, self%n
         column = self%first + k
         contact_column = self%first_contact + k
         call evaluate_item(self, k, motion, contact, f_n, df_ddelta, df_drate, f_t)
         select case (channel)
         case ("eccentricity")
            values(:, column) = contact%e
         case ("force")
            values(:, column) = -f_n*contact%normal + f_t*[-contact%normal(2), contact%normal(1)]
         case ("penetration")
            values(1, contact_column) = max(contact%delta, 0.0_wp)
         case ("penetration_rate")
            values(1, contact_column) = merge(contact%rate, 0.0_wp, self%contact(k)%is_touching)
         case ("normal_force")
            values(1, contact_column) = f_n
         case ("friction_force")
            values(1, contact_column) = f_t
         case ("state")
            values(1, contact_column) = real(merge(state_contact, state_free, self%contact(k)%is_touching), wp)
         end select
      end do
   end procedure revolute_report

   !> Elastic energy that the touching items store.
   module procedure revolute_elastic_energy
      type(contact_t) :: contact
      integer :: k

      energy = 0.0_wp
      do k = 1, self%n
         if (.not. self%contact(k)%is_touching) cycle
         call measure(self, k, motion, contact)
         energy = energy + self%law%potential(contact%delta, self%parameters(:, k))
      end do
   end procedure revolute_elastic_energy

   !> Normal force and signed friction force of one item from the set's laws.
   subroutine evaluate_item(self, k, motion, contact, f_n, df_ddelta, df_drate, f_t)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(contact_t), intent(out) :: contact          !! kinematics
      real(wp), intent(out) :: f_n                     !! normal force [N]
      real(wp), intent(out) :: df_ddelta               !! its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate                !! its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_t                     !! friction force on the journal along t [N]

      real(wp) :: elastic(1), f(1), slope_delta(1), slope_rate(1)

      call measure(self, k, motion, contact)
      f_n = 0.0_wp
      f_t = 0.0_wp
      df_ddelta = 0.0_wp
      df_drate = 0.0_wp
      if (.not. self%contact(k)%is_touching) return
      call self%press(k, k, [contact%delta], [contact%rate], [self%contact(k)%impact_speed], f, slope_delta, slope_rate, elastic)
      f_n = f(1)
      df_ddelta = slope_delta(1)
      df_drate = slope_rate(1)
      if (.not. allocated(self%friction)) return
      if (self%grip%memory /= memory_none) then
         f_t = self%grip%tangent(k)%f_t  ! of the last evaluation: it is no function of the motion alone
         return
      end if
      call measure_sliding(self, k, motion, contact)
      call self%friction%force(1, [f_n], [abs(contact%v_t)], f)
      f_t = -sign(f(1), contact%v_t)
   end subroutine evaluate_item

   !> Centres of bearing and journal, from the centres of mass of their bodies.
   pure subroutine find_centres(self, k, motion, s_i, s_j)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions
      real(wp), intent(out) :: s_i(2)                  !! (2) centre of the bearing, world frame [m]
      real(wp), intent(out) :: s_j(2)                  !! (2) centre of the journal, world frame [m]

      associate (i => self%body(1, k), j => self%body(2, k))
         s_i = motion%rot(1:2, 1, i)*self%s_i(1, k) + motion%rot(1:2, 2, i)*self%s_i(2, k)
         s_j = motion%rot(1:2, 1, j)*self%s_j(1, k) + motion%rot(1:2, 2, j)*self%s_j(2, k)
      end associate
   end subroutine find_centres

end submodule revolute_queries
