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

    /// Points (i/3, j/3) of the unit triangle, as three corners whose mean they are.
    std::array<std::array<unsigned int, 3>, n_terms> lattice()
    {
      std::array<std::array<unsigned int, 3>, n_terms> points;
      unsigned int                                     n = 0;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          for (unsigned int k = j; k < 3; ++k)
            points[n++] = {{i, j, k}};
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
            const auto m = monomials(std::count(points[i].begin(), points[i].end(), 1u) / 3.,
                                     std::count(points[i].begin(), points[i].end(), 2u) / 3.);
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
    , known(shapes.size())
    , index_of_cubic(shape_of_triangle.size(), no_shape)
  {
  }



  TrueShape::TrueShape(const TrueShape &whole, const Renumbering &triangles)
    : shapes(whole.shapes)
    , shape_of_triangle(shapes.empty() ? std::vector<unsigned int>()
                                       : triangles.select(whole.shape_of_triangle))
    , is_used(whole.is_used)
    , known(shapes.size())
    , index_of_cubic(shape_of_triangle.size(), no_shape)
  {
    if (shapes.empty())
      return;
    for (unsigned int t = 0; t < index_of_cubic.size(); ++t)
      if (const unsigned int cubic = whole.index_of_cubic[triangles.kept()[t]]; cubic != no_shape)
        {
          index_of_cubic[t] = static_cast<unsigned int>(cubics.size());
          cubics.push_back(whole.cubics[cubic]);
        }
  }



  std::size_t TrueShape::memory_consumption() const
  {
    std::size_t bytes = list_bytes(shape_of_triangle) + list_bytes(index_of_cubic) + list_bytes(cubics);
    for (const auto &values : known)
      bytes += values.size() * (sizeof(LatticePoint) + sizeof(Vector3));
    return bytes;
  }



  Vector3 TrueShape::lattice_value(const SurfaceMesh &mesh, const unsigned int triangle,
                                   LatticePoint point) const
  {
    std::sort(point.begin(), point.end());
    auto                &values  = known[shape_of_triangle[triangle]];
    const BoundaryShape &shape   = *shapes[shape_of_triangle[triangle]];
    const auto           compute = [&]() -> Vector3 {
      const Point<3> x((Tensor<1, 3>(mesh.vertices[point[0]]) + Tensor<1, 3>(mesh.vertices[point[1]]) +
                        Tensor<1, 3>(mesh.vertices[point[2]])) /
                                 3.);
      return shape.project(x) - x;
    };
    if (point[0] != point[1] && point[1] != point[2])
      return compute();
    const auto it = values.find(point);
    return it != values.end() ? it->second : (values[point] = compute());
  }



  const TrueShape::Cubic &TrueShape::cubic(const SurfaceMesh &mesh, const unsigned int triangle) const
  {
    if (index_of_cubic[triangle] == no_shape)
      {
        const auto &v = mesh.triangles[triangle];
        Cubic       values, coefficients;
        const auto  points = lattice();
        for (unsigned int i = 0; i < n_terms; ++i)
          values[i] = lattice_value(mesh, triangle, {{v[points[i][0]], v[points[i][1]], v[points[i][2]]}});
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
    if (const BoundaryShape &shape = *shapes[shape_of_triangle[triangle]]; shape.is_exact())
      {
        const auto    &v = mesh.triangles[triangle];
        const Point<3> x(weights[0] * Tensor<1, 3>(mesh.vertices[v[0]]) +
                         weights[1] * Tensor<1, 3>(mesh.vertices[v[1]]) +
                         weights[2] * Tensor<1, 3>(mesh.vertices[v[2]]));
        return shape.project(x) - x;
      }
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
