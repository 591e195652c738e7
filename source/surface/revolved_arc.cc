// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "revolved_arc.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// A place turned about the axis into the plane of the profile.
    struct InProfile
    {
      /// Along the normal and along v.
      double       height, way;
      Tensor<1, 3> of_height, of_way;
      /// At the place: away from the axis, and 1/distance from that.
      Tensor<1, 3> outwards;
      double       over_distance;
      /// The distance from the axis over that of the vertex.
      double radius;

      InProfile(const RevolvedArc &arc, const Tensor<1, 3> &x)
      {
        const double size      = std::hypot(arc.across, arc.tilt);
        const double by_normal = size > 0. ? -arc.across / size : 1., by_v = size > 0. ? arc.tilt / size : 0.;
        const Tensor<1, 3> from_axis = by_normal * arc.normal + by_v * arc.v,
                           axis      = by_normal * arc.v - by_v * arc.normal;
        const double s = x * arc.u, r = x * from_axis, h = x * axis;
        radius = std::hypot(size * s, 1. + size * r);
        // The distance from the axis less that of the vertex, also where both are large.
        const double farther = (size * (s * s + r * r) + 2. * r) / (1. + radius);
        outwards             = (size * s * arc.u + (1. + size * r) * from_axis) / radius;
        over_distance        = size / radius;
        height               = by_normal * farther - by_v * h;
        way                  = by_v * farther + by_normal * h;
        of_height            = by_normal * outwards - by_v * axis;
        of_way               = by_v * outwards + by_normal * axis;
      }

      /// With this curvature.
      double distance_from_arc(const double along) const
      {
        return height - .5 * along * square();
      }

      Tensor<1, 3> gradient(const double along) const
      {
        return (1. - along * height) * of_height - along * way * of_way;
      }

      double square() const
      {
        return height * height + way * way;
      }
    };
  } // namespace



  double RevolvedArc::distance(const Tensor<1, 3> &x) const
  {
    return InProfile(*this, x).distance_from_arc(along);
  }



  bool RevolvedArc::reaches(const Tensor<1, 3> &x) const
  {
    constexpr double least_radius = .25;
    return InProfile(*this, x).radius >= least_radius;
  }



  Quadric RevolvedArc::at(const Tensor<1, 3> &x) const
  {
    const InProfile    p(*this, x);
    const Tensor<1, 3> uphill = p.gradient(along);
    Quadric            result;
    set_frame(result, uphill.norm() > 0. ? uphill : normal);
    Tensor<1, 3> around = cross_product_3d(p.of_way, p.of_height);
    around -= (around * result.normal) * result.normal;
    if (around.norm() > 0.)
      {
        result.u = around / around.norm();
        result.v = cross_product_3d(result.normal, result.u);
      }
    result.c         = -p.over_distance * (p.outwards * result.normal);
    result.e         = along;
    result.residual  = residual;
    result.left_over = left_over;
    result.n_checks  = n_checks;
    return result;
  }



  namespace
  {
    constexpr int n_unknowns = 6;

    void turn(RevolvedArc &arc, const Eigen::Vector3d &by)
    {
      const double angle = by.norm();
      if (!(angle > 0.))
        return;
      const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, by / angle).toRotationMatrix();
      for (Tensor<1, 3> *axis : {&arc.u, &arc.v, &arc.normal})
        {
          const Eigen::Vector3d turned = rotation * Eigen::Vector3d((*axis)[0], (*axis)[1], (*axis)[2]);
          *axis                        = Tensor<1, 3>({turned[0], turned[1], turned[2]});
        }
    }

    /// Gauss-Newton; lengths in units of the size of the neighbourhood. Unknowns: a rotation of the frame,
    /// the two curvatures, the tilt.
    void approach(RevolvedArc &arc, const std::vector<Tensor<1, 3>> &points)
    {
      // Vertices of cones and tori end after three to six steps, each of which leaves a fraction of what
      // there was.
      constexpr unsigned int n_steps    = 8;
      constexpr double       difference = 1e-6, large = 1e3, hopeless = .5, nothing = 1e-9;
      const auto             n = static_cast<Eigen::Index>(points.size());
      // With columns known when it is compiled, g++ 14 warns of a copy of negative length.
      Eigen::MatrixXd a(n, n_unknowns);
      Eigen::VectorXd b(n), heights(n);
      double          before = std::numeric_limits<double>::max();
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          RevolvedArc bent = arc, tilted = arc;
          bent.across += difference;
          tilted.tilt += difference;
          for (Eigen::Index i = 0; i < n; ++i)
            {
              const Tensor<1, 3> &x = points[i];
              const InProfile     p(arc, x);
              const double        distance = p.distance_from_arc(arc.along), weight = 1. / x.norm_square();
              const Tensor<1, 3>  turned = cross_product_3d(x, p.gradient(arc.along));
              a.row(i) << -turned[0], -turned[1], -turned[2], (bent.distance(x) - distance) / difference,
                  -.5 * p.square(), (tilted.distance(x) - distance) / difference;
              a.row(i) *= weight;
              b[i]       = -weight * distance;
              heights[i] = weight * (x * arc.normal);
            }
          arc.left_over = b.norm();
          arc.residual  = heights.norm() > 0. ? b.norm() / heights.norm() : 0.;
          if (arc.residual > nothing && arc.residual > hopeless * before)
            return;
          before = arc.residual;
          Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
          qr.setThreshold(1e-6);
          const Eigen::VectorXd x    = qr.solve(b);
          const double          size = x.norm();
          if (!(size < large) || size < 1e-12)
            return;
          turn(arc, x.head<3>());
          arc.across += x[3];
          arc.along += x[4];
          arc.tilt += x[5];
        }
    }
  } // namespace



  namespace
  {
    /// How many different places of the profile, but that of the vertex, points lie on.
    unsigned int count_rows(const RevolvedArc &arc, const std::vector<Tensor<1, 3>> &points)
    {
      constexpr double             same = 1e-3;
      std::vector<Eigen::Vector2d> rows = {Eigen::Vector2d::Zero()};
      for (const Tensor<1, 3> &x : points)
        {
          const InProfile       p(arc, x);
          const Eigen::Vector2d place(p.height, p.way);
          if (std::none_of(rows.begin(), rows.end(),
                           [&](const Eigen::Vector2d &row) { return (row - place).norm() <= same; }))
            rows.push_back(place);
        }
      return static_cast<unsigned int>(rows.size() - 1);
    }
  } // namespace



  bool fit(RevolvedArc &arc, const Quadric &start, const std::vector<Tensor<1, 3>> &neighbours)
  {
    if (neighbours.size() < n_unknowns)
      return false;
    double size = 0.;
    for (const Tensor<1, 3> &x : neighbours)
      size = std::max(size, x.norm());
    std::vector<Tensor<1, 3>> points;
    for (const Tensor<1, 3> &x : neighbours)
      points.push_back(x / size);
    const double mean = .5 * (start.c + start.e), half = .5 * (start.c - start.e),
                 difference = std::hypot(half, start.d), angle = .5 * std::atan2(start.d, half);
    RevolvedArc first;
    first.u            = std::cos(angle) * start.u + std::sin(angle) * start.v;
    first.v            = std::cos(angle) * start.v - std::sin(angle) * start.u;
    first.normal       = start.normal;
    first.across       = size * (mean + difference);
    first.along        = size * (mean - difference);
    RevolvedArc second = first;
    second.u           = first.v;
    second.v           = -first.u;
    std::swap(second.across, second.along);
    approach(first, points);
    approach(second, points);
    arc = second.residual < first.residual ? second : first;
    if (!std::isfinite(arc.residual) ||
        std::any_of(points.begin(), points.end(), [&](const Tensor<1, 3> &x) { return !arc.reaches(x); }))
      return false;
    const unsigned int n_rows = count_rows(arc, points);
    arc.across /= size;
    arc.along /= size;
    arc.tilt /= size;
    // Three rows always lie on an arc. What lies beside each other in a row tells the same, three of them
    // count.
    arc.n_checks =
        std::min(static_cast<unsigned int>(neighbours.size() - n_unknowns), 3 * (std::max(2u, n_rows) - 2));
    arc.left_over *= 2. / (size * std::sqrt(std::max(1., static_cast<double>(arc.n_checks))));
    return true;
  }
} // namespace Signorini
