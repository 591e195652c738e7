signorini_add_layer(discretization
  boundary_conditions.cc
  elasticity.cc
  expression.cc
  hexahedron.cc
  interpolation_exchange.cc
  level_hierarchy.cc
)
