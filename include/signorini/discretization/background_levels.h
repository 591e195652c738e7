// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_background_levels_h
#define signorini_discretization_background_levels_h

#include <signorini/algebra/replicated_data.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>

#include <vector>

namespace Signorini
{
  /// Constants of the levels under a mesh that has no coarser ones.
  struct BackgroundRule
  {
    /// Size of the first cells over the local mesh size. 1.5 needs 12 iterations instead of 18 and twice the
    /// memory and time, 3 has rates of 0.6 on curved thick walls.
    double first_ratio = 2.2;
    /// Of the sum of the two shortest edges at a node: its mesh size. On stretched cells the coarse grid has
    /// to follow the short edges.
    double edge_share = .6;
    /// A level that keeps more than this part of the nodes is skipped.
    double largest_growth = .6;
    /// No level below one of this many nodes: sparse factors are cheaper than cycles.
    unsigned int smallest_level = 300;
  };

  /// Sets of nodes that are connected with each other, such as those of a cell, one after the other.
  struct NodeGroups
  {
    /// Set k has the nodes from place start[k] on, up to start[k + 1].
    std::vector<std::size_t> start = {0};
    /// By number.
    std::vector<unsigned int> nodes;
  };

  /// A mesh as it is seen from the levels below it.
  struct ConnectedNodes
  {
    /// Of the nodes (length).
    std::vector<dealii::Point<3>> positions;
    /// Mesh sizes at the nodes (length).
    std::vector<double> sizes;
    /// The parts (Bodies::part()) of the nodes.
    std::vector<unsigned int> parts;
    /// What is connected.
    NodeGroups cells;
  };

  /// A level of trilinear functions on an octree, under a mesh or another such level: one node for each
  /// function and each connected piece of its support (doc/algorithm.md, (39a)).
  struct BackgroundLevel
  {
    /// One row per node of the finer level: nonnegative weights of sum 1 that reproduce linear functions.
    NodeRows rows;
    /// Of the nodes of the level (length).
    std::vector<dealii::Point<3>> positions;
    /// The parts that they belong to.
    std::vector<unsigned int> parts;
  };

  /// The levels under a mesh, the finest first; each has cells twice as large as the one above or more. Every
  /// part has an octree of its own. Not collective. The order of the nodes matters to the numbering of the
  /// levels only.
  std::vector<BackgroundLevel> make_background_levels(const ConnectedNodes &mesh, const BackgroundRule &rule);



  /// A background level, distributed: every node has the owner of the finer node that depends on it most.
  struct DistributedBackgroundLevel
  {
    /// The nodes of this rank.
    dealii::IndexSet owned;
    /// One row per owned node of the finer level; empty where all of its components are fixed.
    NodeRows rows;
    /// Of the owned nodes (length).
    std::vector<dealii::Point<3>> positions;
    /// The parts that they belong to.
    std::vector<unsigned int> parts;
    /// Nodes that stand for the given ones, on all ranks.
    std::vector<NodeIndex> carriers;
  };

  /// Collective. The levels under a mesh, the finest first. Every rank makes all of them, from the whole
  /// mesh, which is a start mesh: all ranks know its cells.
  /// @param fixed masks of the owned nodes
  /// @param carriers nodes that have a node of their own on each level (of rigid faces); fixed altogether
  std::vector<DistributedBackgroundLevel> background_levels(const NodalSpace                   &space,
                                                            const std::vector<FixedDirections> &fixed,
                                                            const Bodies                       &bodies,
                                                            const std::vector<NodeIndex>       &carriers = {},
                                                            const BackgroundRule &rule = BackgroundRule());
} // namespace Signorini

#endif
