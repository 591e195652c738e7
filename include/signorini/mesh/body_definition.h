// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_body_definition_h
#define signorini_mesh_body_definition_h

#include <signorini/mesh/boundary_shape.h>
#include <signorini/mesh/material.h>
#include <signorini/mesh/volume_mesh.h>

#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  /// What the cells of a mesh are cut into before anything else is done with it.
  enum class CellConversion
  {
    none,
    /// Each tetrahedron into four hexahedra.
    to_hexahedra,
    /// Each hexahedron into twelve tetrahedra.
    to_tetrahedra
  };

  /// What hexahedra are made of.
  enum class ElementChoice
  {
    /// Mean dilatation where Poisson's ratio is above LockingRule::hexahedra, material by material.
    automatic,
    standard,
    mean_dilatation
  };

  /// How refinement follows the true geometry of a boundary.
  struct BoundaryGeometry
  {
    /// A boundary that the mesh names.
    std::string boundary;
    /// New nodes move to it and gaps are measured on it; where the body is, after its placement. May be null.
    BoundaryShapePointer shape;
    /// If not null it is this that places new vertices of hexahedra, and the shape is for gaps and
    /// tetrahedra. Where the body is, after its placement.
    std::shared_ptr<const dealii::Manifold<3>> manifold;
  };

  /// A body: its mesh, place, geometry and materials. Boundaries and volumes are those that the mesh names.
  struct BodyDefinition
  {
    /// What messages and results call it.
    std::string name;
    /// Of make_volume_mesh(), or filled in: then name_faces() makes the boundary, and mend_orientation()
    /// turns mirrored cells over.
    VolumeMesh     mesh;
    CellConversion conversion = CellConversion::none;
    /// Where the mesh is put.
    Placement placement;

    /// Of all cells but those of the volumes below.
    IsotropicMaterial material;
    /// Of volumes that differ from it.
    std::vector<std::pair<std::string, IsotropicMaterial>> volume_materials;
    ElementChoice                                          element = ElementChoice::automatic;

    /// Of boundaries that are not flat. The last entry of a boundary counts.
    std::vector<BoundaryGeometry> geometry;
    /// Pairs of boundaries whose common edges stay straight.
    std::vector<std::pair<std::string, std::string>> sharp_edges;
    /// Whether the vertices of the mesh, too, move to the shapes.
    bool snap = false;
  };

  /// The active cells of a triangulation of hexahedra or tetrahedra without hanging nodes as plain arrays.
  /// Boundaries and volumes (material ids) have the given names, the others their numbers as text. Errors:
  /// InputError for hanging nodes and other kinds of cells.
  VolumeMesh make_volume_mesh(const dealii::Triangulation<3>                          &triangulation,
                              const std::map<dealii::types::boundary_id, std::string> &boundary_names = {},
                              const std::map<dealii::types::material_id, std::string> &volume_names   = {});

  /// A body from a triangulation: the mesh as in make_volume_mesh(), and for every boundary whose faces have
  /// one manifold a copy of that, for new vertices. Gaps want the shape of a boundary, which a manifold does
  /// not have: give it to BoundaryGeometry::shape, or they are measured on what the mesh shows. Manifolds
  /// inside of the body are not kept. Errors: those of make_volume_mesh().
  BodyDefinition make_body(const std::string &name, const dealii::Triangulation<3> &triangulation,
                           const std::map<dealii::types::boundary_id, std::string> &boundary_names = {},
                           const std::map<dealii::types::material_id, std::string> &volume_names   = {});
} // namespace Signorini

#endif
