signorini_add_layer(solvers
  coarse_cholesky.cc
  multigrid_hierarchy.cc
  projected_gauss_seidel.cc
  sweep_schedule.cc
  truncated_newton_multigrid.cc
  v_cycle.cc
)
