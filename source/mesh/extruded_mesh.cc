// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "extruded_mesh.h"

#include <signorini/algebra/input_error.h>

#include <deal.II/base/numbers.h>

namespace Signorini
{
  using namespace dealii;

  bool kind_has(const GeneratedMeshParameters &p, const char *word)
  {
    return p.kind.find(word) != std::string::npos;
  }



  std::function<double(const Point<3> &)> coordinate_plane(const unsigned int axis, const double value)
  {
    return [axis, value](const Point<3> &p) { return p[axis] - value; };
  }



  void require_positive(const double value, const std::string &name)
  {
    if (!(value > 0.) || !std::isfinite(value))
      throw InputError(name + " must be positive.");
  }



  namespace
  {
    using Quadrilateral = std::array<Point<2>, 4>;
    using Places        = std::vector<double>;

    unsigned int cells_of_width(const double length, const double width)
    {
      return std::max(1u, static_cast<unsigned int>(std::lround(length / width)));
    }

    /// The quadrilaterals of a patch (s, t) -> point with s and t in [0,1]; the map must be right-handed.
    void add_patch(std::vector<Quadrilateral> &figure, const Places &s, const Places &t,
                   const std::function<Point<2>(double, double)> &point)
    {
      for (std::size_t j = 0; j + 1 < t.size(); ++j)
        for (std::size_t i = 0; i + 1 < s.size(); ++i)
          figure.push_back(
              {{point(s[i], t[j]), point(s[i + 1], t[j]), point(s[i], t[j + 1]), point(s[i + 1], t[j + 1])}});
    }

    /// Grading of one of the directions of a figure.
    class Grading
    {
    public:
      explicit Grading(const GeneratedMeshParameters &p)
        : p(p)
      {
        if (!(p.grading.ratio >= 1. && p.grading.ratio <= 1e4))
          throw InputError("Grading: the ratio of the largest and the smallest cells must be between 1 and "
                           "10000.");
      }

      /// Places along a direction between two boundaries.
      /// @param at where the point that the mesh is fine at lies in this direction
      Places places(const unsigned int n, const char *low, const char *high, const double at) const
      {
        const bool is_low = p.grading.boundary == low, is_high = p.grading.boundary == high;
        known               = known || is_low || is_high;
        const double centre = is_low ? 0. : is_high ? 1. : std::clamp(at, 0., 1.);
        const bool   wanted = is_low || is_high || (p.grading.boundary.empty() && std::isfinite(at));
        return graded_places(n, wanted ? centre : 0., wanted ? p.grading.ratio : 1.);
      }

      /// Errors: InputError if no direction had the boundary that was asked for.
      void check() const
      {
        if (!p.grading.boundary.empty() && !known)
          throw InputError("Grading: a " + p.kind + " cannot be graded toward \"" + p.grading.boundary +
                           "\".");
      }

      const Point<3> &point() const
      {
        return p.grading.point;
      }

    private:
      const GeneratedMeshParameters &p;
      mutable bool                   known = false;
    };

    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

    std::function<double(const Point<3> &)> cylinder(const double radius)
    {
      return [radius](const Point<3> &p) { return std::hypot(p[0], p[1]) - radius; };
    }

    /// Draws a figure out along z, with the boundaries "start" and "end".
    ShapedCells draw_out(const std::vector<Quadrilateral> &figure, const GeneratedMeshParameters &p,
                         const unsigned int n, const Grading &grading)
    {
      ShapedCells  result;
      const Places z = grading.places(n, "start", "end", grading.point()[2] / p.height);
      grading.check();
      for (std::size_t k = 0; k < n; ++k)
        for (const Quadrilateral &q : figure)
          {
            result.cells.emplace_back();
            for (unsigned int v = 0; v < 8; ++v)
              result.cells.back()[v] = Point<3>(q[v % 4][0], q[v % 4][1], p.height * z[k + v / 4]);
          }
      result.boundaries = {{"start", coordinate_plane(2, 0.)}, {"end", coordinate_plane(2, p.height)}};
      return result;
    }

    /// What a tube is cut off by: whole, y >= 0, or x, y >= 0.
    double angle_of_tube(const GeneratedMeshParameters &p)
    {
      return numbers::PI * (kind_has(p, "quarter") ? .5 : kind_has(p, "half") ? 1. : 2.);
    }

