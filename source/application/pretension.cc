// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "shank.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/journal.h>
#include <signorini/application/pretension.h>

#include <Eigen/LU>

#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Collective. By bolt.
    std::vector<Shank> find_shanks(const ContactModel &model, const Discretization &d)
    {
      std::vector<Shank> shanks;
      for (std::size_t i = 0; i < model.loads().pretensions.size(); ++i)
        shanks.emplace_back(model, d, i);
      return shanks;
    }

    /// By how much the strains of all bolts have to change, times their stiffnesses E A (forces).
    /// @param missing forces; zero for bolts that are locked
    Eigen::VectorXd secant_step(const ContactModel &model, const Eigen::VectorXd &missing)
    {
      const auto               &bolts = model.loads().pretensions;
      std::vector<Eigen::Index> open;
      for (std::size_t i = 0; i < bolts.size(); ++i)
        if (!bolts[i].is_locked(model.loads().time))
          open.push_back(static_cast<Eigen::Index>(i));
      if (open.empty())
        return missing;
      const auto      n = static_cast<Eigen::Index>(open.size());
      Eigen::MatrixXd slopes(n, n);
      Eigen::VectorXd forces(n);
      for (Eigen::Index i = 0; i < n; ++i)
        {
          forces[i] = missing[open[i]];
          for (Eigen::Index j = 0; j < n; ++j)
            slopes(i, j) = bolts[open[i]].slopes[open[j]];
        }
      const Eigen::FullPivLU<Eigen::MatrixXd> inverse(slopes);
      Eigen::VectorXd                         step = missing;
      if (inverse.isInvertible())
        {
          const Eigen::VectorXd of_open = inverse.solve(forces);
          for (Eigen::Index i = 0; i < n; ++i)
            step[open[i]] = of_open[i];
        }
      return step;
    }

    /// Broyden's: the matrix next to the old one that explains what the last step did.
    void update_slopes(std::vector<Pretension> &bolts, const Eigen::VectorXd &step,
                       const Eigen::VectorXd &change)
    {
      for (std::size_t i = 0; i < bolts.size(); ++i)
        {
          std::vector<double> &slopes   = bolts[i].slopes;
          double               expected = 0.;
          for (std::size_t j = 0; j < bolts.size(); ++j)
            expected += slopes[j] * step[j];
          for (std::size_t j = 0; j < bolts.size(); ++j)
            slopes[j] += (change[i] - expected) * step[j] / step.squaredNorm();
          slopes[i] = std::max(slopes[i], PretensionRule().smallest_slope);
        }
    }

    /// Collective.
    Eigen::VectorXd forces_of(const std::vector<Shank> &shanks, const Vector &displacement)
    {
      Eigen::VectorXd forces(static_cast<Eigen::Index>(shanks.size()));
      for (std::size_t i = 0; i < shanks.size(); ++i)
        forces[i] = shanks[i].force(displacement);
      return forces;
    }

    /// The forces that are missing, and whether they are small enough.
    struct Missing
    {
      Eigen::VectorXd forces;
      bool            is_small = true;

      Missing(const ContactModel &model, const std::vector<Shank> &shanks, const Eigen::VectorXd &present,
              const Vector &displacement)
        : forces(present)
      {
        const auto &bolts   = model.loads().pretensions;
        double      largest = 0.;
        for (const Pretension &bolt : bolts)
          largest = std::max(largest, bolt.wanted(model.loads().time));
        const double moved = displacement.linfty_norm();
        for (std::size_t i = 0; i < bolts.size(); ++i)
          {
            if (bolts[i].is_locked(model.loads().time))
              {
                forces[i] = 0.;
                continue;
              }
            const double wanted = bolts[i].wanted(model.loads().time);
            forces[i]           = wanted - present[i];
            // Bolts that should be loose are compared with the others; where all should be, with what the
            // displacements would be for them if their ends had them against each other.
            const double scale = wanted > 0.    ? wanted
                                 : largest > 0. ? largest
                                                : shanks[i].stiffness() * moved / shanks[i].length();
            is_small           = is_small && std::abs(forces[i]) <= PretensionRule().tolerance * scale;
          }
      }
    };

    std::vector<PretensionResult> results_of(const ContactModel &model, const std::vector<Shank> &shanks,
                                             const Eigen::VectorXd           &forces,
                                             const std::vector<unsigned int> &iterations)
    {
      std::vector<PretensionResult> results;
      for (std::size_t i = 0; i < shanks.size(); ++i)
        {
          const Pretension &bolt = model.loads().pretensions[i];
          results.push_back({model.bodies().body_name(bolt.body),
                             bolt.name,
                             bolt.wanted(model.loads().time),
                             forces[i],
                             bolt.strain,
                             shanks[i].length(),
                             bolt.strain * shanks[i].length(),
                             iterations,
                             {}});
          if (bolt.is_locked(model.loads().time))
            results.back().locked_after = bolt.locked_after;
        }
      return results;
    }
  } // namespace



  void foretell_pretension(ContactModel &model, const Discretization &d)
  {
    std::vector<Pretension> &bolts = model.pretensions();
    if (bolts.empty())
      return;
    const std::vector<Shank> shanks = find_shanks(model, d);
    Eigen::VectorXd          missing(static_cast<Eigen::Index>(bolts.size()));
    for (std::size_t i = 0; i < bolts.size(); ++i)
      {
        const double wanted = bolts[i].wanted(model.loads().time);
        if (!(wanted >= 0.))
          throw InputError(bolts[i].where + ": the force " + Patterns::Tools::to_string(wanted) +
                           " is negative; a bolt is under tension.");
        missing[i] = bolts[i].is_locked(model.loads().time) ? 0. : wanted - bolts[i].reached;
        if (bolts[i].slopes.empty())
          {
            bolts[i].slopes.assign(bolts.size(), 0.);
            bolts[i].slopes[i] = 1.;
          }
      }
    const Eigen::VectorXd step = secant_step(model, missing);
    for (std::size_t i = 0; i < bolts.size(); ++i)
      {
        bolts[i].strain += step[i] / shanks[i].stiffness();
        // Foretold again before it is solved, it stays.
        bolts[i].reached += missing[i];
      }
  }



  ContactSolution solve_with_pretension(ContactModel &model, ContactSolver &solver, const Discretization &d,
                                        Journal &journal)
  {
    const PretensionRule     rule;
    std::vector<Pretension> &bolts    = model.pretensions();
    ContactSolution          solution = solver.solve(d);
    if (bolts.empty() || !solution.drift.motions.empty())
      return solution;
    std::vector<unsigned int> iterations = {solution.report.iterations};
    const std::vector<Shank>  shanks     = find_shanks(model, d);
    Vector                    before;
    Eigen::VectorXd           forces = forces_of(shanks, solution.displacement), last_step;
    Missing                   missing(model, shanks, forces, solution.displacement);
    while (solution.report.converged && !missing.is_small && iterations.size() < rule.solutions)
      {
        const Eigen::VectorXd step = secant_step(model, missing.forces);
        for (std::size_t i = 0; i < bolts.size(); ++i)
          bolts[i].strain += step[i] / shanks[i].stiffness();
        // What the last step did to the displacement, this one will do in proportion.
        Vector start = solution.displacement;
        if (last_step.size() > 0)
          {
            const double share = step.dot(last_step) / last_step.squaredNorm();
            start.sadd(1. + share, -share, before);
            start.update_ghost_values();
          }
        before    = solution.displacement;
        last_step = step;
        journal.show("tightening bolts");
        solver.change_loads(d, start);
        solution = solver.solve(d);
        if (!solution.drift.motions.empty())
          return solution;
        iterations.push_back(solution.report.iterations);
        const Eigen::VectorXd present = forces_of(shanks, solution.displacement);
        update_slopes(bolts, step, present - forces);
        forces  = present;
        missing = Missing(model, shanks, forces, solution.displacement);
      }
    for (std::size_t i = 0; i < bolts.size(); ++i)
      if (!bolts[i].is_locked(model.loads().time))
        bolts[i].reached = forces[i];
    if (solution.report.converged && !missing.is_small)
      {
        solution.report.converged = false;
        solution.report.note      = "the pretension was not reached in " + std::to_string(rule.solutions) +
                               " solutions: does anything hold the ends of the bolts?";
      }
    solution.pretensions = results_of(model, shanks, forces, iterations);
    return solution;
  }



  namespace
  {
    /// Those before the present one after which bolts are locked.
    std::set<double> lock_times(const ContactModel &model)
    {
      std::set<double> times;
      for (const Pretension &bolt : model.loads().pretensions)
        if (bolt.is_locked(model.loads().time))
          times.insert(bolt.locked_after);
      return times;
    }
  } // namespace



  ContactSolution solve_with_locked_pretension(ContactModel &model, ContactSolver &solver,
                                               const Discretization &d, const Vector *const start,
                                               Journal &journal)
  {
    const double                           now = model.loads().time;
    std::vector<std::vector<unsigned int>> iterations(model.loads().pretensions.size());
    Vector                                 displacement;
    d.partition().reinit(displacement);
    if (start != nullptr)
      displacement = *start;
    displacement.update_ghost_values();
    const std::set<double> times = lock_times(model);
    for (const Pretension &bolt : model.loads().pretensions)
      if (bolt.locked_after < std::numeric_limits<double>::max() && !bolt.is_locked(now))
        journal.note(bolt.where +
                     ": it is not locked, as all ends at t = " + Patterns::Tools::to_string(now) + ".");
    for (const double time : times)
      {
        model.set_time(time);
        const Discretization there(d, std::make_shared<const ConstrainedSpace>(*d.constrained, model));
        foretell_pretension(model, there);
        solver.change_loads(there, displacement);
        ContactSolution solution = solve_with_pretension(model, solver, there, journal);
        if (!solution.report.converged || !solution.drift.motions.empty())
          {
            // It is no solution of the present time.
            model.set_time(now);
            solution.report.converged = false;
            solution.report.note +=
                " (at t = " + Patterns::Tools::to_string(time) + ", when bolts are locked)";
            return solution;
          }
        for (std::size_t i = 0; i < iterations.size(); ++i)
          if (model.loads().pretensions[i].locked_after == time)
            iterations[i] = solution.pretensions[i].iterations;
        displacement = solution.displacement;
      }
    if (!times.empty())
      {
        model.set_time(now);
        foretell_pretension(model, d);
        solver.change_loads(d, displacement);
      }
    ContactSolution result = solve_with_pretension(model, solver, d, journal);
    for (std::size_t i = 0; i < result.pretensions.size(); ++i)
      if (!iterations[i].empty())
        result.pretensions[i].iterations = iterations[i];
    return result;
  }
} // namespace Signorini
