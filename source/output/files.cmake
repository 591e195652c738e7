signorini_add_layer(output COLD
  checkpoint_file.cc
  field_output.cc
  frd_output.cc
  load_curve.cc
  final_words.cc
  output_folder.cc
  process_memory.cc
  progress.cc
  report_mesh.cc
  report_page.cc
  report_surfaces.cc
  report_template.cc
  summary.cc
  termination.cc
  vtu_file.cc
)
