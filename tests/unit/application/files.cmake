signorini_add_unit_tests(application RANKS "1;2;4" deck_problem.cc pair_pieces.cc problem_definition.cc)
