// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/contact_problem.h>
#include <signorini/discretization/element.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  void ContactProblem::describe()
  {
    setup_space();
    CycleResult cycle;
    setup_contact(cycle);
    Discretization &d = discretization;
    struct Extent
    {
      double   area = 0.;
      Point<3> low = Point<3>(1e300, 1e300, 1e300), high = Point<3>(-1e300, -1e300, -1e300);
    };
    std::map<types::boundary_id, Extent> extents;
    std::vector<std::size_t>             cells(bodies.n_bodies(), 0);
    for (const NodalSpace::Cell &cell : d.space->cells())
      if (cell.is_owned)
        ++cells[bodies.body_of_material(cell.material)];
    for (const NodalSpace::BoundaryFace &face : d.space->boundary_faces())
      if (const NodalSpace::Cell &cell = d.space->cells()[face.cell]; cell.is_owned)
        {
          const ElementFace shape(Element(*d.space, cell), face.face);
          Extent           &extent = extents[face.id];
          for (unsigned int v = 0; v < shape.n_corners(); ++v)
            for (unsigned int c = 0; c < dim; ++c)
              {
                const double x = d.space->position(d.space->nodes(cell)[shape.vertex(v)])[c];
                extent.low[c]  = std::min(extent.low[c], x);
                extent.high[c] = std::max(extent.high[c], x);
              }
          for (unsigned int q = 0; q < shape.n_points(); ++q)
            extent.area += shape.point(q).area.norm();
        }
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      {
        const std::size_t n_cells = Utilities::MPI::sum(cells[b], comm);
        out << "body " << bodies.body_name(b) << ": " << n_cells
            << " cells, E = " << parameters.bodies[b].young << ", nu = " << parameters.bodies[b].poisson
            << std::endl;
        for (unsigned int i = 0; i < bodies.boundary_names(b).size(); ++i)
          {
            const Extent e    = extents[bodies.boundary_id(b, i)];
            const double area = Utilities::MPI::sum(e.area, comm);
            Point<3>     low, high;
            for (unsigned int c = 0; c < dim; ++c)
              {
                low[c]  = Utilities::MPI::min(e.low[c], comm);
                high[c] = Utilities::MPI::max(e.high[c], comm);
              }
            out << "  boundary " << bodies.boundary_names(b)[i] << ": area " << area << ", box (" << low
                << ") to (" << high << ")" << std::endl;
          }
      }
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const PairCoupling &coupling = d.couplings[p];
        std::vector<double> gaps;
        for (std::size_t row = 0; row < coupling.gaps.size(); ++row)
          gaps.push_back(coupling.mean_gap(row, coupling.gaps[row]));
        out << "pair " << d.pairs[p].name << ": nonmortar " << d.pairs[p].nonmortar_name << ", mortar "
            << d.pairs[p].mortar_name << ", " << gaps.size() << " contact nodes, gap "
            << *std::min_element(gaps.begin(), gaps.end()) << " to "
            << *std::max_element(gaps.begin(), gaps.end()) << ", coverage "
            << d.couplings[p].covered_area / d.couplings[p].area << std::endl;
      }
  }
} // namespace Signorini
