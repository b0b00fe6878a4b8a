!> Multipliers of rows that are not solved for, and the names of rows.
submodule(linkage) linkage_reactions
   implicit none (type, external)

contains

   !> What the reports of some rows need of those that are not solved for. The multipliers of prescribed bodies are found together;
   !> they have those of the bodies with one degree of freedom in them that known ones carry.
   module procedure linkage_list_wanted
      logical :: is_wanted(size(is_read)), takes(self%reduced%one_dof%n)
      integer :: k

      is_wanted = is_read
      associate (known => self%reduced%known, one_dof => self%reduced%one_dof, n_v => self%coordinates%n_v)
         do k = 1, known%n
            wanted%has_prescribed = wanted%has_prescribed .or. is_one_read(known%held(k)%row(:n_v))
         end do
         do k = 1, known%n
            if (wanted%has_prescribed) call want(known%held(k)%row(:n_v))
         end do
         do k = 1, one_dof%n
            takes(k) = is_one_read(one_dof%held(k)%row(:n_v - 1)) .or. (wanted%has_prescribed .and. one_dof%held(k)%base > 0)
            if (takes(k)) call want(one_dof%held(k)%row(:n_v - 1))
         end do
         wanted%one_dof = pack([(k, k=1, one_dof%n)], takes)
      end associate
      allocate (wanted%sets(0))
      do k = self%n_solved_set + 1, size(self%joints)
         associate (set => self%joints(k)%set)
            if (any(is_wanted(set%first_row + 1:set%first_row + set%n*set%n_row_item))) wanted%sets = [wanted%sets, k]
         end associate
      end do

   contains

      !> Whether one of some rows is reported.
      pure logical function is_one_read(rows)
         integer, intent(in) :: rows(:)    !! (any) their numbers

         integer :: i

         is_one_read = .false.
         do i = 1, size(rows)
            is_one_read = is_one_read .or. is_read(rows(i))
         end do
      end function is_one_read

      !> Some rows are requested.
      subroutine want(rows)
         integer, intent(in) :: rows(:)    !! (any) their numbers

         integer :: i

         do i = 1, size(rows)
            is_wanted(rows(i)) = .true.
         end do
      end subroutine want

   end procedure linkage_list_wanted

   !> Multipliers of rows that fix bodies that are not solved for, at the motion and the accelerations that are set.
   !> Reports need them.
   module procedure linkage_find_reactions
      real(wp) :: inside
      integer :: k

      inside = min(max(t, self%segment%low), self%segment%high)  ! in the smooth stretch: `smooth_segment`, without its call
      do k = 1, size(wanted%sets)
         call self%joints(wanted%sets(k))%set%evaluate(inside, self%motion, self%rows)
      end do
      associate (known => self%reduced%known, one_dof => self%reduced%one_dof, solution => self%solution)
         do k = 1, size(wanted%one_dof)
            call copy(one_dof%held(wanted%one_dof(k))%body)
         end do
         if (size(wanted%one_dof) > 0) then
            call one_dof%find_multipliers(size(wanted%one_dof), wanted%one_dof, self%coordinates%n_v, self%bodies%n, self%rows, &
                                         self%mass, g, solution%a, solution%lambda)
         end if
         if (.not. wanted%has_prescribed) return
         do k = 1, known%n
            call copy(known%held(k)%body)
         end do
         call known%find_multipliers(self%coordinates%n_v, self%bodies%n, self%rows%n, self%rows%n_block, known%held, &
                                     self%reduced%carried, self%rows%jac, self%mass, g, solution%a, self%rest, solution%lambda)
      end associate

   contains

      !> Acceleration of a body that is not solved for.
      subroutine copy(body)
         integer, intent(in) :: body  !! the body

         call self%coordinates%find_acceleration(self%motion, body, self%solution%a(:, body))
      end subroutine copy

   end procedure linkage_find_reactions

   !> Name of the joint or driver that a constraint row belongs to.
   module procedure linkage_row_name
      integer :: k

      name = "?"
      do k = 1, size(self%joints)
         call look(self%joints(k))
      end do
      do k = 1, size(self%ideal)
         call look(self%ideal(k))
      end do

   contains

      !> Look in one set.
      subroutine look(slot)
         type(joint_slot_t), intent(in) :: slot  !! the set

         integer :: item

         associate (set => slot%set)
            if (row <= set%first_row .or. row > set%first_row + set%n*set%n_row_item) return
            item = (row - set%first_row - 1)/set%n_row_item + 1
            name = set%names(item)%s
         end associate
      end subroutine look

   end procedure linkage_row_name

end submodule linkage_reactions
