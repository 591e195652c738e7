signorini_add_layer(algebra
  algebraic_multigrid.cc
  block_row.cc
  block_storage.cc
  block_structure.cc
  collectives.cc
  dense_matrix.cc
  fixed_directions.cc
  galerkin_product.cc
  interface_rows.cc
  nodal_transfer.cc
  node_block_matrix.cc
  node_exchange.cc
  node_partition.cc
  rank_colour.cc
  replicated_data.cc
  rounded_sweep.cc
  vector_span.cc
)
# Kernels that exist once for each kind of processor compile alone.
set_source_files_properties(algebra/block_row.cc algebra/rounded_sweep.cc PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
