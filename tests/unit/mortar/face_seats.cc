// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "flat_surfaces.h"

#include <signorini/mesh/boundary_shape.h>
#include <signorini/mortar/face_seats.h>

#include <gtest/gtest.h>

using namespace Signorini;
using namespace FlatSurfaces;
using namespace dealii;

namespace
{
  /// Five faces of width 1 from x = -2.5 to 2.5, facing up.
  ContactSurface make_plate()
  {
    return make_surface({5, 1, -2.5, 2.5});
  }

  /// Facing down over the plate, at heights that depend on x alone.
  ContactSurface make_upper(const unsigned int n, const double x0, const double x1,
                            const std::function<double(double)> &height)
  {
    Grid grid{n, 1, x0, x1};
    grid.faces_up          = false;
    grid.first_node        = 100;
    ContactSurface surface = make_surface(grid);
    for (Point<3> &x : surface.mesh.vertices)
      x[2] = height(x[0]);
    return surface;
  }

  /// Rows of the plate, with flanks left.
  PairCoupling couple_seated(ContactSurface &plate, const ContactSurface &upper)
  {
    const SeatedOverlay seated  = without_flanks(plate, upper, make_overlay(plate, upper));
    auto                moments = compute_face_moments(plate, upper, seated.overlay, {}, MPI_COMM_SELF);
    for (FaceMoments &m : moments)
      m.lie = seated.lies[m.face];
    leave_flanks(plate, SurfaceHalo(plate, MPI_COMM_SELF), moments);
    return couple(plate, upper, moments, {}, false, {});
  }

  std::map<double, double> gaps_by_x(const PairCoupling &pair)
  {
    std::map<double, double> gaps;
    for (std::size_t row = 0; row < pair.gaps.size(); ++row)
      gaps[pair.positions[row][0]] = pair.gaps[row];
    return gaps;
  }
} // namespace



// A sole of width 2.6 with chamfers of 45 degrees stands on the plate. The nodes beside its edges, which lie
// under the chamfers, touch the sole; behind them there is the chamfer.
TEST(FaceSeats, SoleWithChamfers)
{
  const ContactSurface upper =
      make_upper(46, -2.3, 2.3, [](const double x) { return std::max(0., std::abs(x) - 1.3); });
  ContactSurface plate = make_plate();
  const auto     gaps  = gaps_by_x(couple_seated(plate, upper));
  ASSERT_EQ(gaps.size(), 6u);
  for (const auto &[x, gap] : gaps)
    if (std::abs(x) < 2.)
      EXPECT_NEAR(gap, 0., 1e-12) << x;
    else
      EXPECT_GT(gap, .3) << x;
  ContactSurface whole = make_plate();
  const auto     mixed = gaps_by_x(
          couple(whole, upper, compute_face_moments(whole, upper, make_overlay(whole, upper), {}, MPI_COMM_SELF),
                 {}, false, {}));
  EXPECT_GT(mixed.at(1.5), .01);
}



// The same where both are known to be round, on a seat of two fifths of a face.
TEST(FaceSeats, RoundSoleWithChamfers)
{
  const double         width = .9, radius = 5.;
  const Point<3>       axis(0., 0., radius);
  const auto           round  = [&](const double x) { return radius - std::sqrt(radius * radius - x * x); };
  const ContactSurface facets = make_upper(36, -1.8, 1.8, [&](const double x) {
    return round(std::min(std::abs(x), width)) + std::max(0., std::abs(x) - width);
  });
  const BoundaryShapePointer shape = make_cylinder_shape(axis, Point<3>(0., 1., 0.), radius);
  std::vector<unsigned int>  of_triangle;
  for (const auto &corners : facets.mesh.triangles)
    {
      double farthest = 0.;
      for (const unsigned int v : corners)
        farthest = std::max(farthest, std::abs(facets.mesh.vertices[v][0]));
      of_triangle.push_back(farthest > width + 1e-9 ? TrueShape::no_shape : 0);
    }
  ContactSurface upper = facets, plate = make_plate();
  upper.true_shape = TrueShape(upper.mesh, {shape}, of_triangle, true);
  for (Point<3> &x : plate.mesh.vertices)
    x[2] = round(x[0]);
  plate.true_shape =
      TrueShape(plate.mesh, {shape}, std::vector<unsigned int>(plate.mesh.triangles.size(), 0), true);
  const PairCoupling pair = couple_seated(plate, upper);
  // And of the last faces, which have no seat, what lies over them from 1.5 to 1.8.
  EXPECT_NEAR(pair.covered_area, 2. * (width + .3), .1);
  // Of the nodes at 1.5 the seat covers too little.
  for (const auto &[x, gap] : gaps_by_x(pair))
    if (std::abs(x) < 2.)
      {
        EXPECT_NEAR(gap, 0., .02) << x;
      }
}



