// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/box_tree.h>
#include <signorini/surface/surface_mesh.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace Signorini
{
  using namespace dealii;

  namespace bg  = boost::geometry;
  namespace bgi = boost::geometry::index;

  namespace
  {
    using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
    using TreeBox   = bg::model::box<TreePoint>;
    using TreeValue = std::pair<TreeBox, unsigned int>;

    template <typename P>
    TreePoint tree_point(const P &p)
    {
      return {p[0], p[1], p[2]};
    }

    /// Takes the numbers of found boxes.
    struct Collector
    {
      using iterator_category = std::output_iterator_tag;
      using value_type        = void;
      using difference_type   = void;
      using pointer           = void;
      using reference         = void;

      std::vector<unsigned int> *found;

      Collector &operator*()
      {
        return *this;
      }
      Collector &operator++()
      {
        return *this;
      }
      Collector operator++(int)
      {
        return *this;
      }
      Collector &operator=(const TreeValue &value)
      {
        found->push_back(value.second);
        return *this;
      }
    };
  } // namespace



  struct BoxTree::Tree
  {
    bgi::rtree<TreeValue, bgi::linear<16>> values;
  };



  void BoxTree::Box::include(const Point<3> &p)
  {
    for (unsigned int c = 0; c < 3; ++c)
      {
        low[c]  = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
  }



  BoxTree::BoxTree(const std::vector<Box> &boxes)
    : tree(std::make_unique<Tree>())
  {
    std::vector<TreeValue> values;
    values.reserve(boxes.size());
    for (unsigned int i = 0; i < boxes.size(); ++i)
      {
        // A box of a flat triangle has no thickness: give it some, against rounding in the line test.
        Point<3>     low = boxes[i].low, high = boxes[i].high;
        const double margin = 1e-9 * low.distance(high);
        for (unsigned int c = 0; c < 3; ++c)
          {
            low[c] -= margin;
            high[c] += margin;
          }
        values.emplace_back(TreeBox(tree_point(low), tree_point(high)), i);
      }
    tree->values = decltype(tree->values)(values.begin(), values.end());
  }



  BoxTree::BoxTree(BoxTree &&) noexcept = default;
  BoxTree::~BoxTree()                   = default;



  void BoxTree::find_along_line(std::vector<unsigned int> &found, const Point<3> &p,
                                const Tensor<1, 3> &direction) const
  {
    found.clear();
    if (tree->values.empty())
      return;
    // A segment as long as the boxes reach.
    const auto   bounds = tree->values.bounds();
    const auto  &low = bounds.min_corner(), &high = bounds.max_corner();
    const double reach = std::max(std::abs(low.get<0>() - p[0]), std::abs(high.get<0>() - p[0])) +
                         std::max(std::abs(low.get<1>() - p[1]), std::abs(high.get<1>() - p[1])) +
                         std::max(std::abs(low.get<2>() - p[2]), std::abs(high.get<2>() - p[2]));
    find_along_segment(found, p - reach * direction, p + reach * direction);
  }



  void BoxTree::find_along_segment(std::vector<unsigned int> &found, const Point<3> &a,
                                   const Point<3> &b) const
  {
    found.clear();
    const bg::model::segment<TreePoint> segment(tree_point(a), tree_point(b));
    tree->values.query(bgi::intersects(segment), Collector{&found});
  }



  void BoxTree::find_overlapping(std::vector<unsigned int> &found, const Box &box,
                                 const unsigned int at_most) const
  {
    found.clear();
    const auto overlap = bgi::intersects(TreeBox(tree_point(box.low), tree_point(box.high)));
    for (auto it = tree->values.qbegin(overlap); it != tree->values.qend() && found.size() < at_most; ++it)
      found.push_back(it->second);
  }



  void BoxTree::find_nearest(std::vector<unsigned int> &found, const Point<3> &p,
                             const unsigned int number) const
  {
    found.clear();
    tree->values.query(bgi::nearest(tree_point(p), number), Collector{&found});
  }



  BoxTree tree_of_triangles(const SurfaceMesh &mesh)
  {
    std::vector<BoxTree::Box> boxes;
    boxes.reserve(mesh.triangles.size());
    for (const auto &t : mesh.triangles)
      {
        BoxTree::Box box{mesh.vertices[t[0]], mesh.vertices[t[0]]};
        box.include(mesh.vertices[t[1]]);
        box.include(mesh.vertices[t[2]]);
        boxes.push_back(box);
      }
    return BoxTree(boxes);
  }
} // namespace Signorini
