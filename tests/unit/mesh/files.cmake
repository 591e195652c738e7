signorini_add_unit_tests(mesh RANKS "1;2;4"
  boundary_shape.cc
  deck.cc
  expression.cc
  generated_mesh.cc
  mesh_input.cc
  size_limit.cc
  surface_extraction.cc
  tetrahedral_forest.cc
  surface_file.cc
  symmetry_planes.cc
)
