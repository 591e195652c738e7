// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Creases: roofs in grooves. The normal field turns across the crease of the mortar side.

#include "surfaces.h"

#include <signorini/surface/mapping_quality.h>

using namespace TestSurfaces;
using dealii::Tensor;

namespace
{
  /// Two planes that meet in a crease along x at z = height.
  struct Roof
  {
    /// Angle between the planes, inside of a roof and outside of a groove (degrees).
    double opening;
    /// Whether normals point up: a roof; else a groove over one.
    bool up;
    /// Squares across each plane, and along the crease.
    unsigned int n, m;
    double       extent = 1., shift = 0., height = 0., jitter = 0.;
    unsigned int seed = 0;

    SurfaceMesh mesh() const
    {
      FlatGrid     grid = flat_grid(2 * n, m, jitter, seed);
      const double half = .5 * opening * dealii::numbers::PI / 180.;
      // Vertices of the crease stay on it.
      for (unsigned int j = 0; j <= m; ++j)
        grid.vertices[j * (2 * n + 1) + n][0] = .5;
      return in_space(
          grid,
          [&](const double u, const double v) {
            const double way = extent * (2. * u - 1.);
            return Point<3>(.5 + extent * (v - .5), shift + way * std::sin(half),
                            height - std::abs(way) * std::cos(half));
          },
          up);
    }
  };

  /// Turned about an oblique axis, then scaled.
  SurfaceMesh moved(SurfaceMesh mesh, const double angle, const double scale)
  {
    Tensor<1, 3> axis = Point<3>(1., 2., 3.);
    axis /= axis.norm();
    for (Point<3> &p : mesh.vertices)
      {
        const Tensor<1, 3> x = p;
        p = Point<3>(scale * (std::cos(angle) * x + std::sin(angle) * cross_product_3d(axis, x) +
                              (1. - std::cos(angle)) * (axis * x) * axis));
      }
    mesh.compute_vertex_normals();
    return mesh;
  }

  void expect_exact(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar, const std::string &where)
  {
    const ContactMapping mapping(nonmortar, mortar);
    EXPECT_EQ(violated_invariant(nonmortar, mortar, mapping, true), "") << where;
    EXPECT_EQ(describe_errors(mapping.report()), "") << where;
    EXPECT_EQ(mapping.report().n_flips, 0u) << where;
  }

  /// A roof in a groove that is larger, and the other way round, moved.
  void expect_exact_pairs(Roof roof, Roof groove)
  {
    roof.up   = true;
    groove.up = false;
    std::ostringstream where;
    where << "roof " << roof.opening << " groove " << groove.opening << " height " << groove.height
          << " shift " << groove.shift << " jitter " << roof.jitter << " squares " << groove.n;
    for (const bool roof_is_nonmortar : {true, false})
      {
        roof.extent           = roof_is_nonmortar ? 1. : 1.3;
        groove.extent         = roof_is_nonmortar ? 1.3 : 1.;
        const SurfaceMesh low = roof.mesh(), high = groove.mesh();
        for (const auto &[angle, scale] :
             {std::pair<double, double>{0., 1.}, {.7, 1.}, {2.1, 1e-6}, {4., 1e6}})
          {
            const SurfaceMesh a = moved(low, angle, scale), b = moved(high, angle, scale);
            expect_exact(roof_is_nonmortar ? a : b, roof_is_nonmortar ? b : a,
                         where.str() + (roof_is_nonmortar ? " roof" : " groove") + " nonmortar, turned by " +
                             std::to_string(angle));
          }
      }
  }
} // namespace



// With and without matching meshes, with normals at the crease that do not halve its angle.
TEST(Creases, RoofInAGroove)
{
  for (const double opening : {60., 90., 120., 150.})
    for (const double height : {0., .01, .02})
      for (const double jitter : {0., .2})
        for (const unsigned int n : {8u, 7u})
          expect_exact_pairs({opening, true, 8, 16, 1., 0., 0., jitter, 1},
                             {opening, false, n, n == 8 ? 16u : 13u, 1., 0., height, jitter, 2});
}



// The crease of the one side lies over the middle of a plane of the other.
TEST(Creases, ShiftedRoof)
{
  for (const double opening : {60., 90., 120.})
    for (const double shift : {1e-12, 1e-9, 1e-6, .003, -.003})
      expect_exact_pairs({opening, true, 8, 16, 1., 0., 0., .2, 1},
                         {opening, false, 7, 13, 1., shift, .01, .2, 2});
}



TEST(Creases, RoofThatIsSteeperThanItsGroove)
{
  for (const double opening : {60., 90., 120.})
    for (const double difference : {1e-7, 1., 3.})
      expect_exact_pairs({opening, true, 8, 16, 1., 0., 0., .2, 1},
                         {opening + difference, false, 7, 13, 1., 0., .003, .2, 2});
}
