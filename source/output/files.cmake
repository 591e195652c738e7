signorini_add_layer(output
  field_output.cc
  frd_output.cc
  output_folder.cc
  progress.cc
  summary.cc
  termination.cc
)
