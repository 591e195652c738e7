// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_nodal_space_h
#define signorini_mesh_nodal_space_h

#include <signorini/algebra/types.h>
#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/tetrahedral_forest.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace Signorini
{
  /// The vertices of the start meshes, counted over all bodies: what single nodes and sets of nodes are named
  /// by. The same on all ranks.
  struct StartNodes
  {
    /// No vertex.
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /// The vertices of the coarse hexahedra by NodalSpace::Cell::coarse_cell (in deal.II's order), and of the
    /// start mesh of the forest.
    std::vector<std::array<unsigned int, 8>> hexahedra;
    std::vector<unsigned int>                forest;
    /// Sets of vertices; for each vertex the sets that it belongs to, ascending (empty without sets).
    unsigned int                           n_sets = 0;
    std::vector<std::vector<unsigned int>> sets_of;
  };

  /// One mesh of the hierarchy: hexahedra, tetrahedra or both. What is missing is null.
  struct MeshView
  {
    /// The meshes; they must outlive the view.
    const dealii::parallel::distributed::Triangulation<3> *hexahedra  = nullptr;
    const TetrahedralForest                               *tetrahedra = nullptr;
    /// Which mesh of the forest.
    unsigned int tetrahedral_level = 0;
    /// Of the start meshes; it need not outlive the space.
    const StartNodes *start = nullptr;
  };

  /// (Tri)linear nodal space on a mesh: the cells this rank sees as plain data, the numbering of the nodes
  /// (hanging ones included), hanging node constraints and node positions. The layers above know
  /// meshes only through it, and it needs neither triangulation nor forest once it is built.
  ///
  /// Positions are a field of our own, because moved vertices do not survive refinement on a
  /// distributed triangulation: a conforming node lies at its mesh vertex, a hanging node at the
  /// constrained mean of its parents, so that the geometry has no cracks.
  class NodalSpace
  {
  public:
    /// An owned or a ghost cell.
    struct Cell
    {
      /// A name that does not depend on the number of ranks: coarse cell and path of children with a leading
      /// 1 (hexahedra); a number beyond the coarse hexahedra and 1 (tetrahedra).
      std::uint64_t coarse_cell, path;
      unsigned int  first_node;
      unsigned char n_vertices;
      bool          is_owned;
      /// How many times the cell was refined to half the size (three bisections of a tetrahedron).
      unsigned char level;
      unsigned int  material;
    };

    /// A face of an owned or ghost cell on the boundary.
    struct BoundaryFace
    {
      /// Index of the cell in cells(), number of the face in it, and the boundary.
      unsigned int               cell;
      unsigned char              face;
      dealii::types::boundary_id id;
      /// Of owned cells: behind each corner (CellShape::face) the hanging vertex on the edge to the next, or
      /// invalid_node.
      std::array<NodeIndex, 4> hanging;
    };

    /// A face between two cells, of which at least one is owned. With a hanging face it is that of the
    /// smaller cell.
    struct InnerFace
    {
      /// Indices of the two cells in cells(), and number of the face in the first.
      unsigned int  cell, other;
      unsigned char face;
    };

    /// Collective. Inner faces are listed if they are wanted.
    NodalSpace(const MPI_Comm communicator, const MeshView &mesh, const bool with_inner_faces = false);

    /// The ranks that share the space.
    MPI_Comm communicator() const
    {
      return comm;
    }

    /// Owned and ghost cells.
    const std::vector<Cell> &cells() const
    {
      return cell_list;
    }

    /// The 4 or 8 nodes of a cell.
    dealii::ArrayView<const NodeIndex> nodes(const Cell &cell) const
    {
      return {cell_nodes.data() + cell.first_node, cell.n_vertices};
    }

    /// Of owned and ghost cells.
    const std::vector<BoundaryFace> &boundary_faces() const
    {
      return boundary;
    }

    /// Empty unless they were wanted.
    const std::vector<InnerFace> &inner_faces() const
    {
      return inner;
    }

    /// Closed hanging node constraints u_h = sum_k C_hk u_k of the locally relevant nodes.
    const dealii::AffineConstraints<double> &hanging_nodes() const
    {
      return constraints;
    }

    /// Number of nodes of all ranks, hanging ones included.
    NodeIndex n_nodes() const
    {
      return owned_nodes.size();
    }

    /// Number of nodes that are not hanging, over all ranks.
    NodeIndex n_conforming_nodes() const
    {
      return n_conforming;
    }

    /// Number of cells over all ranks.
    std::uint64_t n_global_cells() const
    {
      return n_cells_of_all;
    }

    /// The nodes of this rank: a range.
    const dealii::IndexSet &owned() const
    {
      return owned_nodes;
    }

    /// Owned nodes, nodes of ghost cells, and parents of hanging ones among them.
    const dealii::IndexSet &relevant() const
    {
      return relevant_nodes;
    }

    /// Position of a relevant node.
    const dealii::Point<3> &position(const NodeIndex node) const
    {
      return positions[relevant_nodes.index_within_set(node)];
    }

    /// By relevant node (in the order of relevant()) the vertex of the start meshes at it, or
    /// StartNodes::none.
    const std::vector<unsigned int> &start_vertices() const
    {
      return start_vertex;
    }

    /// By set of nodes: its nodes at the cells of this rank that are not hanging, ascending. New nodes on an
    /// edge, a face or in a cell of the start mesh belong to the sets to which all of its vertices belong.
    const std::vector<std::vector<NodeIndex>> &node_sets() const
    {
      return nodes_of_set;
    }

    /// Which mesh of the forest its tetrahedra are.
    unsigned int tetrahedral_level() const
    {
      return forest_level;
    }

    /// Number of the owned nodes of tetrahedra; they come after those of hexahedra.
    NodeIndex n_owned_forest_nodes() const
    {
      return owned_vertices.size();
    }

    /// Names of the vertices of the owned nodes of tetrahedra, in their order.
    const std::vector<ForestMesh::Name> &owned_forest_vertices() const
    {
      return owned_vertices;
    }

  private:
    struct Hexahedra;
    struct Numbering;

    void add_hexahedra(std::vector<dealii::Point<3>> &corner_points, const MeshView &mesh,
                       const Hexahedra &part, const Numbering &numbering);
    void add_tetrahedra(std::vector<dealii::Point<3>> &corner_points, const MeshView &mesh,
                        const Numbering &numbering);
    void add_inner_faces(const ForestMesh &mesh, const unsigned int first_cell);
    void set_positions(const std::vector<dealii::Point<3>> &corner_points);
    void find_start_nodes(const MeshView &mesh);
    void add_start_nodes_of_hexahedra(const StartNodes &start, std::vector<bool> &is_done);
    void add_start_nodes_of_tetrahedra(const StartNodes &start, const MeshView &mesh);
    void add_to_sets(const NodeIndex node, const std::vector<unsigned int> &sets);

    const MPI_Comm                    comm;
    const bool                        with_inner_faces;
    std::vector<Cell>                 cell_list;
    std::vector<NodeIndex>            cell_nodes;
    std::vector<BoundaryFace>         boundary;
    std::vector<InnerFace>            inner;
    dealii::IndexSet                  owned_nodes, relevant_nodes;
    dealii::AffineConstraints<double> constraints;
    std::vector<dealii::Point<3>>     positions;
    /// By vertex of the mesh of the forest; only while the space is built.
    std::vector<NodeIndex>              node_of_vertex;
    std::vector<ForestMesh::Name>       owned_vertices;
    unsigned int                        forest_level = 0;
    std::vector<unsigned int>           start_vertex;
    std::vector<std::vector<NodeIndex>> nodes_of_set;
    NodeIndex                           n_conforming   = 0;
    std::uint64_t                       n_cells_of_all = 0;
  };
} // namespace Signorini

#endif
