// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "flat_surfaces.h"

#include <signorini/mortar/edge_normals.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;
using dealii::numbers::PI;

namespace
{
  /// The walls of a block over or under the unit square, as far as they are seen from its vertices.
  void add_walls(ContactSurface &surface, const bool faces_up)
  {
    for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
      for (unsigned int c = 0; c < 2; ++c)
        for (const double side : {0., 1.})
          if (std::abs(surface.mesh.vertices[v][c] - side) < 1e-10)
            {
              ContactSurface::Facet wall;
              wall.normal[c] = 2. * side - 1.;
              wall.way[2]    = faces_up ? -.1 : .1;
              surface.beyond[v].push_back(wall);
            }
  }

  /// Turned about the y axis, such that what is at larger x gets higher, and lifted.
  void tilt(ContactSurface &surface, const double angle, const double height)
  {
    const auto turn = [&](const Vector3 &v) {
      return Point<3>(std::cos(angle) * v[0] - std::sin(angle) * v[2], v[1],
                      std::sin(angle) * v[0] + std::cos(angle) * v[2]);
    };
    for (Point<3> &x : surface.mesh.vertices)
      {
        x = turn(x);
        x[2] += height;
      }
    for (Vector3 &n : surface.mesh.vertex_normals)
      n = turn(n);
    for (auto &entry : surface.beyond)
      for (ContactSurface::Facet &facet : entry.second)
        {
          facet.normal = turn(facet.normal);
          facet.way    = turn(facet.way);
        }
  }

  /// The bottom of a block, four by four faces, one edge of which is the lowest.
  ContactSurface bottom(const double angle, const double height)
  {
    FlatSurfaces::Grid grid;
    grid.nx = grid.ny      = 4;
    grid.faces_up          = false;
    ContactSurface surface = FlatSurfaces::make_surface(grid);
    add_walls(surface, false);
    tilt(surface, angle, height);
    return surface;
  }

  ContactSurface floor()
  {
    FlatSurfaces::Grid grid;
    grid.nx = 5;
    grid.ny = 3;
    grid.x0 = grid.y0 = -2.;
    grid.x1 = grid.y1 = 3.;
    return FlatSurfaces::make_surface(grid);
  }

  const RigidObstacle &plane()
  {
    static const RigidObstacle result = RigidObstacle::plane(Point<3>(0., 0., 0.), Vector3({0., 0., 1.}));
    return result;
  }

  /// The prism between the planes z = x tan(angle) and z = -x tan(angle), whose edge points down.
  ContactSurface prism(const double angle)
  {
    ContactSurface surface = bottom(angle, 0.);
    surface.beyond.clear();
    ContactSurface            other = surface;
    const auto                n     = static_cast<unsigned int>(surface.mesh.vertices.size());
    std::vector<unsigned int> number(n);
    for (unsigned int v = 0; v < n; ++v)
      if (std::abs(surface.mesh.vertices[v][0]) < 1e-10)
        number[v] = v;
      else
        {
          number[v]  = static_cast<unsigned int>(surface.mesh.vertices.size());
          Point<3> x = other.mesh.vertices[v], m(other.mesh.vertex_normals[v]);
          x[0] *= -1.;
          m[0] *= -1.;
          surface.mesh.vertices.push_back(x);
          surface.mesh.vertex_normals.push_back(m);
          surface.vertex_fixed.push_back(other.vertex_fixed[v]);
          surface.vertex_node.push_back(n + other.vertex_node[v]);
        }
    const auto n_faces = static_cast<unsigned int>(other.faces.size());
    for (const ContactSurface::Face &face : other.faces)
      {
        surface.faces.push_back(face);
        for (unsigned int a = 0; a < 4; ++a)
          surface.faces.back().corners[a] = number[face.corners[(4 - a) % 4]];
      }
    for (unsigned int t = 0; t < other.mesh.triangles.size(); ++t)
      {
        const auto &one = other.mesh.triangles[t];
        surface.mesh.triangles.push_back({{number[one[0]], number[one[2]], number[one[1]]}});
        surface.triangle_face.push_back(n_faces + other.triangle_face[t]);
      }
    surface.hanging.resize(surface.mesh.vertices.size());
    for (unsigned int v = 0; v < n; ++v)
      if (number[v] == v)
        surface.mesh.vertex_normals[v] = Vector3({0., 0., -1.});
    return surface;
  }

  const Vector3 down({0., 0., -1.});

