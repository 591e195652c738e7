// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/truncated_newton_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  void SolverParameters::add_parameters(ParameterHandler &prm)
  {
    prm.declare_entry("Acceleration", "conjugate gradients", Patterns::Selection("none|conjugate gradients"),
                      "Whether the V-cycle preconditions a conjugate gradient method while the active set "
                      "rests, in the contact solve and in the linear comparison alike.");
    prm.add_action("Acceleration", [this](const std::string &value) {
      acceleration = value == "none" ? Acceleration::none : Acceleration::conjugate_gradients;
    });
    prm.add_parameter("Pre-smoothing steps", smoothing.n_pre,
                      "Gauss-Seidel sweeps before the coarse correction.");
    prm.add_parameter("Post-smoothing steps", smoothing.n_post,
                      "Gauss-Seidel sweeps after the coarse correction.");
    prm.add_parameter("Interface sweeps", smoothing.n_interface_sweeps,
                      "Extra sweeps over the contact nodes of both sides and one layer of neighbours, on "
                      "every level, after the pre- and before the post-smoothing.");
    prm.add_parameter("Tolerance", tolerance,
                      "Stop when the energy norm of the correction of an iteration is below this multiple "
                      "of the energy norm of the iterate (no unit).",
                      Patterns::Double(1e-15, 1.));
    prm.add_parameter("Maximal iterations", max_iterations, "Applications of the V-cycle.",
                      Patterns::Integer(1));
  }



  double convergence_rate(const std::vector<double> &history)
  {
    if (history.size() < 2)
      return std::numeric_limits<double>::quiet_NaN();
    const std::size_t n         = std::min<std::size_t>(5, history.size() - 1);
    const double      reduction = history.back() / history[history.size() - 1 - n];
    return std::pow(reduction, 1. / static_cast<double>(n));
  }



  TruncatedNewtonMultigrid::TruncatedNewtonMultigrid(MultigridHierarchy     &hierarchy,
                                                     const SolverParameters &parameters)
    : hierarchy(hierarchy)
    , parameters(parameters)
    , cycle(hierarchy, parameters.smoothing, hierarchy.n_levels() - 2)
  {
  }



  void TruncatedNewtonMultigrid::smooth(Vector &v, const Vector &rhs,
                                        const ProjectedGaussSeidel::Direction direction)
  {
    ProjectedGaussSeidel &smoother = *hierarchy.finest().smoother;
    const bool            is_pre   = direction == ProjectedGaussSeidel::forward;
    if (!is_pre)
      for (unsigned int i = 0; i < parameters.smoothing.n_interface_sweeps; ++i)
        smoother.interface_sweep(v, rhs, direction);
    for (unsigned int i = 0; i < (is_pre ? parameters.smoothing.n_pre : parameters.smoothing.n_post); ++i)
      smoother.sweep(v, rhs, direction);
    if (is_pre)
      for (unsigned int i = 0; i < parameters.smoothing.n_interface_sweeps; ++i)
        smoother.interface_sweep(v, rhs, direction);
  }



  bool TruncatedNewtonMultigrid::all_ranks(const bool condition) const
  {
    return Utilities::MPI::min(static_cast<int>(condition),
                               hierarchy.finest().matrix.partition().communicator()) != 0;
  }



  double TruncatedNewtonMultigrid::admissible_step(const Vector &v, const Vector &c,
                                                   const HalfSpaces                       &half_spaces,
                                                   const std::vector<unsigned char> *const ignored) const
  {
    double step = std::numeric_limits<double>::max();
    for (std::size_t p = 0; p < half_spaces.size(); ++p)
      {
        if (ignored != nullptr && (*ignored)[p])
          continue;
        double motion = 0., room = half_spaces.bounds[p];
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = dim * half_spaces.nodes[p] + d;
            motion += half_spaces.normals[p][d] * c.local_element(i);
            room -= half_spaces.normals[p][d] * v.local_element(i);
          }
        if (motion > 0.)
          step = std::min(step, std::max(room, 0.) / motion);
      }
    return Utilities::MPI::min(step, hierarchy.finest().matrix.partition().communicator());
  }



  double TruncatedNewtonMultigrid::correct(Vector &v, const ObstacleProblem &problem, const bool search)
  {
    const NodeBlockMatrix &matrix   = hierarchy.finest().matrix;
    ProjectedGaussSeidel  &smoother = *hierarchy.finest().smoother;
    MultigridLevel        &coarse   = hierarchy.level(hierarchy.n_levels() - 2);
    if (hierarchy.truncate(problem.half_spaces, smoother.active()))
      ++n_updates;

    Vector residual, coarse_defect, coarse_correction, c, product;
    residual.reinit(v);
    matrix.vmult(residual, v);
    residual.sadd(-1., 1., problem.rhs);
    const double square = v * problem.rhs - v * residual;

    coarse.matrix.partition().reinit(coarse_defect);
    coarse.matrix.partition().reinit(coarse_correction);
    coarse.to_finer.restrict_and_add(coarse_defect, residual);
    for (unsigned int i = 0; i < coarse.matrix.n_rows(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (coarse.fixed[i] & (1u << d))
          coarse_defect.local_element(dim * i + d) = 0.;
    cycle.apply(coarse_correction, coarse_defect);

    c.reinit(v);
    coarse.to_finer.prolongate(c, coarse_correction);
    smoother.project_correction(c, v);
    v.zero_out_ghost_values();
    if (!search)
      {
        v.add(1., c);
        return square;
      }
    // The slope must not see the contact forces: they are larger than the residual by orders of magnitude.
    smoother.restrict_to_tangents(residual);
    product.reinit(v);
    matrix.vmult(product, c);
    const double slope = residual * c, curvature = product * c;
    if (curvature > 0. && slope > 0.)
      {
        const double step =
            std::min(slope / curvature, std::max(1., admissible_step(v, c, problem.half_spaces)));
        v.add(step, c);
      }
    return square;
  }



  bool TruncatedNewtonMultigrid::accelerate(const Vector &start, const Vector &residual, Vector &z,
                                            Vector &az, const HalfSpaces &half_spaces)
  {
    const ProjectedGaussSeidel &smoother = *hierarchy.finest().smoother;
    if (has_direction)
      {
        const double beta = -(z * direction_product) / (direction * direction_product);
        z.add(beta, direction);
        az.add(beta, direction_product);
      }
    const double curvature = z * az;
    const double slope     = residual * z - smoother.normal_product(residual, z);
    const double step      = curvature > 0. ? slope / curvature : 0.;
    if (!(step > 0.) || step > admissible_step(start, z, half_spaces, &smoother.active()))
      return false;
    direction         = z;
    direction_product = az;
    has_direction     = true;
    z *= step;
    az *= step;
    return true;
  }



  ConvergenceReport TruncatedNewtonMultigrid::solve(Vector &v, const ObstacleProblem &problem,
                                                    const Monitor &monitor)
  {
    const NodeBlockMatrix &matrix   = hierarchy.finest().matrix;
    const MPI_Comm         comm     = matrix.partition().communicator();
    ProjectedGaussSeidel  &smoother = *hierarchy.finest().smoother;
    smoother.set_half_spaces(problem.half_spaces);
    smoother.project(v);
    n_updates     = 0;
    has_direction = false;

    ConvergenceReport report;
    Vector            start, residual, correction, product;
    for (Vector *vector : {&start, &residual, &correction, &product})
      vector->reinit(v);
    matrix.vmult(residual, v);
    residual.sadd(-1., 1., problem.rhs);
    bool rests = false;
    while (report.iterations < parameters.max_iterations && !report.converged)
      {
        const std::vector<unsigned char> active = smoother.active();
        start.copy_locally_owned_data_from(v);
        smooth(v, problem.rhs, ProjectedGaussSeidel::forward);
        bool         keeps_active = smoother.active() == active;
        const double square       = correct(v, problem, !rests);
        smooth(v, problem.rhs, ProjectedGaussSeidel::backward);
        keeps_active = all_ranks(keeps_active && smoother.active() == active);

        correction.copy_locally_owned_data_from(v);
        correction -= start;
        matrix.vmult(product, correction);
        const double plain_norm = std::sqrt(std::max(0., correction * product));
        rests = keeps_active && parameters.acceleration == Acceleration::conjugate_gradients;
        if (rests && accelerate(start, residual, correction, product, problem.half_spaces))
          {
            v.copy_locally_owned_data_from(start);
            v += correction;
            report.history.push_back(std::sqrt(std::max(0., correction * product)));
          }
        else
          {
            if (rests)
              {
                // accelerate() has changed the correction.
                correction.copy_locally_owned_data_from(v);
                correction -= start;
                matrix.vmult(product, correction);
              }
            rests = has_direction = false;
            report.history.push_back(plain_norm);
          }
        residual -= product;
        report.scale = std::sqrt(std::max(0., square));
        ++report.iterations;
        unsigned int n_active = std::accumulate(smoother.active().begin(), smoother.active().end(), 0u);
        n_active              = Utilities::MPI::sum(n_active, comm);
        report.active_nodes.push_back(n_active);
        report.converged = report.history.back() <= parameters.tolerance * report.scale;
        if (monitor)
          monitor(report.iterations, report.scale > 0. ? report.history.back() / report.scale : 0., n_active);
        AssertThrow(std::isfinite(report.history.back()), ExcMessage("The iteration produced NaN."));
      }
    matrix.vmult(product, v);
    report.energy            = .5 * (product * v) - problem.rhs * v;
    report.rate              = convergence_rate(report.history);
    report.hierarchy_updates = n_updates;
    if (!report.converged)
      report.note = "stopped after " + std::to_string(report.iterations) + " iterations without convergence";
    return report;
  }
} // namespace Signorini