// A wedge that stands on the plate with its edge alone has no seat.
TEST(FaceSeats, KeepsWedges)
{
  for (const double x0 : {0., .2, .45, .5})
    {
      ContactSurface       plate = make_plate(), same = plate;
      const ContactSurface upper =
          make_upper(40, -2. + x0, 2. + x0, [&](const double x) { return std::abs(x - x0); });
      const auto overlay = make_overlay(plate, upper);
      EXPECT_EQ(without_flanks(plate, upper, overlay).overlay.size(), overlay.size()) << x0;
      couple_seated(plate, upper);
      for (std::size_t f = 0; f < plate.faces.size(); ++f)
        EXPECT_EQ(plate.faces[f].left_corners, 0) << x0;
    }
}



// Nothing of a roller is a flank, wherever it stands on the faces, and however wide these are for it, with
// its true shape or without.
TEST(FaceSeats, KeepsRollers)
{
  for (const double radius : {2.3, 4., 10., 30., 50., 100.})
    for (const unsigned int n : {6u, 17u, 80u})
      for (double x0 = -.5; x0 < .51; x0 += .1)
        for (const bool is_round : {false, true})
          {
            const double   width = std::min(2.2, .9 * radius);
            ContactSurface plate = make_plate();
            ContactSurface upper = make_upper(n, x0 - width, x0 + width, [&](const double x) {
              return radius - std::sqrt(radius * radius - (x - x0) * (x - x0));
            });
            if (is_round)
              upper.true_shape = TrueShape(
                  upper.mesh, {make_cylinder_shape(Point<3>(x0, 0., radius), Point<3>(0., 1., 0.), radius)},
                  std::vector<unsigned int>(upper.mesh.triangles.size(), 0), true);
            const auto overlay = make_overlay(plate, upper);
            EXPECT_EQ(without_flanks(plate, upper, overlay).overlay.size(), overlay.size())
                << radius << ", " << n << ", " << x0 << ", " << is_round;
            couple_seated(plate, upper);
            for (const ContactSurface::Face &face : plate.faces)
              EXPECT_EQ(face.left_corners, 0) << radius << ", " << n << ", " << x0 << ", " << is_round;
          }
}



// Facets of round surfaces that fit into each other lie at all angles up to those of their chords.
TEST(FaceSeats, KeepsFacetsInFits)
{
  const auto round = [](const double x) { return 5. - std::sqrt(25. - x * x); };
  for (const unsigned int n : {4u, 6u, 7u, 9u})
    {
      ContactSurface plate = make_plate();
      for (Point<3> &x : plate.mesh.vertices)
        x[2] = round(x[0]);
      const ContactSurface upper   = make_upper(n, -2.4, 2.4, round);
      const auto           overlay = make_overlay(plate, upper);
      EXPECT_EQ(without_flanks(plate, upper, overlay).overlay.size(), overlay.size()) << n;
      couple_seated(plate, upper);
      for (const ContactSurface::Face &face : plate.faces)
        EXPECT_EQ(face.left_corners, 0) << n;
    }
}
