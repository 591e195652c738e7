signorini_add_unit_tests(application RANKS "1;2" problem_definition.cc)
