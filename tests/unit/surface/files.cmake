signorini_add_unit_tests(surface
  contact_mapping.cc
  degenerate_pairs.cc
  oracle.cc
  phi.cc
  random_pairs.cc
  surface_mesh.cc
)
