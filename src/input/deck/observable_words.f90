!> Channels that expressions of loads may use: positions and velocities. What they are of is looked up by the scene.
module observable_words
   use expression_compile, only: channel_finder_t
   use kind_info, only: dim_angle, dim_angular_speed, dim_length, dim_none, dim_speed, dim_t
   use observable, only: sees_angle, sees_angular_velocity, sees_distance, sees_distance_rate, sees_position, sees_velocity
   use spelling, only: nearest_word
   use text, only: segment, split_blank
   implicit none (type, external)
   private
   public :: read_observable_word, observable_words_t

   character(*), parameter :: known = "position velocity angle angular_velocity distance distance_rate"
   character(*), parameter :: numbers_known = "loads may use position, velocity, angle, angular_velocity of bodies, position and " &
                              //"velocity of points, position, velocity, distance and distance_rate of rows of " &
                              //"[request.motion], and state.NAME; accelerations and forces follow from them: an algebraic loop"

   !> Knows them by their quantities.
   type, extends(channel_finder_t) :: observable_words_t
   contains
      procedure :: find => find_observable_word
   end type observable_words_t

contains

   !> The parts of a word: item, quantity, component. A word is `ITEM.QUANTITY` or `ITEM.QUANTITY.COMPONENT`.
   subroutine read_observable_word(word, item, quantity, component, part)
      character(*), intent(in) :: word                     !! as in the deck
      character(:), allocatable, intent(out) :: item       !! before the first dot
      character(:), allocatable, intent(out) :: quantity   !! behind it
      integer, intent(out) :: component                    !! x, y, z: 1, 2, 3; 0: none is named; -1: another word
      integer, intent(out) :: part                         !! number of the quantity as in `observable`, 0: none of them

      integer :: dot

      dot = index(word, ".")
      item = word(:dot - 1)
      quantity = word(dot + 1:)
      component = 0
      dot = index(quantity, ".")
      if (dot > 0) then
         component = index("xyz", quantity(dot + 1:))
         if (component == 0 .or. len(quantity) /= dot + 1) component = -1
         quantity = segment(quantity, 1, dot - 1)
      end if
      select case (quantity)
      case ("position"); part = sees_position
      case ("velocity"); part = sees_velocity
      case ("angle"); part = sees_angle
      case ("angular_velocity"); part = sees_angular_velocity
      case ("distance"); part = sees_distance
      case ("distance_rate"); part = sees_distance_rate
      case default; part = 0
      end select
   end subroutine read_observable_word

   !> The dimension of a channel.
   subroutine find_observable_word(self, word, dimension, message, help)
      class(observable_words_t), intent(in) :: self               !! the finder
      character(*), intent(in) :: word                       !! as `ram.velocity.y`
      type(dim_t), intent(out) :: dimension                  !! of the channel
      character(:), allocatable, intent(out) :: message      !! what is wrong with it; empty: nothing
      character(:), allocatable, intent(out) :: help         !! what to do, may be empty

      character(:), allocatable :: item, quantity
      integer :: component, part

      message = ""
      help = ""
      dimension = dim_none
      call read_observable_word(word, item, quantity, component, part)
      select case (part)
      case (sees_position, sees_distance)
         dimension = dim_length
      case (sees_velocity, sees_distance_rate)
         dimension = dim_speed
      case (sees_angle)
         dimension = dim_angle
      case (sees_angular_velocity)
         dimension = dim_angular_speed
      case default
         message = "a load cannot use '"//word//"'"
         help = nearest_word(quantity, split_blank(known))
         if (len(help) > 0) help = "did you mean '"//item//"."//help//"'? "
         help = help//numbers_known
      end select
      if (len(message) > 0 .or. component >= 0 .or. .not. same_type_as(self, observable_words_t())) return
      message = "'"//word//"' is not a component"
      help = "components are x, y and, in space, z"
   end subroutine find_observable_word

end module observable_words
