signorini_add_unit_tests(mortar RANKS "1;2;3;4;8"
  contact_forces.cc
  dual_basis.cc
  edge_normals.cc
  face_claims.cc
  face_moments.cc
  face_seats.cc
  interface_parts.cc
  pair_conflicts.cc
  received_bytes.cc
  rigid_obstacle.cc
  two_step_rule.cc
)
