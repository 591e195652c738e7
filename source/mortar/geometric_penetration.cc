// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mortar/geometric_penetration.h>
#include <signorini/mortar/surface_values.h>

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
  } // namespace



  GeometricPenetration sample_geometric_penetration(const ContactSurface               &nonmortar,
                                                    const ContactSurface               &mortar,
                                                    const std::vector<OverlayTriangle> &overlay,
                                                    const std::vector<Vector3> &displacement_nonmortar,
                                                    const std::vector<Vector3> &displacement_mortar,
                                                    const GapFunction          &prescribed_gap,
                                                    const MPI_Comm              communicator)
  {
    const SurfaceValues non(nonmortar), mor(mortar);
    double              min_initial = std::numeric_limits<double>::infinity(), min_gap = min_initial;
    for (const OverlayTriangle &cell : overlay)
      for (const std::array<double, 3> &sample : samples)
        {
          const auto weights = compose(cell.nonmortar, sample), image_weights = compose(cell.mortar, sample);
          const Point<3> x        = non.point(cell.nonmortar_triangle, weights);
          const Point<3> image    = mor.point(cell.mortar_triangle, image_weights);
          const Vector3  n        = non.normal(cell.nonmortar_triangle, weights);
          const Vector3  relative = non.value(displacement_nonmortar, cell.nonmortar_triangle, x) -
                                   mor.value(displacement_mortar, cell.mortar_triangle, image);
          const double initial =
              prescribed_gap ? prescribed_gap(x) : initial_gap(nonmortar, mortar, cell, sample, x, image) * n;
          min_initial = std::min(min_initial, initial);
          min_gap     = std::min(min_gap, initial - n * relative);
        }
    return {Utilities::MPI::min(min_initial, communicator), Utilities::MPI::min(min_gap, communicator)};
  }
} // namespace Signorini