  /// By vertex: whether the normal points down, and is marked.
  std::vector<bool> turned(const ContactSurface &surface)
  {
    std::vector<bool> result;
    for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
      {
        result.push_back((surface.mesh.vertex_normals[v] - down).norm() < 1e-14);
        EXPECT_EQ(surface.has_partner_normal[v], result.back()) << surface.mesh.vertices[v];
      }
    return result;
  }
} // namespace



// With the face that rises from the edge: in its interior it touches nothing, and normals that bend from the
// one to the other over a face would measure the gap wrongly.
TEST(EdgeNormals, AreThoseOfWhatTheEdgesMeet)
{
  const ContactSurface other = floor();
  for (const PartnerSight &partner : {sight_of(plane(), 1.), sight_of(other)})
    for (const double height : {0., 5.})
      {
        ContactSurface surface = bottom(PI / 9., height);
        turn_edges(surface, partner);
        for (const bool is_turned : turned(surface))
          EXPECT_TRUE(is_turned) << height;
      }
}

// Rims of disc springs, one upon the other: along the normal of either face they would push each other aside.
TEST(EdgeNormals, EdgesOnEdgesHaveTheNormalBetweenTheirFaces)
{
  // With the wall at x = 0, a facet for each of its edges.
  const auto half = [](const bool faces_up, const unsigned int n, const double shift) {
    FlatSurfaces::Grid grid;
    grid.nx                = 4;
    grid.ny                = n;
    grid.faces_up          = faces_up;
    ContactSurface surface = FlatSurfaces::make_surface(grid);
    const double   wall    = faces_up ? -.1 : .1;
    for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
      if (const Point<3> &x = surface.mesh.vertices[v]; x[0] < 1e-10)
        for (const double side : {-.5, .5})
          if (const double y = x[1] + side / n; y > 0. && y < 1.)
            surface.beyond[v].push_back({Vector3({-1., 0., 0.}), Point<3>(0., y, wall) - x});
    tilt(surface, faces_up ? -PI / 18. : PI / 18., 0.);
    for (Point<3> &x : surface.mesh.vertices)
      x[0] += shift;
    return surface;
  };
  for (const unsigned int n : {4, 7})
    for (const double shift : {0., .005, .02, .2})
      {
        ContactSurface       surface = half(false, 4, 0.);
        const ContactSurface other   = half(true, n, -shift);
        turn_edges(surface, sight_of(other));
        const Vector3 met = -other.mesh.vertex_normals[0];
        for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
          if (surface.mesh.vertices[v][0] < 1e-10)
            {
              EXPECT_LT((surface.mesh.vertex_normals[v] - (shift < .01 ? down : met)).norm(), 1e-12)
                  << n << ' ' << shift << ' ' << surface.mesh.vertices[v];
            }
      }
}

TEST(EdgeNormals, FacesThatAreParallelKeepTheirs)
{
  const ContactSurface other = floor();
  for (const PartnerSight &partner : {sight_of(plane(), 1.), sight_of(other)})
    {
      ContactSurface surface = bottom(0., .1);
      turn_edges(surface, partner);
      for (const bool is_turned : surface.has_partner_normal)
        EXPECT_FALSE(is_turned);
    }
}

// The lowest edge lies in a symmetry plane: with the mirror image it is one of 40 or of 70 degrees. The
// others do not press.
TEST(EdgeNormals, EdgesInSymmetryPlanes)
{
  for (const bool is_sharp : {false, true})
    {
      ContactSurface surface = bottom(is_sharp ? PI * 35. / 180. : PI / 9., 0.);
      FlatSurfaces::fix(
          surface, [](const Point<3> &x) { return x[1] < 1e-10 || x[1] > 1. - 1e-10; }, FixedDirections(2));
      FlatSurfaces::fix(
          surface, [](const Point<3> &x) { return x[0] < 1e-10; }, FixedDirections(1));
      for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
        if (surface.mesh.vertices[v][0] < 1e-10)
          surface.beyond[v] = {{Vector3({-1., 0., 0.}), Vector3({0., 0., .1})}};
      turn_edges(surface, sight_of(plane(), 1.));
      for (const bool is_turned : surface.has_partner_normal)
        EXPECT_EQ(is_turned, is_sharp);
    }
}

// What goes on smoothly beyond the border of the surface has no edge there.
TEST(EdgeNormals, SeamsAreNoEdges)
{
  ContactSurface surface = bottom(PI / 9., 0.);
  for (auto &entry : surface.beyond)
    for (ContactSurface::Facet &facet : entry.second)
      facet.normal = surface.mesh.vertex_normals[entry.first];
  turn_edges(surface, sight_of(plane(), 1.));
  for (const bool is_turned : surface.has_partner_normal)
    EXPECT_FALSE(is_turned);
}

