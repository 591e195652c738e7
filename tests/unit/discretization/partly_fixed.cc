// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// T at nodes with prescribed components and oblique normals (doc/algorithm.md, (23) to (27)).

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/discretization/basis_transformation.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;
namespace Utilities = dealii::Utilities;

namespace
{
  BodyParameters block()
  {
    BodyParameters p;
    p.name         = "body";
    p.mesh         = "block";
    p.upper_corner = Point<3>(1, 2, 3);
    p.divisions    = {2, 3, 4};
    p.young        = 7.;
    p.poisson      = .3;
    return p;
  }

  /// All conforming nodes with a given z, with their positions, the same on all ranks in the same order.
  std::vector<std::pair<NodeIndex, Point<3>>> nodes_at(const NodalSpace &space, const double z)
  {
    std::vector<std::array<double, 4>> mine;
    for (const NodeIndex node : space.owned())
      if (const Point<3> x = space.position(node);
          std::abs(x[2] - z) < 1e-12 && !space.hanging_nodes().is_constrained(node))
        mine.push_back({{x[0], x[1], x[2], static_cast<double>(node)}});
    std::vector<std::array<double, 4>> all;
    for (const auto &list : gather_values(mine, MPI_COMM_WORLD))
      all.insert(all.end(), list.begin(), list.end());
    std::sort(all.begin(), all.end());
    std::vector<std::pair<NodeIndex, Point<3>>> result;
    for (const auto &entry : all)
      result.emplace_back(static_cast<NodeIndex>(entry[3]), Point<3>(entry[0], entry[1], entry[2]));
    return result;
  }

  double value(const Point<3> &x, const unsigned int c)
  {
    return std::sin(7. * x[0] + 5. * x[1] + 3. * x[2] + 2. * c);
  }

  const Vector3 normal = Vector3(Point<3>(.5, -.6, .7)) / Point<3>(.5, -.6, .7).norm();
} // namespace

// The top of a block follows its bottom, as if it were in contact with it, with prescribed values and hanging
// nodes on both; with a chain it follows nodes in the middle as well, which follow the bottom.
class PartlyFixed : public testing::TestWithParam<bool>
{
};

TEST_P(PartlyFixed, TransformedProblemIsTheSameProblem)
{
  Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {block()}, "."));
  for (const auto &cell : bodies.triangulation().active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] + cell->center()[1] < .9)
      cell->set_refine_flag();
  bodies.triangulation().execute_coarsening_and_refinement();
  const NodalSpace    space(MPI_COMM_WORLD, bodies.mesh());
  const NodePartition partition(space.owned(), space.relevant(), MPI_COMM_WORLD);
  Loads               loads;
  LoadParameters      parameters;
  parameters.dirichlet = "left: (0.1*y - 0.2*z, *, *); right: (*, 0.3 + 0.1*z, 0.2*y)";
  parameters.tractions = "front: (1, 2, 3)";
  loads.add(bodies, 0, parameters.definition(""));
  const DirichletData dirichlet = evaluate_dirichlet(space, loads, true);

  using Row              = std::map<NodeIndex, double>;
  const bool has_chain   = GetParam();
  const auto columns     = nodes_at(space, 0.);
  const auto row_entries = [&](const Point<3> &x) {
    Row entries;
    for (std::size_t k = 0; k < columns.size(); k += 3)
      entries[columns[k].first] = .1 + .5 * value(x + Vector3(columns[k].second), 0);
    return entries;
  };
  // S, and S + S² + ...
  std::map<NodeIndex, Row>      rows, expanded;
  std::map<NodeIndex, Point<3>> places;
  if (has_chain)
    for (const auto &[node, x] : nodes_at(space, 1.5))
      if (x[0] > 1e-12 && x[0] < 1. - 1e-12)
        {
          rows[node] = expanded[node] = row_entries(x);
          places[node]                = x;
        }
  const std::map<NodeIndex, Row> middle = rows;
  EXPECT_EQ(middle.empty(), !has_chain);
  for (const auto &[node, x] : nodes_at(space, 3.))
    {
      rows[node] = expanded[node] = row_entries(x);
      places[node]                = x;
      for (const auto &[link, links] : middle)
        {
          const double weight = .2 * value(x + Vector3(places.at(link)), 1);
          rows[node][link] += weight;
          expanded[node][link] += weight;
          for (const auto &[column, other] : links)
            expanded[node][column] += weight * other;
        }
    }
  const auto as_coupling = [](const std::map<NodeIndex, Row> &list) {
    InterfaceCoupling result;
    for (const auto &[node, row] : list)
      {
        for (const auto &[column, weight] : row)
          result.entries.push_back({column, weight});
        result.rows.push_back(node);
        result.row_start.push_back(result.entries.size());
        result.weight.push_back(1.);
      }
    return result;
  };
  const InterfaceCoupling           coupling = as_coupling(rows), expansion = as_coupling(expanded);
  std::vector<RowProjection>        projections;
  std::vector<double>               gaps;
  std::map<FixedMask, unsigned int> n_rows;
  for (const auto &[node, x] : places)
    {
      projections.emplace_back(x[0] < 1e-12 ? 1 : x[0] > 1. - 1e-12 ? 6 : 0, normal);
      ++n_rows[projections.back().fixed().components()];
      gaps.push_back(.1 * value(x, 1));
    }
  EXPECT_GT(n_rows[0], 0u);
  EXPECT_GT(n_rows[1], 0u);
  EXPECT_GT(n_rows[6], 0u);

  const LinearSystem   system = assemble_elasticity(bodies, space, loads, dirichlet, expansion, projections);
  const NodePartition &unknowns = system.matrix.partition();
  const BasisTransformation transformation(space, partition, dirichlet, coupling, expansion, projections);
  Vector                    v, product, back;
  for (Vector *vector : {&v, &product, &back})
    unknowns.reinit(*vector);
  const Vector lift = transformation.to_displacement(v, unknowns);
  for (unsigned int i = 0; i < unknowns.n_owned(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      if (!(system.fixed[i].components() & (1u << c)))
        v.local_element(dim * i + c) = value(space.position(unknowns.to_global(i)), c);
  const Vector u = transformation.to_displacement(v, unknowns);

  // The same energy.
  system.matrix.vmult(product, v);
  const double energy  = .5 * (product * v) - system.rhs * v;
  const double minimum = potential_energy(bodies, space, partition, loads, lift);
  EXPECT_NEAR(potential_energy(bodies, space, partition, loads, u) - minimum, energy,
              1e-12 * std::abs(energy));

  // Back again.
  transformation.from_displacement(back, u);
  back -= v;
  EXPECT_LT(back.linfty_norm(), 1e-14);

  // What is left of the gap is seen by the free components alone.
  const std::vector<double> bounds = transformation.reduce_gaps(gaps);
  for (std::size_t p = 0; p < coupling.n_rows(); ++p)
    {
      Vector3 relative = replicate_values(partition, u, {coupling.rows[p]})[0];
      for (const auto *entry = coupling.begin(p); entry != coupling.end(p); ++entry)
        relative -= entry->weight * replicate_values(partition, u, {entry->node})[0];
      const Vector3 here = replicate_values(unknowns, v, {coupling.rows[p]})[0];
      EXPECT_NEAR(gaps[p] - normal * relative,
                  projections[p].share() * (bounds[p] - projections[p].direction() * here), 1e-13);
    }
}

INSTANTIATE_TEST_SUITE_P(WithoutAndWithChain, PartlyFixed, testing::Bool());
