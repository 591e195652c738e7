signorini_add_unit_tests(discretization RANKS "1;2;4"
  background_levels.cc
  coarse_contact.cc
  elasticity.cc
  error_indicator.cc
  hexahedron.cc
  level_hierarchy.cc
  motion_description.cc
  partly_fixed.cc
  mean_dilatation.cc
  nodal_stress.cc
)
