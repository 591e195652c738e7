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
      /// tetrahedra, the nearer one is meant.
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



  double Shank::ramp_of(const double linear, const Vector3 &normal, const Vector3 &axis)
  {
    const double along = normal * axis;
    return (std::abs(along) < ShankRule().facing * normal.norm() ? linear > .5 : along > 0.) ? 1. : 0.;
  }



  Vector Shank::find_ramp() const
  {
    const NodalSpace    &space     = d.nodal();
    const NodePartition &partition = d.partition();
    const Vector3       &axis      = bolt().axis;
    // Of each node at first the sum of the normals of the shank times area, pointing outward; in `around`,
    // how many cells of the shank there are, and how many others.
    Vector ramp, around;
    partition.reinit(ramp);
    partition.reinit(around);
    double low = std::numeric_limits<double>::max(), high = -std::numeric_limits<double>::max();
    for (const NodalSpace::Cell &cell : space.cells())
      if (cell.is_owned)
        {
          const bool is_part = is_in(bolt(), space, cell);
          for (const NodeIndex node : space.nodes(cell))
            around.local_element(dim * partition.to_local(node) + (is_part ? 0 : 1)) += 1.;
          if (is_part)
            integrate(Element(space, cell), [&](const double weight, const auto &gradients, const auto &) {
              for (unsigned int v = 0; v < cell.n_vertices; ++v)
                for (unsigned int c = 0; c < dim; ++c)
                  ramp.local_element(dim * partition.to_local(space.nodes(cell)[v]) + c) +=
                      weight * gradients[v][c];
            });
          for (const NodeIndex node : space.nodes(cell))
            if (is_part)
              {
                low  = std::min(low, axis * Vector3(space.position(node)));
                high = std::max(high, axis * Vector3(space.position(node)));
              }
        }
    ramp.compress(VectorOperation::add);
    around.compress(VectorOperation::add);
    low  = Utilities::MPI::min(low, model.communicator());
    high = Utilities::MPI::max(high, model.communicator());
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      {
        const double linear  = (axis * Vector3(space.position(partition.to_global(i))) - low) / (high - low);
        const bool   is_part = around.local_element(dim * i) > 0.,
                   is_other  = around.local_element(dim * i + 1) > 0.;
        ramp.local_element(dim * i) =
            !is_other ? linear : ramp_of(linear, is_part ? nodal_value(ramp, i) : Vector3(), axis);
      }
    ramp.update_ghost_values();
    for (const NodeIndex node : space.owned())
      if (const auto *const parents = space.hanging_nodes().get_constraint_entries(node))
        {
          double mean = 0.;
          for (const auto &[parent, weight] : *parents)
            mean += weight * ramp.local_element(dim * partition.to_local(parent));
          ramp.local_element(dim * partition.to_local(node)) = mean;
        }
    ramp.update_ghost_values();
    return ramp;
  }
} // namespace Signorini
