!> A scene: what a deck means, validated, in SI, with every name turned into a number.
module scene
   use bodies, only: bodies_t, material_t, points_t
   use clearance_registry, only: n_clearance_kinds
   use contact_registry, only: n_friction_kinds, n_law_kinds
   use friction_law, only: friction_slot_t
   use force_registry, only: n_force_kinds
   use function_registry, only: n_function_kinds
   use item, only: item_t
   use joint_registry, only: n_joint_kinds
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use normal_law, only: normal_law_t
   implicit none (type, external)
   private
   public :: analysis_dynamic, analysis_kinematic, analysis_names, analysis_static, n_analysis
   public :: friction_slot_t, law_slot_t, n_base, scene_t, table_t, table_bodies, table_materials, table_points

   integer, parameter :: table_bodies = 1     !! base table: bodies
   integer, parameter :: table_points = 2     !! base table: points
   integer, parameter :: table_materials = 3  !! base table: materials
   integer, parameter :: n_base = 3           !! base tables

   integer, parameter :: analysis_dynamic = 1    !! motion in time under forces
   integer, parameter :: analysis_kinematic = 2  !! motion prescribed by drivers
   integer, parameter :: analysis_static = 3     !! equilibrium at rest
   integer, parameter :: n_analysis = 3          !! analyses

   !> Their names: section [analysis.NAME].
   character(*), parameter :: analysis_names(n_analysis) = [character(9) :: "dynamic", "kinematic", "static"]

   !> The rows of one kind.
   type :: table_t
      type(kind_info_t) :: info                 !! the kind
      type(item_t), allocatable :: items(:)     !! (rows) rows, references resolved
   end type table_t

   !> A place for a normal law of any kind.
   type :: law_slot_t
      class(normal_law_t), allocatable :: law  !! the law
   end type law_slot_t

   !> What a deck means.
   type :: scene_t
      character(:), allocatable :: title                     !! one line
      real(wp) :: gravity(3) = 0.0_wp                        !! (3) acceleration of free fall, world frame [m/s^2]
      type(bodies_t) :: bodies                               !! rigid bodies
      type(points_t) :: points                               !! body-fixed points
      type(material_t), allocatable :: materials(:)          !! (materials) elastic materials
      type(law_slot_t), allocatable :: laws(:)               !! (laws) normal laws
      type(friction_slot_t), allocatable :: frictions(:)     !! (laws) friction laws
      type(item_t) :: header                                 !! settings of the scene itself
      type(table_t) :: base(n_base)                          !! (kinds) bodies, points, materials
      type(table_t) :: functions(n_function_kinds)           !! (kinds) named functions
      type(table_t) :: law_tables(n_law_kinds)               !! (kinds) normal laws
      type(table_t) :: friction_tables(n_friction_kinds)     !! (kinds) friction laws
      type(table_t) :: joints(n_joint_kinds)                 !! (kinds) joints and drivers
      type(table_t) :: forces(n_force_kinds)                 !! (kinds) force elements
      type(table_t) :: clearances(n_clearance_kinds)         !! (kinds) joints with clearance
      integer :: analysis = analysis_dynamic                 !! which analysis runs
      logical :: has_analysis(n_analysis) = .false.          !! (analyses) which of them the deck has
      type(kind_info_t) :: dynamic_kind                      !! keys of [analysis.dynamic]
      type(item_t) :: dynamic                                !! its settings, defaults if the deck has none
      type(kind_info_t) :: kinematic_kind                    !! keys of [analysis.kinematic]
      type(item_t) :: kinematic                              !! its settings, if the deck has it
      type(kind_info_t) :: static_kind                       !! keys of [analysis.static]
      type(item_t) :: static                                 !! its settings, defaults if the deck has none
      type(kind_info_t) :: guards_kind                       !! keys of the guards
      type(item_t) :: guards                                 !! what they are set to
      type(kind_info_t) :: output_kind                       !! keys of the output
      type(item_t) :: output                                 !! settings of the output
      logical :: has_statistics = .false.                    !! whether statistics are asked for
      type(kind_info_t) :: statistics_kind                   !! keys of the statistics
      type(item_t) :: statistics                             !! their settings
      logical :: has_ensemble = .false.                      !! whether there are runs from perturbed starts
      type(kind_info_t) :: ensemble_kind                     !! keys of the ensemble
      type(item_t) :: ensemble                               !! its settings
      real(wp) :: size_of_whole = 0.0_wp                     !! size of the bodies of what this is a group of; 0: all is here [m]
      logical :: has_precision = .false.                     !! whether the deck says what settings are compared
      type(kind_info_t) :: precision_kind                    !! keys of that comparison
      type(item_t) :: precision                              !! its settings, defaults if the deck has none
   end type scene_t

end module scene
