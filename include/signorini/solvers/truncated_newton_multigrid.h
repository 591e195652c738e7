// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_truncated_newton_multigrid_h
#define signorini_solvers_truncated_newton_multigrid_h

#include <signorini/solvers/convergence_report.h>
#include <signorini/solvers/multigrid_hierarchy.h>
#include <signorini/solvers/v_cycle.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <memory>

namespace Signorini
{
  /// How the corrections of the V-cycle are used.
  enum class Acceleration
  {
    /// As they are.
    none,
    /// As preconditioned residuals of a conjugate gradient method while the active set rests.
    conjugate_gradients
  };

  struct SolverParameters
  {
    Acceleration        acceleration = Acceleration::conjugate_gradients;
    SmoothingParameters smoothing;
    /// Stop when the energy norm of the correction is below this multiple of that of the iterate.
    double       tolerance      = 1e-12;
    unsigned int max_iterations = 100;

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// Truncated nonsmooth Newton multigrid (Gräser, Sack & Sander 2009): projected smoothing on the finest
  /// level, one linear V-cycle on the coarse spaces truncated at active nodes, projection, exact line
  /// search, post-smoothing. Without half-spaces this is the linear multigrid.
  ///
  /// With acceleration: as long as the active set rests, the same iteration is a linear symmetric
  /// preconditioner z = M(v) - v of the residual on the free components, and the step goes along the
  /// A-conjugate direction p = z - (z·Ap_old / p_old·Ap_old) p_old with the exact step length. This
  /// minimizes the energy over v + span(z, p_old), so it never ends above M(v). Where the active set moves
  /// or p leaves the admissible set, M(v) is taken. Neither needs a product with A more than the plain
  /// iteration.
  ///
  /// One iteration is one application of the V-cycle.
  class TruncatedNewtonMultigrid
  {
  public:
    /// Called after each iteration: number, energy norm of the correction relative to the iterate, active
    /// nodes.
    using Monitor = std::function<void(unsigned int, double, unsigned int)>;

    /// The hierarchy must outlive the object; its truncation is changed.
    TruncatedNewtonMultigrid(MultigridHierarchy &hierarchy, const SolverParameters &parameters);

    /// Collective. Solves from the given start, which is projected first. v has the layout of the finest
    /// level.
    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor = {});

    /// For each half-space of the last solve whether it is active.
    const std::vector<unsigned char> &active() const
    {
      return hierarchy.finest().smoother->active();
    }

  private:
    void smooth(Vector &v, const Vector &rhs, const ProjectedGaussSeidel::Direction direction);

    /// Truncated V-cycle, projection and, if wanted, exact line search; returns v·(b − residual).
    double correct(Vector &v, const ObstacleProblem &problem, const bool search);

    /// Largest step along c that keeps the half-spaces, those that are active in `ignored` left out.
    double admissible_step(const Vector &v, const Vector &c, const HalfSpaces &half_spaces,
                           const std::vector<unsigned char> *const ignored = nullptr) const;

    /// One accelerated step from `start` with the correction z, az = A z; false if it is not to be taken.
    /// On success z and az are the correction made and its product with A.
    bool accelerate(const Vector &start, const Vector &residual, Vector &z, Vector &az,
                    const HalfSpaces &half_spaces);

    bool all_ranks(const bool condition) const;

    MultigridHierarchy    &hierarchy;
    const SolverParameters parameters;
    VCycle                 cycle;
    unsigned int           n_updates = 0;
    /// Last direction and its product with A; empty at a restart.
    Vector direction, direction_product;
    bool   has_direction = false;
  };
} // namespace Signorini

#endif
