// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_volume_mesh_h
#define signorini_mesh_volume_mesh_h

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  /// A mesh of hexahedra or tetrahedra as plain arrays, with named boundaries and volumes.
  struct VolumeMesh
  {
    /// Vertex numbers of a face; the fourth of a triangle is no_vertex.
    using Face                              = std::array<unsigned int, 4>;
    static constexpr unsigned int no_vertex = static_cast<unsigned int>(-1);

    /// A hexahedron or a tetrahedron.
    struct Cell
    {
      /// 8 in deal.II's order (lexicographic), or 4.
      std::array<unsigned int, 8> vertices;
      unsigned int                n_vertices;
      /// Index into volume_names.
      unsigned int volume;
    };

    /// A face that belongs to a named boundary.
    struct BoundaryFace
    {
      /// As in find_boundary_faces().
      Face vertices;
      /// Index into boundary_names.
      unsigned int name;
    };

    /// The mesh: positions (length), cells, and the faces of its boundaries.
    std::vector<dealii::Point<3>> vertices;
    std::vector<Cell>             cells;
    std::vector<BoundaryFace>     faces;
    /// Names that faces and cells refer to.
    std::vector<std::string> boundary_names;
    std::vector<std::string> volume_names;
    /// Names that stand for several boundaries (indices into boundary_names): a face has one boundary, but
    /// may belong to several groups. A group counts before a boundary of the same name.
    std::vector<std::pair<std::string, std::vector<unsigned int>>> boundary_groups;
    /// Named sets of vertices, which may overlap.
    std::vector<std::pair<std::string, std::vector<unsigned int>>> node_sets;
    /// What the file calls the vertices, as far as they are nodes of it: the first ones; empty if the mesh is
    /// from no file.
    std::vector<long>     node_numbers;
    static constexpr long no_number = -1;
    /// Remarks for the user, e.g. on mended cells.
    std::vector<std::string> notes;

    /// Positions of the vertices of a cell; the rest is zero.
    std::array<dealii::Point<3>, 8> corners(const Cell &cell) const;
  };

  /// For messages between ranks and processes.
  template <typename Archive>
  void transfer(Archive &archive, VolumeMesh::Cell &cell)
  {
    archive(cell.vertices, cell.n_vertices, cell.volume);
  }

  template <typename Archive>
  void transfer(Archive &archive, VolumeMesh::BoundaryFace &face)
  {
    archive(face.vertices, face.name);
  }

  template <typename Archive>
  void transfer(Archive &archive, VolumeMesh &mesh)
  {
    archive(mesh.vertices, mesh.cells, mesh.faces, mesh.boundary_names, mesh.volume_names,
            mesh.boundary_groups, mesh.node_sets, mesh.node_numbers, mesh.notes);
  }

  /// The same vertices in ascending order: what identifies a face.
  VolumeMesh::Face face_key(VolumeMesh::Face face);

  /// Faces that belong to one cell only (hexahedra: vertices in deal.II's face order), and that cell.
  /// Errors: InputError for faces that belong to more than two cells, and for cells that are there twice.
  using BoundaryOfCells = std::vector<std::pair<VolumeMesh::Face, unsigned int>>;
  BoundaryOfCells find_boundary_faces(const VolumeMesh &mesh);

  /// Names of faces, of which one may have several.
  struct FaceNames
  {
    /// Each once.
    std::vector<std::string> names;
    /// By face_key(): indices into the names.
    std::map<VolumeMesh::Face, std::set<unsigned int>> of_face;
  };

  /// Makes the boundary faces of a mesh and names them. Faces with the same names have a boundary together,
  /// "a & b"; a name that stands for several boundaries, or for a part of one, becomes a group. Faces without
  /// names are "unnamed".
  /// @param boundary of the cells of the mesh, find_boundary_faces()
  void name_faces(VolumeMesh &mesh, const BoundaryOfCells &boundary, FaceNames named);

  /// The index of a name, appended if new.
  unsigned int index_of(std::vector<std::string> &names, const std::string &name);

  /// For each cell the number of its connected part: cells that share a vertex are connected. Parts are
  /// numbered in the order of their first cells.
  std::vector<unsigned int> connected_parts(const VolumeMesh &mesh);

  /// Turns mirrored cells over, with a note; `where` names the mesh. Errors: InputError for degenerate and
  /// twisted cells.
  void mend_orientation(VolumeMesh &mesh, const std::string &where);

  /// Cuts every tetrahedron into four hexahedra (at the middles of edges, faces and cells); others stay.
  VolumeMesh split_into_hexahedra(const VolumeMesh &mesh);

  /// Cuts every hexahedron into twelve tetrahedra around its centre; the faces are cut along the diagonal
  /// from their smallest vertex number, so that the mesh is conforming. Tetrahedra stay.
  VolumeMesh split_into_tetrahedra(const VolumeMesh &mesh);

  /// Smallest of the 8 corner Jacobians of a hexahedron, each scaled by the product of its edge lengths: 1
  /// for a brick, not positive for an inverted cell.
  double scaled_jacobian(const std::array<dealii::Point<3>, 8> &corners);
} // namespace Signorini

#endif
