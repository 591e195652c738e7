// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_surface_vertex_quadric_h
#define signorini_source_surface_vertex_quadric_h

#include <deal.II/base/tensor.h>

#include <cmath>
#include <vector>

namespace Signorini
{
  /// A quadratic surface through a vertex: z = (c u² + 2 d u v + e v² + k z²) / 2 in a frame whose third
  /// axis is the normal there. With the larger principal curvature for k these are spheres and cylinders,
  /// exactly.
  struct Quadric
  {
    dealii::Tensor<1, 3> u, v, normal;
    double               c = 0., d = 0., e = 0.;
    /// Root mean square of what the fit leaves over that of the heights of the neighbours.
    double residual = 0.;
    /// The former as a curvature (1/length): where the surface is nearly flat the ratio says little.
    double left_over = 0.;
    /// How many more points than unknowns there were.
    unsigned int n_checks = 0;

    /// The principal curvature of larger magnitude.
    double largest_curvature() const
    {
      const double mean = .5 * (c + e), difference = std::hypot(.5 * (c - e), d);
      return mean < 0. ? mean - difference : mean + difference;
    }

    /// The bilinear form of two vectors from the vertex.
    double form(const dealii::Tensor<1, 3> &x, const dealii::Tensor<1, 3> &y) const
    {
      const double s = x * u, t = x * v;
      return s * (c * (y * u) + d * (y * v)) + t * (d * (y * u) + e * (y * v)) +
             largest_curvature() * (x * normal) * (y * normal);
    }

    /// The quadratic form of a vector from the vertex.
    double along(const dealii::Tensor<1, 3> &x) const
    {
      return form(x, x);
    }

    /// The quadratic form with the magnitudes of the principal curvatures.
    double magnitude_along(const dealii::Tensor<1, 3> &x) const
    {
      const double mean = .5 * (c + e), difference = std::hypot(.5 * (c - e), d), s = x * u, t = x * v,
                   square = .5 * (s * s + t * t);
      // With the share of the difference of curvatures that x sees.
      const double seen =
          difference > 0. ? (.5 * (c - e) * (s * s - t * t) * .5 + d * s * t) / difference : 0.;
      return std::abs(mean + difference) * (square + seen) + std::abs(mean - difference) * (square - seen);
    }

    /// Its unit normal where it comes nearest to the place with this vector from the vertex.
    dealii::Tensor<1, 3> normal_at(const dealii::Tensor<1, 3> &x) const
    {
      const double               s = x * u, t = x * v, k = largest_curvature() * (x * normal);
      const dealii::Tensor<1, 3> gradient = (1. - k) * normal - (c * s + d * t) * u - (d * s + e * t) * v;
      return gradient.norm() > 0. ? gradient / gradient.norm() : normal;
    }
  };

  /// With any axes across a normal of any length.
  void set_frame(Quadric &q, const dealii::Tensor<1, 3> &normal);

  /// Turns the frame to another normal by as little as possible: coefficients keep their meaning.
  void turn_frame(Quadric &q, const dealii::Tensor<1, 3> &normal);

  /// Fits a quadratic surface to the vectors from a vertex to its neighbours, with weights 1/distance², and
  /// turns the frame to the normal found until it rests. Returns false if they do not determine one.
  bool fit(Quadric &q, const std::vector<dealii::Tensor<1, 3>> &neighbours);

  /// The same with terms of third degree beside, from the quadratic surface that has been fitted: what the
  /// curvature changes by is not taken for a slope.
  bool fit_cubic(Quadric &q, const std::vector<dealii::Tensor<1, 3>> &neighbours);

  /// Vectors without their parts along an axis, each place once and that of the vertex not.
  std::vector<dealii::Tensor<1, 3>> places_across(const std::vector<dealii::Tensor<1, 3>> &neighbours,
                                                  const dealii::Tensor<1, 3>              &axis);

  /// fit() for points of a surface that is straight along an axis: no curvature along it, and a normal across
  /// it, whatever the points leave open; with terms of third degree across from four places on.
  bool fit_extruded(Quadric &q, const std::vector<dealii::Tensor<1, 3>> &neighbours,
                    const dealii::Tensor<1, 3> &axis);

  /// The sphere through a vertex that comes nearest to its neighbours, weighted in the same way: it needs
  /// fewer. Returns false if they do not determine one.
  bool fit_sphere(Quadric &q, const std::vector<dealii::Tensor<1, 3>> &neighbours);
} // namespace Signorini

#endif
