// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "mesh_file.h"

#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/surface/contact_mapping.h>

#include <gtest/gtest.h>

using namespace dealii;
using namespace Signorini;

namespace
{
  ContactSurface extract(const Bodies &bodies, const NodalSpace &space, const std::string &boundary,
                         const std::function<bool(const Point<3> &)> &region = {})
  {
    return extract_contact_surface(
        space, bodies.boundary_ids(0, boundary), [](const NodeIndex) { return FixedDirections(); }, region);
  }

  void refine_near(Bodies &bodies, const Point<3> &p, const double radius)
  {
    for (const auto &cell : bodies.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().distance(p) < radius)
        cell->set_refine_flag();
    bodies.triangulation().execute_coarsening_and_refinement();
  }

  double area(const ContactSurface &surface)
  {
    double sum = 0.;
    for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
      sum += triangle_area(surface.mesh, t);
    return sum;
  }

  double smallest_quality(const ContactSurface &surface)
  {
    double smallest = 1.;
    for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
      {
        double longest = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          longest = std::max(longest, surface.mesh.vertices[surface.mesh.triangles[t][i]].distance(
                                          surface.mesh.vertices[surface.mesh.triangles[t][(i + 1) % 3]]));
        smallest = std::min(smallest, 2. * triangle_area(surface.mesh, t) / (longest * longest));
      }
    return smallest;
  }

  /// Every inner edge belongs to two triangles that run through it in opposite directions; returns the number
  /// of border edges.
  unsigned int check_conforming(const ContactSurface &surface)
  {
    std::map<std::pair<unsigned int, unsigned int>, int> edges;
    for (const auto &t : surface.mesh.triangles)
      for (unsigned int i = 0; i < 3; ++i)
        ++edges[{t[i], t[(i + 1) % 3]}];
    unsigned int border = 0;
    for (const auto &[edge, n] : edges)
      {
        EXPECT_EQ(n, 1);
        border += edges.count({edge.second, edge.first}) == 0;
      }
    return border;
  }
} // namespace



TEST(SurfaceExtraction, TopOfABlockWithHangingNodes)
{
  BodyParameters p;
  p.divisions = {3, 3, 3};
  Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  refine_near(bodies, Point<3>(.5, .5, 1.), .2);
  const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
  const auto       surface = extract(bodies, space, "top");
  EXPECT_EQ(surface.faces.size(), 8u + 4u);
  EXPECT_NEAR(area(surface), 1., 1e-14);
  EXPECT_EQ(check_conforming(surface), 12u);
  EXPECT_GT(smallest_quality(surface), .3);
  unsigned int n_hanging = 0;
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v)
    {
      EXPECT_LT((surface.mesh.vertex_normals[v] - Point<3>(0., 0., 1.)).norm(), 1e-14);
      n_hanging += !surface.hanging[v].empty();
      EXPECT_EQ(surface.hanging[v].empty() ? 0u : 2u, surface.hanging[v].size());
    }
  EXPECT_EQ(n_hanging, 4u);
}



// At edges and corners the normal is the mean of the sides, whatever their areas.
TEST(SurfaceExtraction, NormalsOfCreasesAreMeansOfSides)
{
  BodyParameters p;
  p.upper_corner = Point<3>(1., 2., 7.);
  p.divisions    = {1, 3, 2};
  Bodies                       bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  const NodalSpace             space(MPI_COMM_WORLD, bodies.mesh());
  std::set<types::boundary_id> ids;
  for (const char *const boundary : {"right", "back", "top"})
    ids.merge(bodies.boundary_ids(0, boundary));
  const ContactSurface surface =
      extract_contact_surface(space, ids, [](const NodeIndex) { return FixedDirections(); }, {});
  unsigned int n_edges = 0, n_corners = 0;
  for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
    {
      const Point<3> &x = surface.mesh.vertices[v];
      // On the faces x = 1, y = 2 and z = 7 in turn.
      const Vector3 sides(
          {x[0] > 1. - 1e-9 ? 1. : 0., x[1] > 2. - 1e-9 ? 1. : 0., x[2] > 7. - 1e-9 ? 1. : 0.});
      const double n_sides = sides.norm_square();
      EXPECT_LT((surface.mesh.vertex_normals[v] - sides / std::sqrt(n_sides)).norm(), 1e-14) << x;
      n_edges += n_sides == 2.;
      n_corners += n_sides == 3.;
    }
  EXPECT_EQ(n_edges, 6u);
  EXPECT_EQ(n_corners, 1u);
}



// The coarse neighbours of the hanging nodes lie outside of the region: the nodes hang all the same, and
// their parents are there.
TEST(SurfaceExtraction, HangingNodesAtTheBorderOfARegion)
{
  BodyParameters p;
  p.divisions = {3, 3, 3};
  Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  refine_near(bodies, Point<3>(.5, .5, 1.), .2);
  const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
  const auto       surface =
      extract(bodies, space, "top", [](const Point<3> &x) { return x.distance(Point<3>(.5, .5, 1.)) < .15; });
  EXPECT_EQ(surface.faces.size(), 4u);
  unsigned int n_hanging = 0;
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v)
    if (!surface.hanging[v].empty())
      {
        ++n_hanging;
        EXPECT_TRUE(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1 ||
                    space.hanging_nodes().is_constrained(surface.vertex_node[v]));
        Point<3> mean;
        for (const auto &[parent, weight] : surface.hanging[v])
          mean += weight * surface.mesh.vertices[parent];
        EXPECT_LT(mean.distance(surface.mesh.vertices[v]), 1e-14);
      }
  EXPECT_EQ(n_hanging, 4u);
}



// A parent that no face of the region touches.
TEST(SurfaceExtraction, ParentsWithoutFaces)
{
  BodyParameters p;
  p.divisions = {3, 3, 3};
  Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  refine_near(bodies, Point<3>(.5, .5, 1.), .2);
  const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
  // The one fine face at the corner (2/3, 2/3).
  const auto surface =
      extract(bodies, space, "top", [](const Point<3> &x) { return x.distance(Point<3>(.6, .6, 1.)) < .04; });
  ASSERT_EQ(surface.faces.size(), 1u);
  EXPECT_EQ(surface.mesh.vertices.size(), 4u + 2u);
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v)
    EXPECT_LT((surface.mesh.vertex_normals[v] - Point<3>(0., 0., 1.)).norm(), 1e-14);
}



// Ears cut by the shortest diagonal would leave a triangle with all corners on the edge of the hanging node.
TEST(SurfaceExtraction, SkewFacesWithAHangingNodeHaveNoFlatTriangles)
{
  const double          xy[6][2] = {{0., -1.}, {1., -1.}, {1., 0.}, {0., 0.}, {.2, 1.2}, {-.8, 1.2}};
  std::vector<Point<3>> points;
  for (const double z : {0., 1.})
    for (const auto &q : xy)
      points.emplace_back(q[0], q[1], z);
  const TemporaryFile file(gmsh_text(points, {"3 2 9 1 7 8 9 10", "3 2 9 1 10 9 11 12",
                                              "5 2 1 1 1 2 3 4 7 8 9 10", "5 2 1 1 4 3 5 6 10 9 11 12"}));
  BodyParameters      p;
  p.mesh = file.path;
  Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  refine_near(bodies, Point<3>(.5, -.5, .5), .1);
  const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
  const auto       surface = extract(bodies, space, "9");
  EXPECT_EQ(surface.faces.size(), 5u);
  EXPECT_NEAR(area(surface), 2.2, 1e-14);
  EXPECT_GT(smallest_quality(surface), .2);
  check_conforming(surface);
}
