signorini_add_unit_tests(mesh RANKS "1;2;4"
  boundary_shape.cc
  damaged_files.cc
  deck.cc
  expression.cc
  facing_parts.cc
  forest_vertices.cc
  generated_mesh.cc
  mesh_input.cc
  separate_process.cc
  size_limit.cc
  distributed_forest.cc
  serial_forest.cc
  surface_extraction.cc
  tetrahedral_forest.cc
  surface_file.cc
  symmetry_planes.cc
)
