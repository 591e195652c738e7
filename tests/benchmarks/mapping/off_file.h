// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_benchmarks_off_file_h
#define signorini_benchmarks_off_file_h

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

/// A triangulated surface from an OFF file, for the drivers of other codes.
struct OffFile
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>>    triangles;

  explicit OffFile(const std::string &name)
  {
    std::ifstream in(name);
    std::string   word;
    std::size_t   n_points = 0, n_triangles = 0, n;
    in >> word >> n_points >> n_triangles >> n;
    points.resize(n_points);
    triangles.resize(n_triangles);
    for (auto &p : points)
      in >> p[0] >> p[1] >> p[2];
    for (auto &t : triangles)
      in >> n >> t[0] >> t[1] >> t[2];
    if (!in)
      {
        std::cerr << name << " is not an OFF file of triangles\n";
        std::exit(1);
      }
  }

  double area(const std::size_t triangle) const
  {
    const auto &a = points[triangles[triangle][0]], &b = points[triangles[triangle][1]],
               &c = points[triangles[triangle][2]];
    double u[3], v[3];
    for (int k = 0; k < 3; ++k)
      {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
      }
    const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return .5 * std::sqrt(x * x + y * y + z * z);
  }

  double area() const
  {
    double sum = 0.;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      sum += area(t);
    return sum;
  }
};

#endif
