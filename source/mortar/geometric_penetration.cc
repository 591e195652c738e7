// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mortar/face_map.h>
#include <signorini/mortar/geometric_penetration.h>

#include <deal.II/base/mpi.h>

#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr double                half = .5, third = 1. / 3.;
    constexpr std::array<double, 3> samples[7] = {
        {{1., 0., 0.}},     {{0., 1., 0.}},     {{0., 0., 1.}},         {{half, half, 0.}},
        {{0., half, half}}, {{half, 0., half}}, {{third, third, third}}};

    /// Barycentric coordinates in a surface triangle of a point given in an overlay triangle.
    std::array<double, 3> compose(const std::array<std::array<double, 3>, 3> &corners,
                                  const std::array<double, 3>                &weights)
    {
      std::array<double, 3> result = {{0., 0., 0.}};
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int i = 0; i < 3; ++i)
          result[i] += weights[c] * corners[c][i];
      return result;
    }

    /// One surface with its displacement, evaluated in a triangle.
    class DisplacedSurface
    {
    public:
      DisplacedSurface(const ContactSurface &surface, const std::vector<Vector3> &displacement)
        : surface(surface)
        , displacement(displacement)
      {
        AssertDimension(displacement.size(), surface.vertex_node.size());
        faces.reserve(surface.faces.size());
        for (unsigned int f = 0; f < surface.faces.size(); ++f)
          faces.emplace_back(surface, f);
      }

      Point<3> point(const unsigned int triangle, const std::array<double, 3> &weights) const
      {
        const auto &t = surface.mesh.triangles[triangle];
        const auto &x = surface.mesh.vertices;
        return Point<3>(weights[0] * x[t[0]] + weights[1] * x[t[1]] + weights[2] * x[t[2]]);
      }

      Vector3 normal(const unsigned int triangle, const std::array<double, 3> &weights) const
      {
        const auto   &t    = surface.mesh.triangles[triangle];
        const auto   &n    = surface.mesh.vertex_normals;
        const Vector3 sum  = weights[0] * n[t[0]] + weights[1] * n[t[1]] + weights[2] * n[t[2]];
        const double  norm = sum.norm();
        return norm > 0. ? sum / norm : sum;
      }

      Vector3 displacement_at(const unsigned int triangle, const Point<3> &p) const
      {
        const unsigned int f = surface.triangle_face[triangle];
        double             s = .5, t = .5;
        faces[f].invert(s, t, p);
        const auto phi = faces[f].shape(s, t);
        Vector3    u;
        for (unsigned int a = 0; a < 4; ++a)
          u += phi[a] * displacement[surface.faces[f].corners[a]];
        return u;
      }

    private:
      const ContactSurface       &surface;
      const std::vector<Vector3> &displacement;
      std::vector<FaceMap>        faces;
    };
  } // namespace



  GeometricPenetration sample_geometric_penetration(const ContactSurface               &nonmortar,
                                                    const ContactSurface               &mortar,
                                                    const std::vector<OverlayTriangle> &overlay,
                                                    const std::vector<Vector3> &displacement_nonmortar,
                                                    const std::vector<Vector3> &displacement_mortar,
                                                    const GapFunction          &prescribed_gap,
                                                    const MPI_Comm              communicator)
  {
    const DisplacedSurface non(nonmortar, displacement_nonmortar), mor(mortar, displacement_mortar);
    double                 min_initial = std::numeric_limits<double>::infinity(), min_gap = min_initial;
    for (const OverlayTriangle &cell : overlay)
      for (const std::array<double, 3> &sample : samples)
        {
          const auto weights = compose(cell.nonmortar, sample), image_weights = compose(cell.mortar, sample);
          const Point<3> x        = non.point(cell.nonmortar_triangle, weights);
          const Point<3> image    = mor.point(cell.mortar_triangle, image_weights);
          const Vector3  n        = non.normal(cell.nonmortar_triangle, weights);
          const Vector3  relative = non.displacement_at(cell.nonmortar_triangle, x) -
                                   mor.displacement_at(cell.mortar_triangle, image);
          const double initial = prescribed_gap ? prescribed_gap(x) : (image - x) * n;
          min_initial          = std::min(min_initial, initial);
          min_gap              = std::min(min_gap, initial - n * relative);
        }
    return {Utilities::MPI::min(min_initial, communicator), Utilities::MPI::min(min_gap, communicator)};
  }
} // namespace Signorini
