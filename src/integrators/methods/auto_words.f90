!> What the method that chooses says of its choices.
submodule(auto) auto_words
   use method_choice, only: most_changes
   use text, only: real_text, to_text
   implicit none (type, external)

contains

   !> Evaluations of trials.
   module procedure auto_trial_evaluations
      n = self%choice%n_tried
   end procedure auto_trial_evaluations

   !> It makes the steps of its parts.
   module procedure auto_abilities
      can = abilities_t(parts="dop853 verner radau")
   end procedure auto_abilities

   !> What there is to choose from, or what was chosen.
   module procedure auto_says
      if (has_run) then
         words = self%name()//" ("//what_was_chosen(self)//")"
      else
         words = what_there_is(self)
      end if
   end procedure auto_says

   !> What there is to choose from.
   function what_there_is(self) result(words)
      class(auto_t), intent(in) :: self      !! the integrator, with its controls
      character(:), allocatable :: words     !! a line

      logical :: changes

      changes = self%controls%fixed_step <= 0.0_wp .and. self%controls%onset == onset_located
      if (.not. changes) then
         words = "steps of verner, as they are fixed or the contact onset is not located"
      else if (self%controls%tolerance <= order_8_up_to) then
         words = "explicit steps of order 8 (dop853: the tolerance is at most "//real_text(order_8_up_to, 1)//")"
      else
         words = "explicit steps of order 6 (verner: the tolerance is above "//real_text(order_8_up_to, 1)//")"
      end if
      if (changes) words = words//"; implicit steps (radau) where stability, not accuracy, would limit the "// &
         "explicit steps and radau takes fewer evaluations"
   end function what_there_is

   !> What was chosen, when and why.
   function what_was_chosen(self) result(words)
      class(auto_t), intent(in) :: self      !! the integrator, after a run
      character(:), allocatable :: words     !! part of a line

      integer :: k

      words = trim(merge("dop853", "verner", self%is_eighth))
      associate (choice => self%choice)
         if (choice%n_step == 0) return
         words = words//", and radau in "//to_text(choice%n_step)//" steps over "//real_text(choice%time, 3)//" s ("
         do k = 1, int(min(choice%n_change, int(most_changes, i8)))
            if (k > 1) words = words//", "
            words = words//trim(merge("from", "to  ", modulo(k, 2) == 1))//" "//real_text(choice%t_change(k), 4)//" s"
            if (choice%product(k) > 0.0_wp) words = words//" (stiff: h lambda = "// &
                                                      real_text(choice%product(k), 2)//")"
         end do
         if (choice%n_change > most_changes) words = words//", "//to_text(choice%n_change)//" switches in total"
         words = words//")"
      end associate
   end function what_was_chosen

end submodule auto_words
