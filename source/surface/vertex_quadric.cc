// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "vertex_quadric.h"

#include <deal.II/base/numbers.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  void set_frame(Quadric &q, const Tensor<1, 3> &normal)
  {
    q.normal = normal / normal.norm();
    Tensor<1, 3> axis;
    unsigned int least = 0;
    for (unsigned int k = 1; k < 3; ++k)
      if (std::abs(q.normal[k]) < std::abs(q.normal[least]))
        least = k;
    axis[least] = 1.;
    q.u         = cross_product_3d(q.normal, axis);
    q.u /= q.u.norm();
    q.v = cross_product_3d(q.normal, q.u);
  }



  void turn_frame(Quadric &q, const Tensor<1, 3> &normal)
  {
    const Tensor<1, 3> to = normal / normal.norm(), both = q.normal + to;
    // The rotation that takes the one to the other.
    if (const double cosine = q.normal * to; cosine > -1. + 1e-12)
      q.u -= (q.u * to) / (1. + cosine) * both;
    q.normal = to;
    q.u -= (q.u * to) * to;
    q.u /= q.u.norm();
    q.v = cross_product_3d(q.normal, q.u);
  }



  namespace
  {
    double largest_distance(const std::vector<Tensor<1, 3>> &points)
    {
      double result = 0.;
      for (const Tensor<1, 3> &x : points)
        result = std::max(result, x.norm());
      return result;
    }

    /// What is left over as a curvature, of a fit in units of `size`.
    void set_checks(Quadric &q, const Eigen::Index n_checks, const double size)
    {
      q.n_checks = static_cast<unsigned int>(n_checks);
      q.left_over *= 2. / (size * std::sqrt(std::max(1., static_cast<double>(n_checks))));
    }

    /// Solves for the two slopes and the three curvatures of a quadratic surface. Two rows of vertices, a
    /// strip of one cell, leave the curvature across them open: it is nothing. Returns false if the values
    /// leave more open, or something else.
    bool solve_for_quadric(Eigen::Matrix<double, 5, 1> &x, const Eigen::Matrix<double, Eigen::Dynamic, 5> &a,
                           const Eigen::VectorXd &b)
    {
      using Columns = Eigen::Matrix<double, Eigen::Dynamic, 5>;
      Eigen::ColPivHouseholderQR<Columns> qr(a);
      qr.setThreshold(1e-4);
      if (qr.rank() < 4)
        return false;
      if (qr.rank() == 5)
        {
          x = qr.solve(b);
          return true;
        }
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
      const Eigen::VectorXd                   parts = svd.matrixU().transpose() * b;
      x.setZero();
      for (Eigen::Index i = 0; i < 4; ++i)
        x += parts[i] / svd.singularValues()[i] * svd.matrixV().col(i);
      // The direction in which curvature is open: there it is none.
      const Eigen::Matrix<double, 5, 1> open = svd.matrixV().col(4);
      // Neighbours on another conic than two lines leave something else open.
      constexpr double two_lines = 1e-3;
      const double     trace     = open[2] + open[4];
      if (!(std::abs(open[2] * open[4] - open[3] * open[3]) <= two_lines * trace * trace))
        return false;
      const double angle =
          .5 * std::atan2(2. * open[3], open[2] - open[4]) + (trace < 0. ? .5 * numbers::PI : 0.);
      const auto along = [angle](const Eigen::Matrix<double, 5, 1> &y) {
        return y[2] * std::cos(angle) * std::cos(angle) + y[3] * std::sin(2. * angle) +
               y[4] * std::sin(angle) * std::sin(angle);
      };
      if (const double curvature = along(open); std::abs(curvature) > 0.)
        x -= along(x) / curvature * open;
      return true;
    }

    /// The larger principal curvature is linear in c, d, e as long as its direction stays.
    std::array<double, 3> share_in_curvature(const Quadric &q)
    {
      const double half = .5 * (q.c - q.e), size = std::hypot(half, q.d), sign = q.c + q.e < 0. ? -1. : 1.;
      const double cosine = size > 0. ? sign * half / size : 1., sine = size > 0. ? sign * q.d / size : 0.;
      return {{.5 * (1. + cosine), sine, .5 * (1. - cosine)}};
    }
  } // namespace



  bool fit(Quadric &q, const std::vector<Tensor<1, 3>> &neighbours)
  {
    constexpr unsigned int n_steps = 20;
    const Eigen::Index     n       = static_cast<Eigen::Index>(neighbours.size());
    if (n < 5)
      return false;
    const double                             size = largest_distance(neighbours);
    Eigen::Matrix<double, Eigen::Dynamic, 5> a(n, 5);
    Eigen::VectorXd                          b(n);
    double curvature = 0., bend_before = 0., last = std::numeric_limits<double>::max();
    // The share of c, d, e in the curvature k: along its direction. Nothing where k has been cut.
    std::array<double, 3> share = {{0., 0., 0.}};
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        double highest = 0.;
        for (Eigen::Index i = 0; i < n; ++i)
          {
            const Tensor<1, 3> x = neighbours[i] / size;
            const double       s = x * q.u, t = x * q.v, z = x * q.normal;
            highest             = std::max(highest, std::abs(z));
            const double weight = 1. / x.norm_square();
            const double h      = .5 * z * z;
            a.row(i) << s, t, .5 * s * s + share[0] * h, s * t + share[1] * h, .5 * t * t + share[2] * h;
            a.row(i) *= weight;
            b[i] = weight * (z - curvature * h);
          }
        Eigen::Matrix<double, 5, 1> x;
        if (!solve_for_quadric(x, a, b))
          return false;
        q.c                  = x[2];
        q.d                  = x[3];
        q.e                  = x[4];
        const double turn    = std::hypot(x[0], x[1]);
        const double heights = (b - a.leftCols<2>() * x.head<2>()).norm();
        q.left_over          = (b - a * x).norm();
        q.residual           = heights > 0. ? q.left_over / heights : 0.;
        turn_frame(q, q.normal - x[0] * q.u - x[1] * q.v);
        // Where the surface is wild k may do harm: beyond three quarters of a sphere it reaches nothing.
        const double limit = 1.5 / highest, k = q.largest_curvature();
        const double bend   = std::max(-limit, std::min(limit, k));
        const double change = std::max(turn, std::abs(bend - bend_before));
        bend_before         = bend;
        curvature           = bend == k ? 0. : bend;
        share               = bend == k ? share_in_curvature(q) : std::array<double, 3>{{0., 0., 0.}};
        if (change < 1e-13 || (step > 2 && change > .7 * last))
          break;
        last = change;
      }
    q.c /= size;
    q.d /= size;
    q.e /= size;
    set_checks(q, n - 5, size);
    return true;
  }



  bool fit_cubic(Quadric &q, const std::vector<Tensor<1, 3>> &neighbours)
  {
    constexpr unsigned int n_steps    = 20;
    constexpr Eigen::Index n_unknowns = 9;
    const auto             n          = static_cast<Eigen::Index>(neighbours.size());
    if (n <= n_unknowns)
      return false;
    const double    size = largest_distance(neighbours);
    Eigen::MatrixXd a(n, n_unknowns);
    Eigen::VectorXd b(n);
    double          last = std::numeric_limits<double>::max();
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        const double curvature = size * q.largest_curvature();
        for (Eigen::Index i = 0; i < n; ++i)
          {
            const Tensor<1, 3> x = neighbours[i] / size;
            const double       s = x * q.u, t = x * q.v, z = x * q.normal, weight = 1. / x.norm_square();
            a.row(i) << s, t, .5 * s * s, s * t, .5 * t * t, s * s * s, s * s * t, s * t * t, t * t * t;
            a.row(i) *= weight;
            b[i] = weight * (z - .5 * curvature * z * z);
          }
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
        qr.setThreshold(1e-3);
        if (qr.rank() < n_unknowns)
          return false;
        const Eigen::VectorXd x = qr.solve(b);
        const double turn = std::hypot(x[0], x[1]), heights = (b - a.leftCols<2>() * x.head<2>()).norm();
        const double change =
            turn + std::abs(x[2] - size * q.c) + std::abs(x[3] - size * q.d) + std::abs(x[4] - size * q.e);
        q.c         = x[2] / size;
        q.d         = x[3] / size;
        q.e         = x[4] / size;
        q.left_over = (b - a * x).norm();
        q.residual  = heights > 0. ? q.left_over / heights : 0.;
        turn_frame(q, q.normal - x[0] * q.u - x[1] * q.v);
        if (change < 1e-13 || (step > 2 && change > .7 * last))
          break;
        last = change;
      }
    set_checks(q, n - n_unknowns, size);
    return true;
  }



  std::vector<Tensor<1, 3>> places_across(const std::vector<Tensor<1, 3>> &neighbours,
                                          const Tensor<1, 3>              &axis)
  {
    // What lies beside each other along the axis is the same point of the curve, but for digits that files
    // leave out: those of cells a thousand times longer than wide.
    constexpr double          same = 1e-3;
    std::vector<Tensor<1, 3>> points;
    double                    size = 0.;
    for (const Tensor<1, 3> &x : neighbours)
      size = std::max(size, (x - (x * axis) * axis).norm());
    for (const Tensor<1, 3> &x : neighbours)
      if (const Tensor<1, 3> across = x - (x * axis) * axis;
          across.norm() > same * size &&
          std::none_of(points.begin(), points.end(),
                       [&](const Tensor<1, 3> &other) { return (other - across).norm() <= same * size; }))
        points.push_back(across);
    return points;
  }



  bool fit_extruded(Quadric &q, const std::vector<Tensor<1, 3>> &neighbours, const Tensor<1, 3> &axis)
  {
    constexpr unsigned int          n_steps = 20;
    const std::vector<Tensor<1, 3>> points  = places_across(neighbours, axis);
    const double                    size    = largest_distance(points);
    const auto                      n       = static_cast<Eigen::Index>(points.size());
    const Tensor<1, 3>              normal  = q.normal - (q.normal * axis) * axis;
    if (n < 2 || !(normal.norm() > 0.))
      return false;
    q.normal = normal / normal.norm();
    q.v      = axis;
    q.d = q.e = 0.;
    // Slope, curvature, and by how much that changes, which slopes of a symmetric curve would be taken for.
    const Eigen::Index n_unknowns = n > 3 ? 3 : 2;
    Eigen::MatrixXd    a(n, n_unknowns);
    Eigen::VectorXd    b(n);
    double             last = std::numeric_limits<double>::max();
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        q.u = cross_product_3d(q.v, q.normal);
        for (Eigen::Index i = 0; i < n; ++i)
          {
            const Tensor<1, 3> x      = points[i] / size;
            const double       weight = 1. / x.norm_square();
            a(i, 0)                   = weight * (x * q.u);
            a(i, 1)                   = .5;
            if (n_unknowns > 2)
              a(i, 2) = x * q.u;
            b[i] = weight * (x * q.normal);
          }
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
        if (qr.rank() < n_unknowns)
          return false;
        const Eigen::VectorXd x       = qr.solve(b);
        const double          heights = (b - x[0] * a.col(0)).norm(), turn = std::abs(x[0]);
        q.c         = x[1] / size;
        q.left_over = (b - a * x).norm();
        q.residual  = heights > 0. ? q.left_over / heights : 0.;
        q.normal -= x[0] * q.u;
        q.normal /= q.normal.norm();
        if (turn < 1e-13 || (step > 2 && turn > .7 * last))
          break;
        last = turn;
      }
    q.u = cross_product_3d(q.v, q.normal);
    // As many as with five unknowns; rows beside each other tell the same, two of them count.
    const auto n_neighbours = static_cast<Eigen::Index>(neighbours.size());
    set_checks(q, std::max<Eigen::Index>(0, std::min(n_neighbours - 5, 2 * (n - n_unknowns))), size);
    return true;
  }



  bool fit_sphere(Quadric &q, const std::vector<Tensor<1, 3>> &neighbours)
  {
    if (neighbours.size() < 3)
      return false;
    // A circle around the vertex lies on a sphere with it, whatever the surface is: the apex of a cone.
    constexpr double same  = 1e-3;
    const auto [near, far] = std::minmax_element(
        neighbours.begin(), neighbours.end(),
        [](const Tensor<1, 3> &a, const Tensor<1, 3> &b) { return a.norm_square() < b.norm_square(); });
    if (near->norm() >= (1. - same) * far->norm())
      return false;
    // |x|² = 2 x·m at all points, with the vector m to the centre.
    Eigen::Matrix<double, Eigen::Dynamic, 3> a(neighbours.size(), 3);
    for (std::size_t i = 0; i < neighbours.size(); ++i)
      for (unsigned int k = 0; k < 3; ++k)
        a(i, k) = 2. * neighbours[i][k] / neighbours[i].norm_square();
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(a.rows());
    // With three columns known when it is compiled, g++ 14 warns of a copy of negative length.
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
    if (qr.rank() < 3)
      return false;
    const Eigen::Vector3d m      = qr.solve(ones);
    const double          radius = m.norm();
    if (!(radius > 0.))
      return false;
    const Tensor<1, 3> to_centre({m[0], m[1], m[2]});
    const double       sign = to_centre * q.normal > 0. ? 1. : -1.;
    set_frame(q, sign * to_centre);
    q.c = q.e   = sign / radius;
    q.d         = 0.;
    q.residual  = (ones - a * m).norm() / ones.norm();
    q.left_over = q.residual / radius;
    q.n_checks  = static_cast<unsigned int>(neighbours.size() - 3);
    return true;
  }
} // namespace Signorini
