// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_node_movement_h
#define signorini_mesh_node_movement_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <deal.II/base/types.h>

#include <map>
#include <utility>
#include <vector>

namespace Signorini
{
  /// What moving nodes did to the cells: worst quality (scaled Jacobian of hexahedra, mean ratio of
  /// tetrahedra; 1 is best) of those around moved nodes, and the numbers of nodes.
  struct MovementReport
  {
    /// Least quality of a cell before and after; nodes that were moved, and those of them that did not go the
    /// whole way.
    double      quality_before = 1., quality_after = 1.;
    std::size_t n_moved = 0, n_damped = 0;
    /// Of each boundary with vertices that are not on its shape: their number, and the largest distance.
    std::map<dealii::types::boundary_id, std::pair<std::size_t, double>> late;

    /// Joins the reports of two movements.
    void add(const MovementReport &other);
  };

  /// What ranks that share a mesh tell each other while vertices move. This class: the mesh is whole on every
  /// rank, and all of them do the same.
  class SharedVertices
  {
  public:
    virtual ~SharedVertices() = default;

    /// Whether this rank decides what happens to a vertex. It must have all cells around it.
    virtual bool owns(const unsigned int) const
    {
      return true;
    }

    /// Collective. Values of vertices (equally many of each) that others own become those of their owners.
    virtual void update(std::vector<double> &) const
    {
    }

    /// Collective. Of all ranks.
    virtual double minimum(const double value) const
    {
      return value;
    }

    /// Collective. Of all ranks.
    virtual double sum(const double value) const
    {
      return value;
    }

    /// Collective. Tries again to move single vertices.
    /// @param late vertices that this rank owns, those that are not there in the end
    /// @param targets where they should be
    /// @param is_free vertices that may give way
    /// @param reference quality of each cell that counts as whole, zero where it is that of now
    virtual void try_again(std::vector<unsigned int> &late, const std::vector<dealii::Point<3>> &targets,
                           std::vector<dealii::Point<3>>                            &positions,
                           const std::vector<dealii::ArrayView<const unsigned int>> &cells,
                           const std::vector<bool> &is_free, std::vector<double> &reference) const;
  };

  /// Moves vertices to their targets, and free ones around them along (their displacements are means of
  /// their neighbours'), as far as no cell becomes bad: not worse than a third of what it was (nor inverted).
  /// Where one would, the vertices of the cell that move go back half of the way, up to ten times, then all
  /// of it. Then those vertices are tried again one by one, the free ones around moving to where the worst of
  /// their cells is best (MovementRule). Vertices that did not reach their target are returned in `late`. The
  /// result does not depend on the number of ranks. Collective where the vertices are shared.
  /// @param targets of vertices that this rank owns, ascending
  /// @param cells each with the 4 or 8 vertices of a cell
  /// @param is_fixed vertices that may not follow: on boundaries and between materials
  /// @param late ascending, of the vertices that this rank owns
  MovementReport move_nodes(std::vector<dealii::Point<3>>                                &positions,
                            const std::vector<std::pair<unsigned int, dealii::Point<3>>> &targets,
                            const std::vector<dealii::ArrayView<const unsigned int>>     &cells,
                            const std::vector<bool> &is_fixed, std::vector<unsigned int> &late,
                            const SharedVertices &shared = SharedVertices());
} // namespace Signorini

#endif
