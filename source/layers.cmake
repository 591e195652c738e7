# Explicit, sorted file lists. Lower layers first.
signorini_add_layer(algebra
  distributed_rows.cc
  node_block_matrix.cc
  node_partition.cc
)
include(surface/files.cmake)
signorini_add_layer(solvers
  projected_gauss_seidel.cc
)
include(mesh/files.cmake)
signorini_add_layer(discretization
  elasticity.cc
)
include(mortar/files.cmake)
include(output/files.cmake)
