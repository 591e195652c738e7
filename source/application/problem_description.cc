// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/problem_description.h>
#include <signorini/discretization/element.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Of a boundary, as far as this rank has it.
    struct Extent
    {
      double   area = 0.;
      Point<3> low = Point<3>(1e300, 1e300, 1e300), high = Point<3>(-1e300, -1e300, -1e300);

      /// Over all ranks.
      void gather(const MPI_Comm comm)
      {
        area = Utilities::MPI::sum(area, comm);
        for (unsigned int c = 0; c < dim; ++c)
          {
            low[c]  = Utilities::MPI::min(low[c], comm);
            high[c] = Utilities::MPI::max(high[c], comm);
          }
      }
    };

    std::map<types::boundary_id, Extent> measure_boundaries(const NodalSpace &space)
    {
      std::map<types::boundary_id, Extent> extents;
      for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
        if (const NodalSpace::Cell &cell = space.cells()[face.cell]; cell.is_owned)
          {
            const ElementFace shape(Element(space, cell), face.face);
            Extent           &extent = extents[face.id];
            for (unsigned int v = 0; v < shape.n_corners(); ++v)
              for (unsigned int c = 0; c < dim; ++c)
                {
                  const double x = space.position(space.nodes(cell)[shape.vertex(v)])[c];
                  extent.low[c]  = std::min(extent.low[c], x);
                  extent.high[c] = std::max(extent.high[c], x);
                }
            for (unsigned int q = 0; q < shape.n_points(); ++q)
              extent.area += shape.point(q).area.norm();
          }
      return extents;
    }

    void describe_pair(std::ostream &out, const ContactPair &pair, const PairCoupling &coupling)
    {
      std::vector<double> gaps;
      for (std::size_t row = 0; row < coupling.gaps.size(); ++row)
        gaps.push_back(coupling.mean_gap(row, coupling.gaps[row]));
      out << "pair " << pair.name << ": nonmortar " << pair.nonmortar.name << ", mortar " << pair.mortar.name
          << ", " << gaps.size() << " contact nodes, gap " << *std::min_element(gaps.begin(), gaps.end())
          << " to " << *std::max_element(gaps.begin(), gaps.end()) << ", coverage "
          << coupling.covered_area / coupling.area << std::endl;
    }
  } // namespace



  void describe(std::ostream &out, const ContactModel &model, const Discretization &d)
  {
    const MPI_Comm           comm    = model.communicator();
    const Bodies            &bodies  = model.bodies();
    auto                     extents = measure_boundaries(d.nodal());
    std::vector<std::size_t> cells(bodies.n_bodies(), 0);
    for (const NodalSpace::Cell &cell : d.nodal().cells())
      if (cell.is_owned)
        ++cells[bodies.body_of_material(cell.material)];
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      {
        const IsotropicMaterial &material = bodies.material_of_body(b);
        out << "body " << bodies.body_name(b) << ": " << Utilities::MPI::sum(cells[b], comm)
            << " cells, E = " << material.young << ", nu = " << material.poisson << std::endl;
        for (unsigned int i = 0; i < bodies.boundary_names(b).size(); ++i)
          {
            Extent &extent = extents[bodies.boundary_id(b, i)];
            extent.gather(comm);
            out << "  boundary " << bodies.boundary_names(b)[i] << ": area " << extent.area << ", box ("
                << extent.low << ") to (" << extent.high << ")" << std::endl;
          }
      }
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      describe_pair(out, d.pairs[p], d.couplings[p]);
  }
} // namespace Signorini
