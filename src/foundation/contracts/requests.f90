!> What a deck asks of a motion beside the channels of its items: points, places, reactions, and expressions over channels.
!>
!> Every point of the deck can report its position, velocity and acceleration, world frame. A row of [request.motion] is a point as
!> observed from another one or from a body; one of [request.reaction] the reaction of a joint or spring at a point, along the axes
!> of a body; one of [request] an expression over channels.
module requests
   use expression, only: expression_t
   use kind_info, only: add_channel, add_formula, add_reference, add_word, dim_none, dim_t, in_plane, in_space, kind_info_t
   use observable, only: place_t, sees_acceleration, sees_distance, sees_distance_rate, sees_position, sees_velocity
   use text, only: text_t
   implicit none (type, external)
   private
   public :: formula_t, motion_request_info, motion_request_t, of_reaction_force, of_reaction_moment, point_channels, &
      reaction_info, reaction_request_t, request_info, requests_t, source_t
   public :: source_force, source_ideal, source_joint, source_clearance_joints, source_none

   integer, parameter :: of_reaction_force = 1   !! channel of a reaction
   integer, parameter :: of_reaction_moment = 2  !! channel of a reaction

   integer, parameter :: source_none = 0   !! a reaction of a joint that the system does not have
   integer, parameter :: source_joint = 1  !! of an ideal joint or a driver
   integer, parameter :: source_ideal = 2  !! of a joint with clearance that is taken as ideal
   integer, parameter :: source_clearance_joints = 3  !! of a joint with clearance
   integer, parameter :: source_force = 4  !! of a spring, damper or actuator between two bodies

   !> A channel by its names, so that it can be found in any catalogue.
   type :: source_t
      integer :: item_group = 0                        !! group of items of the catalogue
      character(:), allocatable :: item          !! name of the item; of a contact, its joint's
      character(:), allocatable :: label         !! of a contact
      character(:), allocatable :: channel       !! the quantity
      integer :: component = 1                   !! its component
   end type source_t

   !> An expression over channels.
   type :: formula_t
      character(:), allocatable :: name          !! of the request
      character(:), allocatable :: text          !! as written
      character(:), allocatable :: unit          !! SI unit of its value
      type(expression_t) :: expression           !! of the time and the channels
      type(source_t), allocatable :: sources(:)  !! (channels) what it reads
   end type formula_t

   !> A point as it is observed from somewhere.
   type :: motion_request_t
      character(:), allocatable :: name   !! of the request
      type(place_t) :: place              !! the point, and from where
   end type motion_request_t

   !> A reaction at a point.
   type :: reaction_request_t
      character(:), allocatable :: name   !! of the request
      character(:), allocatable :: joint  !! name of the joint, or of what else has a reaction
      logical :: on_j = .false.           !! on the body of j, not on that of i
      integer :: source = source_none     !! where it is in a system, one of the above
      integer :: slot = 0                 !! its set there
      integer :: item = 0                 !! its number in the set
      logical :: has_point = .false.      !! at a point of its own, not where the joint has its force
      type(place_t) :: place              !! the point, and the axes
   end type reaction_request_t

   !> All of a deck.
   type :: requests_t
      logical :: is_spatial = .false.                       !! whether bodies move in space
      type(text_t), allocatable :: points(:)                !! (points) names of those that have channels
      type(place_t), allocatable :: places(:)               !! (points) these
      type(motion_request_t), allocatable :: motions(:)     !! (any) rows of [request.motion]
      type(reaction_request_t), allocatable :: reactions(:) !! (any) rows of [request.reaction]
      type(formula_t), allocatable :: formulas(:)           !! (any) rows of [request] that were understood
   end type requests_t

contains

   !> The deck table of expressions over channels.
   function request_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "request"
      info%help = "requests: expressions of channels, recorded as channels request.NAME"
      info%source = ""
      call add_formula(info, "value", "expression of channels, the time t and functions: {-ram.velocity.y*hand.force.y}")
      call add_word(info, "unit", "unit of the value; default: that of the expression", default="")
   end function request_info

   !> The deck table of points as observed from elsewhere.
   function motion_request_info() result(info)
      type(kind_info_t) :: info  !! columns and channels

      info%name = "request.motion"
      info%help = "motion of a point relative to another point or a body: relative motion, coupler curves, accelerometers"
      info%source = "Flores et al. (2008), eqs. (2.1), (6.1)"
      call add_reference(info, "point", "points", "the point")
      call add_reference(info, "from", "points", "reference point; none: the origin of the frame", default="none")
      call add_reference(info, "frame", "bodies", "body whose axes define the components, or ground", default="ground")
      call add_word(info, "observer", "observer of rates: frame, rotating with the body of the frame, so that they are the " &
                    //"derivatives of the components; world, like an accelerometer on that body", default="frame", &
                    choices="frame world")
      call add_channel(info, "position", "m", "body", 2, "position of the point relative to the reference point, along the "// &
         "axes of the frame", &
                       sees_position)
      call add_channel(info, "velocity", "m/s", "body", 2, "its velocity", sees_velocity)
      call add_channel(info, "acceleration", "m/s^2", "body", 2, "its acceleration", sees_acceleration)
      call add_channel(info, "distance", "m", "none", 1, "distance of the two points", sees_distance)
      call add_channel(info, "distance_rate", "m/s", "none", 1, "its rate", sees_distance_rate)
   end function motion_request_info

   !> The channels of the deck's points; codes are those of `observable`.
   function point_channels() result(info)
      type(kind_info_t) :: info  !! channels

      info%name = "points"
      call add_channel(info, "position", "m", "world", 2, "position of the point", sees_position)
      call add_channel(info, "velocity", "m/s", "world", 2, "velocity of the point", sees_velocity)
      call add_channel(info, "acceleration", "m/s^2", "world", 2, "acceleration of the point", sees_acceleration)
   end function point_channels

   !> The deck table of reactions at points.
   function reaction_info(is_spatial) result(info)
      logical, intent(in) :: is_spatial   !! in space
      type(kind_info_t) :: info           !! columns and channels

      info%name = "request.reaction"
      info%space = merge(in_space, in_plane, is_spatial)
      info%help = "reaction of a joint, driver or spring at a point, along the axes of a body"
      info%source = "Flores et al. (2008), eq. (2.24)"
      call add_word(info, "joint", "the joint, driver, joint with clearance, spring or torsional spring")
      call add_word(info, "on", "the body that it acts on", default="i", choices="i j")
      call add_reference(info, "point", "points", "reference point of the moment; default: that of the joint", &
                         default="none")
      call add_reference(info, "frame", "bodies", "body whose axes define the components, or ground", default="ground")
      call add_channel(info, "force", "N", "body", 2, "force on the body", of_reaction_force)
      call add_channel(info, "moment", "N.m", "body", merge(2, 1, is_spatial), "moment on the body about the point", &
                       of_reaction_moment)
   end function reaction_info

end module requests
