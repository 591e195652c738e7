signorini_add_layer(application
  contact_evaluation.cc
  contact_problem.cc
  contact_setup.cc
  parameters.cc
  problem_description.cc
  write_results.cc
)
