// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_plane_solver_h
#define signorini_solvers_plane_solver_h

#include <signorini/solvers/coarse_cholesky.h>
#include <signorini/solvers/contact_state.h>
#include <signorini/solvers/v_cycle.h>

#include <memory>

namespace Signorini
{
  /// A copy of a matrix in which active nodes stay on their planes: without the normal parts there, but for
  /// the diagonal entry, so that it can be inverted. Collective.
  NodeBlockMatrix matrix_on_planes(const NodeBlockMatrix &matrix, const HalfSpaces &half_spaces,
                                   const std::vector<unsigned char> &active);

  /// What active-set steps ask of the linear solver: corrections in which active nodes stay on their planes.
  class PlaneSolver
  {
  public:
    virtual ~PlaneSolver() = default;

    /// Collective. The planes of these active nodes from now on.
    virtual void setup(const HalfSpaces &half_spaces, const std::vector<unsigned char> &active) = 0;

    /// Collective. correction = (approximate, symmetric) inverse times a residual without normal parts at
    /// active nodes.
    virtual void correct(Vector &correction, const Vector &residual) = 0;

    /// Whether the inverse is exact but for rounding.
    virtual bool is_exact() const = 0;
  };

  /// By sparse factors on rank 0: for small meshes, and thin bodies.
  class FactoredPlanes : public PlaneSolver
  {
  public:
    /// The matrix must outlive the object.
    /// @param is_semidefinite whether it has a kernel: then the inverse is that of a matrix beside it, good
    ///   to nine digits but for the motions that nothing opposes
    explicit FactoredPlanes(const NodeBlockMatrix &matrix, const bool is_semidefinite = false);

    /// Collective. How many multiplications each setup() will take.
    double cost()
    {
      return factors.cost(matrix);
    }

    void setup(const HalfSpaces &half_spaces, const std::vector<unsigned char> &active) override;

    void correct(Vector &correction, const Vector &residual) override
    {
      factors.solve(correction, residual);
    }

    bool is_exact() const override
    {
      return true;
    }

  private:
    const NodeBlockMatrix &matrix;
    const bool             is_semidefinite;
    CoarseCholesky         factors;
  };

  /// By one linear V-cycle on the spaces truncated at active nodes, the finest one among them: a
  /// preconditioner of conjugate gradients.
  class CycledPlanes : public PlaneSolver
  {
  public:
    /// The hierarchy must outlive the object; its truncation is changed.
    /// @param level the finest one of the problem
    CycledPlanes(MultigridHierarchy &hierarchy, const unsigned int level,
                 const SmoothingParameters &smoothing);

    void setup(const HalfSpaces &half_spaces, const std::vector<unsigned char> &active) override;

    void correct(Vector &correction, const Vector &residual) override;

    bool is_exact() const override
    {
      return false;
    }

  private:
    MultigridHierarchy       &hierarchy;
    const unsigned int        level;
    const SmoothingParameters smoothing;
    VCycle                    cycle;
    /// On the planes, and what smooths it; nothing is projected.
    NodeBlockMatrix           reduced;
    std::unique_ptr<Smoother> smoother;
    ContactState              free, contact;
    Vector                    residual_left, step, coarse_defect, coarse_correction;
  };
} // namespace Signorini

#endif