// A flat surface under a ball: the gap grows towards its edges.
TEST(EdgeNormals, EdgesFarFromTheContactKeepTheirs)
{
  FlatSurfaces::Grid grid;
  grid.nx = grid.ny      = 6;
  ContactSurface surface = FlatSurfaces::make_surface(grid);
  add_walls(surface, true);
  turn_edges(surface, sight_of(RigidObstacle::sphere(Point<3>(.4, .5, 1.), 1.), 1.));
  for (const bool is_turned : surface.has_partner_normal)
    EXPECT_FALSE(is_turned);
}

// A roller across a plate: at the ends of the plate there is a vertex nearest to it. Surfaces that touch
// inside have their normals there, too.
TEST(EdgeNormals, EndsOfALineOfContact)
{
  for (const unsigned int n : {10, 40})
    for (const double x : {.5, .52, .537, .55})
      {
        FlatSurfaces::Grid grid;
        grid.nx = grid.ny      = n;
        ContactSurface surface = FlatSurfaces::make_surface(grid);
        add_walls(surface, true);
        const RigidObstacle roller =
            RigidObstacle::cylinder(Point<3>(x, 0., 1.01), Vector3({0., 1., 0.}), 1.);
        turn_edges(surface, sight_of(roller, 1.));
        for (const bool is_turned : surface.has_partner_normal)
          EXPECT_FALSE(is_turned) << n << ' ' << x;
      }
}

// A cylinder that is tilted a little: around its lowest edge own and new normals turn away from each other,
// and the new ones go no farther than to half of the tilt.
TEST(EdgeNormals, SpreadOverCurvedFacesAsFarAsTheTiltMatters)
{
  FlatSurfaces::Grid grid;
  grid.nx                  = 256;
  grid.ny                  = 8;
  grid.faces_up            = false;
  ContactSurface   surface = FlatSurfaces::make_surface(grid);
  constexpr double tilt    = PI / 90.;
  for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
    {
      Point<3>  &x  = surface.mesh.vertices[v];
      const auto at = [&](const double r, const double y, const double z) {
        return Vector3({r, std::cos(tilt) * y - std::sin(tilt) * z, std::sin(tilt) * y + std::cos(tilt) * z});
      };
      const double angle = PI * (.05 + .9 * x[0]), y = x[1];
      if (y < 1e-10 || y > 1. - 1e-10)
        surface.beyond[v] = {
            {at(0., y < .5 ? -1. : 1., 0.), at(.1 * std::cos(angle), 0., .1 * std::sin(angle))}};
      surface.mesh.vertex_normals[v] = at(-std::cos(angle), 0., -std::sin(angle));
      x                              = Point<3>(at(-std::cos(angle), y, -std::sin(angle)));
    }
  const std::vector<Vector3> before = surface.mesh.vertex_normals;
  turn_edges(surface, sight_of(RigidObstacle::plane(Point<3>(0., 0., -1.5), Vector3({0., 0., 1.})), 1.));
  unsigned int n_turned = 0;
  for (unsigned int v = 0; v < before.size(); ++v)
    if (surface.has_partner_normal[v])
      {
        ++n_turned;
        EXPECT_LT((surface.mesh.vertex_normals[v] - before[v]).norm(), 1.6 * tilt);
      }
  EXPECT_GT(n_turned, 0u);
}

TEST(EdgeNormals, SharpEdgesBetweenFacesOfTheSurface)
{
  // Of 90 degrees, on a plane: one wall. In a corner as sharp: two.
  for (const bool in_corner : {false, true})
    {
      ContactSurface      surface = prism(PI / 4.);
      const RigidObstacle corner  = RigidObstacle::parse("function: z - abs(x)", "test");
      turn_edges(surface, sight_of(in_corner ? corner : plane(), 1.));
      unsigned int n_edge = 0;
      for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
        if (const Point<3> &x = surface.mesh.vertices[v]; std::abs(x[2]) < 1e-10 && x[1] > .1 && x[1] < .9)
          {
            ++n_edge;
            EXPECT_EQ(surface.has_partner_normal[v], !in_corner);
            EXPECT_LT((surface.mesh.vertex_normals[v] - down).norm(), 1e-14);
          }
      EXPECT_EQ(n_edge, 3u);
    }
}

