// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Parts of contact surfaces between sharp edges, and which of them face the other side (doc/meshes.md).

#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace Signorini;
  using dealii::Point;

  /// Quadrilaterals whose equal corners are put together.
  class Quads
  {
  public:
    /// n x n faces of the parallelogram from `origin` along a and b; it faces a x b.
    void add(const Point<3> &origin, const Vector3 &a, const Vector3 &b, const unsigned int n = 4)
    {
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const auto corner = [&](const unsigned int k, const unsigned int l) {
              return vertex(origin + (k * a + l * b) / n);
            };
            const auto                        f = static_cast<unsigned int>(surface.faces.size());
            const std::array<unsigned int, 4> c = {
                {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)}};
            surface.faces.push_back({c, 0, 0});
            surface.mesh.triangles.push_back({{c[0], c[1], c[2]}});
            surface.mesh.triangles.push_back({{c[0], c[2], c[3]}});
            surface.triangle_face.insert(surface.triangle_face.end(), 2, f);
          }
    }

    const ContactSurface &finish()
    {
      const std::size_t n = surface.mesh.vertices.size();
      surface.hanging.resize(n);
      surface.vertex_fixed.assign(n, 0);
      for (unsigned int v = 0; v < n; ++v)
        surface.vertex_node.push_back(v);
      set_normals(surface, {});
      return surface;
    }

  private:
    unsigned int vertex(const Point<3> &x)
    {
      for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
        if (surface.mesh.vertices[v].distance(x) < 1e-9)
          return v;
      surface.mesh.vertices.push_back(x);
      return static_cast<unsigned int>(surface.mesh.vertices.size() - 1);
    }

    ContactSurface surface;
  };

  Vector3 vector(const double x, const double y, const double z)
  {
    return Vector3({x, y, z});
  }

  /// The foot of a block and one of its walls, at x = 1.
  ContactSurface foot_and_wall(const double height)
  {
    Quads quads;
    quads.add(Point<3>(0., 0., height), vector(0., 1., 0.), vector(1., 0., 0.));
    quads.add(Point<3>(1., 0., height), vector(0., 1., 0.), vector(0., 0., 1.));
    return quads.finish();
  }

  /// A floor and, at x = `step`, a wall of a step that looks back at the block.
  ContactSurface floor_and_step(const double step)
  {
    Quads quads;
    quads.add(Point<3>(-1., -1., 0.), vector(step + 1., 0., 0.), vector(0., 3., 0.), 7);
    quads.add(Point<3>(step, -1., 0.), vector(0., 0., 2.), vector(0., 3., 0.), 3);
    return quads.finish();
  }

  struct Pair
  {
    ContactSurface first, second;
    FacingParts    first_parts, second_parts;

    Pair(const ContactSurface &one, const ContactSurface &other)
      : first(one)
      , second(other)
      , first_parts(first)
      , second_parts(second)
    {
      see_each_other(first_parts, first, second_parts, second, MPI_COMM_WORLD);
    }
  };

  Vector3 normal_at(const ContactSurface &surface, const Point<3> &x)
  {
    for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
      if (surface.mesh.vertices[v].distance(x) < 1e-9)
        return surface.mesh.vertex_normals[v];
    ADD_FAILURE() << "no vertex at " << x;
    return Vector3();
  }
} // namespace

TEST(FacingParts, WallsThatFaceNothingAreLeftOut)
{
  Quads floor;
  floor.add(Point<3>(-1., -1., 0.), vector(3., 0., 0.), vector(0., 3., 0.), 7);
  const Pair pair(foot_and_wall(.1), floor.finish());
  EXPECT_EQ(pair.first_parts.n_pieces(), 2u);
  EXPECT_EQ(pair.second_parts.n_pieces(), 1u);
  EXPECT_TRUE(pair.first_parts.leaves_out_anything());
  EXPECT_FALSE(pair.second_parts.leaves_out_anything());
  EXPECT_GT((normal_at(pair.first, Point<3>(1., .5, .1)) - vector(0., 0., -1.)).norm(), .5);
  const ContactSurface foot = without_blind_parts(pair.first, pair.first_parts, {});
  EXPECT_EQ(foot.faces.size(), 16u);
  EXPECT_EQ(foot.mesh.triangles.size(), 32u);
  EXPECT_EQ(foot.mesh.vertices.size(), 25u);
  EXPECT_FALSE(foot.origin);
  EXPECT_LT((normal_at(foot, Point<3>(1., .5, .1)) - vector(0., 0., -1.)).norm(), 1e-14);
}

