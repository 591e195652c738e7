// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "vertex_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// What a corner x of a triangle adds to the normal at x: the direction of the sum over the triangles
    /// around a vertex is exact on a sphere (Max: Weights for computing vertex normals from facet normals,
    /// 1999).
    Tensor<1, 3> corner_normal(const Point<3> &x, const Point<3> &next, const Point<3> &previous)
    {
      const Tensor<1, 3> a = next - x, b = previous - x;
      const double       lengths = a.norm() * b.norm();
      return lengths > 0. ? cross_product_3d(a, b) / lengths / lengths : Tensor<1, 3>();
    }
  } // namespace



  VertexFits::VertexFits(const SurfaceMesh &mesh, const SmoothPieces &pieces, const SmoothingRule &rule)
    : mesh(mesh)
    , pieces(pieces)
    , rule(rule)
    , quadrics(pieces.vertices.size())
    , normals(quadrics.size())
    , was_tried(quadrics.size(), false)
    , has_fit(quadrics.size(), false)
    , lenders(mesh.triangles.size(), unknown)
  {
  }



  TriangleFit VertexFits::at_corners(const unsigned int triangle)
  {
    TriangleFit result;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int p = pieces.of_corner[3 * triangle + i];
        result.corners[i]    = taken_at(triangle, i);
        // Exact surfaces may meet at less than the angle of a crease: each has its own normal there.
        if (!meet_exactly(p))
          turn_frame(result.corners[i], normal(p));
        result.is_complete =
            result.is_complete && (lender(triangle) != SurfaceTopology::none || is_fitted(p));
      }
    return result;
  }



  Quadric VertexFits::at_vertex(const unsigned int piece_vertex)
  {
    Quadric result = own_fit(piece_vertex);
    turn_frame(result, normal(piece_vertex));
    return result;
  }



  bool VertexFits::is_exact(const unsigned int triangle)
  {
    const auto own_is_exact = [&](const unsigned int i) {
      const unsigned int p = pieces.of_corner[3 * triangle + i];
      return is_fitted(p) && own_fit(p).residual <= rule.exact;
    };
    return lender(triangle) != SurfaceTopology::none ||
           (own_is_exact(0) && own_is_exact(1) && own_is_exact(2));
  }



  bool VertexFits::meet_exactly(const unsigned int piece_vertex)
  {
    const std::vector<unsigned int> &around = pieces.vertices[piece_vertex].triangles;
    return std::all_of(around.begin(), around.end(), [&](const unsigned int t) { return is_exact(t); });
  }



  std::optional<PlacedArc> VertexFits::arc_of(const unsigned int triangle)
  {
    const auto arc_at = [&](const unsigned int p) -> std::optional<PlacedArc> {
      const auto arc = arcs.find(p);
      if (arc == arcs.end() || !lies_on(triangle, p))
        return {};
      return PlacedArc{arc->second, mesh.vertices[pieces.vertices[p].vertex]};
    };
    if (!is_exact(triangle))
      return {};
    if (const unsigned int from = lender(triangle); from != SurfaceTopology::none)
      return arc_at(from);
    for (unsigned int i = 0; i < 3; ++i)
      if (auto arc = arc_at(pieces.of_corner[3 * triangle + i]))
        return arc;
    return {};
  }



  const Tensor<1, 3> &VertexFits::normal(const unsigned int piece_vertex)
  {
    Tensor<1, 3> &result = normals[piece_vertex];
    if (result.norm() > 0.)
      return result;
    Tensor<1, 3> mean;
    bool         is_own = true;
    for (const unsigned int t : pieces.vertices[piece_vertex].triangles)
      {
        const Quadric taken    = taken_at(t, pieces.corner_of(t, piece_vertex));
        const bool    borrows  = lender(t) != SurfaceTopology::none;
        const double  residual = borrows || is_fitted(piece_vertex) ? taken.residual : 1.,
                     weight    = 1. / (rule.exact + residual);
        mean += weight * weight * taken.normal;
        is_own = is_own && !borrows;
      }
    result = is_own || !(mean.norm() > 0.) ? own_fit(piece_vertex).normal : mean / mean.norm();
    return result;
  }



  Quadric VertexFits::taken_at(const unsigned int triangle, const unsigned int corner)
  {
    const unsigned int from = lender(triangle);
    if (from == SurfaceTopology::none)
      return own_fit(pieces.of_corner[3 * triangle + corner]);
    const Tensor<1, 3> way =
        mesh.vertices[mesh.triangles[triangle][corner]] - mesh.vertices[pieces.vertices[from].vertex];
    if (const auto arc = arcs.find(from); arc != arcs.end())
      return arc->second.at(way);
    Quadric result = own_fit(from);
    turn_frame(result, result.normal_at(way));
    return result;
  }



  unsigned int VertexFits::lender(const unsigned int triangle)
  {
    if (lenders[triangle] == unknown)
      lenders[triangle] = find_lender(triangle);
    return lenders[triangle];
  }



  unsigned int VertexFits::find_lender(const unsigned int triangle)
  {
    double own = 0., left_over = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int p = pieces.of_corner[3 * triangle + i];
        own                  = std::max(own, is_fitted(p) ? own_fit(p).residual : 1.);
        left_over =
            std::max(left_over, is_fitted(p) ? own_fit(p).left_over : std::numeric_limits<double>::max());
      }
    unsigned int result = SurfaceTopology::none;
    if (own <= rule.exact)
      return result;
    double                    least = rule.lends * left_over;
    std::vector<unsigned int> near_corner;
    for (unsigned int i = 0; i < 3; ++i)
      {
        pieces.neighbours(near_corner, pieces.of_corner[3 * triangle + i], 2);
        for (const unsigned int q : near_corner)
          if (const Quadric &quadric = own_fit(q); has_fit[q] && quadric.residual <= rule.exact &&
                                                   quadric.n_checks >= rule.least_checks &&
                                                   quadric.left_over < least && lies_on(triangle, q))
            {
              least  = quadric.left_over;
              result = q;
            }
      }
    return result;
  }



  bool VertexFits::lies_on(const unsigned int triangle, const unsigned int piece_vertex)
  {
    const Quadric  &quadric = own_fit(piece_vertex);
    const auto      arc     = arcs.find(piece_vertex);
    const Point<3> &centre  = mesh.vertices[pieces.vertices[piece_vertex].vertex];
    double          most = 0., size = 0.;
    for (const unsigned int v : mesh.triangles[triangle])
      {
        const Tensor<1, 3> x = mesh.vertices[v] - centre;
        if (arc != arcs.end() && !arc->second.reaches(x))
          return false;
        most = std::max(most, std::abs(arc != arcs.end() ? arc->second.distance(x)
                                                         : x * quadric.normal - .5 * quadric.along(x)));
        size = std::max(size, .5 * std::abs(quadric.largest_curvature()) * x.norm_square());
      }
    return most <= 2. * (arc != arcs.end() ? rule.exact_arc : rule.exact) * size;
  }



  const Quadric &VertexFits::own_fit(const unsigned int piece_vertex)
  {
    if (!was_tried[piece_vertex])
      {
        has_fit[piece_vertex]   = fit_vertex(quadrics[piece_vertex], piece_vertex);
        was_tried[piece_vertex] = true;
      }
    return quadrics[piece_vertex];
  }



  bool VertexFits::is_fitted(const unsigned int piece_vertex)
  {
    own_fit(piece_vertex);
    return has_fit[piece_vertex];
  }



  Tensor<1, 3> VertexFits::find_straight_direction(const unsigned int piece_vertex)
  {
    const auto normal = [&](const unsigned int t) {
      const auto &[a, b, c] = mesh.triangles[t];
      const Tensor<1, 3> area =
          cross_product_3d(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
      const double length = area.norm();
      return length > 0. ? area / length : area;
    };
    Tensor<1, 3> first, last, result;
    for (const unsigned int t : pieces.vertices[piece_vertex].triangles)
      if (first = normal(t); first.norm() > 0.)
        break;
    // At an end of the curve one ring has two columns of cells only.
    pieces.neighbours(near, piece_vertex, pieces.vertices[piece_vertex].is_closed ? 1 : 2);
    near.push_back(piece_vertex);
    for (const unsigned int q : near)
      for (const unsigned int t : pieces.vertices[q].triangles)
        if (const Tensor<1, 3> across = cross_product_3d(first, normal(t)); across.norm() > result.norm())
          {
            last   = normal(t);
            result = across;
          }
    const double turn = result.norm();
    if (!(turn > rule.flat))
      return {};
    result /= turn;
    // Two planes have such a direction on every surface.
    bool has_third = false;
    for (const unsigned int q : near)
      for (const unsigned int t : pieces.vertices[q].triangles)
        {
          const Tensor<1, 3> n = normal(t);
          if (std::abs(n * result) > rule.flat * turn)
            return {};
          has_third = has_third || (n.norm() > 0. &&
                                    std::min((n - first).norm(), (n - last).norm()) > rule.distinct * turn);
        }
    return has_third ? result : Tensor<1, 3>();
  }



  std::vector<unsigned int> VertexFits::neighbours(const unsigned int piece_vertex,
                                                   const unsigned int n_rings) const
  {
    std::vector<unsigned int> result;
    pieces.neighbours(result, piece_vertex, n_rings);
    return result;
  }



  std::vector<Tensor<1, 3>> VertexFits::ways(const unsigned int               piece_vertex,
                                             const std::vector<unsigned int> &others) const
  {
    std::vector<Tensor<1, 3>> result;
    const Point<3>           &centre = mesh.vertices[pieces.vertices[piece_vertex].vertex];
    for (const unsigned int q : others)
      if (const Tensor<1, 3> x = mesh.vertices[pieces.vertices[q].vertex] - centre; x.norm() > 0.)
        result.push_back(x);
    return result;
  }



  void VertexFits::fit_end_of_curve(Quadric &quadric, const unsigned int piece_vertex,
                                    const Tensor<1, 3> &straight, const unsigned int n_rings)
  {
    if (pieces.vertices[piece_vertex].is_closed)
      return;
    for (unsigned int rings = n_rings; rings <= rule.rings_at_ends; ++rings)
      {
        const std::vector<Tensor<1, 3>> points = ways(piece_vertex, neighbours(piece_vertex, rings));
        if (places_across(points, straight).size() < rule.places_at_ends)
          continue;
        if (Quadric farther = quadric;
            rings > n_rings && fit_extruded(farther, points, straight) && farther.residual <= rule.goes_on)
          quadric = farther;
        return;
      }
  }



  void VertexFits::fit_changing_curvature(Quadric &quadric, const unsigned int piece_vertex)
  {
    const unsigned int n_rings = pieces.vertices[piece_vertex].is_closed ? 2 : 3;
    if (Quadric cubic = quadric; fit_cubic(cubic, ways(piece_vertex, neighbours(piece_vertex, n_rings))) &&
                                 cubic.n_checks > rule.least_checks &&
                                 cubic.left_over <= rule.cubic_leaves * quadric.left_over)
      quadric = cubic;
  }



  bool VertexFits::fit_exactly(Quadric &quadric, const unsigned int piece_vertex)
  {
    const bool is_closed = pieces.vertices[piece_vertex].is_closed;
    if (is_closed)
      if (Quadric sphere = quadric; fit_sphere(sphere, ways(piece_vertex, neighbours(piece_vertex, 1))) &&
                                    sphere.residual <= rule.exact && sphere.n_checks >= rule.least_checks)
        {
          quadric = sphere;
          return true;
        }
    const auto take_arc = [&](const std::vector<Tensor<1, 3>> &points) {
      Quadric     start = quadric;
      RevolvedArc arc;
      if (!fit(start, points) || start.residual > rule.may_be_arc || !fit(arc, start, points) ||
          arc.residual > rule.exact_arc || arc.n_checks < rule.least_checks)
        return false;
      quadric            = arc.at(Tensor<1, 3>());
      arcs[piece_vertex] = arc;
      return true;
    };
    if (take_arc(ways(piece_vertex, neighbours(piece_vertex, is_closed ? 2 : 3))))
      return true;
    if (!is_closed)
      return false;
    // Two rings reach beyond a fillet of few faces, those of two neighbours on it may not.
    const std::vector<unsigned int> ring = neighbours(piece_vertex, 1);
    for (const unsigned int other : ring)
      if (pieces.vertices[other].is_closed)
        {
          std::vector<unsigned int> both = neighbours(other, 1);
          both.insert(both.end(), ring.begin(), ring.end());
          std::sort(both.begin(), both.end());
          both.erase(std::unique(both.begin(), both.end()), both.end());
          if (take_arc(ways(piece_vertex, both)))
            return true;
        }
    return false;
  }



  bool VertexFits::fit_vertex(Quadric &quadric, const unsigned int piece_vertex)
  {
    const PieceVertex &centre = pieces.vertices[piece_vertex];
    Tensor<1, 3>       mean, some;
    for (const unsigned int t : centre.triangles)
      {
        const unsigned int i = pieces.corner_of(t, piece_vertex);
        const auto        &v = mesh.triangles[t];
        const Point<3>    &x = mesh.vertices[v[i]], &next = mesh.vertices[v[(i + 1) % 3]],
                       &previous = mesh.vertices[v[(i + 2) % 3]];
        mean += corner_normal(x, next, previous);
        if (some.norm() == 0.)
          some = cross_product_3d(next - x, previous - x);
      }
    if (mean.norm() > 0. || some.norm() > 0.)
      set_frame(quadric, mean.norm() > 0. ? mean : some);
    const Tensor<1, 3> straight = find_straight_direction(piece_vertex);
    // A corner of the surface may need one more ring.
    for (unsigned int n_rings = 2; n_rings <= 3; ++n_rings)
      {
        const std::vector<Tensor<1, 3>> points = ways(piece_vertex, neighbours(piece_vertex, n_rings));
        Quadric                         found  = quadric;
        if (straight.norm() > 0. ? !fit_extruded(found, points, straight) : !fit(found, points))
          continue;
        quadric = found;
        if (straight.norm() > 0.)
          fit_end_of_curve(quadric, piece_vertex, straight, n_rings);
        else if (quadric.residual > rule.exact && !fit_exactly(quadric, piece_vertex))
          fit_changing_curvature(quadric, piece_vertex);
        return true;
      }
    return false;
  }
} // namespace Signorini
