// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mortar/face_map.h>

#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Corners of the parallelogram that a triangle is half of, or those of a quadrilateral.
    std::array<Point<3>, 4> face_corners(const ContactSurface &surface, const unsigned int face)
    {
      std::array<Point<3>, 4> x;
      const auto             &f = surface.faces[face];
      for (unsigned int v = 0; v < 4; ++v)
        x[v] = surface.mesh.vertices[f.corners[v]];
      if (f.n_corners == 3)
        {
          x[3] = x[2];
          x[2] = x[1] + (x[3] - x[0]);
        }
      return x;
    }
  } // namespace



  FaceMap::FaceMap(const ContactSurface &surface, const unsigned int face)
    : FaceMap(face_corners(surface, face))
  {
    if (surface.faces[face].n_corners == 3)
      triangle = parallelogram = planar = true;
  }



  FaceMap::FaceMap(const std::array<Point<3>, 4> &corners)
    : origin(corners[0])
    , edge_s(corners[1] - corners[0])
    , edge_t(corners[3] - corners[0])
    , twist((corners[0] - corners[1]) + (corners[2] - corners[3]))
  {
    const double diagonals = corners[0].distance(corners[2]) + corners[1].distance(corners[3]);
    parallelogram          = twist.norm() <= 1e-12 * diagonals;
    planar = std::abs(cross_product_3d(edge_s, edge_t) * twist) <= 1e-12 * diagonals * diagonals * diagonals;
    const double a = edge_s * edge_s, b = edge_s * edge_t, c = edge_t * edge_t, det = a * c - b * b;
    if (det > 0.)
      {
        dual_s = (c * edge_s - b * edge_t) / det;
        dual_t = (a * edge_t - b * edge_s) / det;
      }
  }



  bool FaceMap::invert_affine(double &s, double &t, const Tensor<1, 3> &from_origin) const
  {
    s = dual_s * from_origin;
    t = dual_t * from_origin;
    return dual_s.norm_square() > 0.;
  }



  bool FaceMap::invert(double &s, double &t, const Point<3> &p) const
  {
    const Tensor<1, 3> target = p - origin;
    if (parallelogram)
      return invert_affine(s, t, target);
    // Gauss-Newton: converges quadratically on planar faces, linearly with a small factor on warped ones.
    const double tolerance = planar ? 1e-8 : 1e-14;
    double       last      = std::numeric_limits<double>::max();
    for (unsigned int iteration = 0; iteration < 40; ++iteration)
      {
        const Tensor<1, 3> ds = edge_s + t * twist, dt = edge_t + s * twist;
        const Tensor<1, 3> r = target - s * ds - t * edge_t;
        const double       a = ds * ds, b = ds * dt, c = dt * dt, det = a * c - b * b;
        if (!(det > 0.))
          return false;
        const double fs = r * ds, ft = r * dt;
        double       step_s = (c * fs - b * ft) / det, step_t = (a * ft - b * fs) / det;
        const double step = std::abs(step_s) + std::abs(step_t);
        // Far steps leave the region where the linearization means something.
        const double damping = step > 1. ? 1. / step : 1.;
        s += damping * step_s;
        t += damping * step_t;
        if (step < tolerance || (step < 1e-10 && step > .5 * last))
          return true;
        last = step;
      }
    return false;
  }
} // namespace Signorini
