// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "serial_forest.h"

#include <signorini/mesh/cell_shape.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Edge = std::array<unsigned char, 2>;

    std::uint64_t edge_key(const unsigned int a, const unsigned int b)
    {
      return static_cast<std::uint64_t>(std::max(a, b)) << 32 | std::min(a, b);
    }

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
  } // namespace



  SerialForest::SerialForest(const std::vector<Point<3>> &vertices, const std::vector<Cell> &cells)
    : points(vertices)
    , vertex_parents(vertices.size())
  {
    for (unsigned int v = 0; v < vertices.size(); ++v)
      vertex_parents[v] = {{v, v}};
    // A strict order of the edges, the same for all cells: by length, then by vertex numbers.
    const auto longest = [&](const Cell &cell, const ArrayView<const unsigned int> &corners) {
      Edge                             best{};
      std::pair<double, std::uint64_t> most(-1., 0);
      for (unsigned int i = 0; i < corners.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          {
            const unsigned int a = std::min(cell.vertices[corners[i]], cell.vertices[corners[j]]);
            const unsigned int b = std::max(cell.vertices[corners[i]], cell.vertices[corners[j]]);
            const std::pair<double, std::uint64_t> size((points[a] - points[b]).norm_square(),
                                                        edge_key(a, b));
            if (size > most)
              {
                most = size;
                best = {{static_cast<unsigned char>(corners[j]), static_cast<unsigned char>(corners[i])}};
              }
          }
      return best;
    };
    static const unsigned int all[] = {0, 1, 2, 3};
    for (const Cell &cell : cells)
      {
        Marking marking;
        for (unsigned int f = 0; f < 4; ++f)
          marking.face_edge[f] = longest(cell, CellShape::face(4, f));
        marking.refinement_edge = longest(cell, ArrayView<const unsigned int>(all, 4));
        marking.flag            = false;
        markings.push_back(marking);
      }
    levels.push_back({cells, static_cast<unsigned int>(vertices.size())});
    order_cells(levels.back().cells, markings);
  }



  void SerialForest::order_cells(std::vector<Cell> &cells, std::vector<Marking> &marks) const
  {
    std::vector<Point<3>> centres;
    centres.reserve(cells.size());
    for (const Cell &cell : cells)
      centres.push_back(
          Point<3>(.25 * (points[cell.vertices[0]] + Tensor<1, 3>(points[cell.vertices[1]]) +
                          Tensor<1, 3>(points[cell.vertices[2]]) + Tensor<1, 3>(points[cell.vertices[3]]))));
    // A cube around them.
    Point<3> low = centres[0], high = centres[0];
    for (const Point<3> &c : centres)
      for (unsigned int d = 0; d < 3; ++d)
        {
          low[d]  = std::min(low[d], c[d]);
          high[d] = std::max(high[d], c[d]);
        }
    const double width = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    centres.push_back(low);
    centres.push_back(low + Tensor<1, 3>({width, width, width}));
    const auto                key = Utilities::inverse_Hilbert_space_filling_curve(centres, 20);
    std::vector<unsigned int> order(cells.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
      return key[a] != key[b] ? key[a] < key[b] : cells[a].vertices < cells[b].vertices;
    });
    std::vector<Cell>    sorted_cells;
    std::vector<Marking> sorted_marks;
    sorted_cells.reserve(cells.size());
    sorted_marks.reserve(cells.size());
    for (const unsigned int i : order)
      {
        sorted_cells.push_back(cells[i]);
        sorted_marks.push_back(marks[i]);
      }
    cells.swap(sorted_cells);
    marks.swap(sorted_marks);
  }



  unsigned int SerialForest::middle_of(const unsigned int a, const unsigned int b)
  {
    const auto [it, is_new] = middles.insert({edge_key(a, b), static_cast<unsigned int>(points.size())});
    if (is_new)
      {
        // The same bits whichever end comes first.
        points.push_back(Point<3>(.5 * (Tensor<1, 3>(points[a]) + Tensor<1, 3>(points[b]))));
        vertex_parents.push_back({{std::min(a, b), std::max(a, b)}});
        at_split_edge.resize(points.size(), false);
        at_split_edge[a] = at_split_edge[b] = true;
      }
    return it->second;
  }



  bool SerialForest::has_split_edge(const Cell &cell) const
  {
    for (unsigned int i = 1; i < 4; ++i)
      if (at_split_edge[cell.vertices[i]])
        for (unsigned int j = 0; j < i; ++j)
          if (at_split_edge[cell.vertices[j]] &&
              middles.count(edge_key(cell.vertices[i], cell.vertices[j])) > 0)
            return true;
    return false;
  }



  void SerialForest::bisect(const WorkItem &parent, WorkItem (&children)[2])
  {
    const Marking     &marking = parent.marking;
    const Edge         r = marking.refinement_edge, other = opposite(r);
    const unsigned int middle = middle_of(parent.cell.vertices[r[0]], parent.cell.vertices[r[1]]);
    for (const unsigned char f : other)
      if (parent.cell.boundary[f] != inner)
        new_on_boundary.emplace_back(middle, parent.cell.boundary[f]);
    // Planar: the marked edges of all four faces lie in one plane, that of a face with the refinement edge.
    // The faces without it are those opposite to r[0] and r[1].
    const Edge m0 = marking.face_edge[r[0]], m1 = marking.face_edge[r[1]];
    bool       planar = false;
    for (const unsigned char f : other)
      planar = planar || (!contains(m0, f) && !contains(m1, f));
    for (unsigned int k = 0; k < 2; ++k)
      {
        // The child keeps vertex r[k]; the midpoint takes the place of `gone`, the other end.
        const unsigned char gone = r[1 - k], kept = r[k];
        WorkItem           &child = children[k];
        child.cell                = parent.cell;
        child.cell.vertices[gone] = middle;
        ++child.cell.generation;
        child.bisections = parent.bisections > 0 ? parent.bisections - 1 : 0;
        // Opposite to the midpoint: the inherited face. Opposite to the kept end: the new one.
        child.cell.boundary[kept]     = inner;
        child.marking.face_edge[gone] = marking.face_edge[gone];
        child.marking.refinement_edge = marking.face_edge[gone];
        for (const unsigned char f : other)
          {
            // A half of a face with the refinement edge: its edge opposite to the midpoint.
            const unsigned char third  = other[0] == f ? other[1] : other[0];
            child.marking.face_edge[f] = {{kept, third}};
          }
        if (planar && marking.flag)
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
        child.marking.flag = planar && !marking.flag;
      }
  }



  bool SerialForest::refine(const std::vector<bool> &marked)
  {
    AssertDimension(marked.size(), levels.back().cells.size());
    if (std::find(marked.begin(), marked.end(), true) == marked.end())
      return false;
    new_on_boundary.clear();
    middles.clear();
    at_split_edge.assign(points.size(), false);
    std::vector<WorkItem> work, next;
    work.reserve(marked.size());
    for (std::size_t i = 0; i < marked.size(); ++i)
      work.push_back({levels.back().cells[i], markings[i], marked[i] ? 3u : 0u});
    for (bool changed = true; changed;)
      {
        changed = false;
        next.clear();
        next.reserve(2 * work.size());
        for (const WorkItem &item : work)
          if (item.bisections > 0 || has_split_edge(item.cell))
            {
              WorkItem children[2];
              bisect(item, children);
              next.push_back(children[0]);
              next.push_back(children[1]);
              changed = true;
            }
          else
            next.push_back(item);
        work.swap(next);
      }
    std::sort(new_on_boundary.begin(), new_on_boundary.end());
    new_on_boundary.erase(std::unique(new_on_boundary.begin(), new_on_boundary.end()), new_on_boundary.end());
    middles.clear();
    at_split_edge.clear();
    levels.push_back({{}, static_cast<unsigned int>(points.size())});
    markings.clear();
    for (const WorkItem &item : work)
      {
        levels.back().cells.push_back(item.cell);
        markings.push_back(item.marking);
      }
    order_cells(levels.back().cells, markings);
    return true;
  }
} // namespace Signorini
