// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_contact_solve_h
#define signorini_application_contact_solve_h

#include <signorini/application/discretization.h>
#include <signorini/application/linear_comparison.h>
#include <signorini/mesh/coarser_meshes.h>
#include <signorini/solvers/obstacle_solver.h>
#include <signorini/solvers/sweep_measurement.h>

#include <optional>
#include <vector>

namespace Signorini
{
  struct SolveParameters
  {
    SolverParameters solver;
    /// Solve the decoupled linear problem, loaded with the contact stresses, from the same start.
    bool compare_linear = false;
    /// Time sweeps on the finest level.
    bool measure_sweeps = false;
  };

  /// What the solution on one mesh gives that on the next.
  struct NestedStart
  {
    /// Physical, on the partition of the next space (ConstrainedSpace::interpolate()).
    Vector displacement;
    bool   needed_interface_sweeps = false, needed_patches = false;
  };

  /// The multipliers, per row of the joined coupling: contact stress and its normal part, the pressure (force
  /// per area); opening g - n·û (length); whether active.
  struct ContactStress
  {
    std::vector<Vector3>       traction;
    std::vector<double>        pressure, opening;
    std::vector<unsigned char> active;
  };

  /// No stress, all gaps as they are, nothing active.
  ContactStress no_stress(const Discretization &discretization);

  struct ContactSolution
  {
    ConvergenceReport report;
    /// Physical, on the partition of the space, ghosts up to date.
    Vector        displacement;
    ContactStress stress;
    /// Active contact nodes; tied ones do not count.
    std::size_t n_active = 0;
    /// Of the multigrid hierarchy.
    unsigned int     n_levels = 0;
    SweepMeasurement sweeps;
    /// If it was wanted and the linear problem has a unique solution.
    std::optional<LinearComparison> linear;
  };

  /// Errors: InputError for methods that cannot solve a pair.
  void check_method(const PairDefinition &pair, const SolverMethod method);

  /// Collective. Solves the contact problem of one mesh.
  /// @param coarser the spaces below, kept from mesh to mesh
  /// @param start null on the first mesh
  /// Errors: those of check_method() and check_free_parts(); InputError for loads that press no body into
  /// contact that could hold it.
  ContactSolution solve_contact(const ContactModel &model, const Discretization &discretization,
                                CoarserSpaces &coarser, const NestedStart *const start,
                                const SolveParameters &parameters, Journal &journal);
} // namespace Signorini

#endif
