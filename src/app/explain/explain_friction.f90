!> Ideal joints with friction, for `gudgeon explain`: their laws, and the data that the friction takes.
module explain_friction
   use console, only: say
   use echo, only: item_words
   use mechanism, only: mechanism_t
   use scene, only: scene_t
   use text, only: split_blank, text_t, to_text
   implicit none (type, external)
   private
   public :: explain_rubbing_joints

contains

   !> Ideal joints with friction: the law and its parameters, the lengths that the friction acts on, and the preload.
   subroutine explain_rubbing_joints(scene, system)
      type(scene_t), intent(in) :: scene         !! the scene
      type(mechanism_t), intent(in) :: system    !! its system

      type(text_t), allocatable :: names(:)
      character(:), allocatable :: lengths
      integer :: c, k, m

      if (system%friction%rubbing%n == 0) return
      call say("")
      call say("ideal joints with friction")
      do k = 1, system%linkage%n_solved_set
         associate (set => system%linkage%joints(k)%set)
            do m = 1, set%friction%n
               call say(set%names(set%friction%item(m))%s//": friction "//law_words(scene, set%friction%law(m)%law%name), 2)
               names = split_blank(set%friction_lengths())
               lengths = ""
               do c = 1, size(names)
                  lengths = lengths//names(c)%s//" "//to_text(set%friction%length(c, m))//" m, "
               end do
               call say(lengths//"preload "//to_text(set%friction%preload(m))//" N", 4)
            end do
         end associate
      end do
   end subroutine explain_rubbing_joints

   !> A friction law as text: name, kind and parameters.
   function law_words(scene, name) result(words)
      type(scene_t), intent(in) :: scene       !! the scene
      character(*), intent(in) :: name         !! name of the law
      character(:), allocatable :: words       !! as in `dry (friction.threlfall): coefficient 0.1`

      integer :: i, k

      words = name
      do k = 1, size(scene%tables%frictions)
         associate (table => scene%tables%frictions(k))
            do i = 1, size(table%items)
               if (table%items(i)%name /= name) cycle
               words = name//" ("//table%info%name//"): "//item_words(table%info, table%items(i))
            end do
         end associate
      end do
   end function law_words

end module explain_friction
