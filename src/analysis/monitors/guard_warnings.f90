!> What guards have to say: of a run that they end, and at the end of one.
submodule(guards) guard_warnings
   use elastic_waves, only: bar_speed, most_share, share_of_waves
   use text, only: append_text
   implicit none (type, external)

contains

   !> A contact as text.
   module procedure joint_words
      words = "joint '"//set%names(set%item_of(c))%s//"'"
      if (set%label_of(c) /= "") words = words//", contact "//set%label_of(c)
      words = words//", law '"//set%laws%normal%name//"'"
   end procedure joint_words

   !> What was passed, as text.
   module procedure breach_words
      associate (breach => self%breach(g, m), limit => self%limit(g, m))
         select case (g)
         case (guard_penetration)
            words = "penetration "//millimetres(breach%value)//", limit "//real_text(self%penetration, 3)// &
                    " times the smaller radius or the slider length, "//millimetres(limit)//" (guard 'penetration')"
         case (guard_clearance)
            words = "penetration up to "//millimetres(breach%value)//", more than the clearance, "//millimetres(limit)
         case (guard_law_range)
            words = "penetration up to "//millimetres(breach%value)//", but the law is valid up to "//millimetres(limit)// &
                    ", and its tangent beyond"
         case (guard_impact_speed)
            words = "impact speed up to "//real_text(breach%value, 3)//" m/s, but the law is quasi-static: it neglects elastic "// &
               "waves, "// &
                    "which take "//real_text(100.0_wp*share_of_waves(breach%value, bar_speed(limit)), 2)// &
                    " % of the energy (limit "//real_text(100.0_wp*most_share, 2)//" %, "//real_text(limit, 3)// &
                    " m/s; Hunter 1957): use a restitution measured at that speed, or reduce the speed"
         case default
            words = "normal force up to "//real_text(breach%value, 3)//" N, but the strength limit of the material is "// &
                    real_text(limit, 3)//" N"
         end select
         words = words//", at t = "//real_text(breach%time, 6)//" s"
         if (breach%first < breach%time) words = words//", first at "//real_text(breach%first, 6)//" s"
      end associate
   end procedure breach_words

   !> A length as text.
   function millimetres(length) result(words)
      real(wp), intent(in) :: length        !! [m]
      character(:), allocatable :: words    !! in mm

      words = real_text(1.0e3_wp*length, 3)//" mm"
   end function millimetres

   !> Append a warning for each joint whose contacts passed a limit without ending the run, one for each limit, and one for the
   !> body that went farthest.
   module procedure guards_warn
      character(:), allocatable :: words
      integer :: c, g, i, k

      if (.not. allocated(self%breach)) return
      call self%films%warn(system, warnings)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n
               words = ""
               do g = 1, n_contact_guard
                  if (self%stops(g)) cycle
                  c = max_of(self%breach(g, set%before%contacts + (i - 1)*set%n_contact_item + 1: &
                                              set%before%contacts + i*set%n_contact_item))
                  if (c == 0) cycle
                  c = (i - 1)*set%n_contact_item + c
                  if (words == "") then
                     words = joint_words(set, c)//": "
                  else
                     words = words//"; "
                  end if
                  words = words//breach_words(self, g, set%before%contacts + c)
               end do
               if (words /= "") call append_text(warnings, words)
            end do
         end associate
      end do
      k = max_of(self%travel)
      if (k == 0) return
      call append_text(warnings, "body '"//system%linkage%bodies%names(k)%s//"' is "//real_text(self%travel(k)%value, 3)// &
                       " m from its initial position at t = "//real_text(self%travel(k)%time, 6)//" s, "// &
                       real_text(self%travel(k)%value/self%size, 3)// &
                       " times the size of the model: check for a driver or load that acts too long, or a missed contact")
   end procedure guards_warn

   !> The breach with the maximum value, 0: none.
   pure integer function max_of(breaches) result(k)
      type(breach_t), intent(in) :: breaches(:)   !! (any) breaches

      integer :: i

      k = 0
      do i = 1, size(breaches)
         if (.not. breaches(i)%is_there) cycle
         if (k > 0) then
            if (breaches(i)%value <= breaches(k)%value) cycle
         end if
         k = i
      end do
   end function max_of

end submodule guard_warnings
