// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Levels of trilinear functions on octrees under a mesh that has no coarser ones.

#include <signorini/discretization/background_levels.h>
#include <signorini/mesh/body_parameters.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

using namespace Signorini;
using dealii::Point;
namespace Utilities = dealii::Utilities;

namespace
{
  /// A grid with cells where `exists` says so; nodes without cells are left out.
  ConnectedNodes grid(const std::array<std::vector<double>, 3>    &lines,
                      const std::function<bool(const Point<3> &)> &exists = {}, const unsigned int part = 0)
  {
    const auto number = [&](const std::size_t i, const std::size_t j, const std::size_t k) {
      return i + lines[0].size() * (j + lines[1].size() * k);
    };
    ConnectedNodes            mesh;
    std::vector<unsigned int> place(lines[0].size() * lines[1].size() * lines[2].size(), 0);
    std::vector<double>       sizes(place.size());
    std::vector<Point<3>>     positions(place.size());
    for (std::size_t k = 0; k + 1 < lines[2].size(); ++k)
      for (std::size_t j = 0; j + 1 < lines[1].size(); ++j)
        for (std::size_t i = 0; i + 1 < lines[0].size(); ++i)
          {
            const Point<3> middle(.5 * (lines[0][i] + lines[0][i + 1]), .5 * (lines[1][j] + lines[1][j + 1]),
                                  .5 * (lines[2][k] + lines[2][k + 1]));
            if (exists && !exists(middle))
              continue;
            for (unsigned int v = 0; v < 8; ++v)
              {
                const std::size_t a = i + (v & 1u), b = j + ((v >> 1) & 1u), c = k + (v >> 2);
                const std::size_t node = number(a, b, c);
                positions[node]        = Point<3>(lines[0][a], lines[1][b], lines[2][c]);
                sizes[node]            = lines[0][i + 1] - lines[0][i];
                mesh.cells.nodes.push_back(static_cast<unsigned int>(node));
              }
            mesh.cells.start.push_back(mesh.cells.nodes.size());
          }
    for (std::size_t node = 0; node < place.size(); ++node)
      if (sizes[node] > 0.)
        {
          place[node] = static_cast<unsigned int>(mesh.positions.size());
          mesh.positions.push_back(positions[node]);
          mesh.sizes.push_back(sizes[node]);
          mesh.parts.push_back(part);
        }
    for (unsigned int &node : mesh.cells.nodes)
      node = place[node];
    return mesh;
  }

  std::vector<double> even(const unsigned int n, const double h)
  {
    std::vector<double> result;
    for (unsigned int i = 0; i <= n; ++i)
      result.push_back(i * h);
    return result;
  }

  /// Twenty times longer cells at the end than at the start.
  std::vector<double> graded(const unsigned int n, const double h)
  {
    std::vector<double> result = {0.};
    for (unsigned int i = 0; i < n; ++i)
      result.push_back(result.back() + h * std::pow(20., static_cast<double>(i) / (n - 1)));
    return result;
  }

  /// Weights are not negative, their sum is 1, and the positions of a level are those of the next finer one:
  /// so all linear functions are reproduced.
  void check_rows(const BackgroundLevel &level, const std::vector<Point<3>> &finer, const double length)
  {
    ASSERT_EQ(level.rows.n_rows(), finer.size());
    for (std::size_t i = 0; i < finer.size(); ++i)
      {
        double   sum = 0.;
        Point<3> x;
        for (std::size_t k = level.rows.start[i]; k < level.rows.start[i + 1]; ++k)
          {
            EXPECT_GT(level.rows.weights[k], 0.);
            sum += level.rows.weights[k];
            x += level.rows.weights[k] * dealii::Tensor<1, 3>(level.positions[level.rows.columns[k]]);
          }
        EXPECT_NEAR(sum, 1., 1e-13);
        // Weights below 1e-7 are left out.
        EXPECT_LT(x.distance(finer[i]), 1e-6 * length);
      }
  }
} // namespace

TEST(BackgroundLevels, ReproduceLinearFunctionsOnGradedMeshes)
{
  for (const double scale : {1e-6, 1., 1e6})
    {
      const ConnectedNodes mesh =
          grid({{graded(30, .1 * scale), graded(20, .07 * scale), even(9, .3 * scale)}});
      const auto                   levels = make_background_levels(mesh, BackgroundRule());
      const std::vector<Point<3>> *finer  = &mesh.positions;
      ASSERT_GE(levels.size(), 2u);
      for (const BackgroundLevel &level : levels)
        {
          EXPECT_LE(level.positions.size(), BackgroundRule().largest_growth * finer->size());
          check_rows(level, *finer, 30. * scale);
          finer = &level.positions;
        }
      EXPECT_LE(finer->size(), BackgroundRule().smallest_level);
    }
}