// The wall could touch one day, but where it meets the foot the foot decides.
TEST(FacingParts, WhatIsFarLeavesTheNormalToWhatIsNear)
{
  const Pair           pair(foot_and_wall(.1), floor_and_step(2.));
  const ContactSurface block = without_blind_parts(pair.first, pair.first_parts, {}),
                       floor = without_blind_parts(pair.second, pair.second_parts, {});
  EXPECT_EQ(block.faces.size(), 32u);
  EXPECT_EQ(floor.faces.size(), 58u);
  EXPECT_LT((normal_at(block, Point<3>(1., .5, .1)) - vector(0., 0., -1.)).norm(), 1e-14);
  EXPECT_LT((normal_at(block, Point<3>(1., .5, .35)) - vector(1., 0., 0.)).norm(), 1e-14);
  EXPECT_LT((normal_at(floor, Point<3>(2., -1., 0.)) - vector(0., 0., 1.)).norm(), 1e-14);
}

TEST(FacingParts, BothSidesOfAnEdgeThatTouchShareTheNormal)
{
  const Pair pair(foot_and_wall(.1), floor_and_step(1.1));
  EXPECT_FALSE(pair.first_parts.leaves_out_anything());
  EXPECT_FALSE(pair.second_parts.leaves_out_anything());
}

// A rib that touches with its foot, on a plate that is far: in the groove beside it its walls face nothing,
// though it is the nearer part.
TEST(FacingParts, InGroovesWhatFacesNothingLeavesTheNormalToWhatDoes)
{
  const auto ribbed = [](const double plate) {
    Quads quads;
    quads.add(Point<3>(-3., 0., plate), vector(0., 1., 0.), vector(2., 0., 0.));
    for (unsigned int i = 0; i < 24; ++i)
      {
        // Half of a cylinder: its lowest faces lie on the floor but for the walls, which rise.
        const double   pi = dealii::numbers::PI, a = pi * i / 24, b = pi * (i + 1) / 24;
        const Point<3> from(-std::cos(a), 0., 1. - std::sin(a)), to(-std::cos(b), 0., 1. - std::sin(b));
        quads.add(from, vector(0., 1., 0.), to - from);
      }
    return quads.finish();
  };
  Quads floor;
  floor.add(Point<3>(-5., -5., 0.), vector(10., 0., 0.), vector(0., 10., 0.), 3);
  const Pair           pair(ribbed(1.), floor.finish());
  const ContactSurface ribs = without_blind_parts(pair.first, pair.first_parts, {});
  EXPECT_EQ(ribs.faces.size(), 400u);
  unsigned int n_left = 0;
  for (unsigned int f = 0; f < ribs.faces.size(); ++f)
    for (unsigned int i = 0; i < 4; ++i)
      if (ribs.faces[f].leaves(i))
        {
          const unsigned int v = ribs.faces[f].corners[i];
          EXPECT_LT(ribs.mesh.vertices[v].distance(Point<3>(-1., ribs.mesh.vertices[v][1], 1.)), 1e-14);
          EXPECT_LT(std::abs(area_vector(ribs, ribs.faces[f])[2]), .1) << "a wall";
          EXPECT_LT((ribs.normals_of_rows.at(v) - vector(0., 0., -1.)).norm(), 1e-14);
          EXPECT_LT(ribs.mesh.vertex_normals[v][0], -.1) << "between both";
          EXPECT_LT(ribs.mesh.vertex_normals[v][2], -.5) << "between both";
          ++n_left;
        }
  EXPECT_EQ(n_left, 8u);
  ContactSurface nonmortar = ribs;
  nonmortar.take_row_normals();
  EXPECT_LT((normal_at(nonmortar, Point<3>(-1., .5, 1.)) - vector(0., 0., -1.)).norm(), 1e-14);
  EXPECT_LT((normal_at(ribs, Point<3>(-2., .5, 1.)) - vector(0., 0., -1.)).norm(), 1e-14);
}

// A block that is a little too low, on a floor whose faces are larger than it.
TEST(FacingParts, OverlapsAndLargeFacesAreSeen)
{
  Quads floor;
  floor.add(Point<3>(-9., -1., 0.), vector(20., 0., 0.), vector(0., 20., 0.), 1);
  floor.add(Point<3>(-9., -1., 0.), vector(0., 20., 0.), vector(0., 0., -5.), 1);
  const Pair pair(foot_and_wall(-.01), floor.finish());
  EXPECT_EQ(without_blind_parts(pair.first, pair.first_parts, {}).faces.size(), 16u);
  EXPECT_EQ(without_blind_parts(pair.second, pair.second_parts, {}).faces.size(), 1u);
}

