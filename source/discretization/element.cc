// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/element.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Four points in a tetrahedron, exact for degree two.
    constexpr double far_point = .58541019662496845446, near_point = .13819660112501051518;

    Block tetrahedral_jacobian(const Hexahedron::Corners &x)
    {
      Block j;
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          j[c][d] = x[d + 1][c] - x[0][c];
      return j;
    }
  } // namespace



  Element::Element(const NodalSpace &space, const NodalSpace::Cell &cell)
    : n(cell.n_vertices)
  {
    const auto nodes = space.nodes(cell);
    for (unsigned int v = 0; v < n; ++v)
      corners[v] = space.position(nodes[v]);
  }



  Element::Element(const VolumeMesh &mesh, const VolumeMesh::Cell &cell)
    : n(cell.n_vertices)
  {
    for (unsigned int v = 0; v < n; ++v)
      corners[v] = mesh.vertices[cell.vertices[v]];
  }



  Point<3> Element::centre() const
  {
    Point<3> sum;
    for (unsigned int v = 0; v < n; ++v)
      sum += corners[v] / n;
    return sum;
  }



  bool Element::stiffness(std::array<double, 576> &blocks, const Material &material) const
  {
    if (n == CellShape::hexahedron)
      return Hexahedron::stiffness(blocks, corners, material, material.mean_dilatation);
    std::array<Vector3, 8> g;
    if (!shape_gradients(g, Point<3>()))
      return false;
    const double weight = determinant(tetrahedral_jacobian(corners)) / 6.;
    const double lambda = weight * material.lambda(), mu = weight * material.mu();
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        {
          double *const k   = blocks.data() + 9 * (n * a + b);
          const double  dot = mu * (g[a] * g[b]);
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              k[3 * c + d] = lambda * g[a][c] * g[b][d] + mu * g[a][d] * g[b][c] + (c == d ? dot : 0.);
        }
    return true;
  }



  Point<3> Element::reference_point(const unsigned int q) const
  {
    if (n == CellShape::hexahedron)
      return Hexahedron::gauss_points()[q];
    Point<3> p(near_point, near_point, near_point);
    if (q > 0)
      p[q - 1] = far_point;
    return p;
  }



  std::pair<double, Point<3>> Element::volume_element(const unsigned int q) const
  {
    if (n == CellShape::hexahedron)
      return Hexahedron::volume_element(corners, q);
    const Shape values = shape_at_point(q);
    Point<3>    p;
    for (unsigned int v = 0; v < n; ++v)
      p += values[v] * corners[v];
    return {determinant(tetrahedral_jacobian(corners)) / 24., p};
  }



  Element::Shape Element::shape_at_point(const unsigned int q) const
  {
    return shape_values(reference_point(q));
  }



  Element::Shape Element::shape_values(const Point<3> &p) const
  {
    if (n == CellShape::hexahedron)
      return Hexahedron::shape_values(p);
    return {{1. - p[0] - p[1] - p[2], p[0], p[1], p[2], 0., 0., 0., 0.}};
  }



  bool Element::reference_gradients(std::array<Vector3, CellShape::max_vertices> &gradients, Block &inverse,
                                    const Point<3> &reference) const
  {
    Block j;
    if (n == CellShape::hexahedron)
      {
        gradients = Hexahedron::reference_gradients(reference);
        for (unsigned int v = 0; v < n; ++v)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              j[c][d] += corners[v][c] * gradients[v][d];
      }
    else
      {
        gradients    = {};
        gradients[0] = Vector3({-1., -1., -1.});
        for (unsigned int c = 0; c < 3; ++c)
          gradients[c + 1][c] = 1.;
        j = tetrahedral_jacobian(corners);
      }
    if (!(determinant(j) > 0.))
      return false;
    inverse = invert(j);
    return true;
  }



  bool Element::shape_gradients(std::array<Vector3, CellShape::max_vertices> &gradients,
                                const Point<3>                               &reference) const
  {
    std::array<Vector3, CellShape::max_vertices> g;
    Block                                        inverse;
    if (!reference_gradients(g, inverse, reference))
      return false;
    const Block t = transpose(inverse);
    for (unsigned int v = 0; v < n; ++v)
      gradients[v] = t * g[v];
    return true;
  }



  bool Element::invert_map(Point<3> &reference, const Point<3> &point) const
  {
    if (n == CellShape::hexahedron)
      return Hexahedron::invert_map(reference, corners, point);
    const Block j = tetrahedral_jacobian(corners);
    if (!(std::abs(determinant(j)) > 0.))
      return false;
    reference = Point<3>(invert(j) * (point - corners[0]));
    return true;
  }



  double Element::outside(const Point<3> &reference) const
  {
    double result = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      result = std::max(result, -reference[c]);
    if (n == CellShape::hexahedron)
      for (unsigned int c = 0; c < 3; ++c)
        result = std::max(result, reference[c] - 1.);
    else
      result = std::max(result, reference[0] + reference[1] + reference[2] - 1.);
    return result;
  }



  double Element::volume() const
  {
    double sum = 0.;
    for (unsigned int q = 0; q < n_points(); ++q)
      sum += volume_element(q).first;
    return sum;
  }



  double Element::diameter() const
  {
    double longest = 0.;
    for (unsigned int v = 0; v < n; ++v)
      for (unsigned int w = 0; w < v; ++w)
        longest = std::max(longest, corners[v].distance(corners[w]));
    return longest;
  }



  Block stress(const Block &gradient, const Material &material)
  {
    Block sigma = material.mu() * (gradient + transpose(gradient));
    for (unsigned int c = 0; c < 3; ++c)
      sigma[c][c] += material.lambda() * trace(gradient);
    return sigma;
  }



  CellDisplacement::CellDisplacement(const Element &element, const Material &material,
                                     const std::array<Vector3, CellShape::max_vertices> &u,
                                     const CellEigenstrain                              &eigenstrain)
    : element(element)
    , material(material)
    , u(u)
    , eigenstrain(eigenstrain)
  {
    // That of linear tetrahedra is constant.
    if (!material.mean_dilatation || element.n_vertices() == CellShape::tetrahedron)
      return;
    double volume = 0., sum = 0., free = 0.;
    Block  gradient;
    for (unsigned int q = 0; q < element.n_points(); ++q)
      if (plain_gradient(gradient, element.reference_point(q)) > 0.)
        {
          const double weight = element.volume_element(q).first;
          volume += weight;
          sum += weight * trace(gradient);
          if (!eigenstrain.is_zero)
            free += weight * trace(eigenstrain.value(element.shape_at_point(q)));
        }
    if (volume > 0.)
      {
        has_mean_dilatation = true;
        mean_dilatation     = sum / volume;
        mean_of_eigenstrain = free / volume;
      }
  }



  double CellDisplacement::plain_gradient(Block &gradient, const Point<3> &reference) const
  {
    std::array<Vector3, CellShape::max_vertices> g;
    Block                                        inverse, on_reference;
    if (!element.reference_gradients(g, inverse, reference))
      return 0.;
    for (unsigned int v = 0; v < element.n_vertices(); ++v)
      on_reference += outer_product(u[v], g[v]);
    gradient = on_reference * inverse;
    return 1. / determinant(inverse);
  }



  Block CellDisplacement::with_mean_dilatation(const Block &plain) const
  {
    Block result = plain;
    if (has_mean_dilatation)
      {
        const double change = (mean_dilatation - trace(result)) / 3.;
        for (unsigned int c = 0; c < 3; ++c)
          result[c][c] += change;
      }
    return result;
  }



  Block CellDisplacement::gradient(const Point<3> &reference) const
  {
    Block plain;
    return plain_gradient(plain, reference) > 0. ? with_mean_dilatation(plain) : Block();
  }



  Block CellDisplacement::without_eigenstrain(const Block &gradient, const Point<3> &reference) const
  {
    if (eigenstrain.is_zero)
      return gradient;
    Block free = eigenstrain.value(element.shape_values(reference));
    if (has_mean_dilatation)
      {
        const double change = (mean_of_eigenstrain - trace(free)) / 3.;
        for (unsigned int c = 0; c < 3; ++c)
          free[c][c] += change;
      }
    return gradient - free;
  }



  Block CellDisplacement::elastic_gradient(const Point<3> &reference) const
  {
    return without_eigenstrain(gradient(reference), reference);
  }



  std::pair<Block, double> CellDisplacement::stress_at_point(const unsigned int q) const
  {
    const Point<3> reference = element.reference_point(q);
    Block          plain;
    const double   determinant = plain_gradient(plain, reference);
    if (!(determinant > 0.))
      return {Block(), 0.};
    const double part = element.n_vertices() == CellShape::hexahedron ? 1. / 8. : 1. / 24.;
    return {Signorini::stress(without_eigenstrain(with_mean_dilatation(plain), reference), material),
            part * determinant};
  }



  Vector3 CellDisplacement::eigenstress_divergence() const
  {
    Vector3                                      result;
    std::array<Vector3, CellShape::max_vertices> g;
    if (!eigenstrain.is_zero && element.shape_gradients(g, Point<3>(.25, .25, .25)))
      for (unsigned int v = 0; v < element.n_vertices(); ++v)
        result += Signorini::stress(eigenstrain.at_vertices[v], material) * g[v];
    return result;
  }



  ElementFace::ElementFace(const Element &cell, const unsigned int face)
    : vertices(CellShape::face(cell.n_vertices(), face))
  {
    for (unsigned int v = 0; v < vertices.size(); ++v)
      x[v] = cell.corner(vertices[v]);
  }



  ElementFace::PointData ElementFace::point(const unsigned int q) const
  {
    PointData data;
    if (n_corners() == 3)
      {
        data.shape    = {{1. / 6., 1. / 6., 1. / 6., 0.}};
        data.shape[q] = 2. / 3.;
        data.area     = cross_product_3d(x[1] - x[0], x[2] - x[0]) / 6.;
      }
    else
      {
        const double g[2] = {.5 - .5 / std::sqrt(3.), .5 + .5 / std::sqrt(3.)};
        const double s = g[q & 1], t = g[q >> 1];
        data.shape = {{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}};
        data.area  = .25 * cross_product_3d((1 - t) * (x[1] - x[0]) + t * (x[2] - x[3]),
                                            (1 - s) * (x[3] - x[0]) + s * (x[2] - x[1]));
      }
    for (unsigned int v = 0; v < n_corners(); ++v)
      data.position += data.shape[v] * x[v];
    return data;
  }



  double ElementFace::diameter() const
  {
    double longest = 0.;
    for (unsigned int v = 0; v < n_corners(); ++v)
      longest = std::max(longest, x[v].distance(x[(v + 1) % n_corners()]));
    return longest;
  }
} // namespace Signorini
