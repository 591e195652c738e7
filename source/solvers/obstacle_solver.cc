// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/parameter_choice.h>
#include <signorini/solvers/active_set_amg.h>
#include <signorini/solvers/gauss_seidel_iteration.h>
#include <signorini/solvers/linear_multigrid.h>
#include <signorini/solvers/monotone_multigrid.h>
#include <signorini/solvers/obstacle_solver.h>
#include <signorini/solvers/truncated_newton_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    const std::map<SolverMethod, std::string> &method_names()
    {
      static const std::map<SolverMethod, std::string> names = {
          {SolverMethod::accelerated, "accelerated"},
          {SolverMethod::truncated_newton_multigrid, "truncated newton multigrid"},
          {SolverMethod::monotone_multigrid, "monotone multigrid"},
          {SolverMethod::active_set_amg, "active set amg"},
          {SolverMethod::projected_gauss_seidel, "projected gauss seidel"},
          {SolverMethod::multigrid, "multigrid"},
          {SolverMethod::multigrid_cg, "multigrid cg"}};
      return names;
    }

    const std::map<std::string, LevelZeroMethod> &level_zero_names()
    {
      static const std::map<std::string, LevelZeroMethod> names = {
          {"automatic", LevelZeroMethod::automatic},
          {"cholesky", LevelZeroMethod::cholesky},
          {"amg", LevelZeroMethod::amg},
          {"algebraic shortened", LevelZeroMethod::algebraic_shortened}};
      return names;
    }

    LevelZeroMethod level_zero_method(const std::string &name)
    {
      const auto &names = level_zero_names();
      for (const auto &entry : names)
        if (plain_word(entry.first) == plain_word(name))
          return entry.second;
      std::string known;
      for (const auto &entry : names)
        known += (known.empty() ? "" : ", ") + entry.first;
      throw InputError(
          "Solver/Level 0: there is no \"" + name + "\", only " + known + "." +
          (name == "algebraic monotone"
               ? " What had this name is \"algebraic shortened\": it has no obstacles on its aggregates."
               : ""));
    }
  } // namespace



  namespace
  {
    void add_method(ParameterHandler &prm, SolverParameters &p)
    {
      add_choice(prm, "Method", p.method, method_names(),
                 "accelerated: truncated Newton multigrid whose V-cycle preconditions conjugate "
                 "gradients while the active set rests (the fastest). truncated newton multigrid: "
                 "without conjugate gradients. monotone multigrid: the method of Krause and Sander, "
                 "with obstacles on all levels. active set amg: primal-dual active set, each linear "
                 "problem by conjugate gradients with algebraic multigrid (a baseline). projected gauss "
                 "seidel: sweeps alone, for tiny problems. multigrid and multigrid cg: V-cycles, alone or as "
                 "preconditioner of conjugate gradients, for bodies without contact and tied pairs.");
      std::string level_zero;
      for (const auto &[name, method] : level_zero_names())
        if (method == p.level_zero)
          level_zero = name;
      // Not a choice: a name of former versions has its own message.
      prm.declare_entry(
          "Level 0", level_zero, Patterns::Anything(),
          "Solver of the coarsest level. automatic: Cholesky while the level is small, else amg. cholesky: "
          "sparse factors. amg: algebraic multigrid (Trilinos ML with rigid motions) to three digits. "
          "algebraic shortened: a few steps of algebraic multigrid, each shortened as a whole to what the "
          "obstacles of the level admit. One of: automatic, cholesky, amg, algebraic shortened.");
      prm.add_action("Level 0", [&p](const std::string &value) { p.level_zero = level_zero_method(value); });
      prm.add_parameter("Level 0 steps", p.level_zero_steps, "Number of steps of algebraic shortened.",
                        Patterns::Integer(1, 10000));
    }



    void add_smoothing(ParameterHandler &prm, SmoothingParameters &p)
    {
      prm.add_parameter("Pre-smoothing steps", p.n_pre, "Gauss-Seidel sweeps before the coarse correction.",
                        Patterns::Integer(0, 10000));
      prm.add_parameter("Post-smoothing steps", p.n_post, "Gauss-Seidel sweeps after the coarse correction.",
                        Patterns::Integer(0, 10000));
      prm.add_parameter(
          "Interface sweeps", p.n_interface_sweeps,
          "Extra sweeps over the contact nodes of both sides and one layer of neighbours, on "
          "every level, after the pre- and before the post-smoothing; "
          "after a good start accelerated leaves them out on the finest level while the active set "
          "rests, until an iteration is slow (leaves more than a quarter of the correction, for V(3,3)).",
          Patterns::Integer(0, 10000));
    }
  } // namespace



  void SolverParameters::add_parameters(ParameterHandler &prm)
  {
    add_method(prm, *this);
    add_smoothing(prm, smoothing);
    prm.add_parameter("Tolerance", tolerance,
                      "Stop when the energy norm of the correction of an iteration is below this multiple "
                      "of the energy norm of the iterate (no unit).",
                      Patterns::Double(1e-15, 1.));
    prm.add_parameter(
        "Absolute tolerance", absolute_tolerance,
        "If positive, stop when the energy norm of the correction (square root of an energy) is "
        "below this value instead.",
        Patterns::Double(0.));
    prm.add_parameter("Maximal iterations", max_iterations,
                      "Applications of the V-cycle (of a symmetric sweep, for projected gauss seidel).",
                      Patterns::Integer(1, 1000000000));
    prm.add_parameter(
        "Safety net", safety_net,
        "Whether accelerated goes on otherwise where it stays slow: with active-set steps, by "
        "sparse factors where these are cheap, by V-cycles elsewhere, or with patches of nodes. "
        "A note says when.");
    prm.add_parameter("Check monotonicity", check_monotonicity,
                      "Measure after every step of the solver on the finest level whether the energy has "
                      "fallen and the iterate is admissible, and report it (costs a product with the matrix "
                      "each).");
  }



  double convergence_rate(const std::vector<double> &history)
  {
    if (history.size() < 2)
      return std::numeric_limits<double>::quiet_NaN();
    const std::size_t n         = std::min<std::size_t>(5, history.size() - 1);
    const double      reduction = history.back() / history[history.size() - 1 - n];
    return std::pow(reduction, 1. / static_cast<double>(n));
  }



  namespace
  {
    /// When corrections are rounding: they are below a multiple of the iterate, and so many iterations do not
    /// halve the smallest one, so many of them with a larger one than the one before. Rounding makes new
    /// smallest ones by chance. Slow methods do not halve it so fast either, but go down.
    struct RoundingRule
    {
      double      largest;
      std::size_t patience, rises;
      double      progress = .5;
    };

    /// The square root of what the energy can resolve, with room for the condition of the matrix. (A light
    /// shaft in a V-block: 28 iterations, 40 until there is no new smallest correction.)
    constexpr RoundingRule of_the_energy = {1e-9, 6, 2};

    /// Where a body has moved far beside its deformation on its way to contacts. That is no convergence. (The
    /// same shaft: 54 to 66 iterations before points of it are held, 66 to 230 without this.)
    constexpr RoundingRule of_far_motions = {1e-6, 30, 8};

    bool is_rounding(const RoundingRule &rule, const std::vector<double> &corrections, const double iterate)
    {
      if (corrections.size() <= rule.patience || corrections.back() > rule.largest * iterate)
        return false;
      const auto  latest = corrections.end() - static_cast<std::ptrdiff_t>(rule.patience);
      std::size_t rises  = 0;
      for (auto it = latest; it != corrections.end(); ++it)
        rises += *it > *(it - 1);
      return rises >= rule.rises && *std::min_element(latest, corrections.end()) >
                                        rule.progress * *std::min_element(corrections.begin(), latest);
    }
  } // namespace



  bool is_at_rounding(const std::vector<double> &corrections, const double iterate)
  {
    return is_rounding(of_the_energy, corrections, iterate);
  }



  ObstacleSolver::ObstacleSolver(MultigridHierarchy &hierarchy, const SolverParameters &parameters,
                                 const unsigned int level)
    : hierarchy(hierarchy)
    , parameters(parameters)
    , level(level)
  {
  }



  void ObstacleSolver::book_iteration(ConvergenceReport &report, const double correction,
                                      const double iterate, const Monitor &monitor) const
  {
    AssertThrow(std::isfinite(correction), ExcMessage("The iteration produced NaN."));
    ++report.iterations;
    report.history.push_back(correction);
    report.scale          = iterate;
    unsigned int n_active = std::accumulate(active().begin(), active().end(), 0u);
    n_active              = Utilities::MPI::sum(n_active, matrix().partition().communicator());
    report.active_nodes.push_back(n_active);

    const double bound =
        parameters.absolute_tolerance > 0. ? parameters.absolute_tolerance : parameters.tolerance * iterate;
    report.converged = correction <= bound;
    if (!report.converged && is_at_rounding(report.history, iterate))
      {
        report.converged = report.stagnated = true;
        std::ostringstream text;
        text << "stopped at rounding: the correction, " << correction / iterate
             << " of the iterate, does not become smaller any more";
        report.note = text.str();
      }
    if (monitor)
      monitor(report.iterations, iterate > 0. ? correction / iterate : 0., n_active);
  }



  namespace
  {
    /// When an iteration gets nowhere.
    struct PlateauRule
    {
      /// So many iterations without a smaller correction than any before: four times what bodies that only
      /// contact holds take altogether.
      std::size_t patience = 100;
    };

    bool is_on_plateau(const std::vector<double> &history, const double iterate)
    {
      const std::size_t n = PlateauRule().patience;
      return is_rounding(of_far_motions, history, iterate) ||
             (history.size() > n &&
              *std::min_element(history.end() - static_cast<long>(n), history.end()) >=
                  *std::min_element(history.begin(), history.end() - static_cast<long>(n)));
    }
  } // namespace



  bool ObstacleSolver::goes_on(const ConvergenceReport &report) const
  {
    return report.iterations < parameters.max_iterations && !report.converged &&
           !is_on_plateau(report.history, report.scale);
  }



  void ObstacleSolver::close(ConvergenceReport &report, const Vector &v, const ObstacleProblem &problem) const
  {
    Vector residual;
    residual.reinit(v);
    matrix().symmetric_residual(residual, v, problem.rhs);
    close(report, v, problem, residual);
  }



  void ObstacleSolver::close(ConvergenceReport &report, const Vector &v, const ObstacleProblem &problem,
                             const Vector &residual) const
  {
    report.energy = -.5 * (problem.rhs * v + residual * v);
    report.rate   = convergence_rate(report.history);
    if (!report.converged)
      report.note =
          "stopped after " + std::to_string(report.iterations) + " iterations without convergence" +
          (is_on_plateau(report.history, report.scale) ? ", the last of which brought nothing" : "");
  }



  std::unique_ptr<ObstacleSolver> make_solver(MultigridHierarchy     &hierarchy,
                                              const SolverParameters &parameters)
  {
    switch (parameters.method)
      {
        case SolverMethod::monotone_multigrid:
          return std::make_unique<MonotoneMultigrid>(hierarchy, parameters);
        case SolverMethod::active_set_amg:
          return std::make_unique<ActiveSetAmg>(hierarchy, parameters);
        case SolverMethod::projected_gauss_seidel:
          return std::make_unique<GaussSeidelIteration>(hierarchy, parameters);
        case SolverMethod::multigrid:
        case SolverMethod::multigrid_cg:
          return std::make_unique<LinearMultigrid>(hierarchy, parameters);
        default:
          return std::make_unique<TruncatedNewtonMultigrid>(hierarchy, parameters, hierarchy.n_levels() - 1);
      }
  }
} // namespace Signorini
