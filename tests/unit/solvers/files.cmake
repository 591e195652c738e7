signorini_add_unit_tests(solvers RANKS "1;2;4" obstacle_cubes.cc random_problems.cc)
