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
    /// How far reference coordinates of a point may stick out of its cell.
    struct ProbeRule
    {
      /// On the mesh of the solution; on the first mesh, which may lie inside of a curved boundary.
      double solved = .05, first = 1.;
    };

    /// The cell of this rank whose reference coordinates of a point stick out least, by how much, and these.
    struct ProbedCell
    {
      double                  outside = std::numeric_limits<double>::max();
      const NodalSpace::Cell *cell    = nullptr;
      Point<3>                reference;
    };

    ProbedCell find_cell(const Bodies &bodies, const NodalSpace &space, const Probe &probe)
    {
      ProbedCell best;
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned && bodies.body_of_material(cell.material) == probe.body)
          {
            const Element element(space, cell);
            Point<3>      reference;
            if (probe.point.distance(element.corner(0)) <= 2. * element.diameter() &&
                element.invert_map(reference, probe.point) && element.outside(reference) < best.outside)
              best = {element.outside(reference), &cell, reference};
          }
      return best;
    }

    Vector3 displacement_in(const ProbedCell &place, const Discretization &d, const Vector &displacement)
    {
      const auto values = Element(d.nodal(), *place.cell).shape_values(place.reference);
      Vector3    result;
      for (unsigned int v = 0; v < place.cell->n_vertices; ++v)
        result +=
            values[v] * nodal_value(displacement, d.partition().to_local(d.nodal().nodes(*place.cell)[v]));
      return result;
    }

    /// Collective. The rank that has the best cell.
    unsigned int refuse_outside(const ContactModel &model, const Probe &probe, const double outside,
                                const double bound)
    {
      const auto nearest = Utilities::MPI::min_max_avg(outside, model.communicator());
      if (!(nearest.min < bound))
        throw InputError("Body " + model.bodies().body_name(probe.body) + "/Probes, \"" + probe.name +
                         "\": the point lies outside of the body.");
      return nearest.min_index;
    }
  } // namespace



  void check_probes(const ContactModel &model, const NodalSpace &space, const std::vector<Probe> &probes)
  {
    for (const Probe &probe : probes)
      refuse_outside(model, probe, find_cell(model.bodies(), space, probe).outside, ProbeRule().first);
  }



  std::vector<ProbeResult> evaluate_probes(const ContactModel &model, const Discretization &d,
                                           const ContactSolution &solution, const std::vector<Probe> &probes)
  {
    const MPI_Comm           comm = model.communicator();
    std::vector<ProbeResult> results;
    for (const Probe &probe : probes)
      {
        const ProbedCell place = find_cell(model.bodies(), d.nodal(), probe);
        const bool       mine  = Utilities::MPI::this_mpi_process(comm) ==
                          refuse_outside(model, probe, place.outside, ProbeRule().solved);
        results.push_back({model.bodies().body_name(probe.body) + ": " + probe.name, probe.point,
                           sum(mine ? displacement_in(place, d, solution.displacement) : Vector3(), comm)});
      }
    return results;
  }
} // namespace Signorini
