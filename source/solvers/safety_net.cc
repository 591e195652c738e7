// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/safety_net.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Logarithm of what an iteration has taken off the correction, in the mean over those watched.
    double decay_of(const std::vector<double> &history, const std::size_t n_watched)
    {
      return std::log(history[history.size() - 1 - n_watched] / history.back()) /
             static_cast<double>(n_watched);
    }

    /// Iterations to the tolerance, at the rate of the last ones.
    double iterations_left(const ConvergenceReport &report, const SolverParameters &parameters)
    {
      const double relative = parameters.tolerance * report.scale;
      const double target   = parameters.absolute_tolerance > 0. ? parameters.absolute_tolerance : relative;
      const double decay    = decay_of(report.history, parameters.net_rule.n_watched);
      return decay > 0. ? std::log(report.history.back() / target) / decay
                        : std::numeric_limits<double>::max();
    }
  } // namespace



  SafetyNet::SafetyNet(MultigridHierarchy &hierarchy, const SolverParameters &parameters,
                       const unsigned int level, TruncatedCycle &cycle, ConvergenceReport &report)
    : hierarchy(hierarchy)
    , parameters(parameters)
    , net_rule(parameters.net_rule)
    , level(level)
    , cycle(cycle)
  {
    if (is_wanted() && parameters.starts_with_patches && may_take_patches())
      strengthen(report);
  }



  bool SafetyNet::is_wanted() const
  {
    return parameters.safety_net && parameters.method == SolverMethod::accelerated;
  }



  bool SafetyNet::acts(const bool is_conjugate, Vector &v, const ObstacleProblem &problem,
                       ContactState &contact, ConvergenceReport &report,
                       const ObstacleSolver::Monitor &monitor)
  {
    n_conjugate         = is_conjugate ? n_conjugate + 1 : 0;
    const Remedy remedy = due(report, problem);
    if (remedy == Remedy::contact_subspace)
      {
        cycle.begin_in_subspace();
        watch_anew(report);
      }
    else if (remedy == Remedy::patches)
      strengthen(report);
    else if (remedy == Remedy::active_set_steps)
      take_over(v, problem, contact, report, monitor);
    return remedy != Remedy::none;
  }



  double SafetyNet::n_unknowns() const
  {
    return static_cast<double>(dim * hierarchy.level(level).matrix.partition().n_global());
  }



  bool SafetyNet::is_small() const
  {
    return n_unknowns() <= net_rule.small;
  }



  bool SafetyNet::may_take_patches() const
  {
    const unsigned int n_ranks =
        Utilities::MPI::n_mpi_processes(hierarchy.level(level).matrix.partition().communicator());
    return !hierarchy.has_strong_smoothers() && n_unknowns() <= net_rule.largest_for_patches * n_ranks;
  }



  void SafetyNet::choose_planes(const bool is_semidefinite)
  {
    const NodeBlockMatrix &matrix = hierarchy.level(level).matrix;
    if (n_unknowns() <= net_rule.largest_for_factors)
      {
        auto factors = std::make_unique<FactoredPlanes>(matrix, is_semidefinite);
        if (is_small() || factors->cost() <= net_rule.cheap_factors)
          planes = std::move(factors);
      }
    if (!planes)
      planes = std::make_unique<CycledPlanes>(hierarchy, level, parameters.smoothing);
  }



  SafetyNet::Remedy SafetyNet::due(const ConvergenceReport &report, const ObstacleProblem &problem)
  {
    if (!is_wanted() || report.converged || level + 1 != hierarchy.n_levels() || report.scale <= 0. ||
        (problem.semidefinite && problem.free_motions.empty()))
      return Remedy::none;
    // Whatever the rate waits for: it is due once.
    if (report.iterations == net_rule.n_to_settle && !problem.semidefinite && n_conjugate == 0 &&
        cycle.may_begin_in_subspace() && report.history.back() > net_rule.most_left * report.history.front())
      return Remedy::contact_subspace;
    return report.iterations >= not_before && report.history.size() > net_rule.n_watched
               ? due_to_rate(report, problem)
               : Remedy::none;
  }



  SafetyNet::Remedy SafetyNet::due_to_rate(const ConvergenceReport &report, const ObstacleProblem &problem)
  {
    const double slow =
        std::min(net_rule.few_left + n_unknowns() / net_rule.unknowns_for_one_more, net_rule.many_left);
    if (iterations_left(report, parameters) <= slow)
      return Remedy::none;
    if (!planes)
      choose_planes(problem.semidefinite);
    if (planes->is_exact())
      return Remedy::active_set_steps;
    const bool searches = n_conjugate + net_rule.fewest_searched <= net_rule.n_watched;
    if (may_take_patches() && (has_failed || !searches))
      return Remedy::patches;
    // V-cycles in single precision leave work on free motions.
    return searches && !problem.semidefinite ? Remedy::active_set_steps : Remedy::none;
  }



  void SafetyNet::watch_anew(const ConvergenceReport &report)
  {
    not_before  = report.iterations + static_cast<unsigned int>(net_rule.n_watched) + 1;
    n_conjugate = 0;
  }



  void SafetyNet::strengthen(ConvergenceReport &report)
  {
    report.needed_patches = !is_small();
    report.before_patches = report.iterations;
    if (report.needed_patches)
      hierarchy.strengthen_smoothers();
    has_failed = false;
    watch_anew(report);
  }



  void SafetyNet::take_over(Vector &v, const ObstacleProblem &problem, ContactState &contact,
                            ConvergenceReport &report, const ObstacleSolver::Monitor &monitor)
  {
    if (!steps)
      steps = std::make_unique<ActiveSetSolver>(hierarchy, parameters, level, *planes);
    SafetyNetReport   &net      = report.safety_net;
    const unsigned int n_before = steps->n_steps(), after = report.iterations;
    const double       rate  = std::exp(-decay_of(report.history, net_rule.n_watched));
    const bool         ended = steps->go_on(v, contact.active(), problem, report, monitor);
    for (std::size_t p = 0; p < contact.size(); ++p)
      contact.set_active(p, steps->active()[p]);
    has_failed = !ended;
    n_given_back += ended ? 0 : 1;
    // Longer each time.
    not_before  = report.iterations + (static_cast<unsigned int>(net_rule.n_watched) << n_given_back);
    n_conjugate = 0;
    // Bodies that would fly away on the first set: nothing was done.
    if (steps->n_steps() == n_before)
      return;
    if (net.after == 0)
      {
        net.after         = after;
        net.rate          = rate;
        net.linear_solver = planes->is_exact() ? "sparse factors" : "conjugate gradients with the V-cycle";
      }
    net.n_steps = steps->n_steps();
    net.n_failed += ended ? 0 : 1;
  }
} // namespace Signorini
