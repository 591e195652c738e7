// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_box_tree_h
#define signorini_surface_box_tree_h

#include <deal.II/base/point.h>

#include <array>
#include <memory>
#include <vector>

namespace Signorini
{
  struct SurfaceMesh;

  /// Spatial search among boxes (of triangles, of edges): an r-tree of boost, built in O(n log n).
  class BoxTree
  {
  public:
    /// A box along the axes.
    struct Box
    {
      /// Lower and upper corner (length).
      dealii::Point<3> low, high;

      /// Makes the box large enough for a point.
      void include(const dealii::Point<3> &p);
    };

    /// Boxes are called by their index from then on.
    explicit BoxTree(const std::vector<Box> &boxes);
    /// Moves the tree.
    BoxTree(BoxTree &&) noexcept;
    ~BoxTree();

    /// The boxes that an infinite line meets, in no particular order.
    void find_along_line(std::vector<unsigned int> &found, const dealii::Point<3> &p,
                         const dealii::Tensor<1, 3> &direction) const;

    /// The same for the segment from a to b.
    void find_along_segment(std::vector<unsigned int> &found, const dealii::Point<3> &a,
                            const dealii::Point<3> &b) const;

    /// The boxes that overlap another one, or as many of them as are wanted.
    void find_overlapping(std::vector<unsigned int> &found, const Box &box,
                          const unsigned int at_most = static_cast<unsigned int>(-1)) const;

    /// The `number` boxes nearest to a point.
    void find_nearest(std::vector<unsigned int> &found, const dealii::Point<3> &p,
                      const unsigned int number) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree;
  };

  /// Of the triangles of a surface, by their numbers.
  BoxTree tree_of_triangles(const SurfaceMesh &mesh);
} // namespace Signorini

#endif