// Of the functions of a level each has a connected support, and they are as many as without the slot where
// the material goes on, but more beside it.
TEST(BackgroundLevels, AreSplitAtSlots)
{
  const auto slot = [](const Point<3> &x) { return x[0] > 18. || x[1] < 11. || x[1] > 12.; };
  for (const bool has_slot : {false, true})
    {
      const ConnectedNodes mesh = grid({{even(24, 1.), even(24, 1.), even(6, 1.)}},
                                       has_slot ? std::function<bool(const Point<3> &)>(slot) : nullptr);
      BackgroundRule       rule;
      rule.first_ratio    = 4.2;
      const auto   levels = make_background_levels(mesh, rule);
      unsigned int across = 0;
      ASSERT_FALSE(levels.empty());
      std::vector<std::array<bool, 2>> walls(levels[0].positions.size(), {{false, false}});
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (mesh.positions[i][0] < 9.)
          for (std::size_t k = levels[0].rows.start[i]; k < levels[0].rows.start[i + 1]; ++k)
            walls[levels[0].rows.columns[k]][mesh.positions[i][1] > 11.5] = true;
      for (const auto &wall : walls)
        across += wall[0] && wall[1];
      if (has_slot)
        EXPECT_EQ(across, 0u);
      else
        EXPECT_GT(across, 0u);
      check_rows(levels[0], mesh.positions, 24.);
    }
}

// Blocks of small cells with one long cell from each to the next, as adaptive meshes of bisected tetrahedra
// have them: no function of a level with small cells is in both, but they are one body.
TEST(BackgroundLevels, KeepWhatLongCellsConnectTogether)
{
  std::vector<double> x;
  for (const double start : {0., 40., 80., 120.})
    for (const double d : even(6, 1.))
      x.push_back(start + d);
  ConnectedNodes mesh = grid({{x, even(6, 1.), even(6, 1.)}});
  std::fill(mesh.sizes.begin(), mesh.sizes.end(), 1.);
  BackgroundRule rule;
  rule.smallest_level                 = 20;
  const auto                   levels = make_background_levels(mesh, rule);
  const std::vector<Point<3>> *finer  = &mesh.positions;
  for (const BackgroundLevel &level : levels)
    {
      check_rows(level, *finer, 130.);
      finer = &level.positions;
    }
  EXPECT_LE(finer->size(), rule.smallest_level);
}

TEST(BackgroundLevels, KeepPartsApart)
{
  ConnectedNodes       mesh  = grid({{even(12, 1.), even(12, 1.), even(12, 1.)}});
  const ConnectedNodes other = grid({{even(12, 1.), even(12, 1.), even(12, 1.)}}, {}, 3);
  const auto           n     = static_cast<unsigned int>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.sizes.insert(mesh.sizes.end(), other.sizes.begin(), other.sizes.end());
  mesh.parts.insert(mesh.parts.end(), other.parts.begin(), other.parts.end());
  for (const unsigned int node : other.cells.nodes)
    mesh.cells.nodes.push_back(n + node);
  for (std::size_t c = 1; c < other.cells.start.size(); ++c)
    mesh.cells.start.push_back(8 * other.cells.start.size() - 8 + other.cells.start[c]);
  const auto levels = make_background_levels(mesh, BackgroundRule());
  ASSERT_FALSE(levels.empty());
  for (unsigned int i = 0; i < 2 * n; ++i)
    for (std::size_t k = levels[0].rows.start[i]; k < levels[0].rows.start[i + 1]; ++k)
      EXPECT_EQ(levels[0].parts[levels[0].rows.columns[k]], i < n ? 0u : 3u);
}

// On any number of ranks the same functions; rows of nodes that are fixed are empty.
TEST(BackgroundLevels, DoNotDependOnTheNumberOfRanks)
{
  BodyParameters p;
  p.name         = "body";
  p.mesh         = "block";
  p.upper_corner = Point<3>(1, 2, 3);
  p.divisions    = {6, 12, 18};
  p.young        = 1.;
  p.poisson      = .3;
  for (const bool tetrahedra : {false, true})
    {
      p.convert_to_tetrahedra = tetrahedra;
      const Bodies                 bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      const NodalSpace             space(MPI_COMM_WORLD, bodies.mesh());
      std::vector<FixedDirections> fixed;
      for (const NodeIndex node : space.owned())
        fixed.push_back(space.position(node)[2] < 1e-12 ? all_fixed : 0);
      const auto             levels = background_levels(space, fixed, bodies);
      std::vector<NodeIndex> sizes;
      for (const auto &level : levels)
        sizes.push_back(level.owned.size());
      EXPECT_EQ(sizes, (std::vector<NodeIndex>{315, 75}));
      double       sum    = 0.;
      unsigned int n_free = 0;
      std::size_t  i      = 0;
      for (const NodeIndex node : space.owned())
        {
          const auto &rows = levels[0].rows;
          EXPECT_EQ(rows.start[i + 1] == rows.start[i], space.position(node)[2] < 1e-12);
          for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
            sum += rows.weights[k];
          n_free += fixed[i] == 0;
          ++i;
        }
      EXPECT_NEAR(Utilities::MPI::sum(sum, MPI_COMM_WORLD), Utilities::MPI::sum(n_free, MPI_COMM_WORLD),
                  1e-9);
    }
}
