// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_linear_comparison_h
#define signorini_application_linear_comparison_h

#include <signorini/application/discretization.h>
#include <signorini/discretization/level_hierarchy.h>
#include <signorini/solvers/obstacle_solver.h>

namespace Signorini
{
  struct ContactStress;

  /// The decoupled linear problem with the contact stresses as loads: what contact costs beyond it.
  struct LinearComparison
  {
    /// V-cycles alone, and as preconditioner of conjugate gradients.
    ConvergenceReport multigrid, multigrid_cg;
    /// Relative difference (energy norm) between its solution and that of contact.
    double difference = 0.;
  };

  /// What the linear problem is compared with: the contact problem on the same mesh.
  struct LinearTask
  {
    /// Its levels.
    const LevelSpaces &levels;
    /// Its solution: the displacement (physical), and what is the load here.
    const Vector        &displacement;
    const ContactStress &stress;
    /// What it began with (physical); null for zero.
    const Vector *const start;
  };

  /// Collective. Solves the linear problem by both methods.
  LinearComparison compare_linear(const ContactModel &model, const Discretization &discretization,
                                  const LinearTask &task, const SolverParameters &parameters,
                                  Journal &journal);
} // namespace Signorini

#endif
