signorini_add_layer(output
  field_output.cc
  final_words.cc
  output_folder.cc
  progress.cc
  summary.cc
  termination.cc
)
