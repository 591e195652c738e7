// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

using namespace TestSurfaces;

TEST(SurfaceTopology, KnowsWhoIsNextToWhom)
{
  const SurfaceMesh     mesh = grid(3, flat, true);
  const SurfaceTopology topology(mesh.triangles, mesh.vertices.size());
  // Euler: vertices - edges + triangles = 1 for a disc.
  EXPECT_EQ(mesh.vertices.size() + mesh.triangles.size(), topology.edges.size() + 1);
  EXPECT_EQ(topology.n_conflicts, 0u);
  unsigned int n_border = 0;
  for (unsigned int e = 0; e < topology.edges.size(); ++e)
    {
      n_border += topology.is_border(e);
      EXPECT_LT(topology.edges[e][0], topology.edges[e][1]);
      for (unsigned int side = 0; side < 2; ++side)
        if (const unsigned int t = topology.edge_triangles[e][side]; t != SurfaceTopology::none)
          {
            const unsigned int i = topology.local_edge(t, e);
            EXPECT_EQ(mesh.triangles[t][i], topology.edges[e][side]);
            EXPECT_EQ(mesh.triangles[t][(i + 1) % 3], topology.edges[e][1 - side]);
          }
    }
  EXPECT_EQ(n_border, 12u);
}

// A third triangle on an edge, and a neighbour that is turned over: the edge is a border for them.
TEST(SurfaceTopology, ConflictsBecomeBorders)
{
  const SurfaceTopology fan({{{0, 1, 2}}, {{1, 0, 3}}, {{0, 1, 4}}}, 5);
  EXPECT_EQ(fan.n_conflicts, 1u);
  EXPECT_EQ(fan.edge_triangles[fan.triangle_edges[0][0]][1], 1u);
  EXPECT_TRUE(fan.is_border(fan.triangle_edges[2][0]));
  const SurfaceTopology turned({{{0, 1, 2}}, {{0, 1, 3}}}, 4);
  EXPECT_EQ(turned.n_conflicts, 1u);
  EXPECT_TRUE(turned.is_border(turned.triangle_edges[0][0]));
  EXPECT_TRUE(turned.is_border(turned.triangle_edges[1][0]));
}

TEST(SurfacePoint, KeepsItsPlace)
{
  const SurfaceMesh     mesh = grid(2, flat, true);
  const SurfaceTopology topology(mesh.triangles, mesh.vertices.size());
  for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int e = topology.triangle_edges[t][i];
        const SurfacePoint p = SurfacePoint::on_edge(e, .25);
        const auto        &a = mesh.vertices[topology.edges[e][0]], &b = mesh.vertices[topology.edges[e][1]];
        ASSERT_TRUE(p.lies_in(topology, t));
        EXPECT_LT(evaluate(mesh, t, p.weights_in(topology, t)).distance(a + .25 * (b - a)), 1e-15);
        const SurfacePoint v = SurfacePoint::at_vertex(mesh.triangles[t][i]);
        EXPECT_EQ(evaluate(mesh, t, v.weights_in(topology, t)), mesh.vertices[v.index]);
      }
}

// A surface with a turned triangle is not silently covered in part.
TEST(SurfaceTopology, TurnedTrianglesAreReported)
{
  SurfaceMesh mesh = grid(3, flat, true);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  mesh.compute_vertex_normals();
  const ContactMapping mapping(mesh, grid(4, flat, false));
  EXPECT_EQ(mapping.report().n_conflicts, 2u); // its third edge is a border anyway
  EXPECT_NEAR(mapping.report().area_covered, 1. - 1. / 18., 1e-12);
}
