// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

using namespace TestSurfaces;

namespace
{
  struct CurvedPair
  {
    SurfaceMesh nonmortar, mortar;
  };

  std::vector<CurvedPair> pairs()
  {
    return {{grid(9, wave, true, .2, 1), grid(8, stretched(saddle), false, .2, 2)},
            {grid(9, saddle, true), grid(7, stretched(wave), false)},
            {grid(6, cap, true, .2, 3), grid(11, stretched(cap), false, .2, 4)},
            {grid(30, flat, true, .2, 5), grid(3, stretched(saddle), false, .2, 6)},
            {grid(4, flat, true), grid(8, flat, false)}};
  }

  std::array<double, 3> random_weights(std::mt19937 &random)
  {
    std::uniform_real_distribution<double> uniform(0., 1.);
    const double                           a = uniform(random), b = uniform(random);
    return a + b < 1. ? std::array<double, 3>{{1. - a - b, a, b}}
                      : std::array<double, 3>{{a + b - 1., 1. - a, 1. - b}};
  }

  Point<3> place(const SurfaceMesh &mesh, const SurfacePoint &p)
  {
    return evaluate(mesh, p.index, {{1. - p.x[0] - p.x[1], p.x[0], p.x[1]}});
  }
} // namespace

TEST(Phi, OfTheInverseIsTheIdentity)
{
  for (const CurvedPair &pair : pairs())
    {
      const ContactMapping mapping(pair.nonmortar, pair.mortar);
      std::mt19937         random(1);
      unsigned int         n_inside = 0;
      for (unsigned int m = 0; m < pair.mortar.triangles.size(); ++m)
        for (unsigned int k = 0; k < 20; ++k)
          {
            const auto         w = random_weights(random);
            const SurfacePoint p = mapping.preimage(m, w);
            if (p.on == SurfacePoint::On::nothing)
              continue;
            const SurfacePoint q = mapping.image(p.index, {{1. - p.x[0] - p.x[1], p.x[0], p.x[1]}});
            ASSERT_EQ(q.on, SurfacePoint::On::triangle);
            EXPECT_LT(place(pair.mortar, q).distance(evaluate(pair.mortar, m, w)), 1e-12);
            ++n_inside;
          }
      EXPECT_GT(n_inside, 100u);
    }
}

TEST(Phi, TakesTheImagesOfMortarVerticesBack)
{
  for (const CurvedPair &pair : pairs())
    {
      const ContactMapping mapping(pair.nonmortar, pair.mortar);
      unsigned int         n_vertices = 0;
      for (const MappingNode &node : mapping.nodes())
        if (node.mortar.on == SurfacePoint::On::vertex)
          for (unsigned int t = 0; t < pair.nonmortar.triangles.size(); ++t)
            if (node.nonmortar.lies_in(mapping.nonmortar_topology(), t))
              {
                const SurfacePoint q =
                    mapping.image(t, node.nonmortar.weights_in(mapping.nonmortar_topology(), t));
                ASSERT_EQ(q.on, SurfacePoint::On::triangle);
                EXPECT_LT(place(pair.mortar, q).distance(pair.mortar.vertices[node.mortar.index]), 1e-12);
                ++n_vertices;
              }
      EXPECT_GE(n_vertices, 4u);
    }
}

TEST(Phi, IsContinuousAcrossNonmortarEdges)
{
  for (const CurvedPair &pair : pairs())
    {
      const ContactMapping                   mapping(pair.nonmortar, pair.mortar);
      const SurfaceTopology                 &topology = mapping.nonmortar_topology();
      std::mt19937                           random(2);
      std::uniform_real_distribution<double> uniform(0., 1.);
      for (unsigned int e = 0; e < topology.edges.size(); ++e)
        if (!topology.is_border(e))
          for (unsigned int k = 0; k < 5; ++k)
            {
              const SurfacePoint p = SurfacePoint::on_edge(e, uniform(random));
              SurfacePoint       images[2];
              for (unsigned int i = 0; i < 2; ++i)
                {
                  const unsigned int t = topology.edge_triangles[e][i];
                  images[i]            = mapping.image(t, p.weights_in(topology, t));
                  ASSERT_EQ(images[i].on, SurfacePoint::On::triangle);
                }
              EXPECT_LT(place(pair.mortar, images[0]).distance(place(pair.mortar, images[1])), 1e-12);
            }
    }
}

// Beside the common part there is no image.
TEST(Phi, EndsWhereTheSurfacesEnd)
{
  const SurfaceMesh square = grid(4, flat, true),
                    other  = grid(
                         4, [](const double x, const double y) { return Point<3>(.5 + x, y, 0.); }, false);
  const ContactMapping mapping(square, other);
  for (unsigned int t = 0; t < square.triangles.size(); ++t)
    {
      const std::array<double, 3> middle = {{1. / 3., 1. / 3., 1. / 3.}};
      const bool                  inside = evaluate(square, t, middle)[0] > .5;
      EXPECT_EQ(mapping.image(t, middle).on != SurfacePoint::On::nothing, inside);
    }
}
