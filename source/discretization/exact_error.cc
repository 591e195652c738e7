// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/element.h>
#include <signorini/discretization/exact_error.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    Block gradient_of(const VectorField &exact, const Point<3> &p, const double step)
    {
      Block gradient;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Vector3 h;
          h[d]                = step;
          const Vector3 slope = (exact(p + h) - exact(p - h)) / (2. * step);
          for (unsigned int c = 0; c < dim; ++c)
            gradient[c][d] = slope[c];
        }
      return gradient;
    }

    double energy_density(const Block &gradient, const Material &material)
    {
      return scalar_product(stress(gradient, material), gradient);
    }
  } // namespace



  ExactError compute_exact_error(const Bodies &bodies, const Loads &loads, const NodalSpace &space,
                                 const NodePartition &partition, const Vector &displacement,
                                 const KnownDisplacement &known_displacement)
  {
    const VectorField    &exact = known_displacement.displacement;
    std::array<double, 4> sums  = {{0., 0., 0., 0.}};
    for (const NodalSpace::Cell &cell : space.cells())
      if (cell.is_owned && bodies.body_of_material(cell.material) == known_displacement.body)
        {
          const Element                                element(space, cell);
          const auto                                   nodes    = space.nodes(cell);
          const Material                              &material = bodies.material(cell.material);
          std::array<Vector3, CellShape::max_vertices> u;
          for (unsigned int v = 0; v < nodes.size(); ++v)
            for (unsigned int c = 0; c < dim; ++c)
              u[v][c] = displacement.local_element(dim * partition.to_local(nodes[v]) + c);
          const CellDisplacement discrete(element, material, u, loads.eigenstrain(space, cell));
          for (unsigned int q = 0; q < element.n_points(); ++q)
            {
              const auto [weight, point] = element.volume_element(q);
              const auto    shape        = element.shape_at_point(q);
              const Vector3 known        = exact(point);
              const Block   known_gradient =
                  gradient_of(exact, point, 1e-3 * element.diameter()) - discrete.eigenstrain.value(shape);
              Vector3     error    = known;
              const Block gradient = known_gradient - discrete.elastic_gradient(element.reference_point(q));
              for (unsigned int v = 0; v < nodes.size(); ++v)
                error -= shape[v] * u[v];
              sums[0] += weight * error.norm_square();
              sums[1] += weight * known.norm_square();
              sums[2] += weight * energy_density(gradient, material);
              sums[3] += weight * energy_density(known_gradient, material);
            }
        }
    for (double &s : sums)
      s = std::sqrt(std::max(0., Utilities::MPI::sum(s, space.communicator())));
    return {sums[0], sums[1], sums[2], sums[3]};
  }
} // namespace Signorini