TEST(FacingParts, WhereNothingIsSeenAllStays)
{
  Quads floor;
  floor.add(Point<3>(50., -1., 0.), vector(3., 0., 0.), vector(0., 3., 0.), 2);
  const Pair pair(foot_and_wall(.1), floor.finish());
  EXPECT_FALSE(pair.first_parts.leaves_out_anything());
  EXPECT_FALSE(pair.second_parts.leaves_out_anything());
}

// The wall of the step is 1.1 away, four widths of a face.
TEST(FacingParts, PartsMayBeLeftToOthers)
{
  Pair       pair(foot_and_wall(.1), floor_and_step(2.1));
  const auto faces = [&](const bool far) {
    std::vector<bool> result;
    for (unsigned int f = 0; f < pair.first.faces.size(); ++f)
      result.push_back(pair.first_parts.is_far(f) == far);
    return result;
  };
  EXPECT_NEAR(pair.first_parts.distance(0), .1, 1e-14);
  EXPECT_NEAR(pair.first_parts.distance(31), 1.1, 1e-14);
  EXPECT_FALSE(pair.first_parts.is_far(0));
  EXPECT_TRUE(pair.first_parts.is_far(31));
  // Nothing if nothing is left.
  EXPECT_EQ(pair.first_parts.leave(std::vector<bool>(32, true)), 0u);
  // One face is not the part.
  std::vector<bool> one(32, false);
  one[31] = true;
  EXPECT_EQ(pair.first_parts.leave(one), 0u);
  EXPECT_EQ(without_blind_parts(pair.first, pair.first_parts, {}).faces.size(), 32u);
  EXPECT_EQ(pair.first_parts.leave(faces(true)), 16u);
  EXPECT_EQ(pair.first_parts.n_blind(), 0u);
  const ContactSurface foot = without_blind_parts(pair.first, pair.first_parts, {});
  EXPECT_EQ(foot.faces.size(), 16u);
  EXPECT_LT((normal_at(foot, Point<3>(1., .5, .1)) - vector(0., 0., -1.)).norm(), 1e-14);
}

TEST(FacingParts, ObstaclesAreSeen)
{
  const ContactSurface block = foot_and_wall(.1);
  FacingParts          parts(block);
  see(
      parts, block,
      [](double &distance, const Point<3> &p, const Vector3 &n) {
        distance = -p[2] / n[2];
        return n[2] < -.5;
      },
      MPI_COMM_WORLD);
  EXPECT_EQ(without_blind_parts(block, parts, {}).faces.size(), 16u);
}

// Walls that meet, and prisms that are round only from twelve sides on.
TEST(FacingParts, VerticesOnSharpEdges)
{
  const ContactSurface corner = foot_and_wall(0.);
  const auto           sharp  = vertices_on_sharp_edges(corner, all_faces);
  for (unsigned int v = 0; v < sharp.size(); ++v)
    EXPECT_EQ(sharp[v], corner.mesh.vertices[v][0] == 1. && corner.mesh.vertices[v][2] == 0.) << v;
  for (const bool is_sharp :
       vertices_on_sharp_edges(corner, [&](const unsigned int face, const unsigned int) {
         return std::abs(area_vector(corner, corner.faces[face])[2]) > 0.;
       }))
    EXPECT_FALSE(is_sharp);
  for (const unsigned int n_sides : {5, 6, 8, 12})
    {
      Quads prism;
      for (unsigned int i = 0; i < n_sides; ++i)
        {
          const auto place = [&](const unsigned int k) {
            const double angle = 2. * dealii::numbers::PI * k / n_sides;
            return Point<3>(std::cos(angle), std::sin(angle), 0.);
          };
          prism.add(place(i), place((i + 1) % n_sides) - place(i), vector(0., 0., 1.), 2);
        }
      const ContactSurface surface = prism.finish();
      std::size_t          n       = 0;
      for (const bool is_sharp : vertices_on_sharp_edges(surface, all_faces))
        n += is_sharp;
      EXPECT_EQ(n, n_sides < 12 ? 3 * n_sides : 0u);
    }
}
