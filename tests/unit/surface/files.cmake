signorini_add_unit_tests(surface RANKS "1;3"
  boundary_depth.cc
  closed_surfaces.cc
  contact_mapping.cc
  coplanar_rims.cc
  crease_edges.cc
  creases.cc
  degenerate_pairs.cc
  layers.cc
  matching_rims.cc
  oracle.cc
  parts.cc
  phi.cc
  random_pairs.cc
  smooth_surface.cc
  surface_mesh.cc
)
