signorini_add_layer(algebra
  algebraic_multigrid.cc
  nodal_transfer.cc
  node_block_matrix.cc
  node_partition.cc
  replicated_data.cc
  vector_span.cc
)
