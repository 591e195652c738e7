signorini_add_unit_tests(application RANKS "1;2" deck_problem.cc problem_definition.cc)
