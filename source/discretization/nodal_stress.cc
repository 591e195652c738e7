// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/element.h>
#include <signorini/discretization/nodal_stress.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    StressComponents components(const Block &sigma)
    {
      return {{sigma[0][0], sigma[1][1], sigma[2][2], sigma[0][1], sigma[1][2], sigma[2][0]}};
    }

    /// sigma : C^-1 : sigma.
    double energy_density(const StressComponents &s, const Material &material)
    {
      const double trace = s[0] + s[1] + s[2];
      const double squares =
          s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2. * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
      return ((1. + material.poisson) * squares - material.poisson * trace * trace) / material.young;
    }

    /// The stress in one cell at the points of its quadrature.
    struct StressAtPoints
    {
      StressAtPoints(const StressedBodies &s, const NodalSpace::Cell &cell)
        : element(s.space, cell)
      {
        const auto                                   nodes = s.space.nodes(cell);
        std::array<Vector3, CellShape::max_vertices> u;
        for (unsigned int v = 0; v < nodes.size(); ++v)
          {
            for (unsigned int c = 0; c < dim; ++c)
              u[v][c] = s.displacement[dim * s.space.relevant().index_within_set(nodes[v]) + c];
            largest_displacement = std::max(largest_displacement, u[v].norm());
          }
        const CellDisplacement displacement(element, s.bodies.material(cell.material), u,
                                            s.loads.eigenstrain(s.space, cell));
        for (unsigned int q = 0; q < element.n_points(); ++q)
          {
            const auto [sigma, weight] = displacement.stress_at_point(q);
            at_points[q]               = components(sigma);
            weights[q]                 = weight;
            volume += weight;
          }
      }

      /// At the vertices: the trilinear function through the values at Gauss points, or their mean.
      std::array<StressComponents, CellShape::max_vertices> at_vertices() const
      {
        auto result = at_points;
        if (element.n_vertices() == CellShape::tetrahedron)
          {
            for (unsigned int c = 0; c < 6; ++c)
              {
                double mean = 0.;
                for (unsigned int q = 0; q < element.n_points(); ++q)
                  mean += at_points[q][c] / element.n_points();
                for (unsigned int v = 0; v < element.n_vertices(); ++v)
                  result[v][c] = mean;
              }
            return result;
          }
        // One direction after the other; vertices and Gauss points have the same order.
        const double near = .5 * (1. + std::sqrt(3.)), far = 1. - near;
        for (const unsigned int step : {1, 2, 4})
          for (unsigned int v = 0; v < CellShape::hexahedron; ++v)
            if ((v & step) == 0)
              for (unsigned int c = 0; c < 6; ++c)
                {
                  const double low = result[v][c], high = result[v + step][c];
                  result[v][c]        = near * low + far * high;
                  result[v + step][c] = near * high + far * low;
                }
        return result;
      }

      const Element                                         element;
      std::array<StressComponents, CellShape::max_vertices> at_points = {};
      /// Of the quadrature (volumes).
      std::array<double, CellShape::max_vertices> weights = {};
      double                                      volume = 0., largest_displacement = 0.;
    };

    /// Groups of materials, by their ids: the stress of those of a group does not jump, or their cells have
    /// no node in common.
    std::vector<unsigned int> groups_of_materials(const Bodies &bodies, const Loads &loads)
    {
      std::vector<unsigned int> groups;
      for (types::material_id id = 0; id < bodies.n_materials(); ++id)
        {
          const Material &mine  = bodies.material(id);
          unsigned int    group = 0;
          for (types::material_id other = 0; other < id; ++other)
            if (const Material &m = bodies.material(other); m.body == mine.body && m.part == mine.part)
              {
                if (m.young == mine.young && m.poisson == mine.poisson && !loads.has_eigenstrains())
                  {
                    group = groups[other];
                    break;
                  }
                group = std::max(group, groups[other] + 1);
              }
          groups.push_back(group);
        }
      return groups;
    }

    template <typename Action>
    void for_owned_cells(const NodalSpace &space, const Action &action)
    {
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned)
          action(cell);
    }

    /// From which part of E times displacement by width of a cell on stresses are more than rounding.
    struct StressRoundingRule
    {
      /// Pure number: far above what a body leaves that is moved as a whole or grows with heat (1e-17 to
      /// 1e-12), far below what a bar leaves that is a thousand times as long as thick (1e-6).
      double strain = 1e-9;
    };

    /// Adds the squares of a cell.
    /// @param recovered the stress at its nodes
    void add_squares(StressError &squares, const StressAtPoints &stress,
                     const std::array<StressComponents, CellShape::max_vertices> &recovered,
                     const Material                                              &material)
    {
      for (unsigned int q = 0; q < stress.element.n_points(); ++q)
        {
          const Element::Shape   shape      = stress.element.shape_at_point(q);
          const StressComponents here       = stress.at_points[q];
          StressComponents       difference = here;
          for (unsigned int v = 0; v < stress.element.n_vertices(); ++v)
            for (unsigned int c = 0; c < 6; ++c)
              difference[c] -= shape[v] * recovered[v][c];
          squares.error += stress.weights[q] * energy_density(difference, material);
          squares.norm += stress.weights[q] * energy_density(here, material);
        }
      const double strain =
          StressRoundingRule().strain * stress.largest_displacement / std::cbrt(stress.volume);
      squares.rounding += stress.volume * material.young * strain * strain;
    }
  } // namespace



  double von_mises(const StressComponents &s)
  {
    return std::sqrt(
        .5 * ((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) + (s[2] - s[0]) * (s[2] - s[0])) +
        3. * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
  }



  NodalStress::NodalStress(const StressedBodies &stressed)
    : NodalStress(
          stressed, [](const NodalSpace::Cell &) { return true; },
          std::make_shared<const ShearFreePlanes>(stressed.space, stressed.loads, stressed.fixed))
  {
  }



  NodalStress::NodalStress(const StressedBodies                                &stressed,
                           const std::function<bool(const NodalSpace::Cell &)> &belongs,
                           std::shared_ptr<const ShearFreePlanes>               planes)
    : stressed(stressed)
    , planes(std::move(planes))
    , partition(stressed.space.owned(), stressed.space.relevant(), stressed.space.communicator())
  {
    for (Vector *v : {&normal, &shear, &weight})
      partition.reinit(*v);
    for_owned_cells(stressed.space, [&](const NodalSpace::Cell &cell) {
      if (!belongs(cell))
        return;
      const StressAtPoints stress(stressed, cell);
      const auto           at_vertices = stress.at_vertices();
      const auto           nodes       = stressed.space.nodes(cell);
      for (unsigned int v = 0; v < nodes.size(); ++v)
        {
          const unsigned int i = partition.to_local(nodes[v]);
          for (unsigned int c = 0; c < 3; ++c)
            {
              normal.local_element(3 * i + c) += stress.volume * at_vertices[v][c];
              shear.local_element(3 * i + c) += stress.volume * at_vertices[v][3 + c];
            }
          weight.local_element(3 * i) += stress.volume;
        }
    });
    for (Vector *v : {&normal, &shear, &weight})
      {
        v->compress(VectorOperation::add);
        v->update_ghost_values();
      }
  }



  StressComponents NodalStress::at(const NodeIndex node) const
  {
    const unsigned int i = partition.to_local(node);
    const double       w = weight.local_element(3 * i);
    Block              sigma;
    for (unsigned int c = 0; c < 3 && w > 0.; ++c)
      {
        const unsigned int next = (c + 1) % 3;
        sigma[c][c]             = normal.local_element(3 * i + c) / w;
        sigma[c][next] = sigma[next][c] = shear.local_element(3 * i + c) / w;
      }
    return components(planes->without_shear(node, sigma));
  }



  std::vector<StressComponents> NodalStress::values() const
  {
    std::vector<StressComponents> result;
    result.reserve(stressed.space.relevant().n_elements());
    for (const NodeIndex node : stressed.space.relevant())
      result.push_back(at(node));
    return result;
  }



  void NodalStress::add_squares_of(const NodalSpace::Cell &cell, std::vector<StressError> &squares) const
  {
    std::array<StressComponents, CellShape::max_vertices> recovered;
    const auto                                            nodes = stressed.space.nodes(cell);
    for (unsigned int v = 0; v < nodes.size(); ++v)
      recovered[v] = at(nodes[v]);
    const Material &material = stressed.bodies.material(cell.material);
    add_squares(squares[material.body], StressAtPoints(stressed, cell), recovered, material);
  }



  std::vector<StressError> NodalStress::errors() const
  {
    const std::vector<unsigned int> groups   = groups_of_materials(stressed.bodies, stressed.loads);
    const unsigned int              n_groups = *std::max_element(groups.begin(), groups.end()) + 1;
    std::vector<StressError>        squares(stressed.bodies.n_bodies());
    for (unsigned int g = 0; g < n_groups; ++g)
      {
        const auto belongs = [&](const NodalSpace::Cell &cell) { return groups[cell.material] == g; };
        std::optional<NodalStress> of_group;
        if (n_groups > 1)
          of_group.emplace(NodalStress(stressed, belongs, planes));
        const NodalStress &nodal = of_group ? *of_group : *this;
        for_owned_cells(stressed.space, [&](const NodalSpace::Cell &cell) {
          if (belongs(cell))
            nodal.add_squares_of(cell, squares);
        });
      }
    std::vector<double> sums;
    for (const StressError &e : squares)
      sums.insert(sums.end(), {e.error, e.norm, e.rounding});
    Utilities::MPI::sum(sums, stressed.space.communicator(), sums);
    for (std::size_t b = 0; b < squares.size(); ++b)
      squares[b] = {std::sqrt(sums[3 * b]), std::sqrt(sums[3 * b + 1]), std::sqrt(sums[3 * b + 2])};
    // What the solver leaves in bodies that nothing loads.
    constexpr double left = 1e-10;
    StressError      all;
    for (const StressError &e : squares)
      all.add(e);
    for (StressError &e : squares)
      e.rounding = std::max(e.rounding, left * all.norm);
    return squares;
  }
} // namespace Signorini
