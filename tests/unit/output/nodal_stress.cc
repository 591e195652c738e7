// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/hexahedron.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/nodal_space.h>
#include <signorini/output/field_output.h>

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
      const auto fields =
          nodal_stress(space, u, bodies, Loads());
      double worst = 0., largest = 0.;
      for (const NodeIndex node : space.owned())
        {
          const double *s        = fields[0].values.data() + 6 * space.relevant().index_within_set(node);
          const double  expected = p.young / (3. * (1. - 2. * p.poisson)) * change[node] / volume[node];
          worst                  = std::max(worst, std::abs((s[0] + s[1] + s[2]) / 3. - expected));
          largest                = std::max(largest, std::abs(expected));
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
