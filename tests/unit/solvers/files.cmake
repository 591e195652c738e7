signorini_add_unit_tests(solvers RANKS "1;2;4" convergence.cc foreign_levels.cc free_bodies.cc gathered_problems.cc linear_multigrid.cc obstacle_cubes.cc
  random_problems.cc safety_net.cc)
