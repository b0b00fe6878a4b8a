!> A scene: what a deck means, validated, in SI, with every name turned into a number.
module scene
   use bodies, only: bodies_t, material_t, points_t
   use friction_law, only: friction_slot_t
   use film_law, only: film_slot_t
   use integration_settings, only: integration_t
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use lubricant, only: oil_t
   use normal_law, only: normal_law_t
   use requests, only: requests_t
   use state_equations, only: state_equations_t
   use wear_law, only: wear_slot_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: analysis_dynamic, analysis_kinematic, analysis_names, analysis_static, n_analysis
   public :: friction_slot_t, law_slot_t, n_base, scene_t, section_t, settings_t, table_t
   public :: table_formulas, table_motions, table_reactions
   public :: table_bodies, table_lubricants, table_materials, table_points, table_shapes

   integer, parameter :: table_bodies = 1     !! base table: bodies
   integer, parameter :: table_points = 2     !! base table: points
   integer, parameter :: table_materials = 3  !! base table: materials
   integer, parameter :: table_lubricants = 4 !! base table: lubricants
   integer, parameter :: table_shapes = 5     !! base table: shapes
   integer, parameter :: n_base = 5           !! base tables

   integer, parameter :: table_formulas = 1   !! requests: expressions over channels
   integer, parameter :: table_motions = 2    !! requests: points as observed from elsewhere
   integer, parameter :: table_reactions = 3  !! requests: reactions at points
   integer, parameter :: n_requests = 3       !! tables of requests

   integer, parameter :: analysis_dynamic = 1    !! motion in time under forces
   integer, parameter :: analysis_kinematic = 2  !! motion prescribed by drivers
   integer, parameter :: analysis_static = 3     !! equilibrium at rest
   integer, parameter :: n_analysis = 3          !! analyses

   !> Their names: section [analysis.NAME].
   character(*), parameter :: analysis_names(n_analysis) = [character(9) :: "dynamic", "kinematic", "static"]

   !> The rows of one kind.
   type :: table_t
      type(kind_info_t), pointer :: info => null()   !! the kind, of `kind_list`
      type(item_t), allocatable :: items(:)          !! (rows) rows, references resolved
   end type table_t

   !> A place for a normal law of any kind.
   type :: law_slot_t
      class(normal_law_t), allocatable :: law  !! the law
   end type law_slot_t

   !> A section of settings: its values, defaults where the deck has none.
   type, extends(item_t) :: section_t
      type(kind_info_t), pointer :: info => null()   !! its keys, of `kind_list`
      logical :: is_present = .false.                !! whether the deck has it
   end type section_t

   !> What a deck sets. `kinematic`, `statistics`, `ensemble` and `life` have values only if the deck has them,
   !> the others have defaults.
   type :: settings_t
      type(section_t) :: header                       !! of the scene itself
      logical :: is_spatial = .false.                 !! whether bodies move in space, not in the plane x, y
      logical :: has_analysis(n_analysis) = .false.   !! (analyses) which analyses the deck has
      type(section_t) :: dynamic                      !! [analysis.dynamic] as the deck has it
      type(integration_t) :: integration              !! what it and the command line set, as values
      type(section_t) :: kinematic                    !! [analysis.kinematic]
      type(section_t) :: static                       !! [analysis.static]
      type(section_t) :: guards                       !! limits and conditions of a run
      type(section_t) :: output                       !! what is written
      type(section_t) :: statistics                   !! numbers of the motion after its transient
      type(section_t) :: ensemble                     !! runs from perturbed starts
      type(section_t) :: life                         !! wear over many cycles
      type(section_t) :: precision                    !! settings of an integration to be compared
   end type settings_t

   !> Tables that became something else when they were read: kept for the echo, and for what is reported of them.
   type :: tables_t
      type(table_t) :: base(n_base)                    !! (kinds) bodies, points, materials, lubricants, shapes
      type(table_t), allocatable :: functions(:)       !! (kinds) named functions
      type(table_t), allocatable :: laws(:)            !! (kinds) normal laws
      type(table_t), allocatable :: frictions(:)       !! (kinds) friction laws
      type(table_t), allocatable :: wears(:)           !! (kinds) wear laws
      type(table_t), allocatable :: films(:)           !! (kinds) films
      type(table_t), allocatable :: worn(:)            !! (kinds) surfaces that are worn at the start
      type(table_t) :: requests(n_requests)            !! (kinds) requests
      type(table_t) :: states                          !! state equations
   end type tables_t

   !> What lubricates joints.
   type :: lubrication_t
      type(film_slot_t), allocatable :: films(:)   !! (films) lubricant films
      type(oil_t), allocatable :: oils(:)          !! (lubricants) all of them
   end type lubrication_t

   !> What a deck means.
   !> Components: what is asked for stands beside what moves.
   type :: scene_t
      character(:), allocatable :: title                     !! one line
      real(wp) :: gravity(3) = 0.0_wp                        !! (3) acceleration of free fall, world frame [m/s^2]
      type(bodies_t) :: bodies                               !! rigid bodies
      type(points_t) :: points                               !! body-fixed points
      type(material_t), allocatable :: materials(:)          !! (materials) elastic materials
      type(law_slot_t), allocatable :: laws(:)               !! (laws) normal laws
      type(friction_slot_t), allocatable :: frictions(:)     !! (laws) friction laws
      type(wear_slot_t), allocatable :: wears(:)             !! (laws) wear laws
      type(worn_surface_t), allocatable :: worn(:)           !! (any) surfaces that are worn at the start; unallocated: none
      type(lubrication_t) :: lubrication                     !! films and lubricants
      type(table_t), allocatable :: joints(:)                !! (kinds) joints and drivers
      type(table_t), allocatable :: forces(:)                !! (kinds) force elements
      type(table_t), allocatable :: clearances(:)            !! (kinds) joints with clearance
      type(tables_t) :: tables                               !! the other tables
      type(requests_t) :: requests                           !! what is asked of the motion
      type(state_equations_t) :: states                      !! own equations of the deck
      integer :: analysis = analysis_dynamic                 !! which analysis runs
      type(settings_t) :: settings                           !! of it, of the output and of studies
      real(wp) :: size_of_whole = 0.0_wp                     !! size of the bodies of what this is a group of; 0: all is here [m]
   end type scene_t

end module scene