// The lip of a seal on a shaft: facets of the other side bulge along the edge, by more than short cells rise
// across it.
TEST(EdgeNormals, LongPiecesOfAnEdgeOverFacets)
{
  ContactSurface surface = prism(PI / 4.);
  for (Point<3> &x : surface.mesh.vertices)
    x[1] *= 10.;
  turn_edges(surface, [](MetPartner &met, const Point<3> &place, const Vector3 &normal, double) {
    met.normal   = down;
    met.distance = (place[2] + .2 + .03 * std::sin(place[1])) / -normal[2];
    return true;
  });
  for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
    if (std::abs(surface.mesh.vertices[v][2]) < 1e-10)
      {
        EXPECT_TRUE(surface.has_partner_normal[v]) << surface.mesh.vertices[v];
      }
}

// A crease of less than 60 degrees has all normals between those of its sides: that of a plane before it, or
// that of the side which is nearest to it. A groove has its own.
TEST(EdgeNormals, CreasesHaveTheNormalBetweenTheirSides)
{
  for (const double half : {.1, .2, .35, -.1, -.2, -.35})
    for (const double tilted : {0., .05, -.15, .3, .5})
      {
        ContactSurface       surface = prism(half);
        const ContactSurface before  = surface;
        const RigidObstacle  below =
            RigidObstacle::plane(Point<3>(0., 0., -2.), Vector3({std::sin(tilted), 0., std::cos(tilted)}));
        turn_edges(surface, sight_of(below, 1.));
        const double  angle = half < 0. ? 0. : std::max(-half, std::min(half, tilted));
        const Vector3 expected({-std::sin(angle), 0., -std::cos(angle)});
        for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
          {
            const bool is_on_crease = std::abs(surface.mesh.vertices[v][0]) < 1e-10;
            EXPECT_LT((surface.mesh.vertex_normals[v] -
                       (is_on_crease ? expected : Vector3(before.mesh.vertex_normals[v])))
                          .norm(),
                      1e-12)
                << half << ' ' << tilted << ' ' << surface.mesh.vertices[v];
            EXPECT_EQ(surface.has_partner_normal[v], is_on_crease && half > 0.);
          }
      }
}

// Of the faces beside a groove one is along a plane before it; the other one looks elsewhere.
TEST(EdgeNormals, GroovesPressOnNothing)
{
  ContactSurface      surface = prism(-PI / 4.);
  const RigidObstacle below =
      RigidObstacle::plane(Point<3>(0., 0., -.5), Vector3({-std::sqrt(.5), 0., std::sqrt(.5)}));
  turn_edges(surface, sight_of(below, 1.));
  for (const bool is_turned : surface.has_partner_normal)
    EXPECT_FALSE(is_turned);
}

// The ends of a faceted half cylinder in a round one: its normals are right as they are.
TEST(EdgeNormals, FacetsDoNotTurnTheEndsOfAPin)
{
  FlatSurfaces::Grid grid;
  grid.nx                = 8;
  grid.ny                = 2;
  grid.faces_up          = false;
  ContactSurface surface = FlatSurfaces::make_surface(grid);
  for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
    {
      Point<3> &x = surface.mesh.vertices[v];
      if (x[1] < 1e-10 || x[1] > 1. - 1e-10)
        surface.beyond[v] = {{Vector3({0., x[1] < .5 ? -1. : 1., 0.}), Vector3({0., 0., .1})}};
      const double angle             = PI * x[0];
      surface.mesh.vertex_normals[v] = Vector3({-std::cos(angle), 0., -std::sin(angle)});
      x                              = Point<3>(-std::cos(angle), x[1], -std::sin(angle));
    }
  const RigidObstacle bore = RigidObstacle::parse("hollow cylinder: (0, 0, 0), (0, 1, 0), 1.01", "test");
  turn_edges(surface, sight_of(bore, 1.));
  for (const bool is_turned : surface.has_partner_normal)
    EXPECT_FALSE(is_turned);
}

// The other side ends over the faces beside the edge: vertices under which there is nothing go with these.
TEST(EdgeNormals, WhereTheOtherSideEnds)
{
  FlatSurfaces::Grid grid;
  grid.nx = grid.ny = 3;
  grid.y0           = .4;
  grid.x0           = -1.;
  grid.x1 = grid.y1            = 2.;
  const ContactSurface other   = FlatSurfaces::make_surface(grid);
  ContactSurface       surface = bottom(PI / 9., 0.);
  turn_edges(surface, sight_of(other));
  for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
    EXPECT_EQ(surface.has_partner_normal[v], surface.mesh.vertices[v][1] > .2) << surface.mesh.vertices[v];
}

