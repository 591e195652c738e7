// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/true_shape.h>
#include <signorini/surface/contact_mapping.h>

#include <Eigen/Dense>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int degree = TrueShape::degree, n_terms = TrueShape::n_terms;

    /// The monomials of this degree and less.
    std::array<double, n_terms> monomials(const double s, const double t)
    {
      std::array<double, n_terms> result = {{1.}};
      // Those of each degree are s times those of the one before, and t times the last of them.
      for (unsigned int d = 1, n = 1, before = 0; d <= degree; ++d)
        {
          const unsigned int first = n;
          for (unsigned int i = before; i < first; ++i)
            result[n++] = s * result[i];
          result[n] = t * result[first - 1];
          ++n;
          before = first;
        }
      return result;
    }

    /// Points (i, j) / degree of the unit triangle, as corners whose mean they are.
    std::array<std::array<unsigned int, degree>, n_terms> lattice()
    {
      std::array<std::array<unsigned int, degree>, n_terms> points;
      unsigned int                                          n = 0;
      for (unsigned int i = 0; i <= degree; ++i)
        for (unsigned int j = 0; i + j <= degree; ++j)
          {
            std::fill(points[n].begin(), points[n].end(), 0u);
            std::fill(points[n].end() - i - j, points[n].end() - j, 1u);
            std::fill(points[n].end() - j, points[n].end(), 2u);
            ++n;
          }
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
            const auto m = monomials(std::count(points[i].begin(), points[i].end(), 1u) / double(degree),
                                     std::count(points[i].begin(), points[i].end(), 2u) / double(degree));
            for (unsigned int j = 0; j < n_terms; ++j)
              a(i, j) = m[j];
          }
        return LatticeMatrix(a.inverse());
      }();
      return inverse;
    }
  } // namespace



  TrueShape::TrueShape(const SurfaceMesh &mesh, std::vector<BoundaryShapePointer> shape_list,
                       std::vector<unsigned int> of_triangle, const bool is_used)
    : shapes(std::move(shape_list))
    , shape_of_triangle(std::move(of_triangle))
    , is_used(is_used)
    , known(shapes.size())
    , index_of_polynomial(shape_of_triangle.size(), no_shape)
  {
    if (shapes.size() > 1)
      find_edges_of_shapes(mesh);
  }



  void TrueShape::find_edges_of_shapes(const SurfaceMesh &mesh)
  {
    const SurfaceTopology topology(mesh.triangles, mesh.vertices.size());
    for (unsigned int e = 0; e < topology.edges.size(); ++e)
      if (!topology.is_border(e))
        for (unsigned int side = 0; side < 2; ++side)
          {
            const unsigned int t = topology.edge_triangles[e][side], own = shape_of_triangle[t],
                               other = shape_of_triangle[topology.edge_triangles[e][1 - side]];
            if (own == no_shape || other == no_shape || own == other)
              continue;
            const auto it = beyond.insert({t, {{no_shape, no_shape, no_shape}}}).first;
            it->second[topology.local_edge(t, e)] = other;
          }
  }



  TrueShape::TrueShape(const TrueShape &whole, const Renumbering &triangles)
    : shapes(whole.shapes)
    , shape_of_triangle(shapes.empty() ? std::vector<unsigned int>()
                                       : triangles.select(whole.shape_of_triangle))
    , is_used(whole.is_used)
    , known(shapes.size())
    , index_of_polynomial(shape_of_triangle.size(), no_shape)
  {
    if (shapes.empty())
      return;
    for (unsigned int t = 0; t < index_of_polynomial.size(); ++t)
      if (const unsigned int one = whole.index_of_polynomial[triangles.kept()[t]]; one != no_shape)
        {
          index_of_polynomial[t] = static_cast<unsigned int>(polynomials.size());
          polynomials.push_back(whole.polynomials[one]);
        }
    for (unsigned int t = 0; t < index_of_polynomial.size(); ++t)
      if (const auto it = whole.beyond.find(triangles.kept()[t]); it != whole.beyond.end())
        beyond.insert({t, it->second});
  }



  std::size_t TrueShape::memory_consumption() const
  {
    std::size_t bytes = list_bytes(shape_of_triangle) + list_bytes(index_of_polynomial) +
                        list_bytes(polynomials) +
                        beyond.size() * (sizeof(unsigned int) + sizeof(ShapesBeyond));
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
      Point<3> x;
      for (const unsigned int v : point)
        x += Tensor<1, 3>(mesh.vertices[v]) / degree;
      return shape.project(x) - x;
    };
    if (std::any_of(point.begin(), point.end(),
                    [&](const unsigned int v) { return v != point.front() && v != point.back(); }))
      return compute();
    const auto it = values.find(point);
    return it != values.end() ? it->second : (values[point] = compute());
  }



  namespace
  {
    /// How a place of the first shape, which belongs to x, moves along the tangent plane there to where it
    /// meets that of the second shape. Nothing if they touch, by up to 10 degrees.
    Vector3 way_to_edge(const Point<3> &x, const BoundaryShape &first, const BoundaryShape &second)
    {
      constexpr double sine_of_touch = .17;
      const Vector3    to_first = first.project(x) - x, to_second = second.project(x) - x;
      // Either side will do.
      const Vector3 facing =
                        (to_first - to_second).norm() > 0. ? to_first - to_second : Vector3({1., 0., 0.}),
                    n = first.normal(x, facing), m = second.normal(x, facing), along = m - (m * n) * n;
      const double sine_square = along.norm_square();
      return sine_square > sine_of_touch * sine_of_touch ? (m * (to_second - to_first) / sine_square) * along
                                                         : Vector3();
    }
  } // namespace



  // Edges of the triangle lie where the shapes meet: their places move by the whole way there, others by
  // (λ_i + λ_j)² of that of the nearest place of the edge. With about λ_i λ_j / (λ_i + λ_j)² along the edge
  // that is a quadratic function, which is zero on the other edges.
  Vector3 TrueShape::moved_offset(const SurfaceMesh &mesh, const unsigned int triangle,
                                  const ShapesBeyond &others, const std::array<double, 3> &weights) const
  {
    const BoundaryShape &own = *shapes[shape_of_triangle[triangle]];
    const auto          &v   = mesh.triangles[triangle];
    const Point<3>       x   = evaluate(mesh, triangle, weights);
    Vector3              way;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j = (i + 1) % 3;
        if (others[i] == no_shape || !(weights[i] > 0.) || !(weights[j] > 0.))
          continue;
        const Point<3> &a = mesh.vertices[v[i]], &b = mesh.vertices[v[j]];
        const double    along = weights[i] + weights[j];
        const Point<3>  on_edge(weights[i] / along * Tensor<1, 3>(a) + weights[j] / along * Tensor<1, 3>(b));
        const Vector3   to_edge = way_to_edge(on_edge, own, *shapes[others[i]]);
        // Farther away they do not meet there.
        if (to_edge.norm() < .5 * a.distance(b))
          way += along * along * to_edge;
      }
    return own.project(x + way) - x;
  }



  const TrueShape::Polynomial &TrueShape::polynomial(const SurfaceMesh &mesh,
                                                     const unsigned int triangle) const
  {
    if (index_of_polynomial[triangle] == no_shape)
      {
        const auto &v = mesh.triangles[triangle];
        Polynomial  values, coefficients;
        const auto  points = lattice();
        const auto  edges  = beyond.find(triangle);
        for (unsigned int i = 0; i < n_terms; ++i)
          {
            LatticePoint point;
            std::transform(points[i].begin(), points[i].end(), point.begin(),
                           [&](const unsigned int corner) { return v[corner]; });
            if (edges == beyond.end())
              {
                values[i] = lattice_value(mesh, triangle, point);
                continue;
              }
            std::array<double, 3> weights = {{0., 0., 0.}};
            for (const unsigned int corner : points[i])
              weights[corner] += 1. / degree;
            values[i] = moved_offset(mesh, triangle, edges->second, weights);
          }
        const LatticeMatrix &matrix = interpolation();
        for (unsigned int j = 0; j < n_terms; ++j)
          for (unsigned int i = 0; i < n_terms; ++i)
            coefficients[j] += matrix(j, i) * values[i];
        index_of_polynomial[triangle] = static_cast<unsigned int>(polynomials.size());
        polynomials.push_back(coefficients);
      }
    return polynomials[index_of_polynomial[triangle]];
  }



  Vector3 TrueShape::known_offset(const SurfaceMesh &mesh, const unsigned int triangle,
                                  const std::array<double, 3> &weights) const
  {
    Vector3 sum;
    if (shapes.empty() || shape_of_triangle[triangle] == no_shape)
      return sum;
    if (const BoundaryShape &shape = *shapes[shape_of_triangle[triangle]]; shape.is_exact())
      {
        if (const auto edges = beyond.find(triangle); edges != beyond.end())
          return moved_offset(mesh, triangle, edges->second, weights);
        const Point<3> x = evaluate(mesh, triangle, weights);
        return shape.project(x) - x;
      }
    const Polynomial &coefficients = polynomial(mesh, triangle);
    const auto        m            = monomials(weights[1], weights[2]);
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
