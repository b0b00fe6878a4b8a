!> What the method that chooses says of its choices.
submodule(auto) auto_words
   use method_choice, only: most_changes
   use text, only: real_text, to_text
   implicit none (type, external)

contains

   !> What there is to choose from.
   module procedure parts_in_words
      logical :: may_change

      may_change = self%controls%fixed_step <= 0.0_wp .and. self%controls%onset == onset_located
      if (.not. may_change) then
         words = "steps of verner, as they are fixed or the contact onset is not located"
      else if (self%controls%tolerance <= order_8_up_to) then
         words = "explicit steps of order 8 (dop853: the tolerance is at most "//real_text(order_8_up_to, 1)//")"
      else
         words = "explicit steps of order 6 (verner: the tolerance is above "//real_text(order_8_up_to, 1)//")"
      end if
      if (may_change) words = words//"; implicit steps (radau) while stability limits these and radau takes fewer evaluations"
   end procedure parts_in_words

   !> What was chosen, when and why.
   module procedure choice_in_words
      integer :: k

      words = trim(merge("dop853", "verner", self%is_eighth))
      associate (choice => self%choice)
         if (choice%n_step == 0) return
         words = words//", and radau in "//to_text(choice%n_step)//" steps over "//real_text(choice%time, 3)//" s ("
         do k = 1, int(min(choice%n_change, int(most_changes, i8)))
            if (k > 1) words = words//", "
            words = words//trim(merge("from", "to  ", modulo(k, 2) == 1))//" "//real_text(choice%t_change(k), 4)//" s"
            if (choice%product(k) > 0.0_wp) words = words//": h lambda = "//real_text(choice%product(k), 2)
         end do
         if (choice%n_change > most_changes) words = words//", "//to_text(choice%n_change)//" switches in total"
         words = words//")"
      end associate
   end procedure choice_in_words

end submodule auto_words
