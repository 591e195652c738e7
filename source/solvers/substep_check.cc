// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/substep_check.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  void SubstepCheck::operator()(const Vector &v, const Vector &z)
  {
    if (!is_wanted)
      return;
    Vector now = v;
    now.zero_out_ghost_values();
    now += z;
    (*this)(now);
  }



  void SubstepCheck::operator()(const Vector &v)
  {
    if (!is_wanted)
      return;
    Vector product;
    product.reinit(v);
    matrix.vmult(product, v);
    const double square = product * v, now = .5 * square - problem.rhs * v;
    double       violation = 0., largest = 0.;
    for (std::size_t p = 0; p < problem.half_spaces.size(); ++p)
      {
        double size = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          size += Utilities::fixed_power<2>(v.local_element(dim * problem.half_spaces.nodes[p] + c));
        violation =
            std::max(violation, problem.half_spaces.normal_part(p, v) - problem.half_spaces.bounds[p]);
        largest = std::max(largest, std::sqrt(size));
      }
    const MPI_Comm comm = matrix.partition().communicator();
    violation           = Utilities::MPI::max(violation, comm);
    largest             = Utilities::MPI::max(largest, comm);
    if (largest > 0.)
      report.largest_violation = std::max(report.largest_violation, violation / largest);
    if (std::isfinite(energy) && square > 0.)
      report.largest_energy_rise = std::max(report.largest_energy_rise, (now - energy) / square);
    ++report.checked_substeps;
    energy = now;
  }
} // namespace Signorini
