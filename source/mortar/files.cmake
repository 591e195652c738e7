signorini_add_layer(mortar
  face_moments.cc
  pair_coupling.cc
)
