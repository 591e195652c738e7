// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_contact_solve_h
#define signorini_application_contact_solve_h

#include <signorini/application/discretization.h>
#include <signorini/application/linear_comparison.h>
#include <signorini/discretization/level_hierarchy.h>
#include <signorini/mesh/coarser_meshes.h>
#include <signorini/output/results.h>
#include <signorini/solvers/obstacle_solver.h>
#include <signorini/solvers/sweep_measurement.h>

#include <optional>
#include <vector>

namespace Signorini
{
  /// How the problem of one mesh is solved.
  struct SolveParameters
  {
    /// Method, smoothing, stopping.
    SolverParameters solver;
    /// Solve the decoupled linear problem, loaded with the contact stresses, from the same start.
    bool compare_linear = false;
    /// Time sweeps on the finest level.
    bool measure_sweeps = false;
    /// What is below the coarsest mesh.
    CoarseLevels coarse_levels = CoarseLevels::automatic;

    /// None where they would not be used: a method without levels, or a solver of level 0 that somebody
    /// chose.
    CoarseLevels coarse_levels_of_method() const
    {
      const bool are_of_use =
          needs_levels(solver.method) &&
          (coarse_levels != CoarseLevels::automatic || solver.level_zero == LevelZeroMethod::automatic);
      return are_of_use ? coarse_levels : CoarseLevels::none;
    }
  };

  /// What the solution on one mesh gives that on the next.
  struct NestedStart
  {
    /// Physical, on the partition of the next space (ConstrainedSpace::interpolate()).
    Vector displacement;
    /// What was slow there will be slow here (ConvergenceReport).
    bool needed_interface_sweeps = false, needed_patches = false;
  };

  /// The multipliers, per row of the joined coupling on this rank: contact stress and its normal part, the
  /// pressure (force per area); opening g - n·û (length); whether active.
  struct ContactStress
  {
    /// Of the nonmortar surface on the mortar surface; along the normal, but in any direction at tied nodes.
    std::vector<Vector3> traction;
    /// Its normal part, positive where the surfaces press on each other; the gap that is left.
    std::vector<double> pressure, opening;
    /// 1 where the surfaces touch and press, else 0; 0 at tied nodes.
    std::vector<unsigned char> active;
  };

  /// No stress, all gaps as they are, nothing active.
  ContactStress no_stress(const Discretization &discretization);

  /// Why motions of bodies are held at points.
  enum class HoldReason
  {
    /// A solution drifts along them, and only facets oppose that.
    drifting,
    /// It slides along rigid obstacles, and only the normals of the body oppose that.
    sliding,
    /// The surfaces oppose them by next to nothing, before there is a solution.
    unopposed
  };

  /// Motions along which a solution slides far although the true bodies do not oppose them.
  struct Drift
  {
    /// Why they are to be held.
    HoldReason reason = HoldReason::drifting;
    /// Coefficients of the free motions; empty if it does not.
    std::vector<std::vector<double>> motions;
    /// Of one that slides: by how much normals change within a face where bodies touch (1).
    double turn = 0.;
  };

  /// The solution of the contact problem of one mesh. The same on all ranks but for displacement and stress.
  struct ContactSolution
  {
    /// Of the solver.
    ConvergenceReport report;
    /// Physical, on the partition of the space, ghosts up to date.
    Vector        displacement;
    ContactStress stress;
    /// Bolts, if there are any.
    std::vector<PretensionResult> pretensions;
    /// Active contact nodes; tied ones do not count.
    std::size_t n_active = 0;
    /// Of the multigrid hierarchy.
    unsigned int n_levels = 0;
    /// What it slides along far. Or a motion that nothing opposes, which has to be held before anything can
    /// be solved: then all but this is empty.
    Drift drift;
    /// If they were to be measured.
    SweepMeasurement sweeps;
    /// If it was wanted and the linear problem has a unique solution.
    std::optional<LinearComparison> linear;
  };

  /// Errors: InputError for methods that cannot solve a pair.
  void check_method(const PairDefinition &pair, const SolverMethod method);

  /// Matrix, levels, right hand side and half-spaces of a mesh.
  struct AlgebraicProblem;

  /// The contact problem of one mesh, set up once and solved for one load after the other: matrix and levels
  /// stay.
  class ContactSolver
  {
  public:
    /// Collective. Parameters and errors as for solve_contact(); model and journal must outlive the object.
    ContactSolver(const ContactModel &model, const Discretization &discretization, CoarserSpaces &coarser,
                  const NestedStart *const start, const SolveParameters &parameters, Journal &journal);
    ~ContactSolver();

    /// Collective. Solves, from the start or from what change_loads() was given.
    /// @param discretization the one of the constructor or of the last change_loads()
    /// Errors: those of settle_free_parts().
    ContactSolution solve(const Discretization &discretization);

    /// Collective. Takes the loads of the present time of the model.
    /// @param discretization of the same mesh, with the conditions of that time
    /// @param displacement to begin with; physical, on the partition of the space
    void change_loads(const Discretization &discretization, const Vector &displacement);

    /// Collective. Times sweeps of the hierarchy.
    SweepMeasurement measure() const;

    /// Gives the hierarchy away; returns the levels it was built on, if there is to be a comparison.
    std::shared_ptr<const LevelSpaces> release();

  private:
    const ContactModel               &model;
    Journal                          &journal;
    SolverParameters                  parameters;
    unsigned int                      n_levels;
    std::unique_ptr<AlgebraicProblem> algebraic;
  };

  /// Collective. Free motions that the surfaces oppose by next to nothing, wherever they touch, with what has
  /// to be held with them (of_same_parts()): no solution shows how far bodies move along these.
  std::vector<std::vector<double>> find_unopposed_motions(const ContactModel   &model,
                                                          const Discretization &discretization);

  /// Collective. Solves the contact problem of one mesh, the strains of bolts too, which the model keeps.
  /// @param coarser the spaces below, kept from mesh to mesh
  /// @param start null on the first mesh
  /// Errors: those of check_method() and check_free_parts(); InputError for loads that press no body into
  /// contact that could hold it.
  ContactSolution solve_contact(ContactModel &model, const Discretization &discretization,
                                CoarserSpaces &coarser, const NestedStart *const start,
                                const SolveParameters &parameters, Journal &journal);
} // namespace Signorini

#endif
