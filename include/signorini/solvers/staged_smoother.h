// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_staged_smoother_h
#define signorini_solvers_staged_smoother_h

#include <signorini/solvers/projected_gauss_seidel.h>
#include <signorini/solvers/rounded_gauss_seidel.h>
#include <signorini/solvers/smoother.h>

#include <memory>

namespace Signorini
{
  /// What a smoother knows of the contact nodes of its level.
  struct LevelInterface
  {
    /// Contact nodes of both sides: global numbers, sorted, the same on all ranks. Empty without contact.
    std::vector<NodeIndex> contact_nodes;
    /// Whether a nonmortar side is stiffer than its mortar side: then it is measured whether sweeps by node
    /// over the contact nodes are slow.
    bool may_be_slow = false;
  };



  /// Sweeps over the contact nodes of both sides and one layer of neighbours.
  class InterfaceSweep : public SmoothingStage
  {
  public:
    /// Matrix and sweeps must outlive the object.
    /// @param contact_nodes global numbers
    InterfaceSweep(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                   const std::vector<NodeIndex> &contact_nodes);

    void run(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction) override
    {
      sweeps.sweep(v, rhs, contact, direction, schedule);
    }

    void run_with_residual(Vector &v, const Vector &, ContactState &contact, Vector &residual) override
    {
      sweeps.sweep_with_residual(v, contact, schedule, residual);
    }

    const std::vector<unsigned int> &rows() const override
    {
      return owned;
    }

  private:
    const ProjectedGaussSeidel &sweeps;
    std::vector<unsigned int>   owned;
    SweepSchedule               schedule;
  };



  /// The smoother of all levels: sweeps by node (in single precision within a cycle), after each of them the
  /// stages that go with it (lines and planes of stretched cells), and nearest to the coarse correction the
  /// stages of the interface (sweeps, and where those are slow a minimization over all contact nodes at
  /// once). Backward everything runs in the opposite order.
  class StagedSmoother : public Smoother
  {
  public:
    /// Collective. The matrix must outlive the object.
    StagedSmoother(const NodeBlockMatrix &matrix, const LevelInterface &interface);

    void smooth(Vector &v, const Vector &rhs, ContactState &contact, const SmoothingParameters &parameters,
                const Direction direction) override;

    void smooth_from_zero(Vector &v, const Vector &rhs, ContactState &contact,
                          const SmoothingParameters &parameters, Vector &residual) override;

    void smooth_to_residual(Vector &v, const Vector &rhs, ContactState &contact,
                            const SmoothingParameters &parameters, Vector *const residual) override;

    void update(const std::vector<unsigned int> &rows) override;

    void strengthen() override;

    bool is_slow_at_interface() const override
    {
      // Only then there is a minimization behind the sweep.
      return at_interface.size() > 1;
    }

  private:
    void smooth_interface(Vector &v, const Vector &rhs, ContactState &contact, const unsigned int n_sweeps,
                          const Direction direction);
    void run_rounded(SmoothingStage &stage, Vector &v, const Vector &rhs, ContactState &contact,
                     const Direction direction, const bool passes_on);

    ProjectedGaussSeidel sweeps;
    RoundedGaussSeidel   rounded;
    /// In the order of a forward run.
    std::vector<std::unique_ptr<SmoothingStage>> after_sweeps, at_interface;
  };
} // namespace Signorini

#endif
