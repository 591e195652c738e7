// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/true_shape.h>

#include <Eigen/Dense>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_terms = 10;

    /// The monomials of degree three and less.
    std::array<double, n_terms> monomials(const double s, const double t)
    {
      return {{1., s, t, s * s, s * t, t * t, s * s * s, s * s * t, s * t * t, t * t * t}};
    }

    /// Points (i/3, j/3) of the unit triangle.
    std::array<std::array<double, 2>, n_terms> lattice()
    {
      std::array<std::array<double, 2>, n_terms> points;
      unsigned int                               n = 0;
      for (unsigned int i = 0; i <= 3; ++i)
        for (unsigned int j = 0; i + j <= 3; ++j)
          points[n++] = {{i / 3., j / 3.}};
      return points;
    }

    using LatticeMatrix = Eigen::Matrix<double, n_terms, n_terms>;

    /// From values at the lattice to the coefficients of the monomials.
    const LatticeMatrix &interpolation()
    {
      static const LatticeMatrix inverse = []() {
        LatticeMatrix a;
        const auto    points = lattice();
        for (unsigned int i = 0; i < n_terms; ++i)
          {
            const auto m = monomials(points[i][0], points[i][1]);
            for (unsigned int j = 0; j < n_terms; ++j)
              a(i, j) = m[j];
          }
        return LatticeMatrix(a.inverse());
      }();
      return inverse;
    }
  } // namespace



  TrueShape::TrueShape(std::vector<BoundaryShapePointer> shape_list, std::vector<unsigned int> of_triangle,
                       const bool is_used)
    : shapes(std::move(shape_list))
    , shape_of_triangle(std::move(of_triangle))
    , is_used(is_used)
    , index_of_cubic(shape_of_triangle.size(), no_shape)
  {
  }



  const TrueShape::Cubic &TrueShape::cubic(const SurfaceMesh &mesh, const unsigned int triangle) const
  {
    if (index_of_cubic[triangle] == no_shape)
      {
        const auto          &v     = mesh.triangles[triangle];
        const BoundaryShape &shape = *shapes[shape_of_triangle[triangle]];
        Cubic                values, coefficients;
        const auto           points = lattice();
        for (unsigned int i = 0; i < n_terms; ++i)
          {
            const auto [s, t] = points[i];
            const Point<3> x((1. - s - t) * mesh.vertices[v[0]] + s * mesh.vertices[v[1]] +
                             t * mesh.vertices[v[2]]);
            values[i] = shape.project(x) - x;
          }
        const LatticeMatrix &matrix = interpolation();
        for (unsigned int j = 0; j < n_terms; ++j)
          for (unsigned int i = 0; i < n_terms; ++i)
            coefficients[j] += matrix(j, i) * values[i];
        index_of_cubic[triangle] = static_cast<unsigned int>(cubics.size());
        cubics.push_back(coefficients);
      }
    return cubics[index_of_cubic[triangle]];
  }



  Vector3 TrueShape::known_offset(const SurfaceMesh &mesh, const unsigned int triangle,
                                  const std::array<double, 3> &weights) const
  {
    Vector3 sum;
    if (shapes.empty() || shape_of_triangle[triangle] == no_shape)
      return sum;
    const Cubic &coefficients = cubic(mesh, triangle);
    const auto   m            = monomials(weights[1], weights[2]);
    for (unsigned int j = 0; j < n_terms; ++j)
      sum += m[j] * coefficients[j];
    return sum;
  }



  double TrueShape::doubt(const SurfaceMesh &mesh, const unsigned int triangle) const
  {
    if (shapes.empty() || shape_of_triangle[triangle] == no_shape)
      return 0.;
    const auto    &v = mesh.triangles[triangle];
    const Point<3> centre((Tensor<1, 3>(mesh.vertices[v[0]]) + Tensor<1, 3>(mesh.vertices[v[1]]) +
                           Tensor<1, 3>(mesh.vertices[v[2]])) /
                          3.);
    return shapes[shape_of_triangle[triangle]]->doubt(centre);
  }
} // namespace Signorini
