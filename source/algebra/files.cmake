signorini_add_layer(algebra
  nodal_transfer.cc
  node_block_matrix.cc
  node_partition.cc
  replicated_data.cc
)
