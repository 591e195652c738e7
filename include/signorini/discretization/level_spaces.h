// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_level_spaces_h
#define signorini_discretization_level_spaces_h

#include <signorini/algebra/replicated_data.h>
#include <signorini/discretization/background_levels.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/rigid_support.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Collective. Nodal interpolation between two nested spaces: for every owned fine node its weights on
  /// conforming coarse nodes (empty for hanging fine nodes). The fine mesh must come from the coarse one
  /// by refining hexahedra at most once; the two may be partitioned differently.
  /// @param forest of the tetrahedra, if there are any
  NodeRows interpolation_rows(const NodalSpace &fine, const NodalSpace &coarse,
                              const TetrahedralForest *const forest);

  /// What levels there are below the coarsest mesh.
  enum class CoarseLevels
  {
    /// Background levels where the coarsest mesh is too large for sparse factors.
    automatic,
    background,
    none
  };

  /// Where a level is too small for all ranks: messages then take longer than the work that is shared.
  struct SmallLevelsRule
  {
    /// Nodes that a rank has at least, on the mean, where there are several.
    NodeIndex least_nodes = 1000;

    /// Every how many ranks there is one that has nodes: a power of two, so that groups contain those of
    /// finer levels.
    unsigned int group_size(const NodeIndex n_nodes, const unsigned int n_ranks) const
    {
      unsigned int size = 1;
      while (size < n_ranks && n_nodes * size < least_nodes * n_ranks)
        size *= 2;
      return size;
    }
  };

  /// The levels of the hierarchy as nodes and the interpolation between consecutive ones: the meshes, and
  /// below the coarsest one background levels, if wanted. Small levels are owned by fewer ranks than the
  /// meshes are.
  class LevelSpaces
  {
  public:
    /// Collective. The coarser spaces (CoarserSpaces::update()) come coarsest first. The finest must outlive
    /// the object.
    LevelSpaces(const NodalSpace &finest, std::vector<std::shared_ptr<const NodalSpace>> coarser,
                const Bodies &bodies, const Loads &loads,
                const CoarseLevels coarse_levels = CoarseLevels::automatic);

    /// Level 0 is the coarsest.
    unsigned int n_levels() const
    {
      return static_cast<unsigned int>(owned_nodes.size());
    }

    /// How many of the levels have no meshes.
    unsigned int n_background_levels() const
    {
      return n_background;
    }

    /// The nodes of a level.
    const dealii::IndexSet &owned(const unsigned int level) const
    {
      return owned_nodes[level];
    }

    /// Where the owned nodes of level 0 are.
    const NodePlaces &coarsest_places() const
    {
      return places;
    }

    /// Rows of the owned nodes of level `level` on level - 1.
    const NodeRows &interpolation(const unsigned int level) const
    {
      return rows[level - 1];
    }

    /// Fixed masks of the owned nodes of a level; hanging nodes are fixed altogether.
    const std::vector<FixedDirections> &fixed(const unsigned int level) const
    {
      return masks[level];
    }

    /// Whether the functions of a level are zero where components of the next finer one are fixed: all but
    /// those under a mesh.
    bool is_nested(const unsigned int level) const
    {
      return level + 1 != n_background;
    }

    /// Rigid faces on a level; null without.
    const RigidFaces *rigid(const unsigned int level) const
    {
      return rigid_faces.empty() ? nullptr : rigid_faces[level].get();
    }

    /// Whether a level has nodes that are fixed in directions that are no axes of coordinates; the same on
    /// all ranks.
    bool has_rollers() const
    {
      return with_rollers;
    }

  private:
    void add_background(std::vector<DistributedBackgroundLevel> &&levels,
                        const std::vector<RigidFace>             &rigid);
    /// Collective. Small levels move to fewer ranks.
    void gather_small_levels(const MPI_Comm communicator);
    void gather_level(const unsigned int level, const MPI_Comm group);

    std::vector<dealii::IndexSet>             owned_nodes;
    std::vector<NodeRows>                     rows;
    std::vector<std::vector<FixedDirections>> masks;
    NodePlaces                                places;
    /// By level; empty without rigid faces.
    std::vector<std::shared_ptr<const RigidFaces>> rigid_faces;
    unsigned int                                   n_background = 0;
    bool                                           with_rollers = false;
  };
} // namespace Signorini

#endif
