signorini_add_layer(application
  contact_evaluation.cc
  contact_problem.cc
  parameters.cc
  write_results.cc
)
