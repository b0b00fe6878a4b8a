!> Description of a kind: its deck table or section, its rows and its output channels.
!>
!> Every joint, driver, force, contact law, friction law, clearance geometry, integrator and every
!> section of settings gives one `kind_info_t`. The deck reader, the range checks, the writers,
!> `gudgeon help`, the manual page and the tests read it; nothing is said twice.
module kind_info
   use dimensions, only: dim_acceleration, dim_angle, dim_angular_acceleration, dim_angular_damping, dim_angular_speed, &
      dim_angular_stiffness, dim_area, dim_contact_stiffness, dim_damping, dim_density, dim_energy, dim_force, dim_frequency, &
      dim_inertia, dim_length, dim_mass, dim_moment, dim_none, dim_power, dim_pressure, dim_speed, dim_stiffness, dim_t, &
      dim_temperature, dim_time, dim_viscosity, same_dimension
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: channel_t, column_t, dim_t, kind_info_t
   public :: cell_duration, cell_expression, cell_flag, cell_number, cell_reference, cell_vector, cell_word
   public :: cell_condition, cell_file, cell_formula, cell_list, cell_words
   public :: add_any_number, add_condition, add_direction, add_file, add_formula, add_list
   public :: add_channel, add_duration, add_expression, add_flag, add_number, add_reference
   public :: add_vector, add_word, add_words, same_dimension
   public :: dim_acceleration, dim_angle, dim_angular_acceleration, dim_angular_damping, dim_angular_speed
   public :: dim_angular_stiffness, dim_area, dim_contact_stiffness, dim_damping, dim_density, dim_energy
   public :: dim_force, dim_frequency, dim_inertia, dim_length, dim_mass, dim_moment, dim_none, dim_power
   public :: dim_pressure, dim_speed, dim_stiffness, dim_temperature, dim_time, dim_viscosity
   public :: longest_column, no_bound
   public :: in_any_space, in_plane, in_space, is_of_space
   public :: free_spherical, free_other, free_none, free_rotation, free_translation

   integer, parameter :: cell_number = 1      !! one dimensional number
   integer, parameter :: cell_vector = 2      !! `size` numbers with one unit (settings only)
   integer, parameter :: cell_word = 3        !! one word, out of `choices` if that is not blank
   integer, parameter :: cell_words = 4       !! a list of words (settings only)
   integer, parameter :: cell_reference = 5   !! the name of an item: of a point, body, joint, law ...
   integer, parameter :: cell_expression = 6  !! a number, or an expression in the time `t`
   integer, parameter :: cell_flag = 7        !! on or off
   integer, parameter :: cell_duration = 8    !! a time, or `N turns of DRIVER` (settings only)
   integer, parameter :: cell_list = 9        !! numbers with one unit, in quotes (tables only)
   integer, parameter :: cell_file = 10       !! a text file
   integer, parameter :: cell_condition = 11  !! conditions on channels (settings only)
   integer, parameter :: cell_formula = 12    !! an expression over channels, understood when these are known (tables only)

   integer, parameter :: in_any_space = 0  !! a kind of planar and of spatial scenes
   integer, parameter :: in_plane = 1      !! a kind of planar scenes only
   integer, parameter :: in_space = 2      !! a kind of spatial scenes only

   integer, parameter :: free_other = 0     !! a joint leaves more, or what nobody asks for
   integer, parameter :: free_none = 1  !! bodies i and j move as one
   integer, parameter :: free_rotation = 2     !! j turns about the point of i
   integer, parameter :: free_spherical = 4   !! the points of i and j coincide, j turns about them in several ways
   integer, parameter :: free_translation = 3      !! j slides along an axis of i, and does not turn against it

   real(wp), parameter :: no_bound = huge(1.0_wp)  !! marks a bound that is not there [any]

   integer, parameter :: longest_column = 24  !! characters of the name of a column or key, at most
   integer, parameter :: longest_list = 20  !! characters of the names of an expression's variables

   !> Bounds of a number.
   type :: bounds_t
      real(wp) :: lower = -no_bound           !! minimum value allowed, SI [any]
      real(wp) :: upper = no_bound            !! maximum value allowed, SI [any]
      logical :: open_lower = .false.         !! the minimum value itself is not allowed
      logical :: open_upper = .false.         !! the maximum value itself is not allowed
      logical :: not_zero = .false.           !! zero is not allowed
   end type bounds_t

   !> One column of a table, or one key of a section of settings.
   type :: column_t
      character(:), allocatable :: name       !! as written in the deck
      integer :: cell = cell_number           !! what a cell holds, one of the above
      type(dim_t) :: dimension = dim_none     !! of a number, vector or expression
      logical :: is_any = .false.             !! of a number: any dimension will do, and is kept with the value
      character(longest_list) :: variable = "t"   !! of an expression: what it depends on, blank-separated; t is the time
      type(dim_t) :: argument(3) = dim_time   !! of an expression: (3) dimensions of its variables
      logical :: sees_motion = .false.        !! of an expression: it may use positions and velocities, as `ram.velocity.y`
      integer :: size = 1                     !! numbers of a vector (2: in the plane; 3: either 2 or 3), of a list; 1: any number
      character(:), allocatable :: refers_to  !! of a reference: blank-separated prefixes of kinds
      character(:), allocatable :: choices    !! of a word: blank-separated words, blank if any is taken
      character(:), allocatable :: default    !! as in a deck; blank: may be left open; unallocated: required
      type(bounds_t) :: bounds                !! of a number
      logical :: is_free = .false.            !! omitted means more than the default: the echo leaves it out too
      character(:), allocatable :: options    !! of a word: blank-separated option names (`key=value`)
      character(:), allocatable :: help       !! one line
   end type column_t

   !> One output channel of each item of a kind.
   type :: channel_t
      character(:), allocatable :: name   !! the part after the item's name and a dot
      character(:), allocatable :: unit   !! SI, as written in files
      character(:), allocatable :: frame  !! world, body, joint or none
      integer :: components = 1           !! 1; a vector: 2, which in a spatial scene means 3; 4: Euler parameters
      character(:), allocatable :: help   !! long name
      integer :: code = 0                 !! number by which its kind knows it when values are requested
   end type channel_t

   !> A kind: all that the rest of the program knows of it by name.
   type :: kind_info_t
      character(:), allocatable :: name             !! section name, as `joint.revolute`
      character(:), allocatable :: help             !! one line
      character(:), allocatable :: source           !! citation with equation numbers
      integer :: space = in_any_space               !! scenes that know it, one of the above; two kinds of one name differ in it
      logical :: is_table = .true.                  !! a table of items; else settings `key = value`
      integer :: n_row = 0                          !! constraint rows that an item adds
      integer :: free = free_other                 !! of a joint: what of the freedom of j against i, one of the above
      logical :: drives_turn = .false.              !! its row prescribes the turn of the joint that it names
      logical :: couples_joints = .false.           !! its row ties all bodies of the two or three joints that it names
      logical :: counts_turns = .false.             !! its items count turns from step to step
      logical :: is_start_only = .false.            !! the rows hold while the start is made consistent, not after
      type(column_t), allocatable :: columns(:)     !! of the table, without `name`
      type(channel_t), allocatable :: channels(:)   !! of each item
   end type kind_info_t

   interface
      !> What every column has.
      module subroutine start_column(column, name, cell, help, default)
         implicit none (type, external)
         type(column_t), intent(out) :: column          !! the column
         character(*), intent(in) :: name               !! as written in the deck
         integer, intent(in) :: cell                    !! what a cell holds
         character(*), intent(in) :: help               !! one line
         character(*), intent(in), optional :: default  !! as in a deck; absent: required
      end subroutine start_column

      !> Append a column to a kind.
      module subroutine add_column(info, column)
         implicit none (type, external)
         type(kind_info_t), intent(inout) :: info  !! the kind
         type(column_t), intent(inout) :: column   !! its new column; its texts are handed over
      end subroutine add_column

      !> Append an output channel to a kind.
      module subroutine add_channel(info, name, unit, frame, components, help, code)
         implicit none (type, external)
         type(kind_info_t), intent(inout) :: info  !! the kind
         character(*), intent(in) :: name          !! part after the item's name and a dot
         character(*), intent(in) :: unit          !! SI unit, `1` if none
         character(*), intent(in) :: frame         !! world, body, joint or none
         integer, intent(in) :: components         !! 1, or 2 in the plane
         character(*), intent(in) :: help          !! long name
         integer, intent(in), optional :: code     !! number by which the kind knows it
      end subroutine add_channel
   end interface

