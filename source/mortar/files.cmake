signorini_add_layer(mortar
  body_edges.cc
  contact_forces.cc
  contact_indicator.cc
  corner_sight.cc
  crease_normals.cc
  dual_basis.cc
  edge_corner.cc
  edge_normals.cc
  face_claims.cc
  face_map.cc
  face_moments.cc
  face_seats.cc
  face_shares.cc
  gap_fit.cc
  geometric_penetration.cc
  joined_couplings.cc
  multiplier_nodes.cc
  pair_conflicts.cc
  pair_coupling.cc
  partner_sight.cc
  rigid_obstacle.cc
  surface_halo.cc
  surface_values.cc
)
# tests/application/broken.cmake puts another object in its place.
set_source_files_properties(mortar/gap_fit.cc mortar/pair_coupling.cc PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
