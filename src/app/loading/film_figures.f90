!> What figures of films ask for, against the scene: films that have pressures, and times within the run.
module film_figures
   use columns, only: cell_index
   use figure_words, only: figure_film, figure_t
   use film_fields, only: moment_at
   use kinds, only: wp
   use scene, only: scene_t
   use text, only: real_text, text_t
   implicit none (type, external)
   private
   public :: check_film_figures

contains

   !> Look for the first figure of a film that there cannot be.
   subroutine check_film_figures(words, figures, scene, end, bad, message, hint)
      type(text_t), intent(in) :: words(:)                 !! (n) words for figures
      type(figure_t), intent(in) :: figures(:)             !! (n) the figures
      type(scene_t), intent(in) :: scene                   !! the scene
      real(wp), intent(in) :: end                          !! of the run; 0: it has none [s]
      integer, intent(out) :: bad                          !! number of the first wrong word, 0: none
      character(:), allocatable, intent(out) :: message    !! what is wrong with it
      character(:), allocatable, intent(out) :: hint       !! what may have been meant, may be blank

      integer :: film

      do bad = 1, size(words)
         if (figures(bad)%kind /= figure_film) cycle
         film = film_of(scene, figures(bad)%film%joint)
         if (film > 0) then
            associate (law => scene%lubrication%films(film)%law)
               if (.not. law%has_field()) then
                  message = "film '"//law%name//"' of joint '"//figures(bad)%film%joint// &
                            "' gives a force without a pressure field: no '"//words(bad)%s//"'"
                  hint = "use a film with a pressure field: film.grid, film.squeeze, or a short or long film"
                  return
               end if
            end associate
         end if
         if (figures(bad)%film%moment == moment_at .and. end > 0.0_wp .and. figures(bad)%film%t > end) then
            message = "'"//words(bad)%s//"' is after the end of the run at "//real_text(end, 6)//" s"
            hint = "film("//figures(bad)%film%joint//") shows the film at the end of the run"
            return
         end if
      end do
      bad = 0
      message = ""
      hint = ""
   end subroutine check_film_figures

   !> Number of the film of a joint; 0: none.
   pure integer function film_of(scene, joint) result(film)
      type(scene_t), intent(in) :: scene   !! the scene
      character(*), intent(in) :: joint    !! name of the joint

      integer :: i, k

      film = 0
      do k = 1, size(scene%clearances)
         if (.not. allocated(scene%clearances(k)%items)) cycle
         do i = 1, size(scene%clearances(k)%items)
            if (scene%clearances(k)%items(i)%name /= joint) cycle
            film = cell_index(scene%clearances(k)%info, scene%clearances(k)%items(i), "film")
            return
         end do
      end do
   end function film_of

end module film_figures
