signorini_add_layer(surface
  contact_mapping.cc
  normal_projection.cc
  pair_intersection.cc
  surface_mesh.cc
)