    ShapedCells tube(const GeneratedMeshParameters &p)
    {
      require_positive(p.inner_radius, "Inner radius");
      require_positive(p.radius - p.inner_radius, "Radius minus Inner radius");
      require_positive(p.height, "Height");
      const double angle = angle_of_tube(p), wall = p.radius - p.inner_radius,
                   middle          = .5 * (p.radius + p.inner_radius);
      auto [radial, around, along] = p.round_divisions;
      if (around == 0)
        around = cells_of_width(angle, numbers::PI / 6.);
      if (angle > 6. && around < 3)
        throw InputError("Round divisions: a whole ring needs three cells around at least.");
      const double width = middle * angle / around;
      if (radial == 0)
        radial = cells_of_width(wall, width);
      if (along == 0)
        along = kind_has(p, "annulus") ? 1 : cells_of_width(p.height, width);
      const Grading   grading(p);
      const Point<3> &x   = grading.point();
      double          phi = std::atan2(x[1], x[0]);
      if (phi < 0.)
        phi += 2. * numbers::PI;
      // A whole ring has no end that it could be graded from.
      const Places r = grading.places(radial, "inner", "outer",
                                      (std::hypot(x[0], x[1]) - p.inner_radius) / wall),
                   a = grading.places(around, "symmetry y", "symmetry x", angle > 6. ? nowhere : phi / angle);
      std::vector<Quadrilateral> figure;
      add_patch(figure, r, a, [&](const double s, const double t) {
        const double radius = p.inner_radius + s * wall;
        // The end of a whole ring is its beginning.
        const double at = angle > 6. && t == 1. ? 0. : t * angle;
        return Point<2>(radius * std::cos(at), radius * std::sin(at));
      });
      ShapedCells result = draw_out(figure, p, along, grading);
      result.size        = p.radius;
      result.curved      = {{"outer", CurvedBoundary::cylinder}, {"inner", CurvedBoundary::cylinder}};
      result.boundaries.emplace_back("outer", cylinder(p.radius));
      result.boundaries.emplace_back("inner", cylinder(p.inner_radius));
      result.boundaries.emplace_back("symmetry y", coordinate_plane(1, 0.));
      result.boundaries.emplace_back("symmetry x", coordinate_plane(0, 0.));
      return result;
    }

    /// The quarter x >= 0, y <= 0 of a disk: a core and two patches around it.
    std::vector<Quadrilateral> quarter_disk(const double radius, const unsigned int n_radial,
                                            const unsigned int n_around, const Grading &grading)
    {
      const Point<3> &x = grading.point();
      // Of the two halves of the arc, from the lowest point on.
      const double at     = (std::atan2(x[1], std::abs(x[0])) / numbers::PI + .5) * 4.;
      const Places low    = grading.places(n_around, "", "", at <= 1. ? at : nowhere),
                   high   = grading.places(n_around, "", "", at > 1. ? at - 1. : nowhere),
                   radial = grading.places(n_radial, "", "outer", 2. * std::hypot(x[0], x[1]) / radius - 1.);
      // As cylinder_quarter() in generated_mesh.cc: angles well above zero.
      const Point<2> centre(0., 0.), bottom(0., -.5 * radius), side(.5 * radius, 0.),
          corner(.42 * radius, -.42 * radius);
      const auto mean = [](const Point<2> &a, const Point<2> &b, const double t) {
        return Point<2>((1. - t) * Tensor<1, 2>(a) + t * Tensor<1, 2>(b));
      };
      const auto on_arc = [&](const double t) {
        const double angle = (.25 * t - .5) * numbers::PI;
        return Point<2>(t == 0. ? 0. : radius * std::cos(angle), t == 2. ? 0. : radius * std::sin(angle));
      };
      std::vector<Quadrilateral> figure;
      // Upward: from the bottom of the core to its side.
      add_patch(figure, low, high, [&](const double s, const double t) {
        return mean(mean(bottom, corner, s), mean(centre, side, s), t);
      });
      add_patch(figure, low, radial, [&](const double s, const double t) {
        return mean(on_arc(s), mean(bottom, corner, s), 1. - t);
      });
      for (auto i = figure.end() - static_cast<long>(n_around * n_radial); i != figure.end(); ++i)
        *i = {{(*i)[2], (*i)[3], (*i)[0], (*i)[1]}};
      add_patch(figure, radial, high, [&](const double s, const double t) {
        return mean(mean(corner, side, t), on_arc(1. + t), s);
      });
      return figure;
    }

    ShapedCells half_cylinder(const GeneratedMeshParameters &p)
    {
      require_positive(p.radius, "Radius");
      require_positive(p.height, "Height");
      const unsigned int quarters  = kind_has(p, "half of") ? 1 : 2;
      auto [radial, around, along] = p.round_divisions;
      if (around % (2 * quarters) != 0)
        throw InputError("Round divisions: the arc of a " + p.kind + " has two parts for each right angle: " +
                         std::to_string(around) + " is no multiple of " + std::to_string(2 * quarters) + ".");
      const unsigned int n_around = around == 0 ? 1 : around / (2 * quarters);
      radial                      = radial == 0 ? n_around : radial;
      along                       = along == 0 ? cells_of_width(p.height, .5 * p.radius / n_around) : along;
      const Grading              grading(p);
      std::vector<Quadrilateral> figure = quarter_disk(p.radius, radial, n_around, grading);
      if (quarters == 2)
        for (std::size_t i = 0, n = figure.size(); i < n; ++i)
          {
            const auto mirrored = [&](const unsigned int v) {
              return Point<2>(-figure[i][v][0], figure[i][v][1]);
            };
            figure.push_back({{mirrored(1), mirrored(0), mirrored(3), mirrored(2)}});
          }
      ShapedCells result = draw_out(figure, p, along, grading);
      result.size        = p.radius;
      result.curved      = {{"outer", CurvedBoundary::cylinder}};
      result.boundaries.emplace_back("outer", cylinder(p.radius));
      result.boundaries.emplace_back("flat", coordinate_plane(1, 0.));
      result.boundaries.emplace_back("symmetry x", coordinate_plane(0, 0.));
      return result;
    }

