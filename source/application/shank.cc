// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "shank.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/discretization/element.h>

#include <deal.II/base/mpi.h>

#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct ShankRule
    {
      /// Where other cells of the body lie behind those of a shank, the cosine between normal and axis from
      /// which on the normal tells which end that is. Elsewhere, beside the spikes that ends have among
      /// tetrahedra, it is the nearer one.
      double facing = .5;
    };

    /// Calls action(weight, gradients of the shape functions) at all points of the rule.
    template <typename Action>
    void integrate(const Element &element, const Action &action)
    {
      std::array<Vector3, CellShape::max_vertices> gradients;
      for (unsigned int q = 0; q < element.n_points(); ++q)
        if (element.shape_gradients(gradients, element.reference_point(q)))
          action(element.volume_element(q).first, gradients, element.reference_point(q));
    }
  } // namespace



  Shank::Shank(const ContactModel &model, const Discretization &d, const std::size_t bolt)
    : model(model)
    , d(d)
    , number(bolt)
  {
    const NodalSpace &space = d.nodal();
    const Vector      ramp  = find_ramp();
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      if (const NodalSpace::Cell &cell = space.cells()[c]; cell.is_owned && is_in(this->bolt(), space, cell))
        {
          Part part;
          part.cell = c;
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            part.ramp[v] = ramp.local_element(dim * d.partition().to_local(space.nodes(cell)[v]));
          parts.push_back(part);
          integrate(Element(space, cell), [&](const double weight, const auto &gradients, const auto &) {
            volume += weight;
            modulus += weight * model.bodies().material(cell.material).young;
            for (unsigned int v = 0; v < cell.n_vertices; ++v)
              section += weight * part.ramp[v] * (gradients[v] * this->bolt().axis);
          });
        }
    for (double *const total : {&volume, &section, &modulus})
      *total = Utilities::MPI::sum(*total, model.communicator());
    if (!(volume > 0.))
      throw InputError(this->bolt().where + ": there is no cell in the region.");
    AssertThrow(section > 0., ExcInternalError());
  }



  double Shank::force(const Vector &displacement) const
  {
    const NodalSpace &space = d.nodal();
    double            force = 0.;
    for (const Part &part : parts)
      {
        const NodalSpace::Cell                      &cell = space.cells()[part.cell];
        const Element                                element(space, cell);
        std::array<Vector3, CellShape::max_vertices> u;
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
          u[v] = nodal_value(displacement, d.partition().to_local(space.nodes(cell)[v]));
        const CellDisplacement here(element, model.bodies().material(cell.material), u,
                                    model.loads().eigenstrain(space, cell));
        integrate(element, [&](const double weight, const auto &gradients, const Point<3> &reference) {
          Vector3 slope;
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            slope += part.ramp[v] * gradients[v];
          force += weight * (slope * (here.stress(reference) * bolt().axis));
        });
      }
    return Utilities::MPI::sum(force, model.communicator());
  }



  // By owned node: what lies around it, and what tells the ends.
  struct Shank::Nodes
  {
    /// Of each node the sum of the normals of the shank times area, pointing outward (zero within); how many
    /// cells of the shank there are, and how many others.
    Vector normals, around;
    /// The extent along the axis.
    double low = std::numeric_limits<double>::max(), high = -std::numeric_limits<double>::max();

    Nodes(const Discretization &d, const Pretension &bolt)
    {
      const NodePartition &partition = d.partition();
      partition.reinit(normals);
      partition.reinit(around);
      for (const NodalSpace::Cell &cell : d.nodal().cells())
        if (cell.is_owned)
          add(cell, d, bolt);
      normals.compress(VectorOperation::add);
      around.compress(VectorOperation::add);
      low  = Utilities::MPI::min(low, partition.communicator());
      high = Utilities::MPI::max(high, partition.communicator());
    }

    void add(const NodalSpace::Cell &cell, const Discretization &d, const Pretension &bolt)
    {
      const bool                                   is_part = is_in(bolt, d.nodal(), cell);
      const auto                                   nodes   = d.nodal().nodes(cell);
      const Element                                element(d.nodal(), cell);
      std::array<Vector3, CellShape::max_vertices> area;
      if (is_part)
        integrate(element, [&](const double weight, const auto &gradients, const auto &) {
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            area[v] += weight * gradients[v];
        });
      for (unsigned int v = 0; v < cell.n_vertices; ++v)
        {
          const unsigned int i = d.partition().to_local(nodes[v]);
          around.local_element(dim * i + (is_part ? 0 : 1)) += 1.;
          for (unsigned int c = 0; c < dim; ++c)
            normals.local_element(dim * i + c) += area[v][c];
          if (is_part)
            {
              low  = std::min(low, bolt.axis * Vector3(element.corner(v)));
              high = std::max(high, bolt.axis * Vector3(element.corner(v)));
            }
        }
    }

    bool is_within(const unsigned int i) const
    {
      return !(around.local_element(dim * i + 1) > 0.);
    }

    /// Whether the shank ends at a node, and which end that is as far as the normal tells: 1, -1, or 0.
    int faces(const unsigned int i, const Vector3 &axis) const
    {
      if (is_within(i) || !(around.local_element(dim * i) > 0.))
        return 0;
      const Vector3 normal = nodal_value(normals, i);
      const double  along  = normal * axis;
      return std::abs(along) < ShankRule().facing * normal.norm() ? 0 : along > 0. ? 1 : -1;
    }
  };



  Vector Shank::find_ramp() const
  {
    const NodePartition &partition = d.partition();
    const Vector3       &axis      = bolt().axis;
    const Nodes          nodes(d, bolt());
    const auto           height = [&](const unsigned int i) {
      return (axis * Vector3(d.nodal().position(partition.to_global(i))) - nodes.low) /
             (nodes.high - nodes.low);
    };
    // Up to where the lower end comes, and down to where the upper one does.
    double ends[2] = {0., 1.};
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      if (const int end = nodes.faces(i, axis); end < 0)
        ends[0] = std::max(ends[0], height(i));
      else if (end > 0)
        ends[1] = std::min(ends[1], height(i));
    const double middle = .5 * (Utilities::MPI::max(ends[0], partition.communicator()) +
                                Utilities::MPI::min(ends[1], partition.communicator()));
    Vector       ramp;
    partition.reinit(ramp);
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      {
        const int end               = nodes.faces(i, axis);
        ramp.local_element(dim * i) = nodes.is_within(i) ? height(i)
                                      : end != 0         ? (end > 0 ? 1. : 0.)
                                                         : (height(i) > middle ? 1. : 0.);
      }
    d.transformation->interpolate_hanging_nodes(ramp);
    return ramp;
  }

} // namespace Signorini