contains

   !> Append a column that holds one number with a dimension.
   subroutine add_number(info, name, dimension, help, default, lower, upper, open_lower, open_upper, not_zero, is_free)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      type(dim_t), intent(in) :: dimension           !! of the number
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! as in a deck, with its unit; absent: required
      real(wp), intent(in), optional :: lower        !! minimum value allowed, SI [any]
      real(wp), intent(in), optional :: upper        !! maximum value allowed, SI [any]
      logical, intent(in), optional :: open_lower    !! the minimum value itself is not allowed
      logical, intent(in), optional :: open_upper    !! the maximum value itself is not allowed
      logical, intent(in), optional :: not_zero      !! zero is not allowed
      logical, intent(in), optional :: is_free       !! omitted means more than the default

      type(column_t) :: column

      call start_column(column, name, cell_number, help, default)
      column%dimension = dimension
      if (present(lower)) column%bounds%lower = lower
      if (present(upper)) column%bounds%upper = upper
      if (present(open_lower)) column%bounds%open_lower = open_lower
      if (present(open_upper)) column%bounds%open_upper = open_upper
      if (present(not_zero)) column%bounds%not_zero = not_zero
      if (present(is_free)) column%is_free = is_free
      call add_column(info, column)
   end subroutine add_number

   !> Append a column that holds one number of any dimension.
   subroutine add_any_number(info, name, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! as in a deck, with its unit; absent: required

      type(column_t) :: column

      call start_column(column, name, cell_number, help, default)
      column%is_any = .true.
      call add_column(info, column)
   end subroutine add_any_number

   !> Append a column that holds a list of numbers of any one dimension, in quotes.
   subroutine add_list(info, name, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! blank: may be left open; absent: required

      type(column_t) :: column

      call start_column(column, name, cell_list, help, default)
      column%is_any = .true.
      call add_column(info, column)
   end subroutine add_list

   !> Append a column that holds a direction: three numbers in quotes, of any length but zero.
   subroutine add_direction(info, name, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! blank: may be left open; absent: required

      type(column_t) :: column

      call start_column(column, name, cell_list, help, default)
      column%size = 3
      call add_column(info, column)
   end subroutine add_direction

   !> Whether scenes of a space know a kind.
   elemental logical function is_of_space(info, is_spatial)
      type(kind_info_t), intent(in) :: info   !! the kind
      logical, intent(in) :: is_spatial       !! spatial scenes, not planar ones

      is_of_space = info%space == in_any_space .or. info%space == merge(in_space, in_plane, is_spatial)
   end function is_of_space

   !> Append a column that names a text file, which is read with the deck; that of a table has two columns of numbers.
   subroutine add_file(info, name, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! blank: may be left open; absent: required

      type(column_t) :: column

      call start_column(column, name, cell_file, help, default)
      call add_column(info, column)
   end subroutine add_file

   !> Append a column that holds one word, out of `choices` if these are given.
   subroutine add_word(info, name, help, default, choices, options)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! absent: required
      character(*), intent(in), optional :: choices  !! blank-separated words; absent: any
      character(*), intent(in), optional :: options  !! blank-separated names of `name=value` after the word

      type(column_t) :: column

      call start_column(column, name, cell_word, help, default)
      if (present(choices)) column%choices = choices
      if (present(options)) column%options = options
      call add_column(info, column)
   end subroutine add_word

   !> Append a column that names an item of other kinds.
   subroutine add_reference(info, name, refers_to, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: refers_to          !! blank-separated kinds, or a prefix ending in a dot
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! absent: required

      type(column_t) :: column

      call start_column(column, name, cell_reference, help, default)
      column%refers_to = refers_to
      call add_column(info, column)
   end subroutine add_reference

   !> Append a column that holds an expression over channels.
   subroutine add_formula(info, name, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! blank: may be left open; absent: required

      type(column_t) :: column

      call start_column(column, name, cell_formula, help, default)
      call add_column(info, column)
   end subroutine add_formula

   !> Append a column that holds a number or an expression in the time `t`, or in another variable.
   subroutine add_expression(info, name, dimension, help, default, variable, argument, sees_motion)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      type(dim_t), intent(in) :: dimension           !! of its value
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! as in a deck; absent: required
      character(*), intent(in), optional :: variable    !! what it depends on, blank-separated; absent: the time t
      type(dim_t), intent(in), optional :: argument(:)  !! (at most 3) dimensions of the variables
      logical, intent(in), optional :: sees_motion      !! it may use positions and velocities too

      type(column_t) :: column

      call start_column(column, name, cell_expression, help, default)
      column%dimension = dimension
      if (present(variable)) column%variable = variable
      if (present(argument)) column%argument(1:size(argument)) = argument
      if (present(sees_motion)) column%sees_motion = sees_motion
      call add_column(info, column)
   end subroutine add_expression

   !> Append a key that holds several numbers with one unit.
   subroutine add_vector(info, name, dimension, n, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      type(dim_t), intent(in) :: dimension           !! of the numbers
      integer, intent(in) :: n                       !! 2: in the plane; 3: either 2 or 3 numbers
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! as in a deck, with its unit; absent: required

      type(column_t) :: column

      call start_column(column, name, cell_vector, help, default)
      column%dimension = dimension
      column%size = n
      call add_column(info, column)
   end subroutine add_vector

   !> Append a key that holds a list of words.
   subroutine add_words(info, name, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! blank: an empty list; absent: required

      type(column_t) :: column

      call start_column(column, name, cell_words, help, default)
      call add_column(info, column)
   end subroutine add_words

   !> Append a key that holds conditions on channels, any of which is enough; omitted: none.
   subroutine add_condition(info, name, help)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line

      type(column_t) :: column

      call start_column(column, name, cell_condition, help, "")
      call add_column(info, column)
   end subroutine add_condition

   !> Append a column that is on or off.
   subroutine add_flag(info, name, help, default)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! `on` or `off`; absent: required

      type(column_t) :: column

      call start_column(column, name, cell_flag, help, default)
      call add_column(info, column)
   end subroutine add_flag

   !> Append a key that holds a time, or a number of turns of a driver.
   subroutine add_duration(info, name, help, default, lower, open_lower)
      type(kind_info_t), intent(inout) :: info       !! the kind
      character(*), intent(in) :: name               !! as written in the deck
      character(*), intent(in) :: help               !! one line
      character(*), intent(in), optional :: default  !! as in a deck; blank: may be left open; absent: required
      real(wp), intent(in), optional :: lower        !! minimum number of seconds or turns allowed [any]
      logical, intent(in), optional :: open_lower    !! the minimum value itself is not allowed

      type(column_t) :: column

      call start_column(column, name, cell_duration, help, default)
      column%dimension = dim_time
      if (present(lower)) column%bounds%lower = lower
      if (present(open_lower)) column%bounds%open_lower = open_lower
      call add_column(info, column)
   end subroutine add_duration

end module kind_info