    double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    void check_polygon(const std::vector<Point<2>> &corners)
    {
      const std::size_t n = corners.size();
      if (n < 3)
        throw InputError("Corners: a prism needs three of them at least.");
      double turned = 0.;
      for (std::size_t i = 0; i < n; ++i)
        {
          const Tensor<1, 2> one = corners[(i + 1) % n] - corners[i],
                             two = corners[(i + 2) % n] - corners[(i + 1) % n];
          if (!(cross(one, two) > 1e-6 * one.norm() * two.norm()))
            throw InputError("Corners: those of a prism must be convex, one after the other, with the inside "
                             "on the left.");
          turned += std::atan2(cross(one, two), one * two);
        }
      if (turned > 7.)
        throw InputError("Corners: they go around more than once.");
    }

    ShapedCells prism(const GeneratedMeshParameters &p)
    {
      require_positive(p.height, "Height");
      check_polygon(p.corners);
      const std::size_t n = p.corners.size();
      Tensor<1, 2>      centre;
      double            around = 0.;
      for (std::size_t i = 0; i < n; ++i)
        {
          centre += Tensor<1, 2>(p.corners[i]) / static_cast<double>(n);
          around += p.corners[i].distance(p.corners[(i + 1) % n]);
        }
      const unsigned int half = std::max(1u, p.round_divisions[0]);
      const unsigned int along =
          p.round_divisions[2] > 0 ? p.round_divisions[2]
                                   : cells_of_width(p.height, around / (2. * static_cast<double>(n) * half));
      const Grading              grading(p);
      const Places               s = grading.places(half, "sides", "", 0.);
      std::vector<Quadrilateral> figure;
      for (std::size_t i = 0; i < n; ++i)
        {
          const Tensor<1, 2> corner(p.corners[i]),
              after  = .5 * (corner + Tensor<1, 2>(p.corners[(i + 1) % n])),
              before = .5 * (corner + Tensor<1, 2>(p.corners[(i + n - 1) % n]));
          add_patch(figure, s, s, [&](const double a, const double b) {
            return Point<2>((1. - a) * ((1. - b) * corner + b * before) +
                            a * ((1. - b) * after + b * centre));
          });
        }
      ShapedCells result = draw_out(figure, p, along, grading);
      result.size        = around;
      for (std::size_t i = 0; i < n; ++i)
        {
          const Point<2> a = p.corners[i], b = p.corners[(i + 1) % n];
          result.boundaries.emplace_back("side " + std::to_string(i + 1), [a, b](const Point<3> &x) {
            return cross(b - a, Point<2>(x[0], x[1]) - a) / (b - a).norm();
          });
        }
      return result;
    }
  } // namespace



  std::vector<double> graded_places(const unsigned int n, const double centre, const double ratio)
  {
    const double slope = (ratio - 1.) / std::max(centre, 1. - centre);
    // Number of cells from the centre on, up to a factor, and its inverse.
    const auto number = [&](const double t) {
      const double distance = std::abs(t - centre);
      return std::copysign(slope * distance < 1e-8 ? distance : std::log1p(slope * distance) / slope,
                           t - centre);
    };
    const auto place = [&](const double m) {
      const double distance =
          slope * std::abs(m) < 1e-8 ? std::abs(m) : std::expm1(slope * std::abs(m)) / slope;
      return centre + std::copysign(distance, m);
    };
    const double        low = number(0.), high = number(1.);
    std::vector<double> result(n + 1, 0.);
    for (unsigned int i = 1; i < n; ++i)
      result[i] = place(low + (high - low) * i / n);
    result[n] = 1.;
    return result;
  }



  bool is_extruded(const std::string &kind)
  {
    for (const char *word : {"annulus", "tube", "half cylinder", "prism"})
      if (kind.find(word) != std::string::npos)
        return true;
    return false;
  }



  ShapedCells extruded_cells(const GeneratedMeshParameters &p)
  {
    return kind_has(p, "prism") ? prism(p) : kind_has(p, "cylinder") ? half_cylinder(p) : tube(p);
  }
} // namespace Signorini
