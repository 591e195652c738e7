signorini_add_layer(discretization
  background_levels.cc background_octree.cc basis_transformation.cc
  boundary_conditions.cc
  coarse_contact.cc
  condition_frame.cc
  elasticity.cc
  elasticity_pattern.cc
  element.cc
  error_indicator.cc
  exact_error.cc
  hexahedron.cc
  interpolation_exchange.cc
  level_hierarchy.cc
  level_spaces.cc
  rigid_support.cc
  transformed_rows.cc
  vertex_expansion.cc
)
