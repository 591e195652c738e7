signorini_add_layer(discretization
  basis_transformation.cc
  boundary_conditions.cc
  elasticity.cc
  hexahedron.cc
  interpolation_exchange.cc
  level_hierarchy.cc
)
