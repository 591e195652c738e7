// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/discretization/element.h>

#include <deal.II/base/mpi.h>

#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The cell of this rank whose reference coordinates of a point stick out least, by how much, and the
    /// displacement there.
    struct ProbedCell
    {
      double  outside = std::numeric_limits<double>::max();
      Vector3 displacement;
    };

    ProbedCell probe_cells(const Bodies &bodies, const Discretization &d, const Vector &displacement,
                           const Probe &probe)
    {
      ProbedCell best;
      for (const NodalSpace::Cell &cell : d.nodal().cells())
        if (cell.is_owned && bodies.body_of_material(cell.material) == probe.body)
          {
            const Element element(d.nodal(), cell);
            Point<3>      reference;
            if (probe.point.distance(element.corner(0)) > 2. * element.diameter() ||
                !element.invert_map(reference, probe.point) || element.outside(reference) >= best.outside)
              continue;
            best.outside      = element.outside(reference);
            best.displacement = Vector3();
            const auto values = element.shape_values(reference);
            for (unsigned int v = 0; v < cell.n_vertices; ++v)
              best.displacement +=
                  values[v] * nodal_value(displacement, d.partition().to_local(d.nodal().nodes(cell)[v]));
          }
      return best;
    }
  } // namespace



  std::vector<ProbeResult> evaluate_probes(const ContactModel &model, const Discretization &d,
                                           const ContactSolution &solution, const std::vector<Probe> &probes)
  {
    const MPI_Comm           comm = model.communicator();
    std::vector<ProbeResult> results;
    for (const Probe &probe : probes)
      {
        const std::string body    = model.bodies().body_name(probe.body);
        const ProbedCell  best    = probe_cells(model.bodies(), d, solution.displacement, probe);
        const auto        nearest = Utilities::MPI::min_max_avg(best.outside, comm);
        if (!(nearest.min < .05))
          throw InputError("Body " + body + "/Probes, \"" + probe.name +
                           "\": the point lies outside of the body.");
        const bool mine = Utilities::MPI::this_mpi_process(comm) == nearest.min_index;
        results.push_back(
            {body + ": " + probe.name, probe.point, sum(mine ? best.displacement : Vector3(), comm)});
      }
    return results;
  }
} // namespace Signorini
