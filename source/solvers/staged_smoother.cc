// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/interface_correction.h>
#include <signorini/solvers/staged_smoother.h>
#include <signorini/solvers/strong_blocks.h>
#include <signorini/solvers/sweep_rate.h>

namespace Signorini
{
  namespace
  {
    using Stages = std::vector<std::unique_ptr<SmoothingStage>>;

    /// In order, or backward in the opposite order.
    template <typename Action>
    void for_each_stage(const Stages &stages, const Direction direction, const Action &action)
    {
      for (std::size_t i = 0; i < stages.size(); ++i)
        action(*stages[direction == Direction::forward ? i : stages.size() - 1 - i]);
    }

    bool is_slow(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                 const std::vector<NodeIndex> &contact_nodes)
    {
      std::vector<unsigned int> contact_rows;
      for (const NodeIndex node : contact_nodes)
        if (matrix.partition().owns(node))
          contact_rows.push_back(matrix.partition().to_local(node));
      return sweep_rate(matrix, sweeps, sweeps.schedule(contact_rows), slow_at_interface) >=
             slow_at_interface.slow;
    }
  } // namespace



  InterfaceSweep::InterfaceSweep(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                                 const std::vector<NodeIndex> &contact_nodes)
    : SmoothingStage(matrix)
    , sweeps(sweeps)
  {
    std::vector<bool> is_contact(matrix.partition().n_local(), false);
    for (const NodeIndex node : contact_nodes)
      if (const unsigned int local = matrix.partition().to_local(node);
          local != dealii::numbers::invalid_unsigned_int)
        is_contact[local] = true;
    owned    = matrix.rows_with_column([&](const unsigned int column) { return is_contact[column]; });
    schedule = sweeps.schedule(owned);
  }



  StagedSmoother::StagedSmoother(const NodeBlockMatrix &matrix, const LevelInterface &interface)
    : Smoother(matrix)
    , sweeps(matrix)
    , rounded(matrix, sweeps)
  {
    auto blocks = std::make_unique<StrongBlocks>(matrix, sweeps);
    if (!interface.contact_nodes.empty())
      {
        at_interface.push_back(std::make_unique<InterfaceSweep>(matrix, sweeps, interface.contact_nodes));
        if (interface.may_be_slow && is_slow(matrix, sweeps, interface.contact_nodes))
          {
            auto correction = std::make_unique<InterfaceCorrection>(matrix, interface.contact_nodes);
            blocks->drop_within(correction->contact_rows());
            at_interface.push_back(std::move(correction));
          }
      }
    if (!blocks->empty())
      after_sweeps.push_back(std::move(blocks));
  }



  void StagedSmoother::update(const std::vector<unsigned int> &rows)
  {
    sweeps.update(rows);
    rounded.update(rows);
    for (const Stages *stages : {&after_sweeps, &at_interface})
      for (const auto &stage : *stages)
        stage->update(rows);
  }



  void StagedSmoother::strengthen()
  {
    after_sweeps.clear();
    after_sweeps.push_back(std::make_unique<StrongBlocks>(matrix, sweeps, StrongBlocks::Choice::patches));
  }



  void StagedSmoother::smooth_interface(Vector &v, const Vector &rhs, ContactState &contact,
                                        const unsigned int n_sweeps, const Direction direction)
  {
    for (unsigned int i = 0; i < n_sweeps; ++i)
      for_each_stage(at_interface, direction,
                     [&](SmoothingStage &stage) { stage.run(v, rhs, contact, direction); });
  }



  void StagedSmoother::smooth(Vector &v, const Vector &rhs, ContactState &contact,
                              const SmoothingParameters &parameters, const Direction direction)
  {
    v.update_ghost_values();
    const auto run_stages = [&] {
      for_each_stage(after_sweeps, direction,
                     [&](SmoothingStage &stage) { stage.run(v, rhs, contact, direction); });
    };
    if (direction == Direction::forward)
      for (unsigned int i = 0; i < parameters.n_pre; ++i)
        {
          sweeps.sweep(v, rhs, contact, direction);
          run_stages();
        }
    smooth_interface(v, rhs, contact, parameters.n_interface_sweeps, direction);
    if (direction == Direction::backward)
      for (unsigned int i = 0; i < parameters.n_post; ++i)
        {
          run_stages();
          sweeps.sweep(v, rhs, contact, direction);
        }
  }



  void StagedSmoother::run_rounded(SmoothingStage &stage, Vector &v, const Vector &rhs, ContactState &contact,
                                   const Direction direction, const bool passes_on)
  {
    stage.run_and_follow(v, rhs, contact, direction,
                         [&](const unsigned int node, const double *const change) {
                           rounded.follow(v, node, change, passes_on);
                         });
  }



  void StagedSmoother::smooth_from_zero(Vector &v, const Vector &rhs, ContactState &contact,
                                        const SmoothingParameters &parameters, Vector &residual)
  {
    v = 0.;
    rounded.start(v, rhs, contact);
    if (parameters.n_pre == 0)
      residual.copy_locally_owned_data_from(rhs);
    const auto run_with_residual = [&](SmoothingStage &stage) {
      stage.run_with_residual(v, rhs, contact, residual);
    };
    for (unsigned int i = 0; i < parameters.n_pre; ++i)
      {
        const bool            is_last = i + 1 == parameters.n_pre;
        RoundedSweep::Options options;
        options.keeps_residual = is_last;
        rounded.sweep(v, rhs, contact, options);
        if (is_last)
          rounded.get_residual(residual, contact);
        for_each_stage(after_sweeps, Direction::forward, [&](SmoothingStage &stage) {
          if (is_last)
            run_with_residual(stage);
          else
            run_rounded(stage, v, rhs, contact, Direction::forward, true);
        });
      }
    for (unsigned int i = 0; i < parameters.n_interface_sweeps; ++i)
      for_each_stage(at_interface, Direction::forward, run_with_residual);
    residual.zero_out_ghost_values();
  }



  void StagedSmoother::smooth_to_residual(Vector &v, const Vector &rhs, ContactState &contact,
                                          const SmoothingParameters &parameters, Vector *const residual)
  {
    v.update_ghost_values();
    smooth_interface(v, rhs, contact, parameters.n_interface_sweeps, Direction::backward);
    if (parameters.n_post > 0)
      rounded.start(v, rhs, contact);
    for (unsigned int i = 0; i < parameters.n_post; ++i)
      {
        // Nothing has been passed on before the first sweep, which passes all on.
        RoundedSweep::Options options;
        options.backward   = true;
        options.passes_all = i == 0;
        for_each_stage(after_sweeps, Direction::backward, [&](SmoothingStage &stage) {
          run_rounded(stage, v, rhs, contact, Direction::backward, !options.passes_all);
        });
        rounded.sweep(v, rhs, contact, options);
      }
    if (residual != nullptr)
      matrix.symmetric_residual(*residual, v, rhs);
  }
} // namespace Signorini
