signorini_add_unit_tests(discretization RANKS "1;2;4"
  elasticity.cc
  hexahedron.cc
)
