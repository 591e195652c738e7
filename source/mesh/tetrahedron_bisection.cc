// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/tetrahedron_bisection.h>

#include <algorithm>
#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Edge = BisectionMarking::Edge;

    bool contains(const Edge &edge, const unsigned int v)
    {
      return edge[0] == v || edge[1] == v;
    }

    Edge opposite(const Edge &edge)
    {
      Edge         other{};
      unsigned int n = 0;
      for (unsigned char v = 0; v < 4; ++v)
        if (!contains(edge, v))
          other[n++] = v;
      return other;
    }

    /// The longest edge between some of the corners of a cell.
    Edge longest(const Tetrahedron &cell, const std::vector<Point<3>> &vertices,
                 const ArrayView<const unsigned int> &corners)
    {
      Edge                                           best{};
      std::tuple<double, unsigned int, unsigned int> most(-1., 0, 0);
      for (unsigned int i = 0; i < corners.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          {
            const unsigned int a = std::min(cell.vertices[corners[i]], cell.vertices[corners[j]]);
            const unsigned int b = std::max(cell.vertices[corners[i]], cell.vertices[corners[j]]);
            const std::tuple<double, unsigned int, unsigned int> size(
                (vertices[a] - vertices[b]).norm_square(), b, a);
            if (size > most)
              {
                most = size;
                best = {{static_cast<unsigned char>(corners[j]), static_cast<unsigned char>(corners[i])}};
              }
          }
      return best;
    }
  } // namespace



  double tetrahedron_quality(const std::array<Point<3>, 4> &x)
  {
    const double volume  = cross_product_3d(x[1] - x[0], x[2] - x[0]) * (x[3] - x[0]) / 6.;
    double       squares = 0.;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < i; ++j)
        squares += (x[i] - x[j]).norm_square();
    return squares > 0. ? 12. * std::copysign(std::pow(3. * std::abs(volume), 2. / 3.), volume) / squares
                        : 0.;
  }



  BisectionMarking mark_longest_edges(const Tetrahedron &cell, const std::vector<Point<3>> &vertices)
  {
    static const unsigned int all[] = {0, 1, 2, 3};
    BisectionMarking          marking;
    for (unsigned int f = 0; f < 4; ++f)
      marking.face_edge[f] = longest(cell, vertices, CellShape::face(4, f));
    marking.refinement_edge = longest(cell, vertices, ArrayView<const unsigned int>(all, 4));
    marking.flag            = false;
    return marking;
  }



  namespace
  {
    /// The half that keeps vertex r[k] of the refinement edge r: the middle takes the place of the other end.
    MarkedTetrahedron half(const MarkedTetrahedron &parent, const unsigned int middle, const unsigned int k,
                           const bool is_planar)
    {
      const BisectionMarking &marking = parent.marking;
      const Edge              r = marking.refinement_edge, other = opposite(r);
      const unsigned char     gone = r[1 - k], kept = r[k];
      MarkedTetrahedron       child = parent;
      child.cell.vertices[gone]     = middle;
      ++child.cell.generation;
      // Opposite to the midpoint: the inherited face. Opposite to the kept end: the new one.
      child.cell.boundary[kept]     = Tetrahedron::inner;
      child.marking.face_edge[gone] = marking.face_edge[gone];
      child.marking.refinement_edge = marking.face_edge[gone];
      for (const unsigned char f : other)
        {
          // A half of a face with the refinement edge: its edge opposite to the midpoint.
          const unsigned char third  = other[0] == f ? other[1] : other[0];
          child.marking.face_edge[f] = {{kept, third}};
        }
      if (is_planar && marking.flag)
        {
          // From the midpoint to the new refinement edge: their common vertex in the new face.
          const Edge         &next      = child.marking.refinement_edge;
          const unsigned char end       = contains(next, other[0]) && !contains(next, other[1])   ? other[0]
                                          : contains(next, other[1]) && !contains(next, other[0]) ? other[1]
                                                                                                  : other[0];
          child.marking.face_edge[kept] = {{gone, end}};
        }
      else
        child.marking.face_edge[kept] = other;
      child.marking.flag = is_planar && !marking.flag;
      return child;
    }
  } // namespace



  std::array<MarkedTetrahedron, 2> bisect(const MarkedTetrahedron &parent, const unsigned int middle)
  {
    const BisectionMarking &marking = parent.marking;
    const Edge              r       = marking.refinement_edge;
    // Planar: the marked edges of all four faces lie in one plane, that of a face with the refinement edge.
    // The faces without it are those opposite to r[0] and r[1].
    const Edge m0 = marking.face_edge[r[0]], m1 = marking.face_edge[r[1]];
    bool       is_planar = false;
    for (const unsigned char f : opposite(r))
      is_planar = is_planar || (!contains(m0, f) && !contains(m1, f));
    return {{half(parent, middle, 0, is_planar), half(parent, middle, 1, is_planar)}};
  }
} // namespace Signorini
