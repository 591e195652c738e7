signorini_add_unit_tests(algebra RANKS "1;2;4"
  block_row.cc
  collectives.cc
  fixed_directions.cc
  node_block_matrix.cc
  replicated_data.cc
  rounded_sweep.cc
  row_projection.cc
)