// Sides that turn away, and what lies behind by more than a face is wide.
TEST(EdgeNormals, WhatIsNotFacedIsNotMet)
{
  const ContactSurface other = floor();
  for (const bool is_steep : {true, false})
    {
      ContactSurface surface = is_steep ? bottom(PI / 2.5, 0.) : bottom(PI / 9., -.4);
      turn_edges(surface, sight_of(other));
      for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
        if (is_steep || surface.mesh.vertices[v][2] < -.39)
          {
            EXPECT_FALSE(surface.has_partner_normal[v]) << surface.mesh.vertices[v];
          }
    }
}

namespace
{
  /// The lower half of a cylinder of radius 1 along y, with a face that is cut in four beside hanging
  /// vertices.
  ContactSurface half_cylinder()
  {
    FlatSurfaces::Grid grid;
    grid.nx       = 11;
    grid.ny       = 3;
    grid.faces_up = false;
    // From 16 to 33 and from 82 to 98 degrees.
    grid.refined           = {{1, 1}, {5, 1}};
    ContactSurface surface = FlatSurfaces::make_surface(grid);
    for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
      {
        Point<3>    &x                 = surface.mesh.vertices[v];
        const double angle             = PI * x[0];
        surface.mesh.vertex_normals[v] = Vector3({-std::cos(angle), 0., -std::sin(angle)});
        x                              = Point<3>(-std::cos(angle), x[1], -std::sin(angle));
      }
    return surface;
  }
} // namespace

// All that looks towards the plane has its normal, the rest its own; also towards a plane that is inclined.
TEST(FacePlane, WhatLooksTowardsIt)
{
  for (const double angle : {0., .3})
    {
      const Vector3        normal({std::sin(angle), 0., std::cos(angle)});
      const ContactSurface before  = half_cylinder();
      ContactSurface       surface = before;
      face_plane(surface, normal);
      unsigned int n_turned = 0;
      for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
        if (surface.hanging[v].empty())
          {
            const Vector3 &own   = before.mesh.vertex_normals[v];
            const bool     looks = -normal * own >= .5;
            n_turned += looks ? 1 : 0;
            EXPECT_EQ(surface.has_partner_normal[v], looks) << surface.mesh.vertices[v];
            EXPECT_LT((surface.mesh.vertex_normals[v] - (looks ? -normal : own)).norm(), 1e-14)
                << surface.mesh.vertices[v];
          }
      EXPECT_GT(n_turned, 30u);
      EXPECT_LT(n_turned, surface.mesh.vertices.size() - 10);
    }
}

// Hanging vertices have the mean of their parents, and are marked where both are.
TEST(FacePlane, HangingVertices)
{
  const ContactSurface before  = half_cylinder();
  ContactSurface       surface = before;
  const Vector3        normal({0., 0., 1.});
  face_plane(surface, normal);
  unsigned int n_marked = 0, n_mixed = 0;
  for (unsigned int v = 0; v < surface.hanging.size(); ++v)
    if (!surface.hanging[v].empty())
      {
        unsigned int n_turned = 0;
        Vector3      mean;
        for (const auto &[parent, weight] : surface.hanging[v])
          {
            n_turned += surface.has_partner_normal[parent] ? 1 : 0;
            mean += weight * surface.mesh.vertex_normals[parent];
          }
        const bool all = n_turned == surface.hanging[v].size();
        n_marked += all ? 1 : 0;
        n_mixed += n_turned > 0 && !all ? 1 : 0;
        EXPECT_EQ(surface.has_partner_normal[v], all);
        const Vector3 expected = n_turned > 0 ? mean / mean.norm() : before.mesh.vertex_normals[v];
        EXPECT_LT((surface.mesh.vertex_normals[v] - expected).norm(), 1e-14);
      }
  EXPECT_GT(n_marked, 0u);
  EXPECT_GT(n_mixed, 0u);
}

// What edges have met before stays marked.
TEST(FacePlane, KeepsWhatEdgesHaveMet)
{
  ContactSurface surface = half_cylinder();
  surface.has_partner_normal.assign(surface.mesh.vertices.size(), false);
  const Vector3 own             = surface.mesh.vertex_normals[0];
  surface.has_partner_normal[0] = true;
  face_plane(surface, Vector3({0., 0., 1.}));
  EXPECT_TRUE(surface.has_partner_normal[0]);
  EXPECT_EQ(surface.mesh.vertex_normals[0], own);
}
