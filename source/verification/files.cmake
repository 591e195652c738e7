signorini_add_layer(verification COLD
  corner_problems.cc
  hertz_problems.cc
  indenter_problems.cc
  manufactured_problems.cc
  mapping_problems.cc
  measurement.cc
  obstacle_problems.cc
  patch_problems.cc
  press_fit_problems.cc
  shell_problems.cc
  verification_problem.cc
  verification_report.cc
  verify_command.cc
)
