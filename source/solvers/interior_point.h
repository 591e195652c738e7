// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_solvers_interior_point_h
#define signorini_source_solvers_interior_point_h

#include "gathered_blocks.h"

#include <Eigen/CholmodSupport>

namespace Signorini
{
  /// Minimizes ½ sᵀ A s - rᵀ s with n_p . s_p <= room_p by a primal-dual interior point method with predictor
  /// and corrector (Mehrotra 1992). It takes some ten to thirty factorizations whatever the guess is, and
  /// motions that cost next to nothing do not make it cycle as they do active set methods.
  class InteriorPoint
  {
  public:
    using Cholesky = Eigen::CholmodSupernodalLLT<GatheredBlocks::UpperHalf, Eigen::Upper>;

    struct Rule
    {
      /// Iterations; what has not ended then has no minimum, or one too far away.
      unsigned int n_iterations = 60;
      /// Part of the way to the first plane or pressure zero.
      double part_of_way = .99;
      /// Complementarity and forces that are left, relative to those of the start: the active set is known
      /// long before.
      double tolerance = 1e-10;
      /// The same where it cannot go on: near the end the springs of active nodes make rounding of everything
      /// else in the factors.
      double enough = 1e-7;
      /// Part of the diagonal that is added, to the matrix only, where it cannot be factorized without: the
      /// first one, and by what it grows.
      double regularization = 1e-13, growth = 100.;
      double most_regularization = 1e-6;
    };

    /// All must outlive the object.
    /// @param upper structure of the upper half, which `cholesky` has analyzed; values are overwritten
    InteriorPoint(const GatheredBlocks &matrix, const std::vector<NodeState> &states,
                  GatheredBlocks::UpperHalf &upper, Cholesky &cholesky);

    /// Whether it has come to the minimizer; then active() is its active set.
    bool run();

    /// Node by node, 1 or 0: whether the pressure is nearer to its scale than the distance is.
    std::vector<unsigned char> active() const;

    /// What has been found.
    const Eigen::VectorXd &step() const
    {
      return s;
    }

  private:
    /// Of s, the distances w and the pressures (forces) l of constrained nodes.
    struct Change
    {
      Eigen::VectorXd s, w, l;
    };

    bool factorize();
    /// Newton's step for forces, distances, and the products w l that are missing.
    Change          newton(const Eigen::VectorXd &products) const;
    double          longest(const Change &change) const;
    Eigen::VectorXd normal_parts(const Eigen::VectorXd &x) const;
    void            subtract_pressures(Eigen::VectorXd &forces, const Eigen::VectorXd &pressures) const;

    const GatheredBlocks         &matrix;
    const std::vector<NodeState> &states;
    GatheredBlocks::UpperHalf    &upper;
    Cholesky                     &cholesky;
    /// Nodes with a half-space; for each node its place there.
    std::vector<std::size_t> constrained, place;
    Eigen::VectorXd          load, s, w, l;
    /// What is missing: forces at nodes, distances.
    Eigen::VectorXd force_defect, way_defect;
    double          scale_w = 0., scale_l = 0., regularization = 0.;
  };
} // namespace Signorini

#endif
