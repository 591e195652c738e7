// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/exact_error.h>
#include <signorini/discretization/hexahedron.h>
#include <signorini/discretization/nodal_stress.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/nodal_space.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;

// The mean of the normal stresses is the bulk modulus times the change of volume of the cells around a node.
TEST(NodalStress, OfTheMeanDilatation)
{
  BodyParameters p;
  p.name    = "ball";
  p.mesh    = "ball";
  p.young   = 3.;
  p.poisson = .45;
  for (const bool mean : {false, true})
    {
      p.element = mean ? ElementChoice::mean_dilatation : ElementChoice::standard;
      const Bodies     bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
      const auto       field = [](const Point<3> &x) {
        return Vector3({std::sin(3. * x[1] + x[2]), x[0] * x[1], std::cos(5. * x[0]) - x[2] * x[2]});
      };
      std::vector<double> u, volume(space.n_nodes(), 0.), change(space.n_nodes(), 0.);
      for (const NodeIndex node : space.relevant())
        for (unsigned int c = 0; c < dim; ++c)
          u.push_back(field(space.position(node))[c]);
      for (const NodalSpace::Cell &cell : space.cells())
        for (unsigned int q = 0; q < 8; ++q)
          {
            // The volume is a cubic polynomial of the displacement.
            double element[3];
            for (const int side : {-1, 0, 1})
              {
                Hexahedron::Corners x;
                for (unsigned int v = 0; v < 8; ++v)
                  {
                    const Point<3> &corner = space.position(space.nodes(cell)[v]);
                    x[v]                   = corner + 1e-4 * side * field(corner);
                  }
                element[side + 1] = Hexahedron::volume_element(x, q).first;
              }
            for (const NodeIndex node : space.nodes(cell))
              {
                volume[node] += element[1];
                change[node] += (element[2] - element[0]) / 2e-4;
              }
          }
      const Loads loads;
      const auto  stress = NodalStress({bodies, loads, space, u}).values();
      double      worst = 0., largest = 0.;
      for (const NodeIndex node : space.owned())
        {
          const auto  &s        = stress[space.relevant().index_within_set(node)];
          const double expected = p.young / (3. * (1. - 2. * p.poisson)) * change[node] / volume[node];
          worst                 = std::max(worst, std::abs((s[0] + s[1] + s[2]) / 3. - expected));
          largest               = std::max(largest, std::abs(expected));
        }
      if (mean)
        {
          EXPECT_LE(worst, 1e-6 * largest);
        }
      else if (largest > 0.)
        {
          EXPECT_GT(worst, 1e-3 * largest);
        }
    }
}



namespace
{
  /// A block with a displacement at its nodes.
  struct DisplacedBlock
  {
    Bodies              bodies;
    Loads               loads;
    NodalSpace          space;
    std::vector<double> u;

    DisplacedBlock(const std::vector<unsigned int> &divisions, const bool tetrahedra,
                   const VectorField &field)
      : bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {parameters(divisions, tetrahedra)}, "."))
      , space(MPI_COMM_WORLD, bodies.mesh())
    {
      for (const NodeIndex node : space.relevant())
        for (unsigned int c = 0; c < dim; ++c)
          u.push_back(field(space.position(node))[c]);
    }

    static BodyParameters parameters(const std::vector<unsigned int> &divisions, const bool tetrahedra)
    {
      BodyParameters p;
      p.name                  = "block";
      p.mesh                  = "block";
      p.divisions             = divisions;
      p.young                 = 2.;
      p.poisson               = .3;
      p.convert_to_tetrahedra = tetrahedra;
      return p;
    }

    StressedBodies stressed() const
    {
      return {bodies, loads, space, u};
    }
  };
} // namespace



// The stress of a linear displacement is the same everywhere.
TEST(NodalStress, OfALinearDisplacement)
{
  for (const bool tetrahedra : {false, true})
    {
      const DisplacedBlock block({3, 2, 4}, tetrahedra, [](const Point<3> &x) {
        return Vector3({.1 * x[0] + .2 * x[1], .05 * x[2], -.3 * x[2] + .1 * x[0]});
      });
      // lambda tr(eps) I + 2 mu eps.
      const Material        &m        = block.bodies.material(0);
      const StressComponents expected = {{-.2 * m.lambda() + .2 * m.mu(), -.2 * m.lambda(),
                                          -.2 * m.lambda() - .6 * m.mu(), .2 * m.mu(), .05 * m.mu(),
                                          .1 * m.mu()}};
      for (const StressComponents &s : NodalStress(block.stressed()).values())
        for (unsigned int c = 0; c < 6; ++c)
          EXPECT_NEAR(s[c], expected[c], 1e-13);
      EXPECT_LE(NodalStress(block.stressed()).errors()[0].relative(), 1e-13);
    }
}



// One layer of hexahedra that is bent: at its surfaces the stress is that of the surfaces, not that of the
// middle, which is none.
TEST(NodalStress, OfABentLayer)
{
  const DisplacedBlock block({6, 1, 1}, false, [](const Point<3> &x) {
    return Vector3({x[0] * (x[2] - .5), 0., -.5 * x[0] * x[0]});
  });
  const Material      &m      = block.bodies.material(0);
  const auto           stress = NodalStress(block.stressed()).values();
  for (const NodeIndex node : block.space.relevant())
    EXPECT_NEAR(stress[block.space.relevant().index_within_set(node)][0],
                (m.lambda() + 2. * m.mu()) * (block.space.position(node)[2] - .5), 1e-13);
}



// The estimate against the distance of the stress of the cells from that of the function that was
// interpolated.
TEST(NodalStress, EstimateAgainstTheErrorOfAnInterpolation)
{
  for (const bool tetrahedra : {false, true})
    {
      const auto field = [](const Point<3> &x) {
        return Vector3({std::sin(2. * x[1] + x[2]), .3 * x[0] * x[0], std::cos(3. * x[0])});
      };
      const DisplacedBlock block({12, 12, 12}, tetrahedra, field);
      const NodePartition  partition(block.space.owned(), block.space.relevant(), MPI_COMM_WORLD);
      Vector               u;
      partition.reinit(u);
      for (const NodeIndex node : block.space.relevant())
        for (unsigned int c = 0; c < dim; ++c)
          u.local_element(dim * partition.to_local(node) + c) = field(block.space.position(node))[c];
      const ExactError exact =
          compute_exact_error(block.bodies, block.loads, block.space, partition, u, {0, field});
      const StressError estimate = NodalStress(block.stressed()).errors()[0];
      EXPECT_NEAR(estimate.error / exact.energy, 1., .06) << (tetrahedra ? "tetrahedra" : "hexahedra");
      EXPECT_NEAR(estimate.relative(), exact.energy / exact.energy_norm, .06 * estimate.relative());
    }
}
